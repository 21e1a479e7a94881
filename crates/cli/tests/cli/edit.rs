//! `edit`: starts the editor that is installed beside the program.

use std::process::{Command, Output};

use crate::folder::{Folder, PROGRAM};

/// Runs a copy of the program that is alone in a folder, so that no editor is beside it.
fn edit(folder: &Folder, arguments: &[&str]) -> Output {
    let copy = folder.path("bin/meshwright");
    std::fs::create_dir_all(copy.parent().unwrap()).unwrap();
    std::fs::copy(PROGRAM, &copy).unwrap();
    let mut command = Command::new(copy);
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

#[cfg(unix)]
#[test]
fn the_editor_gets_the_file_and_its_exit_code_counts() {
    use std::os::unix::fs::PermissionsExt;
    let folder = Folder::new().with("a.obj", "").with(
        "bin/meshwright-viewer",
        "#!/bin/sh\necho opens \"$@\"\nexit 1\n",
    );
    let editor = folder.path("bin/meshwright-viewer");
    std::fs::set_permissions(editor, std::fs::Permissions::from_mode(0o755)).unwrap();

    let ended = edit(&folder, &["a.obj"]);
    assert_eq!(String::from_utf8(ended.stdout).unwrap(), "opens a.obj\n");
    assert_eq!(ended.status.code(), Some(1));

    let ended = edit(&folder, &["missing.obj"]);
    let message = String::from_utf8(ended.stderr).unwrap();
    assert!(message.contains("cannot read missing.obj"), "{message}");
}
