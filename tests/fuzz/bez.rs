//! Reads arbitrary bytes as a `.bez` file.

#![no_main]

#[path = "../../crates/io/tests/corpus/files.rs"]
mod files;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| files::check("bez", bytes));
