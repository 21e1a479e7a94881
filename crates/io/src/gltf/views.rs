//! Reads buffer views and their elements. A buffer view is a part of a buffer and can be compressed.

use std::borrow::Cow;
use std::cell::OnceCell;
use std::fmt;

use super::budget::Budget;
use super::document::Document;
use super::meshopt::{self, Compressed};
use super::reference::get;
use crate::fault::Fault;

/// Reads arrays from the buffers of a document.
pub(super) struct Reader<'a> {
    pub(super) document: &'a Document,
    pub(super) buffers: &'a [Cow<'a, [u8]>],
    pub(super) budget: &'a Budget,
    /// For each view, its decoded bytes. A compressed view is decoded when it is used for the first time. Other views
    /// are not decoded.
    pub(super) decoded: Vec<OnceCell<Vec<u8>>>,
}

impl<'a> Reader<'a> {
    pub(super) fn new(
        document: &'a Document,
        buffers: &'a [Cow<'a, [u8]>],
        budget: &'a Budget,
    ) -> Self {
        Self {
            document,
            buffers,
            budget,
            decoded: document.views.iter().map(|_| OnceCell::new()).collect(),
        }
    }
}

impl Reader<'_> {
    /// The bytes of a view.
    ///
    /// # Errors
    ///
    /// Returns an error if the view does not exist or its buffer is too short. `pointer` is the JSON pointer to the
    /// index that refers to the view, for errors.
    pub(super) fn view(&self, index: usize, pointer: impl fmt::Display) -> Result<&[u8], Fault> {
        let at = format!("/bufferViews/{index}");
        let view = get(&self.document.views, index, pointer, "buffer view")?;
        if let Some(Some(compressed)) = self.document.compressed.get(index) {
            return self.decoded(index, compressed);
        }
        let start = view.byte_offset.unwrap_or_default().0;
        self.part(view.buffer.value(), start, view.byte_length.0, &at)
    }

    /// The bytes of a compressed view, which are decoded on first use.
    fn decoded(&self, index: usize, compressed: &Compressed) -> Result<&[u8], Fault> {
        let slot = &self.decoded[index];
        if let Some(decoded) = slot.get() {
            return Ok(decoded);
        }
        let at = meshopt::pointer(index, compressed.extension);
        let length = compressed.decoded_length(&self.document.views[index], &at)?;
        let (start, n) = (compressed.byte_offset, compressed.byte_length);
        let stream = self.part(compressed.buffer, start, n, &at)?;
        let length = self.budget.inflate(length, &at)?;
        let decoded = compressed.decode(stream, length, &at)?;
        Ok(slot.get_or_init(|| decoded))
    }

    /// Returns `length` bytes of a buffer, beginning at byte `start`. `at` is the JSON pointer of the object that
    /// declares this range.
    fn part(&self, buffer: usize, start: u64, length: u64, at: &str) -> Result<&[u8], Fault> {
        let bytes = get(self.buffers, buffer, format_args!("{at}/buffer"), "buffer")?;
        let range = || {
            let end = usize::try_from(start.checked_add(length)?).ok()?;
            bytes.get(usize::try_from(start).ok()?..end)
        };
        range().ok_or_else(|| {
            let n = bytes.len();
            let message =
                format!("the buffer view declares {length} bytes from byte {start}, but buffer {buffer} has only {n} bytes");
            Fault::json(format!("{at}/byteLength"), message)
        })
    }

    /// Returns `count` rows of a view. A row has `size` bytes. The first row begins at byte `offset` of the view, and
    /// the rows have the stride of the view.
    pub(super) fn rows(
        &self,
        index: usize,
        offset: u64,
        count: u64,
        size: usize,
        here: &str,
    ) -> Result<Rows<'_>, Fault> {
        let bytes = self.view(index, format_args!("{here}/bufferView"))?;
        let (view, at) = (&self.document.views[index], format!("/bufferViews/{index}"));
        let stride = view.byte_stride.map_or(0, |stride| stride.0);
        let stride = if stride == 0 { size } else { stride };
        if stride < size {
            let message = format!(
                "expected a byte stride of at least {size}, the size of an element, found {stride}"
            );
            return Err(Fault::json(format!("{at}/byteStride"), message));
        }
        // The view is allowed to end directly after the last row, even if the stride exceeds the size of a row.
        let before = count.saturating_sub(1).checked_mul(stride as u64);
        let needed = before.and_then(|n| n.checked_add(size as u64)?.checked_add(offset));
        let needed = if count == 0 { Some(0) } else { needed };
        if needed.is_none_or(|needed| needed > bytes.len() as u64) {
            let message = format!(
                "{count} elements of {size} bytes, with a stride of {stride} bytes and beginning at byte {offset}, do \
                not fit in the {} bytes of the view",
                bytes.len()
            );
            return Err(Fault::json(format!("{here}/count"), message));
        }
        // `count` and `offset` fit in a `usize`, because they do not exceed the length of the view.
        let [count, offset] = [count, offset].map(|n| usize::try_from(n).unwrap_or(0));
        Ok(Rows {
            bytes: bytes.get(offset..).unwrap_or_default(),
            count,
            size,
            stride,
        })
    }
}

/// Rows of bytes. All rows have the same size. The stride is the distance in bytes between the beginnings of
/// consecutive rows. The bytes are allowed to end directly after the last row, even if the stride exceeds the size of a
/// row.
#[derive(Clone, Copy)]
pub(super) struct Rows<'a> {
    pub(super) bytes: &'a [u8],
    pub(super) count: usize,
    size: usize,
    pub(super) stride: usize,
}

impl<'a> Rows<'a> {
    /// The `count` rows beginning with row `first`.
    pub(super) fn block(self, first: usize, count: usize) -> Self {
        Self {
            bytes: &self.bytes[first * self.stride..],
            count,
            ..self
        }
    }

    pub(super) fn iter(self) -> impl Iterator<Item = &'a [u8]> {
        (0..self.count).map(move |i| {
            let start = i * self.stride;
            &self.bytes[start..start + self.size]
        })
    }
}
