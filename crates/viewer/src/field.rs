//! The widget of a parameter.

use editor::{FieldKind, FieldValue, Limits, PanelField, SelectionText};
use eframe::egui::{
    self, Align, Button, Checkbox, CollapsingHeader, ComboBox, DragValue, Id, Layout, Response,
    RichText, Slider, TextEdit, Ui,
};

use crate::theme::Colors;

/// A parameter, with the values that its widget needs.
pub(crate) struct Field<'a> {
    pub(crate) of: &'a PanelField,
    /// The value while a slider is dragged, as RON.
    pub(crate) live: Option<&'a str>,
    /// The selection that describes the picked elements.
    pub(crate) selection: Option<&'a SelectionText>,
    /// Distinguishes widgets of parameters with the same name.
    pub(crate) salt: &'a str,
}

/// A change of a parameter.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Change {
    /// A new value as RON.
    Set(String),
    /// A value of a slider that is being dragged.
    Drag(String),
    /// The parameter gets its default value again.
    Reset,
}

/// The widget of a whole number is a slider if the range of the number is at most this large. If the range is larger,
/// the widget is a number field.
const MAX_SLIDER: f64 = 1000.0;

/// If a value has more parts than this, the parts are hidden until the user clicks.
const MAX_OPEN_PARTS: usize = 4;

/// Draws the widget of a parameter.
pub(crate) fn ui(ui: &mut Ui, field: &Field) -> Option<Change> {
    let colors = Colors::current(ui);
    let of = field.of;
    let mut change = None;
    ui.add_space(3.0);
    let is_required = of.is_missing();
    let name = of.name.replace('_', " ");
    let wide = is_wide(of);
    let label = |ui: &mut Ui| {
        let color = if is_required {
            colors.bad
        } else if of.value.is_some() {
            colors.text
        } else {
            colors.weak
        };
        let label = ui.label(RichText::new(&name).size(12.5).color(color));
        let doc = format!("{}\n\n{}", of.doc, of.type_name);
        label.on_hover_text(doc.trim())
    };
    if wide {
        ui.horizontal(|ui| {
            label(ui);
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                reset(ui, of, &mut change);
                use_picked(ui, field, &mut change);
            });
        });
        change = change.take().or(text(ui, field));
    } else {
        ui.horizontal(|ui| {
            label(ui);
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                reset(ui, of, &mut change);
                let new = widget(ui, field);
                change = change.take().or(new);
            });
        });
        change = change.take().or(parts(ui, field));
    }
    change
}

/// Draws the parts of a struct or of a variant, each with its own widget.
fn parts(ui: &mut Ui, field: &Field) -> Option<Change> {
    let of = field.of;
    let whole = field.live.or(of.current())?;
    let (_, parts) = of.kind.parts(whole);
    if parts.is_empty() {
        return None;
    }
    let salt = format!("{}.{}", field.salt, of.name);
    let draw = |ui: &mut Ui| {
        let mut change = None;
        for part in &parts {
            let inner = Field {
                of: &part.field,
                live: None,
                selection: field.selection,
                salt: &salt,
            };
            let new = self::ui(ui, &inner).and_then(|new| match new {
                Change::Set(value) => part.in_whole(whole, Some(&value)).map(Change::Set),
                Change::Drag(value) => part.in_whole(whole, Some(&value)).map(Change::Drag),
                Change::Reset => part.in_whole(whole, None).map(Change::Set),
            });
            change = change.or(new);
        }
        change
    };
    let inside = |ui: &mut Ui| ui.indent(&salt, draw).inner;
    if parts.len() <= MAX_OPEN_PARTS {
        return inside(ui);
    }
    let title = RichText::new(format!("{} parts", parts.len())).size(12.0);
    let header = CollapsingHeader::new(title).id_salt(&salt);
    header.show(ui, inside).body_returned.flatten()
}

