//! Lods: makes levels of detail, a chain of simplified copies of an object.
//!
//! ```text
//!   "rock" (1000 faces)   --->   "rock", "rock_lod1" (500), "rock_lod2" (250), "rock_lod3" (100)
//! ```

use std::sync::Arc;

use geometry::simplify::{Options, simplify};
use op::prelude::*;
use op::{Operation, check_name, named_object};
use scene::{Geometry, Object};

use crate::simplify::{
    error, note_overlaps, note_quantities, part, plan_goal, triangles_problem, unreached,
};

/// Makes levels of detail: simplified copies of an object.
///
/// The copies are named after the object, for example `rock_lod1`, `rock_lod2` and so on. Each copy is made as with
/// `Simplify`, which keeps attributes, materials and lines such as boundaries, seams and creases. The first copy is
/// made from the object, and each further copy from the previous copy. If the scene has nodes that reference the
/// object, each of these nodes gets one sibling node for each copy. The sibling node references the copy and has the
/// same transform.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Lods {
    /// The name of the object.
    pub from: String,
    /// For each copy, the number of its faces divided by the number of faces of the original object. Each fraction must
    /// be smaller than the previous fraction in the list.
    pub ratios: Vec<Fraction>,
    /// The text before the number in the names of the copies. If omitted, the name of the object followed by `_lod`.
    #[serde(default)]
    pub to: Option<String>,
    /// Edges to keep as lines, in addition to the lines that `Simplify` always keeps. For example, `Sharp(above: 30)`.
    /// If omitted, no additional edges.
    #[serde(default)]
    pub features: Option<EdgeSelection>,
    /// What to do if a copy cannot be reduced to the requested number of faces.
    #[serde(default)]
    pub on_refusal: OnRefusal,
}

impl Lods {
    /// Returns the name of the copy with this number. The first copy has the number 1.
    fn name(&self, number: usize) -> String {
        match &self.to {
            Some(to) => format!("{to}{number}"),
            None => format!("{}_lod{number}", self.from),
        }
    }

    fn problem(&self) -> Option<Problem> {
        let problem = |message: &str| Some(Problem::error(message).at(["ratios"]));
        match self.ratios.as_slice() {
            [] => problem("Lods needs at least one ratio"),
            ratios if ratios.windows(2).any(|pair| pair[1].get() >= pair[0].get()) => {
                problem("each ratio must be smaller than the previous one")
            }
            _ => None,
        }
    }
}

