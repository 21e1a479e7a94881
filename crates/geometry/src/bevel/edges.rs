//! Bevels all edges of a set together, with a constant width.
//!
//! ```text
//!      |             |                |   | n |   |        An edge becomes a new face. The other edges at its ends
//!  ----v----e----    v       -->   ---s---+   i---         are cut (s). In the corner of a face between two
//!      |             |                    | e              beveled edges, the vertex moves into the face (i).
//! ```
//!
//! If at least three new vertices replace a vertex, these new vertices become the corners of a new face. The new mesh
//! is built from a list of polygons. The values (attributes) of each new vertex or corner are interpolated between
//! corners of one old face.

use mesh::build::{NonManifold, build};
use mesh::{DVec3, EdgeId, FaceId, HalfEdgeId, Mesh, VertexId};

use super::values::{Blend, blended};

/// A lower limit for the sine of the angle between a beveled edge and an edge that the bevel cuts. The distance from
/// the end of the cut edge to the cut is the bevel width divided by this sine. A smaller sine is replaced by this
/// limit. Otherwise, an edge that is almost parallel to the beveled edge would be cut far from its end. At a corner
/// between two beveled edges, the limit applies to the sine of half the angle of the corner.
const LEAST_SINE: f64 = 0.25;

/// Why an edge cannot be beveled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum BevelRefusal {
    /// One or both sides of the edge have no face.
    Boundary,
    /// Too few other edges meet at this end of the edge: fewer than two new vertices would replace the end vertex.
    FewEdges(VertexId),
    /// An edge at one of the two ends of this edge is too short: the bevels at both ends of the short edge would
    /// overlap.
    TooWide,
    /// The mesh with all bevels would not be a manifold.
    NonManifold,
}

/// The result of [`bevel_edges`].
#[derive(Clone, Debug)]
pub struct Beveled {
    /// The mesh with bevels, which is [dense](mesh::Mesh::is_dense).
    pub mesh: Mesh,
    /// The given edges that were not beveled, in ascending order.
    pub refused: Vec<(EdgeId, BevelRefusal)>,
}

/// Replaces edges by faces of constant width.
///
/// A beveled edge is replaced by a new face between two new edges. Each new edge lies in one of the two old faces at
/// the beveled edge. Each new edge is at the distance `width`, in scene units, from the old edge. Edges that meet at a
/// vertex are beveled together, so the result does not depend on their order. If both the mesh and the set of beveled
/// edges have a symmetry, the result has this symmetry too. An edge that is not beveled is shortened if it ends at a
/// vertex of a beveled edge. A shortened edge that shares a face corner with a beveled edge is cut at the point whose
/// distance from the beveled edge is `width`. Any other edge at an end of a beveled edge is cut at the distance `width`
/// from that end. A cut is at most four times the width away from the removed end of the edge. The bevel is therefore
/// narrower next to an edge that forms a small angle with the beveled edge.
///
/// The vertices at the ends of beveled edges are removed. In the result, the remaining vertices come first, in their
/// old order, followed by the new vertices. Faces keep their ids. The faces that replace edges come after the old
/// faces, in the order of the edges. The faces that replace vertices come last, in the order of the vertices. All edges
/// get new ids; edges that remain keep their values.
///
/// Values of new vertices and corners are interpolated in the old faces, at the positions of the new vertices. Values
/// that cannot be averaged are copied from one corner. The face that replaces an edge has the values of the face of the
/// edge's first half-edge. The face that replaces a vertex has the values of one of the faces around the vertex.
///
/// Edges that cannot be beveled remain edges, and are listed in [`Beveled::refused`]. If the bevels at the two ends of
/// an edge would overlap, none of the edges at these two ends is beveled. If the result would not be a manifold, no
/// edge is beveled.
///
/// # Panics
///
/// Panics if the mesh is not dense, or an edge does not exist.
pub fn bevel_edges(mesh: &Mesh, edges: &[EdgeId], width: f64) -> Beveled {
    assert!(mesh.is_dense(), "the mesh must be dense");
    let mut refused = Vec::new();
    let mut chosen = vec![false; mesh.n_edges()];
    for &e in edges {
        if mesh.edge_faces(e).contains(&None) {
            refused.push((e, BevelRefusal::Boundary));
        } else {
            chosen[e.index()] = true;
        }
    }
    let beveled = loop {
        let bevel = Bevel::new(mesh, &chosen, width);
        let blocked = bevel.blocked();
        if blocked.is_empty() {
            if let Some(mesh) = bevel.build() {
                break mesh;
            }
            let all = mesh.edges().filter(|e| chosen[e.index()]);
            refused.extend(all.map(|e| (e, BevelRefusal::NonManifold)));
            break mesh.clone();
        }
        for &(e, _) in &blocked {
            chosen[e.index()] = false;
        }
        refused.extend(blocked);
    };
    refused.sort_unstable();
    refused.dedup_by_key(|(e, _)| *e);
    Beveled {
        mesh: beveled,
        refused,
    }
}

