//! Measures how many faces per second subdivision produces.
//!
//! The cage is the coarse mesh that is subdivided. At the start of the measured time, the cage is in memory. At the end
//! of the measured time, the refined mesh is in memory, with full connectivity. `tests/oracle` measures `OpenSubdiv` on
//! the same cages. For comparison with the memory bandwidth of the machine, the benchmark also copies 256 MB and fills
//! 256 MB of newly allocated memory.

use std::hint::black_box;

use criterion::measurement::WallTime;
use criterion::{
    BatchSize, BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main,
};
use geometry::shapes;
use mesh::Mesh;
use progress::NoProgress;
use rayon::prelude::*;
use subdivision::{LoopWeights, Rules, Scheme};

fn levels(c: &mut Criterion) {
    let warren = Scheme::Loop(LoopWeights::Warren);
    let cases = [
        (
            "Loop, icosahedron, 9 levels",
            warren,
            shapes::icosahedron(),
            9,
        ),
        ("Loop, 100,352 triangles, 3 levels", warren, triangles(), 3),
        (
            "Catmull-Clark, 33,451 mixed faces, 3 levels",
            Scheme::CatmullClark,
            mixed(),
            3,
        ),
    ];
    let mut group = c.benchmark_group("subdivision");
    group.sample_size(10);
    for (name, scheme, cage, levels) in &cases {
        let refine = || {
            subdivision::subdivide(cage, Rules::of(*scheme), *levels, &NoProgress)
                .expect("the scheme accepts the cage")
        };
        group.throughput(Throughput::Elements(refine().n_faces() as u64));
        group.bench_function(*name, |b| {
            b.iter_batched(|| (), |()| refine(), BatchSize::PerIteration);
        });
    }
    bandwidth(&mut group);
    group.finish();
}

/// Measures how fast bytes are copied from one array to another, and how fast newly allocated memory is filled.
fn bandwidth(group: &mut BenchmarkGroup<WallTime>) {
    const BYTES: usize = 256 << 20;
    const CHUNK: usize = 1 << 16;
    let source = vec![1_u8; BYTES];
    let mut target = vec![2_u8; BYTES];
    group.throughput(Throughput::Bytes(BYTES as u64));
    group.bench_function("memory, copied", |b| {
        b.iter(|| {
            let chunks = target.par_chunks_mut(CHUNK).zip(source.par_chunks(CHUNK));
            chunks.for_each(|(to, from)| to.copy_from_slice(from));
            black_box(&mut target);
        });
    });
    let fill = || {
        let mut new: Vec<u8> = mesh::zeroed(BYTES);
        new.par_chunks_mut(CHUNK).for_each(|chunk| chunk.fill(3));
        new
    };
    group.bench_function("memory, allocated and filled", |b| {
        b.iter_batched(|| (), |()| fill(), BatchSize::PerIteration);
    });
}

/// A torus of 100,352 triangles.
fn triangles() -> Mesh {
    shapes::fans(&shapes::torus(224, 224, 2.0, 1.0))
}

/// A torus of 33,451 faces: one of every three squares is cut into two triangles.
fn mixed() -> Mesh {
    let torus = shapes::torus(224, 112, 2.0, 1.0);
    let mut polygons: Vec<Vec<u32>> = Vec::new();
    for f in torus.faces() {
        let corners = torus.face_vertices(f);
        let v: Vec<u32> = corners
            .map(|v| u32::try_from(v.index()).expect("a small mesh"))
            .collect();
        if f.index().is_multiple_of(3) {
            polygons.push(vec![v[0], v[1], v[2]]);
            polygons.push(vec![v[0], v[2], v[3]]);
        } else {
            polygons.push(v);
        }
    }
    let (mesh, _) = Mesh::from_polygons(torus.positions().to_vec(), &polygons).expect("a torus");
    mesh
}

criterion_group!(benches, levels);
criterion_main!(benches);
