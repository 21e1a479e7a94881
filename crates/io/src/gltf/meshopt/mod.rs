//! Reads compressed buffer views, with the extensions `EXT_meshopt_compression` and `KHR_meshopt_compression`.
//!
//! ```text
//! buffer view     count * byteStride decoded bytes, as if they were in its buffer
//!  `- extension   buffer, byteOffset, byteLength: the location of the stream
//!                 mode:   ATTRIBUTES, TRIANGLES or INDICES
//!                 filter: NONE, OCTAHEDRAL, QUATERNION, EXPONENTIAL or COLOR
//! ```
//!
//! The two extensions are read in the same way. The second extension adds version 1 of the attribute codec and the
//! color filter. Source: Kapoulkine et al., "`KHR_meshopt_compression`", Khronos Group, 2025, appendix A for the codecs
//! and appendix B for the filters.

mod attributes;
mod encode_attributes;
mod encode_triangles;
mod filters;
mod indices;
mod input;
#[cfg(test)]
mod tests;
mod triangles;

use gltf_json::buffer::View;
use serde::Deserialize;
use serde_json::Value;

use crate::fault::{Fault, Location};
pub(super) use encode_attributes::encode as encode_attributes;
pub(super) use encode_triangles::encode as encode_triangles;
pub(super) use filters::Filter;

/// The names of the two extensions for compressed views.
pub(super) const MESHOPT: [&str; 2] = ["EXT_meshopt_compression", "KHR_meshopt_compression"];

/// The largest size of an element in bytes.
const LONGEST: u64 = 256;

/// The content of the extension that declares how a buffer view is compressed.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Compressed {
    /// The buffer with the stream.
    pub(super) buffer: usize,
    #[serde(default)]
    pub(super) byte_offset: u64,
    /// The length of the stream.
    pub(super) byte_length: u64,
    byte_stride: u64,
    /// The number of elements.
    count: u64,
    mode: Mode,
    #[serde(default)]
    filter: Filter,
    /// The name of the extension that the document uses.
    #[serde(skip)]
    pub(super) extension: &'static str,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "UPPERCASE")]
enum Mode {
    Attributes,
    Triangles,
    Indices,
}

/// Reads the extensions of each buffer view in the document.
///
/// # Errors
///
/// Returns an error for the first invalid extension.
pub(super) fn compressed(views: &[Value]) -> Result<Vec<Option<Compressed>>, Fault> {
    let one = |(i, view): (usize, &Value)| {
        let Some((extension, json)) = extension(view) else {
            return Ok(None);
        };
        let read = Compressed::deserialize(json)
            .map_err(|e| Fault::json(pointer(i, extension), e.to_string()))?;
        Ok(Some(Compressed { extension, ..read }))
    };
    views.iter().enumerate().map(one).collect()
}

fn extension(of: &Value) -> Option<(&'static str, &Value)> {
    let extensions = of.get("extensions")?;
    MESHOPT
        .iter()
        .find_map(|&name| Some((name, extensions.get(name)?)))
}

/// The JSON pointer to the extension of the buffer view with index `view`.
pub(super) fn pointer(view: usize, extension: &str) -> String {
    format!("/bufferViews/{view}/extensions/{extension}")
}

/// Returns a flag for each buffer. The flag is true if the reader never reads the buffer. This is the case if the
/// buffer is declared as a fallback, or if it contains only uncompressed alternatives of compressed views.
pub(super) fn fallbacks(
    buffers: &[Value],
    views: &[View],
    compressed: &[Option<Compressed>],
) -> Vec<bool> {
    let mut is_uncompressed_range = vec![false; buffers.len()];
    let mut is_read = vec![false; buffers.len()];
    for (view, compressed) in views.iter().zip(compressed) {
        let buffer = view.buffer.value();
        let (flags, stream) = match compressed {
            Some(compressed) => (&mut is_uncompressed_range, Some(compressed.buffer)),
            None => (&mut is_read, None),
        };
        if let Some(flag) = flags.get_mut(buffer) {
            *flag = true;
        }
        if let Some(flag) = stream.and_then(|stream| is_read.get_mut(stream)) {
            *flag = true;
        }
    }
    let is_declared = |buffer| {
        let json = extension(buffer).and_then(|(_, json)| json.get("fallback"));
        json == Some(&Value::Bool(true))
    };
    let both = is_uncompressed_range.into_iter().zip(is_read);
    both.zip(buffers)
        .map(|((is_uncompressed_range, is_read), buffer)| {
            is_declared(buffer) || is_uncompressed_range && !is_read
        })
        .collect()
}

