use super::*;

/// Returns a cone with many thin triangles. Its axis is not parallel to a coordinate axis.
fn cone(n: u32) -> Mesh {
    let tilted = |p: DVec3| DVec3::new(0.6 * p.x - 0.8 * p.z, p.y, 0.8 * p.x + 0.6 * p.z);
    let rim = shapes::cylinder(n, false);
    let mut positions = rim.positions()[..n as usize].to_vec();
    positions.push(DVec3::new(0.3, 0.2, 5.0));
    for p in &mut positions {
        *p = tilted(*p);
    }
    let triangles: Vec<[u32; 3]> = (0..n).map(|i| [i, (i + 1) % n, n]).collect();
    Mesh::from_polygons(positions, &triangles).unwrap().0
}

#[test]
fn no_triangle_is_nearer_than_the_oriented_box_of_its_node() {
    let mut random = Random(7);
    for round in 0..60 {
        let scale = [1.0, 1e-3, 1e6][round % 3];
        let away = 100.0 * random.point();
        let mut k = 0;
        // The three corners of each triangle lie near a common line. Every fourth triangle has no area.
        let (mut start, mut direction) = (DVec3::ZERO, DVec3::ZERO);
        let mesh = soup(1 + 3 * round, || {
            if k % 3 == 0 {
                (start, direction) = (random.point(), random.point());
            }
            k += 1;
            let width = if k % 12 < 3 { 0.0 } else { 1e-3 };
            scale * (start + random.number() * direction + width * random.point() + away)
        });
        let index = SurfaceIndex::new(&mesh).unwrap();
        assert!(index.has_thin_triangles());
        for reach in [1.0, 10.0, 1e4] {
            let p = scale * (reach * random.point() + away);
            for (i, node) in index.nodes.iter().enumerate() {
                let bound = index.oriented_distance_squared(p, i, 0.0);
                let squared = |t: &[DVec3; 3]| p.distance_squared(nearest_on_triangle(p, t));
                let nearest = index.triangles_of(node).iter().map(squared);
                let nearest = nearest.fold(f64::INFINITY, f64::min);
                assert!(bound <= nearest, "{bound} {nearest}");
            }
            let found = index.nearest(p, 0);
            let squared = |t: &[DVec3; 3]| p.distance(nearest_on_triangle(p, t));
            let brute = index.positions.iter().map(squared);
            assert_eq!(found.distance, brute.fold(f64::INFINITY, f64::min));
        }
    }
}

/// The number of nodes that a search visits grows only with the depth of the tree.
#[test]
fn searches_near_thin_triangles_visit_few_nodes() {
    let mut random = Random(8);
    for n in [1000, 16_000] {
        let mesh = cone(n);
        let index = SurfaceIndex::new(&mesh).unwrap();
        let mut visits = Vec::new();
        for _ in 0..500 {
            let triangle = index.triangle(u32::try_from(random.next(u64::from(n))).unwrap());
            let [a, b] = [0.2, 0.7].map(|w| w * (0.5 + 0.4 * random.number()));
            let at = triangle.point([a, b * (1.0 - a), (1.0 - a) * (1.0 - b)]);
            visits.push(index.nearest(at + 1e-3 * random.point(), 0).visits);
        }
        visits.sort_unstable();
        assert!(visits[400] < 160, "{visits:?}");
    }
}

#[test]
fn surfaces_of_well_shaped_triangles_have_no_oriented_boxes() {
    for mesh in [shapes::icosahedron(), shapes::torus(40, 20, 2.0, 1.0)] {
        assert!(!SurfaceIndex::new(&mesh).unwrap().has_thin_triangles());
    }
}
