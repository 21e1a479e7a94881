//! Prepares objects for writing: vertices, triangles and bounds.

use std::collections::BTreeMap;

use gltf_json::mesh::Semantic;
use mesh::{Domain, FaceId, Mesh, parallel};
use scene::{Graph, Object};

use super::faces::{Faces, faces_by_material};
use super::fill::{Bounds, bounds};
use super::reorder::reorder;
use super::split::{Split, note_changed, split};
use super::streams::{Stream, streams};
use super::write_deform::Deformation;
use crate::WriteOptions;
use crate::error::Unwritable;
use crate::loss::Losses;
use crate::weld::{n_merged, n_merged_if_equal};

/// An object with the data that is needed to write it.
pub(super) struct PreparedObject<'a> {
    pub(super) object: &'a Object,
    pub(super) mesh: &'a Mesh,
    pub(super) streams: Vec<Stream<'a>>,
    pub(super) deformation: Deformation<'a>,
    pub(super) split: Split,
    pub(super) bounds: Bounds,
    pub(super) faces: BTreeMap<i32, Faces>,
}

impl<'a> PreparedObject<'a> {
    /// Converts an object to the form that glTF requires, and adds losses for the content that is not written.
    ///
    /// # Errors
    ///
    /// Returns an error if there are too many vertices, or if glTF cannot store the position of a vertex.
    pub(super) fn new(
        object: &'a Object,
        mesh: &'a Mesh,
        graph: &Graph,
        options: &WriteOptions,
        losses: &mut Losses,
    ) -> Result<Self, Unwritable> {
        let deformation = Deformation::new(object, mesh, graph, options.weight_sets, losses);
        let streams = streams(mesh, |target| deformation.has_deltas(target), losses);
        let mut split = split(mesh, &streams);
        if split.n >= u32::MAX as usize {
            let (max, n) = (u32::MAX, split.n);
            let message = format!(
                "a mesh in a glTF file must have fewer than {max} vertices, but this mesh needs {n}"
            );
            return Err(Unwritable::object(&object.name, message));
        }
        for stream in &streams {
            note_changed(stream, mesh, &split, losses);
        }
        let isolated = mesh.n_isolated_vertices();
        let reason = "isolated vertices: only triangles are written to glTF";
        losses.add(Domain::Vertex, "position", isolated, reason);
        let reason = "coincident vertices, which readers of glTF merge";
        let merged = if deformation.is_none() {
            n_merged(mesh)
        } else {
            n_merged_if_equal(mesh, |a, b| deformation.compare(a, b))
        };
        losses.add(Domain::Vertex, "position", merged, reason);
        let polygons = parallel::count(mesh.domain_len(Domain::Face), |f| {
            let f = FaceId::new(f);
            mesh.has_face(f) && !mesh.is_triangle(f)
        });
        let reason = "only triangles are written to glTF, so polygons are triangulated";
        losses.add(Domain::Face, "polygon", polygons, reason);
        let is_empty = usize::from(mesh.n_faces() == 0);
        let reason = "glTF cannot store meshes without faces, so the object is not written";
        losses.add(None, "mesh", is_empty, reason);
        let bounds = bounds(mesh, &split).map_err(|v| {
            let message = format!(
                "the position {} of the vertex {v} exceeds the range of the 32-bit floats of glTF",
                mesh.position(v)
            );
            Unwritable::object(&object.name, message)
        })?;
        let mut faces = faces_by_material(object, mesh, &split, polygons > 0, losses);
        if options.compression.is_some() {
            reorder(mesh, &mut split, &mut faces);
        }
        Ok(Self {
            object,
            mesh,
            streams,
            deformation,
            split,
            bounds,
            faces,
        })
    }

    /// The number of sets of texture coordinates that are written.
    pub(super) fn n_uvs(&self) -> u32 {
        let is_uv = |stream: &&Stream| {
            stream.target.is_none() && matches!(stream.semantic, Semantic::TexCoords(_))
        };
        let count = self.streams.iter().filter(is_uv).count();
        u32::try_from(count).unwrap_or(u32::MAX)
    }
}
