//! The JSON of a glTF file.

use std::cell::OnceCell;
use std::collections::BTreeMap;

use gltf_json::{Accessor, Buffer, Mesh, buffer::View};
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};

use super::budget::Budget;
use super::draco_json::{self, DRACO};
use super::meshopt::{self, Compressed, MESHOPT};
use super::morph_json::{ValueChange, value_changes};
use super::node_json::{LIGHTS, NodeJson};
use super::reference::{get, index};
use super::rig_json::{AnimationJson, SkinJson};
use super::surface::{
    ImageJson, MaterialJson, STRENGTH, SamplerJson, TRANSFORM, TextureJson, UNLIT,
};
use crate::fault::Fault;
use crate::note::Notes;

/// The extensions that the reader supports. `KHR_mesh_quantization` allows integers for positions, normals, tangents
/// and texture coordinates.
const KNOWN_EXTENSIONS: [&str; 8] = [
    DRACO,
    "KHR_mesh_quantization",
    TRANSFORM,
    STRENGTH,
    UNLIT,
    LIGHTS,
    MESHOPT[0],
    MESHOPT[1],
];

/// A part of the document that is stored unchanged.
pub(super) type Json = Map<String, Value>;

/// The parts of a glTF document that the reader needs.
#[derive(Debug, Default)]
pub(super) struct Document {
    pub(super) accessors: Vec<Accessor>,
    pub(super) buffers: Vec<Buffer>,
    /// For each buffer, a flag that is true if the buffer is never read.
    pub(super) fallbacks: Vec<bool>,
    pub(super) views: Vec<View>,
    /// For each view, a description of its compression. `None` if the view is not compressed.
    pub(super) compressed: Vec<Option<Compressed>>,
    /// The primitives that are compressed by Draco and not decoded yet.
    pub(super) draco: Vec<draco_json::Compressed>,
    pub(super) materials: Vec<MaterialJson>,
    pub(super) meshes: Vec<Mesh>,
    /// The default weights of the morph targets of each mesh.
    pub(super) mesh_weights: Vec<Vec<f64>>,
    /// For each primitive of each mesh, the changes that its morph targets make to texture coordinates and colors.
    pub(super) value_changes: Vec<Vec<Vec<ValueChange>>>,
    pub(super) nodes: Vec<NodeJson>,
    pub(super) skins: Vec<SkinJson>,
    pub(super) animations: Vec<AnimationJson>,
    pub(super) cameras: Vec<Json>,
    pub(super) lights: Vec<Json>,
    /// The JSON texts that [`Graph::document`](scene::Graph::document) stores unchanged. The keys are the names of
    /// parts of the document.
    pub(super) kept: BTreeMap<String, String>,
    /// The root nodes of the scene.
    pub(super) roots: Vec<usize>,
    pub(super) textures: Vec<TextureJson>,
    pub(super) samplers: Vec<SamplerJson>,
    pub(super) images: Vec<ImageJson>,
}

impl Document {
    /// Deserializes the parts of the document. Adds notes for the content that the reader ignores.
    ///
    /// # Errors
    ///
    /// Returns an error for an invalid part of the document.
    pub(super) fn new(json: &Value, budget: &Budget, notes: &mut Notes) -> Result<Self, Fault> {
        check_version(json)?;
        check_extensions(json, notes)?;
        let views: Vec<View> = pieces(json, "bufferViews", budget)?;
        // For each buffer view, the reader stores more than the parsed view. The memory for this additional data is
        // subtracted from the budget here.
        let more = views.len() * size_of::<(Option<Compressed>, OnceCell<Vec<u8>>)>();
        budget.spend(more as u64, "/bufferViews")?;
        let compressed = meshopt::compressed(list(json, "bufferViews")?)?;
        let document = Self {
            fallbacks: meshopt::fallbacks(list(json, "buffers")?, &views, &compressed),
            compressed,
            draco: draco_json::compressed(list(json, "meshes")?, list(json, "accessors")?)?,
            accessors: pieces(json, "accessors", budget)?,
            buffers: pieces(json, "buffers", budget)?,
            views,
            materials: pieces(json, "materials", budget)?,
            meshes: pieces(json, "meshes", budget)?,
            mesh_weights: mesh_weights(json, budget)?,
            value_changes: value_changes(list(json, "meshes")?, budget)?,
            nodes: pieces(json, "nodes", budget)?,
            skins: pieces(json, "skins", budget)?,
            animations: pieces(json, "animations", budget)?,
            cameras: pieces(json, "cameras", budget)?,
            lights: lights(json)?,
            kept: kept(json),
            roots: roots(json, notes)?,
            textures: pieces(json, "textures", budget)?,
            samplers: pieces(json, "samplers", budget)?,
            images: pieces(json, "images", budget)?,
        };
        check_rig(&document)?;
        Ok(document)
    }
}

