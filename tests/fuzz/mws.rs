//! Reads arbitrary bytes as a `.mws` file. Either the file is refused, or its meshes are valid.

#![no_main]

use libfuzzer_sys::fuzz_target;
use mesh_io::ReadOptions;

fuzz_target!(|bytes: &[u8]| {
    let path = "a.mws".as_ref();
    if let Ok(loaded) = mesh_io::read_bytes(&store::Disk, path, bytes.to_vec(), &ReadOptions::default()) {
        for mesh in loaded.objects.iter().filter_map(|object| object.as_mesh()) {
            assert_eq!(mesh.defects(), []);
        }
    }
});
