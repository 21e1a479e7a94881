//! A scene: named objects, each a mesh, Bezier patches, a Bezier curve or polylines.
//!
//! All coordinates are those of the scene: a reader applies the placements of its file, and operations
//! move the points themselves. Names are unique. The [digest](Scene::digest) of a scene is the same on
//! every machine for the same content.

mod decode;
mod digest;
mod error_location;
mod material;

use std::sync::Arc;

use bezier::{Curve, Patch};
use glam::{DVec2, DVec3};
use mesh::Mesh;

pub use decode::{Arrays, DecodeError, NoArrays};
pub use digest::Digest;
pub use error_location::ErrorLocation;
pub use material::{AlphaMode, Filter, Image, Material, Sampler, Texture, TextureTransform, Wrap};

/// Objects in the order in which they were made.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    objects: Vec<Object>,
}

/// One thing in a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Object {
    /// The name, unique in its scene.
    pub name: String,
    /// The shape.
    pub geometry: Geometry,
    /// The materials that the faces of a mesh refer to by their place in this list, through the
    /// attribute [`mesh::MATERIAL`].
    pub materials: Vec<Material>,
}

/// The shape of an object.
#[derive(Clone, Debug, PartialEq)]
pub enum Geometry {
    /// A mesh. Shared until it is changed, so that copies of a scene cost nothing.
    Mesh(Arc<Mesh>),
    /// Bicubic Bezier patches.
    Patches(Vec<Patch>),
    /// A Bezier curve in the plane z = 0.
    Curve(Curve<DVec2>),
    /// Open chains of points.
    Polylines(Vec<Vec<DVec3>>),
}

/// An object of this name is in the scene already.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("an object named \"{0}\" is in the scene already")]
pub struct DuplicateName(pub String);

impl Geometry {
    /// The word for this kind of geometry.
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
    /// A mesh without materials.
    pub fn mesh(name: impl Into<String>, mesh: Mesh) -> Self {
        Self::new(name, Geometry::Mesh(Arc::new(mesh)))
    }

    /// An object without materials.
    pub fn new(name: impl Into<String>, geometry: Geometry) -> Self {
        Self {
            name: name.into(),
            geometry,
            materials: Vec::new(),
        }
    }

    /// The mesh, if the object is one.
    pub fn as_mesh(&self) -> Option<&Arc<Mesh>> {
        if let Geometry::Mesh(mesh) = &self.geometry {
            Some(mesh)
        } else {
            None
        }
    }
}

impl Scene {
    /// An empty scene.
    pub fn new() -> Self {
        Self::default()
    }

    /// The objects in the order in which they were made.
    pub fn objects(&self) -> &[Object] {
        &self.objects
    }

    /// The object of this name.
    pub fn object(&self, name: &str) -> Option<&Object> {
        self.objects.iter().find(|o| o.name == name)
    }

    /// The geometry and the materials of the object of this name, to be changed.
    pub fn parts_mut(&mut self, name: &str) -> Option<(&mut Geometry, &mut Vec<Material>)> {
        self.objects
            .iter_mut()
            .find(|o| o.name == name)
            .map(|o| (&mut o.geometry, &mut o.materials))
    }

    /// Puts an object behind the others.
    ///
    /// # Errors
    ///
    /// [`DuplicateName`] if there is one of its name. The scene is unchanged.
    pub fn insert(&mut self, object: Object) -> Result<(), DuplicateName> {
        if self.object(&object.name).is_some() {
            return Err(DuplicateName(object.name));
        }
        self.objects.push(object);
        Ok(())
    }

    /// Takes an object out.
    pub fn remove(&mut self, name: &str) -> Option<Object> {
        let place = self.objects.iter().position(|o| o.name == name)?;
        Some(self.objects.remove(place))
    }

    /// Gives an object another name, in its place. Returns whether there was such an object.
    ///
    /// # Errors
    ///
    /// [`DuplicateName`] if another object has that name. The scene is unchanged.
    pub fn rename(&mut self, from: &str, to: &str) -> Result<bool, DuplicateName> {
        if from != to && self.object(to).is_some() {
            return Err(DuplicateName(to.to_owned()));
        }
        let found = self.objects.iter_mut().find(|o| o.name == from);
        Ok(found.map(|o| to.clone_into(&mut o.name)).is_some())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;

    #[test]
    fn a_second_object_of_a_name_is_refused_and_nothing_changes() {
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
    fn a_renamed_object_keeps_its_place() {
        let mut scene = Scene::new();
        scene.insert(Object::mesh("a", shapes::cube())).unwrap();
        scene.insert(Object::mesh("b", shapes::cube())).unwrap();
        assert_eq!(scene.rename("a", "c"), Ok(true));
        assert_eq!(scene.rename("a", "d"), Ok(false));
        assert_eq!(scene.rename("c", "b"), Err(DuplicateName("b".into())));
        assert_eq!(scene.objects()[0].name, "c");
    }
}
