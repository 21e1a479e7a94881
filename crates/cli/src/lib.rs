//! The program: command line, output and exit codes, for any registry of operations.
//!
//! A program with operations of its own is five lines:
//!
//! ```no_run
//! fn main() -> std::process::ExitCode {
//!     // with::<MyOperation>() for each of one's own
//!     cli::run(ops_all::registry())
//! }
//! ```
//!
//! Exit codes: 0 done, 1 failed, 2 wrong usage.

mod args;
mod cache;
mod capsule;
mod commands;
mod events;
mod listener;
mod loading;
mod many;
mod output;
mod picture_errors;
mod scenes;
mod terminal_picture;

use std::io::{self, Write};
use std::process::ExitCode;

use clap::Parser;
use engine::Engine;
use op::Registry;

use args::{Args, Command, WrongUsage};
use output::{complain, print_json};

/// Runs the program with the operations of `registry` and returns its exit code.
#[expect(
    clippy::needless_pass_by_value,
    reason = "a program hands its registry over"
)]
pub fn run(registry: Registry) -> ExitCode {
    let args = Args::parse();
    if let Err(clash) = registry.check() {
        complain(&format!("error: {clash}\n"));
        return ExitCode::FAILURE;
    }
    let engine = Engine::new(&registry);
    let mut trouble = 1;
    let done = match args.command {
        Command::Run(args) => commands::run::run(&args, &engine),
        Command::Watch(args) => commands::watch::run(&args, &engine),
        Command::Check(args) => commands::check::run(&args, &engine),
        Command::Test(args) => commands::test::run(&args, &engine),
        Command::Batch(args) => commands::batch::run(&args, &engine),
        Command::Sweep(args) => commands::sweep::run(&args, &engine),
        Command::Ops(args) => commands::ops::run(&args, &registry),
        Command::Info(args) => commands::info::run(&args),
        Command::Convert(args) => commands::convert::run(&args),
        Command::Reproduce(args) => commands::reproduce::run(&args, &engine),
        Command::Picture(args) => commands::picture::run(&args, &engine),
        Command::Select(args) => commands::select::run(&args, &engine),
        Command::Diff(args) => {
            // As `diff` has it: 1 says that there is a difference, and nothing else does.
            trouble = 2;
            commands::diff::run(&args, &engine)
        }
        Command::Upgrade(args) => commands::upgrade::run(&args, &registry),
        Command::Cache(args) => commands::cache::run(&args),
        Command::Shrink(args) => commands::shrink::run(&args, &engine),
        Command::Schema => print_json(&recipe::schema(&registry)).map(|()| true),
        Command::NewOp(args) => commands::new_op::run(&args),
    };
    match done.and_then(|succeeded| Ok(io::stdout().flush().map(|()| succeeded)?)) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) if is_broken_pipe(&error) => ExitCode::SUCCESS,
        Err(error) => {
            complain(&format!("error: {error:#}\n"));
            ExitCode::from(if error.is::<WrongUsage>() { 2 } else { trouble })
        }
    }
}

/// Whether the reader of our output went away, as `head` does.
fn is_broken_pipe(error: &anyhow::Error) -> bool {
    error
        .chain()
        .filter_map(|cause| cause.downcast_ref::<io::Error>())
        .any(|cause| cause.kind() == io::ErrorKind::BrokenPipe)
}
