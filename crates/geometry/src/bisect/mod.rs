//! Cuts a mesh along a plane.

mod chords;
mod symmetrize;
#[cfg(test)]
mod tests;

use mesh::{DVec3, EdgeId, EditError, FaceId, HalfEdgeId, Mesh, VertexId};

use crate::bounds;

use chords::Corner;
pub use symmetrize::{SymmetrizeError, Symmetrized, symmetrize};

/// A vertex counts as lying on the plane if its distance from the plane is at most this fraction of the largest extent
/// of the mesh.
const RELATIVE_TOLERANCE: f64 = 1e-9;
/// A vertex also counts as lying on the plane if its distance from the plane is at most this number times c. Here c is
/// the largest absolute coordinate of all vertices and of the given point of the plane. Coordinates far from the origin
/// have rounding errors of this size.
const ROUNDING_TOLERANCE: f64 = 1e-14;

/// The result of [`bisect`].
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Bisection {
    /// The edges that lie on the plane, in the order of their ids.
    pub edges: Vec<EdgeId>,
    /// The faces on the side that the normal points to, in order of their ids.
    pub front: Vec<FaceId>,
    /// The faces on the side that the normal points away from, in order of their ids.
    pub back: Vec<FaceId>,
}

/// Cuts the mesh along a plane, so that every face lies on one side of the plane.
///
/// ```text
///    +-------+-------+           +-------+-------+
///    |       |       |           |       |       |       normal
///    |       |       |    -->    m-------m-------m         ^     the plane through `point`
///    |       |       |           |       |       |         |
///    +-------+-------+           +-------+-------+
/// ```
///
/// Every edge that crosses the plane gets a vertex at the crossing point. Every face that crosses the plane is cut
/// along the plane; a concave face can be cut several times. The parts of a face share the new edges, so the mesh
/// remains connected. A vertex counts as lying on the plane if its distance from the plane is at most the larger of two
/// tolerances. One tolerance is 1e-9 times the largest extent of the mesh. The other tolerance is 1e-14 times the
/// largest absolute coordinate of the mesh and `point`. A vertex on the plane is not moved, and an edge with an end on
/// the plane is not split. The side of the plane on which a vertex lies is determined once, and is the same for all
/// edges and faces at the vertex. The crossing point of an edge does not depend on which end of the edge comes first.
///
/// Ids change as follows. When an edge is split, the part at the origin of its first half-edge keeps the id of the
/// edge. The other parts of split edges and the crossing points get new ids, in the order of the edges. The new edges
/// on the plane are numbered after the parts of the split edges, face by face. When a face is cut, the part with its
/// first corner keeps the id of the face; the other parts are new.
///
/// Values are interpolated at crossing points. Corner values are interpolated within their face, so that seams are
/// preserved. All parts of a split edge have the values of this edge, and all parts of a cut face have the values of
/// this face. New edges on the plane have zero values.
///
/// The plane meets a flat face in a line. This line crosses the sides of the face an even number of times. The
/// intervals of the line between the crossings are alternately inside and outside of the face. At each corner on the
/// line, the adjacent sides of the face show whether the intervals next to the corner are inside. If a face is not flat
/// or intersects itself, the two ends of an interval can disagree: only one of them shows that the interval is inside.
/// In this case, each part of the face in front of the plane is cut off separately. If two faces share both edges that
/// the plane crosses, each face gets a separate edge between the same two crossing points.
///
/// A face can lie in the plane. If the normal of this face points to the back of the plane, the solid that the face
/// bounds is in front of the plane. The face then counts as a face in front of the plane. Otherwise, the face counts as
/// a face behind the plane.
///
/// # Errors
///
/// Returns [`EditError::BadNumber`] if the normal is zero, if a coordinate is not finite, or if the mesh is so large
/// that distances are not finite. Returns [`EditError::Pinch`] if a face contains a vertex twice and would be cut from
/// that vertex to itself. Returns [`EditError::Full`] if the cut mesh could have too many elements. After an error, the
/// mesh is unchanged.
///
/// # Examples
///
/// ```
/// use mesh::DVec3;
///
/// let mut cube = geometry::shapes::cube();
/// let cut = geometry::bisect(&mut cube, DVec3::ZERO, DVec3::Z)?;
/// assert_eq!((cut.edges.len(), cut.front.len(), cut.back.len()), (4, 5, 5));
/// # Ok::<(), mesh::EditError>(())
/// ```
pub fn bisect(mesh: &mut Mesh, point: DVec3, normal: DVec3) -> Result<Bisection, EditError> {
    let normal = direction(normal)?;
    let mut heights = heights(mesh, point, normal)?;
    mesh.atomically(|mesh| {
        split_across(mesh, &mut heights)?;
        let faces: Vec<FaceId> = mesh.faces().collect();
        for f in faces {
            cut_across(mesh, f, normal, &heights)?;
        }
        Ok(sides(mesh, normal, &heights))
    })
}

