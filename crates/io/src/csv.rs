//! Writes CSV files, which contain a table of the vertices, faces or corners of a mesh. The program does not read CSV
//! files.
//!
//! | column | content |
//! | --- | --- |
//! | `object` | if there are several objects: the name of the object; faces and vertices are then numbered from 0 in each object |
//! | `face` | in tables of faces and corners: the number of the face |
//! | `vertex` | in tables of vertices and corners: the number of the vertex |
//! | `x`, `y`, `z` | the position; in tables of faces, the mean of the corners |
//! | name of an attribute | a number; for a tag, 1 if the element has the tag, otherwise 0 |
//! | `name[0]`, `name[1]`, ... | the components of a vector |
//!
//! Each line ends with a line feed. A field that contains commas, quotes or line breaks is quoted (RFC 4180). Each
//! number gets only as many digits as a reader needs to restore exactly the same 64-bit number. Numbers that are not
//! finite are written as `nan`, `inf` and `-inf`. If another column already has the name of an attribute, a number is
//! appended to the name of the attribute.

use mesh::{Domain, FaceId, HalfEdgeId, Mesh};
use scene::{Geometry, Object, Scene};

use crate::decimal::{push_number, push_whole};
use crate::error::Unwritable;
use crate::joined::joined;
use crate::loss::Losses;
use crate::{Format, Rows, SingleFile, WriteOptions};
use mesh::parallel;

/// Writes `scene`, and lists the content that the file does not store.
///
/// # Errors
///
/// Returns an error if an object is not a mesh.
pub(crate) fn write(scene: &Scene, options: &WriteOptions) -> Result<SingleFile, Unwritable> {
    let mut joined = joined(scene, Format::Csv)?;
    let (mesh, rows) = (&*joined.mesh, options.rows.unwrap_or_default());
    let domain = rows.domain();
    let mut losses = Losses::of(&joined.name, &mut joined.losses);
    losses.add_columns_of_rows(mesh, Format::Csv, rows, |_, _| true);
    let parts = Parts::of(scene);
    let mut out = header(mesh, rows, &parts);
    let blocks = match rows {
        Rows::Vertices => parallel::blocks(mesh.n_vertices(), |block| {
            let mut out = Vec::new();
            for v in block {
                let part = parts.push(&mut out, |part| part.vertices <= v);
                push_whole(&mut out, v - part.vertices);
                push_row(&mut out, mesh, domain, v, mesh.positions()[v].to_array());
            }
            out
        }),
        Rows::Faces => parallel::blocks(mesh.n_faces(), |block| {
            let mut out = Vec::new();
            for f in block {
                let part = parts.push(&mut out, |part| part.faces <= f);
                push_whole(&mut out, f - part.faces);
                let center = mesh.face_center(FaceId::new(f)).to_array();
                push_row(&mut out, mesh, domain, f, center);
            }
            out
        }),
        Rows::Corners => parallel::blocks(mesh.n_faces(), |block| {
            let mut out = Vec::new();
            for f in block {
                for h in mesh.face_half_edges(FaceId::new(f)) {
                    let part = parts.push(&mut out, |part| part.faces <= f);
                    push_corner(&mut out, mesh, f, h, part);
                }
            }
            out
        }),
    };
    for block in blocks {
        out.extend_from_slice(&block);
    }
    Ok((out, joined.losses))
}

/// An object of the scene. `vertices` and `faces` are the total numbers of vertices and faces of all earlier objects.
struct Part {
    name: String,
    vertices: usize,
    faces: usize,
}

/// The objects in the order of the scene.
struct Parts(Vec<Part>);

impl Parts {
    fn of(scene: &Scene) -> Self {
        let (mut vertices, mut faces) = (0, 0);
        let part = |object: &Object| {
            let part = Part {
                name: quoted(&object.name),
                vertices,
                faces,
            };
            if let Geometry::Mesh(mesh) = &object.geometry {
                vertices += mesh.n_vertices();
                faces += mesh.n_faces();
            }
            part
        };
        Self(scene.objects().iter().map(part).collect())
    }

    /// Returns the object that contains the vertex or face of the current row. `has_started` returns whether an object
    /// begins at or before this vertex or face. If there are several objects, appends the name of the returned object
    /// to the row.
    fn push(&self, out: &mut Vec<u8>, has_started: impl Fn(&Part) -> bool) -> &Part {
        let part = &self.0[self.0.partition_point(has_started) - 1];
        if self.0.len() > 1 {
            out.extend_from_slice(part.name.as_bytes());
            out.push(b',');
        }
        part
    }
}

fn push_corner(out: &mut Vec<u8>, mesh: &Mesh, f: usize, h: HalfEdgeId, part: &Part) {
    let v = mesh.origin(h);
    push_whole(out, f - part.faces);
    out.push(b',');
    push_whole(out, v.index() - part.vertices);
    push_row(
        out,
        mesh,
        Domain::Corner,
        h.index(),
        mesh.position(v).to_array(),
    );
}

/// Appends the position and the attributes of the element with index `i`, and ends the row.
fn push_row(out: &mut Vec<u8>, mesh: &Mesh, domain: Domain, i: usize, position: [f64; 3]) {
    for x in position {
        push_value(out, x);
    }
    for column in mesh.attributes().of(domain) {
        for k in 0..column.values.n_components() {
            push_value(out, column.values.component(i, k));
        }
    }
    out.push(b'\n');
}

fn push_value(out: &mut Vec<u8>, x: f64) {
    out.push(b',');
    if x.is_finite() {
        push_number(out, x);
    } else if x.is_nan() {
        out.extend_from_slice(b"nan");
    } else {
        out.extend_from_slice(if x > 0.0 { b"inf" } else { b"-inf" });
    }
}

fn header(mesh: &Mesh, rows: Rows, parts: &Parts) -> Vec<u8> {
    let numbers: &[&str] = match rows {
        Rows::Vertices => &["vertex"],
        Rows::Faces => &["face"],
        Rows::Corners => &["face", "vertex"],
    };
    let object = ["object"].iter().filter(|_| parts.0.len() > 1);
    let mut names: Vec<String> = object
        .chain(numbers)
        .chain(&["x", "y", "z"])
        .map(|&n| n.to_owned())
        .collect();
    for column in mesh.attributes().of(rows.domain()) {
        let n = column.values.n_components();
        for k in 0..n {
            let name = match n {
                1 => column.name.clone(),
                _ => format!("{}[{k}]", column.name),
            };
            names.push(unused(name, |name| names.iter().any(|other| other == name)));
        }
    }
    let line: Vec<String> = names.iter().map(|name| quoted(name)).collect();
    (line.join(",") + "\n").into_bytes()
}

/// Returns a name as a field of the table, in quotes if necessary.
fn quoted(name: &str) -> String {
    if name.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", name.replace('"', "\"\""))
    } else {
        name.to_owned()
    }
}

/// Returns the name if it is unused. Otherwise, tries the numbers 2, 3 and so on, and appends the first number that
/// makes the name unused.
pub(crate) fn unused(name: String, is_used: impl Fn(&str) -> bool) -> String {
    if !is_used(&name) {
        return name;
    }
    let numbered = (2_u64..).map(|n| format!("{name} ({n})"));
    let mut free = numbered.skip_while(|name| is_used(name));
    free.next().unwrap_or(name)
}
