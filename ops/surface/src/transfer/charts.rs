//! The charts of the source mesh. A chart is a part of the mesh between seams.
//!
//! A chart can have seams inside it, such as the single seam of a cylinder. Near a seam inside a chart, a face of the
//! target takes its values from one side of the seam:
//!
//! ```text
//!    target    +-----------+           the center of the face is above side a, so both corners take values
//!    source    a-----a-----|b-----b    from side a; the right corner takes the values of side a at the seam
//! ```

use std::cell::Cell;
use std::cmp::Reverse;
use std::collections::{BTreeSet, BinaryHeap};

use geometry::surface_index::{SurfaceIndex, nearest_on_triangle, triangle_distance};
use mesh::{DVec3, Domain, FaceId, HalfEdgeId, Mesh, Values};
use op::{Cancelled, Progress};

/// Corners are moved toward the center of their face by this fraction of their distance from the center. At a seam, the
/// source face that is nearest to the moved corner is then on the same side of the seam as the face of the corner.
const INSET: f64 = 1e-6;

/// The exact distance between two polygons is computed if they have at most this number of pairs of triangles. With
/// more pairs, the computation would take too long, so the distance from the center of one polygon to the other polygon
/// is used instead.
const MAX_PAIRS: usize = 4096;

/// The charts of a corner attribute. A chart is a set of connected faces. Two faces are connected if the values of
/// their corners are the same at the common edge.
pub(super) struct Charts<'a> {
    mesh: &'a Mesh,
    values: &'a Values,
    /// The chart of each face, by face index.
    pub(super) of_face: Vec<usize>,
    faces: Vec<Vec<FaceId>>,
    /// The spatial index of each chart. An index is built when it is first needed.
    indices: Vec<Option<SurfaceIndex>>,
    /// A spatial index of the faces next to seams that run inside a chart.
    seams: Option<SurfaceIndex>,
}

/// The part of a chart from which the corners of one face take their values.
pub(super) struct Side {
    pub(super) faces: BTreeSet<FaceId>,
    pub(super) index: SurfaceIndex,
}

impl<'a> Charts<'a> {
    pub(super) fn new(
        mesh: &'a Mesh,
        values: &'a Values,
        progress: &dyn Progress,
    ) -> Result<Self, Cancelled> {
        let mut charts = Self {
            mesh,
            values,
            of_face: vec![usize::MAX; mesh.domain_len(Domain::Face)],
            faces: Vec::new(),
            indices: Vec::new(),
            seams: None,
        };
        for first in mesh.faces() {
            if charts.of_face[first.index()] == usize::MAX {
                charts.add(first);
            }
        }
        let is_beside_inner_seam = |&f: &FaceId| {
            mesh.face_half_edges(f).any(|h| {
                mesh.face(h.twin()).is_some_and(|g| {
                    charts.of_face[f.index()] == charts.of_face[g.index()] && charts.is_seam(h)
                })
            })
        };
        let beside = mesh.faces().filter(is_beside_inner_seam);
        charts.seams = SurfaceIndex::of_faces(mesh, beside, progress)?;
        Ok(charts)
    }

    /// Adds the chart that contains the face `first`.
    fn add(&mut self, first: FaceId) {
        let number = self.faces.len();
        self.of_face[first.index()] = number;
        let mut chart = vec![first];
        let mut next = 0;
        while let Some(&f) = chart.get(next) {
            next += 1;
            for h in self.mesh.face_half_edges(f) {
                if let Some(g) = self.mesh.face(h.twin())
                    && self.of_face[g.index()] == usize::MAX
                    && !self.is_seam(h)
                {
                    self.of_face[g.index()] = number;
                    chart.push(g);
                }
            }
        }
        self.faces.push(chart);
        self.indices.push(None);
    }

    /// Whether the values differ between the two sides of the edge of `h`. The edge must have two faces.
    fn is_seam(&self, h: HalfEdgeId) -> bool {
        let twin = h.twin();
        let differ = |a: HalfEdgeId, b: HalfEdgeId| !self.values.are_equal(a.index(), b.index());
        differ(h, self.mesh.next(twin)) || differ(self.mesh.next(h), twin)
    }

    pub(super) fn index(
        &mut self,
        chart: usize,
        progress: &dyn Progress,
    ) -> Result<&SurfaceIndex, Cancelled> {
        if self.indices[chart].is_none() {
            let faces = self.faces[chart].iter().copied();
            self.indices[chart] = SurfaceIndex::of_faces(self.mesh, faces, progress)?;
        }
        Ok(self.indices[chart].as_ref().expect("a chart has faces"))
    }

    /// Compares the distances of the candidates from the face `f`. Returns the nearest candidate if it is less than
    /// half as far away as the first candidate. Otherwise, returns the first candidate. The distance of a chart from a
    /// face is the distance from the chart to the farthest of the following points: the corners and the center of the
    /// face.
    pub(super) fn nearest(
        &mut self,
        candidates: &[usize],
        target: &Mesh,
        f: FaceId,
        progress: &dyn Progress,
    ) -> Result<usize, Cancelled> {
        let (mut chart, mut least) = (candidates[0], f64::INFINITY);
        if candidates.len() == 1 {
            return Ok(chart);
        }
        for &candidate in candidates {
            let index = self.index(candidate, progress)?;
            let corners = target.face_vertices(f).map(|v| target.position(v));
            let points = corners.chain([target.face_center(f)]);
            let distances = points.map(|p| index.nearest(p, 0).distance);
            let distance = distances.fold(0.0, f64::max);
            if least == f64::INFINITY {
                least = 0.5 * distance;
            } else if distance < least {
                (chart, least) = (candidate, distance);
            }
        }
        Ok(chart)
    }

