//! Joins the primitives of a glTF mesh into one list of triangles.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

use glam::{DVec2, DVec3, DVec4};
use gltf_json::Index;
use gltf_json::accessor::Type;
use gltf_json::mesh::{Mode, MorphTarget, Primitive, Semantic};
use gltf_json::validation::Checked;
use mesh::{
    Attributes, CORNER_NORMAL, CORNER_TANGENT, Column, Domain, Rule, VERTEX_SHARPNESS, Value,
};

use super::deform::{Directions, Repairs, expect_len, joints, morphs};
use super::deformers::Deformers;
use super::morph_values::ValueChanges;
use super::names::attribute_name;
use super::reference::get;
use super::views::Reader;
use crate::fault::Fault;
use crate::note::Notes;
use mesh::parallel;

/// If a primitive lacks an attribute that an earlier primitive of the mesh has, its vertices get zeros for this
/// attribute. For each missing attribute, this number of bytes is subtracted from the memory budget, in addition to the
/// size of the zeros. This charge limits the time for files with many primitives and attributes.
const MISSING_ATTRIBUTE_CHARGE: u64 = 16;

/// The triangles of all primitives of a mesh. A vertex on a seam is stored once for each side of the seam, as in glTF.
#[derive(Clone, Debug, Default)]
pub(super) struct Triangles {
    pub(super) positions: Vec<DVec3>,
    /// The corner attributes, and the vertex attributes that deform the mesh. In this struct, a corner attribute also
    /// has one value for each vertex. The texture coordinate v points up.
    pub(super) attributes: Attributes,
    /// Three vertex indices for each triangle.
    pub(super) corners: Vec<u32>,
    /// For each triangle, the index of its material in the document; empty if no triangle has a material.
    pub(super) materials: Vec<Option<usize>>,
}

/// Reads the primitives of the mesh with this index.
///
/// # Errors
///
/// Returns an error for the first accessor or index that is invalid.
pub(super) fn triangles(
    reader: &Reader,
    index: usize,
    deformers: Deformers,
    notes: &mut Notes,
) -> Result<Triangles, Fault> {
    let mut all = Triangles::default();
    // Primitives with the same accessors for all attributes and morph targets share their vertices, so these vertices
    // are read only once. In many files, all primitives of a mesh share their vertices and differ only in their
    // materials.
    let mut known = BTreeMap::new();
    let mut left_out = LeftOut::default();
    let mut has_materials = false;
    let primitives = &reader.document.meshes[index].primitives;
    let morphed = Morphed {
        normals: Directions::normals(primitives),
        tangents: Directions::tangents(primitives),
        values: ValueChanges::new(&reader.document.value_changes[index]),
    };
    for (i, primitive) in primitives.iter().enumerate() {
        let here = format!("/meshes/{index}/primitives/{i}");
        let Checked::Valid(mode) = primitive.mode else {
            let message = "expected a number from 0 to 6";
            return Err(Fault::json(format!("{here}/mode"), message));
        };
        match mode {
            Mode::Points => {
                left_out.points += 1;
                continue;
            }
            Mode::Lines | Mode::LineLoop | Mode::LineStrip => {
                left_out.lines += 1;
                continue;
            }
            Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan => {}
        }
        let changes = morphed.values.of_primitive(i);
        let (base, count) = match known.entry((attributes(primitive), targets(primitive), changes))
        {
            Entry::Occupied(part) => *part.get(),
            Entry::Vacant(new) => *new.insert(all.push_vertices(
                reader,
                (i, primitive),
                deformers,
                &morphed,
                &here,
                &mut left_out,
            )?),
        };
        let mut corners = corners(reader, primitive, mode, count, &here)?;
        let material = primitive.material.map(|material| material.value());
        if let Some(material) = material {
            let pointer = format_args!("{here}/material");
            get(&reader.document.materials, material, pointer, "material")?;
        }
        has_materials |= material.is_some() && !corners.is_empty();
        if has_materials {
            let n = all.corners.len();
            all.materials.resize(n / 3, None);
            all.materials.resize((n + corners.len()) / 3, material);
        }
        if base > 0 {
            parallel::change(&mut corners, |v| *v += base);
        }
        if all.corners.is_empty() {
            all.corners = corners;
        } else {
            all.corners.append(&mut corners);
        }
    }
    left_out.note(notes);
    Ok(all)
}

