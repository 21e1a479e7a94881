//! Measures algorithms on surfaces: simplification, remeshing, smoothing, nearest points, geodesic distances and
//! unwrapping.

use std::time::Duration;

use criterion::measurement::WallTime;
use criterion::{
    BatchSize, BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main,
};
use geometry::surface_index::SurfaceIndex;
use geometry::{geodesic_distances, remesh, shapes, simplify, smooth, uv};
use mesh::{DVec3, Mesh, UV};
use progress::NoProgress;

/// Returns a torus of 20,000 triangles with smooth bumps.
fn bumpy() -> Mesh {
    let mut mesh = shapes::fans(&shapes::torus(200, 50, 2.0, 1.0));
    for p in mesh.positions_mut() {
        let noise = geometry::deform::noise::gradient(7, *p);
        *p *= 1.0 + 0.1 * noise;
    }
    mesh
}

/// Adds texture coordinates without seams to a mesh: the x and y coordinates of the positions.
fn with_uvs(mut mesh: Mesh) -> Mesh {
    let at = |h| mesh.position(mesh.origin(h)).truncate();
    let uvs = mesh.half_edges().map(at).collect();
    mesh.set(UV, uvs);
    mesh
}

fn group<'c>(c: &'c mut Criterion, name: &str, mesh: &Mesh) -> BenchmarkGroup<'c, WallTime> {
    let mut group = c.benchmark_group(name);
    group
        .sample_size(10)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(2))
        .throughput(Throughput::Elements(mesh.n_faces() as u64));
    group
}

fn surfaces(c: &mut Criterion) {
    let mesh = bumpy();
    let mut group = group(c, "surface of 20,000 triangles", &mesh);
    let tenth = simplify::Options {
        faces: mesh.n_faces() / 10,
        ..simplify::Options::default()
    };
    let textured = with_uvs(mesh.clone());
    for (name, mesh) in [
        ("simplify to a tenth", &mesh),
        ("simplify to a tenth, with texture coordinates", &textured),
    ] {
        let run = || simplify::simplify(mesh, &tenth, &NoProgress);
        group.bench_function(name, |b| b.iter(run));
    }
    let lengths = mesh.edges().map(|e| mesh.length(e.half_edge()));
    let even = remesh::Options {
        length: remesh::Length::Uniform(lengths.sum::<f64>() / mesh.n_edges() as f64),
        ..remesh::Options::default()
    };
    let run = || remesh::remesh(&mesh, &even, &NoProgress);
    group.bench_function("remesh, ten passes", |b| b.iter(run));
    let is_free = vec![true; mesh.n_vertices()];
    for (name, method, passes) in [
        (
            "smooth by Taubin's filter, ten passes",
            smooth::Method::Taubin {
                weights: smooth::Weights::Uniform,
                factor: 0.5,
                pass_band: 0.1,
            },
            10,
        ),
        (
            "smooth by an implicit step",
            smooth::Method::Implicit { time: 0.01 },
            1,
        ),
    ] {
        let smoothing = smooth::Smoothing {
            method,
            passes,
            is_free: &is_free,
            boundary: smooth::Boundary::Fixed,
            keep_volume: false,
        };
        group.bench_function(name, |b| {
            b.iter_batched(
                || mesh.clone(),
                |mut mesh| smooth::smooth(&mut mesh, &smoothing, &NoProgress).map(|_| mesh),
                BatchSize::PerIteration,
            );
        });
    }
    let is_source: Vec<bool> = (0..mesh.n_vertices()).map(|v| v == 0).collect();
    let run = || geodesic_distances(&mesh, &is_source, &NoProgress);
    group.bench_function("measure geodesic distances", |b| b.iter(run));
    let index = SurfaceIndex::new(&mesh).expect("the torus has faces");
    let points: Vec<DVec3> = mesh.positions().iter().map(|p| 1.01 * p).collect();
    let run = || index.nearest_to_points(&points, &NoProgress);
    group.bench_function("nearest points of 10,000 points", |b| b.iter(run));
    group.finish();
}

fn textures(c: &mut Criterion) {
    let mesh = shapes::fans(&shapes::torus(50, 20, 2.0, 1.0));
    let mut group = group(c, "surface of 2,000 triangles", &mesh);
    let options = uv::UnwrapOptions {
        seams: &[],
        max_angle: 70.0,
        max_stretch: 4.0,
        page: uv::Page {
            size: 1024,
            padding: 2,
        },
    };
    let run = || uv::unwrap(&mesh, &options, &NoProgress);
    group.bench_function("unwrap", |b| b.iter(run));
    group.finish();
}

criterion_group!(benches, surfaces, textures);
criterion_main!(benches);
