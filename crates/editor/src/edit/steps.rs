//! Changes the steps, the parameters and the expectations of the recipe's text.

use std::sync::Arc;

use super::{CommandError, Editor};
use crate::panel::Panel;
use crate::text::{self, Edits, TextError};

impl Editor {
    /// Applies edits to the text of the recipe, and runs the changed recipe.
    pub(super) fn edit(
        &mut self,
        edits: Edits,
        label: &str,
        cursor: Option<usize>,
    ) -> Result<(), CommandError> {
        let text = text::apply(self.text(), edits)?;
        if self.document.replace(text, label, false) {
            self.text_changed(cursor);
        } else if self.preview.is_some() {
            self.show(None);
        }
        Ok(())
    }

    pub(super) fn preview_edits(&mut self, edits: Edits) -> Result<(), CommandError> {
        let text: Arc<str> = text::apply(self.text(), edits)?.into();
        self.show(Some(text));
        Ok(())
    }

    /// Whether the view shows a preview.
    pub fn is_preview(&self) -> bool {
        self.preview.is_some()
    }

    /// Ends a preview: the text of the document runs again.
    pub fn end_preview(&mut self) {
        if self.preview.is_some() {
            self.show(None);
        }
    }

    /// Replaces the span of bytes `start..end` of the text.
    ///
    /// # Errors
    ///
    /// Returns [`CommandError::Text`] if the span is out of range or splits a character.
    pub fn replace_span(
        &mut self,
        start: usize,
        end: usize,
        new: &str,
    ) -> Result<(), CommandError> {
        let edits = vec![(ron_tree::Span::new(start, end), new.to_owned())];
        self.edit(edits, "edit", None)
    }

    /// Returns the panel of a step. Returns `None` if the step does not exist or its operation is unknown.
    pub fn panel(&self, step: usize) -> Option<Panel> {
        Panel::of_step(self.registry(), self.outline.run_of(step)?, self.text())
    }

    /// Sets a parameter of a step, or a part of its value. The path, such as `["edges", "Random", "count"]`, says which
    /// part is set. If the new value is `None`, the parameter is removed from the text. The parameter then has its
    /// default value. Comments and layout stay.
    ///
    /// # Errors
    ///
    /// Returns [`CommandError::Text`] if the step does not exist, or if `path` leads into a value without fields or to
    /// an item that does not exist.
    pub fn set_parameter(
        &mut self,
        step: usize,
        path: &[&str],
        value: Option<&str>,
    ) -> Result<(), CommandError> {
        let edits = self.parameter_edits(step, path, value)?;
        self.edit(edits, "change a parameter", None)
    }

    /// Previews another value of a step's parameter: runs the recipe with this value, but does not change the text. A
    /// window calls this function while the user drags a slider. If a run with an older value is still in progress, it
    /// is canceled. Afterwards, [`set_parameter`](Self::set_parameter) can write the value to the text, or
    /// [`end_preview`](Self::end_preview) can end the preview.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`set_parameter`](Self::set_parameter).
    pub fn preview_parameter(
        &mut self,
        step: usize,
        path: &[&str],
        value: &str,
    ) -> Result<(), CommandError> {
        let edits = self.parameter_edits(step, path, Some(value))?;
        self.preview_edits(edits)
    }

    fn parameter_edits(
        &self,
        step: usize,
        path: &[&str],
        value: Option<&str>,
    ) -> Result<Edits, TextError> {
        let missing = TextError::NoStep(step, self.outline.steps.len());
        let run = self.outline.run_of(step).ok_or(missing)?;
        let path: Vec<String> = path.iter().map(|&item| item.to_owned()).collect();
        text::set_field(self.text(), run, &path, value)
    }

    /// Returns the value of a step's parameter, as written in the text. Returns `None` if the step does not set the
    /// parameter.
    pub fn parameter(&self, step: usize, path: &[&str]) -> Option<&str> {
        let path: Vec<String> = path.iter().map(|&item| item.to_owned()).collect();
        let value = text::field_value(self.outline.run_of(step)?, &path)?;
        Some(value.span.of(self.text()))
    }

