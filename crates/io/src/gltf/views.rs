//! Buffer views: parts of the buffers, as they are or compressed, and the elements in them.

use super::JsonError;
use super::accessor::Reader;
use super::document::get;
use super::meshopt::{self, Compressed};

impl Reader<'_> {
    /// The bytes of a view.
    ///
    /// # Errors
    ///
    /// If there is no such view or its buffer is too short; `pointer` is the place that refers to it.
    pub(super) fn view(
        &self,
        index: usize,
        pointer: impl Fn() -> String,
    ) -> Result<&[u8], JsonError> {
        let at = format!("/bufferViews/{index}");
        let view = get(&self.document.views, index, pointer, "buffer view")?;
        if let Some(Some(compressed)) = self.document.compressed.get(index) {
            return self.decoded(index, compressed);
        }
        let start = view.byte_offset.unwrap_or_default().0;
        self.part(view.buffer.value(), start, view.byte_length.0, &at)
    }

    /// The bytes of a compressed view, which are decoded when they are first needed.
    fn decoded(&self, index: usize, compressed: &Compressed) -> Result<&[u8], JsonError> {
        let slot = &self.decoded[index];
        if let Some(decoded) = slot.get() {
            return Ok(decoded);
        }
        let at = meshopt::pointer(index, compressed.extension);
        let error = |message| JsonError::new(&at, message);
        let length = compressed
            .decoded_length(&self.document.views[index])
            .map_err(error)?;
        let Compressed {
            buffer,
            byte_offset,
            byte_length,
            ..
        } = *compressed;
        let stream = self.part(buffer, byte_offset, byte_length, &at)?;
        let decoded = compressed
            .decode(stream, self.budget.inflate(length, &at)?)
            .map_err(error)?;
        Ok(slot.get_or_init(|| decoded))
    }

    /// `length` bytes of a buffer from `start`, as the object at `at` says.
    fn part(&self, buffer: usize, start: u64, length: u64, at: &str) -> Result<&[u8], JsonError> {
        let bytes = get(self.buffers, buffer, || format!("{at}/buffer"), "buffer")?;
        let end = start
            .checked_add(length)
            .filter(|&end| end <= bytes.len() as u64);
        let range =
            end.and_then(|end| Some(usize::try_from(start).ok()?..usize::try_from(end).ok()?));
        range.map(|range| &bytes[range]).ok_or_else(|| {
            let message = format!(
                "the view says {length} bytes from {start}, but buffer {buffer} has {}",
                bytes.len()
            );
            JsonError::new(format!("{at}/byteLength"), message)
        })
    }

    /// `count` pieces of `size` bytes in a view, from `offset`, as far apart as the view says.
    pub(super) fn rows(
        &self,
        index: usize,
        offset: u64,
        count: u64,
        size: usize,
        here: &str,
    ) -> Result<Rows<'_>, JsonError> {
        let bytes = self.view(index, || format!("{here}/bufferView"))?;
        let (view, at) = (&self.document.views[index], format!("/bufferViews/{index}"));
        let stride = view.byte_stride.map_or(0, |stride| stride.0);
        let stride = if stride == 0 { size } else { stride };
        if stride < size {
            let message =
                format!("expected at least {size}, the size of an element, found {stride}");
            return Err(JsonError::new(format!("{at}/byteStride"), message));
        }
        // The last element needs no room for the rest of its stride.
        let needed = match count {
            0 => Some(0),
            _ => (count - 1)
                .checked_mul(stride as u64)
                .and_then(|bytes| bytes.checked_add(size as u64))
                .and_then(|bytes| bytes.checked_add(offset)),
        };
        if needed.is_none_or(|needed| needed > bytes.len() as u64) {
            let message = format!(
                "{count} elements of {size} bytes, {stride} apart, from byte {offset} do not fit the \
                 {} bytes of the view",
                bytes.len()
            );
            return Err(JsonError::new(format!("{here}/count"), message));
        }
        // Both fit: they are no more than the length of the view.
        let [count, offset] = [count, offset].map(|n| usize::try_from(n).unwrap_or(0));
        Ok(Rows {
            bytes: bytes.get(offset..).unwrap_or_default(),
            count,
            size,
            stride,
        })
    }
}

/// Pieces of the same size, the same distance apart. The last one needs no room behind it.
#[derive(Clone, Copy)]
pub(super) struct Rows<'a> {
    pub(super) bytes: &'a [u8],
    pub(super) count: usize,
    size: usize,
    pub(super) stride: usize,
}

impl<'a> Rows<'a> {
    /// `count` rows from the one at `first`.
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
