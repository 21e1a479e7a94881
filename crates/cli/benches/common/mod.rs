//! Helpers for the benchmarks of the program.

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Runs the program, which must succeed.
pub(crate) fn run(folder: &Path, arguments: &[&str]) {
    let status = Command::new(env!("CARGO_BIN_EXE_meshwright"))
        .args(arguments)
        .current_dir(folder)
        .stdout(Stdio::null())
        .status();
    assert!(status.is_ok_and(|status| status.success()), "{arguments:?}");
}

/// Prints the median time of the runs of `work`. Before each run, `prepare` is called. The time that `prepare` takes is
/// not measured.
#[expect(clippy::print_stdout, reason = "a benchmark prints its figures")]
pub(crate) fn measure(name: &str, runs: usize, prepare: impl Fn(), work: impl Fn()) {
    let mut times: Vec<Duration> = (0..runs)
        .map(|_| {
            prepare();
            let begin = Instant::now();
            work();
            begin.elapsed()
        })
        .collect();
    times.sort_unstable();
    println!("{name}: {:.1} ms", times[runs / 2].as_secs_f64() * 1e3);
}
