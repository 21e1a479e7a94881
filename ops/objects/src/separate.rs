//! Separate: takes a mesh apart into several objects.
//!
//! ```text
//!    "figure"            "figure 1"   "figure 2"
//!       o                    o
//!       |       --->                      |         each component, material or part of a tag
//!      / \                               / \        becomes an object of its own
//! ```

use std::sync::Arc;

use mesh::{Domain, MATERIAL};
use op::prelude::*;
use op::{Loss, Operation, PlannedObject, Refusal, check_name, named_object};
use scene::{Geometry, Object};

/// Takes a mesh apart into several objects.
///
/// The parts of "figure" are named "figure 1", "figure 2" and so on. The first stands at the place of the
/// object, which is gone, the others behind all others. Elements keep their order and their values, and
/// every part has all materials. Vertices without a face belong to no part; they are left out and counted.
/// A mesh without faces is refused.
///
/// Where parts of one component are separated, the edges and vertices between them are in both. Where
/// the faces of a part around a vertex do not share edges each fan of them gets a vertex of its own.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Separate {
    /// The name of the mesh.
    pub object: String,
    /// What belongs together.
    #[serde(default)]
    pub by: By,
    /// How many parts there must be; another number is refused. Without it the names of the parts are
    /// known only when the recipe runs, so that later steps are not checked against them before.
    #[serde(default)]
    pub count: Option<Count<1>>,
}

/// What belongs together.
#[derive(Clone, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum By {
    /// What is connected, in order of the lowest faces.
    #[default]
    Components,
    /// Faces of one material, in order of the materials; those without one last.
    Material,
    /// First the faces marked by the tag of this name, then the others.
    Tag(String),
}

impl Operation for Separate {
    const NAME: &'static str = "Separate";
    const SUMMARY: &'static str = "Take a mesh apart into several objects";
    const EXAMPLE: &'static str = r#"Separate(object: "mesh")"#;

    fn plan(&self, plan: &mut Plan, _: &PlanContext) -> Vec<Problem> {
        let Some(place) = plan.objects().iter().position(|o| o.name == self.object) else {
            return Vec::from_iter(plan.missing(&self.object, ["object"]));
        };
        let PlannedGeometry::Mesh(mesh) = &plan.objects()[place].geometry else {
            let kind = plan.objects()[place].geometry.kind();
            return vec![Problem::error(not_a_mesh(&self.object, kind)).at(["object"])];
        };
        if mesh.faces.max == 0 {
            return vec![Problem::error(self.no_faces()).at(["object"])];
        }
        let part = self.part_of(mesh);
        let Some(count) = self.count.map(Count::get) else {
            // The parts have names that cannot be known.
            plan.objects_mut().remove(place);
            plan.incomplete = true;
            return Vec::new();
        };
        if u64::from(count) > mesh.faces.max {
            let message = format!(
                "\"{}\" has at most {} faces, too few for {count} parts",
                self.object, mesh.faces.max
            );
            return vec![Problem::error(message).at(["count"])];
        }
        let names: Vec<String> = (1..=count).map(|i| self.name(i)).collect();
        if let Some(taken) = names.iter().find_map(|name| plan.taken(name, "object")) {
            return vec![taken];
        }
        let mut objects = names.into_iter().map(|name| PlannedObject {
            name,
            geometry: PlannedGeometry::Mesh(part.clone()),
        });
        plan.objects_mut()[place] = objects.next().expect("at least one part");
        plan.objects_mut().extend(objects);
        Vec::new()
    }

    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError> {
        let object = named_object(scene, &self.object)?;
        let no_mesh = || OpError::Object(not_a_mesh(&self.object, object.geometry.kind()));
        let mesh = Arc::clone(object.as_mesh().ok_or_else(no_mesh)?);
        cx.advance("separate", 0, 2)?;
        let parts = self.by.parts(&mesh)?;
        if parts.is_empty() {
            return Err(OpError::refused(Refusal::Expectation, self.no_faces()));
        }
        if let Some(count) = self.count.map(Count::get)
            && parts.len() != count as usize
        {
            let message = format!("expected {count} parts, found {}", parts.len());
            return Err(OpError::refused(Refusal::Expectation, message));
        }
        let names: Vec<String> = (1..).map(|i| self.name(i)).take(parts.len()).collect();
        for name in &names {
            check_name(scene, name)?;
        }
        cx.advance("separate", 1, 2)?;

        let mut report = Report::changed(parts.len());
        report.losses = self.losses(&mesh, &parts);
        self.replace(scene, &names, parts);
        let isolated = mesh.n_isolated_vertices();
        Ok(report.count("vertices without a face, left out", isolated))
    }
}

