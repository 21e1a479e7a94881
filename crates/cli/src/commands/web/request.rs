//! Parses the requests of browsers, and finds the files that the browsers request.

use std::io::{self, BufRead, BufReader, Read};
use std::path::{Component, Path, PathBuf};

/// The maximum length of a request in bytes.
const MAX_REQUEST: u64 = 1 << 14;

/// A request without its body.
#[derive(Debug, Default)]
pub(super) struct Request {
    method: String,
    target: String,
    host: String,
    accepts_brotli: bool,
    /// Whether the browser requests only the headers of the response.
    pub(super) is_head: bool,
}

/// The file that a request asks for.
#[derive(Debug)]
pub(super) struct Found {
    pub(super) path: PathBuf,
    pub(super) content_type: &'static str,
    /// Whether the file is compressed.
    pub(super) is_brotli: bool,
}

/// The reason why a request is not answered with a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Refusal {
    /// The request is not valid, or too long.
    BadRequest,
    /// The request names a host other than this computer. Without this check, a page from another host could read the
    /// files. The owner of that host can make its name point to this computer (DNS rebinding).
    Host,
    /// The folder does not contain the file.
    NotFound,
    /// The request is neither `GET` nor `HEAD`.
    Method,
}

impl Request {
    /// Reads a request. Returns `None` if the request is not valid.
    pub(super) fn read(stream: impl Read) -> io::Result<Option<Self>> {
        let mut reader = BufReader::new(stream.take(MAX_REQUEST));
        let mut request = Self::default();
        for number in 0.. {
            let mut line = Vec::new();
            reader.read_until(b'\n', &mut line)?;
            let Ok(line) = String::from_utf8(line) else {
                return Ok(None);
            };
            // A line without a line break means that the stream has ended or that the request is too long.
            let Some(line) = line.strip_suffix('\n') else {
                return Ok(None);
            };
            let line = line.trim_end();
            if number == 0 {
                let parts: Vec<&str> = line.split(' ').collect();
                let [method, target, version] = parts[..] else {
                    return Ok(None);
                };
                if !version.starts_with("HTTP/1.") {
                    return Ok(None);
                }
                request.is_head = method == "HEAD";
                (request.method, request.target) = (method.to_owned(), target.to_owned());
            } else if line.is_empty() {
                break;
            } else if let Some((name, value)) = line.split_once(':') {
                request.add_header(&name.to_ascii_lowercase(), value.trim());
            }
        }
        Ok(Some(request))
    }

    fn add_header(&mut self, name: &str, value: &str) {
        match name {
            "host" => value.clone_into(&mut self.host),
            "accept-encoding" => {
                let mut names = value.split(',').map(str::trim);
                self.accepts_brotli = names.any(|name| name == "br");
            }
            _ => {}
        }
    }

    /// Finds the requested file in `folder`. The path of this folder must be canonical.
    pub(super) fn find(&self, folder: &Path) -> Result<Found, Refusal> {
        let name = self
            .host
            .rsplit_once(':')
            .map_or(&*self.host, |(name, _)| name);
        if !["localhost", "127.0.0.1"].contains(&name) {
            return Err(Refusal::Host);
        }
        if !["GET", "HEAD"].contains(&&*self.method) {
            return Err(Refusal::Method);
        }
        let relative = relative_path(&self.target).ok_or(Refusal::BadRequest)?;
        let path = inside(folder, &relative).ok_or(Refusal::NotFound)?;
        let content_type = content_type(&path);
        let mut compressed = path.clone().into_os_string();
        compressed.push(".br");
        let compressed = Some(compressed).filter(|_| self.accepts_brotli);
        let compressed = compressed.and_then(|path| inside(folder, Path::new(&path)));
        Ok(Found {
            is_brotli: compressed.is_some(),
            path: compressed.unwrap_or(path),
            content_type,
        })
    }
}

/// Follows links, and returns the real path of a file in the folder. Returns `None` if the real path does not exist, is
/// not a regular file, or is outside of the folder.
fn inside(folder: &Path, path: &Path) -> Option<PathBuf> {
    let real = folder.join(path).canonicalize().ok()?;
    (real.starts_with(folder) && real.is_file()).then_some(real)
}

