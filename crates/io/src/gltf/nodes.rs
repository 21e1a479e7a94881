//! Finds the meshes that the nodes of a glTF scene reference, with their placements (transforms) and names.

use std::collections::BTreeMap;

use glam::DAffine3;
use scene::{Graph, MeshLabel, Node, Placement};
use serde_json::Value;

use super::budget::Budget;
use super::deformers::Deformers;
use super::document::{Document, Json};
use super::node_json::NodeJson;
use super::reference::get;
use crate::Placements;
use crate::fault::Fault;
use crate::note::{Names, Notes};

/// A mesh that becomes an object.
pub(super) struct PlacedMesh {
    /// The name of the object.
    pub(super) name: String,
    pub(super) mesh: usize,
    /// The transform that the reader applies to the points of the mesh. This transform is the identity if the scene
    /// keeps the nodes, because the nodes then place the object.
    pub(super) to_scene: DAffine3,
    /// The index (in the file) of the node whose skin and morph weights are applied to the points. `None` if the scene
    /// keeps the nodes.
    pub(super) posed_by: Option<usize>,
    /// The number of nodes that reference the object.
    pub(super) instances: u64,
}

/// The objects of a scene and the nodes that place them.
pub(super) struct PlacedNodes {
    pub(super) meshes: Vec<PlacedMesh>,
    pub(super) graph: Graph,
    /// For each node of the file, its index in the graph. `None` if the node is not in the graph.
    pub(super) places: Vec<Option<usize>>,
    /// For each node of the file, the number of morph targets of its mesh.
    pub(super) targets: Vec<usize>,
    /// For each node of the file, the transform from the space of the node to the space of the scene.
    pub(super) to_scene: Vec<Option<DAffine3>>,
}

/// A node of the scene.
struct SceneNode {
    /// The index in the file.
    index: usize,
    /// The index of the parent in the list of scene nodes.
    parent: Option<usize>,
    placement: Placement,
    to_scene: DAffine3,
    light: Option<usize>,
}

/// The objects of a scene and the nodes that place them.
///
/// # Errors
///
/// Returns an error if a node is invalid or occurs twice in the scene, or if the memory budget is used up.
pub(super) fn placed_meshes(
    document: &Document,
    placements: Placements,
    otherwise: &str,
    budget: &Budget,
    notes: &mut Notes,
) -> Result<PlacedNodes, Fault> {
    let nodes = scene_nodes(document)?;
    let deformers = Deformers::of_meshes(document);
    let targets = |node: &NodeJson| {
        node.mesh
            .and_then(|mesh| deformers.get(mesh))
            .map_or(0, |d| d.targets)
    };
    let mut all = PlacedNodes {
        meshes: Vec::new(),
        graph: Graph::default(),
        places: vec![None; document.nodes.len()],
        targets: document.nodes.iter().map(targets).collect(),
        to_scene: vec![None; document.nodes.len()],
    };
    for node in &nodes {
        all.to_scene[node.index] = Some(node.to_scene);
    }
    let mut names = Names::default();
    match placements {
        Placements::Bake => {
            all.meshes = baked(document, &nodes, otherwise, budget, &mut names, notes)?;
            note_left_out(document, notes);
        }
        Placements::Keep => {
            all.meshes = shared(document, &nodes, otherwise, budget, &mut names, notes)?;
            let (graph, places) = graph(document, &nodes, &all.meshes, &deformers, budget)?;
            (all.graph, all.places) = (graph, places);
        }
    }
    Ok(all)
}

fn note_left_out(document: &Document, notes: &mut Notes) {
    let (cameras, lights) = (document.cameras.len(), document.lights.len());
    notes.left_out("cameras", cameras, None, "cameras left out");
    notes.left_out("lights", lights, None, "lights left out");
    let what = "animations left out";
    notes.left_out("animations", document.animations.len(), None, what);
    let what = "skins left out: the meshes have the pose of the joints";
    notes.left_out("skins", document.skins.len(), None, what);
}

