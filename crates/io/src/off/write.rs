//! From a scene to the text of an OFF file.

use std::borrow::Cow;

use glam::{DVec2, DVec3, DVec4};
use mesh::{COLOR, Domain, Mesh, Rule, UV, VERTEX_NORMAL, Value};
use scene::Scene;

use super::read::COLOR_INDEX;
use crate::decimal::{push_number, push_whole};
use crate::error::Unwritable;
use crate::joined::joined;
use crate::loss::Losses;
use crate::writing::{is_byte, push_comment, to_byte, uvs_of_vertices};
use crate::{One, WriteOptions};

/// The file that holds `scene`, and what it does not hold.
///
/// # Errors
///
/// If an object is no mesh.
pub(crate) fn write(scene: &Scene, options: &WriteOptions) -> Result<One, Unwritable> {
    let mut joined = joined(scene, "OFF", false)?;
    let mut losses = Losses::of(&joined.name, &mut joined.losses);
    let mut out = Vec::new();
    Content::of(&joined.mesh, &mut losses).push(&mut out, options);
    Ok((out, joined.losses))
}

/// What of a mesh a file holds besides positions and corners.
struct Content<'a> {
    mesh: &'a Mesh,
    normals: Option<Cow<'a, [DVec3]>>,
    colors: Option<Cow<'a, [DVec4]>>,
    /// Of vertices.
    uvs: Option<Cow<'a, [DVec2]>>,
    face_colors: Option<Cow<'a, [DVec4]>>,
    face_indices: Option<&'a [i32]>,
}

impl<'a> Content<'a> {
    fn of(mesh: &'a Mesh, losses: &mut Losses) -> Self {
        let of_faces = |name: &str| {
            let column = mesh.attributes().column(Domain::Face, name);
            column.filter(|column| column.rule == Rule::Copy)
        };
        let normals = mesh.get(VERTEX_NORMAL);
        let colors = mesh.get(COLOR);
        let face_colors = of_faces(COLOR.name).and_then(|c| DVec4::of(&c.values));
        let face_indices = of_faces(COLOR_INDEX)
            .and_then(|c| i32::of(&c.values))
            .filter(|_| face_colors.is_none());
        let corner_uvs = mesh.get(UV).filter(|_| mesh.n_faces() > 0);
        let uvs = corner_uvs.and_then(|uvs| uvs_of_vertices(mesh, uvs));
        if uvs.is_none() && corner_uvs.is_some() {
            let reason = "OFF has texture coordinates of vertices, and corners of one differ";
            losses.add(Domain::Corner, UV.name, mesh.n_half_edges(), reason);
        }
        losses.add_columns(mesh, "OFF", |domain, column| {
            match (domain, column.name.as_str()) {
                (Domain::Vertex, "normal") => normals.is_some(),
                (Domain::Vertex, "color") => colors.is_some(),
                // Said above if they are lost.
                (Domain::Corner, "uv") => corner_uvs.is_some(),
                (Domain::Face, "color") => face_colors.is_some(),
                (Domain::Face, COLOR_INDEX) => face_indices.is_some(),
                _ => false,
            }
        });
        let [normal, color, uv] = ["normal", "color", "uv"];
        let [of_vertex, of_face] = [Domain::Vertex, Domain::Face];
        Self {
            mesh,
            normals: normals.map(|n| finite(losses, of_vertex, normal, n, |n| n.is_finite())),
            colors: colors.map(|c| finite(losses, of_vertex, color, c, |c| c.is_finite())),
            uvs: uvs.map(|uvs| {
                let uvs = finite(losses, Domain::Corner, uv, &uvs, |uv| uv.is_finite());
                Cow::Owned(uvs.into_owned())
            }),
            face_colors: face_colors.map(|c| finite(losses, of_face, color, c, |c| c.is_finite())),
            face_indices,
        }
    }

    fn push(&self, out: &mut Vec<u8>, options: &WriteOptions) {
        for (prefix, there) in [
            ("ST", self.uvs.is_some()),
            ("C", self.colors.is_some()),
            ("N", self.normals.is_some()),
        ] {
            if there {
                out.extend_from_slice(prefix.as_bytes());
            }
        }
        out.extend_from_slice(b"OFF\n");
        push_comment(out, "#", options.provenance.as_deref());
        let (n_vertices, n_faces) = (self.mesh.n_vertices(), self.mesh.n_faces());
        let counts = format!("{n_vertices} {n_faces} {}\n", self.mesh.n_edges());
        out.extend_from_slice(counts.as_bytes());
        self.push_vertices(out);
        self.push_faces(out);
    }

    fn push_vertices(&self, out: &mut Vec<u8>) {
        let as_bytes = self.colors.as_deref().is_some_and(are_bytes);
        for (v, position) in self.mesh.positions().iter().enumerate() {
            push_number(out, position.x);
            push_numbers(out, &[position.y, position.z]);
            if let Some(normals) = &self.normals {
                push_numbers(out, &normals[v].to_array());
            }
            if let Some(colors) = &self.colors {
                push_color(out, colors[v], as_bytes);
            }
            if let Some(uvs) = &self.uvs {
                push_numbers(out, &uvs[v].to_array());
            }
            out.push(b'\n');
        }
    }

    fn push_faces(&self, out: &mut Vec<u8>) {
        let as_bytes = self.face_colors.as_deref().is_some_and(are_bytes);
        for f in self.mesh.faces() {
            push_whole(out, self.mesh.degree(f));
            for v in self.mesh.face_vertices(f) {
                out.push(b' ');
                push_whole(out, v.index());
            }
            if let Some(colors) = &self.face_colors {
                push_color(out, colors[f.index()], as_bytes);
            }
            if let Some(indices) = self.face_indices
                && indices[f.index()] != -1
            {
                out.extend_from_slice(format!(" {}", indices[f.index()]).as_bytes());
            }
            out.push(b'\n');
        }
    }
}

/// The values with zero in place of those that are not finite, which is a loss.
fn finite<'a, T: Value>(
    losses: &mut Losses,
    domain: Domain,
    name: &str,
    values: &'a [T],
    is_finite: impl Fn(&T) -> bool,
) -> Cow<'a, [T]> {
    let broken = values.iter().filter(|value| !is_finite(value)).count();
    if broken == 0 {
        return Cow::Borrowed(values);
    }
    losses.add(domain, name, broken, "not finite: written as 0");
    let mended = |value: &T| {
        if is_finite(value) {
            *value
        } else {
            T::default()
        }
    };
    Cow::Owned(values.iter().map(mended).collect())
}

/// Appends numbers, a blank before each.
fn push_numbers(out: &mut Vec<u8>, numbers: &[f64]) {
    for &x in numbers {
        out.push(b' ');
        push_number(out, x);
    }
}

/// Whether all colors are exactly so many 255ths, and not so dark that a reader takes them for parts of 1.
fn are_bytes(colors: &[DVec4]) -> bool {
    let all = colors.iter().all(|c| c.to_array().into_iter().all(is_byte));
    all && colors.iter().any(|c| c.max_element() > 1.0 / 255.0)
}

fn push_color(out: &mut Vec<u8>, color: DVec4, as_bytes: bool) {
    for x in color.to_array() {
        out.push(b' ');
        if as_bytes {
            push_whole(out, to_byte(x).into());
            continue;
        }
        let start = out.len();
        push_number(out, x);
        let is_whole = |byte: &u8| byte.is_ascii_digit() || *byte == b'-';
        // A point says that this is no whole number of 255ths.
        if out[start..].iter().all(is_whole) {
            out.extend_from_slice(b".0");
        }
    }
}
