//! Writes a scene to the text of an OFF file.

use std::borrow::Cow;

use glam::DVec4;
use mesh::{Column, Domain, Mesh, Rule, Values};
use scene::Scene;

use super::read::COLOR_INDEX;
use crate::decimal::{push_number, push_whole};
use crate::error::Unwritable;
use crate::file_vertices::FileVertices;
use crate::joined::joined;
use crate::loss::{Losses, n_values};
use crate::writing::{
    NOT_FINITE, finite, is_byte, push_comment, to_byte, uvs_of_vertices, zero_non_finite,
};
use crate::{Format, SingleFile, WriteOptions};

/// Writes `scene`, and lists the content that the file does not store.
///
/// # Errors
///
/// Returns an error if an object is not a mesh.
pub(crate) fn write(scene: &Scene, options: &WriteOptions) -> Result<SingleFile, Unwritable> {
    let mut joined = joined(scene, Format::Off)?;
    let mut losses = Losses::of(&joined.name, &mut joined.losses);
    let mut out = Vec::new();
    Content::of(&joined.mesh, &mut losses).push(&mut out, options);
    Ok((out, joined.losses))
}

/// The content that is written. In attributes, values that are not finite are replaced by 0.
struct Content<'a> {
    mesh: &'a Mesh,
    /// The normals, colors and texture coordinates of the vertices, if they exist.
    of_vertices: Vec<Cow<'a, Values>>,
    /// The colors of the faces, or their indices into a color map.
    of_faces: Option<Cow<'a, Values>>,
}

impl<'a> Content<'a> {
    fn of(mesh: &'a Mesh, losses: &mut Losses) -> Self {
        let fits = |domain: Domain, column: &Column| match (
            domain,
            column.name.as_str(),
            &column.values,
        ) {
            (Domain::Vertex, "normal", Values::Vec3(_))
            | (Domain::Vertex, "color", Values::Vec4(_)) => true,
            (Domain::Corner, "uv", Values::Vec2(_)) => mesh.n_faces() > 0,
            (Domain::Face, "color", Values::Vec4(_))
            | (Domain::Face, COLOR_INDEX, Values::Int(_)) => column.rule == Rule::Copy,
            _ => false,
        };
        let column = |domain, name: &str| {
            let column = mesh.attributes().column(domain, name);
            column.filter(|column| fits(domain, column))
        };
        let of_corners = column(Domain::Corner, "uv");
        let uvs = of_corners.and_then(|column| uvs_of_vertices(mesh, &column.values));
        if uvs.is_none() && of_corners.is_some() {
            let reason =
                "OFF stores texture coordinates at vertices, but corners of the same vertex differ";
            losses.add(Domain::Corner, "uv", n_values(mesh, Domain::Corner), reason);
        }
        let of_faces = column(Domain::Face, "color").or(column(Domain::Face, COLOR_INDEX));
        let is_other = |column| of_faces.is_none_or(|one| !std::ptr::eq(one, column));
        losses.add_columns(mesh, Format::Off, |domain, column| {
            fits(domain, column) && (domain != Domain::Face || !is_other(column))
        });
        let mut of_vertices = Vec::new();
        for name in ["normal", "color"] {
            let column = column(Domain::Vertex, name);
            of_vertices.extend(column.map(|column| finite(Domain::Vertex, column, losses)));
        }
        if let Some(mut uvs) = uvs {
            losses.add(Domain::Corner, "uv", zero_non_finite(&mut uvs), NOT_FINITE);
            of_vertices.push(Cow::Owned(uvs));
        }
        Self {
            mesh,
            of_vertices,
            of_faces: of_faces.map(|column| finite(Domain::Face, column, losses)),
        }
    }

    fn push(&self, out: &mut Vec<u8>, options: &WriteOptions) {
        for values in self.of_vertices.iter().rev() {
            out.extend_from_slice(match **values {
                Values::Vec2(_) => b"ST",
                Values::Vec4(_) => b"C",
                _ => b"N",
            });
        }
        out.extend_from_slice(b"OFF\n");
        push_comment(out, "#", options.provenance.as_deref());
        let vertices = FileVertices::of(self.mesh);
        let (n_vertices, n_faces) = (vertices.len(), self.mesh.n_faces());
        let counts = format!("{n_vertices} {n_faces} {}\n", self.mesh.n_edges());
        out.extend_from_slice(counts.as_bytes());
        let as_bytes: Vec<bool> = self.of_vertices.iter().map(|v| are_bytes(v)).collect();
        for v in (0..n_vertices).map(|i| vertices.vertex(i)) {
            let position = self.mesh.positions()[v];
            push_number(out, position.x);
            push_numbers(out, &[position.y, position.z]);
            for (values, &as_bytes) in self.of_vertices.iter().zip(&as_bytes) {
                push_value(out, values, v, as_bytes);
            }
            out.push(b'\n');
        }
        let as_bytes = self.of_faces.as_deref().is_some_and(are_bytes);
        for f in self.mesh.faces() {
            push_whole(out, self.mesh.degree(f));
            for v in self.mesh.face_vertices(f) {
                out.push(b' ');
                push_whole(out, vertices.number(v));
            }
            if let Some(values) = &self.of_faces {
                push_value(out, values, f.index(), as_bytes);
            }
            out.push(b'\n');
        }
    }
}

fn push_value(out: &mut Vec<u8>, values: &Values, i: usize, as_bytes: bool) {
    match values {
        Values::Vec2(values) => push_numbers(out, &values[i].to_array()),
        Values::Vec3(values) => push_numbers(out, &values[i].to_array()),
        Values::Vec4(colors) => push_color(out, colors[i], as_bytes),
        Values::Int(indices) if indices[i] != -1 => {
            out.extend_from_slice(format!(" {}", indices[i]).as_bytes());
        }
        _ => {}
    }
}

fn push_numbers(out: &mut Vec<u8>, numbers: &[f64]) {
    for &x in numbers {
        out.push(b' ');
        push_number(out, x);
    }
}

/// Whether all components are exact multiples of 1/255, and at least one of them is greater than 1/255. If such colors
/// are written as bytes, at least one byte is greater than 1. Therefore, a reader does not mistake the bytes for
/// components from 0 to 1.
fn are_bytes(values: &Values) -> bool {
    let Values::Vec4(colors) = values else {
        return false;
    };
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
        // A decimal point shows readers that the component is a number from 0 to 1 instead of a byte.
        if out[start..].iter().all(is_whole) {
            out.extend_from_slice(b".0");
        }
    }
}
