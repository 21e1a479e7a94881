//! Collapses edges that are too short.

use mesh::{DVec3, EdgeId, FaceId, HalfEdgeId, VertexId, parallel};
use progress::{Cancelled, Progress};
use rayon::prelude::*;

use crate::surface_index::triangle::nearest_on_triangle;

use super::original::{Place, Track};
use super::size::{LONG, SHORT};
use super::work::{Work, cross, is_bent, is_turned, quality};
use super::{Refused, WHAT};

/// A collapse is not allowed to reduce the quality of a triangle below this value. The quality is from 0 (degenerate)
/// to 1 (equilateral).
const QUALITY: f64 = 0.3;

/// After a collapse, the new triangles must be near both old ends of the collapsed edge. The largest allowed distance
/// is this fraction of the target length. A collapse that exceeds this limit is refused. Without this limit, collapses
/// cut off pointed tips of the surface. For the bunny of `scenes/assets`, the largest distance between the original and
/// the result is 1.6 % of the diagonal of the bounding box. Without this limit, the distance is 2.9 % of the diagonal.
const TIP: f64 = 0.15;

/// Two edges of the triangle on one side of the collapsed edge. The collapse merges these two edges into one edge. The
/// apex is the vertex that both edges have in common.
struct Merged {
    edges: [EdgeId; 2],
    apex: VertexId,
    /// The line that contains the merged edge, and whether the line runs along this edge away from the apex. `None` if
    /// no line contains the merged edge.
    track: Option<Track>,
}

