//! Makes a mesh symmetric by replacing one half by the mirror image of the other half.

use mesh::{BuildReport, Column, DVec3, Domain, EditError, FaceId, Mesh, Value, morph_of};

use super::{bisect, direction, heights};
use crate::merge::MergeError;
use crate::{merge_clusters, parts};

/// The result of [`symmetrize`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Symmetrized {
    /// The number of faces of the original mesh that have no part in front of the plane. These are the faces behind the
    /// plane, even if they touch the plane, and the faces in the plane. Faces that cross the plane are not counted.
    pub removed: usize,
    /// The number of vertices on the plane at which the two halves are joined.
    pub joined: usize,
    /// The changes that made the result a manifold.
    pub report: BuildReport,
}

/// Why a mesh could not be made symmetric. After this error, the mesh is unchanged.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SymmetrizeError {
    /// The mesh could not be cut.
    #[error(transparent)]
    Cut(#[from] EditError),
    /// The halves could not be joined.
    #[error(transparent)]
    Join(#[from] MergeError),
}

/// Replaces the half of a dense mesh that lies behind a plane by the mirror image of the half in front of the plane.
///
/// ```text
///     +---.   |  .                     +---.   |   .---+
///     |    '--m-'  '                   |    '--m--'    |       the normal points to the left
///     |       |     '         -->      |       |       |
///     |    .--m----'                   |    .--m--.    |
///     +---'   |                        +---'   |   '---+
/// ```
///
/// The mesh is cut as in [`bisect`]. Faces behind the plane and faces in the plane are removed. The remaining vertices
/// that count as lying on the plane are moved onto the plane, by at most the tolerance of `bisect`. The two halves
/// share the boundary vertices on the plane. In the result, the elements of the original half come first and keep their
/// order. The elements of the mirror image follow in the same order, with copies of the values of the original half.
/// The deltas of morph targets are mirrored, and stored normals are removed from both halves. Like `bisect`, this
/// function can add a second edge between two vertices on the plane that already share an edge.
///
/// # Errors
///
/// Returns a [`SymmetrizeError`] if the mesh cannot be cut or the halves cannot be joined. After an error, the mesh is
/// unchanged.
pub fn symmetrize(
    mesh: &mut Mesh,
    point: DVec3,
    normal: DVec3,
) -> Result<Symmetrized, SymmetrizeError> {
    let normal = direction(normal)?;
    let level = heights(mesh, point, normal)?;
    let is_behind = |&f: &FaceId| mesh.face_vertices(f).all(|v| level[v.index()] <= 0.0);
    let removed = mesh.faces().filter(is_behind).count();
    let mut cut = mesh.clone();
    let sides = bisect(&mut cut, point, normal)?;
    let level = heights(&cut, point, normal)?;
    let mut part_of_face = vec![usize::MAX; cut.domain_len(Domain::Face)];
    for &f in &sides.front {
        let is_flat = cut.face_vertices(f).all(|v| level[v.index()] == 0.0);
        if !is_flat {
            part_of_face[f.index()] = 0;
        }
    }
    let Some(mut half) = parts(&cut, &part_of_face).pop() else {
        let faces: Vec<_> = cut.faces().collect();
        cut.delete_faces(&faces)?;
        cut.delete_isolated_vertices();
        cut.compact();
        mesh.replace(cut);
        return Ok(Symmetrized {
            removed,
            ..Symmetrized::default()
        });
    };
    half.remove_normals();
    let level = heights(&half, point, normal)?;
    let on_plane: Vec<bool> = level.iter().map(|&height| height == 0.0).collect();
    let height = |p: DVec3| normal.dot(p - point);
    for (p, &is_on) in half.positions_mut().iter_mut().zip(&on_plane) {
        if is_on {
            *p -= normal * height(*p);
        }
    }
    let mirror = |v: DVec3| v - 2.0 * normal * normal.dot(v);
    let mut image = half.reversed();
    for (p, &is_on) in image.positions_mut().iter_mut().zip(&on_plane) {
        if !is_on {
            *p -= 2.0 * normal * height(*p);
        }
    }
    for column in image.attributes().of(Domain::Vertex).to_vec() {
        if let (Some(_), Some(deltas)) = (morph_of(&column.name), DVec3::of(&column.values)) {
            let values = Value::wrap(deltas.iter().copied().map(mirror).collect());
            image.insert_column(Domain::Vertex, Column { values, ..column });
        }
    }
    let n = half.n_vertices();
    let mut lowest: Vec<u32> = (0..).take(2 * n).collect();
    let mut joined = 0;
    for v in half.vertices() {
        if on_plane[v.index()] && half.is_boundary_vertex(v) {
            lowest[n + v.index()] = lowest[v.index()];
            joined += 1;
        }
    }
    let mut whole = both(&half, &image);
    let merged = merge_clusters(&mut whole, &lowest).map_err(MergeError::from)?;
    mesh.replace(whole);
    Ok(Symmetrized {
        removed,
        joined,
        report: merged.report,
    })
}

/// Returns a mesh with the elements of `a`, followed by the elements of `b`. Both meshes must be dense and have the
/// same attributes.
fn both(a: &Mesh, b: &Mesh) -> Mesh {
    let mut connectivity = a.connectivity().clone();
    connectivity.append(b.connectivity());
    let positions = [a.positions(), b.positions()].concat();
    let lens = |mesh: &Mesh| Domain::ALL.map(|domain| mesh.domain_len(domain));
    let mut attributes = a.attributes().clone();
    attributes.append(lens(a), b.attributes(), lens(b));
    let mut mesh = Mesh::from_arrays(connectivity, positions);
    mesh.set_attributes(attributes);
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;
    use mesh::{DVec2, UV};

    /// Whether each vertex has an exact mirror image, bit for bit.
    fn is_symmetric(mesh: &Mesh, axis: usize) -> bool {
        mesh.positions().iter().all(|&p| {
            let mut image = p;
            image[axis] = -image[axis];
            mesh.positions().contains(&image)
        })
    }

    #[test]
    fn the_halves_of_a_cut_torus_are_equal() {
        for (axis, normal) in [DVec3::X, DVec3::NEG_Y, DVec3::Z].into_iter().enumerate() {
            let mut mesh = shapes::torus(9, 7, 1.0, 0.4);
            for p in mesh.positions_mut() {
                *p += DVec3::new(0.01, 0.02, 0.03) + 0.1 * DVec3::new(p.y, p.z, p.x);
            }
            let done = symmetrize(&mut mesh, DVec3::ZERO, normal).unwrap();
            assert!(is_symmetric(&mesh, axis), "{axis}");
            assert!(mesh.is_valid() && mesh.is_closed() && done.joined > 0);
            assert_eq!(crate::genus(&mesh), 1);
            assert_eq!(done.report, BuildReport::default());
        }
    }

    #[test]
    fn a_symmetric_cube_stays_a_cube() {
        let mut mesh = shapes::cube();
        let done = symmetrize(&mut mesh, DVec3::ZERO, DVec3::X).unwrap();
        assert_eq!(
            (mesh.n_vertices(), mesh.n_faces(), done.joined),
            (12, 10, 4)
        );
        assert!((crate::volume(&mesh) - 8.0).abs() < 1e-12);
        // The plane contains a face. This face is removed, because it would become a wall inside the solid.
        let mut mesh = shapes::cube();
        symmetrize(&mut mesh, DVec3::NEG_X, DVec3::X).unwrap();
        assert_eq!((mesh.n_vertices(), mesh.n_faces()), (12, 10));
        assert!(mesh.is_closed() && (crate::volume(&mesh) - 16.0).abs() < 1e-12);
    }

    #[test]
    fn an_oblique_plane_mirrors_too() {
        let mut mesh = shapes::torus(16, 8, 1.0, 0.4);
        let (point, normal) = (DVec3::new(0.1, 0.0, 0.05), DVec3::new(1.0, 2.0, -0.5));
        symmetrize(&mut mesh, point, normal).unwrap();
        let n = normal.normalize();
        assert!(mesh.is_valid() && mesh.is_closed());
        for &p in mesh.positions() {
            let image = p - 2.0 * n * n.dot(p - point);
            let distances = mesh.positions().iter().map(|q| q.distance(image));
            assert!(distances.fold(f64::MAX, f64::min) < 1e-12);
        }
    }

    #[test]
    fn removed_faces_are_those_without_a_part_in_front() {
        // A comb with three teeth, and a triangle in the plane. The comb is cut into three front parts.
        let points = [
            [-1.0, 0.0],
            [1.0, 0.0],
            [1.0, 2.0],
            [0.8, 2.0],
            [0.6, 0.5],
            [0.2, 2.0],
            [-0.2, 2.0],
            [-0.6, 0.5],
            [-0.8, 2.0],
            [-1.0, 2.0],
        ];
        let comb = points.map(|[x, y]| DVec3::new(x, y, 0.0));
        let behind = comb.map(|p| DVec3::new(p.x + 5.0, p.y - 3.0, 0.0));
        let in_plane = [[9.0, 0.0], [10.0, 0.0], [9.0, 1.0]];
        let in_plane = in_plane.map(|[x, z]| DVec3::new(x, 1.0, z));
        let positions = [&comb[..], &behind[..], &in_plane[..]].concat();
        let faces: [Vec<u32>; 3] = [(0..10).collect(), (10..20).collect(), (20..23).collect()];
        let (mut mesh, _) = Mesh::from_polygons(positions, &faces).unwrap();
        let done = symmetrize(&mut mesh, DVec3::Y, DVec3::Y).unwrap();
        assert_eq!((mesh.n_faces(), done.removed), (6, 2));
    }

    #[test]
    fn nothing_in_front_gives_an_empty_mesh() {
        let mut mesh = shapes::cube();
        let done = symmetrize(&mut mesh, DVec3::splat(5.0), DVec3::X).unwrap();
        assert_eq!((mesh.n_vertices(), mesh.n_faces(), done.removed), (0, 0, 6));
        assert!(symmetrize(&mut mesh, DVec3::ZERO, DVec3::ZERO).is_err());
    }

    #[test]
    fn texture_coordinates_are_copied() {
        let mut mesh = shapes::cube();
        let uvs = mesh
            .half_edges()
            .map(|h| mesh.position(mesh.origin(h)).truncate());
        let uvs: Vec<DVec2> = uvs.collect();
        mesh.set(UV, uvs);
        symmetrize(&mut mesh, DVec3::ZERO, DVec3::X).unwrap();
        let uvs = mesh.get(UV).unwrap();
        for h in mesh.faces().flat_map(|f| mesh.face_half_edges(f)) {
            let p = mesh.position(mesh.origin(h));
            assert_eq!(uvs[h.index()], DVec2::new(p.x.abs(), p.y));
        }
    }
}
