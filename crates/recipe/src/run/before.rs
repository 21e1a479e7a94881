//! Whether a step has left the scene as it was.

use std::sync::{Arc, Weak};

use mesh::Mesh;
use scene::{Material, Scene};

/// A scene as it was before a step, to be told apart from the one after it. Owns no mesh: whoever changes a
/// shared mesh copies it first.
pub(super) struct Before(Vec<(String, Vec<Material>, Option<Weak<Mesh>>)>);

impl Before {
    pub(super) fn of(scene: &Scene) -> Self {
        let objects = scene.objects().iter().map(|o| {
            let mesh = o.as_mesh().map(Arc::downgrade);
            (o.name.clone(), o.materials.clone(), mesh)
        });
        Self(objects.collect())
    }

    /// Whether the scene is certainly the same. A mesh that is changed while it is known here moves away.
    pub(super) fn is_still(&self, scene: &Scene) -> bool {
        let same =
            |(object, (name, materials, mesh)): (&scene::Object, &(_, _, Option<Weak<_>>))| {
                let before = mesh.as_ref().and_then(Weak::upgrade);
                let is_same = |(a, b): (&Arc<Mesh>, Arc<Mesh>)| Arc::ptr_eq(a, &b);
                object.name == *name
                    && object.materials == *materials
                    && object.as_mesh().zip(before).is_some_and(is_same)
            };
        scene.objects().len() == self.0.len() && scene.objects().iter().zip(&self.0).all(same)
    }
}
