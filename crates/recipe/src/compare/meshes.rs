//! Two meshes side by side.

use std::cmp::Ordering;

use mesh::{DVec3, Domain, EdgeId, FaceId, HalfEdgeId, Mesh, VertexId};

use super::attributes::{AttributeDifference, differences};
use crate::expect::same_faces;
use geometry::distance::Distance;

/// Two meshes side by side; pairs are of the first and the second.
#[derive(Clone, Debug)]
pub struct MeshDifference {
    /// How many elements each has, and how large it is.
    pub counts: [Counts; 2],
    /// Whether faces join the same vertices.
    pub connectivity: Connectivity,
    /// How vertices moved, if the connectivity is the same; `None` if none did.
    pub moved: Option<Moved>,
    /// The attributes of both, in order of domains and names.
    pub attributes: Vec<AttributeDifference>,
    /// How far the surfaces are apart; `None` if they are identical or one has no faces.
    pub distance: Option<Distance>,
}

/// How many elements a mesh has, and how large it is.
#[derive(Clone, Debug, PartialEq)]
pub struct Counts {
    /// Vertices.
    pub vertices: usize,
    /// Edges.
    pub edges: usize,
    /// Faces.
    pub faces: usize,
    /// Connected parts.
    pub components: usize,
    /// Holes.
    pub boundary_loops: usize,
    /// The sum of the areas of the faces.
    pub area: f64,
    /// The volume inside; it means nothing if there are holes.
    pub volume: f64,
    /// The lowest and highest coordinates; `None` without vertices.
    pub bounds: Option<[DVec3; 2]>,
}

/// Whether the faces of two meshes join the same vertices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Connectivity {
    /// The same faces of the same vertices, by their numbers.
    Same,
    /// The vertices lie at the same places, and the faces are the same, but numbers differ.
    Reordered,
    /// Other faces.
    Different,
}

/// Vertices that moved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moved {
    /// How many.
    pub count: usize,
    /// The one that moved furthest.
    pub vertex: VertexId,
    /// How far, in scene units.
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

    /// Whether the connectivity is the same and nothing else differs by more than `tolerance`.
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

/// The elements of a mesh in an order that only the numbers of vertices and faces decide.
pub(super) struct Order {
    pub(super) vertices: Vec<VertexId>,
    pub(super) faces: Vec<FaceId>,
    /// Face by face, from the corner at the lowest vertex.
    pub(super) corners: Vec<HalfEdgeId>,
    /// By their vertices, the lower one first.
    pub(super) edges: Vec<EdgeId>,
}

impl Order {
    fn of(mesh: &Mesh) -> Self {
        let faces: Vec<FaceId> = mesh.faces().collect();
        let mut corners = Vec::with_capacity(2 * mesh.n_edges());
        for &f in &faces {
            let begin = corners.len();
            corners.extend(mesh.face_half_edges(f));
            let own = &mut corners[begin..];
            let lowest = (0..own.len()).min_by_key(|&i| mesh.origin(own[i]));
            own.rotate_left(lowest.unwrap_or(0));
        }
        let mut edges: Vec<EdgeId> = mesh.edges().collect();
        // Several edges between the same vertices stay in the order of their numbers.
        edges.sort_by_key(|&e| pair(mesh, e));
        Self {
            vertices: mesh.vertices().collect(),
            faces,
            corners,
            edges,
        }
    }
}

fn pair(mesh: &Mesh, e: EdgeId) -> [VertexId; 2] {
    let [v, w] = mesh.edge_vertices(e);
    [v.min(w), v.max(w)]
}

fn same_connectivity(a: &Mesh, b: &Mesh, [p, q]: &[Order; 2]) -> bool {
    let mut degrees = p.faces.iter().zip(&q.faces);
    let mut corners = p.corners.iter().zip(&q.corners);
    let mut edges = p.edges.iter().zip(&q.edges);
    p.vertices == q.vertices
        && p.faces.len() == q.faces.len()
        && p.edges.len() == q.edges.len()
        && degrees.all(|(&f, &g)| a.degree(f) == b.degree(g))
        && corners.all(|(&h, &k)| a.origin(h) == b.origin(k))
        && edges.all(|(&e, &d)| pair(a, e) == pair(b, d))
}

/// Whether the meshes are the same up to the order of their elements. Of vertices at one place the first of
/// one mesh is taken for the first of the other.
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
    let is_there = |(&v, &w): (&VertexId, &VertexId)| a.position(v) == b.position(w);
    if vertices.len() != others.len() || !vertices.iter().zip(&others).all(is_there) {
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
