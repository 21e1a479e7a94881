//! What a step did.

use std::fmt;

use mesh::Domain;
use serde::{Deserialize, Serialize};

use crate::{OpError, Refusal};

/// What a step did: what it changed, what was refused, what was lost, and anything worth a line.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Eq, Serialize)]
pub struct Report {
    /// How many elements were edited or made.
    pub changed: u64,
    /// Edits that were refused and skipped, by reason.
    pub refused: Vec<Refused>,
    /// Attributes and other things that are gone.
    pub losses: Vec<Loss>,
    /// Other facts, each one line.
    pub notes: Vec<String>,
}

/// Refused edits of one reason.
#[derive(Clone, Debug, Deserialize, PartialEq, Eq, Serialize)]
pub struct Refused {
    /// The reason.
    pub reason: Refusal,
    /// How many.
    pub count: u64,
    /// The message of the first.
    pub first: String,
}

/// Something that a step or a file format could not keep.
#[derive(Clone, Debug, Deserialize, PartialEq, Eq, Serialize)]
pub struct Loss {
    /// The object that lost it.
    pub object: String,
    /// What it was, by the name that a recipe allows it to be lost by: that of an attribute.
    pub name: String,
    /// What it was, in words.
    pub what: String,
    /// Why it is gone.
    pub reason: String,
}

impl fmt::Display for Loss {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} lost {}: {}", self.object, self.what, self.reason)
    }
}

impl Loss {
    /// The loss of an attribute.
    pub fn attribute(object: &str, domain: Domain, name: &str, reason: impl Into<String>) -> Self {
        let what = format!("the {domain} attribute \"{name}\"");
        Self {
            object: object.to_owned(),
            name: name.to_owned(),
            what,
            reason: reason.into(),
        }
    }
}

impl Report {
    /// A report of so many changed elements.
    pub fn changed(n: usize) -> Self {
        Self {
            changed: n as u64,
            ..Self::default()
        }
    }

    /// Adds a line.
    #[must_use]
    pub fn note(mut self, note: impl Into<String>) -> Self {
        self.notes.push(note.into());
        self
    }

    /// Adds a line that says how many of something there are, unless there are none.
    #[must_use]
    pub fn count(self, what: &str, n: usize) -> Self {
        if n > 0 {
            self.note(format!("{what}: {n}"))
        } else {
            self
        }
    }

    /// Counts edits that were refused for this reason. Only the first of a reason is asked for its message.
    pub(crate) fn count_refused(
        &mut self,
        reason: Refusal,
        count: u64,
        first: impl FnOnce() -> String,
    ) {
        match self.refused.iter_mut().find(|r| r.reason == reason) {
            Some(refused) => refused.count += count,
            None => self.refused.push(Refused {
                reason,
                count,
                first: first(),
            }),
        }
    }

    /// Counts a refused edit. Returns the error itself if it is not a refusal.
    ///
    /// # Errors
    ///
    /// Any error but [`OpError::Refused`].
    pub fn refuse(&mut self, error: OpError) -> Result<(), OpError> {
        let OpError::Refused {
            reason, message, ..
        } = error
        else {
            return Err(error);
        };
        self.count_refused(reason, 1, || message);
        Ok(())
    }

    /// Adds what another part of the step did.
    pub fn merge(&mut self, other: Self) {
        self.changed += other.changed;
        for refused in other.refused {
            self.count_refused(refused.reason, refused.count, || refused.first);
        }
        self.losses.extend(other.losses);
        self.notes.extend(other.notes);
    }
}
