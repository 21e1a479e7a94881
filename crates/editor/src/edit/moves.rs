//! Moves the picked elements.

use glam::DAffine3;
use mesh::{DVec3, Mesh, VertexId};
use op::{Axis, Selected};
use serde::Deserialize;

use super::{Command, CommandError, Editor};
use crate::panel::number;

/// How picked elements move. `Rotate` and `Scale` use the axes that [`Editor::picked_axes`] returns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Movement {
    /// Move by an offset in scene units, along the axes of the scene.
    Offset(DVec3),
    /// Rotate around an axis through the center of the elements. The values are the index of the axis and the angle in
    /// degrees. The rotation is counter-clockwise when the axis points towards the viewer.
    Rotate(usize, f64),
    /// Scale by a factor along each axis, about the center of the elements.
    Scale(DVec3),
}

/// The value of the parameter `by` of a step `MoveVertices`. When the user drags the picked elements, this value
/// changes.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
enum By {
    Offset([f64; 3]),
    Rotate { axis: Axis, angle: f64 },
    Scale([f64; 3]),
}

impl By {
    /// Converts the movement to the space of the object.
    fn of(movement: Movement, to_scene: DAffine3) -> Self {
        let map = to_scene.matrix3;
        match movement {
            Movement::Offset(offset) if map == DAffine3::IDENTITY.matrix3 => {
                Self::Offset(offset.to_array())
            }
            Movement::Offset(offset) => {
                let inside = map.inverse() * offset;
                let inside = if inside.is_finite() {
                    inside
                } else {
                    DVec3::ZERO
                };
                Self::Offset(inside.to_array())
            }
            Movement::Rotate(axis, angle) => Self::Rotate {
                axis: [Axis::X, Axis::Y, Axis::Z][axis.min(2)],
                // In a mirrored object, the same rotation has the opposite direction.
                angle: if map.determinant() < 0.0 {
                    -angle
                } else {
                    angle
                },
            },
            Movement::Scale(factors) => Self::Scale(factors.to_array()),
        }
    }

    /// Combines two movements into one movement with the same effect. Returns `None` if they cannot be combined.
    fn then(self, next: Self) -> Option<Self> {
        Some(match (self, next) {
            (Self::Offset(a), Self::Offset(b)) => {
                Self::Offset((DVec3::from(a) + DVec3::from(b)).to_array())
            }
            (Self::Scale(a), Self::Scale(b)) => {
                Self::Scale((DVec3::from(a) * DVec3::from(b)).to_array())
            }
            (
                Self::Rotate { axis, angle },
                Self::Rotate {
                    axis: other,
                    angle: more,
                },
            ) if axis == other => {
                let angle = angle + more;
                Self::Rotate { axis, angle }
            }
            _ => return None,
        })
    }

    /// Whether nothing moves.
    fn is_nothing(self) -> bool {
        match self {
            Self::Offset(offset) => offset == [0.0; 3],
            Self::Rotate { angle, .. } => angle == 0.0,
            Self::Scale(factors) => factors == [1.0; 3],
        }
    }

    fn to_ron(self) -> String {
        // The numbers are rounded, so that a sum such as 0.1 + 0.2 is written as 0.3.
        let vector = |v: [f64; 3]| {
            let [x, y, z] = v.map(|x| number(rounded(x)));
            format!("(({x}, {y}, {z}))")
        };
        match self {
            Self::Offset(offset) => format!("Offset{}", vector(offset)),
            Self::Scale(factors) => format!("Scale{}", vector(factors)),
            Self::Rotate { axis, angle } => {
                format!("Rotate(axis: {axis:?}, angle: {})", number(rounded(angle)))
            }
        }
    }
}

impl Editor {
    /// Returns the mean position of the vertices of the picked elements, in scene space. `None` if nothing is picked.
    pub fn picked_center(&self) -> Option<DVec3> {
        let picked = self.picked()?;
        let mesh = self.shown.object(&picked.object)?.as_mesh()?;
        let vertices = vertices_of(mesh, &picked.elements);
        let sum: DVec3 = vertices.iter().map(|&v| mesh.position(v)).sum();
        let center = sum / vertices.len() as f64;
        Some(self.placed(&picked.object).transform_point3(center))
    }

