//! From a scene to a glTF document and its bytes.
//!
//! Everything is counted first, so that the document is known before its bytes: those are then written
//! once, in parallel, to where they stay.

use std::collections::BTreeMap;
use std::path::Path;

use gltf_json::accessor::{ComponentType, GenericComponentType, Type};
use gltf_json::buffer::{Target, View};
use gltf_json::mesh::{Mode, Primitive, Semantic};
use gltf_json::validation::Checked;
use gltf_json::{Accessor, Asset, Buffer, Index, Node, Root};
use mesh::{Domain, Mesh};
use scene::{Geometry, Object, Scene};
use serde_json::json;

use super::faces::{Faces, faces_by_material};
use super::fill::{Bounds, bounds, fill_indices, fill_positions, fill_stream};
use super::split::{Split, split};
use super::streams::{Stream, streams};
use super::write_materials::MaterialWriter;
use crate::dense::dense;
use crate::error::Unwritable;
use crate::loss::Losses;
use crate::{WriteOptions, Written};

/// The files that hold `scene`, to be renamed in this order, and what they do not hold.
///
/// # Errors
///
/// If an object is no mesh, or the scene does not fit the lengths of the format.
pub(crate) fn write(
    path: &Path,
    binary: bool,
    scene: &Scene,
    options: &WriteOptions,
) -> Result<Written, Unwritable> {
    let mut losses = Vec::new();
    let mut meshes = Vec::new();
    for object in scene.objects() {
        let Geometry::Mesh(mesh) = &object.geometry else {
            return Err(Unwritable::object(
                &object.name,
                format!("glTF files hold meshes, found {}", object.geometry.kind()),
            ));
        };
        meshes.push(dense(mesh));
    }
    let mut prepared = Vec::new();
    for (object, mesh) in scene.objects().iter().zip(&meshes) {
        let mut losses = Losses::of(&object.name, &mut losses);
        prepared.push(Prepared::new(object, mesh, &mut losses)?);
    }
    let mut writer = Writer::new(options);
    for prepared in &prepared {
        let mut losses = Losses::of(&prepared.object.name, &mut losses);
        writer.object(prepared, &mut losses);
    }
    let Writer {
        mut root,
        pieces,
        materials,
        ..
    } = writer;
    let length = pieces.last().map_or(0, Piece::end);
    if u32::try_from(length).is_err() {
        let message = format!("a glTF file holds less than 4 GB, the scene needs {length} bytes");
        return Err(Unwritable::Scene { message });
    }
    if binary {
        add_buffer(&mut root, length, None);
        let glb = container(&to_json(&root, materials)?, length, &pieces)?;
        return Ok(Written {
            files: vec![(path.to_path_buf(), glb)],
            losses,
        });
    }
    let binary_path = path.with_extension("bin");
    let uri = binary_path
        .file_name()
        .map(|name| percent_encoded(&name.to_string_lossy()));
    add_buffer(&mut root, length, uri);
    let mut files = vec![(path.to_path_buf(), to_json(&root, materials)?)];
    if length > 0 {
        let mut bytes = mesh::zeroed(length);
        fill(&mut bytes, &pieces);
        files.insert(0, (binary_path, bytes));
    }
    Ok(Written { files, losses })
}

fn add_buffer(root: &mut Root, length: usize, uri: Option<String>) {
    if length > 0 {
        let byte_length = length.into();
        root.buffers.push(Buffer {
            byte_length,
            name: None,
            uri,
            extensions: None,
            extras: None,
        });
    }
}

fn to_json(root: &Root, materials: MaterialWriter) -> Result<Vec<u8>, Unwritable> {
    let error = |e: serde_json::Error| Unwritable::Scene {
        message: e.to_string(),
    };
    let mut json = serde_json::to_value(root).map_err(error)?;
    if let Some(members) = json.as_object_mut() {
        materials.insert_into(members);
    }
    serde_json::to_vec(&json).map_err(error)
}

/// A GLB file: a header, a chunk of JSON and a chunk of bytes, each filled up to a multiple of 4.
fn container(json: &[u8], binary: usize, pieces: &[Piece]) -> Result<Vec<u8>, Unwritable> {
    let padded = json.len().next_multiple_of(4);
    let start = 20 + padded + 8;
    let length = if binary > 0 {
        start + binary.next_multiple_of(4)
    } else {
        20 + padded
    };
    let word = |n: usize| u32::try_from(n).map(u32::to_le_bytes).ok();
    let (Some(all), Some(json_length), Some(binary_length)) =
        (word(length), word(padded), word(binary.next_multiple_of(4)))
    else {
        let message = format!("a GLB file holds less than 4 GB, the scene needs {length} bytes");
        return Err(Unwritable::Scene { message });
    };
    let mut out = mesh::zeroed::<u8>(length);
    out[..12].copy_from_slice(&[*b"glTF", 2_u32.to_le_bytes(), all].concat());
    out[12..20].copy_from_slice(&[json_length, *b"JSON"].concat());
    out[20..20 + json.len()].copy_from_slice(json);
    out[20 + json.len()..20 + padded].fill(b' ');
    if binary > 0 {
        out[start - 8..start].copy_from_slice(&[binary_length, *b"BIN\0"].concat());
        fill(&mut out[start..], pieces);
    }
    Ok(out)
}

