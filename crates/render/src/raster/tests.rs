//! Compares rendered pictures with results that are computed in a different way.

use glam::{DVec2, DVec3};
use progress::NoProgress;

use super::project::{GRID, GridPoint};
use super::shade::{FILL, FILL_LIGHT, GROUND, KEY, KEY_LIGHT, SKY};
use super::tile::{NO_TRIANGLE, SAMPLES, Tile};
use super::{Look, Rendered, TILE, render};
use crate::drawing::{Channel, Drawing, Label, Line, NO_FACE, Part, Surface};
use crate::style::Shading;
use crate::work::Listener;
use crate::{Camera, PictureError, Projection, Side, Up, View, to_linear};

const WHITE: [f32; 3] = [1.0; 3];

fn part(points: Vec<DVec3>, triangles: Vec<[u32; 3]>, color: [f32; 3]) -> Part<'static> {
    Part {
        points: points.into(),
        n_faces: u32::try_from(triangles.len()).unwrap(),
        triangles,
        corners: Vec::new(),
        faces: Vec::new(),
        normals: Channel::All([0.0; 3]),
        colors: Channel::All(color),
        highlights: Vec::new(),
        materials: vec![Surface::default()],
        material_of_face: Vec::new(),
        uvs: Vec::new(),
        back: None,
    }
}

