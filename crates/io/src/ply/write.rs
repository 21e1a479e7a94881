//! Writes a scene to the bytes of a PLY file.

use std::borrow::Cow;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use glam::DVec3;
use mesh::{Column, Domain, FaceId, Mesh, Rule, UV, Values};
use scene::Scene;
use store::Store;

use super::attribute_comments::AttributeComment;
use super::columns::Kind;
use super::header::MAX_PROPERTIES;
use super::read::plain_rule;
use super::roles;
use super::types::Type;
use crate::error::WriteError;
use crate::file_vertices::{FileVertices, is_mark};
use crate::joined::joined;
use crate::loss::{Losses, n_values};
use crate::save::{Block, Content, save};
use crate::writing::{finite, is_byte, push_comment, to_byte, uvs_of_vertices};
use crate::{Format, WriteOptions, WriteReport, fail_if_lost};
use mesh::parallel;

/// The number of rows in a block of the file. A block has a few hundred kilobytes.
const BLOCK: usize = 8192;

/// Writes the image files in `images`, and then writes `scene` to a little-endian binary PLY file.
///
/// # Errors
///
/// Returns an error if an object is not a mesh, or the files cannot be written.
pub(crate) fn write(
    store: &dyn Store,
    path: &Path,
    scene: &Scene,
    images: Vec<(PathBuf, Content<'static>)>,
    options: &WriteOptions,
) -> Result<WriteReport, WriteError> {
    let mut joined = joined(scene, Format::Ply).map_err(|why| why.in_file(path))?;
    let mesh = &*joined.mesh;
    let mut losses = Losses::of(&joined.name, &mut joined.losses);
    losses.add_columns(mesh, Format::Ply, |_, _| true);
    let mut vertices = Element::vertices(mesh);
    let mut faces = Element::faces(mesh);
    for (domain, column) in mesh.attributes().iter().filter(|(d, c)| !is_mark(*d, c)) {
        let to = match domain {
            Domain::Vertex => &mut vertices,
            Domain::Corner if mesh.n_faces() == 0 => continue,
            Domain::Corner | Domain::Face => &mut faces,
            Domain::Edge => continue,
        };
        if to.properties.len() + 4 > MAX_PROPERTIES / 2 {
            let reason = "too many attributes for one file";
            losses.add(domain, &column.name, n_values(mesh, domain), reason);
            continue;
        }
        let values = finite(domain, column, &mut losses);
        if domain == Domain::Corner
            && (column.name.as_str(), column.rule) == (UV.name, UV.rule)
            && let Values::Vec2(_) = &*values
        {
            if let Some(uvs) = uvs_of_vertices(mesh, &values) {
                vertices.known(&["s", "t"], Cow::Owned(uvs));
            } else {
                // If the texture coordinates differ between the corners of a vertex, they are written as a list for
                // each face, as in `MeshLab`.
                let form = float_for(&values, 2);
                faces.values(&["texcoord"], true, values, 2, form);
            }
        } else {
            to.column(domain, column, values);
        }
    }
    fail_if_lost(path, options, &joined.losses)?;
    let file = FileVertices::of(mesh);
    let mut head = b"ply\nformat binary_little_endian 1.0\n".to_vec();
    push_comment(&mut head, "comment", options.provenance.as_deref());
    vertices.push_header(&mut head, "vertex", file.len());
    faces.push_header(&mut head, "face", mesh.n_faces());
    head.extend_from_slice(b"end_header\n");
    let mut blocks: Vec<Block> = vec![Box::new(move |out| out.extend_from_slice(&head))];
    vertices.add_blocks(&mut blocks, mesh, &file, file.len(), |row| file.vertex(row));
    faces.add_blocks(&mut blocks, mesh, &file, mesh.n_faces(), |row| row);
    let mut files = images;
    files.push((path.to_path_buf(), Content::Blocks(blocks)));
    let (files, bytes) = save(store, files)?;
    Ok(WriteReport {
        files,
        bytes,
        losses: joined.losses,
        packing: None,
    })
}

/// A table to be written.
#[derive(Default)]
struct Element<'a> {
    comments: Vec<String>,
    /// The header lines that declare the properties, without the word `property`.
    properties: Vec<String>,
    names: BTreeSet<String>,
    fields: Vec<Field<'a>>,
    /// The largest number of corners that a face has.
    most: usize,
}