fn check_version(json: &Value) -> Result<(), Fault> {
    if !json.is_object() {
        return Err(Fault::json("/", "expected an object"));
    }
    let version = json.pointer("/asset/version").and_then(Value::as_str);
    let minimum = json.pointer("/asset/minVersion").and_then(Value::as_str);
    let found = match (version, minimum) {
        (None, _) => "nothing",
        (Some(version), _) if !version.starts_with("2.") => &format!("{version:?}"),
        (_, Some(minimum)) if minimum != "2.0" => {
            let message = format!("expected \"2.0\", found {minimum:?}");
            return Err(Fault::json("/asset/minVersion", message));
        }
        _ => return Ok(()),
    };
    let message = format!("expected \"2.0\", found {found}");
    Err(Fault::json("/asset/version", message))
}

fn check_extensions(json: &Value, notes: &mut Notes) -> Result<(), Fault> {
    let known = |name: &str| KNOWN_EXTENSIONS.contains(&name);
    for (i, name) in list(json, "extensionsRequired")?.iter().enumerate() {
        let pointer = format!("/extensionsRequired/{i}");
        let Some(name) = name.as_str() else {
            let message = format!("expected the name of an extension, found {name}");
            return Err(Fault::json(pointer, message));
        };
        if known(name) {
            continue;
        }
        let message = format!("the file requires the extension \"{name}\", which is not supported");
        return Err(Fault::json(pointer, message));
    }
    let mut uses = BTreeMap::new();
    for name in list(json, "extensionsUsed")? {
        uses.insert(name.as_str().unwrap_or_default(), 0);
    }
    count_extensions(json, &mut uses);
    for (name, count) in uses {
        if !known(name) {
            let what = format!("uses of the extension \"{name}\" left out");
            notes.left_out("extensions", count.max(1), None, what);
        }
    }
    Ok(())
}

/// Counts the uses of each extension. The recursion is not too deep, because the JSON parser limits the nesting.
fn count_extensions<'a>(json: &'a Value, uses: &mut BTreeMap<&'a str, usize>) {
    match json {
        Value::Array(values) => {
            for value in values {
                count_extensions(value, uses);
            }
        }
        Value::Object(members) => {
            for (key, value) in members {
                match value {
                    Value::Object(extensions) if key == "extensions" => {
                        for name in extensions.keys() {
                            *uses.entry(name).or_default() += 1;
                        }
                    }
                    // `extras` can contain any application data, so it is not searched for extensions.
                    _ if key == "extras" => {}
                    _ => count_extensions(value, uses),
                }
            }
        }
        _ => {}
    }
}

/// Checks the references in skins and animations, and the references from nodes to skins. The nodes, skins and samplers
/// must exist.
///
/// # Errors
///
/// Returns an error if an index refers to a node, skin or sampler that does not exist, or if a skin has no joints.
fn check_rig(document: &Document) -> Result<(), Fault> {
    for (i, skin) in document.skins.iter().enumerate() {
        let here = format!("/skins/{i}");
        if skin.joints.is_empty() {
            let message = "expected at least one joint";
            return Err(Fault::json(format!("{here}/joints"), message));
        }
        for (k, &joint) in skin.joints.iter().enumerate() {
            get(
                &document.nodes,
                joint,
                format_args!("{here}/joints/{k}"),
                "node",
            )?;
        }
        if let Some(skeleton) = skin.skeleton {
            get(
                &document.nodes,
                skeleton,
                format_args!("{here}/skeleton"),
                "node",
            )?;
        }
    }
    for (i, node) in document.nodes.iter().enumerate() {
        if let Some(skin) = node.skin {
            get(
                &document.skins,
                skin,
                format_args!("/nodes/{i}/skin"),
                "skin",
            )?;
        }
    }
    for (i, animation) in document.animations.iter().enumerate() {
        for (k, channel) in animation.channels.iter().enumerate() {
            let here = format!("/animations/{i}/channels/{k}");
            get(&animation.samplers, channel.sampler, &here, "sampler")?;
            if let Some(node) = channel.target.node {
                get(&document.nodes, node, format_args!("{here}/target"), "node")?;
            }
        }
    }
    Ok(())
}

