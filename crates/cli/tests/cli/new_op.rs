//! `new-op` writes operations that can be built, tested and drawn as they are.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::folder::Folder;

fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Copies files and folders with their times, so that cargo reuses earlier builds.
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

/// A copy of the workspace in a temporary folder.
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
    // Without optimization the build is faster.
    let manifest = String::from_utf8(folder.read("Cargo.toml")).unwrap();
    let (members, _) = manifest.split_once("[profile.").unwrap();
    fs::write(folder.path("Cargo.toml"), members).unwrap();
    folder
}

/// The smallest folder that `new-op` accepts as a workspace.
fn small_workspace() -> Folder {
    Folder::new()
        .with("ops/all/src/lib.rs", "")
        .with("ops/faces/src/lib.rs", GROUP)
}

const GROUP: &str = "mod poke_faces;

use op::Registry;

pub use poke_faces::PokeFaces;

pub fn register(registry: Registry) -> Registry {
    registry
        .with::<PokeFaces>()
}
";

/// Runs cargo in a folder, with a target folder that all tests share.
#[track_caller]
fn cargo(folder: &Path, arguments: &str) {
    let output = Command::new(env!("CARGO"))
        .args(arguments.split(' '))
        .current_dir(folder)
        .env("CARGO_TARGET_DIR", target())
        .env("CARGO_PROFILE_DEV_DEBUG", "false")
        .env("CARGO_PROFILE_DEV_OPT_LEVEL", "0")
        .output()
        .unwrap();
    let (out, err) = (
        String::from_utf8_lossy(&output.stdout),
        String::from_utf8_lossy(&output.stderr),
    );
    assert!(output.status.success(), "cargo {arguments}\n{out}{err}");
}

fn target() -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join("new-op")
}

#[test]
#[ignore = "builds the workspace a second time: .ci/run runs it"]
fn a_new_operation_in_a_group_works_without_changes() {
    let folder = workspace();
    folder
        .run("new-op --in tags InflateFaces")
        .with_code(0)
        .prints(&[
            "wrote ./ops/tags/src/inflate_faces.rs\n",
            "wrote ./ops/all/pictures/inflate_faces.ron\n",
            "changed ./ops/tags/src/lib.rs\n",
            "next: cargo test -p meshwright-ops-tags\n",
        ]);
    let list = String::from_utf8(folder.read("ops/tags/src/lib.rs")).unwrap();
    for line in [
        "mod inflate_faces;\n",
        "pub use inflate_faces::InflateFaces;\n",
        "        .with::<InflateFaces>()\n",
    ] {
        assert_eq!(list.matches(line).count(), 1, "{line}{list}");
    }
    let root = folder.path(".");
    cargo(&root, "test --offline -p meshwright-ops-tags inflate_faces");
    cargo(&root, "fmt --check -p meshwright-ops-tags");
    cargo(
        &root,
        "clippy --offline -p meshwright-ops-tags --all-targets -- -D warnings",
    );
}

#[test]
#[ignore = "builds the workspace a second time: .ci/run runs it"]
fn a_new_crate_is_a_program_with_its_operation() {
    let folder = Folder::new();
    let root = repository();
    folder
        .run_all(&[
            "new-op",
            "InflateFaces",
            "--meshwright",
            root.to_str().unwrap(),
        ])
        .with_code(0)
        .prints(&[
            "wrote ./inflate_faces/Cargo.toml\n",
            "wrote ./inflate_faces/picture.ron\n",
            "next: cd ./inflate_faces && cargo test && cargo run -- run picture.ron\n",
        ]);
    let krate = folder.path("inflate_faces");
    // The new crate gets the lock file of the workspace. It then uses the same versions of all dependencies, so that
    // none of them has to be downloaded.
    fs::copy(root.join("Cargo.lock"), krate.join("Cargo.lock")).unwrap();
    cargo(&krate, "test --offline --quiet");
    cargo(&krate, "build --offline --quiet");
    cargo(&krate, "fmt --check");

    let program = target()
        .join("debug")
        .join(format!("inflate-faces{}", std::env::consts::EXE_SUFFIX));
    let run = |arguments: &str| {
        let output = Command::new(&program)
            .args(arguments.split(' '))
            .current_dir(&krate)
            .output()
            .unwrap();
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        assert!(
            output.status.success(),
            "{arguments}: {text}{}",
            String::from_utf8_lossy(&output.stderr)
        );
        text
    };
    let done = run("run picture.ron --no-cache --out out");
    assert!(done.contains("expectations met"), "{done}");
    for picture in ["before.png", "after.png"] {
        assert!(krate.join("out").join(picture).is_file(), "{picture}");
    }
    // The help, the schema and the example are generated from the source of the new operation.
    let help = run("ops InflateFaces");
    assert!(
        help.contains("The distance along each axis, in scene units"),
        "{help}"
    );
    assert!(
        help.contains("Example: InflateFaces(vertices: Boundary, offset: (0, 0, 0.5))\n"),
        "{help}"
    );
    assert!(run("schema").contains("\"InflateFaces\""));
}

