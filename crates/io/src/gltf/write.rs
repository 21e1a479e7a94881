//! Writes a scene to a glTF document and its bytes.
//!
//! The sizes and positions of all parts of the buffer are determined first. After the document is complete, all threads
//! together write the parts directly to their positions in the buffer, one part after the other.

use std::path::Path;

use scene::{Geometry, Scene};

use super::pieces::{Piece, container, container_length, fill};
use super::prepare::PreparedObject;
use super::write_document::Writer;
use crate::assets::percent_encoded;
use crate::error::Unwritable;
use crate::loss::{Loss, Losses};
use crate::writing::dense;
use crate::{Format, PackingReport, WriteOptions, Written, gzip};

/// Converts `scene` to the bytes of files, and lists the content that the files do not store. The returned files are in
/// the order in which they must be saved.
///
/// # Errors
///
/// Returns an error if an object is not a mesh, or if the scene exceeds the size limits of the format.
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
            return Err(Unwritable::kind(Format::Gltf, object));
        };
        meshes.push(dense(mesh));
    }
    let mut prepared = Vec::new();
    for (object, mesh) in scene.objects().iter().zip(&meshes) {
        let mut losses = Losses::of(&object.name, &mut losses);
        prepared.push(PreparedObject::new(
            object,
            mesh,
            scene.graph(),
            options,
            &mut losses,
        )?);
    }
    let path = path.to_path_buf();
    let binary_path = gzip::plain(&path).with_extension("bin");
    let name = binary_path.file_name();
    let uri = name.map(|name| percent_encoded(&name.to_string_lossy()));
    let uri = uri.as_deref().filter(|_| !binary);
    let is_packed = options.compression.is_some() || options.quantization.is_some();
    let plain = WriteOptions {
        compression: None,
        quantization: None,
        ..options.clone()
    };
    let bytes_before = if is_packed {
        let writer = document(&prepared, scene, &plain, &mut Vec::new())?;
        let (json, pieces) = writer.into_json(options, uri);
        let length = pieces.last().map_or(0, Piece::end);
        if binary {
            container_length(json.len(), length)
        } else {
            json.len() + length
        }
    } else {
        0
    };
    let mut writer = document(&prepared, scene, options, &mut losses)?;
    let packing = is_packed.then(|| PackingReport {
        bytes_before: bytes_before as u64,
        ..std::mem::take(&mut writer.quantizer.report)
    });
    let (json, pieces) = writer.into_json(options, uri);
    let length = pieces.last().map_or(0, Piece::end);
    if u32::try_from(length).is_err() {
        let message =
            format!("a glTF file must be smaller than 4 GiB, but the scene needs {length} bytes");
        return Err(Unwritable::scene(message));
    }
    let mut files = Vec::new();
    if binary {
        files.push((path, container(&json, length, &pieces)?));
    } else {
        if length > 0 {
            let mut bytes = mesh::zeroed(length);
            fill(&mut bytes, &pieces);
            files.push((binary_path, bytes));
        }
        files.push((path, json));
    }
    let bytes_after = files.iter().map(|(_, bytes)| bytes.len() as u64).sum();
    let packing = packing.map(|report| PackingReport {
        bytes_after,
        ..report
    });
    Ok(Written {
        files,
        losses,
        packing,
    })
}

/// Builds the document without writing the bytes of its buffer.
fn document<'a>(
    prepared: &'a [PreparedObject<'a>],
    scene: &'a Scene,
    options: &WriteOptions,
    losses: &mut Vec<Loss>,
) -> Result<Writer<'a>, Unwritable> {
    let mut writer = Writer::new(options);
    for prepared in prepared {
        let mut losses = Losses::of(&prepared.object.name, losses);
        writer.object(prepared, scene.graph(), &mut losses)?;
    }
    let mut losses = Losses::of("", losses);
    writer.nodes(scene, &mut losses)?;
    writer.rig(scene, &mut losses)?;
    Ok(writer)
}
