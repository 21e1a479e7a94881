//! Decodes primitives that are compressed by Draco, with the extension `KHR_draco_mesh_compression`.
//!
//! ```text
//! primitive       attributes, indices: accessors without buffer views
//!  `- extension   bufferView: the location of the stream
//!                 attributes: the ids of the attributes in the stream
//! ```
//!
//! The crate `draco-core` decodes the streams. The results become additional buffers with a buffer view for each
//! accessor, so the other modules of the reader find uncompressed data. If an accessor also has uncompressed data, that
//! data is read instead of the decoded data.

use std::borrow::Cow;

use draco_core::{DataType, DecodeLimits, DecoderBuffer, Mesh, MeshDecoder, PointIndex};
use gltf_json::Index;
use gltf_json::accessor::ComponentType;
use gltf_json::buffer::View;
use gltf_json::mesh::{Mode, Semantic};
use gltf_json::validation::Checked;
use serde::Deserialize;
use serde_json::json;

use super::budget::Budget;
use super::document::Document;
use super::draco_json::Compressed;
use super::numbers::kinds;
use super::reference::get;
use super::views::Reader;
use crate::fault::Fault;

/// The approximate memory in bytes that decoding needs for each face and each vertex, in addition to the result.
const WORK: u64 = 64;

/// The maximum size in bytes of all attributes of a vertex together, including attributes that are not read.
const LARGEST: u64 = 512;

/// Decodes all compressed primitives into additional buffers of the document.
///
/// # Errors
///
/// Returns an error for the first primitive that cannot be decoded or does not match its accessors.
pub(super) fn decode(
    document: &mut Document,
    buffers: &mut Vec<Cow<'_, [u8]>>,
    budget: &Budget,
) -> Result<(), Fault> {
    for compressed in std::mem::take(&mut document.draco) {
        let arrays = arrays(&Reader::new(document, buffers, budget), &compressed)?;
        for (accessor, bytes) in arrays {
            let view = json!({ "buffer": buffers.len(), "byteLength": bytes.len() });
            let view = View::deserialize(view)
                .map_err(|e| Fault::json(compressed.pointer(), e.to_string()))?;
            let accessor = &mut document.accessors[accessor];
            accessor.buffer_view = Some(Index::new(
                u32::try_from(document.views.len()).unwrap_or(u32::MAX),
            ));
            accessor.byte_offset = None;
            document.views.push(view);
            document.compressed.push(None);
            buffers.push(Cow::Owned(bytes));
        }
    }
    Ok(())
}