    /// Sets the default value of a parameter of the recipe.
    ///
    /// # Errors
    ///
    /// Returns [`CommandError::Text`] if the parameter does not exist.
    pub fn set_recipe_parameter(&mut self, name: &str, value: &str) -> Result<(), CommandError> {
        let edits = self.recipe_parameter_edits(name, value)?;
        self.edit(edits, "change a parameter of the recipe", None)
    }

    /// Previews another default value of a recipe's parameter: runs the recipe with this value, but does not change the
    /// text. A window calls this function while the user drags a slider.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`set_recipe_parameter`](Self::set_recipe_parameter).
    pub fn preview_recipe_parameter(
        &mut self,
        name: &str,
        value: &str,
    ) -> Result<(), CommandError> {
        let edits = self.recipe_parameter_edits(name, value)?;
        self.preview_edits(edits)
    }

    fn recipe_parameter_edits(&self, name: &str, value: &str) -> Result<Edits, TextError> {
        let parameters = &self.outline.parameters;
        let found = parameters.iter().find(|parameter| parameter.name == name);
        let span = found.and_then(|parameter| parameter.default);
        let span = span.ok_or_else(|| TextError::NoParameter(name.to_owned()))?;
        Ok(vec![(span, value.to_owned())])
    }

    /// Deletes a step.
    ///
    /// # Errors
    ///
    /// Returns [`CommandError::Text`] if the step does not exist.
    pub fn delete_step(&mut self, step: usize) -> Result<(), CommandError> {
        let edits = text::remove_step(self.text(), &self.outline, step)?;
        let cursor = if step < self.cursor() {
            self.cursor() - 1
        } else {
            self.cursor()
        };
        self.edit(edits, "delete a step", Some(cursor))
    }

    /// Inserts a copy of a step directly after this step. If the step has an id, the copy gets a new id.
    ///
    /// # Errors
    ///
    /// Returns [`CommandError::Text`] if the step does not exist.
    pub fn duplicate_step(&mut self, step: usize) -> Result<(), CommandError> {
        let edits = text::duplicate_step(self.text(), &self.outline, step)?;
        let cursor = if step < self.cursor() {
            self.cursor() + 1
        } else {
            self.cursor()
        };
        self.edit(edits, "duplicate a step", Some(cursor))
    }

    /// Moves the step with the index `from`, so that its new index is `to`. The comments above the step, and the
    /// comments at the end of its line, move with the step.
    ///
    /// # Errors
    ///
    /// Returns [`CommandError::Text`] if one of the two indices is not less than the number of steps.
    pub fn move_step(&mut self, from: usize, to: usize) -> Result<(), CommandError> {
        let edits = text::move_step(self.text(), &self.outline, from, to)?;
        let cursor = self.cursor();
        self.edit(edits, "move a step", Some(cursor))
    }

    /// Enables or disables a step. In the text of the recipe, a disabled step has `enabled: false`.
    ///
    /// # Errors
    ///
    /// Returns [`CommandError::Text`] if the step does not exist.
    pub fn set_enabled(&mut self, step: usize, enabled: bool) -> Result<(), CommandError> {
        let edits = text::set_enabled(self.text(), &self.outline, step, enabled)?;
        let label = if enabled {
            "enable a step"
        } else {
            "disable a step"
        };
        let cursor = self.cursor();
        self.edit(edits, label, Some(cursor))
    }

    /// Adds expectations at the end of the recipe.
    ///
    /// # Errors
    ///
    /// Returns [`CommandError::Text`] if the text has errors.
    pub fn add_expectations(&mut self, expectations: &[String]) -> Result<(), CommandError> {
        let edits = text::add_expectations(self.text(), &self.outline, expectations)?;
        self.edit(edits, "record a test", None)
    }
}
