//! The input files of a batch: expands patterns to a list, and divides the list into parts.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, anyhow, bail, ensure};
use walkdir::WalkDir;

use crate::args::Shard;

/// An input file of a batch.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Input {
    /// The path, with the same beginning as the pattern.
    pub(crate) path: String,
    /// The path relative to the folder in which the pattern starts.
    pub(crate) relative: PathBuf,
}

impl Input {
    /// Whether the file belongs to this part. The part of a file depends only on its path, so that adding a file does
    /// not move other files to different parts.
    pub(crate) fn is_in(&self, shard: Shard) -> bool {
        let hash = blake3::hash(self.path.as_bytes());
        let mut first = [0; 8];
        first.copy_from_slice(&hash.as_bytes()[..8]);
        u64::from_le_bytes(first) % u64::from(shard.of) == u64::from(shard.index - 1)
    }
}

/// Lists the files that the patterns match, without duplicates. The files of each pattern are sorted by path, and
/// follow the files of the previous pattern.
pub(crate) fn list(patterns: &[String]) -> anyhow::Result<Vec<Input>> {
    let mut inputs = Vec::new();
    for pattern in patterns {
        let before = inputs.len();
        let path = Path::new(pattern);
        // If a file has the name `pattern`, the pattern is the path of this file.
        if path.is_file() {
            inputs.push(Input {
                path: pattern.clone(),
                relative: path.file_name().map(PathBuf::from).unwrap_or_default(),
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

/// Finds the files that match one pattern. Does not follow links to folders, since they can form cycles. Finds hidden
/// files only if a name in the pattern begins with a dot.
fn search(pattern: &str, inputs: &mut Vec<Input>) -> anyhow::Result<()> {
    let (base, rest) = split(pattern);
    let invalid = || format!("{pattern} is not a valid file pattern");
    fast_glob::validate(rest).map_err(|error| anyhow!("{error}").context(invalid()))?;
    // A leading exclamation mark is part of a name here, not a negation.
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
            });
        }
    }
    Ok(())
}

/// Splits a pattern into the folder in which it starts and the rest.
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

#[cfg(test)]
mod tests {
    use super::*;

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
    fn every_file_is_in_exactly_one_part() {
        let input = |i: usize| Input {
            path: format!("models/{i}.obj"),
            relative: PathBuf::new(),
        };
        for of in [1, 2, 3, 7] {
            let mut sizes = vec![0; of as usize];
            for input in (0..500).map(input) {
                let parts = (1..=of).filter(|&index| input.is_in(Shard { index, of }));
                let parts: Vec<u32> = parts.collect();
                assert_eq!(parts.len(), 1);
                sizes[parts[0] as usize - 1] += 1;
            }
            let fair = 500 / of;
            assert!(
                sizes.iter().all(|&n| n > fair / 2 && n < fair * 2),
                "{sizes:?}"
            );
        }
    }
}
