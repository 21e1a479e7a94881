//! Backtraces of panics, printed by the program.
//!
//! With `RUST_BACKTRACE=1`, the standard library also prints a backtrace if an allocation fails. To do this, it takes a
//! lock and allocates memory. If this second allocation fails too, the program waits for the lock forever. A program
//! can safely change the variable only for another process. This program therefore starts itself again with backtraces
//! of the standard library switched off, and prints the backtraces of panics in a hook.

/// Makes panics print backtraces if `RUST_BACKTRACE` asks for them.
#[cfg(not(unix))]
pub(crate) fn print_by_hook() {}

/// Makes panics print backtraces if `RUST_BACKTRACE` asks for them. Replaces the process in that case.
#[cfg(unix)]
pub(crate) fn print_by_hook() {
    use std::backtrace::Backtrace;
    use std::env;
    use std::os::unix::process::CommandExt;
    use std::process::Command;

    /// The variable that is set for the second start.
    const BY_HOOK: &str = "MESHWRIGHT_BACKTRACE";

    if env::var_os(BY_HOOK).is_some() {
        let print_message = std::panic::take_hook();
        std::panic::set_hook(Box::new(move |panic| {
            print_message(panic);
            crate::output::print_error(&format!("{}\n", Backtrace::force_capture()));
        }));
    } else if env::var_os("RUST_BACKTRACE").is_some_and(|value| value != "0")
        && let Ok(program) = env::current_exe()
    {
        let mut arguments = env::args_os();
        let mut again = Command::new(program);
        if let Some(name) = arguments.next() {
            again.arg0(name);
        }
        // `exec` returns only if the program cannot be started. In this case, the current process continues.
        let _ = again
            .args(arguments)
            .env("RUST_BACKTRACE", "0")
            .env(BY_HOOK, "1")
            .exec();
    }
}
