//! The report of a step.

use std::fmt;

use mesh::Domain;
use serde::{Deserialize, Serialize};

use crate::{OpError, Refusal};

/// The report of a step: what it changed, which edits were refused, what was lost, and notes.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Eq, Serialize)]
pub struct Report {
    /// The number of elements or objects that were changed or created.
    pub changed: u64,
    /// The edits that were refused and therefore skipped, grouped by reason.
    pub refused: Vec<Refused>,
    /// The attributes and other data that the step lost.
    pub losses: Vec<Loss>,
    /// The changes that were made to the data of a file while it was read.
    pub changes: Vec<ReadingChange>,
    /// Other facts about the step, each in one line.
    pub notes: Vec<String>,
}

/// A change that was made to the data of a file while the file was read, such as the reversal of faces.
#[derive(Clone, Debug, Deserialize, PartialEq, Eq, Serialize)]
pub struct ReadingChange {
    /// A stable name for this kind of change, such as `faces-reversed`. Programs can rely on this name.
    pub code: String,
    /// The number of elements or values that were changed.
    pub count: u64,
    /// The changed elements, if they are known, given by their indices in the file.
    pub elements: Option<ReadingElements>,
    /// A message that describes the change and names the file.
    pub message: String,
}

/// Elements of a file, given by their indices in the file. Indices start at 0.
#[derive(Clone, Debug, Deserialize, PartialEq, Eq, Serialize)]
pub enum ReadingElements {
    /// Vertices.
    Vertices(Vec<u64>),
    /// Edges, each given by the indices of its two vertices.
    Edges(Vec<[u64; 2]>),
    /// Faces.
    Faces(Vec<u64>),
}

/// The edits that were refused for one reason.
#[derive(Clone, Debug, Deserialize, PartialEq, Eq, Serialize)]
pub struct Refused {
    /// The reason for the refusal of these edits.
    pub reason: Refusal,
    /// The number of refused edits.
    pub count: u64,
    /// The message of the first refused edit.
    pub first: String,
}

/// Data that a step or a file format could not preserve.
#[derive(Clone, Debug, Deserialize, PartialEq, Eq, Serialize)]
pub struct Loss {
    /// A stable name for this kind of loss, such as `attribute-lost`. Programs can rely on this name.
    pub code: String,
    /// The number of lost values, elements or other items, if it is known.
    pub count: Option<u64>,
    /// The name of the object or file that lost the data. The name is empty if the loss concerns the whole scene, such
    /// as its animations.
    pub object: String,
    /// The name of the lost data, such as the name of an attribute. Recipes use this name to allow the loss.
    pub name: String,
    /// A description of the lost data.
    pub what: String,
    /// Why the data was lost. If the reason is empty, `what` is the whole message.
    pub reason: String,
}

impl fmt::Display for Loss {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.reason.is_empty() {
            return f.write_str(&self.what);
        }
        write!(f, "{} lost {}: {}", self.owner(), self.what, self.reason)
    }
}

impl Loss {
    /// Creates the record of a loss that occurred while a file was read. `code` is used both as the code of the loss
    /// and as the name of the lost data. `message` describes the loss and names the file.
    pub fn reading(file: &str, code: &str, count: u64, message: impl Into<String>) -> Self {
        Self {
            code: code.to_owned(),
            count: Some(count),
            object: file.to_owned(),
            name: code.to_owned(),
            what: message.into(),
            reason: String::new(),
        }
    }

    /// Creates the record of a lost attribute.
    pub fn attribute(object: &str, domain: Domain, name: &str, reason: impl Into<String>) -> Self {
        let what = format!("the {domain} attribute \"{name}\"");
        Self {
            code: "attribute-lost".to_owned(),
            ..Self::part(object, name, what, reason)
        }
    }

    /// Creates the record of a lost part of an object or of the scene. `name` is the name of the part, such as `skins`.
    /// The code is derived from this name.
    pub fn part(
        object: &str,
        name: &str,
        what: impl Into<String>,
        reason: impl Into<String>,
    ) -> Self {
        Self {
            code: format!("{}-lost", name.replace(' ', "-")),
            count: None,
            object: object.to_owned(),
            name: name.to_owned(),
            what: what.into(),
            reason: reason.into(),
        }
    }

    /// Returns the message for a loss that is possible but not certain.
    pub fn possible_message(&self) -> String {
        if self.reason.is_empty() {
            return format!("{} may lose {}", self.owner(), self.what);
        }
        format!("{} may lose {}: {}", self.owner(), self.what, self.reason)
    }

    /// Returns how messages name the owner of the lost data: the name of the object in quotation marks, or `the scene`.
    fn owner(&self) -> String {
        match self.object.as_str() {
            "" => "the scene".to_owned(),
            object => format!("\"{object}\""),
        }
    }
}

impl Report {
    /// Creates a report of `n` changed elements.
    pub fn changed(n: usize) -> Self {
        Self {
            changed: n as u64,
            ..Self::default()
        }
    }

    /// Adds a note.
    #[must_use]
    pub fn note(mut self, note: impl Into<String>) -> Self {
        self.notes.push(note.into());
        self
    }

    /// Adds the note `what: n`, unless `n` is 0.
    #[must_use]
    pub fn count(self, what: &str, n: usize) -> Self {
        if n > 0 {
            self.note(format!("{what}: {n}"))
        } else {
            self
        }
    }

    /// Adds `count` edits that were refused for the reason `reason`. `first` returns the message of the first of these
    /// edits. `first` is called only if the report does not yet count a refusal for this reason.
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

    /// Counts a refused edit.
    ///
    /// # Errors
    ///
    /// Returns `error` unless it is [`OpError::Refused`].
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

    /// Adds the contents of the report `other`, which describes another part of the same step.
    pub fn merge(&mut self, other: Self) {
        self.changed += other.changed;
        for refused in other.refused {
            self.count_refused(refused.reason, refused.count, || refused.first);
        }
        self.losses.extend(other.losses);
        self.changes.extend(other.changes);
        self.notes.extend(other.notes);
    }
}
