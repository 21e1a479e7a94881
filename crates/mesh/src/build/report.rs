//! What building did to polygons that are not a manifold as they stand.

use std::fmt;

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

    /// What was done, in one line, naming the first elements of each kind.
    pub fn summary(&self) -> String {
        let mut repairs = self.repairs();
        repairs.extend(self.dropped());
        let parts: Vec<String> = repairs.iter().map(ToString::to_string).collect();
        parts.join(", ")
    }

    /// What was done apart from leaving polygons out.
    pub fn repairs(&self) -> Vec<Repair> {
        let faces = |faces: &[usize]| Elements::Faces(faces.to_vec());
        let copied = self.split_vertices.iter().map(|&(v, _)| v).collect();
        let repairs = [
            Repair::new(
                "face reversed to agree with its neighbors",
                "faces reversed to agree with their neighbors",
                faces(&self.reversed_faces),
            ),
            Repair::new(
                "part has no consistent orientation",
                "parts have no consistent orientation",
                faces(&self.unorientable),
            ),
            Repair::new(
                "non-manifold edge split",
                "non-manifold edges split",
                Elements::Edges(self.split_edges.clone()),
            ),
            Repair::new(
                "copy made of a non-manifold vertex",
                "copies made of non-manifold vertices",
                Elements::Vertices(copied),
            ),
        ];
        repairs.into_iter().flatten().collect()
    }

    /// The polygons that were left out, if there are any.
    pub fn dropped(&self) -> Option<Repair> {
        Repair::new(
            "face left out that visits a vertex twice",
            "faces left out that visit a vertex twice",
            Elements::Faces(self.dropped_faces.clone()),
        )
    }
}

/// Something that was done to elements of the input.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Repair {
    /// What was done, as words that follow the number of elements.
    pub what: &'static str,
    /// To which elements, one or more.
    pub elements: Elements,
}

impl Repair {
    /// The repair of these elements, told in the singular or the plural; `None` if there are none.
    pub fn new(one: &'static str, several: &'static str, elements: Elements) -> Option<Self> {
        let what = if elements.len() == 1 { one } else { several };
        (elements.len() > 0).then_some(Self { what, elements })
    }
}

impl fmt::Display for Repair {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {} {}", self.elements.len(), self.what, self.elements)
    }
}

/// Elements that were given to [`build()`](crate::build()), by their places there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Elements {
    /// Vertices.
    Vertices(Vec<VertexId>),
    /// Edges by their vertices.
    Edges(Vec<[VertexId; 2]>),
    /// Faces, from 0.
    Faces(Vec<usize>),
}

impl Elements {
    /// How many there are.
    #[expect(
        clippy::len_without_is_empty,
        reason = "they are never none where they are told"
    )]
    pub fn len(&self) -> usize {
        match self {
            Self::Vertices(list) => list.len(),
            Self::Edges(list) => list.len(),
            Self::Faces(list) => list.len(),
        }
    }
}

/// The first few, in parentheses: `(face 3)`, `(v0, v7)`.
impl fmt::Display for Elements {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        const SHOWN: usize = 5;
        let mut words: Vec<String> = match self {
            Self::Vertices(list) => list.iter().take(SHOWN).map(ToString::to_string).collect(),
            Self::Edges(list) => list
                .iter()
                .take(SHOWN)
                .map(|[v, w]| format!("{v}-{w}"))
                .collect(),
            Self::Faces(list) => list.iter().take(SHOWN).map(ToString::to_string).collect(),
        };
        if self.len() > SHOWN {
            words.push("..".to_owned());
        }
        let kind = match self {
            Self::Faces(list) if list.len() == 1 => "face ",
            Self::Faces(_) => "faces ",
            Self::Vertices(_) | Self::Edges(_) => "",
        };
        write!(f, "({kind}{})", words.join(", "))
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
             1 part has no consistent orientation (face 4), \
             1 non-manifold edge split (v0-v1), \
             1 copy made of a non-manifold vertex (v2), \
             1 face left out that visits a vertex twice (face 5)"
        );
        report.split_edges.push([v(7), v(8)]);
        report.split_vertices.push((v(7), v(10)));
        report.reversed_faces.push(7);
        report.unorientable.push(7);
        report.dropped_faces.push(7);
        assert_eq!(
            report.summary(),
            "2 faces reversed to agree with their neighbors (faces 3, 7), \
             2 parts have no consistent orientation (faces 4, 7), \
             2 non-manifold edges split (v0-v1, v7-v8), \
             2 copies made of non-manifold vertices (v2, v7), \
             2 faces left out that visit a vertex twice (faces 5, 7)"
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