/// Returns the parts of the document that are stored unchanged: the copyright and the extras of `asset`, the name and
/// the extras of the scene, and the extras of the document.
fn kept(json: &Value) -> BTreeMap<String, String> {
    let only = |json: Option<&Value>, keys: &[&str]| -> Json {
        let members = json.and_then(Value::as_object).into_iter().flatten();
        let kept = members.filter(|(key, value)| keys.contains(&key.as_str()) && !value.is_null());
        kept.map(|(key, value)| (key.clone(), value.clone()))
            .collect()
    };
    let mut asset = only(json.get("asset"), &["copyright", "extras"]);
    if let Some(Value::Object(extras)) = asset.get_mut("extras") {
        extras.shift_remove("meshwright");
        if extras.is_empty() {
            asset.shift_remove("extras");
        }
    }
    let scene = json.get("scene").and_then(Value::as_u64).unwrap_or(0);
    let scene = json.pointer(&format!("/scenes/{scene}"));
    let parts = [
        ("asset", asset),
        ("scene", only(scene, &["name", "extras"])),
        ("root", only(Some(json), &["extras"])),
    ];
    let parts = parts.into_iter().filter(|(_, members)| !members.is_empty());
    parts
        .map(|(name, members)| (name.to_owned(), Value::Object(members).to_string()))
        .collect()
}

/// Returns the default weights of the morph targets of each mesh. The weights are not rounded to 32 bits.
fn mesh_weights(json: &Value, budget: &Budget) -> Result<Vec<Vec<f64>>, Fault> {
    #[derive(Default, serde::Deserialize)]
    #[serde(default)]
    struct Weights {
        weights: Vec<f64>,
    }
    let meshes: Vec<Weights> = pieces(json, "meshes", budget)?;
    Ok(meshes.into_iter().map(|mesh| mesh.weights).collect())
}

fn lights(json: &Value) -> Result<Vec<Json>, Fault> {
    let pointer = format!("/extensions/{LIGHTS}/lights");
    let lights = match json.pointer(&pointer) {
        None => return Ok(Vec::new()),
        Some(Value::Array(lights)) => lights.iter().enumerate(),
        Some(_) => return Err(Fault::json(pointer, "expected a list")),
    };
    let light = |(i, light): (usize, &Value)| {
        let expected = || Fault::json(format!("{pointer}/{i}"), "expected an object");
        light.as_object().cloned().ok_or_else(expected)
    };
    lights.map(light).collect()
}

fn roots(json: &Value, notes: &mut Notes) -> Result<Vec<usize>, Fault> {
    let scenes = list(json, "scenes")?;
    if scenes.is_empty() {
        // If the document has no scenes, the roots are the nodes without a parent.
        let nodes = list(json, "nodes")?;
        let mut is_child = vec![false; nodes.len()];
        for node in nodes {
            let children = node.get("children").and_then(Value::as_array);
            for child in children.into_iter().flatten() {
                let child = child.as_u64().and_then(|child| usize::try_from(child).ok());
                if let Some(flag) = child.and_then(|child| is_child.get_mut(child)) {
                    *flag = true;
                }
            }
        }
        return Ok((0..nodes.len()).filter(|&i| !is_child[i]).collect());
    }
    let which = match json.get("scene") {
        None => 0,
        Some(scene) => index(scene, "/scene")?,
    };
    let scene = get(scenes, which, "/scene", "scene")?;
    notes.left_out("scenes", scenes.len() - 1, None, "other scenes left out");
    let pointer = format!("/scenes/{which}/nodes");
    let nodes = match scene.get("nodes") {
        None => return Ok(Vec::new()),
        Some(Value::Array(nodes)) => nodes,
        Some(_) => return Err(Fault::json(pointer, "expected a list")),
    };
    let nodes = nodes.iter().enumerate();
    nodes
        .map(|(i, node)| index(node, &format!("{pointer}/{i}")))
        .collect()
}

fn list<'a>(json: &'a Value, key: &str) -> Result<&'a [Value], Fault> {
    match json.get(key) {
        None => Ok(&[]),
        Some(Value::Array(values)) => Ok(values),
        Some(_) => Err(Fault::json(format!("/{key}"), "expected a list")),
    }
}

/// Deserializes the elements of a list. The memory budget limits the number of elements, because an element with
/// default values takes far less space in the text than in memory.
fn pieces<T: DeserializeOwned>(json: &Value, key: &str, budget: &Budget) -> Result<Vec<T>, Fault> {
    let piece = |(i, value): (usize, &Value)| {
        T::deserialize(value).map_err(|e| Fault::json(format!("/{key}/{i}"), e.to_string()))
    };
    let list = list(json, key)?;
    budget.spend((list.len() * size_of::<T>()) as u64, &format!("/{key}"))?;
    // Only the memory for this capacity was subtracted from the budget, so the list must not grow beyond this capacity.
    let mut pieces = Vec::with_capacity(list.len());
    for numbered in list.iter().enumerate() {
        pieces.push(piece(numbered)?);
    }
    Ok(pieces)
}
