use mesh::{DVec2, DVec3, EdgeId, FaceId, HalfEdgeId, Mesh};
use progress::{NoProgress, Progress};

use super::*;
use crate::shapes;

const PAGE: Page = Page {
    size: 256,
    padding: 2,
};

fn options(seams: &[EdgeId]) -> UnwrapOptions<'_> {
    UnwrapOptions {
        seams,
        max_angle: 70.0,
        max_stretch: 4.0,
        page: PAGE,
    }
}

fn unwrapped(mesh: &Mesh) -> Unwrapped {
    unwrap(mesh, &options(&[]), &NoProgress).unwrap()
}

/// Returns a sphere from which the top was removed.
fn bowl() -> Mesh {
    let mut mesh = shapes::uv_sphere(24, 16);
    let lid: Vec<_> = mesh
        .faces()
        .filter(|&f| mesh.face_center(f).z > 0.7)
        .collect();
    mesh.delete_faces(&lid).unwrap();
    mesh.compact();
    mesh
}

fn models() -> Vec<(&'static str, Mesh)> {
    vec![
        ("cube", shapes::cube()),
        ("torus", shapes::torus(32, 16, 1.0, 0.4)),
        ("bowl", bowl()),
        ("grid", shapes::grid(5, 3)),
        ("icosahedron", shapes::icosahedron()),
        ("cylinder", shapes::cylinder(12, true)),
    ]
}

/// Returns, for each texel of a page, the number of triangles that contain its center.
fn raster(mesh: &Mesh, uvs: &[DVec2], size: usize) -> Vec<u8> {
    let mut counts = vec![0; size * size];
    for triangle in crate::tangent::triangles(mesh) {
        let [a, b, c] = triangle.map(|h| uvs[h.index()] * size as f64);
        for y in 0..size {
            for x in 0..size {
                let p = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
                let sides = [(a, b), (b, c), (c, a)].map(|(q, r)| (r - q).perp_dot(p - q));
                if sides.iter().all(|&s| s > 0.0) || sides.iter().all(|&s| s < 0.0) {
                    counts[y * size + x] += 1;
                }
            }
        }
    }
    counts
}

#[test]
fn charts_do_not_overlap_and_stay_on_the_page() {
    for (name, mesh) in models() {
        let result = unwrapped(&mesh);
        assert_eq!(
            overlapping_faces(&mesh, &result.uvs, &NoProgress).unwrap(),
            [],
            "{name}"
        );
        let most = raster(&mesh, &result.uvs, 128).into_iter().max();
        assert_eq!(most, Some(1), "{name}");
        let corners = mesh.faces().flat_map(|f| mesh.face_half_edges(f));
        for h in corners {
            let uv = result.uvs[h.index()];
            assert!(uv.cmpge(DVec2::ZERO).all() && uv.cmple(DVec2::ONE).all());
        }
        assert!(result.coverage > 0.3 && result.coverage < 1.0, "{name}");
        assert_eq!((result.flat.len(), result.bent.len()), (0, 0), "{name}");
    }
}

#[test]
fn charts_are_not_mirrored_and_stretched_little() {
    for (name, mesh) in models() {
        let result = unwrapped(&mesh);
        let stretch = stretch(&mesh, &result.uvs).unwrap();
        assert_eq!(stretch.n_mirrored, 0, "{name}");
        assert!(stretch.aspect <= 1.15, "{name}: {stretch:?}");
        assert!(stretch.scales < 1.6, "{name}: {stretch:?}");
    }
}

/// Returns a strip of `n` squares between two helices with radii 0.5 and 1 around the z axis. A turn has 48 squares,
/// and rises by 0.2.
fn ramp(n: u32) -> Mesh {
    let row = |i: u32| {
        let turn = f64::from(i) / 48.0;
        let (sin, cos) = libm::sincos(turn * std::f64::consts::TAU);
        [0.5, 1.0].map(|r| DVec3::new(r * cos, r * sin, 0.2 * turn))
    };
    let points: Vec<DVec3> = (0..=n).flat_map(row).collect();
    let face = |i: u32| vec![2 * i, 2 * i + 1, 2 * i + 3, 2 * i + 2];
    let faces: Vec<Vec<u32>> = (0..n).map(face).collect();
    Mesh::from_polygons(points, &faces).unwrap().0
}

