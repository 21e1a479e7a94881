//! The program: command line, output and exit codes, for any registry of operations.
//!
//! To write a program that has additional operations, only the function [`run`] is needed:
//!
//! ```no_run
//! fn main() -> std::process::ExitCode {
//!     // Add `.with::<MyOperation>()` for each additional operation.
//!     cli::run(ops_all::registry())
//! }
//! ```
//!
//! The exit code is 0 for success, 1 for failure, 2 for wrong usage, and 130 if Ctrl-C interrupted the command. If
//! Ctrl-C ends `watch`, the exit code is 0. If `diff` cannot compare the files because of an error, its exit code is 2.

mod args;
mod cache;
mod capsule;
mod commands;
mod events;
mod file_kind;
mod junit;
mod listener;
mod loading;
mod many;
mod output;
mod picture_errors;
mod pipes;
mod recording;
mod scenes;
mod terminal_picture;

use std::cell::Cell;
use std::ffi::OsString;
use std::io::{self, Write};
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::path::PathBuf;
use std::process::ExitCode;

use engine::Engine;
use op::Registry;

use args::{Command, ReportedUsage, WrongUsage};
use listener::is_interrupted;
use output::{print_error, print_json};

/// Runs the program with the operations of `registry` and returns its exit code.
#[expect(
    clippy::needless_pass_by_value,
    reason = "the caller has no further use for the registry"
)]
pub fn run(registry: Registry) -> ExitCode {
    let arguments: Vec<OsString> = std::env::args_os().collect();
    ExitCode::from(run_with(&registry, &arguments))
}

/// Returns the recipes that `meshwright test PATHS` runs, where `paths` are the paths of recipes and folders. The
/// result includes recipes that cannot be read. A recipe is left out if it has neither expectations nor a step with the
/// field `refused`. A recipe is also left out if one of the other recipes calls it, unless `paths` names the recipe
/// itself.
///
/// # Errors
///
/// Returns an error if a path does not exist, or if a folder cannot be listed.
pub fn tested_recipes(registry: &Registry, paths: &[PathBuf]) -> Result<Vec<PathBuf>, String> {
    commands::test::tested(paths, &Engine::new(registry)).map_err(|error| format!("{error:#}"))
}

/// Returns the input files that `meshwright batch --inputs PATTERNS` processes. A pattern can also be the path of a
/// file.
///
/// # Errors
///
/// Returns an error if a pattern is invalid, or if no file matches a pattern.
pub fn batch_inputs(patterns: &[String]) -> Result<Vec<String>, String> {
    let inputs = commands::batch::inputs::list(patterns).map_err(|error| format!("{error:#}"))?;
    Ok(inputs.into_iter().map(|input| input.path).collect())
}

/// Runs the program with these arguments and returns its exit code. The first argument is the name of the program. Ends
/// the process if the arguments are invalid or request help.
pub fn run_with(registry: &Registry, arguments: &[OsString]) -> u8 {
    if arguments.len() <= 1 {
        print_error(args::help::FIRST_STEPS);
        return 2;
    }
    let args = args::help::parse(arguments);
    if let Err(clash) = registry.check() {
        print_error(&format!("error: {clash}\n"));
        return 1;
    }
    let engine = Engine::new(registry);
    let code_of_errors = Cell::new(1);
    let run = || match args.command {
        Command::Run(args) => commands::run::run(&args, &engine),
        Command::Watch(args) => commands::watch::run(&args, &engine),
        Command::Check(args) => commands::check::run(&args, &engine),
        Command::Test(args) => commands::test::run(&args, &engine),
        Command::Batch(args) => commands::batch::run(&args, &engine),
        Command::Sweep(args) => commands::sweep::run(&args, &engine),
        Command::Ops(args) => commands::ops::run(&args, registry),
        Command::Info(args) => commands::info::run(&args),
        Command::Convert(args) => commands::convert::run(&args),
        Command::Reproduce(args) => commands::reproduce::run(&args, &engine),
        Command::Picture(args) => commands::picture::run(&args, &engine),
        Command::Select(args) => commands::select::run(&args, &engine),
        Command::Diff(args) => {
            // The exit code 1 of `diff` means that the files differ, as for the Unix program `diff`. Errors therefore
            // need another code.
            code_of_errors.set(2);
            commands::diff::run(&args, &engine)
        }
        Command::Upgrade(args) => commands::upgrade::run(&args, registry),
        Command::Cache(args) => commands::cache::run(&args),
        Command::Shrink(args) => commands::shrink::run(&args, &engine),
        Command::Edit(args) => commands::edit::run(&args),
        Command::Web(args) => commands::web::run(&args),
        Command::New(args) => commands::new::run(&args),
        Command::Expectations { name } => commands::ops::expectations(name.as_deref()),
        Command::Completions { shell } => commands::man::completions(shell),
        Command::Man => commands::man::page(),
        Command::Schema => print_json(&recipe::schema(registry)).map(|()| true),
        Command::NewOp(args) => commands::new_op::run(&args, registry),
    };
    let result = catch_unwind(AssertUnwindSafe(run)).unwrap_or_else(|payload| {
        // If an array does not fit into memory, the code panics with `OutOfMemory`. The program reports this panic as
        // an ordinary error, not as a bug.
        match payload.downcast::<mesh::OutOfMemory>() {
            Ok(missing) => Err(anyhow::Error::new(*missing)),
            Err(payload) => resume_unwind(payload),
        }
    });
    match result.and_then(|succeeded| Ok(io::stdout().flush().map(|()| succeeded)?)) {
        Ok(true) => 0,
        Ok(false) => failure(1),
        Err(error) if is_broken_pipe(&error) => 0,
        Err(error) if error.is::<ReportedUsage>() => failure(2),
        Err(error) if is_interrupted() && is_cancelled(&error) => {
            print_error("interrupted\n");
            failure(1)
        }
        Err(error) => {
            print_error(&format!("error: {error:#}\n"));
            failure(if error.is::<WrongUsage>() {
                2
            } else {
                code_of_errors.get()
            })
        }
    }
}

/// Returns the exit code of a failure: 130 after Ctrl-C, as shells expect, and otherwise `code`.
fn failure(code: u8) -> u8 {
    if is_interrupted() { 130 } else { code }
}

/// Whether the error occurred because a computation was canceled.
fn is_cancelled(error: &anyhow::Error) -> bool {
    error.chain().any(|cause| {
        matches!(cause.downcast_ref(), Some(op::OpError::Cancelled))
            || matches!(cause.downcast_ref(), Some(render::PictureError::Cancelled))
            || cause.is::<op::Cancelled>()
    })
}

/// Whether the error is a broken pipe: the program that reads the output, such as `head`, has closed the pipe.
fn is_broken_pipe(error: &anyhow::Error) -> bool {
    error
        .chain()
        .filter_map(|cause| cause.downcast_ref::<io::Error>())
        .any(|cause| cause.kind() == io::ErrorKind::BrokenPipe)
}
