//! The input files of a batch: expands patterns to a list, and divides the list into parts.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, anyhow, bail, ensure};
use walkdir::WalkDir;

use super::sets::{ParameterSet, label};

/// An input file of a batch.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Input {
    /// The path of the input file, such as `models/a/cow.obj` for the pattern `models/**/*.obj`. The path is empty if
    /// the recipe runs without an input file.
    pub(crate) path: String,
    /// The path relative to the folder before the first wildcard of the pattern: `a/cow.obj` for `models/**/*.obj`.
    pub(crate) relative: PathBuf,
    /// The parameter set of the run, if the batch has several.
    pub(crate) set: Option<ParameterSet>,
}

impl Input {
    /// Returns the number of the parameter set, or 0 if there is no parameter set.
    pub(super) fn number(&self) -> usize {
        self.set.as_ref().map_or(0, |set| set.number)
    }

    /// Returns the text that names the file and its parameter set in messages.
    pub(super) fn label(&self) -> String {
        let values = self.set.as_ref().map(|set| set.values.clone());
        label(&self.path, &values.unwrap_or_default())
    }

    /// Returns a digest of the path and of the number of the parameter set.
    pub(super) fn digest(&self) -> blake3::Hash {
        let mut hasher = blake3::Hasher::new();
        hasher.update(self.path.as_bytes());
        if let Some(set) = &self.set {
            hasher.update(format!("\0{}", set.number).as_bytes());
        }
        hasher.finalize()
    }

    /// Returns the number of the part to which the file belongs, counted from 1. This number depends only on the path
    /// of the file and on the number of its parameter set. So if a file is added, no other file moves to a different
    /// part.
    pub(super) fn part(&self, of: u32) -> u32 {
        let mut first = [0; 8];
        first.copy_from_slice(&self.digest().as_bytes()[..8]);
        let part = u64::from_le_bytes(first) % u64::from(of);
        u32::try_from(part).map_or(of, |part| part + 1)
    }
}

/// Lists the files that the patterns match, without duplicates. The patterns are handled in their given order. The
/// files of each pattern are sorted by path.
pub(crate) fn list(patterns: &[String]) -> anyhow::Result<Vec<Input>> {
    let mut inputs = Vec::new();
    for pattern in patterns {
        let before = inputs.len();
        let path = Path::new(pattern);
        // If `pattern` is the path of an existing file, it stands for this file and is not expanded.
        if path.is_file() {
            inputs.push(Input {
                path: pattern.clone(),
                relative: path.file_name().map(PathBuf::from).unwrap_or_default(),
                set: None,
            });
        } else if path.is_dir() {
            bail!(
                "{pattern} is a folder, expected files: use '{pattern}/*.obj' for the files in it"
            );
        } else {
            search(pattern, &mut inputs)?;
        }
        ensure!(inputs.len() > before, "no file matches {pattern}");
        inputs[before..].sort_by(|a, b| a.path.cmp(&b.path));
    }
    let mut paths = HashSet::new();
    inputs.retain(|input| paths.insert(input.path.clone()));
    Ok(inputs)
}

/// Finds the files that match one pattern. Does not follow links to folders, since such links can form cycles. Finds
/// hidden files only if the name of a file or folder in the pattern begins with a dot.
fn search(pattern: &str, inputs: &mut Vec<Input>) -> anyhow::Result<()> {
    let (base, rest) = split(pattern);
    let invalid = || format!("{pattern} is not a valid file pattern");
    fast_glob::validate(rest).map_err(|error| anyhow!("{error}").context(invalid()))?;
    // In `fast_glob`, a leading exclamation mark negates the pattern. Here, it is a part of the name.
    let glob = if rest.starts_with('!') {
        format!("\\{rest}")
    } else {
        rest.to_owned()
    };
    let folder = if base.is_empty() { "." } else { base };
    if !Path::new(folder).is_dir() {
        return Ok(());
    }
    let shows_hidden = rest.split('/').any(|part| part.starts_with('.'));
    let depth = if rest.contains("**") || rest.contains('{') {
        usize::MAX
    } else {
        rest.split('/').count()
    };
    let walk = WalkDir::new(folder).min_depth(1).max_depth(depth);
    let is_searched = move |entry: &walkdir::DirEntry| {
        let is_hidden = entry.file_name().to_string_lossy().starts_with('.');
        entry.depth() == 0 || shows_hidden || !is_hidden
    };
    for entry in walk.into_iter().filter_entry(is_searched) {
        let entry = entry.with_context(|| format!("cannot search for {pattern}"))?;
        let relative = entry.path().strip_prefix(folder).unwrap_or(entry.path());
        let is_match = fast_glob::glob_match(&glob, relative.as_os_str().as_encoded_bytes());
        if is_match && entry.path().is_file() {
            let path = Path::new(base).join(relative);
            let Some(text) = path.to_str() else {
                bail!(
                    "{}: the path of an input file must be valid Unicode",
                    path.display()
                );
            };
            inputs.push(Input {
                path: text.to_owned(),
                relative: relative.to_path_buf(),
                set: None,
            });
        }
    }
    Ok(())
}

