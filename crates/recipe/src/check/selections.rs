//! Checks the element ids and the names in selections. Reports elements and materials that a mesh certainly does not
//! have, and objects that do not exist.
//!
//! A selection can be nested in any parameter, so selections are found by their syntax.

use op::{MeshPlan, Plan};
use ron_tree::{Call, Diagnostic, Span, Value, ValueKind};

use super::attributes::meshes;
use super::diagnostic;
use crate::recipe::RecipeStep;
use crate::schema_check::did_you_mean;

/// An element, a material or an object that a selection names.
enum Named<'v> {
    Vertex(u32),
    Face(u32),
    Material(&'v str),
    Object(&'v str),
}

/// Checks the elements, materials and objects that are named in the selections of a step. Reports an element or a
/// material if one of the meshes of the step certainly does not have it. Reports an object if it does not exist.
pub(super) fn missing_elements(step: &RecipeStep, plan: &Plan, found: &mut Vec<Diagnostic>) {
    // If the recipe expects the operation to refuse its input, a missing element can be the expected reason. Therefore
    // no error is reported.
    if plan.incomplete || step.refused.is_some() {
        return;
    }
    let mut named = Vec::new();
    collect(&step.value, &mut named);
    if named.is_empty() {
        return;
    }
    let on = step.on_names();
    let is_target = |object: &str| on.as_ref().is_none_or(|on| on.iter().any(|n| n == object));
    let targets = || meshes(plan.objects()).filter(|(object, _)| is_target(object));
    for (named, span) in named {
        if let Named::Object(name) = named {
            let problem = plan.missing(name, []);
            found.extend(problem.map(|problem| diagnostic(&problem, span)));
            continue;
        }
        let missing = targets().find_map(|(object, mesh)| named.missing_in(object, mesh));
        if let Some((message, help)) = missing {
            let error = Diagnostic::error(span, message);
            found.push(match help {
                Some(help) => error.with_help(help),
                None => error,
            });
        }
    }
}

impl Named<'_> {
    /// Returns an error message if a mesh certainly does not have the element or material. Some of the errors also have
    /// a help text.
    fn missing_in(&self, object: &str, mesh: &MeshPlan) -> Option<(String, Option<String>)> {
        match *self {
            Self::Vertex(number) => mesh.missing_vertex_message(number).map(|m| (m, None)),
            Self::Face(number) => mesh.missing_face_message(number).map(|m| (m, None)),
            Self::Object(_) => None,
            Self::Material(name) => {
                let known = mesh.materials.as_ref()?;
                if known.iter().any(|known| known == name) {
                    return None;
                }
                let message = format!("\"{object}\" has no material named \"{name}\"");
                let help = if known.is_empty() {
                    format!("\"{object}\" has no materials")
                } else {
                    did_you_mean(name, known.iter().map(String::as_str))
                };
                Some((message, Some(help)))
            }
        }
    }
}

/// Collects the elements, materials and objects that are named in the selections inside a value, each with its span.
fn collect<'v>(value: &'v Value, named: &mut Vec<(Named<'v>, Span)>) {
    if let ValueKind::Call(call) = &value.kind {
        match &*call.name.text {
            "Between" => add(call.body.parts(), Named::Vertex, named),
            "Path" => {
                let ends = ["from", "to"].into_iter();
                add(
                    ends.filter_map(|end| call.body.field(end)),
                    Named::Vertex,
                    named,
                );
            }
            "Vertices" => add(listed(call), Named::Vertex, named),
            "Faces" => add(listed(call), Named::Face, named),
            "Material" => add_name(call, Named::Material, named),
            "InsideOf" => add_name(call, Named::Object, named),
            _ => {}
        }
    }
    value.parts().for_each(|part| collect(part, named));
}

/// Adds the name in a call such as `Material("..")` to the list `named`.
fn add_name<'v>(
    call: &'v Call,
    name: fn(&'v str) -> Named<'v>,
    named: &mut Vec<(Named<'v>, Span)>,
) {
    if let Some(value) = call.body.single()
        && let Some(text) = value.as_str()
    {
        named.push((name(text), value.span));
    }
}

/// Adds the elements with these ids to the list `named`.
fn add<'v>(
    numbers: impl Iterator<Item = &'v Value>,
    element: fn(u32) -> Named<'v>,
    named: &mut Vec<(Named<'v>, Span)>,
) {
    for value in numbers {
        if let ValueKind::Number(number) = &value.kind
            && let Some(number) = number.to_int().and_then(|n| u32::try_from(n).ok())
        {
            named.push((element(number), value.span));
        }
    }
}

/// Returns the items of the list in `Name([..])`.
fn listed(call: &Call) -> impl Iterator<Item = &Value> {
    let items = call.body.single().and_then(Value::items);
    items.into_iter().flatten()
}
