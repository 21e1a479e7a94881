//! Scenes: lists of named objects. An object is a mesh, Bezier patches, a Bezier curve or polylines.
//!
//! Each object has its own coordinate system, called its space. The nodes of the [graph](Graph) place meshes in the
//! scene. If no node references an object, the coordinates of the object are in scene space. Object names are unique.
//! The [digest](Scene::digest) of a scene is the same on every machine for the same content.

mod decode;
mod digest;
mod error_location;
mod graph;
mod material;
mod placed;
mod pose;
mod transformed;

use std::collections::BTreeSet;
use std::sync::Arc;

use bezier::{Curve, Patch};
use glam::{DVec2, DVec3};
use mesh::Mesh;

pub use decode::{ArraySource, DecodeError, NoArrays};
pub use digest::Digest;
pub use error_location::ErrorLocation;
pub use graph::{
    AnimatedProperty, Animation, AnimationSampler, Channel, Graph, Interpolation, MeshLabel, Node,
    Placement, Skin,
};
pub use material::{
    AlphaMode, Filter, Image, Material, Sampler, Texture, TextureNames, TextureTransform, Wrap,
};
pub use placed::Instance;
pub use pose::Pose;
pub use transformed::{
    holds_normals, holds_tangents, transform_tangent, transform_tangents, transformed,
};

/// A list of objects in the order of their creation, and the nodes that place them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    objects: Vec<Object>,
    /// Copies of a scene share the graph until one of them changes it, so that copying a scene is cheap.
    graph: Arc<Graph>,
}

/// A named object in a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Object {
    /// The name, unique in its scene.
    pub name: String,
    /// The shape of the object.
    pub geometry: Geometry,
    /// The materials of the faces of a mesh. The attribute [`mesh::MATERIAL`] has indices into this list.
    pub materials: Vec<Material>,
}

/// The shape of an object.
#[derive(Clone, Debug, PartialEq)]
pub enum Geometry {
    /// A mesh. Copies of a scene share the mesh until one of them changes it, so that copying a scene is cheap.
    Mesh(Arc<Mesh>),
    /// Bicubic Bezier patches.
    Patches(Vec<Patch>),
    /// A Bezier curve in the plane z = 0.
    Curve(Curve<DVec2>),
    /// Open polylines, each a list of points.
    Polylines(Vec<Vec<DVec3>>),
}

/// The scene already has an object with this name.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the scene already has an object named \"{0}\"")]
pub struct DuplicateName(pub String);

impl Geometry {
    /// Returns the word for this kind of geometry, for use in messages.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Mesh(_) => "mesh",
            Self::Patches(_) => "patches",
            Self::Curve(_) => "curve",
            Self::Polylines(_) => "polylines",
        }
    }
}

impl Object {
    /// Creates a mesh object without materials.
    pub fn mesh(name: impl Into<String>, mesh: Mesh) -> Self {
        Self::new(name, Geometry::Mesh(Arc::new(mesh)))
    }

    /// Creates an object without materials.
    pub fn new(name: impl Into<String>, geometry: Geometry) -> Self {
        Self {
            name: name.into(),
            geometry,
            materials: Vec::new(),
        }
    }

    /// Returns the mesh, if the object is a mesh.
    pub fn as_mesh(&self) -> Option<&Arc<Mesh>> {
        if let Geometry::Mesh(mesh) = &self.geometry {
            Some(mesh)
        } else {
            None
        }
    }
}

impl Scene {
    /// Creates an empty scene.
    pub fn new() -> Self {
        Self::default()
    }

    /// Returns the objects in the order of their creation.
    pub fn objects(&self) -> &[Object] {
        &self.objects
    }

    /// Returns the object with this name.
    pub fn object(&self, name: &str) -> Option<&Object> {
        self.objects.iter().find(|o| o.name == name)
    }

    /// Returns the nodes that place objects in the scene.
    pub fn graph(&self) -> &Graph {
        &self.graph
    }

    /// Returns a mutable reference to the nodes that place objects in the scene. Each object that a node references
    /// must be a mesh of the scene.
    pub fn graph_mut(&mut self) -> &mut Graph {
        Arc::make_mut(&mut self.graph)
    }

    /// Returns a scene of the objects that `is_wanted` accepts. The scene has the nodes of these objects, the joints of
    /// their skins, the roots of these joints, and the ancestors of all these nodes. The returned scene has no cameras
    /// and no lights.
    #[must_use]
    pub fn only(&self, is_wanted: impl Fn(&str) -> bool) -> Self {
        let objects = self.objects.iter().filter(|o| is_wanted(&o.name));
        Self {
            objects: objects.cloned().collect(),
            graph: Arc::new(self.graph.only(is_wanted)),
        }
    }

