//! Checks that images of materials are read from the folder of the model, embedded, copied, or reported as missing.

use std::path::{Path, PathBuf};

use mesh_io::{Images, Loaded, ReadOptions, WriteOptions};
use scene::{Image, Scene};
use store::{Memory, Store, files_below};

const PNG: &[u8] = b"\x89PNG\r\n\x1a\n...";
const JPEG: &[u8] = b"\xff\xd8\xff...";

/// Returns a store with these files and an OBJ file whose only material has this texture.
fn model(texture: &str, files: &[(&str, &[u8])]) -> Memory {
    let store = Memory::default();
    let obj = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n";
    let mtl = format!("newmtl m\nmap_Kd {texture}\n");
    for (path, bytes) in [("in/a.obj", obj.as_bytes()), ("in/a.mtl", mtl.as_bytes())]
        .iter()
        .chain(files)
    {
        store.write(path.as_ref(), bytes).unwrap();
    }
    store.make_folder("out".as_ref()).unwrap();
    store
}

fn read(store: &Memory, path: &str) -> Loaded {
    mesh_io::read(store, path.as_ref(), &ReadOptions::default()).unwrap()
}

/// Returns the image that the materials of a file use. There must be exactly one such image.
fn image(loaded: &Loaded) -> Image {
    let textures: Vec<_> = loaded.objects[0]
        .materials
        .iter()
        .flat_map(scene::Material::textures)
        .collect();
    assert_eq!(textures.len(), 1);
    textures[0].image.clone()
}

/// Converts a file, and returns the names of the files in the folder `out`.
fn convert(store: &Memory, from: &str, to: &str, images: Option<Images>) -> Vec<String> {
    let mut scene = Scene::new();
    for object in read(store, from).objects {
        scene.insert(object).unwrap();
    }
    let options = WriteOptions {
        images,
        ..WriteOptions::default()
    };
    let report = mesh_io::write(store, to.as_ref(), &scene, &options).unwrap();
    assert_eq!(report.losses, []);
    assert_eq!(
        report.files.last().map(PathBuf::as_path),
        Some(Path::new(to))
    );
    let files = files_below(store, "out".as_ref()).unwrap();
    files
        .iter()
        .map(|path| path.strip_prefix("out").unwrap().display().to_string())
        .collect()
}

fn loaded(path: &str, bytes: &[u8]) -> Image {
    let (path, bytes) = (path.to_owned(), bytes.into());
    Image::Loaded { path, bytes }
}

#[test]
fn a_converted_glb_contains_the_image_beside_the_source() {
    let store = model("textures/x.png", &[("in/textures/x.png", PNG)]);
    assert_eq!(
        image(&read(&store, "in/a.obj")),
        loaded("textures/x.png", PNG)
    );
    assert_eq!(convert(&store, "in/a.obj", "out/a.glb", None), ["a.glb"]);
    let mime = "image/png".to_owned();
    let bytes = PNG.into();
    assert_eq!(
        image(&read(&store, "out/a.glb")),
        Image::Embedded { mime, bytes }
    );
}

#[test]
fn images_are_copied_beside_text_files() {
    for (to, files) in [
        ("out/b.gltf", ["b.bin", "b.gltf", "textures/x.png"]),
        ("out/b.obj", ["b.mtl", "b.obj", "textures/x.png"]),
    ] {
        let store = model("textures/x.png", &[("in/textures/x.png", PNG)]);
        assert_eq!(convert(&store, "in/a.obj", to, None), files);
        let back = read(&store, to);
        assert_eq!(back.notes, []);
        assert_eq!(image(&back), loaded("textures/x.png", PNG));
    }
}

#[test]
fn policies_replace_the_default() {
    let store = || model("x.png", &[("in/x.png", PNG)]);
    let of = |to, images| convert(&store(), "in/a.obj", to, Some(images));
    assert_eq!(of("out/b.glb", Images::Copy), ["b.glb", "x.png"]);
    assert_eq!(of("out/b.glb", Images::Keep), ["b.glb"]);
    assert_eq!(of("out/b.gltf", Images::Embed), ["b.bin", "b.gltf"]);
    assert_eq!(of("out/b.obj", Images::Keep), ["b.mtl", "b.obj"]);
}

#[test]
fn embedded_images_become_files_of_obj() {
    let store = model("x.jpg", &[("in/x.jpg", JPEG)]);
    convert(&store, "in/a.obj", "in/b.glb", None);
    let files = convert(&store, "in/b.glb", "out/c.obj", None);
    assert_eq!(files, ["c.jpg", "c.mtl", "c.obj"]);
    assert_eq!(image(&read(&store, "out/c.obj")), loaded("c.jpg", JPEG));
}

