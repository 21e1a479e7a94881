//! A temporary folder to run the program in.

use std::fs;
use std::path::{Path, PathBuf};

use assert_cmd::Command;
use tempfile::TempDir;

/// The program that is tested.
pub(crate) const PROGRAM: &str = env!("CARGO_BIN_EXE_meshwright");

/// A temporary working folder, and a temporary folder for the cache. Both folders are removed after the test.
pub(crate) struct Folder(TempDir, TempDir);

/// The exit code and the output of a program that has ended.
#[derive(Debug)]
pub(crate) struct Ended {
    pub(crate) code: Option<i32>,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

impl Folder {
    pub(crate) fn new() -> Self {
        Self(tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap())
    }

    /// A folder with one recipe, `recipe.ron`.
    pub(crate) fn with_recipe(text: &str) -> Self {
        Self::new().with("recipe.ron", text)
    }

    /// Adds a file.
    pub(crate) fn with(self, path: &str, content: impl AsRef<[u8]>) -> Self {
        let path = self.path(path);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, content).unwrap();
        self
    }

    pub(crate) fn path(&self, path: &str) -> PathBuf {
        self.0.path().join(path)
    }

    pub(crate) fn read(&self, path: &str) -> Vec<u8> {
        fs::read(self.path(path)).unwrap()
    }

    /// The sorted names of all entries of a folder, including hidden files. The result is empty if the folder does
    /// not exist.
    pub(crate) fn entries(&self, path: &str) -> Vec<String> {
        names(&self.path(path))
    }

    /// Runs the program with these arguments, separated by spaces.
    pub(crate) fn run(&self, arguments: &str) -> Ended {
        self.run_all(&arguments.split_whitespace().collect::<Vec<_>>())
    }

    pub(crate) fn run_all(&self, arguments: &[&str]) -> Ended {
        self.command(PROGRAM, arguments, b"")
    }

    /// Runs the program with these arguments, separated by spaces, and passes `input` to its standard input.
    pub(crate) fn run_with(&self, arguments: &str, input: impl AsRef<[u8]>) -> Ended {
        let arguments: Vec<&str> = arguments.split_whitespace().collect();
        self.command(PROGRAM, &arguments, input.as_ref())
    }

    /// Runs shell commands. In the commands, `"$0"` stands for the path of the program.
    #[cfg(unix)]
    pub(crate) fn shell(&self, commands: &str) -> Ended {
        self.command("sh", &["-c", commands, PROGRAM], b"")
    }

    fn command(&self, program: &str, arguments: &[&str], input: &[u8]) -> Ended {
        let output = Command::new(program)
            .args(arguments)
            .current_dir(self.0.path())
            .env("MESHWRIGHT_CACHE", self.1.path())
            .write_stdin(input)
            .output()
            .unwrap();
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
        Ended {
            code: output.status.code(),
            stdout: text(output.stdout),
            stderr: text(output.stderr),
        }
    }
}

pub(crate) fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder)
        .into_iter()
        .flatten()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

impl Ended {
    /// Checks the exit code.
    #[track_caller]
    pub(crate) fn with_code(self, code: i32) -> Self {
        assert_eq!(self.code, Some(code), "{self:#?}");
        self
    }

    /// Checks that standard output contains these strings in this order.
    #[track_caller]
    pub(crate) fn prints(self, texts: &[&str]) -> Self {
        assert_contains(&self.stdout, texts);
        self
    }

    /// Checks that standard error contains these strings in this order.
    #[track_caller]
    pub(crate) fn complains(self, texts: &[&str]) -> Self {
        assert_contains(&self.stderr, texts);
        self
    }

    #[track_caller]
    pub(crate) fn json(&self) -> serde_json::Value {
        serde_json::from_str(&self.stdout).unwrap_or_else(|error| panic!("{error}: {self:#?}"))
    }

    /// The lines of standard output, each parsed as JSON.
    #[track_caller]
    pub(crate) fn events(&self) -> Vec<serde_json::Value> {
        let event = |line| serde_json::from_str(line).unwrap_or_else(|e| panic!("{e}: {self:#?}"));
        self.stdout.lines().map(event).collect()
    }

    /// Returns the digest that `meshwright run` has printed.
    #[track_caller]
    pub(crate) fn digest(&self) -> &str {
        let line = self.stdout.lines().find_map(|l| l.strip_prefix("digest "));
        line.unwrap_or_else(|| panic!("no digest: {self:#?}"))
    }
}

#[track_caller]
fn assert_contains(text: &str, expected: &[&str]) {
    let mut rest = text;
    for part in expected {
        let Some(at) = rest.find(part) else {
            panic!("expected `{part}` in this order in:\n{text}");
        };
        rest = &rest[at + part.len()..];
    }
}
