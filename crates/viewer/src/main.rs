//! The program `meshwright-viewer`: the window of the editor.

use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    viewer::run(&arguments)
}
