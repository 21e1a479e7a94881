//! Recipes that run on files in memory.

use std::fmt::Debug;
use std::path::{Path, PathBuf};
use std::sync::{Arc, LazyLock, Mutex, PoisonError};
use std::time::Duration;

use engine::json::step_done;
use engine::{
    Engine, Listener, Loaded, Memory, Options, Run, Source, StepDone, StepKeys, Store, Values,
};
use glam::DMat4;
use op::{Progress, Registry};
use recipe::LineIndex;
use render::{Camera, Lines, Overlays, PictureError, Style, Up};
use scene::Scene;
use serde_json::{Value as Json, json};
use store::StoreError;
use view::Quantity;
use web_time::Instant;

use crate::describe::{expectations, object, parameter, placed};
use crate::kept::Kept;
use crate::{Arrays, Colors};

static REGISTRY: LazyLock<Registry> = LazyLock::new(ops_all::registry);

/// The memory budget for the meshes of a run, and for rendering a picture, in bytes. WebAssembly can address at
/// most 4 GiB.
const BUDGET: u64 = 1 << 30;

/// The minimum time between two progress events.
const MIN_INTERVAL: Duration = Duration::from_millis(100);

/// The folder for outputs.
const OUT: &str = "out";

/// Files in memory, and the scene of the last run.
#[derive(Debug)]
pub struct Session {
    engine: Engine<'static>,
    store: Arc<Memory>,
    scene: Scene,
    kept: Kept,
}

impl Default for Session {
    fn default() -> Self {
        let store = Arc::new(Memory::default());
        Self {
            engine: Engine::new(&REGISTRY).with_store(store.clone()),
            store,
            scene: Scene::new(),
            kept: Kept::default(),
        }
    }
}

impl Session {
    /// Creates a session without files.
    pub fn new() -> Self {
        Self::default()
    }

    /// Writes a file, which recipes can then read. Missing folders of the path are created.
    ///
    /// # Errors
    ///
    /// Returns [`StoreError`] if the path is the path of a folder, or a part of the path is a file.
    pub fn write(&mut self, path: &str, bytes: &[u8]) -> Result<(), StoreError> {
        // A step runs again if its key has changed. However, the key does not depend on all files that the step reads,
        // such as the material files of a model. Therefore, no result is kept when a file is written.
        self.kept = Kept::default();
        self.store.write(path.as_ref(), bytes)
    }

    /// Removes a file or a folder with its files, if it exists.
    pub fn remove(&mut self, path: &str) {
        self.kept = Kept::default();
        self.store.remove(path.as_ref());
    }

    /// Reads a file, such as an output of a run.
    ///
    /// # Errors
    ///
    /// Returns [`StoreError`] if the file does not exist.
    pub fn read(&self, path: &str) -> Result<Vec<u8>, StoreError> {
        self.store.read(path.as_ref())
    }

    /// Checks a recipe without running it. `path` is the path of the recipe. Paths in the recipe are relative to its
    /// folder, and paths in `values` are relative to the root folder.
    ///
    /// Returns an object with these fields:
    ///
    /// - `problems`, each with `severity`, `file`, `line`, `column`, `message`, `help` and `range` (the start and the
    ///   exclusive end in UTF-16 code units)
    /// - `parameters`, each with `name`, `type`, `value`, `doc`, `min` and `max` (the limits), and `of` (the allowed
    ///   names); a value that does not exist is `null`
    /// - `presets`, the names of the presets
    /// - `steps`, each with `label`, `operation` and `line` (`null` if the step is in a called recipe)
    /// - `peak_bytes`, the largest memory of all meshes after any step; `null` if unknown
    pub fn check(&self, path: &str, text: &str, values: Values) -> Json {
        let loaded = self.load(path, text, values);
        let parameters = loaded.recipe.parameters().iter().map(parameter);
        let index = LineIndex::new(text);
        let steps = loaded.recipe.steps.iter().map(|step| {
            let written = loaded.recipe.scopes[step.scope].source == 0;
            let line = written.then(|| index.position(step.span.start).0);
            json!({ "label": step.label(), "operation": step.name, "line": line })
        });
        let peaks = loaded.forecast.steps.iter().map(|step| step.bytes.max);
        json!({
            "problems": placed(&loaded.diagnostics, &loaded),
            "parameters": parameters.collect::<Vec<_>>(),
            "presets": loaded.recipe.presets,
            "steps": steps.collect::<Vec<_>>(),
            "peak_bytes": peaks.max().filter(|&peak| peak < u64::MAX),
        })
    }