/// Whether the widget has a line of its own.
fn is_wide(of: &PanelField) -> bool {
    let is_text = |kind: &FieldKind| {
        matches!(
            kind,
            FieldKind::Selection(_) | FieldKind::Other | FieldKind::Text
        )
    };
    of.argument.is_some() || is_text(of.kind.inner()) || of.value.is_some() && of.typed().is_none()
}

fn reset(ui: &mut Ui, of: &PanelField, change: &mut Option<Change>) {
    if of.value.is_some() && of.default.is_some() {
        let button = ui.add(
            Button::new(
                RichText::new("reset")
                    .size(11.0)
                    .color(Colors::current(ui).weak),
            )
            .small()
            .frame(false),
        );
        let doc = format!("Reset to {}", of.default.as_deref().unwrap_or_default());
        if button
            .accessible_name(format!("Reset {}", of.name))
            .on_hover_text(doc)
            .clicked()
        {
            *change = Some(Change::Reset);
        }
    }
}

fn use_picked(ui: &mut Ui, field: &Field, change: &mut Option<Change>) {
    let FieldKind::Selection(kind) = field.of.kind.inner() else {
        return;
    };
    let Some(selection) = field.selection.filter(|selection| {
        kind.is_none_or(|kind| kind == selection.kind) && selection.before.is_none()
    }) else {
        return;
    };
    if ui
        .small_button("Use picked")
        .on_hover_text(&selection.text)
        .clicked()
    {
        *change = Some(Change::Set(selection.text.clone()));
    }
}

/// Draws the widget of a parameter on the same line as the name of the parameter.
fn widget(ui: &mut Ui, field: &Field) -> Option<Change> {
    let of = field.of;
    let current = match field.live {
        Some(live) => FieldValue::read(&of.kind, live),
        None => of.typed(),
    };
    let (kind, optional) = match &of.kind {
        FieldKind::Optional(inner) => (inner.inner(), true),
        kind => (kind, false),
    };
    let current = match current {
        Some(FieldValue::None) | None if optional => {
            let mut is_set = false;
            let response = ui.add(Checkbox::without_text(&mut is_set));
            let response = response.accessible_name(format!("Set {}", of.name));
            return response
                .changed()
                .then(|| Change::Set(kind.first().to_ron()));
        }
        Some(value) => value,
        None => kind.first(),
    };
    let name = of.name.clone();
    match (kind, current) {
        (FieldKind::Number(limits), FieldValue::Number(x)) => number(ui, name, x, limits),
        (FieldKind::Integer(limits), FieldValue::Integer(mut n)) => {
            let response = if let Some((min, max)) =
                range(limits).filter(|(min, max)| max - min <= MAX_SLIDER)
            {
                ui.add(Slider::new(&mut n, integer(min)..=integer(max)))
            } else {
                ui.add(whole(&mut n, limits))
            };
            dragged(
                &response.accessible_name(name),
                || FieldValue::Integer(n),
                true,
            )
        }
        (FieldKind::Bool, FieldValue::Bool(mut is)) => {
            let response = ui
                .add(Checkbox::without_text(&mut is))
                .accessible_name(name);
            response
                .changed()
                .then(|| Change::Set(FieldValue::Bool(is).to_ron()))
        }
        (FieldKind::Choice(names), FieldValue::Choice(current)) => {
            let choices = names
                .iter()
                .map(|(name, doc)| (name.as_str(), doc.as_str()));
            let chosen = choice(ui, field, &current, choices);
            chosen.map(|i| Change::Set(names[i].0.clone()))
        }
        (FieldKind::Variants(variants), FieldValue::Ron(text)) => {
            // If the parameter has no value, no variant is chosen yet.
            let current = field.live.or(of.current()).map_or("", |_| text.as_str());
            let current = of.kind.parts(current).0.unwrap_or_default();
            let choices = variants
                .iter()
                .map(|variant| (variant.name.as_str(), variant.doc.as_str()));
            let chosen = choice(ui, field, &current, choices);
            chosen.map(|i| Change::Set(variants[i].first()))
        }
        (FieldKind::Vector(_), FieldValue::Vector(parts)) => {
            let value =
                |parts: &[f64]| FieldValue::Vector(parts.iter().map(|&x| rounded(x)).collect());
            tuple(ui, &name, parts, component, value)
        }
        (FieldKind::Integers(_, limits), FieldValue::Integers(parts)) => {
            let value = |parts: &[i64]| FieldValue::Integers(parts.to_vec());
            tuple(ui, &name, parts, |n| whole(n, limits), value)
        }
        _ => None,
    }
}

