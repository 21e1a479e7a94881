//! Keys that do something in the whole window.

use editor::{Action, Keys};
use eframe::egui::{Context, Event, Key, Modifiers};

/// Removes the keys with an action from the input, and returns the actions.
///
/// While a text is edited, keys without Ctrl or Alt belong to the text. While another widget has the focus, Space, Enter
/// and Tab belong to the widget.
pub(crate) fn actions(ctx: &Context, keys: &Keys, is_modal: bool) -> Vec<Action> {
    let is_text = ctx.text_edit_focused();
    let has_focus = ctx.memory(|memory| memory.focused().is_some());
    let mut actions = Vec::new();
    ctx.input_mut(|input| {
        input.events.retain(|event| {
            let Event::Key {
                key,
                pressed: true,
                modifiers,
                ..
            } = event
            else {
                return true;
            };
            let Some(action) = keys.action(&name(*key, *modifiers)) else {
                return true;
            };
            let is_plain = !modifiers.command && !modifiers.alt;
            let is_function = matches!(key, Key::F1 | Key::Escape);
            if is_text && is_plain && !is_function || is_text && *key == Key::A && modifiers.command
            {
                return true;
            }
            if has_focus && matches!(key, Key::Space | Key::Enter | Key::Tab) {
                return true;
            }
            if is_modal && !matches!(action, Action::Cancel | Action::Help) {
                return true;
            }
            actions.push(action);
            false
        });
    });
    actions
}

/// Writes a key as the table of keys does: `Ctrl+Shift+Z`.
fn name(key: Key, modifiers: Modifiers) -> String {
    let mut text = String::new();
    for (is_down, name) in [
        (modifiers.command, "Ctrl+"),
        (modifiers.alt, "Alt+"),
        (modifiers.shift, "Shift+"),
    ] {
        if is_down {
            text += name;
        }
    }
    text + match key {
        // On many keyboards, plus is on the same key as equals.
        Key::Equals => "Plus",
        key => key.name(),
    }
}
