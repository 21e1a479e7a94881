//! `meshwright new-op`: writes a working sample operation, either to a group of the workspace or as a separate crate
//! with a program.

use std::fs;
use std::path::{Path, PathBuf, absolute};

use anyhow::{Context as _, bail, ensure};
use op::Registry;

use crate::args::NewOpArgs;
use crate::output::print;

const OPERATION: &str = include_str!("new_op/operation.rs.txt");
const PICTURE: &str = include_str!("new_op/picture.ron.txt");
const MAIN: &str = include_str!("new_op/main.rs.txt");
const MANIFEST: &str = include_str!("new_op/Cargo.toml.txt");

/// Names that the module of a new operation cannot have: keywords, and the names of crates that the generated source
/// uses.
const RESERVED_MODULES: &str = "abstract alloc as async await become box break cli const continue core crate do \
    dyn else enum extern false final fn for gen if impl in let lib loop macro main match mesh mod move mut op \
    ops_all override priv proc_macro pub ref return schemars self serde static std struct super test \
    trait true try type typeof unsafe unsized use virtual where while yield";

/// Names that a new operation cannot have, because the generated source uses types with these names.
const RESERVED_TYPES: &str = "Context DVec3 Deserialize JsonSchema Mesh MeshOperation MeshPlan OpError PlanContext \
    Problem Report Result Select Serialize Vec Vector VertexSelection";

/// A list of files: the path and the content of each file.
type Files = Vec<(PathBuf, String)>;

/// Writes an operation. If a group is given, `dir` is the workspace, and the operation is added to this group.
/// Otherwise, a new crate is written to `dir`. This crate depends on the workspace in the folder `meshwright`.
pub(crate) fn run(args: &NewOpArgs, registry: &Registry) -> anyhow::Result<bool> {
    let (name, snake) = (&args.name, module_name(&args.name)?);
    let fill = |text: &str| text.replace("{Name}", name).replace("{name}", &snake);
    // All contents are prepared before the first file is written, so that an error in the preparation changes no file.
    let (files, next) = match &args.group {
        Some(group) => in_group(group, &snake, &args.dir, fill)?,
        None => in_new_crate(&snake, &args.dir, &args.meshwright, fill)?,
    };
    if let Some(entry) = registry.get(name) {
        let taken = entry.name;
        let help = "choose another name";
        if taken == name {
            bail!("an operation is already named `{name}`: {help}");
        }
        bail!("`{name}` is an earlier name of the operation `{taken}`: {help}");
    }
    let mut text = String::new();
    for (path, content) in files {
        let change = if path.exists() { "changed" } else { "wrote" };
        let folder = path.parent().expect("a file is in a folder");
        fs::create_dir_all(folder)
            .with_context(|| format!("cannot create the folder {}", folder.display()))?;
        fs::write(&path, content).with_context(|| format!("cannot write {}", path.display()))?;
        text += &format!("{change} {}\n", path.display());
    }
    print(&(text + &next))?;
    Ok(true)
}

/// Returns the files that add an operation to a group, and the commands that the user should run next.
fn in_group(
    group: &str,
    snake: &str,
    root: &Path,
    fill: impl Fn(&str) -> String,
) -> anyhow::Result<(Files, String)> {
    check_root(root)?;
    let source = root.join("ops").join(group).join("src");
    let (list, file) = (source.join("lib.rs"), source.join(format!("{snake}.rs")));
    let picture = root.join(format!("ops/all/pictures/{snake}.ron"));
    ensure!(
        group != "all" && list.is_file(),
        "the group `{group}` does not exist; groups: {}",
        groups(root).join(", ")
    );
    for path in [&file, &picture] {
        ensure!(!path.exists(), "{} already exists", path.display());
    }
    let text =
        fs::read_to_string(&list).with_context(|| format!("cannot read {}", list.display()))?;
    let text = insert_sorted(&text, "mod ", &fill("mod {name};"))?;
    let text = insert_sorted(&text, "pub use ", &fill("pub use {name}::{Name};"))?;
    let with = fill("        .with::<{Name}>()");
    let text = insert_last(&text, "        .with::<", &with)?;
    let next = format!(
        "next: cargo test -p meshwright-ops-{group}\nto draw its pictures: cargo run -- test \
         ops/all/pictures/{snake}.ron --out ops/all/pictures\n\
         to check it like all operations: cargo test -p meshwright-tests --test laws every_op\n"
    );
    let files = vec![
        (file, fill(OPERATION)),
        (picture, fill(PICTURE)),
        (list, text),
    ];
    Ok((files, next))
}