/// Returns the height of each vertex: the signed distance from the plane. The height is 0 for vertices that count as
/// lying on the plane, and for dead (removed) vertices.
fn heights(mesh: &Mesh, point: DVec3, normal: DVec3) -> Result<Vec<f64>, EditError> {
    if let Some(&bad) = point.to_array().iter().find(|x| !x.is_finite()) {
        return Err(EditError::BadNumber(bad));
    }
    let [min, max] = bounds(mesh).unwrap_or([DVec3::ZERO; 2]);
    let extent = (max - min).max_element();
    let largest = min.abs().max(max.abs()).max(point.abs()).max_element();
    let near = (RELATIVE_TOLERANCE * extent).max(ROUNDING_TOLERANCE * largest);
    let height = |v: usize| {
        let v = VertexId::new(v);
        if !mesh.has_vertex(v) {
            return Ok(0.0);
        }
        let height = (mesh.position(v) - point).dot(normal);
        // The difference of the heights of any two vertices must be finite too. This difference is at most twice the
        // largest absolute height.
        if !(2.0 * height).is_finite() || !near.is_finite() {
            return Err(EditError::BadNumber(height));
        }
        Ok(if height.abs() <= near { 0.0 } else { height })
    };
    (0..mesh.positions().len()).map(height).collect()
}

/// Inserts a vertex on every edge whose ends lie on different sides of the plane. For each new vertex, appends its
/// height 0 to `heights`.
fn split_across(mesh: &mut Mesh, heights: &mut Vec<f64>) -> Result<(), EditError> {
    let crossing: Vec<EdgeId> = mesh
        .edges()
        .filter(|&e| {
            let [a, b] = mesh.edge_vertices(e).map(|v| heights[v.index()]);
            (a < 0.0 && b > 0.0) || (a > 0.0 && b < 0.0)
        })
        .collect();
    for e in crossing {
        let [a, b] = mesh.edge_vertices(e);
        let [low, high] = [a, b].map(|v| heights[v.index()]);
        // If a and b are swapped, each of them keeps exactly the same weight. So the new position does not depend on
        // the direction of the edge.
        let (weight_a, weight_b) = (high / (high - low), low / (low - high));
        let p = weight_a * mesh.position(a) + weight_b * mesh.position(b);
        let new = mesh.insert_vertex(e, weight_b)?;
        let [m, _] = mesh.edge_vertices(new);
        mesh.set_position(m, p);
        heights.push(0.0);
    }
    Ok(())
}

/// Cuts face `f` along the plane if it has corners on both sides of the plane.
fn cut_across(mesh: &mut Mesh, f: FaceId, normal: DVec3, heights: &[f64]) -> Result<(), EditError> {
    let height = |h: HalfEdgeId| heights[mesh.origin(h).index()];
    let around = mesh.face_half_edges(f);
    let (is_front, is_back) = around.clone().fold((false, false), |(front, back), h| {
        (front || height(h) > 0.0, back || height(h) < 0.0)
    });
    if !is_front || !is_back {
        return Ok(());
    }
    let sides: Vec<HalfEdgeId> = around.collect();
    // The direction of the line in which the plane meets the face. The front side of the plane is to the left of this
    // direction.
    let along = normal.cross(mesh.face_normal(f));
    let first = mesh.position(mesh.origin(sides[0]));
    let corners: Vec<Corner> = sides
        .iter()
        .map(|&h| {
            let p = mesh.position(mesh.origin(h)) - first;
            Corner::new(height(h), along.dot(p), p)
        })
        .collect();
    let chords = chords::chords_along_line(&corners, mesh.face_normal(f));
    mesh.cut_face(f, &chords).map(drop)
}

/// Returns the edges on the plane and the faces on both sides, after all faces were cut.
fn sides(mesh: &Mesh, normal: DVec3, heights: &[f64]) -> Bisection {
    let height = |v: VertexId| heights[v.index()];
    let mut bisection = Bisection::default();
    let on_plane = |&e: &EdgeId| mesh.edge_vertices(e).iter().all(|&v| height(v) == 0.0);
    bisection.edges = mesh.edges().filter(on_plane).collect();
    for f in mesh.faces() {
        let side = mesh.face_vertices(f).map(height).find(|&h| h != 0.0);
        let side = side.unwrap_or_else(|| -mesh.area_vector(f).dot(normal));
        if side > 0.0 {
            bisection.front.push(f);
        } else {
            bisection.back.push(f);
        }
    }
    bisection
}

/// Returns the unit vector in the direction of a vector. Fails if the vector is zero or not finite.
fn direction(vector: DVec3) -> Result<DVec3, EditError> {
    let largest = vector.abs().max_element();
    if let Some(&bad) = vector.to_array().iter().find(|x| !x.is_finite()) {
        return Err(EditError::BadNumber(bad));
    }
    if largest == 0.0 {
        return Err(EditError::BadNumber(0.0));
    }
    // Scales the vector to a length near 1 first, so that squares neither overflow nor underflow.
    Ok((vector / largest).normalize())
}
