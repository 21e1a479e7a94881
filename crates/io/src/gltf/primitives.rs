//! The primitives of a glTF mesh as one list of triangles.

use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};

use glam::{DVec2, DVec3, DVec4};
use gltf_json::accessor::Type;
use gltf_json::mesh::{Mode, Primitive, Semantic};
use gltf_json::validation::Checked;
use mesh::{Value, Values};
use rayon::prelude::*;

use super::JsonError;
use super::accessor::Reader;
use super::document::get;
use super::names::attribute_name;
use crate::note::Notes;

/// How many corners are looked at by one task at least.
const BLOCK: usize = 1 << 14;
/// What looking at an attribute that a primitive does not have costs, in bytes: time rather than memory.
const SMALL: u64 = 16;

/// All primitives of a mesh. A vertex here is one of glTF: one for each side of a seam.
#[derive(Clone, Debug, Default)]
pub(super) struct Triangles {
    pub(super) positions: Vec<DVec3>,
    /// Named as in a mesh; one value for each vertex. Texture coordinates have v upwards.
    pub(super) columns: BTreeMap<String, Values>,
    /// Three for each triangle.
    pub(super) corners: Vec<u32>,
    /// For each triangle its material in the document; empty if none has one.
    pub(super) materials: Vec<Option<usize>>,
}

/// Reads the primitives of mesh number `index`.
///
/// # Errors
///
/// The first accessor or index that is not what it should be.
pub(super) fn triangles(
    reader: &Reader,
    index: usize,
    notes: &mut Notes,
) -> Result<Triangles, JsonError> {
    let mut all = Triangles::default();
    // Primitives that share all their attributes, as parts of one model do, share their vertices.
    let mut known = BTreeMap::new();
    let mut seen = Seen::default();
    let mut has_materials = false;
    for (i, primitive) in reader.document.meshes[index].primitives.iter().enumerate() {
        let here = format!("/meshes/{index}/primitives/{i}");
        seen.morphs += primitive.targets.as_ref().map_or(0, Vec::len);
        let Checked::Valid(mode) = primitive.mode else {
            return Err(JsonError::new(
                format!("{here}/mode"),
                "expected a number from 0 to 6",
            ));
        };
        match mode {
            Mode::Points => {
                seen.points += 1;
                continue;
            }
            Mode::Lines | Mode::LineLoop | Mode::LineStrip => {
                seen.lines += 1;
                continue;
            }
            Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan => {}
        }
        let attributes: Vec<_> = primitive
            .attributes
            .iter()
            .map(|(k, a)| (k.clone(), a.value()))
            .collect();
        let (base, count) = if let Some(&part) = known.get(&attributes) {
            part
        } else {
            let part = all.push_vertices(reader, primitive, &here, &mut seen)?;
            known.insert(attributes, part);
            part
        };
        let mut corners = corners(reader, primitive, mode, count, &here)?;
        if let Some(material) = primitive.material {
            let pointer = || format!("{here}/material");
            get(
                &reader.document.materials,
                material.value(),
                pointer,
                "material",
            )?;
        }
        let material = primitive.material.map(|material| material.value());
        has_materials |= material.is_some() && !corners.is_empty();
        if has_materials {
            all.materials.resize(all.corners.len() / 3, None);
            all.materials
                .resize((all.corners.len() + corners.len()) / 3, material);
        }
        if base > 0 {
            corners
                .par_iter_mut()
                .with_min_len(BLOCK)
                .for_each(|v| *v += base);
        }
        if all.corners.is_empty() {
            all.corners = corners;
        } else {
            all.corners.append(&mut corners);
        }
    }
    seen.note(notes);
    Ok(all)
}

impl Triangles {
    /// The bytes that an object of them takes, about: each column has a value for each corner there.
    pub(super) fn cost(&self) -> u64 {
        const VERTEX: usize = 64;
        const CORNER: usize = 48;
        let values: usize = self.columns.values().map(size_of_value).sum();
        (VERTEX * self.positions.len() + (CORNER + values) * self.corners.len()) as u64
    }

