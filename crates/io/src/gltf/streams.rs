//! The glTF vertex attributes: normals, tangents, texture coordinates, colors and custom attributes.

use glam::DVec3;
use gltf_json::accessor::Type;
use gltf_json::mesh::Semantic;
use mesh::{
    Column, Domain, FaceId, HalfEdgeId, Mesh, Values, VertexId, joint_of, morph_normal_of,
    morph_of, morph_tangent_of, morph_value_of, uv_set,
};

use super::names::{attribute_name, custom_semantic};
use crate::Format;
use crate::file_vertices::is_mark;
use crate::loss::Losses;

/// A stream: an attribute of a mesh in the form that glTF requires. Numbers have 32 bits, normals have length 1, the v
/// coordinate points down, and colors are from 0 to 1.
pub(super) struct Stream<'a> {
    pub(super) semantic: Semantic,
    pub(super) kind: Type,
    meaning: Meaning<'a>,
    /// The morph target that this attribute belongs to. `None` if the attribute belongs to the mesh itself.
    pub(super) target: Option<usize>,
    pub(super) domain: Domain,
    pub(super) column: &'a Column,
}

#[derive(Clone, Copy)]
enum Meaning<'a> {
    Normal,
    /// The normals of a morph target minus the normals of the mesh. The variant contains the column with the normals of
    /// the mesh, and the domain of this column.
    NormalDelta(Domain, &'a Column),
    Tangent,
    /// The tangents of a morph target minus the tangents of the mesh. The variant contains the corner column with the
    /// tangents of the mesh.
    TangentDelta(&'a Column),
    Uv,
    UvDelta,
    Color,
    ColorDelta,
    Custom,
}

/// Returns the streams of a mesh, which are its attributes in the form that glTF requires. Adds losses for all other
/// attributes. `has_target` returns whether the morph target with this index is written.
pub(super) fn streams<'a>(
    mesh: &'a Mesh,
    has_target: impl Fn(usize) -> bool,
    losses: &mut Losses,
) -> Vec<Stream<'a>> {
    let mut streams: Vec<Stream> = Vec::new();
    // In glTF, the indices of the sets of texture coordinates start at 0 and have no gaps.
    let is_uv = |set: u32| {
        let mut columns = mesh.attributes().of(Domain::Corner).iter();
        let is_it =
            |c: &Column| uv_set(&c.name) == Some(set) && matches!(c.values, Values::Vec2(_));
        columns.any(is_it)
    };
    let n_uvs = (0..u32::MAX).take_while(|&set| is_uv(set)).count();
    let n_uvs = u32::try_from(n_uvs).unwrap_or(u32::MAX);
    for domain in [Domain::Corner, Domain::Vertex] {
        for column in mesh.attributes().of(domain) {
            if let Some(stream) = stream(domain, column, n_uvs)
                // A corner attribute takes precedence over a vertex attribute of the same name.
                && streams.iter().all(|other| other.semantic != stream.semantic)
            {
                streams.push(stream);
            }
        }
    }
    let find = |streams: &[Stream<'a>], semantic| {
        let stream = streams.iter().find(|stream| stream.semantic == semantic)?;
        Some((stream.domain, stream.column))
    };
    let changes = value_deltas(mesh, &streams, &has_target);
    let normals = find(&streams, Semantic::Normals);
    if normals.is_none() {
        // Readers ignore tangents without normals, so such tangents are not written.
        streams.retain(|stream| stream.semantic != Semantic::Tangents);
    }
    let tangents = find(&streams, Semantic::Tangents);
    if let Some((domain, column)) = normals {
        streams.extend(deltas(
            mesh,
            Meaning::NormalDelta(domain, column),
            &has_target,
        ));
    }
    if let Some((_, column)) = tangents {
        streams.extend(deltas(mesh, Meaning::TangentDelta(column), &has_target));
    }
    streams.extend(changes);
    losses.add_columns(mesh, Format::Gltf, |domain, column| {
        let is_material = domain == Domain::Face && column.name == mesh::MATERIAL.name;
        is_deformer(domain, column)
            || is_mark(domain, column)
            // If a morph target is not written, one loss is reported for the whole target. No further losses are
            // reported for other attributes of the target, such as its normals.
            || normals.is_some() && morph_normal_of(&column.name).is_some()
            || tangents.is_some() && morph_tangent_of(&column.name).is_some()
            || morph_value_of(&column.name).is_some_and(|(changed, _)| {
                streams.iter().any(|stream| stream.is_named(changed))
            })
            || is_material && matches!(column.values, Values::Int(_))
            || streams
                .iter()
                .any(|stream| std::ptr::eq(stream.column, column))
    });
    streams.sort_by(|a, b| a.semantic.cmp(&b.semantic));
    streams
}