/// Returns the length of the shortest edge among the given edges and all edges that share a vertex with them. Returns
/// infinity if `edges` is empty.
pub fn shortest_edge_at(mesh: &Mesh, edges: &[EdgeId]) -> f64 {
    let ends = edges.iter().flat_map(|&e| mesh.edge_vertices(e));
    let around = ends.flat_map(|v| mesh.vertex_half_edges(v));
    around.map(|h| mesh.length(h)).fold(f64::INFINITY, f64::min)
}

/// A corner of a new polygon.
#[derive(Clone, Copy)]
struct Corner {
    vertex: u32,
    /// The old corners and their weights: each value of this corner is the weighted mean of the values of the old
    /// corners. All of these old corners belong to one face.
    values: Blend<HalfEdgeId>,
}

/// A new vertex near the origin of a half-edge. The new vertex is either on the half-edge, or inside the face of the
/// half-edge, at a corner between two beveled edges.
#[derive(Clone, Copy)]
struct Point {
    position: DVec3,
    /// The weight of the corner at the target of the half-edge. The values of the new vertex are a weighted mean of the
    /// values at three corners of the face.
    along: f64,
    /// The weight of the corner at the origin of the previous half-edge of the face. The three weights add up to 1; the
    /// third is the weight of the corner at the origin of the half-edge.
    before: f64,
}

struct Bevel<'m> {
    mesh: &'m Mesh,
    chosen: &'m [bool],
    width: f64,
    area_vectors: Vec<DVec3>,
    /// For each old vertex, its index in the new mesh; `None` if the vertex is removed.
    kept: Vec<Option<u32>>,
    n_kept: usize,
    /// For each half-edge, the new vertex near its origin.
    points: Vec<Option<Point>>,
    /// For each half-edge, the index of the new vertex near its origin; `u32::MAX` if there is none.
    numbers: Vec<u32>,
}

impl<'m> Bevel<'m> {
    fn new(mesh: &'m Mesh, chosen: &'m [bool], width: f64) -> Self {
        let mut this = Self {
            mesh,
            chosen,
            width,
            area_vectors: mesh.area_vectors(),
            kept: vec![None; mesh.n_vertices()],
            n_kept: 0,
            points: vec![None; mesh.n_half_edges()],
            numbers: vec![u32::MAX; mesh.n_half_edges()],
        };
        for v in mesh.vertices() {
            let around = || mesh.vertex_half_edges(v);
            if around().any(|h| this.is_chosen(h)) {
                for h in around() {
                    this.points[h.index()] = if this.is_chosen(h) {
                        this.inset(h)
                    } else {
                        Some(this.slide(h))
                    };
                }
            } else {
                this.kept[v.index()] = Some(number(this.n_kept));
                this.n_kept += 1;
            }
        }
        let mut next = this.n_kept;
        for (point, slot) in this.points.iter().zip(&mut this.numbers) {
            if point.is_some() {
                *slot = number(next);
                next += 1;
            }
        }
        this
    }

    fn is_chosen(&self, h: HalfEdgeId) -> bool {
        self.chosen[h.edge().index()]
    }

    fn direction(&self, h: HalfEdgeId) -> DVec3 {
        self.mesh.position(self.mesh.target(h)) - self.mesh.position(self.mesh.origin(h))
    }

    /// Returns the half-edge that comes after `h` counter-clockwise around the origin of `h`. Returns `None` if there
    /// is no face between the two half-edges.
    fn left(&self, h: HalfEdgeId) -> Option<HalfEdgeId> {
        self.mesh.face(h).map(|_| self.mesh.prev(h).twin())
    }

