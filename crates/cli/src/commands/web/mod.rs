//! `meshwright web`: serves a folder of static files, such as Meshwright's web page, to browsers on this computer.
//!
//! Each connection has its own thread and serves one request. Files are only read. Ctrl-C ends the program with exit
//! code 130.

mod request;

use std::fs::File;
use std::io::{self, Write};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::path::Path;
use std::sync::Arc;
use std::thread::{Builder, sleep};
use std::time::Duration;

use anyhow::{Context, bail};

use crate::args::WebArgs;
use crate::listener::{catch_interrupts, is_interrupted};
use crate::output::print;
use request::{Refusal, Request};

/// The interval for checking whether Ctrl-C was pressed.
const POLL_INTERVAL: Duration = Duration::from_millis(50);

/// The maximum time for which one read or write of a connection can wait.
const TIMEOUT: Duration = Duration::from_secs(10);

/// The headers of all responses. The first two headers isolate the page from pages of other origins. On a page that is
/// not isolated, browsers do not allow threads to share memory.
const HEADERS: &str = "\
Cross-Origin-Opener-Policy: same-origin\r
Cross-Origin-Embedder-Policy: require-corp\r
Cross-Origin-Resource-Policy: same-origin\r
X-Content-Type-Options: nosniff\r
Cache-Control: no-cache\r
Vary: Accept-Encoding\r
Connection: close\r
";

pub(crate) fn run(args: &WebArgs) -> anyhow::Result<bool> {
    let shown = args.folder.display();
    if !args.folder.join("index.html").is_file() {
        bail!(
            "{shown} has no file index.html\n\
             help: in the source of Meshwright, `crates/web/build.sh` builds the page in target/web/page"
        );
    }
    let folder = args.folder.canonicalize();
    let folder: Arc<Path> = folder
        .with_context(|| format!("cannot read {shown}"))?
        .into();
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, args.port))
        .with_context(|| format!("cannot listen on port {}", args.port))?;
    let address = listener.local_addr()?;
    catch_interrupts();
    Builder::new().spawn(move || accept(&listener, &folder))?;
    print(&format!(
        "serving {shown} at http://{address}/, press Ctrl-C to stop\n"
    ))?;
    while !is_interrupted() {
        sleep(POLL_INTERVAL);
    }
    Ok(false)
}

/// Accepts connections until the program ends.
fn accept(listener: &TcpListener, folder: &Arc<Path>) {
    loop {
        let accepted = listener.accept().and_then(|(stream, _)| {
            let folder = folder.clone();
            // An error while answering is ignored. Usually, the browser has closed the connection.
            Builder::new().spawn(move || _ = answer(&stream, &folder))
        });
        if accepted.is_err() {
            // There are too many connections or threads. While this thread sleeps, some of them can end.
            sleep(POLL_INTERVAL);
        }
    }
}

fn answer(mut stream: &TcpStream, folder: &Path) -> io::Result<()> {
    stream.set_read_timeout(Some(TIMEOUT))?;
    stream.set_write_timeout(Some(TIMEOUT))?;
    let Some(request) = Request::read(stream)? else {
        return refuse(stream, Refusal::BadRequest);
    };
    match request.find(folder) {
        Ok(found) => {
            let mut file = File::open(&found.path)?;
            let len = file.metadata()?.len();
            let encoding = if found.is_brotli {
                "Content-Encoding: br\r\n"
            } else {
                ""
            };
            write!(
                stream,
                "HTTP/1.1 200 OK\r\nContent-Type: {}\r\nContent-Length: {len}\r\n{encoding}{HEADERS}\r\n",
                found.content_type,
            )?;
            if !request.is_head {
                io::copy(&mut file, &mut stream)?;
            }
            Ok(())
        }
        Err(refusal) => refuse(stream, refusal),
    }
}

fn refuse(mut stream: &TcpStream, refusal: Refusal) -> io::Result<()> {
    let status = match refusal {
        Refusal::BadRequest => "400 Bad Request",
        Refusal::Host => "403 Forbidden",
        Refusal::NotFound => "404 Not Found",
        Refusal::Method => "405 Method Not Allowed\r\nAllow: GET, HEAD",
    };
    write!(
        stream,
        "HTTP/1.1 {status}\r\nContent-Length: 0\r\n{HEADERS}\r\n"
    )
}
