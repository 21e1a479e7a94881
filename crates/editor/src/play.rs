//! Plays the local edits of a step one by one, forwards and backwards. For each edit, also finds out which pointers of
//! half-edges the edit changes.

use std::sync::Arc;

use mesh::{Change, Domain, EdgeId, EditError, FaceId, HalfEdgeId, Mesh, VertexId};
use op::{EdgeSelection, Elements, Selected};
use recipe::{read_selection, resolve};
use ron_tree::{Value, ValueKind};
use scene::{Object, Scene};

use crate::edit::Editor;

/// The maximum number of edits that are played.
const MAX_EDITS: usize = 10_000;

/// The name of the operation for Loop subdivision. One level of this subdivision can be played as splits, flips and
/// moves of vertices.
const LOOP: &str = "LoopSubdivide";

/// The local edits of a step, and the number of edits that have been made so far.
#[derive(Debug)]
pub struct Play {
    mesh: Mesh,
    edits: Vec<PlayedEdit>,
    /// For each edit, the change of the mesh that undoes the edit (if the edit has been made) or makes the edit (if
    /// not).
    changes: Vec<Option<Change>>,
    at: usize,
}

/// A local edit.
#[derive(Clone, Debug, PartialEq)]
pub struct PlayedEdit {
    /// What the edit does: `flip e7`.
    pub name: String,
    /// The edge that is edited. `None` if the edit moves vertices.
    pub edge: Option<EdgeId>,
    /// The reason for which the edit was refused, or `None` if it was not refused.
    pub refused: Option<EditError>,
    /// The changes of pointers: one entry for each half-edge whose pointers change, in the order of the half-edges'
    /// indices.
    pub pointers: Vec<PointerChange>,
}

/// The pointers of a half-edge before and after an edit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PointerChange {
    /// The half-edge.
    pub half_edge: HalfEdgeId,
    /// The pointers before the edit. `None` if the edit adds the half-edge.
    pub before: Option<Pointers>,
    /// The pointers after the edit. `None` if the edit removes the half-edge.
    pub after: Option<Pointers>,
}

/// The pointers of a half-edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pointers {
    /// The next half-edge.
    pub next: HalfEdgeId,
    /// The origin.
    pub origin: VertexId,
    /// The face of the half-edge. `None` if the half-edge is on the boundary.
    pub face: Option<FaceId>,
}

impl Play {
    /// Returns the edits that a step `FlipEdges`, `SplitEdges` or `CollapseEdges` makes on an object. `scene` is the
    /// scene before the step. None of the edits is done yet. If there are more than 10 000 edits, only the first 10 000
    /// edits are returned.
    ///
    /// `label` is the label of the step, which seeds random choices. Returns `None` if the step has another operation,
    /// or if it is `FlipEdges` and sets the parameter `until`. Also returns `None` if the step has errors or a value
    /// `arg(..)`, or if the object is not a mesh.
    pub fn of_step(scene: &Scene, object: &str, run: &Value, label: &str) -> Option<Self> {
        let object = scene.object(object)?;
        let mesh = object.as_mesh()?;
        let edit = Edit::of(run.name()?.0).filter(|_| run.field("until").is_none())?;
        let text = run.field("edges")?.to_string();
        let Elements::Edges(selection) =
            read_selection(&text, Some(op::ElementKind::Edges)).ok()?
        else {
            return None;
        };
        let at = match run.field("at").map(|at| &at.kind) {
            None => 0.5,
            Some(ValueKind::Number(number)) => number.to_float(),
            Some(_) => return None,
        };
        let edges = edges(&selection, scene, object, mesh, label)?;
        let mut play = Self::new(mesh);
        for &edge in edges.iter().take(MAX_EDITS) {
            let place = selection.place_on(&play.mesh, edge, at);
            play.record(edit, edge, place);
        }
        Some(play.rewound())
    }

    /// Returns one level of Loop subdivision as local edits. First, all edges are split. Each split also adds edges
    /// inside the neighboring faces. Then, those of the added edges that join an old and a new vertex are flipped. At
    /// the end, all vertices move. None of the edits is done yet.
    ///
    /// Returns `None` if one level of Loop subdivision of all faces does not turn `before` into `after`. Also returns
    /// `None` if there are more than 10 000 edits.
    pub fn of_loop_level(before: &Mesh, after: &Mesh) -> Option<Self> {
        if !is_loop_level(before, after) {
            return None;
        }
        let n_vertices = before.n_vertices();
        let mut play = Self::new(before);
        let mut new_edges = Vec::new();
        for edge in before.edges() {
            let [v, w] = before.edge_vertices(edge);
            play.record(Edit::Split, edge, 0.5);
            let middle = VertexId::new(play.mesh.domain_len(Domain::Vertex) - 1);
            let across = play.mesh.vertex_half_edges(middle);
            let across = across.filter(|&h| ![v, w].contains(&play.mesh.target(h)));
            new_edges.extend(across.map(HalfEdgeId::edge));
        }
        for edge in new_edges {
            let ends = play.mesh.edge_vertices(edge);
            let is_new = |v: VertexId| v.index() >= n_vertices;
            if is_new(ends[0]) != is_new(ends[1]) {
                play.record(Edit::Flip, edge, 0.5);
            }
        }
        play.mesh.begin();
        for (i, &to) in after.positions().iter().enumerate() {
            play.mesh.set_position(VertexId::new(i), to);
        }
        play.edits.push(PlayedEdit {
            name: "move all vertices".to_owned(),
            edge: None,
            refused: None,
            pointers: Vec::new(),
        });
        play.changes.push(play.mesh.commit());
        Some(play.rewound())
    }

