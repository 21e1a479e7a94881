//! Picks elements: by events of the view, by selections, and by keys.

use std::sync::Arc;

use editor::Picked;
use mesh::{DVec3, Element, HalfEdgeId, Mesh};
use op::Selected;
use scene::Scene;

use super::Parts;
use crate::view_pane::{Gizmo, Tool, ViewEvent};

/// If faces are picked up to sharp edges, an edge counts as sharp above this angle in degrees. The user can change this
/// angle in the text of the selection.
const ANGLE: u32 = 30;

impl Parts {
    pub(super) fn view_event(&mut self, event: ViewEvent, scene: &Scene) {
        let picks = matches!(event, ViewEvent::Click { .. } | ViewEvent::Area { .. });
        if picks && self.draft.is_some() && self.editor.is_preview() {
            // The new step acts on elements of the scene before this step. Therefore the preview ends here: elements of
            // the preview cannot be picked for the step.
            self.editor.end_preview();
            self.inform(
                "The view now shows the scene before the new step: pick the elements here.",
            );
            return;
        }
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
            ViewEvent::Area { picked, removes } => {
                let mut all = self.editor.picked().cloned();
                for new in &picked {
                    match &mut all {
                        Some(all) if removes => all.remove(new),
                        None if removes => {}
                        Some(all) => all.add(new),
                        None => all = Some(new.clone()),
                    }
                }
                self.editor.set_picked(all);
            }
            ViewEvent::Move { by, is_done } => {
                let result = self.editor.move_picked(by, !is_done);
                self.report(result);
            }
            ViewEvent::MoveControlPoint {
                object,
                index,
                to,
                is_done,
            } => {
                let moved = self.editor.move_control_point(&object, index, to, !is_done);
                self.report(moved);
            }
        }
    }

    /// Returns the handles at the picked elements.
    pub(super) fn gizmo(&self) -> Option<Gizmo> {
        let tool = self.view.tool?;
        if self.player.is_some() || self.draft.is_some() {
            return None;
        }
        Some(Gizmo {
            tool,
            base: self.editor.picked_center()?,
            axes: match tool {
                Tool::Move => [DVec3::X, DVec3::Y, DVec3::Z],
                Tool::Rotate | Tool::Scale => self.editor.picked_axes(),
            },
        })
    }

    fn pick_edge_loop(&mut self, mesh: &Mesh, object: &str, half_edge: Option<HalfEdgeId>) {
        let Some(h) = half_edge else { return };
        self.editor
            .set_picked(Some(Picked::one(object, Element::HalfEdge(h))));
        let [v, w] = [mesh.origin(h), mesh.target(h)].map(mesh::VertexId::index);
        self.pick_checked(&format!("EdgeLoop(Between({v}, {w}))"));
    }

    /// Picks the elements that a selection selects, and uses this selection for the next step.
    pub(crate) fn pick_text(&mut self, text: &str) {
        let kind = self.view.mode.kind();
        let result = self.editor.pick_by_text(text, kind);
        self.report(result);
    }

    /// Like [`pick_text`](Self::pick_text), but stores the number of picked elements in the selection. The next step
    /// then fails if the selection selects another number of elements.
    fn pick_checked(&mut self, text: &str) {
        self.pick_text(text);
        let n = self.editor.picked().map(Picked::len);
        if let Some(n) = n.filter(|_| self.notice.is_none()) {
            self.pick_text(&format!("Expect(count: {n}, of: {text})"));
        }
    }

    /// Picks the shortest path between two picked vertices.
    pub(super) fn pick_path(&mut self) {
        let picked = self.editor.picked().map(|picked| &picked.elements);
        let Some(Selected::Vertices(list)) = picked else {
            self.inform("Pick the two vertices at the ends of the path first.");
            return;
        };
        if let [from, to] = list[..] {
            self.pick_checked(&format!("Path(from: {}, to: {})", from.index(), to.index()));
        } else {
            self.inform("A path has two ends: pick two vertices.");
        }
    }

    /// Picks the faces around the picked faces, up to edges that are sharper than an angle.
    pub(super) fn pick_by_angle(&mut self) {
        let picked = self.editor.picked().map(|picked| &picked.elements);
        let Some(Selected::Faces(list)) = picked else {
            self.inform(
                "Pick a face first. This command then picks the faces around it, up to sharp edges.",
            );
            return;
        };
        let ids: Vec<String> = list.iter().map(|f| f.index().to_string()).collect();
        let of = format!("Faces([{}])", ids.join(", "));
        self.pick_checked(&format!("Expand(to_angle: {ANGLE}, of: {of})"));
    }

    /// Replaces the picked elements by those that `change` returns, unless `change` returns no elements.
    pub(super) fn change_picked(&mut self, change: impl Fn(&Picked, &Mesh) -> Picked) {
        if let (Some(mesh), Some(picked)) = (self.picked_mesh(), self.editor.picked()) {
            let new = change(picked, &mesh);
            if !new.is_empty() {
                self.editor.set_picked(Some(new));
            }
        }
    }

    /// Picks the edge loops or the edge rings through the picked edges.
    pub(super) fn pick_through(&mut self, function: &str) {
        let scene = self.editor.view().scene;
        self.change_picked(|picked, mesh| {
            let mut all = picked.clone();
            let Selected::Edges(list) = &picked.elements else {
                return all;
            };
            // If an edge is in the loop or ring of an earlier edge, the edge is skipped.
            let mut rest = list.clone();
            while let Some(e) = rest.first() {
                let [v, w] = mesh.edge_vertices(*e).map(mesh::VertexId::index);
                let text = format!("{function}(Between({v}, {w}))");
                let kind = Some(op::ElementKind::Edges);
                let Ok(new) = Picked::by_text(&scene, &picked.object, &text, kind) else {
                    return all;
                };
                let is_new = |e: &mesh::EdgeId| !new.contains(Element::Edge(*e));
                rest = rest.split_off(1);
                rest.retain(is_new);
                all.add(&new);
            }
            all
        });
    }

    pub(super) fn pick_all(&mut self) {
        let scene = self.editor.view().scene;
        let Some((name, mesh)) = scene
            .objects()
            .iter()
            .find_map(|o| Some((o.name.clone(), o.as_mesh()?.clone())))
        else {
            return;
        };
        let all = Picked::all(&name, &mesh, self.view.mode.kind());
        self.editor.set_picked(Some(all));
    }
}

fn mesh_of(scene: &Scene, object: &str) -> Option<Arc<Mesh>> {
    scene.object(object)?.as_mesh().cloned()
}
