//! Selections of vertices.

use mesh::{Mesh, VertexId};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{
    EdgeSelection, FaceSelection, Region, Select, Shared, marks, named_vertex, one, shared,
    shared_count, shared_mask,
};
use crate::{Context, MeshPlan, OpError, Range, Vector};

/// Which vertices.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum VertexSelection {
    /// Every vertex.
    #[default]
    All,
    /// Vertices with a boundary edge.
    Boundary,
    /// Vertices without edges.
    Isolated,
    /// Vertices of these numbers; refused if one is not there.
    Vertices(Vec<u32>),
    /// Vertices with so many edges.
    Valence(u32),
    /// The ends of these edges.
    EndsOf(Box<EdgeSelection>),
    /// The corners of these faces.
    CornersOf(FaceSelection),
    /// Vertices that lie in a region, its surface included.
    Inside(Region),
    /// Vertices marked by a tag of this name.
    Tagged(String),
    /// Vertices in all of these; every one for an empty list.
    And(Vec<Self>),
    /// Vertices in any of these; none for an empty list.
    Or(Vec<Self>),
    /// Vertices that are not in this.
    Not(Box<Self>),
    /// These, and those that share an edge with one of them.
    Grow(Box<Self>),
    /// Those of these that share an edge with no other one outside.
    Shrink(Box<Self>),
    /// All of the connected pieces of the mesh that one of these belongs to.
    Component(Box<Self>),
    /// Drawn by chance, the same for the same seed and step.
    Random {
        /// How many; all if there are fewer.
        count: u32,
        /// From which.
        #[serde(default)]
        of: Box<Self>,
        /// Another number gives another choice.
        seed: u64,
    },
    /// Those nearest to a point; of equal distances the lower numbers.
    Nearest {
        /// The point.
        to: Vector,
        /// How many; all if there are fewer.
        #[serde(default = "one")]
        count: u32,
        /// From which.
        #[serde(default)]
        of: Box<Self>,
    },
    /// These, but refused unless they are so many.
    Expect {
        /// How many there must be.
        count: u32,
        /// Of what.
        of: Box<Self>,
    },
}

impl VertexSelection {
    fn shared(&self) -> Option<Shared<'_, Self>> {
        shared!(self)
    }
}

impl Select for VertexSelection {
    type Id = VertexId;
    const WORD: &'static str = "vertices";

    fn mask(&self, mesh: &Mesh, cx: &Context) -> Result<Vec<bool>, OpError> {
        if let Some(shared) = self.shared() {
            return shared_mask(&shared, mesh, cx);
        }
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
            Self::EndsOf(edges) => {
                let mut mask = marks::<Self>(mesh, |_| false);
                for e in edges.resolve(mesh, cx)? {
                    mesh.edge_vertices(e)
                        .iter()
                        .for_each(|v| mask[v.index()] = true);
                }
                mask
            }
            Self::CornersOf(faces) => {
                let mut mask = marks::<Self>(mesh, |_| false);
                for f in faces.resolve(mesh, cx)? {
                    mesh.face_vertices(f).for_each(|v| mask[v.index()] = true);
                }
                mask
            }
            _ => unreachable!("the shared part is evaluated above"),
        })
    }

    fn count(&self, plan: &MeshPlan) -> Range {
        match self {
            Self::Vertices(numbers) => Range::at_most(numbers.len() as u64),
            _ => self.shared().map_or(plan.vertices.or_less(), |s| {
                shared_count(&s, plan.vertices, plan)
            }),
        }
    }

    fn elements(mesh: &Mesh) -> Vec<VertexId> {
        mesh.vertices().collect()
    }

    fn vertices(_: &Mesh, v: VertexId) -> Vec<VertexId> {
        vec![v]
    }
}
