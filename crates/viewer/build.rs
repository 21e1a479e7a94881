//! Lists the pictures of operations in ops/all/pictures, so that the program contains these pictures.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{env, fs, io};

fn main() -> io::Result<()> {
    let folder = Path::new(&env::var("CARGO_MANIFEST_DIR").map_err(io::Error::other)?)
        .join("../../ops/all/pictures")
        .canonicalize()?;
    println!("cargo::rerun-if-changed={}", folder.display());
    let mut folders: Vec<PathBuf> = fs::read_dir(folder)?
        .map(|entry| entry.map(|entry| entry.path()))
        .collect::<Result<_, _>>()?;
    folders.sort();
    let mut list = "[\n".to_owned();
    for folder in folders {
        let picture = |name: &str| {
            let path = folder.join(name);
            let text = path.to_string_lossy();
            if path.exists() {
                format!("Some(include_bytes!({text:?}))")
            } else {
                "None".to_owned()
            }
        };
        if let Some(name) = folder.file_name().filter(|_| folder.is_dir()) {
            let name = camel_case(&name.to_string_lossy());
            let [before, after] = [picture("before.png"), picture("after.png")];
            let _ = writeln!(list, "({name:?}, {before}, {after}),");
        }
    }
    list.push(']');
    let file = Path::new(&env::var("OUT_DIR").map_err(io::Error::other)?).join("pictures.rs");
    fs::write(file, list)
}

/// Returns the name of the operation of a folder: `BevelEdges` for `bevel_edges`.
fn camel_case(name: &str) -> String {
    let words = name.split('_').map(|word| {
        let (first, rest) = word.split_at(word.len().min(1));
        first.to_uppercase() + rest
    });
    words.collect()
}