    /// Returns the half-edge that comes before `h` counter-clockwise around the origin of `h`. Returns `None` if there
    /// is no face between the two half-edges.
    fn right(&self, h: HalfEdgeId) -> Option<HalfEdgeId> {
        self.mesh.face(h.twin()).map(|_| self.mesh.next(h.twin()))
    }

    /// Returns the point at which an edge that is not beveled is cut.
    fn slide(&self, h: HalfEdgeId) -> Point {
        let along = self.direction(h);
        let length = along.length();
        let beside = [self.left(h), self.right(h)].into_iter().flatten();
        let beside = beside.filter(|&g| self.is_chosen(g));
        let cuts = beside.map(|g| {
            let other = self.direction(g);
            let sine = along.cross(other).length() / (length * other.length());
            self.width / sine.max(LEAST_SINE)
        });
        let t = cuts.fold(self.width, f64::max) / length;
        Point {
            position: self.mesh.position(self.mesh.origin(h)) + t * along,
            along: t,
            before: 0.0,
        }
    }

    /// Returns the new vertex inside the face of a beveled half-edge `h`, near the origin of `h`. Returns `None` if the
    /// other edge at this corner of the face is not beveled, or if `h` has no face. The distance of the new vertex from
    /// both edges is the width, or less if the angle of the corner is small.
    fn inset(&self, h: HalfEdgeId) -> Option<Point> {
        let g = self.left(h).filter(|&g| self.is_chosen(g))?;
        let [a, b] = [h, g].map(|h| self.direction(h));
        let lengths = [a.length(), b.length()];
        let [a, b] = [a / lengths[0], b / lengths[1]];
        let normal = self.area_vectors[self.mesh.face(h)?.index()];
        let cross = a.cross(b);
        let is_reflex = cross.dot(normal) < 0.0;
        // The sine and the cosine of half the angle from a to b, measured through the face.
        let cosine = a.dot(b).clamp(-1.0, 1.0);
        let half_sine = (0.5 - 0.5 * cosine).sqrt();
        let half_cosine = (0.5 + 0.5 * cosine).sqrt();
        let half_cosine = if is_reflex { -half_cosine } else { half_cosine };
        // The normal of the plane of both edges, or the normal of the face if both edges are on one line.
        let normal = if cross.length() > 1e-6 {
            if is_reflex { -cross } else { cross }
        } else {
            normal
        };
        let inwards = normal.normalize_or_zero().cross(a);
        let distance = self.width / half_sine.max(LEAST_SINE);
        let offset = distance * (half_cosine * a + half_sine * inwards);
        let sine = 2.0 * half_sine * half_cosine;
        let weight = |length: f64| {
            let weight = self.width / (sine * length);
            // Each of the two edges at the corner has a weight. If both edges are almost on one line, or if one of them
            // is too short, the absolute value of a weight can be 1 or more. Such a weight is replaced by 0. If the
            // weights of both edges are 0, the point gets the values of the old vertex.
            if weight.abs() < 1.0 { weight } else { 0.0 }
        };
        Some(Point {
            position: self.mesh.position(self.mesh.origin(h)) + offset,
            along: weight(lengths[0]),
            before: weight(lengths[1]),
        })
    }

    /// Returns the corners that replace the corner of `h`. The half-edge `h` must have a face.
    fn corners(&self, h: HalfEdgeId) -> Vec<Corner> {
        let mesh = self.mesh;
        if let Some(vertex) = self.kept[mesh.origin(h).index()] {
            let values = [(h, 1.0), (h, 0.0), (h, 0.0)];
            return vec![Corner { vertex, values }];
        }
        let before = mesh.prev(h);
        let mut corners = Vec::with_capacity(2);
        if let Some(point) = self.points[before.twin().index()].filter(|_| !self.is_chosen(before))
        {
            let t = point.along;
            corners.push(Corner {
                vertex: self.numbers[before.twin().index()],
                values: [(h, 1.0 - t), (before, t), (h, 0.0)],
            });
        }
        if let Some(point) = self.points[h.index()] {
            let Point {
                along, before: b, ..
            } = point;
            corners.push(Corner {
                vertex: self.numbers[h.index()],
                values: [(h, 1.0 - along - b), (mesh.next(h), along), (before, b)],
            });
        }
        corners
    }

