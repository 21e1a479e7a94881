//! Moves objects by changing the placements of their nodes. The placement of a node is its transform relative to its
//! parent.
//!
//! ```text
//!   scene <-- P -- parent <-- L -- node <-- points of the object
//! ```
//!
//! L places the node in its parent, and P places the parent in the scene. A transform M in scene space moves a point p
//! of the object from P L p to M P L p. The new placement of the node is therefore P'^-1 M P L, where P' places the
//! parent after the move. If M also moves the parent, P' = M P, and the placement of the node does not change.

use glam::{DAffine3, DVec3};
use op::{Context, OpError, Plan, PlanContext, Problem, Report};
use scene::{Graph, Instance, Placement, Scene};

use super::{About, Space, Transform};
use crate::transform::map::Map;

impl Transform {
    /// Moves the objects that nodes place, and removes the names of these objects from `names`. The report counts the
    /// points of these objects.
    pub(super) fn move_nodes(
        &self,
        scene: &mut Scene,
        names: &mut Vec<String>,
        map: &Map,
        cx: &Context,
    ) -> Result<Report, OpError> {
        let graph = scene.graph();
        // For each node, the transform in scene space that the step must apply to the node.
        let mut maps: Vec<Option<DAffine3>> = vec![None; graph.nodes().len()];
        let mut n_points = 0;
        let nodes_of = graph.nodes_of_objects();
        names.retain(|name| !nodes_of.contains_key(name.as_str()));
        let is_target = |name: &String| cx.on.is_none_or(|on| on.contains(name));
        let instances = scene.instances();
        for instances in instances.chunk_by(|a, b| a.object.name == b.object.name) {
            let object = instances[0].object;
            let Some(nodes) = nodes_of.get(object.name.as_str()) else {
                continue;
            };
            if !is_target(&object.name) {
                continue;
            }
            let center = if self.about == About::Center {
                let placed: Vec<_> = instances.iter().map(Instance::placed).collect();
                let meshes = placed.iter().filter_map(|object| object.as_mesh());
                self.center(meshes.flat_map(|mesh| mesh.positions().iter().copied()))
            } else {
                self.center(std::iter::empty())
            };
            for &i in nodes {
                maps[i] = Some(map.affine(center));
            }
            // Skinned meshes are placed by their joints, so the nodes of the joints move.
            let skinned = instances.iter().zip(nodes);
            let skinned = skinned.filter(|(instance, _)| instance.pose.joints.is_some());
            for skin in skinned.filter_map(|(_, &i)| graph.nodes()[i].skin) {
                for &joint in &graph.skins[skin].joints {
                    maps[joint] = Some(map.affine(center));
                }
            }
            n_points += object.as_mesh().map_or(0, |mesh| mesh.n_vertices());
        }
        if cx.on.is_none() && self.about != About::Center {
            move_roots(
                graph,
                &mut maps,
                &map.affine(self.center(std::iter::empty())),
            );
        }
        let graph = scene.graph_mut();
        let n_inserted = insert_parents(graph, &mut maps);
        move_by(graph, &maps, map.only_moves())?;
        let what = "nodes inserted above animated nodes";
        Ok(Report::changed(n_points).count(what, n_inserted))
    }

    /// Moves the nodes in the plan of a scene. Returns a problem if a node certainly cannot store its new placement.
    pub(super) fn plan_nodes(&self, plan: &mut Plan, cx: &PlanContext) -> Option<Problem> {
        let graph = plan.graph();
        if self.space == Space::Object || plan.incomplete || graph.nodes().is_empty() {
            return None;
        }
        let map = self.map();
        // The center of an object is not known in the plan. The center affects only the translations of the nodes.
        let affine = map.affine(self.center(std::iter::empty()));
        let mut maps: Vec<Option<DAffine3>> = vec![None; graph.nodes().len()];
        let mut may_be_skinned = false;
        for (i, node) in graph.nodes().iter().enumerate() {
            let Some(name) = &node.object else {
                continue;
            };
            if cx.on.is_some_and(|on| !on.contains(name)) {
                continue;
            }
            maps[i] = Some(affine);
            for &joint in node.skin.iter().flat_map(|&skin| &graph.skins[skin].joints) {
                // If the mesh has no weights of joints, the joints do not move. The plan does not always know whether
                // the mesh has weights.
                (maps[joint], may_be_skinned) = (Some(affine), true);
            }
        }
        if cx.on.is_none() && self.about != About::Center {
            move_roots(graph, &mut maps, &affine);
        }
        let mut result = Ok(());
        plan.edit_graph(|graph| {
            insert_parents(graph, &mut maps);
            result = move_by(graph, &maps, map.only_moves());
        });
        let error = result.err()?;
        // With `About::Center`, the translations in the plan differ from the translations in the run. An overflow in
        // the plan therefore does not prove that a coordinate overflows in the run.
        let is_certain = self.about != About::Center || matches!(error, OpError::Object(_));
        (is_certain && !may_be_skinned).then(|| Problem::error(error.to_string()))
    }
}

