//! Plays the edits of a step one by one in the view, with the pointers that each edit changes.

use std::sync::Arc;
use std::time::Duration;

use editor::{Play, PlayedEdit, Pointers};
use eframe::egui::{Button, Grid, Label, RichText, Slider, Ui};
use mesh::{EdgeId, HalfEdgeId};
use scene::{Geometry, Scene};

use crate::app::Parts;
use crate::paths::{self, Purpose};
use crate::steps_pane::heading;
use crate::theme::Colors;

/// The maximum number of half-edges whose pointers are listed.
const MAX_POINTERS: usize = 24;

/// Plays the edits of one step.
pub(crate) struct Player {
    play: Play,
    object: String,
    /// The index of the step in the text.
    step: usize,
    /// The version of the text that the edits belong to.
    version: u64,
    /// The scene before the step, but with a changed mesh: it already has the edits that have been played so far.
    scene: Arc<Scene>,
    /// The number of edits per second.
    speed: f64,
    /// The time at which the player does the next edit, in seconds since the start of the program. `None` while the
    /// player is paused.
    next: Option<f64>,
}

impl Player {
    /// Returns the scene after the edits that have been played so far.
    pub(crate) fn scene(&self) -> &Arc<Scene> {
        &self.scene
    }

    /// Returns the edge that was edited last, and the name of the object that has this edge. Before the first edit,
    /// returns the edge that will be edited first. Returns `None` if the edit has removed the edge, or if the edit
    /// moves vertices.
    pub(crate) fn edge(&self) -> Option<(&str, EdgeId)> {
        let edge = self.shown()?.edge?;
        (self.play.mesh().has_edge(edge)).then_some((self.object.as_str(), edge))
    }

    /// Returns the edit that was done last. Before the first edit, returns the next edit.
    fn shown(&self) -> Option<&PlayedEdit> {
        self.play
            .edits()
            .get(self.play.position().saturating_sub(1))
    }

    pub(crate) fn n_edits(&self) -> usize {
        self.play.edits().len()
    }

    pub(crate) fn speed(&self) -> f64 {
        self.speed
    }

    /// Pauses the player between two edits.
    pub(crate) fn pause(&mut self) {
        self.next = None;
    }

    /// Moves forwards or backwards until this number of edits is done.
    pub(crate) fn go_to(&mut self, position: usize) {
        while self.play.position() < position && self.play.forward() {}
        while self.play.position() > position && self.play.back() {}
        self.update();
    }

    /// Shows the mesh after the edits that have been played so far.
    fn update(&mut self) {
        if let Some((geometry, _)) = Arc::make_mut(&mut self.scene).parts_mut(&self.object) {
            *geometry = Geometry::Mesh(Arc::new(self.play.mesh().clone()));
        }
    }
}

impl Parts {
    /// Begins to play the edits of a step.
    pub(crate) fn play(&mut self, step: usize) {
        let Some((object, play)) = self.editor.play(step) else {
            self.inform(
                "The edits of this step cannot be played. Playable steps flip (without `until`), split or collapse edges of a mesh, or make one level of Loop subdivision. The recipe must have run, and the step must be enabled and contain no `arg(..)`.",
            );
            return;
        };
        let before = self.editor.scene_before(step).unwrap_or_default();
        let mut player = Player {
            play,
            object,
            step,
            version: self.editor.document().version(),
            scene: before,
            speed: 2.0,
            next: None,
        };
        player.update();
        self.player = Some(player);
    }

    /// Does the next edit if its time has come. Ends the player if the text has changed, or if the step cursor is no
    /// longer directly after the step.
    pub(crate) fn advance_player(&mut self, ui: &Ui) {
        let Some(player) = &mut self.player else {
            return;
        };
        let is_same = self.editor.document().version() == player.version
            && self.editor.cursor() == player.step + 1;
        if !is_same {
            self.player = None;
            return;
        }
        let now = ui.input(|input| input.time);
        let Some(next) = player.next else { return };
        let mut rest = next - now;
        if rest <= 0.0 {
            player.go_to(player.play.position() + 1);
            rest = 1.0 / player.speed;
            let is_end = player.play.position() == player.play.edits().len();
            player.next = (!is_end).then_some(now + rest);
        }
        ui.ctx()
            .request_repaint_after(Duration::from_secs_f64(rest.clamp(0.0, 10.0)));
    }
}

