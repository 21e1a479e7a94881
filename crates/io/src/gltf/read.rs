//! From a glTF document to objects.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

use glam::{DAffine3, DMat3, DVec3};
use mesh::{CORNER_NORMAL, Column, Domain, Rule, Values};
use rayon::prelude::*;
use scene::{Material, Texture};
use serde_json::Value;

use super::accessor::Reader;
use super::budget::Budget;
use super::document::Document;
use super::materials::Materials;
use super::nodes::placed_meshes;
use super::primitives::{Triangles, triangles};
use super::{JsonError, buffers};
use crate::error::{ReadError, TextError};
use crate::names::Names;
use crate::note::Notes;
use crate::{Found, Polygons, weld};

/// How many values are looked at by one task at least.
const BLOCK: usize = 1 << 14;

/// Reads the objects of a glTF file from its bytes; `path` is where its buffers are looked for.
///
/// # Errors
///
/// The first thing that breaks the rules of the format.
pub(crate) fn read(
    path: &Path,
    bytes: Vec<u8>,
    name: &str,
    notes: &mut Notes,
) -> Result<Vec<Found>, ReadError> {
    // Dropped at the end: the accessors read from it as it is.
    let bytes = bytes.into_boxed_slice();
    let in_file = |error: JsonError| error.in_file(path);
    let container = buffers::container(path, &bytes)?;
    let json = parse(path, &bytes[container.json])?;
    let budget = Budget::of(bytes.len());
    let document = Document::new(&json, &budget, notes).map_err(in_file)?;
    drop(json);
    let binary = container.binary.map(|range| &bytes[range]);
    let (buffers, fallbacks) = (&document.buffers, &document.fallbacks);
    let loaded =
        buffers::load(path, buffers, fallbacks, binary, &budget, notes).map_err(in_file)?;
    if document.compressed.iter().any(Option::is_some) {
        budget.grant_compressed(loaded.iter().map(|buffer| buffer.len() as u64).sum());
    }
    let reader = Reader::new(&document, &loaded, &budget);
    objects(&reader, name, notes).map_err(in_file)
}

fn objects(reader: &Reader, name: &str, notes: &mut Notes) -> Result<Vec<Found>, JsonError> {
    let document = reader.document;
    let placed = placed_meshes(document, notes)?;
    // How often each mesh is still needed: the last object takes its arrays.
    let mut uses = BTreeMap::new();
    for placed in &placed {
        *uses.entry(placed.mesh).or_insert(0) += 1;
    }
    notes.left_out(
        document.meshes.len() - uses.len(),
        None,
        "meshes left out: no node of the scene shows them",
    );
    let mut meshes = BTreeMap::new();
    let mut materials = Materials::new(reader);
    let mut names = Names::default();
    let mut objects = Vec::new();
    for placed in placed {
        let here = format!("/meshes/{}", placed.mesh);
        let triangles = match meshes.remove(&placed.mesh) {
            Some(triangles) => triangles,
            None => triangles(reader, placed.mesh, notes)?,
        };
        reader.budget.spend(triangles.cost(), &here)?;
        let left = uses.entry(placed.mesh).or_default();
        *left -= 1;
        if *left > 0 {
            meshes.insert(placed.mesh, triangles.clone());
        }
        if triangles.corners.len() >= u32::MAX as usize {
            let message = format!("expected fewer than {} corners in a mesh", u32::MAX);
            return Err(JsonError::new(here, message));
        }
        let name = placed.name(document, name);
        placed.spend(name, reader.budget)?;
        let name = names.unique(name, notes);
        let (materials, places) = used_materials(&mut materials, &triangles)?;
        let cost: usize = materials.iter().map(cost_of_material).sum();
        reader.budget.spend(cost as u64, &here)?;
        let polygons = Polygons {
            materials,
            ..polygons(triangles, &places, &placed.to_scene, notes)
        };
        objects.push(Found::polygons(name, polygons));
    }
    materials.note(notes);
    Ok(objects)
}

pub(super) fn parse(path: &Path, json: &[u8]) -> Result<Value, ReadError> {
    let json = json.strip_prefix(b"\xef\xbb\xbf").unwrap_or(json);
    serde_json::from_slice(json).map_err(|error| {
        let message = error.to_string();
        let message = message
            .rsplit_once(" at line ")
            .map_or(message.as_str(), |(what, _)| what);
        TextError {
            line: error.line(),
            column: error.column(),
            message: message.to_owned(),
        }
        .in_file(path)
    })
}

/// The materials that the triangles use, in the order of the document, and where each of the
/// document's is among them.
fn used_materials(
    materials: &mut Materials,
    triangles: &Triangles,
) -> Result<(Vec<Material>, BTreeMap<usize, i32>), JsonError> {
    let mut used: Vec<usize> = triangles.materials.iter().copied().flatten().collect();
    used.dedup();
    let used: BTreeSet<usize> = used.into_iter().collect();
    let places = used.iter().copied().zip(0..).collect();
    let materials = used.into_iter().map(|i| materials.get(i));
    Ok((materials.collect::<Result<_, _>>()?, places))
}

