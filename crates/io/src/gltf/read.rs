//! Converts a glTF document to objects.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::atomic::Ordering::Relaxed;

use glam::{DAffine3, DMat4, DVec3};
use mesh::{Attributes, Domain};
use scene::{Material, Pose};
use serde_json::Value;

use super::budget::Budget;
use super::buffers;
use super::deformers::Deformers;
use super::document::Document;
use super::draco;
use super::left_out::note_left_out;
use super::materials::Materials;
use super::nodes::{PlacedMesh, PlacedNodes, placed_meshes};
use super::primitives::{Triangles, triangles};
use super::rig::RigReader;
use super::views::Reader;
use crate::assets::Assets;
use crate::fault::Fault;
use crate::note::Notes;
use crate::polygons::gather;
use crate::text::{BYTE_ORDER_MARK, TextPosition};
use crate::{Parsed, ParsedObject, Placements, Polygons, Shape, weld};
use mesh::parallel;

/// Reads the objects of a glTF file from its bytes and from separate buffer files.
///
/// # Errors
///
/// Returns the first error in the file.
pub(crate) fn read(
    bytes: Vec<u8>,
    name: &str,
    placements: Placements,
    assets: &mut Assets,
    notes: &mut Notes,
) -> Result<Parsed, Fault> {
    // The bytes are kept until all objects are built, because accessors read from them directly.
    let bytes = bytes.into_boxed_slice();
    let (json, binary) = buffers::container(&bytes)?;
    let json = parse(json)?;
    let budget = Budget::of(bytes.len());
    let mut document = Document::new(&json, &budget, notes)?;
    note_left_out(&json, &document, notes);
    drop(json);
    let (buffers, fallbacks) = (&document.buffers, &document.fallbacks);
    let mut loaded = buffers::load(buffers, fallbacks, binary, &budget, assets)?;
    let size = loaded.iter().map(|buffer| buffer.len() as u64).sum();
    if document.compressed.iter().any(Option::is_some) {
        budget.grant_compressed(size);
    }
    if !document.draco.is_empty() {
        // A triangle takes only about one byte in a Draco stream. Therefore, Draco streams increase the memory budget
        // more than compressed views do.
        budget.grant_compressed(2 * size);
    }
    draco::decode(&mut document, &mut loaded, &budget)?;
    objects(
        &Reader::new(&document, &loaded, &budget),
        name,
        placements,
        notes,
    )
}

fn objects(
    reader: &Reader,
    name: &str,
    placements: Placements,
    notes: &mut Notes,
) -> Result<Parsed, Fault> {
    let document = reader.document;
    let mut nodes = placed_meshes(document, placements, name, reader.budget, notes)?;
    let deformers = Deformers::of_meshes(document);
    let mut rig = RigReader::new(reader);
    let placed = std::mem::take(&mut nodes.meshes);
    // For each mesh, the number of objects that still need it. The last of these objects takes the arrays of the mesh
    // instead of copying them.
    let mut uses = BTreeMap::new();
    for placed in &placed {
        *uses.entry(placed.mesh).or_insert(0) += 1;
    }
    let mut meshes = BTreeMap::new();
    let mut materials = Materials::new(reader);
    let mut objects = Vec::new();
    for placed in placed {
        let here = format!("/meshes/{}", placed.mesh);
        let triangles = match meshes.remove(&placed.mesh) {
            Some(triangles) => triangles,
            None => triangles(reader, placed.mesh, deformers[placed.mesh], notes)?,
        };
        reader.budget.spend(triangles.cost(), &here)?;
        let left = uses.entry(placed.mesh).or_default();
        *left -= 1;
        if *left > 0 {
            meshes.insert(placed.mesh, triangles.clone());
        }
        if triangles.corners.len() >= u32::MAX as usize {
            let message = format!(
                "expected fewer than {} corners in a mesh, found more",
                u32::MAX
            );
            return Err(Fault::json(here, message));
        }
        let (materials, places) = used_materials(&mut materials, &triangles)?;
        let cost: usize = materials.iter().map(cost_of_material).sum();
        reader.budget.spend(cost as u64, &here)?;
        let pose = pose(&placed, &nodes, &mut rig)?;
        let polygons = Polygons {
            materials,
            ..polygons(triangles, &places, &placed.to_scene, pose.as_ref(), notes)
        };
        let shape = Shape::Polygons(polygons);
        objects.push(ParsedObject {
            name: placed.name,
            shape,
        });
    }
    let mut graph = std::mem::take(&mut nodes.graph);
    if placements == Placements::Keep {
        rig.fill(&nodes, &mut graph, notes)?;
    }
    Ok(Parsed { objects, graph })
}

