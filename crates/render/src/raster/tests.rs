//! The rasteriser against scenes whose pictures can be computed in another way.

use glam::{DVec2, DVec3};
use progress::NoProgress;

use super::project::{Corner, GRID};
use super::shade::{FILL, FILL_LIGHT, GROUND, KEY, KEY_LIGHT, SKY};
use super::tile::{NOTHING, SAMPLES, Tile};
use super::{Look, Rendered, TILE, render};
use crate::drawing::{Channel, Drawing, Label, Line, NO_FACE, Part, Surface};
use crate::style::Shading;
use crate::work::While;
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
        marks: Vec::new(),
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

/// Colors as they are, on nothing.
fn plain() -> Look {
    Look {
        shading: Shading::Plain,
        occlusion: 0.0,
        background: [0.0; 4],
    }
}

/// A camera before the plane z = 0 whose picture is `height` units high.
fn before(height: f64, size: [u32; 2]) -> View {
    // What `LookAt` shows without perspective, as its documentation says.
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

/// How many pixels are covered, in parts too.
fn covered(picture: &Rendered) -> f64 {
    let alphas = picture.image.pixels.iter().map(|p| f64::from(p[3]));
    alphas.sum::<f64>() / 255.0
}

/// Numbers that look random: `SplitMix64`.
fn random(seed: &mut u64) -> i32 {
    *seed = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut z = *seed;
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    i32::try_from(z >> 48).unwrap()
}

#[test]
fn a_sample_has_a_row_and_a_column_of_its_own() {
    let mut rows: Vec<_> = super::tile::PLACES.iter().map(|p| p[1]).collect();
    let mut columns: Vec<_> = super::tile::PLACES.iter().map(|p| p[0]).collect();
    rows.sort_unstable();
    columns.sort_unstable();
    let expected: Vec<i32> = (0..16).map(|i| i * 16 + 8 - 128).collect();
    assert_eq!((&rows, &columns), (&expected, &expected));
}

#[test]
fn triangles_that_fill_a_square_cover_every_sample_once() {
    // A grid with moved points, over the tile and beyond; the steps make both ways of counting edges run.
    for (seed, cells) in [(1, 40), (2, 7), (3, 2)] {
        let mut seed = seed;
        let tile_size = GRID * i32::try_from(TILE).unwrap();
        let (step, low) = (2 * tile_size / cells, -tile_size / 2);
        let mut place = |i: i32| -> [i32; 2] {
            let (x, y) = (i % (cells + 1), i / (cells + 1));
            let is_inside = x > 0 && y > 0 && x < cells && y < cells;
            // Multiples of 8: many lie exactly on samples.
            let aside = |r: i32| {
                if is_inside {
                    (r % (step / 3)) / 8 * 8
                } else {
                    0
                }
            };
            [
                low + x * step + aside(random(&mut seed)),
                low + y * step + aside(random(&mut seed)),
            ]
        };
        let n = (cells + 1) * (cells + 1);
        let corners: Vec<Corner> = (0..n)
            .map(|i| Corner {
                at: place(i),
                depth: 0.0,
            })
            .collect();
        let mut counts = vec![[0_u8; SAMPLES]; (TILE * TILE) as usize];
        let mut cover = |flat: [usize; 3]| {
            let mut tile = Tile::new();
            (tile.right, tile.bottom) = (TILE, TILE);
            tile.draw(0, &flat.map(|i| corners[i]), u16::MAX);
            for (counts, seen) in counts.iter_mut().zip(&tile.seen) {
                for (count, &seen) in counts.iter_mut().zip(seen) {
                    *count += u8::from(seen != NOTHING);
                }
            }
        };
        let columns = usize::try_from(cells).unwrap();
        for y in 0..columns {
            for x in 0..columns {
                let a = y * (columns + 1) + x;
                let [b, c, d] = [a + 1, a + columns + 2, a + columns + 1];
                // Turned both ways: the order of corners does not matter.
                cover([a, b, c]);
                cover([a, d, c]);
            }
        }
        assert!(counts.iter().flatten().all(|&n| n == 1), "{cells} cells");
    }
}

#[test]
fn a_square_of_whole_pixels_is_exactly_them() {
    let size = [8, 8];
    // From pixel 2 to pixel 6 each way.
    let corners = [[-2.0, -2.0], [2.0, -2.0], [2.0, 2.0], [-2.0, 2.0]];
    let points = corners.map(|[x, y]| DVec3::new(x, y, 0.0)).to_vec();
    let square = drawing(vec![part(points, vec![[0, 1, 2], [0, 2, 3]], WHITE)]);
    let picture = rendered(&square, &before(8.0, size), size, &plain());
    for (i, pixel) in picture.image.pixels.iter().enumerate() {
        let inside = (2..6).contains(&(i % 8)) && (2..6).contains(&(i / 8));
        assert_eq!(*pixel, if inside { [255; 4] } else { [0; 4] }, "pixel {i}");
    }
}

/// A sphere around the origin, of triangles.
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
    // Without perspective a disc of 80 pixels.
    let flat = covered(&rendered(&ball, &before(2.5, size), size, &plain()));
    let expected = std::f64::consts::PI * 80.0 * 80.0;
    assert!((flat / expected - 1.0).abs() < 2e-3, "{flat}, {expected}");
    // From the distance d the outline is a circle with the half angle asin(1 / d).
    let camera = Camera::LookAt {
        from: [0.0, 0.0, 3.0],
        to: [0.0; 3],
        up: Up::Y,
        projection: Projection::Perspective { angle: 60.0 },
    };
    let view = View::new(&camera, &|_| {}, size).unwrap();
    let seen = covered(&rendered(&ball, &view, size, &plain()));
    let radius = 100.0 * libm::tan(libm::asin(1.0 / 3.0)) / libm::tan(30.0_f64.to_radians());
    let expected = std::f64::consts::PI * radius * radius;
    assert!((seen / expected - 1.0).abs() < 2e-3, "{seen}, {expected}");
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
            room: 0.05,
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
fn drawing_says_how_far_it_is_and_stops_where_it_is_told_to() {
    let drawing = drawing(vec![sphere(1.0)]);
    let look = Look {
        shading: Shading::Smooth,
        occlusion: 0.8,
        background: [1.0; 4],
    };
    let size = [200, 90];
    let view = View::new(&Camera::default(), &|each| drawing.each_point(each), size).unwrap();
    let told = std::sync::Mutex::new(Vec::new());
    let until = |end: f64| {
        told.lock().unwrap().clear();
        let go_on = While(|part| {
            told.lock().unwrap().push(part);
            part < end
        });
        render(&drawing, &view, size, &look, &go_on)
    };
    let whole = until(2.0).unwrap();
    assert_eq!(whole, rendered(&drawing, &view, size, &look));
    let parts = told.lock().unwrap().clone();
    assert!(parts.is_sorted() && parts.len() > 50, "{parts:?}");
    assert!(parts[0] == 0.0 && parts[parts.len() - 1] > 0.99);
    // While nothing, triangles, maps and tiles are done; nobody is asked again.
    for end in [0.0, 0.05, 0.3, 0.9] {
        let stopped = until(end);
        assert!(matches!(stopped, Err(PictureError::Cancelled)), "{end}");
        let told = told.lock().unwrap();
        assert_eq!(told.iter().filter(|&&part| part >= end).count(), 1, "{end}");
    }
}

#[test]
fn the_nearer_of_crossing_triangles_is_seen() {
    // Two triangles through each other along x = 0: the red one is nearer on the left.
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
    for is_turned in [false, true] {
        let mut parts = parts.clone();
        if is_turned {
            parts.reverse();
        }
        let picture = rendered(&drawing(parts), &before(2.0, size), size, &plain());
        for (i, &[r, _, b, a]) in picture.image.pixels.iter().enumerate() {
            let expected = if i % 32 < 16 { [255, 0] } else { [0, 255] };
            assert_eq!(([r, b], a), (expected, 255), "pixel {i}");
        }
    }
}

#[test]
fn of_two_triangles_in_one_plane_the_first_is_seen() {
    let size = [16, 16];
    let triangle = [[-9.0, -9.0], [9.0, -9.0], [0.0, 18.0]];
    let points = triangle.map(|[x, y]| DVec3::new(x, y, 0.0)).to_vec();
    let one = |color| part(points.clone(), vec![[0, 1, 2]], color);
    let both = drawing(vec![one([1.0, 0.0, 0.0]), one([0.0, 0.0, 1.0])]);
    let picture = rendered(&both, &before(2.0, size), size, &plain());
    assert!(picture.image.pixels.iter().all(|p| *p == [255, 0, 0, 255]));
}

#[test]
fn a_plane_is_lit_by_the_cosine_of_its_angle() {
    let size = [3, 3];
    for degrees in [-60.0_f64, -30.0, 0.0, 20.0, 45.0, 70.0] {
        let (sin, cos) = libm::sincos(degrees.to_radians());
        // Turned about the x axis: its upper half leans back.
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
        let picture = rendered(&plane, &before(2.0, size), size, &look);
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
            // A byte is up to 0.9 % of full light.
            assert!(
                (found - expected).abs() < 0.005,
                "{degrees}: {found}, {expected}"
            );
        }
    }
}