/// Draws the controls of the player. Draws nothing if no edits are played.
pub(crate) fn ui(ui: &mut Ui, parts: &mut Parts) {
    let Some(player) = &mut parts.player else {
        return;
    };
    let mut closes = false;
    let mut exports = None;
    heading(ui, "Edits of the step", |ui| {
        closes = ui.small_button("Close").clicked();
        for (name, purpose) in [("APNG", Purpose::SaveApng), ("GIF", Purpose::SaveGif)] {
            let button = ui.add_enabled(parts.export.is_none(), Button::new(name).small());
            let button = button.accessible_name(format!("Export as {name}"));
            if button
                .on_hover_text("Save an animation of the edits, drawn as in the view")
                .clicked()
            {
                exports = Some(purpose);
            }
        }
    });
    let n = player.play.edits().len();
    let mut position = player.play.position();
    ui.horizontal(|ui| {
        if ui.button("Back").clicked() {
            position = position.saturating_sub(1);
            player.next = None;
        }
        let is_playing = player.next.is_some();
        if ui
            .button(if is_playing { "Pause" } else { "Play" })
            .clicked()
        {
            let from_start = !is_playing && position == n;
            position = if from_start { 0 } else { position };
            player.next = (!is_playing).then(|| ui.input(|input| input.time));
        }
        if ui.button("Next").clicked() {
            position = (position + 1).min(n);
            player.next = None;
        }
    });
    ui.add(Slider::new(&mut position, 0..=n).text("edits done"));
    ui.add(
        Slider::new(&mut player.speed, 0.5..=30.0)
            .logarithmic(true)
            .text("edits per second"),
    );
    if position != player.play.position() {
        player.go_to(position);
    }
    if let Some(edit) = player.shown() {
        let verb = if player.play.position() == 0 {
            "Next"
        } else {
            "Done"
        };
        edit_ui(ui, verb, edit);
    }
    ui.add_space(12.0);
    if closes {
        parts.player = None;
    } else if let Some(purpose) = exports {
        let ctx = ui.ctx().clone();
        paths::ask(parts, purpose, &ctx);
    }
}

/// Draws the name of an edit, the pointers that the edit changes and, if the edit was refused, the reason.
fn edit_ui(ui: &mut Ui, verb: &str, edit: &PlayedEdit) {
    let colors = Colors::current(ui);
    ui.label(RichText::new(format!("{verb}: {}", edit.name)).color(colors.picked));
    if let Some(refused) = &edit.refused {
        let text = RichText::new(format!("refused: {refused}")).size(12.0);
        ui.add(Label::new(text.color(colors.warning)).wrap());
        return;
    }
    Grid::new("pointers")
        .num_columns(4)
        .spacing([10.0, 2.0])
        .show(ui, |ui| {
            for name in ["half-edge", "next", "origin", "face"] {
                ui.label(RichText::new(name).size(11.0).color(colors.weak));
            }
            ui.end_row();
            for change in edit.pointers.iter().take(MAX_POINTERS) {
                let id = |h: HalfEdgeId| h.index().to_string();
                cell(
                    ui,
                    &colors,
                    [Some(id(change.half_edge)), Some(id(change.half_edge))],
                );
                let both = [change.before, change.after];
                let column = |of: fn(Pointers) -> String| both.map(|side| side.map(of));
                cell(ui, &colors, column(|p| p.next.index().to_string()));
                cell(ui, &colors, column(|p| p.origin.index().to_string()));
                let face = |p: Pointers| {
                    p.face
                        .map_or_else(|| "none".to_owned(), |f| f.index().to_string())
                };
                cell(ui, &colors, column(face));
                ui.end_row();
            }
        });
    if let Some(more) = edit.pointers.len().checked_sub(MAX_POINTERS + 1) {
        ui.label(RichText::new(format!("and {} more half-edges", more + 1)).size(11.0));
    }
}

/// Draws a value before and after an edit.
fn cell(ui: &mut Ui, colors: &Colors, [before, after]: [Option<String>; 2]) {
    let (text, color) = match (before, after) {
        (Some(before), Some(after)) if before == after => (before, colors.weak),
        (Some(before), Some(after)) => (format!("{before} → {after}"), colors.text),
        (None, Some(after)) => (format!("+ {after}"), colors.good),
        (Some(before), None) => (format!("- {before}"), colors.bad),
        (None, None) => (String::new(), colors.weak),
    };
    ui.label(RichText::new(text).monospace().size(11.0).color(color));
}
