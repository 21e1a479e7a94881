//! Records a test: adds expectations, such as the present number of faces, to the recipe.

use engine::{FileReader, Silent};
use op::Files;
use recipe::Expectation;
use recipe::expect::Subject;
use scene::Scene;

use super::{CommandError, Editor};
use crate::text::{self, Outline};

impl Editor {
    /// Adds expectations about the scene after the last step before the step cursor: the numbers of objects, vertices,
    /// edges and faces, and the Euler characteristic. Also adds `Manifold` and `Closed` if these expectations hold. If
    /// the step cursor is not at the end of the recipe, the expectations are checked directly after the step before the
    /// cursor. They refer to this step by its id. If this step has no id, it gets one. Returns the expectations.
    ///
    /// # Errors
    ///
    /// Returns [`CommandError::Text`] if the text has errors. Returns [`CommandError::NoScene`] if the scene after the
    /// last step before the step cursor is not known, or if the cursor is before the first step.
    pub fn record_test(&mut self) -> Result<Vec<String>, CommandError> {
        let view = self.view();
        if !view.is_current {
            return Err(CommandError::NoScene);
        }
        let expectations = facts(&view.scene);
        let is_end = self.cursor() == self.outline().steps.len();
        if is_end {
            self.add_expectations(&expectations)?;
            return Ok(expectations);
        }
        let Some(step) = self.cursor().checked_sub(1) else {
            return Err(CommandError::NoScene);
        };
        let mut new = self.text().to_owned();
        let outline = self.outline();
        let id = if let Some(id) = &outline.steps[step].id {
            id.clone()
        } else {
            let id = text::unused_id(outline, &outline.steps[step].name.to_lowercase());
            let literal = ron_tree::string_literal(&id);
            let edits = text::set_envelope_field(&new, outline, step, "id", Some(&literal))?;
            new = text::apply(&new, edits)?;
            id
        };
        let that = expectations.join(", ");
        let placed = format!("(after: {}, that: [{that}])", ron_tree::string_literal(&id));
        let edits = text::add_expectations(&new, &Outline::of(&new), &[placed])?;
        let new = text::apply(&new, edits)?;
        let cursor = self.cursor();
        if self.document.replace(new, "record a test", false) {
            self.text_changed(Some(cursor));
        }
        Ok(expectations)
    }
}

/// Returns expectations that hold for a scene.
fn facts(scene: &Scene) -> Vec<String> {
    let meshes: Vec<_> = scene
        .objects()
        .iter()
        .filter_map(|object| object.as_mesh())
        .collect();
    let sum =
        |count: fn(&mesh::Mesh) -> usize| meshes.iter().map(|mesh| count(mesh)).sum::<usize>();
    let mut all = vec![format!("Objects(eq: {})", scene.objects().len())];
    if !meshes.is_empty() {
        let euler: i64 = meshes.iter().map(|mesh| mesh.euler_characteristic()).sum();
        all.extend([
            format!("Vertices(eq: {})", sum(mesh::Mesh::n_vertices)),
            format!("Edges(eq: {})", sum(mesh::Mesh::n_edges)),
            format!("Faces(eq: {})", sum(mesh::Mesh::n_faces)),
            format!("EulerCharacteristic(eq: {euler})"),
            "Manifold".to_owned(),
            "Closed".to_owned(),
        ]);
    }
    let files = Files::default();
    let holds = |text: &String| {
        let subject = Subject {
            scene,
            on: None,
            files: &files,
            reader: &FileReader,
            progress: &Silent,
        };
        let expectation = ron_tree::from_str::<Expectation>(text);
        expectation.is_ok_and(|expectation| expectation.check(subject).is_ok())
    };
    all.retain(holds);
    all
}
