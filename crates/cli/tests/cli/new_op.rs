//! `new-op`: the sample that it writes builds and passes its tests.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::folder::Folder;

fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Copies files and folders with their times, so that cargo knows what it has built before.
fn copy(from: &Path, to: &Path) {
    if from.is_dir() {
        fs::create_dir_all(to).unwrap();
        for entry in fs::read_dir(from).unwrap() {
            let name = entry.unwrap().file_name();
            copy(&from.join(&name), &to.join(&name));
        }
    } else {
        fs::copy(from, to).unwrap();
        let modified = fs::metadata(from).unwrap().modified().unwrap();
        let file = fs::File::options().write(true).open(to).unwrap();
        file.set_modified(modified).unwrap();
    }
}

/// The workspace in a folder of its own.
fn workspace() -> Folder {
    let folder = Folder::new();
    for part in [
        "Cargo.toml",
        "Cargo.lock",
        ".clippy.toml",
        ".rustfmt.toml",
        "crates",
        "ops",
        "tests",
        "README.md",
    ] {
        copy(&repository().join(part), &folder.path(part));
    }
    folder
}

/// The least that `new-op` takes for a workspace.
fn small_workspace() -> Folder {
    Folder::new()
        .with(
            "ops/all/Cargo.toml",
            "[dependencies]\nop.workspace = true\n\n[lints]\nworkspace = true\n",
        )
        .with(
            "ops/all/src/lib.rs",
            "pub fn registry() -> Registry {\n    Registry::new()\n}\n",
        )
}

/// Runs cargo in the workspace, with a target folder that stays from test to test.
#[track_caller]
fn cargo(folder: &Folder, arguments: &str) {
    let output = Command::new(env!("CARGO"))
        .args(arguments.split(' '))
        .current_dir(folder.path("."))
        .env(
            "CARGO_TARGET_DIR",
            concat!(env!("CARGO_TARGET_TMPDIR"), "/new-op"),
        )
        .output()
        .unwrap();
    let (out, err) = (
        String::from_utf8_lossy(&output.stdout),
        String::from_utf8_lossy(&output.stderr),
    );
    assert!(output.status.success(), "cargo {arguments}\n{out}{err}");
}

#[test]
fn a_new_operation_works_as_it_is() {
    let folder = workspace();
    folder.run("new-op InflateFaces").with_code(0).prints(&[
        "wrote ./ops/inflate_faces/Cargo.toml and ./ops/inflate_faces/src/lib.rs\n",
        "added InflateFaces to ops/all\n",
        "next: cargo test -p meshwright-op-inflate-faces\n",
    ]);
    let list = String::from_utf8(folder.read("ops/all/src/lib.rs")).unwrap();
    let line = "        .with::<inflate_faces::InflateFaces>()\n";
    assert_eq!(list.matches(line).count(), 1, "{list}");
    let manifest = String::from_utf8(folder.read("ops/all/Cargo.toml")).unwrap();
    let line = "inflate_faces = { package = \"meshwright-op-inflate-faces\", path = \"../inflate_faces\" }\n";
    assert_eq!(manifest.matches(line).count(), 1, "{manifest}");

    cargo(&folder, "test --offline -p meshwright-op-inflate-faces");
    cargo(&folder, "fmt --check -p meshwright-op-inflate-faces");
    cargo(
        &folder,
        "clippy --offline -p meshwright-op-inflate-faces --all-targets -- -D warnings",
    );
    cargo(&folder, "check --offline -p meshwright-ops-all");
}

#[test]
fn the_first_operation_of_a_list_finds_its_place() {
    let folder = small_workspace();
    folder.run("new-op Twist").with_code(0);
    assert_eq!(
        folder.read("ops/all/src/lib.rs"),
        b"pub fn registry() -> Registry {\n    Registry::new()\n        .with::<twist::Twist>()\n}\n"
    );
    folder.run("new-op BendMore").with_code(0);
    let manifest = String::from_utf8(folder.read("ops/all/Cargo.toml")).unwrap();
    let twist = manifest.find("twist = {").unwrap();
    let bend = manifest.find("bend_more = {").unwrap();
    assert!(
        twist < bend && bend < manifest.find("[lints]").unwrap(),
        "{manifest}"
    );
}

/// The path and bytes of every file.
fn content(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(content(&path));
        } else {
            found.push((path.clone(), fs::read(path).unwrap()));
        }
    }
    found.sort();
    found
}

#[test]
fn a_second_operation_of_a_name_is_refused_and_changes_nothing() {
    let folder = small_workspace();
    folder.run("new-op InflateFaces").with_code(0);
    let before = content(&folder.path("."));
    let again = folder.run("new-op InflateFaces").with_code(1);
    assert_eq!(
        again.stderr,
        "error: ./ops/inflate_faces is there already\n"
    );
    assert_eq!(content(&folder.path(".")), before);
    // In the list, but without its folder.
    fs::remove_dir_all(folder.path("ops/inflate_faces")).unwrap();
    let before = content(&folder.path("."));
    folder
        .run("new-op InflateFaces")
        .with_code(1)
        .complains(&["is there already\n"]);
    assert_eq!(content(&folder.path(".")), before);
}

#[test]
fn bad_names_are_refused_and_change_nothing() {
    let folder = small_workspace();
    let before = content(&folder.path("."));
    for name in [
        "inflate",
        "inflate_faces",
        "Inflate-Faces",
        "Inflate Faces",
        "../Evil",
        "",
        "Größe",
        "7Up",
    ] {
        folder
            .run_all(&["new-op", name])
            .with_code(1)
            .complains(&[&format!(
                "error: expected a name in camel case, such as InflateFaces, found `{name}`\n"
            )]);
    }
    for (name, krate) in [
        ("All", "all"),
        ("Loop", "loop"),
        ("Mesh", "mesh"),
        ("Std", "std"),
    ] {
        let message = format!("error: `{name}` would be the crate `{krate}`, which is taken\n");
        folder
            .run_all(&["new-op", name])
            .with_code(1)
            .complains(&[&message]);
    }
    folder
        .run("new-op Report")
        .with_code(1)
        .complains(&["error: the sample uses another `Report`"]);
    assert_eq!(content(&folder.path(".")), before);
}

#[test]
fn another_folder_is_no_workspace() {
    let folder = Folder::new();
    folder
        .run("new-op Twist --dir .")
        .with_code(1)
        .complains(&["error: . is not the root of a Meshwright workspace: there is no ops/all\n"]);
    assert!(folder.entries(".").is_empty());
}
