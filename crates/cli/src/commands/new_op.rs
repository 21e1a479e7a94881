//! `meshwright new-op`: writes an operation crate that works, to be changed.

use std::fs;
use std::path::Path;

use anyhow::{Context as _, bail, ensure};

use crate::output::print;

const MANIFEST: &str = include_str!("new_op/Cargo.toml.txt");
const SOURCE: &str = include_str!("new_op/lib.rs.txt");

/// Names of crates that the sample or the list use, and words that no crate can have as its name.
const TAKEN: &str = "abstract alloc all as async await become box break const continue core crate do \
    dyn else enum extern false final fn for gen if impl in let loop macro match mesh mod move mut op \
    override priv proc_macro pub ref return scene schemars self serde static std struct super test \
    trait true try type typeof unsafe unsized use virtual where while yield";

/// Types that the sample uses.
const TYPES: &str = "Context DVec3 Deserialize JsonSchema MeshOperation MeshPlan OpError PlanContext \
    Problem Report Result Select Serialize Vec VertexSelection";

pub(crate) fn run(name: &str, root: &Path) -> anyhow::Result<bool> {
    let snake = checked(name)?;
    let folder = root.join("ops").join(&snake);
    let (list, manifest) = (
        root.join("ops/all/src/lib.rs"),
        root.join("ops/all/Cargo.toml"),
    );
    ensure!(
        list.is_file() && manifest.is_file(),
        "{} is not the root of a Meshwright workspace: there is no ops/all",
        root.display()
    );
    ensure!(!folder.exists(), "{} is there already", folder.display());

    // Everything is prepared before anything is written.
    let fill = |text: &str| {
        text.replace("{Name}", name)
            .replace("{name}", &snake)
            .replace("{kebab}", &snake.replace('_', "-"))
    };
    let read = |path: &Path| {
        fs::read_to_string(path).with_context(|| format!("cannot read {}", path.display()))
    };
    let dependency = fill("{name} = { package = \"meshwright-op-{kebab}\", path = \"../{name}\" }");
    let line = fill("        .with::<{name}::{Name}>()");
    let new_manifest = insert_line(&read(&manifest)?, "[dependencies]", &dependency, |l| {
        l.contains("path = \"")
    })?;
    let new_list = insert_line(&read(&list)?, "Registry::new()", &line, |l| {
        l.contains(".with::<")
    })?;

    let write = |path: &Path, text: &str| {
        fs::write(path, text).with_context(|| format!("cannot write {}", path.display()))
    };
    fs::create_dir_all(folder.join("src"))
        .with_context(|| format!("cannot make {}", folder.display()))?;
    write(&folder.join("Cargo.toml"), &fill(MANIFEST))?;
    write(&folder.join("src/lib.rs"), &fill(SOURCE))?;
    write(&manifest, &new_manifest)?;
    write(&list, &new_list)?;
    print(&format!(
        "wrote {folder}/Cargo.toml and {folder}/src/lib.rs\nadded {name} to ops/all\nnext: cargo test -p meshwright-op-{}\n",
        snake.replace('_', "-"),
        folder = folder.display(),
    ))?;
    Ok(true)
}

/// `InflateFaces` as `inflate_faces`.
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

/// The name in snake case, if an operation can have it.
fn checked(name: &str) -> anyhow::Result<String> {
    let mut letters = name.chars();
    let first_is_upper = letters.next().is_some_and(|c| c.is_ascii_uppercase());
    if !first_is_upper || !letters.all(|c| c.is_ascii_alphanumeric()) {
        bail!("expected a name in camel case, such as InflateFaces, found `{name}`");
    }
    let snake = snake_case(name);
    let among = |words: &str, word: &str| words.split(' ').any(|w| w == word);
    ensure!(
        !among(TAKEN, &snake),
        "`{name}` would be the crate `{snake}`, which is taken"
    );
    ensure!(
        !among(TYPES, name),
        "the sample uses another `{name}`: choose a name that says more"
    );
    Ok(snake)
}

/// Puts a line behind the last one that `is_alike`, or behind the line with `anchor` if there is none.
fn insert_line(
    text: &str,
    anchor: &str,
    line: &str,
    is_alike: impl Fn(&str) -> bool,
) -> anyhow::Result<String> {
    let mut lines: Vec<&str> = text.lines().collect();
    ensure!(!lines.contains(&line), "`{}` is there already", line.trim());
    let Some(place) = lines
        .iter()
        .rposition(|l| is_alike(l))
        .or_else(|| lines.iter().position(|l| l.contains(anchor)))
    else {
        bail!("found no line with `{anchor}`");
    };
    lines.insert(place + 1, line);
    Ok(lines.join("\n") + "\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn camel_case_becomes_snake_case() {
        assert_eq!(checked("InflateFaces").unwrap(), "inflate_faces");
        for bad in [
            "inflate",
            "",
            "Inflate-Faces",
            "../Evil",
            "All",
            "Loop",
            "Std",
            "Report",
        ] {
            assert!(checked(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn a_line_goes_behind_those_like_it() {
        let text = "a\n  .with::<x>()\nb\n";
        let new = insert_line(text, "a", "  .with::<y>()", |l| l.contains(".with")).unwrap();
        assert_eq!(new, "a\n  .with::<x>()\n  .with::<y>()\nb\n");
        let first = insert_line("a\nb\n", "a", "c", |_| false).unwrap();
        assert_eq!(first, "a\nc\nb\n");
    }
}
