//! Writes the nodes of a scene, with their cameras and lights.

use std::collections::BTreeSet;

use scene::{Node, Placement, Scene};
use serde_json::{Value, json};

use super::extras::{optional_json, parsed};
use super::node_json::LIGHTS;
use super::write_document::{Deformed, Writer};
use crate::error::Unwritable;
use crate::loss::Losses;

impl Writer<'_> {
    /// Adds the nodes of the graph, and then a node for each object that no node references.
    ///
    /// # Errors
    ///
    /// Returns an error if glTF cannot store the placement of a node, or if a part of the graph is not JSON.
    pub(super) fn nodes(&mut self, scene: &Scene, losses: &mut Losses) -> Result<(), Unwritable> {
        let graph = scene.graph();
        let list = &mut self.nodes;
        for (texts, values) in [
            (&graph.cameras, &mut list.cameras),
            (&graph.lights, &mut list.lights),
        ] {
            for text in texts {
                values.push(parsed(text)?);
            }
        }
        for (name, text) in &graph.document {
            if let Value::Object(members) = parsed(text)? {
                list.kept.push((name.clone(), members));
            }
        }
        let mut children: Vec<Vec<usize>> = vec![Vec::new(); graph.nodes().len()];
        let mut shown = BTreeSet::new();
        for (i, node) in graph.nodes().iter().enumerate() {
            match node.parent {
                Some(parent) => children[parent].push(i),
                None => list.roots.push(i),
            }
            shown.extend(node.object.as_deref());
        }
        for (node, children) in graph.nodes().iter().zip(children) {
            let mesh = node
                .object
                .as_deref()
                .and_then(|object| self.mesh_of.get(object));
            let mut json = json!({ "mesh": mesh, "name": node.name, "children": children });
            write_placement(node, &mut json)?;
            json["camera"] = json!(node.camera);
            if let Some(light) = node.light {
                json["extensions"] = json!({ LIGHTS: { "light": light } });
            }
            let deformed = node
                .object
                .as_deref()
                .and_then(|object| self.deformed.get(object));
            let mut losses = losses.about(node.object.as_deref().unwrap_or_default());
            write_deformation(node, deformed, &mut json, &mut losses);
            json["extras"] = optional_json(node.extras.as_deref())?;
            list.nodes.push(json);
        }
        for object in scene.objects() {
            let name = object.name.as_str();
            if let (Some(mesh), false) = (self.mesh_of.get(name), shown.contains(name)) {
                list.roots.push(list.nodes.len());
                list.nodes.push(json!({ "mesh": mesh, "name": name }));
            }
        }
        self.quantizer.place(graph, &mut list.nodes);
        Ok(())
    }
}

/// Adds the skin and the weights of morph targets to the JSON of a node.
fn write_deformation(
    node: &Node,
    deformed: Option<&Deformed>,
    json: &mut Value,
    losses: &mut Losses,
) {
    if deformed.is_some_and(|deformed| deformed.has_joints) {
        json["skin"] = json!(node.skin);
    }
    let n = deformed.map_or(0, |deformed| deformed.n_targets);
    if node.weights.is_empty() {
        return;
    }
    let lost = node.weights.len().saturating_sub(n);
    let reason = "the mesh has fewer morph targets than the node has weights";
    losses.add(None, "morph weights", lost, reason);
    let mut weights = node.weights.clone();
    weights.resize(n, 0.0);
    json["weights"] = json!(weights);
}

/// Adds the placement (transform) of a node to its JSON. A translation, rotation or scale that has no effect is left
/// out.
fn write_placement(node: &Node, json: &mut Value) -> Result<(), Unwritable> {
    let numbers = match &node.placement {
        Placement::Matrix(matrix) => {
            json["matrix"] = json!(matrix);
            matrix.to_vec()
        }
        Placement::Parts {
            translation,
            rotation,
            scale,
        } => {
            let parts: [(&str, &[f64], &[f64]); 3] = [
                ("translation", translation, &[0.0; 3]),
                ("rotation", rotation, &[0.0, 0.0, 0.0, 1.0]),
                ("scale", scale, &[1.0; 3]),
            ];
            for (key, numbers, default) in parts {
                let bits =
                    |numbers: &[f64]| numbers.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
                if bits(numbers) != bits(default) {
                    json[key] = json!(numbers);
                }
            }
            [&translation[..], rotation, scale].concat()
        }
    };
    // Readers round the transform of a node to 32 bits, so larger numbers would become infinite.
    if numbers.iter().all(|&x| x.abs() <= f64::from(f32::MAX)) {
        return Ok(());
    }
    let name = node.name.as_deref().unwrap_or_default();
    let message = format!(
        "the transform of the node \"{name}\" exceeds the range of the 32-bit floats of glTF"
    );
    Err(Unwritable::scene(message))
}
