//! Performs the actions of keys, menus and buttons.

use editor::{Action, Command, Editor, FieldKind, Panel, Picked, Walk, walk};
use eframe::egui;
use mesh::Element;
use op::{ElementKind, Selected};
use render::Shading;

use super::{Parts, Pending};
use crate::files;
use crate::gpu::Wireframe;
use crate::inspector::Draft;
use crate::palette::Palette;
use crate::paths::{self, Purpose};
use crate::view_pane::Tool;

impl Parts {
    /// Performs the action of a key or a menu.
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
            Action::Tag => self.tag(),
            Action::Move => self.toggle_tool(Tool::Move),
            Action::Rotate => self.toggle_tool(Tool::Rotate),
            Action::Scale => self.toggle_tool(Tool::Scale),
            Action::Information => self.shows_information = !self.shows_information,
            Action::Help => self.shows_help = !self.shows_help,
            Action::ResetView => self.view.reset(),
            Action::Fit => self.fit(),
            Action::Palette => self.palette = Some(Palette::new(&self.editor)),
            Action::Undo => {
                self.editor.undo();
            }
            Action::Redo => {
                self.editor.redo();
            }
            Action::Save => files::save(self, ctx),
            Action::SaveAs => paths::ask(self, Purpose::SaveRecipe, ctx),
            Action::Open => paths::ask(self, Purpose::Open, ctx),
            Action::New => self.drop_document(Pending::New, ctx),
            Action::Quit => self.drop_document(Pending::Close, ctx),
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
            Action::Grow => self.change_picked(Picked::grown),
            Action::Shrink => self.change_picked(Picked::shrunk),
            Action::EdgeLoop => self.pick_through("EdgeLoop"),
            Action::EdgeRing => self.pick_through("EdgeRing"),
            Action::Path => self.pick_path(),
            Action::ByAngle => self.pick_by_angle(),
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

    /// Handles the choice of an operation in the palette: applies the operation, or opens its panel if the operation
    /// needs a parameter.
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

    /// Opens the panel of a step that tags the picked elements.
    fn tag(&mut self) {
        match self.editor.picked().map(Picked::kind) {
            Some(ElementKind::Vertices) => self.choose("TagVertices"),
            Some(ElementKind::Edges) => self.choose("TagEdges"),
            Some(ElementKind::Faces) => self.choose("TagFaces"),
            None => self.inform("Pick elements first: the tag marks the picked elements."),
        }
    }

    /// Shows the handles of a tool, or hides them.
    fn toggle_tool(&mut self, tool: Tool) {
        let view = &mut self.view;
        view.tool = (view.tool != Some(tool)).then_some(tool);
        if view.tool.is_some() && self.editor.picked().is_none() {
            self.inform("Pick elements first: the handles appear at the picked elements.");
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
            // If no half-edge is picked yet, the first walk only picks a half-edge of the picked element.
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
            || self.prompt.take().is_some()
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
}
