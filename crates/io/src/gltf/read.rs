//! From a glTF document to objects.

use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};
use std::fs::File;
use std::io::Read;
use std::path::Path;

use glam::{DAffine3, DMat3, DMat4, DQuat, DVec3};
use gltf_json::mesh::{Mode, Semantic};
use gltf_json::validation::Checked;
use gltf_json::{Index, Node};
use mesh::{COLOR, CORNER_NORMAL, Mesh, UV, VERTEX_NORMAL};
use scene::{Material, Object};
use serde_json::Value;

use super::accessor::Reader;
use super::document::{Document, get};
use super::primitives::{Triangles, triangles};
use super::{CORNER_COLOR, JsonError, buffers};
use crate::ReadOptions;
use crate::asset_path::read_plain;
use crate::build::build_mesh;
use crate::corners::{on_half_edges, set_on_vertices_or_corners};
use crate::error::{ReadError, TextError};
use crate::note::Notes;
use crate::peek::{PeekGeometry, PeekMesh, PeekObject};

/// Reads the objects of a glTF file from its bytes; `path` is where its buffers are looked for.
///
/// # Errors
///
/// The first thing that breaks the rules of the format.
pub(crate) fn read(
    path: &Path,
    bytes: Vec<u8>,
    name: &str,
    options: &ReadOptions,
    notes: &mut Notes,
) -> Result<Vec<Object>, ReadError> {
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
        let mesh = to_mesh(path, triangles, &places, &placed.to_scene, options, notes)?;
        objects.push(Object {
            materials,
            ..Object::mesh(name, mesh)
        });
    }
    Ok(objects)
}

