//! Reads arbitrary bytes as a `.ply` file.

#![no_main]

#[path = "../../crates/io/tests/corpus/files.rs"]
mod files;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| files::check("ply", bytes));