    /// Returns mutable references to the geometry and the materials of the object with this name.
    pub fn parts_mut(&mut self, name: &str) -> Option<(&mut Geometry, &mut Vec<Material>)> {
        self.objects
            .iter_mut()
            .find(|o| o.name == name)
            .map(|o| (&mut o.geometry, &mut o.materials))
    }

    /// Appends an object.
    ///
    /// # Errors
    ///
    /// Returns [`DuplicateName`] if the scene already has an object with this name. The scene is then unchanged.
    pub fn insert(&mut self, object: Object) -> Result<(), DuplicateName> {
        if self.object(&object.name).is_some() {
            return Err(DuplicateName(object.name));
        }
        self.objects.push(object);
        Ok(())
    }

    /// Appends objects and the nodes that place them. Like [`Graph::append`], returns the number of parts of
    /// [`Graph::document`] that are not kept.
    ///
    /// # Errors
    ///
    /// Returns [`DuplicateName`] if the scene already has an object with one of the names, or if two of the objects
    /// have the same name. The scene is then unchanged.
    pub fn append(&mut self, objects: Vec<Object>, graph: Graph) -> Result<usize, DuplicateName> {
        let mut names: BTreeSet<&str> = self.objects.iter().map(|o| o.name.as_str()).collect();
        if let Some(object) = objects.iter().find(|o| !names.insert(&o.name)) {
            return Err(DuplicateName(object.name.clone()));
        }
        self.objects.extend(objects);
        if graph.is_empty() {
            return Ok(0);
        }
        Ok(self.graph_mut().append(graph))
    }

    /// Removes an object and returns it. The nodes that reference the object are removed, too. A node is kept if it
    /// still has children, has a camera or a light, or belongs to a skin (as a joint or as the root of the joints).
    pub fn remove(&mut self, name: &str) -> Option<Object> {
        let index = self.objects.iter().position(|o| o.name == name)?;
        self.unplace(name);
        Some(self.objects.remove(index))
    }

    /// Removes an object from all nodes, so that the coordinates of the object are in scene space. The nodes that
    /// referenced the object are removed, too. A node is kept if it still has children, has a camera or a light, or
    /// belongs to a skin (as a joint or as the root of the joints).
    pub fn unplace(&mut self, name: &str) {
        if !self.graph.is_empty() {
            self.graph_mut().remove_object(name);
        }
    }

    /// Renames an object. Each node that references the object and has the name `from` is renamed, too. The
    /// [label](MeshLabel) of the mesh is renamed if it has the name `from`, or if no node was renamed. The object keeps
    /// its position in the list. Returns whether the object exists.
    ///
    /// # Errors
    ///
    /// Returns [`DuplicateName`] if a different object has the new name. The scene is then unchanged.
    pub fn rename(&mut self, from: &str, to: &str) -> Result<bool, DuplicateName> {
        if from != to && self.object(to).is_some() {
            return Err(DuplicateName(to.to_owned()));
        }
        let Some(object) = self.objects.iter_mut().find(|o| o.name == from) else {
            return Ok(false);
        };
        to.clone_into(&mut object.name);
        if !self.graph.is_empty() {
            self.graph_mut().rename_object(from, to);
        }
        Ok(true)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;

    #[test]
    fn a_second_object_with_the_same_name_is_refused_and_nothing_changes() {
        let mut scene = Scene::new();
        scene.insert(Object::mesh("a", shapes::cube())).unwrap();
        let before = scene.clone();
        assert_eq!(
            scene.insert(Object::mesh("a", shapes::square())),
            Err(DuplicateName("a".into()))
        );
        assert_eq!(scene, before);
    }

    #[test]
    fn a_renamed_object_keeps_its_position_in_the_list() {
        let mut scene = Scene::new();
        scene.insert(Object::mesh("a", shapes::cube())).unwrap();
        scene.insert(Object::mesh("b", shapes::cube())).unwrap();
        assert_eq!(scene.rename("a", "c"), Ok(true));
        assert_eq!(scene.rename("a", "d"), Ok(false));
        assert_eq!(scene.rename("c", "b"), Err(DuplicateName("b".into())));
        assert_eq!(scene.objects()[0].name, "c");
    }
}
