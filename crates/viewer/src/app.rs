//! The application: an editor, a view, and the panels around it.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use editor::{
    Action, Command, Editor, FieldKind, FileChange, Keys, Panel, Picked, Settings, Walk, walk,
};
use eframe::egui::{self, Ui, ViewportCommand};
use eframe::egui_wgpu;
use egui_tiles::{Tile, TileId, Tiles, Tree, UiResponse};
use mesh::{Element, HalfEdgeId, Mesh};
use op::Selected;
use render::Shading;
use scene::{ErrorLocation, Scene};

use crate::gpu::Wireframe;
use crate::inspector::Draft;
use crate::palette::Palette;
use crate::text_pane::TextPane;
use crate::view_pane::{Shown, ViewEvent, ViewPane};
use crate::{bars, files, help, inspector, keyboard, overlay, steps_pane, theme};

/// A tile of the window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Pane {
    /// The steps and expectations.
    Steps,
    /// The text of the recipe.
    Text,
    /// The picture.
    View,
    /// The picked elements and the parameters of a step.
    Inspector,
}

/// A message at the top of the view.
#[derive(Clone, Debug)]
pub(crate) struct Notice {
    pub(crate) text: String,
    pub(crate) is_error: bool,
}

/// What to open at the start.
#[derive(Clone, Debug, Default)]
pub struct Start {
    /// A model or a recipe.
    pub path: Option<PathBuf>,
    /// The folder for the list of recent files and the recovery of texts. If omitted, nothing is stored.
    pub state_folder: Option<PathBuf>,
}

/// The window of the editor.
pub struct App {
    pub(crate) parts: Parts,
    tree: Tree<Pane>,
}

/// Everything except for the layout of the tiles.
pub(crate) struct Parts {
    pub(crate) editor: Editor,
    pub(crate) view: ViewPane,
    pub(crate) text: TextPane,
    pub(crate) keys: Keys,
    pub(crate) palette: Option<Palette>,
    /// An operation whose parameters are being chosen.
    pub(crate) draft: Option<Draft>,
    /// The value of a parameter while its slider is dragged: the step or none for the recipe, the name, and the value.
    pub(crate) dragged: Option<(Option<usize>, String, String)>,
    pub(crate) shows_help: bool,
    pub(crate) shows_information: bool,
    pub(crate) notice: Option<Notice>,
    pub(crate) files: files::Files,
    /// What the user wants to do although the recipe has unsaved changes.
    pub(crate) pending: Option<Pending>,
    /// The places of errors that are shown in the view.
    places: Vec<ErrorLocation>,
    description: String,
    is_closing: bool,
}

/// An action that drops the document.
#[derive(Clone, Debug)]
pub(crate) enum Pending {
    /// Start a new recipe.
    New,
    /// Open a file.
    Open(PathBuf),
    /// Close the window.
    Close,
}

impl App {
    /// Creates the window's contents. Opens the file of `start`, if there is one.
    pub fn new(ctx: &egui::Context, gpu: Option<&egui_wgpu::RenderState>, start: &Start) -> Self {
        theme::apply(ctx);
        let registry = Arc::new(ops_all::registry());
        // Before this editor has a journal of its own.
        let files = files::Files::new(start.state_folder.clone());
        let settings = Settings {
            journals: files::journals(start.state_folder.as_deref()),
            ..Settings::default()
        };
        let editor = Editor::new(registry, Arc::new(engine::Disk), settings);
        let wake = ctx.clone();
        editor.on_wake(Arc::new(move || wake.request_repaint()));
        let mut parts = Parts {
            editor,
            view: ViewPane::new(gpu),
            text: TextPane::default(),
            keys: Keys::default(),
            palette: None,
            draft: None,
            dragged: None,
            shows_help: false,
            shows_information: false,
            notice: None,
            files,
            pending: None,
            places: Vec::new(),
            description: String::new(),
            is_closing: false,
        };
        parts.read_keys();
        if let Some(path) = &start.path {
            parts.open(path);
        }
        Self {
            parts,
            tree: layout(),
        }
    }

    /// Returns the editor.
    pub fn editor(&self) -> &Editor {
        &self.parts.editor
    }

    /// Returns the editor, mutably.
    pub fn editor_mut(&mut self) -> &mut Editor {
        &mut self.parts.editor
    }

    /// Returns the position of a point of the scene in the view, in points from the upper left corner of the view. `None` if
    /// the point is behind the camera.
    pub fn pixel_of(&self, point: mesh::DVec3) -> Option<[f64; 2]> {
        self.parts.view.pixel_of(point).map(|at| at.to_array())
    }

