//! The ids of mesh elements: plain numbers, with one type for each kind of element.

use std::fmt;

use bytemuck::{Pod, Zeroable};

/// The interface that the four kinds of ids share.
pub trait Id:
    Copy + Ord + fmt::Display + fmt::Debug + Pod + Send + Sync + Into<Element> + 'static
{
    /// The value that marks a missing element in the arrays of a [`Connectivity`](crate::Connectivity). Accessors
    /// return an `Option` instead of this value.
    const NONE: Self;

    /// The domain of the attribute columns that are indexed by ids of this kind. For half-edges, this is
    /// [`Domain::Corner`]: a half-edge stands for the corner of its face at the vertex that the half-edge leaves.
    const DOMAIN: Domain;

    /// Creates the id with this index.
    ///
    /// # Panics
    ///
    /// Panics if `index` is not below 2³² − 1. The edits and builders of this crate check the number of elements
    /// first.
    fn new(index: usize) -> Self;

    /// Returns the index of the element in the arrays of the mesh.
    fn index(self) -> usize;
}

macro_rules! id {
    ($(#[$doc:meta])* $name:ident, $letter:literal, $domain:ident, $element:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Pod, Zeroable)]
        #[repr(transparent)]
        pub struct $name(u32);

        impl $name {
            /// The value that marks a missing element in the arrays of a [`Connectivity`](crate::Connectivity).
            /// Accessors return an `Option` instead of this value.
            pub const NONE: Self = Self(u32::MAX);

            /// Creates the id with this index.
            ///
            /// # Panics
            ///
            /// Panics if `index` is not below 2³² − 1. The edits and builders of this crate check the number of
            /// elements first.
            #[inline]
            pub fn new(index: usize) -> Self {
                assert!(index < u32::MAX as usize, "more than 2^32 - 2 elements of one kind");
                #[expect(clippy::cast_possible_truncation, reason = "checked above")]
                Self(index as u32)
            }

            /// Returns the index of the element in the arrays of the mesh.
            #[inline]
            pub const fn index(self) -> usize {
                self.0 as usize
            }

            /// Returns the id as an `Option`: `None` for [`Self::NONE`].
            #[inline]
            pub fn some(self) -> Option<Self> {
                (self != Self::NONE).then_some(self)
            }
        }

        impl Id for $name {
            const NONE: Self = Self::NONE;
            const DOMAIN: Domain = Domain::$domain;

            #[inline]
            fn new(index: usize) -> Self {
                Self::new(index)
            }

            #[inline]
            fn index(self) -> usize {
                self.index()
            }
        }

        impl From<$name> for Element {
            fn from(id: $name) -> Self {
                Self::$element(id)
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                if *self == Self::NONE {
                    write!(f, concat!($letter, "-"))
                } else {
                    write!(f, concat!($letter, "{}"), self.0)
                }
            }
        }

        impl fmt::Debug for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                fmt::Display::fmt(self, f)
            }
        }
    };
}

id!(
    /// A vertex. Displayed as the letter v and the index, such as `v12`.
    VertexId, "v", Vertex, Vertex
);
id!(
    /// A half-edge: an edge seen from one of its sides, with a direction. Displayed as the letter h and the index, such
    /// as `h12`.
    ///
    /// Edge e consists of the half-edges 2e and 2e + 1.
    HalfEdgeId, "h", Corner, HalfEdge
);
id!(
    /// An edge: a pair of half-edges. Displayed as the letter e and the index, such as `e12`.
    EdgeId, "e", Edge, Edge
);
id!(
    /// A face: a polygon with any number of corners. Displayed as the letter f and the index, such as `f12`.
    FaceId, "f", Face, Face
);

impl HalfEdgeId {
    /// Returns the other half-edge of the same edge.
    #[inline]
    #[must_use]
    pub const fn twin(self) -> Self {
        Self(self.0 ^ 1)
    }

    /// Returns the edge of this half-edge.
    #[inline]
    pub const fn edge(self) -> EdgeId {
        EdgeId(self.0 >> 1)
    }
}

impl EdgeId {
    /// Returns the first half-edge of the edge. The second half-edge is its twin.
    #[inline]
    pub const fn half_edge(self) -> HalfEdgeId {
        HalfEdgeId(self.0 << 1)
    }

    /// Returns both half-edges of the edge.
    #[inline]
    pub const fn half_edges(self) -> [HalfEdgeId; 2] {
        [HalfEdgeId(self.0 << 1), HalfEdgeId(self.0 << 1 | 1)]
    }
}

/// The kind of element to which the values of an attribute column belong.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Domain {
    /// One value for each vertex.
    Vertex,
    /// One value for each half-edge. The half-edge represents the corner of its face at the vertex that the half-edge
    /// leaves.
    Corner,
    /// One value for each edge.
    Edge,
    /// One value for each face.
    Face,
}

impl Domain {
    /// All four domains.
    pub const ALL: [Self; 4] = [Self::Vertex, Self::Corner, Self::Edge, Self::Face];
}

impl fmt::Display for Domain {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Vertex => "vertex",
            Self::Corner => "corner",
            Self::Edge => "edge",
            Self::Face => "face",
        })
    }
}

/// One element of a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Element {
    /// A vertex.
    Vertex(VertexId),
    /// A half-edge, or the corner at its origin.
    HalfEdge(HalfEdgeId),
    /// An edge.
    Edge(EdgeId),
    /// A face.
    Face(FaceId),
}

/// Writes the id, such as `e7`.
impl fmt::Display for Element {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Vertex(v) => v.fmt(f),
            Self::HalfEdge(h) => h.fmt(f),
            Self::Edge(e) => e.fmt(f),
            Self::Face(face) => face.fmt(f),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_id_takes_four_bytes() {
        assert_eq!(size_of::<VertexId>(), 4);
        assert_eq!(size_of::<HalfEdgeId>(), 4);
        assert_eq!(size_of::<EdgeId>(), 4);
        assert_eq!(size_of::<FaceId>(), 4);
    }

    #[test]
    fn the_halves_of_an_edge_are_twins() {
        let [a, b] = EdgeId::new(7).half_edges();
        assert_eq!((a.twin(), b.twin()), (b, a));
        assert_eq!((a.edge(), b.edge()), (EdgeId::new(7), EdgeId::new(7)));
    }

    #[test]
    fn ids_are_shown_with_their_letter() {
        assert_eq!(
            format!("{} {:?} {}", VertexId::new(3), FaceId::new(0), EdgeId::NONE),
            "v3 f0 e-"
        );
    }
}
