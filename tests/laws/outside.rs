//! A program with an operation of its own, built outside of the workspace as a third party would.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// Builds `tests/outside` and returns its program.
fn program() -> PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("outside");
    // The same versions as in the workspace, so that nothing has to be fetched.
    std::fs::copy(crate::root().join("Cargo.lock"), folder.join("Cargo.lock"))
        .expect("the lock of the workspace can be copied");
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).join("outside");
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let built = Command::new(cargo)
        .args(["build", "--offline", "--quiet"])
        .current_dir(&folder)
        .env("CARGO_TARGET_DIR", &target)
        .output()
        .expect("cargo starts");
    assert!(built.status.success(), "{}", text(&built));
    let name = format!("outside{}", std::env::consts::EXE_SUFFIX);
    target.join("debug").join(name)
}

fn text(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr)
}

#[test]
fn a_program_of_five_lines_has_an_operation_of_its_own() {
    let program = program();
    let recipe = Path::new(env!("CARGO_MANIFEST_DIR")).join("outside/lift.ron");
    let out = tempfile::tempdir().expect("a temporary folder");

    let run = Command::new(&program)
        .arg("run")
        .arg(&recipe)
        .arg("--out")
        .arg(out.path())
        .output()
        .expect("the program starts");
    assert!(run.status.success(), "{}", text(&run));
    assert!(text(&run).contains("expectations hold"), "{}", text(&run));
    let path = out.path().join("lifted.obj");
    let lifted = mesh_io::read(&store::Disk, &path, &mesh_io::ReadOptions::default())
        .expect("it was written");
    let mesh = lifted.objects[0].as_mesh().expect("a mesh");
    let heights: Vec<f64> = mesh.positions().iter().map(|p| p.z).collect();
    assert_eq!(heights, [2.5; 6]);

    // Help and schema come from the same definition.
    let help = Command::new(&program)
        .args(["ops", "Lift"])
        .output()
        .expect("it starts");
    assert!(
        text(&help).contains("How far, in scene units"),
        "{}",
        text(&help)
    );
    let schema = Command::new(&program)
        .arg("schema")
        .output()
        .expect("it starts");
    assert!(text(&schema).contains("\"Lift\""));
}
