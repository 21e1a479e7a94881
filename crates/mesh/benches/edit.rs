//! How many local edits a second, with all their checks?

use std::time::Duration;

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use mesh::{EdgeId, Mesh, shapes};

/// Flipping every edge, and splitting every edge, of a torus of a million triangles. In random order
/// each edit waits for memory. Flipping in order of ids would heap all edges onto a few vertices.
fn every_edge_once(c: &mut Criterion) {
    let mesh = torus();
    let in_order: Vec<EdgeId> = mesh.edges().collect();
    let shuffled = shuffled(in_order.clone());

    let mut group = c.benchmark_group("edit a mesh of 1 M triangles");
    group.sample_size(10).warm_up_time(Duration::from_secs(1));
    group.throughput(Throughput::Elements(in_order.len() as u64));
    let start = || mesh.clone();
    group.bench_function("flip every edge, random order", |b| {
        b.iter_batched(start, |mesh| flip(mesh, &shuffled), BatchSize::PerIteration);
    });
    group.bench_function("split every edge, random order", |b| {
        b.iter_batched(
            start,
            |mesh| split(mesh, &shuffled),
            BatchSize::PerIteration,
        );
    });
    group.bench_function("split every edge, order of ids", |b| {
        b.iter_batched(
            start,
            |mesh| split(mesh, &in_order),
            BatchSize::PerIteration,
        );
    });
    group.finish();
}

/// Flips where it is legal: others are checked and refused. Returns how many were.
fn flip(mut mesh: Mesh, edges: &[EdgeId]) -> (Mesh, usize) {
    let mut refused = 0;
    for (i, &e) in edges.iter().enumerate() {
        mesh.fetch_ahead(edges, i);
        refused += usize::from(mesh.flip_edge(e).is_err());
    }
    (mesh, refused)
}

fn split(mut mesh: Mesh, edges: &[EdgeId]) -> Mesh {
    for (i, &e) in edges.iter().enumerate() {
        mesh.fetch_ahead(edges, i);
        mesh.split_edge(e, 0.5).expect("any edge can be split");
    }
    mesh
}

/// The edges in a random order, the same in every run: Fisher and Yates with a 64-bit linear
/// congruential generator (Knuth, "The Art of Computer Programming", volume 2, 1997, 3.3.4).
fn shuffled(mut edges: Vec<EdgeId>) -> Vec<EdgeId> {
    let mut state = 1_u64;
    for i in (1..edges.len()).rev() {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        let high = usize::try_from(state >> 33).expect("31 bits");
        edges.swap(i, high % (i + 1));
    }
    edges
}

/// A torus of a million triangles.
fn torus() -> Mesh {
    shapes::fans(&shapes::torus(1000, 500, 2.0, 1.0))
}

criterion_group!(benches, every_edge_once);
criterion_main!(benches);