/// The bytes that a material takes, about.
fn cost_of_material(material: &Material) -> usize {
    let textures = [
        &material.base_color_texture,
        &material.metallic_roughness_texture,
        &material.normal_texture,
        &material.occlusion_texture,
        &material.emissive_texture,
    ];
    let paths = textures.into_iter().flatten().filter_map(Texture::path);
    size_of::<Material>() + material.name.len() + paths.map(str::len).sum::<usize>()
}

/// The polygons of a mesh that is placed in the scene, welded along the seams that glTF needs.
fn polygons(
    triangles: Triangles,
    places: &BTreeMap<usize, i32>,
    to_scene: &DAffine3,
    notes: &mut Notes,
) -> Polygons {
    let Triangles {
        positions,
        columns,
        corners: mut order,
        materials,
    } = triangles;
    let Welded {
        mut positions,
        vertex_of,
        unused,
    } = weld(positions, &order);
    notes.left_out(unused, None, "vertices left out: no triangle uses them");
    let moved = *to_scene != DAffine3::IDENTITY;
    if moved {
        positions
            .par_iter_mut()
            .with_min_len(BLOCK)
            .for_each(|position| *position = to_scene.transform_point3(*position));
    }
    // A mirror turns triangles inside out: their corners are taken the other way round.
    if to_scene.matrix3.determinant() < 0.0 {
        order
            .par_chunks_exact_mut(3)
            .with_min_len(BLOCK)
            .for_each(|triangle| triangle.swap(1, 2));
    }
    let n_triangles = order.len() / 3;
    let mut polygons = Polygons {
        positions,
        offsets: offsets(n_triangles),
        ..Polygons::default()
    };
    for (name, values) in columns {
        let values = values.gather(order.len(), |c| Some(order[c] as usize));
        let (rule, values) = match (name.as_str(), values) {
            (_, Values::Vec3(normals)) if name == CORNER_NORMAL.name => {
                if !moved {
                    (Rule::Normal, Values::Vec3(normals))
                } else if let Some(turn) = normal_matrix(to_scene) {
                    (Rule::Normal, Values::Vec3(turned(normals, turn)))
                } else {
                    let what = "normals left out: the placement is flat";
                    notes.left_out(normals.len(), None, what);
                    continue;
                }
            }
            (_, values) if name == mesh::CORNER.name => (mesh::CORNER.rule, values),
            (_, values) => (Rule::Interpolate, values),
        };
        let column = Column { name, rule, values };
        polygons.attributes.insert(Domain::Corner, column);
    }
    if !materials.is_empty() {
        let place = |material: &Option<usize>| material.map_or(-1, |m| places[&m]);
        let values = materials.par_iter().with_min_len(BLOCK).map(place);
        polygons.insert_faces(mesh::MATERIAL, values.collect());
    }
    if let Some(vertex_of) = vertex_of {
        order
            .par_iter_mut()
            .with_min_len(BLOCK)
            .for_each(|v| *v = vertex_of[*v as usize]);
    }
    polygons.corners = order;
    polygons
}

/// Where each of `n` triangles begins, and where the last one ends.
fn offsets(n: usize) -> Vec<u32> {
    let mut offsets = mesh::zeroed::<u32>(n + 1);
    offsets
        .par_iter_mut()
        .with_min_len(BLOCK)
        .enumerate()
        .for_each(|(f, offset)| *offset = u32::try_from(3 * f).unwrap_or(u32::MAX));
    offsets
}

fn turned(mut normals: Vec<DVec3>, turn: DMat3) -> Vec<DVec3> {
    normals
        .par_iter_mut()
        .with_min_len(BLOCK)
        .for_each(|normal| *normal = (turn * *normal).normalize_or_zero());
    normals
}

/// The matrix that turns normals: the transposed inverse.
fn normal_matrix(to_scene: &DAffine3) -> Option<DMat3> {
    let matrix = to_scene.matrix3.inverse().transpose();
    matrix.is_finite().then_some(matrix)
}

struct Welded {
    positions: Vec<DVec3>,
    /// For each vertex of the triangles its place in `positions`; `None` if it is its own.
    vertex_of: Option<Vec<u32>>,
    unused: usize,
}

/// Joins vertices at exactly the same position, in the order in which each place comes first, and
/// leaves out those that no triangle uses.
fn weld(positions: Vec<DVec3>, corners: &[u32]) -> Welded {
    let n = positions.len();
    let used: Vec<AtomicBool> = (0..n).map(|_| AtomicBool::new(false)).collect();
    corners
        .par_iter()
        .with_min_len(BLOCK)
        .for_each(|&v| used[v as usize].store(true, Relaxed));
    let is_used = |&v: &usize| used[v].load(Relaxed);
    let unused = n
        - (0..n)
            .into_par_iter()
            .with_min_len(BLOCK)
            .filter(is_used)
            .count();
    if unused == 0 {
        let (positions, vertex_of) = weld::weld(positions);
        return Welded {
            vertex_of: (positions.len() < n).then_some(vertex_of),
            positions,
            unused,
        };
    }
    let kept: Vec<usize> = (0..n).filter(is_used).collect();
    let (positions, places) = weld::weld(kept.iter().map(|&v| positions[v]).collect());
    let mut vertex_of = vec![0; n];
    for (&v, place) in kept.iter().zip(places) {
        vertex_of[v] = place;
    }
    Welded {
        positions,
        vertex_of: Some(vertex_of),
        unused,
    }
}
