//! Builds the document of a glTF file: nodes, meshes, accessors and views.

use std::collections::BTreeMap;

use gltf_json::accessor::{ComponentType, Type};
use gltf_json::buffer::{ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER};
use gltf_json::mesh::Semantic;
use scene::Graph;
use serde_json::{Map, Value, json};

use super::compress::{Array, compress};
use super::extras::optional_json;
use super::faces::Faces;
use super::fill::{
    Bounds, bounds_of, fill_floats, fill_indices, fill_joints, fill_positions, fill_stream,
};
use super::meshopt::{Filter, MESHOPT};
use super::node_json::LIGHTS;
use super::numbers::type_name;
use super::pieces::Piece;
use super::prepare::PreparedObject;
use super::quantize::{Integers, QUANTIZATION, Quantizer};
use super::write_materials::MaterialWriter;
use crate::error::Unwritable;
use crate::loss::Losses;
use crate::{Compression, WriteOptions};

/// Builds the document, and collects the functions that write the parts of its buffer.
#[derive(Default)]
pub(super) struct Writer<'a> {
    pub(super) accessors: Vec<Value>,
    views: Vec<Value>,
    meshes: Vec<Value>,
    /// For each written object that has faces, the index of its mesh in `meshes`. The key is the name of the object.
    pub(super) mesh_of: BTreeMap<&'a str, usize>,
    pub(super) nodes: NodeList,
    /// For each written object that has faces, whether its joints are written, and how many of its morph targets. The
    /// key is the name of the object.
    pub(super) deformed: BTreeMap<&'a str, Deformed>,
    /// For each array that was written, the index of its accessor. The key consists of the index of the array, the
    /// number of components of each element, and the total number of components.
    pub(super) number_accessors: BTreeMap<(usize, usize, usize), usize>,
    pub(super) pieces: Vec<Piece<'a>>,
    materials: MaterialWriter,
    pub(super) quantizer: Quantizer<'a>,
    /// For each array that can be compressed, how its elements are encoded. The key is the index of the view of the
    /// array.
    arrays: BTreeMap<usize, Array>,
    compression: Option<Compression>,
}

/// Whether the joints of an object are written, and how many of its morph targets are written.
pub(super) struct Deformed {
    pub(super) has_joints: bool,
    pub(super) n_targets: usize,
}

/// The nodes of a document.
#[derive(Default)]
pub(super) struct NodeList {
    pub(super) nodes: Vec<Value>,
    /// The nodes without a parent.
    pub(super) roots: Vec<usize>,
    pub(super) cameras: Vec<Value>,
    pub(super) lights: Vec<Value>,
    pub(super) skins: Vec<Value>,
    pub(super) animations: Vec<Value>,
    /// The parts of the document that come from [`Graph::document`](scene::Graph::document). Each entry consists of the
    /// name of a part and its members.
    pub(super) kept: Vec<(String, Map<String, Value>)>,
}

impl<'a> Writer<'a> {
    /// Creates a document without content.
    pub(super) fn new(options: &WriteOptions) -> Self {
        Self {
            quantizer: Quantizer::new(options.quantization, options.compression.is_some()),
            compression: options.compression,
            ..Self::default()
        }
    }

