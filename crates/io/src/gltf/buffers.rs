//! Reads the bytes of a glTF document from the container of a GLB file, data URIs, and files next to the document.

use std::borrow::Cow;
use std::collections::BTreeSet;
use std::path::Path;

use base64::Engine as _;
use base64::alphabet::STANDARD;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use gltf_json::Buffer;
use store::Store;

use super::budget::Budget;
use crate::ReadError;
use crate::assets::{Assets, inside_uri};
use crate::fault::Fault;

const MAGIC: &[u8] = b"glTF";
const JSON_CHUNK: &[u8] = b"JSON";
const BIN_CHUNK: &[u8] = b"BIN\0";

/// The number of bytes before the JSON of a GLB file: its header, and the length and the kind of the first chunk.
const HEAD: usize = 20;

/// The largest JSON chunk of a GLB file that is read, in bytes.
const MAX_JSON: u64 = 1 << 30;

/// Reads the JSON of a file, without the bytes that follow it in a GLB file.
///
/// # Errors
///
/// Returns an error if the file cannot be read.
pub(crate) fn document_of(store: &dyn Store, path: &Path) -> Result<Vec<u8>, ReadError> {
    // The first bytes of a GLB file contain the length of its JSON chunk.
    let head = store.read_up_to(path, HEAD as u64)?;
    let length = match head.as_slice() {
        [b'g', b'l', b'T', b'F', .., a, b, c, d, _, _, _, _] if head.len() == HEAD => {
            u32::from_le_bytes([*a, *b, *c, *d])
        }
        _ => return Ok(store.read(path)?),
    };
    let mut bytes = store.read_up_to(path, HEAD as u64 + u64::from(length).min(MAX_JSON))?;
    Ok(bytes.split_off(HEAD.min(bytes.len())))
}

/// Returns the JSON and the binary chunk of a GLB file. If the file does not begin with the header of a GLB file,
/// returns all of its bytes as JSON.
///
/// # Errors
///
/// Returns an error if the header or the lengths are wrong.
pub(super) fn container(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), Fault> {
    if !bytes.starts_with(MAGIC) {
        return Ok((bytes, None));
    }
    let word = |at: usize| {
        let four = bytes.get(at..).and_then(|rest| rest.first_chunk());
        let message = "expected 4 more bytes, found the end of the file";
        let four = four.ok_or_else(|| Fault::byte(at, message))?;
        Ok(u32::from_le_bytes(*four) as usize)
    };
    let version = word(4)?;
    if version != 2 {
        let message = format!("expected GLB version 2, found {version}");
        return Err(Fault::byte(4, message));
    }
    let length = word(8)?;
    if length > bytes.len() {
        let n = bytes.len();
        let message = format!(
            "the header declares a file of {length} bytes, but the file has only {n} bytes"
        );
        return Err(Fault::byte(8, message));
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
            Fault::byte(
                at,
                format!("a chunk declares {size} bytes, but only {rest} bytes follow"),
            )
        })?;
        chunks.push((&bytes[at + 4..start], &bytes[start..end]));
        at = end;
    }
    match chunks[..] {
        [(JSON_CHUNK, json), (BIN_CHUNK, binary)] => Ok((json, Some(binary))),
        [(JSON_CHUNK, json), ..] => Ok((json, None)),
        _ => Err(Fault::byte(12, "expected a JSON chunk as the first chunk")),
    }
}