/// Returns the streams (attributes as glTF stores them) with the normals or the tangents of morph targets. glTF stores
/// the normals and tangents of a morph target as differences from the normals and tangents of the mesh.
fn deltas<'a>(
    mesh: &'a Mesh,
    meaning: Meaning<'a>,
    has_target: &impl Fn(usize) -> bool,
) -> Vec<Stream<'a>> {
    let mut deltas: Vec<Stream> = Vec::new();
    for domain in [Domain::Corner, Domain::Vertex] {
        for column in mesh.attributes().of(domain) {
            let (semantic, target) = match (meaning, &column.values) {
                (Meaning::NormalDelta(..), Values::Vec3(_)) => {
                    (Semantic::Normals, morph_normal_of(&column.name))
                }
                (Meaning::TangentDelta(_), Values::Vec4(_)) if domain == Domain::Corner => {
                    (Semantic::Tangents, morph_tangent_of(&column.name))
                }
                _ => continue,
            };
            let target = target.filter(|&target| has_target(target));
            if target.is_some() && deltas.iter().all(|other| other.target != target) {
                deltas.push(Stream {
                    semantic,
                    kind: Type::Vec3,
                    meaning,
                    target,
                    domain,
                    column,
                });
            }
        }
    }
    deltas
}

/// Morph targets can change texture coordinates and colors. Returns a stream for each such change. `streams` contains
/// the streams of the mesh itself. It is needed because in glTF, a morph target can change only attributes that the
/// mesh has.
fn value_deltas<'a>(
    mesh: &'a Mesh,
    streams: &[Stream<'a>],
    has_target: &impl Fn(usize) -> bool,
) -> Vec<Stream<'a>> {
    let mut deltas: Vec<Stream> = Vec::new();
    for domain in [Domain::Corner, Domain::Vertex] {
        for column in mesh.attributes().of(domain) {
            let Some((changed, target)) = morph_value_of(&column.name) else {
                continue;
            };
            let base = streams.iter().find(|stream| stream.is_named(changed));
            let Some(base) = base.filter(|_| has_target(target)) else {
                continue;
            };
            let (kind, meaning) = match (base.meaning, &column.values) {
                (Meaning::Uv, Values::Vec2(_)) => (Type::Vec2, Meaning::UvDelta),
                (Meaning::Color, Values::Vec4(_)) => (Type::Vec4, Meaning::ColorDelta),
                _ => continue,
            };
            if deltas.iter().all(|other| other.column.name != column.name) {
                deltas.push(Stream {
                    semantic: base.semantic.clone(),
                    kind,
                    meaning,
                    target: Some(target),
                    domain,
                    column,
                });
            }
        }
    }
    deltas
}

/// Whether a column contains the weights of a joint or the deltas of a morph target. Such columns are written
/// separately.
fn is_deformer(domain: Domain, column: &Column) -> bool {
    let is_joint = matches!(column.values, Values::Float(_)) && joint_of(&column.name).is_some();
    let is_morph = matches!(column.values, Values::Vec3(_)) && morph_of(&column.name).is_some();
    domain == Domain::Vertex && (is_joint || is_morph)
}

fn stream(domain: Domain, column: &Column, n_uvs: u32) -> Option<Stream<'_>> {
    let kind = match column.values {
        Values::Float(_) => Type::Scalar,
        Values::Vec2(_) => Type::Vec2,
        Values::Vec3(_) => Type::Vec3,
        Values::Vec4(_) => Type::Vec4,
        Values::Int(_) | Values::Tag(_) => return None,
    };
    let (semantic, meaning) = match (column.name.as_str(), kind) {
        ("normal", Type::Vec3) => (Semantic::Normals, Meaning::Normal),
        ("tangent", Type::Vec4) if domain == Domain::Corner => {
            (Semantic::Tangents, Meaning::Tangent)
        }
        ("color", Type::Vec4) => (Semantic::Colors(0), Meaning::Color),
        (name, Type::Vec2) if domain == Domain::Corner && uv_set(name).is_some() => {
            let set = uv_set(name).filter(|&set| set < n_uvs)?;
            (Semantic::TexCoords(set), Meaning::Uv)
        }
        (name, _) => (custom_semantic(name)?, Meaning::Custom),
    };
    Some(Stream {
        semantic,
        kind,
        meaning,
        target: None,
        domain,
        column,
    })
}

