//! Enumerations whose outer name may be left out where the content tells which variant is meant: those
//! whose schema says `x-shorthand`, such as [`op::Elements`].
//!
//! ```text
//! Sharp(above: 30)   only edges can be sharp     ---> Edges(Sharp(above: 30))
//! Boundary           vertices, edges, faces can  ---> an error: say which are meant
//! ```

use std::borrow::Cow;
use std::cmp::Reverse;

use super::schema::{Choice, Schema};
use super::{Checker, Place, Rename, did_you_mean};
use ron_tree::{Call, Diagnostic, Name, Span, Value, ValueKind};

/// A value whose outer name was left out.
#[derive(Clone, Debug)]
pub(super) struct Short {
    /// Where it stands.
    span: Span,
    /// The name.
    name: Box<str>,
}

impl Checker {
    /// Checks a value that is a variant, or what stands in the brackets of one.
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
                let (_, _, trial) = trials.swap_remove(place.expect("one of them"));
                self.take(trial);
                let (span, name) = (value.span, one.into());
                self.shorts.push(Short { span, name });
            }
            [] if value.name().is_some_and(|(name, _)| choice.has(name)) => self.take(whole),
            [] => self.take_closest(value, trials),
            _ => {
                let words: Vec<String> = fitting.iter().map(|name| name.to_lowercase()).collect();
                let message = format!("this selects {}: say which are meant", words.join(" or "));
                let full: Vec<String> = (fitting.iter())
                    .map(|name| format!("`{}`", in_full(value, name)))
                    .collect();
                let help = format!("write {}", full.join(" or "));
                self.report(value, value.span, message, Some(help));
            }
        }
    }

    /// What is wrong with a value that fits no variant.
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
        // The one that knows most of the names, and of those the first with the fewest errors.
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

/// What came of holding a value against a schema.
pub(crate) struct Checked {
    /// What is wrong.
    pub(crate) wrong: Vec<Diagnostic>,
    /// The older names of fields and variants, in the order of the text: those that the schema lists as `aliases`.
    pub(crate) renames: Vec<Rename>,
    pub(super) shorts: Vec<Short>,
}

impl Checked {
    /// The older names in a step `Name(..)` that was checked, its own among them. `name` is that of its operation
    /// today.
    pub(crate) fn renames_in_step(self, run: &Value, name: &str) -> Vec<Rename> {
        let own = run.name().filter(|(own, _)| *own != name);
        let own = own.map(|(own, span)| Rename {
            span,
            from: own.to_owned(),
            to: name.to_owned(),
        });
        own.into_iter().chain(self.renames).collect()
    }

    /// The value with all names that were left out.
    pub(crate) fn in_full<'v>(&self, value: &'v Value) -> Cow<'v, Value> {
        if self.shorts.is_empty() {
            return Cow::Borrowed(value);
        }
        let mut full = value.clone();
        complete(&mut full, &self.shorts);
        Cow::Owned(full)
    }
}

/// Puts names around the values in `value` that stand where these were left out.
fn complete(value: &mut Value, shorts: &[Short]) {
    // Of several values at one place, the outermost is the one that was checked against the schema.
    match shorts.iter().find(|short| short.span == value.span) {
        Some(short) => *value = in_full(value, &short.name),
        None => value.for_each_part(|part| complete(part, shorts)),
    }
}

/// `value` as the content of the variant of this name.
fn in_full(value: &Value, name: &str) -> Value {
    let span = value.span;
    let body = Value::new(span, ValueKind::Tuple(vec![value.clone()]));
    let text = name.into();
    let name = Name { span, text };
    Value::new(span, ValueKind::Call(Box::new(Call { name, body })))
}

/// How many names in the value are among those of `names`.
fn n_known(value: &Value, names: &[String]) -> usize {
    let inside: usize = value.parts().map(|part| n_known(part, names)).sum();
    let is_known = |(name, _): (&str, _)| names.iter().any(|known| known == name);
    inside + usize::from(value.name().is_some_and(is_known))
}