    fn new(mesh: &Mesh) -> Self {
        Self {
            mesh: mesh.clone(),
            edits: Vec::new(),
            changes: Vec::new(),
            at: 0,
        }
    }

    /// Undoes all recorded edits.
    #[must_use]
    fn rewound(mut self) -> Self {
        self.at = self.edits.len();
        while self.back() {}
        self
    }

    /// Does an edit and records it.
    fn record(&mut self, edit: Edit, edge: EdgeId, place: f64) {
        let mesh = &mut self.mesh;
        let around = half_edges_around(mesh, edge);
        let before: Vec<_> = around.iter().map(|&h| pointers(mesh, h)).collect();
        let first_new = mesh.domain_len(Domain::Corner);
        mesh.begin();
        let result = match edit {
            Edit::Flip => mesh.flip_edge(edge),
            Edit::Split => mesh
                .split_edge(edge, place.min(1.0_f64.next_down()))
                .map(drop),
            Edit::Collapse => mesh.collapse_edge_at(edge, place).map(drop),
        };
        let change = if result.is_ok() {
            mesh.commit()
        } else {
            mesh.rollback();
            None
        };
        let new = (first_new..mesh.domain_len(Domain::Corner)).map(HalfEdgeId::new);
        let known = around.into_iter().zip(before);
        let all = known.chain(new.map(|h| (h, None)));
        let changed = all.map(|(half_edge, before)| PointerChange {
            half_edge,
            before,
            after: pointers(mesh, half_edge),
        });
        self.edits.push(PlayedEdit {
            name: format!("{} {edge}", edit.word()),
            edge: Some(edge),
            refused: result.err(),
            pointers: changed
                .filter(|change| change.before != change.after)
                .collect(),
        });
        self.changes.push(change);
    }

    /// Returns the mesh after the edits that have been made so far. The indices of removed elements are not used again,
    /// so there can be gaps between the indices of the mesh's elements.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// Returns all edits.
    pub fn edits(&self) -> &[PlayedEdit] {
        &self.edits
    }

    /// Returns the number of edits that have been made so far.
    pub fn position(&self) -> usize {
        self.at
    }

    /// Does the next edit. Returns `false` if there is no next edit.
    pub fn forward(&mut self) -> bool {
        let can = self.at < self.edits.len();
        if can {
            self.turn(self.at);
            self.at += 1;
        }
        can
    }

    /// Undoes the edit that was made last. Returns `false` if there is no edit to undo.
    pub fn back(&mut self) -> bool {
        let can = self.at > 0;
        if can {
            self.at -= 1;
            self.turn(self.at);
        }
        can
    }

    fn turn(&mut self, edit: usize) {
        if let Some(change) = self.changes[edit].take() {
            self.changes[edit] = Some(self.mesh.revert(change));
        }
    }
}

impl Editor {
    /// Returns the scene before a step of the text. `None` if it is not known.
    pub fn scene_before(&self, step: usize) -> Option<Arc<Scene>> {
        match self.run().result_after(step) {
            (Some(snapshot), true) => Some(snapshot.scene.clone()),
            _ => None,
        }
    }

    /// Whether a step of the text makes local edits that [`play`](Self::play) can show one by one. Does not check the
    /// parameters of a step that flips, splits or collapses edges, so [`play`](Self::play) can still return `None` for
    /// this step.
    pub fn has_edits(&self, step: usize) -> bool {
        let operation = self.outline().steps.get(step).map(|text| &*text.name);
        operation.is_some_and(|name| match Edit::of(name) {
            Some(_) => true,
            None => name == LOOP && self.loop_level(step).is_some(),
        })
    }