#[test]
fn a_different_image_or_file_with_the_same_name_is_not_replaced() {
    let store = model("x.png", &[("in/x.png", PNG), ("out/x.png", b"other")]);
    let files = convert(&store, "in/a.obj", "out/b.obj", None);
    assert_eq!(files, ["b.mtl", "b.obj", "x.2.png", "x.png"]);
    assert_eq!(store.read("out/x.png".as_ref()).unwrap(), b"other");
    // If the conversion is repeated, the copy of the image already exists and is not written again.
    assert_eq!(convert(&store, "in/a.obj", "out/b.obj", None), files);
    // An image with the name of the written model is renamed, so it does not replace the model.
    let store = model("b.obj", &[("in/b.obj", PNG)]);
    let files = convert(&store, "in/a.obj", "out/b.obj", None);
    assert_eq!(files, ["b.2.obj", "b.mtl", "b.obj"]);
}

#[test]
fn converting_in_place_keeps_the_image() {
    let store = model("x.png", &[("in/x.png", PNG)]);
    convert(&store, "in/a.obj", "in/b.gltf", None);
    assert_eq!(image(&read(&store, "in/b.gltf")), loaded("x.png", PNG));
}

#[test]
fn images_beside_a_material_library_are_found() {
    let store = model("unused.png", &[("in/unused.png", PNG)]);
    let obj = "mtllib sub/a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n";
    let files: [(&str, &[u8]); 3] = [
        ("in/c.obj", obj.as_bytes()),
        ("in/sub/a.mtl", b"newmtl m\nmap_Kd ../x/y.png\n"),
        ("in/x/y.png", PNG),
    ];
    for (path, bytes) in files {
        store.write(path.as_ref(), bytes).unwrap();
    }
    assert_eq!(image(&read(&store, "in/c.obj")), loaded("x/y.png", PNG));
}

#[test]
fn missing_and_unsafe_images_are_notes_with_the_path() {
    for (texture, why) in [
        ("x.png", "the file in/x.png does not exist"),
        ("../secret.png", "leads out of the folder of the file"),
        (
            "/etc/x.png",
            "is absolute, expected a path inside the folder of the file",
        ),
        ("http://example.com/x.png", "names a drive or a scheme"),
        ("a.mtl", "it is not an image"),
    ] {
        let store = model(texture, &[("secret.png", PNG)]);
        let found = read(&store, "in/a.obj");
        let expected = format!("in/a.obj: 1 image `{texture}` left out: {why}");
        assert_eq!(found.notes[0].to_string(), expected);
        assert_eq!(image(&found), Image::File(texture.to_owned()));
        // The path of an image is written even if the image is missing.
        convert(&store, "in/a.obj", "out/b.glb", None);
        assert_eq!(
            image(&read(&store, "out/b.glb")),
            Image::File(texture.to_owned())
        );
        let strict = ReadOptions {
            strict: true,
            ..ReadOptions::default()
        };
        assert!(mesh_io::read(&store, "in/a.obj".as_ref(), &strict).is_err());
    }
}

#[test]
fn the_total_size_of_images_is_limited() {
    let store = model("x.png", &[("in/x.png", PNG)]);
    let options = ReadOptions {
        budget: Some(PNG.len() as u64 - 1),
        ..ReadOptions::default()
    };
    let found = mesh_io::read(&store, "in/a.obj".as_ref(), &options).unwrap();
    assert!(found.notes[0].what.contains("exceed the memory budget"));
}

#[cfg(unix)]
#[test]
fn a_copied_image_does_not_follow_a_link_out_of_the_folder() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    for name in ["in/textures", "out", "elsewhere"] {
        std::fs::create_dir_all(at(name)).unwrap();
    }
    let memory = model("textures/x.png", &[]);
    for name in ["in/a.obj", "in/a.mtl"] {
        std::fs::write(at(name), memory.read(name.as_ref()).unwrap()).unwrap();
    }
    std::fs::write(at("in/textures/x.png"), PNG).unwrap();
    std::os::unix::fs::symlink("../elsewhere", at("out/textures")).unwrap();
    let mut scene = Scene::new();
    let found = mesh_io::read(&store::Disk, &at("in/a.obj"), &ReadOptions::default()).unwrap();
    scene.insert(found.objects[0].clone()).unwrap();
    let path = at("out/a.obj");
    let error = mesh_io::write(&store::Disk, &path, &scene, &WriteOptions::default());
    assert!(
        error
            .unwrap_err()
            .to_string()
            .contains("a symbolic link leads out")
    );
    assert!(!path.exists() && !at("elsewhere/x.png").exists());
}
