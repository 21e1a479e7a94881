//! Building a mesh from polygons: without a hash map, the same for any number of threads.
//!
//! A corner c of a polygon stands for the directed side from its vertex a to the next vertex b. Its
//! twin is the corner of a side from b to a. Corners are bucketed by their vertex, so the twin of c
//! is found in the bucket of b. Edges are numbered in the order in which the polygons first name
//! them, and the first half of an edge lies on the polygon that named it.
//!
//! What is not a manifold is split until it is, and everything that was done is listed in a
//! [`BuildReport`]:
//!
//! - Of more than two sides between the same two vertices, or two that run the same way, the k-th
//!   from a to b is paired with the k-th from b to a, in order of corners; the rest are boundary.
//! - Where the faces around a vertex form several fans that share no edge, the fan of the first
//!   corner keeps the vertex and each other fan gets a copy of it, behind all others.
//! - A polygon with fewer than three corners, or that visits a vertex twice, is left out.

use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use glam::DVec3;
use rayon::prelude::*;

use crate::blocks::BLOCK;
use crate::{Connectivity, FaceId, HalfEdgeId, Mesh, VertexId};

const NONE: u32 = u32::MAX;

/// Why polygons could not become a mesh.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BuildError {
    /// A polygon names a vertex that does not exist.
    #[error("face {face} refers to vertex {vertex}, but there are {n_vertices} vertices")]
    NoSuchVertex {
        /// The polygon, from 0.
        face: usize,
        /// What it names.
        vertex: u32,
        /// How many positions were given.
        n_vertices: usize,
    },
    /// A position is infinite or not a number.
    #[error("the position of vertex {0} is not finite")]
    NotFinite(usize),
    /// The ids would not fit.
    #[error("{0} {1} are more than a mesh can hold")]
    TooLarge(usize, &'static str),
    /// The offsets do not divide the corners into polygons.
    #[error("the offsets of the faces must rise from 0 to the number of corners, {0}")]
    BadOffsets(usize),
    /// The polygons are not a manifold, and [`NonManifold::Refuse`] was asked for.
    #[error("the faces are not a manifold: {0}")]
    NonManifold(String),
}

/// What to do where polygons do not form a manifold.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum NonManifold {
    /// Split edges and vertices until they do, and report it.
    #[default]
    Split,
    /// Return [`BuildError::NonManifold`].
    Refuse,
}

/// What was done to make polygons a manifold. Empty lists: nothing.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct BuildReport {
    /// Pairs of vertices, lower first, with more than two sides between them or with two sides that
    /// run the same way.
    pub split_edges: Vec<[VertexId; 2]>,
    /// Vertices that joined several fans, each with the copy that one of the fans got.
    pub split_vertices: Vec<(VertexId, VertexId)>,
    /// Polygons that were left out, by their place in the input.
    pub dropped_faces: Vec<usize>,
}

impl BuildReport {
    /// Whether nothing had to be done.
    pub fn is_clean(&self) -> bool {
        self.split_edges.is_empty()
            && self.split_vertices.is_empty()
            && self.dropped_faces.is_empty()
    }

    /// What was done, in one line, naming the first element of each kind.
    pub fn summary(&self) -> String {
        let mut parts = Vec::new();
        if let Some([v, w]) = self.split_edges.first() {
            let n = self.split_edges.len();
            parts.push(format!("{n} non-manifold edges split (first {v}-{w})"));
        }
        if let Some((v, _)) = self.split_vertices.first() {
            let n = self.split_vertices.len();
            parts.push(format!(
                "{n} copies made of non-manifold vertices (first {v})"
            ));
        }
        if let Some(f) = self.dropped_faces.first() {
            let n = self.dropped_faces.len();
            parts.push(format!("{n} degenerate faces left out (first: face {f})"));
        }
        parts.join(", ")
    }
}

/// A mesh built from polygons, and where each corner and polygon went.
#[derive(Clone, Debug)]
pub struct Built {
    /// The mesh.
    pub mesh: Mesh,
    /// What was done to make it a manifold.
    pub report: BuildReport,
    /// For each corner of the input its half-edge; `NONE` if its polygon was left out.
    pub half_edge_of_corner: Vec<HalfEdgeId>,
    /// For each polygon of the input its face; `NONE` if it was left out.
    pub face_of_polygon: Vec<FaceId>,
}

