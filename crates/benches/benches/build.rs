//! Measures how many triangles per second are built into a mesh. For comparison, also measures the time to copy the
//! bytes of the mesh.
//!
//! The input is a torus of a million triangles and half a million vertices. Vertices are numbered row by row, so that
//! neighbors are close in memory. The input is in memory before the measured time starts. The mesh is written to newly
//! allocated memory.
//!
//! - `build`: builds the mesh from an array of the vertices of all corners, and an array of offsets. The offset of a
//!   face is the index of its first corner.
//! - `from_polygons`: builds the mesh from one list of corners for each triangle. The library first copies these lists
//!   into offsets and corners.
//! - `shuffled`: the same triangles and vertices in random order, so that neighbors are far apart in memory.
//! - `half reversed`: every second triangle has the opposite orientation. The library builds the mesh, searches for the
//!   triangles to reverse, reverses them, and builds the mesh again.

use std::hint::black_box;
use std::time::Duration;

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use mesh::build::{NonManifold, build};
use mesh::{DVec3, Mesh};

fn a_million_triangles(c: &mut Criterion) {
    let (positions, triangles) = torus();
    let offsets: Vec<u32> = (0..).step_by(3).take(triangles.len() + 1).collect();
    let corners = triangles.as_flattened();
    let built = |positions: Vec<DVec3>| {
        build(positions, &offsets, corners, NonManifold::Refuse).expect("a torus is a manifold")
    };
    let (shuffled_positions, shuffled) = shuffled(&positions, &triangles);
    let mut half = triangles.clone();
    half.iter_mut().step_by(2).for_each(|t| t.swap(1, 2));
    let bytes = vec![1_u8; built(positions.clone()).mesh.bytes()];

    let mut group = c.benchmark_group("build 1 M triangles");
    group.sample_size(10).warm_up_time(Duration::from_secs(1));
    group.throughput(Throughput::Elements(triangles.len() as u64));
    group.bench_function("build", |b| {
        b.iter_batched(|| positions.clone(), built, BatchSize::PerIteration);
    });
    group.bench_function("from_polygons", |b| {
        let from_polygons = |positions| Mesh::from_polygons(positions, &triangles);
        b.iter_batched(|| positions.clone(), from_polygons, BatchSize::PerIteration);
    });
    for (name, positions, triangles) in [
        ("shuffled", &shuffled_positions, &shuffled),
        ("half reversed", &positions, &half),
    ] {
        let corners = triangles.as_flattened();
        let built = |positions| build(positions, &offsets, corners, NonManifold::Split);
        group.bench_function(name, |b| {
            b.iter_batched(|| positions.clone(), built, BatchSize::PerIteration);
        });
    }
    // The copy is written to newly allocated memory, because the arrays of a built mesh are newly allocated, too.
    group.bench_function("bytes alone: copy of the mesh", |b| {
        b.iter_batched(
            || (),
            |()| black_box(&bytes).clone(),
            BatchSize::PerIteration,
        );
    });
    group.finish();
}

/// A torus of a million triangles.
fn torus() -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let quads = geometry::shapes::torus(1000, 500, 2.0, 1.0);
    let triangles = quads.faces().flat_map(|f| {
        let mut v = quads.face_vertices(f).map(mesh::VertexId::index);
        let v = [(); 4].map(|()| v.next().expect("a quadrilateral"));
        let v = v.map(|v| u32::try_from(v).expect("few vertices"));
        [[v[0], v[1], v[2]], [v[0], v[2], v[3]]]
    });
    (quads.positions().to_vec(), triangles.collect())
}

/// Returns the positions and the triangles of the same mesh, with vertices and triangles in random order.
fn shuffled(positions: &[DVec3], triangles: &[[u32; 3]]) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let mut order: Vec<u32> = (0..).take(positions.len()).collect();
    shuffle(&mut order);
    let mut moved = positions.to_vec();
    for (position, &v) in positions.iter().zip(&order) {
        moved[v as usize] = *position;
    }
    let mut triangles: Vec<[u32; 3]> = triangles
        .iter()
        .map(|t| t.map(|v| order[v as usize]))
        .collect();
    shuffle(&mut triangles);
    (moved, triangles)
}

/// Puts values into a random order, with a linear congruential generator.
fn shuffle<T>(values: &mut [T]) {
    let mut state = 1_u64;
    for i in (1..values.len()).rev() {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        let number = usize::try_from(state >> 33).expect("31 bits");
        values.swap(i, number % (i + 1));
    }
}

criterion_group!(benches, a_million_triangles);
criterion_main!(benches);
