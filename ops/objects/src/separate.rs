//! Separate: splits a mesh into several objects.
//!
//! ```text
//!    "figure"            "figure 1"   "figure 2"
//!       o                    o
//!       |       --->                      |         each component (or the faces of each material,
//!      / \                               / \        or with a tag) becomes an object
//! ```

use std::sync::Arc;

use mesh::{Domain, MATERIAL};
use op::prelude::*;
use op::{Loss, Operation, PlannedObject, Refusal, check_name, named_object};
use scene::{Geometry, Graph, Object};

/// Splits a mesh into several objects.
///
/// The parts of an object "figure" get the names "figure 1", "figure 2" and so on. In the list of objects, the first
/// part replaces the original object, and the other parts come last. Elements keep their order and their values. Every
/// part keeps the whole list of materials. Vertices without a face are dropped. The report counts them. The step fails
/// if the mesh has no faces.
///
/// Nodes of the scene (as in glTF) that placed the original object now place the first part. Each of these nodes gets
/// child nodes that place the other parts at the same location.
///
/// If several parts come from one connected component, each of these parts gets its own copies of the edges and
/// vertices between the parts. Within a part, the faces around a vertex can form several fans that share no edge at
/// this vertex. Each fan then gets a separate copy of the vertex.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Separate {
    /// The name of the mesh.
    pub object: String,
    /// How the faces are grouped into parts.
    #[serde(default)]
    pub by: SeparateBy,
    /// The expected number of parts. The step fails if the number of parts is not `count`. If omitted, the number and
    /// names of the parts are known only during the run. Later steps that refer to objects by name can then not be
    /// checked before the run.
    #[serde(default)]
    pub count: Option<Count<1>>,
}

/// How faces are grouped into parts. Each part becomes an object.
#[derive(Clone, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum SeparateBy {
    /// One part for each connected component, in order of the lowest face id in each component.
    #[default]
    Components,
    /// One part for each material that at least one face has, in order of the materials. Faces without a material form
    /// the last part.
    Material,
    /// Two parts: the first part has the faces with the tag of this name, and the second part has all other faces. A
    /// part without faces is left out.
    Tag(String),
}

impl Operation for Separate {
    const NAME: &'static str = "Separate";
    const SUMMARY: &'static str = "Split a mesh into several objects";
    const EXAMPLE: &'static str = r#"Separate(object: "mesh")"#;
    const WORDS: &'static [&'static str] = &["split", "components", "parts"];

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
            // Without `count`, the number and the names of the parts are unknown before the run.
            plan.objects_mut().remove(place);
            plan.edit_graph(|graph| graph.rename_object(&self.object, &self.name(1)));
            plan.incomplete = true;
            return Vec::new();
        };
        if u64::from(count) > mesh.faces.max {
            let message = format!(
                "the mesh \"{}\" has at most {} faces, which is not enough for {count} parts",
                self.object, mesh.faces.max
            );
            return vec![Problem::error(message).at(["count"])];
        }
        let names: Vec<String> = (1..=count).map(|i| self.name(i)).collect();
        if let Some(taken) = names.iter().find_map(|name| plan.taken(name, "object")) {
            return vec![taken];
        }
        let unplaced_nodes = plan.objects()[place].unplaced_nodes;
        let mut objects = names.iter().map(|name| PlannedObject {
            name: name.clone(),
            geometry: PlannedGeometry::Mesh(part.clone()),
            unplaced_nodes,
        });
        plan.objects_mut()[place] = objects.next().expect("at least one part");
        plan.objects_mut().extend(objects);
        plan.edit_graph(|graph| {
            graph.rename_object(&self.object, &names[0]);
            show_parts(graph, &names);
        });
        Vec::new()
    }

    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError> {
        let object = named_object(scene, &self.object)?;
        let wrong_kind = || OpError::Object(not_a_mesh(&self.object, object.geometry.kind()));
        let mesh = Arc::clone(object.as_mesh().ok_or_else(wrong_kind)?);
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
        Ok(report.count("vertices without a face, dropped", isolated))
    }
}