/// Returns the joints and morph weights that the reader applies to the points of a mesh. Returns `None` if the scene
/// keeps the nodes, which then place and deform the mesh.
///
/// # Errors
///
/// Returns an error if the skin of the node is invalid.
fn pose(
    placed: &PlacedMesh,
    nodes: &PlacedNodes,
    rig: &mut RigReader,
) -> Result<Option<Pose>, Fault> {
    let Some(node) = placed.posed_by else {
        return Ok(None);
    };
    let document = rig.reader.document;
    let json = &document.nodes[node];
    let mut pose = Pose {
        weights: json.weights.clone(),
        ..Pose::default()
    };
    if pose.weights.is_empty() {
        pose.weights.clone_from(&document.mesh_weights[placed.mesh]);
    }
    let skin = json.skin.map(|skin| (skin, &document.skins[skin]));
    let Some((i, skin)) = skin else {
        return Ok(Some(pose));
    };
    let joints = skin.joints.iter().map(|&joint| nodes.to_scene[joint]);
    // If one of the joints is not in the scene, the skin is ignored.
    let Some(joints) = joints.collect::<Option<Vec<_>>>() else {
        return Ok(Some(pose));
    };
    let matrices = rig.matrices(i, skin)?;
    let maps = joints.into_iter().enumerate().map(|(j, joint)| {
        let numbers = matrices.map(|array| rig.numbers(array).as_chunks::<16>().0[j]);
        let bind = numbers.map(|m| DAffine3::from_mat4(DMat4::from_cols_array(&m.map(f64::from))));
        bind.map_or(joint, |bind| joint * bind)
    });
    let maps: Vec<DAffine3> = maps.collect();
    if !maps.iter().all(DAffine3::is_finite) {
        let here = format!("/skins/{i}");
        return Err(Fault::json(here, "the transform of a joint is not finite"));
    }
    pose.joints = Some(maps.into());
    Ok(Some(pose))
}

pub(super) fn parse(json: &[u8]) -> Result<Value, Fault> {
    let json = json.strip_prefix(BYTE_ORDER_MARK).unwrap_or(json);
    serde_json::from_slice(json).map_err(|error| {
        let (line, column) = (error.line(), error.column());
        let message = error.to_string();
        let what = message
            .rsplit_once(" at line ")
            .map_or(message.as_str(), |(what, _)| what);
        TextPosition { line, column }.error(what)
    })
}

/// Returns the materials that the triangles use, in the order of the document. Also returns a map from the index of
/// each used material in the document to its index in the returned list.
fn used_materials(
    materials: &mut Materials,
    triangles: &Triangles,
) -> Result<(Vec<Material>, BTreeMap<usize, i32>), Fault> {
    let mut used: Vec<usize> = triangles.materials.iter().copied().flatten().collect();
    used.dedup();
    let used: BTreeSet<usize> = used.into_iter().collect();
    let places = used.iter().copied().zip(0..).collect();
    let materials = used.into_iter().map(|i| materials.get(i));
    Ok((materials.collect::<Result<_, _>>()?, places))
}

/// The approximate size of a material in bytes.
fn cost_of_material(material: &Material) -> usize {
    let texts = material
        .textures()
        .flat_map(|texture| texture.path().into_iter().chain(texture.names.iter()));
    let texts = texts.chain(material.extras.as_deref());
    size_of::<Material>() + material.name.len() + texts.map(str::len).sum::<usize>()
}

/// Builds polygons from the triangles of a mesh, and merges vertices along seams. If `pose` has joints, the joints move
/// the vertices to scene space. Otherwise, `to_scene` moves them.
fn polygons(
    triangles: Triangles,
    places: &BTreeMap<usize, i32>,
    to_scene: &DAffine3,
    pose: Option<&Pose>,
    notes: &mut Notes,
) -> Polygons {
    let Triangles {
        positions,
        mut attributes,
        corners: mut order,
        materials,
    } = triangles;
    let n = positions.len();
    let (positions, vertex_of, unused) = weld(positions, &mut attributes, &order);
    notes.left_out(
        "vertices-unused",
        unused,
        None,
        "vertices left out: not used by any triangle",
    );
    let mut polygons = Polygons {
        positions,
        offsets: Polygons::even_offsets(order.len() / 3, 3),
        attributes,
        ..Polygons::default()
    };
    gather(&mut polygons.attributes, Domain::Corner, &order);
    if !materials.is_empty() {
        let place = |f: usize| materials[f].map_or(-1, |m| places[&m]);
        let values = parallel::collect(materials.len(), place);
        polygons.insert_known(mesh::MATERIAL, values);
    }
    if polygons.positions.len() < n {
        parallel::change(&mut order, |v| *v = vertex_of[*v as usize]);
    }
    polygons.corners = order;
    let lost = match pose {
        Some(pose) => polygons.apply_pose(pose, to_scene),
        None => polygons.apply_transform(to_scene),
    };
    notes.left_out(
        "normals",
        lost,
        None,
        "normals left out: the transform of the node is singular",
    );
    polygons
}

/// Merges vertices that are at exactly the same position and have the same vertex attributes, and leaves out vertices
/// without a triangle. Returns three results. The first result is the list of remaining positions, in the order of
/// their first occurrence. The second result contains, for each vertex, the index of its position in this list. The
/// third result is the number of vertices that are left out.
fn weld(
    mut positions: Vec<DVec3>,
    attributes: &mut Attributes,
    corners: &[u32],
) -> (Vec<DVec3>, Vec<u32>, usize) {
    let n = positions.len();
    let used = parallel::index_flags(n, corners);
    let kept = parallel::filter(n, |v| used[v].load(Relaxed));
    let unused = n - kept.len();
    if unused > 0 {
        positions = kept.iter().map(|&v| positions[v]).collect();
    }
    let has_deformers = !attributes.of(Domain::Vertex).is_empty();
    if has_deformers && unused > 0 {
        let kept: Vec<u32> = kept
            .iter()
            .map(|&v| u32::try_from(v).unwrap_or(0))
            .collect();
        gather(attributes, Domain::Vertex, &kept);
    }
    let (positions, mut vertex_of) = if has_deformers {
        weld::weld_equal(&positions, attributes)
    } else {
        weld::weld(&positions)
    };
    if unused > 0 {
        let places = std::mem::replace(&mut vertex_of, vec![0; n]);
        for (&v, place) in kept.iter().zip(places) {
            vertex_of[v] = place;
        }
    }
    (positions, vertex_of, unused)
}
