//! Lists the instances of objects. An object has one instance for each node that references it, or one instance if no
//! node references it.

use std::borrow::Cow;
use std::collections::BTreeSet;
use std::sync::Arc;

use glam::DAffine3;

use crate::pose::posed;
use crate::{Geometry, Object, Pose, Scene, transformed};

/// An object with one of its placements in the scene.
#[derive(Clone, Debug)]
pub struct Instance<'s> {
    /// The object that is placed.
    pub object: &'s Object,
    /// A name that is unique among all instances. If an object has only one instance, this instance has the name of the
    /// object. If an object has several instances, each has the name of its node (or of the object, if the node has no
    /// name). If this name is not unique, a number is appended.
    pub name: String,
    /// The affine map from the space of the object to scene space. For a skinned mesh, this is the map of the first
    /// joint.
    pub to_scene: DAffine3,
    /// The deformation of the object.
    pub pose: Pose,
}

impl Instance<'_> {
    /// Returns a copy of the object that has the name of the instance. The points of a mesh are mapped to scene space;
    /// other geometry is unchanged. Morph targets deform the mesh by the weights of the node, or by the default weights
    /// if the node has none. A skin deforms the mesh by the placements of the joints.
    pub fn placed(&self) -> Object {
        let geometry = match &self.object.geometry {
            Geometry::Mesh(mesh) if self.pose.deforms() => {
                Geometry::Mesh(Arc::new(posed(mesh, &self.pose, &self.to_scene)))
            }
            Geometry::Mesh(mesh) if self.to_scene != DAffine3::IDENTITY => {
                Geometry::Mesh(Arc::new(transformed(mesh, &self.to_scene)))
            }
            geometry => geometry.clone(),
        };
        Object {
            name: self.name.clone(),
            geometry,
            materials: self.object.materials.clone(),
        }
    }
}

impl Scene {
    /// Returns all instances, ordered by object. The instances of an object are in the order of its nodes. An
    /// object that no node references has one instance.
    pub fn instances(&self) -> Vec<Instance<'_>> {
        let graph = self.graph();
        let nodes = graph.nodes_of_objects();
        let to_scene = graph.to_scene();
        let instance = |object, name, node: Option<usize>| {
            let pose = match &Object::as_mesh(object) {
                Some(mesh) => {
                    let node = node.map(|i| &graph.nodes()[i]);
                    Pose::of(graph, node, &object.name, mesh.attributes(), &to_scene)
                }
                None => Pose::default(),
            };
            let placed = node.map_or(DAffine3::IDENTITY, |i| to_scene[i]);
            let first = pose.joints.as_ref().and_then(|joints| joints.first());
            Instance {
                object,
                name,
                to_scene: first.copied().unwrap_or(placed),
                pose,
            }
        };
        let nodes_of = |object: &Object| nodes.get(object.name.as_str()).map_or(&[][..], |n| n);
        let mut taken: BTreeSet<String> = (self.objects().iter())
            .filter(|object| nodes_of(object).len() <= 1)
            .map(|object| object.name.clone())
            .collect();
        let mut instances = Vec::new();
        for object in self.objects() {
            let nodes = nodes_of(object);
            if nodes.len() <= 1 {
                instances.push(instance(
                    object,
                    object.name.clone(),
                    nodes.first().copied(),
                ));
                continue;
            }
            // All instances of an object share the counter `number`. If the counter restarted at 1 for each instance,
            // finding the names of many instances would take quadratic time.
            let mut number = 1;
            for &i in nodes {
                let node = graph.nodes()[i]
                    .name
                    .as_deref()
                    .filter(|name| !name.is_empty());
                let wanted = node.unwrap_or(&object.name);
                let mut name = wanted.to_owned();
                while !taken.insert(name.clone()) {
                    number += 1;
                    name = format!("{wanted}.{number}");
                }
                instances.push(instance(object, name, Some(i)));
            }
        }
        instances
    }

    /// Returns a scene without nodes, in which each instance is an object with points in scene space. The returned
    /// scene has no cameras, lights, skins or animations.
    pub fn placed(&self) -> Cow<'_, Self> {
        if self.graph().is_empty() {
            return Cow::Borrowed(self);
        }
        let objects = self.instances().iter().map(Instance::placed).collect();
        Cow::Owned(Self {
            objects,
            graph: Arc::default(),
        })
    }

    /// Returns the size of the meshes of [`placed`](Self::placed) in bytes.
    pub fn placed_bytes(&self) -> u64 {
        let meshes = self.instances();
        let meshes = meshes
            .iter()
            .filter_map(|instance| instance.object.as_mesh());
        meshes.fold(0, |sum, mesh| sum.saturating_add(mesh.bytes() as u64))
    }
}
