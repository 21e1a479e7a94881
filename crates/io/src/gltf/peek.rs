//! Counts the objects in a glTF file, and their elements. Only the JSON of the file is read, not its buffers.

use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};

use gltf_json::Index;
use gltf_json::accessor::Type;
use gltf_json::mesh::{Mode, Semantic};
use gltf_json::validation::Checked;
use mesh::Domain;
use scene::Graph;

use super::budget::Budget;
use super::deform::Directions;
use super::deformers::Deformers;
use super::document::Document;
use super::left_out::note_left_out;
use super::materials::{image_paths, material_name};
use super::morph_values::ValueChanges;
use super::names::attribute_name;
use super::nodes::placed_meshes;
use super::primitives::attributes;
use super::read::parse;
use super::rig::RigReader;
use super::views::Reader;
use crate::Placements;
use crate::assets::Assets;
use crate::fault::Fault;
use crate::images::note_missing;
use crate::note::Notes;
use crate::peek::{PeekGeometry, PeekMesh, PeekObject};

/// Returns the objects of a glTF file with their element counts, and notes on content that is left out. Only the JSON
/// of the file is used.
///
/// # Errors
///
/// Returns the same errors as [`read`](super::read()), but only for the parts that are checked.
pub(crate) fn peek(
    json: &[u8],
    name: &str,
    placements: Placements,
    assets: &mut Assets,
    graph: &mut Graph,
    notes: &mut Notes,
) -> Result<Vec<PeekObject>, Fault> {
    let budget = Budget::of(json.len());
    let json = parse(json)?;
    let document = Document::new(&json, &budget, notes)?;
    note_left_out(&json, &document, notes);
    drop(json);
    let reader = Reader::new(&document, &[], &budget);
    let mut meshes: BTreeMap<usize, Counted> = BTreeMap::new();
    let mut objects = Vec::new();
    let deformers = Deformers::of_meshes(&document);
    let mut nodes = placed_meshes(&document, placements, name, &budget, notes)?;
    *graph = std::mem::take(&mut nodes.graph);
    if placements == Placements::Keep {
        RigReader::without_numbers(&reader).fill(&nodes, graph, notes)?;
    }
    for placed in nodes.meshes {
        let counted = match meshes.entry(placed.mesh) {
            Entry::Occupied(known) => known.into_mut(),
            Entry::Vacant(new) => {
                let deformers = deformers[placed.mesh];
                let mut counted = peek_mesh(&reader, placed.mesh, deformers, notes)?;
                counted.mesh.targets = deformers.targets as u64;
                if placements == Placements::Keep {
                    counted.mesh.joints = deformers.n_joints() as u64;
                }
                new.insert(counted)
            }
        };
        let names = counted
            .materials
            .iter()
            .map(|&i| material_name(&document, i));
        // A corner attribute becomes a vertex attribute if all corners of each vertex have the same value.
        let domains = [Domain::Vertex, Domain::Corner];
        let attributes =
            (counted.names.iter()).flat_map(|name| domains.map(|domain| (domain, name.clone())));
        objects.push(PeekObject {
            name: placed.name,
            geometry: PeekGeometry::Mesh(counted.mesh),
            materials: Some(names.collect()),
            attributes: Some(attributes.collect()),
        });
    }
    let used: BTreeSet<usize> = meshes.into_values().flat_map(|m| m.materials).collect();
    let paths: Vec<String> = used
        .iter()
        .flat_map(|&i| image_paths(&document, i))
        .collect();
    note_missing(paths.iter().map(String::as_str), assets, notes);
    Ok(objects)
}

/// The content of a mesh that the JSON describes.
struct Counted {
    mesh: PeekMesh,
    /// The materials that the mesh uses.
    materials: BTreeSet<usize>,
    /// The names of the attributes that [`PeekMesh`] does not describe.
    names: BTreeSet<String>,
}

/// Returns the content of a mesh, and adds notes on content that is left out.
fn peek_mesh(
    reader: &Reader,
    index: usize,
    deformers: Deformers,
    notes: &mut Notes,
) -> Result<Counted, Fault> {
    let mut counts = PeekMesh::default();
    let mut materials = BTreeSet::new();
    let mut names = BTreeSet::new();
    let mut known = BTreeSet::new();
    let mut left_out: BTreeMap<String, usize> = BTreeMap::new();
    let (mut points, mut lines) = (0, 0);
    let primitives = &reader.document.meshes[index].primitives;
    names.extend(Directions::normals(primitives).names());
    names.extend(Directions::tangents(primitives).names());
    names.extend(ValueChanges::new(&reader.document.value_changes[index]).names());
    for (i, primitive) in primitives.iter().enumerate() {
        let here = format!("/meshes/{index}/primitives/{i}");
        match primitive.mode {
            Checked::Valid(Mode::Points) => points += 1,
            Checked::Valid(Mode::Lines | Mode::LineLoop | Mode::LineStrip) => lines += 1,
            _ => {}
        }
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
            for (semantic, accessor) in attributes(primitive) {
                match attribute(reader, &semantic, accessor, deformers) {
                    Found::Described => {}
                    Found::Named(name) => {
                        names.insert(name);
                    }
                    Found::LeftOut(name) => *left_out.entry(name).or_default() += 1,
                }
            }
        }
        counts.uvs |= has(Semantic::TexCoords(0));
        counts.normals |= has(Semantic::Normals);
        counts.colors |= has(Semantic::Colors(0));
        counts.materials |= primitive.material.is_some();
        let material = primitive.material.map(|material| material.value());
        let exists = |&i: &usize| triangles > 0 && i < reader.document.materials.len();
        materials.extend(material.filter(exists));
    }
    notes.left_out("points", points, None, "primitives of points left out");
    notes.left_out("polylines", lines, None, "primitives of lines left out");
    for (name, count) in left_out {
        notes.left_out(
            "attributes",
            count,
            None,
            format!("attributes {name} left out"),
        );
    }
    Ok(Counted {
        mesh: counts,
        materials,
        names,
    })
}

/// What the reader does with an attribute of a primitive.
enum Found {
    /// The reader keeps the attribute, and the fields of [`PeekMesh`] describe it.
    Described,
    /// The mesh gets an attribute with this name.
    Named(String),
    /// The attribute is left out.
    LeftOut(String),
}

fn attribute(
    reader: &Reader,
    semantic: &Checked<Semantic>,
    accessor: usize,
    deformers: Deformers,
) -> Found {
    let Checked::Valid(semantic) = semantic else {
        return Found::LeftOut("with unknown names".to_owned());
    };
    let kind = reader.document.accessors.get(accessor).map(|a| a.type_);
    let is_matrix = matches!(
        kind,
        Some(Checked::Valid(Type::Mat2 | Type::Mat3 | Type::Mat4))
    );
    match semantic {
        Semantic::Positions | Semantic::Normals | Semantic::TexCoords(0) | Semantic::Colors(0) => {
            Found::Described
        }
        Semantic::Joints(set) | Semantic::Weights(set) if *set < deformers.weight_sets => {
            Found::Described
        }
        _ => match attribute_name(semantic).filter(|_| !is_matrix) {
            Some(name) => Found::Named(name),
            None => Found::LeftOut(semantic.to_string()),
        },
    }
}