/// A field of each row.
enum Field<'a> {
    Positions(&'a [DVec3]),
    /// The vertex indices of a face. The field is the type in which the number of indices is stored.
    Corners(Type),
    Values {
        values: Cow<'a, Values>,
        /// The number of written components of each value. If all colors are opaque, the alpha is left out.
        size: usize,
        form: Type,
        /// Values of corners are stored as a list for each face. For such a list, this is the type of its length.
        /// `None` for values of vertices and faces.
        count: Option<Type>,
    },
}

impl<'a> Element<'a> {
    fn vertices(mesh: &'a Mesh) -> Self {
        let mut new = Self::empty(0);
        for axis in ["x", "y", "z"] {
            new.property(None, Type::Float64, axis);
        }
        new.fields.push(Field::Positions(mesh.positions()));
        new
    }

    fn faces(mesh: &Mesh) -> Self {
        let degree = |f| mesh.degree(FaceId::new(f));
        let most = parallel::blocks(mesh.n_faces(), |faces| faces.map(degree).max());
        let mut new = Self::empty(most.into_iter().flatten().max().unwrap_or(0));
        let is_large = mesh.n_vertices() > i32::MAX as usize;
        let index = if is_large { Type::UInt32 } else { Type::Int32 };
        let count = count_type(new.most);
        new.property(Some(count), index, "vertex_indices");
        new.fields.push(Field::Corners(count));
        new
    }

    fn empty(most: usize) -> Self {
        Self {
            names: roles::names().map(str::to_owned).collect(),
            most,
            ..Self::default()
        }
    }

    /// Adds a property to the header. The property is a list if `count` is given.
    fn property(&mut self, count: Option<Type>, form: Type, name: &str) {
        let list = count.map_or(String::new(), |count| format!("list {} ", count.name()));
        self.properties
            .push(format!("{list}{} {name}", form.name()));
    }

    /// Adds the first `size` components of each value to the element. If `is_list` is true, they become one list
    /// property. Otherwise, they become one scalar property for each name.
    fn values(
        &mut self,
        names: &[impl AsRef<str>],
        is_list: bool,
        values: Cow<'a, Values>,
        size: usize,
        form: Type,
    ) {
        let count = is_list.then(|| count_type(size * self.most));
        for name in names.iter().take(size) {
            self.property(count, form, name.as_ref());
        }
        self.fields.push(Field::Values {
            values,
            size,
            form,
            count,
        });
    }

    /// Adds an attribute of vertices, faces or corners.
    fn column(&mut self, domain: Domain, column: &Column, values: Cow<'a, Values>) {
        match (domain, column.name.as_str(), column.rule, &*values) {
            (Domain::Vertex | Domain::Face, "normal", Rule::Normal, Values::Vec3(_)) => {
                self.known(&["nx", "ny", "nz"], values);
            }
            (Domain::Vertex, "color", Rule::Interpolate, Values::Vec4(_))
            | (Domain::Face, "color", Rule::Copy, Values::Vec4(_)) => {
                self.known(&["red", "green", "blue", "alpha"], values);
            }
            _ => self.free(domain, column, values),
        }
    }

    /// Adds the values of an attribute as properties with these standard names, which other programs know.
    fn known(&mut self, names: &[&str], values: Cow<'a, Values>) {
        let opaque = match &*values {
            Values::Vec4(colors) => parallel::all(colors.len(), |i| colors[i].w == 1.0),
            _ => false,
        };
        let size = names.len() - usize::from(opaque);
        let form = if names[0] == "red" && all_numbers(&values, size, is_byte) {
            Type::UInt8
        } else {
            float_for(&values, size)
        };
        self.values(names, false, values, size, form);
    }

