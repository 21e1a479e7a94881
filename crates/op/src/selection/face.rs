//! Selections of faces.

use geometry::surface_index::self_intersecting_faces;
use mesh::{DVec3, FaceId, MATERIAL, Mesh, VertexId, angle_between};

use super::{EdgeSelection, Select, VertexSelection, marks, missing_element, touching, walk};
use crate::{AngleBetween, Context, MeshPlan, OpError, Range, Refusal, Vector};

selection! {
    /// A selection of faces.
    FaceSelection(
        "faces",
        inside: "Faces whose vertices all lie in a region or on its surface.",
        inside_of: "The faces whose vertices are all inside",
        shares: "a vertex",
        nearest: "The faces whose centers (the means of their vertices) are nearest to a point. If faces are \
                  equally near, those with the lower ids are selected."
    ) {
        /// Faces with at least one boundary edge.
        Boundary,
        /// The faces with these ids. Refused if a face does not exist.
        Faces(Vec<u32>),
        /// Faces with this number of corners.
        Degree(u32),
        /// Faces that intersect another face of the object. Two adjacent faces count as intersecting only if they share
        /// points other than their common vertices and edges. Vertices at the same position count as the same vertex.
        SelfIntersecting,
        /// Faces with the material of this name. Refused if the object has no material of this name.
        Material(String),
        /// Faces with at least one corner among these vertices.
        FacesAround(Box<VertexSelection>),
        /// Faces with at least one of these edges.
        FacesBeside(Box<EdgeSelection>),
        /// Faces whose normals differ from a direction by at most the angle `within`.
        Facing {
            /// The direction. The length of the direction does not matter; a zero vector selects no faces.
            direction: Vector,
            /// The largest angle between the normal and the direction, in degrees.
            within: AngleBetween,
        },
        /// The given faces, and all faces that are connected to them across nearly flat edges. At a nearly flat edge,
        /// the normals of the two faces differ by at most the angle `to_angle`.
        Expand {
            /// The largest angle between the normals of two neighboring faces, in degrees, from 0 (flat) to 180.
            to_angle: AngleBetween,
            /// The faces to start from.
            of: Box<Self>,
        },
    }
}

impl Select for FaceSelection {
    type Id = FaceId;
    const WORD: &'static str = "faces";

    fn mask(&self, mesh: &Mesh, cx: &Context) -> Result<Vec<bool>, OpError> {
        Ok(match self {
            Self::Boundary => marks::<Self>(mesh, |f| {
                mesh.face_half_edges(f)
                    .any(|h| mesh.face(h.twin()).is_none())
            }),
            Self::Faces(numbers) => {
                let mut mask = marks::<Self>(mesh, |_| false);
                for &number in numbers {
                    let f = FaceId::new((number as usize).min(u32::MAX as usize - 1));
                    if !mesh.has_face(f) {
                        return Err(missing_element(number, "face", mesh.n_faces()));
                    }
                    mask[f.index()] = true;
                }
                mask
            }
            Self::Degree(n) => marks::<Self>(mesh, |f| mesh.degree(f) == *n as usize),
            Self::SelfIntersecting => {
                let mut mask = marks::<Self>(mesh, |_| false);
                for f in self_intersecting_faces(mesh, cx.progress())? {
                    mask[f.index()] = true;
                }
                mask
            }
            Self::Material(name) => {
                let Some(place) = cx.materials.iter().position(|m| m == name) else {
                    let known = cx.materials.join(", ");
                    let known = if known.is_empty() { "none" } else { &known };
                    let message = format!("no material is named \"{name}\"; materials: {known}");
                    return Err(OpError::refused(Refusal::Missing, message));
                };
                let of_face = mesh.get(MATERIAL).unwrap_or_default();
                marks::<Self>(mesh, |f| {
                    of_face
                        .get(f.index())
                        .is_some_and(|&m| usize::try_from(m) == Ok(place))
                })
            }
            Self::FacesAround(vertices) => touching::<Self>(mesh, &vertices.mask(mesh, cx)?),
            Self::FacesBeside(edges) => {
                let sides = edges.mask(mesh, cx)?;
                marks::<Self>(mesh, |f| {
                    mesh.face_half_edges(f).any(|h| sides[h.edge().index()])
                })
            }
            Self::Facing { direction, within } => {
                let direction = DVec3::from(*direction);
                marks::<Self>(mesh, |f| {
                    let normal = mesh.face_normal(f);
                    let turn = angle_between(normal, direction).to_degrees();
                    normal != DVec3::ZERO && direction != DVec3::ZERO && turn <= within.get()
                })
            }
            Self::Expand { to_angle, of } => walk::spread(mesh, of.mask(mesh, cx)?, to_angle.get()),
            _ => self.shared().mask(mesh, cx)?,
        })
    }

    fn count(&self, plan: &MeshPlan) -> Range {
        match self {
            Self::Faces(numbers) => Range::at_most(numbers.len() as u64),
            _ => self.shared().count(plan.faces, plan),
        }
    }

    fn elements(mesh: &Mesh) -> impl Iterator<Item = FaceId> {
        mesh.faces()
    }

    fn vertices(mesh: &Mesh, f: FaceId) -> impl Iterator<Item = VertexId> {
        mesh.face_vertices(f)
    }
}