impl Stream<'_> {
    /// Whether this stream contains the attribute with this name, and belongs to the mesh itself instead of a morph
    /// target.
    fn is_named(&self, name: &str) -> bool {
        self.target.is_none() && attribute_name(&self.semantic).as_deref() == Some(name)
    }

    /// Returns the value that is written for a corner, and whether glTF allows the value in the mesh. If glTF does not
    /// allow it, a different value is written. The value always has four components. The caller drops the components
    /// that the stream does not need.
    pub(super) fn at(&self, mesh: &Mesh, v: VertexId, h: HalfEdgeId) -> ([f32; 4], bool) {
        let value = value(self.domain, self.column, v, h);
        let [x, y, ..] = value;
        match self.meaning {
            Meaning::Normal => normal(mesh, h, value),
            Meaning::NormalDelta(domain, normals) => {
                let (from, _) = normal(mesh, h, self::value(domain, normals, v, h));
                delta(from, value)
            }
            Meaning::Tangent => tangent(value),
            Meaning::TangentDelta(tangents) => {
                let (from, _) = tangent(self::value(Domain::Corner, tangents, v, h));
                delta(from, value)
            }
            Meaning::Uv => narrow([x, 1.0 - y, 0.0, 0.0], true),
            Meaning::Color => {
                let inside = |x: f64| if x.is_nan() { 0.0 } else { x.clamp(0.0, 1.0) };
                let color = value.map(inside);
                narrow(color, color == value)
            }
            Meaning::UvDelta => narrow([x, -y, 0.0, 0.0], true),
            Meaning::ColorDelta | Meaning::Custom => narrow(value, true),
        }
    }

    /// Returns the reason of a loss. It says which values of this stream glTF does not allow, and how they are changed.
    pub(super) fn change(&self) -> &'static str {
        match self.meaning {
            Meaning::Normal => "zero or not finite, so replaced by the normal of the face",
            Meaning::NormalDelta(..) => {
                "zero or not finite, so the morph target does not change the normal"
            }
            Meaning::TangentDelta(_) => {
                "zero or not finite, so the morph target does not change the tangent"
            }
            Meaning::Tangent => {
                "zero, not finite, or with an invalid sign, so replaced by a valid tangent"
            }
            Meaning::Color => "outside the range from 0 to 1, so clamped",
            Meaning::Uv | Meaning::UvDelta | Meaning::ColorDelta | Meaning::Custom => {
                "not finite when rounded to 32 bits, so written as 0"
            }
        }
    }
}

/// Returns a tangent as glTF stores it, and whether the tangent is unchanged.
fn tangent([x, y, z, w]: [f64; 4]) -> ([f32; 4], bool) {
    let unit = unit(DVec3::new(x, y, z));
    let is_kept = unit.is_some() && w.abs().to_bits() == 1.0_f64.to_bits();
    let tangent = unit.unwrap_or(DVec3::X);
    let sign = if w < 0.0 { -1.0 } else { 1.0 };
    narrow([tangent.x, tangent.y, tangent.z, sign], is_kept)
}

/// Subtracts the direction `from` (a normal or tangent), which is written for the mesh, from the direction that a morph
/// target gives, and returns the difference. If the direction of the morph target is zero or not finite, returns zero
/// and false.
fn delta(from: [f32; 4], [x, y, z, _]: [f64; 4]) -> ([f32; 4], bool) {
    let to = DVec3::new(x, y, z);
    if to == DVec3::ZERO || !to.is_finite() {
        return ([0.0; 4], false);
    }
    let from = from.map(f64::from);
    narrow([x - from[0], y - from[1], z - from[2], 0.0], true)
}

/// Returns the value of a column at a corner. Missing components are 0.
fn value(domain: Domain, column: &Column, v: VertexId, h: HalfEdgeId) -> [f64; 4] {
    let i = match domain {
        Domain::Vertex => v.index(),
        _ => h.index(),
    };
    match &column.values {
        Values::Float(values) => [values[i], 0.0, 0.0, 0.0],
        Values::Vec2(values) => [values[i].x, values[i].y, 0.0, 0.0],
        Values::Vec3(values) => [values[i].x, values[i].y, values[i].z, 0.0],
        Values::Vec4(values) => values[i].to_array(),
        Values::Int(_) | Values::Tag(_) => [0.0; 4],
    }
}

/// Returns the normal that is written for a corner, and whether the normal in the mesh can be normalized. If it cannot
/// be normalized, the normal of the face is written instead.
fn normal(mesh: &Mesh, h: HalfEdgeId, [x, y, z, _]: [f64; 4]) -> ([f32; 4], bool) {
    let unit = unit(DVec3::new(x, y, z));
    let normal = unit.unwrap_or_else(|| face_normal(mesh, mesh.face(h)));
    narrow([normal.x, normal.y, normal.z, 0.0], unit.is_some())
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "glTF stores 32-bit numbers"
)]
fn narrow(value: [f64; 4], good: bool) -> ([f32; 4], bool) {
    let narrow = value.map(|x| x as f32);
    if narrow.iter().all(|x| x.is_finite()) {
        return (narrow, good);
    }
    (narrow.map(|x| if x.is_finite() { x } else { 0.0 }), false)
}

/// Normalizes a vector. Returns `None` if the vector has no direction. A unit vector that was rounded to 32 bits is
/// returned unchanged. The length of such a vector is not exactly 1, so normalizing would change the vector slightly
/// each time it is written.
fn unit(v: DVec3) -> Option<DVec3> {
    const ROUNDING: f64 = 1e-6;
    if (v.length_squared() - 1.0).abs() < ROUNDING {
        return Some(v);
    }
    v.try_normalize()
}

fn face_normal(mesh: &Mesh, f: Option<FaceId>) -> DVec3 {
    f.and_then(|f| mesh.area_vector(f).try_normalize())
        .unwrap_or(DVec3::Z)
}