/// A file name as a URI reference (RFC 3986): all but the unreserved characters are escaped.
pub(super) fn percent_encoded(name: &str) -> String {
    let encode = |byte: u8| match byte {
        b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'-' | b'.' | b'_' | b'~' => {
            char::from(byte).to_string()
        }
        _ => format!("%{byte:02X}"),
    };
    name.bytes().map(encode).collect()
}

// ---- The bytes ---------------------------------------------------------------------------------

type Fill<'a> = Box<dyn Fn(&mut [u8]) + 'a>;

/// A part of the buffer, and what writes it.
struct Piece<'a> {
    start: usize,
    length: usize,
    fill: Fill<'a>,
}

impl Piece<'_> {
    fn end(&self) -> usize {
        self.start + self.length
    }
}

fn fill(out: &mut [u8], pieces: &[Piece]) {
    for piece in pieces {
        (piece.fill)(&mut out[piece.start..piece.end()]);
    }
}

// ---- Objects -----------------------------------------------------------------------------------

/// An object of which everything is known but its place in the document.
struct Prepared<'a> {
    object: &'a Object,
    mesh: &'a Mesh,
    streams: Vec<Stream<'a>>,
    split: Split,
    bounds: Bounds,
    faces: BTreeMap<i32, Faces>,
}

impl<'a> Prepared<'a> {
    fn new(object: &'a Object, mesh: &'a Mesh, losses: &mut Losses) -> Result<Self, Unwritable> {
        let streams = streams(mesh, losses);
        let split = split(mesh, &streams);
        if split.n >= u32::MAX as usize {
            let message = format!(
                "expected fewer than {} vertices, found {}",
                u32::MAX,
                split.n
            );
            return Err(Unwritable::object(&object.name, message));
        }
        for stream in &streams {
            stream.count_broken(mesh, &split, losses);
        }
        let isolated = mesh.n_isolated_vertices();
        losses.add(
            Domain::Vertex,
            "position",
            isolated,
            "isolated vertices: glTF holds triangles",
        );
        let polygons = mesh.faces().filter(|&f| !mesh.is_triangle(f)).count();
        losses.add(
            Domain::Face,
            "polygon",
            polygons,
            "glTF holds triangles: the polygons are cut",
        );
        if isolated == 0 && mesh.n_faces() == 0 {
            losses.add(
                None,
                "mesh",
                1,
                "an empty mesh is written as a node without one",
            );
        }
        let bounds = bounds(mesh, &split).map_err(|v| {
            let message = format!(
                "the position of {v}, {}, is too large for the 32 bits of glTF",
                mesh.position(v)
            );
            Unwritable::object(&object.name, message)
        })?;
        let faces = faces_by_material(object, mesh, &split, polygons > 0, losses);
        Ok(Self {
            object,
            mesh,
            streams,
            split,
            bounds,
            faces,
        })
    }

    /// How many sets of texture coordinates there are.
    fn n_uvs(&self) -> u32 {
        let is_uv = |stream: &&Stream| matches!(stream.semantic, Semantic::TexCoords(_));
        let count = self.streams.iter().filter(is_uv).count();
        u32::try_from(count).unwrap_or(u32::MAX)
    }
}

// ---- The document ------------------------------------------------------------------------------

struct Writer<'a> {
    root: Root,
    pieces: Vec<Piece<'a>>,
    materials: MaterialWriter,
}

impl<'a> Writer<'a> {
    fn new(options: &WriteOptions) -> Self {
        let extras = options
            .provenance
            .as_ref()
            .and_then(|text| serde_json::value::to_raw_value(&json!({ "meshwright": text })).ok());
        let generator = Some(concat!("meshwright ", env!("CARGO_PKG_VERSION")).to_owned());
        let root = Root {
            asset: Asset {
                generator,
                extras,
                ..Asset::default()
            },
            scene: Some(Index::new(0)),
            scenes: vec![gltf_json::Scene {
                extensions: None,
                extras: None,
                name: None,
                nodes: Vec::new(),
            }],
            ..Root::default()
        };
        Self {
            root,
            pieces: Vec::new(),
            materials: MaterialWriter::default(),
        }
    }

