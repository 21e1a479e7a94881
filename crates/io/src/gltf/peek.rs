//! Counts the content of a glTF file from its JSON alone.

use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};

use gltf_json::Index;
use gltf_json::mesh::{Mode, Semantic};
use gltf_json::validation::Checked;
use scene::Graph;

use super::budget::Budget;
use super::document::Document;
use super::materials::{image_paths, material_name};
use super::nodes::placed_meshes;
use super::primitives::attributes;
use super::read::parse;
use super::rig::RigReader;
use super::rig_json::Deformers;
use super::views::Reader;
use crate::Placements;
use crate::assets::Assets;
use crate::fault::Fault;
use crate::images::note_missing;
use crate::note::Notes;
use crate::peek::{PeekGeometry, PeekMesh, PeekObject};

/// Returns the counts of the objects of a glTF file from its JSON, and notes on content that is left out.
///
/// # Errors
///
/// The errors of [`read`](super::read()) for the parts that are checked.
pub(crate) fn peek(
    json: &[u8],
    name: &str,
    placements: Placements,
    assets: &mut Assets,
    graph: &mut Graph,
    notes: &mut Notes,
) -> Result<Vec<PeekObject>, Fault> {
    let budget = Budget::of(json.len());
    let document = Document::new(&parse(json)?, &budget, notes)?;
    let reader = Reader::new(&document, &[], &budget);
    let mut meshes: BTreeMap<usize, (PeekMesh, BTreeSet<usize>)> = BTreeMap::new();
    let mut objects = Vec::new();
    let deformers = Deformers::of_meshes(&document);
    let mut nodes = placed_meshes(&document, placements, name, &budget, notes)?;
    *graph = std::mem::take(&mut nodes.graph);
    if placements == Placements::Keep {
        RigReader::without_numbers(&reader).fill(&nodes, graph, notes)?;
    }
    for placed in nodes.meshes {
        let (mesh, materials) = match meshes.entry(placed.mesh) {
            Entry::Occupied(known) => known.into_mut(),
            Entry::Vacant(new) => {
                let (mut mesh, materials) = peek_mesh(&reader, placed.mesh)?;
                let deformers = deformers[placed.mesh];
                mesh.targets = deformers.targets as u64;
                if placements == Placements::Keep {
                    mesh.joints = deformers.n_joints() as u64;
                }
                new.insert((mesh, materials))
            }
        };
        let names = materials.iter().map(|&i| material_name(&document, i));
        objects.push(PeekObject {
            name: placed.name,
            geometry: PeekGeometry::Mesh(*mesh),
            materials: Some(names.collect()),
        });
    }
    let used: BTreeSet<usize> = meshes.into_values().flat_map(|(_, used)| used).collect();
    let paths: Vec<String> = used
        .iter()
        .flat_map(|&i| image_paths(&document, i))
        .collect();
    note_missing(paths.iter().map(String::as_str), assets, notes);
    Ok(objects)
}

/// Returns the counts of a mesh, and the materials that it uses.
fn peek_mesh(reader: &Reader, index: usize) -> Result<(PeekMesh, BTreeSet<usize>), Fault> {
    let mut counts = PeekMesh::default();
    let mut materials = BTreeSet::new();
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
        let material = primitive.material.map(|material| material.value());
        let exists = |&i: &usize| triangles > 0 && i < reader.document.materials.len();
        materials.extend(material.filter(exists));
    }
    Ok((counts, materials))
}
