//! How long do reading and writing a million triangles take, in the file's bytes a second, and how far
//! is that from reading and writing the bytes alone?

use std::path::Path;

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use mesh::{Mesh, shapes};
use mesh_io::{ReadOptions, WriteOptions, read, write};
use scene::{Object, Scene};

fn million_triangles(c: &mut Criterion) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut scene = Scene::new();
    scene
        .insert(Object::mesh("torus", torus()))
        .expect("the first object");
    for ending in ["obj", "glb"] {
        let path = folder.path().join(format!("torus.{ending}"));
        save(&path, &scene);
        let bytes = std::fs::read(&path).expect("the file is there");
        let mut group = c.benchmark_group(format!("1 M triangles as {ending}"));
        group
            .sample_size(10)
            .throughput(Throughput::Bytes(bytes.len() as u64));
        group.bench_function("read to a connected mesh", |b| {
            b.iter_batched(
                || (),
                |()| read(&path, &ReadOptions::default()).expect("it was written"),
                BatchSize::PerIteration,
            );
        });
        group.bench_function("read the bytes alone", |b| b.iter(|| std::fs::read(&path)));
        group.bench_function("write", |b| b.iter(|| save(&path, &scene)));
        group.bench_function("write the bytes alone", |b| {
            b.iter(|| std::fs::write(&path, &bytes));
        });
        group.finish();
    }
}

fn save(path: &Path, scene: &Scene) {
    write(path, scene, &WriteOptions::default()).expect("the folder can be written");
}

/// A torus of 1000 x 500 squares, each cut into two triangles.
fn torus() -> Mesh {
    shapes::fans(&shapes::torus(1000, 500, 3.0, 1.0))
}

criterion_group!(benches, million_triangles);
criterion_main!(benches);
