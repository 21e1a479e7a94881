//! Finds a direction from which a location in a scene is visible.

use std::collections::HashSet;

use glam::DVec3;
use mesh::{FaceId, Mesh};
use rayon::prelude::*;
use scene::Scene;

use crate::position_bits::bits;

/// The number of directions that are spread over the whole sphere. Directions that point behind the surface, or whose
/// elevation is too large, are not tried.
const DIRECTIONS: u32 = 200;

/// The sine of 75 degrees, which is the maximum elevation of the camera. If the camera looks straight down, the upward
/// direction of the picture is unclear.
const MAX_ELEVATION: f64 = 0.965_925_826_289_068_3;

/// A location in a scene that the camera looks at.
pub(crate) struct Target<'a> {
    /// The points of the location. Faces that have a corner at one of these points do not count as faces that hide the
    /// location.
    pub(crate) points: &'a [DVec3],
    /// The middle of the points.
    pub(crate) middle: DVec3,
    /// The outward normal of the surface at the location; zero if there is no surface.
    pub(crate) normal: DVec3,
}

/// Returns the direction from a target to the camera, as a unit vector.
///
/// The candidates are directions on the outer side of the surface. A candidate is clear if no face hides the middle of
/// the target from a camera in this direction. Of all clear candidates, returns the one nearest to the unit vector
/// `preferred`. If no candidate is clear, the search is repeated for a camera at the distance `near` from the target.
/// Faces behind this camera are ignored. If still no candidate is clear, returns `preferred`.
pub(crate) fn clear_direction(
    scene: &Scene,
    target: &Target,
    preferred: DVec3,
    near: f64,
) -> DVec3 {
    let is_outside = |d: &DVec3| target.normal == DVec3::ZERO || target.normal.dot(*d) > 0.0;
    let directions = std::iter::once(preferred).chain(directions());
    let directions: Vec<DVec3> = directions.filter(is_outside).collect();
    let points: HashSet<[u64; 3]> = target.points.iter().map(|&p| bits(p)).collect();
    // For each direction, the distance from the target to the nearest face in this direction.
    let mut distances = vec![f64::INFINITY; directions.len()];
    for mesh in scene.objects().iter().filter_map(|o| o.as_mesh()) {
        let n = mesh.domain_len(mesh::Domain::Face);
        let of_mesh = (0..n).into_par_iter().with_min_len(4096).fold(
            || vec![f64::INFINITY; directions.len()],
            |mut nearest, f| {
                let f = FaceId::new(f);
                if mesh.has_face(f) && !touches(mesh, f, &points) {
                    for (nearest, &direction) in nearest.iter_mut().zip(&directions) {
                        *nearest = nearest.min(distance(mesh, f, target.middle, direction));
                    }
                }
                nearest
            },
        );
        // The result is the same for any number of threads, because the minimum does not depend on the order of the
        // faces.
        let of_mesh = of_mesh.reduce(|| vec![f64::INFINITY; directions.len()], minima);
        distances = minima(distances, of_mesh);
    }
    let best = |limit: f64| {
        let candidates = directions.iter().zip(&distances);
        let candidates = candidates
            .filter(|&(_, &distance)| distance >= limit)
            .map(|(direction, _)| *direction);
        candidates.max_by(|a, b| a.dot(preferred).total_cmp(&b.dot(preferred)))
    };
    let best = best(f64::INFINITY).or_else(|| best(near));
    best.unwrap_or(preferred)
}

/// Returns the minimum of each pair of numbers with the same index.
fn minima(a: Vec<f64>, b: Vec<f64>) -> Vec<f64> {
    a.into_iter().zip(b).map(|(a, b)| a.min(b)).collect()
}

/// Whether a corner of a face is at one of these points.
fn touches(mesh: &Mesh, f: FaceId, points: &HashSet<[u64; 3]>) -> bool {
    let mut corners = mesh.face_vertices(f).map(|v| mesh.position(v));
    corners.any(|p| points.contains(&bits(p)))
}

/// Returns directions that are spread evenly over the sphere, up to the maximum elevation.
///
/// Swinbank, Purser, "Fibonacci grids: A novel approach to global modelling", 2006.
fn directions() -> impl Iterator<Item = DVec3> {
    let golden_angle = 180.0 * (3.0 - 5.0_f64.sqrt());
    let n = f64::from(DIRECTIONS);
    (0..DIRECTIONS).map(f64::from).filter_map(move |i| {
        let up = 1.0 - (2.0 * i + 1.0) / n;
        let (sin, cos) = geometry::sin_cos_degrees(golden_angle * i);
        let horizontal = (1.0 - up * up).sqrt();
        (up.abs() <= MAX_ELEVATION).then(|| DVec3::new(horizontal * cos, up, horizontal * sin))
    })
}

