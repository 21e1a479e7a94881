//! The context in which an operation runs: progress, cancellation, the label that seeds random selections, files, and
//! the memory budget.

use std::sync::{Arc, Mutex, PoisonError};

use mesh::Mesh;
use progress::Progress;
use scene::Scene;

use crate::{CancellableStore, Files, OpError};

/// The context in which an operation runs.
pub struct Context<'a> {
    progress: &'a dyn Progress,
    files: &'a Files,
    /// The names of the objects in the step's `on:`. `None` if the step has no `on:`. The step then acts on all objects
    /// that its operation supports.
    pub on: Option<&'a [String]>,
    /// The label of the step in the recipe. The selection `Random` is seeded with this label and with its own `seed`.
    /// Two steps with the same seed therefore select different elements. Random positions and numbers, such as those of
    /// `Scatter` and `Displace`, depend only on their `seed`.
    pub stream: &'a str,
    /// The memory budget of meshes, in bytes.
    pub budget: u64,
    /// The names of the materials of the object that is being changed. Selections use these names.
    pub materials: Vec<String>,
    /// The name of the object that is being changed.
    object: String,
    /// The other objects of the scene, each with its name and its mesh. The mesh is `None` if the object has another
    /// kind of geometry.
    others: Vec<(String, Option<Arc<Mesh>>)>,
    /// Remarks about the selections of the step, for the report of the step.
    notes: Mutex<Vec<String>>,
}

impl<'a> Context<'a> {
    /// Creates a context for a step without `on:`, with an unlimited memory budget.
    pub fn new(progress: &'a dyn Progress, files: &'a Files) -> Self {
        Self {
            progress,
            files,
            on: None,
            stream: "",
            budget: u64::MAX,
            materials: Vec::new(),
            object: String::new(),
            others: Vec::new(),
            notes: Mutex::default(),
        }
    }

    /// Reports that `done` of `total` parts of the work are finished. Every operation calls this method before its
    /// first change and at least every few milliseconds.
    ///
    /// # Errors
    ///
    /// Returns [`OpError::Cancelled`] if the run was canceled. The operation must then return [`OpError::Cancelled`] at
    /// once.
    pub fn advance(&self, what: &str, done: u64, total: u64) -> Result<(), OpError> {
        Ok(self.progress.report(what, done, total)?)
    }

    /// Sets the object that the step changes. The selections of the step are evaluated on this object. Also stores the
    /// materials of the object, and the other objects of the scene for [`other_mesh`](Self::other_mesh). The context
    /// shares the meshes of the other objects with the scene until [`clear_object`](Self::clear_object) is called.
    pub fn set_object(&mut self, scene: &Scene, name: &str) {
        let (mut materials, mut others) = (Vec::new(), Vec::new());
        for object in scene.objects() {
            if object.name == name {
                materials.extend(object.materials.iter().map(|m| m.name.clone()));
            } else {
                others.push((object.name.clone(), object.as_mesh().cloned()));
            }
        }
        self.materials = materials;
        name.clone_into(&mut self.object);
        self.others = others;
    }

    /// Removes everything that [`set_object`](Self::set_object) has stored in the context.
    pub fn clear_object(&mut self) {
        self.materials.clear();
        self.object.clear();
        self.others.clear();
    }

    /// Returns the mesh of another object of the scene, in its state before the step. `user` is the name, such as
    /// `Project`, of the operation or selection that needs the mesh. Error messages contain this name.
    ///
    /// # Errors
    ///
    /// Returns [`OpError::Object`] if no object has this name, if the object is not a mesh, or if the step is changing
    /// this object itself.
    pub fn other_mesh(&self, user: &str, name: &str) -> Result<Arc<Mesh>, OpError> {
        if name == self.object {
            return Err(OpError::Object(format!(
                "{user} needs an object other than \"{name}\", because the step acts on \"{name}\"; choose the objects of the step with `on`"
            )));
        }
        match self.others.iter().find(|other| other.0 == name) {
            Some((_, Some(mesh))) => Ok(Arc::clone(mesh)),
            Some((_, None)) => Err(OpError::Object(format!(
                "{user} needs a mesh, but \"{name}\" is not a mesh"
            ))),
            None => {
                let quoted = self.others.iter().map(|other| format!("\"{}\"", other.0));
                let known = quoted.collect::<Vec<_>>().join(", ");
                let known = if known.is_empty() { "none" } else { &known };
                Err(OpError::Object(format!(
                    "{user}: no object is named \"{name}\"; other objects at this point: {known}"
                )))
            }
        }
    }

    /// Adds a note (a remark in one line) to the report of the step, unless the report already has the same note.
    pub(crate) fn note(&self, note: String) {
        let mut notes = self.notes.lock().unwrap_or_else(PoisonError::into_inner);
        if !notes.contains(&note) {
            notes.push(note);
        }
    }

    /// Removes and returns the notes for the report.
    pub(crate) fn take_notes(&mut self) -> Vec<String> {
        let notes = self.notes.get_mut().unwrap_or_else(PoisonError::into_inner);
        std::mem::take(notes)
    }

    /// Returns the receiver of progress reports, for long computations in other crates.
    pub fn progress(&self) -> &'a dyn Progress {
        self.progress
    }

    /// Returns the store of the run, for writing large files. When data is written to this store, progress is reported,
    /// and the write fails if the run is canceled. After such a failure, [`advance`](Self::advance) returns
    /// [`OpError::Cancelled`].
    pub fn cancellable_store(&self) -> CancellableStore<'_> {
        CancellableStore::new(&*self.files.store, self.progress)
    }

    /// Returns the [`Files`] of the run, which determine where files are read and written.
    pub fn files(&self) -> &Files {
        self.files
    }
}
