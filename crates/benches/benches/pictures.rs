//! Measures triangles and pixels per second of pictures, from the scene in memory to pixels in memory, with one and two
//! threads: many small triangles, few large triangles, lines, and ambient occlusion.
//!
//! `cargo bench -p meshwright-benches --bench pictures` prints the median times.

#![expect(clippy::print_stdout, reason = "a benchmark prints its figures")]

use std::hint::black_box;
use std::time::Instant;

use geometry::shapes;
use mesh::Mesh;
use render::{Camera, Lines, Overlays, Shading, Style, picture};
use scene::{Object, Scene};

/// Number of measured runs, after one to warm up.
const RUNS: usize = 5;

fn main() {
    // `cargo test` also runs the benchmarks, to check that they work.
    let is_test = std::env::args().any(|a| a == "--test");
    let n = if is_test { 20 } else { 1000 };
    let dense = scene(shapes::fans(&shapes::torus(n, n / 2, 1.0, 0.4)));
    let coarse = scene(shapes::cube());
    let fast = Style {
        occlusion: 0.0,
        ..Style::default()
    };
    let flat = Style {
        shading: Shading::Flat,
        ..fast.clone()
    };
    let wire = Style {
        wireframe: Some(Lines::default()),
        ..fast.clone()
    };
    let full = Style::default();
    let usual = if is_test { [64, 48] } else { [1280, 960] };
    let large = if is_test { [64, 48] } else { [2048, 1536] };
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
        ("12 triangles, with occlusion", &coarse, &full, large),
    ];
    for threads in [1, 2] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("a pool of one or two threads").install(|| {
            println!("{threads} thread{}", if threads == 1 { "" } else { "s" });
            for (name, scene, style, size) in cases {
                measure(name, scene, style, size);
            }
        });
    }
}

fn scene(mesh: Mesh) -> Scene {
    let mut scene = Scene::new();
    scene
        .insert(Object::mesh("a", mesh))
        .expect("the only object");
    scene
}

/// Measures one case and prints a line.
fn measure(name: &str, scene: &Scene, style: &Style, size: [u32; 2]) {
    let (camera, overlays) = (Camera::default(), Overlays::default());
    let draw = || {
        let start = Instant::now();
        let drawn = picture(
            scene,
            &camera,
            style,
            &overlays,
            size,
            u64::MAX,
            &mut |_| None,
        );
        black_box(&drawn);
        let time = start.elapsed().as_secs_f64();
        drawn.expect("a scene that can be drawn");
        time
    };
    draw();
    let mut times: Vec<f64> = (0..RUNS).map(|_| draw()).collect();
    times.sort_unstable_by(f64::total_cmp);
    let seconds = times[RUNS / 2];
    let pixels = f64::from(size[0]) * f64::from(size[1]);
    let triangles: usize = scene
        .objects()
        .iter()
        .map(|object| match &object.geometry {
            scene::Geometry::Mesh(mesh) => mesh.n_half_edges() - 2 * mesh.n_faces(),
            _ => 0,
        })
        .sum();
    println!(
        "  {name}: {:.0} ms, {:.2} M triangles/s, {:.1} M pixels/s",
        seconds * 1e3,
        triangles as f64 / seconds / 1e6,
        pixels / seconds / 1e6,
    );
}