/// Returns the files of a new program that has the operation, and the commands that the user should run next.
fn in_new_crate(
    snake: &str,
    dir: &Path,
    meshwright: &Path,
    fill: impl Fn(&str) -> String,
) -> anyhow::Result<(Files, String)> {
    check_root(meshwright)
        .context("set the root of the Meshwright workspace with `--meshwright`")?;
    let folder = dir.join(snake);
    ensure!(!folder.exists(), "{} already exists", folder.display());
    let meshwright = absolute(meshwright)?;
    let path = pathdiff::diff_paths(&meshwright, absolute(&folder)?).unwrap_or(meshwright);
    let path = path.display().to_string().replace('\\', "/");
    let manifest = MANIFEST.replace("{kebab}", &snake.replace('_', "-"));
    let manifest = manifest.replace("{meshwright}", &path);
    let next = format!(
        "next: cd {} && cargo test && cargo run -- run picture.ron\n",
        folder.display()
    );
    let files = vec![
        (folder.join("Cargo.toml"), fill(&manifest)),
        (folder.join("src/main.rs"), fill(MAIN)),
        (folder.join(format!("src/{snake}.rs")), fill(OPERATION)),
        (folder.join("picture.ron"), fill(PICTURE)),
    ];
    Ok((files, next))
}

/// Returns the names of the groups of operations, sorted.
fn groups(root: &Path) -> Vec<String> {
    let entries = fs::read_dir(root.join("ops"))
        .into_iter()
        .flatten()
        .flatten();
    let folders = entries.filter(|entry| entry.path().join("src/lib.rs").is_file());
    let names = folders.map(|entry| entry.file_name().to_string_lossy().into_owned());
    let mut names: Vec<String> = names.filter(|name| name != "all").collect();
    names.sort();
    names
}

fn check_root(root: &Path) -> anyhow::Result<()> {
    ensure!(
        root.join("ops/all/src/lib.rs").is_file(),
        "{} is not the root of a Meshwright workspace: it has no folder ops/all",
        root.display()
    );
    Ok(())
}

/// Converts a name such as `InflateFaces` to `inflate_faces`.
pub(crate) fn snake_case(name: &str) -> String {
    let mut snake = String::new();
    for c in name.chars() {
        if c.is_ascii_uppercase() && !snake.is_empty() {
            snake.push('_');
        }
        snake.push(c.to_ascii_lowercase());
    }
    snake
}

/// Returns the name of an operation in snake case, or an error if an operation cannot have this name.
fn module_name(name: &str) -> anyhow::Result<String> {
    let mut letters = name.chars();
    let first_is_upper = letters.next().is_some_and(|c| c.is_ascii_uppercase());
    if !first_is_upper || !letters.all(|c| c.is_ascii_alphanumeric()) {
        bail!("expected a name in camel case, such as InflateFaces, found `{name}`");
    }
    let snake = snake_case(name);
    let contains = |words: &str, word: &str| words.split(' ').any(|w| w == word);
    ensure!(
        !contains(RESERVED_MODULES, &snake),
        "the name `{name}` cannot be used: its module `{snake}` would have the name of a keyword or of a crate that the generated source uses"
    );
    ensure!(
        !contains(RESERVED_TYPES, name),
        "the name `{name}` cannot be used: the generated source uses another type of this name"
    );
    Ok(snake)
}

/// Inserts a line among the lines that begin with `prefix`, so that these lines stay sorted.
fn insert_sorted(text: &str, prefix: &str, line: &str) -> anyhow::Result<String> {
    let next = |l: &&str| l.starts_with(prefix) && *l > line;
    match text.lines().find(next) {
        Some(next) => Ok(text.replacen(&format!("{next}\n"), &format!("{line}\n{next}\n"), 1)),
        None => insert_last(text, prefix, line),
    }
}

/// Inserts a line after the last line that begins with `prefix`.
fn insert_last(text: &str, prefix: &str, line: &str) -> anyhow::Result<String> {
    let missing = || format!("found no line that begins with `{}`", prefix.trim());
    let last = text.lines().rfind(|l| l.starts_with(prefix));
    let last = last.with_context(missing)?;
    Ok(text.replacen(&format!("{last}\n"), &format!("{last}\n{line}\n"), 1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn camel_case_becomes_snake_case() {
        assert_eq!(module_name("InflateFaces").unwrap(), "inflate_faces");
        for bad in [
            "inflate",
            "",
            "Inflate-Faces",
            "../Evil",
            "Loop",
            "Std",
            "Report",
        ] {
            assert!(module_name(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn a_line_is_inserted_among_lines_with_the_same_prefix() {
        let text = "mod a;\nmod c;\n\n.with::<C>()\n.with::<A>()\n";
        let b = insert_sorted(text, "mod ", "mod b;").unwrap();
        assert_eq!(b, "mod a;\nmod b;\nmod c;\n\n.with::<C>()\n.with::<A>()\n");
        let d = insert_sorted(text, "mod ", "mod d;").unwrap();
        assert_eq!(d, "mod a;\nmod c;\nmod d;\n\n.with::<C>()\n.with::<A>()\n");
        let last = insert_last(text, ".with::<", ".with::<B>()").unwrap();
        assert!(last.ends_with(".with::<A>()\n.with::<B>()\n"));
        assert!(insert_last(text, "pub use ", "pub use a::A;").is_err());
    }
}
