//! A recipe that was read and checked, and its runs.

use op::Files;
use recipe::{Diagnostic, Forecast, Listener, Outcome, Recipe, Settings, StepCache};
use scene::Scene;

use crate::FileReader;

/// A recipe that was read and checked.
#[derive(Debug)]
pub struct Loaded {
    /// The path of its text, as it is shown.
    pub path: String,
    /// The recipe, as far as it could be read.
    pub recipe: Recipe,
    /// Its folders and its store.
    pub files: Files,
    /// How many bytes meshes may take.
    pub budget: u64,
    /// What is known of the scene after each step.
    pub forecast: Forecast,
    /// Whether every step and expectation could be read.
    pub is_read: bool,
    /// Everything that is wrong, from reading and from checking, in order.
    pub diagnostics: Vec<Diagnostic>,
}

/// How a recipe is run. By default outputs are not kept, and there is no cache.
#[derive(Clone, Copy, Debug, Default)]
pub struct Run<'a> {
    /// Whether outputs are kept.
    pub keep_outputs: bool,
    /// The step cache, if there is one.
    pub cache: Option<&'a dyn StepCache>,
}

impl Loaded {
    /// Whether the recipe cannot run.
    pub fn has_errors(&self) -> bool {
        self.n_errors() > 0
    }

    /// How many errors there are.
    pub fn n_errors(&self) -> usize {
        self.diagnostics.iter().filter(|d| d.is_error()).count()
    }

    /// Runs the recipe, which must have no errors.
    pub fn run(&self, run: Run, listener: &dyn Listener) -> Outcome {
        self.run_from(0, Scene::new(), run, listener)
    }

    /// Runs the recipe from the step of number `first` on, as [`recipe::run_from`] does: `scene` is that before it.
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

    /// The scene before a step. `None` if a step before it fails.
    pub fn scene_before(&mut self, step: usize, listener: &dyn Listener) -> Option<Scene> {
        let later = self.recipe.steps.split_off(step);
        let expectations = std::mem::take(&mut self.recipe.expectations);
        let outcome = self.run(Run::default(), listener);
        self.recipe.steps.extend(later);
        self.recipe.expectations = expectations;
        let succeeded = outcome.succeeded();
        outcome.scene.filter(|_| succeeded)
    }

    /// Diagnostics as a compiler shows them.
    pub fn render(&self, diagnostics: &[Diagnostic], colours: bool) -> String {
        recipe::render(&self.recipe.sources, diagnostics, colours)
    }
}
