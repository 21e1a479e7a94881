//! Copies an object under a new name.
//!
//! ```text
//!   "head", "body"   --->   "head", "body", "twin"
//! ```

use op::prelude::*;
use op::{Operation, check_name, named_object};
use scene::Object;

/// Copies an object, with its attributes and materials, under a new name.
///
/// The copy is added after all other objects. The elements of the copy have the same ids as in the original. If nodes
/// of the scene (as in glTF) place the object, each of these nodes gets a sibling node. The sibling node places the
/// copy at the same location.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Copy {
    /// The name of the object to copy.
    pub from: String,
    /// The name of the new object.
    pub to: String,
}

impl Operation for Copy {
    const NAME: &'static str = "Copy";
    const SUMMARY: &'static str = "Copy an object under a new name";
    const EXAMPLE: &'static str = r#"Copy(from: "mesh", to: "new")"#;
    const WORDS: &'static [&'static str] = &["duplicate", "clone"];

    fn plan(&self, plan: &mut Plan, _: &PlanContext) -> Vec<Problem> {
        let Some(object) = plan.object(&self.from) else {
            return Vec::from_iter(plan.missing(&self.from, ["from"]));
        };
        let geometry = object.geometry.clone();
        let taken = plan.insert_copy(&self.from, &self.to, geometry);
        Vec::from_iter(taken.map(|p| p.at(["to"])))
    }

    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError> {
        let object = named_object(scene, &self.from)?;
        check_name(scene, &self.to)?;
        cx.advance("copy", 0, 1)?;
        let copy = Object {
            name: self.to.clone(),
            ..object.clone()
        };
        scene.insert(copy).expect("the name is free");
        if !scene.graph().is_empty() {
            scene.graph_mut().copy_object(&self.from, &self.to);
        }
        Ok(Report::changed(1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use op::{Files, MeshPlan, PlannedGeometry};
    use scene::Material;

    fn step(text: &str) -> Copy {
        op::test::read(text).unwrap()
    }

    fn scene() -> Scene {
        let mut scene = Scene::new();
        let mut head = Object::mesh("head", shapes::cube());
        head.materials.push(Material::new("skin"));
        scene.insert(head).unwrap();
        scene
            .insert(Object::mesh("body", shapes::square()))
            .unwrap();
        scene
    }

    #[test]
    fn the_copy_is_equal_and_comes_last() {
        let mut scene = scene();
        op::test::run(&step(r#"(from: "head", to: "twin")"#), &mut scene).unwrap();
        let names: Vec<_> = scene.objects().iter().map(|o| o.name.as_str()).collect();
        assert_eq!(names, ["head", "body", "twin"]);
        assert_eq!(scene.objects()[2].geometry, scene.objects()[0].geometry);
        assert_eq!(scene.objects()[2].materials, scene.objects()[0].materials);
    }

    #[test]
    fn a_missing_source_and_a_taken_name_are_refused() {
        for text in [
            r#"(from: "tail", to: "twin")"#,
            r#"(from: "head", to: "body")"#,
        ] {
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
        let files = Files::default();
        let cx = PlanContext::new(&files);
        let mut plan = Plan::default();
        let cube = PlannedGeometry::Mesh(MeshPlan::of(&shapes::cube()));
        assert_eq!(plan.insert("head", cube.clone()), None);
        assert_eq!(
            step(r#"(from: "head", to: "twin")"#).plan(&mut plan, &cx),
            []
        );
        assert_eq!(plan.object("twin").unwrap().geometry, cube);
        let taken = step(r#"(from: "head", to: "twin")"#).plan(&mut plan, &cx);
        assert_eq!(taken[0].path, ["to"]);
        let missing = step(r#"(from: "tail", to: "x")"#).plan(&mut plan, &cx);
        assert_eq!(missing[0].path, ["from"]);
    }
}
