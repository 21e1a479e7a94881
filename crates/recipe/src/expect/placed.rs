//! The instances of a scene, for expectations about positions or sizes of meshes.

use std::borrow::Cow;

use scene::Scene;

use super::subject::Subject;
use super::violation::Violation;

/// The maximum total size of all instances, in bytes. Because many nodes can reference the same mesh, the instances can
/// be much larger than the meshes.
const MAX_BYTES: u64 = 1 << 36;

/// A [`Subject`] (a scene to check) that is made from another subject. Each instance of an object in the original scene
/// becomes an object in scene space.
pub(crate) struct PlacedSubject<'a> {
    scene: Cow<'a, Scene>,
    on: Option<Vec<String>>,
    unplaced: Subject<'a>,
}

impl<'a> PlacedSubject<'a> {
    /// Places all objects in scene space. `other` is the name of the object with which the expectation compares the
    /// checked meshes. The object `other` must not have several instances.
    ///
    /// # Errors
    ///
    /// Returns an error if `other` has several instances, or if the instances are too large.
    pub(crate) fn new(subject: Subject<'a>, other: Option<&str>) -> Result<Self, Violation> {
        let scene = subject.scene;
        let bytes = scene.placed_bytes();
        if bytes > MAX_BYTES {
            return Err(format!(
                "the instances of all objects need {} of memory, expected at most {}",
                op::readable_bytes(bytes),
                op::readable_bytes(MAX_BYTES)
            )
            .into());
        }
        let instances = scene.instances();
        let n = instances
            .iter()
            .filter(|i| Some(i.object.name.as_str()) == other);
        let n = n.count();
        if let (Some(other), 2..) = (other, n) {
            let message = format!("expected 1 instance of \"{other}\", found {n}");
            return Err(message.into());
        }
        // Every object has at least one instance, so a name without instances is not the name of an object. The check
        // reports this name as unknown, because the name stays in `on`.
        let on = subject.on.map(|on| {
            let names = on.iter().flat_map(|name| {
                let of_object = instances.iter().filter(|i| i.object.name == *name);
                let mut names: Vec<String> = of_object.map(|i| i.name.clone()).collect();
                if names.is_empty() {
                    names.push(name.clone());
                }
                names
            });
            names.collect()
        });
        Ok(Self {
            scene: scene.placed(),
            on,
            unplaced: subject,
        })
    }

    /// Returns a subject (a scene to check) in which each instance is an object.
    pub(crate) fn subject(&self) -> Subject<'_> {
        Subject {
            scene: &self.scene,
            on: self.on.as_deref(),
            ..self.unplaced
        }
    }
}
