//! One run with the cache: looks up steps, stores the results of steps that ran, and loads scenes.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::time::Duration;

use op::{FileUse, Files};
use recipe::{CachedRun, CompletedStep, RecipeExpectation, RecipeStep, RerunReason, StepResult};
use scene::{Digest, Geometry, Scene};

use super::{ALWAYS_STORED, BYTES_PER_SECOND, Caching, evict};
use crate::blob::{SceneRef, exists, load_scene, restore_file, store_file, store_scene};
use crate::expectations::{MetExpectation, is_known_to_hold};
use crate::folder::{Folder, Kind, Unusable};
use crate::history::History;
use crate::inputs::FileChecker;
use crate::key::{Ingredients, Key, State};
use crate::record::{OutputFile, Outputs, Record, load, store};

/// The data that are known about the scene at one point of the run: at the start, or after a step.
#[derive(Default)]
struct Position {
    /// A digest that identifies the scene, if it is known.
    state: Option<State>,
    /// The key and the record of the step that leads to this point of the run.
    step: Option<(Key, Record)>,
    /// Whether the record has changes that are not stored yet.
    is_dirty: bool,
    digest: Option<Digest>,
    /// Why the scene could not be loaded.
    load_failure: Option<RerunReason>,
}

/// A run with a cache.
pub(crate) struct Session<'a> {
    folder: &'a Folder,
    caching: Caching<'a>,
    checker: FileChecker,
    history: History,
    /// One entry for the start of the run, and one entry for each completed step.
    positions: Vec<Position>,
    /// If the step that was looked up last must run: the ingredients of this step (the data from which its key is
    /// computed).
    ingredients: Option<Ingredients>,
    /// The time that steps have taken since a scene was last stored or loaded.
    unstored_time: Duration,
    /// The last step that ran because something changed. Because of this step, later steps may also have to run again.
    /// The tuple consists of the number of the step, counted from 1, and its label.
    last_changed: Option<(usize, String)>,
    notes: Vec<String>,
}

