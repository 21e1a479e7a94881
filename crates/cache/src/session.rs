//! One run and its cache: looks steps up, stores what ran, and brings scenes back.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::time::Duration;

use op::{FileUse, Files};
use recipe::{CachedRun, Done, Finding, RecipeExpectation, RecipeStep, RerunReason, mebibytes};
use scene::{Digest, Geometry, Scene};

use super::{Caching, SMALL, SPEED, evict};
use crate::blob::{load_scene, restore_file, seems_there, store_file, store_scene};
use crate::folder::{Folder, Kind, Unusable};
use crate::held::{Held, holds};
use crate::key::{Ingredients, Key, State};
use crate::record::{OutputFile, Outputs, Record, load, store};
use crate::seen::Eyes;
use crate::why::History;

/// What is known of the scene before a step, or at the end.
#[derive(Default)]
struct Position {
    /// `None` if nobody can tell what it is.
    state: Option<State>,
    /// The step that led here, with its key.
    step: Option<(Key, Record)>,
    /// Whether the record has something that is not stored yet.
    is_dirty: bool,
    digest: Option<Digest>,
    /// Why the scene could not be brought back.
    lost: Option<RerunReason>,
}

/// A run with a cache.
pub(crate) struct Session<'a> {
    folder: &'a Folder,
    caching: Caching<'a>,
    eyes: Eyes,
    history: History,
    /// One more than steps are done.
    positions: Vec<Position>,
    /// What the next step is made of.
    made_of: Option<Ingredients>,
    /// What computing took since the last scene that is stored.
    since: Duration,
    /// The last step that has left another state than before by itself: its number from 1 and its label.
    changed: Option<(usize, String)>,
    notes: Vec<String>,
}