/// Loads the bytes of all buffers. `binary` is the binary chunk of a GLB file. The chunk is not copied. When a file
/// next to the document is read for the first time, the memory budget grows with the number of bytes read. If a file
/// was already read for an earlier buffer, the length of the new buffer is subtracted from the budget. A buffer whose
/// flag in `fallbacks` is true is not read and stays empty.
///
/// # Errors
///
/// Returns an error in these cases: a URI leads out of the folder of the document, a data URI is not base64, a file
/// cannot be read, there are fewer bytes than a buffer declares, or the memory budget is used up.
pub(super) fn load<'a>(
    buffers: &[Buffer],
    fallbacks: &[bool],
    mut binary: Option<&'a [u8]>,
    budget: &Budget,
    assets: &mut Assets,
) -> Result<Vec<Cow<'a, [u8]>>, Fault> {
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
                // A buffer without a URI and without a binary chunk has no bytes. If such a buffer declares a length
                // other than 0, the buffer is refused below.
                Cow::Borrowed(chunk.unwrap_or_default())
            }
            Some(uri) => {
                let pointer = format!("/buffers/{i}/uri");
                let error = |message: String| Fault::json(&pointer, message);
                Cow::Owned(if let Some(data) = uri.strip_prefix("data:") {
                    data_uri(data, &pointer)?.1
                } else {
                    // A message contains only the beginning of a long URI.
                    let shown: String = uri.chars().take(80).collect();
                    let name =
                        inside_uri(uri).map_err(|why| error(format!("the URI {shown:?} {why}")))?;
                    if files.contains(&name) {
                        budget.spend(length, &pointer)?;
                    }
                    let bytes = assets.read(&name, length);
                    let bytes =
                        bytes.map_err(|cause| error(format!("cannot read {shown:?}: {cause}")))?;
                    if files.insert(name) {
                        budget.grant(bytes.len() as u64);
                    }
                    bytes
                })
            }
        };
        if (bytes.len() as u64) < length {
            let message = format!(
                "the buffer declares {length} bytes, but has only {} bytes",
                bytes.len()
            );
            return Err(Fault::json(format!("/buffers/{i}/byteLength"), message));
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

/// Decodes a data URI (RFC 2397). `data` is the text after `data:`, and `pointer` is the location of the URI.
/// Returns the media type and the bytes.
///
/// # Errors
///
/// Returns an error if the data is not marked as base64 or is not valid base64.
pub(super) fn data_uri<'a>(data: &'a str, pointer: &str) -> Result<(&'a str, Vec<u8>), Fault> {
    let (kind, encoded) = data
        .split_once(";base64,")
        .ok_or_else(|| Fault::json(pointer, "expected a data URI in base64"))?;
    let mime = kind.split(';').next().unwrap_or_default();
    let bytes = base64(encoded);
    let bytes = bytes.ok_or_else(|| Fault::json(pointer, "the data is not valid base64"))?;
    Ok((mime, bytes))
}

/// Decodes base64 (RFC 4648) in the standard or the URL-safe alphabet, with or without padding. White space is ignored.
fn base64(encoded: &str) -> Option<Vec<u8>> {
    const CONFIG: GeneralPurposeConfig = GeneralPurposeConfig::new()
        .with_decode_allow_trailing_bits(true)
        .with_decode_padding_mode(DecodePaddingMode::Indifferent);
    const ENGINE: GeneralPurpose = GeneralPurpose::new(&STANDARD, CONFIG);
    let plain = |byte: u8| match byte {
        b'-' => b'+',
        b'_' => b'/',
        byte => byte,
    };
    let digits = encoded.bytes().filter(|byte| !byte.is_ascii_whitespace());
    ENGINE.decode(digits.map(plain).collect::<Vec<_>>()).ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fault::Location;

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
            assert_eq!(base64(text).as_deref(), Some(bytes), "{text}");
        }
        for text in ["Z", "Zm9v!", "====", "Zm=v"] {
            assert_eq!(base64(text), None, "{text}");
        }
    }

    #[test]
    fn chunks_are_found() {
        let bytes = glb(&[(JSON_CHUNK, b"{}  "), (BIN_CHUNK, b"abcd"), (b"XXXX", b"")]);
        let chunks = container(&bytes).unwrap();
        assert_eq!(chunks, (&b"{}  "[..], Some(&b"abcd"[..])));
    }

    #[test]
    fn errors_in_containers_name_the_byte() {
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
            assert_eq!(container(&bytes).unwrap_err().at, Location::Byte(place));
        }
    }
}
