//! Counts the content of a glTF file from its JSON alone.

use std::collections::{BTreeMap, BTreeSet};

use gltf_json::Index;
use gltf_json::mesh::{Mode, Semantic};
use gltf_json::validation::Checked;

use super::budget::Budget;
use super::document::Document;
use super::nodes::placed_meshes;
use super::primitives::attributes;
use super::read::parse;
use super::views::Reader;
use crate::Placements;
use crate::fault::Fault;
use crate::note::Notes;
use crate::peek::{PeekGeometry, PeekMesh, PeekObject};

/// Returns the counts of the objects of a glTF file from its JSON.
///
/// # Errors
///
/// As [`read`](super::read()), for the parts that are checked.
pub(crate) fn peek(
    json: &[u8],
    name: &str,
    placements: Placements,
    notes: &mut Notes,
) -> Result<Vec<PeekObject>, Fault> {
    let budget = Budget::of(json.len());
    let document = Document::new(&parse(json)?, &budget, notes)?;
    let reader = Reader::new(&document, &[], &budget);
    let mut meshes = BTreeMap::new();
    let mut objects = Vec::new();
    let (placed, _) = placed_meshes(&document, placements, name, &budget, notes)?;
    for placed in placed {
        let mesh = match meshes.get(&placed.mesh) {
            Some(&known) => known,
            None => peek_mesh(&reader, placed.mesh)?,
        };
        meshes.insert(placed.mesh, mesh);
        objects.push(PeekObject {
            name: placed.name,
            instances: placed.instances,
            geometry: PeekGeometry::Mesh(mesh),
        });
    }
    Ok(objects)
}

fn peek_mesh(reader: &Reader, index: usize) -> Result<PeekMesh, Fault> {
    let mut counts = PeekMesh::default();
    let mut known = BTreeSet::new();
    for (i, primitive) in reader.document.meshes[index].primitives.iter().enumerate() {
        let here = format!("/meshes/{index}/primitives/{i}");
        let has = |semantic| primitive.attributes.contains_key(&Checked::Valid(semantic));
        let position = Checked::Valid(Semantic::Positions);
        let Some(position) = primitive.attributes.get(&position).map(Index::value) else {
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
        if known.insert(attributes(primitive)) {
            counts.vertices = counts.vertices.saturating_add(vertices);
        }
        counts.uvs |= has(Semantic::TexCoords(0));
        counts.normals |= has(Semantic::Normals);
        counts.colors |= has(Semantic::Colors(0));
        counts.materials |= primitive.material.is_some();
    }
    Ok(counts)
}
