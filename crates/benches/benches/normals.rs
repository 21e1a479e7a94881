//! Compares the time to compute the vertex normals of a mesh of a million triangles with the time to copy its positions
//! and normals.

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use geometry::shapes;
use mesh::Mesh;
use ops_vertices::{Weight, normals};

fn million_triangles(c: &mut Criterion) {
    let mesh = torus();
    let mut group = c.benchmark_group("vertex normals of 1 M triangles");
    group
        .sample_size(20)
        .throughput(Throughput::Elements(mesh.n_faces() as u64));
    for weight in [Weight::Area, Weight::Angle, Weight::Uniform] {
        group.bench_function(format!("{weight:?}"), |b| b.iter(|| normals(&mesh, weight)));
    }
    let bytes = vec![1_u8; 2 * size_of_val(mesh.positions())];
    group.bench_function("bytes alone: copy of positions and normals", |b| {
        b.iter(|| black_box(&bytes).clone());
    });
    group.finish();
}

/// A torus of 1000 x 500 squares, each cut into two triangles.
fn torus() -> Mesh {
    shapes::fans(&shapes::torus(1000, 500, 3.0, 1.0))
}

criterion_group!(benches, million_triangles);
criterion_main!(benches);
