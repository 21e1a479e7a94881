//! `web`: serves a folder to browsers on this computer.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::{Child, Command, Stdio};

use crate::folder::{Folder, PROGRAM};

/// A running server, which is killed when this value is dropped.
struct Server {
    child: Child,
    address: String,
    folder: Folder,
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// A response: the status, the headers in lower case, and the body.
struct Response {
    head: String,
    body: Vec<u8>,
}

impl Response {
    fn status(&self) -> u16 {
        self.head[9..12].parse().unwrap()
    }

    fn header(&self, name: &str) -> Option<&str> {
        let mut lines = self.head.lines().filter_map(|line| line.split_once(": "));
        lines
            .find(|(found, _)| *found == name)
            .map(|(_, value)| value)
    }
}

impl Server {
    fn new() -> Self {
        let folder = Folder::new()
            .with("secret.txt", "secret")
            .with("page/index.html", "<p>start</p>")
            .with("page/core.wasm", "plain")
            .with("page/core.wasm.br", "brotli")
            .with("page/inner/index.html", "<p>inner</p>")
            .with("page/LICENSE-MIT", "license");
        let mut child = Command::new(PROGRAM)
            .args(["web", "--port", "0", "page"])
            .current_dir(folder.path("."))
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let mut line = String::new();
        let mut output = BufReader::new(child.stdout.as_mut().unwrap());
        output.read_line(&mut line).unwrap();
        let address = line
            .strip_prefix("serving page at http://")
            .and_then(|rest| rest.strip_suffix("/, press Ctrl-C to stop\n"))
            .unwrap_or_else(|| panic!("{line:?}"))
            .to_owned();
        Self {
            child,
            address,
            folder,
        }
    }

    fn send(&self, request: &str) -> Response {
        let mut stream = TcpStream::connect(&self.address).unwrap();
        stream.write_all(request.as_bytes()).unwrap();
        let mut bytes = Vec::new();
        stream.read_to_end(&mut bytes).unwrap();
        let end = bytes.windows(4).position(|w| w == b"\r\n\r\n").unwrap() + 4;
        Response {
            head: String::from_utf8(bytes[..end].to_vec())
                .unwrap()
                .to_ascii_lowercase(),
            body: bytes[end..].to_vec(),
        }
    }

    fn get(&self, path: &str) -> Response {
        self.send(&format!(
            "GET {path} HTTP/1.1\r\nHost: {}\r\n\r\n",
            self.address
        ))
    }
}

#[test]
fn files_have_their_types_and_isolate_the_page() {
    let server = Server::new();
    for (path, content_type, body) in [
        ("/", "text/html; charset=utf-8", "<p>start</p>"),
        ("/?a#b", "text/html; charset=utf-8", "<p>start</p>"),
        ("/inner/", "text/html; charset=utf-8", "<p>inner</p>"),
        ("/core.wasm", "application/wasm", "plain"),
        ("/LICENSE-MIT", "text/plain; charset=utf-8", "license"),
    ] {
        let response = server.get(path);
        assert_eq!(response.status(), 200, "{path}");
        assert_eq!(response.header("content-type"), Some(content_type));
        assert_eq!(response.body, body.as_bytes());
        assert_eq!(
            response.header("cross-origin-opener-policy"),
            Some("same-origin")
        );
        assert_eq!(
            response.header("cross-origin-embedder-policy"),
            Some("require-corp")
        );
        assert_eq!(response.header("x-content-type-options"), Some("nosniff"));
        assert_eq!(response.header("content-encoding"), None);
    }
}

#[test]
fn a_compressed_file_is_sent_to_browsers_that_accept_it() {
    let server = Server::new();
    let request = "GET /core.wasm HTTP/1.1\r\nHost: localhost\r\nAccept-Encoding: gzip, br\r\n\r\n";
    let response = server.send(request);
    assert_eq!(response.body, b"brotli");
    assert_eq!(response.header("content-type"), Some("application/wasm"));
    assert_eq!(response.header("content-encoding"), Some("br"));
}

#[test]
fn files_outside_of_the_folder_are_not_served() {
    let server = Server::new();
    #[cfg(unix)]
    std::os::unix::fs::symlink(
        server.folder.path("secret.txt"),
        server.folder.path("page/link.txt"),
    )
    .unwrap();
    for (path, status) in [
        ("/missing.html", 404),
        ("/inner", 404),
        ("/link.txt", 404),
        ("/../secret.txt", 400),
        ("/inner/../../secret.txt", 400),
        ("/%2e%2e/secret.txt", 400),
        ("/..%5csecret.txt", 400),
        ("//etc/passwd", 400),
    ] {
        let response = server.get(path);
        assert_eq!(response.status(), status, "{path}");
        assert!(response.body.is_empty());
    }
}

#[test]
fn other_hosts_and_methods_are_refused() {
    let server = Server::new();
    let status = |request: &str| server.send(request).status();
    assert_eq!(status("GET / HTTP/1.1\r\nHost: evil.example\r\n\r\n"), 403);
    assert_eq!(status("GET / HTTP/1.1\r\n\r\n"), 403);
    assert_eq!(status("PUT / HTTP/1.1\r\nHost: localhost\r\n\r\n"), 405);
    assert_eq!(status("nonsense\r\n\r\n"), 400);
    let head = server.send("HEAD / HTTP/1.1\r\nHost: localhost\r\n\r\n");
    assert_eq!(
        (head.status(), head.header("content-length")),
        (200, Some("12"))
    );
    assert!(head.body.is_empty());
}

#[test]
fn a_large_file_arrives_complete() {
    let server = Server::new();
    let content: Vec<u8> = (0..30_000_000_u32).map(|i| (i % 251) as u8).collect();
    std::fs::write(server.folder.path("page/large.bin"), &content).unwrap();
    let response = server.get("/large.bin");
    assert_eq!(
        response.header("content-type"),
        Some("application/octet-stream")
    );
    assert!(response.body == content);
    // A browser that leaves early does not end the server.
    let mut stream = TcpStream::connect(&server.address).unwrap();
    write!(stream, "GET /large.bin HTTP/1.1\r\nHost: localhost\r\n\r\n").unwrap();
    drop(stream);
    assert_eq!(server.get("/").status(), 200);
}

#[test]
fn a_folder_without_a_page_is_an_error() {
    let ended = Folder::new().run("web .").with_code(1);
    ended.complains(&[". has no file index.html", "help: in the source"]);
}

#[cfg(unix)]
#[test]
fn ctrl_c_ends_the_server_with_exit_code_130() {
    let mut server = Server::new();
    let kill = Command::new("kill")
        .args(["-INT", &server.child.id().to_string()])
        .status();
    assert!(kill.unwrap().success());
    assert_eq!(server.child.wait().unwrap().code(), Some(130));
}
