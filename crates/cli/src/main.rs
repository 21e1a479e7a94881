//! The program `meshwright` with the built-in operations.

use std::process::ExitCode;

fn main() -> ExitCode {
    cli::run(ops_all::registry())
}
