//! Builds the tree of boxes of a surface index.

use std::cell::Cell;

use mesh::{DVec3, FaceId, HalfEdgeId, Mesh, parallel};
use progress::{Cancelled, Progress};

use super::oriented::{are_thin, longest_side, sum};
use super::{Node, Oriented, Origin, Slab, SurfaceIndex, Triangle};
use crate::triangulate::Cutter;

/// The maximum number of triangles in a leaf of the tree.
const LEAF: usize = 4;

/// A subtree with at most this number of triangles is built by one thread.
const TASK: usize = 4096;

/// The text that progress reports show while the index is built.
const WHAT: &str = "build the spatial index";

/// The center of a triangle, and the index of the triangle in the order of the faces.
type Key = (DVec3, u32);

/// A flat convex face with at least this number of corners is repeatedly cut in half.
const MANY_CORNERS: usize = 64;

/// The number of triangles that are copied between two progress reports.
const PART: usize = 1 << 18;

/// The number of triangles that are made from faces between two progress reports.
const REPORT: usize = 16_384;

/// Appends the triangles of a face. A face with at most four corners is divided into a fan of triangles. A face with
/// more than four corners is triangulated by `cutter`, because the triangles of a fan could lie on top of each other. A
/// point near a face would then be near all triangles of its fan, and searches would be slow. A flat convex face with
/// at least 64 corners is an exception: it is repeatedly cut in half. If the corners of a flat convex face lie on a
/// circle, for example, `cutter` would make long and thin triangles. A point would then be inside the bounding boxes of
/// many of these triangles, and searches would be slow.
///
/// # Errors
///
/// Returns an error if `ask` returns an error. For a face with many corners, `ask` is called many times.
pub(crate) fn triangulate(
    mesh: &Mesh,
    face: FaceId,
    cutter: &mut Cutter,
    triangles: &mut Vec<Triangle>,
    ask: &dyn Fn() -> Result<(), Cancelled>,
) -> Result<(), Cancelled> {
    let triangle = |corners: [HalfEdgeId; 3]| {
        let vertices = corners.map(|h| mesh.origin(h));
        Triangle {
            positions: vertices.map(|v| mesh.position(v)),
            vertices,
            corners,
            face,
        }
    };
    let mut corners = mesh.face_half_edges(face);
    if corners.clone().nth(4).is_some() {
        let corners: Vec<HalfEdgeId> = corners.collect();
        if corners.len() >= MANY_CORNERS {
            ask()?;
            if cutter.is_flat_and_convex(mesh, face) {
                return halve(&corners, &mut |corners| {
                    triangles.push(triangle(corners));
                    if triangles.len().is_multiple_of(REPORT) {
                        ask()?;
                    }
                    Ok(())
                });
            }
        }
        let is_cancelled = Cell::new(false);
        let stops = || {
            is_cancelled.set(is_cancelled.get() || ask().is_err());
            is_cancelled.get()
        };
        let cut = cutter.cut_unless(&stops, mesh, face);
        if is_cancelled.get() {
            return Err(Cancelled);
        }
        for cut in cut.triangles().chunks(REPORT) {
            triangles.extend(cut.iter().map(|t| triangle(t.map(|i| corners[i as usize]))));
            if cut.len() == REPORT {
                ask()?;
            }
        }
    } else if let (Some(first), Some(mut last)) = (corners.next(), corners.next()) {
        triangles.extend(corners.map(|h| triangle([first, std::mem::replace(&mut last, h), h])));
    }
    Ok(())
}

/// Divides a polygon into triangles, and calls `triangle` with the corners of each of them. The first triangle
/// separates the polygon into two halves. Each half is then divided in the same way.
fn halve(
    corners: &[HalfEdgeId],
    triangle: &mut impl FnMut([HalfEdgeId; 3]) -> Result<(), Cancelled>,
) -> Result<(), Cancelled> {
    let [first, .., last] = *corners else {
        return Ok(());
    };
    let middle = corners.len() / 2;
    if corners.len() > 2 {
        triangle([first, corners[middle], last])?;
        halve(&corners[..=middle], triangle)?;
        halve(&corners[middle..], triangle)?;
    }
    Ok(())
}

