//! Cutting a face into triangles.

use mesh::{EditError, FaceId, HalfEdgeId, Mesh, VertexId};

use super::Cutter;

/// Cuts a face into triangles, whatever its shape and however it lies in space.
///
/// ```text
///    e --- d           e --- d
///    |      \          | 2 / |\        f = a b c d e keeps its id as triangle 0, with its first
///    |       c   -->   |  /  |1c       corner and its first side; the others are new
///    |      /          | / 0 |/
///    a --- b           a --- b
/// ```
///
/// A face of n corners becomes n - 2 triangles. The n - 3 diagonals are new edges, in order of their
/// corners counted from the first corner of `f`, each from the lower to the higher; the new faces come
/// in order of their lowest side, counted likewise, those without a side of `f` last. Which diagonals,
/// is told by [`Cutter`]. A diagonal between vertices that share an edge already is avoided if there is
/// another way to cut the face; then those with the shortest diagonals are taken.
///
/// The new faces have the values of `f`, and corners those of the same vertex in `f`. The diagonals have
/// zero values.
///
/// Returns the triangles, `f` first.
///
/// # Errors
///
/// [`EditError::DuplicateEdge`] if a diagonal that joins two vertices again cannot be avoided, which is
/// not tried for more than 256 corners; [`EditError::Pinch`] if it would begin and end at one vertex,
/// which `f` passes twice; [`EditError::NoSuchFace`], [`EditError::Full`]. The mesh is unchanged.
///
/// # Examples
///
/// ```
/// let mut prism = geometry::shapes::cylinder(5, true);
/// let top = prism.faces().last().unwrap();
/// assert_eq!(geometry::triangulate::triangulate_face(&mut prism, top)?.len(), 3);
/// assert!(prism.is_triangle(top));
/// # Ok::<(), mesh::EditError>(())
/// ```
pub fn triangulate_face(mesh: &mut Mesh, f: FaceId) -> Result<Vec<FaceId>, EditError> {
    if !mesh.has_face(f) {
        return Err(EditError::NoSuchFace(f));
    }
    let sides: Vec<HalfEdgeId> = mesh.face_half_edges(f).collect();
    if sides.len() == 3 {
        return Ok(vec![f]);
    }
    let vertices = |pair: [u32; 2]| pair.map(|corner| mesh.origin(sides[corner as usize]));
    let allowed = |pair: [u32; 2]| {
        let [x, y] = pair.map(|corner| sides[corner as usize]);
        mesh.origin(x) != mesh.origin(y) && !mesh.share_an_edge(x, y)
    };
    let mut cutter = Cutter::default();
    let mut diagonals = Vec::new();
    let Some(cut) = cutter.cut_where(mesh, f, allowed) else {
        cutter.cut(mesh, f).diagonals(&mut diagonals);
        let bad = diagonals.into_iter().find(|&pair| !allowed(pair));
        let [v, w] = vertices(bad.expect("else it can be cut so"));
        return Err(refusal(v, w));
    };
    cut.diagonals(&mut diagonals);
    // A face that passes a vertex twice may have two diagonals between the same vertices.
    let mut joined: Vec<[VertexId; 2]> = diagonals
        .iter()
        .map(|&pair| {
            let [v, w] = vertices(pair);
            [v.min(w), v.max(w)]
        })
        .collect();
    joined.sort_unstable();
    if let Some(pair) = joined.windows(2).find(|pair| pair[0] == pair[1]) {
        return Err(refusal(pair[0][0], pair[0][1]));
    }
    mesh.cut_face(f, &diagonals)
}
fn refusal(v: VertexId, w: VertexId) -> EditError {
    if v == w {
        EditError::Pinch(v)
    } else {
        EditError::DuplicateEdge(v, w)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mesh::{CREASE, DVec2, DVec3, MATERIAL, UV};

    use crate::{shapes, volume};

    /// One face in the plane z = 0.
    fn polygon(points: &[(f64, f64)]) -> Mesh {
        let at = |&(x, y): &(f64, f64)| DVec3::new(x, y, 0.0);
        let corners: Vec<u32> = (0..).take(points.len()).collect();
        Mesh::from_polygons(points.iter().map(at).collect(), &[corners])
            .unwrap()
            .0
    }

    /// Cuts the face, takes it back, and does it again.
    fn cut(before: &Mesh, f: FaceId) -> Result<Mesh, EditError> {
        let mut mesh = before.clone();
        mesh.begin();
        let triangles = triangulate_face(&mut mesh, f);
        assert_eq!(mesh.defects(), [], "{triangles:?}");
        let after = mesh.clone();
        mesh.rollback();
        assert_eq!(&mesh, before);
        let triangles = triangles?;

        assert_eq!(triangles[0], f);
        assert_eq!(triangles.len() + 2, before.degree(f));
        assert!(triangles.iter().all(|&f| after.is_triangle(f)));
        assert_eq!(after.euler_characteristic(), before.euler_characteristic());
        assert_eq!(after.n_boundary_loops(), before.n_boundary_loops());
        let first = |mesh: &Mesh| mesh.origin(mesh.face_half_edge(f));
        assert_eq!(first(&after), first(before));
        let area: f64 = triangles.iter().map(|&f| after.face_area(f)).sum();
        assert!((area - before.face_area(f)).abs() < 1e-12 * (1.0 + area));

        mesh.begin();
        triangulate_face(&mut mesh, f).unwrap();
        let change = mesh.commit().unwrap();
        let again = mesh.revert(change);
        assert_eq!(&mesh, before);
        mesh.revert(again);
        assert_eq!(mesh, after);
        Ok(after)
    }

    #[test]
    fn every_face_of_every_shape_becomes_triangles() {
        for shape in [
            shapes::square(),
            shapes::cube(),
            shapes::grid(3, 2),
            shapes::icosahedron(),
            shapes::torus(4, 3, 2.0, 0.5),
            shapes::cylinder(3, true),
            shapes::cylinder(20, true),
        ] {
            for f in shape.faces() {
                cut(&shape, f).unwrap();
            }
            let mut all = shape.clone();
            for f in shape.faces() {
                triangulate_face(&mut all, f).unwrap();
            }
            assert_eq!(all.defects(), []);
            assert!(all.faces().all(|f| all.is_triangle(f)));
            assert!((volume(&all) - volume(&shape)).abs() < 1e-12);
        }
    }

    #[test]
    fn a_dented_face_is_covered_once() {
        let comb = [
            (0., 0.),
            (5., 0.),
            (5., 3.),
            (4., 1.),
            (3., 3.),
            (2., 1.),
            (1., 3.),
        ];
        for first in 0..comb.len() {
            let mut points = comb;
            points.rotate_left(first);
            let mesh = cut(&polygon(&points), FaceId::new(0)).unwrap();
            assert!(mesh.faces().all(|f| mesh.area_vector(f).z > 0.0));
        }
    }

    #[test]
    fn new_faces_come_in_order_of_their_sides() {
        let flat = polygon(&[(0., 0.), (2., 0.), (3., 1.), (2., 2.), (0., 2.)]);
        let mesh = cut(&flat, FaceId::new(0)).unwrap();
        let corners = |f| {
            mesh.face_vertices(f)
                .map(VertexId::index)
                .collect::<Vec<_>>()
        };
        let around: Vec<_> = mesh.faces().map(corners).collect();
        assert_eq!(around, [[0, 1, 3], [1, 2, 3], [3, 4, 0]]);
        let ends = mesh.edges().skip(5).map(|e| mesh.edge_vertices(e));
        let ends: Vec<_> = ends.map(|pair| pair.map(VertexId::index)).collect();
        assert_eq!(ends, [[0, 3], [1, 3]]);
    }

    #[test]
    fn values_go_with_their_elements() {
        let mut before = shapes::cylinder(7, true);
        let place = |mesh: &Mesh, h| {
            let p = mesh.position(mesh.origin(h));
            let chart = mesh
                .face(h)
                .map_or(-1, |f| mesh.get(MATERIAL).unwrap()[f.index()]);
            DVec2::new(p.x + 10.0 * f64::from(chart), p.y + p.z)
        };
        before.set(MATERIAL, (0..9).collect());
        before.set(UV, before.half_edges().map(|h| place(&before, h)).collect());
        before.set(CREASE, vec![1.0; before.n_edges()]);
        let mesh = cut(&before, FaceId::new(8)).unwrap();
        let uvs = mesh.get(UV).unwrap();
        assert!(mesh.half_edges().all(|h| uvs[h.index()] == place(&mesh, h)));
        assert_eq!(mesh.get(MATERIAL).unwrap()[8..], [8; 5]);
        assert_eq!(mesh.get(CREASE).unwrap()[before.n_edges()..], [0.0; 4]);
    }

    #[test]
    fn vertices_that_share_an_edge_are_not_joined_again() {
        // Vertices 0 and 2 share an edge behind the square, whose shorter diagonal that would be.
        let points = vec![
            DVec3::ZERO,
            DVec3::X,
            DVec3::new(0.9, 0.9, 0.0),
            DVec3::Y,
            DVec3::new(0.5, 0.5, -1.0),
        ];
        let faces: [&[u32]; 3] = [&[0, 1, 2, 3], &[1, 0, 4, 2], &[0, 2, 4]];
        let (mesh, _) = Mesh::from_polygons(points, &faces).unwrap();
        let mesh = cut(&mesh, FaceId::new(0)).unwrap();
        let [v, w] = [1, 3].map(VertexId::new);
        assert!(mesh.find_half_edge(v, w).is_some());
    }

    #[test]
    fn a_pentagon_finds_another_way_around_an_edge() {
        let flat = polygon(&[(0., 0.), (2., 0.), (3., 1.), (2., 2.), (0., 2.)]);
        let f = FaceId::new(0);
        let joined = |mesh: &Mesh| {
            let [v, w] = [1, 3].map(VertexId::new);
            mesh.vertex_neighbors(v).filter(|&n| n == w).count()
        };
        assert_eq!(joined(&cut(&flat, f).unwrap()), 1);
        // The same with faces behind it that join 1 and 3 by an edge.
        let mut positions = flat.positions().to_vec();
        positions.push(DVec3::new(1.0, 1.0, -1.0));
        let faces: [&[u32]; 3] = [&[0, 1, 2, 3, 4], &[2, 1, 3], &[3, 1, 5]];
        let (behind, report) = Mesh::from_polygons(positions, &faces).unwrap();
        assert!(report.is_clean());
        assert_eq!(joined(&behind), 1);
        assert_eq!(joined(&cut(&behind, f).unwrap()), 1);
    }

    #[test]
    fn what_cannot_be_avoided_is_refused() {
        // Two arrow heads back to back: each has one diagonal inside.
        let points = vec![
            DVec3::ZERO,
            DVec3::new(2.0, 1.0, 0.0),
            DVec3::X,
            DVec3::new(2.0, -1.0, 0.0),
        ];
        let (mesh, _) = Mesh::from_polygons(points, &[[0, 1, 2, 3], [3, 2, 1, 0]]).unwrap();
        let mut mesh = cut(&mesh, FaceId::new(0)).unwrap();
        let before = mesh.clone();
        let refused = triangulate_face(&mut mesh, FaceId::new(1));
        assert!(
            matches!(refused, Err(EditError::DuplicateEdge(..))),
            "{refused:?}"
        );
        assert_eq!(mesh, before);
        let missing = FaceId::new(9);
        assert_eq!(cut(&mesh, missing), Err(EditError::NoSuchFace(missing)));
    }

    #[test]
    fn a_face_without_area_becomes_a_fan() {
        let line: Vec<(f64, f64)> = (0..6).map(|i| (f64::from(i), 0.0)).collect();
        let mesh = cut(&polygon(&line), FaceId::new(0)).unwrap();
        assert_eq!(mesh.valence(VertexId::new(0)), 5);
    }
}