    /// Checks and runs a recipe. Calls `listen` with the events `step`, `progress` and `done`, which have the same form
    /// as in the output of `meshwright run --format json`. At most ten `progress` events are sent per second. If
    /// `listen` returns false for a `progress` event, the run is canceled.
    ///
    /// The run starts at the first step that differs from the last run or that writes a file. The run starts earlier if
    /// the scene before this step was not kept, or if an expectation must be checked again. The first run after a file
    /// was written or removed starts at the first step. The reports of steps that do not run again have the field
    /// `cached`.
    ///
    /// Returns an object with these fields:
    ///
    /// - `succeeded` and `cancelled`
    /// - `problems`, as in [`check`](Self::check)
    /// - `steps`, the `done` events of all steps
    /// - `expectations`, each checked expectation with `line`, `text` and `met`
    /// - `digest`, `null` if the recipe has errors
    /// - `files`, the paths of the written files
    /// - `objects`, each with `name`, `kind`, `vertices`, `edges` and `faces`
    ///
    /// After a run, [`picture`](Self::picture) and [`arrays`](Self::arrays) show the scene at the end of this run, even
    /// if the run failed.
    pub fn run(
        &mut self,
        path: &str,
        text: &str,
        values: Values,
        listen: &(dyn Fn(&Json) -> bool + Sync),
    ) -> Json {
        // Frees the memory of the last scene, except for meshes that are part of kept scenes.
        self.scene = Scene::new();
        let loaded = self.load(path, text, values);
        let mut result = json!({
            "succeeded": false,
            "cancelled": false,
            "problems": placed(&loaded.diagnostics, &loaded),
            "steps": [],
            "expectations": [],
            "digest": null,
            "files": [],
        });
        if !loaded.has_errors() {
            self.run_loaded(&loaded, listen, &mut result);
        }
        result["objects"] = self.scene.objects().iter().map(object).collect();
        result
    }

    /// Runs a recipe, which must have no errors, and writes the outcome into `result`.
    fn run_loaded(
        &mut self,
        loaded: &Loaded,
        listen: &(dyn Fn(&Json) -> bool + Sync),
        result: &mut Json,
    ) {
        let keys = StepKeys::of(loaded);
        let (first, start) = self.kept.start(loaded, &keys);
        let mut steps = self.kept.reports();
        let events = Events {
            loaded,
            listen,
            kept: &self.kept,
            last: Mutex::new(Instant::now()),
        };
        for (number, done) in steps.iter().enumerate() {
            events.step_begins(number, &done.label);
            events.step_done(number, done);
        }
        let settings = Run {
            keep_outputs: true,
            cache: None,
        };
        let outcome = loaded.run_from(first, start, settings, &events);
        let earlier = loaded.recipe.expectations.iter();
        let earlier = earlier.take_while(|placed| placed.after.is_some_and(|after| after < first));
        let checked = earlier.count() + outcome.checked;
        self.kept.add(&keys, &outcome, checked);
        steps.extend(outcome.steps.iter().cloned());
        let steps = steps.iter().enumerate();
        let problems = [&loaded.diagnostics[..], &outcome.failures].concat();
        let files = outcome
            .written
            .iter()
            .map(|path| path.display().to_string());
        result["succeeded"] = json!(outcome.succeeded());
        result["cancelled"] = json!(outcome.cancelled);
        result["problems"] = json!(placed(&problems, loaded));
        result["steps"] = steps.map(|(i, done)| step_done(i, done)).collect();
        result["expectations"] = json!(expectations(loaded, &outcome, checked));
        result["digest"] = json!(outcome.digest.to_string());
        result["files"] = files.collect();
        self.scene = outcome.scene.unwrap_or_default();
    }

