//! Runs recipes for the program `meshwright`, the editor, the Python package and browsers. The engine opens the recipe
//! and its input files in a store, which is the disk or a set of files in memory. The engine applies parameter values
//! and the memory budget, and can use a step cache, which stores the results of steps. Runs can be canceled. The recipe
//! language itself is implemented in the crate `recipe`.
//!
//! ```text
//! Engine --open--> Source --load--> Loaded --run--> Outcome      (diagnostics and forecast are in Loaded)
//!                                      ^ `--run_from(step, scene)--> Outcome
//! ```
//!
//! A [`Listener`] receives the scene after each step if its method [`wants_scenes`](Listener::wants_scenes) returns
//! true. To cancel the run, return false from the method [`advance`](op::Progress::advance) of the listener, or use the
//! listener [`Cancel`] and call [`Cancel::set`] from another thread.
//!
//! # Examples
//!
//! Runs a recipe that is stored in memory:
//!
//! ```
//! use std::sync::Arc;
//!
//! use engine::{Engine, Memory, Options, Run, Silent, Store};
//!
//! let store = Arc::new(Memory::default());
//! let text = r#"(recipe: 1, steps: [Cube(name: "cube"), PokeFaces()], expect: [Faces(eq: 24)])"#;
//! store.write("cube.ron".as_ref(), text.as_bytes())?;
//!
//! let registry = op::Registry::new().with_group(ops_shapes::register).with_group(ops_faces::register);
//! let engine = Engine::new(&registry).with_store(store);
//! let recipe = engine.load(&engine.open("cube.ron".as_ref())?, &Options::default());
//! assert!(!recipe.has_errors());
//!
//! let outcome = recipe.run(Run::default(), &Silent);
//! assert!(outcome.succeeded());
//! assert_eq!(outcome.scene.unwrap().object("cube").unwrap().as_mesh().unwrap().n_faces(), 24);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

/// Runs the examples in the book's chapter about the library as documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../../../book/src/library.md")]
struct Library;

pub mod json;

mod cancel;
mod keys;
mod loaded;
mod memory;
mod read;
mod stop;

use std::path::Path;
use std::sync::Arc;

use op::{Files, Registry};
use recipe::{Schemas, Stamp};

pub use cancel::Cancel;
pub use keys::{StepKey, StepKeys, stamp_line};
pub use loaded::{Loaded, Run};
pub use memory::SceneMemory;
pub use read::FileReader;
pub use recipe::{
    Diagnostic, Failure, Listener, Outcome, Settings, Silent, Source, SourceError, StepDone, Values,
};
pub use stop::{Stop, UnknownStep};
pub use store::{Disk, Memory, Store};

/// The default memory budget for meshes, in bytes.
pub const BUDGET: u64 = 8 << 30;

/// Reads and runs recipes, with the operations of a registry and the files of a store.
#[derive(Debug)]
pub struct Engine<'r> {
    registry: &'r Registry,
    /// The schemas of the parameters, built once and shared by all recipes.
    schemas: Schemas<'r>,
    store: Arc<dyn Store>,
}

/// Options for reading and checking a recipe.
#[derive(Clone, Copy, Debug)]
pub struct Options<'a> {
    /// Values for the parameters of the recipe.
    pub values: Values<'a>,
    /// The folder for outputs. Defaults to `out`.
    pub out: &'a Path,
    /// The memory budget for meshes, in bytes. Defaults to [`BUDGET`].
    pub budget: u64,
    /// Whether it is an error if a step loses data, such as an attribute. Losses that the recipe allows with
    /// `on_loss: Allow([..])` are never errors. Defaults to false.
    pub strict: bool,
}

impl Default for Options<'_> {
    fn default() -> Self {
        Self {
            values: Values::default(),
            out: Path::new("out"),
            budget: BUDGET,
            strict: false,
        }
    }
}

impl<'r> Engine<'r> {
    /// Creates an engine that reads and writes files on disk.
    pub fn new(registry: &'r Registry) -> Self {
        Self {
            registry,
            schemas: Schemas::new(registry),
            store: Arc::new(Disk),
        }
    }

    /// Makes this engine read and write its files in `store`, and returns the engine.
    #[must_use]
    pub fn with_store(self, store: Arc<dyn Store>) -> Self {
        Self { store, ..self }
    }

    /// Returns the registry of operations that recipes can use.
    pub fn registry(&self) -> &'r Registry {
        self.registry
    }

    /// Reads the text of a recipe.
    ///
    /// # Errors
    ///
    /// Returns [`SourceError`] if the file cannot be read, is too long, or is not UTF-8 text.
    pub fn open(&self, path: &Path) -> Result<Source, SourceError> {
        Source::open_in(&*self.store, path)
    }

    /// Reads and checks a recipe. Errors and warnings are listed in the [`diagnostics`](Loaded::diagnostics) of the
    /// result.
    pub fn load(&self, source: &Source, options: &Options) -> Loaded {
        let mut reading = recipe::read_by(&self.schemas, &*self.store, source, options.values);
        if options.strict {
            reading.recipe.forbid_losses();
        }
        let is_read = !reading.has_errors();
        let mut files = Files {
            store: self.store.clone(),
            input: source.folder().to_path_buf(),
            output: options.out.to_path_buf(),
            placeholders: reading.recipe.placeholders(),
            ..Files::default()
        };
        let forecast = recipe::check(&reading.recipe, &files, options.budget);
        if !forecast.outputs.is_empty() && !forecast.has_errors() {
            let stamp = Stamp::new(&reading.recipe, &forecast.inputs, &*self.store);
            files.provenance = Some(stamp.to_string());
        }
        let mut diagnostics = reading.diagnostics;
        diagnostics.extend(forecast.diagnostics.iter().cloned());
        diagnostics.sort_by_key(|d| (d.source, d.span));
        Loaded {
            path: source.path.display().to_string(),
            recipe: reading.recipe,
            files,
            budget: options.budget,
            forecast,
            is_read,
            diagnostics,
        }
    }
}

#[cfg(test)]
mod tests;