fn drawing(parts: Vec<Part<'static>>) -> Drawing<'static> {
    Drawing {
        parts,
        ..Drawing::default()
    }
}

/// Returns settings that leave the colors of surfaces unchanged, on a transparent background.
fn plain() -> Look {
    Look {
        shading: Shading::Plain,
        occlusion: 0.0,
        background: [0.0; 4],
    }
}

/// Returns the view of an orthographic camera in front of the plane z = 0. The picture is `height` units high.
fn front_view(height: f64, size: [u32; 2]) -> View {
    // At this distance, the picture of an orthographic `LookAt` is `height` units high (see the documentation of
    // `LookAt`).
    let distance = 0.5 * height / libm::tan(15.0_f64.to_radians());
    let camera = Camera::LookAt {
        from: [0.0, 0.0, distance],
        to: [0.0; 3],
        up: Up::Y,
        projection: Projection::Orthographic,
    };
    View::new(&camera, &|_| {}, size).unwrap()
}

fn rendered(drawing: &Drawing, view: &View, size: [u32; 2], look: &Look) -> Rendered {
    render(drawing, view, size, look, &NoProgress).unwrap()
}

/// Returns the covered area in pixels.
fn covered(picture: &Rendered) -> f64 {
    let alphas = picture.image.pixels.iter().map(|p| f64::from(p[3]));
    alphas.sum::<f64>() / 255.0
}

/// Returns the next pseudo-random number of the generator `SplitMix64`.
fn random(seed: &mut u64) -> i32 {
    *seed = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut z = *seed;
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    i32::try_from(z >> 48).unwrap()
}

#[test]
fn samples_are_in_different_rows_and_columns() {
    let mut rows: Vec<_> = super::tile::OFFSETS.iter().map(|p| p[1]).collect();
    let mut columns: Vec<_> = super::tile::OFFSETS.iter().map(|p| p[0]).collect();
    rows.sort_unstable();
    columns.sort_unstable();
    let expected: Vec<i32> = (0..16).map(|i| i * 16 + 8 - 128).collect();
    assert_eq!((&rows, &columns), (&expected, &expected));
}

#[test]
fn triangles_that_fill_a_square_cover_every_sample_once() {
    // The grid of triangles is larger than the tile, and the inner points of the grid are moved. Grids with small cells
    // test the 32-bit arithmetic, and grids with large cells test the 64-bit arithmetic.
    for (seed, cells) in [(1, 40), (2, 7), (3, 2)] {
        let mut seed = seed;
        let tile_size = GRID * i32::try_from(TILE).unwrap();
        let (step, low) = (2 * tile_size / cells, -tile_size / 2);
        let mut position = |i: i32| -> [i32; 2] {
            let (x, y) = (i % (cells + 1), i / (cells + 1));
            let is_inside = x > 0 && y > 0 && x < cells && y < cells;
            // Offsets are multiples of 8, so that many points are exactly on samples.
            let offset = |r: i32| {
                if is_inside {
                    (r % (step / 3)) / 8 * 8
                } else {
                    0
                }
            };
            [
                low + x * step + offset(random(&mut seed)),
                low + y * step + offset(random(&mut seed)),
            ]
        };
        let n = (cells + 1) * (cells + 1);
        let corners: Vec<GridPoint> = (0..n)
            .map(|i| GridPoint {
                at: position(i),
                depth: 0.0,
            })
            .collect();
        let mut counts = vec![[0_u8; SAMPLES]; (TILE * TILE) as usize];
        let mut count = |triangle: [usize; 3]| {
            let mut tile = Tile::new();
            (tile.right, tile.bottom) = (TILE, TILE);
            tile.draw(0, &triangle.map(|i| corners[i]), u16::MAX);
            for (counts, triangles) in counts.iter_mut().zip(&tile.triangles) {
                for (count, &triangle) in counts.iter_mut().zip(triangles) {
                    *count += u8::from(triangle != NO_TRIANGLE);
                }
            }
        };
        let columns = usize::try_from(cells).unwrap();
        for y in 0..columns {
            for x in 0..columns {
                let a = y * (columns + 1) + x;
                let [b, c, d] = [a + 1, a + columns + 2, a + columns + 1];
                // The orientation of a triangle does not matter.
                count([a, b, c]);
                count([a, d, c]);
            }
        }
        assert!(counts.iter().flatten().all(|&n| n == 1), "{cells} cells");
    }
}

#[test]
fn a_square_with_sides_between_pixels_covers_exactly_these_pixels() {
    let size = [8, 8];
    // The square reaches from pixel 2 to pixel 6 in each axis.
    let corners = [[-2.0, -2.0], [2.0, -2.0], [2.0, 2.0], [-2.0, 2.0]];
    let points = corners.map(|[x, y]| DVec3::new(x, y, 0.0)).to_vec();
    let square = drawing(vec![part(points, vec![[0, 1, 2], [0, 2, 3]], WHITE)]);
    let picture = rendered(&square, &front_view(8.0, size), size, &plain());
    for (i, pixel) in picture.image.pixels.iter().enumerate() {
        let inside = (2..6).contains(&(i % 8)) && (2..6).contains(&(i / 8));
        assert_eq!(*pixel, if inside { [255; 4] } else { [0; 4] }, "pixel {i}");
    }
}

/// Returns a triangulated sphere around the origin.
fn sphere(radius: f64) -> Part<'static> {
    let mesh = geometry::shapes::fans(&geometry::shapes::uv_sphere(192, 96));
    let mut triangles = Vec::new();
    for f in mesh.faces() {
        let corners: Vec<u32> = mesh
            .face_vertices(f)
            .map(|v| u32::try_from(v.index()).unwrap())
            .collect();
        triangles.push(corners.try_into().unwrap());
    }
    let outwards = |p: &DVec3| p.normalize() * radius;
    part(
        mesh.positions().iter().map(outwards).collect(),
        triangles,
        WHITE,
    )
}

#[test]
fn a_sphere_covers_the_area_of_its_outline() {
    let size = [200, 200];
    let ball = drawing(vec![sphere(1.0)]);
    // Without perspective, the outline of the sphere is a circle with a radius of 80 pixels.
    let orthographic = covered(&rendered(&ball, &front_view(2.5, size), size, &plain()));
    let expected = std::f64::consts::PI * 80.0 * 80.0;
    assert!(
        (orthographic / expected - 1.0).abs() < 2e-3,
        "{orthographic}, {expected}"
    );
    // Seen from the distance d, the outline of the sphere is a circle with the half angle asin(1 / d).
    let camera = Camera::LookAt {
        from: [0.0, 0.0, 3.0],
        to: [0.0; 3],
        up: Up::Y,
        projection: Projection::Perspective { angle: 60.0 },
    };
    let view = View::new(&camera, &|_| {}, size).unwrap();
    let perspective = covered(&rendered(&ball, &view, size, &plain()));
    let radius = 100.0 * libm::tan(libm::asin(1.0 / 3.0)) / libm::tan(30.0_f64.to_radians());
    let expected = std::f64::consts::PI * radius * radius;
    assert!(
        (perspective / expected - 1.0).abs() < 2e-3,
        "{perspective}, {expected}"
    );
}

