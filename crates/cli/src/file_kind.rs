//! Checks that a file is of the kind that a command expects. If the file is of another kind, the error names the
//! commands that accept the file.

use std::path::Path;

use mesh_io::Format;
use ron_tree::ValueKind;
use store::{Disk, Store as _};

use crate::args::WrongUsage;
use crate::output::shell_quoted;

/// The kinds of files that commands take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum FileKind {
    Recipe,
    Sweep,
    Mesh,
}

/// The maximum size of a sweep file, in bytes. A larger file is not read, but assumed to be a recipe, because sweep
/// files are short.
const MAX_SWEEP: u64 = 1 << 20;

/// Checks the kind of a file by its extension. Recipes and sweeps share an extension, so they are distinguished by
/// their contents. If a recipe or a sweep is expected, a file with an unknown extension must begin like a RON file. If
/// the file does not exist or its kind cannot be determined, this check succeeds. The command then reports the error
/// when it reads the file.
///
/// # Errors
///
/// Returns [`WrongUsage`] if the path is a folder, or if the file is not of the expected kind. If the kind of the file
/// is known, the error message names the commands that accept the file.
pub(crate) fn expect_kind(path: &Path, expected: FileKind) -> anyhow::Result<()> {
    let shown = path.display();
    if path.is_dir() {
        let message = format!("{shown} is a folder, expected {}", expected.describe());
        return Err(WrongUsage(message).into());
    }
    match FileKind::of(path) {
        Some(kind) if kind != expected => {
            let name = shell_quoted(&shown.to_string()).into_owned();
            let (kind, expected, help) = (kind.describe(), expected.describe(), kind.help(&name));
            let message = format!("{shown} is {kind}, expected {expected}: {help}");
            Err(WrongUsage(message).into())
        }
        None if expected != FileKind::Mesh && !can_be_ron(path) => {
            let expected = expected.describe();
            let message =
                format!("{shown} is not {expected}: expected a .ron file, which begins with `(`");
            Err(WrongUsage(message).into())
        }
        _ => Ok(()),
    }
}

/// Whether a file can be a recipe or a sweep. Returns `true` if the name of the file ends in `.ron`, or if the file is
/// empty or begins with a parenthesis, a comment or an attribute. If the file cannot be read, also returns `true`.
fn can_be_ron(path: &Path) -> bool {
    const MAX_START: u64 = 4096;
    if path.extension().is_some_and(|ending| ending == "ron") {
        return true;
    }
    let Ok(start) = Disk.read_up_to(path, MAX_START) else {
        return true;
    };
    let start = start.trim_ascii_start();
    let openings = ["(", "//", "/*", "#!"];
    start.is_empty()
        || openings
            .iter()
            .any(|opening| start.starts_with(opening.as_bytes()))
}

impl FileKind {
    /// Returns the kind of an existing file, or `None` if the kind cannot be determined.
    fn of(path: &Path) -> Option<Self> {
        let size = path
            .metadata()
            .ok()
            .filter(std::fs::Metadata::is_file)?
            .len();
        if Format::from_path(path).is_some_and(Format::can_read) {
            return Some(Self::Mesh);
        }
        if path.extension().is_none_or(|ending| ending != "ron") {
            return None;
        }
        if size > MAX_SWEEP {
            return Some(Self::Recipe);
        }
        let text = std::fs::read_to_string(path).ok()?;
        if is_sweep(&text) {
            Some(Self::Sweep)
        } else {
            text.contains("steps").then_some(Self::Recipe)
        }
    }

    fn describe(self) -> &'static str {
        match self {
            Self::Recipe => "a recipe",
            Self::Sweep => "a sweep",
            Self::Mesh => "a mesh file",
        }
    }

    /// Returns a hint for an error message: the commands that accept a file of this kind.
    fn help(self, name: &str) -> String {
        match self {
            Self::Recipe => format!("use `meshwright run {name}` or `meshwright check {name}`"),
            Self::Sweep => format!("use `meshwright sweep {name}`"),
            Self::Mesh => format!(
                "use `meshwright info {name}`, `meshwright picture {name}` or `meshwright convert {name} OUTPUT`; to write a recipe that loads the file, use `meshwright new {name}`"
            ),
        }
    }
}

/// Whether a text has the field `sweep` but not the field `steps`.
fn is_sweep(text: &str) -> bool {
    if !text.contains("sweep") {
        return false;
    }
    let root = ron_tree::parse(text).value;
    let is_struct = matches!(root.kind, ValueKind::Struct(_));
    is_struct && root.field("sweep").is_some() && root.field("steps").is_none()
}
