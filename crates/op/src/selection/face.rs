//! Selections of faces.

use mesh::{DVec3, FaceId, MATERIAL, Mesh, VertexId, angle_between};

use super::{EdgeSelection, Select, VertexSelection, marks, touching, walk};
use crate::{AngleBetween, Context, MeshPlan, OpError, Range, Refusal, Vector};

selection! {
    /// Which faces.
    FaceSelection(
        "faces",
        inside: "Faces whose vertices all lie in a region, its surface included.",
        shares: "a vertex",
        nearest: "Those whose middles are nearest to a point; of equal distances the lower numbers."
    ) {
        /// Faces with a boundary edge.
        Boundary,
        /// Faces of these numbers; refused if one is not there.
        Faces(Vec<u32>),
        /// Faces with so many corners.
        Degree(u32),
        /// Faces of the material of this name; refused if the object has none of that name.
        Material(String),
        /// Faces with a corner in these vertices.
        FacesAround(Box<VertexSelection>),
        /// Faces beside these edges.
        FacesBeside(Box<EdgeSelection>),
        /// Faces that face a direction.
        Facing {
            /// Of any length but 0.
            direction: Vector,
            /// By how many degrees the normal may turn away from it.
            within: AngleBetween,
        },
        /// These, and the faces reached from them over edges that turn by at most an angle.
        Expand {
            /// In degrees, from 0 (flat) to 180.
            to_angle: AngleBetween,
            /// From which.
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
                        let n = mesh.n_faces();
                        let message = format!("there is no face {number}, only {n} faces");
                        return Err(OpError::refused(Refusal::Missing, message));
                    }
                    mask[f.index()] = true;
                }
                mask
            }
            Self::Degree(n) => marks::<Self>(mesh, |f| mesh.degree(f) == *n as usize),
            Self::Material(name) => {
                let Some(place) = cx.materials.iter().position(|m| m == name) else {
                    let known = cx.materials.join(", ");
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
