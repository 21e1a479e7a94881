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
use output::complain;

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
        Command::Ops {
            name,
            markdown,
            pictures,
        } => commands::ops::run(name.as_deref(), markdown, pictures.as_deref(), &registry),
        Command::Info {
            file,
            picture,
            picture_errors,
            read,
            format,
        } => commands::info::run(&file, picture, &picture_errors, &read, format),
        Command::Convert {
            input,
            read,
            output,
        } => commands::convert::run(&input, &read, &output),
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
        Command::Schema => commands::schema::run(&registry),
        Command::NewOp {
            name,
            group,
            dir,
            meshwright,
        } => commands::new_op::run(&name, group.as_deref(), &dir, &meshwright),
    };
    match done.and_then(|succeeded| flushed().map(|()| succeeded)) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) if is_broken_pipe(&error) => ExitCode::SUCCESS,
        Err(error) => {
            complain(&format!("error: {error:#}\n"));
            ExitCode::from(if error.is::<WrongUsage>() { 2 } else { trouble })
        }
    }
}

fn flushed() -> anyhow::Result<()> {
    Ok(io::stdout().flush()?)
}

/// Whether the reader of our output went away, as `head` does.
fn is_broken_pipe(error: &anyhow::Error) -> bool {
    error
        .chain()
        .filter_map(|cause| cause.downcast_ref::<io::Error>())
        .any(|cause| cause.kind() == io::ErrorKind::BrokenPipe)
}