impl Mesh {
    /// A mesh of polygons given as lists of vertex indices, counter-clockwise.
    ///
    /// Polygon i becomes face i unless a degenerate one before it was left out. For input that is not
    /// a manifold see the [module](mod@crate::build).
    ///
    /// # Errors
    ///
    /// [`BuildError`] for an index out of range, a position that is not finite, too many elements.
    ///
    /// # Examples
    ///
    /// ```
    /// use mesh::{DVec3, Mesh};
    ///
    /// let (mesh, report) = Mesh::from_polygons(
    ///     vec![DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y],
    ///     &[vec![0, 1, 2], vec![0, 2, 3]],
    /// )?;
    /// assert_eq!((mesh.n_vertices(), mesh.n_edges(), mesh.n_faces()), (4, 5, 2));
    /// assert!(report.is_clean());
    /// # Ok::<(), mesh::BuildError>(())
    /// ```
    pub fn from_polygons(
        positions: Vec<DVec3>,
        polygons: &[impl AsRef<[u32]>],
    ) -> Result<(Self, BuildReport), BuildError> {
        let mut offsets = vec![0];
        let mut corners = Vec::new();
        for polygon in polygons {
            corners.extend_from_slice(polygon.as_ref());
            offsets.push(to_u32(corners.len(), "corners")?);
        }
        let built = build(positions, &offsets, &corners, NonManifold::Split)?;
        Ok((built.mesh, built.report))
    }
}

/// Builds a mesh from polygons: polygon i has the corners `corners[offsets[i]..offsets[i + 1]]`,
/// indices of `positions`, counter-clockwise.
///
/// # Errors
///
/// As [`Mesh::from_polygons`], and [`BuildError::NonManifold`] if that is asked for.
pub fn build(
    positions: Vec<DVec3>,
    offsets: &[u32],
    corners: &[u32],
    non_manifold: NonManifold,
) -> Result<Built, BuildError> {
    let degenerate = check(&positions, offsets, corners)?;
    if degenerate.is_empty() {
        return build_clean(positions, offsets, corners, non_manifold);
    }
    if non_manifold == NonManifold::Refuse {
        return Err(BuildError::NonManifold(format!(
            "face {} is degenerate",
            degenerate[0]
        )));
    }
    build_without(positions, offsets, corners, &degenerate, non_manifold)
}

/// Checks the input and returns the degenerate polygons.
fn check(positions: &[DVec3], offsets: &[u32], corners: &[u32]) -> Result<Vec<usize>, BuildError> {
    // Half-edges are numbered below 2^32 - 1, and each corner may need an edge of its own.
    to_u32(positions.len().saturating_add(corners.len()), "vertices")?;
    to_u32(corners.len().saturating_mul(2), "half-edges")?;
    let rising = offsets.first() == Some(&0)
        && offsets
            .last()
            .is_some_and(|&last| last as usize == corners.len())
        && offsets.is_sorted();
    if !rising {
        return Err(BuildError::BadOffsets(corners.len()));
    }
    if let Some(i) = positions.par_iter().position_first(|p| !p.is_finite()) {
        return Err(BuildError::NotFinite(i));
    }
    let n_vertices = positions.len();
    if let Some(c) = corners
        .par_iter()
        .position_first(|&v| v as usize >= n_vertices)
    {
        let face = offsets.partition_point(|&offset| offset as usize <= c) - 1;
        return Err(BuildError::NoSuchVertex {
            face,
            vertex: corners[c],
            n_vertices,
        });
    }
    Ok(offsets
        .par_windows(2)
        .enumerate()
        .filter(|(_, w)| visits_twice(&corners[w[0] as usize..w[1] as usize]))
        .map(|(face, _)| face)
        .collect())
}

/// Whether a polygon has fewer than three corners or two at one vertex.
fn visits_twice(polygon: &[u32]) -> bool {
    match polygon {
        [a, b, c] => a == b || b == c || c == a,
        _ if polygon.len() < 3 => true,
        _ if polygon.len() <= 16 => polygon
            .iter()
            .enumerate()
            .any(|(i, v)| polygon[..i].contains(v)),
        _ => {
            let mut sorted = polygon.to_vec();
            sorted.sort_unstable();
            sorted.windows(2).any(|w| w[0] == w[1])
        }
    }
}

