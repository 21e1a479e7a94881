//! Joins meshes into one object.
//!
//! ```text
//!    "head"  "body"             "figure": one mesh of two components;
//!      o       |         --->      o       the faces of "head" come first;
//!             / \                  |       the faces are tagged "head" and "body"
//!                                 / \
//! ```

mod attributes;
mod parts;
mod skin;

use std::sync::Arc;

use mesh::Domain;
use op::prelude::*;
use op::{Operation, PlannedAttribute, PlannedObject, check_name, named_object};
use scene::{Graph, MeshLabel, Object};

use crate::join::skin::{KeptSkin, LostSkin};

/// Joins meshes into one object.
///
/// Each mesh becomes a part of the result. Vertices, edges and faces are numbered part by part, in the order of
/// `objects`. The parts are not connected, even where they touch. In the scene, the result replaces the first mesh in
/// `objects`, and the other meshes are removed. If nodes of the scene (as in glTF) place a mesh, the result contains a
/// copy of the mesh for each of these nodes. The points of each copy are transformed by the transform of the node. The
/// result keeps a skin only if all skinned parts have the same skin and each of them has exactly one node. In this
/// case, the result also keeps the node of the first skinned part. Parts without a skin then follow the first joint of
/// the skin. If no skin is kept, skinned parts are joined in their current pose. The result then has no node, because
/// its points are already at their positions in the scene. The names and default weights of morph targets are kept if
/// they are the same in all parts that have morph targets.
///
/// If only some of the parts have an attribute, the value of this attribute is zero in all other parts. Missing
/// material indices become -1 (no material). If a part has no normals, the normals of all parts are dropped and
/// reported as lost. If an attribute of a part has a different type than in earlier parts, the attribute of this part
/// is dropped and reported as lost. Equal materials become one material.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Join {
    /// The names of the meshes. At least one name, without duplicates.
    pub objects: Vec<String>,
    /// The name of the result, which can be the name of one of the joined meshes.
    pub name: String,
    /// Whether to tag the faces of each part with the name of the part. In later steps, `Tagged("head")` then selects
    /// the faces of the part "head".
    #[serde(default = "yes")]
    pub tag_parts: bool,
}

const fn yes() -> bool {
    true
}

