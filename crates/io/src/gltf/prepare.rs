//! Objects before they are written: their vertices, triangles and bounds.

use std::collections::BTreeMap;

use gltf_json::mesh::Semantic;
use mesh::{Domain, Mesh};
use scene::Object;

use super::faces::{Faces, faces_by_material};
use super::fill::{Bounds, bounds};
use super::split::{Split, note_changed, split};
use super::streams::{Stream, streams};
use crate::error::Unwritable;
use crate::loss::Losses;
use crate::weld::n_merged;

/// An object of which everything is known but its place in the document.
pub(super) struct Prepared<'a> {
    pub(super) object: &'a Object,
    pub(super) mesh: &'a Mesh,
    pub(super) streams: Vec<Stream<'a>>,
    pub(super) split: Split,
    pub(super) bounds: Bounds,
    pub(super) faces: BTreeMap<i32, Faces>,
}

impl<'a> Prepared<'a> {
    /// Counts what there is to write, and says what is not.
    ///
    /// # Errors
    ///
    /// If there are too many vertices, or one whose position glTF cannot hold.
    pub(super) fn new(
        object: &'a Object,
        mesh: &'a Mesh,
        losses: &mut Losses,
    ) -> Result<Self, Unwritable> {
        let streams = streams(mesh, losses);
        let split = split(mesh, &streams);
        if split.n >= u32::MAX as usize {
            let (most, n) = (u32::MAX, split.n);
            let message = format!("expected fewer than {most} vertices, found {n}");
            return Err(Unwritable::object(&object.name, message));
        }
        for stream in &streams {
            note_changed(stream, mesh, &split, losses);
        }
        let isolated = mesh.n_isolated_vertices();
        let reason = "isolated vertices: glTF holds triangles";
        losses.add(Domain::Vertex, "position", isolated, reason);
        let reason =
            "vertices at the place of another: glTF knows vertices of a mesh by their places";
        losses.add(Domain::Vertex, "position", n_merged(mesh), reason);
        let polygons = mesh.faces().filter(|&f| !mesh.is_triangle(f)).count();
        let reason = "glTF holds triangles: the polygons are cut";
        losses.add(Domain::Face, "polygon", polygons, reason);
        let is_empty = usize::from(mesh.n_faces() == 0);
        let reason = "glTF has no meshes without faces: the object is not written";
        losses.add(None, "mesh", is_empty, reason);
        let bounds = bounds(mesh, &split).map_err(|v| {
            let message = format!(
                "the position of {v}, {}, is too large for the 32 bits of glTF",
                mesh.position(v)
            );
            Unwritable::object(&object.name, message)
        })?;
        let faces = faces_by_material(object, mesh, &split, polygons > 0, losses);
        Ok(Self {
            object,
            mesh,
            streams,
            split,
            bounds,
            faces,
        })
    }

    /// How many sets of texture coordinates there are.
    pub(super) fn n_uvs(&self) -> u32 {
        let is_uv = |stream: &&Stream| matches!(stream.semantic, Semantic::TexCoords(_));
        let count = self.streams.iter().filter(is_uv).count();
        u32::try_from(count).unwrap_or(u32::MAX)
    }
}
