//! Detects whether a step has left the scene unchanged.

use std::sync::{Arc, Weak};

use mesh::Mesh;
use scene::{Graph, Material, Scene};

/// A snapshot of a scene, for comparison with a later state of the scene. The snapshot holds only weak references to
/// meshes. With a strong reference, an operation would have to copy a mesh before changing it.
pub(super) struct SceneSnapshot {
    objects: Vec<(String, Vec<Material>, Option<Weak<Mesh>>)>,
    graph: Graph,
}

impl SceneSnapshot {
    pub(super) fn of(scene: &Scene) -> Self {
        let objects = scene.objects().iter().map(|o| {
            let mesh = o.as_mesh().map(Arc::downgrade);
            (o.name.clone(), o.materials.clone(), mesh)
        });
        Self {
            objects: objects.collect(),
            graph: scene.graph().clone(),
        }
    }

    /// Whether it is known that the scene is unchanged. If a mesh is changed while weak references to it exist, the
    /// mesh moves to a new allocation. Equal pointers therefore mean that the mesh is unchanged.
    pub(super) fn is_unchanged(&self, scene: &Scene) -> bool {
        let same =
            |(object, (name, materials, mesh)): (&scene::Object, &(_, _, Option<Weak<_>>))| {
                let before = mesh.as_ref().and_then(Weak::upgrade);
                let is_same = |(a, b): (&Arc<Mesh>, Arc<Mesh>)| Arc::ptr_eq(a, &b);
                object.name == *name
                    && object.materials == *materials
                    && object.as_mesh().zip(before).is_some_and(is_same)
            };
        scene.objects().len() == self.objects.len()
            && scene.objects().iter().zip(&self.objects).all(same)
            && *scene.graph() == self.graph
    }
}