impl Operation for Join {
    const NAME: &'static str = "Join";
    const VERSION: u32 = 2;
    const SUMMARY: &'static str = "Join meshes into one object";
    const EXAMPLE: &'static str = r#"Join(objects: ["mesh", "other"], name: "joined")"#;
    const WORDS: &'static [&'static str] = &["merge", "combine", "append"];

    fn plan(&self, plan: &mut Plan, _: &PlanContext) -> Vec<Problem> {
        let mut problems = self.problems();
        let mut parts = Vec::new();
        for (i, name) in self.objects.iter().enumerate() {
            let at = i.to_string();
            match plan.object(name).map(|o| &o.geometry) {
                None => problems.extend(plan.missing(name, ["objects", &at])),
                Some(PlannedGeometry::Mesh(mesh)) => {
                    parts.push((mesh.clone(), plan.instances(name)));
                }
                Some(other) => {
                    let message = not_a_mesh(name, other.kind());
                    problems.push(Problem::error(message).at(["objects", &at]));
                }
            }
        }
        if !self.objects.contains(&self.name) {
            problems.extend(plan.taken(&self.name, "name"));
        }
        if !problems.is_empty() {
            return problems;
        }
        if parts.len() != self.objects.len() {
            // An earlier step that could not be planned can create the missing objects.
            plan.incomplete = true;
            return problems;
        }
        let joined = self.joined_plan(&parts);
        let kept = skin::planned(plan, &self.objects);
        let morphed = self.objects.iter().zip(&parts);
        let morphed = morphed.filter(|(_, (mesh, _))| mesh.n_morphs() > 0);
        let morphed: Vec<&str> = morphed.map(|(name, _)| name.as_str()).collect();
        let label = skin::shared_label(plan.graph(), &morphed);
        if kept.is_err() {
            plan.losses
                .push(skin::lost_skin(&self.name, LostSkin::Different));
        }
        let counts = [joined.edges.by(2), joined.vertices, joined.faces];
        let largest = counts.map(|n| n.min).into_iter().fold(0, u64::max);
        if largest > parts::MAX_ELEMENTS {
            problems.push(Problem::error(parts::too_many(largest)));
        }
        let first = &self.objects[0];
        let objects = plan.objects_mut();
        objects.retain(|o| o.name == *first || !self.objects.contains(&o.name));
        let object = objects.iter_mut().find(|o| o.name == *first);
        *object.expect("checked above") = PlannedObject {
            name: self.name.clone(),
            geometry: PlannedGeometry::Mesh(joined),
            unplaced_nodes: 0,
        };
        plan.edit_graph(|graph| self.join_nodes(graph, kept.ok().flatten().as_deref(), label));
        problems
    }

    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError> {
        if let Some(problem) = self.problems().into_iter().next() {
            return Err(OpError::Parameter(problem.message));
        }
        if !self.objects.contains(&self.name) {
            check_name(scene, &self.name)?;
        }
        let part = |name: &String| {
            let object = named_object(scene, name)?;
            let wrong_kind = || OpError::Object(not_a_mesh(name, object.geometry.kind()));
            object.as_mesh().map(|_| object).ok_or_else(wrong_kind)
        };
        let parts: Vec<&Object> = self.objects.iter().map(part).collect::<Result<_, _>>()?;
        let kept = KeptSkin::of(scene, &parts);
        let skin = kept.as_ref().ok().and_then(Option::as_ref);
        let label = skin::shared_label(scene.graph(), &skin::morphed(&parts));
        let placed = placed(scene, &parts, skin, label.is_some(), cx)?;
        let (joined, mut report) = match &placed {
            Some(placed) => self.joined(&placed.iter().collect::<Vec<_>>(), cx)?,
            None => self.joined(&parts, cx)?,
        };
        if let Some(placed) = placed {
            report = report.count(
                "instances whose transforms were applied to their points",
                placed.len(),
            );
        }
        let mut joined = joined;
        skin::report(
            scene,
            &parts,
            &kept,
            label.as_ref(),
            &mut joined,
            &mut report,
        );

        // All checks have passed. The result now replaces the first part, and the other parts are removed.
        let (first, others) = self.objects.split_first().expect("at least one");
        let (geometry, materials) = scene.parts_mut(first).expect("found above");
        (*geometry, *materials) = (joined.geometry, joined.materials);
        if !scene.graph().is_empty() {
            let kept = kept.ok().flatten();
            self.join_nodes(
                scene.graph_mut(),
                kept.as_ref().map(|kept| &*kept.part),
                label,
            );
        }
        for name in others {
            scene.remove(name);
        }
        scene.rename(first, &self.name).expect("the name is free");
        Ok(report)
    }
}

impl Join {
    fn problems(&self) -> Vec<Problem> {
        let mut problems = Vec::new();
        if self.objects.is_empty() {
            problems.push(Problem::error("expected at least one object").at(["objects"]));
        }
        for (i, name) in self.objects.iter().enumerate() {
            if self.objects[..i].contains(name) {
                let message = format!("\"{name}\" is listed twice");
                problems.push(Problem::error(message).at(["objects", &i.to_string()]));
            }
        }
        problems
    }

    /// Removes the nodes of all parts except `kept`, the part whose skin the result keeps. The node of `kept` then
    /// places the result. If `kept` is `None`, the result has no node. `label` contains the names and default weights
    /// of the morph targets if the parts share them.
    fn join_nodes(&self, graph: &mut Graph, kept: Option<&str>, label: Option<MeshLabel>) {
        let first = &self.objects[0];
        if kept != Some(first) {
            graph.remove_object(first);
        }
        if let Some(kept) = kept.filter(|kept| kept != first) {
            graph.show_instead(kept, first);
        }
        for name in &self.objects[1..] {
            graph.remove_object(name);
        }
        graph.rename_object(first, &self.name);
        if let Some(shared) = label.filter(MeshLabel::is_deformed) {
            let own = graph.label(&self.name).cloned().unwrap_or_default();
            let label = MeshLabel {
                name: own.name.or_else(|| Some(self.name.clone())),
                extras: shared.extras.or(own.extras),
                weights: shared.weights,
                weight_sets: own.weight_sets,
            };
            graph.set_label(&*self.name, label);
        }
    }