    /// Returns the corners of the new polygon of an old face. For each side of the polygon, also returns the old edge
    /// that the side comes from, or [`EdgeId::NONE`].
    fn face(&self, f: FaceId) -> (Vec<Corner>, Vec<EdgeId>) {
        let (mut corners, mut sides) = (Vec::new(), Vec::new());
        for h in self.mesh.face_half_edges(f) {
            let new = self.corners(h);
            sides.resize(sides.len() + new.len() - 1, EdgeId::NONE);
            sides.push(if self.is_chosen(h) {
                EdgeId::NONE
            } else {
                h.edge()
            });
            corners.extend(new);
        }
        (corners, sides)
    }

    /// Returns the polygon that replaces a beveled edge.
    ///
    /// ```text
    ///        face of h
    ///     0 ----------- 3
    ///     a ---- h ---> b        at a seam, all corners have values of the face of h
    ///     1 ----------- 2
    /// ```
    fn strip(&self, e: EdgeId) -> Vec<Corner> {
        let [h, t] = e.half_edges();
        let mesh = self.mesh;
        let first = |h| self.corners(h)[0];
        let last = |h| *self.corners(h).last().expect("a corner becomes one or two");
        let mut strip = [last(h), first(mesh.next(t)), last(t), first(mesh.next(h))];
        if mesh.is_seam(e) {
            strip[1].values = [(h, 1.0), (h, 0.0), (h, 0.0)];
            strip[2].values = strip[1].values.map(|(_, weight)| (mesh.next(h), weight));
        }
        strip.to_vec()
    }

    /// Returns the corners, in counter-clockwise order, of the polygon that replaces a vertex. If there are fewer than
    /// three corners, no face replaces the vertex. Also returns an old face at the vertex, whose values the new face
    /// copies.
    fn cap(&self, v: VertexId) -> (Vec<Corner>, Option<FaceId>) {
        let mesh = self.mesh;
        let mut around: Vec<HalfEdgeId> = mesh.vertex_half_edges(v).collect();
        around.reverse();
        let has_seam = around.iter().any(|h| mesh.is_seam(h.edge()));
        let mut cap: Vec<Corner> = Vec::new();
        let points = around.iter().filter(|h| self.points[h.index()].is_some());
        for &h in points {
            let vertex = self.numbers[h.index()];
            // Uses the corner in the face to the left of h. If there is no face to the left, uses the corner in the
            // face to the right.
            let corners = match (mesh.face(h), self.right(h)) {
                (Some(_), _) => self.corners(h),
                (None, Some(right)) => self.corners(right),
                (None, None) => continue,
            };
            cap.extend(corners.into_iter().find(|corner| corner.vertex == vertex));
        }
        if has_seam && let Some(&first) = cap.first() {
            for corner in &mut cap {
                corner.values = first.values;
            }
        }
        (cap, around.iter().find_map(|&h| mesh.face(h)))
    }

    fn is_removed(&self, v: VertexId) -> bool {
        self.kept[v.index()].is_none()
    }

    /// Returns the edges in `chosen` that cannot be beveled, each with the reason.
    fn blocked(&self) -> Vec<(EdgeId, BevelRefusal)> {
        let mut blocked = Vec::new();
        let mut block = |v: VertexId, refusal| {
            let around = self
                .mesh
                .vertex_half_edges(v)
                .filter(|&h| self.is_chosen(h));
            blocked.extend(around.map(|h| (h.edge(), refusal)));
        };
        for v in self.mesh.vertices().filter(|&v| self.is_removed(v)) {
            let mut around = self.mesh.vertex_half_edges(v);
            if around
                .by_ref()
                .filter(|h| self.points[h.index()].is_some())
                .count()
                < 2
            {
                block(v, BevelRefusal::FewEdges(v));
            }
        }
        for h in self
            .mesh
            .half_edges()
            .filter(|&h| self.mesh.face(h).is_some())
        {
            let ends = [self.mesh.origin(h), self.mesh.target(h)];
            if ends.iter().all(|&v| !self.is_removed(v)) {
                continue;
            }
            let [from, to] = self.side(h);
            let is_kept = (to - from).dot(self.direction(h)) > 0.0;
            if !is_kept || !from.is_finite() || !to.is_finite() {
                for v in ends {
                    block(v, BevelRefusal::TooWide);
                }
            }
        }
        blocked.sort_unstable();
        blocked.dedup_by_key(|(e, _)| *e);
        blocked
    }

