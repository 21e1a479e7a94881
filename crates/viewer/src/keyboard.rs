//! Converts pressed keys to actions. These keys work in the whole window.

use editor::{Action, Keys};
use eframe::egui::{Context, Event, Id, Key, Modifiers, Popup};

/// Finds the pressed keys that start an action, and removes them from the input. Returns the actions.
///
/// While the user edits a text, only F1, Escape and keys with Ctrl have an effect. Even these keys have an effect only
/// if their action is about the window or the file. While a widget other than the view has the focus, that widget
/// receives Space and Enter. While a menu or a list of choices is open, this menu or list receives all keys.
pub(crate) fn actions(ctx: &Context, keys: &Keys, is_modal: bool, view: Option<Id>) -> Vec<Action> {
    if Popup::is_any_open(ctx) {
        return Vec::new();
    }
    let is_text = ctx.text_edit_focused();
    let has_focus = ctx.memory(|memory| memory.focused().is_some_and(|id| Some(id) != view));
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
            let is_letter = !modifiers.command && !matches!(key, Key::F1 | Key::Escape);
            if is_text && (is_letter || !is_for_window(action)) {
                return true;
            }
            if has_focus && matches!(key, Key::Space | Key::Enter) {
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

/// Whether an action is about the window or the file, and therefore does not disturb the text that is being edited.
fn is_for_window(action: Action) -> bool {
    matches!(
        action,
        Action::Undo
            | Action::Redo
            | Action::Save
            | Action::SaveAs
            | Action::Open
            | Action::New
            | Action::Quit
            | Action::Palette
            | Action::Help
            | Action::Cancel
    )
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
        // On many keyboards, plus is on the same key as equals, so this key is called `Plus`.
        Key::Equals => "Plus",
        key => key.name(),
    }
}
