//! Checks enumerations in which a value can omit the name of the variant. The name can be omitted if the content fits
//! exactly one variant. The schema of these enumerations has the keyword `x-shorthand`. An example is [`op::Elements`].
//!
//! ```text
//! Sharp(above: 30)   exists only for edges                ---> Edges(Sharp(above: 30))
//! Boundary           exists for vertices, edges, faces    ---> an error: the kind must be specified
//! ```

use std::borrow::Cow;
use std::cmp::Reverse;

use super::schema::{Choice, Schema};
use super::{Checker, Place, Rename, did_you_mean};
use ron_tree::{Call, Diagnostic, Name, Span, Value, ValueKind};

/// A value that is written without the name of its variant.
#[derive(Clone, Debug)]
pub(super) struct Short {
    /// The span of the value.
    span: Span,
    /// The name that was omitted.
    name: Box<str>,
}

impl Checker {
    /// Checks a value that is either a variant, or the content of a variant whose name was omitted.
    pub(super) fn check_shorthand(
        &mut self,
        value: &Value,
        schema: &Schema,
        choice: &Choice,
        place: Place,
    ) {
        let mut whole = Self::default();
        whole.check_variant(value, schema, choice, place);
        if whole.diagnostics.is_empty() {
            return self.take(whole);
        }
        let mut trials = Vec::new();
        for name in choice.names() {
            if let Some(content) = choice.content(name) {
                let mut trial = Self::default();
                trial.check(value, &content, place);
                trials.push((name, content, trial));
            }
        }
        let fitting: Vec<&str> = (trials.iter())
            .filter(|(_, _, trial)| trial.diagnostics.is_empty())
            .map(|(name, ..)| *name)
            .collect();
        match fitting[..] {
            [one] => {
                let place = trials.iter().position(|(name, ..)| *name == one);
                let (_, _, trial) =
                    trials.swap_remove(place.expect("the name comes from `trials`"));
                self.take(trial);
                let (span, name) = (value.span, one.into());
                self.shorts.push(Short { span, name });
            }
            [] if value.name().is_some_and(|(name, _)| choice.has(name)) => self.take(whole),
            [] => self.take_closest(value, trials),
            _ => {
                let words: Vec<String> = fitting.iter().map(|name| name.to_lowercase()).collect();
                let message = format!(
                    "this selection can select {}: specify which",
                    words.join(" or ")
                );
                let full: Vec<String> = (fitting.iter())
                    .map(|name| format!("`{}`", in_full(value, name)))
                    .collect();
                let help = format!("write {}", full.join(" or "));
                self.report(value, value.span, message, Some(help));
            }
        }
    }

    /// Reports the errors of a value that does not fit any variant. The reported errors are those from the check
    /// against the best fitting variant.
    fn take_closest(&mut self, value: &Value, trials: Vec<(&str, Schema, Self)>) {
        let variants = |schema: &Schema| -> Vec<String> {
            let choice = schema.choice().unwrap_or_default();
            choice.names().map(str::to_owned).collect()
        };
        let names: Vec<Vec<String>> = trials.iter().map(|(_, s, _)| variants(s)).collect();
        if let Some((name, span)) = value.name()
            && !names.iter().flatten().any(|known| known == name)
        {
            let mut known: Vec<&str> = names.iter().flatten().map(String::as_str).collect();
            known.sort_unstable();
            known.dedup();
            let help = did_you_mean(name, known);
            return self.report(
                value,
                span,
                format!("unknown selection `{name}`"),
                Some(help),
            );
        }
        // For each variant, counts the selections in the value that this variant can contain. The variant with the
        // highest count fits best. If several variants have the same count, the variant with the fewest errors fits
        // best. If several variants also have the same number of errors, the first of them is chosen.
        let fit = |((_, _, trial), names): &((&str, Schema, Self), Vec<String>)| {
            (n_known(value, names), Reverse(trial.diagnostics.len()))
        };
        let all = trials.into_iter().zip(names).rev();
        if let Some(((name, _, mut trial), _)) = all.max_by_key(fit) {
            let word = name.to_lowercase();
            for diagnostic in &mut trial.diagnostics {
                diagnostic.message =
                    format!("{} (read as a selection of {word})", diagnostic.message);
            }
            self.take(trial);
        }
    }

    pub(super) fn take(&mut self, trial: Self) {
        self.diagnostics.extend(trial.diagnostics);
        self.more += trial.more;
        self.renames.extend(trial.renames);
        self.shorts.extend(trial.shorts);
    }
}

/// The result of checking a value against a schema.
pub(crate) struct Checked {
    /// The errors in the value.
    pub(crate) wrong: Vec<Diagnostic>,
    /// The old names that the value uses for fields and variants, in the order of the text. The schema lists old names
    /// in `aliases`.
    pub(crate) renames: Vec<Rename>,
    pub(super) shorts: Vec<Short>,
}

impl Checked {
    /// Returns the old names that a checked step `Name(..)` uses. The name of the operation can be one of them. `name`
    /// is the current name of the operation.
    pub(crate) fn renames_in_step(self, run: &Value, name: &str) -> Vec<Rename> {
        let own = run.name().filter(|(own, _)| *own != name);
        let own = own.map(|(own, span)| Rename {
            span,
            from: own.to_owned(),
            to: name.to_owned(),
        });
        own.into_iter().chain(self.renames).collect()
    }

    /// Returns the value with all omitted names of variants added.
    pub(crate) fn in_full<'v>(&self, value: &'v Value) -> Cow<'v, Value> {
        if self.shorts.is_empty() {
            return Cow::Borrowed(value);
        }
        let mut full = value.clone();
        complete(&mut full, &self.shorts);
        Cow::Owned(full)
    }
}

/// Adds the omitted names of variants inside `value`.
fn complete(value: &mut Value, shorts: &[Short]) {
    // If several nested values have the same span, the name belongs to the outermost one, because that value was
    // checked against the schema.
    match shorts.iter().find(|short| short.span == value.span) {
        Some(short) => *value = in_full(value, &short.name),
        None => value.for_each_part(|part| complete(part, shorts)),
    }
}

/// Returns a variant that has this name and whose content is `value`.
fn in_full(value: &Value, name: &str) -> Value {
    let span = value.span;
    let body = Value::new(span, ValueKind::Tuple(vec![value.clone()]));
    let text = name.into();
    let name = Name { span, text };
    Value::new(span, ValueKind::Call(Box::new(Call { name, body })))
}

/// Counts the names inside the value that are also in `names`.
fn n_known(value: &Value, names: &[String]) -> usize {
    let inside: usize = value.parts().map(|part| n_known(part, names)).sum();
    let is_known = |(name, _): (&str, _)| names.iter().any(|known| known == name);
    inside + usize::from(value.name().is_some_and(is_known))
}
