//! Counting what a glTF file holds, from its JSON alone.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::File;
use std::io::Read;
use std::path::Path;

use gltf_json::Index;
use gltf_json::mesh::{Mode, Semantic};
use gltf_json::validation::Checked;

use super::JsonError;
use super::accessor::Reader;
use super::budget::Budget;
use super::document::Document;
use super::nodes::placed_meshes;
use super::read::parse;
use crate::asset_path::read_plain;
use crate::error::ReadError;
use crate::names::Names;
use crate::note::Notes;
use crate::peek::{PeekGeometry, PeekMesh, PeekObject};

/// The largest JSON chunk of a GLB file that is looked at, in bytes.
const LARGEST_JSON: usize = 1 << 30;

/// The counts of the objects of a glTF file: only its JSON is read.
///
/// # Errors
///
/// As [`read`], as far as it looks.
pub(crate) fn peek(path: &Path, name: &str) -> Result<Vec<PeekObject>, ReadError> {
    let io = |source| ReadError::io(path, source);
    // The header, the length of the first chunk, and no more.
    let head = read_plain(path, 20).map_err(io)?;
    let json = match head.as_slice() {
        [b'g', b'l', b'T', b'F', .., a, b, c, d, _, _, _, _] if head.len() == 20 => {
            let length = u32::from_le_bytes([*a, *b, *c, *d]) as usize;
            let end = 20 + length.min(LARGEST_JSON) as u64;
            let mut bytes = Vec::new();
            File::open(path)
                .map_err(io)?
                .take(end)
                .read_to_end(&mut bytes)
                .map_err(io)?;
            bytes.split_off(bytes.len().min(20))
        }
        _ => read_plain(path, u64::MAX).map_err(io)?,
    };
    let in_file = |error: JsonError| error.in_file(path);
    let length = json.len();
    let json = parse(path, &json)?;
    let mut notes = Notes::of(path);
    let budget = Budget::of(length);
    let document = Document::new(&json, &budget, &mut notes).map_err(in_file)?;
    let reader = Reader::new(&document, &[], &budget);
    let mut meshes = BTreeMap::new();
    let mut names = Names::default();
    let mut objects = Vec::new();
    for placed in placed_meshes(&document, &mut notes).map_err(in_file)? {
        let mesh = match meshes.get(&placed.mesh) {
            Some(&known) => known,
            None => peek_mesh(&reader, placed.mesh).map_err(in_file)?,
        };
        meshes.insert(placed.mesh, mesh);
        let name = placed.name(&document, name);
        placed.spend(name, &budget).map_err(in_file)?;
        let name = names.unique(name, &mut notes);
        objects.push(PeekObject {
            name,
            geometry: PeekGeometry::Mesh(mesh),
        });
    }
    Ok(objects)
}

fn peek_mesh(reader: &Reader, index: usize) -> Result<PeekMesh, JsonError> {
    let mut counts = PeekMesh::default();
    let mut known = BTreeSet::new();
    for (i, primitive) in reader.document.meshes[index].primitives.iter().enumerate() {
        let here = format!("/meshes/{index}/primitives/{i}");
        let has = |semantic| primitive.attributes.contains_key(&Checked::Valid(semantic));
        let position = primitive
            .attributes
            .get(&Checked::Valid(Semantic::Positions));
        let Some(position) = position.map(Index::value) else {
            continue;
        };
        let vertices = reader.count(position, &format!("{here}/attributes/POSITION"))?;
        let corners = match primitive.indices {
            Some(indices) => reader.count(indices.value(), &format!("{here}/indices"))?,
            None => vertices,
        };
        let triangles = match primitive.mode {
            Checked::Valid(Mode::Triangles) => corners / 3,
            Checked::Valid(Mode::TriangleStrip | Mode::TriangleFan) => corners.saturating_sub(2),
            _ => continue,
        };
        counts.add_faces(triangles, 3);
        let attributes: Vec<_> = primitive
            .attributes
            .iter()
            .map(|(k, a)| (k.clone(), a.value()))
            .collect();
        if known.insert(attributes) {
            counts.vertices = counts.vertices.saturating_add(vertices);
        }
        counts.uvs |= has(Semantic::TexCoords(0));
        counts.normals |= has(Semantic::Normals);
        counts.colors |= has(Semantic::Colors(0));
        counts.materials |= primitive.material.is_some();
    }
    Ok(counts)
}
