//! `meshwright edit`: starts the editor, which is a separate program.

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, bail};

use crate::args::EditArgs;

/// The name of the editor's program.
const EDITOR: &str = "meshwright-viewer";

pub(crate) fn run(args: &EditArgs) -> anyhow::Result<bool> {
    let program = std::env::current_exe().context("cannot determine the path of this program")?;
    let editor = beside(&program);
    if !editor.is_file() {
        bail!(
            "the editor is not installed: expected {}\n\
             help: if `cargo install` has installed this program, run `cargo install --path crates/viewer` in the \
             source of Meshwright to install the editor in the same folder",
            editor.display()
        );
    }
    if let Some(file) = args.file.as_deref().filter(|file| !file.exists()) {
        bail!("cannot read {}: the file does not exist", file.display());
    }
    let status = Command::new(&editor).args(&args.file).status();
    let status = status.with_context(|| format!("cannot start {}", editor.display()))?;
    Ok(status.success())
}

/// Returns the path of the editor, which is expected in the folder of the program `meshwright`.
fn beside(program: &Path) -> PathBuf {
    program.with_file_name(format!("{EDITOR}{}", std::env::consts::EXE_SUFFIX))
}