    /// Returns the axes of the object with the picked elements, as unit vectors in scene space. If no elements are
    /// picked, returns the axes of the scene.
    pub fn picked_axes(&self) -> [DVec3; 3] {
        let object = self.picked().map(|picked| self.placed(&picked.object));
        let map = object.unwrap_or_default().matrix3;
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        axes.map(|axis| (map * axis).try_normalize().unwrap_or(axis))
    }

    /// Returns the matrix from the space of an object to the space of the scene. If the scene has several instances of
    /// the object, returns the matrix of the first instance.
    fn placed(&self, object: &str) -> DAffine3 {
        let instances = self.shown.instances();
        let mut all = instances.iter();
        let found = all.find(|instance| instance.object.name == object);
        found.map_or(DAffine3::IDENTITY, |instance| instance.to_scene)
    }

    /// Moves the picked elements with a step `MoveVertices`. If the step before the cursor already moves the same
    /// elements in the same way, the parameter `by` of that step is changed instead. Several movements of the same
    /// elements therefore become one step. If `is_preview` is true, the movement is only previewed, and the text does
    /// not change.
    ///
    /// # Errors
    ///
    /// Returns [`CommandError::NothingPicked`] if no elements are picked. Also returns the errors of [`Editor::apply`].
    pub fn move_picked(
        &mut self,
        movement: Movement,
        is_preview: bool,
    ) -> Result<(), CommandError> {
        let selection = self.selection();
        let to_scene = selection
            .as_ref()
            .map(|selection| self.placed(&selection.object));
        let by = By::of(movement, to_scene.unwrap_or_default());
        let command = Command {
            selection,
            ..Command::new("MoveVertices").with("by", &by.to_ron())
        };
        let steps = self.steps_of(&command)?;
        let before = self.moves_same(&steps);
        if let Some((step, whole)) =
            before.and_then(|(step, before)| Some((step, before.then(by)?)))
        {
            let value = whole.to_ron();
            return if is_preview {
                self.preview_parameter(step, &["by"], &value)
            } else {
                self.set_parameter(step, &["by"], Some(&value))
            };
        }
        if is_preview {
            self.preview(&command)
        } else if by.is_nothing() {
            self.end_preview();
            Ok(())
        } else {
            self.apply(&command)
        }
    }

    /// If the step before the cursor moves the same elements as the new step, returns the index of that earlier step
    /// and its movement.
    fn moves_same(&self, new: &[String]) -> Option<(usize, By)> {
        let [new] = new else { return None };
        let step = self.cursor().checked_sub(1)?;
        let written = self.outline().steps.get(step)?;
        if written.name != "MoveVertices" || !written.enabled {
            return None;
        }
        let new = crate::Outline::of(&format!("(steps: [{new}])"));
        let [text] = &new.steps[..] else { return None };
        let vertices = new.run_of(0)?.field("vertices")?.to_string();
        let run = self.outline().run_of(step)?;
        let known = run.field("vertices")?.to_string();
        if written.on != text.on || vertices != known || run.field("falloff").is_some() {
            return None;
        }
        let before = ron_tree::from_str(self.parameter(step, &["by"])?).ok()?;
        Some((step, before))
    }
}

/// Rounds a number to 12 significant digits.
fn rounded(x: f64) -> f64 {
    format!("{x:.11e}").parse().unwrap_or(x)
}

/// Returns the vertices of elements. Each vertex is in the list only once.
fn vertices_of(mesh: &Mesh, elements: &Selected) -> Vec<VertexId> {
    let mut vertices: Vec<VertexId> = match elements {
        Selected::Vertices(list) => return list.clone(),
        Selected::Edges(list) => list.iter().flat_map(|&e| mesh.edge_vertices(e)).collect(),
        Selected::Faces(list) => list.iter().flat_map(|&f| mesh.face_vertices(f)).collect(),
    };
    vertices.sort_unstable();
    vertices.dedup();
    vertices
}
