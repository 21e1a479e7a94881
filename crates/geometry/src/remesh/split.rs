//! Splits edges that are too long.

use mesh::{EdgeId, HalfEdgeId, parallel};
use progress::Progress;
use rayon::prelude::*;

use super::original::{Place, Track};
use super::size::LONG;
use super::work::{Work, cross, is_turned};
use super::{Refused, RemeshError, WHAT};

impl Work<'_> {
    /// Splits edges that are too long, the longest first. Each edge is split at its midpoint. Stops when no edge that
    /// is too long can be split, or when the mesh has `enough` faces. Returns the number of splits.
    pub(super) fn split_long(
        &mut self,
        max_faces: usize,
        enough: f64,
        progress: &dyn Progress,
    ) -> Result<usize, RemeshError> {
        let mut n_splits = 0;
        let mut long: Vec<EdgeId> = self.mesh.edges().collect();
        while !long.is_empty() && (self.mesh.n_faces() as f64) < enough {
            let lengths = parallel::collect(long.len(), |i| self.relative_length(long[i]));
            let mut sorted: Vec<(f64, EdgeId)> = lengths.into_iter().zip(long.drain(..)).collect();
            sorted.retain(|&(length, _)| length > LONG);
            sorted.par_sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
            for (i, (_, e)) in sorted.into_iter().enumerate() {
                if i % 1024 == 0 {
                    progress.report(WHAT, self.counts.passes, self.counts.max_passes)?;
                }
                if self.mesh.n_faces() + 2 > max_faces {
                    return Err(full(self.mesh.n_faces(), max_faces));
                }
                let first_new = self.tracks.len();
                if self.relative_length(e) > LONG && self.split(e)? {
                    n_splits += 1;
                    long.push(e);
                    long.extend((first_new..self.tracks.len()).map(EdgeId::new));
                }
            }
        }
        self.counts.split += n_splits;
        Ok(n_splits)
    }

    /// Splits an edge at its midpoint. If the edge is on a line of the original surface, the new vertex lies on this
    /// line, in the middle between the ends of the edge. Returns false if the split would turn a triangle too far, or
    /// if the two triangles at the edge have the same opposite vertex.
    fn split(&mut self, e: EdgeId) -> Result<bool, RemeshError> {
        let opposite = |h: HalfEdgeId| {
            let is_inner = self.mesh.face(h).is_some();
            is_inner.then(|| self.mesh.origin(self.mesh.prev(h)))
        };
        let [left, right] = e.half_edges().map(opposite);
        if left.is_some() && left == right {
            // If the faces on both sides of the edge have the same opposite vertex, the new vertex would have two edges
            // to this vertex.
            self.counts.refuse(Refused::Topology);
            return Ok(false);
        }
        let track = self.tracks[e.index()];
        let [a, b] = self.mesh.edge_vertices(e);
        let mut point = 0.5 * (self.mesh.position(a) + self.mesh.position(b));
        let mut place = None;
        if let Some(track) = track {
            let h = e.half_edges()[0];
            let chain = &self.original.chains[track.chain as usize];
            let at = chain.after(self.start(h, track), 0.5 * self.way(h, track));
            let on_line = self.original.on_chain(track.chain, at);
            let turns = |h: HalfEdgeId| {
                let [a, b, c] = self.triangle(h);
                let before = cross([a, b, c]);
                self.mesh.face(h).is_some()
                    && [[a, on_line, c], [on_line, b, c]]
                        .into_iter()
                        .any(|triangle| is_turned(before, cross(triangle)))
            };
            if e.half_edges().into_iter().any(turns) {
                self.counts.refuse(Refused::Turned);
                return Ok(false);
            }
            point = on_line;
            place = Some(Place::Line {
                chain: track.chain,
                at,
            });
        }
        let hint = |h: HalfEdgeId| match self.places[self.mesh.origin(h).index()] {
            Place::Inside(hint) => Some(hint),
            _ => None,
        };
        // A vertex inside a chart stores a hint: the index of a nearby triangle of the original mesh. The new vertex
        // takes its hint from a vertex of the two triangles at the edge.
        let [h, twin] = e.half_edges();
        let around = [h, twin, self.mesh.prev(h), self.mesh.prev(twin)];
        let hint = around.into_iter().find_map(hint).unwrap_or(0);
        let size = 0.5 * (self.sizes[a.index()] + self.sizes[b.index()]);
        let charts = e
            .half_edges()
            .map(|h| self.mesh.face(h).map(|f| self.chart(f)));
        let m = self
            .mesh
            .split_edge(e, 0.5)
            .map_err(|_| full(self.mesh.n_faces(), self.mesh.n_faces()))?;
        self.mesh.set_position(m, point);
        let is_boundary = charts.contains(&None);
        self.places.push(place.unwrap_or(Place::Inside(hint)));
        self.sizes.push(size);
        self.valences.push(if is_boundary { 4 } else { 6 });
        self.is_off.push(track.is_none());
        // The second half of the split edge has the same direction as the first half, so the second half gets the same
        // track (location on a line).
        self.tracks.push(track);
        for chart in charts.into_iter().flatten() {
            self.tracks.push(None::<Track>);
            self.charts.push(chart);
        }
        Ok(true)
    }
}

/// Returns the error for a mesh that has reached the largest number of faces.
fn full(n_faces: usize, max: usize) -> RemeshError {
    RemeshError::TooManyFaces {
        needed: n_faces as f64 + 2.0,
        max,
    }
}
