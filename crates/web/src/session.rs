//! Recipes that run on files in memory.

use std::fmt::Debug;
use std::path::{Path, PathBuf};
use std::sync::{Arc, LazyLock, Mutex, PoisonError};
use std::time::Duration;

use engine::json::{Problem, problems, step_done};
use engine::{
    Diagnostic, Engine, Listener, Loaded, Memory, Options, Outcome, Run, Source, StepDone, Store,
    Values,
};
use glam::DMat4;
use op::{Progress, Registry};
use recipe::{LineIndex, Param, Parameter};
use render::{Camera, Lines, Overlays, PictureError, Style, Up};
use scene::{Geometry, Scene};
use serde::Serialize;
use serde_json::{Value as Json, json};
use store::StoreError;
use view::Quantity;
use web_time::Instant;

use crate::{Arrays, Colors};

static REGISTRY: LazyLock<Registry> = LazyLock::new(ops_all::registry);

/// The default memory budget for meshes in bytes. The addresses of WebAssembly end at 4 GiB.
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
}

/// A diagnostic with its range in the text of the recipe.
#[derive(Serialize)]
struct PlacedProblem {
    #[serde(flatten)]
    problem: Problem,
    /// The range in UTF-16 code units, as JavaScript counts. `null` if the problem is not about the text of the recipe
    /// itself.
    range: Option<[usize; 2]>,
}

impl Default for Session {
    fn default() -> Self {
        let store = Arc::new(Memory::default());
        Self {
            engine: Engine::new(&REGISTRY).with_store(store.clone()),
            store,
            scene: Scene::new(),
        }
    }
}

impl Session {
    /// Creates a session without files.
    pub fn new() -> Self {
        Self::default()
    }

    /// Writes a file, which recipes can then read. Folders are created.
    ///
    /// # Errors
    ///
    /// [`StoreError`] if the path is the path of a folder, or a part of the path is a file.
    pub fn write(&self, path: &str, bytes: &[u8]) -> Result<(), StoreError> {
        self.store.write(path.as_ref(), bytes)
    }

    /// Reads a file, such as an output of a run.
    ///
    /// # Errors
    ///
    /// [`StoreError`] if the file does not exist.
    pub fn read(&self, path: &str) -> Result<Vec<u8>, StoreError> {
        self.store.read(path.as_ref())
    }

    /// Checks a recipe without running it. `path` is the path of the recipe, which other paths are relative to. `set` has
    /// values of parameters.
    ///
    /// Returns `problems`, each with `severity`, `file`, `line`, `column`, `message`, `help` and `range` (the first and
    /// the last offset in UTF-16 code units); `parameters` with `name`, `type`, `value`, `doc`, the limits `min` and `max`, and
    /// the allowed names `of`, each `null` if there is none; `steps` with `label`, `operation` and `line` (`null` if the step is
    /// in a called recipe); `peak_bytes`, the largest memory of all meshes after any step, `null` if unknown.
    pub fn check(&self, path: &str, text: &str, set: &[(String, String)]) -> Json {
        let loaded = self.load(path, text, set);
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
            "steps": steps.collect::<Vec<_>>(),
            "peak_bytes": peaks.max().filter(|&peak| peak < u64::MAX),
        })
    }

    /// Checks and runs a recipe. Calls `listen` with the events `step`, `progress` (at most ten times
    /// per second) and `done` of `meshwright run --format json`. If `listen` returns false for an event `progress`, the run is
    /// canceled.
    ///
    /// Returns `succeeded`, `cancelled`, `problems` as [`check`](Self::check), `steps` with the events `done`,
    /// `expectations` with `line`, `text` and `met` for each checked expectation, `digest` (`null` if the recipe has errors),
    /// the paths of the written `files`, and `objects` with `name`, `kind`, `vertices`, `edges` and `faces`.
    ///
    /// Afterwards, [`picture`](Self::picture) and [`arrays`](Self::arrays) show the scene at the end, even if the run
    /// failed.
    pub fn run(
        &mut self,
        path: &str,
        text: &str,
        set: &[(String, String)],
        listen: &(dyn Fn(&Json) -> bool + Sync),
    ) -> Json {
        // The memory of the last scene can be used again.
        self.scene = Scene::new();
        let loaded = self.load(path, text, set);
        let mut found = loaded.diagnostics.clone();
        let outcome = (!loaded.has_errors()).then(|| {
            let settings = Run {
                keep_outputs: true,
                cache: None,
            };
            let events = Events {
                loaded: &loaded,
                listen,
                last: Mutex::new(Instant::now()),
            };
            loaded.run(settings, &events)
        });
        if let Some(outcome) = &outcome {
            found.extend(outcome.failures.iter().cloned());
        }
        let steps = outcome.iter().flat_map(|o| o.steps.iter().enumerate());
        let written = outcome.iter().flat_map(|o| &o.written);
        let mut result = json!({
            "succeeded": outcome.as_ref().is_some_and(Outcome::succeeded),
            "cancelled": outcome.as_ref().is_some_and(|o| o.cancelled),
            "problems": placed(&found, &loaded),
            "steps": steps.map(|(i, done)| step_done(i, done)).collect::<Vec<_>>(),
            "expectations": outcome.as_ref().map_or_else(Vec::new, |o| expectations(&loaded, o)),
            "digest": outcome.as_ref().map(|o| o.digest.to_string()),
            "files": written.map(|path| path.display().to_string()).collect::<Vec<_>>(),
        });
        self.scene = outcome.and_then(|o| o.scene).unwrap_or_default();
        result["objects"] = self.scene.objects().iter().map(object).collect();
        result
    }

    /// Renders a picture of the scene of the last run, as the bytes of a PNG file. `size` is in pixels. `up` is the axis that
    /// points upwards.
    ///
    /// # Errors
    ///
    /// [`PictureError`] if the picture is too large.
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

    /// Returns the placements of a mesh of the last run: for each of its instances, the map from the space of the mesh to the
    /// scene, as 16 numbers column by column. A skinned mesh has the placement of its first joint.
    pub fn placements(&self, object: &str) -> Vec<f64> {
        let instances = self.scene.instances().into_iter();
        let own = instances.filter(|instance| instance.object.name == object);
        own.flat_map(|instance| DMat4::from(instance.to_scene).to_cols_array())
            .collect()
    }

    /// Returns the quantities of the meshes of the last run that [`colors`](Self::colors) can show: the `title` and the
    /// `quantity` of each, as recipes write it.
    pub fn quantities(&self) -> Json {
        let quantities = Quantity::of_scene(&self.scene).into_iter();
        quantities
            .map(|quantity| json!({ "title": quantity.title(), "quantity": quantity }))
            .collect()
    }

    /// Shows a quantity of the meshes of the last run as colors.
    ///
    /// # Errors
    ///
    /// [`PictureError::Style`] if no mesh has this quantity.
    pub fn colors(&self, quantity: Quantity) -> Result<Colors, PictureError> {
        Colors::new(&self.scene, quantity)
    }

    /// Returns the JSON schema of recipes.
    pub fn schema(&self) -> Json {
        recipe::schema(self.engine.registry())
    }

    /// Returns the operations: `name`, `summary` and `example` of each.
    pub fn operations(&self) -> Json {
        let entries = self.engine.registry().entries().iter();
        let described = entries.map(|entry| {
            json!({ "name": entry.name, "summary": entry.summary, "example": entry.example })
        });
        described.collect()
    }

    fn load(&self, path: &str, text: &str, set: &[(String, String)]) -> Loaded {
        let options = Options {
            values: Values {
                set,
                preset: None,
                folder: Some(Path::new("")),
            },
            out: Path::new(OUT),
            budget: BUDGET,
        };
        self.engine
            .load(&Source::new(PathBuf::from(path), text), &options)
    }
}

