//! [`Loaded`]: a recipe that was read and checked, with the methods that run it.

use op::Files;
use recipe::{Diagnostic, Forecast, Listener, Outcome, Recipe, Settings, StepCache};
use scene::Scene;

use crate::FileReader;

/// A recipe that was read and checked.
#[derive(Debug)]
pub struct Loaded {
    /// The path of the recipe file, for messages.
    pub path: String,
    /// The recipe. If the recipe has errors, this field contains only the parts that could be read.
    pub recipe: Recipe,
    /// The input and output folders, and the store of files.
    pub files: Files,
    /// The memory budget for meshes, in bytes.
    pub budget: u64,
    /// The forecast of the scene after each step.
    pub forecast: Forecast,
    /// Whether the recipe was read without errors. Even then, the recipe can have errors that the checks after reading
    /// have found: see [`has_errors`](Self::has_errors).
    pub is_read: bool,
    /// All errors and warnings from reading and checking, in the order of the text.
    pub diagnostics: Vec<Diagnostic>,
}

/// The settings of a run. By default, outputs are not kept and no cache is used.
#[derive(Clone, Copy, Debug, Default)]
pub struct Run<'a> {
    /// Whether outputs are kept after the run.
    pub keep_outputs: bool,
    /// The step cache, if one is used.
    pub cache: Option<&'a dyn StepCache>,
}

impl Loaded {
    /// Whether the recipe has errors. A recipe with errors cannot run.
    pub fn has_errors(&self) -> bool {
        self.n_errors() > 0
    }

    /// Returns the number of errors.
    pub fn n_errors(&self) -> usize {
        self.diagnostics.iter().filter(|d| d.is_error()).count()
    }

    /// Runs the recipe, which must not have errors.
    pub fn run(&self, run: Run, listener: &dyn Listener) -> Outcome {
        self.run_from(0, Scene::new(), run, listener)
    }

    /// Runs the recipe starting at the step with index `first`, where `scene` is the scene before that step. See
    /// [`recipe::run_from`].
    pub fn run_from(
        &self,
        first: usize,
        scene: Scene,
        run: Run,
        listener: &dyn Listener,
    ) -> Outcome {
        let settings = Settings {
            files: &self.files,
            budget: self.budget,
            reader: &FileReader,
            keep_outputs: run.keep_outputs,
            writes: !self.forecast.outputs.is_empty(),
            cache: run.cache,
        };
        recipe::run_from(&self.recipe, first, scene, settings, listener)
    }

    /// Runs all steps before the step with the index `step`, and returns the resulting scene. Returns `None` if one of
    /// these steps fails or the run is canceled.
    pub fn scene_before(&mut self, step: usize, listener: &dyn Listener) -> Option<Scene> {
        let later = self.recipe.steps.split_off(step);
        let expectations = std::mem::take(&mut self.recipe.expectations);
        let outcome = self.run(Run::default(), listener);
        self.recipe.steps.extend(later);
        self.recipe.expectations = expectations;
        let succeeded = outcome.succeeded();
        outcome.scene.filter(|_| succeeded)
    }

    /// Renders diagnostics as text with excerpts of the recipe, as compilers do.
    pub fn render(&self, diagnostics: &[Diagnostic], colours: bool) -> String {
        recipe::render(&self.recipe.sources, diagnostics, colours)
    }
}
