//! Tests of files that are compressed with gzip.

use std::io::Write as _;
use std::path::Path;

use flate2::Compression;
use flate2::write::GzEncoder;
use geometry::shapes;
use mesh_io::{Format, ReadError, ReadOptions, WriteOptions};
use scene::{Object, Scene};
use store::{Memory, Store};

fn gzipped(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

#[test]
fn compressed_files_have_the_content_of_plain_files() {
    let mut scene = Scene::new();
    scene.insert(Object::mesh("cube", shapes::cube())).unwrap();
    let options = WriteOptions {
        provenance: Some("meshwright 1.2.3".to_owned()),
        ..WriteOptions::default()
    };
    for extension in ["obj", "gltf", "ply", "stl", "off"] {
        let store = Memory::default();
        store.make_folder("out".as_ref()).unwrap();
        let [plain, packed] = ["", ".gz"].map(|end| format!("out/cube.{extension}{end}"));
        let [plain, packed] = [&plain, &packed].map(|path| Path::new(path.as_str()));
        let first = mesh_io::write(&store, plain, &scene, &options).unwrap();
        let second = mesh_io::write(&store, packed, &scene, &options).unwrap();
        assert_eq!(first.losses, second.losses);
        // The decompressed bytes equal the bytes of a file that is written without compression.
        let bytes = store.read(packed).unwrap();
        let mut content = Vec::new();
        let mut decoder = flate2::read::GzDecoder::new(&bytes[..]);
        std::io::Read::read_to_end(&mut decoder, &mut content).unwrap();
        assert_eq!(content, store.read(plain).unwrap(), "{extension}");
        let sizes = second.files.iter().map(|path| store.len(path).unwrap());
        assert_eq!(second.bytes, sizes.sum::<u64>());

        let read = |path| mesh_io::read(&store, path, &ReadOptions::default()).unwrap();
        assert_eq!(read(packed).objects, read(plain).objects, "{extension}");
        let peek = |path| mesh_io::peek(&store, path, &ReadOptions::default()).unwrap();
        assert_eq!(peek(packed), peek(plain), "{extension}");
        let provenance = |path| mesh_io::provenance(&store, path).unwrap();
        assert_eq!(provenance(packed), provenance(plain), "{extension}");
    }
}

#[test]
fn compressed_collada_is_read() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/fuzz/corpus/dae/cube.dae");
    let store = Memory::default();
    let bytes = std::fs::read(path).unwrap();
    store.write("a.dae".as_ref(), &bytes).unwrap();
    store.write("a.dae.gz".as_ref(), &gzipped(&bytes)).unwrap();
    let read = |path: &str| mesh_io::read(&store, path.as_ref(), &ReadOptions::default()).unwrap();
    assert_eq!(read("a.dae.gz").objects, read("a.dae").objects);
}

#[test]
fn a_material_library_beside_a_compressed_file_is_found() {
    let store = Memory::default();
    let obj = b"mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n";
    store.write("a.obj.gz".as_ref(), &gzipped(obj)).unwrap();
    store
        .write("a.mtl".as_ref(), b"newmtl m\nKd 1 0 0\n")
        .unwrap();
    let found = mesh_io::read(&store, "a.obj.gz".as_ref(), &ReadOptions::default()).unwrap();
    assert_eq!(found.notes, []);
    assert_eq!(found.objects[0].name, "a");
    assert_eq!(
        found.objects[0].materials[0].base_color,
        [1.0, 0.0, 0.0, 1.0]
    );
    // The name of the material library is the name of the written file with `.mtl` instead of `.obj.gz`.
    let mut scene = Scene::new();
    scene.insert(found.objects[0].clone()).unwrap();
    let path = Path::new("b.obj.gz");
    let report = mesh_io::write(&store, path, &scene, &WriteOptions::default()).unwrap();
    assert_eq!(report.files, ["b.mtl", "b.obj.gz"].map(Path::new));
}

#[test]
fn a_bomb_is_refused() {
    let store = Memory::default();
    let bomb = gzipped(&vec![b'\n'; 1 << 24]);
    assert!(bomb.len() < 1 << 15);
    store.write("a.obj.gz".as_ref(), &bomb).unwrap();
    let options = ReadOptions {
        budget: Some(1 << 20),
        ..ReadOptions::default()
    };
    let errors = [
        mesh_io::read(&store, "a.obj.gz".as_ref(), &options)
            .map(|_| ())
            .unwrap_err(),
        mesh_io::peek(&store, "a.obj.gz".as_ref(), &options)
            .map(|_| ())
            .unwrap_err(),
    ];
    for error in errors {
        assert!(matches!(&error, ReadError::Compressed { .. }), "{error}");
        assert!(
            error
                .to_string()
                .contains("larger than the memory budget of 1.0 MiB"),
            "{error}"
        );
    }
}

#[test]
fn damaged_files_are_errors() {
    let whole = gzipped(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let store = Memory::default();
    let path = Path::new("a.obj.gz");
    for n in 0..whole.len() {
        store.write(path, &whole[..n]).unwrap();
        let read = mesh_io::read(&store, path, &ReadOptions::default());
        assert!(read.is_err(), "{n} bytes");
        let _ = mesh_io::peek(&store, path, &ReadOptions::default());
    }
    for i in 0..whole.len() {
        let mut changed = whole.clone();
        changed[i] ^= 1 << (i % 8);
        store.write(path, &changed).unwrap();
        let _ = mesh_io::read(&store, path, &ReadOptions::default());
    }
}

#[test]
fn binary_formats_are_not_compressed() {
    for format in [Format::Glb, Format::Mws] {
        let name = format!("a.{}.gz", format.extension());
        assert_eq!(Format::from_path(Path::new(&name)), None);
    }
}
