//! The files of a batch: patterns to a sorted list, and the parts of the list.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, anyhow, bail, ensure};
use walkdir::WalkDir;

use crate::args::Shard;

/// A file that the recipe is to run on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Input {
    /// Its path, as the pattern leads to it.
    pub(crate) path: String,
    /// Its path from the folder in which the pattern begins.
    pub(crate) relative: PathBuf,
}

impl Input {
    /// Whether the file belongs to this part of every list that it is in: by its path alone, so that
    /// no other file moves when one is added.
    pub(crate) fn is_in(&self, shard: Shard) -> bool {
        let hash = blake3::hash(self.path.as_bytes());
        let mut first = [0; 8];
        first.copy_from_slice(&hash.as_bytes()[..8]);
        u64::from_le_bytes(first) % u64::from(shard.of) == u64::from(shard.index - 1)
    }
}

/// The files that the patterns match, sorted by their paths, each once.
pub(crate) fn list(patterns: &[String]) -> anyhow::Result<Vec<Input>> {
    let mut inputs = Vec::new();
    for pattern in patterns {
        let before = inputs.len();
        let path = Path::new(pattern);
        // A name that looks like a pattern is a name.
        if path.is_file() {
            inputs.push(Input {
                path: pattern.clone(),
                relative: path.file_name().map(PathBuf::from).unwrap_or_default(),
            });
        } else if path.is_dir() {
            bail!("{pattern} is a folder: write '{pattern}/*.obj' for the files in it");
        } else {
            search(pattern, &mut inputs)?;
        }
        ensure!(inputs.len() > before, "no file matches {pattern}");
    }
    inputs.sort_by(|a, b| a.path.cmp(&b.path));
    inputs.dedup_by(|a, b| a.path == b.path);
    Ok(inputs)
}

/// Finds what matches one pattern. Links to folders are not followed, as they may lead in a circle;
/// hidden files are found by patterns that begin a name with a point.
fn search(pattern: &str, inputs: &mut Vec<Input>) -> anyhow::Result<()> {
    let (base, rest) = split(pattern);
    let wrong = || format!("{pattern} is no pattern of files");
    fast_glob::validate(rest).map_err(|error| anyhow!("{error}").context(wrong()))?;
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
    let visible = move |entry: &walkdir::DirEntry| {
        let is_hidden = entry.file_name().to_string_lossy().starts_with('.');
        entry.depth() == 0 || shows_hidden || !is_hidden
    };
    for entry in walk.into_iter().filter_entry(visible) {
        let entry = entry.with_context(|| format!("cannot search for {pattern}"))?;
        let relative = entry.path().strip_prefix(folder).unwrap_or(entry.path());
        let is_match = fast_glob::glob_match(&glob, relative.as_os_str().as_encoded_bytes());
        if is_match && entry.path().is_file() {
            let path = Path::new(base).join(relative);
            let Some(text) = path.to_str() else {
                bail!(
                    "{}: the name of a file must be Unicode text to be put into a recipe",
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

/// The folder in which a pattern begins, and what is left of the pattern.
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
    fn a_pattern_begins_in_a_folder() {
        assert_eq!(split("a/b/*.obj"), ("a/b", "*.obj"));
        assert_eq!(split("a/b*/c"), ("a", "b*/c"));
        assert_eq!(split("*.obj"), ("", "*.obj"));
        assert_eq!(split("/*.obj"), ("/", "*.obj"));
        assert_eq!(split("../x/**/*.{obj,ply}"), ("../x", "**/*.{obj,ply}"));
    }

    #[test]
    fn parts_are_disjoint_and_together_everything() {
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