#[test]
fn a_strip_that_overlaps_itself_in_the_plane_is_cut() {
    for (n, n_charts) in [(72, 2..=3), (144, 4..=6)] {
        let mesh = ramp(n);
        let result = unwrapped(&mesh);
        assert!(n_charts.contains(&result.charts.n), "{n}: {result:?}");
        let overlapping = overlapping_faces(&mesh, &result.uvs, &NoProgress).unwrap();
        assert_eq!(overlapping, []);
    }
    assert_eq!(unwrapped(&ramp(43)).charts.n, 1);
}

#[test]
fn a_developable_surface_becomes_one_chart_without_stretch() {
    let mut mesh = shapes::cylinder(96, false);
    let center = |mesh: &Mesh, f| mesh.face_center(f);
    let far: Vec<_> = mesh
        .faces()
        .filter(|&f| center(&mesh, f).x < 0.5 * center(&mesh, f).truncate().length())
        .collect();
    mesh.delete_faces(&far).unwrap();
    mesh.compact();
    let result = unwrapped(&mesh);
    assert_eq!(result.charts.n, 1);
    let stretch = stretch(&mesh, &result.uvs).unwrap();
    assert!(stretch.max_aspect < 1.0 + 1e-6, "{stretch:?}");
    assert!(stretch.scales < 1.0 + 1e-6, "{stretch:?}");
}

#[test]
fn the_faces_of_a_chart_are_divided_among_its_neighbors() {
    // The step that dissolves charts reduces six charts to four.
    assert_eq!(unwrapped(&shapes::icosahedron()).charts.n, 4);
}

#[test]
fn charts_of_a_page_keep_their_distance() {
    let mesh = shapes::cube();
    let Unwrapped { uvs, charts, .. } = unwrap(
        &mesh,
        &UnwrapOptions {
            max_angle: 30.0,
            ..options(&[])
        },
        &NoProgress,
    )
    .unwrap();
    assert_eq!(charts.n, 6);
    let distance = 2.0 * f64::from(PAGE.padding) / f64::from(PAGE.size);
    let boxes: Vec<[DVec2; 2]> = mesh
        .faces()
        .map(|f| {
            let corners = mesh.face_half_edges(f).map(|h| uvs[h.index()]);
            let low = corners.clone().fold(DVec2::MAX, DVec2::min);
            [low, corners.fold(DVec2::MIN, DVec2::max)]
        })
        .collect();
    for (i, [low, high]) in boxes.iter().enumerate() {
        for [low2, high2] in &boxes[i + 1..] {
            let gap = (low2 - high).max(low - high2).max_element();
            assert!(gap > distance - 1e-6, "{gap}");
        }
    }
}

#[test]
fn seams_become_borders_of_charts() {
    let mesh = shapes::grid(4, 4);
    assert_eq!(unwrapped(&mesh).charts.n, 1);
    let middle: Vec<EdgeId> = mesh
        .edges()
        .filter(|&e| {
            mesh.edge_vertices(e)
                .iter()
                .all(|&v| mesh.position(v).x.abs() < 1e-9)
        })
        .collect();
    assert_eq!(middle.len(), 4);
    let cut = unwrap(&mesh, &options(&middle), &NoProgress).unwrap();
    assert_eq!(cut.charts.n, 2);
    for e in middle {
        assert!(is_border(&mesh, &cut.uvs, e.half_edge()));
    }
}