/// The attributes of a mesh that morph targets change: normals, tangents, texture coordinates and colors.
struct Morphed<'a> {
    normals: Directions,
    tangents: Directions,
    values: ValueChanges<'a>,
}

impl Morphed<'_> {
    /// For each morph target, reads the normals and tangents of the primitive that result if only this target is
    /// applied. `n` is the number of vertices of the primitive, and `own` contains its attributes.
    ///
    /// # Errors
    ///
    /// Returns an error if an accessor is invalid.
    fn directions(
        &self,
        reader: &Reader,
        primitive: &Primitive,
        own: &Attributes,
        n: usize,
        here: &str,
        repairs: &mut Repairs,
    ) -> Result<Vec<Column>, Fault> {
        let old = own.column(Domain::Corner, CORNER_NORMAL.name);
        let old = old.and_then(|column| DVec3::of(&column.values));
        let mut columns = (self.normals).read(reader, primitive, old, n, here, repairs)?;
        let old = own.column(Domain::Corner, CORNER_TANGENT.name);
        let old = old.and_then(|column| DVec4::of(&column.values));
        columns.extend((self.tangents).read(reader, primitive, old, n, here, repairs)?);
        Ok(columns)
    }
}

/// The accessors of the attributes of a primitive.
pub(super) fn attributes(primitive: &Primitive) -> Vec<(Checked<Semantic>, usize)> {
    let attributes = primitive.attributes.iter();
    attributes
        .map(|(semantic, accessor)| (semantic.clone(), accessor.value()))
        .collect()
}

/// The accessors of the morph targets of a primitive.
fn targets(primitive: &Primitive) -> Vec<[Option<usize>; 3]> {
    let targets = primitive.targets.iter().flatten();
    let accessors = |target: &MorphTarget| {
        let MorphTarget {
            positions,
            normals,
            tangents,
        } = target;
        [positions, normals, tangents].map(|accessor| accessor.as_ref().map(Index::value))
    };
    targets.map(accessors).collect()
}

impl Triangles {
    /// The approximate size in bytes of an object with these triangles, if each attribute has a value for each corner.
    pub(super) fn cost(&self) -> u64 {
        const VERTEX: usize = 64;
        const CORNER: usize = 48;
        let columns = self.attributes.of(Domain::Corner).iter();
        let values: usize = columns.map(|column| column.values.bytes_per_value()).sum();
        let columns = self.attributes.of(Domain::Vertex).iter();
        let deformers: usize = columns.map(|column| column.values.bytes_per_value()).sum();
        let n = self.positions.len();
        ((VERTEX + deformers) * n + (CORNER + values) * self.corners.len()) as u64
    }

