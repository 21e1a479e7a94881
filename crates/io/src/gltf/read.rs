//! From a glTF document to objects.

use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use glam::{DAffine3, DMat3, DVec3};
use gltf_json::validation::Checked;
use mesh::{CORNER_NORMAL, UV};
use scene::{AlphaMode, Material, Texture};
use serde_json::Value;

use super::accessor::Reader;
use super::document::Document;
use super::nodes::placed_meshes;
use super::primitives::{Triangles, triangles};
use super::{CORNER_COLOR, JsonError, buffers};
use crate::error::{ReadError, TextError};
use crate::names::Names;
use crate::note::Notes;
use crate::{Found, Polygons, weld};

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
    let in_file = |error: JsonError| error.in_file(path);
    let container = buffers::container(path, &bytes)?;
    let json = parse(path, &bytes[container.json])?;
    let document = Document::new(&json, notes).map_err(in_file)?;
    drop(json);
    let binary = container.binary.map(|range| &bytes[range]);
    let loaded = buffers::load(path, &document.buffers, binary).map_err(in_file)?;
    drop(bytes);
    let reader = Reader {
        document: &document,
        buffers: &loaded,
    };
    let placed = placed_meshes(&document).map_err(in_file)?;
    let used: BTreeSet<usize> = placed.iter().map(|placed| placed.mesh).collect();
    let unused = document.meshes.len() - used.len();
    notes.left_out(
        unused,
        None,
        "meshes left out: no node of the scene shows them",
    );
    let mut meshes = BTreeMap::new();
    let mut names = Names::default();
    let mut objects = Vec::new();
    for placed in placed {
        let triangles = match meshes.entry(placed.mesh) {
            Entry::Occupied(known) => known.into_mut(),
            Entry::Vacant(new) => {
                new.insert(triangles(&reader, placed.mesh, notes).map_err(in_file)?)
            }
        };
        let name = names.unique(placed.name(&document, name), notes);
        let (materials, places) = materials(&document, triangles, notes);
        let polygons = Polygons {
            materials,
            ..polygons(triangles, &places, &placed.to_scene, notes)
        };
        objects.push(Found::polygons(name, polygons));
    }
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

// ---- Materials ---------------------------------------------------------------------------------

/// The materials that the triangles use, in the order of the document, and where each of the
/// document's is among them.
fn materials(
    document: &Document,
    triangles: &Triangles,
    notes: &mut Notes,
) -> (Vec<Material>, BTreeMap<usize, i32>) {
    let used: BTreeSet<usize> = triangles.materials.iter().copied().flatten().collect();
    let places = used.iter().copied().zip(0..).collect();
    let mut textures = 0;
    let mut converted = |i: &usize| {
        let from = &document.materials[*i];
        let pbr = &from.pbr_metallic_roughness;
        let unit = |x: f32| decimal(x).clamp(0.0, 1.0);
        let picture = pbr.base_color_texture.as_ref().and_then(|texture| {
            document
                .pictures
                .get(texture.index.value())
                .cloned()
                .flatten()
        });
        let others = [
            pbr.metallic_roughness_texture.is_some(),
            from.normal_texture.is_some(),
            from.occlusion_texture.is_some(),
            from.emissive_texture.is_some(),
        ];
        textures += others.into_iter().filter(|&is| is).count();
        Material {
            name: from.name.clone().unwrap_or_else(|| format!("material {i}")),
            base_color: pbr.base_color_factor.0.map(unit),
            metallic: unit(pbr.metallic_factor.0),
            roughness: unit(pbr.roughness_factor.0),
            base_color_texture: picture.map(Texture::file),
            alpha: match from.alpha_mode {
                Checked::Valid(gltf_json::material::AlphaMode::Blend) => AlphaMode::Blend,
                _ => AlphaMode::Opaque,
            },
            ..Material::new("")
        }
    };
    let materials = used.iter().map(&mut converted).collect();
    notes.left_out(
        textures,
        None,
        "textures of materials other than the base color left out",
    );
    (materials, places)
}

/// The shortest decimal number that is this one with 32 bits: 0.8 is written as 0.8.
fn decimal(x: f32) -> f64 {
    x.to_string().parse().unwrap_or(f64::from(x))
}