#[test]
fn any_number_of_threads_gives_the_same_bytes() {
    let mut drawing = drawing(vec![sphere(1.0), sphere(0.8)]);
    drawing.parts[1]
        .points
        .to_mut()
        .iter_mut()
        .for_each(|p| p.x += 0.7);
    drawing.lines = drawing.parts[0]
        .triangles
        .iter()
        .map(|&[a, b, _]| Line {
            ends: [a, b].map(|v| drawing.parts[0].points[v as usize]),
            width: 1.0,
            color: [0.0, 0.0, 0.0, 0.7],
            faces: [NO_FACE; 2],
            hidden: 0.2,
            spacing: 0.05,
        })
        .collect();
    let look = Look {
        shading: Shading::Phong,
        occlusion: 0.8,
        background: [1.0; 4],
    };
    let size = [150, 90];
    let view = View::new(&Camera::default(), &|each| drawing.each_point(each), size).unwrap();
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.unwrap()
            .install(|| rendered(&drawing, &view, size, &look))
    };
    let one = with(1);
    assert_eq!(one, with(2));
    assert_eq!(one, with(8));
}

#[test]
fn rendering_reports_progress_and_can_be_cancelled_at_each_stage() {
    let drawing = drawing(vec![sphere(1.0)]);
    let look = Look {
        shading: Shading::Smooth,
        occlusion: 0.8,
        background: [1.0; 4],
    };
    let size = [200, 90];
    let view = View::new(&Camera::default(), &|each| drawing.each_point(each), size).unwrap();
    let reported = std::sync::Mutex::new(Vec::new());
    let render_until = |end: f64| {
        reported.lock().unwrap().clear();
        let listener = Listener(|fraction| {
            reported.lock().unwrap().push(fraction);
            fraction < end
        });
        render(&drawing, &view, size, &look, &listener)
    };
    let complete = render_until(2.0).unwrap();
    assert_eq!(complete, rendered(&drawing, &view, size, &look));
    let fractions = reported.lock().unwrap().clone();
    assert!(
        fractions.is_sorted() && fractions.len() > 50,
        "{fractions:?}"
    );
    assert!(fractions[0] == 0.0 && fractions[fractions.len() - 1] > 0.99);
    // The listener cancels the work at the start, while triangles are sorted into tiles, while depth maps are drawn, or
    // while tiles are drawn. After that, the listener must not be called again.
    for end in [0.0, 0.05, 0.3, 0.9] {
        let result = render_until(end);
        assert!(matches!(result, Err(PictureError::Cancelled)), "{end}");
        let reported = reported.lock().unwrap();
        let n_after_end = reported.iter().filter(|&&fraction| fraction >= end).count();
        assert_eq!(n_after_end, 1, "{end}");
    }
}

#[test]
fn the_nearer_of_intersecting_triangles_is_visible() {
    // A red and a blue triangle intersect along x = 0. The red triangle is nearer on the left side.
    let size = [32, 32];
    let triangle = |slope: f64| {
        [[-3.0, -3.0], [3.0, -3.0], [0.0, 6.0]]
            .map(|[x, y]| DVec3::new(x, y, slope * x))
            .to_vec()
    };
    let (red, blue) = ([1.0, 0.0, 0.0], [0.0, 0.0, 1.0]);
    let parts = vec![
        part(triangle(-0.5), vec![[0, 1, 2]], red),
        part(triangle(0.5), vec![[0, 1, 2]], blue),
    ];
    for is_reversed in [false, true] {
        let mut parts = parts.clone();
        if is_reversed {
            parts.reverse();
        }
        let picture = rendered(&drawing(parts), &front_view(2.0, size), size, &plain());
        for (i, &[r, _, b, a]) in picture.image.pixels.iter().enumerate() {
            let expected = if i % 32 < 16 { [255, 0] } else { [0, 255] };
            assert_eq!(([r, b], a), (expected, 255), "pixel {i}");
        }
    }
}