    /// Returns the document and the parts of its buffer. The buffer is stored in the file `uri`. If `uri` is `None`,
    /// the buffer is stored in the GLB chunk after the JSON.
    pub(super) fn into_json(
        self,
        options: &WriteOptions,
        uri: Option<&str>,
    ) -> (Vec<u8>, Vec<Piece<'a>>) {
        let mut pieces = self.pieces;
        let mut views = self.views;
        let length = pieces.last().map_or(0, Piece::end);
        let mut buffers = vec![json!({ "byteLength": length, "uri": uri })];
        let mut required = Vec::new();
        if self.quantizer.uses_extension {
            required.push(QUANTIZATION);
        }
        if self.compression == Some(Compression::Meshopt) && !self.arrays.is_empty() {
            required.push(MESHOPT[0]);
            pieces = compress(&mut views, &mut buffers, &pieces, &self.arrays);
        }
        let NodeList {
            kept,
            nodes,
            roots,
            cameras,
            lights,
            skins,
            animations,
        } = self.nodes;
        // If there are no nodes, no scene is written.
        let has_nodes = !nodes.is_empty();
        let mut extensions = self.materials.extensions();
        extensions.extend(&required);
        let lights = (!lights.is_empty()).then(|| {
            extensions.push(LIGHTS);
            json!({ LIGHTS: { "lights": lights } })
        });
        let mut document = json!({
            "accessors": self.accessors,
            "asset": {
                "extras": options.provenance.as_ref().map(|text| json!({ "meshwright": text })),
                "generator": concat!("meshwright ", env!("CARGO_PKG_VERSION")),
                "version": "2.0",
            },
            "buffers": (length > 0).then_some(buffers),
            "bufferViews": views,
            "scene": has_nodes.then_some(0),
            "meshes": self.meshes,
            "nodes": nodes,
            "scenes": has_nodes.then(|| json!([{ "nodes": roots }])),
            "extensionsUsed": extensions,
            "extensionsRequired": required,
            "extensions": lights,
            "cameras": cameras,
            "skins": skins,
            "animations": animations,
            "materials": self.materials.materials,
            "textures": self.materials.textures,
            "samplers": self.materials.samplers,
            "images": self.materials.images,
        });
        for (name, members) in kept {
            let part = match name.as_str() {
                "asset" => &mut document["asset"],
                "scene" if has_nodes => &mut document["scenes"][0],
                "root" => &mut document,
                _ => continue,
            };
            for (key, value) in members {
                match (&mut part[&key], value) {
                    // The `asset` can already have extras with the provenance. The extras from the graph are then added
                    // to them.
                    (Value::Object(extras), Value::Object(more)) => extras.extend(more),
                    (place, value) => *place = value,
                }
            }
        }
        remove_empty(&mut document);
        (document.to_string().into_bytes(), pieces)
    }

    /// Adds the mesh of an object, if the mesh has faces.
    ///
    /// # Errors
    ///
    /// Returns an error if the extras of the mesh or of a material are not JSON.
    pub(super) fn object(
        &mut self,
        prepared: &'a PreparedObject<'a>,
        graph: &Graph,
        losses: &mut Losses,
    ) -> Result<(), Unwritable> {
        if prepared.faces.is_empty() {
            return Ok(());
        }
        let primitives = self.primitives(prepared, losses)?;
        let name = &prepared.object.name;
        let mut mesh = json!({ "name": name, "primitives": primitives });
        let n_targets = prepared.deformation.morphs.len();
        let mut weights = vec![0.0; n_targets];
        if let Some(label) = graph.label(name) {
            mesh["name"] = json!(label.name);
            mesh["extras"] = optional_json(label.extras.as_deref())?;
            let known = weights.iter_mut().zip(&label.weights);
            known.for_each(|(weight, known)| *weight = *known);
        }
        if weights.iter().any(|&weight| weight != 0.0) {
            mesh["weights"] = json!(weights);
        }
        let deformed = Deformed {
            has_joints: prepared.deformation.sets > 0,
            n_targets,
        };
        self.deformed.insert(name, deformed);
        let mesh = push(&mut self.meshes, mesh);
        self.mesh_of.insert(name, mesh);
        Ok(())
    }

    /// Creates a primitive for each material, in the order of the materials of the object. The primitives share
    /// their vertices.
    fn primitives(
        &mut self,
        prepared: &'a PreparedObject<'a>,
        losses: &mut Losses,
    ) -> Result<Vec<Value>, Unwritable> {
        let attributes = self.attributes(prepared, losses);
        let targets = self.targets(prepared);
        let mut primitives = Vec::new();
        for (&material, faces) in &prepared.faces {
            let material = usize::try_from(material).ok();
            let material = material.and_then(|m| prepared.object.materials.get(m));
            let material = material
                .map(|material| self.materials.index_of(material, prepared.n_uvs(), losses))
                .transpose()?;
            let indices = self.indices(prepared, faces);
            primitives.push(json!({
                "attributes": attributes,
                "indices": indices,
                "material": material,
                "targets": targets,
            }));
        }
        // In the buffer, the bytes of an image come after the data of the first object that uses the image.
        for (place, bytes) in std::mem::take(&mut self.materials.image_bytes) {
            let length = bytes.len();
            let view = self.view(length, None, move |out| out.copy_from_slice(&bytes));
            self.materials.images[place].buffer_view = Some(view);
        }
        Ok(primitives)
    }

