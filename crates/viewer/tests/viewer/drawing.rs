//! Pictures of scenes, without a window.

use std::path::Path;

use eframe::egui_wgpu::RenderState;
use geometry::shapes;
use glam::DVec2;
use mesh::{DVec3, Mesh};
use render::{Image, Shading};
use scene::{Object, Scene};
use view::{ColorBy, Quantity};
use viewer::camera::{Camera, Side, UpAxis};
use viewer::gpu::{Look, Overlay, OverlayLine, Painter, Wireframe};

use crate::adapter::device;

const SIZE: [u32; 2] = [320, 240];

pub(crate) fn scene(mesh: Mesh) -> Scene {
    let mut scene = Scene::new();
    scene.insert(Object::mesh("a", mesh)).unwrap();
    scene
}

pub(crate) fn bare() -> Look {
    Look {
        wireframe: Wireframe::None,
        boundary: false,
        creases: false,
        grid: false,
        ..Look::default()
    }
}

pub(crate) struct Stage {
    pub(crate) painter: Painter,
    pub(crate) camera: Camera,
}

impl Stage {
    pub(crate) fn new(state: &RenderState, scene: &Scene, look: &Look) -> Self {
        let mut painter = Painter::new(&state.device, &state.queue);
        let messages = painter.set_scene(scene, look);
        assert!(messages.is_empty(), "{messages:?}");
        let mut camera = Camera::default();
        let (center, radius) = painter.extent().unwrap();
        camera.fit(
            center,
            radius,
            DVec2::new(f64::from(SIZE[0]), f64::from(SIZE[1])),
        );
        Self { painter, camera }
    }

    pub(crate) fn draw(&mut self, look: &Look, overlay: &Overlay) -> Image {
        self.painter.draw(&self.camera, look, overlay, SIZE, 1.0);
        self.painter.read().unwrap()
    }

    /// Draws the scene with the crate `render`, without a graphics card, and returns the picture. The background is
    /// transparent.
    pub(crate) fn expected(&self, scene: &Scene, shading: Shading) -> Image {
        let camera = render::Camera::LookAt {
            from: self.camera.eye().to_array(),
            to: self.camera.target.to_array(),
            up: render::Up::Y,
            projection: render::Projection::Perspective { angle: 25.0 },
        };
        let style = render::Style {
            shading,
            occlusion: 0.0,
            background: render::Background::Transparent,
            ..render::Style::default()
        };
        let overlays = render::Overlays::default();
        let images = &mut |_: &str| None;
        let drawn = render::picture(scene, &camera, &style, &overlays, SIZE, 1 << 30, images);
        drawn.unwrap().0.image
    }
}

/// Checks the pixels that are opaque in `expected`: at least `percent` % of them have nearly the same color in `found`.
pub(crate) fn assert_near(found: &Image, expected: &Image, percent: usize) {
    let inside = expected.pixels.iter().zip(&found.pixels);
    let inside: Vec<_> = inside.filter(|(e, _)| e[3] == 255).collect();
    assert!(inside.len() > 8000, "{}", inside.len());
    let near = |(e, f): &&(&[u8; 4], &[u8; 4])| (0..3).all(|i| e[i].abs_diff(f[i]) <= 3);
    let n_near = inside.iter().filter(near).count();
    let n = inside.len();
    assert!(n_near * 100 >= n * percent, "{n_near} of {n}");
}

fn picture(state: &RenderState, scene: &Scene, look: &Look) -> Image {
    Stage::new(state, scene, look).draw(look, &Overlay::default())
}

/// Writes a picture to the temporary folder of the tests, where people can look at the picture.
pub(crate) fn keep(name: &str, image: &Image) {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("viewer");
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(
        folder.join(format!("{name}.png")),
        image.to_png(&[]).unwrap(),
    )
    .unwrap();
}

/// Returns the sum of the channels of the brightest pixel.
fn brightest(image: &Image) -> u32 {
    let sum = |p: &[u8; 4]| p[..3].iter().map(|&c| u32::from(c)).sum();
    image.pixels.iter().map(sum).max().unwrap()
}

