//! Reads arbitrary bytes as a `.glb` file. Most mutations change one of the two chunks and correct the lengths in the
//! headers. Without correct lengths, the reader would reject nearly all files before it reads a chunk.

#![no_main]

#[path = "../../crates/io/tests/corpus/files.rs"]
mod files;

use libfuzzer_sys::{fuzz_mutator, fuzz_target, fuzzer_mutate};

/// The number of bytes of the file header and the two chunk headers.
const HEADERS: usize = 12 + 2 * 8;

fuzz_target!(|bytes: &[u8]| files::check("glb", bytes));

fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, seed: u32| {
    let chunks = chunks(&data[..size]);
    let Some(mut chunks) = chunks.filter(|_| !seed.is_multiple_of(16) && max_size > 2 * HEADERS)
    else {
        return fuzzer_mutate(data, size, max_size);
    };
    let which = usize::from(seed % 4 == 1);
    let room = max_size - HEADERS - 8;
    chunks[1 - which].truncate(room);
    let room = room - chunks[1 - which].len();
    let chunk = &mut chunks[which];
    let length = chunk.len().min(room);
    chunk.resize(room, 0);
    let length = fuzzer_mutate(chunk, length, room);
    chunk.truncate(length);
    let file = file(&chunks);
    data[..file.len()].copy_from_slice(&file);
    file.len()
});

/// Returns the two chunks of a well-formed file.
fn chunks(bytes: &[u8]) -> Option<[Vec<u8>; 2]> {
    let word = |at: usize| {
        let four = bytes.get(at..)?.first_chunk()?;
        usize::try_from(u32::from_le_bytes(*four)).ok()
    };
    let json = bytes.get(20..20 + word(12)?)?;
    let start = 20 + json.len() + 8;
    let binary = match word(start - 8) {
        Some(length) => bytes.get(start..start + length)?,
        None => &[],
    };
    Some([json.to_vec(), binary.to_vec()])
}

fn file(chunks: &[Vec<u8>; 2]) -> Vec<u8> {
    let mut body = Vec::new();
    for (chunk, (name, pad)) in chunks.iter().zip([(b"JSON", b' '), (b"BIN\0", 0)]) {
        let length = chunk.len().next_multiple_of(4);
        body.extend(word(length));
        body.extend(name);
        body.extend(chunk);
        body.resize(body.len() + length - chunk.len(), pad);
    }
    let mut file = b"glTF\x02\0\0\0".to_vec();
    file.extend(word(12 + body.len()));
    file.extend(body);
    file
}

fn word(length: usize) -> [u8; 4] {
    u32::try_from(length).unwrap_or(u32::MAX).to_le_bytes()
}
