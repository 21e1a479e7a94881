//! The application: an editor, a view, and the panels around it.

mod actions;
mod documents;
mod layout;
mod picks;
mod remembered;
mod start;

use std::fmt::Display;
use std::sync::Arc;
use std::time::{Duration, Instant};

use editor::{Action, Editor, FileChange, Keys};
use eframe::egui::{self, Ui};
use eframe::egui_wgpu;
use egui_tiles::Tree;
use mesh::Mesh;
use scene::ErrorLocation;

use crate::export::Export;
use crate::inspector::Draft;
use crate::palette::Palette;
use crate::paths::Prompt;
use crate::player::Player;
use crate::text_pane::TextPane;
use crate::view_pane::{Loss, Shown, ViewPane};
use crate::{controls, files, help, keyboard, overlay, paths, theme, top_bar};
pub(crate) use documents::Pending;
use layout::Pane;
pub(crate) use remembered::Remembered;
pub use start::{Opened, Start};

/// The time after which the window shows the progress of a run.
const LONG: Duration = Duration::from_millis(100);

/// The longest time for which the first frame waits for the scene. Without this wait, a window that opens a file would
/// first draw an empty scene.
const FIRST_FRAME: Duration = Duration::from_millis(250);

/// A message at the top of the view.
#[derive(Clone, Debug)]
pub(crate) struct Notice {
    pub(crate) text: String,
    pub(crate) is_error: bool,
}

impl Notice {
    pub(crate) fn error(message: impl Display) -> Self {
        Self {
            text: message.to_string(),
            is_error: true,
        }
    }
}

/// The window of the editor.
pub struct App {
    pub(crate) parts: Parts,
    tree: Tree<Pane>,
    /// The layout that is stored in the state folder.
    remembered: Remembered,
}

/// All state of the window except for the layout of its tiles.
#[expect(
    clippy::struct_excessive_bools,
    reason = "the flags are independent of each other"
)]
pub(crate) struct Parts {
    pub(crate) editor: Editor,
    pub(crate) view: ViewPane,
    pub(crate) text: TextPane,
    pub(crate) keys: Keys,
    pub(crate) palette: Option<Palette>,
    /// An operation whose parameters are being chosen.
    pub(crate) draft: Option<Draft>,
    /// Plays the edits of a step in the view. `None` if no step is played.
    pub(crate) player: Option<Player>,
    /// The parameter whose slider is dragged: its step (`None` for a parameter of the recipe), its name, and its value.
    pub(crate) dragged: Option<(Option<usize>, String, String)>,
    pub(crate) shows_help: bool,
    pub(crate) shows_information: bool,
    pub(crate) notice: Option<Notice>,
    pub(crate) files: files::Files,
    /// Whether the program asks for paths with dialogs of the system.
    pub(crate) has_dialogs: bool,
    /// A path that the user is typing in the window.
    pub(crate) prompt: Option<Prompt>,
    /// An animation that is being written.
    pub(crate) export: Option<Export>,
    /// The action that waits until the user has decided about the unsaved changes.
    pub(crate) pending: Option<Pending>,
    /// The time at which the run in progress started.
    running_since: Option<Instant>,
    /// The places of errors that are shown in the view.
    places: Vec<ErrorLocation>,
    description: String,
    is_closing: bool,
}

impl App {
    /// Creates the window's contents. Opens the file of `start`, if there is one.
    pub fn new(ctx: &egui::Context, gpu: Option<&egui_wgpu::RenderState>, start: Start) -> Self {
        Self::with(ctx, gpu, start.open())
    }