/// Returns the number of pixels that differ by more than 12 in a channel.
fn n_different(a: &Image, b: &Image) -> usize {
    let differs = |(p, q): (&[u8; 4], &[u8; 4])| p.iter().zip(q).any(|(x, y)| x.abs_diff(*y) > 12);
    a.pixels
        .iter()
        .zip(&b.pixels)
        .filter(|&pair| differs(pair))
        .count()
}

#[test]
fn a_cube_has_the_colors_of_the_renderer_without_a_graphics_card() {
    let Some(state) = device() else { return };
    let scene = scene(shapes::cube());
    for shading in [
        Shading::Flat,
        Shading::Smooth,
        Shading::Matcap,
        Shading::Plain,
    ] {
        let look = Look { shading, ..bare() };
        let mut stage = Stage::new(&state, &scene, &look);
        let found = stage.draw(&look, &Overlay::default());
        keep(&format!("cube-{shading:?}"), &found);
        // Most pixels must agree. The pixels at edges differ, because the colors of the faces are blended differently
        // there.
        assert_near(&found, &stage.expected(&scene, shading), 97);
    }
}

#[test]
fn phong_shading_has_a_highlight() {
    let Some(state) = device() else { return };
    let ball = scene(shapes::uv_sphere(48, 24));
    let smooth = picture(&state, &ball, &bare());
    let phong = picture(
        &state,
        &ball,
        &Look {
            shading: Shading::Phong,
            ..bare()
        },
    );
    keep("phong", &phong);
    assert!(brightest(&phong) > brightest(&smooth) + 40);
}

#[test]
fn wireframes_show_the_edges_of_polygons_and_no_diagonals() {
    let Some(state) = device() else { return };
    let cube = scene(shapes::cube());
    let plain = picture(&state, &cube, &bare());
    let count = |wireframe| {
        let image = picture(
            &state,
            &cube,
            &Look {
                wireframe,
                ..bare()
            },
        );
        keep(&format!("wire-{wireframe:?}"), &image);
        n_different(&image, &plain)
    };
    let on_surface = count(Wireframe::Shaded);
    // Nine edges of the cube are visible. Each edge is about 100 pixels long.
    assert!((400..2500).contains(&on_surface), "{on_surface}");
    assert!(count(Wireframe::HiddenLine) > 5000);
    assert!(count(Wireframe::Lines) > 5000);
    // If the diagonals of the faces were drawn, the middle of the front face would have another color than its
    // surroundings.
    let look = Look {
        wireframe: Wireframe::Shaded,
        ..bare()
    };
    let mut stage = Stage::new(&state, &cube, &look);
    stage.camera.look_from(Side::Front);
    stage.camera.is_perspective = false;
    let image = stage.draw(&look, &Overlay::default());
    let at = |x: u32, y: u32| image.pixels[(y * SIZE[0] + x) as usize];
    assert_eq!(at(160, 120), at(150, 100));
}

#[test]
fn an_overlay_line_is_drawn_on_the_edge_with_its_width() {
    let Some(state) = device() else { return };
    let cube = scene(shapes::cube());
    let look = bare();
    let mut stage = Stage::new(&state, &cube, &look);
    stage.camera.look_from(Side::Front);
    stage.camera.is_perspective = false;
    let [min, max] = geometry::bounds(cube.objects()[0].as_mesh().unwrap()).unwrap();
    let middle = 0.5 * (min.y + max.y);
    let line = OverlayLine {
        ends: [
            DVec3::new(0.8 * min.x, middle, max.z),
            DVec3::new(0.8 * max.x, middle, max.z),
        ],
        width: 6.0,
        hidden: 0.0,
        color: [255, 0, 0, 255],
    };
    let overlay = Overlay {
        lines: vec![line],
        ..Overlay::default()
    };
    let image = stage.draw(&look, &overlay);
    let red = |y: u32| image.pixels[(y * SIZE[0] + 160) as usize] == [255, 0, 0, 255];
    let n = (0..SIZE[1]).filter(|&y| red(y)).count();
    assert!((5..=6).contains(&n), "{n}");
    // From behind, the cube hides the line.
    stage.camera.look_from(Side::Back);
    let image = stage.draw(&look, &overlay);
    assert!(!image.pixels.contains(&[255, 0, 0, 255]));
}

