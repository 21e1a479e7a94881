//! How many triangles a second can be built into a mesh, and how far is that from copying its bytes?

use std::hint::black_box;
use std::time::Duration;

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use mesh::build::{NonManifold, build};
use mesh::{DVec3, Mesh};

/// Building a torus of a million triangles from positions and corners.
fn a_million_triangles(c: &mut Criterion) {
    let (positions, triangles) = torus();
    let offsets: Vec<u32> = (0..).step_by(3).take(triangles.len() + 1).collect();
    let corners = triangles.as_flattened();
    let built = |positions: Vec<DVec3>| {
        build(positions, &offsets, corners, NonManifold::Refuse).expect("a torus is a manifold")
    };
    let bytes = vec![1_u8; built(positions.clone()).mesh.bytes()];

    let mut group = c.benchmark_group("build 1 M triangles");
    group.sample_size(10).warm_up_time(Duration::from_secs(1));
    group.throughput(Throughput::Elements(triangles.len() as u64));
    for threads in [1, 2] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let pool = pool.build().expect("a pool of one or two threads");
        group.bench_function(format!("build, {threads} threads"), |b| {
            pool.install(|| b.iter_batched(|| positions.clone(), built, BatchSize::PerIteration));
        });
        group.bench_function(format!("from_polygons, {threads} threads"), |b| {
            let from_polygons = |positions| Mesh::from_polygons(positions, &triangles);
            pool.install(|| {
                b.iter_batched(|| positions.clone(), from_polygons, BatchSize::PerIteration);
            });
        });
    }
    // Into new memory, as the mesh is.
    group.bench_function("copy of its bytes", |b| {
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
    let quads = mesh::shapes::torus(1000, 500, 2.0, 1.0);
    let triangles = quads.faces().flat_map(|f| {
        let mut v = quads.face_vertices(f).map(mesh::VertexId::index);
        let v = [(); 4].map(|()| v.next().expect("a quadrilateral"));
        let v = v.map(|v| u32::try_from(v).expect("few vertices"));
        [[v[0], v[1], v[2]], [v[0], v[2], v[3]]]
    });
    (quads.positions().to_vec(), triangles.collect())
}

criterion_group!(benches, a_million_triangles);
criterion_main!(benches);