/// Builds without the polygons listed in `dropped` and puts gaps into the maps of the result.
fn build_without(
    positions: Vec<DVec3>,
    offsets: &[u32],
    corners: &[u32],
    dropped: &[usize],
    non_manifold: NonManifold,
) -> Result<Built, BuildError> {
    let mut is_dropped = vec![false; offsets.len() - 1];
    for &face in dropped {
        is_dropped[face] = true;
    }
    let mut kept_offsets = vec![0];
    let mut kept_corners = Vec::with_capacity(corners.len());
    for (w, _) in offsets
        .windows(2)
        .zip(&is_dropped)
        .filter(|(_, dropped)| !**dropped)
    {
        kept_corners.extend_from_slice(&corners[w[0] as usize..w[1] as usize]);
        kept_offsets.push(to_u32(kept_corners.len(), "corners")?);
    }
    let mut built = build_clean(positions, &kept_offsets, &kept_corners, non_manifold)?;
    let mut half_edges = built.half_edge_of_corner.into_iter();
    let mut faces = built.face_of_polygon.into_iter();
    built.half_edge_of_corner = Vec::with_capacity(corners.len());
    built.face_of_polygon = Vec::with_capacity(is_dropped.len());
    for (w, &dropped) in offsets.windows(2).zip(&is_dropped) {
        let degree = (w[1] - w[0]) as usize;
        if dropped {
            built
                .half_edge_of_corner
                .extend(std::iter::repeat_n(HalfEdgeId::NONE, degree));
            built.face_of_polygon.push(FaceId::NONE);
        } else {
            built
                .half_edge_of_corner
                .extend(half_edges.by_ref().take(degree));
            built.face_of_polygon.extend(faces.next());
        }
    }
    built.report.dropped_faces = dropped.to_vec();
    Ok(built)
}

fn build_clean(
    mut positions: Vec<DVec3>,
    offsets: &[u32],
    corners: &[u32],
    non_manifold: NonManifold,
) -> Result<Built, BuildError> {
    let polygons = Polygons::new(offsets, corners);
    let buckets = Buckets::new(positions.len(), &polygons);
    let twin = pair_sides(&polygons, &buckets);

    let mut report = BuildReport {
        split_edges: split_edges(&polygons, &buckets),
        ..<_>::default()
    };
    let (vertex_corner, pinched) = fans(&polygons, &buckets, &twin);
    if non_manifold == NonManifold::Refuse {
        if let Some([v, w]) = report.split_edges.first() {
            return Err(BuildError::NonManifold(format!(
                "the edge {v}-{w} has too many faces"
            )));
        }
        if let Some(v) = pinched.first() {
            return Err(BuildError::NonManifold(format!(
                "v{v} joins faces that share no edge"
            )));
        }
    }

    let half_edge_of_corner = number_edges(&twin);
    let mut vertex_half_edge: Vec<HalfEdgeId> = vertex_corner
        .into_par_iter()
        .map(|start| start.half_edge(&polygons, &half_edge_of_corner))
        .collect();

    // Rare: vertices between several fans. The other fans move to copies.
    let mut origin = std::borrow::Cow::Borrowed(corners);
    for &v in &pinched {
        for fan in other_fans(v, &polygons, &buckets, &twin) {
            let copy = to_u32(positions.len(), "vertices")?;
            positions.push(positions[v as usize]);
            vertex_half_edge.push(fan.start.half_edge(&polygons, &half_edge_of_corner));
            for c in fan.corners {
                origin.to_mut()[c as usize] = copy;
            }
            report
                .split_vertices
                .push((VertexId::new(v as usize), VertexId::new(copy as usize)));
        }
    }

    let connectivity = Connectivity {
        face_half_edge: polygons
            .offsets
            .par_iter()
            .take(polygons.n())
            .map(|&c| half_edge_of_corner[c as usize])
            .collect(),
        vertex_half_edge,
        ..half_edge_arrays(&polygons, &origin, &twin, &half_edge_of_corner)
    };
    let face_of_polygon = (0..polygons.n()).into_par_iter().map(FaceId::new).collect();
    let mesh = Mesh::from_arrays(connectivity, positions);
    Ok(Built {
        mesh,
        report,
        half_edge_of_corner,
        face_of_polygon,
    })
}