    fn object(&mut self, prepared: &'a Prepared<'a>, losses: &mut Losses) {
        let primitives = self.primitives(prepared, losses);
        let name = Some(prepared.object.name.clone());
        let index = (!primitives.is_empty()).then(|| {
            self.root.push(gltf_json::Mesh {
                extensions: None,
                extras: None,
                name: name.clone(),
                primitives,
                weights: None,
            })
        });
        let node = self.root.push(Node {
            mesh: index,
            name,
            ..Node::default()
        });
        self.root.scenes[0].nodes.push(node);
    }

    /// One primitive for each material, in the order of the object's materials; they share their
    /// vertices.
    fn primitives(&mut self, prepared: &'a Prepared<'a>, losses: &mut Losses) -> Vec<Primitive> {
        if prepared.faces.is_empty() {
            return Vec::new();
        }
        let attributes = self.attributes(prepared);
        let mut primitives = Vec::new();
        for (&material, faces) in &prepared.faces {
            let material = usize::try_from(material).ok();
            let material = material.and_then(|m| prepared.object.materials.get(m));
            let material = material.map(|material| {
                let place = self.materials.place(material, prepared.n_uvs(), losses);
                Index::new(u32::try_from(place).unwrap_or(u32::MAX))
            });
            let indices = self.indices(prepared, faces);
            primitives.push(Primitive {
                attributes: attributes.clone(),
                extensions: None,
                extras: None,
                indices: Some(indices),
                material,
                mode: Checked::Valid(Mode::Triangles),
                targets: None,
            });
        }
        // Pictures lie behind what the first object needs of them.
        for (place, bytes) in self.materials.take_pictures() {
            let fill_bytes = bytes.clone();
            let view = self.view(bytes.len(), None, move |out| {
                out.copy_from_slice(&fill_bytes);
            });
            self.materials.set_view(place, view.value());
        }
        primitives
    }

    fn attributes(
        &mut self,
        prepared: &'a Prepared<'a>,
    ) -> BTreeMap<Checked<Semantic>, Index<Accessor>> {
        let Prepared { mesh, split, .. } = prepared;
        let mut attributes = BTreeMap::new();
        let positions = self.floats(split.n, Type::Vec3, move |out| {
            fill_positions(out, mesh, split);
        });
        let with_bounds = &mut self.root.accessors[positions.value()];
        let Bounds { min, max } = prepared.bounds;
        (with_bounds.min, with_bounds.max) = (Some(json!(min)), Some(json!(max)));
        attributes.insert(Checked::Valid(Semantic::Positions), positions);
        for stream in &prepared.streams {
            let accessor = self.floats(split.n, stream.kind, move |out| {
                fill_stream(out, mesh, split, stream);
            });
            attributes.insert(Checked::Valid(stream.semantic.clone()), accessor);
        }
        attributes
    }

    fn floats(
        &mut self,
        count: usize,
        kind: Type,
        fill: impl Fn(&mut [u8]) + 'a,
    ) -> Index<Accessor> {
        let length = count * kind.multiplicity() * size_of::<f32>();
        let view = self.view(length, Some(Target::ArrayBuffer), fill);
        self.accessor(view, count, ComponentType::F32, kind)
    }

    fn indices(&mut self, prepared: &'a Prepared<'a>, faces: &'a Faces) -> Index<Accessor> {
        let Prepared { mesh, split, .. } = prepared;
        // The highest number of each size is kept free: it restarts primitives on graphics cards.
        let short = u16::try_from(split.n).is_ok();
        let component = if short {
            ComponentType::U16
        } else {
            ComponentType::U32
        };
        let count = 3 * faces.n_triangles();
        let length = count * component.size();
        let view = self.view(length, Some(Target::ElementArrayBuffer), move |out| {
            fill_indices(out, mesh, split, faces, short);
        });
        self.accessor(view, count, component, Type::Scalar)
    }

    /// A view of bytes behind all others, from a multiple of 4.
    fn view(
        &mut self,
        length: usize,
        target: Option<Target>,
        fill: impl Fn(&mut [u8]) + 'a,
    ) -> Index<View> {
        let start = self.pieces.last().map_or(0, Piece::end).next_multiple_of(4);
        self.pieces.push(Piece {
            start,
            length,
            fill: Box::new(fill),
        });
        self.root.push(View {
            buffer: Index::new(0),
            byte_length: length.into(),
            byte_offset: Some(start.into()),
            byte_stride: None,
            name: None,
            target: target.map(Checked::Valid),
            extensions: None,
            extras: None,
        })
    }

    fn accessor(
        &mut self,
        view: Index<View>,
        count: usize,
        component: ComponentType,
        kind: Type,
    ) -> Index<Accessor> {
        self.root.push(Accessor {
            buffer_view: Some(view),
            byte_offset: None,
            count: count.into(),
            component_type: Checked::Valid(GenericComponentType(component)),
            extensions: None,
            extras: None,
            type_: Checked::Valid(kind),
            min: None,
            max: None,
            name: None,
            normalized: false,
            sparse: None,
        })
    }
}
