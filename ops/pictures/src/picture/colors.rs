//! Checks the parameter `color_by`, and reads the file that it names.

use mesh::Mesh;
use mesh_io::ReadOptions;
use op::{Context, OpError, Plan, PlanContext, PlannedGeometry, Problem};
use scene::Scene;
use view::{ColorBy, Quantity, existing_attributes, missing_attribute};

/// Returns the problems with the parameter `color_by`. If `color_by` names a file, adds this file to the input files of
/// the plan.
pub(crate) fn plan(by: &ColorBy, plan: &mut Plan, cx: &PlanContext) -> Vec<Problem> {
    let mut problems = Vec::new();
    if let Some([low, high]) = by.range
        && !(low.is_finite() && high.is_finite() && low < high)
    {
        let message =
            format!("expected two finite numbers, the lower one first, found {low} and {high}");
        problems.push(Problem::error(message).at(["color_by", "range"]));
    }
    match &by.of {
        Quantity::DistanceTo(path) => {
            let full = cx.files.to_read(path);
            let peek = mesh_io::peek(&*cx.files.store, &full, &ReadOptions::default());
            if let Err(error) = peek {
                problems.push(Problem::error(error.to_string()).at(["color_by", "of"]));
            }
            plan.inputs.push(full);
        }
        Quantity::Attribute { name, .. } if !plan.incomplete => {
            let mut names = Vec::new();
            for object in plan.objects() {
                if let PlannedGeometry::Mesh(mesh) = &object.geometry {
                    if mesh.has_unlisted_attributes {
                        return problems;
                    }
                    names.extend(mesh.attributes.iter().map(|a| a.name.as_str()));
                }
            }
            if !names.contains(&name.as_str()) {
                let error = Problem::error(missing_attribute(name)).at(["color_by", "of"]);
                problems.push(error.help(existing_attributes(names)));
            }
        }
        _ => {}
    }
    problems
}

/// Reads the meshes to which [`Quantity::DistanceTo`] measures distances.
pub(crate) fn distance_targets(by: &ColorBy, cx: &Context) -> Result<Vec<Mesh>, OpError> {
    let Quantity::DistanceTo(path) = &by.of else {
        return Ok(Vec::new());
    };
    let full = cx.files().to_read(path);
    let loaded = mesh_io::read(&*cx.files().store, &full, &ReadOptions::default());
    let loaded = loaded.map_err(|error| OpError::File(error.to_string()))?;
    for file in loaded.files {
        cx.files().has_used(file.path, file.is_read);
    }
    let mut scene = Scene::new();
    let appended = scene.append(loaded.objects, loaded.graph);
    appended.map_err(|error| OpError::File(error.to_string()))?;
    let placed = crate::picture::placed(&scene, cx)?;
    let meshes: Vec<Mesh> = (placed.objects().iter())
        .filter_map(|object| object.as_mesh().map(|mesh| (**mesh).clone()))
        .filter(|mesh| mesh.n_faces() > 0)
        .collect();
    if meshes.is_empty() {
        let message = format!("expected a mesh with faces in {path}, found none");
        return Err(OpError::File(message));
    }
    Ok(meshes)
}
