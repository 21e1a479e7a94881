//! `meshwright watch`: runs the program, saves files and waits for its output.

use std::io::{BufRead as _, BufReader};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

use crate::folder::{Folder, PROGRAM};

/// The time to wait for output. It is long enough for any machine. Only a failing test waits this long.
const TIMEOUT: Duration = Duration::from_secs(120);

struct Watching {
    child: Child,
    lines: Receiver<String>,
}

impl Watching {
    fn start(folder: &Folder, arguments: &[&str]) -> Self {
        let mut child = Command::new(PROGRAM)
            .args(["watch", "--cache", "cache"])
            .args(arguments)
            .current_dir(folder.path("."))
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let (sender, lines) = channel();
        let (stdout, stderr) = (child.stdout.take().unwrap(), child.stderr.take().unwrap());
        let other = sender.clone();
        std::thread::spawn(move || {
            let lines = BufReader::new(stdout).lines().map_while(Result::ok);
            lines.for_each(|line| drop(sender.send(line)));
        });
        std::thread::spawn(move || {
            let lines = BufReader::new(stderr).lines().map_while(Result::ok);
            lines.for_each(|line| drop(other.send(line)));
        });
        Self { child, lines }
    }

    /// Waits for a line with this text. Returns the lines that were printed since the last call, and the line with the
    /// text as the last.
    #[track_caller]
    fn wait_for(&self, text: &str) -> Vec<String> {
        let mut lines = Vec::new();
        loop {
            let Ok(line) = self.lines.recv_timeout(TIMEOUT) else {
                panic!("expected {text:?} after {lines:#?}")
            };
            let is_match = line.contains(text);
            lines.push(line);
            if is_match {
                return lines;
            }
        }
    }
}

impl Drop for Watching {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

const RECIPE: &str = r#"(recipe: 1, params: {"levels": Int(default: 1)}, steps: [
    Load(path: "a.obj"), LoopSubdivide(levels: arg("levels")), Save(path: "b.obj"),
])"#;

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

#[test]
fn a_saved_recipe_and_a_saved_input_run_again() {
    let folder = Folder::with_recipe(RECIPE).with("a.obj", TRIANGLE);
    let watching = Watching::start(&folder, &["recipe.ron", "--set", "levels=2", "--out", "."]);
    watching.wait_for("wrote ./b.obj");
    watching.wait_for("watching one folder");

    // The second run uses the same parameter values as the first run, and takes the results of unchanged steps from the
    // cache.
    let folder = folder.with("recipe.ron", RECIPE.replace("b.obj", "c.obj"));
    watching.wait_for("recipe.ron changed");
    let table = watching.wait_for("wrote ./c.obj");
    let cached = table.iter().filter(|line| line.contains("cached")).count();
    assert_eq!(cached, 2, "{table:#?}");
    watching.wait_for("watching");

    // An error in the recipe is reported, and the recipe runs again after the error is fixed.
    let folder = folder.with(
        "recipe.ron",
        RECIPE.replace("LoopSubdivide", "LoopSubdivde"),
    );
    watching.wait_for("did you mean `LoopSubdivide`?");
    let folder = folder.with("recipe.ron", RECIPE);
    watching.wait_for("wrote ./b.obj");
    watching.wait_for("watching");

    let _folder = folder.with("a.obj", TRIANGLE.replace("v 1", "v 2"));
    watching.wait_for("a.obj changed");
    let table = watching.wait_for("wrote ./b.obj");
    assert!(
        !table.iter().any(|line| line.contains("cached")),
        "{table:#?}"
    );
}

#[test]
fn only_files_that_the_recipe_reads_start_a_run() {
    let with_material = format!("mtllib a.mtl\n{TRIANGLE}");
    let folder = Folder::with_recipe(RECIPE)
        .with("a.obj", &with_material)
        .with("a.mtl", "newmtl red\nKd 1 0 0\n");
    let arguments = ["recipe.ron", "--set", "levels=1", "--out", "."];
    for is_cached in [false, true] {
        let watching = Watching::start(&folder, &arguments);
        watching.wait_for("watching one folder");
        // A change of an output, or of a file that the recipe does not read, starts no run.
        std::fs::write(folder.path("notes.txt"), "1").unwrap();
        std::fs::write(folder.path("b.obj"), TRIANGLE).unwrap();
        std::fs::write(folder.path("b.mtl"), "newmtl blue\n").unwrap();
        std::thread::sleep(Duration::from_millis(300));
        let kd = if is_cached { "0 1 0" } else { "0 0 1" };
        std::fs::write(folder.path("a.mtl"), format!("newmtl red\nKd {kd}\n")).unwrap();
        let lines = watching.wait_for(" changed");
        assert!(
            lines.last().unwrap().contains("a.mtl changed"),
            "{lines:#?}"
        );
        watching.wait_for("watching");
    }
}

#[cfg(unix)]
#[test]
fn ctrl_c_ends_the_program_with_success() {
    // Ctrl-C is pressed between runs, and during a long run.
    for (levels, text) in [(1, "watching one folder"), (11, "")] {
        let folder = Folder::with_recipe(RECIPE).with("a.obj", TRIANGLE);
        let levels = format!("levels={levels}");
        let arguments = [
            "recipe.ron",
            "--no-expect",
            "--set",
            &levels,
            "--out",
            "out",
        ];
        let mut watching = Watching::start(&folder, &arguments);
        if text.is_empty() {
            // The temporary folder for outputs is created when the run starts.
            while crate::folder::names(&folder.path("out")).is_empty() {
                std::thread::sleep(Duration::from_millis(5));
            }
        } else {
            watching.wait_for(text);
        }
        let id = watching.child.id().to_string();
        let kill = Command::new("kill").args(["-INT", &id]).status();
        assert!(kill.unwrap().success());
        let status = watching.child.wait().unwrap();
        assert_eq!(status.code(), Some(0), "{levels}");
        let rest: Vec<String> = watching.lines.iter().collect();
        assert_eq!(rest, [""; 0], "{levels}");
        let out = crate::folder::names(&folder.path("out"));
        let expected: &[&str] = if text.is_empty() { &[] } else { &["b.obj"] };
        assert_eq!(out, expected);
    }
}
