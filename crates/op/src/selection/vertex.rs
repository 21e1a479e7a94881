//! Selections of vertices.

use std::iter;

use mesh::{Mesh, VertexId};

use super::{EdgeSelection, FaceSelection, Select, marks, named_vertex, touched};
use crate::{Context, MeshPlan, OpError, Range};

selection! {
    /// A selection of vertices.
    VertexSelection(
        "vertices",
        inside: "Vertices in a region or on its surface.",
        inside_of: "The vertices inside",
        shares: "an edge",
        nearest: "The vertices nearest to a point. If vertices are equally near, those with the lower \
                  ids are selected."
    ) {
        /// Vertices with a boundary edge, which is an edge with a face on one side only.
        Boundary,
        /// Isolated vertices: vertices without edges.
        Isolated,
        /// The vertices with these ids. Refused if a vertex does not exist.
        Vertices(Vec<u32>),
        /// Vertices with this number of edges.
        Valence(u32),
        /// The ends of these edges.
        EndsOf(Box<EdgeSelection>),
        /// The corners of these faces.
        CornersOf(FaceSelection),
    }
}

impl Select for VertexSelection {
    type Id = VertexId;
    const WORD: &'static str = "vertices";

    fn mask(&self, mesh: &Mesh, cx: &Context) -> Result<Vec<bool>, OpError> {
        Ok(match self {
            Self::Boundary => marks::<Self>(mesh, |v| mesh.is_boundary_vertex(v)),
            Self::Isolated => marks::<Self>(mesh, |v| mesh.vertex_half_edge(v).is_none()),
            Self::Vertices(numbers) => {
                let mut mask = marks::<Self>(mesh, |_| false);
                for &number in numbers {
                    mask[named_vertex(mesh, number)?.index()] = true;
                }
                mask
            }
            Self::Valence(n) => marks::<Self>(mesh, |v| mesh.valence(v) == *n as usize),
            Self::EndsOf(edges) => touched::<EdgeSelection>(mesh, &edges.mask(mesh, cx)?),
            Self::CornersOf(faces) => touched::<FaceSelection>(mesh, &faces.mask(mesh, cx)?),
            _ => self.shared().mask(mesh, cx)?,
        })
    }

    fn count(&self, plan: &MeshPlan) -> Range {
        match self {
            Self::Vertices(numbers) => Range::at_most(numbers.len() as u64),
            _ => self.shared().count(plan.vertices, plan),
        }
    }

    fn elements(mesh: &Mesh) -> impl Iterator<Item = VertexId> {
        mesh.vertices()
    }

    fn vertices(_: &Mesh, v: VertexId) -> impl Iterator<Item = VertexId> {
        iter::once(v)
    }
}