impl CachedRun for Session<'_> {
    fn look_up(
        &mut self,
        step: &RecipeStep,
        budget: u64,
        files: &Files,
        stage: Option<&Path>,
    ) -> Result<StepResult, RerunReason> {
        self.ingredients = None;
        let before = self.last().state.ok_or(RerunReason::NoState)?;
        let program = &self.caching.cache.program;
        let ingredients = Ingredients::of(step, program, budget, before).ok_or(RerunReason::New)?;
        let key = ingredients.key();
        let found = self.find_record(key, &ingredients, files, stage);
        let record = match found {
            Ok(record) => record,
            Err(why) => {
                self.ingredients = Some(ingredients);
                let keeps_state = matches!(
                    why,
                    RerunReason::Earlier(..)
                        | RerunReason::Order
                        | RerunReason::Provenance
                        | RerunReason::Outputs
                        | RerunReason::NotKept
                );
                if !keeps_state {
                    self.last_changed = Some((self.positions.len(), step.label().to_owned()));
                }
                return Err(why);
            }
        };
        if Folder::touch(&self.folder.path(Kind::Step, &key.0)) {
            for blob in record.blobs() {
                Folder::touch(&self.folder.path(Kind::Blob, &blob.hash));
            }
        }
        self.history.push(ingredients, None);
        let result = record.result.clone();
        let digest = record.digest.map(Digest::from_bytes);
        self.positions.push(Position {
            state: Some(key.after(&record.inputs.files)),
            digest: digest.or_else(|| self.last().digest.filter(|_| record.keeps_scene)),
            step: Some((key, record)),
            ..Position::default()
        });
        Ok(result)
    }

    fn record_step(&mut self, number: usize, label: &str, files: &Files, done: &CompletedStep) {
        self.unstored_time += done.time;
        let keeps_scene = done.keeps_scene;
        let ingredients = self.ingredients.take();
        let inputs = self.checker.inputs(done.uses);
        let mut position = Position {
            digest: self.last().digest.filter(|_| keeps_scene),
            ..Position::default()
        };
        let Some(ingredients) = ingredients else {
            self.positions.push(position);
            return;
        };
        let key = ingredients.key();
        match inputs {
            Ok(inputs) => {
                position.state = Some(key.after(&inputs.files));
                let outputs = self.store_outputs(files, done);
                let scene = self.last().step.as_ref().and_then(|(_, r)| r.scene.clone());
                let scene = scene.filter(|_| keeps_scene);
                let scene = scene.or_else(|| self.store_scene(done.scene, number, label));
                let record = Record {
                    inputs,
                    outputs,
                    result: done.result.clone(),
                    keeps_scene,
                    scene,
                    digest: position.digest.map(Digest::to_bytes),
                    met_expectations: Vec::new(),
                };
                position.step = Some((key, record));
                position.is_dirty = true;
                self.history.push(ingredients, None);
            }
            Err((path, why)) => {
                self.notes.push(format!(
                    "the result of step {number} {label} is not stored in the cache, because the input files of the step cannot be determined ({}: {why})",
                    path.display()
                ));
                // Usually, the key and the input files of a step identify the scene after the step. Because the input
                // files of this step are unknown, the state of the scene is computed from the content of the scene.
                // With this state, later steps can still be cached.
                if is_dense(done.scene) {
                    let digest = position.digest.unwrap_or_else(|| done.scene.digest());
                    position.digest = Some(digest);
                    position.state = Some(State::of_scene(digest));
                }
                self.history.push(ingredients, Some((path, why.to_owned())));
            }
        }
        self.positions.push(position);
    }

    fn record_rerun(
        &mut self,
        number: usize,
        label: &str,
        scene: &Scene,
        time: Duration,
    ) -> RerunReason {
        self.unstored_time += time;
        if let Some(stored) = self.store_scene(scene, number, label)
            && let Some(position) = self.positions.get_mut(number)
            && let Some((key, record)) = &mut position.step
        {
            record.scene = Some(stored);
            store(self.folder, *key, record.clone());
        }
        let position = self.positions.get_mut(number);
        let load_failure = position.and_then(|p| p.load_failure.take());
        load_failure.unwrap_or(RerunReason::NotKept)
    }

    fn load_scene(&mut self, from: usize, to: usize) -> Option<(usize, Scene)> {
        for index in (from + 1..=to).rev() {
            let position = &mut self.positions[index];
            let Some((_, record)) = &mut position.step else {
                continue;
            };
            let Some(stored) = &record.scene else {
                continue;
            };
            let all_exist = stored.arrays.iter().all(|blob| exists(self.folder, blob));
            let loaded = if all_exist {
                load_scene(self.folder, stored)
            } else {
                Err(Unusable::Missing)
            };
            match loaded {
                Ok(scene) => {
                    self.unstored_time = Duration::ZERO;
                    return Some((index, scene));
                }
                Err(why) => {
                    record.scene = None;
                    let why = rerun_reason(why);
                    self.notes.push(format!(
                        "the scene after step {index} cannot be loaded from the cache: {why}"
                    ));
                    position.load_failure = Some(why);
                }
            }
        }
        None
    }

    fn keeps_scene(&self, index: usize) -> bool {
        let step = self.positions.get(index + 1).and_then(|p| p.step.as_ref());
        step.is_some_and(|(_, record)| record.keeps_scene)
    }

    fn is_known_to_hold(&mut self, placed: &RecipeExpectation, files: &Files) -> bool {
        let step = self.positions.last().and_then(|p| p.step.as_ref());
        step.is_some_and(|(_, record)| {
            is_known_to_hold(&record.met_expectations, placed, files, &mut self.checker)
        })
    }

    fn record_met_expectation(&mut self, placed: &RecipeExpectation, uses: &[FileUse]) {
        if let Some(met) = MetExpectation::new(placed, uses, &mut self.checker)
            && let Some(position) = self.positions.last_mut()
            && let Some((_, record)) = &mut position.step
        {
            record.met_expectations.push(met);
            position.is_dirty = true;
        }
    }

    fn digest(&self) -> Option<Digest> {
        self.last().digest
    }

    fn set_digest(&mut self, digest: Digest) {
        if let Some(position) = self.positions.last_mut() {
            position.digest = Some(digest);
            if let Some((_, record)) = &mut position.step
                && record.digest.is_none()
            {
                record.digest = Some(digest.to_bytes());
                position.is_dirty = true;
            }
        }
    }

    fn wants_scene(&self) -> bool {
        self.caching.want_scene
    }

    fn flush(&mut self) {
        if let Some(position) = self.positions.last_mut()
            && std::mem::take(&mut position.is_dirty)
            && let Some((key, record)) = &position.step
        {
            store(self.folder, *key, record.clone());
        }
    }

    fn finish(mut self: Box<Self>) -> (Option<String>, Vec<String>) {
        self.flush();
        self.history.store(self.folder);
        evict::after_run(self.folder, self.caching.cache.limit);
        (self.folder.problem().map(str::to_owned), self.notes)
    }
}

