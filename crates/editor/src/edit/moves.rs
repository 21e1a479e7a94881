//! Moves the picked elements.

use glam::DAffine3;
use mesh::{DVec3, Mesh, VertexId};
use op::Selected;
use serde::Deserialize;

use super::{Command, CommandError, Editor};
use crate::panel::number;

/// The parameter `by` of a step that dragging changes.
#[derive(Clone, Copy, Deserialize)]
enum By {
    Offset([f64; 3]),
}

impl Editor {
    /// Returns the mean of the vertices of the picked elements, in scene units. `None` if nothing is picked.
    pub fn picked_center(&self) -> Option<DVec3> {
        let picked = self.picked()?;
        let mesh = self.shown.object(&picked.object)?.as_mesh()?;
        let vertices = vertices_of(mesh, &picked.elements);
        let sum: DVec3 = vertices.iter().map(|&v| mesh.position(v)).sum();
        let center = sum / vertices.len() as f64;
        Some(self.placed(&picked.object).transform_point3(center))
    }

    /// Returns the map from the space of an object to the scene. If the object is there several times, that of the first.
    fn placed(&self, object: &str) -> DAffine3 {
        let instances = self.shown.instances();
        let mut all = instances.iter();
        let found = all.find(|instance| instance.object.name == object);
        found.map_or(DAffine3::IDENTITY, |instance| instance.to_scene)
    }

    /// Moves the picked elements by an offset in scene units, by a step `MoveVertices`. If the step before the cursor moves
    /// the same elements, its offset is changed, so that dragging several times gives one step. With `is_preview`, the text
    /// stays as it is.
    ///
    /// # Errors
    ///
    /// [`CommandError::NothingPicked`] if nothing is picked; other errors as [`Editor::apply`].
    pub fn move_picked(&mut self, offset: DVec3, is_preview: bool) -> Result<(), CommandError> {
        let selection = self.selection();
        let to_scene = selection
            .as_ref()
            .map(|selection| self.placed(&selection.object));
        let to_scene = to_scene.unwrap_or_default();
        let mut offset = offset;
        if to_scene.matrix3 != DAffine3::IDENTITY.matrix3 {
            offset = to_scene.matrix3.inverse() * offset;
            if !offset.is_finite() {
                offset = DVec3::ZERO;
            }
        }
        let command = Command {
            selection,
            ..Command::new("MoveVertices").with("by", &by(offset))
        };
        let steps = self.steps_of(&command)?;
        if let Some((step, before)) = self.moves_same(&steps) {
            let value = by(before + offset);
            return if is_preview {
                self.preview_parameter(step, &["by"], &value)
            } else {
                self.set_parameter(step, &["by"], Some(&value))
            };
        }
        if is_preview {
            self.preview(&command)
        } else if offset == DVec3::ZERO {
            self.end_preview();
            Ok(())
        } else {
            self.apply(&command)
        }
    }

    /// Returns the step before the cursor and its offset, if it moves the elements that the new step moves.
    fn moves_same(&self, new: &[String]) -> Option<(usize, DVec3)> {
        let [new] = new else { return None };
        let step = self.cursor().checked_sub(1)?;
        let written = self.outline().steps.get(step)?;
        if written.name != "MoveVertices" || !written.enabled {
            return None;
        }
        let new = crate::Outline::of(&format!("(steps: [{new}])"));
        let [text] = &new.steps[..] else { return None };
        let vertices = new.run_of(0)?.field("vertices")?.to_string();
        let known = self.outline().run_of(step)?.field("vertices")?.to_string();
        if written.on != text.on || vertices != known {
            return None;
        }
        let By::Offset(before) = ron_tree::from_str(self.parameter(step, &["by"])?).ok()?;
        Some((step, DVec3::from(before)))
    }
}

/// Writes an offset as the parameter `by`.
fn by(offset: DVec3) -> String {
    // Sums of short numbers are short again.
    let [x, y, z] = offset.to_array().map(|x| number(rounded(x)));
    format!("Offset(({x}, {y}, {z}))")
}

/// Rounds to 12 significant digits.
fn rounded(x: f64) -> f64 {
    format!("{x:.11e}").parse().unwrap_or(x)
}

/// Returns the vertices of elements, each once.
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
