//! The help of the program: commands grouped by purpose, each with an example.

use std::ffi::OsString;

use std::fmt::Write;

use clap::{Arg, Command, CommandFactory, FromArgMatches};

use super::Args;

/// Groups of commands: the title, and each command with an example.
const GROUPS: [(&str, &[(&str, &str)]); 4] = [
    (
        "Run and check",
        &[
            ("run", "run part.ron --set levels=3"),
            ("check", "check part.ron"),
            ("watch", "watch part.ron"),
            ("test", "test scenes"),
        ],
    ),
    (
        "Inspect and compare",
        &[
            ("info", "info model.obj"),
            ("picture", "picture model.obj --wireframe"),
            ("select", "select model.obj 'Sharp(above: 30)'"),
            ("diff", "diff a.obj b.glb"),
        ],
    ),
    (
        "Many files and values",
        &[
            ("convert", "convert scan.obj scan.glb"),
            ("batch", "batch clean.ron --inputs 'scans/*.obj'"),
            ("sweep", "sweep levels.sweep.ron"),
        ],
    ),
    (
        "Write and maintain recipes",
        &[
            ("edit", "edit part.ron"),
            ("web", "web target/web/page"),
            ("new", "new part"),
            ("ops", "ops BevelEdges"),
            ("expectations", "expectations Area"),
            ("schema", "schema"),
            ("upgrade", "upgrade scenes/*.ron"),
            ("reproduce", "reproduce out/part.glb"),
            ("shrink", "shrink part.ron"),
            ("cache", "cache clear"),
            ("new-op", "new-op InflateFaces"),
            ("completions", "completions bash"),
            ("man", "man > meshwright.1"),
        ],
    ),
];

/// The text that is printed when the program is started without arguments.
pub(crate) const FIRST_STEPS: &str = "\
Meshwright edits 3D meshes with recipes. Three commands to start with:

  meshwright new part             write a small recipe, part.ron
  meshwright run part.ron         run it; its files are written to the folder out
  meshwright info out/part.glb    show what a file contains

`meshwright --help` lists all commands.
";

/// Returns the definition of the command line, with the commands in groups.
pub(crate) fn command() -> Command {
    let command = Args::command();
    let mut template = "{about}\n\n{usage-heading} {usage}\n".to_owned();
    for (title, commands) in GROUPS {
        // Writing to a string cannot fail, so the result is ignored.
        let _ = write!(template, "\n{title}:\n");
        for (name, example) in commands {
            let about = command.find_subcommand(name).and_then(Command::get_about);
            let about = about.map(ToString::to_string).unwrap_or_default();
            let _ = write!(
                template,
                "  {name:<13} {about}\n{:16}meshwright {example}\n",
                ""
            );
        }
    }
    template += "\nOptions:\n{options}\n\n`meshwright COMMAND --help` describes a command and its options.\n";
    // Values that are names can be written in lower or upper case.
    command
        .help_template(template)
        .mut_subcommands(|command| command.mut_args(in_any_case))
}

/// Changes an argument so that its values can be written in lower or upper case.
fn in_any_case(argument: Arg) -> Arg {
    let takes_values = argument.get_action().takes_values();
    argument.ignore_case(takes_values)
}

/// Parses the command line. If the command line is invalid, prints a message and exits.
pub(crate) fn parse(arguments: &[OsString]) -> Args {
    let matches = command().get_matches_from(arguments);
    Args::from_arg_matches(&matches).unwrap_or_else(|error| error.exit())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_command_is_in_a_group_with_an_example() {
        let named: Vec<&str> = GROUPS
            .iter()
            .flat_map(|(_, c)| c.iter().map(|(name, _)| *name))
            .collect();
        for command in Args::command().get_subcommands() {
            assert!(
                named.contains(&command.get_name()),
                "{}",
                command.get_name()
            );
        }
        for (name, example) in GROUPS.iter().flat_map(|(_, commands)| commands.iter()) {
            assert!(Args::command().find_subcommand(name).is_some(), "{name}");
            assert!(example.starts_with(name), "{example}");
        }
    }
}