#[test]
fn a_line_has_its_width_everywhere() {
    let size = [200, 200];
    // At 45 degrees each pixel has the same part, which 16 samples know to some percent only.
    for degrees in [0.0_f64, 17.0, 43.0, 80.0] {
        let (sin, cos) = libm::sincos(degrees.to_radians());
        let along = DVec3::new(cos, sin, 0.0) * 60.0;
        let line = Line {
            ends: [-along, along],
            width: 3.0,
            color: [0.0, 0.0, 0.0, 1.0],
            faces: [NO_FACE; 2],
            hidden: 0.0,
            room: f64::INFINITY,
        };
        let mut lines = Drawing::default();
        lines.lines.push(line);
        let picture = rendered(&lines, &before(200.0, size), size, &plain());
        // A rectangle and two half discs.
        let expected = 120.0 * 3.0 + std::f64::consts::PI * 1.5 * 1.5;
        let found = covered(&picture);
        assert!((found / expected - 1.0).abs() < 0.01, "{degrees}: {found}");
    }
}

#[test]
fn lines_cover_no_more_than_half_of_a_dense_mesh() {
    let size = [128, 128];
    for (side, n) in [(1.0, 220), (3.0, 75), (6.0, 38), (20.0, 13)] {
        // The sides of regular triangles, over the whole picture.
        let place = |i: i32, j: i32| {
            let aside = f64::from(i) + 0.5 * f64::from(j);
            DVec3::new(aside, f64::from(j) * 0.75_f64.sqrt(), 0.0) * side
        };
        let mut lines = Drawing::default();
        for (i, j) in (-n..n).flat_map(|i| (-n..n).map(move |j| (i, j))) {
            let p = place(i, j);
            if p.abs().max_element() > 70.0 + side {
                continue;
            }
            for q in [place(i + 1, j), place(i, j + 1), place(i - 1, j + 1)] {
                lines.lines.push(Line {
                    ends: [p, q],
                    width: 1.0,
                    color: [0.0, 0.0, 0.0, 1.0],
                    faces: [NO_FACE; 2],
                    hidden: 0.0,
                    room: side,
                });
            }
        }
        let picture = rendered(&lines, &before(128.0, size), size, &plain());
        let found = covered(&picture) / 128.0 / 128.0;
        let width = 1.0_f64.min(0.15 * side);
        // Without what lies in two lines.
        let most = 2.0 * 3.0_f64.sqrt() * width / side;
        assert!(
            (0.7 * most..1.02 * most).contains(&found),
            "{side}: {found}, {most}"
        );
    }
}