    fn attributes(
        &mut self,
        prepared: &'a PreparedObject<'a>,
        losses: &mut Losses,
    ) -> Map<String, Value> {
        let PreparedObject { mesh, split, .. } = prepared;
        let mut attributes = BTreeMap::new();
        let quantized = self.quantizer.positions(prepared, losses);
        let (positions, min, max) = if let Some((integers, [min, max])) = quantized {
            (self.integers(integers), json!(min), json!(max))
        } else {
            let fill = move |out: &mut [u8]| fill_positions(out, mesh, split);
            let Bounds { min, max } = prepared.bounds;
            let positions = self.floats(split.n, Type::Vec3, fill);
            (positions, json!(min), json!(max))
        };
        self.accessors[positions]["min"] = min;
        self.accessors[positions]["max"] = max;
        attributes.insert(Semantic::Positions, positions);
        let streams = prepared.streams.iter();
        for stream in streams.filter(|stream| stream.target.is_none()) {
            let quantized = self.quantizer.stream(prepared, stream);
            let accessor = if let Some(integers) = quantized {
                self.integers(integers)
            } else {
                let fill = move |out: &mut [u8]| fill_stream(out, mesh, split, stream);
                self.floats(split.n, stream.kind, fill)
            };
            attributes.insert(stream.semantic.clone(), accessor);
        }
        self.joints(prepared, &mut attributes);
        let named = attributes.into_iter();
        named
            .map(|(semantic, at)| (semantic.to_string(), at.into()))
            .collect()
    }

    /// Adds the sets of joints and weights.
    fn joints(
        &mut self,
        prepared: &'a PreparedObject<'a>,
        attributes: &mut BTreeMap<Semantic, usize>,
    ) {
        let PreparedObject {
            mesh,
            split,
            deformation,
            ..
        } = prepared;
        let component = if deformation.is_short() {
            ComponentType::U8
        } else {
            ComponentType::U16
        };
        for (set, number) in (0..deformation.sets).zip(0..) {
            let fill = move |out: &mut [u8]| {
                fill_joints(out, component.size(), |i| {
                    deformation.joints(split.vertex(mesh, i).index(), set)
                });
            };
            let length = split.n * 4 * component.size();
            let view = self.view(length, Some(ARRAY_BUFFER), fill);
            let joints = self.accessor(view, split.n, component, Type::Vec4);
            attributes.insert(Semantic::Joints(number), joints);
            let fill = move |out: &mut [u8]| {
                fill_floats(out, |i| {
                    deformation.weights(split.vertex(mesh, i).index(), set)
                });
            };
            let weights = self.floats(split.n, Type::Vec4, fill);
            attributes.insert(Semantic::Weights(number), weights);
        }
    }

    /// Adds the morph targets, each with its attributes.
    fn targets(&mut self, prepared: &'a PreparedObject<'a>) -> Vec<Value> {
        let PreparedObject {
            mesh,
            split,
            deformation,
            ..
        } = prepared;
        let mut targets = Vec::new();
        for target in 0..deformation.morphs.len() {
            let delta = move |i| deformation.delta(target, split.vertex(mesh, i).index());
            let fill = move |out: &mut [u8]| fill_floats(out, delta);
            let accessor = self.floats(split.n, Type::Vec3, fill);
            let Bounds { min, max } = bounds_of(split.n, delta);
            self.accessors[accessor]["min"] = json!(min);
            self.accessors[accessor]["max"] = json!(max);
            let mut attributes = json!({ "POSITION": accessor });
            let streams = prepared.streams.iter();
            for stream in streams.filter(|stream| stream.target == Some(target)) {
                let fill = move |out: &mut [u8]| fill_stream(out, mesh, split, stream);
                attributes[stream.semantic.to_string()] =
                    self.floats(split.n, stream.kind, fill).into();
            }
            targets.push(attributes);
        }
        targets
    }

