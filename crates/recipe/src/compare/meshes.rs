//! Compares two meshes.

use std::cmp::Ordering;

use mesh::{DVec3, Domain, Mesh, VertexId};

use super::attributes::{AttributeDifference, differences};
use super::order::{Order, same_connectivity};
use crate::expect::same_faces;
use geometry::distance::Distance;

/// The comparison of two meshes.
#[derive(Clone, Debug)]
pub struct MeshDifference {
    /// The element counts and the size of the first mesh, and those of the second mesh.
    pub counts: [Counts; 2],
    /// Whether corresponding faces of the two meshes have the same vertices.
    pub connectivity: Connectivity,
    /// The vertices that moved. `None` if no vertex moved or `connectivity` is not [`Connectivity::Same`].
    pub moved: Option<Moved>,
    /// The attributes of both meshes. The attributes are grouped by domain. In each group, the attributes of the first
    /// mesh come first, followed by the attributes that only the second mesh has.
    pub attributes: Vec<AttributeDifference>,
    /// The distance between the surfaces of the two meshes. `None` if the meshes are identical or one of them has no
    /// faces.
    pub distance: Option<Distance>,
}

/// The element counts and the size of a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Counts {
    /// The number of vertices.
    pub vertices: usize,
    /// The number of edges.
    pub edges: usize,
    /// The number of faces.
    pub faces: usize,
    /// The number of connected components.
    pub components: usize,
    /// The number of boundary loops.
    pub boundary_loops: usize,
    /// The sum of the areas of the faces, in square scene units.
    pub area: f64,
    /// The enclosed volume, in cubic scene units. The volume has no meaning if the mesh has boundary loops.
    pub volume: f64,
    /// The lowest and the highest coordinates of the vertices. `None` if the mesh has no vertices.
    pub bounds: Option<[DVec3; 2]>,
}

/// Whether the faces of two meshes have the same vertices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Connectivity {
    /// Both meshes have the same vertex ids. If the faces are ordered by id, the n-th face of one mesh has the same
    /// vertices as the n-th face of the other mesh.
    Same,
    /// The vertices have the same positions and the faces are the same, but the ids differ.
    Reordered,
    /// The faces differ.
    Different,
}

/// The vertices that moved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moved {
    /// The number of vertices that moved.
    pub count: usize,
    /// The vertex that moved the largest distance.
    pub vertex: VertexId,
    /// The distance that the vertex moved, in scene units.
    pub by: f64,
}

impl MeshDifference {
    pub(super) fn between(a: &Mesh, b: &Mesh, identical: bool) -> Self {
        let orders = [Order::of(a), Order::of(b)];
        let connectivity = if same_connectivity(a, b, &orders) {
            Connectivity::Same
        } else if same_up_to_order(a, b, &orders) {
            Connectivity::Reordered
        } else {
            Connectivity::Different
        };
        let is_same = connectivity == Connectivity::Same;
        let distance = if identical {
            None
        } else {
            Distance::between(a, b, None)
        };
        Self {
            counts: [Counts::of(a), Counts::of(b)],
            connectivity,
            moved: if is_same { moved(a, b, &orders) } else { None },
            attributes: differences([a, b], is_same.then_some(&orders)),
            distance,
        }
    }

    /// Whether the connectivity is the same and no position or attribute value differs by more than `tolerance`.
    pub fn is_within(&self, tolerance: f64) -> bool {
        self.connectivity == Connectivity::Same
            && self.moved.is_none_or(|moved| moved.by <= tolerance)
            && self.attributes.iter().all(|a| a.is_within(tolerance))
    }
}

impl Counts {
    fn of(mesh: &Mesh) -> Self {
        Self {
            vertices: mesh.n_vertices(),
            edges: mesh.n_edges(),
            faces: mesh.n_faces(),
            components: geometry::n_components(mesh),
            boundary_loops: mesh.n_boundary_loops(),
            area: geometry::area(mesh),
            volume: geometry::volume(mesh),
            bounds: geometry::bounds(mesh),
        }
    }
}

/// Whether the two meshes differ only in the order of their elements. If several vertices have the same position, they
/// are matched in the order of their ids.
fn same_up_to_order(a: &Mesh, b: &Mesh, [p, q]: &[Order; 2]) -> bool {
    let sorted = |mesh: &Mesh, order: &Order| {
        let mut vertices = order.vertices.clone();
        let compare = |v: DVec3, w: DVec3| {
            let axes = [
                v.x.total_cmp(&w.x),
                v.y.total_cmp(&w.y),
                v.z.total_cmp(&w.z),
            ];
            axes.into_iter().fold(Ordering::Equal, Ordering::then)
        };
        vertices.sort_by(|&v, &w| compare(mesh.position(v), mesh.position(w)));
        vertices
    };
    let (vertices, others) = (sorted(a, p), sorted(b, q));
    let is_same_position = |(&v, &w): (&VertexId, &VertexId)| a.position(v) == b.position(w);
    if vertices.len() != others.len() || !vertices.iter().zip(&others).all(is_same_position) {
        return false;
    }
    let mut map = vec![VertexId::NONE; b.domain_len(Domain::Vertex)];
    for (&v, &w) in vertices.iter().zip(&others) {
        map[w.index()] = v;
    }
    same_faces(a, b, &map, false)
}

fn moved(a: &Mesh, b: &Mesh, [p, q]: &[Order; 2]) -> Option<Moved> {
    let mut moved: Option<Moved> = None;
    for (&v, &w) in p.vertices.iter().zip(&q.vertices) {
        let (from, to) = (a.position(v), b.position(w));
        if from == to {
            continue;
        }
        let by = from.distance(to);
        let count = moved.map_or(0, |m| m.count) + 1;
        moved = Some(match moved {
            Some(most) if most.by >= by => Moved { count, ..most },
            _ => Moved {
                count,
                vertex: v,
                by,
            },
        });
    }
    moved
}