    /// Appends the vertices of the primitive with this index. `morphed` are the attributes of the mesh that morph
    /// targets change. Returns the index of the first vertex, and the number of vertices.
    fn push_vertices(
        &mut self,
        reader: &Reader,
        (number, primitive): (usize, &Primitive),
        deformers: Deformers,
        morphed: &Morphed,
        here: &str,
        left_out: &mut LeftOut,
    ) -> Result<(u32, u32), Fault> {
        let pointer = |name: &str| format!("{here}/attributes/{name}");
        let semantic = Checked::Valid(Semantic::Positions);
        let Some(positions) = primitive.attributes.get(&semantic) else {
            // glTF allows primitives without positions. They are empty unless an extension defines their content.
            left_out.empty += 1;
            return Ok((0, 0));
        };
        let (accessor, at) = (positions.value(), pointer("POSITION"));
        let mut positions = reader.vectors(accessor, &at, &[Type::Vec3], 0.0, DVec3::from_array)?;
        let n = positions.len();
        let base = self.positions.len();
        let fits = base.saturating_add(n) < u32::MAX as usize;
        let (true, Ok(first), Ok(count)) = (fits, u32::try_from(base), u32::try_from(n)) else {
            let message = format!(
                "expected fewer than {} vertices in a mesh, found more",
                u32::MAX
            );
            return Err(Fault::json(at, message));
        };
        if base == 0 {
            self.positions = positions;
        } else {
            self.positions.append(&mut positions);
        }
        let mut own = Attributes::default();
        for (semantic, accessor) in &primitive.attributes {
            let semantic = match semantic {
                Checked::Valid(Semantic::Positions) => continue,
                Checked::Valid(Semantic::Joints(set) | Semantic::Weights(set))
                    if *set < deformers.weight_sets =>
                {
                    continue;
                }
                Checked::Valid(semantic) => semantic,
                Checked::Invalid => {
                    left_out.attribute("with unknown names");
                    continue;
                }
            };
            let at = pointer(&semantic.to_string());
            let Some(column) = read_column(reader, semantic, accessor.value(), &at)? else {
                left_out.attribute(&semantic.to_string());
                continue;
            };
            expect_len(column.values.len(), n, &at)?;
            let before = self.attributes.column(Domain::Corner, &column.name);
            let kind = |column: &Column| column.values.type_name();
            if own.column(Domain::Corner, &column.name).is_some() {
                left_out.attribute(&(semantic.to_string() + " (name already used)"));
            } else if before.is_some_and(|before| kind(before) != kind(&column)) {
                left_out.attribute(
                    &(semantic.to_string() + " (different type than in another primitive)"),
                );
            } else {
                if before.is_none() && base > 0 {
                    let zeros = base * column.values.bytes_per_value();
                    reader.budget.spend(zeros as u64, &at)?;
                    left_out.partial += 1;
                }
                own.insert(Domain::Corner, column);
            }
        }
        let repairs = &mut left_out.repairs;
        let joints = joints(reader, primitive, n, deformers, here, repairs)?;
        let morphs = morphs(reader, primitive, n, deformers, here, repairs)?;
        for column in joints.into_iter().chain(morphs) {
            own.insert(Domain::Vertex, column);
        }
        let mut changed = morphed.directions(reader, primitive, &own, n, here, repairs)?;
        changed.extend(morphed.values.read(reader, number, n, here, repairs)?);
        for column in changed {
            own.insert(Domain::Corner, column);
        }
        let all = |attributes: &Attributes| attributes.of(Domain::Vertex).len();
        let bytes = (all(&own) + all(&self.attributes)) as u64 * 24 * (base + n) as u64;
        if base > 0 && all(&own) > 0 && !reader.budget.has(bytes) {
            let what =
                "the joint weights and the morph targets of all primitives need too much memory";
            return Err(Fault::json(here.to_owned(), what));
        }
        left_out.partial += self.spend_missing(reader, &own, n, here)?;
        if base == 0 && self.attributes == Attributes::default() {
            self.attributes = own;
        } else {
            let lens = |n| {
                let has = |d| matches!(d, Domain::Corner | Domain::Vertex);
                Domain::ALL.map(|d| if has(d) { n } else { 0 })
            };
            self.attributes.append(lens(base), &own, lens(n));
        }
        Ok((first, count))
    }

    /// Counts the attributes that earlier primitives of the mesh have, but that this primitive does not have. `n` is
    /// the number of vertices of this primitive, and `own` contains its attributes. The caller sets the missing values
    /// to zero. The size of these values is subtracted from the memory budget.
    ///
    /// # Errors
    ///
    /// Returns an error if the missing values need too much memory.
    fn spend_missing(
        &self,
        reader: &Reader,
        own: &Attributes,
        n: usize,
        here: &str,
    ) -> Result<usize, Fault> {
        let columns = self.attributes.of(Domain::Corner).iter();
        let missing = columns.filter(|c| own.column(Domain::Corner, &c.name).is_none());
        let mut count = 0;
        for column in missing {
            let zeros = (n * column.values.bytes_per_value()) as u64;
            (reader.budget).spend(MISSING_ATTRIBUTE_CHARGE + zeros, here)?;
            count += 1;
        }
        Ok(count)
    }
}

