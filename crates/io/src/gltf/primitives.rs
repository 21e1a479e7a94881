//! The primitives of a glTF mesh as one list of triangles.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3, DVec4};
use gltf_json::Index;
use gltf_json::accessor::Type;
use gltf_json::mesh::{Mode, Primitive, Semantic};
use gltf_json::validation::Checked;

use super::JsonError;
use super::accessor::Reader;
use super::document::get;
use crate::note::Notes;

/// All primitives of a mesh. A vertex here is one of glTF: one for each side of a seam.
#[derive(Clone, Debug, Default)]
pub(super) struct Triangles {
    pub(super) positions: Vec<DVec3>,
    /// One for each vertex, or none at all.
    pub(super) normals: Vec<DVec3>,
    /// One for each vertex, or none at all; v upwards.
    pub(super) uvs: Vec<DVec2>,
    /// One for each vertex, or none at all.
    pub(super) colors: Vec<DVec4>,
    pub(super) corners: Vec<[u32; 3]>,
    /// For each triangle its material in the document.
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
    for (i, primitive) in reader.document.meshes[index].primitives.iter().enumerate() {
        let here = format!("/meshes/{index}/primitives/{i}");
        seen.morphs += primitive.targets.as_ref().map_or(0, Vec::len);
        let Checked::Valid(mode) = primitive.mode else {
            return Err(JsonError::new(
                format!("{here}/mode"),
                "expected a number from 0 to 6",
            ));
        };
        if matches!(
            mode,
            Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip
        ) {
            seen.lines += 1;
            continue;
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
        let corners = corners(reader, primitive, mode, count, &here)?;
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
        all.materials
            .resize(all.corners.len() + corners.len(), material);
        all.corners
            .extend(corners.into_iter().map(|corners| corners.map(|v| base + v)));
    }
    seen.note(notes);
    Ok(all)
}

impl Triangles {
    /// Appends the vertices of a primitive; returns the first's index and how many there are.
    fn push_vertices(
        &mut self,
        reader: &Reader,
        primitive: &Primitive,
        here: &str,
        seen: &mut Seen,
    ) -> Result<(u32, u32), JsonError> {
        let find = |semantic| {
            primitive
                .attributes
                .get(&Checked::Valid(semantic))
                .map(Index::value)
        };
        let pointer = |name: &str| format!("{here}/attributes/{name}");
        let Some(positions) = find(Semantic::Positions) else {
            // Legal, and nothing to draw without an extension.
            seen.empty += 1;
            return Ok((0, 0));
        };
        let positions = reader.vectors(positions, &pointer("POSITION"), &[Type::Vec3], 0.0)?;
        let n = positions.len();
        let base = self.positions.len();
        let total = base
            .checked_add(n)
            .and_then(|total| u32::try_from(total).ok());
        let (Some(_), Ok(first), Ok(count)) = (total, u32::try_from(base), u32::try_from(n)) else {
            let message = format!("expected fewer than {} vertices in a mesh", u32::MAX);
            return Err(JsonError::new(pointer("POSITION"), message));
        };
        self.positions
            .extend(positions.into_iter().map(DVec3::from_array));
        let mut column = Column {
            reader,
            here,
            base,
            n,
            partial: &mut seen.partial,
        };
        column.extend(
            &mut self.normals,
            find(Semantic::Normals),
            "NORMAL",
            &[Type::Vec3],
            DVec3::from_array,
        )?;
        column.extend(
            &mut self.uvs,
            find(Semantic::TexCoords(0)),
            "TEXCOORD_0",
            &[Type::Vec2],
            |[u, v]| DVec2::new(u, 1.0 - v),
        )?;
        column.extend(
            &mut self.colors,
            find(Semantic::Colors(0)),
            "COLOR_0",
            &[Type::Vec3, Type::Vec4],
            DVec4::from_array,
        )?;
        for semantic in primitive.attributes.keys() {
            match semantic {
                Checked::Valid(
                    Semantic::Positions
                    | Semantic::Normals
                    | Semantic::TexCoords(0)
                    | Semantic::Colors(0),
                ) => {}
                Checked::Valid(semantic) => {
                    *seen.attributes.entry(semantic.to_string()).or_default() += 1;
                }
                Checked::Invalid => *seen.attributes.entry("unknown".to_owned()).or_default() += 1,
            }
        }
        Ok((first, count))
    }
}

/// Appends an attribute of a primitive with `n` vertices, the first of them number `base`.
struct Column<'a> {
    reader: &'a Reader<'a>,
    here: &'a str,
    base: usize,
    n: usize,
    partial: &'a mut usize,
}

impl Column<'_> {
    fn extend<const N: usize, T: Copy + Default>(
        &mut self,
        values: &mut Vec<T>,
        accessor: Option<usize>,
        name: &str,
        types: &[Type],
        convert: impl Fn([f64; N]) -> T,
    ) -> Result<(), JsonError> {
        let end = self.base + self.n;
        let Some(accessor) = accessor else {
            if !values.is_empty() {
                values.resize(end, T::default());
                *self.partial += 1;
            }
            return Ok(());
        };
        let pointer = format!("{}/attributes/{name}", self.here);
        let read = self.reader.vectors(accessor, &pointer, types, 1.0)?;
        if read.len() != self.n {
            let message = format!(
                "expected {} elements, one for each position, found {}",
                self.n,
                read.len()
            );
            return Err(JsonError::new(pointer, message));
        }
        if values.len() < self.base {
            values.resize(self.base, T::default());
            *self.partial += 1;
        }
        values.extend(read.into_iter().map(convert));
        Ok(())
    }
}

/// The triangles of a primitive whose vertices are counted from 0.
fn corners(
    reader: &Reader,
    primitive: &Primitive,
    mode: Mode,
    count: u32,
    here: &str,
) -> Result<Vec<[u32; 3]>, JsonError> {
    let order = match primitive.indices {
        None => (0..count).collect(),
        Some(indices) => {
            let pointer = format!("{here}/indices");
            let order = reader.indices(indices.value(), &pointer)?;
            if let Some(i) = order.iter().position(|&v| v >= count) {
                let message = format!(
                    "index {i} refers to vertex {}, but the primitive has {count} vertices",
                    order[i]
                );
                return Err(JsonError::new(pointer, message));
            }
            order
        }
    };
    let triangles = match mode {
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
            .collect(),
        Mode::TriangleFan => match order.split_first() {
            None => Vec::new(),
            Some((&center, rest)) => rest.windows(2).map(|w| [w[0], w[1], center]).collect(),
        },
        _ => {
            if order.len() % 3 != 0 {
                let message = format!("expected a multiple of 3 corners, found {}", order.len());
                return Err(JsonError::new(here, message));
            }
            order.chunks_exact(3).map(|w| [w[0], w[1], w[2]]).collect()
        }
    };
    Ok(triangles)
}

/// What of the primitives is left out.
#[derive(Default)]
struct Seen {
    morphs: usize,
    lines: usize,
    empty: usize,
    partial: usize,
    attributes: BTreeMap<String, usize>,
}

impl Seen {
    fn note(self, notes: &mut Notes) {
        notes.left_out(self.morphs, None, "morph targets left out");
        notes.left_out(self.lines, None, "primitives of points or lines left out");
        notes.left_out(self.empty, None, "primitives without positions left out");
        let what = "attributes that only some primitives of a mesh have: taken as 0 elsewhere";
        notes.changed(self.partial, None, what);
        for (name, count) in self.attributes {
            notes.left_out(count, None, format!("attributes {name} left out"));
        }
    }
}