    /// Returns the faces of `chart` that lie under the target face `f`, on the same side of the seam as the center of
    /// `f`. Returns `None` if the chart has no seam near `f`. `farthest` is the distance from the source to the
    /// farthest of these points: the corners and the center of `f`.
    ///
    /// First finds the part of the source under `f`: the source faces nearest to the center and to the corners of `f`,
    /// and the faces that connect them. Then returns the faces of this part that can be reached from the face under the
    /// center without crossing a seam.
    pub(super) fn side_under(
        &mut self,
        chart: usize,
        target: &Mesh,
        f: FaceId,
        farthest: f64,
        progress: &dyn Progress,
    ) -> Result<Option<Side>, Cancelled> {
        let Some(seams) = &self.seams else {
            return Ok(None);
        };
        let center = target.face_center(f);
        let corners: Vec<DVec3> = target
            .face_vertices(f)
            .map(|v| target.position(v))
            .collect();
        let radius = corners
            .iter()
            .fold(0.0_f64, |r, p| r.max(p.distance(center)));
        let reach = DVec3::splat(2.0 * (radius + farthest));
        let (low, high) = (center - reach, center + reach);
        let is_near = Cell::new(false);
        seams.visit_boxes(
            &mut |min, max| !is_near.get() && min.cmple(high).all() && max.cmpge(low).all(),
            &mut |_| is_near.set(true),
        );
        if !is_near.get() {
            return Ok(None);
        }
        let corners: Vec<DVec3> = corners.iter().map(|p| p.lerp(center, INSET)).collect();
        let index = self.index(chart, progress)?;
        let face_of = |p: &DVec3| index.triangle(index.nearest(*p, 0).triangle).face;
        let start = face_of(&center);
        let goals: BTreeSet<FaceId> = corners.iter().map(face_of).collect();
        let fan = fan(&corners);
        let under = self.connecting(start, goals, &fan, radius + farthest, progress)?;
        let mut faces = BTreeSet::from([start]);
        let mut open = vec![start];
        while let Some(f) = open.pop() {
            for h in self.mesh.face_half_edges(f) {
                if let Some(g) = self.mesh.face(h.twin())
                    && under.contains(&g)
                    && !self.is_seam(h)
                    && faces.insert(g)
                {
                    open.push(g);
                }
            }
        }
        let index = SurfaceIndex::of_faces(self.mesh, faces.iter().copied(), progress)?;
        Ok(index.map(|index| Side { faces, index }))
    }

    /// Starts at the face `start`, and collects the connected faces that are at most a distance d away from
    /// `triangles`. Faces are also connected across seams. The distance d is the smallest distance for which the result
    /// contains all `goals`, but at most `limit`. If d is `limit`, some goals can be missing.
    fn connecting(
        &self,
        start: FaceId,
        mut goals: BTreeSet<FaceId>,
        triangles: &[[DVec3; 3]],
        limit: f64,
        progress: &dyn Progress,
    ) -> Result<BTreeSet<FaceId>, Cancelled> {
        // If the center of a face is within `reached_distance`, the face is reached in any case, so its exact distance
        // is not needed.
        let distance = |f: FaceId, reached_distance: f64| {
            let center = self.mesh.face_center(f);
            let to_center = |t: &[DVec3; 3]| center.distance(nearest_on_triangle(center, t));
            let to_center = triangles
                .iter()
                .map(to_center)
                .fold(f64::INFINITY, f64::min);
            let n_triangles = self.mesh.degree(f) - 2;
            if to_center <= reached_distance || n_triangles * triangles.len() > MAX_PAIRS {
                return to_center;
            }
            let corners = self.mesh.face_vertices(f).map(|v| self.mesh.position(v));
            let parts = fan(&corners.collect::<Vec<_>>());
            let pairs = parts
                .iter()
                .flat_map(|s| triangles.iter().map(move |t| (s, t)));
            pairs.fold(to_center, |d, (s, t)| d.min(triangle_distance(s, t)))
        };
        let mut reached = BTreeSet::new();
        let mut seen = BTreeSet::from([start]);
        // Distances are not negative, so their bits, compared as integers, have the same order as the distances.
        let mut open = BinaryHeap::from([Reverse((distance(start, 0.0).to_bits(), start))]);
        let mut largest = 0.0;
        while let Some(Reverse((bits, f))) = open.pop() {
            let distance_of_f = f64::from_bits(bits);
            if distance_of_f > largest {
                if goals.is_empty() || distance_of_f > limit {
                    break;
                }
                largest = distance_of_f;
            }
            reached.insert(f);
            if reached.len().is_multiple_of(256) {
                let (done, total) = (reached.len() as u64, self.mesh.n_faces() as u64);
                progress.report("find the source under a face", done, total)?;
            }
            goals.remove(&f);
            for h in self.mesh.face_half_edges(f) {
                if let Some(g) = self.mesh.face(h.twin())
                    && seen.insert(g)
                {
                    open.push(Reverse((distance(g, largest).to_bits(), g)));
                }
            }
        }
        Ok(reached)
    }
}

/// Divides a polygon into a fan of triangles around its first corner.
fn fan(corners: &[DVec3]) -> Vec<[DVec3; 3]> {
    let pairs = corners[1..].windows(2);
    pairs.map(|pair| [corners[0], pair[0], pair[1]]).collect()
}
