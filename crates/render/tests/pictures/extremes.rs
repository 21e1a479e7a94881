//! Tests with many triangles, very large pictures, and very large and small coordinates.
//!
//! `cargo test -p meshwright-render --test pictures -- --ignored` runs the tests that need a lot of time or memory.

use geometry::shapes;
use mesh::{DVec3, Mesh};
use render::{
    Background, Camera, Image, Lines, Overlays, Projection, Shading, Side, Style, Up, picture,
};
use scene::{Object, Scene};

const SHADINGS: [Shading; 5] = [
    Shading::Flat,
    Shading::Smooth,
    Shading::Phong,
    Shading::Matcap,
    Shading::Plain,
];

fn scene(mesh: Mesh) -> Scene {
    let mut scene = Scene::new();
    scene.insert(Object::mesh("a", mesh)).unwrap();
    scene
}

fn draw(mesh: Mesh, camera: &Camera, style: &Style, size: [u32; 2]) -> Image {
    let (scene, none) = (scene(mesh), Overlays::default());
    let (picture, missing) =
        picture(&scene, camera, style, &none, size, 4 << 30, &mut |_| None).unwrap();
    assert_eq!(missing, [""; 0]);
    picture.image
}

/// Returns an orthographic camera in front of the scene. The picture is `height` units high.
fn front(height: f64) -> Camera {
    // At this distance, the picture of an orthographic `LookAt` is `height` units high (see the documentation of
    // `LookAt`).
    let distance = 0.5 * height / libm::tan(15.0_f64.to_radians());
    Camera::LookAt {
        from: [0.0, 0.0, distance],
        to: [0.0; 3],
        up: Up::Y,
        projection: Projection::Orthographic,
    }
}

fn transparent(shading: Shading) -> Style {
    Style {
        shading,
        background: Background::Transparent,
        ..Style::default()
    }
}

/// Returns the covered area in pixels.
fn covered(image: &Image) -> f64 {
    let alphas = image.pixels.iter().map(|p| f64::from(p[3]));
    alphas.sum::<f64>() / 255.0
}

/// Checks that a sphere of about `2 n²` triangles is drawn as a disc without cracks.
fn check_dense_sphere(n: u32, size: [u32; 2]) {
    let mut ball = shapes::fans(&shapes::uv_sphere(2 * n, n / 2));
    for p in ball.positions_mut() {
        *p = p.normalize();
    }
    assert!(10 * ball.n_faces() > 19 * n as usize * n as usize);
    let image = draw(ball, &front(2.5), &transparent(Shading::Smooth), size);
    let radius = f64::from(size[1]) / 2.5;
    let expected = std::f64::consts::PI * radius * radius;
    let found = covered(&image);
    assert!((found / expected - 1.0).abs() < 2e-3, "{found}, {expected}");
    for (i, pixel) in image.pixels.iter().enumerate() {
        let [x, y] = [i % size[0] as usize, i / size[0] as usize].map(|x| x as f64 + 0.5);
        let (dx, dy) = (x - f64::from(size[0]) / 2.0, y - f64::from(size[1]) / 2.0);
        if (dx * dx + dy * dy).sqrt() < radius - 2.0 {
            assert_eq!(pixel[3], 255, "pixel {i}");
        }
    }
}

#[test]
fn half_a_million_triangles_have_no_cracks() {
    check_dense_sphere(500, [640, 480]);
}

#[test]
#[ignore = "takes ten seconds and 2 GB"]
fn ten_million_triangles_have_no_cracks() {
    check_dense_sphere(2240, [1280, 960]);
}

/// Checks that a square covers exactly the left half of a picture.
fn check_half_picture(size: [u32; 2]) {
    let mut square = shapes::square();
    let aspect = f64::from(size[0]) / f64::from(size[1]);
    for p in square.positions_mut() {
        *p = DVec3::new((p.x - 1.0) * aspect, p.y * 4.0 - 2.0, 0.0);
    }
    let image = draw(square, &front(1.0), &transparent(Shading::Plain), size);
    let (width, half) = (size[0] as usize, size[0] as usize / 2);
    for row in image.pixels.chunks(width) {
        assert!(row[..half].iter().all(|p| p[3] == 255));
        assert!(row[half..].iter().all(|p| p[3] == 0));
    }
}