    /// Adds the values of an attribute as properties that are named after the attribute. If a reader cannot restore the
    /// attribute from the names and types of these properties, a comment is added.
    fn free(&mut self, domain: Domain, column: &Column, values: Cow<'a, Values>) {
        let kind = Kind::of(&values);
        let form = match kind {
            Kind::Tag => Type::UInt8,
            Kind::Int => Type::Int32,
            _ => Type::Float64,
        };
        let is_list = domain == Domain::Corner;
        let names = self.free_names(&column.name, if is_list { 1 } else { kind.size() });
        let plain = !is_list
            && matches!(kind, Kind::Int | Kind::Float)
            && names[0] == column.name
            && plain_rule(domain, form) == column.rule;
        if !plain {
            let comment = AttributeComment {
                domain,
                kind,
                rule: column.rule,
                property: names[0].clone(),
                name: column.name.clone(),
            };
            self.comments.push(comment.text());
        }
        self.values(&names, is_list, values, kind.size(), form);
    }

    /// Returns unused names for the properties of an attribute with `n` components.
    fn free_names(&mut self, name: &str, n: usize) -> Vec<String> {
        let is_fine = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '-' | '.' | ':');
        let word = name.replace(|c| !is_fine(c), "_");
        let word = if word.is_empty() { "value" } else { &word };
        let mut number = 1_usize;
        loop {
            let base = match number {
                1 => word.to_owned(),
                _ => format!("{word}_{number}"),
            };
            let axes = ["_x", "_y", "_z", "_w"].into_iter().take(n);
            let axes = axes.map(|axis| if n == 1 { "" } else { axis });
            let names: Vec<String> = axes.map(|axis| format!("{base}{axis}")).collect();
            if names.iter().all(|name| !self.names.contains(name)) {
                self.names.extend(names.iter().cloned());
                return names;
            }
            number += 1;
        }
    }

    fn push_header(&self, out: &mut Vec<u8>, name: &str, rows: usize) {
        for comment in &self.comments {
            out.extend_from_slice(format!("comment {comment}\n").as_bytes());
        }
        out.extend_from_slice(format!("element {name} {rows}\n").as_bytes());
        for property in &self.properties {
            out.extend_from_slice(format!("property {property}\n").as_bytes());
        }
    }

    /// Divides the rows into blocks, and adds the functions that write these blocks. `element` maps the index of a row
    /// to the index of an element of the mesh.
    fn add_blocks<'b>(
        &'b self,
        blocks: &mut Vec<Block<'b>>,
        mesh: &'b Mesh,
        file: &'b FileVertices,
        n: usize,
        element: impl Fn(usize) -> usize + Copy + Send + Sync + 'b,
    ) {
        for first in (0..n).step_by(BLOCK) {
            let rows = first..n.min(first + BLOCK);
            blocks.push(Box::new(move |out| {
                for row in rows.clone() {
                    for field in &self.fields {
                        field.push(out, mesh, file, element(row));
                    }
                }
            }));
        }
    }
}

impl Field<'_> {
    fn push(&self, out: &mut Vec<u8>, mesh: &Mesh, file: &FileVertices, row: usize) {
        let f = FaceId::new(row);
        match self {
            Self::Positions(positions) => {
                push_numbers(out, positions[row].to_array(), Type::Float64);
            }
            Self::Corners(count) => {
                push_count(out, *count, mesh.degree(f));
                for v in mesh.face_vertices(f) {
                    push_whole(out, file.number(v));
                }
            }
            Self::Values {
                values,
                size,
                form,
                count: None,
            } => push_value(out, values, row, *size, *form),
            Self::Values {
                values,
                size,
                form,
                count: Some(count),
            } => {
                push_count(out, *count, size * mesh.degree(f));
                for h in mesh.face_half_edges(f) {
                    push_value(out, values, h.index(), *size, *form);
                }
            }
        }
    }
}

fn count_type(most: usize) -> Type {
    if most < 256 { Type::UInt8 } else { Type::Int32 }
}