impl CachedRun for Session<'_> {
    fn find(
        &mut self,
        step: &RecipeStep,
        budget: u64,
        files: &Files,
        stage: Option<&Path>,
    ) -> Result<Finding, RerunReason> {
        self.made_of = None;
        let before = self.last().state.ok_or(RerunReason::NoState)?;
        let program = &self.caching.cache.program;
        let made_of = Ingredients::of(step, program, budget, before).ok_or(RerunReason::New)?;
        let key = made_of.key();
        let found = self.look_up(key, &made_of, files, stage);
        let record = match found {
            Ok(record) => record,
            Err(why) => {
                self.made_of = Some(made_of);
                let keeps_state = matches!(
                    why,
                    RerunReason::Earlier(..)
                        | RerunReason::Order
                        | RerunReason::Provenance
                        | RerunReason::Outputs
                        | RerunReason::NotKept
                );
                if !keeps_state {
                    self.changed = Some((self.positions.len(), step.label().to_owned()));
                }
                return Err(why);
            }
        };
        if Folder::touch(&self.folder.path(Kind::Step, &key.0)) {
            for blob in record.blobs() {
                Folder::touch(&self.folder.path(Kind::Blob, &blob.hash));
            }
        }
        self.history.push(made_of, None);
        let finding = record.finding.clone();
        let digest = record.digest.map(Digest::from_bytes);
        self.positions.push(Position {
            state: Some(key.after(&record.read.files)),
            digest: digest.or_else(|| self.last().digest.filter(|_| record.same)),
            step: Some((key, record)),
            ..Position::default()
        });
        Ok(finding)
    }

    fn ran(&mut self, number: usize, label: &str, files: &Files, done: &Done) {
        self.since += done.time;
        let same = done.same;
        let made_of = self.made_of.take();
        let read = self.eyes.read(done.uses);
        let mut position = Position {
            digest: self.last().digest.filter(|_| same),
            ..Position::default()
        };
        let Some(made_of) = made_of else {
            self.positions.push(position);
            return;
        };
        let key = made_of.key();
        match read {
            Ok(read) => {
                position.state = Some(key.after(&read.files));
                let outputs = self.outputs(files, done);
                let scene = self.last().step.as_ref().and_then(|(_, r)| r.scene.clone());
                let scene = scene.filter(|_| same);
                let scene = scene.or_else(|| self.keep(done.scene, number, label));
                let record = Record {
                    read,
                    outputs,
                    finding: done.finding.clone(),
                    same,
                    scene,
                    digest: position.digest.map(Digest::to_bytes),
                    held: Vec::new(),
                };
                position.step = Some((key, record));
                position.is_dirty = true;
                self.history.push(made_of, None);
            }
            Err((path, why)) => {
                self.notes.push(format!(
                    "step {number} {label} is not stored: what it read cannot be told: {}, {why}",
                    path.display()
                ));
                // What comes after it depends on what it left.
                if is_dense(done.scene) {
                    let digest = position.digest.unwrap_or_else(|| done.scene.digest());
                    position.digest = Some(digest);
                    position.state = Some(State::of_scene(digest));
                }
                self.history.push(made_of, Some((path, why.to_owned())));
            }
        }
        self.positions.push(position);
    }

    fn ran_again(
        &mut self,
        place: usize,
        label: &str,
        scene: &Scene,
        time: Duration,
    ) -> RerunReason {
        self.since += time;
        if let Some(stored) = self.keep(scene, place, label)
            && let Some(position) = self.positions.get_mut(place)
            && let Some((key, record)) = &mut position.step
        {
            record.scene = Some(stored);
            store(self.folder, *key, record.clone());
        }
        let lost = self.positions.get_mut(place).and_then(|p| p.lost.take());
        lost.unwrap_or(RerunReason::NotKept)
    }

    fn bring(&mut self, from: usize, to: usize) -> Option<(usize, Scene)> {
        for place in (from + 1..=to).rev() {
            let position = &mut self.positions[place];
            let Some((_, record)) = &mut position.step else {
                continue;
            };
            let Some(stored) = &record.scene else {
                continue;
            };
            let seem = stored
                .arrays
                .iter()
                .all(|blob| seems_there(self.folder, blob));
            let loaded = if seem {
                load_scene(self.folder, stored)
            } else {
                Err(Unusable::Missing)
            };
            match loaded {
                Ok(scene) => {
                    self.since = Duration::ZERO;
                    return Some((place, scene));
                }
                Err(why) => {
                    record.scene = None;
                    let why = lost(why);
                    self.notes
                        .push(format!("the scene after step {place}: {why}"));
                    position.lost = Some(why);
                }
            }
        }
        None
    }

    fn is_same(&self, place: usize) -> bool {
        let step = self.positions.get(place + 1).and_then(|p| p.step.as_ref());
        step.is_some_and(|(_, record)| record.same)
    }

    fn holds(&mut self, placed: &RecipeExpectation, files: &Files) -> bool {
        let step = self.positions.last().and_then(|p| p.step.as_ref());
        step.is_some_and(|(_, record)| holds(&record.held, placed, files, &mut self.eyes))
    }

    fn held(&mut self, placed: &RecipeExpectation, uses: &[FileUse]) {
        if let Some(held) = Held::new(placed, uses, &mut self.eyes)
            && let Some(position) = self.positions.last_mut()
            && let Some((_, record)) = &mut position.step
        {
            record.held.push(held);
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
            eyes: Eyes::new(),
            history: History::load(folder, caching.recipe),
            positions: vec![start],
            made_of: None,
            since: Duration::ZERO,
            changed: None,
            notes: Vec::new(),
        }
    }

    fn look_up(
        &mut self,
        key: Key,
        made_of: &Ingredients,
        files: &Files,
        stage: Option<&Path>,
    ) -> Result<Record, RerunReason> {
        let records = load(self.folder, key).map_err(|why| match why {
            Unusable::Missing => self.history.why(made_of, self.changed.clone()),
            Unusable::Damaged(how) => RerunReason::Damaged(how),
        })?;
        let mut first = None;
        for record in records {
            match self.fits(&record, files, stage) {
                Ok(()) => return Ok(record),
                Err(why) => _ = first.get_or_insert(why),
            }
        }
        Err(first.unwrap_or(RerunReason::Gone))
    }

    /// Whether the record is what the step would do now. Its outputs are then in their places.
    fn fits(
        &mut self,
        record: &Record,
        files: &Files,
        stage: Option<&Path>,
    ) -> Result<(), RerunReason> {
        if !record.read.are_asked_for_in(files) {
            return Err(RerunReason::Folder);
        }
        if let Some((path, change)) = self.eyes.changed(&record.read.files) {
            return Err(RerunReason::File(path, change));
        }
        let Some(outputs) = &record.outputs else {
            return Ok(());
        };
        // It stands in the files only, and nobody may want them.
        if stage.is_some() && outputs.provenance != files.provenance {
            return Err(RerunReason::Provenance);
        }
        let is_asked = |(path, relative): &(String, PathBuf)| {
            files
                .to_write(path)
                .is_ok_and(|to| to == files.output.join(relative))
        };
        if !outputs.asked.iter().all(is_asked) {
            return Err(RerunReason::Outputs);
        }
        let Some(stage) = stage else { return Ok(()) };
        let written = outputs.files.as_ref().ok_or(RerunReason::NotKept)?;
        // First all of them beside their places: what is there stays if one of them is damaged.
        let part = |i: usize| stage.join(format!(".part-{i}"));
        let mut restored = written.iter().enumerate().try_for_each(|(i, file)| {
            if !is_below(&file.path) {
                let how = "a path leads out of the output folder";
                return Err(RerunReason::Damaged(how.to_owned()));
            }
            restore_file(self.folder, &file.content, &part(i)).map_err(lost)
        });
        for (i, file) in written.iter().enumerate() {
            if restored.is_ok() {
                restored = put(&part(i), &stage.join(&file.path));
            }
            // Nothing is left there if all went well.
            Folder::discard(&part(i));
        }
        restored
    }

    /// Stores a scene, if that is worth it.
    fn keep(&mut self, scene: &Scene, number: usize, label: &str) -> Option<crate::blob::SceneRef> {
        let bytes = bytes(scene);
        let why = if !is_dense(scene) {
            "it has removed elements"
        } else if !is_worth(bytes, self.since) {
            "making it took less time than storing it would"
        } else {
            ""
        };
        if !why.is_empty() {
            let size = mebibytes(bytes);
            self.notes.push(format!(
                "the scene after step {number} {label} ({size}) is not stored: {why}"
            ));
            return None;
        }
        let stored = store_scene(self.folder, scene)?;
        self.since = Duration::ZERO;
        Some(stored)
    }

    /// Stores what a step has written, if that is worth it.
    fn outputs(&mut self, files: &Files, done: &Done) -> Option<Outputs> {
        let asked: Vec<_> = done
            .uses
            .iter()
            .filter_map(|file| match file {
                FileUse::Written { path, relative } => Some((path.clone(), relative.clone())),
                _ => None,
            })
            .collect();
        if asked.is_empty() && done.written.is_empty() {
            return None;
        }
        let stored = done.stage.and_then(|stage| {
            // A file that was written twice within a tick of the clock looks as it did before.
            let asked = asked.iter().map(|(_, path)| path);
            let asked = asked.filter(|path| stage.join(path).is_file());
            let written: BTreeSet<&PathBuf> = done.written.iter().chain(asked).collect();
            let len = |path: &PathBuf| std::fs::metadata(path).map_or(0, |meta| meta.len());
            let total = written.iter().map(|path| len(&stage.join(path))).sum();
            let again = done.time + Duration::from_secs_f64(bytes(done.scene) as f64 / SPEED);
            if !is_worth(total, again) {
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
            asked,
            files: stored,
        })
    }

    fn last(&self) -> &Position {
        self.positions.last().expect("never empty")
    }
}

