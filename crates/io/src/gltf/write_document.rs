//! The document of a glTF file: nodes, meshes, accessors and views.

use std::collections::BTreeMap;

use gltf_json::accessor::{ComponentType, GenericComponentType, Type};
use gltf_json::buffer::{Target, View};
use gltf_json::mesh::{Mode, Primitive, Semantic};
use gltf_json::validation::Checked;
use gltf_json::{Accessor, Index, Mesh, Node};
use serde::Serialize;
use serde_json::{Map, Value, json};

use super::faces::Faces;
use super::fill::{Bounds, fill_indices, fill_positions, fill_stream};
use super::pieces::Piece;
use super::prepare::Prepared;
use super::write_materials::MaterialWriter;
use crate::WriteOptions;
use crate::error::Unwritable;
use crate::loss::Losses;

/// Makes the document, and knows what writes the bytes that it refers to.
#[derive(Default)]
pub(super) struct Writer<'a> {
    accessors: Vec<Accessor>,
    views: Vec<View>,
    meshes: Vec<Mesh>,
    nodes: Vec<Node>,
    pub(super) pieces: Vec<Piece<'a>>,
    materials: MaterialWriter,
}

impl<'a> Writer<'a> {
    /// The document, whose bytes are in the file of this name or behind it, and what writes these.
    ///
    /// # Errors
    ///
    /// If something of it cannot be written as JSON.
    pub(super) fn into_json(
        self,
        options: &WriteOptions,
        uri: Option<String>,
    ) -> Result<(Vec<u8>, Vec<Piece<'a>>), Unwritable> {
        let mut asset = json!({});
        if let Some(text) = &options.provenance {
            asset["extras"] = json!({ "meshwright": text });
        }
        asset["generator"] = concat!("meshwright ", env!("CARGO_PKG_VERSION")).into();
        asset["version"] = "2.0".into();
        let length = self.pieces.last().map_or(0, Piece::end);
        let mut buffer = json!({ "byteLength": length });
        if let Some(uri) = uri {
            buffer["uri"] = uri.into();
        }
        let n_nodes = self.nodes.len();
        let mut document = Map::new();
        insert(&mut document, "accessors", &self.accessors)?;
        document.insert("asset".to_owned(), asset);
        if length > 0 {
            insert(&mut document, "buffers", &[buffer])?;
        }
        insert(&mut document, "bufferViews", &self.views)?;
        // A scene without nodes says nothing.
        if n_nodes > 0 {
            document.insert("scene".to_owned(), 0.into());
        }
        insert(&mut document, "meshes", &self.meshes)?;
        insert(&mut document, "nodes", &self.nodes)?;
        if n_nodes > 0 {
            let nodes: Vec<usize> = (0..n_nodes).collect();
            document.insert("scenes".to_owned(), json!([{ "nodes": nodes }]));
        }
        self.materials.insert_into(&mut document);
        let json = serde_json::to_vec(&document).map_err(|error| no_json(&error))?;
        Ok((json, self.pieces))
    }

    /// Adds a node with the mesh of an object, if it has faces.
    pub(super) fn object(&mut self, prepared: &'a Prepared<'a>, losses: &mut Losses) {
        let primitives = self.primitives(prepared, losses);
        if primitives.is_empty() {
            return;
        }
        let name = Some(prepared.object.name.clone());
        let mesh = Mesh {
            extensions: None,
            extras: None,
            name: name.clone(),
            primitives,
            weights: None,
        };
        self.nodes.push(Node {
            mesh: Some(Index::push(&mut self.meshes, mesh)),
            name,
            ..Node::default()
        });
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
            let length = bytes.len();
            let view = self.view(length, None, move |out| out.copy_from_slice(&bytes));
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
        let fill = move |out: &mut [u8]| fill_positions(out, mesh, split);
        let positions = self.floats(split.n, Type::Vec3, fill);
        let with_bounds = &mut self.accessors[positions.value()];
        let Bounds { min, max } = prepared.bounds;
        (with_bounds.min, with_bounds.max) = (Some(json!(min)), Some(json!(max)));
        attributes.insert(Checked::Valid(Semantic::Positions), positions);
        for stream in &prepared.streams {
            let fill = move |out: &mut [u8]| fill_stream(out, mesh, split, stream);
            let accessor = self.floats(split.n, stream.kind, fill);
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
        let fill = move |out: &mut [u8]| fill_indices(out, mesh, split, faces, short);
        let view = self.view(length, Some(Target::ElementArrayBuffer), fill);
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
        let view = View {
            buffer: Index::new(0),
            byte_length: length.into(),
            byte_offset: Some(start.into()),
            byte_stride: None,
            name: None,
            target: target.map(Checked::Valid),
            extensions: None,
            extras: None,
        };
        Index::push(&mut self.views, view)
    }

    fn accessor(
        &mut self,
        view: Index<View>,
        count: usize,
        component: ComponentType,
        kind: Type,
    ) -> Index<Accessor> {
        let accessor = Accessor {
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
        };
        Index::push(&mut self.accessors, accessor)
    }
}

/// Adds a list to a document, if it has something in it.
fn insert<T: Serialize>(
    document: &mut Map<String, Value>,
    key: &str,
    list: &[T],
) -> Result<(), Unwritable> {
    let values = list
        .iter()
        .map(|one| serde_json::to_value(one).map_err(|error| no_json(&error)));
    let values = values.collect::<Result<Vec<_>, _>>()?;
    if !values.is_empty() {
        document.insert(key.to_owned(), values.into());
    }
    Ok(())
}

fn no_json(error: &serde_json::Error) -> Unwritable {
    Unwritable::Scene {
        message: error.to_string(),
    }
}
