//! Checks the attributes of meshes before and after each step. The meshes must have the attributes that a step needs,
//! and a step must not lose attributes unless `on_loss` allows it.
//!
//! The plan of a step predicts which attributes each mesh has after the step. A step certainly loses an attribute of a
//! mesh if the mesh certainly has the attribute before the step, and the plan does not contain it. A mesh lacks an
//! attribute if all attributes of the mesh are known, and this attribute is not one of them.

use std::collections::HashMap;

use mesh::Domain;
use op::{Loss, MeshPlan, Plan, PlannedAttribute, PlannedGeometry, PlannedObject};

use crate::expect::Expectation;
use crate::recipe::{OnLoss, RecipeExpectation, RecipeStep};
use crate::schema_check::did_you_mean;
use ron_tree::{Diagnostic, Span, Value, ValueKind};

/// The attributes that were dropped by the steps checked so far.
#[derive(Debug, Default)]
pub(super) struct Attributes {
    dropped: Vec<DroppedAttribute>,
}

#[derive(Debug)]
struct DroppedAttribute {
    object: String,
    domain: Domain,
    name: String,
    /// The label of the step that dropped the attribute.
    step: String,
}

/// For each mesh whose attributes are known: the name of the object and the list of attributes.
pub(super) type KnownAttributes = Vec<(String, Vec<PlannedAttribute>)>;

fn key(attribute: &PlannedAttribute) -> (Domain, &str) {
    (attribute.domain, &attribute.name)
}

impl Attributes {
    /// Adds the certain losses of a step to the list `losses`, and its possible losses to the list `possible`. Also
    /// records the attributes that are certainly lost: if one of them is missing later, the help text names the step
    /// that dropped it.
    pub(super) fn losses(
        &mut self,
        step: &RecipeStep,
        before: &KnownAttributes,
        plan: &Plan,
        losses: &mut Vec<Loss>,
        possible: &mut Vec<Loss>,
    ) {
        for (object, had) in before {
            // If the step removes the whole object, the removal is deliberate, so the attributes of the object do not
            // count as lost.
            let Some(PlannedGeometry::Mesh(mesh)) = plan.object(object).map(|o| &o.geometry) else {
                continue;
            };
            if mesh.attributes == *had {
                continue;
            }
            let kept = mesh.attributes.iter().map(|a| (key(a), a.certain));
            let kept: HashMap<(Domain, &str), bool> = kept.collect();
            for lost in had {
                let kept = kept.get(&key(lost));
                if kept.is_some_and(|is_certain| *is_certain || !lost.certain) {
                    continue;
                }
                let reason = format!("{} cannot preserve it", step.name);
                let loss = Loss::attribute(object, lost.domain, &lost.name, reason);
                if kept.is_some() || !lost.certain {
                    possible.push(loss);
                    continue;
                }
                losses.push(loss);
                self.dropped.push(DroppedAttribute {
                    object: object.clone(),
                    domain: lost.domain,
                    name: lost.name.clone(),
                    step: step.label().to_owned(),
                });
            }
        }
    }

    /// Reports errors in the selections of a step. A `Tagged(..)` or a `Where(..)` is an error if one of the meshes
    /// certainly does not have the named tag or attribute. A `Where(..)` without `above` and `below` is an error, too.
    pub(super) fn needs(&self, step: &RecipeStep, plan: &Plan, found: &mut Vec<Diagnostic>) {
        // If the recipe expects the operation to refuse its input, a missing tag can be the expected reason. Therefore
        // no error is reported.
        if plan.incomplete || step.refused.is_some() {
            return;
        }
        let mut names = Vec::new();
        needed(&step.value, &mut names);
        let on = step.on_names();
        for need in names {
            if need.is_unbounded {
                let error = Diagnostic::error(need.span, "`Where` has no bound");
                found.push(error.with_help("add `above`, `below` or both"));
            }
            let name = need.name;
            if let Some((object, help)) = self.lacking(plan, on.as_deref(), None, name) {
                let message = if need.is_tag {
                    format!("no element of \"{object}\" is tagged \"{name}\"")
                } else {
                    format!("\"{object}\" has no attribute \"{name}\" before this step")
                };
                found.push(Diagnostic::error(need.span, message).with_help(help));
            }
        }
    }

    /// Reports an error for an expectation about an attribute that cannot exist at this point of the recipe.
    pub(super) fn expected(
        &self,
        placed: &RecipeExpectation,
        plan: &Plan,
        found: &mut Vec<Diagnostic>,
    ) {
        let (domain, name) = match &placed.that {
            Expectation::HasAttribute { domain, name } => (Some(Domain::from(*domain)), name),
            Expectation::Attribute { name, .. } => (None, name),
            _ => return,
        };
        if plan.incomplete {
            return;
        }
        let lacking = self.lacking(plan, placed.on.as_deref(), domain, name);
        if let Some((object, help)) = lacking {
            let kind = domain.map_or(String::new(), |domain| format!("{domain} "));
            let message = format!(
                "\"{object}\" has no {kind}attribute \"{name}\" at this point of the recipe"
            );
            found.push(Diagnostic::error(placed.span, message).with_help(help));
        }
    }