fn parse(path: &Path, json: &[u8]) -> Result<Value, ReadError> {
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

// ---- Nodes -------------------------------------------------------------------------------------

/// A node with a mesh.
struct Placed {
    node: usize,
    mesh: usize,
    to_scene: DAffine3,
}

impl Placed {
    fn name<'a>(&self, document: &'a Document, otherwise: &'a str) -> &'a str {
        let node = document.nodes[self.node].name.as_deref();
        let mesh = document.meshes[self.mesh].name.as_deref();
        [node, mesh]
            .into_iter()
            .flatten()
            .find(|name| !name.is_empty())
            .unwrap_or(otherwise)
    }
}

/// The nodes of the scene that have a mesh, parents before children, in the order of the file.
fn placed_meshes(document: &Document) -> Result<Vec<Placed>, JsonError> {
    let mut seen = vec![false; document.nodes.len()];
    let mut placed = Vec::new();
    // A stack of our own: a chain of nodes may be as long as the file.
    let mut open: Vec<(usize, DAffine3)> = Vec::new();
    for &root in document.roots.iter().rev() {
        open.push((root, DAffine3::IDENTITY));
    }
    while let Some((i, above)) = open.pop() {
        let node = get(&document.nodes, i, || "/scenes".to_owned(), "node")?;
        let here = format!("/nodes/{i}");
        if std::mem::replace(&mut seen[i], true) {
            return Err(JsonError::new(
                here,
                "the node is in the scene twice, or below itself",
            ));
        }
        let to_scene = above * placement(node, &here)?;
        if !to_scene.is_finite() {
            return Err(JsonError::new(
                here,
                "the placement of the node is not finite",
            ));
        }
        if let Some(mesh) = node.mesh {
            get(
                &document.meshes,
                mesh.value(),
                || format!("{here}/mesh"),
                "mesh",
            )?;
            placed.push(Placed {
                node: i,
                mesh: mesh.value(),
                to_scene,
            });
        }
        for (k, child) in node
            .children
            .as_deref()
            .unwrap_or(&[])
            .iter()
            .enumerate()
            .rev()
        {
            let pointer = || format!("{here}/children/{k}");
            get(&document.nodes, child.value(), pointer, "node")?;
            open.push((child.value(), to_scene));
        }
    }
    Ok(placed)
}

fn placement(node: &Node, here: &str) -> Result<DAffine3, JsonError> {
    if let Some(matrix) = node.matrix {
        let matrix = DMat4::from_cols_array(&matrix.map(f64::from));
        if matrix.row(3).to_array().map(f64::to_bits) != [0.0, 0.0, 0.0, 1.0].map(f64::to_bits) {
            return Err(JsonError::new(
                format!("{here}/matrix"),
                "expected 0, 0, 0, 1 as the last row",
            ));
        }
        return Ok(DAffine3::from_mat4(matrix));
    }
    let scale = node
        .scale
        .map_or(DVec3::ONE, |scale| DVec3::from_array(scale.map(f64::from)));
    let translation = node.translation.unwrap_or_default().map(f64::from);
    let rotation = node.rotation.unwrap_or_default().0.map(f64::from);
    let rotation = DQuat::from_array(rotation);
    // Written with 32 bits, its length is only nearly 1.
    let length = rotation.length();
    if length == 0.0 || !length.is_finite() {
        return Err(JsonError::new(
            format!("{here}/rotation"),
            "expected a unit quaternion",
        ));
    }
    let rotation = DQuat::from_array(rotation.to_array().map(|x| x / length));
    Ok(DAffine3::from_scale_rotation_translation(
        scale,
        rotation,
        DVec3::from_array(translation),
    ))
}

/// Makes names different from each other.
#[derive(Default)]
struct Names {
    taken: BTreeSet<String>,
    /// The number that was last put behind a name.
    last: BTreeMap<String, usize>,
}

impl Names {
    fn unique(&mut self, name: &str, notes: &mut Notes) -> String {
        let mut new = name.to_owned();
        while !self.taken.insert(new.clone()) {
            let last = self.last.entry(name.to_owned()).or_insert(1);
            *last += 1;
            new = format!("{name}.{last}");
        }
        let renamed = usize::from(new != name);
        notes.changed(
            renamed,
            None,
            format!("node named `{name}` is now called `{new}`: the name is taken"),
        );
        new
    }
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
            base_color_texture: picture,
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

fn to_mesh(
    path: &Path,
    triangles: &Triangles,
    places: &BTreeMap<usize, i32>,
    to_scene: &DAffine3,
    options: &ReadOptions,
    notes: &mut Notes,
) -> Result<Mesh, ReadError> {
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
    let offsets: Vec<u32> = (0..=n).step_by(3).collect();
    let mut built = build_mesh(path, positions, &offsets, &corners, options, notes)?;
    if !triangles.uvs.is_empty() {
        let uvs = on_half_edges(&built, |c| triangles.uvs[order[c] as usize]);
        built.mesh.set(UV, uvs);
    }
    if !triangles.colors.is_empty() {
        let values = on_half_edges(&built, |c| triangles.colors[order[c] as usize]);
        set_on_vertices_or_corners(&mut built.mesh, COLOR, CORNER_COLOR, values, |_| {
            glam::DVec4::ONE
        });
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
                let values = on_half_edges(&built, |c| {
                    let normal = triangles.normals[order[c] as usize];
                    if moved {
                        (turn * normal).normalize_or_zero()
                    } else {
                        normal
                    }
                });
                let zero = |_| DVec3::ZERO;
                set_on_vertices_or_corners(
                    &mut built.mesh,
                    VERTEX_NORMAL,
                    CORNER_NORMAL,
                    values,
                    zero,
                );
            }
        }
    }
    if triangles.materials.iter().any(Option::is_some) {
        let mut values = vec![-1; built.mesh.n_faces()];
        for (f, material) in built.face_of_polygon.iter().zip(&triangles.materials) {
            if let (Some(f), Some(material)) = (f.some(), material) {
                values[f.index()] = places[material];
            }
        }
        built.mesh.set(mesh::MATERIAL, values);
    }
    Ok(built.mesh)
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
    // Adding 0 turns -0 into 0: they are the same place.
    let key = |v: u32| {
        triangles.positions[v as usize]
            .to_array()
            .map(|x| (x + 0.0).to_bits())
    };
    let mut used = vec![false; triangles.positions.len()];
    for &v in triangles.corners.as_flattened() {
        used[v as usize] = true;
    }
    let all = 0..u32::try_from(triangles.positions.len()).unwrap_or(u32::MAX);
    let mut sorted: Vec<u32> = all.clone().filter(|&v| used[v as usize]).collect();
    let unused = triangles.positions.len() - sorted.len();
    sorted.sort_unstable_by_key(|&v| (key(v), v));
    // Each vertex first points to the lowest one at its place, ...
    let mut vertex_of = vec![0; triangles.positions.len()];
    for same in sorted.chunk_by(|&a, &b| key(a) == key(b)) {
        for &v in same {
            vertex_of[v as usize] = same[0];
        }
    }
    // ... and those get their numbers in order.
    let mut positions = Vec::new();
    for v in all.filter(|&v| used[v as usize]) {
        let first = vertex_of[v as usize];
        vertex_of[v as usize] = if first == v {
            positions.push(triangles.positions[v as usize]);
            u32::try_from(positions.len() - 1).unwrap_or(u32::MAX)
        } else {
            vertex_of[first as usize]
        };
    }
    Welded {
        positions,
        vertex_of,
        unused,
    }
}

// ---- Peeking -----------------------------------------------------------------------------------

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
    let json = parse(path, &json)?;
    let mut notes = Notes::of(path);
    let document = Document::new(&json, &mut notes).map_err(in_file)?;
    let mut names = Names::default();
    let mut objects = Vec::new();
    for placed in placed_meshes(&document).map_err(in_file)? {
        let mesh = peek_mesh(&document, placed.mesh).map_err(in_file)?;
        let name = names.unique(placed.name(&document, name), &mut notes);
        objects.push(PeekObject {
            name,
            geometry: PeekGeometry::Mesh(mesh),
        });
    }
    Ok(objects)
}

fn peek_mesh(document: &Document, index: usize) -> Result<PeekMesh, JsonError> {
    let reader = Reader {
        document,
        buffers: &[],
    };
    let mut counts = PeekMesh::default();
    let mut known = BTreeSet::new();
    for (i, primitive) in document.meshes[index].primitives.iter().enumerate() {
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
