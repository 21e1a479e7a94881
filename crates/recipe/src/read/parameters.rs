//! The parameters of a recipe: reads their declarations, sets their values, and inserts the values into the steps.

use std::collections::HashSet;

use super::{Reader, Values};
use crate::params::{Param, Rebase};
use crate::recipe::{Origin, Parameter};
use crate::schema;
use crate::schema_check::did_you_mean;
use crate::substitute::substitute;
use ron_tree::{Diagnostic, Span, Value, ValueKind};

/// A preset, which is a named set of values for parameters.
pub(super) struct Preset {
    pub(super) name: String,
    /// The names of parameters, each with its value in this preset.
    values: Vec<(String, Value)>,
}

impl Reader<'_, '_> {
    /// Reads the declarations. Each parameter gets its default value.
    pub(super) fn declare(&mut self, params: Option<&Value>) {
        for (key, value) in entries(params) {
            let Some(name) = key.as_str() else { continue };
            let Some(param): Option<Param> = self.typed(value, schema::param()) else {
                self.broken.insert(name.to_owned());
                continue;
            };
            match param.default_value() {
                Ok(value) => {
                    let parameter = Parameter {
                        name: name.to_owned(),
                        param,
                        value,
                        origin: Origin::Default,
                    };
                    self.parameters.insert(name.to_owned(), parameter);
                }
                Err(problem) => {
                    let message = format!(
                        "the default value of the parameter `{name}` is not allowed: {problem}"
                    );
                    self.error(value.span, message, "");
                    self.broken.insert(name.to_owned());
                }
            }
        }
    }

    /// Reads all presets, even those that are not chosen, so that their errors are found, too.
    pub(super) fn declare_presets(&mut self, presets: Option<&Value>) {
        for (key, values) in entries(presets) {
            let Some(name) = key.as_str() else { continue };
            let (values, wrong) = self.values_of(values, None);
            self.diagnostics.extend(wrong);
            self.presets.push(Preset {
                name: name.to_owned(),
                values,
            });
        }
    }

    /// Reads `{"name": value}`. Returns the values and the errors.
    pub(super) fn values_of(
        &self,
        values: &Value,
        folders: Option<Rebase>,
    ) -> (Vec<(String, Value)>, Vec<Diagnostic>) {
        let (mut found, mut wrong) = (Vec::new(), Vec::new());
        for (key, value) in entries(Some(values)) {
            let Some(name) = key.as_str() else { continue };
            if self.broken.contains(name) || value.has_errors() {
                continue;
            }
            match self.parameters.get(name) {
                None => wrong.push(self.unknown(name, key.span)),
                Some(parameter) => match parameter.param.value_from(value, folders) {
                    Ok(value) => found.push((name.to_owned(), value)),
                    Err(problem) => {
                        let message = format!(
                            "this value of the parameter `{name}` is not allowed: {problem}"
                        );
                        wrong.push(Diagnostic::error(value.span, message));
                    }
                },
            }
        }
        (found, wrong)
    }

    /// Sets the values of parameters.
    pub(super) fn assign(&mut self, values: &[(String, Value)], origin: &Origin) {
        for (name, value) in values {
            if let Some(parameter) = self.parameters.get_mut(name) {
                (parameter.value, parameter.origin) = (value.clone(), origin.clone());
            }
        }
    }

    /// Sets the parameters to the values of the preset with this name.
    pub(super) fn choose_preset(&mut self, name: Option<&str>) {
        let Some(name) = name else { return };
        if let Some(preset) = self.presets.iter().find(|p| p.name == name) {
            let values = preset.values.clone();
            self.assign(&values, &Origin::Preset(name.to_owned()));
            return;
        }
        let help = if self.presets.is_empty() {
            "the recipe has no presets; declare one with `presets: {\"name\": {\"parameter\": value}}`"
                .to_owned()
        } else {
            did_you_mean(name, self.presets.iter().map(|p| p.name.as_str()))
        };
        let message = format!("the recipe has no preset `{name}`");
        self.diagnostics
            .push(Diagnostic::without_place(message).with_help(help));
    }

    /// Sets the parameters to the values that were passed to `read`.
    pub(super) fn set(&mut self, values: Values) {
        for (name, text) in values.set {
            if self.broken.contains(name) {
                continue;
            }
            let Some(parameter) = self.parameters.get_mut(name) else {
                let unknown = self.unknown(name, Span::default());
                self.diagnostics.push(Diagnostic {
                    span: None,
                    ..unknown
                });
                continue;
            };
            let to = self.source.folder();
            let from = values.folder.unwrap_or(to);
            let store = self.shared.store;
            let folders = Some(Rebase { from, to, store });
            match parameter.param.value_of(text, folders) {
                Ok(value) => {
                    (parameter.value, parameter.origin) = (value, Origin::Set);
                }
                Err(problem) => {
                    let message = format!(
                        "the value that was set for the parameter `{name}` is not allowed: {problem}"
                    );
                    self.diagnostics.push(Diagnostic::without_place(message));
                }
            }
        }
    }

    pub(super) fn unknown(&self, name: &str, span: Span) -> Diagnostic {
        let known = self.parameters.keys().map(String::as_str);
        Diagnostic::error(span, format!("the recipe has no parameter `{name}`"))
            .with_help(did_you_mean(name, known))
    }

    /// Replaces each `arg(..)` in a value by the value of its parameter. Returns whether it was possible to replace
    /// every `arg(..)`.
    pub(super) fn fill(&mut self, value: &mut Value) -> bool {
        let mut used = Vec::new();
        // The spans of the names of parameters that have errors in their declarations. No error is reported at these
        // spans, because the errors in the declarations were already reported.
        let mut reported = Vec::new();
        let resolve = |name: &str, span: Span| {
            if !self.used.contains(name) {
                used.push(name.to_owned());
            }
            if self.broken.contains(name) {
                reported.push(span);
            }
            let found = self.parameters.get(name);
            found
                .map(|p| p.value.clone())
                .ok_or_else(|| Box::new(self.unknown(name, span)))
        };
        let mut wrong = substitute(value, resolve);
        self.used.extend(used);
        let is_whole = wrong.is_empty();
        wrong.retain(|d| d.span.is_none_or(|span| !reported.contains(&span)));
        self.diagnostics.extend(wrong);
        is_whole
    }

    /// Warns about each parameter that is never used: no `arg(..)`, no `If` and no placeholder in a path refers to it.
    /// Does nothing if the recipe has errors, because the parts that could not be read possibly use the parameter.
    pub(super) fn unused(&mut self, params: Option<&Value>) {
        if self.diagnostics.iter().any(Diagnostic::is_error) {
            return;
        }
        let after_braces = self.source.text.split('{').skip(1);
        let placeholders = after_braces.filter_map(|after| after.split_once('.'));
        let placeholders: HashSet<&str> = placeholders.map(|(name, _)| name).collect();
        for (key, _) in entries(params) {
            if let Some(name) = key.as_str()
                && !self.used.contains(name)
                && !placeholders.contains(name)
            {
                let message = format!("the parameter `{name}` is never used");
                let help = format!("use its value in a step with arg(\"{name}\")");
                self.diagnostics
                    .push(Diagnostic::warning(key.span, message).with_help(help));
            }
        }
    }
}

/// Returns the entries of a map. The list is empty if the value is not a map.
fn entries(value: Option<&Value>) -> &[(Value, Value)] {
    match value.map(|v| &v.kind) {
        Some(ValueKind::Map(entries)) => entries,
        _ => &[],
    }
}
