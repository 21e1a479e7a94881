//! Compresses the arrays of a document with the extension `EXT_meshopt_compression`.
//!
//! ```text
//! buffer 0    the compressed arrays and everything else, such as images
//! buffer 1    the fallback: the size of the uncompressed arrays, without content
//! view        its range in buffer 1 (the fallback); its extension has the range in buffer 0
//! ```

use std::collections::BTreeMap;

use serde_json::{Value, json};

use super::meshopt::{Filter, MESHOPT, encode_attributes, encode_triangles};
use super::pieces::Piece;

/// How the elements of an array are compressed.
pub(super) struct Array {
    mode: &'static str,
    stride: usize,
    filter: Filter,
}

impl Array {
    /// Returns how an array of attributes is compressed. Each element has `stride` bytes, to which the reader applies
    /// `filter`.
    pub(super) fn attribute(stride: usize, filter: Filter) -> Self {
        Self {
            mode: "ATTRIBUTES",
            stride,
            filter,
        }
    }

    /// Returns how an array of triangles is compressed. Each index has `size` bytes, which is 2 or 4.
    pub(super) fn triangles(size: usize) -> Self {
        Self {
            mode: "TRIANGLES",
            stride: size,
            filter: Filter::None,
        }
    }

    fn encode(&self, bytes: &[u8]) -> Vec<u8> {
        match (self.mode, self.stride) {
            ("ATTRIBUTES", stride) => encode_attributes(bytes, stride),
            (_, 2) => encode_triangles(bytes, |index: [u8; 2]| u16::from_le_bytes(index).into()),
            _ => encode_triangles(bytes, u32::from_le_bytes),
        }
    }
}

/// Compresses each piece of the buffer whose view has an entry in `arrays`. `views` and `pieces` have the same length
/// and order. Returns all pieces, each with its new position in the buffer.
pub(super) fn compress<'a>(
    views: &mut [Value],
    buffers: &mut Vec<Value>,
    pieces: &[Piece<'a>],
    arrays: &BTreeMap<usize, Array>,
) -> Vec<Piece<'a>> {
    let mut packed: Vec<Piece> = Vec::with_capacity(pieces.len());
    let mut fallback = 0_usize;
    for (i, (piece, view)) in pieces.iter().zip(views).enumerate() {
        let mut bytes = mesh::zeroed(piece.length);
        (piece.fill)(&mut bytes);
        let start = packed.last().map_or(0, Piece::end).next_multiple_of(4);
        if let Some(array) = arrays.get(&i) {
            let stream = array.encode(&bytes);
            let filter = (array.filter == Filter::Octahedral).then_some("OCTAHEDRAL");
            view["extensions"] = json!({ MESHOPT[0]: {
                "buffer": 0,
                "byteOffset": start,
                "byteLength": stream.len(),
                "byteStride": array.stride,
                "count": bytes.len() / array.stride,
                "mode": array.mode,
                "filter": filter,
            } });
            view["buffer"] = json!(1);
            view["byteOffset"] = json!(fallback);
            fallback = (fallback + piece.length).next_multiple_of(4);
            bytes = stream;
        } else {
            view["byteOffset"] = json!(start);
        }
        packed.push(Piece {
            start,
            length: bytes.len(),
            fill: Box::new(move |out| out.copy_from_slice(&bytes)),
        });
    }
    buffers[0]["byteLength"] = json!(packed.last().map_or(0, Piece::end));
    buffers.push(json!({
        "byteLength": fallback,
        "extensions": { MESHOPT[0]: { "fallback": true } },
    }));
    packed
}
