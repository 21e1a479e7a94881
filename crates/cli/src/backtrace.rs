//! Backtraces of panics, printed by the program.
//!
//! With `RUST_BACKTRACE=1` the standard library also prints a backtrace if memory runs out. Printing takes a lock and
//! needs memory, so a second failed allocation would wait for this lock forever. The variable can only be changed for a
//! new process, so the program starts itself again with `RUST_BACKTRACE=0`, and prints backtraces of panics in a hook.

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

    /// The environment variable that marks the restarted process.
    const RESTARTED: &str = "MESHWRIGHT_BACKTRACE";

    if env::var_os(RESTARTED).is_some() {
        let print_message = std::panic::take_hook();
        std::panic::set_hook(Box::new(move |panic| {
            print_message(panic);
            crate::output::print_error(&format!("{}\n", Backtrace::force_capture()));
        }));
    } else if env::var_os("RUST_BACKTRACE").is_some_and(|value| value != "0")
        && let Ok(program) = env::current_exe()
    {
        let mut arguments = env::args_os();
        let mut restart = Command::new(program);
        if let Some(name) = arguments.next() {
            restart.arg0(name);
        }
        // Returns only if the restart fails; then this process continues.
        let _ = restart
            .args(arguments)
            .env("RUST_BACKTRACE", "0")
            .env(RESTARTED, "1")
            .exec();
    }
}