/// Sets the entry in `maps` of each root of the graph (a node without a parent) to `affine`.
fn move_roots(graph: &Graph, maps: &mut [Option<DAffine3>], affine: &DAffine3) {
    for (map, node) in maps.iter_mut().zip(graph.nodes()) {
        if node.parent.is_none() {
            *map = Some(*affine);
        }
    }
}

/// Inserts a parent above each animated node that the step moves. The animation overwrites the placement of the node,
/// so the step moves the new parent instead of the node. Returns the number of new nodes.
fn insert_parents(graph: &mut Graph, maps: &mut Vec<Option<DAffine3>>) -> usize {
    let mut animated = graph.animated_flags();
    if !animated.contains(&true) {
        return 0;
    }
    let before = maps.len();
    let mut moved: Vec<Option<DAffine3>> = Vec::new();
    while moved.len() < maps.len() {
        let i = moved.len();
        let of_parent = graph.nodes()[i].parent.and_then(|parent| moved[parent]);
        let own = maps[i].filter(|map| Some(*map) != of_parent);
        if own.is_some() && animated[i] {
            graph.insert_parent(i);
            maps.insert(i, own);
            animated.insert(i, false);
        }
        moved.push(maps[i].or(of_parent));
    }
    maps.len() - before
}

/// Moves each node by its entry in `maps`, which is an affine transform in scene space. A node whose entry is `None`
/// moves with its parent. If `only_moves` is set, the transforms in `maps` neither scale nor rotate.
fn move_by(graph: &mut Graph, maps: &[Option<DAffine3>], only_moves: bool) -> Result<(), OpError> {
    let old = graph.to_scene();
    let nodes = graph.nodes();
    let mut placements: Vec<Placement> = nodes.iter().map(|node| node.placement).collect();
    let mut new: Vec<DAffine3> = Vec::with_capacity(nodes.len());
    // For each node, the transform in scene space that was applied to the node.
    let mut moved: Vec<Option<DAffine3>> = Vec::with_capacity(nodes.len());
    for (i, node) in nodes.iter().enumerate() {
        let of_parent = node.parent.and_then(|parent| moved[parent]);
        let own = maps[i].filter(|map| Some(*map) != of_parent);
        if let Some(map) = own {
            if !map.is_finite() {
                return Err(OpError::overflow("Transform", "scale, rotate and move"));
            }
            let parent = node.parent.map_or(DAffine3::IDENTITY, |parent| new[parent]);
            let placed = if only_moves && of_parent.is_none() {
                // Only the translation is changed, so that the scale and the rotation stay exactly the same.
                let shift = parent.matrix3.inverse() * map.translation;
                shift
                    .is_finite()
                    .then(|| translated(&node.placement, shift))
            } else {
                Placement::of(&(parent.inverse() * map * old[i]))
            };
            placements[i] = placed.ok_or_else(|| {
                let name = node.name.as_deref().or(node.object.as_deref()).unwrap_or_default();
                OpError::Object(format!(
                    "the node \"{name}\" cannot store the result as a scale, a rotation and a translation: use \
                     `space: Object`, or read the file with `placements: Bake`"
                ))
            })?;
        }
        moved.push(maps[i].or(of_parent));
        let own = placements[i].to_affine();
        new.push(node.parent.map_or(own, |parent| new[parent] * own));
        if !new[i].is_finite() {
            return Err(OpError::overflow("Transform", "scale, rotate and move"));
        }
    }
    for (i, placement) in placements.into_iter().enumerate() {
        graph.set_placement(i, placement);
    }
    Ok(())
}

/// Returns a placement that is moved by `shift` in the space of the parent.
fn translated(placement: &Placement, shift: DVec3) -> Placement {
    let mut moved = *placement;
    let translation = match &mut moved {
        Placement::Matrix(matrix) => &mut matrix[12..15],
        Placement::Parts { translation, .. } => &mut translation[..],
    };
    for (x, shift) in translation.iter_mut().zip(shift.to_array()) {
        *x += shift;
    }
    moved
}