impl Compressed {
    /// Returns the length of the decoded data in bytes.
    ///
    /// # Errors
    ///
    /// Returns an error if the extension at `pointer` is invalid, does not match the view, or declares more data than a
    /// stream of its size can contain.
    pub(super) fn decoded_length(&self, view: &View, pointer: &str) -> Result<u64, Fault> {
        let (stride, count) = (self.byte_stride, self.count);
        let (allowed, expected) = match self.mode {
            Mode::Attributes => (
                stride.is_multiple_of(4) && (4..=LONGEST).contains(&stride),
                "a multiple of 4 from 4 to 256",
            ),
            Mode::Triangles | Mode::Indices => (stride == 2 || stride == 4, "2 or 4"),
        };
        let filter_fits = self.filter == Filter::None
            || self.mode == Mode::Attributes && self.filter.fits(stride);
        let view_stride = view.byte_stride.map_or(stride, |other| other.0 as u64);
        let view_length = view.byte_length.0;
        let length = count
            .checked_mul(stride)
            .filter(|&length| length == view_length);
        let least = || match self.mode {
            Mode::Attributes => attributes::shortest(count, stride),
            Mode::Triangles => triangles::shortest(count),
            Mode::Indices => indices::shortest(count),
        };
        let message = if !allowed {
            format!("expected byteStride to be {expected}, found {stride}")
        } else if !filter_fits {
            let filter = self.filter;
            format!(
                "in this mode, the filter {filter:?} does not support elements of {stride} bytes"
            )
        } else if self.mode == Mode::Triangles && !count.is_multiple_of(3) {
            format!("expected count to be a multiple of 3, found {count}")
        } else if view_stride != stride {
            format!("expected the byteStride {view_stride} of the buffer view, found {stride}")
        } else if let Some(length) = length {
            if least() <= self.byte_length {
                return Ok(length);
            }
            format!(
                "{count} elements of {stride} bytes need at least {} compressed bytes, found {}",
                least(),
                self.byte_length
            )
        } else {
            format!(
                "{count} elements of {stride} bytes do not match the {view_length} bytes of the buffer view"
            )
        };
        Err(Fault::json(pointer, message))
    }

    /// Decodes the stream into `length` bytes, where `length` is the result of
    /// [`decoded_length`](Self::decoded_length).
    ///
    /// # Errors
    ///
    /// Returns the offset of the byte with the first error in the stream, and a message.
    pub(super) fn decode(
        &self,
        stream: &[u8],
        length: usize,
        pointer: &str,
    ) -> Result<Vec<u8>, Fault> {
        let mut decoded = mesh::zeroed::<u8>(length);
        // The conversion cannot fail, because `decoded_length` has checked that the stride is from 2 to 256.
        let stride = usize::try_from(self.byte_stride).unwrap_or(4);
        let result = match (self.mode, stride) {
            (Mode::Attributes, _) => attributes::decode(stream, stride, &mut decoded),
            (Mode::Triangles, 2) => triangles::decode(stream, length / 6, shorts(&mut decoded)),
            (Mode::Triangles, _) => triangles::decode(stream, length / 12, longs(&mut decoded)),
            (Mode::Indices, 2) => indices::decode(stream, shorts(&mut decoded)),
            (Mode::Indices, _) => indices::decode(stream, longs(&mut decoded)),
        };
        result.map_err(|Fault { at, message }| match at {
            Location::Byte(at) => {
                Fault::json(pointer, format!("byte {at} of the stream: {message}"))
            }
            at => Fault { at, message },
        })?;
        self.filter.apply(&mut decoded, stride);
        Ok(decoded)
    }
}

/// Returns functions that each store an index in 16 bits. Higher bits are dropped.
fn shorts(bytes: &mut [u8]) -> impl Iterator<Item = impl FnOnce(u32)> {
    let slots = bytes.as_chunks_mut::<2>().0.iter_mut();
    slots.map(|slot| {
        move |i: u32| {
            let [low, high, ..] = i.to_le_bytes();
            *slot = [low, high];
        }
    })
}

/// Returns functions that each store an index in 32 bits.
fn longs(bytes: &mut [u8]) -> impl Iterator<Item = impl FnOnce(u32)> {
    let slots = bytes.as_chunks_mut::<4>().0.iter_mut();
    slots.map(|slot| move |i: u32| *slot = i.to_le_bytes())
}
