//! Builds the connectivity arrays of the next subdivision level, edge by edge and face by face.

use mesh::{Connectivity, FaceId, HalfEdgeId};

use super::closure::Cut;
use super::pieces::Pieces;
use super::sides;
use crate::links;

/// The arrays of the next level while they are filled.
pub(super) struct ConnectivityBuilder<'a> {
    pieces: &'a Pieces<'a>,
    pub(super) new: Connectivity,
    /// The half-edges of the face that is being built.
    ring: Vec<HalfEdgeId>,
}

impl<'a> ConnectivityBuilder<'a> {
    /// Allocates the arrays and fills in the vertices, the parts of old edges and the boundary loops.
    pub(super) fn with_edges(pieces: &'a Pieces<'a>) -> Self {
        let (mesh, mut new) = (pieces.mesh, links::zeroed(pieces.counts()));
        for v in mesh.vertices() {
            let leaving = mesh.vertex_half_edge(v);
            new.vertex_half_edge[v.index()] = leaving.map_or(HalfEdgeId::NONE, |h| pieces.first(h));
        }
        for h in mesh.half_edges() {
            let (first, is_cut) = (pieces.first(h), pieces.is_cut(h.edge()));
            new.origin[first.index()] = mesh.origin(h);
            let mut last = first;
            if is_cut {
                last = pieces.second(h);
                let m = pieces.on_edge(h.edge());
                new.origin[last.index()] = m;
                // The new vertex m on the old edge stores a half-edge that leaves it. If the second half-edge of the
                // old edge has no face, m stores the second part of that half-edge; otherwise, m stores the second part
                // of the first half-edge.
                if h.index().is_multiple_of(2) || mesh.face(h).is_none() {
                    new.vertex_half_edge[m.index()] = last;
                }
            }
            if mesh.face(h).is_none() {
                for part in pieces.parts_of(h) {
                    new.face[part.index()] = FaceId::NONE;
                }
                new.next[first.index()] = last;
                new.next[last.index()] = pieces.first(mesh.next(h));
            }
        }
        let ring = Vec::new();
        Self { pieces, new, ring }
    }

    /// Links the half-edges of `ring` around the face `f`, whose first half-edge is `ring[start]`, and clears `ring`.
    fn close(&mut self, f: FaceId, start: usize) {
        let next = self.ring.iter().cycle().skip(1);
        for (h, &next) in self.ring.iter().zip(next) {
            self.new.next[h.index()] = next;
            self.new.face[h.index()] = f;
        }
        self.new.face_half_edge[f.index()] = self.ring[start];
        self.ring.clear();
    }

    /// Adds a face that is not cut.
    pub(super) fn keep(&mut self, f: usize) {
        let pieces = self.pieces;
        let mut hanging = 0;
        for h in sides(pieces.mesh, f) {
            self.ring.extend(pieces.parts_of(h));
            if pieces.is_cut(h.edge()) {
                hanging = self.ring.len() - 1;
            }
        }
        let start = match pieces.cuts[f] {
            Cut::Hanging => hanging,
            _ => 0,
        };
        self.close(pieces.part(f, 0), start);
    }

    /// Cuts a triangle with a hanging vertex in two: first the part at b, then the part at a (see the figure
    /// in `pieces.rs`).
    pub(super) fn cut_in_two(&mut self, f: usize) {
        let pieces = self.pieces;
        let [side_bc, side_ca, side_ab] = pieces.three_sides(f);
        let across = pieces.inner(f, 0);
        let mesh = pieces.mesh;
        self.new.origin[across.index()] = mesh.origin(side_ca.to);
        self.new.origin[across.twin().index()] = mesh.origin(side_ab.from);
        let triangles = [
            [side_ab.from, side_bc.to].map(|h| pieces.first(h)),
            [side_ca.to, side_ab.to].map(|h| pieces.first(h)),
        ];
        for (k, [first, second]) in triangles.into_iter().enumerate() {
            let third = if k == 0 { across } else { across.twin() };
            self.ring.extend([first, second, third]);
            self.close(pieces.part(f, k), 0);
        }
    }

    /// Cuts a triangle into four: first the parts at the corners, then the part in the middle.
    pub(super) fn cut_into_four(&mut self, f: usize) {
        let pieces = self.pieces;
        let sides = pieces.three_sides(f);
        for k in 0..3 {
            let before = sides[(k + 2) % 3];
            let across = pieces.inner(f, k);
            self.new.origin[across.index()] = pieces.middle(sides[k]);
            self.new.origin[across.twin().index()] = pieces.middle(before);
            pieces.to_middle(sides[k], &mut self.ring);
            let n_to = self.ring.len();
            self.ring.push(across);
            pieces.push_ring_from_middle(before, &mut self.ring);
            // If the ring of half-edges has two parts of the same half-edge, a hanging vertex lies between these parts.
            // In this case, the first half-edge of the face starts at the hanging vertex.
            let start = match (n_to, self.ring.len() - n_to) {
                (2, _) => 1,
                (_, 3) => 3,
                _ => 0,
            };
            self.close(pieces.part(f, k), start);
        }
        let middle = [0, 1, 2].map(|k| pieces.inner(f, k).twin());
        self.ring.extend(middle);
        self.close(pieces.part(f, 3), 0);
    }

    /// Cuts a face into quads, one for each corner.
    pub(super) fn cut_into_quads(&mut self, f: usize) {
        let pieces = self.pieces;
        let center = pieces.center(f);
        let n = pieces.mesh.degree(FaceId::new(f));
        self.new.vertex_half_edge[center.index()] = pieces.inner(f, 0).twin();
        let mut h_before = pieces.mesh.prev(pieces.mesh.face_half_edge(FaceId::new(f)));
        for (k, h) in sides(pieces.mesh, f).enumerate() {
            let before = (k + n - 1) % n;
            let (out, back) = (pieces.inner(f, k), pieces.inner(f, before).twin());
            self.new.origin[out.index()] = pieces.on_edge(h.edge());
            self.new.origin[back.index()] = center;
            let ring = [pieces.first(h), out, back, pieces.second(h_before)];
            self.ring.extend(ring);
            self.close(pieces.part(f, k), 0);
            h_before = h;
        }
    }
}
