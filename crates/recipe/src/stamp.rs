//! The stamp: one line of text in an output file. The line records the provenance of the file: which run wrote it.
//!
//! ```text
//! meshwright 0.1.0, recipe 1f0c..e2, {"file":"teapot.ron","set":{"levels":"2"},"inputs":{"a.bez":"9a.."}}
//! ```
//!
//! The digest of the recipe comes before the details of the run. Therefore, a format that can store only a short text
//! still stores the digest. The stamp contains no absolute paths. A stamp records a file by its path relative to the
//! recipe's folder. If the path is absolute and leads out of this folder, only the name of the file is recorded.

use std::fmt;
use std::path::Path;

use serde::{Deserialize, Serialize};
use store::{Store, StoreError};

use crate::params::Param;
use crate::recipe::{Origin, Recipe};
use crate::source::below;

/// The content of a stamp.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stamp {
    /// The program and its version.
    pub program: String,
    /// The digest of the recipe, including the values of its parameters.
    pub recipe: String,
    /// The details of the run. `None` if the stamp was truncated before the end of these details.
    pub run: Option<Run>,
}

/// The information that is needed to run the recipe again.
#[derive(Clone, Debug, Default, Deserialize, Eq, PartialEq, Serialize)]
pub struct Run {
    /// The name of the recipe's file.
    pub file: String,
    /// The preset that was chosen.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub preset: Option<String>,
    /// The parameters that were set, with their values as text. Paths are written as in [`inputs`](Self::inputs).
    #[serde(default, skip_serializing_if = "Pairs::is_empty")]
    pub set: Pairs,
    /// The digest of each file that the run read. The keys are the paths of the files relative to the recipe's folder.
    /// See [`shown`].
    #[serde(default, skip_serializing_if = "Pairs::is_empty")]
    pub inputs: Pairs,
}

/// Named strings, sorted by name.
pub type Pairs = std::collections::BTreeMap<String, String>;

impl Stamp {
    /// Returns the stamp of the files that a run of `recipe` writes. `inputs` are the files that the recipe reads.
    pub fn new(recipe: &Recipe, inputs: &[impl AsRef<Path>], store: &dyn Store) -> Self {
        let mut run = Run::default();
        if let Some(source) = recipe.sources.first() {
            let name = source.path.file_name().unwrap_or_default();
            run.file = name.to_string_lossy().into_owned();
            for input in inputs.iter().map(AsRef::as_ref) {
                // A file that cannot be read is skipped, because the run will fail anyway.
                if let Ok(digest) = digest(store, input) {
                    run.inputs.insert(shown(input, source.folder()), digest);
                }
            }
        }
        for parameter in recipe.parameters() {
            match &parameter.origin {
                Origin::Preset(name) => run.preset = Some(name.clone()),
                Origin::Set => {
                    let text = parameter.plain_text();
                    let text = match (&parameter.param, recipe.sources.first()) {
                        (Param::Path { .. }, Some(source)) if Path::new(&text).has_root() => {
                            shown(Path::new(&text), source.folder())
                        }
                        _ => text,
                    };
                    run.set.insert(parameter.name.clone(), text);
                }
                Origin::Default | Origin::Call => {}
            }
        }
        Self {
            program: concat!("meshwright ", env!("CARGO_PKG_VERSION")).to_owned(),
            recipe: recipe.digest(),
            run: Some(run),
        }
    }

    /// Parses a stamp. Returns `None` if the text is not a stamp.
    pub fn parse(text: &str) -> Option<Self> {
        let (program, rest) = text.split_once(", recipe ")?;
        let (recipe, rest) = rest.split_once(", ").unwrap_or((rest, ""));
        let is_digest = recipe.len() == 32 && recipe.bytes().all(|b| b.is_ascii_hexdigit());
        (is_digest && program.starts_with("meshwright ")).then(|| Self {
            program: program.to_owned(),
            recipe: recipe.to_owned(),
            run: serde_json::from_str(rest).ok(),
        })
    }
}

impl fmt::Display for Stamp {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, recipe {}", self.program, self.recipe)?;
        if let Some(run) = &self.run {
            let run = serde_json::to_string(run).map_err(|_| fmt::Error)?;
            write!(f, ", {run}")?;
        }
        Ok(())
    }
}

/// Returns the digest of the bytes of a file.
///
/// # Errors
///
/// Returns an error if the file cannot be read.
pub fn digest(store: &dyn Store, path: &Path) -> Result<String, StoreError> {
    let bytes = store.read(path)?;
    let digest = blake3::Hasher::new().update_rayon(&bytes).finalize();
    Ok(digest.to_hex()[..32].to_owned())
}