    /// Joins the parts into one object. All parts must be meshes.
    fn joined(&self, parts: &[&Object], cx: &Context) -> Result<(Object, Report), OpError> {
        let meshes = parts.iter().filter_map(|o| o.as_mesh());
        let meshes: Vec<&Mesh> = meshes.map(Arc::as_ref).collect();
        let bytes: usize = meshes.iter().map(|m| m.bytes()).sum();
        let budget = cx.budget;
        if bytes as u64 > budget {
            let message = format!(
                "the joined mesh needs {} of memory, but the memory budget is {}",
                op::readable_bytes(bytes as u64),
                op::readable_bytes(budget)
            );
            return Err(OpError::Budget(message));
        }
        let mut joined = parts::connected(&meshes, cx)?;
        let mut report = Report::changed(joined.n_faces());
        let (materials, numbers) = attributes::merged_materials(parts);
        joined.set_attributes(attributes::appended(parts, &numbers, &mut report));
        if self.tag_parts {
            attributes::tag_parts(&mut joined, parts, &mut report);
        }
        let object = Object {
            materials,
            ..Object::mesh(&self.name, joined)
        };
        Ok((object, report))
    }

    /// Returns the plan of the result: the element counts and the attributes, as predicted before the run. Each entry
    /// of `parts` contains the plan of a part, and the number of instances of the part in the scene.
    fn joined_plan(&self, parts: &[(MeshPlan, u64)]) -> MeshPlan {
        let mut joined = parts[0].0.clone();
        let none = Range::exactly(0);
        (joined.vertices, joined.edges, joined.faces) = (none, none, none);
        for (part, instances) in parts {
            let counts = [part.vertices, part.edges, part.faces].map(|n| n.by(*instances));
            joined.grow(counts[0], counts[1], counts[2]);
            joined.has_unlisted_attributes |= part.has_unlisted_attributes;
            joined.degrees = joined.degrees.or(part.degrees);
            joined.materials =
                joined
                    .materials
                    .take()
                    .zip(part.materials.clone())
                    .map(|(mut all, of_part)| {
                        all.extend(of_part);
                        all
                    });
            for a in &part.attributes {
                let is_same = |b: &PlannedAttribute| (b.domain, &b.name) == (a.domain, &a.name);
                if !joined.attributes.iter().any(is_same) {
                    joined.attributes.push(a.clone());
                }
            }
        }
        // It is not certain that the result has an attribute if some parts lack this attribute, because the step drops
        // normals that only some parts have.
        let certain =
            |a: &PlannedAttribute| parts.iter().all(|(part, _)| part.attributes.contains(a));
        for attribute in &mut joined.attributes {
            attribute.certain = true;
            attribute.certain = certain(attribute);
        }
        if self.tag_parts {
            for name in &self.objects {
                joined.provide(Domain::Face, name);
            }
        }
        joined
    }
}

/// Returns all instances of the parts: a copy of a part for each node that places this part in the scene. An instance
/// has the name of its part. Returns `None` if no node places any of the parts. The points are in scene space. If a
/// skin is kept, they are instead in bind space, the space in which the skin binds points. If `keeps_morphs` is true,
/// the morph targets are not applied to the points, because the result keeps the default weights of the targets.
fn placed(
    scene: &Scene,
    parts: &[&Object],
    kept: Option<&KeptSkin>,
    keeps_morphs: bool,
    cx: &Context,
) -> Result<Option<Vec<Object>>, OpError> {
    let is_part = |name: &str| parts.iter().any(|part| part.name == name);
    let nodes = scene.graph().nodes().iter();
    if !nodes.filter_map(|node| node.object.as_deref()).any(is_part) {
        return Ok(None);
    }
    let mut instances = scene.instances();
    for instance in instances.iter_mut().filter(|_| keeps_morphs) {
        instance.pose.weights.clear();
    }
    let of_part = |part: &&Object| {
        let name = part.name.clone();
        instances
            .iter()
            .filter(move |instance| instance.object.name == name)
    };
    let instances: Vec<_> = parts.iter().flat_map(of_part).collect();
    let bytes = instances.iter().filter_map(|i| i.object.as_mesh());
    let bytes = bytes.fold(0_u64, |sum, mesh| sum.saturating_add(mesh.bytes() as u64));
    if bytes > cx.budget {
        let message = format!(
            "the instances of the objects need {} of memory, but the memory budget is {}",
            op::readable_bytes(bytes),
            op::readable_bytes(cx.budget)
        );
        return Err(OpError::Budget(message));
    }
    let placed = instances.into_iter().map(|instance| Object {
        name: instance.object.name.clone(),
        ..match kept {
            Some(kept) => kept.bound(instance),
            None => instance.placed(),
        }
    });
    Ok(Some(placed.collect()))
}

fn not_a_mesh(name: &str, kind: &str) -> String {
    format!("Join joins meshes, but the type of \"{name}\" is {kind}")
}

#[cfg(test)]
mod tests;