impl<'a> Session<'a> {
    pub(crate) fn new(caching: Caching<'a>) -> Self {
        let folder = &caching.cache.folder;
        let start = Position {
            state: Some(State::start()),
            ..Position::default()
        };
        Self {
            folder,
            caching,
            checker: FileChecker::new(),
            history: History::load(folder, caching.recipe),
            positions: vec![start],
            ingredients: None,
            unstored_time: Duration::ZERO,
            last_changed: None,
            notes: Vec::new(),
        }
    }

    fn find_record(
        &mut self,
        key: Key,
        ingredients: &Ingredients,
        files: &Files,
        stage: Option<&Path>,
    ) -> Result<Record, RerunReason> {
        let records = load(self.folder, key).map_err(|why| match why {
            Unusable::Missing => self.history.why(ingredients, self.last_changed.clone()),
            Unusable::Damaged(how) => RerunReason::Damaged(how),
        })?;
        let mut first = None;
        for record in records {
            match self.use_record(&record, files, stage) {
                Ok(()) => return Ok(record),
                Err(why) => _ = first.get_or_insert(why),
            }
        }
        Err(first.unwrap_or(RerunReason::Gone))
    }

    /// Checks that running a step now would still give its recorded result. If the result would be the same, restores
    /// the output files of the step into the folder `stage`, if it is given. This folder collects output files until
    /// the run succeeds.
    fn use_record(
        &mut self,
        record: &Record,
        files: &Files,
        stage: Option<&Path>,
    ) -> Result<(), RerunReason> {
        if !record.inputs.resolve_as_before(files) {
            return Err(RerunReason::Folder);
        }
        if let Some((path, change)) = self.checker.first_change(files, &record.inputs.files) {
            return Err(RerunReason::File(path, change));
        }
        let Some(outputs) = &record.outputs else {
            return Ok(());
        };
        // Without a stage (a folder that collects the output files), the run writes no output files. In this case, the
        // provenance (a text about the origin of the files) in the cached files does not matter.
        if stage.is_some() && outputs.provenance != files.provenance {
            return Err(RerunReason::Provenance);
        }
        let is_same_path = |(path, relative): &(String, PathBuf)| {
            files
                .to_write(path)
                .is_ok_and(|to| to == files.output.join(relative))
        };
        if !outputs.requested.iter().all(is_same_path) {
            return Err(RerunReason::Outputs);
        }
        let Some(stage) = stage else { return Ok(()) };
        let written = outputs.files.as_ref().ok_or(RerunReason::NotKept)?;
        // All output files are first restored under temporary names. Therefore, if a cached file is damaged, the
        // existing files in the stage (the folder that collects output files) stay unchanged.
        let part = |i: usize| stage.join(format!(".part-{i}"));
        let mut restored = written.iter().enumerate().try_for_each(|(i, file)| {
            if !is_below(&file.path) {
                let how = "a path leads out of the output folder";
                return Err(RerunReason::Damaged(how.to_owned()));
            }
            restore_file(self.folder, &file.content, &part(i)).map_err(rerun_reason)
        });
        for (i, file) in written.iter().enumerate() {
            if restored.is_ok() {
                restored = move_file(&part(i), &stage.join(&file.path));
            }
            // If the temporary file was not moved, it is removed.
            Folder::discard(&part(i));
        }
        restored
    }

    /// Stores the scene after a step, if the scene can be restored exactly and storing the scene is worthwhile. Storing
    /// is worthwhile if the scene is small, or if storing it takes at most as long as computing it again.
    fn store_scene(&mut self, scene: &Scene, number: usize, label: &str) -> Option<SceneRef> {
        let bytes = estimated_bytes(scene);
        let why = if !is_dense(scene) {
            "a mesh of the scene contains removed elements"
        } else if !is_worth_storing(bytes, self.unstored_time) {
            "storing the scene would take longer than computing it again"
        } else {
            ""
        };
        if !why.is_empty() {
            let size = op::readable_bytes(bytes);
            self.notes.push(format!(
                "the scene after step {number} {label} ({size}) is not stored in the cache: {why}"
            ));
            return None;
        }
        let stored = store_scene(self.folder, scene)?;
        self.unstored_time = Duration::ZERO;
        Some(stored)
    }

