//! Project: moves vertices onto the surface of another object.
//!
//! ```text
//!    .---.---.---.                                       the object
//!                         -->    .---.
//!       .-----.                .'     '.                 the object named by `onto`
//!    --'       '--         .--'         '--.
//! ```

use geometry::deform::vertex_directions;
use geometry::surface_index::{RayHit, SurfaceIndex};
use mesh::DVec3;
use op::prelude::*;

use crate::moved::moved;

/// Moves vertices onto the surface of another object (shrinkwrap).
///
/// A vertex moves only if it is in `vertices` and not in `pin`. All other vertices keep their exact positions. If the
/// step does not name objects with `on`, it acts on all meshes except the object that `onto` names. Normals and
/// tangents are dropped. Faces, element ids and other attributes do not change, so textures stretch with the surface.
///
/// Vertices that would move farther than `distance` do not move. With `along: Normal`, a vertex moves along the line of
/// its normal. With `along: Direction(..)`, a vertex moves along a ray in this direction. If the line or ray of a
/// vertex misses the surface, the vertex does not move. The report counts the vertices that would move too far, and the
/// vertices whose line or ray misses the surface.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Project {
    /// The name of the object onto whose surface the vertices move.
    pub onto: String,
    /// How the step finds the point of the surface to which a vertex moves.
    #[serde(default)]
    pub along: ProjectAlong,
    /// The vertices to move. If omitted, all vertices.
    #[serde(default)]
    pub vertices: VertexSelection,
    /// Vertices that do not move. If omitted, no vertices.
    #[serde(default)]
    pub pin: Option<VertexSelection>,
    /// The largest distance that a vertex is allowed to move, in scene units. If omitted, there is no limit.
    #[serde(default)]
    pub distance: Option<PositiveLength>,
}

/// How the step finds the point of the surface to which a vertex moves.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum ProjectAlong {
    /// Moves to the nearest point of the surface.
    #[default]
    Nearest,
    /// Moves to the nearest point at which the surface meets the line through the vertex along its normal. The point
    /// can lie on either side of the vertex. The normal of a vertex is the area-weighted mean of its face normals.
    Normal,
    /// Moves to the first point of the surface in this direction.
    Direction(Direction),
}

