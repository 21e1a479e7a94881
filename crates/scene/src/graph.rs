//! The nodes of a scene: the hierarchy that places objects, cameras and lights.
//!
//! ```text
//! graph --- node "car" --- node "wheel left"  --- object "wheel"     (one mesh,
//!              |      `--- node "wheel right" --- object "wheel"      used twice)
//!              `---------- object "body"
//! ```
//!
//! A mesh has coordinates in its own space. The placement of a node is an affine map from the space of the node to the
//! space of its parent. If a node references an object, the object is placed by the product of the placements of the
//! node and all its ancestors. If the node has a skin, the joints of the skin place the object instead. An object that
//! no node references appears once, and its own space is the space of the scene.

mod edit;
mod form;
mod placement;
mod rig;
mod rig_form;

use std::collections::BTreeMap;

use glam::DAffine3;

pub use placement::Placement;
pub use rig::{AnimatedProperty, Animation, AnimationSampler, Channel, Interpolation, Skin};

/// The nodes of a scene, with their cameras and lights. In the list of nodes, a parent comes before its children.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Graph {
    nodes: Vec<Node>,
    /// The cameras that nodes refer to, as JSON objects of glTF.
    pub cameras: Vec<String>,
    /// The lights that nodes refer to, as JSON objects of the glTF extension `KHR_lights_punctual`.
    pub lights: Vec<String>,
    /// The skins that nodes refer to.
    pub skins: Vec<Skin>,
    /// The animations, which change properties of nodes over time.
    pub animations: Vec<Animation>,
    /// Arrays of numbers. Skins and animations refer to these arrays by index, and can share an array.
    pub arrays: Vec<Vec<f32>>,
    /// The parts of a glTF file that have no field in [`Graph`]. Each key is the name of a part, and each value is a
    /// JSON object. `asset` contains the copyright and the extras of the asset. `scene` contains the name and the
    /// extras of the scene. `root` contains the extras of the document.
    pub document: BTreeMap<String, String>,
    /// The labels of meshes. Each key is the name of the object that has the mesh.
    labels: BTreeMap<String, MeshLabel>,
}

/// A node of the hierarchy. A node can place an object, a camera or a light.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Node {
    /// The name. Several nodes can have the same name.
    pub name: Option<String>,
    /// The index of the parent, which is less than the index of this node. `None` for a root.
    pub parent: Option<usize>,
    /// The placement in the space of the parent.
    pub placement: Placement,
    /// The name of the object that the node references.
    pub object: Option<String>,
    /// The index of the camera in [`Graph::cameras`].
    pub camera: Option<usize>,
    /// The index of the light in [`Graph::lights`].
    pub light: Option<usize>,
    /// The index, in [`Graph::skins`], of the skin that deforms the object.
    pub skin: Option<usize>,
    /// The weights of the morph targets of the object. If empty, the default weights of the mesh apply: see
    /// [`MeshLabel::weights`].
    pub weights: Vec<f64>,
    /// Application-specific data (`extras` in glTF), as JSON.
    pub extras: Option<String>,
}

/// Properties of a mesh that a file can store, and for which [`Object`](crate::Object) has no field.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshLabel {
    /// The name of the mesh, which can differ from the name of the object.
    pub name: Option<String>,
    /// Application-specific data (`extras` in glTF), as JSON. The member `targetNames` has the names of the morph
    /// targets.
    pub extras: Option<String>,
    /// The default weights of the morph targets, one for each target.
    pub weights: Vec<f64>,
    /// The number of sets of joints that the file stores for each vertex. A set has four joints. 0 if the mesh has no
    /// joints.
    pub weight_sets: u32,
}

impl MeshLabel {
    /// Whether the mesh in the file has joints or morph targets.
    pub fn is_deformed(&self) -> bool {
        !self.weights.is_empty() || self.weight_sets > 0
    }
}

impl Graph {
    /// Returns all nodes of the graph.
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// Whether the graph has no nodes and no other content, such as cameras or animations.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// Appends a node and returns its index.
    ///
    /// # Panics
    ///
    /// Panics if the parent, the camera or the light does not exist.
    pub fn push(&mut self, node: Node) -> usize {
        let index = self.nodes.len();
        assert!(node.parent.is_none_or(|parent| parent < index), "no parent");
        assert!(
            node.camera.is_none_or(|i| i < self.cameras.len()),
            "no camera"
        );
        assert!(node.light.is_none_or(|i| i < self.lights.len()), "no light");
        self.nodes.push(node);
        index
    }

    /// Changes the placement of a node.
    ///
    /// # Panics
    ///
    /// Panics if the node does not exist.
    pub fn set_placement(&mut self, node: usize, placement: Placement) {
        self.nodes[node].placement = placement;
    }

    /// Returns the label of the mesh of an object. Without a label, the mesh has the name of the object.
    pub fn label(&self, object: &str) -> Option<&MeshLabel> {
        self.labels.get(object)
    }

    /// Sets the label of the mesh of an object.
    pub fn set_label(&mut self, object: impl Into<String>, label: MeshLabel) {
        self.labels.insert(object.into(), label);
    }

    /// Returns one affine map for each node, from the space of the node to scene space.
    pub fn to_scene(&self) -> Vec<DAffine3> {
        let mut maps: Vec<DAffine3> = Vec::with_capacity(self.nodes.len());
        for node in &self.nodes {
            let own = node.placement.to_affine();
            // The map of a root node is not multiplied by the identity, because the product could turn -0 into 0.
            maps.push(match node.parent {
                Some(parent) => maps[parent] * own,
                None => own,
            });
        }
        maps
    }

    /// Returns, for each object, the indices of the nodes that reference the object. The keys are the names of the
    /// objects.
    pub fn nodes_of_objects(&self) -> BTreeMap<&str, Vec<usize>> {
        let mut nodes: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
        for (i, node) in self.nodes.iter().enumerate() {
            if let Some(object) = &node.object {
                nodes.entry(object).or_default().push(i);
            }
        }
        nodes
    }

    /// Returns the indices of the nodes that reference an object.
    pub fn nodes_of(&self, object: &str) -> Vec<usize> {
        let shows = |&i: &usize| self.nodes[i].object.as_deref() == Some(object);
        (0..self.nodes.len()).filter(shows).collect()
    }
}

#[cfg(test)]
mod tests;
