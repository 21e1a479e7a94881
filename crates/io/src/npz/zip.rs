//! Uncompressed zip archives.
//!
//! Source: PKWARE, "APPNOTE.TXT - .ZIP File Format Specification", sections 4.3.7, 4.3.12 and 4.3.16.

use flate2::Crc;

/// An archive under construction. Equal content gives equal bytes, because all files have the earliest date,
/// 1980-01-01.
#[derive(Debug, Default)]
pub(super) struct Archive {
    bytes: Vec<u8>,
    files: Vec<Entry>,
}

#[derive(Debug)]
struct Entry {
    name: String,
    /// The checksum (CRC-32), the compressed size and the uncompressed size of the file.
    sizes: [u64; 3],
    offset: u64,
}

/// The header fields that are the same for all files of the archive: the version that a reader needs (2.0), the flag
/// for names in UTF-8, no compression, the time, and the date.
const COMMON: [u16; 5] = [20, 1 << 11, 0, 0, (1 << 5) | 1];

impl Archive {
    /// Whether there is a file of this name.
    pub(super) fn has(&self, name: &str) -> bool {
        self.files.iter().any(|file| file.name == name)
    }

    /// Adds a file.
    pub(super) fn add(&mut self, name: &str, content: &[u8]) {
        let mut crc = Crc::new();
        crc.update(content);
        let size = content.len() as u64;
        let entry = Entry {
            name: name.to_owned(),
            sizes: [crc.sum().into(), size, size],
            offset: self.bytes.len() as u64,
        };
        self.bytes.extend_from_slice(b"PK\x03\x04");
        push_header(&mut self.bytes, &entry);
        self.bytes.extend_from_slice(name.as_bytes());
        self.bytes.extend_from_slice(content);
        self.files.push(entry);
    }

    /// Returns the bytes of the archive. Returns `None` if the archive exceeds a limit of the format: 4 GiB, 65,535
    /// files, or names of 65,535 bytes.
    pub(super) fn finish(mut self) -> Option<Vec<u8>> {
        let start = u32::try_from(self.bytes.len()).ok()?;
        let count = u16::try_from(self.files.len()).ok()?.to_le_bytes();
        for entry in &self.files {
            u16::try_from(entry.name.len()).ok()?;
            self.bytes.extend_from_slice(b"PK\x01\x02\x14\x00");
            push_header(&mut self.bytes, entry);
            // The entry has no comment, is on disk 0, and has no attributes.
            self.bytes.extend_from_slice(&[0; 10]);
            self.bytes.extend_from_slice(&low(entry.offset));
            self.bytes.extend_from_slice(entry.name.as_bytes());
        }
        let size = u32::try_from(self.bytes.len()).ok()? - start;
        self.bytes.extend_from_slice(b"PK\x05\x06\x00\x00\x00\x00");
        self.bytes.extend_from_slice(&[count, count].concat());
        self.bytes.extend_from_slice(&size.to_le_bytes());
        self.bytes.extend_from_slice(&start.to_le_bytes());
        self.bytes.extend_from_slice(&[0, 0]);
        Some(self.bytes)
    }
}

/// The local header and the central header of a file have some fields in common. Appends these fields, from the version
/// to the length of the extra field. This length is 0.
fn push_header(out: &mut Vec<u8>, entry: &Entry) {
    out.extend(COMMON.iter().flat_map(|x| x.to_le_bytes()));
    out.extend(entry.sizes.iter().flat_map(|&x| low(x)));
    let length = low(entry.name.len() as u64);
    out.extend_from_slice(&[length[0], length[1], 0, 0]);
}

/// Returns the lowest 32 bits of a number. `finish` refuses archives in which a number needs more than 32 bits.
fn low(x: u64) -> [u8; 4] {
    let [a, b, c, d, ..] = x.to_le_bytes();
    [a, b, c, d]
}
