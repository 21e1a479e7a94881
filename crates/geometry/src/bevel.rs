//! Fractions of edges that are cut from both ends.

use mesh::{EdgeId, FaceId, Mesh};

/// What is left of edges that bevels cut, so that their fractions can be those of the lengths from before
/// the step, in whatever order the ends of an edge come.
///
/// ```text
///    a---+---------------+---b      both cuts at a quarter of a-b: the second one at a third of what
///       1/4             3/4         the first one left
/// ```
#[derive(Clone, Debug, Default)]
pub struct Cuts {
    /// By index of the edge; 1 where there is none.
    left: Vec<f64>,
}

impl Cuts {
    /// The fraction of what is left of `e` that is `fraction` of it at the beginning; 1 or more if there is
    /// not so much left.
    pub fn fraction(&self, e: EdgeId, fraction: f64) -> f64 {
        fraction / self.left.get(e.index()).unwrap_or(&1.0)
    }

    /// Takes `fraction` off the edges that end at the corners of `new`: the face that a bevel of a vertex or
    /// an edge has made.
    pub fn cut(&mut self, mesh: &Mesh, new: FaceId, fraction: f64) {
        for h in mesh.face_half_edges(new) {
            let e = mesh.next(h.twin()).edge();
            if self.left.len() <= e.index() {
                self.left.resize(e.index() + 1, 1.0);
            }
            self.left[e.index()] -= fraction;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;
    use mesh::VertexId;

    #[test]
    fn both_ends_are_cut_by_the_same_length() {
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
    fn too_large_fractions_do_not_fit_twice() {
        let mut mesh = shapes::cube();
        let mut cuts = Cuts::default();
        let new = mesh.bevel_vertex(VertexId::new(0), 0.5).unwrap();
        cuts.cut(&mesh, new, 0.5);
        let h = mesh.face_half_edge(new);
        assert_eq!(cuts.fraction(mesh.next(h.twin()).edge(), 0.5), 1.0);
        assert_eq!(cuts.fraction(h.edge(), 0.5), 0.5);
    }
}