    /// Returns the first object in `on` that cannot have the attribute, and a help text.
    fn lacking<'p>(
        &self,
        plan: &'p Plan,
        on: Option<&[String]>,
        domain: Option<Domain>,
        name: &str,
    ) -> Option<(&'p str, String)> {
        let has = |a: &PlannedAttribute| a.name == name && domain.is_none_or(|d| a.domain == d);
        let lacks = |(object, mesh): &(&str, &MeshPlan)| {
            on.is_none_or(|on| on.iter().any(|name| name == object))
                && !mesh.has_unlisted_attributes
                && !mesh.attributes.iter().any(has)
        };
        let (object, mesh) = meshes(plan.objects()).find(lacks)?;
        Some((object, self.help(object, domain, name, mesh)))
    }

    /// Returns the help text for a missing attribute. The help text names the step that dropped the attribute or, if no
    /// step dropped it, an attribute with a similar name.
    fn help(&self, object: &str, domain: Option<Domain>, name: &str, mesh: &MeshPlan) -> String {
        let is_missing = |d: &&DroppedAttribute| {
            d.object == object && d.name == name && domain.is_none_or(|domain| d.domain == domain)
        };
        if let Some(dropped) = self.dropped.iter().rev().find(is_missing) {
            return format!("the step {} dropped \"{name}\"", dropped.step);
        }
        let attributes = mesh.attributes.iter();
        let attributes = attributes.filter(|a| domain.is_none_or(|domain| a.domain == domain));
        let mut names: Vec<&str> = attributes.map(|a| a.name.as_str()).collect();
        names.dedup();
        if names.is_empty() {
            return format!("no earlier step creates \"{name}\"");
        }
        did_you_mean(name, names)
    }
}

/// Returns the error for a loss that `on_loss` does not allow.
pub(crate) fn forbidden(step: &RecipeStep, loss: &Loss) -> Diagnostic {
    let (what, object, name) = (&loss.what, &loss.object, &loss.name);
    let lost = if loss.reason.is_empty() && !object.is_empty() && what.starts_with(object.as_str())
    {
        what.clone()
    } else {
        let object = match object.as_str() {
            "" => "the scene".to_owned(),
            object => format!("\"{object}\""),
        };
        format!("{} loses {what} of {object}", step.name)
    };
    let message = format!("{lost}, and `on_loss` does not allow it");
    let help = match &step.on_loss {
        OnLoss::Allow(names) => {
            let names = names.iter().chain([name]);
            let names: Vec<String> = names.map(|name| format!("{name:?}")).collect();
            format!("allow it with `on_loss: Allow([{}])`", names.join(", "))
        }
        _ => format!("allow it with `on_loss: Allow([{name:?}])`"),
    };
    Diagnostic::error(step.span, message).with_help(help)
}

/// Returns the warning for a possible loss that `on_loss` does not allow.
pub(super) fn may_fail(step: &RecipeStep, loss: &Loss) -> Diagnostic {
    let message = format!(
        "{}, and `on_loss` does not allow it",
        loss.possible_message()
    );
    let help = format!(
        "if the loss of {name:?} is acceptable, add {name:?} to `on_loss: Allow([..])`",
        name = loss.name
    );
    Diagnostic::warning(step.span, message).with_help(help)
}

#[cfg(test)]
thread_local! {
    /// The number of objects that the checks on this thread have visited so far.
    pub(crate) static VISITED: std::cell::Cell<usize> = const { std::cell::Cell::new(0) };
}

/// Returns the objects that are meshes, with their names.
pub(super) fn meshes(objects: &[PlannedObject]) -> impl Iterator<Item = (&str, &MeshPlan)> {
    let objects = objects.iter();
    #[cfg(test)]
    let objects = objects.inspect(|_| VISITED.set(VISITED.get() + 1));
    objects.filter_map(|object| match &object.geometry {
        PlannedGeometry::Mesh(mesh) => Some((object.name.as_str(), mesh)),
        _ => None,
    })
}

/// An attribute or a tag that a selection names.
struct Needed<'v> {
    name: &'v str,
    span: Span,
    is_tag: bool,
    /// Whether the selection is a `Where` that has neither `above` nor `below`.
    is_unbounded: bool,
}

/// Collects the names in every `Tagged("..")` and every `Where(attribute: "..")` inside a value, each with its span.
fn needed<'v>(value: &'v Value, names: &mut Vec<Needed<'v>>) {
    if let ValueKind::Call(call) = &value.kind {
        let (is_tag, field) = match &*call.name.text {
            "Tagged" => (true, call.body.single()),
            "Where" => (false, call.body.field("attribute")),
            _ => (false, None),
        };
        if let Some(name) = field.and_then(Value::as_str) {
            let has_bound = ["above", "below"].map(|bound| call.body.field(bound).is_some());
            names.push(Needed {
                name,
                span: value.span,
                is_tag,
                is_unbounded: !is_tag && has_bound == [false; 2],
            });
        }
    }
    value.parts().for_each(|part| needed(part, names));
}