    /// Stores the output files of a step, if they are small or if storing them takes at most as long as computing them
    /// again. Returns `None` if the step has no outputs.
    fn store_outputs(&mut self, files: &Files, done: &CompletedStep) -> Option<Outputs> {
        let requested: Vec<_> = done
            .uses
            .iter()
            .filter_map(|file| match file {
                FileUse::Written { path, relative } => Some((path.clone(), relative.clone())),
                _ => None,
            })
            .collect();
        if requested.is_empty() && done.written.is_empty() {
            return None;
        }
        let stored = done.stage.and_then(|stage| {
            // `done.written` lists the files whose length or modification time has changed. If a file keeps its length
            // and is written twice within a short time, its modification time can stay the same. The requested paths
            // are therefore added.
            let requested = requested.iter().map(|(_, path)| path);
            let requested = requested.filter(|path| stage.join(path).is_file());
            let written: BTreeSet<&PathBuf> = done.written.iter().chain(requested).collect();
            let len = |path: &PathBuf| std::fs::metadata(path).map_or(0, |meta| meta.len());
            let total = written.iter().map(|path| len(&stage.join(path))).sum();
            let loading = estimated_bytes(done.scene) as f64 / BYTES_PER_SECOND;
            let rerun_time = done.time + Duration::from_secs_f64(loading);
            if !is_worth_storing(total, rerun_time) {
                return None;
            }
            let store = |path: &PathBuf| {
                let content = store_file(self.folder, &stage.join(path))?;
                let path = path.clone();
                Some(OutputFile { path, content })
            };
            written.into_iter().map(store).collect()
        });
        Some(Outputs {
            provenance: files.provenance.clone(),
            requested,
            files: stored,
        })
    }

    fn last(&self) -> &Position {
        self.positions.last().expect("never empty")
    }
}

/// Whether a relative path stays inside its folder.
fn is_below(path: &Path) -> bool {
    let mut parts = path.components();
    parts.all(|part| matches!(part, std::path::Component::Normal(_)))
}

/// Moves a file. If the target folder does not exist, creates it.
fn move_file(from: &Path, to: &Path) -> Result<(), RerunReason> {
    let folder = to.parent().map_or(Ok(()), std::fs::create_dir_all);
    let moved = folder.and_then(|()| std::fs::rename(from, to));
    moved.map_err(|error| RerunReason::Damaged(format!("{}: {error}", to.display())))
}

fn rerun_reason(why: Unusable) -> RerunReason {
    match why {
        Unusable::Missing => RerunReason::Gone,
        Unusable::Damaged(how) => RerunReason::Damaged(how),
    }
}

/// Whether `bytes` is less than [`ALWAYS_STORED`], or storing this number of bytes takes at most `time`.
fn is_worth_storing(bytes: u64, time: Duration) -> bool {
    bytes < ALWAYS_STORED || bytes as f64 / BYTES_PER_SECOND <= time.as_secs_f64()
}

/// Whether all meshes of a scene are dense: no removed element has left a gap in the arrays of a mesh. If a mesh with
/// gaps were stored and loaded again, its elements would be renumbered.
fn is_dense(scene: &Scene) -> bool {
    let mut meshes = scene.objects().iter().filter_map(|o| o.as_mesh());
    meshes.all(|mesh| mesh.is_dense())
}

/// Returns the approximate size of a scene in bytes.
fn estimated_bytes(scene: &Scene) -> u64 {
    let points = |n: usize| n * size_of::<mesh::DVec3>();
    let of = |geometry: &Geometry| match geometry {
        Geometry::Mesh(mesh) => mesh.bytes(),
        Geometry::Patches(patches) => points(16 * patches.len()),
        Geometry::Curve(curve) => points(curve.points().len()),
        Geometry::Polylines(lines) => points(lines.iter().map(Vec::len).sum()),
    };
    let objects = scene.objects().iter();
    objects.map(|o| of(&o.geometry) as u64).sum()
}