#[test]
fn only_new_objects_are_uploaded() {
    let Some(state) = device() else { return };
    let mut scene = scene(shapes::cube());
    scene
        .insert(Object::mesh("b", shapes::icosahedron()))
        .unwrap();
    let look = Look::default();
    let mut stage = Stage::new(&state, &scene, &look);
    assert_eq!(stage.painter.n_uploads(), 2);
    stage.painter.set_scene(&scene.clone(), &look);
    assert_eq!(stage.painter.n_uploads(), 2);
    // If one mesh changes, only this mesh is uploaded again.
    let (geometry, _) = scene.parts_mut("b").unwrap();
    *geometry = scene::Geometry::Mesh(std::sync::Arc::new(shapes::cube()));
    stage.painter.set_scene(&scene, &look);
    assert_eq!(stage.painter.n_uploads(), 3);
}

#[test]
fn numbers_are_shown_as_colors() {
    let Some(state) = device() else { return };
    let ball = scene(shapes::torus(32, 16, 1.0, 0.4));
    let plain = picture(&state, &ball, &bare());
    for of in [
        Quantity::MeanCurvature,
        Quantity::Valence,
        Quantity::Area,
        Quantity::DihedralAngle,
    ] {
        let look = Look {
            color_by: Some(ColorBy::new(of.clone())),
            ..bare()
        };
        let image = picture(&state, &ball, &look);
        keep(
            &format!("color-{}", format!("{of:?}").to_lowercase()),
            &image,
        );
        assert!(n_different(&image, &plain) > 2000, "{of:?}");
    }
}

#[test]
fn views_from_opposite_sides_and_both_upward_axes_differ() {
    let Some(state) = device() else { return };
    let mut mesh = shapes::cube();
    // The loop deforms the cube to a wedge that has no symmetry.
    for p in mesh.positions_mut() {
        *p = DVec3::new(p.x, p.y * (1.0 + p.x), p.z * (1.3 + 0.5 * p.y + 0.2 * p.x));
    }
    let wedge = scene(mesh);
    let look = Look::default();
    let mut stage = Stage::new(&state, &wedge, &look);
    let mut images: Vec<Image> = Vec::new();
    for up in [UpAxis::Y, UpAxis::Z] {
        for is_perspective in [true, false] {
            stage.camera.up = up;
            stage.camera.is_perspective = is_perspective;
            let image = stage.draw(&look, &Overlay::default());
            keep(&format!("view-{up:?}-{is_perspective}"), &image);
            assert!(images.iter().all(|other| n_different(&image, other) > 500));
            images.push(image);
        }
    }
}

#[test]
fn flips_upload_only_what_changed_and_the_picture_is_that_of_the_new_mesh() {
    let Some(state) = device() else { return };
    let mut mesh = shapes::torus(60, 40, 1.0, 0.4);
    let faces: Vec<_> = mesh.faces().collect();
    for f in faces {
        mesh.poke_face(f).unwrap();
    }
    for shading in [Shading::Smooth, Shading::Flat] {
        let look = Look {
            shading,
            ..Look::default()
        };
        let mut stage = Stage::new(&state, &scene(mesh.clone()), &look);
        stage.draw(&look, &Overlay::default());
        let mut flipped = mesh.clone();
        for (i, e) in (0..4800).step_by(37).enumerate() {
            flipped.flip_edge(mesh::EdgeId::new(e)).unwrap();
            if i % 20 == 0 {
                let new = scene(flipped.clone());
                stage.painter.set_scene(&new, &look);
                let found = stage.draw(&look, &Overlay::default());
                let expected = picture(&state, &new, &look);
                assert_eq!(n_different(&found, &expected), 0, "{shading:?} {i}");
            }
        }
        assert_eq!(stage.painter.n_uploads(), 1, "{shading:?}");
        // If the number of elements changes, the whole object is converted and uploaded again.
        flipped.split_edge(mesh::EdgeId::new(7), 0.5).unwrap();
        let new = scene(flipped);
        stage.painter.set_scene(&new, &look);
        assert_eq!(stage.painter.n_uploads(), 2);
        let found = stage.draw(&look, &Overlay::default());
        assert_eq!(n_different(&found, &picture(&state, &new, &look)), 0);
    }
}