/// Reads an attribute of a primitive. Returns `None` if the reader does not support the attribute.
fn read_column(
    reader: &Reader,
    semantic: &Semantic,
    accessor: usize,
    at: &str,
) -> Result<Option<Column>, Fault> {
    let Some(name) = attribute_name(semantic) else {
        return Ok(None);
    };
    let kinds: &[Type] = match semantic {
        Semantic::Normals => &[Type::Vec3],
        Semantic::Tangents => &[Type::Vec4],
        Semantic::TexCoords(_) => &[Type::Vec2],
        Semantic::Colors(_) => &[Type::Vec3, Type::Vec4],
        _ => &[reader.kind(accessor, at)?],
    };
    let values = match (semantic, kinds[kinds.len() - 1]) {
        (Semantic::TexCoords(_), _) => {
            let up = |[u, v]: [f64; 2]| DVec2::new(u, 1.0 - v);
            DVec2::wrap(reader.vectors(accessor, at, kinds, 0.0, up)?)
        }
        (_, Type::Scalar) => {
            f64::wrap(reader.vectors(accessor, at, kinds, 0.0, |[x]: [f64; 1]| x)?)
        }
        (_, Type::Vec2) => {
            DVec2::wrap(reader.vectors(accessor, at, kinds, 0.0, DVec2::from_array)?)
        }
        (_, Type::Vec3) => {
            DVec3::wrap(reader.vectors(accessor, at, kinds, 0.0, DVec3::from_array)?)
        }
        // Colors without alpha are opaque.
        (_, Type::Vec4) => {
            DVec4::wrap(reader.vectors(accessor, at, kinds, 1.0, DVec4::from_array)?)
        }
        (_, Type::Mat2 | Type::Mat3 | Type::Mat4) => return Ok(None),
    };
    let rule = match name.as_str() {
        "normal" => CORNER_NORMAL.rule,
        "corner" => VERTEX_SHARPNESS.rule,
        "tangent" => CORNER_TANGENT.rule,
        _ => Rule::Interpolate,
    };
    Ok(Some(Column { name, rule, values }))
}

/// Returns the corners of the triangles of a primitive, as vertex indices within the primitive.
fn corners(
    reader: &Reader,
    primitive: &Primitive,
    mode: Mode,
    count: u32,
    here: &str,
) -> Result<Vec<u32>, Fault> {
    let order = match primitive.indices {
        None => {
            let pointer = format!("{here}/attributes/POSITION");
            reader.budget.spend(u64::from(count) * 4, &pointer)?;
            (0..count).collect()
        }
        Some(indices) => {
            let pointer = format!("{here}/indices");
            let order = reader.indices(indices.value(), &pointer)?;
            if !parallel::all(order.len(), |i| order[i] < count) {
                let mut indices = order.iter().enumerate();
                let (i, v) = indices.find(|(_, v)| **v >= count).unwrap_or((0, &0));
                let message = format!(
                    "index {i} refers to vertex {v}, but the number of vertices of the primitive is {count}"
                );
                return Err(Fault::json(pointer, message));
            }
            order
        }
    };
    let corners = match mode {
        Mode::TriangleStrip => {
            // Every second triangle of a strip is reversed, so that all triangles have the same orientation.
            let triangle = |(i, w): (usize, &[u32])| match i % 2 {
                0 => [w[0], w[1], w[2]],
                _ => [w[0], w[2], w[1]],
            };
            // Triangles that use a vertex twice are left out, because they only connect separate parts of a strip.
            let has_area = |[a, b, c]: &[u32; 3]| a != b && b != c && c != a;
            let triangles = order.windows(3).enumerate().map(triangle);
            triangles.filter(has_area).flatten().collect()
        }
        Mode::TriangleFan => match order.split_first() {
            None => Vec::new(),
            Some((&center, rest)) => rest.windows(2).flat_map(|w| [w[0], w[1], center]).collect(),
        },
        _ => {
            if order.len() % 3 != 0 {
                let message = format!(
                    "expected the number of corners to be a multiple of 3, found {}",
                    order.len()
                );
                return Err(Fault::json(here, message));
            }
            order
        }
    };
    Ok(corners)
}

/// Counts the content of primitives that is left out.
#[derive(Default)]
struct LeftOut {
    repairs: Repairs,
    points: usize,
    lines: usize,
    empty: usize,
    partial: usize,
    attributes: BTreeMap<String, usize>,
}

impl LeftOut {
    fn attribute(&mut self, name: &str) {
        *self.attributes.entry(name.to_owned()).or_default() += 1;
    }

    fn note(self, notes: &mut Notes) {
        notes.left_out("points", self.points, None, "primitives of points left out");
        notes.left_out(
            "polylines",
            self.lines,
            None,
            "primitives of lines left out",
        );
        notes.left_out(
            "primitives-empty",
            self.empty,
            None,
            "primitives without positions left out",
        );
        let what =
            "attributes that only some primitives of a mesh have: set to 0 in the other primitives";
        notes.changed("attributes-partial", self.partial, None, what);
        for (what, count) in self.repairs.changed {
            notes.changed("joint-weights", count, None, what);
        }
        for (what, count) in self.repairs.left_out {
            notes.left_out("morphs", count, None, what);
        }
        for (name, count) in self.attributes {
            notes.left_out(
                "attributes",
                count,
                None,
                format!("attributes {name} left out"),
            );
        }
    }
}