/// The polygons, with the face of each corner where they are not all triangles.
struct Polygons<'a> {
    offsets: &'a [u32],
    corners: &'a [u32],
    face_of_corner: Option<Vec<u32>>,
}

impl<'a> Polygons<'a> {
    fn new(offsets: &'a [u32], corners: &'a [u32]) -> Self {
        let triangles = corners.len() == 3 * (offsets.len() - 1)
            && offsets.par_windows(2).all(|w| w[1] - w[0] == 3);
        let face_of_corner = (!triangles).then(|| {
            let mut faces = Vec::with_capacity(corners.len());
            for (face, w) in (0..).zip(offsets.windows(2)) {
                faces.extend(std::iter::repeat_n(face, (w[1] - w[0]) as usize));
            }
            faces
        });
        Self {
            offsets,
            corners,
            face_of_corner,
        }
    }

    fn n(&self) -> usize {
        self.offsets.len() - 1
    }

    fn face(&self, c: u32) -> u32 {
        self.face_of_corner
            .as_ref()
            .map_or(c / 3, |faces| faces[c as usize])
    }

    fn next(&self, c: u32) -> u32 {
        let f = self.face(c) as usize;
        if c + 1 == self.offsets[f + 1] {
            self.offsets[f]
        } else {
            c + 1
        }
    }

    fn prev(&self, c: u32) -> u32 {
        let f = self.face(c) as usize;
        if c == self.offsets[f] {
            self.offsets[f + 1] - 1
        } else {
            c - 1
        }
    }

    fn origin(&self, c: u32) -> u32 {
        self.corners[c as usize]
    }

    fn target(&self, c: u32) -> u32 {
        self.origin(self.next(c))
    }

    fn ids(&self) -> rayon::range::Iter<u32> {
        (0..u32::try_from(self.corners.len()).expect("checked before")).into_par_iter()
    }
}

/// A side: the vertex that it goes to and its corner.
type Side = (u32, u32);

/// The sides that leave each vertex, in order of corners.
struct Buckets {
    first: Vec<u32>,
    sides: Vec<Side>,
}

impl Buckets {
    fn new(n_vertices: usize, polygons: &Polygons) -> Self {
        let mut first = vec![0_u32; n_vertices + 1];
        for &v in polygons.corners {
            first[v as usize + 1] += 1;
        }
        for v in 0..n_vertices {
            first[v + 1] += first[v];
        }
        let mut place = first.clone();
        let mut sides: Vec<Side> = vec![(0, 0); polygons.corners.len()];
        for w in polygons.offsets.windows(2) {
            for c in w[0]..w[1] {
                let target = polygons.corners[if c + 1 == w[1] { w[0] } else { c + 1 } as usize];
                let at = &mut place[polygons.corners[c as usize] as usize];
                sides[*at as usize] = (target, c);
                *at += 1;
            }
        }
        Self { first, sides }
    }

    fn of(&self, v: u32) -> &[Side] {
        &self.sides[self.first[v as usize] as usize..self.first[v as usize + 1] as usize]
    }

    /// The corners of the sides from `v` to `w`.
    fn between(&self, v: u32, w: u32) -> impl Iterator<Item = u32> + '_ {
        self.of(v)
            .iter()
            .filter(move |side| side.0 == w)
            .map(|side| side.1)
    }
}

/// For each corner the corner of the other side of its edge, or `NONE`.
fn pair_sides(polygons: &Polygons, buckets: &Buckets) -> Vec<u32> {
    polygons
        .ids()
        .with_min_len(BLOCK)
        .map(|c| {
            let (a, b) = (polygons.origin(c), polygons.target(c));
            let mut back = buckets.between(b, a);
            let first = back.next();
            let second = back.next();
            let rank = buckets
                .between(a, b)
                .position(|side| side == c)
                .unwrap_or(0);
            match rank {
                0 => first,
                1 => second,
                _ => buckets.between(b, a).nth(rank),
            }
            .unwrap_or(NONE)
        })
        .collect()
}

