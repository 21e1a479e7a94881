//! How many triangles a second does Loop subdivision make, and how far is that from copying the bytes
//! of the result?

use std::hint::black_box;
use std::time::Duration;

use criterion::{BatchSize, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use loop_subdivide::LoopSubdivide;
use mesh::{Mesh, shapes};
use op::{Context, Files, MeshOperation, NoProgress};

/// Loop subdivision to about five million triangles: nine levels from 20 and four from 20,000.
fn five_million_triangles(c: &mut Criterion) {
    let mut group = c.benchmark_group("Loop to 5 M triangles");
    group.sample_size(10).warm_up_time(Duration::from_secs(1));
    let starts = [
        ("icosahedron, 9 levels", shapes::icosahedron(), 9),
        ("torus of 20,000, 4 levels", torus(), 4),
    ];
    for (name, mesh, levels) in starts {
        let result = subdivided(&mesh, levels);
        group.throughput(Throughput::Elements(result.n_faces() as u64));
        let bytes = vec![1_u8; result.bytes()];
        drop(result);
        for threads in [1, 2] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
            let pool = pool.build().expect("a pool of one or two threads");
            let id = BenchmarkId::new(name, format!("{threads} threads"));
            group.bench_function(id, |b| {
                pool.install(|| {
                    b.iter_batched(
                        || (),
                        |()| subdivided(&mesh, levels),
                        BatchSize::PerIteration,
                    );
                });
            });
        }
        // Into new memory, as the mesh is.
        group.bench_function(BenchmarkId::new(name, "copy of its bytes"), |b| {
            b.iter_batched(
                || (),
                |()| black_box(&bytes).clone(),
                BatchSize::PerIteration,
            );
        });
    }
    group.finish();
}

fn subdivided(mesh: &Mesh, levels: u32) -> Mesh {
    let files = Files::default();
    let mut mesh = mesh.clone();
    LoopSubdivide::levels(levels)
        .apply(&mut mesh, &mut Context::new(&NoProgress, &files))
        .expect("a mesh of triangles");
    mesh
}

/// A torus of 20,000 triangles.
fn torus() -> Mesh {
    shapes::fans(&shapes::torus(100, 100, 2.0, 1.0))
}

criterion_group!(benches, five_million_triangles);
criterion_main!(benches);
