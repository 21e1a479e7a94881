//! How many local edits a second, with all their checks?

mod common;

use std::time::Duration;

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use mesh::{EdgeId, Mesh};

/// Flipping every edge, and splitting every edge, of a torus of a million triangles. In random order
/// each edit waits for memory. Flipping in order of ids would heap all edges onto a few vertices.
fn every_edge_once(c: &mut Criterion) {
    let mesh = common::torus();
    let in_order: Vec<EdgeId> = mesh.edges().collect();
    let shuffled = common::shuffled(in_order.clone());

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

criterion_group!(benches, every_edge_once);
criterion_main!(benches);