/// Draws the number fields of a tuple. The last number is drawn first, because the layout runs from right to left.
fn tuple<N>(
    ui: &mut Ui,
    name: &str,
    mut parts: Vec<N>,
    number_field: impl for<'n> Fn(&'n mut N) -> DragValue<'n>,
    value: impl Fn(&[N]) -> FieldValue,
) -> Option<Change> {
    let mut change = None;
    for i in (0..parts.len()).rev() {
        let axis = ["x", "y", "z"][i.min(2)];
        let response = ui.add(number_field(&mut parts[i]));
        let response = response
            .accessible_name(format!("{name} {axis}"))
            .on_hover_text(axis);
        change = change.or(dragged(&response, || value(&parts), true));
    }
    change
}

/// Draws a list of choices, each with its description. Returns the index of the choice that was clicked.
fn choice<'c>(
    ui: &mut Ui,
    field: &Field,
    current: &str,
    choices: impl Iterator<Item = (&'c str, &'c str)>,
) -> Option<usize> {
    let name = &field.of.name;
    let mut chosen = None;
    let combo = ComboBox::from_id_salt((field.salt, name))
        .selected_text(if current.is_empty() {
            "Choose"
        } else {
            current
        })
        .show_ui(ui, |ui| {
            for (i, (choice, doc)) in choices.enumerate() {
                let mut response = ui.selectable_label(choice == current, choice);
                if !doc.is_empty() {
                    response = response.on_hover_text(doc);
                }
                if response.clicked() {
                    chosen = Some(i);
                }
            }
        });
    combo.response.accessible_name(name.clone());
    chosen
}

/// Returns a number field for a whole number.
fn whole<'a>(n: &'a mut i64, limits: &Limits) -> DragValue<'a> {
    let speed = (n.unsigned_abs() as f64 * 0.001).max(0.1);
    let low = limits.min.map_or(i64::MIN, integer);
    let high = limits.max.map_or(i64::MAX, integer);
    DragValue::new(n).speed(speed).range(low..=high)
}

/// Returns a number field for one component of a vector.
fn component(x: &mut f64) -> DragValue<'_> {
    let speed = (x.abs() * 0.01).max(0.01);
    unlimited(x, &Limits::default()).speed(speed)
}

fn unlimited<'a>(x: &'a mut f64, limits: &Limits) -> DragValue<'a> {
    let speed = (x.abs() * 0.01).max(0.005);
    let low = limits.min.unwrap_or(f64::NEG_INFINITY);
    let high = limits.max.unwrap_or(f64::INFINITY);
    DragValue::new(x)
        .speed(speed)
        .range(low..=high)
        .custom_formatter(|x, _| format!("{}", rounded(x)))
}

/// Draws a slider, or a number field if the number has no minimum or no maximum.
fn number(ui: &mut Ui, name: String, before: f64, limits: &Limits) -> Option<Change> {
    let mut x = before;
    let response = match range(limits) {
        Some((min, max)) => {
            let slider = ui.add(Slider::new(&mut x, min..=max).max_decimals(4));
            if let Some(change) = by_wheel(ui, &slider, before, [min, max]) {
                return Some(change);
            }
            slider
        }
        None => ui.add(unlimited(&mut x, limits)),
    };
    dragged(
        &response.accessible_name(name),
        || FieldValue::Number(rounded(x)),
        limits.allows(x),
    )
}

