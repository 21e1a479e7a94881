use super::*;

#[test]
fn no_triangle_is_nearer_than_the_slab_of_its_node() {
    let mut random = Random(5);
    for round in 0..60 {
        let scale = [1.0, 1e-3, 1e6][round % 3];
        let flat = [DVec3::ONE, DVec3::new(1.0, 1.0, 0.01)][round % 2];
        let away = 100.0 * random.point();
        let mesh = soup(1 + 3 * round, || scale * (flat * random.point() + away));
        let index = SurfaceIndex::new(&mesh).unwrap();
        for reach in [1.0, 10.0, 1e4] {
            let p = scale * (reach * random.point() + away);
            for (i, node) in index.nodes.iter().enumerate() {
                let box_distance = p.distance_squared(p.max(node.min).min(node.max));
                let bound = index.slab_distance_squared(p, i, box_distance);
                assert!(bound >= box_distance);
                let squared = |t: &[DVec3; 3]| p.distance_squared(nearest_on_triangle(p, t));
                let nearest = index.triangles_of(node).iter().map(squared);
                let nearest = nearest.fold(f64::INFINITY, f64::min);
                assert!(bound <= nearest, "{bound} {nearest}");
            }
        }
    }
}

#[test]
fn slabs_find_the_distance_to_a_tilted_square() {
    let corner = |x: f64, y: f64| DVec3::new(x, y, x + y);
    let mut k = 0;
    let corners = [
        (0.0, 0.0),
        (1.0, 0.0),
        (1.0, 1.0),
        (0.0, 0.0),
        (1.0, 1.0),
        (0.0, 1.0),
    ];
    let square = soup(2, || {
        k += 1;
        corner(corners[k - 1].0, corners[k - 1].1)
    });
    let index = SurfaceIndex::new(&square).unwrap();
    let normal = DVec3::new(-1.0, -1.0, 1.0) / 3_f64.sqrt();
    for side in [1.0, -1.0] {
        let p = corner(0.5, 0.5) + side * 2.0 * normal;
        let node = index.nodes[0];
        let box_distance = p.distance_squared(p.max(node.min).min(node.max));
        let bound = index.slab_distance_squared(p, 0, box_distance);
        assert!(box_distance < 2.0, "{box_distance}");
        assert!((bound - 4.0).abs() < 1e-6, "{bound}");
    }
}

/// When the given point is far from the mesh, the search for the nearest point visits few nodes. The number of visited
/// nodes grows only with the depth of the tree.
#[test]
fn far_points_visit_few_nodes_of_a_fine_mesh() {
    let mut most = [0; 2];
    for (most, side) in most.iter_mut().zip([64, 256]) {
        let index = SurfaceIndex::new(&shapes::torus(2 * side, side / 2, 2.0, 1.0)).unwrap();
        let mut random = Random(6);
        for _ in 0..200 {
            let direction = random.point().normalize();
            // Points near the z axis are skipped, because they have almost the same distance to all points of a circle
            // on the torus.
            if direction.z.abs() < 0.9 {
                *most = index.nearest(100.0 * direction, 0).visits.max(*most);
            }
        }
    }
    assert!(most[1] <= most[0] + 200, "{most:?}");
}