#[test]
fn flat_squares_keep_their_shape() {
    let mesh = shapes::grid(3, 3);
    let uvs = unwrapped(&mesh).uvs;
    let lengths: Vec<f64> = mesh
        .faces()
        .flat_map(|f| mesh.face_half_edges(f))
        .map(|h| uvs[h.index()].distance(uvs[mesh.next(h).index()]))
        .collect();
    assert!(lengths.iter().all(|l| (l - lengths[0]).abs() < 1e-5));
}

#[test]
fn faces_without_area_are_counted_and_empty_meshes_are_unwrapped() {
    let points = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [2.0, 0.0, 0.0]];
    let points = points.map(DVec3::from).to_vec();
    let (mesh, _) = Mesh::from_polygons(points, &[[0_u32, 1, 2], [1, 0, 3]]).unwrap();
    let result = unwrapped(&mesh);
    assert_eq!(result.flat.len(), 1);
    assert_eq!(unwrapped(&Mesh::default()).charts.n, 0);
}

#[test]
fn positions_of_any_size_are_unwrapped() {
    let of_size = |size: f64| {
        let mut mesh = shapes::cube();
        for p in mesh.positions_mut() {
            *p *= size;
        }
        unwrapped(&mesh)
    };
    let expected = of_size(1.0).uvs;
    for size in [1e300, 1e-300, 4.0] {
        assert_eq!(of_size(size).uvs, expected, "{size}");
    }
}

#[test]
fn a_page_that_is_too_small_is_refused() {
    let mesh = shapes::torus(12, 8, 1.0, 0.4);
    let page = Page {
        size: 16,
        padding: 7,
    };
    for page in [
        page,
        Page {
            size: 4,
            padding: 2,
        },
    ] {
        let options = UnwrapOptions {
            page,
            ..options(&[])
        };
        let refused = unwrap(&mesh, &options, &NoProgress).unwrap_err();
        assert_eq!(refused, UvError::PageTooSmall(page));
        let uvs = unwrapped(&mesh).uvs;
        let refused = pack(&mesh, &uvs, page, &NoProgress).unwrap_err();
        assert_eq!(refused, UvError::PageTooSmall(page));
    }
}

#[test]
fn the_result_is_the_same_for_any_number_of_threads() {
    let mesh = bowl();
    let results = [1, 2, 8].map(|n| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n).build();
        pool.unwrap().install(|| {
            let uvs = unwrapped(&mesh).uvs;
            let packed = pack(&mesh, &uvs, PAGE, &NoProgress).unwrap().uvs;
            (uvs, packed)
        })
    });
    assert_eq!(results[0], results[1]);
    assert_eq!(results[0], results[2]);
}

#[test]
fn unwrapping_can_be_cancelled() {
    struct Never;
    impl Progress for Never {
        fn advance(&self, _: &str, _: u64, _: u64) -> bool {
            false
        }
    }
    let mesh = bowl();
    let refused = unwrap(&mesh, &options(&[]), &Never).unwrap_err();
    assert!(matches!(refused, UvError::Cancelled(_)));
    let uvs = unwrapped(&mesh).uvs;
    assert!(pack(&mesh, &uvs, PAGE, &Never).is_err());
    assert!(overlapping_faces(&mesh, &uvs, &Never).is_err());
}

/// Returns texture coordinates for a mesh of quadrilaterals. The first face is mapped to a mirrored square, and the
/// last face to a larger square. These two squares overlap no other square. The other faces are mapped to overlapping
/// unit squares.
fn stacked(mesh: &Mesh) -> Vec<DVec2> {
    let square = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
    let mut uvs = vec![DVec2::ZERO; mesh.n_half_edges()];
    let last = mesh.n_faces() - 1;
    for (i, f) in mesh.faces().enumerate() {
        for (k, h) in mesh.face_half_edges(f).enumerate() {
            let p = square[k];
            uvs[h.index()] = match i {
                0 => DVec2::new(5.0 - p.x, p.y),
                _ if i == last => p * 7.0 - DVec2::splat(20.0),
                _ => p + DVec2::splat(0.25 * i as f64),
            };
        }
    }
    uvs
}

