//! From a scene to a glTF document and its bytes.
//!
//! Everything is counted first, so that the document is known before its bytes: those are then written
//! once, in parallel, to where they stay.

use std::path::Path;

use gltf_json::{Buffer, Root};
use scene::{Geometry, Scene};

use super::pieces::{Piece, container, fill};
use super::prepare::Prepared;
use super::write_document::Writer;
use super::write_materials::MaterialWriter;
use crate::dense::dense;
use crate::error::Unwritable;
use crate::loss::Losses;
use crate::{WriteOptions, Written};

/// The files that hold `scene`, to be renamed in this order, and what they do not hold.
///
/// # Errors
///
/// If an object is no mesh, or the scene does not fit the lengths of the format.
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
            return Err(Unwritable::object(
                &object.name,
                format!("glTF files hold meshes, found {}", object.geometry.kind()),
            ));
        };
        meshes.push(dense(mesh));
    }
    let mut prepared = Vec::new();
    for (object, mesh) in scene.objects().iter().zip(&meshes) {
        let mut losses = Losses::of(&object.name, &mut losses);
        prepared.push(Prepared::new(object, mesh, &mut losses)?);
    }
    let mut writer = Writer::new(options);
    for prepared in &prepared {
        let mut losses = Losses::of(&prepared.object.name, &mut losses);
        writer.object(prepared, &mut losses);
    }
    let Writer {
        mut root,
        pieces,
        materials,
        ..
    } = writer;
    // A scene without nodes says nothing.
    if root.nodes.is_empty() {
        (root.scene, root.scenes) = (None, Vec::new());
    }
    let length = pieces.last().map_or(0, Piece::end);
    if u32::try_from(length).is_err() {
        let message = format!("a glTF file holds less than 4 GB, the scene needs {length} bytes");
        return Err(Unwritable::Scene { message });
    }
    if binary {
        add_buffer(&mut root, length, None);
        let glb = container(&to_json(&root, materials)?, length, &pieces)?;
        return Ok(Written {
            files: vec![(path.to_path_buf(), glb)],
            losses,
        });
    }
    let binary_path = path.with_extension("bin");
    let uri = binary_path
        .file_name()
        .map(|name| percent_encoded(&name.to_string_lossy()));
    add_buffer(&mut root, length, uri);
    let mut files = vec![(path.to_path_buf(), to_json(&root, materials)?)];
    if length > 0 {
        let mut bytes = mesh::zeroed(length);
        fill(&mut bytes, &pieces);
        files.insert(0, (binary_path, bytes));
    }
    Ok(Written { files, losses })
}

fn add_buffer(root: &mut Root, length: usize, uri: Option<String>) {
    if length > 0 {
        let byte_length = length.into();
        root.buffers.push(Buffer {
            byte_length,
            name: None,
            uri,
            extensions: None,
            extras: None,
        });
    }
}

fn to_json(root: &Root, materials: MaterialWriter) -> Result<Vec<u8>, Unwritable> {
    let error = |e: serde_json::Error| Unwritable::Scene {
        message: e.to_string(),
    };
    let mut json = serde_json::to_value(root).map_err(error)?;
    if let Some(members) = json.as_object_mut() {
        materials.insert_into(members);
    }
    serde_json::to_vec(&json).map_err(error)
}

/// A file name as a URI reference (RFC 3986): all but the unreserved characters are escaped.
pub(super) fn percent_encoded(name: &str) -> String {
    let encode = |byte: u8| match byte {
        b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'-' | b'.' | b'_' | b'~' => {
            char::from(byte).to_string()
        }
        _ => format!("%{byte:02X}"),
    };
    name.bytes().map(encode).collect()
}
