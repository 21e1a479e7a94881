//! Deletes objects.
//!
//! ```text
//!   "head", "body", "tail"   --->   "head", "tail"
//! ```

use op::prelude::*;
use op::{Operation, named_object};

/// Deletes objects.
///
/// The remaining objects keep their order. If a node of the scene (as in glTF) places a deleted object, the step also
/// removes the node. However, if the node has children, a camera or a light, or is a joint of a skin, the node is kept
/// without the object.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Delete {
    /// The names of the objects. All of these objects must exist.
    pub objects: Vec<String>,
}

impl Operation for Delete {
    const NAME: &'static str = "Delete";
    const SUMMARY: &'static str = "Delete objects";
    const EXAMPLE: &'static str = r#"Delete(objects: ["mesh"])"#;
    const WORDS: &'static [&'static str] = &["remove"];

    fn plan(&self, plan: &mut Plan, _: &PlanContext) -> Vec<Problem> {
        let mut problems = Vec::new();
        for (i, name) in self.objects.iter().enumerate() {
            problems.extend(plan.missing(name, ["objects", &i.to_string()]));
            plan.remove(name);
        }
        problems
    }

    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError> {
        cx.advance("delete", 0, 1)?;
        for name in &self.objects {
            named_object(scene, name)?;
            scene.remove(name);
        }
        Ok(Report::changed(self.objects.len()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use scene::Object;

    fn step(text: &str) -> Delete {
        op::test::read(text).unwrap()
    }

    fn scene() -> Scene {
        let mut scene = Scene::new();
        for name in ["a", "b", "c"] {
            scene.insert(Object::mesh(name, shapes::square())).unwrap();
        }
        scene
    }

    #[test]
    fn the_remaining_objects_keep_their_order() {
        let mut scene = scene();
        let report = op::test::run(&step(r#"(objects: ["b"])"#), &mut scene).unwrap();
        assert_eq!(report.changed, 1);
        let names: Vec<_> = scene.objects().iter().map(|o| o.name.as_str()).collect();
        assert_eq!(names, ["a", "c"]);
    }

    #[test]
    fn missing_and_repeated_names_are_errors() {
        for text in [r#"(objects: ["d"])"#, r#"(objects: ["a", "a"])"#] {
            let deleted = op::test::run(&step(text), &mut scene());
            assert!(matches!(deleted, Err(OpError::Object(_))));
        }
    }

    #[test]
    fn the_plan_reports_the_index_of_a_missing_name() {
        let files = op::Files::default();
        let cx = PlanContext::new(&files);
        let mut plan = Plan::default();
        assert_eq!(plan.insert("a", PlannedGeometry::Polylines), None);
        let problems = step(r#"(objects: ["a", "d"])"#).plan(&mut plan, &cx);
        assert_eq!(problems.len(), 1);
        assert_eq!(problems[0].path, ["objects", "1"]);
        assert_eq!(plan.objects(), []);
    }
}