#[test]
fn the_first_of_two_coplanar_triangles_is_visible() {
    let size = [16, 16];
    let triangle = [[-9.0, -9.0], [9.0, -9.0], [0.0, 18.0]];
    let points = triangle.map(|[x, y]| DVec3::new(x, y, 0.0)).to_vec();
    let one = |color| part(points.clone(), vec![[0, 1, 2]], color);
    let both = drawing(vec![one([1.0, 0.0, 0.0]), one([0.0, 0.0, 1.0])]);
    let picture = rendered(&both, &front_view(2.0, size), size, &plain());
    assert!(picture.image.pixels.iter().all(|p| *p == [255, 0, 0, 255]));
}

#[test]
fn a_plane_is_lit_by_the_cosine_of_its_angle() {
    let size = [3, 3];
    for degrees in [-60.0_f64, -30.0, 0.0, 20.0, 45.0, 70.0] {
        let (sin, cos) = libm::sincos(degrees.to_radians());
        // The square is rotated about the x axis, so that its upper half is away from the camera.
        let up = DVec3::new(0.0, cos, -sin) * 50.0;
        let points = vec![
            -DVec3::X * 50.0 - up,
            DVec3::X * 50.0 - up,
            DVec3::X * 50.0 + up,
            -DVec3::X * 50.0 + up,
        ];
        let color = [0.5, 0.4, 0.3];
        let plane = drawing(vec![part(points, vec![[0, 1, 2], [0, 2, 3]], color)]);
        let look = Look {
            shading: Shading::Flat,
            ..plain()
        };
        let picture = rendered(&plane, &front_view(2.0, size), size, &look);
        // Lambert, "Photometria", 1760.
        let n = DVec3::new(0.0, sin, cos);
        let lambert = |light: DVec3| n.dot(light.normalize()).max(0.0);
        for i in 0..3 {
            let sky = f64::from(GROUND[i])
                + (f64::from(SKY[i]) - f64::from(GROUND[i])) * (0.5 + 0.5 * n.y);
            let light = sky
                + f64::from(KEY_LIGHT[i]) * lambert(KEY)
                + f64::from(FILL_LIGHT[i]) * lambert(FILL);
            let expected = light * f64::from(color[i]);
            let found = f64::from(to_linear(picture.image.pixels[4][i]));
            // The light values of two consecutive bytes differ by up to 0.9 % of full light.
            assert!(
                (found - expected).abs() < 0.005,
                "{degrees}: {found}, {expected}"
            );
        }
    }
}

#[test]
fn a_line_covers_the_same_area_in_every_direction() {
    let size = [200, 200];
    // An angle of 45 degrees is not tested. At this angle, all border pixels have the same error, which is a few
    // percent with 16 samples.
    for degrees in [0.0_f64, 17.0, 43.0, 80.0] {
        let (sin, cos) = libm::sincos(degrees.to_radians());
        let along = DVec3::new(cos, sin, 0.0) * 60.0;
        let line = Line {
            ends: [-along, along],
            width: 3.0,
            color: [0.0, 0.0, 0.0, 1.0],
            faces: [NO_FACE; 2],
            hidden: 0.0,
            spacing: f64::INFINITY,
        };
        let mut lines = Drawing::default();
        lines.lines.push(line);
        let picture = rendered(&lines, &front_view(200.0, size), size, &plain());
        // The line covers a rectangle and two half discs.
        let expected = 120.0 * 3.0 + std::f64::consts::PI * 1.5 * 1.5;
        let found = covered(&picture);
        assert!((found / expected - 1.0).abs() < 0.01, "{degrees}: {found}");
    }
}

