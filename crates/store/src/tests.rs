use std::fs;
use std::path::PathBuf;

use super::*;

/// Returns both stores, each with the path of an empty folder in that store.
fn stores() -> [(Box<dyn Store>, PathBuf, Option<tempfile::TempDir>); 2] {
    let folder = tempfile::tempdir().unwrap();
    [
        (Box::new(Memory::default()), PathBuf::from("."), None),
        (Box::new(Disk), folder.path().to_owned(), Some(folder)),
    ]
}

#[test]
fn the_stem_of_a_compressed_file_has_no_extension() {
    for (path, expected) in [
        ("a/model.obj.gz", "model"),
        ("a/model.OBJ.GZ", "model"),
        ("model.obj", "model"),
        ("model.v2.obj.gz", "model.v2"),
        ("model.gz", "model"),
        ("model", "model"),
        (".gz", ".gz"),
        ("..", ""),
    ] {
        assert_eq!(stem(path.as_ref()), expected, "{path}");
    }
}

#[test]
fn written_files_can_be_read_and_listed() {
    for (store, folder, _guard) in stores() {
        let path = folder.join("a/b/c.txt");
        assert_eq!((store.len(&path), store.exists(&path)), (None, false));
        store.write(&path, b"first").unwrap();
        store.write(&path, b"second").unwrap();
        assert_eq!(store.read(&path).unwrap(), b"second");
        assert_eq!(store.read_up_to(&path, 3).unwrap(), b"sec");
        assert_eq!(store.len(&path), Some(6));
        assert_eq!(
            store.list(&folder.join("a/b")).unwrap(),
            std::slice::from_ref(&path)
        );
        assert_eq!(
            files_below(&*store, &folder).unwrap(),
            std::slice::from_ref(&path)
        );
        assert!(store.is_folder(&folder.join("a")) && !store.is_file(&folder.join("a")));
        let round = folder.join("a/../a/b/c.txt");
        assert_eq!(
            store.canonical(&round).unwrap(),
            store.canonical(&path).unwrap()
        );
    }
}

#[test]
fn a_file_that_is_not_committed_leaves_nothing() {
    for (store, folder, _guard) in stores() {
        let path = folder.join("a.txt");
        store.write(&path, b"old").unwrap();
        let mut file = store.create(&path).unwrap();
        file.write_all(b"half").unwrap();
        drop(file);
        assert_eq!(store.read(&path).unwrap(), b"old");
        let mut file = store.create(&path).unwrap();
        file.write_all(b"new").unwrap();
        file.sync().unwrap();
        file.commit().unwrap();
        assert_eq!(store.read(&path).unwrap(), b"new");
        assert_eq!(store.list(&folder).unwrap().len(), 1);
    }
}

#[test]
fn errors_name_the_path() {
    for (store, folder, _guard) in stores() {
        let path = folder.join("missing/a.txt");
        let shown = path.display();
        let error = store.read(&path).unwrap_err().to_string();
        assert!(error.starts_with(&format!("cannot read {shown}: ")));
        let error = store.create(&path).err().unwrap().to_string();
        assert_eq!(
            error,
            format!("cannot write {shown}: the folder does not exist")
        );
        assert!(store.list(&folder.join("missing")).is_err());
        assert!(store.read(&folder).is_err() && store.create(&folder).is_err());
        assert!(store.canonical(&path).is_err());
        store.write(&folder.join("file"), b"").unwrap();
        assert!(store.make_folder(&folder.join("file/below")).is_err());
    }
}

#[test]
fn renaming_replaces_a_file_and_writing_changes_its_entry() {
    for (store, folder, _guard) in stores() {
        let [a, b] = ["a", "b"].map(|name| folder.join(name));
        store.write(&a, b"1").unwrap();
        store.write(&b, b"2").unwrap();
        store.rename(&a, &b).unwrap();
        assert_eq!(
            (store.exists(&a), store.read(&b).unwrap()),
            (false, vec![b'1'])
        );
        assert!(store.rename(&a, &b).is_err());
    }
    let memory = Memory::default();
    let path = Path::new("a");
    memory.write(path, b"1").unwrap();
    let before = memory.entry(path);
    memory.write(path, b"2").unwrap();
    assert_ne!(memory.entry(path), before);
}

#[test]
fn temporary_folders_are_removed_with_their_content() {
    for (store, folder, _guard) in stores() {
        let inside = folder.join("out");
        let one = TemporaryFolder::new(&*store, Some(&inside)).unwrap();
        let two = TemporaryFolder::new(&*store, Some(&inside)).unwrap();
        assert_ne!(one.path(), two.path());
        store.write(&one.path().join("deep/a"), b"1").unwrap();
        drop((one, two));
        assert_eq!(store.list(&inside).unwrap(), Vec::<PathBuf>::new());
        let path = TemporaryFolder::new(&*store, None)
            .unwrap()
            .path()
            .to_owned();
        assert!(!store.exists(&path));
    }
}

#[test]
fn a_large_file_is_read_completely_and_in_part() {
    let (store, folder, _guard) = stores().into_iter().nth(1).unwrap();
    let bytes: Vec<u8> = (0..3_500_000_u32)
        .map(|i| i.wrapping_mul(2_654_435_761).to_be_bytes()[0])
        .collect();
    let path = folder.join("large");
    store.write(&path, &bytes).unwrap();
    assert!(store.read(&path).unwrap() == bytes);
    assert!(store.read_up_to(&path, 2_000_001).unwrap() == bytes[..2_000_001]);
}

#[cfg(unix)]
#[test]
fn a_link_is_replaced_by_create_and_kept_by_replace() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let folder = tempfile::tempdir().unwrap();
    let [file, link] = ["file", "link"].map(|name| folder.path().join(name));
    fs::write(&file, "old").unwrap();
    fs::set_permissions(&file, fs::Permissions::from_mode(0o640)).unwrap();
    symlink(&file, &link).unwrap();
    assert!(Disk.is_link(&link) && !Disk.is_link(&file));

    replace(&link, b"new").unwrap();
    assert!(Disk.is_link(&link));
    assert_eq!(fs::read(&file).unwrap(), b"new");
    assert_eq!(
        fs::metadata(&file).unwrap().permissions().mode() & 0o777,
        0o640
    );

    Disk.write(&link, b"own").unwrap();
    assert!(!Disk.is_link(&link));
    assert_eq!(fs::read(&file).unwrap(), b"new");
    assert!(replace(&folder.path().join("none"), b"").is_err());
}

#[cfg(target_os = "linux")]
#[test]
fn the_error_of_a_folder_that_accepts_no_files_does_not_name_the_temporary_file() {
    // Even the superuser cannot create files in `/proc`.
    let error = Disk.create(Path::new("/proc/a.obj")).err().unwrap();
    let text = error.to_string();
    assert!(
        text.starts_with("cannot write /proc/a.obj: ") && !text.contains("meshwright-"),
        "{text}"
    );
}