impl MeshOperation for Project {
    const NAME: &'static str = "Project";
    const SUMMARY: &'static str = "Move vertices onto the surface of another object";
    const EXAMPLE: &'static str = r#"Project(onto: "scan", distance: 0.1)"#;
    const WORDS: &'static [&'static str] = &["shrinkwrap", "snap", "wrap", "conform", "retopology"];

    fn reads(&self) -> Vec<(&str, &'static str)> {
        vec![(&self.onto, "onto")]
    }

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        plan.drop_normals();
        Vec::new()
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        let surface = cx.other_mesh(Self::NAME, &self.onto)?;
        let mut mask = self.vertices.mask(mesh, cx)?;
        if let Some(pin) = &self.pin {
            let pinned = pin.mask(mesh, cx)?;
            mask.iter_mut().zip(pinned).for_each(|(m, pin)| *m &= !pin);
        }
        cx.advance("project", 0, 1)?;
        let Some(index) = SurfaceIndex::with_progress(&surface, cx.progress())? else {
            return Err(OpError::Object(format!("\"{}\" has no faces", self.onto)));
        };
        let normals = match self.along {
            ProjectAlong::Normal => vertex_directions(mesh),
            _ => Vec::new(),
        };
        let chosen: Vec<usize> = (0..mask.len()).filter(|&v| mask[v]).collect();
        let points: Vec<DVec3> = chosen.iter().map(|&v| mesh.positions()[v]).collect();
        let hits = |direction: &dyn Fn(usize) -> DVec3| {
            let rays = chosen.iter().zip(&points).map(|(&v, &p)| [p, direction(v)]);
            index.first_hits(&rays.collect::<Vec<_>>(), cx.progress())
        };
        let on_surface = |hit: Option<RayHit>| hit.map(|hit| hit.point);
        let targets: Vec<Option<DVec3>> = match self.along {
            ProjectAlong::Nearest => {
                let nearest = index.nearest_to_points(&points, cx.progress())?;
                let found = nearest.into_iter().map(|nearest| nearest.point);
                found.map(|p| p.is_finite().then_some(p)).collect()
            }
            ProjectAlong::Normal => {
                let sides = hits(&|v| normals[v])?
                    .into_iter()
                    .zip(hits(&|v| -normals[v])?);
                let nearer = |(front, back): (Option<RayHit>, Option<RayHit>)| match (front, back) {
                    (Some(front), Some(back)) if back.t < front.t => Some(back),
                    (front, back) => front.or(back),
                };
                sides.map(|sides| on_surface(nearer(sides))).collect()
            }
            ProjectAlong::Direction(direction) => {
                let direction = direction.get();
                hits(&|_| direction)?.into_iter().map(on_surface).collect()
            }
        };
        let mut new = mesh.positions().to_vec();
        let (mut missed, mut far) = (0, 0);
        for ((v, p), target) in chosen.into_iter().zip(points).zip(targets) {
            match target {
                None => missed += 1,
                Some(q) if self.distance.is_some_and(|d| q.distance(p) > d.get()) => far += 1,
                Some(q) => new[v] = q,
            }
        }
        let report = moved(mesh, &mask, Self::NAME, "onto", |v, _| new[v.index()])?;
        let report = report.count(
            "vertices not moved, because their projection line misses the surface",
            missed,
        );
        Ok(report.count(
            "vertices not moved, because they would move farther than `distance`",
            far,
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use mesh::VERTEX_NORMAL;
    use scene::Object;

    fn step(text: &str) -> Project {
        op::test::read(text).unwrap()
    }

    /// Returns a scene with a sphere of radius 1 and a cube around it. A new vertex above the center of each side of
    /// the cube divides the side into triangles. The distance of each new vertex from the center of the cube is 2.
    fn scene() -> Scene {
        let mut cube = subdivided_cube();
        cube.set(VERTEX_NORMAL, vec![DVec3::Z; cube.n_vertices()]);
        let mut scene = Scene::new();
        scene.insert(Object::mesh("cube", cube)).unwrap();
        scene
            .insert(Object::mesh("ball", shapes::uv_sphere(48, 24)))
            .unwrap();
        scene
    }

    fn subdivided_cube() -> Mesh {
        let mut cube = shapes::cube();
        let faces: Vec<_> = cube.faces().collect();
        for f in faces {
            let center = 2.0 * cube.face_center(f);
            cube.poke_face_at(f, center).unwrap();
        }
        cube
    }

    fn positions(scene: &Scene, name: &str) -> Vec<DVec3> {
        scene
            .object(name)
            .unwrap()
            .as_mesh()
            .unwrap()
            .positions()
            .to_vec()
    }

    #[test]
    fn vertices_move_to_the_nearest_points() {
        let mut scene = scene();
        let before = positions(&scene, "cube");
        let ball = positions(&scene, "ball");
        let report =
            op::test::run(&step(r#"(onto: "ball", pin: Vertices([3]))"#), &mut scene).unwrap();
        assert_eq!(report.changed, 13);
        assert_eq!(positions(&scene, "ball"), ball);
        let sphere = scene.object("ball").unwrap().as_mesh().unwrap().clone();
        let index = SurfaceIndex::new(&sphere).unwrap();
        for (v, (p, q)) in before.iter().zip(positions(&scene, "cube")).enumerate() {
            if v == 3 {
                assert_eq!(*p, q);
            } else {
                assert_eq!(q, index.nearest(*p, 0).point);
                assert!(q.distance(p.normalize()) < 0.1);
            }
        }
        let mesh = scene.object("cube").unwrap().as_mesh().unwrap();
        assert!(mesh.get(VERTEX_NORMAL).is_none());
    }

    #[test]
    fn vertices_beyond_the_distance_stay_and_are_counted() {
        let mut scene = scene();
        let before = positions(&scene, "cube");
        // The 8 corners of the cube are at the distance √3 - 1 from the unit sphere. The vertices above the centers of
        // the sides are at the distance 1.
        let report = op::test::run(&step(r#"(onto: "ball", distance: 0.8)"#), &mut scene).unwrap();
        assert_eq!(report.changed, 8);
        assert_eq!(
            report.notes,
            ["vertices not moved, because they would move farther than `distance`: 6"]
        );
        assert_eq!(positions(&scene, "cube")[8..], before[8..]);
    }

    #[test]
    fn directions_and_normals_lead_to_the_first_point_and_misses_stay() {
        let mut scene = scene();
        let before = positions(&scene, "cube");
        let down = step(r#"(onto: "ball", along: Direction((0, 0, -1)))"#);
        let report = op::test::run(&down, &mut scene).unwrap();
        assert_eq!(
            report.notes,
            ["vertices not moved, because their projection line misses the surface: 13"]
        );
        let top = before
            .iter()
            .position(|p| *p == DVec3::new(0.0, 0.0, 2.0))
            .unwrap();
        assert!(positions(&scene, "cube")[top].distance(DVec3::Z) < 1e-12);

        let mut scene = self::scene();
        let report = op::test::run(&step(r#"(onto: "ball", along: Normal)"#), &mut scene).unwrap();
        assert_eq!(report.changed, 14);
        for (p, q) in before.iter().zip(positions(&scene, "cube")) {
            assert!(q.distance(p.normalize()) < 0.02, "{p} {q}");
        }
    }

    #[test]
    fn the_other_object_must_be_a_mesh_and_not_a_target() {
        for (text, on) in [
            (r#"(onto: "sphere")"#, None),
            (r#"(onto: "ball")"#, Some("ball")),
        ] {
            let mut scene = scene();
            let files = op::Files::default();
            let on: Option<Vec<String>> = on.map(|name| vec![name.to_owned()]);
            let mut plan = Plan::default();
            for object in scene.objects() {
                let planned = PlannedGeometry::Mesh(MeshPlan::of(object.as_mesh().unwrap()));
                assert_eq!(plan.insert(&object.name, planned), None);
            }
            let cx = PlanContext {
                files: &files,
                on: on.as_deref(),
                budget: u64::MAX,
            };
            assert_eq!(
                op::Operation::plan(&step(text), &mut plan, &cx).len(),
                1,
                "{text}"
            );
            let mut cx = Context::new(&op::NoProgress, &files);
            cx.on = on.as_deref();
            let before = scene.clone();
            let error = op::Operation::apply(&step(text), &mut scene, &mut cx).unwrap_err();
            assert!(matches!(error, OpError::Object(_)), "{error}");
            assert_eq!(scene, before);
        }
    }
}
