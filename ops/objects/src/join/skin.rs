//! Joining skinned meshes.
//!
//! If all skinned parts have the same skin, and each of them has exactly one node, the joined mesh keeps this skin. The
//! parts without a skin follow the first joint of this skin. The points of these parts are transformed by the inverse
//! of the transform of the first joint, so that the parts do not move in the scene. In all other cases, the parts are
//! joined in the pose of their joints, and the skins are lost.

use std::sync::Arc;

use glam::DAffine3;
use mesh::{Column, Domain, Mesh, Rule, Value, joint_name};
use op::{Loss, Plan, Report};
use scene::{Geometry, Graph, Instance, MeshLabel, Object, Scene, transformed};

/// Why a joined mesh loses the skins of its parts.
#[derive(Clone, Copy, Debug)]
pub(super) enum LostSkin {
    /// The parts have different skins, or a skinned part has several instances.
    Different,
    /// Parts without a skin cannot be bound to the first joint, because its transform has no inverse.
    FirstJoint,
    /// No part has weights of joints.
    NoWeights,
}

/// The skin that a joined mesh keeps.
pub(super) struct KeptSkin {
    /// The name of the first skinned part. The node and the morph weights of this part are kept.
    pub(super) part: String,
    /// The transform of the first joint. It transforms points from bind space to scene space. Bind space is the space
    /// in which the skin binds points.
    first_joint: DAffine3,
}

impl KeptSkin {
    /// Returns the skin that all skinned parts share; `None` if no part has a skin.
    pub(super) fn of(scene: &Scene, parts: &[&Object]) -> Result<Option<Self>, LostSkin> {
        let graph = scene.graph();
        let instances = scene.instances();
        let mut kept: Option<(Option<usize>, Self)> = None;
        let (mut is_every_part_bound, mut has_unused_skin) = (true, false);
        for part in parts {
            let nodes = graph.nodes_of(&part.name);
            let mut own = instances.iter().filter(|i| i.object.name == part.name);
            let Some(joints) = own.find_map(|instance| instance.pose.joints.clone()) else {
                is_every_part_bound = false;
                has_unused_skin |= nodes.iter().any(|&i| graph.nodes()[i].skin.is_some());
                continue;
            };
            let [node] = nodes[..] else {
                return Err(LostSkin::Different);
            };
            let skin = graph.nodes()[node].skin;
            match &kept {
                Some((known, _)) if *known != skin => return Err(LostSkin::Different),
                Some(_) => {}
                None => {
                    let first_joint = joints.first().copied().unwrap_or_default();
                    let part = part.name.clone();
                    kept = Some((skin, Self { part, first_joint }));
                }
            }
        }
        match kept {
            None if has_unused_skin => Err(LostSkin::NoWeights),
            None => Ok(None),
            Some((_, kept)) if is_every_part_bound || kept.first_joint.inverse().is_finite() => {
                Ok(Some(kept))
            }
            Some(_) => Err(LostSkin::FirstJoint),
        }
    }

    /// Returns the object of an instance, with its points transformed to the space in which the skin binds points. If
    /// the instance has no skin, all its points are bound to the first joint.
    pub(super) fn bound(&self, instance: &Instance) -> Object {
        if instance.pose.joints.is_some() {
            return instance.object.clone();
        }
        let mut object = instance.placed();
        if let Geometry::Mesh(mesh) = &mut object.geometry {
            let mut bound = transformed(mesh, &self.first_joint.inverse());
            remove_joints(&mut bound);
            let values = vec![1.0; bound.n_vertices()];
            let column = Column {
                name: joint_name(0),
                rule: Rule::Interpolate,
                values: f64::wrap(values),
            };
            bound.insert_column(Domain::Vertex, column);
            *mesh = Arc::new(bound);
        }
        object
    }
}

/// Removes the weights of all joints.
fn remove_joints(mesh: &mut Mesh) {
    let joints = mesh.attributes().joints().into_iter();
    let names: Vec<String> = joints.map(|(joint, _)| joint_name(joint)).collect();
    for name in names {
        mesh.remove_column(Domain::Vertex, &name);
    }
}

