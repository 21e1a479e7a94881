//! Writes the parts of a buffer, and the container of a GLB file.

use crate::error::Unwritable;

/// A function that writes the bytes of a part.
pub(super) type Fill<'a> = Box<dyn Fn(&mut [u8]) + 'a>;

/// A part of the buffer, with the function that writes it.
pub(super) struct Piece<'a> {
    pub(super) start: usize,
    pub(super) length: usize,
    pub(super) fill: Fill<'a>,
}

impl Piece<'_> {
    /// The offset of the first byte after the part.
    pub(super) fn end(&self) -> usize {
        self.start + self.length
    }
}

/// Writes each part to its position in `out`.
pub(super) fn fill(out: &mut [u8], pieces: &[Piece]) {
    for piece in pieces {
        (piece.fill)(&mut out[piece.start..piece.end()]);
    }
}

/// Returns the size of a GLB file with a JSON chunk and a binary chunk of these sizes.
pub(super) fn container_length(json: usize, binary: usize) -> usize {
    let chunk = |length: usize| 8 + length.next_multiple_of(4);
    12 + chunk(json) + if binary > 0 { chunk(binary) } else { 0 }
}

/// Creates a GLB file: a header, a JSON chunk and a binary chunk, each padded to a multiple of 4 bytes.
///
/// # Errors
///
/// Returns an error if the file would be longer than the format allows.
pub(super) fn container(
    json: &[u8],
    binary: usize,
    pieces: &[Piece],
) -> Result<Vec<u8>, Unwritable> {
    let padded = json.len().next_multiple_of(4);
    let start = 20 + padded + 8;
    let length = container_length(json.len(), binary);
    let word = |n: usize| u32::try_from(n).map(u32::to_le_bytes).ok();
    let (Some(all), Some(json_length), Some(binary_length)) =
        (word(length), word(padded), word(binary.next_multiple_of(4)))
    else {
        let message =
            format!("a GLB file must be smaller than 4 GiB, but the scene needs {length} bytes");
        return Err(Unwritable::scene(message));
    };
    let mut out = mesh::zeroed::<u8>(length);
    out[..12].copy_from_slice(&[*b"glTF", 2_u32.to_le_bytes(), all].concat());
    out[12..20].copy_from_slice(&[json_length, *b"JSON"].concat());
    out[20..20 + json.len()].copy_from_slice(json);
    out[20 + json.len()..20 + padded].fill(b' ');
    if binary > 0 {
        out[start - 8..start].copy_from_slice(&[binary_length, *b"BIN\0"].concat());
        fill(&mut out[start..], pieces);
    }
    Ok(out)
}
