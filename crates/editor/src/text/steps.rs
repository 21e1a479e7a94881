//! Edits of the list of steps and of the expectations.

use ron_tree::{Span, Value, ValueKind};

use super::entries::{insert_entry, line_start, remove_entry, starts_line, tail};
use super::fields::{entry_spans, set_field};
use super::{Edits, Outline, StepText, TextError};

impl Outline {
    fn list(&self) -> Result<(Span, Vec<Span>), TextError> {
        let list = self
            .root()
            .field("steps")
            .filter(|steps| steps.items().is_some());
        let list = list.ok_or(TextError::NoSteps)?;
        Ok((list.span, self.steps.iter().map(|step| step.span).collect()))
    }

    fn step(&self, step: usize) -> Result<&Value, TextError> {
        let missing = TextError::NoStep(step, self.steps.len());
        self.written(step).ok_or(missing)
    }
}

/// Inserts steps so that the first of them has the index `at`.
pub(crate) fn insert_steps(
    text: &str,
    outline: &Outline,
    at: usize,
    steps: &[String],
) -> Result<Edits, TextError> {
    let (list, entries) = outline.list()?;
    let indent = match entries.first() {
        Some(first) if starts_line(text, first.start) => {
            super::entries::indent(text, first.start).to_owned()
        }
        Some(_) => return Ok(insert_entry(text, list, &entries, at, &steps.join(", "))),
        None => format!("{}    ", super::entries::indent(text, list.start)),
    };
    Ok(insert_entry(
        text,
        list,
        &entries,
        at,
        &steps.join(&format!(",\n{indent}")),
    ))
}

/// Removes a step.
pub(crate) fn remove_step(text: &str, outline: &Outline, step: usize) -> Result<Edits, TextError> {
    let (_, entries) = outline.list()?;
    outline.step(step)?;
    Ok(remove_entry(text, &entries, step))
}

/// Inserts a copy of a step directly after that step. If the step has an id, the copy gets a new id.
pub(crate) fn duplicate_step(
    text: &str,
    outline: &Outline,
    step: usize,
) -> Result<Edits, TextError> {
    let written = outline.step(step)?;
    let mut copy = written.span.of(text).to_owned();
    if let (Some(id), Some(old)) = (&outline.steps[step].id, written.field("id")) {
        let new = ron_tree::string_literal(&unused_id(outline, id));
        let at = old.span.start - written.span.start;
        copy.replace_range(at..at + old.span.len(), &new);
    }
    insert_steps(text, outline, step + 1, &[copy])
}

/// Returns an id that no step of the text has: `id` itself, or `id-2`, `id-3` and so on.
pub(crate) fn unused_id(outline: &Outline, id: &str) -> String {
    fn is_used(steps: &[StepText], id: &str) -> bool {
        steps
            .iter()
            .any(|step| step.id.as_deref() == Some(id) || is_used(&step.inner, id))
    }
    if !is_used(&outline.steps, id) {
        return id.to_owned();
    }
    let stem = id
        .trim_end_matches(|c: char| c.is_ascii_digit())
        .trim_end_matches('-');
    let stem = if stem.is_empty() || stem.len() == id.len() {
        id
    } else {
        stem
    };
    let mut ids = (2..).map(|n| format!("{stem}-{n}"));
    ids.find(|new| !is_used(&outline.steps, new))
        .expect("a text has finitely many ids")
}

/// Moves a step to the index `to`. The comments directly above the step and at the end of its line move with it.
pub(crate) fn move_step(
    text: &str,
    outline: &Outline,
    from: usize,
    to: usize,
) -> Result<Edits, TextError> {
    let (list, entries) = outline.list()?;
    let step = outline.step(from)?.span;
    outline.step(to)?;
    if from == to {
        return Ok(Vec::new());
    }
    let end = tail(text, step.end);
    let is_own_line = starts_line(text, step.start) && end.ends_line;
    let target = if to > from { to + 1 } else { to };
    if !is_own_line || entries.iter().any(|e| !starts_line(text, e.start)) {
        let mut edits = remove_entry(text, &entries, from);
        edits.extend(insert_entry(text, list, &entries, target, step.of(text)));
        return Ok(edits);
    }
    let start = block_start(text, step.start);
    let comment = &text[end.comma.unwrap_or(step.end)..end.end];
    let block = format!("{}{}", &text[start..step.end], ",");
    let removed = Span::new(start.saturating_sub(1), end.end);
    // The step moves to the line after the step that will precede it. If it becomes the first step, it moves before the
    // current first step and the comments above that step.
    let mut edits = vec![(removed, String::new())];
    if let Some(before) = target.checked_sub(1) {
        let before_tail = tail(text, entries[before].end);
        if before_tail.comma.is_none() {
            edits.push((
                Span::new(entries[before].end, entries[before].end),
                ",".to_owned(),
            ));
        }
        let at = before_tail.end;
        edits.push((Span::new(at, at), format!("\n{block}{comment}")));
    } else {
        let at = block_start(text, entries[0].start).saturating_sub(1);
        edits.push((Span::new(at, at), format!("\n{block}{comment}")));
    }
    Ok(edits)
}