#[test]
fn a_line_is_hidden_behind_a_surface_and_seen_on_it() {
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
            room: f64::INFINITY,
        });
        let picture = rendered(&drawing, &before(4.0, size), size, &plain());
        let light = |p: &[u8; 4]| 1.0 - f64::from(to_linear(p[0]));
        picture.image.pixels.iter().map(light).sum::<f64>()
    };
    // On the surface, and before it: all of it, though the surface is slanted and the line thick.
    let whole = with_line(0.5, 0.0);
    assert!(whole > 300.0, "{whole}");
    assert_eq!(with_line(0.0, 0.0), whole);
    assert_eq!(with_line(-1.0, 0.0), 0.0);
    let faint = with_line(-1.0, 0.25);
    assert!((faint / whole - 0.25).abs() < 0.02, "{faint}");
}

#[test]
fn a_point_is_a_disc_and_a_ring_where_it_is_hidden() {
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
            room: f64::INFINITY,
        });
        let picture = rendered(&drawing, &before(4.0, size), size, &plain());
        // From the middle to the right.
        [0, 4, 8, 14].map(|x| to_linear(picture.image.pixels[20 * 41 + 20 + x][0]))
    };
    assert_eq!(lights(0.5), [0.0, 0.0, 0.0, 1.0]);
    let [middle, inside, ring, outside] = lights(-3.0);
    assert_eq!([middle, inside, outside], [1.0; 3]);
    assert!((ring - 0.5).abs() < 0.01, "{ring}");
}