#[test]
fn the_widest_and_the_highest_pictures_are_drawn_to_their_borders() {
    check_half_picture([16_384, 64]);
    check_half_picture([64, 16_384]);
}

#[test]
#[ignore = "takes a minute and 2 GB"]
fn the_largest_picture_is_drawn_to_its_borders() {
    check_half_picture([16_384, 16_384]);
}

/// Returns the mean difference between corresponding channel values of two images.
fn difference(a: &Image, b: &Image) -> f64 {
    let (a, b) = (a.pixels.as_flattened(), b.pixels.as_flattened());
    let each = a.iter().zip(b).map(|(a, b)| f64::from(a.abs_diff(*b)));
    each.sum::<f64>() / a.len() as f64
}

#[test]
fn scaling_a_scene_does_not_change_its_picture() {
    for shading in SHADINGS {
        for projection in [Projection::Orthographic, Projection::default()] {
            let camera = Camera::Fit {
                from: Side::ThreeQuarter,
                up: Up::Z,
                projection,
                margin: 0.05,
                steady: false,
            };
            let style = Style {
                wireframe: Some(Lines {
                    hidden: 0.3,
                    ..Lines::default()
                }),
                normals: Some(0.2),
                points: Some(4.0),
                ..transparent(shading)
            };
            let draw_scaled = |scale: f64| {
                let mut torus = shapes::torus(24, 12, 1.0, 0.4);
                for p in torus.positions_mut() {
                    *p *= scale;
                }
                draw(torus, &camera, &style, [96, 64])
            };
            let unscaled = draw_scaled(1.0);
            assert!(covered(&unscaled) > 1000.0);
            for scale in [1e-30, 1e-3, 1e3, 1e30] {
                let mean = difference(&draw_scaled(scale), &unscaled);
                assert!(mean < 0.2, "{shading:?}, {scale:e}: {mean}");
            }
            // Depths are `f32`. If depths are out of the range of `f32`, rendering must not fail, but the picture is
            // not checked.
            for scale in [1e-300, 1e-70, 1e70, 1e300] {
                assert_eq!(draw_scaled(scale).pixels.len(), unscaled.pixels.len());
            }
        }
    }
}

#[test]
fn degenerate_meshes_are_drawn_in_every_style() {
    let p = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
    let triangles = [
        ("one point", [p(1., 2., 3.); 3]),
        ("a line", [p(0., 0., 0.), p(1., 1., 1.), p(3., 3., 3.)]),
        (
            "seen edge-on",
            [p(0., 0., 0.), p(0., 1., 0.), p(0., 0., 1.)],
        ),
        (
            "far and near",
            [p(1e300, 0., 0.), p(1e-300, 1., 0.), p(0., 0., -1e300)],
        ),
        (
            "the largest numbers",
            [
                p(f64::MAX, 0., 0.),
                p(f64::MIN, 1., 0.),
                p(0., f64::MAX, f64::MIN),
            ],
        ),
        (
            "the smallest numbers",
            [p(5e-324, 0., 0.), p(0., 5e-324, 0.), p(0., 0., 5e-324)],
        ),
        (
            "far away",
            [
                p(1e300, 1e300, 1e300),
                p(1e300, 1.1e300, 1e300),
                p(1.2e300, 1e300, 1e300),
            ],
        ),
    ];
    for (name, points) in triangles {
        for shading in SHADINGS {
            for from in [Side::Front, Side::Left, Side::ThreeQuarter] {
                for size in [[1, 1], [33, 20]] {
                    let (mesh, _) = Mesh::from_polygons(points.to_vec(), &[[0, 1, 2]]).unwrap();
                    let camera = Camera::Fit {
                        from,
                        up: Up::Y,
                        projection: Projection::default(),
                        margin: 0.05,
                        steady: false,
                    };
                    let style = Style {
                        shading,
                        wireframe: Some(Lines::default()),
                        boundary: Some(Lines::default()),
                        normals: Some(1.0),
                        points: Some(3.0),
                        ..Style::default()
                    };
                    let image = draw(mesh, &camera, &style, size);
                    // If a computation gave NaN, pixels would be black and transparent.
                    let is_opaque = |p: &[u8; 4]| p[3] == 255;
                    assert!(image.pixels.iter().all(is_opaque), "{name}, {shading:?}");
                }
            }
        }
    }
}