#[test]
fn packed_charts_have_one_scale_and_keep_their_shapes() {
    // The few charts of the cube are nested. The 300 charts of the grid are packed in rows.
    for (mesh, size) in [(shapes::cube(), 256), (shapes::grid(20, 15), 512)] {
        let before = stacked(&mesh);
        let overlapping = |uvs: &[DVec2]| overlapping_faces(&mesh, uvs, &NoProgress).unwrap();
        assert!(!overlapping(&before).is_empty());
        let packed = pack(&mesh, &before, Page { size, ..PAGE }, &NoProgress).unwrap();
        assert_eq!(
            (packed.n_charts, packed.n_flat, packed.n_overlapping),
            (mesh.n_faces(), 0, 0)
        );
        assert_eq!(overlapping(&packed.uvs), []);
        let measured = stretch(&mesh, &packed.uvs).unwrap();
        // The two triangles of the first face stay mirrored.
        assert_eq!(measured.n_mirrored, 2);
        assert!((measured.max_aspect - 1.0).abs() < 1e-9, "{measured:?}");
        assert!((measured.scales - 1.0).abs() < 1e-9, "{measured:?}");
        assert!(packed.coverage > 0.5);
        let pixels = raster(&mesh, &packed.uvs, size as usize / 2);
        let n_covered: usize = pixels.iter().copied().map(usize::from).sum();
        assert!((n_covered as f64 / pixels.len() as f64 - packed.coverage).abs() < 0.02);
    }
}

#[test]
fn charts_that_overlap_themselves_are_packed_by_their_hulls() {
    let mesh = shapes::grid(2, 1);
    let mut folded = vec![DVec2::ZERO; mesh.n_half_edges()];
    for h in mesh.faces().flat_map(|f| mesh.face_half_edges(f)) {
        let p = mesh.position(mesh.origin(h));
        folded[h.index()] = DVec2::new(p.x.abs() + if p.x > 0.0 { 0.1 } else { 0.0 }, p.y);
    }
    let packed = pack(&mesh, &folded, PAGE, &NoProgress).unwrap();
    assert_eq!((packed.n_charts, packed.n_overlapping), (1, 1));
    assert_eq!(
        overlapping_faces(&mesh, &packed.uvs, &NoProgress)
            .unwrap()
            .len(),
        2
    );
    let inside = |uv: &DVec2| uv.cmpge(DVec2::ZERO).all() && uv.cmple(DVec2::ONE).all();
    assert!(packed.uvs.iter().all(inside));
    let none = vec![DVec2::ONE; mesh.n_half_edges()];
    let packed = pack(&mesh, &none, PAGE, &NoProgress).unwrap();
    assert_eq!((packed.n_flat, packed.coverage), (1, 0.0));
}

#[test]
fn a_chart_of_many_triangles_that_overlaps_itself_is_packed_by_its_hull() {
    // The texture coordinates project the cylinder along its axis. In the texture, both caps are the same disk, and the
    // side faces have zero area.
    let mesh = shapes::cylinder(300, true);
    let uv = |h| mesh.position(mesh.origin(HalfEdgeId::new(h))).truncate();
    let uvs: Vec<DVec2> = (0..mesh.n_half_edges()).map(uv).collect();
    let packed = pack(&mesh, &uvs, PAGE, &NoProgress).unwrap();
    assert_eq!((packed.n_charts, packed.n_overlapping), (1, 1));
    let inside = |uv: &DVec2| uv.cmpge(DVec2::ZERO).all() && uv.cmple(DVec2::ONE).all();
    assert!(packed.uvs.iter().all(inside));
}

/// The charts are narrow along u. The points with the smallest and the largest u are therefore close to each other,
/// compared with the size of the chart.
#[test]
fn long_convex_charts_of_many_triangles_do_not_overlap_after_packing() {
    let mut mesh = shapes::cylinder(2000, true);
    for p in mesh.positions_mut() {
        p.x *= 0.01;
    }
    let result = unwrapped(&mesh);
    let packed = pack(&mesh, &result.uvs, PAGE, &NoProgress).unwrap();
    assert_eq!(packed.n_overlapping, 0);
    for uvs in [&result.uvs, &packed.uvs] {
        assert_eq!(overlapping_faces(&mesh, uvs, &NoProgress).unwrap(), []);
    }
}

