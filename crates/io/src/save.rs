//! Writing files whole or not at all.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use rayon::prelude::*;
use tempfile::NamedTempFile;

use crate::asset_path::folder_of;
use crate::error::WriteError;

/// What a file will hold.
pub(crate) enum Content<'a> {
    /// These bytes.
    Bytes(Vec<u8>),
    /// What these append, in their order. They are made as they are written, several at a time, so that a
    /// large text is never in memory as a whole.
    Blocks(Vec<Block<'a>>),
}

/// Appends a block of a file, of some hundred kilobytes.
pub(crate) type Block<'a> = Box<dyn Fn(&mut Vec<u8>) + Send + Sync + 'a>;

/// As [`save`], for files whose bytes are there. Returns their paths.
///
/// # Errors
///
/// As [`save`].
pub(crate) fn save_all(files: Vec<(PathBuf, Vec<u8>)>) -> Result<Vec<PathBuf>, WriteError> {
    let content = |(path, bytes)| (path, Content::Bytes(bytes));
    save(files.into_iter().map(content).collect()).map(|(paths, _)| paths)
}

/// Writes all files to temporary ones in their folders first, and renames them only when every
/// one is complete, in the given order. Returns their paths, and how many bytes they have together.
///
/// # Errors
///
/// [`WriteError::Io`] with the file that could not be written. The files of the same names are then
/// as they were, unless the system refused one of the last renamings.
pub(crate) fn save(files: Vec<(PathBuf, Content)>) -> Result<(Vec<PathBuf>, u64), WriteError> {
    let mut complete = Vec::with_capacity(files.len());
    let mut n_bytes = 0;
    for (path, content) in files {
        if path.is_dir() {
            let source = io::Error::other("a folder of this name is there");
            return Err(WriteError::io(&path, source));
        }
        if !folder_of(&path).is_dir() {
            let source = io::Error::other("there is no such folder");
            return Err(WriteError::io(&path, source));
        }
        let (file, n) = temporary(&path, &content)
            .map_err(|source| WriteError::io(&path, without_temporary_name(source)))?;
        n_bytes += n;
        complete.push((path, file));
    }
    let mut paths = Vec::with_capacity(complete.len());
    for (path, file) in complete {
        file.persist(&path)
            .map_err(|failed| WriteError::io(&path, failed.error))?;
        paths.push(path);
    }
    Ok((paths, n_bytes))
}

fn temporary(path: &Path, content: &Content) -> io::Result<(NamedTempFile, u64)> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".meshwright-");
    // A temporary file is private to its user; the file that it becomes is as open as any other.
    #[cfg(unix)]
    let mode = std::os::unix::fs::PermissionsExt::from_mode(0o666);
    #[cfg(unix)]
    builder.permissions(mode);
    let mut file = builder.tempfile_in(folder_of(path))?;
    let n_bytes = match content {
        Content::Bytes(bytes) => {
            file.write_all(bytes)?;
            bytes.len() as u64
        }
        Content::Blocks(blocks) => write_blocks(&mut file, blocks)?,
    };
    file.flush()?;
    Ok((file, n_bytes))
}

/// Writes what the blocks append and returns how many bytes that is. While one thread writes a group of
/// blocks, the others make the next.
fn write_blocks(out: &mut (impl Write + Send), blocks: &[Block]) -> io::Result<u64> {
    let in_group = 4 * rayon::current_num_threads();
    let mut made: Vec<Vec<u8>> = Vec::new();
    let mut spare: Vec<Vec<u8>> = Vec::new();
    let mut n_bytes = 0;
    // The last round has nothing to make.
    for group in blocks.chunks(in_group).chain([&[][..]]) {
        spare.resize_with(group.len(), Vec::new);
        let (written, ()) = rayon::join(
            || made.iter().try_for_each(|bytes| out.write_all(bytes)),
            || make(group, &mut spare),
        );
        written?;
        n_bytes += made.iter().map(|bytes| bytes.len() as u64).sum::<u64>();
        std::mem::swap(&mut made, &mut spare);
    }
    Ok(n_bytes)
}

fn make(blocks: &[Block], room: &mut [Vec<u8>]) {
    blocks
        .par_iter()
        .zip(room)
        .with_max_len(1)
        .for_each(|(block, bytes)| {
            bytes.clear();
            block(bytes);
        });
}

/// The error without the path that tempfile puts behind it: the name of a file that is gone tells a
/// person nothing.
fn without_temporary_name(error: io::Error) -> io::Error {
    match error.to_string().split_once(" at path ") {
        Some((what, _)) => io::Error::new(error.kind(), what),
        None => error,
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn files_are_replaced_and_nothing_else_is_left() {
        let folder = tempfile::tempdir().unwrap();
        let [a, b] = ["a", "b"].map(|name| folder.path().join(name));
        fs::write(&a, "old").unwrap();

        save_all(vec![
            (a.clone(), b"new".to_vec()),
            (b.clone(), b"b".to_vec()),
        ])
        .unwrap();

        assert_eq!(fs::read(a).unwrap(), b"new");
        assert_eq!(fs::read(b).unwrap(), b"b");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
    }

    #[test]
    fn blocks_are_written_in_order() {
        let folder = tempfile::tempdir().unwrap();
        for n in [0, 1, 7, 1000] {
            let path = folder.path().join(n.to_string());
            let block = |i: usize| -> Block {
                Box::new(move |out| {
                    let length = i * 7919 % 300;
                    out.extend(format!("{i} ").as_bytes().iter().cycle().take(length));
                })
            };
            let mut expected = Vec::new();
            for i in 0..n {
                block(i)(&mut expected);
            }
            let blocks = Content::Blocks((0..n).map(block).collect());
            let (_, n_bytes) = save(vec![(path.clone(), blocks)]).unwrap();
            assert_eq!(fs::read(path).unwrap(), expected);
            assert_eq!(n_bytes, expected.len() as u64);
        }
    }

    #[test]
    fn if_one_file_cannot_be_written_none_is() {
        let folder = tempfile::tempdir().unwrap();
        let a = folder.path().join("a");
        let missing = folder.path().join("no/such/b");

        let error = save_all(vec![(a.clone(), vec![]), (missing.clone(), vec![])]).unwrap_err();

        let expected = format!(
            "cannot write {}: there is no such folder",
            missing.display()
        );
        assert_eq!(error.to_string(), expected);
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_folder_that_takes_no_files_is_named_without_the_temporary_file() {
        // Not even the administrator makes files here.
        let error = save_all(vec![(PathBuf::from("/proc/a.obj"), vec![])]).unwrap_err();
        let text = error.to_string();
        assert!(
            text.starts_with("cannot write /proc/a.obj: ") && !text.contains("meshwright-"),
            "{text}"
        );
    }

    #[test]
    fn a_folder_in_the_way_is_an_error() {
        let folder = tempfile::tempdir().unwrap();
        assert!(save_all(vec![(folder.path().to_path_buf(), vec![])]).is_err());
    }
}
