//! The flow of attributes: what a step needs is there, and what it loses may be lost.
//!
//! The plan of each step says which attributes it keeps, provides and drops. What a mesh has for certain
//! before a step and not after it is lost; what no step has made, on a mesh that has nothing else, is
//! missing.

use std::collections::HashSet;

use mesh::Domain;
use op::{Loss, MeshPlan, Plan, PlannedAttribute, PlannedGeometry, PlannedObject};

use crate::expect::Expectation;
use crate::recipe::{OnLoss, RecipeExpectation, RecipeStep};
use crate::shape::did_you_mean;
use ron_tree::{Diagnostic, Span, Value, ValueKind};

/// What steps have dropped so far.
#[derive(Debug, Default)]
pub(super) struct Attributes {
    dropped: Vec<Dropped>,
}

#[derive(Debug)]
struct Dropped {
    object: String,
    domain: Domain,
    name: String,
    /// The label of the step.
    step: String,
}

/// The certain attributes of each mesh.
pub(super) type Before = Vec<(String, Vec<PlannedAttribute>)>;

fn key(attribute: &PlannedAttribute) -> (Domain, &str) {
    (attribute.domain, &attribute.name)
}

impl Attributes {
    /// Reports what a step loses for certain and may not lose.
    pub(super) fn losses(
        &mut self,
        step: &RecipeStep,
        before: &Before,
        plan: &Plan,
        found: &mut Vec<Diagnostic>,
    ) {
        for (object, had) in before {
            // An object that is gone was taken away, and not by accident.
            let Some(PlannedGeometry::Mesh(mesh)) = plan.object(object).map(|o| &o.geometry) else {
                continue;
            };
            if mesh.attributes == *had {
                continue;
            }
            let kept: HashSet<(Domain, &str)> = mesh.attributes.iter().map(key).collect();
            let is_lost = |a: &&PlannedAttribute| !kept.contains(&key(a));
            for lost in had.iter().filter(is_lost) {
                let loss = Loss::attribute(object, lost.domain, &lost.name, "");
                if !step.on_loss.allows(&lost.name) {
                    found.push(forbidden(step, &loss));
                }
                self.dropped.push(Dropped {
                    object: object.clone(),
                    domain: lost.domain,
                    name: lost.name.clone(),
                    step: step.label().to_owned(),
                });
            }
        }
    }

    /// Reports tags that a step selects by and that are on no element for certain.
    pub(super) fn needs(&self, step: &RecipeStep, plan: &Plan, found: &mut Vec<Diagnostic>) {
        // What must be refused may well lack something.
        if plan.incomplete || step.refused.is_some() {
            return;
        }
        let mut tags = Vec::new();
        tagged(&step.value, &mut tags);
        let on = step.on_names();
        for (tag, span) in tags {
            if let Some((object, help)) = self.lacking(plan, on.as_deref(), None, tag) {
                let message = format!("nothing of \"{object}\" is tagged \"{tag}\"");
                found.push(Diagnostic::error(span, message).with_help(help));
            }
        }
    }

    /// Reports an expected attribute that cannot be there.
    pub(super) fn expected(
        &self,
        placed: &RecipeExpectation,
        plan: &Plan,
        found: &mut Vec<Diagnostic>,
    ) {
        let Expectation::HasAttribute { domain, name } = &placed.that else {
            return;
        };
        let domain = Domain::from(*domain);
        if plan.incomplete {
            return;
        }
        let lacking = self.lacking(plan, placed.on.as_deref(), Some(domain), name);
        if let Some((object, help)) = lacking {
            let message = format!("\"{object}\" has no {domain} attribute \"{name}\" here");
            found.push(Diagnostic::error(placed.span, message).with_help(help));
        }
    }

    /// The first of the objects that are meant that cannot have an attribute, with advice.
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

    /// Who dropped it, or else what it may have been meant to be.
    fn help(&self, object: &str, domain: Option<Domain>, name: &str, mesh: &MeshPlan) -> String {
        let is_it = |d: &&Dropped| {
            d.object == object && d.name == name && domain.is_none_or(|domain| d.domain == domain)
        };
        if let Some(dropped) = self.dropped.iter().rev().find(is_it) {
            return format!("the step {} has dropped it", dropped.step);
        }
        let here = mesh.attributes.iter();
        let here = here.filter(|a| domain.is_none_or(|domain| a.domain == domain));
        let mut names: Vec<&str> = here.map(|a| a.name.as_str()).collect();
        names.dedup();
        if names.is_empty() {
            return "no step before has made one".to_owned();
        }
        did_you_mean(name, names)
    }
}

/// The error for a loss that a step may not have.
pub(crate) fn forbidden(step: &RecipeStep, loss: &Loss) -> Diagnostic {
    let (what, object, name) = (&loss.what, &loss.object, &loss.name);
    let message = format!(
        "{} loses {what} of \"{object}\", and `on_loss` does not allow it",
        step.name
    );
    let help = match &step.on_loss {
        OnLoss::Allow(names) => {
            let names = names.iter().chain([name]);
            let names: Vec<String> = names.map(|name| format!("{name:?}")).collect();
            format!("`on_loss: Allow([{}])` lets it go", names.join(", "))
        }
        _ => format!("`on_loss: Allow([{name:?}])` lets it go"),
    };
    Diagnostic::error(step.span, message).with_help(help)
}

/// The meshes among some objects, with their names.
pub(super) fn meshes(objects: &[PlannedObject]) -> impl Iterator<Item = (&str, &MeshPlan)> {
    objects.iter().filter_map(|object| match &object.geometry {
        PlannedGeometry::Mesh(mesh) => Some((object.name.as_str(), mesh)),
        _ => None,
    })
}

/// The names in `Tagged("..")` anywhere in a value, and their places.
fn tagged<'v>(value: &'v Value, tags: &mut Vec<(&'v str, Span)>) {
    if let ValueKind::Call(call) = &value.kind
        && &*call.name.text == "Tagged"
        && let Some(name) = call.body.single().and_then(Value::as_str)
    {
        tags.push((name, value.span));
    }
    value.parts().for_each(|part| tagged(part, tags));
}
