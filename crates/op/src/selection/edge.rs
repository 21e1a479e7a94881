//! Selections of edges.

use mesh::{EdgeId, Mesh, VertexId};

use super::{
    FaceSelection, Select, VertexSelection, lowest, marks, named_vertex, note_if_fewer, touching,
    walk,
};
use crate::{AngleBetween, Context, Length, MeshPlan, OpError, Range, Refusal};

selection! {
    /// A selection of edges.
    EdgeSelection(
        "edges",
        inside: "Edges whose vertices all lie in a region or on its surface.",
        inside_of: "The edges whose vertices are all inside",
        shares: "a vertex",
        nearest: "The edges whose midpoints are nearest to a point. If edges are equally near, those with the \
                  lower ids are selected."
    ) {
        /// Boundary edges: edges with a face on one side only.
        Boundary,
        /// The edge that joins the two vertices with these ids. Refused if no edge joins these two vertices.
        Between(u32, u32),
        /// Edges at which the normals of the two faces differ by more than the angle `above`.
        Sharp {
            /// The lower limit of the angle between the normals, in degrees, from 0 (flat) to 180. Boundary edges have
            /// no angle and are never sharp.
            above: AngleBetween,
        },
        /// Edges at which the normals of the two faces differ by less than the angle `below`.
        Flat {
            /// The upper limit of the angle between the normals, in degrees, from 0 (flat) to 180. Boundary edges have
            /// no angle and are never flat.
            below: AngleBetween,
        },
        /// Edges whose length is greater than `than`.
        Longer {
            /// The length, in scene units.
            than: Length,
        },
        /// Edges whose length is less than `than`.
        Shorter {
            /// The length, in scene units.
            than: Length,
        },
        /// The edges of these faces.
        EdgesOf(FaceSelection),
        /// Edges with at least one end among these vertices.
        EdgesAround(VertexSelection),
        /// Edges with both ends among these vertices.
        EdgesWithin(VertexSelection),
        /// The given edges and all edge loops through them. At an interior vertex with four edges, an edge loop
        /// continues with the opposite edge. At all other vertices, the loop ends. An edge loop that starts at a
        /// boundary edge follows the boundary instead.
        EdgeLoop(Box<Self>),
        /// The given edges and all edge rings through them. In a face with four corners, an edge ring passes from an
        /// edge to the opposite edge. The ring ends at the boundary, and at faces that do not have four corners.
        EdgeRing(Box<Self>),
        /// The shortest path along edges from one vertex to another. Refused if no path exists.
        Path {
            /// The id of the first vertex.
            from: u32,
            /// The id of the last vertex.
            to: u32,
        },
        /// The `count` longest edges of the selection `of`. If several edges have the same length, the edges with the
        /// lowest ids are chosen.
        Longest {
            /// The number of edges. If fewer are available, all are selected.
            #[serde(default = "super::one")]
            count: u32,
            /// The selection to choose from.
            #[serde(default)]
            of: Box<Self>,
        },
    }
}

impl EdgeSelection {
    /// Converts the parameter `at` of a recipe to a position on the edge `e`. The position is 0 at the origin of the
    /// first half-edge of `e` and 1 at the other end. With the selection `Between(v, w)`, `at` is 0 at v and 1 at w.
    /// With every other selection, `at` is 0 at the end whose vertex has the lower id. If the edge does not exist,
    /// returns `at` unchanged, because the edit will refuse the edge later.
    pub fn place_on(&self, mesh: &Mesh, e: EdgeId, at: f64) -> f64 {
        if !mesh.has_edge(e) {
            return at;
        }
        let [a, b] = mesh.edge_vertices(e);
        let start = match self {
            Self::Between(v, _) => *v as usize,
            _ => a.min(b).index(),
        };
        if start == a.index() { at } else { 1.0 - at }
    }
}

impl Select for EdgeSelection {
    type Id = EdgeId;
    const WORD: &'static str = "edges";

    fn mask(&self, mesh: &Mesh, cx: &Context) -> Result<Vec<bool>, OpError> {
        let length = |e: EdgeId| mesh.length(e.half_edge());
        Ok(match self {
            Self::Boundary => marks::<Self>(mesh, |e| mesh.is_boundary_edge(e)),
            Self::Between(v, w) => {
                let (a, b) = (named_vertex(mesh, *v)?, named_vertex(mesh, *w)?);
                let Some(h) = mesh.find_half_edge(a, b) else {
                    let message = format!("no edge joins vertices {v} and {w}");
                    return Err(OpError::refused(Refusal::Missing, message).about([a, b]));
                };
                marks::<Self>(mesh, |e| e == h.edge())
            }
            Self::Sharp { above } => {
                let angle = mesh.dihedral_angles();
                marks::<Self>(mesh, |e| {
                    angle(e).is_some_and(|a| a.to_degrees() > above.get())
                })
            }
            Self::Flat { below } => {
                let angle = mesh.dihedral_angles();
                marks::<Self>(mesh, |e| {
                    angle(e).is_some_and(|a| a.to_degrees() < below.get())
                })
            }
            Self::Longer { than } => marks::<Self>(mesh, |e| length(e) > than.get()),
            Self::Shorter { than } => marks::<Self>(mesh, |e| length(e) < than.get()),
            Self::EdgesOf(faces) => {
                let faces = faces.mask(mesh, cx)?;
                marks::<Self>(mesh, |e| {
                    mesh.edge_faces(e)
                        .into_iter()
                        .flatten()
                        .any(|f| faces[f.index()])
                })
            }
            Self::EdgesAround(vertices) => touching::<Self>(mesh, &vertices.mask(mesh, cx)?),
            Self::EdgesWithin(vertices) => {
                let ends = vertices.mask(mesh, cx)?;
                marks::<Self>(mesh, |e| {
                    mesh.edge_vertices(e).iter().all(|v| ends[v.index()])
                })
            }
            Self::EdgeLoop(of) => walk::edge_loops(mesh, &of.resolve(mesh, cx)?),
            Self::EdgeRing(of) => walk::edge_rings(mesh, &of.resolve(mesh, cx)?),
            Self::Path { from, to } => {
                let (from, to) = (named_vertex(mesh, *from)?, named_vertex(mesh, *to)?);
                let mut mask = marks::<Self>(mesh, |_| false);
                for e in walk::shortest_path(mesh, from, to)? {
                    mask[e.index()] = true;
                }
                mask
            }
            Self::Longest { count, of } => {
                let mask = of.mask(mesh, cx)?;
                note_if_fewer::<Self>("Longest", *count, &mask, cx);
                lowest::<Self, f64>(mesh, *count, &mask, |e| -length(e))
            }
            _ => self.shared().mask(mesh, cx)?,
        })
    }

    fn count(&self, plan: &MeshPlan) -> Range {
        match self {
            Self::Between(..) => Range::exactly(1),
            Self::Longest { count, of } => of.count(plan).capped(u64::from(*count)),
            _ => self.shared().count(plan.edges, plan),
        }
    }

    fn elements(mesh: &Mesh) -> impl Iterator<Item = EdgeId> {
        mesh.edges()
    }

    fn vertices(mesh: &Mesh, e: EdgeId) -> impl Iterator<Item = VertexId> {
        mesh.edge_vertices(e).into_iter()
    }
}