impl By {
    /// The parts, none of them without faces.
    fn parts(&self, mesh: &Mesh) -> Result<Vec<Mesh>, OpError> {
        let part_of_face: Vec<usize> = match self {
            Self::Components => return Ok(geometry::separated(mesh)),
            Self::Material => {
                let of_face = mesh.get(MATERIAL).unwrap_or_default();
                let material = |f: usize| of_face.get(f).copied().unwrap_or(-1);
                // Those without a material come last.
                (0..mesh.n_faces())
                    .map(|f| usize::try_from(material(f)).unwrap_or(usize::MAX - 1))
                    .collect()
            }
            Self::Tag(name) => {
                let Some(marks) = mesh.tag(Domain::Face, name) else {
                    let message = format!("no faces are tagged \"{name}\"");
                    return Err(OpError::refused(Refusal::Missing, message));
                };
                marks
                    .iter()
                    .map(|is_marked| usize::from(!is_marked))
                    .collect()
            }
        };
        Ok(geometry::parts(mesh, &part_of_face))
    }
}

impl Separate {
    /// The name of the i-th part, from 1.
    fn name(&self, i: u32) -> String {
        format!("{} {i}", self.object)
    }

    fn no_faces(&self) -> String {
        format!("\"{}\" has no faces to separate", self.object)
    }

    /// What is known of each part.
    fn part_of(&self, whole: &MeshPlan) -> MeshPlan {
        let mut part = whole.clone();
        // Copies are made for fans that meet in a vertex, at most one for each edge.
        part.vertices = whole.vertices.plus(whole.edges).or_less();
        part.edges = whole.edges.or_less();
        part.faces = whole.faces.or_less();
        if self.by == By::Components {
            part.vertices = whole.vertices.or_less();
        }
        part
    }

    /// Columns that a part has lost because it was cut off.
    fn losses(&self, whole: &Mesh, parts: &[Mesh]) -> Vec<Loss> {
        let columns = whole
            .attributes()
            .iter()
            .map(|(domain, c)| (domain, &c.name));
        let lost = columns.filter(|(domain, name)| {
            let lacks = |part: &Mesh| part.attributes().column(*domain, name).is_none();
            parts.iter().any(lacks)
        });
        let reason = "Separate cuts between faces";
        lost.map(|(domain, name)| Loss::attribute(&self.object, domain, name, reason))
            .collect()
    }

    /// Puts the parts into the scene; the names are free.
    fn replace(&self, scene: &mut Scene, names: &[String], parts: Vec<Mesh>) {
        let (_, materials) = scene.parts_mut(&self.object).expect("it was found");
        let materials = materials.clone();
        for (i, (name, part)) in names.iter().zip(parts).enumerate() {
            let geometry = Geometry::Mesh(Arc::new(part));
            if i == 0 {
                *scene.parts_mut(&self.object).expect("it was found").0 = geometry;
                scene.rename(&self.object, name).expect("the name is free");
            } else {
                let object = Object {
                    name: name.clone(),
                    geometry,
                    materials: materials.clone(),
                };
                scene.insert(object).expect("the name is free");
            }
        }
    }
}

