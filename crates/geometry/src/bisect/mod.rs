//! Cutting a mesh along a plane.

mod chords;
#[cfg(test)]
mod tests;

use mesh::{DVec3, EdgeId, EditError, FaceId, HalfEdgeId, Mesh, VertexId};

use crate::bounds;

use chords::Corner;

/// How near to the plane a vertex counts as on it, as a part of the largest extent of the mesh.
const NEAR: f64 = 1e-9;
/// The same as a part of the largest coordinate: what rounding may do far from the origin.
const ROUNDING: f64 = 1e-14;

/// What a plane made of a mesh: see [`bisect`].
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Bisection {
    /// The edges on the plane, in order of their ids.
    pub edges: Vec<EdgeId>,
    /// The faces on the side that the normal points to, in order of their ids.
    pub front: Vec<FaceId>,
    /// The faces on the other side, in order of their ids.
    pub back: Vec<FaceId>,
}

/// Cuts the mesh along a plane: afterwards every face lies on one side of it.
///
/// ```text
///    +-------+-------+           +-------+-------+
///    |       |       |           |       |       |       normal
///    |       |       |    -->    m-------m-------m         ^     the plane through `point`
///    |       |       |           |       |       |         |
///    +-------+-------+           +-------+-------+
/// ```
///
/// Every edge that crosses the plane gets a vertex where it does, and every face that crosses it is cut
/// along it, concave ones several times. The mesh stays in one piece. Vertices nearer to the plane than
/// 1e-9 of the largest extent of the mesh, or than 1e-14 of its largest coordinate, count as on it:
/// they are not moved, and no edge shorter than that arises. On which side a vertex lies is decided
/// once, for all edges and faces. A crossing point does not depend on which end of its edge is first.
///
/// An edge keeps its id on the side of the origin of its first half; the other parts are new, in order of
/// the edges, and so are the crossing points. Then come the edges on the plane, face by face. A face
/// keeps its id at its first corner, its other parts are new.
///
/// Values are interpolated at crossing points, within its own face at each corner, so that both sides of
/// a seam keep theirs. Parts of an edge or a face have its values, edges on the plane have zero values.
///
/// The line of the plane crosses the sides of a flat face an even number of times, and every other piece
/// between them is inside. Where that comes out wrong, because a face is twisted or crosses itself, each
/// piece in front of the plane is cut off on its own. Two faces that share both edges which the plane
/// crosses get an edge each between the same two crossing points.
///
/// A face in the plane counts as behind it if its normal points to the front, because what it closes lies
/// behind, and otherwise as in front.
///
/// # Errors
///
/// [`EditError::BadNumber`] for a normal without direction, for coordinates that are not finite, and if
/// the mesh is so large that distances are not; [`EditError::Pinch`] if a face passes a vertex twice and
/// would be cut from there to there; [`EditError::Full`]. The mesh is unchanged.
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

/// The signed distance of each vertex from the plane: 0 if it counts as on it, and for dead ones.
fn heights(mesh: &Mesh, point: DVec3, normal: DVec3) -> Result<Vec<f64>, EditError> {
    if let Some(&bad) = point.to_array().iter().find(|x| !x.is_finite()) {
        return Err(EditError::BadNumber(bad));
    }
    let [min, max] = bounds(mesh).unwrap_or([DVec3::ZERO; 2]);
    let extent = (max - min).max_element();
    let largest = min.abs().max(max.abs()).max(point.abs()).max_element();
    let near = (NEAR * extent).max(ROUNDING * largest);
    let height = |v: usize| {
        let v = VertexId::new(v);
        if !mesh.has_vertex(v) {
            return Ok(0.0);
        }
        let height = (mesh.position(v) - point).dot(normal);
        // Twice as much is the largest difference of two heights.
        if !(2.0 * height).is_finite() || !near.is_finite() {
            return Err(EditError::BadNumber(height));
        }
        Ok(if height.abs() <= near { 0.0 } else { height })
    };
    (0..mesh.positions().len()).map(height).collect()
}

/// Puts a vertex on every edge whose ends lie on different sides, and its height, 0, behind the others.
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
        // The same two weights, bit for bit, if a and b change places.
        let (weight_a, weight_b) = (high / (high - low), low / (low - high));
        let p = weight_a * mesh.position(a) + weight_b * mesh.position(b);
        let new = mesh.insert_vertex(e, weight_b)?;
        let [m, _] = mesh.edge_vertices(new);
        mesh.set_position(m, p);
        heights.push(0.0);
    }
    Ok(())
}

/// Cuts a face whose corners lie on both sides.
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
    // Along the line in which the plane meets the face, so that the front is to its left.
    let along = normal.cross(mesh.face_normal(f));
    let first = mesh.position(mesh.origin(sides[0]));
    let corners: Vec<Corner> = sides
        .iter()
        .map(|&h| {
            let p = mesh.position(mesh.origin(h)) - first;
            Corner::new(height(h), along.dot(p), p)
        })
        .collect();
    let chords = chords::between(&corners, mesh.face_normal(f));
    mesh.cut_face(f, &chords).map(drop)
}

/// What lies where, after all is cut.
fn sides(mesh: &Mesh, normal: DVec3, heights: &[f64]) -> Bisection {
    let height = |v: VertexId| heights[v.index()];
    let mut found = Bisection::default();
    let on_plane = |&e: &EdgeId| mesh.edge_vertices(e).iter().all(|&v| height(v) == 0.0);
    found.edges = mesh.edges().filter(on_plane).collect();
    for f in mesh.faces() {
        let off = mesh.face_vertices(f).map(height).find(|&h| h != 0.0);
        let off = off.unwrap_or_else(|| -mesh.area_vector(f).dot(normal));
        if off > 0.0 {
            found.front.push(f);
        } else {
            found.back.push(f);
        }
    }
    found
}

/// The direction of a vector, of any length but 0.
fn direction(vector: DVec3) -> Result<DVec3, EditError> {
    let largest = vector.abs().max_element();
    if let Some(&bad) = vector.to_array().iter().find(|x| !x.is_finite()) {
        return Err(EditError::BadNumber(bad));
    }
    if largest == 0.0 {
        return Err(EditError::BadNumber(0.0));
    }
    // Brought near 1 first, so that squares neither overflow nor vanish.
    Ok((vector / largest).normalize())
}
