//! Reports how polygons were repaired to form a manifold.

use std::fmt;

use crate::VertexId;

/// The repairs that made polygons a manifold. All lists are empty if no repair was necessary.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct BuildReport {
    /// The edges that more than two polygons shared, or along which two polygons ran in the same direction. Each edge
    /// is a pair of vertices, the lower one first.
    pub split_edges: Vec<[VertexId; 2]>,
    /// The vertices whose faces formed several fans. Each entry is a pair of a vertex and one of its copies. Each fan
    /// except the first got a separate copy of the vertex.
    pub split_vertices: Vec<(VertexId, VertexId)>,
    /// The indices, in ascending order, of the polygons that were reversed to agree with the orientation of their
    /// neighbors.
    pub reversed_faces: Vec<usize>,
    /// For each connected part without a consistent orientation, such as a Moebius strip, the index of
    /// its first polygon. The polygons of these parts are not reversed. Edges along which two polygons
    /// run in the same direction are split.
    pub unorientable: Vec<usize>,
    /// The indices, in ascending order, of the polygons that were dropped.
    pub dropped_faces: Vec<usize>,
}

impl BuildReport {
    /// Whether no repair was necessary.
    pub fn is_clean(&self) -> bool {
        *self == Self::default()
    }

    /// Describes all repairs in one line of text. For each kind of repair, the text lists the first repaired elements.
    pub fn summary(&self) -> String {
        let mut repairs = self.repairs();
        repairs.extend(self.dropped());
        let parts: Vec<String> = repairs.iter().map(ToString::to_string).collect();
        parts.join(", ")
    }

    /// Returns all repairs except dropped polygons.
    pub fn repairs(&self) -> Vec<Repair> {
        let faces = |faces: &[usize]| Elements::Faces(faces.to_vec());
        let mut split: Vec<VertexId> = self.split_vertices.iter().map(|&(v, _)| v).collect();
        // A vertex with several copies is listed once.
        split.sort_unstable();
        split.dedup();
        let repairs = [
            Repair::new(
                "faces-reversed",
                "face reversed to agree with its neighbors",
                "faces reversed to agree with their neighbors",
                faces(&self.reversed_faces),
            ),
            Repair::new(
                "parts-unorientable",
                "part has no consistent orientation",
                "parts have no consistent orientation",
                faces(&self.unorientable),
            ),
            Repair::new(
                "edges-split",
                "non-manifold edge split",
                "non-manifold edges split",
                Elements::Edges(self.split_edges.clone()),
            ),
            Repair::new(
                "vertices-split",
                "non-manifold vertex split",
                "non-manifold vertices split",
                Elements::Vertices(split),
            ),
        ];
        repairs.into_iter().flatten().collect()
    }

    /// Returns the dropped polygons, if there are any.
    pub fn dropped(&self) -> Option<Repair> {
        Repair::new(
            "faces-dropped",
            "face dropped because it has fewer than 3 corners or contains a vertex twice",
            "faces dropped because they have fewer than 3 corners or contain a vertex twice",
            Elements::Faces(self.dropped_faces.clone()),
        )
    }
}

/// A repair of some elements of the input.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Repair {
    /// A stable name for the kind of repair, such as `faces-reversed`. Programs can rely on this name.
    pub code: &'static str,
    /// The text that follows the number of elements, such as "non-manifold edges split".
    pub description: &'static str,
    /// The repaired elements, at least one.
    pub elements: Elements,
}

impl Repair {
    /// Creates the repair of these elements. The description is the singular or the plural text, depending on the
    /// number of elements. Returns `None` if the list is empty.
    pub fn new(
        code: &'static str,
        singular: &'static str,
        plural: &'static str,
        elements: Elements,
    ) -> Option<Self> {
        let description = if elements.len() == 1 {
            singular
        } else {
            plural
        };
        (elements.len() > 0).then_some(Self {
            code,
            description,
            elements,
        })
    }
}

impl fmt::Display for Repair {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            description,
            elements,
            ..
        } = self;
        write!(f, "{} {description} {elements}", elements.len())
    }
}

/// Elements of the input of [`build()`](crate::build()).
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Elements {
    /// Vertices.
    Vertices(Vec<VertexId>),
    /// Edges, as pairs of their vertices.
    Edges(Vec<[VertexId; 2]>),
    /// Faces, as their indices.
    Faces(Vec<usize>),
}

impl Elements {
    /// Returns the number of elements.
    #[expect(
        clippy::len_without_is_empty,
        reason = "the list of the elements of a repair is never empty"
    )]
    pub fn len(&self) -> usize {
        match self {
            Self::Vertices(list) => list.len(),
            Self::Edges(list) => list.len(),
            Self::Faces(list) => list.len(),
        }
    }
}

/// Writes up to five elements in parentheses, such as `(face 3)` or `(v0, v7)`, and `..` if there are more.
impl fmt::Display for Elements {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        const MAX_SHOWN: usize = 5;
        let mut words: Vec<String> = match self {
            Self::Vertices(list) => list
                .iter()
                .take(MAX_SHOWN)
                .map(ToString::to_string)
                .collect(),
            Self::Edges(list) => list
                .iter()
                .take(MAX_SHOWN)
                .map(|[v, w]| format!("{v}-{w}"))
                .collect(),
            Self::Faces(list) => list
                .iter()
                .take(MAX_SHOWN)
                .map(ToString::to_string)
                .collect(),
        };
        if self.len() > MAX_SHOWN {
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
    fn summaries_use_singular_and_plural() {
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
             1 non-manifold vertex split (v2), \
             1 face dropped because it has fewer than 3 corners or contains a vertex twice (face 5)"
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
             2 non-manifold vertices split (v2, v7), \
             2 faces dropped because they have fewer than 3 corners or contain a vertex twice (faces 5, 7)"
        );
    }

    #[test]
    fn a_report_with_repairs_is_not_clean() {
        let reversed = BuildReport {
            reversed_faces: vec![0],
            ..<_>::default()
        };
        assert!(!reversed.is_clean());
        assert!(BuildReport::default().is_clean());
        assert_eq!(BuildReport::default().summary(), "");
    }
}