impl SeparateBy {
    /// Returns the meshes of the parts. Each mesh has at least one face.
    fn parts(&self, mesh: &Mesh) -> Result<Vec<Mesh>, OpError> {
        let part_of_face: Vec<usize> = match self {
            Self::Components => return Ok(geometry::separated(mesh)),
            Self::Material => {
                let of_face = mesh.get(MATERIAL).unwrap_or_default();
                let material = |f: usize| of_face.get(f).copied().unwrap_or(-1);
                // Faces without a material form the last part.
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
    /// Returns the name of part `i`, counted from 1.
    fn name(&self, i: u32) -> String {
        format!("{} {i}", self.object)
    }

    fn no_faces(&self) -> String {
        format!("\"{}\" has no faces to separate", self.object)
    }

    /// Returns a plan that is valid for every part. The counts in the plan are upper limits.
    fn part_of(&self, whole: &MeshPlan) -> MeshPlan {
        let mut part = whole.clone();
        // If several fans of faces meet at a vertex, each fan gets its own copy of the vertex. Each fan has at least
        // two of the edges at the vertex, so the number of copies is at most the number of edges.
        part.vertices = whole.vertices.plus(whole.edges).or_less();
        part.edges = whole.edges.or_less();
        part.faces = whole.faces.or_less();
        if self.by == SeparateBy::Components {
            part.vertices = whole.vertices.or_less();
        }
        part
    }

    /// Returns a loss for each attribute of `whole` that at least one part does not have.
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

    /// Replaces the object with the parts. The name of a part must not be the name of another object.
    fn replace(&self, scene: &mut Scene, names: &[String], parts: Vec<Mesh>) {
        let (_, materials) = scene.parts_mut(&self.object).expect("it was found");
        let materials = materials.clone();
        let mut objects = names.iter().zip(parts).map(|(name, part)| Object {
            name: name.clone(),
            geometry: Geometry::Mesh(Arc::new(part)),
            materials: materials.clone(),
        });
        let first = objects.next().expect("at least one part");
        *scene.parts_mut(&self.object).expect("it was found").0 = first.geometry;
        let is_free = "the names are free";
        scene.rename(&self.object, &first.name).expect(is_free);
        let objects = objects.collect();
        scene.append(objects, Graph::default()).expect(is_free);
        if !scene.graph().is_empty() {
            show_parts(scene.graph_mut(), names);
        }
    }
}

/// The first part keeps the nodes of the separated object. Adds nodes for all other parts.
fn show_parts(graph: &mut Graph, names: &[String]) {
    for name in &names[1..] {
        graph.add_part(&names[0], name);
    }
}

fn not_a_mesh(name: &str, kind: &str) -> String {
    format!("Separate splits meshes, but the type of \"{name}\" is {kind}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use mesh::{Attribute, DVec3, FaceId, Rule};
    use op::{Files, Range};
    use scene::Material;

    /// Returns a mesh of a cube, a tetrahedron and an isolated vertex.
    fn cube_and_tetrahedron() -> Mesh {
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
        let mut pair = Object::mesh("pair", cube_and_tetrahedron());
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
        let cx = PlanContext::new(&files);
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
        assert_eq!(report.notes, ["vertices without a face, dropped: 1"]);
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
    fn the_expected_number_of_parts_is_checked_and_planned() {
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
    fn without_a_count_the_plan_is_incomplete() {
        let (plan, problems) = planned(&step(r#"(object: "pair")"#), &scene());
        assert_eq!((problems, plan.incomplete), (vec![], true));
        assert!(plan.object("pair").is_none());
    }

    #[test]
    fn taken_names_and_missing_objects_are_errors() {
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
    fn empty_meshes_and_unknown_tags_are_refused() {
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
