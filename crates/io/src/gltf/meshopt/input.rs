//! Reads the bytes of a compressed stream.

use crate::fault::Fault;
use mesh::counted;

/// Reads a stream between its header and its tail.
pub(super) struct Input<'a> {
    pub(super) bytes: &'a [u8],
    pub(super) at: usize,
}

impl<'a> Input<'a> {
    /// Creates an input that starts after the first byte of `stream` and ends `tail` bytes before the end of `stream`.
    ///
    /// # Errors
    ///
    /// Returns an error if the stream is shorter than `tail + 1` bytes.
    pub(super) fn new(stream: &'a [u8], tail: usize) -> Result<Self, Fault> {
        let end = stream.len().checked_sub(tail).filter(|&end| end > 0);
        let end = end.ok_or_else(|| {
            let message = format!("expected at least {} bytes", tail + 1);
            Fault::byte(stream.len(), message)
        })?;
        Ok(Self {
            bytes: &stream[..end],
            at: 1,
        })
    }

    pub(super) fn take(&mut self, n: usize) -> Result<&'a [u8], Fault> {
        let rest = &self.bytes[self.at..];
        let taken = rest.get(..n).ok_or_else(|| {
            let bytes = counted(n, "more byte");
            let message = format!("expected {bytes}, found {}", rest.len());
            Fault::byte(self.at, message)
        })?;
        self.at += n;
        Ok(taken)
    }

    pub(super) fn byte(&mut self) -> Result<u8, Fault> {
        Ok(self.take(1)?[0])
    }

    /// Reads a number in groups of 7 bits, the lowest first. Each byte except the last has its highest bit set.
    pub(super) fn number(&mut self) -> Result<u32, Fault> {
        let start = self.at;
        let mut number = 0;
        for shift in (0..35).step_by(7) {
            let byte = self.byte()?;
            number |= u32::from(byte & 0x7f) << shift;
            if byte < 0x80 {
                return Ok(number);
            }
        }
        Err(Fault::byte(start, "expected a number of at most 5 bytes"))
    }

    /// Checks that the input is completely read.
    ///
    /// # Errors
    ///
    /// Returns an error if bytes are left.
    pub(super) fn end(&self) -> Result<(), Fault> {
        let left = self.bytes.len() - self.at;
        if left > 0 {
            let bytes = counted(left, "more byte");
            let message = format!("expected the end of the data, found {bytes}");
            return Err(Fault::byte(self.at, message));
        }
        Ok(())
    }
}

/// Checks the first byte of a stream.
pub(super) fn header(stream: &[u8], expected: u8) -> Result<(), Fault> {
    match stream.first() {
        Some(&found) if found == expected => Ok(()),
        Some(found) => {
            let message = format!("expected {expected:#04x}, found {found:#04x}");
            Err(Fault::byte(0, message))
        }
        None => Err(Fault::byte(0, "the stream is empty")),
    }
}

/// Returns the signed difference that a number in zigzag encoding represents. The numbers 0, 1, 2, 3 and so on encode
/// 0, -1, 1, -2 and so on.
pub(super) fn zigzag(v: u32) -> u32 {
    (v >> 1) ^ (v & 1).wrapping_neg()
}
