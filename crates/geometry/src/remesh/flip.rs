//! Flips edges, so that most vertices have six edges, and so that the smallest angles of triangles become larger.

use mesh::{EdgeId, HalfEdgeId, VertexId};
use progress::{Cancelled, Progress};

use super::size::LONG;
use super::work::{Work, cross, is_bent, is_turned, quality};
use super::{Refused, WHAT};

impl Work<'_> {
    /// Flips edges to improve the valences: the numbers of edges at vertices. An edge is also flipped if the flip
    /// improves the shapes of the triangles and leaves the valences equally good. Flips that would make a thin
    /// triangle, turn a triangle too far or move the surface too far are left out. The last pass also leaves out flips
    /// that would make an edge too long, because no later pass would split this edge. Returns the number of flips.
    pub(super) fn flip_all(&mut self, progress: &dyn Progress) -> Result<usize, Cancelled> {
        let mut valences: Vec<i32> = vec![0; self.places.len()];
        for h in self.mesh.half_edges() {
            valences[self.mesh.origin(h).index()] += 1;
        }
        let mut n_flips = 0;
        let mut edges: Vec<EdgeId> = self.mesh.edges().filter(|&e| !self.is_line(e)).collect();
        let mut is_waiting = vec![false; self.tracks.len()];
        // Each flip improves the mesh, so the loop would end even without a limit. The limit of eight rounds bounds the
        // running time.
        for _ in 0..8 {
            let mut again = Vec::new();
            for (i, &e) in edges.iter().enumerate() {
                if i % 4096 == 0 {
                    progress.report(WHAT, self.counts.passes, self.counts.max_passes)?;
                }
                is_waiting[e.index()] = false;
                if !self.flip(e, &mut valences) {
                    continue;
                }
                n_flips += 1;
                for h in e.half_edges() {
                    let next = self.mesh.next(h);
                    for e in [next.edge(), self.mesh.next(next).edge()] {
                        if !is_waiting[e.index()] && !self.is_line(e) {
                            is_waiting[e.index()] = true;
                            again.push(e);
                        }
                    }
                }
            }
            if again.is_empty() {
                break;
            }
            edges = again;
        }
        self.counts.flipped += n_flips;
        Ok(n_flips)
    }

    fn flip(&mut self, e: EdgeId, valences: &mut [i32]) -> bool {
        let [h, twin] = e.half_edges();
        let opposite = |h: HalfEdgeId| self.mesh.target(self.mesh.next(h));
        let [a, b] = self.mesh.edge_vertices(e);
        let (c, d) = (opposite(h), opposite(twin));
        let deviation = |v: VertexId, change: i32| {
            let i = v.index();
            let deviation = valences[i] + change - i32::from(self.valences[i]);
            deviation * deviation
        };
        let before = deviation(a, 0) + deviation(b, 0) + deviation(c, 0) + deviation(d, 0);
        let after = deviation(a, -1) + deviation(b, -1) + deviation(c, 1) + deviation(d, 1);
        if after > before {
            return false;
        }
        let [p, q, r, s] = [a, b, c, d].map(|v| self.mesh.position(v));
        let (old, new) = ([[p, q, r], [q, p, s]], [[r, s, q], [s, r, p]]);
        let worst = |t: [_; 2]| quality(t[0]).min(quality(t[1]));
        let (worst_before, worst_after) = (worst(old), worst(new));
        if after == before && worst_after <= worst_before + 0.02 {
            return false;
        }
        if worst_after < 0.5 && worst_after < worst_before {
            return false;
        }
        let (old, crosses) = (old.map(cross), new.map(cross));
        let turns = |&before: &_| crosses.iter().any(|&after| is_turned(before, after));
        if old.iter().any(turns) || crosses.contains(&mesh::DVec3::ZERO) {
            return false;
        }
        let is_last_pass = self.counts.passes + 1 == self.counts.max_passes;
        if is_last_pass && self.relative_distance(c, d) > LONG.max(self.relative_length(e)) {
            self.counts.refuse(Refused::Long);
            return false;
        }
        if (self.limit.is_some() || is_bent(old[0], old[1]))
            && let Some(f) = self.mesh.face(h)
            && self.is_far(&new.map(|triangle| (f, triangle)), &[0.5 * (p + q)])
        {
            self.counts.refuse(Refused::Far);
            return false;
        }
        if self.mesh.flip_edge(e).is_err() {
            return false;
        }
        for (v, change) in [(a, -1), (b, -1), (c, 1), (d, 1)] {
            valences[v.index()] += change;
        }
        true
    }
}
