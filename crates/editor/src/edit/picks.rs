//! The picked elements of an editor, and the selections that mean them.

use crate::select::{Picked, Proposal, propose, propose_one};

use super::Editor;

impl Editor {
    /// Returns the picked elements, which exist in the scene that the view shows. `None` while a preview lacks some of them.
    pub fn picked(&self) -> Option<&Picked> {
        self.picked.as_ref().filter(|_| self.has_picked)
    }

    /// Sets the picked elements of the scene that the view shows.
    pub fn set_picked(&mut self, picked: Option<Picked>) {
        self.picked = picked.filter(|picked| !picked.is_empty());
        self.has_picked = true;
        (self.proposals, self.first_proposal, self.proposal) = (None, None, 0);
    }

    /// Returns the selections that mean the picked elements, the best first. The list is computed once for each pick.
    pub fn proposals(&mut self) -> &[Proposal] {
        if self.proposals.is_none() {
            let found = self
                .picked
                .as_ref()
                .map(|picked| propose(&self.shown, picked, ""));
            self.proposals = Some(found.unwrap_or_default());
        }
        self.proposals.as_deref().unwrap_or_default()
    }

    /// Returns the selection that commands use for the picked elements.
    pub fn proposal(&mut self) -> Option<&Proposal> {
        let at = self.proposal;
        if self.proposals.is_none() && at == 0 {
            if self.first_proposal.is_none() {
                let picked = self.picked.as_ref()?;
                self.first_proposal = propose_one(&self.shown, picked);
            }
            if self.first_proposal.is_some() {
                return self.first_proposal.as_ref();
            }
        }
        self.proposals().get(at)
    }

    /// Whether another selection may mean the picked elements. All selections are computed only when they are asked for,
    /// because this takes long for a large mesh.
    pub fn may_have_other_proposal(&self) -> bool {
        match &self.proposals {
            Some(proposals) => proposals.len() > 1,
            None => self.picked.is_some(),
        }
    }

    /// Chooses the next selection that means the picked elements, or the first after the last.
    pub fn next_proposal(&mut self) {
        let n = self.proposals().len().max(1);
        self.proposal = (self.proposal + 1) % n;
    }

    /// Drops picked elements that the scene at the cursor does not have.
    pub(super) fn keep_picked(&mut self) {
        let existing = self.existing();
        self.set_picked(existing);
    }

    /// Returns the picked elements that the scene at the cursor has.
    pub(super) fn existing(&self) -> Option<Picked> {
        let picked = self.picked.as_ref()?;
        let mesh = self.shown.object(&picked.object)?.as_mesh()?;
        Some(picked.existing(mesh)).filter(|picked| !picked.is_empty())
    }
}
