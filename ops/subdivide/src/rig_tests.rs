//! Tests that a subdivided character deforms like the original, because posing and linear subdivision commute.

use geometry::shapes;
use mesh::{
    Column, DMat3, DVec2, DVec3, Domain, Mesh, Rule, UV, Values, joint_name, morph_name,
    morph_value_name,
};
use op::test::{applied, read};

use crate::{CatmullClark, LoopSubdivide, Midpoint};

/// Returns a subdivided octahedron with weights of three joints and the deltas of a morph target. If `is_rigid` is
/// true, all vertices have the same weights.
fn character(is_rigid: bool) -> Mesh {
    let mut mesh = applied(
        &read::<Midpoint>("(levels: 2)").unwrap(),
        shapes::octahedron(),
    );
    let points = mesh.positions().to_vec();
    let upper = |p: &DVec3| {
        if is_rigid {
            0.75
        } else {
            0.5 + 0.5 * p.z * p.z.abs()
        }
    };
    let columns = [
        (
            joint_name(0),
            Values::Float(points.iter().map(|p| 0.25 * upper(p)).collect()),
        ),
        (
            joint_name(1),
            Values::Float(points.iter().map(|p| 0.75 * upper(p)).collect()),
        ),
        (
            joint_name(2),
            Values::Float(points.iter().map(|p| 1.0 - upper(p)).collect()),
        ),
        (
            morph_name(0),
            Values::Vec3(
                points
                    .iter()
                    .map(|p| p.cross(DVec3::new(1.0, 2.0, 3.0)))
                    .collect(),
            ),
        ),
    ];
    for (name, values) in columns {
        let rule = Rule::Interpolate;
        mesh.insert_column(Domain::Vertex, Column { name, rule, values });
    }
    mesh
}

/// Returns the mesh in a pose: morphed with weight 0.7, then deformed by linear blend skinning.
fn posed(mesh: &Mesh, joints: &[(DMat3, DVec3)]) -> Mesh {
    let mut posed = mesh.clone();
    let (weights, morphs) = (mesh.attributes().joints(), mesh.attributes().morphs());
    for (v, point) in posed.positions_mut().iter_mut().enumerate() {
        let morphed = *point + 0.7 * morphs[0].1[v];
        let images = weights.iter().map(|&(j, weights)| {
            let (linear, shift) = joints[j];
            weights[v] * (linear * morphed + shift)
        });
        *point = images.sum();
    }
    posed
}

fn largest_distance(a: &Mesh, b: &Mesh) -> f64 {
    let pairs = a.positions().iter().zip(b.positions());
    pairs
        .map(|(a, b)| a.distance(*b))
        .fold(0.0, |a: f64, b| if a > b { a } else { b })
}

/// Returns the transforms of three joints. If `turns` is false, the joints are only translated.
fn joints(turns: bool) -> [(DMat3, DVec3); 3] {
    let turn = DMat3::from_cols(DVec3::Y, DVec3::NEG_X, 2.0 * DVec3::Z);
    let linear = |turn| if turns { turn } else { DMat3::IDENTITY };
    [
        (DMat3::IDENTITY, DVec3::ZERO),
        (linear(turn), DVec3::new(1.0, -2.0, 0.5)),
        (linear(turn * turn), DVec3::new(0.0, 3.0, 7.0)),
    ]
}

/// The weights of a new vertex depend linearly on the weights of the old vertices, and its point depends linearly on
/// their points. To pose a vertex, its weights are multiplied by its point. Therefore, subdivision and the pose commute
/// if the joints are only translated, or if the weights are the same at both ends of an edge. Otherwise, the two
/// results for the new vertex on an edge from p to q differ. The difference is 1/4 of the sum of (w(q) - w(p)) M (q -
/// p) over all joints, where M is the linear part of the transform of a joint.
#[test]
fn posing_and_midpoint_subdivision_commute() {
    for (is_rigid, turns) in [(false, false), (true, true)] {
        let mesh = character(is_rigid);
        let step: Midpoint = read("(levels: 1)").unwrap();
        let posed_last = posed(&applied(&step, mesh.clone()), &joints(turns));
        let posed_first = applied(&step, posed(&mesh, &joints(turns)));
        assert!(posed_last.n_vertices() > 3 * mesh.n_vertices());
        assert!(largest_distance(&posed_last, &posed_first) < 1e-12);
    }
    // Subdivision and posing also commute for smooth schemes, which use the same masks for attributes and positions.
    let mesh = character(true);
    let step: CatmullClark = read("(levels: 2)").unwrap();
    let posed_last = posed(&applied(&step, mesh.clone()), &joints(true));
    let posed_first = applied(&step, posed(&mesh, &joints(true)));
    assert!(largest_distance(&posed_last, &posed_first) < 1e-12);
}