    /// Renders the scene of the last run, and returns the bytes of a PNG file. `size` is the size in pixels. `up` is
    /// the axis that points upwards.
    ///
    /// # Errors
    ///
    /// Returns a [`PictureError`] if the picture is too large.
    pub fn picture(
        &self,
        size: [u32; 2],
        wireframe: bool,
        up: Up,
    ) -> Result<Vec<u8>, PictureError> {
        let style = Style {
            wireframe: wireframe.then(Lines::default),
            ..Style::default()
        };
        let mut camera = Camera::default();
        if let Camera::Fit { up: axis, .. } = &mut camera {
            *axis = up;
        }
        let mut image = |path: &str| self.read(path).ok();
        let (rendered, _) = render::picture(
            &self.scene,
            &camera,
            &style,
            &Overlays::default(),
            size,
            BUDGET,
            &mut image,
        )?;
        rendered.image.to_png(&[])
    }

    /// Returns the arrays of a mesh of the last run; `None` if no mesh has this name.
    pub fn arrays(&self, object: &str) -> Option<Arrays> {
        let mesh = self.scene.object(object)?.as_mesh()?;
        Some(Arrays::new(mesh))
    }

    /// Returns the placements of a mesh of the last run. The placement of an instance is the matrix that maps the space
    /// of the mesh to the scene: 16 numbers, column by column. A skinned mesh has the placement of its first joint.
    pub fn placements(&self, object: &str) -> Vec<f64> {
        let instances = self.scene.instances().into_iter();
        let own = instances.filter(|instance| instance.object.name == object);
        own.flat_map(|instance| DMat4::from(instance.to_scene).to_cols_array())
            .collect()
    }

    /// Returns the quantities that [`colors`](Self::colors) can show on the meshes of the last run. Each entry of the
    /// result has two fields: `title` is a text for users, and `quantity` is the [`Quantity`] as JSON.
    pub fn quantities(&self) -> Json {
        let quantities = Quantity::of_scene(&self.scene).into_iter();
        quantities
            .map(|quantity| json!({ "title": quantity.title(), "quantity": quantity }))
            .collect()
    }

    /// Returns colors that show a quantity, such as the valence, on the meshes of the last run.
    ///
    /// # Errors
    ///
    /// Returns [`PictureError::Style`] if no mesh has this quantity.
    pub fn colors(&self, quantity: Quantity) -> Result<Colors, PictureError> {
        Colors::new(&self.scene, quantity)
    }

    /// Returns the JSON schema of recipes.
    pub fn schema(&self) -> Json {
        recipe::schema(self.engine.registry())
    }

    /// Returns all operations, each with `name`, `summary` and `example`.
    pub fn operations(&self) -> Json {
        let entries = self.engine.registry().entries().iter();
        let described = entries.map(|entry| {
            json!({ "name": entry.name, "summary": entry.summary, "example": entry.example })
        });
        described.collect()
    }

    fn load(&self, path: &str, text: &str, values: Values) -> Loaded {
        let options = Options {
            values: Values {
                folder: Some(Path::new("")),
                ..values
            },
            out: Path::new(OUT),
            budget: BUDGET,
            strict: false,
        };
        self.engine
            .load(&Source::new(PathBuf::from(path), text), &options)
    }
}

/// Passes the events of a run to the listener as JSON, and keeps the scenes.
struct Events<'a> {
    loaded: &'a Loaded,
    listen: &'a (dyn Fn(&Json) -> bool + Sync),
    kept: &'a Kept,
    /// The time of the last progress event.
    last: Mutex<Instant>,
}

impl Progress for Events<'_> {
    fn advance(&self, task: &str, done: u64, total: u64) -> bool {
        {
            let mut last = self.last.lock().unwrap_or_else(PoisonError::into_inner);
            if last.elapsed() < MIN_INTERVAL {
                return true;
            }
            *last = Instant::now();
        }
        (self.listen)(&json!({ "event": "progress", "what": task, "done": done, "total": total }))
    }
}

impl Listener for Events<'_> {
    fn step_begins(&self, number: usize, label: &str) {
        let operation = &self.loaded.recipe.steps[number].name;
        (self.listen)(&json!({
            "event": "step", "number": number + 1, "label": label, "operation": operation,
        }));
    }

    fn step_done(&self, number: usize, done: &StepDone) {
        (self.listen)(&step_done(number, done));
    }

    fn wants_scenes(&self) -> bool {
        true
    }

    fn scene_after(&self, _: usize, scene: &Scene) {
        self.kept.add_scene(scene);
    }
}

#[cfg(test)]
mod tests;
