//! From where a place in a scene can be seen.

use std::collections::HashSet;

use glam::DVec3;
use mesh::{FaceId, Mesh};
use rayon::prelude::*;
use scene::Scene;

use crate::places::bits;

/// How many directions are tried.
const DIRECTIONS: u32 = 200;

/// The highest camera, as the sine of its elevation: that of 75 degrees. From straight above it is not clear which way
/// is up.
const HIGHEST: f64 = 0.965_925_826_289_068_3;

/// A place of a scene that is to be seen.
pub(crate) struct Place<'a> {
    /// Its points: faces that touch one of them do not hide it.
    pub(crate) points: &'a [DVec3],
    /// Their middle.
    pub(crate) middle: DVec3,
    /// The outer side of the surface there; zero if there is none.
    pub(crate) normal: DVec3,
}

/// The direction nearest to `preferred`, a unit vector, from which a place is seen from its outer side and nothing hides
/// its middle; or else, nothing nearer than `near` does; or else `preferred`.
pub(crate) fn clear(scene: &Scene, place: &Place, preferred: DVec3, near: f64) -> DVec3 {
    let is_outside = |d: &DVec3| place.normal == DVec3::ZERO || place.normal.dot(*d) > 0.0;
    let directions = std::iter::once(preferred).chain(directions());
    let directions: Vec<DVec3> = directions.filter(is_outside).collect();
    let points: HashSet<[u64; 3]> = place.points.iter().map(|&p| bits(p)).collect();
    // How far one sees in each direction.
    let mut sight = vec![f64::INFINITY; directions.len()];
    for mesh in scene.objects().iter().filter_map(|o| o.as_mesh()) {
        let n = mesh.domain_len(mesh::Domain::Face);
        let hidden = (0..n).into_par_iter().with_min_len(4096).fold(
            || vec![f64::INFINITY; directions.len()],
            |mut nearest, f| {
                let f = FaceId::new(f);
                if mesh.has_face(f) && !touches(mesh, f, &points) {
                    for (nearest, &direction) in nearest.iter_mut().zip(&directions) {
                        *nearest = nearest.min(distance(mesh, f, place.middle, direction));
                    }
                }
                nearest
            },
        );
        // The least of numbers is the same in any order.
        let hidden = hidden.reduce(|| vec![f64::INFINITY; directions.len()], least);
        sight = least(sight, hidden);
    }
    let best = |limit: f64| {
        let seen = directions.iter().zip(&sight);
        let seen = seen.filter(|&(_, &sight)| sight >= limit).map(|(d, _)| *d);
        seen.max_by(|a, b| a.dot(preferred).total_cmp(&b.dot(preferred)))
    };
    let best = best(f64::INFINITY).or_else(|| best(near));
    best.unwrap_or(preferred)
}

fn least(a: Vec<f64>, b: Vec<f64>) -> Vec<f64> {
    a.into_iter().zip(b).map(|(a, b)| a.min(b)).collect()
}

fn touches(mesh: &Mesh, f: FaceId, points: &HashSet<[u64; 3]>) -> bool {
    let mut corners = mesh.face_vertices(f).map(|v| mesh.position(v));
    corners.any(|p| points.contains(&bits(p)))
}

/// Directions spread evenly over the sphere, without those from straight above and below.
///
/// Swinbank, Purser, "Fibonacci grids: A novel approach to global modelling", 2006.
fn directions() -> impl Iterator<Item = DVec3> {
    let golden_angle = 180.0 * (3.0 - 5.0_f64.sqrt());
    let n = f64::from(DIRECTIONS);
    (0..DIRECTIONS).map(f64::from).filter_map(move |i| {
        let up = 1.0 - (2.0 * i + 1.0) / n;
        let (sin, cos) = geometry::sin_cos_degrees(golden_angle * i);
        let along = (1.0 - up * up).sqrt();
        (up.abs() <= HIGHEST).then(|| DVec3::new(along * cos, up, along * sin))
    })
}

