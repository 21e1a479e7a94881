//! Checks that OBJ files with very many names on a line are read quickly.

use std::time::{Duration, Instant};

use mesh_io::Loaded;

use crate::{Folder, read};

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

/// Reads an OBJ file with this text and with a library `a.mtl`, and checks that reading takes little time.
fn read_quickly(text: &str, library: &str) -> Loaded {
    let folder = Folder::new();
    folder.with("a.mtl", library);
    let path = folder.with("a.obj", text);
    let start = Instant::now();
    let loaded = read(&path).unwrap();
    assert!(
        start.elapsed() < Duration::from_secs(5),
        "{:?}",
        start.elapsed()
    );
    loaded
}

#[test]
fn a_line_of_many_libraries_is_cut() {
    let names: Vec<String> = (0..200_000).map(|i| format!("b{i}")).collect();
    let text = format!("mtllib {}\n{TRIANGLE}", names.join(" "));
    let notes = read_quickly(&text, "newmtl red\n").notes;
    let rest = notes.last().unwrap();
    assert!(
        rest.what.contains("names of material libraries left out"),
        "{rest}"
    );
    assert_eq!(notes.len() - 1 + rest.count, names.len());
    // A file name can contain blanks, so there are very many ways to combine the words of a line into file names.
    let line = format!("mtllib {}\n", "b ".repeat(400));
    read_quickly(&format!("{}{TRIANGLE}", line.repeat(5000)), "newmtl red\n");
}

#[test]
fn a_library_that_is_named_again_is_read_once() {
    let text = format!("{}usemtl red\n{TRIANGLE}", "mtllib a.mtl\n".repeat(500));
    let library = "newmtl red\nKd 1 0 0\n".to_owned() + &"# a comment\n".repeat(2000);
    let loaded = read_quickly(&text, &library);
    assert_eq!(loaded.objects[0].materials.len(), 1);
    assert!(loaded.notes.is_empty(), "{:?}", loaded.notes);
}
