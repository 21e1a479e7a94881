//! Changes of a graph that follow from changes of the objects.

use super::{Graph, Node};

impl Graph {
    /// Removes an object from all nodes. A node that is left without an object, a camera, a light and children is
    /// removed too. Other nodes keep their order.
    pub(crate) fn remove_object(&mut self, object: &str) {
        self.labels.remove(object);
        let mut n_children = vec![0_usize; self.nodes.len()];
        for parent in self.nodes.iter().filter_map(|node| node.parent) {
            n_children[parent] += 1;
        }
        let mut keep = vec![true; self.nodes.len()];
        // Children come after their parents, so a parent is visited after all its children.
        for (i, node) in self.nodes.iter_mut().enumerate().rev() {
            if node.object.take_if(|name| name == object).is_none() {
                continue;
            }
            if n_children[i] == 0 && node.camera.is_none() && node.light.is_none() {
                keep[i] = false;
                if let Some(parent) = node.parent {
                    n_children[parent] -= 1;
                }
            }
        }
        self.keep_nodes(&keep);
    }

    /// Renames an object. A node or mesh with the old name gets the new name. If there is none, the mesh gets it.
    pub(crate) fn rename_object(&mut self, from: &str, to: &str) {
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
        // Without a label, the mesh has the name of the object.
        if let Some(mut label) = self.labels.remove(from) {
            if !is_named || label.name.as_deref() == Some(from) {
                label.name = Some(to.to_owned());
            }
            self.labels.insert(to.to_owned(), label);
        }
    }

    /// Shows the object `to` wherever the object `from` is shown: adds a node next to each node of `from`, with its
    /// placement and extras. If `from` is shown once, the new node is named `to`.
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
        if let Some(extras) = self.labels.get(from).and_then(|label| label.extras.clone()) {
            let label = super::MeshLabel {
                name: Some(to.to_owned()),
                extras: Some(extras),
            };
            self.labels.insert(to.to_owned(), label);
        }
    }

    /// Adds a child that shows the object `part` to each node that shows the object `whole`. The child has the same
    /// place. If `whole` is shown once, the child is named `part`.
    pub fn add_part(&mut self, whole: &str, part: &str) {
        let nodes = self.nodes_of(whole);
        for &parent in &nodes {
            self.nodes.push(Node {
                name: (nodes.len() == 1).then(|| part.to_owned()),
                parent: Some(parent),
                object: Some(part.to_owned()),
                ..Node::default()
            });
        }
    }

    /// Appends the nodes of another graph. Its objects must have other names. Of different parts of the document with the
    /// same name, the first is kept. Returns the number of parts that are not kept.
    pub fn append(&mut self, other: Self) -> usize {
        let (n, cameras, lights) = (self.nodes.len(), self.cameras.len(), self.lights.len());
        self.nodes.extend(other.nodes.into_iter().map(|node| Node {
            parent: node.parent.map(|i| i + n),
            camera: node.camera.map(|i| i + cameras),
            light: node.light.map(|i| i + lights),
            ..node
        }));
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

    /// Returns the nodes that show an object that `is_wanted` accepts, and their ancestors, without cameras and lights,
    /// and the parts of the document.
    pub(crate) fn only(&self, is_wanted: impl Fn(&str) -> bool) -> Self {
        let mut graph = Self {
            nodes: self.nodes.clone(),
            labels: self.labels.clone(),
            document: self.document.clone(),
            ..Self::default()
        };
        graph.labels.retain(|object, _| is_wanted(object));
        let mut keep = vec![false; graph.nodes.len()];
        for (i, node) in graph.nodes.iter_mut().enumerate().rev() {
            (node.camera, node.light) = (None, None);
            node.object.take_if(|object| !is_wanted(object));
            keep[i] |= node.object.is_some();
            if let Some(parent) = node.parent {
                keep[parent] |= keep[i];
            }
        }
        graph.keep_nodes(&keep);
        graph
    }

    /// Removes the nodes for which `keep` is false. The parents of the other nodes must be kept.
    fn keep_nodes(&mut self, keep: &[bool]) {
        let mut n = 0;
        let places = keep.iter().map(|&is_kept| {
            let place = n;
            n += usize::from(is_kept);
            place
        });
        let places: Vec<usize> = places.collect();
        let mut kept = keep.iter();
        self.nodes.retain(|_| *kept.next().unwrap_or(&true));
        for node in &mut self.nodes {
            node.parent = node.parent.map(|parent| places[parent]);
        }
    }
}
