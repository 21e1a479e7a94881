//! Exit codes of the command line.

use crate::folder::Folder;

#[test]
fn wrong_usage_is_exit_code_2_and_writes_no_files() {
    let folder =
        Folder::with_recipe("(recipe: 1, steps: [Cube(name: \"a\"), Save(path: \"a.obj\")])");
    for (arguments, message) in [
        ("", "meshwright new part"),
        ("runn recipe.ron", "unrecognized subcommand 'runn'"),
        ("run", "<RECIPE>"),
        ("run recipe.ron --fast", "unexpected argument '--fast'"),
        ("run recipe.ron --set levels", "expected NAME=VALUE"),
        ("run recipe.ron --set =2", "expected NAME=VALUE"),
        ("run recipe.ron --threads 0", "0 is not in 1..=1024"),
        ("run recipe.ron --threads many", "invalid value 'many'"),
        (
            "run recipe.ron --budget 8Gig",
            "expected a size such as 512MiB or 8GiB",
        ),
        ("run recipe.ron --format xml", "invalid value 'xml'"),
        ("ops Cube --markdown", "cannot be used with"),
        ("convert a.obj", "<OUTPUT>"),
    ] {
        folder.run(arguments).with_code(2).complains(&[message]);
    }
    assert_eq!(folder.entries("."), ["recipe.ron"]);
}

#[test]
fn help_and_version_are_exit_code_0() {
    let folder = Folder::new();
    let commands = [
        "run",
        "check",
        "watch",
        "test",
        "info",
        "picture",
        "select",
        "diff",
        "convert",
        "batch",
        "sweep",
        "edit",
        "new",
        "ops",
        "expectations",
        "schema",
        "upgrade",
        "reproduce",
        "shrink",
        "cache",
        "new-op",
        "completions",
        "man",
    ];
    folder.run("--help").with_code(0).prints(&commands);
    for command in commands {
        folder
            .run(&format!("{command} --help"))
            .with_code(0)
            .prints(&[&format!("Usage: meshwright {command}")]);
    }
    let version = format!("meshwright {}\n", env!("CARGO_PKG_VERSION"));
    assert_eq!(folder.run("--version").with_code(0).stdout, version);
}
