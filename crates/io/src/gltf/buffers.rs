//! The bytes behind a glTF document: the container of a GLB file, data URIs and files beside it.

use std::borrow::Cow;
use std::collections::BTreeSet;
use std::ops::Range;
use std::path::{Path, PathBuf};

use gltf_json::Buffer;

use super::JsonError;
use super::budget::Budget;
use crate::asset_path::{folder_of, inside_uri, read_beside};
use crate::error::ReadError;
use crate::note::Notes;

const MAGIC: &[u8] = b"glTF";
const JSON_CHUNK: &[u8] = b"JSON";
const BIN_CHUNK: &[u8] = b"BIN\0";

/// Where the parts of a GLB file lie in its bytes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Container {
    pub(super) json: Range<usize>,
    pub(super) binary: Option<Range<usize>>,
}

/// Finds the chunks of a GLB file; a file that does not begin as one is JSON as a whole.
///
/// # Errors
///
/// [`ReadError::Binary`] if the header or the lengths are wrong.
pub(super) fn container(path: &Path, bytes: &[u8]) -> Result<Container, ReadError> {
    if !bytes.starts_with(MAGIC) {
        return Ok(Container {
            json: 0..bytes.len(),
            binary: None,
        });
    }
    let error = |offset, message: String| ReadError::Binary {
        path: path.to_path_buf(),
        offset,
        message,
    };
    let word = |at: usize| {
        let four = bytes.get(at..at + 4).and_then(|four| four.try_into().ok());
        four.map(|four| u32::from_le_bytes(four) as usize)
            .ok_or_else(|| {
                error(
                    at,
                    "expected 4 more bytes, found the end of the file".to_owned(),
                )
            })
    };
    let version = word(4)?;
    if version != 2 {
        return Err(error(4, format!("expected GLB version 2, found {version}")));
    }
    let length = word(8)?;
    if length > bytes.len() {
        let message = format!(
            "the header says {length} bytes, but the file has {}",
            bytes.len()
        );
        return Err(error(8, message));
    }
    let mut chunks = Vec::new();
    let mut at = 12;
    while at < length && chunks.len() < 2 {
        let size = word(at)?;
        let start = at + 8;
        word(at + 4)?;
        let end = start.checked_add(size).filter(|&end| end <= length);
        let end = end.ok_or_else(|| {
            let rest = length.saturating_sub(start);
            error(at, format!("a chunk says {size} bytes, but {rest} follow"))
        })?;
        chunks.push((at, &bytes[at + 4..start], start..end));
        at = end;
    }
    match chunks.first() {
        Some((_, kind, json)) if *kind == JSON_CHUNK => {
            let binary = chunks.get(1).filter(|(_, kind, _)| *kind == BIN_CHUNK);
            Ok(Container {
                json: json.clone(),
                binary: binary.map(|(_, _, range)| range.clone()),
            })
        }
        _ => Err(error(12, "expected a chunk of JSON first".to_owned())),
    }
}

/// Finds the bytes of all buffers. `binary` is the chunk of a GLB file, which stays where it is. What files beside
/// it pay for is added to the budget, a file that is read once more is taken from it. Of `fallbacks` nothing is
/// read: they stay empty.
///
/// # Errors
///
/// If a URI leaves the folder of `path` or its file cannot be read, or there are fewer bytes than a
/// buffer says.
pub(super) fn load<'a>(
    path: &Path,
    buffers: &[Buffer],
    fallbacks: &[bool],
    mut binary: Option<&'a [u8]>,
    budget: &Budget,
    notes: &mut Notes,
) -> Result<Vec<Cow<'a, [u8]>>, JsonError> {
    let mut loaded = Vec::new();
    let mut files = BTreeSet::new();
    for (i, buffer) in buffers.iter().enumerate() {
        if fallbacks.get(i) == Some(&true) {
            loaded.push(Cow::Borrowed(&[][..]));
            continue;
        }
        let length = buffer.byte_length.0;
        let mut bytes = match &buffer.uri {
            None => {
                let chunk = if i == 0 { binary.take() } else { None };
                // A buffer without data is legal: an extension would fill it. Nothing can be read of it.
                Cow::Borrowed(chunk.unwrap_or_default())
            }
            Some(uri) => {
                let pointer = format!("/buffers/{i}/uri");
                let error = |message| JsonError::new(&pointer, message);
                Cow::Owned(if let Some(data) = uri.strip_prefix("data:") {
                    data_uri(data).map_err(error)?.1
                } else {
                    let name = file_of(uri).map_err(error)?;
                    if files.contains(&name) {
                        budget.spend(length, &pointer)?;
                    }
                    notes.has_read(folder_of(path).join(&name));
                    let bytes = read_beside(path, &name, length)
                        .map_err(|cause| error(format!("cannot read {:?}: {cause}", shown(uri))))?;
                    if files.insert(name) {
                        budget.grant(bytes.len() as u64);
                    }
                    bytes
                })
            }
        };
        if (bytes.len() as u64) < length {
            return Err(JsonError::new(
                format!("/buffers/{i}/byteLength"),
                format!("the buffer says {length} bytes, but has {}", bytes.len()),
            ));
        }
        let length = usize::try_from(length).unwrap_or(usize::MAX);
        match &mut bytes {
            Cow::Borrowed(bytes) => *bytes = &bytes[..length.min(bytes.len())],
            Cow::Owned(bytes) => bytes.truncate(length),
        }
        loaded.push(bytes);
    }
    Ok(loaded)
}