/// Returns the path of a file in the form in which a stamp records it. `folder` is the folder of the recipe, and a
/// relative `path` is relative to the working directory. The recorded path is relative to `folder`. If `path` is
/// absolute and leads out of `folder`, only the name of the file is recorded.
pub fn shown(path: &Path, folder: &Path) -> String {
    let relative = if path.has_root() {
        let name = || path.file_name().unwrap_or_default().into();
        below(path, folder).unwrap_or_else(name)
    } else if let Ok(below) = path.strip_prefix(folder) {
        below.to_owned()
    } else {
        pathdiff::diff_paths(path, folder).unwrap_or_else(|| path.to_owned())
    };
    relative.to_string_lossy().replace('\\', "/")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Source, Values};

    #[test]
    fn a_stamp_has_the_information_to_run_the_recipe_again() {
        let folder = tempfile::tempdir().unwrap();
        let input = folder.path().join("a.bez");
        std::fs::write(&input, "0").unwrap();
        let text = r#"(recipe: 1, params: {
            "n": Int(default: 1), "s": Text(default: ""), "m": Float(default: 1),
        }, presets: {"fine": {"m": 2}}, steps: [])"#;
        let set = [("n", "7"), ("s", "a \"b\"\n")].map(|(a, b)| (a.to_owned(), b.to_owned()));
        let values = Values {
            set: &set,
            preset: Some("fine"),
            folder: None,
        };
        let source = Source::new(folder.path().join("x.ron"), text);
        let registry = op::Registry::new();
        let recipe = crate::read(&source, &registry, values).recipe;
        let stamp = Stamp::new(&recipe, &[input], &store::Disk);
        let line = stamp.to_string();
        assert_eq!(Stamp::parse(&line).as_ref(), Some(&stamp), "{line}");
        assert!(!line.contains('\n') && !line.contains(&*folder.path().to_string_lossy()));
        let run = stamp.run.unwrap();
        assert_eq!(
            (run.file.as_str(), run.preset.as_deref()),
            ("x.ron", Some("fine"))
        );
        assert_eq!(run.set.into_iter().collect::<Vec<_>>(), set);
        assert_eq!(run.inputs.keys().collect::<Vec<_>>(), ["a.bez"]);
    }

    #[test]
    fn a_stamp_contains_no_absolute_paths() {
        let elsewhere = tempfile::tempdir().unwrap();
        let input = elsewhere.path().join("a.bez");
        std::fs::write(&input, "0").unwrap();
        let here = std::path::absolute("sub/b.bez").unwrap();
        // If a recipe is given only by its file name, its folder is "".
        for folder in ["", ".", "sub", "/nowhere"].map(Path::new) {
            assert_eq!(shown(&input, folder), "a.bez", "{folder:?}");
        }
        assert_eq!(shown(&here, Path::new("")), "sub/b.bez");
        assert_eq!(shown(&here, Path::new("sub")), "b.bez");
        assert_eq!(shown(Path::new("sub/b.bez"), Path::new("")), "sub/b.bez");
        assert_eq!(
            shown(Path::new("sub/b.bez"), Path::new("other")),
            "../sub/b.bez"
        );

        let text =
            r#"(recipe: 1, params: {"a": Path(default: ""), "b": Path(default: "")}, steps: [])"#;
        let set = [("a", &input), ("b", &here)];
        let set = set.map(|(name, path)| (name.to_owned(), path.to_string_lossy().into_owned()));
        let values = Values {
            set: &set,
            ..Values::default()
        };
        let source = Source::new("k.ron", text);
        let recipe = crate::read(&source, &op::Registry::new(), values).recipe;
        let run = Stamp::new(&recipe, &[&input], &store::Disk).run.unwrap();
        assert_eq!(run.inputs.keys().collect::<Vec<_>>(), ["a.bez"]);
        assert_eq!(run.set.values().collect::<Vec<_>>(), ["a.bez", "sub/b.bez"]);
    }

    #[test]
    fn a_truncated_stamp_keeps_the_digest() {
        let line = "meshwright 0.1.0, recipe 0123456789abcdef0123456789abcdef, {\"fi";
        let stamp = Stamp::parse(line).unwrap();
        assert_eq!((stamp.recipe.len(), stamp.run), (32, None));
        for text in [
            "",
            "meshwright 0.1.0",
            "blender, recipe 01",
            "meshwright 1, recipe zz",
        ] {
            assert_eq!(Stamp::parse(text), None, "{text}");
        }
    }
}