/// The edges with more than two sides, or with two that run the same way, in order of vertices.
fn split_edges(polygons: &Polygons, buckets: &Buckets) -> Vec<[VertexId; 2]> {
    let mut edges: Vec<[VertexId; 2]> = polygons
        .ids()
        .with_min_len(BLOCK)
        .filter_map(|c| {
            let (a, b) = (polygons.origin(c), polygons.target(c));
            let same_way = buckets.between(a, b).nth(1).is_some();
            same_way.then(|| [a.min(b), a.max(b)].map(|v| VertexId::new(v as usize)))
        })
        .collect();
    edges.sort_unstable();
    edges.dedup();
    edges
}

/// Where the walk around a fan begins, clockwise: at a corner, or at the boundary half-edge that is
/// the twin of the side before a corner.
#[derive(Clone, Copy)]
enum FanStart {
    Isolated,
    Closed(u32),
    Boundary(u32),
}

impl FanStart {
    fn half_edge(self, polygons: &Polygons, half_edge_of_corner: &[HalfEdgeId]) -> HalfEdgeId {
        match self {
            Self::Isolated => HalfEdgeId::NONE,
            Self::Closed(c) => half_edge_of_corner[c as usize],
            Self::Boundary(c) => half_edge_of_corner[polygons.prev(c) as usize].twin(),
        }
    }
}

struct Fan {
    start: FanStart,
    corners: Vec<u32>,
}

/// Walks the fan of corner `c`, calling `visit` for each of its corners once.
fn walk_fan(c: u32, polygons: &Polygons, twin: &[u32], mut visit: impl FnMut(u32)) -> FanStart {
    // Counter-clockwise to the end, which on the boundary is where a half-edge without face leaves.
    let mut last = c;
    loop {
        visit(last);
        match twin[polygons.prev(last) as usize] {
            NONE => break,
            following if following == c => return FanStart::Closed(c),
            following => last = following,
        }
    }
    // Then clockwise from c to the other end.
    let mut at = c;
    while twin[at as usize] != NONE {
        at = polygons.next(twin[at as usize]);
        visit(at);
    }
    FanStart::Boundary(last)
}

/// The first fan of each vertex, and the vertices that have more than one.
fn fans(polygons: &Polygons, buckets: &Buckets, twin: &[u32]) -> (Vec<FanStart>, Vec<u32>) {
    let walked: Vec<(FanStart, bool)> = (0..buckets.first.len() - 1)
        .into_par_iter()
        .with_min_len(BLOCK)
        .map(|v| {
            let sides = &buckets.sides[buckets.first[v] as usize..buckets.first[v + 1] as usize];
            let Some(&(_, c)) = sides.first() else {
                return (FanStart::Isolated, false);
            };
            let mut visited = 0;
            let start = walk_fan(c, polygons, twin, |_| visited += 1);
            (start, visited < sides.len())
        })
        .collect();
    let pinched = (0..)
        .zip(&walked)
        .filter(|(_, (_, more))| *more)
        .map(|(v, _)| v)
        .collect();
    (
        walked.into_par_iter().map(|(start, _)| start).collect(),
        pinched,
    )
}

/// All fans of `v` but the first, in order of their first corners.
fn other_fans(v: u32, polygons: &Polygons, buckets: &Buckets, twin: &[u32]) -> Vec<Fan> {
    let mut fans: Vec<Fan> = Vec::new();
    for &(_, c) in buckets.of(v) {
        if fans.iter().all(|fan| !fan.corners.contains(&c)) {
            let mut corners = Vec::new();
            let start = walk_fan(c, polygons, twin, |c| corners.push(c));
            fans.push(Fan { start, corners });
        }
    }
    fans.split_off(1)
}

/// For each corner its half-edge. Edges are numbered in the order of their first corners.
fn number_edges(twin: &[u32]) -> Vec<HalfEdgeId> {
    let owns = |c: usize| twin[c] == NONE || c < twin[c] as usize;
    let counts: Vec<usize> = (0..twin.len().div_ceil(BLOCK))
        .into_par_iter()
        .map(|b| {
            (b * BLOCK..twin.len().min((b + 1) * BLOCK))
                .filter(|&c| owns(c))
                .count()
        })
        .collect();
    let firsts: Vec<usize> = counts
        .iter()
        .scan(0, |sum, n| Some(std::mem::replace(sum, *sum + n)))
        .collect();
    // Each corner is written once, by the owner of its edge.
    let half_edges: Vec<AtomicU32> = (0..twin.len())
        .into_par_iter()
        .map(|_| AtomicU32::new(0))
        .collect();
    firsts.into_par_iter().enumerate().for_each(|(b, first)| {
        let mut e = u32::try_from(first).expect("checked before");
        for c in b * BLOCK..twin.len().min((b + 1) * BLOCK) {
            if owns(c) {
                half_edges[c].store(2 * e, Relaxed);
                if twin[c] != NONE {
                    half_edges[twin[c] as usize].store(2 * e + 1, Relaxed);
                }
                e += 1;
            }
        }
    });
    half_edges
        .into_par_iter()
        .map(|h| HalfEdgeId::new(h.into_inner() as usize))
        .collect()
}

