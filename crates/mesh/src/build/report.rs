//! What building did to polygons that are not a manifold as they stand.

use crate::VertexId;

/// What was done to make polygons a manifold. Empty lists: nothing.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct BuildReport {
    /// Pairs of vertices, lower first, with more than two sides between them or with two sides that
    /// run the same way.
    pub split_edges: Vec<[VertexId; 2]>,
    /// Vertices that joined several fans, each with the copy that one of the fans got.
    pub split_vertices: Vec<(VertexId, VertexId)>,
    /// Polygons that were turned round because their neighbors run the other way, by their place in
    /// the input, in order.
    pub reversed_faces: Vec<usize>,
    /// Of each connected part that has no consistent orientation, as a Moebius strip, the first
    /// polygon by its place in the input. Such a part is left as it is, and split.
    pub unorientable: Vec<usize>,
    /// Polygons that were left out, by their place in the input, in order.
    pub dropped_faces: Vec<usize>,
}

impl BuildReport {
    /// Whether nothing had to be done.
    pub fn is_clean(&self) -> bool {
        *self == Self::default()
    }

    /// What was done, in one line, naming the first element of each kind.
    pub fn summary(&self) -> String {
        let mut parts = self.changes();
        if let Some(f) = self.dropped_faces.first() {
            let what = match self.dropped_faces.len() {
                1 => format!("degenerate face left out (face {f})"),
                _ => format!("degenerate faces left out (first: face {f})"),
            };
            parts.push((self.dropped_faces.len(), what));
        }
        let parts = parts.iter().map(|(n, what)| format!("{n} {what}"));
        parts.collect::<Vec<_>>().join(", ")
    }

    /// What was done apart from leaving faces out: of each kind how many, and the words that follow
    /// the number.
    pub fn changes(&self) -> Vec<(usize, String)> {
        let mut parts = Vec::new();
        if let Some(f) = self.reversed_faces.first() {
            let what = match self.reversed_faces.len() {
                1 => format!("face reversed to agree with its neighbors (face {f})"),
                _ => format!("faces reversed to agree with their neighbors (first: face {f})"),
            };
            parts.push((self.reversed_faces.len(), what));
        }
        if let Some(f) = self.unorientable.first() {
            let what = match self.unorientable.len() {
                1 => format!("part has no consistent orientation (from face {f})"),
                _ => format!("parts have no consistent orientation (first: from face {f})"),
            };
            parts.push((self.unorientable.len(), what));
        }
        if let Some([v, w]) = self.split_edges.first() {
            let what = match self.split_edges.len() {
                1 => format!("non-manifold edge split ({v}-{w})"),
                _ => format!("non-manifold edges split (first {v}-{w})"),
            };
            parts.push((self.split_edges.len(), what));
        }
        if let Some((v, _)) = self.split_vertices.first() {
            let what = match self.split_vertices.len() {
                1 => format!("copy made of a non-manifold vertex ({v})"),
                _ => format!("copies made of non-manifold vertices (first {v})"),
            };
            parts.push((self.split_vertices.len(), what));
        }
        parts
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_is_told_in_the_singular_and_two_in_the_plural() {
        let v = VertexId::new;
        let mut report = BuildReport {
            split_edges: vec![[v(0), v(1)]],
            split_vertices: vec![(v(2), v(9))],
            reversed_faces: vec![3],
            unorientable: vec![4],
            dropped_faces: vec![5],
        };
        assert_eq!(
            report.summary(),
            "1 face reversed to agree with its neighbors (face 3), \
             1 part has no consistent orientation (from face 4), \
             1 non-manifold edge split (v0-v1), \
             1 copy made of a non-manifold vertex (v2), \
             1 degenerate face left out (face 5)"
        );
        report.split_edges.push([v(7), v(8)]);
        report.split_vertices.push((v(7), v(10)));
        report.reversed_faces.push(7);
        report.unorientable.push(7);
        report.dropped_faces.push(7);
        assert_eq!(
            report.summary(),
            "2 faces reversed to agree with their neighbors (first: face 3), \
             2 parts have no consistent orientation (first: from face 4), \
             2 non-manifold edges split (first v0-v1), \
             2 copies made of non-manifold vertices (first v2), \
             2 degenerate faces left out (first: face 5)"
        );
    }

    #[test]
    fn a_report_of_anything_is_not_clean() {
        let reversed = BuildReport {
            reversed_faces: vec![0],
            ..<_>::default()
        };
        assert!(!reversed.is_clean());
        assert!(BuildReport::default().is_clean());
        assert_eq!(BuildReport::default().summary(), "");
    }
}