/// Returns the first skinned part if all skinned parts have the same skin and each of them has one instance. Returns
/// `None` if no part has a skin.
pub(super) fn planned(plan: &Plan, parts: &[String]) -> Result<Option<String>, LostSkin> {
    let mut kept: Option<(Option<usize>, &String)> = None;
    for part in parts {
        let nodes = plan.graph().nodes_of(part);
        let skins = nodes.iter().map(|&i| plan.graph().nodes()[i].skin);
        let Some(skin) = skins.clone().find(Option::is_some) else {
            continue;
        };
        let is_same = kept.is_none_or(|(known, _)| known == skin);
        if !is_same || plan.instances(part) > 1 {
            return Err(LostSkin::Different);
        }
        kept = kept.or(Some((skin, part)));
    }
    Ok(kept.map(|(_, part)| part.clone()))
}

pub(super) fn lost_skin(joined: &str, why: LostSkin) -> Loss {
    let reason = match why {
        LostSkin::Different => {
            "the parts have different skins or several instances, so they are joined in the pose of their joints"
        }
        LostSkin::FirstJoint => {
            "the parts without a skin cannot be bound to the first joint, because its transform has no inverse, so the \
             parts are joined in the pose of their joints"
        }
        LostSkin::NoWeights => "no part has weights of joints",
    };
    Loss::part(joined, "skins", "its skin", reason)
}

/// Returns the names of the parts with morph targets.
pub(super) fn morphed<'a>(parts: &[&'a Object]) -> Vec<&'a str> {
    let has_morphs = |part: &&&Object| {
        let mesh = part.as_mesh();
        mesh.is_some_and(|mesh| !mesh.attributes().morphs().is_empty())
    };
    let morphed = parts.iter().filter(has_morphs);
    morphed.map(|part| part.name.as_str()).collect()
}

/// Returns the names and default weights of the morph targets. Returns `None` if the names or default weights differ
/// between the parts. Also returns `None` if the weights at a node of a part differ from the default weights. `morphed`
/// contains the names of the parts with morph targets.
pub(super) fn shared_label(graph: &Graph, morphed: &[&str]) -> Option<MeshLabel> {
    let mut shared = None;
    for part in morphed {
        let label = graph.label(part).cloned().unwrap_or_default();
        let label = MeshLabel {
            extras: label.extras,
            weights: label.weights,
            ..MeshLabel::default()
        };
        let nodes = graph.nodes_of(part).into_iter();
        let mut weights = nodes.map(|node| &graph.nodes()[node].weights);
        let is_default = weights.all(|own| own.is_empty() || *own == label.weights);
        if !is_default || shared.as_ref().is_some_and(|shared| *shared != label) {
            return None;
        }
        shared = Some(label);
    }
    Some(shared.unwrap_or_default())
}

/// Adds the changes of skins and morph targets to the report. Removes the weights of joints from the joined mesh if the
/// skins of the parts are lost.
pub(super) fn report(
    scene: &Scene,
    parts: &[&Object],
    kept: &Result<Option<KeptSkin>, LostSkin>,
    label: Option<&MeshLabel>,
    joined: &mut Object,
    report: &mut Report,
) {
    let graph = scene.graph();
    let is_skinned = |part: &&&Object| {
        let mut nodes = graph.nodes().iter();
        let mut nodes = nodes
            .by_ref()
            .filter(|n| n.object.as_deref() == Some(&part.name));
        nodes.any(|node| node.skin.is_some())
    };
    let skin = kept.as_ref().ok().and_then(Option::as_ref);
    if skin.is_some() {
        let others = parts.iter().filter(|part| !is_skinned(part));
        let n: usize = others
            .filter_map(|part| part.as_mesh())
            .map(|m| m.n_vertices())
            .sum();
        if n > 0 {
            report.notes.push(format!(
                "vertices bound to the first joint, because their objects had no skin: {n}"
            ));
        }
    } else if let Err(why) = kept {
        report.losses.push(lost_skin(&joined.name, *why));
    }
    let morphed = morphed(parts);
    let keeps_label = label.is_some()
        || skin.is_some_and(|kept| matches!(morphed[..], [only] if only == kept.part));
    if !keeps_label {
        let what = "the names and default weights of morph targets";
        let reason = "they are kept only if they are the same for all parts with morph targets, or if only the part \
                      whose skin is kept has morph targets";
        let loss = Loss::part(&joined.name, "morph targets", what, reason);
        report.losses.push(loss);
    }
    if kept.is_err()
        && let Geometry::Mesh(mesh) = &mut joined.geometry
    {
        remove_joints(Arc::make_mut(mesh));
    }
}