    /// Sets how the scene is drawn.
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
        for action in keyboard::actions(&ctx, &self.parts.keys, self.parts.is_modal()) {
            self.parts.act(action, &ctx);
        }
        bars::top(ui, &mut self.parts);
        bars::status(ui, &mut self.parts);
        let frame = egui::Frame::new().fill(theme::Colors::current(ui).line);
        egui::CentralPanel::no_frame().frame(frame).show(ui, |ui| {
            self.tree.ui(&mut self.parts, ui);
        });
        self.parts.windows(&ctx);
        self.parts.closing(&ctx);
    }
}

/// Returns the tiles: steps and text at the left, the view in the middle, the inspector at the right.
fn layout() -> Tree<Pane> {
    let mut tiles = Tiles::default();
    let [steps, text, view, inspector] =
        [Pane::Steps, Pane::Text, Pane::View, Pane::Inspector].map(|pane| tiles.insert_pane(pane));
    let left = linear(
        &mut tiles,
        egui_tiles::LinearDir::Vertical,
        &[(steps, 0.52), (text, 0.48)],
    );
    let root = linear(
        &mut tiles,
        egui_tiles::LinearDir::Horizontal,
        &[(left, 0.25), (view, 0.52), (inspector, 0.23)],
    );
    Tree::new(egui::Id::unique("tiles"), root, tiles)
}

fn linear(
    tiles: &mut Tiles<Pane>,
    direction: egui_tiles::LinearDir,
    children: &[(TileId, f32)],
) -> TileId {
    let mut linear =
        egui_tiles::Linear::new(direction, children.iter().map(|(id, _)| *id).collect());
    for &(id, share) in children {
        linear.shares.set_share(id, share);
    }
    tiles.insert_new(Tile::Container(egui_tiles::Container::Linear(linear)))
}

impl egui_tiles::Behavior<Pane> for Parts {
    fn pane_ui(&mut self, ui: &mut Ui, _: TileId, pane: &mut Pane) -> UiResponse {
        let colors = theme::Colors::current(ui);
        ui.painter().rect_filled(ui.max_rect(), 0.0, colors.panel);
        match pane {
            Pane::View => self.view_ui(ui),
            Pane::Steps => steps_pane::ui(ui, self),
            Pane::Text => crate::text_pane::ui(ui, self),
            Pane::Inspector => inspector::ui(ui, self),
        }
        UiResponse::None
    }

    fn tab_title_for_pane(&mut self, pane: &Pane) -> egui::WidgetText {
        match pane {
            Pane::Steps => "Steps",
            Pane::Text => "Recipe",
            Pane::View => "View",
            Pane::Inspector => "Inspector",
        }
        .into()
    }

    fn simplification_options(&self) -> egui_tiles::SimplificationOptions {
        egui_tiles::SimplificationOptions {
            all_panes_must_have_tabs: false,
            ..egui_tiles::SimplificationOptions::default()
        }
    }

    fn gap_width(&self, _: &egui::Style) -> f32 {
        1.0
    }
}