#[test]
fn an_operation_is_added_to_the_lists_of_its_group() {
    let folder = small_workspace();
    for name in ["BendMore", "Wobble"] {
        folder
            .run_all(&["new-op", "--in", "faces", name])
            .with_code(0);
    }
    let list = String::from_utf8(folder.read("ops/faces/src/lib.rs")).unwrap();
    assert!(
        list.starts_with("mod bend_more;\nmod poke_faces;\nmod wobble;\n\n"),
        "{list}"
    );
    assert!(list.contains(
        "pub use bend_more::BendMore;\npub use poke_faces::PokeFaces;\npub use wobble::Wobble;\n"
    ));
    assert!(list.ends_with(
        "        .with::<PokeFaces>()\n        .with::<BendMore>()\n        .with::<Wobble>()\n}\n"
    ));
}

/// Returns the path and the bytes of each file in a folder and its subfolders, sorted by path.
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
fn a_second_operation_with_the_same_name_is_refused_and_changes_no_files() {
    let folder = small_workspace();
    for (arguments, path) in [
        (
            "new-op InflateFaces --in faces",
            "./ops/faces/src/inflate_faces.rs",
        ),
        ("new-op InflateFaces", "./inflate_faces"),
    ] {
        folder.run(arguments).with_code(0);
        let before = content(&folder.path("."));
        let again = folder.run(arguments).with_code(1);
        assert_eq!(again.stderr, format!("error: {path} already exists\n"));
        assert_eq!(content(&folder.path(".")), before);
    }
    // An operation with the same name is also refused in another group, because both operations would have the same
    // recipe for their pictures.
    let folder = folder.with("ops/edges/src/lib.rs", GROUP);
    folder
        .run("new-op InflateFaces --in edges")
        .with_code(1)
        .complains(&["error: ./ops/all/pictures/inflate_faces.ron already exists\n"]);
}

#[test]
fn the_name_of_an_operation_of_the_program_is_refused() {
    let folder = small_workspace();
    let before = content(&folder.path("."));
    for arguments in ["new-op PokeFaces", "new-op PokeFaces --in faces"] {
        folder.run(arguments).with_code(1).complains(&[
            "error: an operation is already named `PokeFaces`: choose another name\n",
        ]);
    }
    assert_eq!(content(&folder.path(".")), before);
}

#[test]
fn invalid_names_are_refused_and_change_no_files() {
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
    for (name, module) in [
        ("Lib", "lib"),
        ("Loop", "loop"),
        ("Mesh", "mesh"),
        ("Std", "std"),
    ] {
        let message = format!(
            "error: the name `{name}` cannot be used: its module `{module}` would have the name of a keyword"
        );
        folder
            .run_all(&["new-op", name])
            .with_code(1)
            .complains(&[&message]);
    }
    folder
        .run("new-op Report")
        .with_code(1)
        .complains(&["error: the name `Report` cannot be used: the generated source uses"]);
    assert_eq!(content(&folder.path(".")), before);
}

#[test]
fn a_folder_that_is_not_a_workspace_is_refused() {
    let folder = Folder::new();
    let message = ". is not the root of a Meshwright workspace: it has no folder ops/all";
    folder
        .run("new-op Wobble --in faces --dir .")
        .with_code(1)
        .complains(&[&format!("error: {message}\n")]);
    folder.run("new-op Wobble").with_code(1).complains(&[
        "set the root of the Meshwright workspace with `--meshwright`",
        message,
    ]);
    assert!(folder.entries(".").is_empty());
    small_workspace()
        .run("new-op Wobble --in hair")
        .with_code(1)
        .complains(&["error: the group `hair` does not exist; groups: "]);
}