/// The arrays `next`, `origin` and `face`.
fn half_edge_arrays(
    polygons: &Polygons,
    origin: &[u32],
    twin: &[u32],
    half_edge_of_corner: &[HalfEdgeId],
) -> Connectivity {
    let owners: Vec<u32> = polygons
        .ids()
        .with_min_len(BLOCK)
        .filter(|&c| twin[c as usize] == NONE || c < twin[c as usize])
        .collect();
    let mut next = bytemuck::zeroed_vec::<HalfEdgeId>(2 * owners.len());
    let mut origins = bytemuck::zeroed_vec::<VertexId>(2 * owners.len());
    let mut face = bytemuck::zeroed_vec::<FaceId>(2 * owners.len());
    let of = |c: u32| half_edge_of_corner[c as usize];
    let vertex = |c: u32| VertexId::new(origin[c as usize] as usize);
    let id = |f: u32| FaceId::new(f as usize);
    next.par_chunks_mut(2)
        .zip(origins.par_chunks_mut(2))
        .zip(face.par_chunks_mut(2))
        .zip(&owners)
        .with_min_len(BLOCK)
        .for_each(|(((next, origins), face), &c)| {
            (next[0], origins[0], face[0]) =
                (of(polygons.next(c)), vertex(c), id(polygons.face(c)));
            (next[1], origins[1], face[1]) = match twin[c as usize] {
                NONE => {
                    // The boundary goes on at the other end of the fan.
                    let mut p = polygons.prev(c);
                    while twin[p as usize] != NONE {
                        p = polygons.prev(twin[p as usize]);
                    }
                    (of(p).twin(), vertex(polygons.next(c)), FaceId::NONE)
                }
                t => (of(polygons.next(t)), vertex(t), id(polygons.face(t))),
            };
        });
    Connectivity {
        next,
        origin: origins,
        face,
        ..Connectivity::default()
    }
}

