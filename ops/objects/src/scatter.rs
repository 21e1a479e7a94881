//! Scatter: places copies of an object on a surface.
//!
//! ```text
//!                                  A      A    A
//!     "tree"  A    "ground" ___    -->   __A____A___A__
//! ```

use geometry::{Sample, samples};
use glam::{DAffine3, DQuat, DVec3};
use mesh::VERTEX_NORMAL;
use op::prelude::*;
use op::{Axis, Operation, Refusal, check_name, named_object};
use scene::{Geometry, Node, Object, Placement, transformed};

/// Places copies of an object on a surface, at random positions that are evenly spread.
///
/// Exactly `count` points are chosen so that no two of them are close together (Yuksel, "Sample Elimination for
/// Generating Poisson Disk Sample Sets", 2015). Each copy is an instance: a node that references the object. Copies
/// therefore need almost no memory, and almost no space in `.gltf`, `.glb` and `.mws` files. The node of each copy
/// moves the origin of the object to one of the points. To make one mesh of all copies, use `Join` in a later step. If
/// no node placed the object before the step, the object disappears from its original position and is visible only at
/// the points.
///
/// Without `object`, the result is a mesh whose vertices are the chosen points. The mesh has no faces. Its vertex
/// normals are the normals of the surface at the points.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Scatter {
    /// The name of the object that is copied. If omitted, the step creates a mesh of points instead of copies.
    #[serde(default)]
    pub object: Option<String>,
    /// The name of the object on whose surface the points lie. This object must be a mesh that appears only once in the
    /// scene (a single instance).
    pub surface: String,
    /// The number of points.
    pub count: Count<1, 1_000_000>,
    /// The seed of the random numbers. Two steps with the same seed, surface and count choose the same points. A
    /// different seed gives different points.
    #[serde(default)]
    pub seed: u64,
    /// The axis of the object that is aligned with the normal of the surface. If omitted, the copies are not rotated.
    #[serde(default)]
    pub align: Option<Axis>,
    /// Without `object`, the name of the mesh of points. Defaults to `points`.
    #[serde(default = "points")]
    pub name: String,
}

fn points() -> String {
    "points".to_owned()
}

impl Operation for Scatter {
    const NAME: &'static str = "Scatter";
    const SUMMARY: &'static str = "Place copies of an object on a surface";
    const EXAMPLE: &'static str = r#"Scatter(surface: "mesh", count: 20, seed: 7)"#;
    const WORDS: &'static [&'static str] =
        &["instance", "distribute", "poisson", "sample", "points"];

    fn plan(&self, plan: &mut Plan, _: &PlanContext) -> Vec<Problem> {
        let Some(surface) = plan.object(&self.surface) else {
            return Vec::from_iter(plan.missing(&self.surface, ["surface"]));
        };
        if !matches!(surface.geometry, PlannedGeometry::Mesh(_)) {
            let message = not_a_mesh(&self.surface, surface.geometry.kind());
            return vec![Problem::error(message).at(["surface"])];
        }
        let n = u64::from(self.count.get());
        let Some(name) = &self.object else {
            let mut points = MeshPlan::counted(n, 0, 0, Range::exactly(0));
            points.provide(mesh::Domain::Vertex, VERTEX_NORMAL.name);
            let taken = plan.insert(&self.name, PlannedGeometry::Mesh(points));
            return Vec::from_iter(taken.map(|problem| problem.at(["name"])));
        };
        if plan.object(name).is_none() {
            return Vec::from_iter(plan.missing(name, ["object"]));
        }
        if *name == self.surface {
            return vec![Problem::error(SAME).at(["object"])];
        }
        let object = plan.objects_mut().iter_mut().find(|o| o.name == *name);
        if let Some(object) = object {
            // If no node places the object, the scene shows the object once. The step removes this single instance, so
            // it is not counted.
            object.unplaced_nodes = object.unplaced_nodes.saturating_add(n);
        }
        Vec::new()
    }

    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError> {
        let surface = named_object(scene, &self.surface)?;
        let mesh = surface
            .as_mesh()
            .ok_or_else(|| OpError::Object(not_a_mesh(&self.surface, surface.geometry.kind())))?;
        if let Some(name) = &self.object {
            named_object(scene, name)?;
            if *name == self.surface {
                return Err(OpError::Parameter(SAME.to_owned()));
            }
        } else {
            check_name(scene, &self.name)?;
        }
        cx.advance("scatter", 0, 1)?;
        let instances = scene.instances().into_iter();
        let places: Vec<DAffine3> = instances
            .filter(|instance| instance.object.name == self.surface)
            .map(|instance| instance.to_scene)
            .collect();
        let [place] = places[..] else {
            let (name, n) = (&self.surface, places.len());
            let message = format!(
                "expected a surface with one instance, but \"{name}\" has {n} instances; `Join` makes one object of \
                 them"
            );
            return Err(OpError::Object(message));
        };
        let count = self.count.get() as usize;
        let points = if place == DAffine3::IDENTITY {
            samples(mesh, count, self.seed, cx.progress())
        } else {
            samples(&transformed(mesh, &place), count, self.seed, cx.progress())
        };
        let points = points.map_err(|_| OpError::Cancelled)?;
        if points.is_empty() {
            let message = format!("the surface of \"{}\" has no area", self.surface);
            return Err(OpError::refused(Refusal::Missing, message));
        }
        match &self.object {
            None => {
                let positions = points.iter().map(|p| p.position).collect();
                let (mut mesh, _) = Mesh::from_polygons(positions, &[[0_u32; 3]; 0])?;
                mesh.set(VERTEX_NORMAL, points.iter().map(|p| p.normal).collect());
                let object = Object::new(&self.name, Geometry::Mesh(mesh.into()));
                scene.insert(object).expect("the name is free");
            }
            Some(name) => {
                for (i, point) in points.iter().enumerate() {
                    scene.graph_mut().push(Node {
                        name: Some(format!("{name}.{}", i + 1)),
                        placement: self.placement(point),
                        object: Some(name.clone()),
                        ..Node::default()
                    });
                }
            }
        }
        Ok(Report::changed(points.len()))
    }
}