/// Decodes the stream of a primitive. Returns the bytes of each accessor that has data in the stream and no
/// uncompressed data.
fn arrays(reader: &Reader, compressed: &Compressed) -> Result<Vec<(usize, Vec<u8>)>, Fault> {
    let at = compressed.pointer();
    let document = reader.document;
    let primitive = &document.meshes[compressed.mesh].primitives[compressed.primitive];
    let wrong = |message: String| Fault::json(at.clone(), message);
    let (Some(indices), Checked::Valid(Mode::Triangles)) = (primitive.indices, primitive.mode)
    else {
        return Err(wrong("expected triangles with indices".to_owned()));
    };
    let indices = indices.value();
    let position = primitive
        .attributes
        .get(&Checked::Valid(Semantic::Positions));
    let position = position.ok_or_else(|| wrong("expected an attribute `POSITION`".to_owned()))?;
    let (n_corners, n_points) = (
        reader.count(indices, &at)?,
        reader.count(position.value(), &at)?,
    );
    let is_missing = |accessor: usize| {
        let accessor = document.accessors.get(accessor);
        accessor.is_some_and(|a| a.buffer_view.is_none() && a.sparse.is_none())
    };
    let mut wanted = Vec::new();
    for (semantic, accessor) in &primitive.attributes {
        let Checked::Valid(semantic) = semantic else {
            continue;
        };
        let (accessor, name) = (accessor.value(), semantic.to_string());
        let id = compressed.extension.attributes.get(&name);
        if let (Some(id), true) = (id, is_missing(accessor)) {
            let json = get(&document.accessors, accessor, &at, "accessor")?;
            let (kind, component) = kinds(json, &format!("/accessors/{accessor}"))?;
            wanted.push((accessor, name, *id, kind.multiplicity(), component));
        }
    }
    // The memory that the decoder allocates depends on the counts that the file declares. The size of this memory is
    // subtracted from the memory budget before the decoder starts. Therefore, counts that are too high cause an error.
    let size: usize = wanted
        .iter()
        .map(|(.., n, component)| n * component.size())
        .sum();
    let length = n_points
        .saturating_mul(size as u64)
        .saturating_add(n_corners.saturating_mul(4));
    reader.budget.inflate(length, &at)?;
    let work = n_points.saturating_add(n_corners / 3).saturating_mul(WORK);
    reader.budget.spend(work, &at)?;

    let stream = reader.view(
        compressed.extension.buffer_view,
        format_args!("{at}/bufferView"),
    )?;
    let limits = DecodeLimits::default()
        .with_max_points(n_points)
        .with_max_faces(n_corners / 3)
        .with_max_decoded_bytes(n_points.saturating_mul(LARGEST));
    let mut input = DecoderBuffer::new(stream).with_limits(limits);
    let mut mesh = Mesh::new();
    MeshDecoder::new()
        .decode(&mut input, &mut mesh)
        .map_err(|e| wrong(format!("the Draco stream cannot be decoded: {e}")))?;
    let (n_faces, n) = (mesh.num_faces() as u64, mesh.num_points());
    if n_faces.saturating_mul(3) != n_corners || n as u64 != n_points {
        return Err(wrong(format!(
            "the accessors declare {n_corners} indices and {n_points} vertices, but the Draco stream has {} indices \
             and {n} vertices",
            3 * n_faces
        )));
    }
    let mut arrays = Vec::new();
    if is_missing(indices) {
        let json = get(&document.accessors, indices, &at, "accessor")?;
        let (_, component) = kinds(json, &format!("/accessors/{indices}"))?;
        arrays.push((
            indices,
            index_bytes(&mesh, component.size(), n_points, &at)?,
        ));
    }
    for (accessor, name, id, components, component) in wanted {
        let bytes = attribute_bytes(&mesh, id, components, component)
            .map_err(|why| wrong(format!("attribute {name}: {why}")))?;
        if arrays.iter().all(|(known, _)| *known != accessor) {
            arrays.push((accessor, bytes));
        }
    }
    Ok(arrays)
}

/// The corners of the faces, as integers of `size` bytes.
fn index_bytes(mesh: &Mesh, size: usize, n_points: u64, at: &str) -> Result<Vec<u8>, Fault> {
    let mut bytes = Vec::with_capacity(3 * size * mesh.num_faces());
    for point in mesh.faces().iter().flatten() {
        let fits = u64::from(point.0) < n_points.min(1 << (8 * size.min(4)));
        if !fits {
            let message = format!("vertex {} of the Draco stream does not exist", point.0);
            return Err(Fault::json(at, message));
        }
        bytes.extend_from_slice(&point.0.to_le_bytes()[..size.min(4)]);
    }
    Ok(bytes)
}

/// The values of an attribute for each vertex.
fn attribute_bytes(
    mesh: &Mesh,
    id: u32,
    components: usize,
    component: ComponentType,
) -> Result<Vec<u8>, String> {
    let attribute = mesh.attribute_by_unique_id(id);
    let attribute = attribute.ok_or_else(|| format!("the Draco stream has no attribute {id}"))?;
    let expected = match component {
        ComponentType::I8 => DataType::Int8,
        ComponentType::U8 => DataType::Uint8,
        ComponentType::I16 => DataType::Int16,
        ComponentType::U16 => DataType::Uint16,
        ComponentType::U32 => DataType::Uint32,
        ComponentType::F32 => DataType::Float32,
    };
    let found = (
        attribute.data_type(),
        usize::from(attribute.num_components()),
    );
    if found != (expected, components) {
        return Err(format!(
            "expected {components} numbers of type {expected:?} for each element of the accessor, found {} numbers of type {:?} in the Draco stream",
            found.1, found.0
        ));
    }
    let size = components * component.size();
    let stride = usize::try_from(attribute.byte_stride())
        .unwrap_or(0)
        .max(size);
    let values = attribute.buffer().data();
    let mut bytes = Vec::with_capacity(size * mesh.num_points());
    for point in (0..).take(mesh.num_points()) {
        let value = attribute.mapped_index(PointIndex(point)).0 as usize;
        let start = value.checked_mul(stride);
        let value = start.and_then(|start| values.get(start..start.checked_add(size)?));
        bytes.extend_from_slice(value.ok_or_else(|| format!("vertex {point} has no value"))?);
    }
    Ok(bytes)
}