/// Passes events of a run on as JSON.
struct Events<'a> {
    loaded: &'a Loaded,
    listen: &'a (dyn Fn(&Json) -> bool + Sync),
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
}

fn placed(diagnostics: &[Diagnostic], loaded: &Loaded) -> Vec<PlacedProblem> {
    let sources = &loaded.recipe.sources;
    let text = sources.first().map_or("", |s| &s.text);
    let range = |d: &Diagnostic| {
        let range = d.span.filter(|_| d.source == 0)?.fitted(text);
        let units = |end: usize| text[..end].encode_utf16().count();
        Some([units(range.start), units(range.end)])
    };
    let described = problems(diagnostics, sources).into_iter().zip(diagnostics);
    described
        .map(|(problem, d)| PlacedProblem {
            problem,
            range: range(d),
        })
        .collect()
}

/// Describes the expectations that were checked. Expectations are checked in order, so these are the first ones.
fn expectations(loaded: &Loaded, outcome: &Outcome) -> Vec<Json> {
    let recipe = &loaded.recipe;
    let checked = recipe.expectations.iter().enumerate().take(outcome.checked);
    let described = checked.map(|(i, placed)| {
        let source = &recipe.sources[recipe.scopes[placed.scope].source];
        let (line, _) = LineIndex::new(&source.text).position(placed.span.start);
        json!({
            "file": source.path.display().to_string(),
            "line": line,
            "text": as_written(&source.text[placed.span.fitted(&source.text)]),
            "met": outcome.unmet.iter().all(|unmet| unmet.expectation != i),
        })
    });
    described.collect()
}

/// Returns a part of a recipe on one line.
fn as_written(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn parameter(parameter: &Parameter) -> Json {
    let param = &parameter.param;
    let mut json = json!({
        "name": parameter.name, "type": param.type_name(), "value": parameter.plain_text(), "doc": param.doc(),
        "min": null, "max": null, "of": null,
    });
    match param {
        Param::Int { min, max, .. } => (json["min"], json["max"]) = (json!(min), json!(max)),
        Param::Float { min, max, .. } => (json["min"], json["max"]) = (json!(min), json!(max)),
        Param::Choice { of, .. } => json["of"] = json!(of),
        _ => {}
    }
    json
}

fn object(object: &scene::Object) -> Json {
    let mut json = json!({ "name": object.name, "kind": object.geometry.kind() });
    if let Geometry::Mesh(mesh) = &object.geometry {
        json["vertices"] = json!(mesh.n_vertices());
        json["edges"] = json!(mesh.n_edges());
        json["faces"] = json!(mesh.n_faces());
    }
    json
}

#[cfg(test)]
mod tests;
