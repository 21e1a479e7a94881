//! Selections of faces.

use mesh::{DVec3, FaceId, MATERIAL, Mesh, VertexId, angle_between};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{
    EdgeSelection, Region, Select, Shared, VertexSelection, marks, one, shared, shared_count,
    shared_mask, walk,
};
use crate::{Context, MeshPlan, OpError, Range, Refusal, Vector};

/// Which faces.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum FaceSelection {
    /// Every face.
    #[default]
    All,
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
        #[schemars(range(min = 0.0, max = 180.0))]
        within: f64,
    },
    /// These, and the faces reached from them over edges that turn by at most an angle.
    Expand {
        /// In degrees, from 0 (flat) to 180.
        #[schemars(range(min = 0.0, max = 180.0))]
        to_angle: f64,
        /// From which.
        of: Box<Self>,
    },
    /// Faces whose vertices all lie in a region, its surface included.
    Inside(Region),
    /// Faces marked by a tag of this name.
    Tagged(String),
    /// Faces in all of these; every one for an empty list.
    And(Vec<Self>),
    /// Faces in any of these; none for an empty list.
    Or(Vec<Self>),
    /// Faces that are not in this.
    Not(Box<Self>),
    /// These, and those that share a vertex with one of them.
    Grow(Box<Self>),
    /// Those of these that share a vertex with no other one outside.
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
    /// Those whose middles are nearest to a point; of equal distances the lower numbers.
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

impl FaceSelection {
    fn shared(&self) -> Option<Shared<'_, Self>> {
        shared!(self)
    }
}

impl Select for FaceSelection {
    type Id = FaceId;
    const WORD: &'static str = "faces";

    fn mask(&self, mesh: &Mesh, cx: &Context) -> Result<Vec<bool>, OpError> {
        if let Some(shared) = self.shared() {
            return shared_mask(&shared, mesh, cx);
        }
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
            Self::FacesAround(vertices) => {
                let corners = vertices.mask(mesh, cx)?;
                marks::<Self>(mesh, |f| mesh.face_vertices(f).any(|v| corners[v.index()]))
            }
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
                    normal != DVec3::ZERO && direction != DVec3::ZERO && turn <= *within
                })
            }
            Self::Expand { to_angle, of } => walk::spread(mesh, of.mask(mesh, cx)?, *to_angle),
            _ => unreachable!("the shared part is evaluated above"),
        })
    }

    fn count(&self, plan: &MeshPlan) -> Range {
        match self {
            Self::Faces(numbers) => Range::at_most(numbers.len() as u64),
            _ => self
                .shared()
                .map_or(plan.faces.or_less(), |s| shared_count(&s, plan.faces, plan)),
        }
    }

    fn elements(mesh: &Mesh) -> Vec<FaceId> {
        mesh.faces().collect()
    }

    fn vertices(mesh: &Mesh, f: FaceId) -> Vec<VertexId> {
        mesh.face_vertices(f).collect()
    }
}
