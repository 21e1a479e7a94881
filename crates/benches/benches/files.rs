//! Measures how fast a mesh of a million triangles is read and written, in bytes per second. For comparison, also
//! measures how fast the same bytes are read and written without a conversion.
//!
//! The readers of other libraries are measured in the same run, on the same files. `tobj` and `mesh-loader` return flat
//! arrays, `alum` returns a half-edge mesh, and the `gltf` crate returns accessors. The benchmark copies the values of
//! the glTF accessors into arrays. If `python3 -c "import rapidobj"` works (`pip install rapidobj`), the C++ reader
//! rapidobj is measured too. rapidobj uses all threads, returns arrays of 32-bit numbers, and triangulates polygons.
//!
//! Most programs write OBJ files with six decimals. Meshwright writes enough digits to restore the same `f64`. The
//! benchmark reads both kinds of OBJ files.

use std::fs;
use std::path::Path;
use std::process::Command;

use criterion::measurement::WallTime;
use criterion::{
    BatchSize, BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main,
};
use geometry::shapes;
use mesh::Mesh;
use mesh_io::{ReadOptions, WriteOptions, read, read_polygons, write};
use scene::{Object, Scene};
use store::Disk;

type Group<'a> = BenchmarkGroup<'a, WallTime>;

fn million_triangles(c: &mut Criterion) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let [exact, rounded] = [torus(), rounded(torus())].map(scene);
    for (scene, digits, ending) in [
        (&rounded, "six digits", "obj"),
        (&exact, "all digits", "obj"),
        (&exact, "32 bits", "glb"),
    ] {
        let path = folder.path().join(format!("torus.{ending}"));
        save(&path, scene);
        let bytes = fs::read(&path).expect("the file was written above");
        let mut group = c.benchmark_group(format!("1 M triangles as {ending}, {digits}"));
        group
            .sample_size(10)
            .throughput(Throughput::Bytes(bytes.len() as u64));
        measure(&mut group, "read, bytes alone", || fs::read(&path));
        measure(&mut group, "read to arrays", || {
            read_polygons(&Disk, &path, &ReadOptions::default()).expect("the file was written")
        });
        measure(&mut group, "read to a connected mesh", || {
            read(&Disk, &path, &ReadOptions::default()).expect("the file was written")
        });
        match ending {
            "obj" => obj_peers(&mut group, &path),
            _ => gltf_peer(&mut group, &path),
        }
        measure(&mut group, "write, bytes alone", || {
            fs::write(&path, &bytes)
        });
        measure(&mut group, "write", || save(&path, scene));
        if ending == "obj" {
            let mesh = alum::PolyMeshF64::load_obj(&path).expect("the mesh is a manifold");
            measure(&mut group, "write, alum", || mesh.save_obj(&path));
        }
        group.finish();
    }
}

/// Measures how fast other libraries read an OBJ file.
fn obj_peers(group: &mut Group, path: &Path) {
    measure(group, "read to arrays, tobj", || {
        tobj::load_obj(path, &tobj::LoadOptions::default()).expect("the file is OBJ")
    });
    measure(group, "read to arrays, mesh-loader", || {
        mesh_loader::Loader::default()
            .load_obj(path)
            .expect("the file is OBJ")
    });
    let python = |repeats: u64| {
        let program = "import sys, time, rapidobj\n\
                       start = time.perf_counter()\n\
                       for _ in range(int(sys.argv[2])): assert rapidobj.parse_obj(sys.argv[1]).ok\n\
                       print(time.perf_counter() - start)";
        let mut command = Command::new("python3");
        command.args(["-c", program]).arg(path);
        let output = command.arg(repeats.to_string()).output().ok()?;
        let seconds = String::from_utf8(output.stdout).ok()?;
        seconds.trim().parse().ok()
    };
    if python(0).is_some() {
        group.bench_function("read to arrays, rapidobj", |b| {
            b.iter_custom(|n| {
                let seconds = python(n).expect("rapidobj was imported before");
                std::time::Duration::from_secs_f64(seconds)
            });
        });
    }
    measure(group, "read to a connected mesh, alum", || {
        alum::PolyMeshF64::load_obj(path).expect("the mesh is a manifold")
    });
}

/// Reads GLB with the `gltf` crate.
fn gltf_peer(group: &mut Group, path: &Path) {
    measure(group, "read to arrays, gltf", || {
        let gltf::Gltf { document, blob } = gltf::Gltf::open(path).expect("the file is glTF");
        let mesh = document.meshes().next().expect("there is a mesh");
        let primitive = mesh.primitives().next().expect("the mesh has triangles");
        let reader = primitive.reader(|_| blob.as_deref());
        let positions: Vec<[f32; 3]> = reader.read_positions().expect("positions exist").collect();
        let indices: Vec<u32> = reader
            .read_indices()
            .expect("indices exist")
            .into_u32()
            .collect();
        (positions, indices)
    });
}

/// Measures single calls. The time to drop the results is not included.
fn measure<T>(group: &mut Group, name: &str, mut call: impl FnMut() -> T) {
    group.bench_function(name, |b| {
        b.iter_batched(|| (), |()| call(), BatchSize::PerIteration);
    });
}

fn save(path: &Path, scene: &Scene) {
    write(&Disk, path, scene, &WriteOptions::default()).expect("the folder can be written");
}

fn scene(mesh: Mesh) -> Scene {
    let mut scene = Scene::new();
    scene
        .insert(Object::mesh("torus", mesh))
        .expect("the first object");
    scene
}

/// A torus of 1000 x 500 squares, each cut into two triangles.
fn torus() -> Mesh {
    shapes::fans(&shapes::torus(1000, 500, 3.0, 1.0))
}

/// Rounds positions to six decimals.
fn rounded(mut mesh: Mesh) -> Mesh {
    for position in mesh.positions_mut() {
        *position = position.map(|x| (x * 1e6).round() / 1e6);
    }
    mesh
}

criterion_group!(benches, million_triangles);
criterion_main!(benches);