impl SurfaceIndex {
    pub(super) fn build(
        mesh: &Mesh,
        faces: impl Iterator<Item = FaceId>,
        progress: &dyn Progress,
    ) -> Result<Option<Self>, Cancelled> {
        progress.report(WHAT, 0, 2)?;
        let (mut cutter, mut triangles) = (Cutter::default(), Vec::new());
        let mut next_report = 0;
        for f in faces {
            if triangles.len() >= next_report {
                progress.report(WHAT, 0, 2)?;
                next_report = triangles.len() + REPORT;
            }
            let ask = || progress.report(WHAT, 0, 2);
            triangulate(mesh, f, &mut cutter, &mut triangles, &ask)?;
        }
        if triangles.is_empty() {
            return Ok(None);
        }
        progress.report(WHAT, 1, 2)?;
        let center =
            |t: &Triangle| t.positions[0] / 3.0 + t.positions[1] / 3.0 + t.positions[2] / 3.0;
        let ask = || progress.report(WHAT, 1, 2);
        let mut keys: Vec<Key> = (0..).zip(&triangles).map(|(i, t)| (center(t), i)).collect();
        ask()?;
        let mut nodes = vec![Node::EMPTY; n_nodes(keys.len())];
        ask()?;
        let mut slabs = vec![Slab::EVERYTHING; nodes.len()];
        ask()?;
        let thin = are_thin(triangles.len(), triangles.iter().map(|t| &t.positions));
        ask()?;
        let n_oriented = if thin { nodes.len() } else { 0 };
        let mut oriented = vec![Oriented::EVERYTHING; n_oriented];
        ask()?;
        Subtree {
            keys: &mut keys,
            nodes: &mut nodes,
            slabs: &mut slabs,
            oriented: &mut oriented,
            first: 0,
            node: 0,
        }
        .build(&triangles, &ask)?;
        let sorted = |i: usize| &triangles[keys[i].1 as usize];
        Ok(Some(Self {
            nodes,
            slabs,
            oriented,
            positions: collect(keys.len(), |i| sorted(i).positions, &ask)?,
            origins: collect(keys.len(), |i| Origin::of(sorted(i)), &ask)?,
        }))
    }
}

/// A subtree that has not been built yet, and the lists into which its nodes are written.
struct Subtree<'a> {
    keys: &'a mut [Key],
    nodes: &'a mut [Node],
    slabs: &'a mut [Slab],
    /// The oriented boxes of the nodes. The list is empty if the nodes have no oriented boxes.
    oriented: &'a mut [Oriented],
    /// The position of the first key in the list of all keys.
    first: usize,
    /// The position of the first node in the list of all nodes.
    node: usize,
}