impl Work<'_> {
    /// Collapses edges that are too short, the shortest first. Returns the number of collapses.
    pub(super) fn collapse_short(&mut self, progress: &dyn Progress) -> Result<usize, Cancelled> {
        let mut n_collapses = 0;
        let mut short: Vec<EdgeId> = self.mesh.edges().collect();
        while !short.is_empty() {
            short.retain(|&e| self.mesh.has_edge(e));
            let lengths = parallel::collect(short.len(), |i| self.relative_length(short[i]));
            let mut sorted: Vec<(f64, EdgeId)> = lengths.into_iter().zip(short.drain(..)).collect();
            sorted.retain(|&(length, _)| length < SHORT);
            sorted.par_sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            sorted.dedup();
            for (i, (_, e)) in sorted.into_iter().enumerate() {
                if i % 1024 == 0 {
                    progress.report(WHAT, self.counts.passes, self.counts.max_passes)?;
                }
                if !self.mesh.has_edge(e) || self.relative_length(e) >= SHORT {
                    continue;
                }
                match self.collapse(e) {
                    Ok(v) => {
                        n_collapses += 1;
                        short.extend(self.mesh.vertex_half_edges(v).map(HalfEdgeId::edge));
                    }
                    Err(reason) => self.counts.refuse(reason),
                }
            }
        }
        self.counts.collapsed += n_collapses;
        Ok(n_collapses)
    }

    /// Collapses an edge to a point: one of its two ends, or its midpoint. Returns the vertex that remains.
    fn collapse(&mut self, e: EdgeId) -> Result<VertexId, Refused> {
        let ends = self.mesh.edge_vertices(e);
        let [a, b] = ends.map(|v| self.places[v.index()]);
        let is_line = self.is_line(e);
        let may_vanish = |place: Place| match place {
            Place::Corner(_) => false,
            Place::Line { .. } => is_line,
            Place::Inside(_) => true,
        };
        let points = ends.map(|v| self.mesh.position(v));
        let mut best: Result<(f64, DVec3, Option<usize>), Refused> = Err(Refused::Lines);
        let mut attempt = |point: DVec3, kept: Option<usize>| {
            let longest = self.longest_after(e, point);
            best = match (best, longest) {
                (Ok(best), Ok(longest)) if longest >= best.0 => Ok(best),
                (_, Ok(longest)) => Ok((longest, point, kept)),
                (Err(Refused::Lines), Err(reason)) => Err(reason),
                (best, Err(_)) => best,
            };
        };
        if let [Place::Inside(_), Place::Inside(_)] = [a, b] {
            attempt(0.5 * (points[0] + points[1]), None);
        }
        if may_vanish(b) {
            attempt(points[0], Some(0));
        }
        if may_vanish(a) {
            attempt(points[1], Some(1));
        }
        let (_, point, kept) = best?;
        let merged = self.merged(e)?;
        let v = self
            .mesh
            .collapse_edge_to(e, point)
            .map_err(|_| Refused::Topology)?;
        let (to, from) = (v.index(), ends[kept.unwrap_or(0)].index());
        self.places[to] = self.places[from];
        self.sizes[to] = self.sizes[from];
        self.valences[to] = self.valences[from];
        self.is_off[to] = self.is_off[from] || kept.is_none();
        for Merged { edges, apex, track } in merged.into_iter().flatten() {
            for e in edges.into_iter().filter(|&e| self.mesh.has_edge(e)) {
                let starts_at_apex = self.mesh.origin(e.half_edges()[0]) == apex;
                self.tracks[e.index()] = track.map(|track| Track {
                    is_along: track.is_along == starts_at_apex,
                    ..track
                });
            }
        }
        Ok(v)
    }

    fn merged(&self, e: EdgeId) -> Result<[Option<Merged>; 2], Refused> {
        let mut merged = [None, None];
        for (h, merged) in e.half_edges().into_iter().zip(&mut merged) {
            if self.mesh.face(h).is_none() {
                continue;
            }
            let next = self.mesh.next(h);
            let last = self.mesh.next(next);
            // The tracks (locations on lines) of two half-edges, which both start at the apex of the triangle.
            let tracks = [self.track_of(next.twin()), self.track_of(last)];
            if tracks.iter().all(Option::is_some) {
                return Err(Refused::Lines);
            }
            *merged = Some(Merged {
                edges: [next.edge(), last.edge()],
                apex: self.mesh.origin(last),
                track: tracks[0].or(tracks[1]),
            });
        }
        Ok(merged)
    }

    /// Returns the largest relative length of the edges that a collapse to `point` would make. The relative length is
    /// the length of an edge divided by its target length. If the collapse is not allowed, returns the reason as an
    /// error.
    fn longest_after(&self, e: EdgeId, point: DVec3) -> Result<f64, Refused> {
        let ends = self.mesh.edge_vertices(e);
        let size = self.sizes[ends[0].index()].min(self.sizes[ends[1].index()]);
        let mut longest = 0.0;
        let mut new: Vec<(FaceId, [DVec3; 3])> = Vec::new();
        let mut first = None;
        let mut bent = self.limit.is_some();
        for end in ends {
            for g in self.mesh.vertex_half_edges(end) {
                let x = self.mesh.target(g);
                if ends.contains(&x) {
                    continue;
                }
                let length =
                    self.mesh.position(x).distance(point) / size.min(self.sizes[x.index()]);
                if length > LONG {
                    return Err(Refused::Long);
                }
                longest = length.max(longest);
                let y = self.mesh.target(self.mesh.next(g));
                let Some(f) = self.mesh.face(g).filter(|_| !ends.contains(&y)) else {
                    continue;
                };
                let before = self.triangle(g);
                let after = [point, before[1], before[2]];
                let crosses = [cross(before), cross(after)];
                let first = *first.get_or_insert(crosses[0]);
                bent |= crosses.into_iter().any(|cross| is_bent(first, cross));
                if is_turned(crosses[0], crosses[1]) {
                    return Err(Refused::Turned);
                }
                let quality_after = quality(after);
                if quality_after < QUALITY && quality_after < quality(before) {
                    return Err(Refused::Thin);
                }
                new.push((f, after));
            }
        }
        let gone = ends.map(|v| self.mesh.position(v));
        let is_cut_off = |p: DVec3| {
            let mut distances = new
                .iter()
                .map(|(_, t)| nearest_on_triangle(p, t).distance(p));
            distances.all(|distance| distance > TIP * size)
        };
        if gone.into_iter().any(is_cut_off) || (bent && self.is_far(&new, &gone)) {
            return Err(Refused::Far);
        }
        Ok(longest)
    }
}