    /// Appends the vertices of a primitive; returns the first's index and how many there are.
    fn push_vertices(
        &mut self,
        reader: &Reader,
        primitive: &Primitive,
        here: &str,
        seen: &mut Seen,
    ) -> Result<(u32, u32), JsonError> {
        let pointer = |name: &str| format!("{here}/attributes/{name}");
        let Some(positions) = primitive
            .attributes
            .get(&Checked::Valid(Semantic::Positions))
        else {
            // Legal, and nothing to draw without an extension.
            seen.empty += 1;
            return Ok((0, 0));
        };
        let mut positions = reader.vectors(
            positions.value(),
            &pointer("POSITION"),
            &[Type::Vec3],
            0.0,
            DVec3::from_array,
        )?;
        let n = positions.len();
        let base = self.positions.len();
        let total = base
            .checked_add(n)
            .and_then(|total| u32::try_from(total).ok())
            .filter(|&total| total < u32::MAX);
        let (Some(_), Ok(first), Ok(count)) = (total, u32::try_from(base), u32::try_from(n)) else {
            let message = format!("expected fewer than {} vertices in a mesh", u32::MAX);
            return Err(JsonError::new(pointer("POSITION"), message));
        };
        if base == 0 {
            self.positions = positions;
        } else {
            self.positions.append(&mut positions);
        }
        let mut found = BTreeSet::new();
        for (semantic, accessor) in &primitive.attributes {
            let column = match semantic {
                Checked::Valid(Semantic::Positions) => continue,
                Checked::Valid(semantic) => semantic,
                Checked::Invalid => {
                    seen.attribute("of unknown names");
                    continue;
                }
            };
            let at = pointer(&column.to_string());
            let Some((name, values)) = read_column(reader, column, accessor.value(), &at)? else {
                seen.attribute(&column.to_string());
                continue;
            };
            if values.len() != n {
                let found = values.len();
                let message =
                    format!("expected {n} elements, one for each position, found {found}");
                return Err(JsonError::new(at, message));
            }
            if found.contains(&name) {
                seen.attribute(&(column.to_string() + " of a name that is taken"));
                continue;
            }
            if !self.columns.contains_key(&name) {
                let before = base * size_of_value(&values);
                reader.budget.spend(before as u64, &at)?;
            }
            if !self.push_column(name.clone(), values, base, seen) {
                seen.attribute(&(column.to_string() + " of another type"));
                continue;
            }
            found.insert(name);
        }
        // Attributes that only other primitives have.
        for (name, values) in &mut self.columns {
            if !found.contains(name) {
                let more = (base + n - values.len()) * size_of_value(values);
                reader.budget.spend(SMALL + more as u64, here)?;
                grow(values, base + n);
                seen.partial += 1;
            }
        }
        Ok((first, count))
    }

    /// Appends values behind `base` others; false if those are of another type.
    fn push_column(&mut self, name: String, values: Values, base: usize, seen: &mut Seen) -> bool {
        match self.columns.entry(name) {
            Entry::Vacant(new) if base == 0 => {
                new.insert(values);
                true
            }
            Entry::Vacant(new) => {
                let mut all = values.gather(base, |_| None);
                seen.partial += 1;
                let same = append(&mut all, values);
                new.insert(all);
                same
            }
            Entry::Occupied(known) => append(known.into_mut(), values),
        }
    }
}

/// The name and the values of an attribute; `None` if it is not read.
fn read_column(
    reader: &Reader,
    semantic: &Semantic,
    accessor: usize,
    at: &str,
) -> Result<Option<(String, Values)>, JsonError> {
    let Some(name) = attribute_name(semantic) else {
        return Ok(None);
    };
    let values = match semantic {
        Semantic::Normals => {
            DVec3::wrap(reader.vectors(accessor, at, &[Type::Vec3], 0.0, DVec3::from_array)?)
        }
        Semantic::TexCoords(_) => {
            let up = |[u, v]: [f64; 2]| DVec2::new(u, 1.0 - v);
            DVec2::wrap(reader.vectors(accessor, at, &[Type::Vec2], 0.0, up)?)
        }
        Semantic::Colors(_) => {
            let types = [Type::Vec3, Type::Vec4];
            DVec4::wrap(reader.vectors(accessor, at, &types, 1.0, DVec4::from_array)?)
        }
        _ => match reader.kind(accessor, at)? {
            kind @ Type::Scalar => {
                f64::wrap(reader.vectors(accessor, at, &[kind], 0.0, |[x]: [f64; 1]| x)?)
            }
            kind @ Type::Vec2 => {
                DVec2::wrap(reader.vectors(accessor, at, &[kind], 0.0, DVec2::from_array)?)
            }
            kind @ Type::Vec3 => {
                DVec3::wrap(reader.vectors(accessor, at, &[kind], 0.0, DVec3::from_array)?)
            }
            kind @ Type::Vec4 => {
                DVec4::wrap(reader.vectors(accessor, at, &[kind], 0.0, DVec4::from_array)?)
            }
            Type::Mat2 | Type::Mat3 | Type::Mat4 => return Ok(None),
        },
    };
    Ok(Some((name, values)))
}

