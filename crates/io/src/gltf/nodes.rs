//! The nodes of a glTF scene: the meshes with their transforms and names.

use glam::{DAffine3, DMat4, DQuat, DVec3};
use gltf_json::Node;

use super::budget::Budget;
use super::document::{Document, get};
use crate::fault::Fault;
use crate::note::Notes;

/// A node with a mesh.
pub(super) struct PlacedMesh {
    node: usize,
    pub(super) mesh: usize,
    pub(super) to_scene: DAffine3,
}

impl PlacedMesh {
    /// Takes the minimal size of an object from the budget, including several copies of its name.
    ///
    /// # Errors
    ///
    /// If the budget is used up.
    pub(super) fn spend(&self, name: &str, budget: &Budget) -> Result<(), Fault> {
        let bytes = Budget::OBJECT + 8 * name.len() as u64;
        budget.spend(bytes, &format!("/nodes/{}", self.node))
    }

    pub(super) fn name<'a>(&self, document: &'a Document, otherwise: &'a str) -> &'a str {
        let node = document.nodes[self.node].name.as_deref();
        let mesh = document.meshes[self.mesh].name.as_deref();
        let mut names = [node, mesh].into_iter().flatten();
        names.find(|name| !name.is_empty()).unwrap_or(otherwise)
    }
}

/// The nodes of the scene that have a mesh, parents before children, in the order of the file.
///
/// # Errors
///
/// If a node is invalid or occurs twice in the scene.
pub(super) fn placed_meshes(
    document: &Document,
    notes: &mut Notes,
) -> Result<Vec<PlacedMesh>, Fault> {
    let mut skinned = 0;
    let mut visited = vec![false; document.nodes.len()];
    let mut placed = Vec::new();
    // An explicit stack, because a chain of nodes can be as long as the file.
    let mut open: Vec<(usize, DAffine3)> = Vec::new();
    for &root in document.roots.iter().rev() {
        open.push((root, DAffine3::IDENTITY));
    }
    while let Some((i, parent_to_scene)) = open.pop() {
        let node = get(&document.nodes, i, "/scenes", "node")?;
        let here = format!("/nodes/{i}");
        if std::mem::replace(&mut visited[i], true) {
            let message = "the node occurs twice in the scene or is its own descendant";
            return Err(Fault::json(here, message));
        }
        let to_scene = parent_to_scene * transform(node, &here)?;
        if !to_scene.is_finite() {
            return Err(Fault::json(here, "the transform of the node is not finite"));
        }
        if let Some(mesh) = node.mesh {
            skinned += usize::from(node.skin.is_some());
            let mesh = mesh.value();
            get(&document.meshes, mesh, format_args!("{here}/mesh"), "mesh")?;
            placed.push(PlacedMesh {
                node: i,
                mesh,
                to_scene,
            });
        }
        let children = node.children.as_deref().unwrap_or(&[]);
        for (k, child) in children.iter().enumerate().rev() {
            let pointer = format_args!("{here}/children/{k}");
            get(&document.nodes, child.value(), pointer, "node")?;
            open.push((child.value(), to_scene));
        }
    }
    let what = "skinned meshes read in their rest pose";
    notes.changed(skinned, None, what);
    Ok(placed)
}

fn transform(node: &Node, here: &str) -> Result<DAffine3, Fault> {
    if let Some(matrix) = node.matrix {
        let matrix = DMat4::from_cols_array(&matrix.map(f64::from));
        if matrix.row(3).to_array().map(f64::to_bits) != [0.0, 0.0, 0.0, 1.0].map(f64::to_bits) {
            let message = "expected 0, 0, 0, 1 as the last row of the matrix";
            return Err(Fault::json(format!("{here}/matrix"), message));
        }
        return Ok(DAffine3::from_mat4(matrix));
    }
    let scale = DVec3::from_array(node.scale.unwrap_or([1.0; 3]).map(f64::from));
    let translation = DVec3::from_array(node.translation.unwrap_or_default().map(f64::from));
    let rotation = DQuat::from_array(node.rotation.unwrap_or_default().0.map(f64::from));
    // Because of 32-bit rounding, the length is only approximately 1.
    let length = rotation.length();
    if length == 0.0 || !length.is_finite() {
        let pointer = format!("{here}/rotation");
        return Err(Fault::json(pointer, "expected a unit quaternion"));
    }
    let rotation = DQuat::from_array(rotation.to_array().map(|x| x / length));
    Ok(DAffine3::from_scale_rotation_translation(
        scale,
        rotation,
        translation,
    ))
}