/// Returns the distance from a point to a face along a ray; infinite if the ray misses the face. A polygon is treated
/// as a triangle fan around its first corner.
fn distance(mesh: &Mesh, f: FaceId, from: DVec3, direction: DVec3) -> f64 {
    let mut corners = mesh.face_vertices(f).map(|v| mesh.position(v));
    let (Some(a), Some(mut b)) = (corners.next(), corners.next()) else {
        return f64::INFINITY;
    };
    corners.fold(f64::INFINITY, |nearest, c| {
        let corners = [a, std::mem::replace(&mut b, c), c];
        nearest.min(triangle_distance(corners, from, direction))
    })
}

/// Returns the distance from a point to a triangle along a ray; infinite if the ray misses the triangle.
///
/// Möller, Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997.
fn triangle_distance([a, b, c]: [DVec3; 3], from: DVec3, direction: DVec3) -> f64 {
    let (ab, ac) = (b - a, c - a);
    let p = direction.cross(ac);
    let inverse = 1.0 / ab.dot(p);
    let offset = from - a;
    let u = offset.dot(p) * inverse;
    let q = offset.cross(ab);
    let v = direction.dot(q) * inverse;
    let t = ac.dot(q) * inverse;
    // For a triangle that is degenerate or seen edge-on, the numbers are infinite or NaN, and the condition is false.
    if u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 {
        t
    } else {
        f64::INFINITY
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use scene::Object;

    fn scene(mesh: Mesh) -> Scene {
        let mut scene = Scene::new();
        scene.insert(Object::mesh("mesh", mesh)).unwrap();
        scene
    }

    fn target(middle: DVec3) -> Target<'static> {
        Target {
            points: &[],
            middle,
            normal: DVec3::ZERO,
        }
    }

    #[test]
    fn the_preferred_direction_is_used_if_nothing_hides_the_target() {
        let scene = scene(shapes::cube());
        let preferred = DVec3::new(0.6, 0.0, 0.8);
        let point = DVec3::new(0.0, 0.0, 5.0);

        let found = clear_direction(&scene, &target(point), preferred, 1.0);

        assert_eq!(found, preferred);
    }

    #[test]
    fn a_point_behind_a_cube_is_seen_from_the_side() {
        let scene = scene(shapes::cube());
        // The cube is between the point and a camera on the positive z axis.
        let point = DVec3::new(0.0, 0.0, -1.5);

        let found = clear_direction(&scene, &target(point), DVec3::Z, 1.0);

        let mesh = scene.objects()[0].as_mesh().unwrap();
        let is_hidden = mesh
            .faces()
            .any(|f| distance(mesh, f, point, found).is_finite());
        assert!(!is_hidden, "{found}");
        assert!(found.is_normalized() && found.y.abs() <= MAX_ELEVATION);
    }

    #[test]
    fn a_surface_is_seen_from_its_outer_side() {
        let scene = scene(shapes::square());
        let mesh = scene.objects()[0].as_mesh().unwrap();
        let f = mesh.faces().next().unwrap();
        let points = mesh.element_points(f.into());
        let target = Target {
            points: &points,
            middle: points.iter().sum::<DVec3>() / points.len() as f64,
            normal: mesh.area_vector(f),
        };
        let back = -target.normal.normalize();

        let found = clear_direction(&scene, &target, back, 1.0);

        assert!(found.dot(target.normal) > 0.0, "{found}");
    }

    #[test]
    fn a_point_inside_of_a_mesh_is_seen_from_where_no_face_is_near() {
        let cube = |size: f64, center: DVec3| {
            let mut mesh = shapes::cube();
            mesh.positions_mut()
                .iter_mut()
                .for_each(|p| *p = *p * size + center);
            mesh
        };
        // The scene has a large cube around the point, and a small cube in front of the point.
        let mut scene = scene(cube(10.0, DVec3::ZERO));
        let small = Object::mesh("small", cube(0.4, DVec3::Z));
        scene.insert(small).unwrap();

        let found = clear_direction(&scene, &target(DVec3::ZERO), DVec3::Z, 2.0);

        let small = scene.objects()[1].as_mesh().unwrap();
        let hits = |d| {
            small
                .faces()
                .any(|f| distance(small, f, DVec3::ZERO, d).is_finite())
        };
        assert!(hits(DVec3::Z) && !hits(found), "{found}");
        // If faces are near in all directions, the preferred direction is used.
        let found = clear_direction(&scene, &target(DVec3::ZERO), DVec3::Z, 100.0);
        assert_eq!(found, DVec3::Z);
    }
}
