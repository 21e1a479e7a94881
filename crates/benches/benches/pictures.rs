//! Measures how many pixels per second are rendered. The measured time starts when the scene is in memory, and ends
//! when the pixels are in memory. One scene has a million small triangles, the other has 12 large triangles. Some
//! pictures also show lines or ambient occlusion.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use geometry::shapes;
use mesh::Mesh;
use render::{Camera, Lines, Overlays, Shading, Style, picture};
use scene::{Object, Scene};

fn pictures(c: &mut Criterion) {
    let dense = scene(shapes::fans(&shapes::torus(1000, 500, 1.0, 0.4)));
    let coarse = scene(shapes::cube());
    let full = Style::default();
    let fast = Style {
        occlusion: 0.0,
        ..full.clone()
    };
    let flat = Style {
        shading: Shading::Flat,
        ..fast.clone()
    };
    let wire = Style {
        wireframe: Some(Lines::default()),
        ..fast.clone()
    };
    let (usual, large) = ([1280, 960], [2048, 1536]);
    let cases = [
        ("1 M triangles, flat", &dense, &flat, usual),
        ("1 M triangles, smooth", &dense, &fast, usual),
        (
            "1 M triangles, smooth, with occlusion",
            &dense,
            &full,
            usual,
        ),
        ("1 M triangles and 1.5 M lines", &dense, &wire, usual),
        ("12 triangles, large picture", &coarse, &fast, large),
        (
            "12 triangles, large picture, with occlusion",
            &coarse,
            &full,
            large,
        ),
    ];
    let mut group = c.benchmark_group("pictures");
    group.sample_size(10);
    for (name, scene, style, size) in cases {
        let (camera, overlays) = (Camera::default(), Overlays::default());
        group.throughput(Throughput::Elements(
            u64::from(size[0]) * u64::from(size[1]),
        ));
        group.bench_function(name, |b| {
            b.iter(|| {
                picture(
                    scene,
                    &camera,
                    style,
                    &overlays,
                    size,
                    u64::MAX,
                    &mut |_| None,
                )
                .expect("the scene can be drawn")
            });
        });
    }
    group.finish();
}

fn scene(mesh: Mesh) -> Scene {
    let mut scene = Scene::new();
    scene
        .insert(Object::mesh("a", mesh))
        .expect("the only object");
    scene
}

criterion_group!(benches, pictures);
criterion_main!(benches);