fn push_count(out: &mut Vec<u8>, kind: Type, n: usize) {
    match u8::try_from(n) {
        Ok(byte) if kind == Type::UInt8 => out.push(byte),
        _ => push_whole(out, n),
    }
}

fn push_whole(out: &mut Vec<u8>, n: usize) {
    let n = u32::try_from(n).expect("meshes have fewer than 2^32 elements");
    out.extend_from_slice(&n.to_le_bytes());
}

fn push_value(out: &mut Vec<u8>, values: &Values, i: usize, size: usize, form: Type) {
    match values {
        Values::Tag(v) => out.push(u8::from(v[i])),
        Values::Int(v) => out.extend_from_slice(&v[i].to_le_bytes()),
        Values::Float(v) => push_numbers(out, [v[i]], form),
        Values::Vec2(v) => push_numbers(out, v[i].to_array(), form),
        Values::Vec3(v) => push_numbers(out, v[i].to_array(), form),
        Values::Vec4(v) if size == 3 => push_numbers(out, v[i].truncate().to_array(), form),
        Values::Vec4(v) => push_numbers(out, v[i].to_array(), form),
    }
}

fn push_numbers<const N: usize>(out: &mut Vec<u8>, numbers: [f64; N], form: Type) {
    match form {
        Type::UInt8 => out.extend_from_slice(&numbers.map(to_byte)),
        Type::Float32 => {
            out.extend_from_slice(numbers.map(|x| to_float(x).to_le_bytes()).as_flattened());
        }
        _ => out.extend_from_slice(numbers.map(f64::to_le_bytes).as_flattened()),
    }
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "called only for values that are exact in 32 bits"
)]
fn to_float(x: f64) -> f32 {
    x as f32
}

/// Returns the smallest floating-point type that stores the first `size` components of all values exactly.
fn float_for(values: &Values, size: usize) -> Type {
    let is_float = |x: f64| f64::from(to_float(x)).to_bits() == x.to_bits();
    if all_numbers(values, size, is_float) {
        Type::Float32
    } else {
        Type::Float64
    }
}

/// Whether the function `is` returns true for each of the first `size` components of every vector.
fn all_numbers(values: &Values, size: usize, is: impl Fn(f64) -> bool + Sync) -> bool {
    parallel::all(values.len(), |i| match values {
        Values::Vec2(v) => v[i].to_array()[..size].iter().all(|&x| is(x)),
        Values::Vec3(v) => v[i].to_array()[..size].iter().all(|&x| is(x)),
        Values::Vec4(v) => v[i].to_array()[..size].iter().all(|&x| is(x)),
        _ => false,
    })
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use geometry::shapes;
    use scene::{Object, Scene};
    use store::{Memory, Store};

    use super::{BLOCK, WriteOptions};
    use crate::{ReadOptions, read, write};

    #[test]
    fn a_mesh_of_several_blocks_has_the_same_bytes_for_any_number_of_threads() {
        let torus = shapes::torus(300, 70, 3.0, 1.0);
        assert!(torus.n_vertices() > 2 * BLOCK);
        let mut scene = Scene::new();
        scene.insert(Object::mesh("torus", torus.clone())).unwrap();
        let bytes = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            let (store, path) = (Memory::default(), Path::new("torus.ply"));
            let report = pool
                .unwrap()
                .install(|| write(&store, path, &scene, &WriteOptions::default()))
                .unwrap();
            let bytes = store.read(path).unwrap();
            assert_eq!(report.bytes, bytes.len() as u64);
            let back = read(&store, path, &ReadOptions::default()).unwrap();
            let mesh = back.objects[0].as_mesh().unwrap();
            assert_eq!(mesh.positions(), torus.positions());
            let corners = |mesh: &mesh::Mesh| -> Vec<Vec<mesh::VertexId>> {
                let corners = mesh.faces().map(|f| mesh.face_vertices(f).collect());
                corners.collect()
            };
            assert_eq!(corners(mesh), corners(&torus));
            bytes
        };
        let one = bytes(1);
        assert!([2, 8].iter().all(|&threads| bytes(threads) == one));
    }
}