/// Splits a pattern into the folder before its first wildcard and the rest: `models/*.obj` becomes `models` and
/// `*.obj`.
fn split(pattern: &str) -> (&str, &str) {
    let special = pattern
        .find(['*', '?', '[', '{', '\\'])
        .unwrap_or(pattern.len());
    match pattern[..special].rfind('/') {
        Some(0) => ("/", &pattern[1..]),
        Some(slash) => (&pattern[..slash], &pattern[slash + 1..]),
        None => ("", pattern),
    }
}

/// Returns every combination of an input file and a parameter set. If there are no input files, the list has one entry
/// for each parameter set.
pub(super) fn combined(inputs: Vec<Input>, sets: &[ParameterSet]) -> Vec<Input> {
    let inputs = if inputs.is_empty() {
        vec![Input::default()]
    } else {
        inputs
    };
    let with = |input: &Input, set: &ParameterSet| Input {
        set: Some(set.clone()),
        ..input.clone()
    };
    let each = inputs.iter();
    each.flat_map(|input| sets.iter().map(|set| with(input, set)))
        .collect()
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;

    #[test]
    fn every_input_is_combined_with_every_set() {
        let set = |number| ParameterSet {
            number,
            values: BTreeMap::new(),
        };
        let input = |path: &str| Input {
            path: path.to_owned(),
            ..Input::default()
        };
        let found = combined(vec![input("a"), input("b")], &[set(1), set(2)]);
        let found: Vec<_> = found
            .iter()
            .map(|i| (i.path.as_str(), i.number()))
            .collect();
        assert_eq!(found, [("a", 1), ("a", 2), ("b", 1), ("b", 2)]);
        let alone = combined(Vec::new(), &[set(1), set(2)]);
        assert_eq!(alone.len(), 2);
    }

    #[test]
    fn files_are_listed_in_the_order_of_their_patterns() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name).display().to_string();
        for name in ["a.obj", "b.obj", "c.ply", "d.ply"] {
            std::fs::write(path(name), "").unwrap();
        }
        let listed = list(&[path("b.obj"), path("*.ply"), path("*.obj")]).unwrap();
        let paths: Vec<String> = listed.into_iter().map(|input| input.path).collect();
        assert_eq!(paths, ["b.obj", "c.ply", "d.ply", "a.obj"].map(path));
    }

    #[test]
    fn a_pattern_is_split_after_its_folder() {
        assert_eq!(split("a/b/*.obj"), ("a/b", "*.obj"));
        assert_eq!(split("a/b*/c"), ("a", "b*/c"));
        assert_eq!(split("*.obj"), ("", "*.obj"));
        assert_eq!(split("/*.obj"), ("/", "*.obj"));
        assert_eq!(split("../x/**/*.{obj,ply}"), ("../x", "**/*.{obj,ply}"));
    }

    #[test]
    fn files_are_divided_evenly() {
        let input = |i: usize| Input {
            path: format!("models/{i}.obj"),
            ..Input::default()
        };
        for of in [1, 2, 3, 7] {
            let mut sizes = vec![0; of as usize];
            for input in (0..500).map(input) {
                sizes[input.part(of) as usize - 1] += 1;
            }
            let fair = 500 / of;
            assert!(
                sizes.iter().all(|&n| n > fair / 2 && n < fair * 2),
                "{sizes:?}"
            );
        }
    }
}