/// Returns the nodes of the scene in depth-first order. After each node come its first child and the descendants of
/// this child, then its second child, and so on.
fn scene_nodes(document: &Document) -> Result<Vec<SceneNode>, Fault> {
    let mut visited = vec![false; document.nodes.len()];
    let mut nodes: Vec<SceneNode> = Vec::new();
    // The code uses its own stack instead of recursion, because a long chain of nodes would overflow the call stack.
    let mut open: Vec<(usize, Option<usize>)> = Vec::new();
    open.extend(document.roots.iter().rev().map(|&root| (root, None)));
    while let Some((index, parent)) = open.pop() {
        let node = get(&document.nodes, index, "/scenes", "node")?;
        let here = format!("/nodes/{index}");
        if std::mem::replace(&mut visited[index], true) {
            let message = "the node occurs twice in the scene or is its own descendant";
            return Err(Fault::json(here, message));
        }
        let placement = node.placement(&here)?;
        let own = placement.to_affine();
        let to_scene = parent.map_or(own, |parent| nodes[parent].to_scene * own);
        if !to_scene.is_finite() {
            return Err(Fault::json(here, "the transform of the node is not finite"));
        }
        if let Some(mesh) = node.mesh {
            get(&document.meshes, mesh, format_args!("{here}/mesh"), "mesh")?;
        }
        if let Some(camera) = node.camera {
            get(
                &document.cameras,
                camera,
                format_args!("{here}/camera"),
                "camera",
            )?;
        }
        let light = node.light(&here)?;
        if let Some(light) = light {
            get(&document.lights, light, &here, "light")?;
        }
        for (k, &child) in node.children.iter().enumerate().rev() {
            let pointer = format_args!("{here}/children/{k}");
            get(&document.nodes, child, pointer, "node")?;
            open.push((child, Some(nodes.len())));
        }
        nodes.push(SceneNode {
            index,
            parent,
            placement,
            to_scene,
            light,
        });
    }
    Ok(nodes)
}

/// Returns an object for each node with a mesh, in the order of the nodes.
fn baked(
    document: &Document,
    nodes: &[SceneNode],
    otherwise: &str,
    budget: &Budget,
    names: &mut Names,
    notes: &mut Notes,
) -> Result<Vec<PlacedMesh>, Fault> {
    let mut placed = Vec::new();
    for node in nodes {
        let Some(mesh) = document.nodes[node.index].mesh else {
            continue;
        };
        let known = [
            &document.nodes[node.index].name,
            &document.meshes[mesh].name,
        ];
        let name = first_name(known, otherwise);
        spend(name, node.index, budget)?;
        placed.push(PlacedMesh {
            name: names.unique(name, notes),
            mesh,
            to_scene: node.to_scene,
            posed_by: Some(node.index),
            instances: 1,
        });
    }
    Ok(placed)
}

/// Returns an object for each mesh that nodes reference, in the order of the meshes. If several nodes reference a mesh,
/// its object gets the name of the mesh, otherwise the name of the node.
fn shared(
    document: &Document,
    nodes: &[SceneNode],
    otherwise: &str,
    budget: &Budget,
    names: &mut Names,
    notes: &mut Notes,
) -> Result<Vec<PlacedMesh>, Fault> {
    // For each mesh, the first node that references it, and the number of nodes that reference it.
    let mut uses: BTreeMap<usize, (usize, u64)> = BTreeMap::new();
    for node in nodes {
        if let Some(mesh) = document.nodes[node.index].mesh {
            uses.entry(mesh).or_insert((node.index, 0)).1 += 1;
        }
    }
    let mut placed = Vec::new();
    for (mesh, (node, instances)) in uses {
        let mut known = [&document.nodes[node].name, &document.meshes[mesh].name];
        if instances > 1 {
            known.reverse();
        }
        let name = first_name(known, otherwise);
        spend(name, node, budget)?;
        placed.push(PlacedMesh {
            name: names.unique(name, notes),
            mesh,
            to_scene: DAffine3::IDENTITY,
            posed_by: None,
            instances,
        });
    }
    Ok(placed)
}

