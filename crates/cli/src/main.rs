//! The program `meshwright` with the built-in operations.

use std::backtrace::Backtrace;
use std::env;
use std::io::{self, Write};
use std::panic;
use std::process::ExitCode;

fn main() -> ExitCode {
    print_backtraces_in_a_hook();
    cli::run(ops_all::registry())
}

/// If `RUST_BACKTRACE` requests backtraces, sets a panic hook that prints backtraces, and turns off the backtraces of
/// the standard library.
///
/// The standard library would print a backtrace even when memory runs out. To print a backtrace, the standard library
/// takes a lock and allocates memory. If this allocation also failed, the program would wait for the lock forever.
fn print_backtraces_in_a_hook() {
    const VARIABLE: &str = "RUST_BACKTRACE";

    if env::var_os(VARIABLE).is_none_or(|value| value == "0") {
        return;
    }
    #[expect(
        unsafe_code,
        reason = "no safe function changes the environment, and without the change, a run could wait forever"
    )]
    // SAFETY: `main` has started no threads yet, so no other thread reads the environment.
    unsafe {
        env::set_var(VARIABLE, "0");
    }
    let print_message = panic::take_hook();
    panic::set_hook(Box::new(move |panic| {
        print_message(panic);
        let _ = writeln!(io::stderr(), "{}", Backtrace::force_capture());
    }));
}
