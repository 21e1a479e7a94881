//! Writing files whole or not at all.

use std::io::Write;
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use crate::asset_path::folder_of;
use crate::error::WriteError;

/// Writes all files to temporary ones in their folders first, and renames them only when every
/// one is complete, in the given order. Returns their paths.
///
/// # Errors
///
/// [`WriteError::Io`] with the file that could not be written. The files of the same names are then
/// as they were, unless the system refused one of the last renamings.
pub(crate) fn save_all(files: Vec<(PathBuf, Vec<u8>)>) -> Result<Vec<PathBuf>, WriteError> {
    let mut complete = Vec::with_capacity(files.len());
    for (path, bytes) in files {
        if path.is_dir() {
            let source = std::io::Error::other("a folder of this name is there");
            return Err(WriteError::io(&path, source));
        }
        if !folder_of(&path).is_dir() {
            let source = std::io::Error::other("there is no such folder");
            return Err(WriteError::io(&path, source));
        }
        let file = temporary(&path, &bytes)
            .map_err(|source| WriteError::io(&path, without_temporary_name(source)))?;
        complete.push((path, file));
    }
    let mut paths = Vec::with_capacity(complete.len());
    for (path, file) in complete {
        file.persist(&path)
            .map_err(|failed| WriteError::io(&path, failed.error))?;
        paths.push(path);
    }
    Ok(paths)
}

fn temporary(path: &Path, bytes: &[u8]) -> std::io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".meshwright-");
    // A temporary file is private to its user; the file that it becomes is as open as any other.
    #[cfg(unix)]
    let mode = std::os::unix::fs::PermissionsExt::from_mode(0o666);
    #[cfg(unix)]
    builder.permissions(mode);
    let mut file = builder.tempfile_in(folder_of(path))?;
    file.write_all(bytes)?;
    file.flush()?;
    Ok(file)
}

/// The error without the path that tempfile puts behind it: the name of a file that is gone tells a
/// person nothing.
fn without_temporary_name(error: std::io::Error) -> std::io::Error {
    match error.to_string().split_once(" at path ") {
        Some((what, _)) => std::io::Error::new(error.kind(), what),
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