/// Converts the target of a request, such as `/a%20b.html?c`, to a path relative to the folder that is served. If the
/// path ends with a slash, it names a folder, so `index.html` is appended. Returns `None` if the path is not valid or
/// leads out of the folder that is served.
fn relative_path(target: &str) -> Option<PathBuf> {
    let path = target.split(['?', '#']).next().unwrap_or_default();
    let path = percent_decoded(path.strip_prefix('/')?)?;
    let is_normal = |part| matches!(part, Component::Normal(_));
    if path.contains(['\0', '\\']) || !Path::new(&path).components().all(is_normal) {
        return None;
    }
    let is_folder = path.is_empty() || path.ends_with('/');
    let path = PathBuf::from(path);
    Some(if is_folder {
        path.join("index.html")
    } else {
        path
    })
}

fn percent_decoded(text: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes();
    while let [first, tail @ ..] = rest {
        rest = tail;
        if *first != b'%' {
            bytes.push(*first);
            continue;
        }
        let (digits, tail) = rest.split_at_checked(2)?;
        let digit = |byte: u8| char::from(byte).to_digit(16);
        bytes.push(u8::try_from(16 * digit(digits[0])? + digit(digits[1])?).ok()?);
        rest = tail;
    }
    String::from_utf8(bytes).ok()
}

fn content_type(path: &Path) -> &'static str {
    let extension = path.extension().unwrap_or_default().to_string_lossy();
    match &*extension.to_ascii_lowercase() {
        "html" => "text/html; charset=utf-8",
        "js" | "mjs" => "text/javascript; charset=utf-8",
        "css" => "text/css; charset=utf-8",
        "json" => "application/json",
        "wasm" => "application/wasm",
        "svg" => "image/svg+xml",
        "png" => "image/png",
        "jpg" | "jpeg" => "image/jpeg",
        "ico" => "image/x-icon",
        "woff2" => "font/woff2",
        // Meshwright's web page has license files without an extension.
        "" | "txt" | "md" | "ron" => "text/plain; charset=utf-8",
        _ => "application/octet-stream",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_never_leads_out_of_the_folder() {
        for target in [
            "/../a",
            "/a/../../b",
            "/%2e%2e/a",
            "/%2E%2E%2Fa",
            "/..%2fa",
            "//etc/passwd",
            "/%2fetc/passwd",
            "/a%00b",
            "/..\\a",
            "/%5c..%5ca",
            "/%",
            "/%2",
            "/%zz",
            "/%ff",
            "a",
            "",
            "http://localhost/a",
            "*",
            "/./a/..",
        ] {
            assert_eq!(relative_path(target), None, "{target}");
        }
        for (target, path) in [
            ("/", "index.html"),
            ("/?a=/../b", "index.html"),
            ("/a/", "a/index.html"),
            ("/a%20b/c.js?d#e", "a b/c.js"),
            ("/%C3%A4..b", "ä..b"),
        ] {
            assert_eq!(
                relative_path(target).as_deref(),
                Some(Path::new(path)),
                "{target}"
            );
        }
    }

    #[test]
    fn requests_that_are_not_valid_have_no_target() {
        for text in [
            "",
            "GET / HTTP/1.1",
            "GET /\r\n\r\n",
            "GET / HTTP/2\r\n\r\n",
            "\r\n\r\n",
            "GET / HTTP/1.1\r\nHost: a\r\n",
        ] {
            assert!(
                Request::read(text.as_bytes()).unwrap().is_none(),
                "{text:?}"
            );
        }
        assert!(
            Request::read(&b"GET /\xff HTTP/1.1\r\n\r\n"[..])
                .unwrap()
                .is_none()
        );
        let long = format!("GET /{} HTTP/1.1\r\n\r\n", "a".repeat(1 << 20));
        assert!(Request::read(long.as_bytes()).unwrap().is_none());
        let request = Request::read(
            &b"HEAD /a HTTP/1.1\r\nHOST:  localhost:80\r\naccept-encoding: gzip, br\r\n\r\n"[..],
        );
        let request = request.unwrap().unwrap();
        assert_eq!((&*request.target, &*request.host), ("/a", "localhost:80"));
        assert!(request.is_head && request.accepts_brotli);
    }
}
