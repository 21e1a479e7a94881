//! The losses that are known before `Save` writes a file. A loss is content of the scene that the file format cannot
//! store.

use std::path::Path;

use mesh::{Domain, joint_of, morph_of};
use mesh_io::{Format, Storage, Stored};
use op::prelude::*;
use op::{Loss, PlannedObject};

use crate::Save;

/// Returns problems if the format cannot store the kind or the number of the objects. Adds the losses that are known
/// before the run to the plan.
pub(crate) fn plan(save: &Save, plan: &mut Plan, cx: &PlanContext) -> Vec<Problem> {
    let format = Format::from_path(Path::new(&save.path));
    let Some(format) = format.filter(|format| format.can_write()) else {
        return Vec::new();
    };
    let is_written = |o: &&PlannedObject| cx.on.is_none_or(|on| on.contains(&o.name));
    let objects: Vec<&PlannedObject> = plan.objects().iter().filter(is_written).collect();
    let mut problems = Vec::new();
    for object in &objects {
        let refused = format.refused_kind(object.geometry.kind());
        let message = refused.map(|why| format!("object `{}`: {why}", object.name));
        problems.extend(message.map(|message| Problem::error(message).at(["path"])));
    }
    if !plan.incomplete && !objects.is_empty() {
        let refused = format.refused_count(objects.len());
        problems.extend(refused.map(|message| Problem::error(message).at(["path"])));
    }
    let mut losses = Losses::default();
    if !format.has_nodes() {
        graph_losses(plan, &objects, cx.on.is_none(), &mut losses);
    }
    let n: u64 = objects.iter().map(|o| plan.instances(&o.name)).sum();
    if n > 1 && !format.keeps_names() {
        let first = objects.first().map_or("", |o| &o.name);
        let reason = format!("{format} files store one object");
        losses.certain(Loss::part(first, "name", "the names of objects", reason));
    }
    for object in &objects {
        if let PlannedGeometry::Mesh(mesh) = &object.geometry {
            let writing = Writing { save, format };
            writing.mesh(&object.name, mesh, &mut losses);
        }
    }
    plan.losses.extend(losses.certain);
    plan.possible_losses.extend(losses.possible);
    problems
}

/// The certain and the possible losses of a step.
#[derive(Default)]
struct Losses {
    certain: Vec<Loss>,
    possible: Vec<Loss>,
}

impl Losses {
    fn certain(&mut self, loss: Loss) {
        self.add(true, loss);
    }

    fn add(&mut self, is_certain: bool, loss: Loss) {
        if is_certain {
            self.certain.push(loss);
        } else {
            self.possible.push(loss);
        }
    }
}

/// Adds the losses of nodes, cameras, lights, skins and animations, for a format that cannot store nodes. `all` says
/// whether all objects are written. If so, the losses are certain. Otherwise, it is uncertain whether the written
/// objects need these parts of the scene, so the losses are added as possible losses.
fn graph_losses(plan: &Plan, objects: &[&PlannedObject], all: bool, losses: &mut Losses) {
    let graph = plan.graph();
    let unplaced: u64 = objects.iter().map(|o| o.unplaced_nodes).sum();
    let nodes = graph.nodes().len() as u64 + unplaced;
    for (name, count) in [
        ("nodes", nodes),
        ("cameras", graph.cameras.len() as u64),
        ("lights", graph.lights.len() as u64),
        ("skins", graph.skins.len() as u64),
        ("animations", graph.animations.len() as u64),
    ] {
        if count > 0 {
            let what = format!("\"{name}\" ({count})");
            let loss = Loss::part("", name, what, format!("the format has no {name}"));
            let count = Some(count);
            losses.add(all, Loss { count, ..loss });
        }
    }
}

/// The step `Save` with its options, and the format of the output file.
struct Writing<'a> {
    save: &'a Save,
    format: Format,
}

