//! Reads the expectations of a recipe.

use super::Reader;
use super::steps::explain_outer_fields;
use crate::expect::Expectation;
use crate::recipe::RecipeExpectation;
use crate::schema;
use crate::schema_check::{check_schema, did_you_mean};
use ron_tree::{Span, Value, ValueKind};

impl Reader<'_, '_> {
    /// Reads either `Name(..)` or `(after: "id", on: [..], that: ..)`, where `that` is an expectation or a list of
    /// expectations. Returns the id of the step after which the expectations are checked, and the expectations. The id
    /// is `None` if they are checked at the end of the recipe.
    pub(super) fn expectation(
        &mut self,
        mut value: Value,
    ) -> (Option<String>, Vec<RecipeExpectation>) {
        if !self.fill(&mut value) {
            return (None, Vec::new());
        }
        if !matches!(value.kind, ValueKind::Struct(_) | ValueKind::Unit) {
            return (None, self.placed(&value, None).into_iter().collect());
        }
        let wrong = check_schema(&value, &schema::expectation_envelope());
        self.diagnostics.extend(wrong);
        let after = value
            .field("after")
            .and_then(|id| Some((id.span, id.as_str()?)));
        if let Some((span, id)) = after
            && !self.ids.contains(id)
        {
            let help = did_you_mean(id, self.ids.iter().map(String::as_str));
            self.error(span, format!("no step has the id \"{id}\""), help);
            return (None, Vec::new());
        }
        let on = value.field("on").and_then(|on| {
            let names = on.items()?.iter().filter_map(Value::as_str);
            Some((on.span, names.map(str::to_owned).collect::<Vec<_>>()))
        });
        let Some(that) = value.field("that") else {
            return (None, Vec::new());
        };
        let items = that.items().unwrap_or(std::slice::from_ref(that));
        let placed = items
            .iter()
            .filter_map(|item| self.placed(item, on.clone()))
            .collect();
        (after.map(|(_, id)| id.to_owned()), placed)
    }

    fn placed(
        &mut self,
        value: &Value,
        on: Option<(Span, Vec<String>)>,
    ) -> Option<RecipeExpectation> {
        let before = self.diagnostics.len();
        let that = self.typed(value, schema::expectation());
        let wrong = &mut self.diagnostics[before..];
        explain_outer_fields(wrong, value, &schema::expectation_envelope(), "that");
        let that: Expectation = that?;
        if let Some(problem) = that.problem() {
            let help = match that.output() {
                Some(_) => "remove `tolerance`",
                None => "add a bound, such as `eq`, `min` or `max`",
            };
            self.error(value.span, problem, help);
            return None;
        }
        if let (Some((span, _)), Some(name)) = (&on, that.without_objects()) {
            let message = format!("{name} does not take `on`");
            self.error(
                *span,
                message,
                "this expectation checks the whole scene or a file, not single objects",
            );
            return None;
        }
        Some(RecipeExpectation {
            after: None,
            on: on.map(|(_, names)| names),
            that,
            scope: self.scope,
            span: value.span,
        })
    }
}