    /// Returns the positions of the two ends of the side that replaces `h` in the new polygon. The half-edge `h` must
    /// have a face.
    fn side(&self, h: HalfEdgeId) -> [DVec3; 2] {
        let point = |h: HalfEdgeId| self.points[h.index()].map(|point| point.position);
        let from = point(h).or_else(|| point(self.mesh.prev(h).twin()));
        let next = self.mesh.next(h);
        let to = if self.is_chosen(h) {
            point(next)
        } else {
            point(h.twin())
        };
        let old = |v| self.mesh.position(v);
        [
            from.unwrap_or_else(|| old(self.mesh.origin(h))),
            to.unwrap_or_else(|| old(self.mesh.target(h))),
        ]
    }

    /// Builds the new mesh. Returns `None` if the new mesh would not be a manifold.
    fn build(&self) -> Option<Mesh> {
        let mesh = self.mesh;
        let mut faces: Vec<FaceId> = Vec::new();
        let (mut offsets, mut corners, mut sides) = (vec![0], Vec::new(), Vec::new());
        let mut push = |polygon: Vec<Corner>, of: FaceId, edges: Vec<EdgeId>| {
            corners.extend(polygon);
            sides.extend(edges);
            sides.resize(corners.len(), EdgeId::NONE);
            offsets.push(number(corners.len()));
            faces.push(of);
        };
        for f in mesh.faces() {
            let (polygon, edges) = self.face(f);
            push(polygon, f, edges);
        }
        for e in mesh.edges().filter(|e| self.chosen[e.index()]) {
            let f = mesh.face(e.half_edges()[0])?;
            push(self.strip(e), f, Vec::new());
        }
        for v in mesh.vertices().filter(|&v| self.is_removed(v)) {
            if let (polygon, Some(f)) = self.cap(v)
                && polygon.len() > 2
            {
                push(polygon, f, Vec::new());
            }
        }

        let kept = mesh.vertices().filter(|&v| !self.is_removed(v));
        let mut positions: Vec<DVec3> = kept.clone().map(|v| mesh.position(v)).collect();
        positions.extend(self.points.iter().flatten().map(|point| point.position));
        let numbers: Vec<u32> = corners.iter().map(|corner| corner.vertex).collect();
        let built = build(positions, &offsets, &numbers, NonManifold::RefuseAsGiven).ok()?;

        let mut vertices: Vec<Blend<VertexId>> =
            kept.map(|v| [(v, 1.0), (v, 0.0), (v, 0.0)]).collect();
        for h in mesh.half_edges() {
            if let Some(Point { along, before, .. }) = self.points[h.index()] {
                let v = mesh.origin(h);
                let w = if before == 0.0 {
                    v
                } else {
                    mesh.origin(mesh.prev(h))
                };
                vertices.push([
                    (v, 1.0 - along - before),
                    (mesh.target(h), along),
                    (w, before),
                ]);
            }
        }
        let mut of_half_edge = vec![None; built.mesh.n_half_edges()];
        for (h, corner) in built.half_edge_of_corner.iter().zip(&corners) {
            of_half_edge[h.index()] = Some(corner.values);
        }
        let mut of_edge = vec![EdgeId::NONE; built.mesh.n_edges()];
        for (e, &side) in built.edges_of_sides(&offsets).iter().zip(&sides) {
            if side != EdgeId::NONE {
                of_edge[e.index()] = side;
            }
        }
        let mut attributes = blended(
            mesh.attributes(),
            &vertices,
            &of_half_edge,
            &of_edge,
            &faces,
        );
        attributes.drop_by_rule();
        let mut result = built.mesh;
        result.set_attributes(attributes);
        Some(result)
    }
}

/// Converts the index of a vertex or a corner to 32 bits.
fn number(i: usize) -> u32 {
    u32::try_from(i).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests;
