//! Writes NPZ files, which contain the arrays of a mesh for `NumPy`. The program does not read NPZ files.
//!
//! | array | shape | content |
//! | --- | --- | --- |
//! | `vertices` | n, 3 | the positions of the vertices |
//! | `faces` | m, k | the vertex ids of the faces, if all faces have k corners |
//! | `faces`, `offsets` | corners; m + 1 | otherwise: the vertex ids of all faces, one face after the other; face i has the entries `offsets[i]` to `offsets[i + 1]` |
//! | `edges` | e, 2 | the vertex ids of the edges, if edges have attributes |
//! | `vertex/name`, `face/name`, `edge/name` | elements, or elements and components | the attributes |
//! | `corner/name` | corners, or corners and components | the attributes of corners, face by face |
//!
//! Floating-point numbers are stored as `float64`, integers as `int32`, tags as `bool`, and vertex ids as `int64`. The
//! file is an uncompressed zip archive of `.npy` files (version 1.0 of the format). In the names of attributes,
//! slashes, backslashes and control characters become `_`. If the name of an array is already used, a number is
//! appended to it.

mod zip;

use glam::DVec3;
use mesh::{Column, Domain, HalfEdgeId, Mesh, Values, VertexId};
use scene::Scene;

use crate::csv::unused;
use crate::error::Unwritable;
use crate::joined::joined;
use crate::{Format, SingleFile};
use zip::Archive;

/// Writes `scene`, and lists the content that the file does not store.
///
/// # Errors
///
/// Returns an error if an object is not a mesh, or if the file would exceed a limit of zip archives, such as 4 GiB.
pub(crate) fn write(scene: &Scene) -> Result<SingleFile, Unwritable> {
    let joined = joined(scene, Format::Npz)?;
    let mesh = &*joined.mesh;
    let mut archive = Archive::default();
    let positions = bytemuck::cast_slice::<DVec3, f64>(mesh.positions());
    let n = mesh.n_vertices();
    archive.add("vertices.npy", &npy("<f8", &[n, 3], floats(positions)));
    add_faces(mesh, &mut archive);
    if !mesh.attributes().of(Domain::Edge).is_empty() {
        let ends = mesh.edges().flat_map(|e| mesh.edge_vertices(e));
        let bytes = wholes(ends.map(VertexId::index));
        archive.add("edges.npy", &npy("<i8", &[mesh.n_edges(), 2], bytes));
    }
    for (domain, column) in mesh.attributes().iter() {
        let name: String = (column.name.chars())
            .map(|c| {
                if c.is_control() || c == '/' || c == '\\' {
                    '_'
                } else {
                    c
                }
            })
            .collect();
        let name = unused(format!("{domain}/{name}"), |name| {
            archive.has(&format!("{name}.npy"))
        });
        archive.add(&format!("{name}.npy"), &attribute(mesh, domain, column));
    }
    let bytes = archive.finish().ok_or_else(|| {
        Unwritable::scene(
            "expected arrays of less than 4 GiB in total, which is the limit of .npz files"
                .to_owned(),
        )
    })?;
    Ok((bytes, joined.losses))
}

fn add_faces(mesh: &Mesh, archive: &mut Archive) {
    let mut offsets = vec![0];
    let mut corners = Vec::new();
    for f in mesh.faces() {
        corners.extend(mesh.face_vertices(f).map(VertexId::index));
        offsets.push(corners.len());
    }
    let (m, n) = (mesh.n_faces(), corners.len());
    let degree = if m == 0 { 3 } else { offsets[1] };
    let corners = wholes(corners);
    if offsets.windows(2).all(|pair| pair[1] - pair[0] == degree) {
        archive.add("faces.npy", &npy("<i8", &[m, degree], corners));
    } else {
        archive.add("faces.npy", &npy("<i8", &[n], corners));
        archive.add("offsets.npy", &npy("<i8", &[m + 1], wholes(offsets)));
    }
}

/// Returns the `.npy` file of an attribute.
fn attribute(mesh: &Mesh, domain: Domain, column: &Column) -> Vec<u8> {
    let gathered;
    let values = if domain == Domain::Corner {
        let corners = mesh.faces().flat_map(|f| mesh.face_half_edges(f));
        let corners: Vec<usize> = corners.map(HalfEdgeId::index).collect();
        gathered = column.values.gather(corners.len(), |i| Some(corners[i]));
        &gathered
    } else {
        &column.values
    };
    let n = values.len();
    match values {
        Values::Float(list) => npy("<f8", &[n], floats(list)),
        Values::Vec2(list) => npy("<f8", &[n, 2], floats(bytemuck::cast_slice(list))),
        Values::Vec3(list) => npy("<f8", &[n, 3], floats(bytemuck::cast_slice(list))),
        Values::Vec4(list) => npy("<f8", &[n, 4], floats(bytemuck::cast_slice(list))),
        Values::Int(list) => npy(
            "<i4",
            &[n],
            list.iter().flat_map(|x| x.to_le_bytes()).collect(),
        ),
        Values::Tag(list) => npy("|b1", &[n], list.iter().map(|&x| x.into()).collect()),
    }
}

fn floats(numbers: &[f64]) -> Vec<u8> {
    numbers.iter().flat_map(|x| x.to_le_bytes()).collect()
}

fn wholes(numbers: impl IntoIterator<Item = usize>) -> Vec<u8> {
    let number = |n: usize| i64::try_from(n).expect("a length of a list").to_le_bytes();
    numbers.into_iter().flat_map(number).collect()
}

/// Returns an array as a `.npy` file. The header is padded, so that the data starts at a multiple of 64 bytes.
///
/// Source: "NEP 1 - A Simple File Format for `NumPy` Arrays".
fn npy(kind: &str, shape: &[usize], data: Vec<u8>) -> Vec<u8> {
    const PREFIX: usize = 10;
    let sizes: Vec<String> = shape.iter().map(ToString::to_string).collect();
    // The header is a Python literal. In Python, a tuple with one number has a comma after the number.
    let end = if shape.len() == 1 { "," } else { "" };
    let shape = sizes.join(", ") + end;
    let mut header = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({shape}), }}");
    let end = (PREFIX + header.len() + 1).next_multiple_of(64);
    header += &" ".repeat(end - PREFIX - header.len() - 1);
    header += "\n";
    let length = u16::try_from(header.len()).expect("a shape of at most two numbers");
    let mut out = Vec::with_capacity(end + data.len());
    out.extend_from_slice(b"\x93NUMPY\x01\x00");
    out.extend_from_slice(&length.to_le_bytes());
    out.extend_from_slice(header.as_bytes());
    out.extend(data);
    out
}
