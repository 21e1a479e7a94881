//! A mesh written in a recipe: its points and its faces.
//!
//! ```text
//!    3 ------- 2
//!    |       / |       points: [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)],
//!    |     /   |       faces: [[0, 1, 2], [0, 2, 3]]
//!    |   /     |
//!    0 ------- 1
//! ```

use mesh::{BuildReport, DVec3};
use op::Operation;
use op::prelude::*;

/// Makes a mesh of points and faces.
///
/// Point i becomes vertex i and polygon i becomes face i. Faces that run the other way round than most
/// of those they hang together with are reversed, where that makes all of them agree. Faces that do not
/// form a manifold are split until they do: an edge keeps two faces that run opposite ways along it, a
/// vertex keeps one fan of faces, and copies of the vertices, behind all others, take the rest. The
/// report names what was reversed and split, and so does the check of the recipe.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Polygons {
    /// The name of the new object.
    pub name: String,
    /// The points: `(x, y, z)`, in scene units. Those without a face stay as isolated vertices.
    pub points: Vec<Vector>,
    /// The faces: for each the numbers of its points, from 0, counter-clockwise seen from outside. At
    /// least three, none of them twice.
    pub faces: Vec<Vec<u32>>,
}

impl Polygons {
    /// The mesh and what was done to make it a manifold, or the first problem.
    fn build(&self) -> Result<(Mesh, BuildReport), Problem> {
        let points: Vec<DVec3> = self.points.iter().map(|&p| p.into()).collect();
        for (f, face) in self.faces.iter().enumerate() {
            self.check(f, face)?;
        }
        Mesh::from_polygons(points, &self.faces).map_err(|e| Problem::error(e.to_string()))
    }

    fn check(&self, f: usize, face: &[u32]) -> Result<(), Problem> {
        let at_face = f.to_string();
        if face.len() < 3 {
            let message = format!("face {f} needs at least 3 points, but has {}", face.len());
            return Err(Problem::error(message).at(["faces", &at_face]));
        }
        // In order of points, equal ones in order of places.
        let mut places: Vec<usize> = (0..face.len()).collect();
        places.sort_by_key(|&i| face[i]);
        let n = self.points.len();
        let missing = (0..face.len()).find(|&i| face[i] as usize >= n);
        let twice = places.windows(2).filter(|w| face[w[0]] == face[w[1]]);
        let twice = twice.map(|w| w[1]).min();
        let (i, what) = match (missing, twice) {
            (Some(i), _) => (i, format!("which is not there: there are {n} points")),
            (None, Some(i)) => (i, "which it has already".to_owned()),
            (None, None) => return Ok(()),
        };
        let message = format!("face {f} has point {} at place {i}, {what}", face[i]);
        Err(Problem::error(message).at(["faces", &at_face, &i.to_string()]))
    }

    /// The source, the mesh, and what was done to make it a manifold.
    fn source(&self) -> (Source<'_>, Mesh, BuildReport) {
        match self.build() {
            Ok((mesh, done)) => {
                let source = Source::new(&self.name, MeshPlan::of(&mesh));
                (source, mesh, done)
            }
            Err(problem) => {
                let source = Source::new(&self.name, MeshPlan::unknown()).with(problem);
                (source, Mesh::default(), BuildReport::default())
            }
        }
    }
}

impl Operation for Polygons {
    const NAME: &'static str = "Polygons";
    const SUMMARY: &'static str = "Make a mesh of points and faces";
    const EXAMPLE: &'static str =
        r#"Polygons(name: "new", points: [(0, 0, 0), (1, 0, 0), (0, 1, 0)], faces: [[0, 1, 2]])"#;

    fn plan(&self, plan: &mut Plan, _: &PlanContext) -> Vec<Problem> {
        let (mut source, _, done) = self.source();
        if !done.is_clean() {
            let summary = done.summary();
            let message = format!("the faces are no manifold as they stand: {summary}");
            source = source.with(Problem::warning(message).at(["faces"]));
        }
        source.plan(plan)
    }

    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError> {
        cx.advance("build", 0, 1)?;
        let (source, mesh, done) = self.source();
        let report = source.insert(scene, cx, || mesh)?;
        Ok(if done.is_clean() {
            report
        } else {
            report.note(done.summary())
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn step(text: &str) -> Polygons {
        op::test::read(text).unwrap()
    }

    /// The path and the message of the one problem.
    fn problem(text: &str) -> (String, String) {
        let step = step(text);
        assert!(matches!(
            op::test::run(&step, &mut Scene::new()),
            Err(OpError::Parameter(_))
        ));
        let [problem] = &step.source().0.plan(&mut Plan::default())[..] else {
            panic!("one problem");
        };
        (problem.path.join("."), problem.message.clone())
    }

    #[test]
    fn a_recipe_text_becomes_its_mesh() {
        let step = step(
            r#"(name: "kite", points: [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)],
                faces: [[0, 1, 2], [0, 2, 3]])"#,
        );
        let mesh = op::test::made(&step);
        assert_eq!(
            (mesh.n_vertices(), mesh.n_edges(), mesh.n_faces()),
            (4, 5, 2)
        );
        assert_eq!(geometry::area(&mesh), 1.0);
    }

    #[test]
    fn no_points_and_no_faces_are_an_empty_mesh() {
        assert_eq!(
            op::test::made(&step(r#"(name: "a", points: [], faces: [])"#)),
            Mesh::default()
        );
    }

    #[test]
    fn two_fans_at_a_vertex_are_split_with_a_note() {
        let step = step(
            r#"(name: "bow", points: [(0, 0, 0), (1, 0, 0), (1, 1, 0), (-1, 0, 0), (-1, -1, 0)],
                faces: [[0, 1, 2], [0, 3, 4]])"#,
        );
        assert_eq!(op::test::made(&step).n_vertices(), 6);
        let report = op::test::run(&step, &mut Scene::new()).unwrap();
        assert_eq!(report.notes, ["1 copy made of a non-manifold vertex (v0)"]);
        let files = op::Files::default();
        let cx = PlanContext {
            files: &files,
            on: None,
            budget: u64::MAX,
        };
        let problems = step.plan(&mut Plan::default(), &cx);
        assert!(problems.len() == 1 && problems[0].is_warning);
    }

    #[test]
    fn a_face_that_runs_the_other_way_is_reversed_with_a_note() {
        let step = step(
            r#"(name: "kite", points: [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)],
                faces: [[0, 1, 2], [0, 3, 2]])"#,
        );
        assert_eq!(op::test::made(&step).n_edges(), 5);
        let report = op::test::run(&step, &mut Scene::new()).unwrap();
        assert_eq!(
            report.notes,
            ["1 face reversed to agree with its neighbors (face 1)"]
        );
    }

    #[test]
    fn errors_name_the_face_and_the_place() {
        let points = "points: [(0, 0, 0), (1, 0, 0), (0, 1, 0)]";
        let face = |faces: &str| problem(&format!(r#"(name: "a", {points}, faces: {faces})"#));
        let (path, message) = face("[[0, 1, 2], [0, 1, 7]]");
        assert_eq!(path, "faces.1.2");
        assert_eq!(
            message,
            "face 1 has point 7 at place 2, which is not there: there are 3 points"
        );
        let (path, message) = face("[[0, 1, 2, 1]]");
        assert_eq!(path, "faces.0.3");
        assert_eq!(
            message,
            "face 0 has point 1 at place 3, which it has already"
        );
        let (path, message) = face("[[0, 1]]");
        assert_eq!(path, "faces.0");
        assert_eq!(message, "face 0 needs at least 3 points, but has 2");
    }
}
