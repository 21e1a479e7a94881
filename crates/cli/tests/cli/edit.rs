//! `edit`: starts the editor that is installed beside the program.
#![cfg(unix)]

use std::process::{Command, Output};

use crate::folder::{Folder, PROGRAM};

/// Runs shell commands in a folder. The commands create executable files. If this process wrote the files itself,
/// another test could start a process at the same time. That process would inherit the open file, and a file that is
/// open for writing cannot be executed.
fn shell(folder: &Folder, commands: &str, argument: &str) {
    let mut command = Command::new("sh");
    command.args(["-ec", commands, "sh", argument]);
    let ended = command.current_dir(folder.path(".")).status().unwrap();
    assert!(ended.success());
}

/// Runs a copy of the program from a folder with no other files, so that the editor is missing there.
fn edit(folder: &Folder, arguments: &[&str]) -> Output {
    shell(folder, "mkdir -p bin; cp \"$1\" bin/meshwright", PROGRAM);
    let mut command = Command::new(folder.path("bin/meshwright"));
    command
        .arg("edit")
        .args(arguments)
        .current_dir(folder.path("."));
    command.output().unwrap()
}

#[test]
fn without_the_editor_the_message_says_how_to_install_it() {
    let ended = edit(&Folder::new(), &[]);
    let message = String::from_utf8(ended.stderr).unwrap();
    assert_eq!(ended.status.code(), Some(1));
    for part in [
        "the editor is not installed",
        "meshwright-viewer",
        "cargo install --path crates/viewer",
    ] {
        assert!(message.contains(part), "{message}");
    }
}

#[test]
fn the_editor_gets_the_file_and_its_exit_code_counts() {
    let folder = Folder::new().with("a.obj", "");
    let script =
        "mkdir bin; printf '%s' \"$1\" > bin/meshwright-viewer; chmod +x bin/meshwright-viewer";
    shell(&folder, script, "#!/bin/sh\necho opens \"$@\"\nexit 1\n");

    let ended = edit(&folder, &["a.obj"]);
    assert_eq!(String::from_utf8(ended.stdout).unwrap(), "opens a.obj\n");
    assert_eq!(ended.status.code(), Some(1));

    let ended = edit(&folder, &["missing.obj"]);
    let message = String::from_utf8(ended.stderr).unwrap();
    assert!(message.contains("cannot read missing.obj"), "{message}");
}