const SAME: &str = "`object` and `surface` must be different objects";

fn not_a_mesh(name: &str, kind: &str) -> String {
    format!("expected object \"{name}\" to be a mesh, found {kind}")
}

impl Scatter {
    fn placement(&self, point: &Sample) -> Placement {
        let axis = self.align.map(|axis| match axis {
            Axis::X => DVec3::X,
            Axis::Y => DVec3::Y,
            Axis::Z => DVec3::Z,
        });
        let rotation = axis.map_or(DQuat::IDENTITY, |axis| half_way(axis, point.normal));
        Placement::Parts {
            translation: point.position.to_array(),
            rotation: rotation.to_array(),
            scale: [1.0; 3],
        }
    }
}

/// Returns the shortest rotation from one unit vector to another. Uses no trigonometric functions, because their
/// results differ between platforms.
fn half_way(from: DVec3, to: DVec3) -> DQuat {
    let w = 1.0 + from.dot(to);
    if w < 1e-12 {
        let axis = from.any_orthonormal_vector();
        return DQuat::from_xyzw(axis.x, axis.y, axis.z, 0.0);
    }
    let v = from.cross(to);
    let length = (v.length_squared() + w * w).sqrt();
    let v = v / length;
    DQuat::from_xyzw(v.x, v.y, v.z, w / length)
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;

    fn scene() -> Scene {
        let mut scene = Scene::new();
        for (name, mesh) in [("ground", shapes::cube()), ("tree", shapes::tetrahedron())] {
            scene.insert(Object::mesh(name, mesh)).unwrap();
        }
        scene
    }

    fn run(text: &str, scene: &mut Scene) -> Result<Report, OpError> {
        let step: Scatter = op::test::read(text).unwrap();
        op::test::run(&step, scene)
    }

    #[test]
    fn copies_are_instances_at_the_points() {
        let mut scene = scene();
        let text = r#"(object: "tree", surface: "ground", count: 50, align: Z)"#;
        assert_eq!(run(text, &mut scene).unwrap().changed, 50);
        let placed: Vec<DAffine3> = (scene.instances().iter())
            .filter(|instance| instance.object.name == "tree")
            .map(|instance| instance.to_scene)
            .collect();
        assert_eq!(placed.len(), 50);
        for map in placed {
            let up = map.matrix3 * DVec3::Z;
            assert!((map.translation.dot(up) - 1.0).abs() < 1e-12, "{map}");
        }
    }

    #[test]
    fn the_plan_counts_copies_and_earlier_nodes() {
        let files = op::Files::default();
        let cx = PlanContext::new(&files);
        for n_nodes in 0..3 {
            let mut scene = scene();
            for _ in 0..n_nodes {
                scene.graph_mut().push(Node {
                    object: Some("tree".to_owned()),
                    ..Node::default()
                });
            }
            let mut plan = Plan::of(&scene);
            let text = r#"(object: "tree", surface: "ground", count: 4)"#;
            let step: Scatter = op::test::read(text).unwrap();
            assert_eq!(step.plan(&mut plan, &cx), []);
            op::test::run(&step, &mut scene).unwrap();
            assert_eq!(plan.instances("tree"), Plan::of(&scene).instances("tree"));

            let text = r#"(objects: ["tree"], name: "tree")"#;
            let join: crate::Join = op::test::read(text).unwrap();
            assert_eq!(join.plan(&mut plan, &cx), []);
            op::test::run(&join, &mut scene).unwrap();
            assert_eq!(plan.instances("tree"), 1);
            let PlannedGeometry::Mesh(planned) = &plan.object("tree").unwrap().geometry else {
                panic!("a mesh");
            };
            assert_eq!(planned.faces, Range::exactly(4 * (4 + n_nodes)));
            let joined = scene.object("tree").unwrap().as_mesh().unwrap();
            assert_eq!(planned.faces, Range::exactly(joined.n_faces() as u64));
        }
    }

    #[test]
    fn points_alone_are_a_mesh() {
        let mut scene = scene();
        run(r#"(surface: "ground", count: 9)"#, &mut scene).unwrap();
        let points = scene.object("points").unwrap().as_mesh().unwrap();
        assert_eq!(op::test::counts(points), [9, 0, 0]);
        assert_eq!(points.get(VERTEX_NORMAL).unwrap().len(), 9);
        let again = run(r#"(surface: "ground", count: 9)"#, &mut scene);
        assert!(again.is_err());
    }

    #[test]
    fn surfaces_without_area_or_shown_several_times_are_refused() {
        let mut scene = scene();
        let empty = Object::mesh("empty", Mesh::default());
        scene.insert(empty).unwrap();
        run(
            r#"(object: "tree", surface: "ground", count: 2)"#,
            &mut scene,
        )
        .unwrap();
        for (text, words) in [
            (r#"(surface: "tree", count: 2)"#, "has 2 instances"),
            (r#"(surface: "empty", count: 2)"#, "no area"),
            (r#"(surface: "none", count: 2)"#, "none"),
            (
                r#"(object: "tree", surface: "tree", count: 2)"#,
                "different objects",
            ),
        ] {
            let refused = run(text, &mut scene).unwrap_err().to_string();
            assert!(refused.contains(words), "{refused}");
        }
    }
}