#[test]
fn weights_of_new_vertices_are_means_and_add_up_to_1() {
    let mesh = character(false);
    let n = mesh.n_vertices();
    let fine = applied(&read::<Midpoint>("(levels: 1)").unwrap(), mesh.clone());
    let (before, after) = (mesh.attributes().joints(), fine.attributes().joints());
    for e in mesh.edges() {
        let [v, w] = mesh.edge_vertices(e).map(mesh::VertexId::index);
        let middle = n + e.index();
        for ((_, old), (_, new)) in before.iter().zip(&after) {
            assert!((new[middle] - 0.5 * (old[v] + old[w])).abs() < 1e-15);
        }
        let sum: f64 = after.iter().map(|(_, weights)| weights[middle]).sum();
        assert!((sum - 1.0).abs() < 1e-12);
    }
}

/// Returns texture coordinates with a seam: at the seam, the corners of the upper faces have other values than the
/// corners of the lower faces.
fn with_seam(mesh: &Mesh, value: impl Fn(DVec3, bool) -> DVec2) -> Vec<DVec2> {
    let corner = |h: mesh::HalfEdgeId| {
        let face = mesh.face(h)?;
        let is_upper = mesh.face_center(face).z > 0.0;
        Some(value(mesh.position(mesh.origin(h)), is_upper))
    };
    let corners = (0..mesh.n_half_edges()).map(mesh::HalfEdgeId::new);
    corners.map(|h| corner(h).unwrap_or_default()).collect()
}

/// A morph target adds changes to texture coordinates. Subdivision treats these changes like texture coordinates, so it
/// does not matter whether the changes are added before or after the subdivision.
#[test]
fn changes_of_texture_coordinates_are_subdivided_like_texture_coordinates() {
    let name = morph_value_name(UV.name, 0);
    let mut mesh = shapes::octahedron();
    let uvs = with_seam(&mesh, |p, is_upper| {
        DVec2::new(p.x, p.y) + DVec2::splat(f64::from(u8::from(is_upper)))
    });
    let changes = with_seam(&mesh, |p, is_upper| {
        DVec2::new(p.y * p.z, 0.5 * p.x) - DVec2::splat(0.25 * f64::from(u8::from(is_upper)))
    });
    let rule = Rule::Interpolate;
    mesh.set(UV, uvs);
    let values = Values::Vec2(changes);
    let column = Column {
        name: name.clone(),
        rule,
        values,
    };
    mesh.insert_column(Domain::Corner, column);
    let changed = |mesh: &Mesh| {
        let column = mesh.attributes().column(Domain::Corner, &name).unwrap();
        let Values::Vec2(changes) = &column.values else {
            panic!("texture coordinates");
        };
        let uvs = mesh.get(UV).unwrap().iter().zip(changes);
        let uvs = uvs.map(|(uv, change)| uv + 0.7 * change).collect();
        let mut mesh = mesh.clone();
        mesh.set(UV, uvs);
        mesh
    };
    let fine = |mesh: &Mesh| {
        [
            applied(&read::<LoopSubdivide>("(levels: 2)").unwrap(), mesh.clone()),
            applied(&read::<CatmullClark>("(levels: 2)").unwrap(), mesh.clone()),
        ]
    };
    for (last, first) in fine(&mesh).iter().map(changed).zip(fine(&changed(&mesh))) {
        let (last, first) = (last.get(UV).unwrap(), first.get(UV).unwrap());
        assert_eq!(last.len(), first.len());
        let differs = |(a, b): (&DVec2, &DVec2)| a.distance(*b) > 1e-12;
        assert!(!last.iter().zip(first).any(differs));
        assert!(last.iter().any(|uv| uv.length() > 0.5));
    }
}