    /// Creates the contents of a window. `opened` has the editor, which was created before the window.
    pub fn with(ctx: &egui::Context, gpu: Option<&egui_wgpu::RenderState>, opened: Opened) -> Self {
        theme::apply(ctx);
        let Opened {
            editor,
            files,
            notice,
            start,
        } = opened;
        let wake = ctx.clone();
        editor.on_wake(Arc::new(move || wake.request_repaint()));
        let mut parts = Parts {
            editor,
            view: ViewPane::new(gpu),
            text: TextPane::default(),
            keys: Keys::default(),
            palette: None,
            draft: None,
            player: None,
            dragged: None,
            shows_help: false,
            shows_information: false,
            notice: None,
            files,
            has_dialogs: start.has_dialogs,
            prompt: None,
            export: None,
            pending: None,
            running_since: None,
            places: Vec::new(),
            description: String::new(),
            is_closing: false,
        };
        parts.wait_for_scene(FIRST_FRAME);
        parts.read_keys();
        if notice.is_some() {
            parts.notice = notice;
        }
        let mut tree = layout::initial();
        let remembered = Remembered::read(start.state_folder.as_deref());
        remembered.apply(ctx, &mut tree);
        Self {
            parts,
            tree,
            remembered,
        }
    }

    /// Returns the editor.
    pub fn editor(&self) -> &Editor {
        &self.parts.editor
    }

    /// Returns the errors of the graphics device.
    pub(crate) fn loss(&self) -> Loss {
        self.parts.view.loss.clone()
    }

    /// Returns a mutable reference to the editor.
    pub fn editor_mut(&mut self) -> &mut Editor {
        &mut self.parts.editor
    }

    /// Returns where the view shows a point of the scene, in logical pixels from the upper left corner of the view.
    /// `None` if the point is behind the camera.
    pub fn pixel_of(&self, point: mesh::DVec3) -> Option<[f64; 2]> {
        self.parts.view.pixel_of(point).map(|at| at.to_array())
    }

    /// Returns a mutable reference to the settings that determine how the scene is drawn.
    pub fn look_mut(&mut self) -> &mut crate::gpu::Look {
        &mut self.parts.view.look
    }
}

impl eframe::App for App {
    fn logic(&mut self, ctx: &egui::Context, _: &mut eframe::Frame) {
        self.parts.poll(ctx);
    }

    fn ui(&mut self, ui: &mut Ui, _: &mut eframe::Frame) {
        let ctx = ui.ctx().clone();
        self.parts.dropped_files(&ctx);
        for action in keyboard::actions(
            &ctx,
            &self.parts.keys,
            self.parts.is_modal(),
            self.parts.view.id,
        ) {
            self.parts.act(action, &ctx);
        }
        top_bar::top(ui, &mut self.parts);
        top_bar::status(ui, &mut self.parts);
        let frame = egui::Frame::new().fill(theme::Colors::current(ui).line);
        egui::CentralPanel::no_frame().frame(frame).show(ui, |ui| {
            self.tree.ui(&mut self.parts, ui);
        });
        self.parts.windows(&ctx);
        self.parts.closing(&ctx);
        self.remember(&ctx);
    }
}

impl Parts {
    /// Closes the window if the graphics device is lost, because nothing can be drawn any more.
    fn check_device(&mut self, ctx: &egui::Context) {
        if self.view.loss.reason().is_some() {
            if !self.is_closing {
                self.editor.leave_journal();
                self.is_closing = true;
                ctx.send_viewport_cmd(egui::ViewportCommand::Close);
            }
        } else if let Some(error) = self.view.loss.take_error() {
            self.warn(format!("The graphics adapter reports an error: {error}"));
        }
    }

    /// Waits until there is a scene or the run has ended, but not longer than the given time.
    fn wait_for_scene(&mut self, time: Duration) {
        let end = Instant::now() + time;
        let is_waiting = |editor: &Editor| {
            editor.is_running() && editor.view().scene.objects().is_empty() && Instant::now() < end
        };
        while is_waiting(&self.editor) {
            std::thread::sleep(Duration::from_millis(1));
            self.editor.poll();
        }
        self.places = self.places_of_errors();
    }

