//! Picks elements: by events of the view, by selections, and by keys.

use std::sync::Arc;

use editor::Picked;
use mesh::{DVec3, Element, HalfEdgeId, Mesh};
use op::Selected;
use scene::Scene;

use super::Parts;
use crate::view_pane::ViewEvent;

impl Parts {
    pub(super) fn view_event(&mut self, event: ViewEvent, scene: &Scene) {
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
            ViewEvent::Area { picked, extends } => {
                let mut all = self.editor.picked().cloned().filter(|_| extends);
                for new in &picked {
                    match &mut all {
                        Some(all) => all.add(new),
                        None => all = Some(new.clone()),
                    }
                }
                self.editor.set_picked(all);
            }
            ViewEvent::Move { offset, is_done } => {
                let result = self.editor.move_picked(offset, !is_done);
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

    /// Returns where the arrows that move the picked elements are shown: at the mean of their vertices, in scene units.
    pub(super) fn base(&self) -> Option<DVec3> {
        if !self.view.shows_arrows || self.player.is_some() {
            return None;
        }
        self.editor.picked_center()
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

    pub(super) fn around_picked(&mut self, function: &str) {
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

    pub(super) fn pick_all(&mut self) {
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
