//! The picked elements of an editor, and the selections that describe them.

use std::thread::JoinHandle;

use mesh::Element;
use op::ElementKind;
use scene::Object;

use crate::select::{Picked, Proposal, propose, propose_one};

use super::Editor;

/// If a mesh has more edges than this, a separate thread searches for the selections that describe the picked elements.
const MAX_AT_ONCE: usize = 50_000;

/// The selections that describe the picked elements.
#[derive(Default)]
pub(super) enum Proposals {
    /// The selections have not been requested yet.
    #[default]
    Unknown,
    /// A thread searches for the selections.
    Searching(JoinHandle<Vec<Proposal>>),
    /// The selections are known.
    Known(Vec<Proposal>),
}

/// Why a typed selection picks no elements.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PickError {
    /// The scene has no mesh.
    #[error("the scene has no mesh whose elements can be picked")]
    NoMesh,
    /// The text is not a selection, or the selection fails on the mesh. For example, `Expect` fails if the number of
    /// elements is not the expected number.
    #[error("{0}")]
    Selection(String),
    /// The selection selects no elements.
    #[error("no elements match the selection")]
    NoElements,
}

impl Editor {
    /// Returns the picked elements. Returns `None` if nothing is picked, or if a preview is shown and its scene does
    /// not have all picked elements.
    pub fn picked(&self) -> Option<&Picked> {
        self.picked.as_ref().filter(|_| self.has_picked)
    }

    /// Sets the picked elements, which must be elements of the scene that the view shows.
    pub fn set_picked(&mut self, picked: Option<Picked>) {
        self.picked = picked.filter(|picked| !picked.is_empty());
        self.has_picked = true;
        (self.first_proposal, self.proposal) = (None, 0);
        self.proposals = Proposals::default();
    }

    /// Returns the selections that describe the picked elements, the best first. The list is computed only once for
    /// each pick.
    pub fn proposals(&mut self) -> &[Proposal] {
        self.search();
        self.proposals = match std::mem::take(&mut self.proposals) {
            // If the search panics, its result is an empty list.
            Proposals::Searching(thread) => Proposals::Known(thread.join().unwrap_or_default()),
            known => known,
        };
        match &self.proposals {
            Proposals::Known(list) => list,
            _ => &[],
        }
    }

    /// Returns the selection that commands use to describe the picked elements.
    pub fn proposal(&mut self) -> Option<&Proposal> {
        let at = self.proposal;
        if self.first_proposal.is_none() && matches!(self.proposals, Proposals::Unknown) {
            let picked = self.picked.as_ref()?;
            self.first_proposal = propose_one(&self.shown, picked);
        }
        if self.first_proposal.is_none() {
            return self.proposals().get(at);
        }
        self.first_proposal.as_ref()
    }

    /// Starts the search for the selections that describe the picked elements, unless it was started before.
    fn search(&mut self) {
        let Some(picked) = &self.picked else {
            self.proposals = Proposals::Known(Vec::new());
            return;
        };
        if !matches!(self.proposals, Proposals::Unknown) {
            return;
        }
        let mesh = self.shown.object(&picked.object).and_then(Object::as_mesh);
        let is_small = mesh.is_none_or(|mesh| mesh.n_edges() <= MAX_AT_ONCE);
        let (scene, picked) = (self.shown.clone(), picked.clone());
        let search = move || propose(&scene, &picked, "");
        self.proposals = if is_small {
            Proposals::Known(search())
        } else {
            Proposals::Searching(std::thread::spawn(search))
        };
    }

    /// Whether a thread still searches for the selections that describe the picked elements. If several elements are
    /// picked, starts the search. In a large mesh, the search takes a long time. Commands wait for the end of the
    /// search. To avoid waiting, a window calls this function before it shows a selection.
    pub fn is_searching(&mut self) -> bool {
        let is_one = self.picked.as_ref().is_some_and(|picked| picked.len() == 1);
        if !is_one && self.first_proposal.is_none() {
            self.search();
        }
        matches!(&self.proposals, Proposals::Searching(thread) if !thread.is_finished())
    }

    /// Returns false if no other selection describes the picked elements, or if nothing is picked. Can return true
    /// although no other selection exists, because the selections are computed only when they are requested. In a large
    /// mesh, this computation takes a long time.
    pub fn may_have_other_proposal(&self) -> bool {
        match &self.proposals {
            Proposals::Known(proposals) => proposals.len() > 1,
            _ => self.picked.is_some(),
        }
    }

    /// Switches to the next of the selections that describe the picked elements, and from the last of them to the
    /// first.
    pub fn next_proposal(&mut self) {
        let first = self.first_proposal.take();
        self.proposals();
        let Proposals::Known(all) = &mut self.proposals else {
            return;
        };
        if let Some(first) = first {
            all.retain(|other| *other != first);
            all.insert(0, first);
        }
        self.proposal = (self.proposal + 1) % all.len().max(1);
    }

    /// Picks the elements that a typed selection selects. The text has the form of a selection in a recipe. Commands
    /// use the text as their selection. If elements are picked, the text is read as a selection of elements of their
    /// kind. If nothing is picked, the text is read as a selection of elements of the given kind. If the text does not
    /// fit this kind, the other kinds are tried. The elements are selected on the object with the picked elements or,
    /// if nothing is picked, on the first mesh.
    ///
    /// # Errors
    ///
    /// Returns [`PickError`] if the scene has no mesh or the text is not a selection. Also returns it if the selection
    /// fails on the mesh, or selects no elements.
    pub fn pick_by_text(&mut self, text: &str, kind: ElementKind) -> Result<(), PickError> {
        let kind = self.picked.as_ref().map_or(kind, Picked::kind);
        let object = if let Some(picked) = &self.picked {
            picked.object.clone()
        } else {
            let mut objects = self.shown.objects().iter();
            let first = objects.find(|object| object.as_mesh().is_some());
            let first = first.ok_or(PickError::NoMesh)?;
            first.name.clone()
        };
        let read = |kind| Picked::by_text(&self.shown, &object, text, Some(kind));
        let found = read(kind).or_else(|errors| {
            let mut others = ElementKind::ALL.into_iter().filter(|other| *other != kind);
            others.find_map(|kind| read(kind).ok()).ok_or(errors)
        });
        let mut picked = found.map_err(|errors| match errors.into_iter().next() {
            Some(error) => PickError::Selection(error.message),
            None => PickError::Selection("this is not a selection".to_owned()),
        })?;
        if picked.is_empty() {
            return Err(PickError::NoElements);
        }
        let half_edge = self.picked.as_ref().and_then(|picked| picked.half_edge);
        picked.half_edge = half_edge.filter(|&h| picked.contains(Element::HalfEdge(h)));
        self.set_picked(Some(picked));
        self.first_proposal = Some(Proposal {
            text: text.trim().to_owned(),
            before: None,
        });
        Ok(())
    }

    /// Keeps only those picked elements that exist in the scene that is shown.
    pub(super) fn keep_picked(&mut self) {
        let existing = self.existing();
        self.set_picked(existing);
    }

    /// Returns the picked elements that exist in the scene that is shown.
    pub(super) fn existing(&self) -> Option<Picked> {
        let picked = self.picked.as_ref()?;
        let mesh = self.shown.object(&picked.object)?.as_mesh()?;
        Some(picked.existing(mesh)).filter(|picked| !picked.is_empty())
    }
}