/// How far a face is from a point in a direction; infinite if the ray passes by. Polygons are fans around their first
/// corner.
fn distance(mesh: &Mesh, f: FaceId, from: DVec3, direction: DVec3) -> f64 {
    let mut corners = mesh.face_vertices(f).map(|v| mesh.position(v));
    let (Some(a), Some(mut b)) = (corners.next(), corners.next()) else {
        return f64::INFINITY;
    };
    corners.fold(f64::INFINITY, |nearest, c| {
        let corners = [a, std::mem::replace(&mut b, c), c];
        nearest.min(triangle(corners, from, direction))
    })
}

/// Möller, Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997.
fn triangle([a, b, c]: [DVec3; 3], from: DVec3, direction: DVec3) -> f64 {
    let (ab, ac) = (b - a, c - a);
    let p = direction.cross(ac);
    let inverse = 1.0 / ab.dot(p);
    let aside = from - a;
    let u = aside.dot(p) * inverse;
    let q = aside.cross(ab);
    let v = direction.dot(q) * inverse;
    let t = ac.dot(q) * inverse;
    // Not true of numbers that are none: triangles without area, or seen from their edge.
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

    fn at(middle: DVec3) -> Place<'static> {
        Place {
            points: &[],
            middle,
            normal: DVec3::ZERO,
        }
    }

    #[test]
    fn what_nothing_hides_is_seen_from_where_it_is_wanted() {
        let scene = scene(shapes::cube());
        let preferred = DVec3::new(0.6, 0.0, 0.8);
        let point = DVec3::new(0.0, 0.0, 5.0);

        assert_eq!(clear(&scene, &at(point), preferred, 1.0), preferred);
    }

    #[test]
    fn what_is_behind_a_cube_is_seen_from_aside() {
        let scene = scene(shapes::cube());
        // The cube is between the point and the camera.
        let point = DVec3::new(0.0, 0.0, -1.5);

        let found = clear(&scene, &at(point), DVec3::Z, 1.0);

        let mesh = scene.objects()[0].as_mesh().unwrap();
        let is_hidden = mesh
            .faces()
            .any(|f| distance(mesh, f, point, found).is_finite());
        assert!(!is_hidden, "{found}");
        assert!(found.is_normalized() && found.y.abs() <= HIGHEST);
    }

    #[test]
    fn a_surface_is_seen_from_its_outer_side() {
        let scene = scene(shapes::square());
        let mesh = scene.objects()[0].as_mesh().unwrap();
        let f = mesh.faces().next().unwrap();
        let points = mesh.element_points(f.into());
        let place = Place {
            points: &points,
            middle: points.iter().sum::<DVec3>() / points.len() as f64,
            normal: mesh.area_vector(f),
        };
        let back = -place.normal.normalize();

        let found = clear(&scene, &place, back, 1.0);

        assert!(found.dot(place.normal) > 0.0, "{found}");
    }

    #[test]
    fn what_is_inside_is_seen_from_where_nothing_is_near() {
        let sized = |size: f64, at: DVec3| {
            let mut mesh = shapes::cube();
            mesh.positions_mut()
                .iter_mut()
                .for_each(|p| *p = *p * size + at);
            mesh
        };
        // A large cube around everything, and a small one in front of the point.
        let mut scene = scene(sized(10.0, DVec3::ZERO));
        let small = Object::mesh("small", sized(0.4, DVec3::Z));
        scene.insert(small).unwrap();

        let found = clear(&scene, &at(DVec3::ZERO), DVec3::Z, 2.0);

        let small = scene.objects()[1].as_mesh().unwrap();
        let hits = |d| {
            small
                .faces()
                .any(|f| distance(small, f, DVec3::ZERO, d).is_finite())
        };
        assert!(hits(DVec3::Z) && !hits(found), "{found}");
        // Where everything is near, it is what is wanted.
        assert_eq!(clear(&scene, &at(DVec3::ZERO), DVec3::Z, 100.0), DVec3::Z);
    }
}