/// Whether a path stays in its folder.
fn is_below(path: &Path) -> bool {
    let mut parts = path.components();
    parts.all(|part| matches!(part, std::path::Component::Normal(_)))
}

/// Moves a file to its place.
fn put(from: &Path, to: &Path) -> Result<(), RerunReason> {
    let folder = to.parent().map_or(Ok(()), std::fs::create_dir_all);
    let moved = folder.and_then(|()| std::fs::rename(from, to));
    moved.map_err(|error| RerunReason::Damaged(format!("{}: {error}", to.display())))
}

fn lost(why: Unusable) -> RerunReason {
    match why {
        Unusable::Missing => RerunReason::Gone,
        Unusable::Damaged(how) => RerunReason::Damaged(how),
    }
}

/// Whether storing so many bytes takes no more than `time`.
fn is_worth(bytes: u64, time: Duration) -> bool {
    bytes < SMALL || bytes as f64 / SPEED <= time.as_secs_f64()
}

/// Only the scene of dense meshes is the same when it comes back.
fn is_dense(scene: &Scene) -> bool {
    let mut meshes = scene.objects().iter().filter_map(|o| o.as_mesh());
    meshes.all(|mesh| mesh.is_dense())
}

/// About how many bytes a scene takes.
fn bytes(scene: &Scene) -> u64 {
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
