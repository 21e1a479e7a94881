//! The program `meshwright-viewer`: the window of the editor, with the built-in operations.

use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    viewer::run(ops_all::registry(), &arguments)
}
