//! Tests of behavior that is the same for all formats: file names, folders, and invalid files.

use std::fs;

use geometry::shapes;
use mesh_io::{ReadError, ReadOptions, WriteError, WriteOptions};
use scene::{Geometry, Object};

use crate::{Folder, only, read, scene, write};

#[test]
fn unknown_extensions_list_the_known_ones() {
    let folder = Folder::new();
    let path = folder.with("a.xyz", "solid");
    let error = read(&path).unwrap_err();
    assert!(
        error
            .to_string()
            .contains(&mesh_io::Format::readable_extensions()),
        "{error}"
    );
    let scene = scene([]);
    let error = mesh_io::write(&store::Disk, &path, &scene, &WriteOptions::default()).unwrap_err();
    assert!(matches!(error, WriteError::UnknownFormat { .. }));
}

#[test]
fn missing_files_and_folders_are_named() {
    let folder = Folder::new();
    for name in ["no.obj", "no.glb", "no.gltf", "no.bez", "no.bzc"] {
        let path = folder.path(name);
        for error in [
            read(&path).unwrap_err(),
            mesh_io::peek(&store::Disk, &path, &ReadOptions::default()).unwrap_err(),
        ] {
            assert!(matches!(error, ReadError::Io { .. }), "{error}");
            assert_eq!(error.path(), path);
        }
        fs::create_dir(&path).unwrap();
        assert!(read(&path).is_err());
        let scene = scene([]);
        assert!(mesh_io::write(&store::Disk, &path, &scene, &WriteOptions::default()).is_err());
    }
}

#[test]
fn a_failed_write_leaves_the_old_file() {
    let folder = Folder::new();
    let path = folder.with("a.glb", "old");
    let patches = scene([Object::new("p", Geometry::Patches(Vec::new()))]);
    assert!(mesh_io::write(&store::Disk, &path, &patches, &WriteOptions::default()).is_err());
    assert_eq!(fs::read(&path).unwrap(), b"old");
    assert_eq!(folder.count(), 1);

    let nowhere = folder.path("no/such/a.obj");
    let cube = scene([Object::mesh("c", shapes::cube())]);
    let error =
        mesh_io::write(&store::Disk, &nowhere, &cube, &WriteOptions::default()).unwrap_err();
    assert!(
        error.to_string().contains(&nowhere.display().to_string()),
        "{error}"
    );
}

#[test]
fn bezier_files_survive_a_round_trip() {
    let folder = Folder::new();
    let line = bezier::Curve::new(vec![glam::DVec2::ZERO, glam::DVec2::new(0.1, -1e-12)]).unwrap();
    let curve = Object::new("c", Geometry::Curve(line));
    let path = folder.path("c.bzc");
    write(&path, [curve.clone()]);
    assert_eq!(only(&path), curve);
    assert!(
        mesh_io::write(
            &store::Disk,
            &folder.path("c.bez"),
            &scene([curve]),
            &WriteOptions::default()
        )
        .is_err()
    );

    let patch = bezier::Patch::new([[glam::DVec3::ONE; 4]; 4]).unwrap();
    let patches = |name: &str| Object::new(name, Geometry::Patches(vec![patch]));
    let path = folder.path("p.bez");
    assert!(write(&path, [patches("p")]).losses.is_empty());
    assert_eq!(only(&path), patches("p"));
    assert_eq!(write(&path, [patches("a"), patches("b")]).losses.len(), 2);
    assert_eq!(only(&path).geometry, Geometry::Patches(vec![patch; 2]));
    assert!(
        mesh_io::write(
            &store::Disk,
            &folder.path("p.bzc"),
            &scene([patches("p")]),
            &WriteOptions::default()
        )
        .is_err()
    );
}

#[test]
fn errors_of_text_files_show_path_line_and_column() {
    let folder = Folder::new();
    for (name, text, place) in [
        ("a.obj", "v 0 0 0\nf 1 2 3\n", "a.obj:2:5: "),
        ("a.bez", "1\n0 0 x\n", "a.bez:1:1: "),
        ("a.bzc", "1\n0 x\n", "a.bzc:2:3: "),
        ("a.gltf", "{\n  \"asset\": }", "a.gltf:2:12: "),
    ] {
        let error = read(&folder.with(name, text)).unwrap_err();
        assert!(error.to_string().contains(place), "{error}");
    }
}
