//! Applies the transforms of nodes to the meshes of a scene, for formats without nodes.

use std::borrow::Cow;
use std::path::Path;

use scene::Scene;

use crate::{Format, Loss, WriteError};

/// A scene in the form that a format can store.
pub(crate) struct Placed<'s> {
    pub(crate) scene: Cow<'s, Scene>,
    /// The parts of the graph (nodes, cameras, lights, skins and animations) that the format does not store.
    pub(crate) losses: Vec<Loss>,
}

/// The maximum total size, in bytes, of the meshes that are written for all nodes. The size is limited because many
/// nodes can reference the same mesh.
const MAX_PLACED_BYTES: u64 = 1 << 36;

/// Converts a scene to the form that a format can store. If the format has no nodes, every instance of an object
/// becomes a separate object, with its points in scene space.
///
/// # Errors
///
/// Returns a [`WriteError`] if the placed meshes would be too large.
pub(crate) fn placed<'s>(
    scene: &'s Scene,
    format: Format,
    path: &Path,
) -> Result<Placed<'s>, WriteError> {
    let graph = scene.graph();
    if format.has_nodes() || graph.is_empty() {
        return Ok(Placed {
            scene: Cow::Borrowed(scene),
            losses: Vec::new(),
        });
    }
    let bytes = scene.placed_bytes();
    if bytes > MAX_PLACED_BYTES {
        let message = format!(
            "the format has no nodes, so each instance is written separately; this needs {} of memory, which is more \
             than the limit of {}",
            mesh::readable_bytes(bytes),
            mesh::readable_bytes(MAX_PLACED_BYTES)
        );
        return Err(crate::error::Unwritable::scene(message).in_file(path));
    }
    let loss = |count: usize, attribute: &str, reason: &str| {
        (count > 0).then(|| Loss {
            object: String::new(),
            domain: None,
            attribute: attribute.to_owned(),
            count,
            reason: reason.to_owned(),
        })
    };
    let nodes = graph.nodes();
    let reason = "the format has no nodes, so each instance is written separately";
    let losses = [
        loss(nodes.len(), "nodes", reason),
        loss(graph.cameras.len(), "cameras", "the format has no cameras"),
        loss(graph.lights.len(), "lights", "the format has no lights"),
        loss(
            graph.skins.len(),
            "skins",
            "the format has no skins, so the meshes get the pose of the joints",
        ),
        loss(
            graph.animations.len(),
            "animations",
            "the format has no animations",
        ),
    ];
    Ok(Placed {
        scene: scene.placed(),
        losses: losses.into_iter().flatten().collect(),
    })
}