    fn floats(&mut self, count: usize, kind: Type, fill: impl Fn(&mut [u8]) + 'a) -> usize {
        let stride = kind.multiplicity() * size_of::<f32>();
        let view = self.view(count * stride, Some(ARRAY_BUFFER), fill);
        self.arrays
            .insert(view, Array::attribute(stride, Filter::None));
        self.accessor(view, count, ComponentType::F32, kind)
    }

    /// Adds an attribute of normalized integers.
    fn integers(&mut self, integers: Integers) -> usize {
        let Integers {
            bytes,
            stride,
            component,
            kind,
            filter,
        } = integers;
        let count = bytes.len() / stride;
        let fill = move |out: &mut [u8]| out.copy_from_slice(&bytes);
        let view = self.view(count * stride, Some(ARRAY_BUFFER), fill);
        self.views[view]["byteStride"] = json!(stride);
        self.arrays.insert(view, Array::attribute(stride, filter));
        let accessor = self.accessor(view, count, component, kind);
        self.accessors[accessor]["normalized"] = json!(true);
        accessor
    }

    fn indices(&mut self, prepared: &'a PreparedObject<'a>, faces: &'a Faces) -> usize {
        let PreparedObject { mesh, split, .. } = prepared;
        // The largest value of each integer type is not used as an index, because graphics cards interpret it as the
        // start of a new primitive.
        let short = u16::try_from(split.n).is_ok();
        let component = if short {
            ComponentType::U16
        } else {
            ComponentType::U32
        };
        let count = 3 * faces.n_triangles;
        let length = count * component.size();
        let fill = move |out: &mut [u8]| fill_indices(out, mesh, split, faces, short);
        let view = self.view(length, Some(ELEMENT_ARRAY_BUFFER), fill);
        self.arrays.insert(view, Array::triangles(component.size()));
        self.accessor(view, count, component, Type::Scalar)
    }

    /// Adds a view after all other views. The view begins at a multiple of 4 bytes.
    pub(super) fn view(
        &mut self,
        length: usize,
        target: Option<u32>,
        fill: impl Fn(&mut [u8]) + 'a,
    ) -> usize {
        let start = self.pieces.last().map_or(0, Piece::end).next_multiple_of(4);
        self.pieces.push(Piece {
            start,
            length,
            fill: Box::new(fill),
        });
        let view = json!({
            "buffer": 0,
            "byteLength": length,
            "byteOffset": start,
            "target": target,
        });
        push(&mut self.views, view)
    }

    pub(super) fn accessor(
        &mut self,
        view: usize,
        count: usize,
        component: ComponentType,
        kind: Type,
    ) -> usize {
        let accessor = json!({
            "bufferView": view,
            "count": count,
            "componentType": component.as_gl_enum(),
            "type": type_name(kind),
        });
        push(&mut self.accessors, accessor)
    }
}

/// Appends a value to a list and returns its index.
fn push(list: &mut Vec<Value>, value: Value) -> usize {
    list.push(value);
    list.len() - 1
}

/// Removes members that are null or empty lists. The content of `extras` is data of other programs and is not changed.
fn remove_empty(json: &mut Value) {
    match json {
        Value::Object(members) => {
            let is_extras = |key: &str| key == "extras";
            members
                .retain(|key, value| !value.is_null() && (is_extras(key) || *value != json!([])));
            let members = members.iter_mut().filter(|(key, _)| !is_extras(key));
            members.for_each(|(_, value)| remove_empty(value));
        }
        Value::Array(values) => values.iter_mut().for_each(remove_empty),
        _ => {}
    }
}
