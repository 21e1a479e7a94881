//! Updates the nodes of a graph when objects are added, removed, renamed or copied.

use super::{AnimatedProperty, Graph, MeshLabel, Node};

impl Graph {
    /// Removes an object from all nodes. The nodes that referenced the object are removed, with two exceptions. A node
    /// is kept if it has a camera, a light or remaining children. A node is also kept if it belongs to a skin (as a
    /// joint or as the root of the joints). The channels that animate a removed node are removed too. The remaining
    /// nodes keep their order.
    pub fn remove_object(&mut self, object: &str) {
        self.labels.remove(object);
        let mut n_children = vec![0_usize; self.nodes.len()];
        for parent in self.nodes.iter().filter_map(|node| node.parent) {
            n_children[parent] += 1;
        }
        let mut keep = vec![true; self.nodes.len()];
        let is_joint = self.joint_flags();
        // Children come after their parents in the list, so this reverse loop visits a parent after all its children.
        for (i, node) in self.nodes.iter_mut().enumerate().rev() {
            if node.object.take_if(|name| name == object).is_none() {
                continue;
            }
            (node.skin, node.weights) = (None, Vec::new());
            if !is_joint[i] && n_children[i] == 0 && node.camera.is_none() && node.light.is_none() {
                keep[i] = false;
                if let Some(parent) = node.parent {
                    n_children[parent] -= 1;
                }
            }
        }
        self.keep_nodes(&keep);
        // A node without an object has no morph targets. Channels that animate morph weights of the node are therefore
        // removed.
        let shows: Vec<bool> = self.nodes.iter().map(|n| n.object.is_some()).collect();
        self.retain_channels(|c| c.property != AnimatedProperty::Weights || shows[c.node]);
    }

    /// Renames an object. Each node that references the object and has the name `from` gets the name `to`. The label of
    /// the mesh gets the name `to` if it had the name `from`, or if no node was renamed.
    pub fn rename_object(&mut self, from: &str, to: &str) {
        let mut is_named = false;
        for node in &mut self.nodes {
            if node.object.as_deref() != Some(from) {
                continue;
            }
            node.object = Some(to.to_owned());
            if node.name.as_deref() == Some(from) {
                node.name = Some(to.to_owned());
                is_named = true;
            }
        }
        // A mesh without a label has the name of its object, so nothing else must be renamed.
        if let Some(mut label) = self.labels.remove(from) {
            if !is_named || label.name.as_deref() == Some(from) {
                label.name = Some(to.to_owned());
            }
            self.labels.insert(to.to_owned(), label);
        }
    }

    /// Adds an instance of the object `to` beside each instance of the object `from`. The new node has the same parent,
    /// placement, skin, weights and extras as the node of `from`. If only one node references `from`, the new node is
    /// named `to`.
    pub fn copy_object(&mut self, from: &str, to: &str) {
        let nodes = self.nodes_of(from);
        for &i in &nodes {
            let node = &self.nodes[i];
            self.nodes.push(Node {
                name: (nodes.len() == 1).then(|| to.to_owned()),
                object: Some(to.to_owned()),
                camera: None,
                light: None,
                ..node.clone()
            });
        }
        if let Some(label) = self.labels.get(from) {
            let label = MeshLabel {
                name: Some(to.to_owned()),
                ..label.clone()
            };
            if label.extras.is_some() || label.is_deformed() {
                self.labels.insert(to.to_owned(), label);
            }
        }
    }

    /// Gives each node that references the object `whole` a child node that references the object `part`. The child has
    /// the skin and the morph weights of its parent. Its placement is the identity, so the child has the same position
    /// in the scene as its parent. If only one node references `whole`, the child is named `part`.
    pub fn add_part(&mut self, whole: &str, part: &str) {
        let nodes = self.nodes_of(whole);
        for &parent in &nodes {
            self.nodes.push(Node {
                name: (nodes.len() == 1).then(|| part.to_owned()),
                parent: Some(parent),
                object: Some(part.to_owned()),
                skin: self.nodes[parent].skin,
                weights: self.nodes[parent].weights.clone(),
                ..Node::default()
            });
        }
        let label = self.labels.get(whole).filter(|label| label.is_deformed());
        if let Some(label) = label {
            // The part gets a copy of the label of `whole`, because the extras of this label contain the names of the
            // morph targets.
            let label = MeshLabel {
                name: Some(part.to_owned()),
                ..label.clone()
            };
            self.labels.insert(part.to_owned(), label);
        }
    }