impl Parts {
    /// Takes the results of the engine.
    fn poll(&mut self, ctx: &egui::Context) {
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
            // Progress has no event of its own.
            ctx.request_repaint_after(Duration::from_millis(100));
        }
    }

    /// Returns the places of failures in the scene at the cursor.
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

    /// Whether a dialog has the keyboard.
    fn is_modal(&self) -> bool {
        self.palette.is_some() || self.pending.is_some() || self.shows_help
    }

    pub(crate) fn inform(&mut self, text: impl Into<String>) {
        self.notice = Some(Notice {
            text: text.into(),
            is_error: false,
        });
    }

    pub(crate) fn warn(&mut self, text: impl Into<String>) {
        self.notice = Some(Notice {
            text: text.into(),
            is_error: true,
        });
    }

    /// Shows the error of an edit, if there is one.
    pub(crate) fn report<E: std::fmt::Display>(&mut self, result: Result<(), E>) {
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

    /// Opens a file, or reports why it cannot be opened.
    pub(crate) fn open(&mut self, path: &Path) {
        match self.editor.open(path) {
            Ok(()) => {
                self.files.remember(path);
                self.draft = None;
                self.notice = None;
                self.view.forget_fit();
            }
            Err(error) => self.warn(error.to_string()),
        }
    }

    /// Does something that drops the document, after a question if the document has unsaved changes.
    pub(crate) fn drop_document(&mut self, pending: Pending, ctx: &egui::Context) {
        if self.editor.document().is_dirty() && self.editor.document().undo_label().is_some() {
            self.pending = Some(pending);
        } else {
            self.proceed(pending, ctx);
        }
    }

    pub(crate) fn proceed(&mut self, pending: Pending, ctx: &egui::Context) {
        self.pending = None;
        match pending {
            Pending::New => {
                self.editor.new_recipe();
                self.draft = None;
                self.view.forget_fit();
            }
            Pending::Open(path) => self.open(&path),
            Pending::Close => {
                self.is_closing = true;
                ctx.send_viewport_cmd(ViewportCommand::Close);
            }
        }
    }

    fn closing(&mut self, ctx: &egui::Context) {
        if ctx.input(|input| input.viewport().close_requested()) && !self.is_closing {
            let is_dirty =
                self.editor.document().is_dirty() && self.editor.document().undo_label().is_some();
            if is_dirty {
                ctx.send_viewport_cmd(ViewportCommand::CancelClose);
                self.pending = Some(Pending::Close);
            }
        }
    }

    fn dropped_files(&mut self, ctx: &egui::Context) {
        let dropped = ctx.input(|input| {
            input
                .raw
                .dropped_files
                .first()
                .map(|file| file.path().to_owned())
        });
        if let Some(path) = dropped {
            self.drop_document(Pending::Open(path), ctx);
        }
    }

    fn windows(&mut self, ctx: &egui::Context) {
        help::ui(ctx, self);
        crate::palette::ui(ctx, self);
        files::question(ctx, self);
    }

    /// Returns the mesh with the picked elements.
    pub(crate) fn picked_mesh(&self) -> Option<Arc<Mesh>> {
        let picked = self.editor.picked()?;
        let scene = self.editor.view().scene;
        scene.object(&picked.object)?.as_mesh().cloned()
    }

    fn view_ui(&mut self, ui: &mut Ui) {
        let view = self.editor.view();
        let picked = self.editor.picked().cloned();
        self.description = match (&picked, self.picked_mesh()) {
            (Some(picked), Some(mesh)) => overlay::describe(&mesh, picked),
            _ => String::new(),
        };
        let rect = ui.max_rect();
        let shown = Shown {
            scene: Some(&view.scene),
            picked: picked.as_ref(),
            places: &self.places,
            indexes: self.editor.indexes(),
            description: &self.description,
            is_stale: !view.is_current && !self.editor.is_running(),
        };
        let events = self.view.ui(ui, &shown);
        for event in events {
            self.view_event(event, &view.scene);
        }
        bars::over_view(ui, rect, self);
    }

    /// Returns what is said about the picked elements.
    pub(crate) fn description(&self) -> &str {
        &self.description
    }

    fn view_event(&mut self, event: ViewEvent, scene: &Scene) {
        match event {
            ViewEvent::Click {
                hit: None, extends, ..
            } => {
                if !extends {
                    self.editor.set_picked(None);
                }
            }
            ViewEvent::Click {
                hit: Some(hit),
                extends,
                is_double,
            } => {
                let mut new = Picked::one(&hit.object, hit.element);
                new.half_edge = new.half_edge.and(hit.half_edge);
                if is_double
                    && let (Element::Edge(_) | Element::HalfEdge(_), Some(mesh)) =
                        (hit.element, mesh_of(scene, &hit.object))
                {
                    self.pick_edge_loop(&mesh, &hit.object, hit.half_edge);
                    return;
                }
                let picked = match self.editor.picked().cloned().filter(|_| extends) {
                    Some(mut picked) => {
                        picked.toggle(&new);
                        picked
                    }
                    None => new,
                };
                self.editor.set_picked(Some(picked));
            }
            ViewEvent::Box { picked, extends } => {
                let mut all = self.editor.picked().cloned().filter(|_| extends);
                for new in &picked {
                    match &mut all {
                        Some(all) => all.add(new),
                        None => all = Some(new.clone()),
                    }
                }
                self.editor.set_picked(all);
            }
        }
    }

    fn pick_edge_loop(&mut self, mesh: &Mesh, object: &str, half_edge: Option<HalfEdgeId>) {
        let Some(h) = half_edge else { return };
        let [v, w] = [mesh.origin(h), mesh.target(h)].map(mesh::VertexId::index);
        self.pick_text(
            object,
            mesh,
            &format!("EdgeLoop(Between({v}, {w}))"),
            op::ElementKind::Edges,
        );
    }

    /// Picks the elements of a selection.
    pub(crate) fn pick_text(
        &mut self,
        object: &str,
        mesh: &Mesh,
        text: &str,
        kind: op::ElementKind,
    ) {
        let scene = self.editor.view().scene;
        let found = scene.object(object).and_then(|of| {
            let elements = recipe::read_selection(text, Some(kind)).ok()?;
            recipe::resolve(&elements, &scene, of, mesh, "").ok()
        });
        if let Some(found) = found.filter(|found| !found.is_empty()) {
            let half_edge = self.editor.picked().and_then(|picked| picked.half_edge);
            let mut picked = Picked::new(object, found);
            picked.half_edge = half_edge.filter(|&h| picked.contains(Element::HalfEdge(h)));
            self.editor.set_picked(Some(picked));
        }
    }

    /// Does what a key or a menu asks for.
    pub(crate) fn act(&mut self, action: Action, ctx: &egui::Context) {
        match action {
            Action::Next => self.walk(Walk::Next),
            Action::Twin => self.walk(Walk::Twin),
            Action::Previous => self.walk(Walk::Previous),
            Action::AroundVertex => self.walk(Walk::AroundVertex),
            Action::Wireframe => {
                let look = &mut self.view.look;
                look.wireframe = if look.wireframe == Wireframe::None {
                    Wireframe::Shaded
                } else {
                    Wireframe::None
                };
            }
            Action::Smooth => {
                let look = &mut self.view.look;
                look.shading = if look.shading == Shading::Flat {
                    Shading::Smooth
                } else {
                    Shading::Flat
                };
            }
            Action::Information => self.shows_information = !self.shows_information,
            Action::Help => self.shows_help = !self.shows_help,
            Action::ResetView => self.view.reset(),
            Action::Fit => self.fit(),
            Action::Palette => self.palette = Some(Palette::default()),
            Action::Undo => {
                self.editor.undo();
            }
            Action::Redo => {
                self.editor.redo();
            }
            Action::Save => files::save(self),
            Action::SaveAs => files::save_as(self),
            Action::Open => {
                if let Some(path) = files::ask_open() {
                    self.drop_document(Pending::Open(path), ctx);
                }
            }
            Action::New => self.drop_document(Pending::New, ctx),
            Action::Cancel => self.cancel(),
            Action::NextProposal => self.editor.next_proposal(),
            Action::SelectNone => self.editor.set_picked(None),
            Action::StepBack => self
                .editor
                .set_cursor(self.editor.cursor().saturating_sub(1)),
            Action::StepForward => self.editor.set_cursor(self.editor.cursor() + 1),
            Action::DeleteStep => self.at_cursor(Editor::delete_step),
            Action::DuplicateStep => self.at_cursor(Editor::duplicate_step),
            Action::ToggleStep => self.at_cursor(|editor, step| {
                let is_enabled = editor
                    .outline()
                    .steps
                    .get(step)
                    .is_none_or(|step| step.enabled);
                editor.set_enabled(step, !is_enabled)
            }),
            Action::PickVertices => self.view.mode = editor::PickMode::Vertex,
            Action::PickEdges => self.view.mode = editor::PickMode::Edge,
            Action::PickFaces => self.view.mode = editor::PickMode::Face,
            Action::PickHalfEdges => self.view.mode = editor::PickMode::HalfEdge,
            Action::Grow => self.around_picked("Grow"),
            Action::Shrink => self.around_picked("Shrink"),
            Action::EdgeLoop => self.around_picked("EdgeLoop"),
            Action::EdgeRing => self.around_picked("EdgeRing"),
            Action::SelectAll => self.pick_all(),
            _ => {
                if let Some(command) = self.editor.command_of(action) {
                    self.apply(&command);
                }
            }
        }
        ctx.request_repaint();
    }

    /// Applies a command, or opens its panel if a parameter is missing.
    pub(crate) fn apply(&mut self, command: &Command) {
        match self.editor.apply(command) {
            Ok(()) => {
                self.notice = None;
                self.draft = None;
            }
            Err(error) => self.warn(error.to_string()),
        }
    }

    /// Chooses an operation from the palette: applies it, or opens its panel if it needs a parameter.
    pub(crate) fn choose(&mut self, operation: &str) {
        let selection = self.editor.selection();
        let Some(entry) = self.editor.registry().get(operation) else {
            return;
        };
        let panel = Panel::new(entry);
        let needs = |field: &editor::PanelField| {
            field.is_missing() && !matches!(field.kind.inner(), FieldKind::Selection(_))
        };
        let takes_selection = panel
            .fields
            .iter()
            .any(|field| matches!(field.kind.inner(), FieldKind::Selection(_)));
        let command = Command {
            selection: selection.filter(|_| takes_selection),
            ..Command::new(operation)
        };
        if !panel.fields.iter().any(needs) && self.editor.steps_of(&command).is_ok() {
            self.apply(&command);
        } else {
            self.draft = Some(Draft::new(panel, entry.example));
        }
    }

    fn walk(&mut self, step: Walk) {
        let (Some(mesh), Some(picked)) = (self.picked_mesh(), self.editor.picked().cloned()) else {
            self.inform("Pick an edge first: the keys N, T, P and V walk from its half-edge.");
            return;
        };
        let start = picked.half_edge.or_else(|| match &picked.elements {
            Selected::Vertices(list) => list.first().and_then(|&v| mesh.vertex_half_edge(v)),
            Selected::Edges(list) => list.first().map(|e| e.half_edge()),
            Selected::Faces(list) => list.first().map(|&f| mesh.face_half_edge(f)),
        });
        if let Some(h) = start.filter(|h| mesh.has_edge(h.edge())) {
            // The first step from a vertex or a face shows its half-edge.
            let to = if picked.half_edge.is_some() {
                walk(&mesh, h, step)
            } else {
                h
            };
            self.editor
                .set_picked(Some(Picked::one(&picked.object, Element::HalfEdge(to))));
        }
    }

    fn fit(&mut self) {
        let points: Vec<mesh::DVec3> = match (self.editor.picked(), self.picked_mesh()) {
            (Some(picked), Some(mesh)) => match &picked.elements {
                Selected::Vertices(list) => list.iter().map(|&v| mesh.position(v)).collect(),
                Selected::Edges(list) => list
                    .iter()
                    .flat_map(|&e| mesh.element_points(Element::Edge(e)))
                    .collect(),
                Selected::Faces(list) => list
                    .iter()
                    .flat_map(|&f| mesh.element_points(Element::Face(f)))
                    .collect(),
            },
            _ => Vec::new(),
        };
        if points.is_empty() {
            self.view.fit();
        } else {
            self.view.fit_points(&points);
        }
    }

    fn cancel(&mut self) {
        if self.palette.take().is_some()
            || std::mem::take(&mut self.shows_help)
            || self.pending.take().is_some()
        {
            return;
        }
        if self.draft.take().is_some() {
            self.editor.end_preview();
        } else if self.editor.is_running() {
            self.editor.cancel();
        } else {
            self.editor.set_picked(None);
            self.notice = None;
        }
    }

    fn at_cursor(&mut self, edit: impl Fn(&mut Editor, usize) -> Result<(), editor::CommandError>) {
        if let Some(step) = self.editor.cursor().checked_sub(1) {
            let result = edit(&mut self.editor, step);
            self.report(result);
        }
    }

    fn around_picked(&mut self, function: &str) {
        let (Some(mesh), Some(picked)) = (self.picked_mesh(), self.editor.picked().cloned()) else {
            return;
        };
        let inner = match &picked.elements {
            Selected::Vertices(list) => list_of("Vertices", list.iter().map(|v| v.index())),
            Selected::Faces(list) => list_of("Faces", list.iter().map(|f| f.index())),
            Selected::Edges(list) => {
                let between = list.iter().map(|&e| {
                    let [v, w] = mesh.edge_vertices(e).map(mesh::VertexId::index);
                    format!("Between({v}, {w})")
                });
                format!("Or([{}])", between.collect::<Vec<_>>().join(", "))
            }
        };
        self.pick_text(
            &picked.object,
            &mesh,
            &format!("{function}({inner})"),
            picked.kind(),
        );
    }

    fn pick_all(&mut self) {
        let scene = self.editor.view().scene;
        let Some((name, mesh)) = scene
            .objects()
            .iter()
            .find_map(|o| Some((o.name.clone(), o.as_mesh()?.clone())))
        else {
            return;
        };
        let kind = match self.view.mode {
            editor::PickMode::Vertex => op::ElementKind::Vertices,
            editor::PickMode::Edge | editor::PickMode::HalfEdge => op::ElementKind::Edges,
            _ => op::ElementKind::Faces,
        };
        self.pick_text(&name, &mesh, "All", kind);
    }
}

fn mesh_of(scene: &Scene, object: &str) -> Option<Arc<Mesh>> {
    scene.object(object)?.as_mesh().cloned()
}

fn list_of(name: &str, items: impl Iterator<Item = usize>) -> String {
    let items: Vec<String> = items.map(|i| i.to_string()).collect();
    format!("{name}([{}])", items.join(", "))
}
