//! Bevels all edges of a set together. If an earlier bevel has shortened an edge at one end, the module also computes
//! where the next bevel cuts the edge at the other end.

mod edges;
mod values;

use mesh::{EdgeId, FaceId, Mesh};

pub use edges::{BevelRefusal, Beveled, bevel_edges, shortest_edge_at};

/// The remaining lengths of edges, if several bevels cut them one after another. A position that is given as a fraction
/// of the original length of an edge is converted to a fraction of its current length. Therefore the result does not
/// depend on which end of an edge is cut first.
///
/// ```text
///    a---+---------------+---b      both cuts at a quarter of a-b: the second cut is at a third
///       1/4             3/4         of the length that the first cut left
/// ```
#[derive(Clone, Debug, Default)]
pub struct Cuts {
    /// For each edge index, the current length divided by the original length. Edges beyond the end of the list are
    /// uncut: their fraction is 1.
    remaining: Vec<f64>,
}

impl Cuts {
    /// Returns where the next bevel cuts the edge `e`. The result is the distance between the cut and the end that the
    /// bevel removes, divided by the current length of `e`. `fraction` is the same distance, divided by the length of
    /// `e` before all bevels. The result is 1 or more if the current length is too short for the cut.
    pub fn fraction(&self, e: EdgeId, fraction: f64) -> f64 {
        fraction / self.remaining.get(e.index()).unwrap_or(&1.0)
    }

    /// Records a bevel of a vertex or an edge. `new` is the face that the bevel added. Every edge that ends at a corner
    /// of `new`, but is not a side of `new`, was shortened by `fraction` of its original length.
    pub fn cut(&mut self, mesh: &Mesh, new: FaceId, fraction: f64) {
        for h in mesh.face_half_edges(new) {
            let e = mesh.next(h.twin()).edge();
            if self.remaining.len() <= e.index() {
                self.remaining.resize(e.index() + 1, 1.0);
            }
            self.remaining[e.index()] -= fraction;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;
    use mesh::VertexId;

    #[test]
    fn cuts_at_both_ends_of_an_edge_have_the_same_length() {
        let mut mesh = shapes::cube();
        let mut cuts = Cuts::default();
        for v in [0, 1].map(VertexId::new) {
            let new = mesh.bevel_vertex_with(v, |e| cuts.fraction(e, 0.375));
            cuts.cut(&mesh, new.unwrap(), 0.375);
        }
        let lengths = |length: f64| {
            let first_halves = (0..12).map(|e| EdgeId::new(e).half_edges()[0]);
            first_halves
                .filter(|&h| (mesh.length(h) - length).abs() < 1e-15)
                .count()
        };
        assert_eq!([lengths(0.5), lengths(1.25), lengths(2.0)], [1, 4, 7]);
    }

    #[test]
    fn half_an_edge_can_be_cut_from_one_end_only() {
        let mut mesh = shapes::cube();
        let mut cuts = Cuts::default();
        let new = mesh.bevel_vertex(VertexId::new(0), 0.5).unwrap();
        cuts.cut(&mesh, new, 0.5);
        let h = mesh.face_half_edge(new);
        assert_eq!(cuts.fraction(mesh.next(h.twin()).edge(), 0.5), 1.0);
        assert_eq!(cuts.fraction(h.edge(), 0.5), 0.5);
    }
}