#[test]
fn lines_cover_no_more_than_half_of_a_dense_mesh() {
    let size = [128, 128];
    for (side, n) in [(1.0, 220), (3.0, 75), (6.0, 38), (20.0, 13)] {
        // The lines are the edges of equilateral triangles that fill the picture.
        let position = |i: i32, j: i32| {
            let x = f64::from(i) + 0.5 * f64::from(j);
            DVec3::new(x, f64::from(j) * 0.75_f64.sqrt(), 0.0) * side
        };
        let mut lines = Drawing::default();
        for (i, j) in (-n..n).flat_map(|i| (-n..n).map(move |j| (i, j))) {
            let p = position(i, j);
            if p.abs().max_element() > 70.0 + side {
                continue;
            }
            let neighbors = [(i + 1, j), (i, j + 1), (i - 1, j + 1)];
            for q in neighbors.map(|(i, j)| position(i, j)) {
                lines.lines.push(Line {
                    ends: [p, q],
                    width: 1.0,
                    color: [0.0, 0.0, 0.0, 1.0],
                    faces: [NO_FACE; 2],
                    hidden: 0.0,
                    spacing: side,
                });
            }
        }
        let picture = rendered(&lines, &front_view(128.0, size), size, &plain());
        let found = covered(&picture) / 128.0 / 128.0;
        let width = 1.0_f64.min(0.15 * side);
        // Lines overlap near vertices, so the covered area is less than the sum of the areas of the lines.
        let sum = 2.0 * 3.0_f64.sqrt() * width / side;
        assert!(
            (0.7 * sum..1.02 * sum).contains(&found),
            "{side}: {found}, {sum}"
        );
    }
}

#[test]
fn a_line_is_hidden_behind_a_surface_and_visible_on_it() {
    let size = [64, 64];
    let plane = |z: f64| {
        let corners = [[-9.0, -9.0], [9.0, -9.0], [9.0, 9.0], [-9.0, 9.0]];
        let points = corners.map(|[x, y]| DVec3::new(x, y, z + 0.8 * x)).to_vec();
        part(points, vec![[0, 1, 2], [0, 2, 3]], WHITE)
    };
    let with_line = |z: f64, hidden: f32| {
        let mut drawing = drawing(vec![plane(0.0)]);
        drawing.lines.push(Line {
            ends: [[-1.5, -1.0], [1.5, 1.0]].map(|[x, y]| DVec3::new(x, y, z + 0.8 * x)),
            width: 6.0,
            color: [0.0, 0.0, 0.0, 1.0],
            faces: [NO_FACE; 2],
            hidden,
            spacing: f64::INFINITY,
        });
        let picture = rendered(&drawing, &front_view(4.0, size), size, &plain());
        let light = |p: &[u8; 4]| 1.0 - f64::from(to_linear(p[0]));
        picture.image.pixels.iter().map(light).sum::<f64>()
    };
    // The line must be visible in its full width if it is on the slanted surface or in front of it.
    let visible = with_line(0.5, 0.0);
    assert!(visible > 300.0, "{visible}");
    assert_eq!(with_line(0.0, 0.0), visible);
    assert_eq!(with_line(-1.0, 0.0), 0.0);
    let faint = with_line(-1.0, 0.25);
    assert!((faint / visible - 0.25).abs() < 0.02, "{faint}");
}

#[test]
fn a_visible_point_is_a_disc_and_a_hidden_point_is_a_ring() {
    let size = [41, 41];
    let corners = [[-9.0, -9.0], [9.0, -9.0], [9.0, 9.0], [-9.0, 9.0]];
    let points = corners.map(|[x, y]| DVec3::new(x, y, 0.0)).to_vec();
    let lights = |z: f64| {
        let mut drawing = drawing(vec![part(
            points.clone(),
            vec![[0, 1, 2], [0, 2, 3]],
            WHITE,
        )]);
        drawing.lines.push(Line {
            ends: [DVec3::Z * z; 2],
            width: 20.0,
            color: [0.0, 0.0, 0.0, 1.0],
            faces: [NO_FACE; 2],
            hidden: 0.5,
            spacing: f64::INFINITY,
        });
        let picture = rendered(&drawing, &front_view(4.0, size), size, &plain());
        // The result has pixels from the middle of the picture to the right.
        [0, 4, 8, 14].map(|x| to_linear(picture.image.pixels[20 * 41 + 20 + x][0]))
    };
    assert_eq!(lights(0.5), [0.0, 0.0, 0.0, 1.0]);
    let [middle, inside, ring, outside] = lights(-3.0);
    assert_eq!([middle, inside, outside], [1.0; 3]);
    assert!((ring - 0.5).abs() < 0.01, "{ring}");
}