#[test]
fn labels_know_what_is_before_them() {
    let size = [32, 32];
    let triangle = [[-9.0, -9.0], [9.0, -9.0], [0.0, 18.0]];
    let points = triangle.map(|[x, y]| DVec3::new(x, y, 0.0)).to_vec();
    let mut drawing = drawing(vec![part(points, vec![[0, 1, 2]], WHITE)]);
    for at in [DVec3::Z, DVec3::ZERO, -DVec3::Z, DVec3::X * 9.0] {
        let text = String::new();
        drawing.labels.push(Label { at, text });
    }
    let picture = rendered(&drawing, &before(2.0, size), size, &plain());
    let hidden: Vec<_> = picture
        .labels
        .iter()
        .map(|l| l.map(|l| l.is_hidden))
        .collect();
    assert_eq!(hidden, [Some(false), Some(false), Some(true), None]);
    assert_eq!(picture.labels[0].unwrap().at, DVec2::splat(16.0));
}

#[test]
fn what_is_behind_the_camera_is_cut_away() {
    // A floor from far before the camera to far behind it, with a point of view just above.
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
fn the_bottom_of_a_cup_sees_as_much_as_its_opening() {
    // An open cylinder of radius 1 with a bottom, seen from its middle: the opening of radius r at the
    // distance h fills r² / (r² + h²) of the cosine-weighted half space.
    let around = 64;
    for height in [0.5, 1.0, 2.0] {
        let mut points = vec![DVec3::ZERO];
        let mut triangles = Vec::new();
        for i in 0..around {
            let (sin, cos) = libm::sincos(std::f64::consts::TAU * f64::from(i) / f64::from(around));
            points.push(DVec3::new(cos, sin, 0.0));
            points.push(DVec3::new(cos, sin, height));
            let j = (i + 1) % around;
            let [a, b, c, d] = [1 + 2 * i, 1 + 2 * j, 2 + 2 * j, 2 + 2 * i];
            triangles.extend([[a, b, c], [a, c, d], [0, a, b]]);
        }
        let cup = drawing(vec![part(points, triangles, WHITE)]);
        let occlusion = super::occlusion::Occlusion::new(&cup, [1024, 1024], |_| Ok(())).unwrap();
        let expected = 1.0 / (1.0 + height * height);
        let found = f64::from(occlusion.open(DVec3::ZERO, DVec3::Z));
        assert!(
            (found - expected).abs() < 0.05,
            "{height}: {found}, {expected}"
        );
        let outside = occlusion.open(DVec3::ZERO, -DVec3::Z);
        assert!(outside > 0.99, "{outside}");
    }
}

#[test]
fn glass_does_not_darken_what_is_below_it() {
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
        occlusion.open(DVec3::ZERO, DVec3::Z)
    };
    assert!(
        open(0.2) > 0.99 && open(1.0) < 0.3,
        "{}, {}",
        open(0.2),
        open(1.0)
    );
}

#[test]
fn transparent_surfaces_cover_as_much_as_their_alpha() {
    let size = [16, 16];
    let triangle = [[-9.0, -9.0], [9.0, -9.0], [0.0, 18.0]];
    let points = triangle.map(|[x, y]| DVec3::new(x, y, 0.0)).to_vec();
    for sixteenths in 0..=16_u8 {
        let mut glass = part(points.clone(), vec![[0, 1, 2]], WHITE);
        glass.materials[0].color[3] = f32::from(sixteenths) / 16.0;
        let picture = rendered(&drawing(vec![glass]), &before(2.0, size), size, &plain());
        let expected = crate::color::byte(f32::from(sixteenths) / 16.0);
        assert!(picture.image.pixels.iter().all(|p| p[3] == expected));
    }
}

#[test]
fn degenerate_drawings_have_pictures() {
    let p = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
    let line = Line {
        ends: [DVec3::ZERO; 2],
        width: 3.0,
        color: [0.0, 0.0, 0.0, 1.0],
        faces: [NO_FACE; 2],
        hidden: 1.0,
        room: f64::INFINITY,
    };
    let dot = Drawing {
        lines: vec![line],
        ..Drawing::default()
    };
    let drawings = [
        Drawing::default(),
        dot,
        // One point, a line, seen from its edge, very large, very small, very far away.
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