/// Returns the start of the comment lines directly above an entry, or the start of its line if there are no such
/// comments.
fn block_start(text: &str, entry: usize) -> usize {
    let mut start = line_start(text, entry);
    while start > 0 {
        let above = line_start(text, start - 1);
        if !text[above..start].trim_start().starts_with("//") {
            break;
        }
        start = above;
    }
    start
}

/// Enables or disables a step.
pub(crate) fn set_enabled(
    text: &str,
    outline: &Outline,
    step: usize,
    enabled: bool,
) -> Result<Edits, TextError> {
    let written = outline.step(step)?;
    if outline.steps[step].enabled == enabled {
        return Ok(Vec::new());
    }
    if !enabled {
        return set_envelope_field(text, outline, step, "enabled", Some("false"));
    }
    // If `run` is the only field left, the step is written as the operation alone.
    let run = outline.steps[step].run;
    if written.fields().len() == 2 && written.field("run").is_some() {
        let around = [
            Span::new(written.span.start, run.start),
            Span::new(run.end, written.span.end),
        ];
        if around
            .iter()
            .all(|span| !span.of(text).contains("/*") && !span.of(text).contains("//"))
        {
            return Ok(around.map(|span| (span, String::new())).to_vec());
        }
    }
    set_envelope_field(text, outline, step, "enabled", None)
}

/// Sets or removes a field around the operation of a step, such as `id` or `on`. The field is removed if `new` is
/// `None`.
pub(crate) fn set_envelope_field(
    text: &str,
    outline: &Outline,
    step: usize,
    field: &str,
    new: Option<&str>,
) -> Result<Edits, TextError> {
    let written = outline.step(step)?;
    if matches!(written.kind, ValueKind::Struct(_)) {
        return set_field(text, written, &[field.to_owned()], new);
    }
    let Some(new) = new else {
        return Ok(Vec::new());
    };
    let Span { start, end } = written.span;
    let (before, after) = if field == "id" {
        (format!("({field}: {new}, run: "), ")".to_owned())
    } else {
        ("(run: ".to_owned(), format!(", {field}: {new})"))
    };
    Ok(vec![
        (Span::new(start, start), before),
        (Span::new(end, end), after),
    ])
}

/// Adds expectations at the end of `expect`.
pub(crate) fn add_expectations(
    text: &str,
    outline: &Outline,
    expectations: &[String],
) -> Result<Edits, TextError> {
    if expectations.is_empty() {
        return Ok(Vec::new());
    }
    if let Some(list) = outline
        .root()
        .field("expect")
        .filter(|list| list.items().is_some())
    {
        let indent = match outline.expectations.last() {
            Some(last) if starts_line(text, last.start) => super::entries::indent(text, last.start),
            Some(_) => {
                let all = expectations.join(", ");
                return Ok(insert_entry(
                    text,
                    list.span,
                    &outline.expectations,
                    usize::MAX,
                    &all,
                ));
            }
            None => &format!("{}    ", super::entries::indent(text, list.span.start)),
        };
        let all = expectations.join(&format!(",\n{indent}"));
        return Ok(insert_entry(
            text,
            list.span,
            &outline.expectations,
            usize::MAX,
            &all,
        ));
    }
    let root = outline.root();
    if !matches!(root.kind, ValueKind::Struct(_)) {
        return Err(TextError::NoSteps);
    }
    let fields = entry_spans(root);
    let lines: Vec<String> = expectations
        .iter()
        .map(|line| format!("        {line},\n"))
        .collect();
    let entry = format!("expect: [\n{}    ]", lines.concat());
    Ok(insert_entry(text, root.span, &fields, usize::MAX, &entry))
}