#[test]
fn labels_behind_triangles_are_hidden_and_labels_outside_have_no_position() {
    let size = [32, 32];
    let triangle = [[-9.0, -9.0], [9.0, -9.0], [0.0, 18.0]];
    let points = triangle.map(|[x, y]| DVec3::new(x, y, 0.0)).to_vec();
    let mut drawing = drawing(vec![part(points, vec![[0, 1, 2]], WHITE)]);
    for at in [DVec3::Z, DVec3::ZERO, -DVec3::Z, DVec3::X * 9.0] {
        let text = String::new();
        drawing.labels.push(Label { at, text });
    }
    let picture = rendered(&drawing, &front_view(2.0, size), size, &plain());
    let hidden: Vec<_> = picture
        .labels
        .iter()
        .map(|l| l.map(|l| l.is_hidden))
        .collect();
    assert_eq!(hidden, [Some(false), Some(false), Some(true), None]);
    assert_eq!(picture.labels[0].unwrap().at, DVec2::splat(16.0));
}

#[test]
fn triangles_are_clipped_behind_the_camera() {
    // The floor reaches from far in front of the camera to far behind the camera. The camera is just above the floor.
    let size = [64, 64];
    let corners = [[-1e6, -1e6], [1e6, -1e6], [1e6, 1e6], [-1e6, 1e6]];
    let points = corners.map(|[x, z]| DVec3::new(x, 0.0, z)).to_vec();
    let floor = drawing(vec![part(points, vec![[0, 1, 2], [0, 2, 3]], WHITE)]);
    let camera = Camera::LookAt {
        from: [0.0, 1.0, 0.0],
        to: [0.0, 1.0, -1.0],
        up: Up::Y,
        projection: Projection::Perspective { angle: 60.0 },
    };
    let view = View::new(&camera, &|_| {}, size).unwrap();
    let picture = rendered(&floor, &view, size, &plain());
    for (i, pixel) in picture.image.pixels.iter().enumerate() {
        let row = i / 64;
        if row != 31 && row != 32 {
            assert_eq!(pixel[3], if row > 32 { 255 } else { 0 }, "row {row}");
        }
    }
}

#[test]
fn the_openness_at_the_bottom_of_a_cup_is_that_of_its_opening() {
    // The scene is an open cylinder of radius 1 with a bottom. The opening has the radius r and the distance h from the
    // bottom. Seen from the middle of the bottom, the opening fills the fraction r² / (r² + h²) of the cosine-weighted
    // hemisphere.
    let n_sides = 64;
    for height in [0.5, 1.0, 2.0] {
        let mut points = vec![DVec3::ZERO];
        let mut triangles = Vec::new();
        for i in 0..n_sides {
            let angle = std::f64::consts::TAU * f64::from(i) / f64::from(n_sides);
            let (sin, cos) = libm::sincos(angle);
            points.push(DVec3::new(cos, sin, 0.0));
            points.push(DVec3::new(cos, sin, height));
            let j = (i + 1) % n_sides;
            let [a, b, c, d] = [1 + 2 * i, 1 + 2 * j, 2 + 2 * j, 2 + 2 * i];
            triangles.extend([[a, b, c], [a, c, d], [0, a, b]]);
        }
        let cup = drawing(vec![part(points, triangles, WHITE)]);
        let occlusion = super::occlusion::Occlusion::new(&cup, [1024, 1024], |_| Ok(())).unwrap();
        let expected = 1.0 / (1.0 + height * height);
        let found = f64::from(occlusion.openness(DVec3::ZERO, DVec3::Z));
        assert!(
            (found - expected).abs() < 0.05,
            "{height}: {found}, {expected}"
        );
        let outside = occlusion.openness(DVec3::ZERO, -DVec3::Z);
        assert!(outside > 0.99, "{outside}");
    }
}

#[test]
fn a_transparent_surface_does_not_occlude_the_surface_below_it() {
    let plane = |z: f64, alpha: f32| {
        let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
        let points = corners.map(|[x, y]| DVec3::new(x, y, z)).to_vec();
        let mut plane = part(points, vec![[0, 1, 2], [0, 2, 3]], WHITE);
        plane.materials[0].color[3] = alpha;
        plane
    };
    let open = |alpha: f32| {
        let drawing = drawing(vec![plane(0.0, 1.0), plane(0.3, alpha)]);
        let size = [300, 300];
        let occlusion = super::occlusion::Occlusion::new(&drawing, size, |_| Ok(())).unwrap();
        occlusion.openness(DVec3::ZERO, DVec3::Z)
    };
    assert!(
        open(0.2) > 0.99 && open(1.0) < 0.3,
        "{}, {}",
        open(0.2),
        open(1.0)
    );
}

