//! Tests that rendering needs no more memory than `bytes_needed` returns, for several drawings.
//!
//! This test binary has only one test, because memory that other tests allocate at the same time would also be counted.

use geometry::shapes;
use mesh::DVec3;
use peak_alloc::PeakAlloc;
use progress::NoProgress;
use render::{
    Camera, Drawing, Image, Line, NO_FACE, Overlays, PictureError, Projection, Shading, Style, Up,
    View, build, bytes_needed, picture, render,
};
use scene::{Material, Object, Scene, Texture};

#[global_allocator]
static MEMORY: PeakAlloc = PeakAlloc;

/// Runs a function, and returns its result and its peak memory in bytes.
fn peak<T>(run: impl FnOnce() -> T) -> (T, u64) {
    MEMORY.reset_peak_usage();
    let before = MEMORY.current_usage();
    let result = run();
    (result, (MEMORY.peak_usage() - before) as u64)
}

#[test]
fn rendering_takes_at_most_the_estimated_memory() {
    let mut dense = Scene::new();
    let ball = shapes::fans(&shapes::uv_sphere(400, 200));
    dense.insert(Object::mesh("ball", ball)).unwrap();
    let mut many = Scene::new();
    for i in 0..300 {
        let mut cube = shapes::cube();
        for p in cube.positions_mut() {
            p.x += 2.0 * f64::from(i % 20);
            p.y += 2.0 * f64::from(i / 20);
        }
        many.insert(Object::mesh(format!("cube {i}"), cube))
            .unwrap();
    }
    let mut one = Scene::new();
    one.insert(Object::mesh("cube", shapes::cube())).unwrap();
    let smooth = Style::default();
    let plain = Style {
        shading: Shading::Plain,
        wireframe: Some(render::Lines::default()),
        ..Style::default()
    };
    for threads in [1, 8] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.unwrap().install(|| {
            for (name, scene, style, size) in [
                ("dense", &dense, &smooth, [640, 480]),
                ("dense and small", &dense, &plain, [64, 48]),
                ("many", &many, &plain, [1000, 1000]),
                ("one", &one, &smooth, [300, 300]),
                ("large", &one, &plain, [2000, 2000]),
                ("strip", &one, &plain, [16_384, 64]),
                ("column", &one, &plain, [64, 16_384]),
                ("pixel", &one, &smooth, [1, 1]),
            ] {
                let (drawing, _) =
                    build(scene, style, &Overlays::default(), &mut |_| None).unwrap();
                let name = format!("{name}, {threads} threads");
                check(&name, &drawing, &Camera::default(), style, size);
            }
            let camera = Camera::default();
            check("nothing", &Drawing::default(), &camera, &plain, [500, 500]);
            check("lines", &long_lines(), &camera, &plain, [512, 512]);
            // The surface surrounds the camera, so some triangles are behind the camera or very near it. These
            // triangles are clipped.
            let (drawing, _) = build(&dense, &plain, &Overlays::default(), &mut |_| None).unwrap();
            for to in [[0.0, 0.0, 0.9], [3e4, 0.0, 0.0]] {
                let camera = Camera::LookAt {
                    from: [0.0, 0.0, 0.999],
                    to,
                    up: Up::Y,
                    projection: Projection::default(),
                };
                check(
                    &format!("inside, to {to:?}"),
                    &drawing,
                    &camera,
                    &plain,
                    [64, 48],
                );
            }
        });
    }
    too_large_pictures_are_refused_before_anything_is_allocated(&dense);
    too_large_textures_are_refused_before_they_are_decoded(&one);
}

/// Renders a drawing, and compares the peak memory with the estimate.
fn check(name: &str, drawing: &Drawing, camera: &Camera, style: &Style, size: [u32; 2]) {
    let look = style.look();
    let view = View::new(camera, &|each| drawing.each_point(each), size).unwrap();
    let needed = bytes_needed(drawing, &view, size, &look);
    let (rendered, peak) = peak(|| render(drawing, &view, size, &look, &NoProgress));
    assert_eq!(
        rendered.unwrap().image.pixels.len(),
        (size[0] * size[1]) as usize
    );
    assert!(peak <= needed, "{name}: {peak} bytes, estimated {needed}");
}

/// Returns a drawing of long lines. Each line is in the lists of many tiles.
fn long_lines() -> Drawing<'static> {
    let line = |i: i32| {
        let from = DVec3::new(f64::from(i % 200), f64::from(i / 200), 0.0);
        Line {
            ends: [from, from + DVec3::new(90.0, 90.0, 0.0)],
            width: 0.1,
            color: [0.0, 0.0, 0.0, 1.0],
            faces: [NO_FACE; 2],
            hidden: 0.0,
            spacing: f64::INFINITY,
        }
    };
    Drawing {
        lines: (0..8_000).map(line).collect(),
        ..Drawing::default()
    }
}

fn too_large_pictures_are_refused_before_anything_is_allocated(scene: &Scene) {
    let (camera, style, none) = (Camera::default(), Style::default(), Overlays::default());
    let size = [16_384; 2];
    let budget = 1 << 30;
    let draw = || picture(scene, &camera, &style, &none, size, budget, &mut |_| None);
    let (refused, peak) = peak(draw);
    let Err(PictureError::Budget { needed, .. }) = refused else {
        panic!("{refused:?}");
    };
    assert!(needed > budget && peak < 1 << 16, "{needed}, {peak}");
}

fn too_large_textures_are_refused_before_they_are_decoded(scene: &Scene) {
    let image = Image::filled(2000, 2000, [9; 4]).unwrap();
    let png = image.to_png(&[]).unwrap();
    let mut material = Material::new("wood");
    material.base_color_texture = Some(Texture::file("wood.png"));
    let mut textured = Scene::new();
    let mesh = scene.object("cube").unwrap().as_mesh().unwrap();
    let object = Object {
        materials: vec![material],
        ..Object::mesh("cube", mesh.as_ref().clone())
    };
    textured.insert(object).unwrap();
    let (camera, style, none) = (Camera::default(), Style::default(), Overlays::default());
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    pool.unwrap().install(|| {
        let mut images = |_: &str| Some(png.clone());
        for (budget, is_enough) in [(40 << 20, false), (50 << 20, true)] {
            let draw = || {
                picture(
                    &textured,
                    &camera,
                    &style,
                    &none,
                    [64; 2],
                    budget,
                    &mut images,
                )
            };
            let (drawn, peak) = peak(draw);
            assert_eq!(drawn.is_ok(), is_enough, "{drawn:?}");
            let limit = if is_enough { budget } else { 1 << 20 };
            assert!(peak < limit, "{peak} bytes");
        }
    });
}