    /// Returns the edits of a step of the text, and the name of the mesh that they change. If the step has `on`, its
    /// edits are played on the first mesh in `on`. If the step has no `on`, its edits are played on the mesh with the
    /// picked elements. If nothing is picked either, they are played on the first mesh. Returns `None` if the scene
    /// before the step is not known, or if the step cannot be played (see [`Play::of_step`] and
    /// [`Play::of_loop_level`]).
    pub fn play(&self, step: usize) -> Option<(String, Play)> {
        let text = self.outline().steps.get(step)?;
        if text.name == LOOP {
            let (object, [before, after]) = self.loop_level(step)?;
            return Some((object, Play::of_loop_level(&before, &after)?));
        }
        let (object, scene) = self.played_object(step)?;
        let mut steps = self.run().steps.iter().filter(|state| state.item == step);
        let label = &steps.next()?.label;
        let play = Play::of_step(&scene, &object, self.outline().run_of(step)?, label)?;
        Some((object, play))
    }

    /// Returns the name of the object whose edits are played, and the scene before the step.
    fn played_object(&self, step: usize) -> Option<(String, Arc<Scene>)> {
        let text = self.outline().steps.get(step)?;
        if !text.enabled || !self.is_run_current() {
            return None;
        }
        let scene = self.scene_before(step)?;
        let is_mesh = |name: &&str| scene.object(name).is_some_and(|o| o.as_mesh().is_some());
        let named = text.on.iter().flatten().map(String::as_str);
        let picked = self.picked().map(|picked| picked.object.as_str());
        let all = scene.objects().iter().map(|object| object.name.as_str());
        let object = match &text.on {
            Some(_) => named.into_iter().find(is_mesh)?,
            None => picked.into_iter().chain(all).find(is_mesh)?,
        };
        Some((object.to_owned(), scene))
    }

    /// Returns the name of the subdivided object, and its mesh before and after the step. Returns `None` if the step is
    /// not one level of Loop subdivision that can be played.
    fn loop_level(&self, step: usize) -> Option<(String, [Arc<Mesh>; 2])> {
        let (object, before) = self.played_object(step)?;
        let after = self.scene_before(step + 1)?;
        let mesh = |scene: &Scene| scene.object(&object)?.as_mesh().cloned();
        let meshes = [mesh(&before)?, mesh(&after)?];
        is_loop_level(&meshes[0], &meshes[1]).then_some((object, meshes))
    }
}

/// Whether one level of Loop subdivision of all faces turns `before` into `after`, and can be played with at most
/// [`MAX_EDITS`] edits.
fn is_loop_level(before: &Mesh, after: &Mesh) -> bool {
    // Loop subdivision is played as one split for each edge, one flip for each triangle, and one edit that moves the
    // vertices. The splits add three edges inside each triangle. Of these three edges, the edge that ends at an old
    // vertex is flipped.
    let n_edits = before.n_edges() + before.n_faces() + 1;
    n_edits <= MAX_EDITS
        && after.n_vertices() == before.n_vertices() + before.n_edges()
        && after.n_faces() == 4 * before.n_faces()
        && before.is_dense()
        && before.faces().all(|f| before.is_triangle(f))
}

#[derive(Clone, Copy, Debug)]
enum Edit {
    Flip,
    Split,
    Collapse,
}

impl Edit {
    fn of(operation: &str) -> Option<Self> {
        match operation {
            "FlipEdges" => Some(Self::Flip),
            "SplitEdges" => Some(Self::Split),
            "CollapseEdges" => Some(Self::Collapse),
            _ => None,
        }
    }

    fn word(self) -> &'static str {
        match self {
            Self::Flip => "flip",
            Self::Split => "split",
            Self::Collapse => "collapse",
        }
    }
}

fn edges(
    selection: &EdgeSelection,
    scene: &Scene,
    object: &Object,
    mesh: &Mesh,
    label: &str,
) -> Option<Vec<EdgeId>> {
    let elements = Elements::Edges(selection.clone());
    match resolve(&elements, scene, object, mesh, label).ok()? {
        Selected::Edges(edges) => Some(edges),
        _ => None,
    }
}

/// Returns the half-edges near an edge: all half-edges that start or end at its two vertices, and all half-edges of the
/// faces around these vertices. The half-edges are in the order of their indices.
fn half_edges_around(mesh: &Mesh, edge: EdgeId) -> Vec<HalfEdgeId> {
    if !mesh.has_edge(edge) {
        return Vec::new();
    }
    let mut around = Vec::new();
    for v in mesh.edge_vertices(edge) {
        for h in mesh.vertex_half_edges(v) {
            around.extend([h, h.twin()]);
            if let Some(f) = mesh.face(h) {
                around.extend(mesh.face_half_edges(f));
            }
        }
    }
    around.sort_unstable();
    around.dedup();
    around
}

fn pointers(mesh: &Mesh, h: HalfEdgeId) -> Option<Pointers> {
    mesh.has_edge(h.edge()).then(|| Pointers {
        next: mesh.next(h),
        origin: mesh.origin(h),
        face: mesh.face(h),
    })
}
