//! The JSON of a glTF file, piece by piece.

use gltf_json::{Accessor, Buffer, Material, Mesh, Node, buffer::View};
use serde::de::DeserializeOwned;
use serde_json::Value;

use super::JsonError;
use crate::note::Notes;

/// Required extensions that the reader knows: positions and texture coordinates may be integers.
const KNOWN_EXTENSIONS: [&str; 1] = ["KHR_mesh_quantization"];

/// What the reader needs of a glTF document.
#[derive(Debug, Default)]
pub(super) struct Document {
    pub(super) accessors: Vec<Accessor>,
    pub(super) buffers: Vec<Buffer>,
    pub(super) views: Vec<View>,
    pub(super) materials: Vec<Material>,
    pub(super) meshes: Vec<Mesh>,
    pub(super) nodes: Vec<Node>,
    /// The nodes that the scene begins with.
    pub(super) roots: Vec<usize>,
    /// For each texture the path of its picture, if that is a file.
    pub(super) pictures: Vec<Option<String>>,
}

impl Document {
    /// Takes the document apart. What the reader does not look at goes to the notes.
    ///
    /// # Errors
    ///
    /// The first piece that is not what it should be.
    pub(super) fn new(json: &Value, notes: &mut Notes) -> Result<Self, JsonError> {
        check_version(json)?;
        check_extensions(json, notes)?;
        let document = Self {
            accessors: pieces(json, "accessors")?,
            buffers: pieces(json, "buffers")?,
            views: pieces(json, "bufferViews")?,
            materials: pieces(json, "materials")?,
            meshes: pieces(json, "meshes")?,
            nodes: pieces(json, "nodes")?,
            roots: roots(json, notes)?,
            pictures: pictures(json),
        };
        for (key, what) in [
            ("animations", "animations left out"),
            ("skins", "skins left out"),
            ("cameras", "cameras left out"),
        ] {
            notes.left_out(list(json, key)?.len(), None, what);
        }
        let with_materials = document
            .pictures
            .iter()
            .filter(|picture| picture.is_none())
            .count();
        notes.left_out(with_materials, None, "pictures inside the file left out");
        Ok(document)
    }
}

/// The piece at `index`, or an error at `pointer`, which refers to it.
///
/// # Errors
///
/// If there is no such piece.
pub(super) fn get<'a, T>(
    pieces: &'a [T],
    index: usize,
    pointer: impl Fn() -> String,
    what: &str,
) -> Result<&'a T, JsonError> {
    pieces.get(index).ok_or_else(|| {
        JsonError::new(
            pointer(),
            format!("refers to {what} {index}, but there are {}", pieces.len()),
        )
    })
}

fn check_version(json: &Value) -> Result<(), JsonError> {
    if !json.is_object() {
        return Err(JsonError::new("/", "expected an object"));
    }
    let version = json.pointer("/asset/version").and_then(Value::as_str);
    let minimum = json.pointer("/asset/minVersion").and_then(Value::as_str);
    match (version, minimum) {
        (None, _) => Err(JsonError::new(
            "/asset/version",
            "expected \"2.0\", found nothing",
        )),
        (Some(version), _) if !version.starts_with("2.") => Err(JsonError::new(
            "/asset/version",
            format!("expected \"2.0\", found {version:?}"),
        )),
        (_, Some(minimum)) if minimum != "2.0" => Err(JsonError::new(
            "/asset/minVersion",
            format!("expected \"2.0\", found {minimum:?}"),
        )),
        _ => Ok(()),
    }
}

fn check_extensions(json: &Value, notes: &mut Notes) -> Result<(), JsonError> {
    let unknown = |name: &Value| {
        name.as_str()
            .is_none_or(|name| !KNOWN_EXTENSIONS.contains(&name))
    };
    if let Some((i, name)) = list(json, "extensionsRequired")?
        .iter()
        .enumerate()
        .find(|(_, name)| unknown(name))
    {
        return Err(JsonError::new(
            format!("/extensionsRequired/{i}"),
            format!(
                "the file cannot be read without the extension {name}, which is not known here"
            ),
        ));
    }
    for name in list(json, "extensionsUsed")?
        .iter()
        .filter(|name| unknown(name))
    {
        notes.left_out(
            1,
            None,
            format!("extension {name}: what it says is left out"),
        );
    }
    Ok(())
}

fn roots(json: &Value, notes: &mut Notes) -> Result<Vec<usize>, JsonError> {
    let scenes = list(json, "scenes")?;
    if scenes.is_empty() {
        // A library of nodes: those that no other node holds.
        let nodes = list(json, "nodes")?;
        let mut is_child = vec![false; nodes.len()];
        for node in nodes {
            for child in node
                .get("children")
                .and_then(Value::as_array)
                .into_iter()
                .flatten()
            {
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
    let scene = get(scenes, which, || "/scene".to_owned(), "scene")?;
    notes.left_out(scenes.len() - 1, None, "other scenes left out");
    let pointer = format!("/scenes/{which}/nodes");
    let nodes = match scene.get("nodes") {
        None => return Ok(Vec::new()),
        Some(Value::Array(nodes)) => nodes,
        Some(_) => return Err(JsonError::new(pointer, "expected a list")),
    };
    nodes
        .iter()
        .enumerate()
        .map(|(i, node)| index(node, &format!("{pointer}/{i}")))
        .collect()
}

fn index(value: &Value, pointer: &str) -> Result<usize, JsonError> {
    value
        .as_u64()
        .and_then(|index| usize::try_from(index).ok())
        .ok_or_else(|| JsonError::new(pointer, format!("expected an index, found {value}")))
}

/// For each texture the path of its picture. What is broken here is only left out.
fn pictures(json: &Value) -> Vec<Option<String>> {
    let textures = json.get("textures").and_then(Value::as_array);
    let path = |texture: &Value| {
        let image = usize::try_from(texture.get("source")?.as_u64()?).ok()?;
        let uri = json.get("images")?.get(image)?.get("uri")?.as_str()?;
        let path = crate::asset_path::inside_uri(uri).ok()?;
        Some(path.to_str()?.replace('\\', "/"))
    };
    textures.into_iter().flatten().map(path).collect()
}

fn list<'a>(json: &'a Value, key: &str) -> Result<&'a [Value], JsonError> {
    match json.get(key) {
        None => Ok(&[]),
        Some(Value::Array(values)) => Ok(values),
        Some(_) => Err(JsonError::new(format!("/{key}"), "expected a list")),
    }
}

fn pieces<T: DeserializeOwned>(json: &Value, key: &str) -> Result<Vec<T>, JsonError> {
    let piece = |(i, value): (usize, &Value)| {
        T::deserialize(value).map_err(|e| JsonError::new(format!("/{key}/{i}"), e.to_string()))
    };
    list(json, key)?.iter().enumerate().map(piece).collect()
}