    /// Appends the nodes of another graph. The objects of the two graphs must have different names. If both graphs have
    /// a part of [`Graph::document`] with the same name but different content, the part of this graph is kept. Returns
    /// the number of parts of `other` that are not kept.
    pub fn append(&mut self, other: Self) -> usize {
        let (n, cameras, lights) = (self.nodes.len(), self.cameras.len(), self.lights.len());
        let (skins, arrays) = (self.skins.len(), self.arrays.len());
        self.nodes.extend(other.nodes.into_iter().map(|node| Node {
            parent: node.parent.map(|i| i + n),
            camera: node.camera.map(|i| i + cameras),
            light: node.light.map(|i| i + lights),
            skin: node.skin.map(|i| i + skins),
            ..node
        }));
        self.skins.extend(other.skins.into_iter().map(|mut skin| {
            (skin.joints.iter_mut().chain(&mut skin.skeleton)).for_each(|node| *node += n);
            skin.inverse_bind_matrices = skin.inverse_bind_matrices.map(|i| i + arrays);
            skin
        }));
        self.animations
            .extend(other.animations.into_iter().map(|mut animation| {
                for sampler in &mut animation.samplers {
                    sampler.input += arrays;
                    sampler.output += arrays;
                }
                animation.channels.iter_mut().for_each(|c| c.node += n);
                animation
            }));
        self.arrays.extend(other.arrays);
        self.cameras.extend(other.cameras);
        self.lights.extend(other.lights);
        self.labels.extend(other.labels);
        let mut left_out = 0;
        for (name, json) in other.document {
            let kept = self.document.entry(name).or_insert_with(|| json.clone());
            left_out += usize::from(*kept != json);
        }
        left_out
    }

    /// Returns a graph for the objects that `is_wanted` accepts. The graph has the nodes that reference these objects,
    /// the joints of their skins, the roots of these joints, and the ancestors of all these nodes. A joint or an
    /// ancestor can reference an object that `is_wanted` does not accept. Such a node is kept, but without the object,
    /// the skin and the morph weights. The returned graph also has the skins and labels of the accepted objects. It has
    /// the animations of its nodes, but no channels for the morph weights of nodes without an object. All arrays and
    /// all parts of the document are kept. Cameras and lights are removed.
    pub(crate) fn only(&self, is_wanted: impl Fn(&str) -> bool) -> Self {
        let mut graph = Self {
            nodes: self.nodes.clone(),
            labels: self.labels.clone(),
            document: self.document.clone(),
            skins: self.skins.clone(),
            animations: self.animations.clone(),
            arrays: self.arrays.clone(),
            ..Self::default()
        };
        graph.labels.retain(|object, _| is_wanted(object));
        let mut keep_skins = vec![false; graph.skins.len()];
        for node in &mut graph.nodes {
            (node.camera, node.light) = (None, None);
            if node.object.take_if(|object| !is_wanted(object)).is_some() {
                (node.skin, node.weights) = (None, Vec::new());
            }
            if let Some(skin) = node.skin {
                keep_skins[skin] = true;
            }
        }
        graph.retain_skins(&keep_skins);
        let mut keep = graph.joint_flags();
        for (i, node) in graph.nodes.iter_mut().enumerate().rev() {
            keep[i] |= node.object.is_some();
            if let Some(parent) = node.parent {
                keep[parent] |= keep[i];
            }
        }
        let shows: Vec<bool> = graph.nodes.iter().map(|n| n.object.is_some()).collect();
        graph.retain_channels(|c| c.property != AnimatedProperty::Weights || shows[c.node]);
        graph.keep_nodes(&keep);
        graph
    }

    /// Removes each node whose flag in `keep` is false. The flag of each joint must be true, and so must the flag of
    /// each root of the joints of a skin. If the flag of a node is true, the flag of its parent must be true, too.
    fn keep_nodes(&mut self, keep: &[bool]) {
        let mut n = 0;
        let places = keep.iter().map(|&is_kept| {
            n += usize::from(is_kept);
            is_kept.then(|| n - 1)
        });
        let places: Vec<Option<usize>> = places.collect();
        let mut kept = keep.iter();
        self.nodes.retain(|_| *kept.next().unwrap_or(&true));
        for node in &mut self.nodes {
            node.parent = node.parent.and_then(|parent| places[parent]);
        }
        self.renumber_rig(&places);
    }
}