fn not_a_mesh(name: &str, kind: &str) -> String {
    format!("Separate takes meshes apart, but \"{name}\" is {kind}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use mesh::{Attribute, DVec3, FaceId, Rule};
    use op::{Files, Range};
    use scene::Material;

    /// A cube and a tetrahedron beside it, and a vertex without a face.
    fn two() -> Mesh {
        let (cube, other) = (shapes::cube(), shapes::tetrahedron());
        let mut positions = cube.positions().to_vec();
        positions.extend(other.positions().iter().map(|&p| p + 5.0));
        positions.push(DVec3::splat(9.0));
        let corners = |mesh: &Mesh, first: usize| -> Vec<Vec<u32>> {
            let number = |v: mesh::VertexId| u32::try_from(v.index() + first).unwrap();
            mesh.faces()
                .map(|f| mesh.face_vertices(f).map(number).collect())
                .collect()
        };
        let polygons = [corners(&cube, 0), corners(&other, 8)].concat();
        Mesh::from_polygons(positions, &polygons).unwrap().0
    }

    fn scene() -> Scene {
        let mut scene = Scene::new();
        let mut pair = Object::mesh("pair", two());
        pair.materials.push(Material::new("skin"));
        scene.insert(pair).unwrap();
        scene
            .insert(Object::mesh("other", shapes::square()))
            .unwrap();
        scene
    }

    fn step(text: &str) -> Separate {
        op::test::read(text).unwrap()
    }

    fn names(scene: &Scene) -> Vec<&str> {
        scene.objects().iter().map(|o| o.name.as_str()).collect()
    }

    fn planned(step: &Separate, scene: &Scene) -> (Plan, Vec<Problem>) {
        let files = Files::default();
        let cx = PlanContext {
            files: &files,
            on: None,
            budget: u64::MAX,
        };
        let mut plan = Plan::default();
        for object in scene.objects() {
            let mesh = MeshPlan::of(object.as_mesh().unwrap());
            plan.insert(&object.name, PlannedGeometry::Mesh(mesh));
        }
        let problems = step.plan(&mut plan, &cx);
        (plan, problems)
    }

    #[test]
    fn components_become_objects_with_all_materials() {
        let mut scene = scene();
        let report = op::test::run(&step(r#"(object: "pair")"#), &mut scene).unwrap();
        assert_eq!(names(&scene), ["pair 1", "other", "pair 2"]);
        for (name, volume) in [
            ("pair 1", geometry::volume(&shapes::cube())),
            ("pair 2", geometry::volume(&shapes::tetrahedron())),
        ] {
            let part = scene.object(name).unwrap();
            assert!((geometry::volume(part.as_mesh().unwrap()) - volume).abs() < 1e-12);
            assert_eq!(part.materials, [Material::new("skin")]);
        }
        assert_eq!(report.changed, 2);
        assert_eq!(report.notes, ["vertices without a face, left out: 1"]);
    }

    #[test]
    fn faces_of_a_material_or_a_tag_become_objects() {
        let mut mesh = shapes::cube();
        mesh.set(MATERIAL, vec![-1, 4, 4, 1, 1, 1]);
        let tag = Attribute::<FaceId, bool>::new("lid", Rule::Copy);
        mesh.set(tag, vec![false, true, false, false, false, false]);
        for (by, expected) in [("Material", vec![3, 2, 1]), (r#"Tag("lid")"#, vec![1, 5])] {
            let mut scene = Scene::new();
            scene.insert(Object::mesh("cube", mesh.clone())).unwrap();
            let step = step(&format!(r#"(object: "cube", by: {by})"#));
            op::test::run(&step, &mut scene).unwrap();
            let counts = scene
                .objects()
                .iter()
                .map(|o| o.as_mesh().unwrap().n_faces());
            assert_eq!(counts.collect::<Vec<_>>(), expected);
        }
    }

    #[test]
    fn a_given_number_of_parts_is_checked_and_planned() {
        let mut scene = scene();
        let three = step(r#"(object: "pair", count: 3)"#);
        let refused = op::test::run(&three, &mut scene);
        let reason = Refusal::Expectation;
        assert!(
            matches!(refused, Err(OpError::Refused { reason: r, .. }) if r == reason),
            "{refused:?}"
        );
        let (plan, problems) = planned(&step(r#"(object: "pair", count: 2)"#), &scene);
        assert_eq!((problems, plan.incomplete), (vec![], false));
        let planned: Vec<_> = plan.objects().iter().map(|o| o.name.as_str()).collect();
        assert_eq!(planned, ["pair 1", "other", "pair 2"]);
        let PlannedGeometry::Mesh(part) = &plan.objects()[2].geometry else {
            panic!("a part is a mesh");
        };
        assert_eq!(part.faces, Range::at_most(10));
    }

    #[test]
    fn without_a_number_later_steps_are_not_checked() {
        let (plan, problems) = planned(&step(r#"(object: "pair")"#), &scene());
        assert_eq!((problems, plan.incomplete), (vec![], true));
        assert!(plan.object("pair").is_none());
    }

    #[test]
    fn taken_names_and_missing_objects_are_refused() {
        let mut scene = scene();
        scene
            .insert(Object::mesh("pair 2", shapes::cube()))
            .unwrap();
        let before = scene.clone();
        for text in [r#"(object: "pair", count: 2)"#, r#"(object: "pear")"#] {
            let (_, problems) = planned(&step(text), &scene);
            assert_eq!(problems[0].path, ["object"]);
            let refused = op::test::run(&step(text), &mut scene);
            assert!(matches!(refused, Err(OpError::Object(_))), "{refused:?}");
            assert_eq!(scene, before);
        }
    }

    #[test]
    fn nothing_and_unknown_tags_are_refused() {
        let mut empty = Scene::new();
        empty.insert(Object::mesh("pair", Mesh::default())).unwrap();
        let refused = op::test::run(&step(r#"(object: "pair")"#), &mut empty);
        assert!(matches!(refused, Err(OpError::Refused { .. })));
        assert_eq!(planned(&step(r#"(object: "pair")"#), &empty).1.len(), 1);
        let tag = step(r#"(object: "pair", by: Tag("lid"))"#);
        let refused = op::test::run(&tag, &mut scene());
        assert!(matches!(refused, Err(OpError::Refused { .. })));
    }
}