// ---- Meshes ------------------------------------------------------------------------------------

/// The polygons of a mesh that is placed in the scene, welded along the seams that glTF needs.
fn polygons(
    triangles: &Triangles,
    places: &BTreeMap<usize, i32>,
    to_scene: &DAffine3,
    notes: &mut Notes,
) -> Polygons {
    let welded = weld(triangles);
    notes.left_out(
        welded.unused,
        None,
        "vertices left out: no triangle uses them",
    );
    let moved = *to_scene != DAffine3::IDENTITY;
    let mut positions = welded.positions;
    if moved {
        for position in &mut positions {
            *position = to_scene.transform_point3(*position);
        }
    }
    // A mirror turns triangles inside out: their corners are taken the other way round.
    let mirrored = to_scene.matrix3.determinant() < 0.0;
    let mut order = triangles.corners.clone();
    if mirrored {
        for [_, b, c] in &mut order {
            std::mem::swap(b, c);
        }
    }
    let order = order.as_flattened();
    let corners: Vec<u32> = order
        .iter()
        .map(|&v| welded.vertex_of[v as usize])
        .collect();
    let n = u32::try_from(corners.len()).unwrap_or(u32::MAX);
    let mut polygons = Polygons {
        positions,
        offsets: (0..=n).step_by(3).collect(),
        corners,
        ..Polygons::default()
    };
    if !triangles.uvs.is_empty() {
        let values = order.iter().map(|&v| triangles.uvs[v as usize]);
        polygons.insert_corners(UV, values.collect());
    }
    if !triangles.colors.is_empty() {
        let values = order.iter().map(|&v| triangles.colors[v as usize]);
        polygons.insert_corners(CORNER_COLOR, values.collect());
    }
    if !triangles.normals.is_empty() {
        let turn = if moved {
            normal_matrix(to_scene)
        } else {
            Some(DMat3::IDENTITY)
        };
        match turn {
            None => notes.left_out(
                triangles.normals.len(),
                None,
                "normals left out: the placement is flat",
            ),
            Some(turn) => {
                let turned = |&v: &u32| {
                    let normal = triangles.normals[v as usize];
                    if moved {
                        (turn * normal).normalize_or_zero()
                    } else {
                        normal
                    }
                };
                polygons.insert_corners(CORNER_NORMAL, order.iter().map(turned).collect());
            }
        }
    }
    if triangles.materials.iter().any(Option::is_some) {
        let place = |material: &Option<usize>| material.map_or(-1, |m| places[&m]);
        let values = triangles.materials.iter().map(place);
        polygons.insert_faces(mesh::MATERIAL, values.collect());
    }
    polygons
}

/// The matrix that turns normals: the transposed inverse.
fn normal_matrix(to_scene: &DAffine3) -> Option<DMat3> {
    let matrix = to_scene.matrix3.inverse().transpose();
    matrix.is_finite().then_some(matrix)
}

struct Welded {
    positions: Vec<DVec3>,
    /// For each vertex of the triangles its place in `positions`.
    vertex_of: Vec<u32>,
    unused: usize,
}

/// Joins vertices at exactly the same position, in the order in which each place comes first, and
/// leaves out those that no triangle uses.
fn weld(triangles: &Triangles) -> Welded {
    let mut used = vec![false; triangles.positions.len()];
    for &v in triangles.corners.as_flattened() {
        used[v as usize] = true;
    }
    let kept: Vec<usize> = (0..used.len()).filter(|&v| used[v]).collect();
    let unused = used.len() - kept.len();
    if unused == 0 {
        let (positions, vertex_of) = weld::weld(triangles.positions.clone());
        return Welded {
            positions,
            vertex_of,
            unused,
        };
    }
    let (positions, places) = weld::weld(kept.iter().map(|&v| triangles.positions[v]).collect());
    let mut vertex_of = vec![0; used.len()];
    for (&v, place) in kept.iter().zip(places) {
        vertex_of[v] = place;
    }
    Welded {
        positions,
        vertex_of,
        unused,
    }
}