#[test]
fn a_hull_with_two_points_that_nearly_coincide_stays_in_one_part() {
    // The mesh has a chart of two quads that overlap in the texture, and six square charts. A corner of one quad nearly
    // coincides with a corner of the other quad.
    let (mut positions, mut faces) = (Vec::new(), Vec::<[u32; 4]>::new());
    for (x, y) in [(0, 0), (1, 0), (1, 1), (0, 1), (-1, 0), (-1, 1)] {
        positions.push(DVec3::new(f64::from(x), f64::from(y), 0.0));
    }
    faces.extend([[0, 1, 2, 3], [4, 0, 3, 5]]);
    for i in 1..=6 {
        let first = 2 + 4 * i;
        for (x, y) in [(0, 0), (1, 0), (1, 1), (0, 1)] {
            positions.push(DVec3::new(f64::from(x), f64::from(y), f64::from(i)));
        }
        faces.push([first, first + 1, first + 2, first + 3]);
    }
    let mesh = Mesh::from_polygons(positions, &faces).unwrap().0;
    let uvs = (0..mesh.n_half_edges()).map(|h| {
        let p = mesh.position(mesh.origin(HalfEdgeId::new(h)));
        let corner = DVec2::new(10.0 * p.z, 0.0);
        corner
            + match (p.x < 0.0, p.y > 0.0) {
                (true, true) => DVec2::new(1.0 + 3e-7, 1.0 - 3e-7),
                (true, false) => DVec2::new(0.9, 0.1),
                (false, _) => p.truncate(),
            }
    });
    let packed = pack(&mesh, &uvs.collect::<Vec<_>>(), PAGE, &NoProgress).unwrap();
    assert_eq!((packed.n_charts, packed.n_overlapping), (7, 1));
    let overlapping = overlapping_faces(&mesh, &packed.uvs, &NoProgress).unwrap();
    assert_eq!(overlapping, [0, 1].map(FaceId::new));
}

/// Each cap is a chart with a single face of many corners. The packing replaces each cap by its convex hull, and leaves
/// out most corners of the hull.
#[test]
fn charts_of_faces_with_many_corners_cover_as_much_of_the_page_as_those_of_faces_with_few() {
    let charts = |around| {
        let mesh = shapes::cylinder(around, true);
        let result = unwrapped(&mesh);
        let overlapping = overlapping_faces(&mesh, &result.uvs, &NoProgress).unwrap();
        assert_eq!(overlapping, []);
        let stretch = stretch(&mesh, &result.uvs).unwrap();
        assert!(stretch.max_aspect < 1.0 + 1e-6, "{stretch:?}");
        (result.charts.n, result.coverage)
    };
    let (few, many) = (charts(200), charts(3000));
    assert_eq!(few.0, many.0);
    assert!((few.1 - many.1).abs() < 0.01, "{few:?} {many:?}");
}

#[test]
fn aspects_and_scales_are_those_of_the_map() {
    let mesh = shapes::grid(1, 1);
    let map = |x: f64, y: f64| {
        let uvs = mesh.half_edges().map(|h| {
            let p = mesh.position(mesh.origin(h));
            DVec2::new(p.x * x, p.y * y)
        });
        stretch(&mesh, &uvs.collect::<Vec<_>>()).unwrap()
    };
    assert_eq!(map(1.0, 1.0).aspect, 1.0);
    assert!((map(3.0, 1.0).aspect - 3.0).abs() < 1e-12);
    assert_eq!(map(-1.0, 1.0).n_mirrored, 2);
    assert_eq!(map(0.0, 1.0).aspect, f64::INFINITY);
    assert_eq!(stretch(&Mesh::default(), &[]), None);
}