/// Returns the graph of the scene, and for each node of the file, its index in the graph. If the nodes of the file are
/// exactly those that the writer creates for a graph without nodes, the returned graph has no nodes.
fn graph(
    document: &Document,
    nodes: &[SceneNode],
    placed: &[PlacedMesh],
    deformers: &[Deformers],
    budget: &Budget,
) -> Result<(Graph, Vec<Option<usize>>), Fault> {
    let mut graph = Graph::default();
    graph.cameras.extend(document.cameras.iter().map(text));
    graph.lights.extend(document.lights.iter().map(text));
    graph.document.clone_from(&document.kept);
    let objects: BTreeMap<usize, &PlacedMesh> = placed.iter().map(|p| (p.mesh, p)).collect();
    for object in placed {
        let mesh = &document.meshes[object.mesh];
        let extras = mesh.extras.as_ref().map(|extras| extras.get().to_owned());
        let Deformers {
            targets,
            weight_sets,
            ..
        } = deformers[object.mesh];
        let mut weights = document.mesh_weights[object.mesh].clone();
        weights.resize(targets, 0.0);
        budget.spend(8 * targets as u64, &format!("/meshes/{}", object.mesh))?;
        let label = MeshLabel {
            name: mesh.name.clone(),
            extras,
            weights,
            weight_sets,
        };
        if label.name.as_ref() != Some(&object.name)
            || label.extras.is_some()
            || label.is_deformed()
        {
            graph.set_label(&*object.name, label);
        }
    }
    let is_referenced = referenced(document);
    let is_plain = |node: &SceneNode, object: &PlacedMesh| {
        !is_referenced[node.index] && is_plain(node, &document.nodes[node.index], object)
    };
    let is_implied = nodes.len() == placed.len()
        && (nodes.iter().zip(placed)).all(|(node, object)| is_plain(node, object));
    if is_implied {
        return Ok((graph, vec![None; document.nodes.len()]));
    }
    // For each node of the scene, the index of the node in the graph.
    let mut places = vec![0; nodes.len()];
    let mut of_file = vec![None; document.nodes.len()];
    for (i, node) in nodes.iter().enumerate() {
        let json = &document.nodes[node.index];
        let object = json.mesh.map(|mesh| objects[&mesh].name.clone());
        let length = object.as_ref().map_or(0, String::len);
        let pointer = format!("/nodes/{}", node.index);
        budget.spend((size_of::<Node>() + length) as u64, &pointer)?;
        places[i] = graph.push(Node {
            name: json.name.clone(),
            parent: node.parent.map(|parent| places[parent]),
            placement: node.placement,
            object,
            camera: json.camera,
            light: node.light,
            skin: json.skin.filter(|_| json.mesh.is_some()),
            weights: json.weights.clone(),
            extras: json.extras.as_ref().map(ToString::to_string),
        });
        of_file[node.index] = Some(places[i]);
    }
    Ok((graph, of_file))
}

fn text(json: &Json) -> String {
    Value::Object(json.clone()).to_string()
}

/// For an object without a node, the writer creates a simple node. Returns whether a node equals this simple node.
fn is_plain(node: &SceneNode, json: &NodeJson, object: &PlacedMesh) -> bool {
    node.parent.is_none()
        && json.mesh == Some(object.mesh)
        && json.children.is_empty()
        && node.placement.to_affine() == DAffine3::IDENTITY
        && json.name.as_ref() == Some(&object.name)
        && json.camera.is_none()
        && node.light.is_none()
        && json.extras.is_none()
        && json.skin.is_none()
        && json.weights.is_empty()
        && object.instances == 1
}

fn first_name<'a>(names: [&'a Option<String>; 2], otherwise: &'a str) -> &'a str {
    let mut names = names.into_iter().flatten();
    names
        .find(|name| !name.is_empty())
        .map_or(otherwise, |name| name)
}

/// Subtracts the minimum size of an object from the memory budget. The size includes the memory of the object name,
/// which is stored several times.
fn spend(name: &str, node: usize, budget: &Budget) -> Result<(), Fault> {
    let bytes = Budget::OBJECT + 8 * name.len() as u64;
    budget.spend(bytes, &format!("/nodes/{node}"))
}

/// Returns one flag for each node of the file: whether a skin or an animation refers to the node.
fn referenced(document: &Document) -> Vec<bool> {
    let mut flags = vec![false; document.nodes.len()];
    let of_skins = document.skins.iter();
    let of_skins = of_skins.flat_map(|skin| skin.joints.iter().chain(&skin.skeleton));
    let channels = document.animations.iter().flat_map(|a| &a.channels);
    for &node in of_skins.chain(channels.filter_map(|c| c.target.node.as_ref())) {
        if let Some(flag) = flags.get_mut(node) {
            *flag = true;
        }
    }
    flags
}