/// A count that fits the ids, which end at 2³² − 2.
fn to_u32(n: usize, what: &'static str) -> Result<u32, BuildError> {
    u32::try_from(n)
        .ok()
        .filter(|&n| n < NONE)
        .ok_or(BuildError::TooLarge(n, what))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(n: usize) -> Vec<DVec3> {
        #[expect(clippy::cast_precision_loss, reason = "small numbers")]
        (0..n)
            .map(|i| DVec3::new(i as f64, (i * i) as f64, 0.0))
            .collect()
    }

    fn mesh(n: usize, polygons: &[&[u32]]) -> (Mesh, BuildReport) {
        let (mesh, report) = Mesh::from_polygons(points(n), polygons).unwrap();
        assert_eq!(mesh.defects(), []);
        (mesh, report)
    }

    #[test]
    fn nothing_becomes_an_empty_mesh() {
        let (mesh, report) = mesh(0, &[]);
        assert_eq!(
            (mesh.n_vertices(), mesh.n_edges(), mesh.n_faces()),
            (0, 0, 0)
        );
        assert!(report.is_clean());
    }

    #[test]
    fn unused_vertices_stay_as_isolated_ones() {
        let (mesh, report) = mesh(5, &[&[0, 2, 4]]);
        assert_eq!(mesh.n_vertices(), 5);
        assert_eq!(mesh.vertex_half_edge(VertexId::new(1)), None);
        assert!(report.is_clean());
    }

    #[test]
    fn edges_are_numbered_as_they_are_first_named() {
        let (mesh, _) = mesh(4, &[&[0, 1, 2], &[0, 2, 3]]);
        let ends: Vec<_> = mesh
            .edges()
            .map(|e| mesh.edge_vertices(e).map(VertexId::index))
            .collect();
        assert_eq!(ends, [[0, 1], [1, 2], [2, 0], [2, 3], [3, 0]]);
    }

    #[test]
    fn three_faces_at_an_edge_are_split_and_listed() {
        let (mesh, report) = mesh(5, &[&[0, 1, 2], &[1, 0, 3], &[0, 1, 4]]);
        assert_eq!(report.split_edges, [[VertexId::new(0), VertexId::new(1)]]);
        assert_eq!(report.split_vertices.len(), 2);
        assert_eq!((mesh.n_faces(), mesh.n_vertices()), (3, 7));
    }

    #[test]
    fn two_faces_that_run_the_same_way_along_an_edge_are_split() {
        let (mesh, report) = mesh(4, &[&[0, 1, 2], &[0, 1, 3]]);
        assert_eq!(report.split_edges.len(), 1);
        assert_eq!(mesh.n_faces(), 2);
    }

    #[test]
    fn a_bow_tie_vertex_is_copied_for_its_second_fan() {
        let (mesh, report) = mesh(5, &[&[0, 1, 2], &[0, 3, 4]]);
        assert_eq!(
            report.split_vertices,
            [(VertexId::new(0), VertexId::new(5))]
        );
        assert_eq!(
            mesh.position(VertexId::new(0)),
            mesh.position(VertexId::new(5))
        );
    }

    #[test]
    fn two_cubes_that_share_an_edge_come_apart_as_two_closed_cubes() {
        let cube = |o: u32, shared: [u32; 2]| -> Vec<Vec<u32>> {
            let id = |i: u32| if i < 2 { shared[i as usize] } else { o + i };
            [
                [0, 1, 3, 2],
                [0, 4, 5, 1],
                [1, 5, 7, 3],
                [3, 7, 6, 2],
                [2, 6, 4, 0],
                [4, 6, 7, 5],
            ]
            .iter()
            .map(|f| f.iter().map(|&i| id(i)).collect())
            .collect()
        };
        let polygons = [cube(0, [0, 1]), cube(6, [0, 1])].concat();
        let (mesh, report) = Mesh::from_polygons(points(14), &polygons).unwrap();
        assert_eq!(mesh.defects(), []);
        assert_eq!(report.split_edges.len(), 1);
        assert_eq!(report.split_vertices.len(), 2);
        assert!(mesh.edges().all(|e| !mesh.is_boundary_edge(e)));
        assert_eq!(mesh.n_components(), 2);
    }

    #[test]
    fn degenerate_polygons_are_left_out_and_leave_gaps_in_the_maps() {
        let corners = [0, 1, 1, 0, 1, 2, 0, 1];
        let built = build(points(3), &[0, 3, 6, 8], &corners, NonManifold::Split).unwrap();
        assert_eq!(built.report.dropped_faces, [0, 2]);
        assert_eq!(
            built.face_of_polygon,
            [FaceId::NONE, FaceId::new(0), FaceId::NONE]
        );
        assert_eq!(built.half_edge_of_corner[2], HalfEdgeId::NONE);
        assert_eq!(
            built.mesh.origin(built.half_edge_of_corner[5]),
            VertexId::new(2)
        );
    }

    #[test]
    fn bad_input_is_refused_with_the_place() {
        let none = |r: Result<(Mesh, BuildReport), BuildError>| r.unwrap_err().to_string();
        assert_eq!(
            none(Mesh::from_polygons(points(3), &[[0, 1, 2], [0, 1, 3]])),
            "face 1 refers to vertex 3, but there are 3 vertices"
        );
        let mut bad = points(3);
        bad[1].y = f64::NAN;
        assert_eq!(
            none(Mesh::from_polygons(bad, &[[0, 1, 2]])),
            "the position of vertex 1 is not finite"
        );
        assert!(build(points(3), &[0, 5], &[0, 1, 2], NonManifold::Split).is_err());
    }

    #[test]
    fn a_manifold_can_be_insisted_on() {
        let built = build(
            points(5),
            &[0, 3, 6],
            &[0, 1, 2, 0, 3, 4],
            NonManifold::Refuse,
        );
        assert_eq!(
            built.unwrap_err().to_string(),
            "the faces are not a manifold: v0 joins faces that share no edge"
        );
    }
}