impl Writing<'_> {
    /// Adds the losses that occur when the mesh of the object is written.
    fn mesh(&self, object: &str, mesh: &MeshPlan, losses: &mut Losses) {
        let format = self.format;
        if format.has_only_triangles() && mesh.degrees.max > 3 && mesh.faces.max > 0 {
            let is_certain = mesh.degrees.min > 3 && mesh.faces.min > 0;
            let reason = format!("{format} stores only triangles, so polygons are triangulated");
            losses.add(
                is_certain,
                Loss::part(object, "polygon", "polygons", reason),
            );
        }
        if format == Format::Stl && mesh.vertices.max > 0 {
            let reason = "STL stores 32-bit coordinates of the corners of triangles";
            let what = "digits of positions, coincident vertices or vertices without a face";
            losses.add(false, Loss::part(object, "position", what, reason));
        }
        self.materials(object, mesh, losses);
        self.attributes(object, mesh, losses);
    }

    fn materials(&self, object: &str, mesh: &MeshPlan, losses: &mut Losses) {
        let format = self.format;
        let reason = format!("{format} cannot store materials");
        match &mesh.materials {
            Some(names) if !format.has_materials() && !names.is_empty() => {
                losses.certain(Loss::part(object, "materials", "its materials", reason));
            }
            None if !format.has_materials() => {
                losses.add(
                    false,
                    Loss::part(object, "materials", "its materials", reason),
                );
            }
            Some(names) if matches!(format, Format::Obj | Format::Gltf | Format::Glb) => {
                for name in names {
                    let what = format!("parts of the material \"{name}\"");
                    let loss =
                        Loss::part(object, name, what, "the format cannot store all materials");
                    let code = "material-changed".to_owned();
                    losses.add(false, Loss { code, ..loss });
                }
            }
            _ => {}
        }
    }

    fn attributes(&self, object: &str, mesh: &MeshPlan, losses: &mut Losses) {
        let has = |domain, name: &str| {
            let mut attributes = mesh.attributes.iter();
            attributes.any(|a| a.domain == domain && a.name == name)
        };
        let table = Stored {
            format: self.format,
            rows: self.save.rows.unwrap_or_default(),
            has: &has,
        };
        let name = table.name();
        let (mut joints, mut morphs) = (Vec::new(), Vec::new());
        for attribute in &mesh.attributes {
            let storage = table.storage(attribute.domain, &attribute.name, None);
            if attribute.domain == Domain::Vertex && joint_of(&attribute.name).is_some() {
                joints.push((storage, attribute.certain));
            } else if attribute.domain == Domain::Vertex && morph_of(&attribute.name).is_some() {
                morphs.push((storage, attribute.certain));
            } else if storage != Storage::Kept {
                let reason = match storage {
                    Storage::Lost => format!("{name} cannot store it"),
                    _ => format!("{name} cannot store all such values"),
                };
                let loss = Loss::attribute(object, attribute.domain, &attribute.name, reason);
                losses.add(attribute.certain && storage == Storage::Lost, loss);
            }
        }
        for (part, list) in [("joint weights", &joints), ("morph targets", &morphs)] {
            let n = list.iter().filter(|(s, _)| *s != Storage::Kept).count();
            let is_certain =
                |(storage, certain): &(Storage, bool)| *certain && *storage == Storage::Lost;
            if n > 0 {
                let what = format!("\"{part}\" ({n})");
                let reason = format!("{name} cannot store all {part}");
                let loss = Loss::part(object, part, what, reason);
                losses.add(list.iter().any(is_certain), loss);
            }
        }
        let sets = self.save.weight_sets.map_or(1, Count::get);
        let most = 4 * sets as usize;
        if self.format.packs() && joints.len() > most {
            let what = format!(
                "the smallest joint weights of vertices that have more than {most} weights"
            );
            let reason = "`weight_sets` determines the number of joints that are written";
            losses.add(false, Loss::part(object, "influences", what, reason));
        }
        if mesh.has_unlisted_attributes && !matches!(self.format, Format::Mws | Format::Npz) {
            let what = "attributes that are known only when the step runs";
            let reason = format!("{name} cannot store all attributes");
            losses.add(false, Loss::part(object, "attributes", what, reason));
        }
    }
}