fn file_of(uri: &str) -> Result<PathBuf, String> {
    inside_uri(uri).map_err(|why| format!("the URI {:?} {why}", shown(uri)))
}

/// The beginning of a text that may be long.
fn shown(uri: &str) -> String {
    uri.chars().take(80).collect()
}

/// The type and the bytes of a data URI (RFC 2397) behind its `data:`.
///
/// # Errors
///
/// If it is not in base64.
pub(super) fn data_uri(data: &str) -> Result<(&str, Vec<u8>), String> {
    let (kind, encoded) = data
        .split_once(";base64,")
        .ok_or("expected data in base64")?;
    let mime = kind.split(';').next().unwrap_or_default();
    let bytes =
        base64(encoded.as_bytes()).ok_or_else(|| "the data is not valid base64".to_owned())?;
    Ok((mime, bytes))
}

/// Decodes base64 (RFC 4648), with or without its padding. White space in it means nothing.
fn base64(encoded: &[u8]) -> Option<Vec<u8>> {
    let joined: Vec<u8>;
    let encoded = if encoded.iter().any(u8::is_ascii_whitespace) {
        let digits = encoded.iter().filter(|byte| !byte.is_ascii_whitespace());
        joined = digits.copied().collect();
        &joined
    } else {
        encoded
    };
    let padding = encoded
        .iter()
        .rev()
        .take_while(|&&byte| byte == b'=')
        .count();
    let digits = &encoded[..encoded.len() - padding];
    if padding > 2 || digits.len() % 4 == 1 {
        return None;
    }
    let mut bytes = Vec::with_capacity(digits.len() / 4 * 3 + 2);
    let (mut bits, mut n_bits) = (0_u32, 0);
    for &digit in digits {
        let value = match digit {
            b'A'..=b'Z' => digit - b'A',
            b'a'..=b'z' => digit - b'a' + 26,
            b'0'..=b'9' => digit - b'0' + 52,
            b'+' | b'-' => 62,
            b'/' | b'_' => 63,
            _ => return None,
        };
        bits = (bits << 6 | u32::from(value)) & 0xfff;
        n_bits += 6;
        if n_bits >= 8 {
            n_bits -= 8;
            bytes.push((bits >> n_bits & 0xff) as u8);
        }
    }
    Some(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn glb(chunks: &[(&[u8], &[u8])]) -> Vec<u8> {
        let mut body = Vec::new();
        for (kind, data) in chunks {
            body.extend_from_slice(&u32::try_from(data.len()).unwrap().to_le_bytes());
            body.extend_from_slice(kind);
            body.extend_from_slice(data);
        }
        let mut bytes = b"glTF\x02\0\0\0".to_vec();
        bytes.extend_from_slice(&u32::try_from(body.len() + 12).unwrap().to_le_bytes());
        bytes.extend_from_slice(&body);
        bytes
    }

    #[test]
    fn base64_of_every_length_decodes() {
        for (text, bytes) in [
            ("", &b""[..]),
            ("Zg==", b"f"),
            ("Zm8=", b"fo"),
            ("Zm9v", b"foo"),
            ("Zm9vYg", b"foob"),
            ("Zm9vYmFy", b"foobar"),
            (" Zm9v\r\n\tYg == \n", b"foob"),
        ] {
            assert_eq!(base64(text.as_bytes()).as_deref(), Some(bytes), "{text}");
        }
        for text in ["Z", "Zm9v!", "====", "Zm=v"] {
            assert_eq!(base64(text.as_bytes()), None, "{text}");
        }
    }

    #[test]
    fn chunks_are_found() {
        let bytes = glb(&[(JSON_CHUNK, b"{}  "), (BIN_CHUNK, b"abcd"), (b"XXXX", b"")]);
        let container = container(Path::new("a"), &bytes).unwrap();
        assert_eq!(&bytes[container.json], b"{}  ");
        assert_eq!(&bytes[container.binary.unwrap()], b"abcd");
    }

    #[test]
    fn broken_containers_are_refused_at_the_byte() {
        let good = glb(&[(JSON_CHUNK, b"{}  "), (BIN_CHUNK, b"abcd")]);
        let changed = |at: usize, byte: u8| {
            let mut bytes = good.clone();
            bytes[at] = byte;
            bytes
        };
        for (bytes, place) in [
            (good[..6].to_vec(), 4),
            (good[..12].to_vec(), 8),
            (good[..good.len() - 1].to_vec(), 8),
            (changed(4, 1), 4),
            (changed(12, 200), 12),
            (changed(15, 255), 12),
            (changed(16, b'X'), 12),
            (changed(8, 12), 12),
        ] {
            match container(Path::new("a"), &bytes) {
                Err(ReadError::Binary { offset, .. }) => assert_eq!(offset, place),
                other => panic!("{other:?}"),
            }
        }
    }
}
