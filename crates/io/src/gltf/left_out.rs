//! Counts supported content of a document that the reader leaves out. A part of the document is left out, for example,
//! if the glTF scene does not use it, or if a scene of this program cannot store it.

use std::collections::BTreeMap;

use gltf_json::mesh::Mode;
use gltf_json::validation::Checked;
use serde_json::Value;

use super::document::Document;
use super::morph_json::is_changeable;
use super::surface::MaterialJson;
use crate::note::Notes;

/// Adds notes for the content of a document that is left out. Content that can be counted only by reading the buffers
/// is not included.
pub(super) fn note_left_out(json: &Value, document: &Document, notes: &mut Notes) {
    let used = Used::of(document);
    for (code, flags, what) in [
        (
            "nodes-unused",
            &used.nodes,
            "nodes left out: not in the scene",
        ),
        (
            "meshes-unused",
            &used.meshes,
            "meshes left out: not used by any node of the scene",
        ),
        (
            "materials-unused",
            &used.materials,
            "materials left out: not used by any triangles of the scene",
        ),
        (
            "textures-unused",
            &used.textures,
            "textures left out: not used by any part of a material that is read",
        ),
        (
            "samplers-unused",
            &used.samplers,
            "samplers left out: not used by any texture that is read",
        ),
        (
            "images-unused",
            &used.images,
            "images left out: not used by any texture that is read",
        ),
    ] {
        let unused = flags.iter().filter(|is_used| !**is_used).count();
        notes.left_out(code, unused, None, what);
    }
    let what = "textures without a supported image left out";
    notes.left_out("textures", used.without_image, None, what);
    for (name, count) in morph_attributes(json, &used.meshes) {
        let what = format!("attributes {name} of morph targets left out");
        notes.left_out("morphs", count, None, what);
    }
    notes.left_out("extras", extras(json), None, "members `extras` left out");
}

/// For each part of a document, a flag that is true if the nodes of the scene use the part. Invalid indices are ignored
/// here, because the reader refuses them later.
struct Used {
    nodes: Vec<bool>,
    meshes: Vec<bool>,
    materials: Vec<bool>,
    textures: Vec<bool>,
    samplers: Vec<bool>,
    images: Vec<bool>,
    /// The number of references from materials to textures without a supported image. Either the texture has no image,
    /// or its image has neither a URI nor a buffer view.
    without_image: usize,
}

impl Used {
    fn of(document: &Document) -> Self {
        let mut used = Self {
            nodes: vec![false; document.nodes.len()],
            meshes: vec![false; document.meshes.len()],
            materials: vec![false; document.materials.len()],
            textures: vec![false; document.textures.len()],
            samplers: vec![false; document.samplers.len()],
            images: vec![false; document.images.len()],
            without_image: 0,
        };
        let mut open = document.roots.clone();
        while let Some(i) = open.pop() {
            if !mark(&mut used.nodes, i) {
                continue;
            }
            let node = &document.nodes[i];
            open.extend(&node.children);
            if let Some(mesh) = node.mesh {
                used.mesh(document, mesh);
            }
        }
        used
    }

    fn mesh(&mut self, document: &Document, mesh: usize) {
        if !mark(&mut self.meshes, mesh) {
            return;
        }
        for primitive in &document.meshes[mesh].primitives {
            let is_read = matches!(
                primitive.mode,
                Checked::Valid(Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan)
            );
            let material = primitive.material.map(|material| material.value());
            if let Some(material) = material.filter(|_| is_read)
                && mark(&mut self.materials, material)
            {
                self.material(document, &document.materials[material]);
            }
        }
    }

    fn material(&mut self, document: &Document, material: &MaterialJson) {
        for info in material.textures() {
            let Some(texture) = document.textures.get(info.index) else {
                continue;
            };
            let image = texture.source.and_then(|image| document.images.get(image));
            let is_read = image.is_some_and(|i| i.uri.is_some() || i.buffer_view.is_some());
            self.without_image += usize::from(!is_read);
            if !mark(&mut self.textures, info.index) {
                continue;
            }
            // The sampler of a texture without an image is not read.
            let Some(image) = texture.source else {
                continue;
            };
            mark(&mut self.images, image);
            if let Some(sampler) = texture.sampler {
                mark(&mut self.samplers, sampler);
            }
        }
    }
}

/// Sets the flag with index `i`. Returns true if the flag exists and was not set before.
fn mark(flags: &mut [bool], i: usize) -> bool {
    flags
        .get_mut(i)
        .is_some_and(|flag| !std::mem::replace(flag, true))
}

/// Counts the morph target attributes that the reader leaves out. The keys are the names of the attributes. Meshes for
/// which `is_used` is false are skipped.
fn morph_attributes(json: &Value, is_used: &[bool]) -> BTreeMap<String, usize> {
    let mut counts = BTreeMap::new();
    let meshes = elements(json, "meshes").zip(is_used);
    let meshes = meshes.filter_map(|(mesh, is_used)| is_used.then_some(mesh));
    for primitive in meshes.flat_map(|mesh| elements(mesh, "primitives")) {
        let has = |name: &str| primitive["attributes"].get(name).is_some();
        let targets = elements(primitive, "targets").filter_map(Value::as_object);
        for name in targets.flat_map(|target| target.keys()) {
            let is_read = match name.as_str() {
                "POSITION" => true,
                "NORMAL" | "TANGENT" => has(name),
                _ => is_changeable(primitive, name),
            };
            if !is_read {
                *counts.entry(name.clone()).or_default() += 1;
            }
        }
    }
    counts
}

fn elements<'a>(json: &'a Value, key: &str) -> impl Iterator<Item = &'a Value> + use<'a> {
    let list = json.get(key).and_then(Value::as_array);
    list.into_iter().flatten()
}

/// Counts the `extras` members that are left out, such as those of primitives and accessors.
fn extras(json: &Value) -> usize {
    let members = json.as_object().into_iter().flatten();
    let of_member = |(key, value): (&String, &Value)| match key.as_str() {
        "asset" | "scenes" | "nodes" | "cameras" | "skins" | "animations" | "extensions"
        | "extras" => 0,
        "meshes" => elements(json, key)
            .filter_map(|mesh| mesh.get("primitives"))
            .map(count_extras)
            .sum(),
        "materials" => {
            let own = |material: &Value| usize::from(has_extras(material));
            let materials = elements(json, key);
            materials.map(|m| count_extras(m) - own(m)).sum()
        }
        _ => count_extras(value),
    };
    members.map(of_member).sum()
}

fn has_extras(json: &Value) -> bool {
    json.get("extras").is_some_and(|extras| !extras.is_null())
}

/// Counts the `extras` members in a part of the JSON. The recursion is not too deep, because the JSON parser limits the
/// nesting.
fn count_extras(json: &Value) -> usize {
    match json {
        Value::Array(values) => values.iter().map(count_extras).sum(),
        Value::Object(members) => {
            let parts = members.iter().filter(|(key, _)| *key != "extras");
            usize::from(has_extras(json)) + parts.map(|(_, part)| count_extras(part)).sum::<usize>()
        }
        _ => 0,
    }
}
