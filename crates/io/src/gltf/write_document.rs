//! The document of a glTF file: nodes, meshes, accessors and views.

use std::collections::BTreeMap;

use gltf_json::accessor::{ComponentType, GenericComponentType, Type};
use gltf_json::buffer::{Target, View};
use gltf_json::mesh::{Mode, Primitive, Semantic};
use gltf_json::validation::Checked;
use gltf_json::{Accessor, Asset, Index, Node, Root};
use serde_json::json;

use super::faces::Faces;
use super::fill::{Bounds, fill_indices, fill_positions, fill_stream};
use super::pieces::Piece;
use super::prepare::Prepared;
use super::write_materials::MaterialWriter;
use crate::WriteOptions;
use crate::loss::Losses;

/// Makes the document, and knows what writes the bytes that it refers to.
pub(super) struct Writer<'a> {
    pub(super) root: Root,
    pub(super) pieces: Vec<Piece<'a>>,
    pub(super) materials: MaterialWriter,
}

impl<'a> Writer<'a> {
    pub(super) fn new(options: &WriteOptions) -> Self {
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

    /// Adds a node with the mesh of an object, if it has faces.
    pub(super) fn object(&mut self, prepared: &'a Prepared<'a>, losses: &mut Losses) {
        let primitives = self.primitives(prepared, losses);
        if primitives.is_empty() {
            return;
        }
        let name = Some(prepared.object.name.clone());
        let mesh = self.root.push(gltf_json::Mesh {
            extensions: None,
            extras: None,
            name: name.clone(),
            primitives,
            weights: None,
        });
        let node = self.root.push(Node {
            mesh: Some(mesh),
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