/// Appends values, if they are of the same type.
fn append(all: &mut Values, more: Values) -> bool {
    match (all, more) {
        (Values::Float(all), Values::Float(mut more)) => all.append(&mut more),
        (Values::Vec2(all), Values::Vec2(mut more)) => all.append(&mut more),
        (Values::Vec3(all), Values::Vec3(mut more)) => all.append(&mut more),
        (Values::Vec4(all), Values::Vec4(mut more)) => all.append(&mut more),
        _ => return false,
    }
    true
}

/// The bytes of one of the values.
fn size_of_value(values: &Values) -> usize {
    match values {
        Values::Float(_) => size_of::<f64>(),
        Values::Vec2(_) => size_of::<DVec2>(),
        Values::Vec3(_) => size_of::<DVec3>(),
        Values::Vec4(_) => size_of::<DVec4>(),
        Values::Int(_) => size_of::<i32>(),
        Values::Tag(_) => size_of::<bool>(),
    }
}

/// Fills values up with zeros.
fn grow(values: &mut Values, n: usize) {
    match values {
        Values::Float(values) => values.resize(n, 0.0),
        Values::Vec2(values) => values.resize(n, DVec2::ZERO),
        Values::Vec3(values) => values.resize(n, DVec3::ZERO),
        Values::Vec4(values) => values.resize(n, DVec4::ZERO),
        Values::Int(values) => values.resize(n, 0),
        Values::Tag(values) => values.resize(n, false),
    }
}

/// The triangles of a primitive whose vertices are counted from 0.
fn corners(
    reader: &Reader,
    primitive: &Primitive,
    mode: Mode,
    count: u32,
    here: &str,
) -> Result<Vec<u32>, JsonError> {
    let order = match primitive.indices {
        None => {
            let pointer = format!("{here}/attributes/POSITION");
            reader.budget.spend(u64::from(count) * 4, &pointer)?;
            (0..count).collect()
        }
        Some(indices) => {
            let pointer = format!("{here}/indices");
            let order = reader.indices(indices.value(), &pointer)?;
            let wrong = |&v: &u32| v >= count;
            if order.par_iter().with_min_len(BLOCK).any(wrong) {
                let i = order.iter().position(wrong).unwrap_or(0);
                let message = format!(
                    "index {i} refers to vertex {}, but the primitive has {count} vertices",
                    order[i]
                );
                return Err(JsonError::new(pointer, message));
            }
            order
        }
    };
    let corners = match mode {
        Mode::TriangleStrip => order
            .windows(3)
            .enumerate()
            // Every second triangle is turned, so that all face the same way.
            .map(|(i, w)| {
                if i % 2 == 0 {
                    [w[0], w[1], w[2]]
                } else {
                    [w[0], w[2], w[1]]
                }
            })
            // Strips jump by triangles without area.
            .filter(|[a, b, c]| a != b && b != c && c != a)
            .flatten()
            .collect(),
        Mode::TriangleFan => match order.split_first() {
            None => Vec::new(),
            Some((&center, rest)) => rest.windows(2).flat_map(|w| [w[0], w[1], center]).collect(),
        },
        _ => {
            if order.len() % 3 != 0 {
                let message = format!("expected a multiple of 3 corners, found {}", order.len());
                return Err(JsonError::new(here, message));
            }
            order
        }
    };
    Ok(corners)
}

/// What of the primitives is left out.
#[derive(Default)]
struct Seen {
    morphs: usize,
    points: usize,
    lines: usize,
    empty: usize,
    partial: usize,
    attributes: BTreeMap<String, usize>,
}

impl Seen {
    fn attribute(&mut self, name: &str) {
        *self.attributes.entry(name.to_owned()).or_default() += 1;
    }

    fn note(self, notes: &mut Notes) {
        notes.left_out(self.morphs, None, "morph targets left out");
        notes.left_out(self.points, None, "primitives of points left out");
        notes.left_out(self.lines, None, "primitives of lines left out");
        notes.left_out(self.empty, None, "primitives without positions left out");
        let what = "attributes that only some primitives of a mesh have: taken as 0 elsewhere";
        notes.changed(self.partial, None, what);
        for (name, count) in self.attributes {
            notes.left_out(count, None, format!("attributes {name} left out"));
        }
    }
}