#[test]
fn the_coverage_of_a_transparent_surface_is_its_alpha() {
    let size = [16, 16];
    let triangle = [[-9.0, -9.0], [9.0, -9.0], [0.0, 18.0]];
    let points = triangle.map(|[x, y]| DVec3::new(x, y, 0.0)).to_vec();
    for sixteenths in 0..=16_u8 {
        let mut glass = part(points.clone(), vec![[0, 1, 2]], WHITE);
        glass.materials[0].color[3] = f32::from(sixteenths) / 16.0;
        let picture = rendered(
            &drawing(vec![glass]),
            &front_view(2.0, size),
            size,
            &plain(),
        );
        let expected = crate::color::byte(f32::from(sixteenths) / 16.0);
        assert!(picture.image.pixels.iter().all(|p| p[3] == expected));
    }
}

#[test]
fn degenerate_drawings_are_rendered() {
    let p = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
    let line = Line {
        ends: [DVec3::ZERO; 2],
        width: 3.0,
        color: [0.0, 0.0, 0.0, 1.0],
        faces: [NO_FACE; 2],
        hidden: 1.0,
        spacing: f64::INFINITY,
    };
    let dot = Drawing {
        lines: vec![line],
        ..Drawing::default()
    };
    let drawings = [
        Drawing::default(),
        dot,
        // The first three triangles are a point, a line, and a triangle that is seen edge-on. The other triangles are
        // very large, huge, very small, or far from the origin.
        drawing(vec![part(vec![DVec3::ZERO; 3], vec![[0, 1, 2]], WHITE)]),
        drawing(vec![part(
            vec![p(0., 0., 0.), p(1., 0., 0.), p(2., 0., 0.)],
            vec![[0, 1, 2]],
            WHITE,
        )]),
        drawing(vec![part(
            vec![p(0., 0., 0.), p(0., 1., 0.), p(0., 0., 1.)],
            vec![[0, 1, 2]],
            WHITE,
        )]),
        drawing(vec![part(
            vec![p(0., 0., 0.), p(1e200, 0., 0.), p(0., 1e200, 1e200)],
            vec![[0, 1, 2]],
            WHITE,
        )]),
        drawing(vec![part(
            vec![p(0., 0., 0.), p(f64::MAX, 0., 0.), p(f64::MIN, 1., 1.)],
            vec![[0, 1, 2]],
            WHITE,
        )]),
        drawing(vec![part(
            vec![p(0., 0., 0.), p(1e-200, 0., 0.), p(0., 1e-200, 1e-200)],
            vec![[0, 1, 2]],
            WHITE,
        )]),
        drawing(vec![part(
            vec![p(1e15, 0., 0.), p(1e15 + 1., 0., 0.), p(1e15, 1., 0.)],
            vec![[0, 1, 2]],
            WHITE,
        )]),
    ];
    let look = Look {
        shading: Shading::Phong,
        occlusion: 1.0,
        background: [1.0; 4],
    };
    for (i, drawing) in drawings.iter().enumerate() {
        for projection in [Projection::Orthographic, Projection::default()] {
            for (from, steady) in [
                (Side::Front, false),
                (Side::Top, true),
                (Side::default(), false),
            ] {
                let camera = Camera::Fit {
                    from,
                    up: Up::Z,
                    projection,
                    margin: 0.0,
                    steady,
                };
                for size in [[1, 1], [40, 3], [3, 40]] {
                    let view = View::new(&camera, &|each| drawing.each_point(each), size).unwrap();
                    let picture = rendered(drawing, &view, size, &look);
                    let n = picture.image.pixels.len();
                    assert_eq!(n, (size[0] * size[1]) as usize, "drawing {i}");
                    assert!(picture.image.pixels.iter().all(|p| p[3] == 255));
                }
            }
        }
    }
}