/// Returns the change that the user made with a slider or number field: `Change::Drag` during a drag, and `Change::Set`
/// otherwise.
fn dragged(
    response: &Response,
    value: impl FnOnce() -> FieldValue,
    is_allowed: bool,
) -> Option<Change> {
    if response.drag_stopped() && is_allowed {
        return Some(Change::Set(value().to_ron()));
    }
    if !response.changed() || !is_allowed {
        return None;
    }
    let text = value().to_ron();
    Some(if response.dragged() {
        Change::Drag(text)
    } else {
        Change::Set(text)
    })
}

/// Returns the change that the user made by turning the wheel over a slider: `Change::Drag` while the wheel turns, and
/// `Change::Set` when the wheel stops.
fn by_wheel(ui: &Ui, slider: &Response, x: f64, [min, max]: [f64; 2]) -> Option<Change> {
    let id = slider.id.with("wheel");
    let last: Option<f64> = ui.data(|data| data.get_temp(id));
    let turned = if slider.hovered() {
        ui.input_mut(|input| std::mem::take(&mut input.smooth_scroll_delta.y))
    } else {
        0.0
    };
    if turned == 0.0 {
        let last = last?;
        ui.data_mut(|data| data.remove_temp::<f64>(id));
        return Some(Change::Set(FieldValue::Number(last).to_ron()));
    }
    let x = last.unwrap_or(x) + f64::from(turned) * (max - min) / 2000.0;
    let x = rounded(x.clamp(min, max));
    ui.data_mut(|data| data.insert_temp(id, x));
    ui.ctx().request_repaint();
    Some(Change::Drag(FieldValue::Number(x).to_ron()))
}

/// Returns the range of a slider. The range is a little smaller than the limits if the limits themselves are not
/// allowed. `None` if the number has no minimum or no maximum; its widget is then a number field.
fn range(limits: &Limits) -> Option<(f64, f64)> {
    let (mut min, mut max) = (limits.min?, limits.max?);
    let margin = (max - min) * 1e-3;
    if limits.above_min {
        min += margin;
    }
    if limits.below_max {
        max -= margin;
    }
    (max > min && (max - min).is_finite()).then_some((min, max))
}

/// Rounds to six significant digits, which is finer than a pixel of a slider.
fn rounded(x: f64) -> f64 {
    format!("{x:.5e}").parse().unwrap_or(x)
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "conversions from f64 saturate"
)]
fn integer(x: f64) -> i64 {
    x as i64
}

/// Draws a text field for a value.
fn text(ui: &mut Ui, field: &Field) -> Option<Change> {
    let of = field.of;
    let id = Id::unique(("field", field.salt, &of.name));
    let is_text = matches!(of.kind.inner(), FieldKind::Text) && of.argument.is_none();
    let current = match of.typed() {
        Some(FieldValue::Text(text)) if is_text => text,
        _ => of.current().unwrap_or_default().to_owned(),
    };
    let hint = if of.is_missing() { "required" } else { "" };
    let new = line(ui, &of.name, &current, hint, id)?;
    if new.trim().is_empty() && of.default.is_some() {
        return Some(Change::Reset);
    }
    Some(Change::Set(if is_text {
        FieldValue::Text(new).to_ron()
    } else {
        new
    }))
}

/// Draws a line of text that can be edited. Returns the new text when Enter is pressed or the line loses the focus.
pub(crate) fn line(ui: &mut Ui, name: &str, current: &str, hint: &str, id: Id) -> Option<String> {
    // If Tab moves the focus away, the typed text is still needed in the next frame.
    let has_focus = ui.memory(|memory| memory.has_focus(id) || memory.had_focus_last_frame(id));
    let mut buffer = ui
        .data_mut(|data| data.get_temp::<String>(id))
        .filter(|_| has_focus)
        .unwrap_or_else(|| current.to_owned());
    let edit = TextEdit::singleline(&mut buffer)
        .id(id)
        .font(egui::TextStyle::Monospace)
        .desired_width(f32::INFINITY)
        .hint_text(hint);
    let response = ui.add(edit).accessible_name(name);
    ui.data_mut(|data| data.insert_temp(id, buffer.clone()));
    (response.lost_focus() && buffer != current).then_some(buffer)
}
