//! Renames an object.
//!
//! ```text
//!   "head", "body"   --->   "skull", "body"
//! ```

use op::prelude::*;
use op::{Operation, named_object};

/// Renames an object.
///
/// The order of the objects does not change. If an object comes from a glTF file, the object, its nodes and its mesh
/// each have a name, and these names can differ. A node or mesh with the old name of the object also gets the new name.
/// If no node has the old name, the mesh gets the new name even if the mesh did not have the old name.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Rename {
    /// The current name.
    pub from: String,
    /// The new name.
    pub to: String,
}

impl Operation for Rename {
    const NAME: &'static str = "Rename";
    const SUMMARY: &'static str = "Rename an object";
    const EXAMPLE: &'static str = r#"Rename(from: "mesh", to: "new")"#;

    fn plan(&self, plan: &mut Plan, _: &PlanContext) -> Vec<Problem> {
        let mut problem = plan.missing(&self.from, ["from"]);
        if problem.is_none() && self.from != self.to {
            problem = plan.taken(&self.to, "to");
        }
        if problem.is_none()
            && let Some(object) = plan.objects_mut().iter_mut().find(|o| o.name == self.from)
        {
            object.name.clone_from(&self.to);
            plan.edit_graph(|graph| graph.rename_object(&self.from, &self.to));
        }
        Vec::from_iter(problem)
    }

    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError> {
        cx.advance("rename", 0, 1)?;
        named_object(scene, &self.from)?;
        scene
            .rename(&self.from, &self.to)
            .map_err(|e| OpError::Object(e.to_string()))?;
        Ok(Report::changed(1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use scene::Object;

    fn step(text: &str) -> Rename {
        op::test::read(text).unwrap()
    }

    fn scene() -> Scene {
        let mut scene = Scene::new();
        for name in ["a", "b"] {
            scene.insert(Object::mesh(name, shapes::square())).unwrap();
        }
        scene
    }

    #[test]
    fn the_order_of_the_objects_does_not_change() {
        let mut scene = scene();
        op::test::run(&step(r#"(from: "a", to: "c")"#), &mut scene).unwrap();
        let names: Vec<_> = scene.objects().iter().map(|o| o.name.as_str()).collect();
        assert_eq!(names, ["c", "b"]);
    }

    #[test]
    fn a_missing_object_and_a_taken_name_are_refused() {
        for text in [r#"(from: "d", to: "c")"#, r#"(from: "a", to: "b")"#] {
            let mut scene = scene();
            assert!(matches!(
                op::test::run(&step(text), &mut scene),
                Err(OpError::Object(_))
            ));
            assert_eq!(scene, self::scene());
        }
    }

    #[test]
    fn the_plan_agrees_with_the_result() {
        let files = op::Files::default();
        let cx = PlanContext::new(&files);
        let mut plan = Plan::default();
        for name in ["a", "b"] {
            assert_eq!(plan.insert(name, PlannedGeometry::Polylines), None);
        }
        assert_eq!(
            step(r#"(from: "d", to: "c")"#).plan(&mut plan, &cx)[0].path,
            ["from"]
        );
        assert_eq!(
            step(r#"(from: "a", to: "b")"#).plan(&mut plan, &cx)[0].path,
            ["to"]
        );
        assert_eq!(step(r#"(from: "a", to: "a")"#).plan(&mut plan, &cx), []);
        assert_eq!(step(r#"(from: "a", to: "c")"#).plan(&mut plan, &cx), []);
        assert_eq!(plan.objects()[0].name, "c");
    }
}