impl Subtree<'_> {
    /// Builds the nodes of the subtree. Returns two sums over its triangles. The first sum adds up the unit normals of
    /// the triangles, each multiplied by twice the area of its triangle. The second sum adds up the longest sides of
    /// the triangles as vectors. The function [`sum`] reverses some of these vectors, so that opposite vectors do not
    /// cancel.
    fn build(
        self,
        triangles: &[Triangle],
        ask: &(dyn Fn() -> Result<(), Cancelled> + Sync),
    ) -> Result<[DVec3; 2], Cancelled> {
        let n = self.keys.len();
        let ([root, nodes @ ..], [slab, slabs @ ..]) = (self.nodes, self.slabs) else {
            unreachable!("a subtree has a root");
        };
        let (mut own, oriented) = match self.oriented {
            [own, others @ ..] => (Some(own), others),
            none => (None, none),
        };
        root.first = number(self.first);
        root.last = number(self.first + n);
        if n <= LEAF {
            let triangles = self
                .keys
                .iter()
                .map(|&(_, i)| &triangles[i as usize].positions);
            (root.min, root.max) = bounds(triangles.clone().flatten().copied());
            let normal = triangles
                .clone()
                .map(|[a, b, c]| (b - a).cross(c - a))
                .sum();
            let sides = triangles.clone().map(longest_side);
            let along = sides.fold(DVec3::ZERO, sum);
            if let Some(own) = &mut own {
                **own = Oriented::of(triangles.clone(), n, normal, along);
            }
            *slab = Slab::of(triangles, n, normal);
            return Ok([normal, along]);
        }
        let (min, max) = bounds(self.keys.iter().map(|key| key.0));
        let axis = (max - min).max_position();
        let middle = n / 2;
        if n > TASK {
            ask()?;
        }
        // Triangles whose centers have the same coordinate along the axis are ordered by their indices. Therefore no
        // two keys are equal, and the two halves do not depend on the order in which the keys were given.
        self.keys.select_nth_unstable_by(middle, |a, b| {
            a.0[axis].total_cmp(&b.0[axis]).then(a.1.cmp(&b.1))
        });
        let (low, high) = self.keys.split_at_mut(middle);
        let right = n_nodes(middle);
        root.right = number(self.node + 1 + right);
        let (left_nodes, right_nodes) = nodes.split_at_mut(right);
        let (left_slabs, right_slabs) = slabs.split_at_mut(right);
        let (left_oriented, right_oriented) = oriented.split_at_mut(right.min(oriented.len()));
        let left = Subtree {
            keys: low,
            nodes: &mut *left_nodes,
            slabs: left_slabs,
            oriented: left_oriented,
            first: self.first,
            node: self.node + 1,
        };
        let right = Subtree {
            keys: high,
            nodes: &mut *right_nodes,
            slabs: right_slabs,
            oriented: right_oriented,
            first: self.first + middle,
            node: self.node + 1 + right,
        };
        let (left, right) = if n > TASK {
            ask()?;
            rayon::join(
                || left.build(triangles, ask),
                || right.build(triangles, ask),
            )
        } else {
            (left.build(triangles, ask), right.build(triangles, ask))
        };
        let ([left, left_along], [right, right_along]) = (left?, right?);
        let (normal, along) = (left + right, sum(left_along, right_along));
        root.min = left_nodes[0].min.min(right_nodes[0].min);
        root.max = left_nodes[0].max.max(right_nodes[0].max);
        let keys = self.keys.iter();
        let triangles = keys.map(|&(_, i)| &triangles[i as usize].positions);
        if let Some(own) = &mut own {
            **own = Oriented::of(triangles.clone(), n, normal, along);
        }
        *slab = Slab::of(triangles, n, normal);
        Ok([normal, along])
    }
}

/// Computes the list of the values `value(0)` to `value(n - 1)`, in parallel. Stops with an error if `ask` returns an
/// error.
fn collect<T: Send>(
    n: usize,
    value: impl Fn(usize) -> T + Sync,
    ask: &(dyn Fn() -> Result<(), Cancelled> + Sync),
) -> Result<Vec<T>, Cancelled> {
    let mut values = Vec::with_capacity(n);
    for first in (0..n).step_by(PART) {
        ask()?;
        let part = parallel::collect(PART.min(n - first), |i| value(first + i));
        values.extend(part);
    }
    Ok(values)
}

/// Returns the number of nodes of a tree over `n` triangles.
fn n_nodes(n: usize) -> usize {
    /// Returns the number of nodes of a tree over `n` triangles, and the number of nodes of a tree over `n + 1`
    /// triangles.
    fn both(n: usize) -> (usize, usize) {
        if n < LEAF {
            return (1, 1);
        }
        let (low, high) = both(n / 2);
        if n == LEAF {
            (1, 1 + low + high)
        } else if n.is_multiple_of(2) {
            (1 + 2 * low, 1 + low + high)
        } else {
            (1 + low + high, 1 + 2 * high)
        }
    }
    both(n).0
}

fn bounds(points: impl Iterator<Item = DVec3>) -> (DVec3, DVec3) {
    points.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(min, max), p| {
        (min.min(p), max.max(p))
    })
}

impl Node {
    const EMPTY: Self = Self {
        min: DVec3::INFINITY,
        max: DVec3::NEG_INFINITY,
        first: 0,
        last: 0,
        right: 0,
    };
}

impl Origin {
    fn of(triangle: &Triangle) -> Self {
        Self {
            vertices: triangle.vertices,
            corners: triangle.corners,
            face: triangle.face,
        }
    }
}

/// Converts an array index to 32 bits. A mesh has fewer than 2³² half-edges, and fewer triangles than half-edges.
fn number(i: usize) -> u32 {
    u32::try_from(i).expect("fewer than 2^32 triangles")
}