    /// Handles the changes that the editor reports, and requests repaints while a run is in progress.
    fn poll(&mut self, ctx: &egui::Context) {
        self.check_device(ctx);
        if let Some(update) = self.editor.poll() {
            match update.file {
                Some(FileChange::Reloaded) => {
                    self.inform("The file was changed by another program, and was read again.");
                }
                Some(FileChange::Removed) => {
                    self.inform("The file of the recipe was removed. Save to write it again.");
                }
                Some(FileChange::Unreadable(message)) => self.warn(message),
                Some(FileChange::Conflict) | None => {}
            }
            self.places = self.places_of_errors();
            ctx.request_repaint();
        }
        if self.editor.is_running() {
            self.running_since.get_or_insert_with(Instant::now);
            // The progress of a run sends no event, so a repaint is requested here.
            ctx.request_repaint_after(LONG);
        } else {
            self.running_since = None;
        }
    }

    /// Whether the run takes so long that the window shows its progress.
    pub(crate) fn runs_long(&self) -> bool {
        self.running_since
            .is_some_and(|since| since.elapsed() >= LONG)
    }

    /// Returns the locations in the scene that the failures of the newest run refer to.
    fn places_of_errors(&self) -> Vec<ErrorLocation> {
        let failures = self.editor.run().failures.iter();
        failures
            .flat_map(|failure| failure.places.clone())
            .collect()
    }

    /// Returns the first key of an action, for hints.
    pub(crate) fn editor_key(&self, action: Action) -> String {
        self.keys.of(action).first().cloned().unwrap_or_default()
    }

    /// Whether a dialog receives the keyboard input.
    fn is_modal(&self) -> bool {
        self.palette.is_some() || self.pending.is_some() || self.prompt.is_some() || self.shows_help
    }

    pub(crate) fn inform(&mut self, text: impl Into<String>) {
        self.notice = Some(Notice {
            text: text.into(),
            is_error: false,
        });
    }

    pub(crate) fn warn(&mut self, text: impl Into<String>) {
        self.notice = Some(Notice::error(text.into()));
    }

    /// Shows the error of an edit, if there is one.
    pub(crate) fn report<E: Display>(&mut self, result: Result<(), E>) {
        match result {
            Ok(()) => self.notice = None,
            Err(error) => self.warn(error.to_string()),
        }
    }

    fn read_keys(&mut self) {
        match self.files.read_keys() {
            Some(Ok(keys)) => self.keys = keys,
            Some(Err(message)) => self.warn(message),
            None => {}
        }
    }

    fn windows(&mut self, ctx: &egui::Context) {
        help::ui(ctx, self);
        crate::palette::ui(ctx, self);
        files::question(ctx, self);
        paths::ui(ctx, self);
    }

    /// Returns the mesh with the picked elements.
    pub(crate) fn picked_mesh(&self) -> Option<Arc<Mesh>> {
        let picked = self.editor.picked()?;
        let scene = self.editor.view().scene;
        scene.object(&picked.object)?.as_mesh().cloned()
    }

    fn view_ui(&mut self, ui: &mut Ui) {
        self.advance_player(ui);
        self.show_exported();
        let view = self.editor.view();
        let picked = self.editor.picked().cloned();
        self.description = match (&picked, self.picked_mesh()) {
            (Some(picked), Some(mesh)) => overlay::describe(&mesh, picked),
            _ => String::new(),
        };
        let rect = ui.max_rect();
        let gizmo = self.gizmo();
        let player = self.player.as_ref();
        let shown = Shown {
            scene: Some(player.map_or(&view.scene, Player::scene)),
            picked: picked.as_ref().filter(|_| player.is_none()),
            edge: player.and_then(Player::edge),
            gizmo,
            can_pick: player.is_none(),
            places: &self.places,
            indexes: self.editor.indexes(),
            description: &self.description,
            is_stale: !view.is_current && (self.runs_long() || !self.editor.is_running()),
        };
        let events = self.view.ui(ui, &shown);
        for event in events {
            self.view_event(event, &view.scene);
        }
        self.take_exported(ui.ctx());
        controls::over_view(ui, rect, self);
    }

    /// Returns the description of the picked elements.
    pub(crate) fn description(&self) -> &str {
        &self.description
    }
}
