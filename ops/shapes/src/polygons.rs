//! A mesh whose points and faces are given in the recipe.
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

/// Creates a mesh from points and faces.
///
/// The id of each vertex is the index of its point in `points`, and the id of each face is its index in `faces`. If
/// connected faces have opposite orientations, the faces with the less frequent orientation are reversed. If the
/// orientations of the connected faces cannot be made to agree, as in a Moebius strip, none of these faces is reversed.
/// Two kinds of edges are split: edges with more than two faces, and edges whose two faces still have opposite
/// orientations. At a split edge, pairs of faces with consistent orientations stay connected. Each pair, and each face
/// that is left over, gets its own copy of the edge. A vertex is split if its faces form several fans (groups of faces
/// that are connected by edges at the vertex). One fan keeps the vertex, and each other fan gets a copy of the vertex.
/// The copies of vertices get the highest ids. The report and the command `check` list the reversed and split elements.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Polygons {
    /// The name of the new object. Defaults to the first of the names `polygons`, `polygons.2`, `polygons.3` and so on
    /// that no other object has.
    #[serde(default)]
    pub name: Option<String>,
    /// The points `(x, y, z)`, in scene units. Points that no face uses become isolated vertices.
    pub points: Vec<Vector>,
    /// The faces. Each face lists the indices of its points, in counter-clockwise order as seen from outside. The first
    /// of the `points` has the index 0. A face has at least three points, without duplicates.
    pub faces: Vec<Vec<u32>>,
}

impl Polygons {
    /// Returns the mesh and the report of the changes that made the mesh manifold. Returns the first problem if the
    /// points and faces are not valid.
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
            let message = format!(
                "expected at least 3 points in face {f}, found {}",
                face.len()
            );
            return Err(Problem::error(message).at(["faces", &at_face]));
        }
        // The corners of the face, sorted by the indices of their points. The sort is stable, so corners with the same
        // point keep their order.
        let mut sorted: Vec<usize> = (0..face.len()).collect();
        sorted.sort_by_key(|&i| face[i]);
        let n = self.points.len();
        let missing = (0..face.len()).find(|&i| face[i] as usize >= n);
        let twice = sorted.windows(2).filter(|w| face[w[0]] == face[w[1]]);
        let twice = twice.map(|w| w[1]).min();
        let (i, problem) = match (missing, twice) {
            (Some(i), _) => (i, format!("does not exist (number of points: {n})")),
            (None, Some(i)) => (i, "is already a corner of this face".to_owned()),
            (None, None) => return Ok(()),
        };
        let message = format!("face {f}, corner {i}: point {} {problem}", face[i]);
        Err(Problem::error(message).at(["faces", &at_face, &i.to_string()]))
    }

    /// Returns the `Source` of the new object, its mesh, and the report of the changes that made the mesh manifold.
    fn source(&self) -> (Source<'_>, Mesh, BuildReport) {
        match self.build() {
            Ok((mesh, changes)) => {
                let source = Source::new(
                    Self::NAME,
                    self.name.as_deref(),
                    without_materials(MeshPlan::of(&mesh)),
                );
                (source, mesh, changes)
            }
            Err(problem) => {
                let source = Source::new(
                    Self::NAME,
                    self.name.as_deref(),
                    without_materials(MeshPlan::unknown()),
                )
                .with(problem);
                (source, Mesh::default(), BuildReport::default())
            }
        }
    }
}

/// Returns the plan with an empty list of materials, because a new mesh has no materials.
fn without_materials(plan: MeshPlan) -> MeshPlan {
    MeshPlan {
        materials: Some(Vec::new()),
        ..plan
    }
}

impl Operation for Polygons {
    const NAME: &'static str = "Polygons";
    const SUMMARY: &'static str = "Create a mesh from points and faces";
    const EXAMPLE: &'static str =
        r#"Polygons(name: "new", points: [(0, 0, 0), (1, 0, 0), (0, 1, 0)], faces: [[0, 1, 2]])"#;
    const WORDS: &'static [&'static str] = &["mesh", "polygon"];

    fn plan(&self, plan: &mut Plan, _: &PlanContext) -> Vec<Problem> {
        let (mut source, _, changes) = self.source();
        if !changes.is_clean() {
            let summary = changes.summary();
            let message = format!("the faces do not form an oriented manifold: {summary}");
            source = source.with(Problem::warning(message).at(["faces"]));
        }
        source.plan(plan)
    }

    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError> {
        cx.advance("build", 0, 1)?;
        let (source, mesh, changes) = self.source();
        let report = source.insert(scene, cx, || mesh)?;
        Ok(if changes.is_clean() {
            report
        } else {
            report.note(changes.summary())
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn step(text: &str) -> Polygons {
        op::test::read(text).unwrap()
    }

    /// Plans the step, which must have exactly one problem. Returns the path and the message of this problem.
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
    fn empty_lists_give_an_empty_mesh() {
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
        assert_eq!(report.notes, ["1 non-manifold vertex split (v0)"]);
        let files = op::Files::default();
        let cx = PlanContext::new(&files);
        let problems = step.plan(&mut Plan::default(), &cx);
        assert!(problems.len() == 1 && problems[0].is_warning);
    }

    #[test]
    fn a_face_with_the_opposite_orientation_is_reversed_with_a_note() {
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
    fn errors_name_the_face_and_the_corner() {
        let points = "points: [(0, 0, 0), (1, 0, 0), (0, 1, 0)]";
        let face = |faces: &str| problem(&format!(r#"(name: "a", {points}, faces: {faces})"#));
        let (path, message) = face("[[0, 1, 2], [0, 1, 7]]");
        assert_eq!(path, "faces.1.2");
        assert_eq!(
            message,
            "face 1, corner 2: point 7 does not exist (number of points: 3)"
        );
        let (path, message) = face("[[0, 1, 2, 1]]");
        assert_eq!(path, "faces.0.3");
        assert_eq!(
            message,
            "face 0, corner 3: point 1 is already a corner of this face"
        );
        let (path, message) = face("[[0, 1]]");
        assert_eq!(path, "faces.0");
        assert_eq!(message, "expected at least 3 points in face 0, found 2");
    }
}