impl Operation for Lods {
    const NAME: &'static str = "Lods";
    const VERSION: u32 = 4;
    const SUMMARY: &'static str = "Make levels of detail: simplified copies of an object";
    const EXAMPLE: &'static str = r#"Lods(from: "mesh", ratios: [0.5, 0.25])"#;
    const WORDS: &'static [&'static str] = &["lod", "level of detail"];

    fn plan(&self, plan: &mut Plan, _: &PlanContext) -> Vec<Problem> {
        let Some(object) = plan.object(&self.from) else {
            return Vec::from_iter(plan.missing(&self.from, ["from"]));
        };
        let PlannedGeometry::Mesh(mesh) = object.geometry.clone() else {
            let message = format!("Lods needs a mesh, but \"{}\" is not a mesh", self.from);
            return vec![Problem::error(message).at(["from"])];
        };
        let mut problems = Vec::from_iter(self.problem());
        problems.extend(triangles_problem(Self::NAME, &mesh));
        for (i, &ratio) in self.ratios.iter().enumerate() {
            let mut copy = mesh.clone();
            let goal = Range {
                min: part(mesh.faces.min, ratio),
                max: part(mesh.faces.max, ratio),
            };
            plan_goal(&mut copy, goal, self.on_refusal == OnRefusal::Error);
            let copy = PlannedGeometry::Mesh(copy);
            problems.extend(plan.insert_copy(&self.from, &self.name(i + 1), copy));
        }
        problems
    }

    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError> {
        if let Some(problem) = self.problem() {
            return Err(OpError::Parameter(problem.message));
        }
        let object = named_object(scene, &self.from)?.clone();
        let Geometry::Mesh(original) = &object.geometry else {
            return Err(OpError::Object(format!("\"{}\" is not a mesh", self.from)));
        };
        cx.advance("simplify", 0, self.ratios.len() as u64)?;
        let n_faces = original.n_faces() as u64;
        let mut mesh = Arc::clone(original);
        let mut report = Report::changed(self.ratios.len());
        note_quantities(original, &mut report);
        cx.set_object(scene, &self.from);
        for (i, &ratio) in self.ratios.iter().enumerate() {
            let name = self.name(i + 1);
            check_name(scene, &name)?;
            let features = match &self.features {
                Some(features) => features.resolve(&mesh, cx)?,
                None => Vec::new(),
            };
            let goal = part(n_faces, ratio);
            let faces = usize::try_from(goal).unwrap_or(usize::MAX);
            let options = Options {
                faces,
                error: None,
                features: &features,
                pinned: &[],
                refuse_intersections: false,
            };
            let simplified = simplify(&mesh, &options, cx.progress()).map_err(|e| error(&e))?;
            note_overlaps(&mesh, &simplified.mesh, &mut report, cx)?;
            mesh = Arc::new(simplified.mesh);
            if mesh.n_faces() as u64 > goal {
                let refused = unreached(mesh.n_faces(), goal, &simplified.blocked);
                self.on_refusal.refuse(refused, &mut report)?;
            }
            let copy = Object {
                name: name.clone(),
                geometry: Geometry::Mesh(Arc::clone(&mesh)),
                ..object.clone()
            };
            scene.insert(copy).expect("the name is free");
            if !scene.graph().is_empty() {
                scene.graph_mut().copy_object(&self.from, &name);
            }
        }
        cx.clear_object();
        Ok(report)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use op::Files;

    fn step(text: &str) -> Lods {
        op::test::read(text).unwrap()
    }

    fn scene() -> Scene {
        let mut scene = Scene::new();
        scene
            .insert(Object::mesh("ball", shapes::icosahedron()))
            .unwrap();
        scene
    }

    #[test]
    fn the_copies_form_a_chain() {
        let mut scene = scene();
        op::test::run(
            &step(r#"(from: "ball", ratios: [0.7, 0.5, 0.2])"#),
            &mut scene,
        )
        .unwrap();
        let sizes: Vec<(&str, usize)> = scene
            .objects()
            .iter()
            .map(|object| match &object.geometry {
                Geometry::Mesh(mesh) => (object.name.as_str(), mesh.n_faces()),
                _ => unreachable!("all objects are meshes"),
            })
            .collect();
        let expected = [
            ("ball", 20),
            ("ball_lod1", 14),
            ("ball_lod2", 10),
            ("ball_lod3", 4),
        ];
        assert_eq!(sizes, expected);
    }

    #[test]
    fn bad_ratios_and_missing_or_taken_names_are_refused() {
        for text in [
            r#"(from: "ball", ratios: [])"#,
            r#"(from: "ball", ratios: [0.5, 0.5])"#,
            r#"(from: "cube", ratios: [0.5])"#,
        ] {
            let files = Files::default();
            let cx = PlanContext::new(&files);
            let mut plan = Plan::default();
            let ball = PlannedGeometry::Mesh(MeshPlan::of(&shapes::icosahedron()));
            assert_eq!(plan.insert("ball", ball), None);
            assert_eq!(step(text).plan(&mut plan, &cx).len(), 1, "{text}");
            let mut scene = scene();
            assert!(op::test::run(&step(text), &mut scene).is_err(), "{text}");
            assert_eq!(scene, self::scene());
        }
    }

    #[test]
    fn the_plan_agrees_with_the_result() {
        let files = Files::default();
        let cx = PlanContext::new(&files);
        let mut plan = Plan::default();
        let ball = PlannedGeometry::Mesh(MeshPlan::of(&shapes::icosahedron()));
        assert_eq!(plan.insert("ball", ball), None);
        let lods = step(r#"(from: "ball", ratios: [0.5], to: "low")"#);
        assert_eq!(lods.plan(&mut plan, &cx), []);
        let PlannedGeometry::Mesh(low) = &plan.object("low1").unwrap().geometry else {
            panic!("not a mesh");
        };
        assert!(low.faces.contains(10));
    }
}
