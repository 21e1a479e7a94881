//! Measures how many local edits per second a step of a recipe performs, with all checks.

mod common;

use std::time::Duration;

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use mesh::{EdgeId, EditError, Mesh};
use op::{Context, Files, NoProgress, OnRefusal, edit_each};

/// Measures how long it takes to flip every edge of a torus of a million triangles, and to split every edge of this
/// torus. Edits in random order are memory-bound: they mostly wait for the memory. Flipping the edges in the order of
/// their ids is not measured, because a few vertices would get a very high valence.
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

/// Tries to flip every edge. The mesh refuses flips that are not legal.
fn flip(mesh: Mesh, edges: &[EdgeId]) -> Mesh {
    edit_every(mesh, edges, |mesh, e| mesh.flip_edge(e).map(drop))
}

fn split(mesh: Mesh, edges: &[EdgeId]) -> Mesh {
    edit_every(mesh, edges, |mesh, e| mesh.split_edge(e, 0.5).map(drop))
}

/// Edits every edge, and records each change in the journal of the mesh, so that all edits can be rolled back. A step
/// of a recipe works in the same way.
fn edit_every(
    mut mesh: Mesh,
    edges: &[EdgeId],
    edit: impl FnMut(&mut Mesh, EdgeId) -> Result<(), EditError>,
) -> Mesh {
    let files = Files::default();
    let cx = Context::new(&NoProgress, &files);
    mesh.begin();
    edit_each(&mut mesh, edges, OnRefusal::Skip, "edit", &cx, edit).expect("refusals are skipped");
    mesh.commit();
    mesh
}

criterion_group!(benches, every_edge_once);
criterion_main!(benches);
