//! Writes a scene to a glTF document and its bytes.
//!
//! All sizes are determined first, so that the document is complete before any bytes of the buffer are written.
//! The bytes are then written once, in parallel, directly to their positions.

use std::path::Path;

use scene::{Geometry, Scene};

use super::pieces::{Piece, container, fill};
use super::prepare::PreparedObject;
use super::write_document::Writer;
use crate::assets::percent_encoded;
use crate::error::Unwritable;
use crate::loss::Losses;
use crate::writing::dense;
use crate::{WriteOptions, Written, gzip};

/// Converts `scene` to the bytes of files, and lists what the files do not store. The files are in the order in
/// which they must be renamed.
///
/// # Errors
///
/// If an object is not a mesh, or if the scene exceeds the size limits of the format.
pub(crate) fn write(
    path: &Path,
    binary: bool,
    scene: &Scene,
    options: &WriteOptions,
) -> Result<Written, Unwritable> {
    let mut losses = Vec::new();
    let mut meshes = Vec::new();
    for object in scene.objects() {
        let Geometry::Mesh(mesh) = &object.geometry else {
            return Err(Unwritable::kind("glTF files store meshes", object));
        };
        meshes.push(dense(mesh));
    }
    let mut prepared = Vec::new();
    for (object, mesh) in scene.objects().iter().zip(&meshes) {
        let mut losses = Losses::of(&object.name, &mut losses);
        prepared.push(PreparedObject::new(object, mesh, &mut losses)?);
    }
    let mut writer = Writer::default();
    for prepared in &prepared {
        let mut losses = Losses::of(&prepared.object.name, &mut losses);
        writer.object(prepared, scene.graph(), &mut losses)?;
    }
    writer.nodes(scene)?;
    let length = writer.pieces.last().map_or(0, Piece::end);
    if u32::try_from(length).is_err() {
        let message =
            format!("a glTF file must be smaller than 4 GiB, but the scene needs {length} bytes");
        return Err(Unwritable::scene(message));
    }
    let path = path.to_path_buf();
    if binary {
        let (json, pieces) = writer.into_json(options, None);
        let files = vec![(path, container(&json, length, &pieces)?)];
        return Ok(Written { files, losses });
    }
    let binary_path = gzip::plain(&path).with_extension("bin");
    let name = binary_path.file_name();
    let uri = name.map(|name| percent_encoded(&name.to_string_lossy()));
    let (json, pieces) = writer.into_json(options, uri.as_deref());
    let mut files = vec![(path, json)];
    if length > 0 {
        let mut bytes = mesh::zeroed(length);
        fill(&mut bytes, &pieces);
        files.insert(0, (binary_path, bytes));
    }
    Ok(Written { files, losses })
}
