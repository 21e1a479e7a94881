//! The parameters of a text: declared, given values, and filled in.

use super::{Reader, Values};
use crate::params::{Move, Param};
use crate::recipe::{Origin, Parameter};
use crate::schema;
use crate::shape::did_you_mean;
use crate::substitute::substitute;
use ron_tree::{Diagnostic, Span, Value, ValueKind};

/// Values for some parameters, under one name.
pub(super) struct Preset {
    /// Its name.
    pub(super) name: String,
    /// Names of parameters and their values.
    values: Vec<(String, Value)>,
}

impl Reader<'_, '_> {
    /// Reads the declarations; each parameter has its default.
    pub(super) fn declare(&mut self, params: Option<&Value>) {
        for (key, value) in entries(params) {
            let Some(name) = key.as_str() else { continue };
            let Some(param): Option<Param> = self.typed(value, schema::param()) else {
                self.broken.push(name.to_owned());
                continue;
            };
            match param.default_value() {
                Ok(value) => self.parameters.push(Parameter {
                    name: name.to_owned(),
                    param,
                    value,
                    origin: Origin::Default,
                }),
                Err(problem) => {
                    let message = format!("the default of `{name}` is not allowed: {problem}");
                    self.error(value.span, message, "");
                    self.broken.push(name.to_owned());
                }
            }
        }
    }

    /// Reads the presets, all of them, whichever is chosen.
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

    /// The values of `{"name": value}`, and what is wrong with them.
    pub(super) fn values_of(
        &self,
        values: &Value,
        folders: Option<Move>,
    ) -> (Vec<(String, Value)>, Vec<Diagnostic>) {
        let (mut found, mut wrong) = (Vec::new(), Vec::new());
        for (key, value) in entries(Some(values)) {
            let Some(name) = key.as_str() else { continue };
            if self.broken.iter().any(|b| b == name) || value.has_errors() {
                continue;
            }
            match self.parameters.iter().find(|p| p.name == name) {
                None => wrong.push(self.unknown(name, key.span)),
                Some(parameter) => match parameter.param.value_from(value, folders) {
                    Ok(value) => found.push((name.to_owned(), value)),
                    Err(problem) => {
                        let message = format!("this value of `{name}` is not allowed: {problem}");
                        wrong.push(Diagnostic::error(value.span, message));
                    }
                },
            }
        }
        (found, wrong)
    }

    /// Gives parameters values.
    pub(super) fn assign(&mut self, values: &[(String, Value)], origin: &Origin) {
        for (name, value) in values {
            if let Some(parameter) = self.parameters.iter_mut().find(|p| p.name == *name) {
                (parameter.value, parameter.origin) = (value.clone(), origin.clone());
            }
        }
    }

    /// Takes the values of one of the presets.
    pub(super) fn choose_preset(&mut self, name: Option<&str>) {
        let Some(name) = name else { return };
        if let Some(preset) = self.presets.iter().find(|p| p.name == name) {
            let values = preset.values.clone();
            self.assign(&values, &Origin::Preset(name.to_owned()));
            return;
        }
        let help = if self.presets.is_empty() {
            "it has none; `presets: {\"name\": {\"parameter\": value}}` makes one".to_owned()
        } else {
            did_you_mean(name, self.presets.iter().map(|p| p.name.as_str()))
        };
        let message = format!("the recipe has no preset `{name}`");
        self.diagnostics
            .push(Diagnostic::without_place(message).with_help(help));
    }

    /// Takes the values that are set from outside.
    pub(super) fn set(&mut self, values: Values) {
        for (name, text) in values.set {
            if self.broken.contains(name) {
                continue;
            }
            let Some(parameter) = self.parameters.iter_mut().find(|p| p.name == *name) else {
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
            let folders = Some(Move { from, to, store });
            match parameter.param.value_of(text, folders) {
                Ok(value) => {
                    (parameter.value, parameter.origin) = (value, Origin::Set);
                }
                Err(problem) => {
                    let message = format!("the value set for `{name}` is not allowed: {problem}");
                    self.diagnostics.push(Diagnostic::without_place(message));
                }
            }
        }
    }

    pub(super) fn unknown(&self, name: &str, span: Span) -> Diagnostic {
        let known = self.parameters.iter().map(|p| p.name.as_str());
        Diagnostic::error(span, format!("the recipe has no parameter `{name}`"))
            .with_help(did_you_mean(name, known))
    }

    /// Fills parameters in. Returns whether all of them have values.
    pub(super) fn fill(&mut self, value: &mut Value) -> bool {
        let mut used = Vec::new();
        // The declarations of these were reported already.
        let mut reported = Vec::new();
        let resolve = |name: &str, span: Span| {
            if !self.used.contains(name) {
                used.push(name.to_owned());
            }
            if self.broken.iter().any(|b| b == name) {
                reported.push(span);
            }
            let found = self.parameters.iter().find(|p| p.name == name);
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

    /// Warns of parameters that neither an `arg(..)`, an `If` nor a placeholder in a path names. Says
    /// nothing beside errors: one of them may be the use.
    pub(super) fn unused(&mut self, params: Option<&Value>) {
        if self.diagnostics.iter().any(Diagnostic::is_error) {
            return;
        }
        for (key, _) in entries(params) {
            if let Some(name) = key.as_str()
                && !self.used.contains(name)
                && !self.source.text.contains(&format!("{{{name}."))
            {
                let message = format!("the parameter `{name}` is never used");
                let help = format!("a step takes its value with arg(\"{name}\")");
                self.diagnostics
                    .push(Diagnostic::warning(key.span, message).with_help(help));
            }
        }
    }
}

/// The entries of a map; none if it is no map.
fn entries(value: Option<&Value>) -> &[(Value, Value)] {
    match value.map(|v| &v.kind) {
        Some(ValueKind::Map(entries)) => entries,
        _ => &[],
    }
}
