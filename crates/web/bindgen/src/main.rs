//! Writes the JavaScript and the types for a WebAssembly file: `meshwright-bindgen FILE.wasm FOLDER`.

use std::env::args_os;

use anyhow::{Context, Result};
use wasm_bindgen_cli_support::Bindgen;

fn main() -> Result<()> {
    let mut arguments = args_os().skip(1);
    let wasm = arguments.next().context("expected a WebAssembly file")?;
    let folder = arguments.next().context("expected a folder")?;
    Bindgen::new()
        .input_path(wasm)
        .web(true)?
        .typescript(true)
        .remove_name_section(true)
        .remove_producers_section(true)
        .out_name("core")
        .generate(folder)
}
