//! Remesh: replaces all triangles with nearly equilateral triangles of a given size.
//!
//! ```text
//!     +---+-----------+            +-----+-----+
//!     |\ /       .  / |            |\   / \   /|
//!     | X     .    /  |            | \ /   \ / |
//!     |/ \ .      /   |    -->     |  +-----+  |
//!     +---+------+----+            | / \   / \ |
//!     |  / .      \   |            |/   \ /   \|
//!     +-+----------+--+            +-----+-----+
//! ```

use geometry::remesh::{Counts, Length, MAX_FACES, Options, RemeshError, remesh};
use op::prelude::*;
use op::{Refusal, readable};

use crate::simplify::triangles_problem;

/// Replaces all triangles with nearly equilateral triangles of a given size, on the same surface.
///
/// Each pass splits long edges, collapses short edges, flips edges so that most vertices have six edges, and moves
/// vertices along the surface (Botsch, Kobbelt, 2004). Most edges of the result have 4/5 to 4/3 of the target length.
/// Almost all other edges are shorter. Nearly all vertices of the result lie on the original surface. The only
/// exceptions are new vertices that cannot move onto the surface without turning a triangle too far or moving the
/// surface too far. The parameter `length` gives the same target length to all edges. With the parameter `curvature`,
/// edges are short where the surface is curved, and long where it is flat (Dunyach and others, 2013). Exactly one of
/// `length` and `curvature` must be given. All faces must be triangles.
///
/// The following properties are kept:
///
/// - Topology: the numbers of holes, handles and separate parts do not change.
/// - Lines: lines consist of boundary edges, seams of texture coordinates or normals, edges between faces with
///   different tags or materials, tagged edges, creases, and the edges that `features` selects. Vertices on a line can
///   only slide along this line. The ends of lines, the vertices where lines meet, and corners where a line turns by
///   more than 40 degrees keep their exact positions. Sharp edges that are not on a line are rounded. To keep sharp
///   edges, select them with `features`.
/// - Attributes: each vertex and corner gets the values of the original surface at its position. Values are never
///   interpolated across a line.
/// - Vertex tags: a new vertex gets a tag if all old vertices around its position have the tag. Usually, these old
///   vertices are the three corners of the old triangle at this position. A tagged vertex can move only in two cases:
///   all corners of one of its triangles have the tag, or both of its neighbors on a line have the tag. All other
///   tagged vertices keep their exact positions. Vertices with a sharpness (see `Crease`) also keep their exact
///   positions.
///
/// The number of faces depends on the area of the mesh, which is not known before the run. Therefore the command
/// `check`, which examines a recipe but does not run it, shows the largest number of faces that fits the memory budget.
/// When the step starts, it estimates the number of faces from the area. The step fails if a mesh with this number of
/// faces would exceed the memory budget.
///
/// The passes leave out every split, collapse, flip or move that would turn a triangle by more than 60 degrees. All
/// elements get new ids. If the step cannot prove that the distance between the result and the original is at most
/// `error`, the step is refused (reason: `Unreached`). With `on_refusal: Skip`, a refused step leaves the mesh
/// unchanged, and the run continues.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Remesh {
    /// The target length of edges, in scene units.
    #[serde(default)]
    pub length: Option<PositiveLength>,
    /// Target lengths that depend on the curvature of the surface, instead of one target length for all edges.
    #[serde(default)]
    pub curvature: Option<RemeshCurvature>,
    /// Edges to keep as lines, in addition to the lines that are always kept. For example, `Sharp(above: 30)`. If
    /// omitted, no additional edges.
    #[serde(default)]
    pub features: Option<EdgeSelection>,
    /// The largest allowed Hausdorff distance between the old and the new surface, in scene units. To stay below this
    /// limit, the step can make some edges shorter than the target length. The distance is measured at the end of the
    /// step, in both directions and for all points of both surfaces. If omitted, there is no limit.
    #[serde(default)]
    pub error: Option<PositiveLength>,
    /// Vertices that keep their exact positions, for example `Boundary`. If omitted, no vertices.
    #[serde(default)]
    pub pin: Option<VertexSelection>,
    /// The largest number of passes, from 1 to 1000. The step ends earlier if a pass changes almost nothing. Defaults
    /// to 10.
    #[serde(default = "ten")]
    pub passes: Count<1, 1000>,
    /// What to do if the distance between the result and the original could exceed `error`.
    #[serde(default)]
    pub on_refusal: OnRefusal,
}

/// Target edge lengths that depend on the curvature of the surface: edges are short where the surface is curved, and
/// long where it is flat.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct RemeshCurvature {
    /// The intended largest distance between the original surface and the new triangles, in scene units. This distance
    /// is not guaranteed. To guarantee a distance, use the other parameter `error`, which belongs to the step itself:
    /// `Remesh(error: ..)`.
    pub error: PositiveLength,
    /// The smallest target length of edges, in scene units.
    pub min: PositiveLength,
    /// The largest target length of edges, in scene units.
    pub max: PositiveLength,
}

fn ten() -> Count<1, 1000> {
    Count::literal(10)
}

impl Remesh {
    /// Returns the target length that `length` or `curvature` defines. Returns an error message if the combination of
    /// the two parameters is invalid.
    fn target(&self) -> Result<Length, &'static str> {
        match (self.length, self.curvature) {
            (Some(length), None) => Ok(Length::Uniform(length.get())),
            (None, Some(RemeshCurvature { error, min, max })) if min <= max => {
                Ok(Length::Curvature {
                    error: error.get(),
                    min: min.get(),
                    max: max.get(),
                })
            }
            (None, Some(_)) => Err("`min` of `curvature` must not exceed `max`"),
            (Some(_), Some(_)) => Err("`length` and `curvature` cannot be combined"),
            (None, None) => Err("Remesh needs `length` or `curvature`"),
        }
    }
}

/// The number of bytes for connectivity and positions, divided by the number of faces. A mesh has about half a vertex
/// and one and a half edges for each face.
const BYTES: u64 = 54;

/// Returns the largest number of faces that fits the memory budget. Both the result and the copy that the step changes
/// must fit.
fn max_faces(mesh: &Mesh, budget: u64) -> usize {
    let per_face = BYTES + mesh.bytes() as u64 / (mesh.n_faces() as u64).max(1);
    usize::try_from(budget / per_face).unwrap_or(usize::MAX)
}

fn notes(counts: &Counts) -> Report {
    let report = Report::changed(counts.split + counts.collapsed + counts.flipped)
        .count("edges split", counts.split)
        .count("edges collapsed", counts.collapsed)
        .count("edges flipped", counts.flipped);
    let refused: Vec<String> = counts
        .refused()
        .map(|(reason, n)| format!("{n} {reason}"))
        .collect();
    if refused.is_empty() {
        return report;
    }
    report.note(format!(
        "improvements that were refused in the last pass, by reason: {}",
        refused.join(", ")
    ))
}

impl MeshOperation for Remesh {
    const NAME: &'static str = "Remesh";
    const VERSION: u32 = 2;
    const SUMMARY: &'static str =
        "Replace all triangles with nearly equilateral triangles of a given size";
    const EXAMPLE: &'static str = "Remesh(length: 0.5)";
    const WORDS: &'static [&'static str] = &["isotropic", "retriangulate", "resample", "adaptive"];

    fn plan(&self, plan: &mut MeshPlan, cx: &PlanContext) -> Vec<Problem> {
        let mut problems = Vec::from_iter(triangles_problem(Self::NAME, plan));
        problems.extend(self.target().err().map(|message| {
            Problem::error(message).help("write, for example, `Remesh(length: 0.02)`")
        }));
        // Before the run, the area of the mesh is not known, so only the memory budget limits the predicted number of
        // faces. If the mesh has no faces, the result has no faces. Isolated vertices are kept.
        let most = match plan.faces.max {
            0 => 0,
            _ => (cx.budget / BYTES).min(MAX_FACES as u64),
        };
        let isolated = plan.vertices.max;
        for (count, max) in [
            (&mut plan.vertices, isolated.saturating_add(3 * most)),
            (&mut plan.edges, 3 * most),
            (&mut plan.faces, most),
        ] {
            *count = Range {
                min: count.min.min(1),
                max,
            };
        }
        problems
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        let length = self
            .target()
            .map_err(|message| OpError::Parameter(message.to_owned()))?;
        let features = match &self.features {
            Some(features) => features.resolve(mesh, cx)?,
            None => Vec::new(),
        };
        let pinned = match &self.pin {
            Some(pin) => pin.resolve(mesh, cx)?,
            None => Vec::new(),
        };
        let options = Options {
            length,
            error: self.error.map(PositiveLength::get),
            features: &features,
            pinned: &pinned,
            passes: self.passes.get(),
            max_faces: max_faces(mesh, cx.budget),
        };
        match remesh(mesh, &options, cx.progress()) {
            Ok(remeshed) => {
                mesh.replace(remeshed.mesh);
                Ok(notes(&remeshed.counts))
            }
            Err(RemeshError::Cancelled(_)) => Err(OpError::Cancelled),
            Err(error @ RemeshError::NotTriangle(f)) => {
                let message = format!("{error}; triangulate the faces first, with Triangulate");
                Err(OpError::refused(Refusal::NotTriangle, message).about([f]))
            }
            Err(RemeshError::TooManyFaces { needed, max }) => {
                let message = if needed.is_finite() {
                    format!(
                        "remeshing needs up to about {} faces, but the mesh can have at most {max}; use a longer target length",
                        readable(needed.round())
                    )
                } else {
                    format!(
                        "remeshing needs too many faces to count, but the mesh can have at most {max}; use a longer target length"
                    )
                };
                Err(OpError::Budget(message))
            }
            Err(RemeshError::TooFar { reached, limit }) => {
                let mut report = Report::default();
                let message = format!(
                    "the distance between the original and the new surface could be as large as {}, which exceeds the allowed error of {}",
                    readable(reached),
                    readable(limit)
                );
                let refused = OpError::refused(Refusal::Unreached, message);
                self.on_refusal.refuse(refused, &mut report)?;
                Ok(report)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use op::test::{applied, planned, try_applied};

    fn step(text: &str) -> Remesh {
        op::test::read(text).unwrap()
    }

    #[test]
    fn a_length_gives_edges_of_about_this_length() {
        let icosahedron = shapes::icosahedron();
        let step = step("(length: 0.2)");
        let (plan, problems) = planned(&step, &icosahedron);
        let (mesh, report) = try_applied(&step, icosahedron.clone()).unwrap();
        assert_eq!(problems, []);
        assert!(plan.faces.contains(mesh.n_faces() as u64));
        assert!(report.changed > 100 && !report.notes.is_empty());
        let in_range = |&e: &mesh::EdgeId| {
            let length = mesh.length(e.half_edges()[0]);
            (0.8 * 0.2..4.0 / 3.0 * 0.2).contains(&length)
        };
        let n = mesh.edges().filter(in_range).count();
        assert!(n as f64 > 0.9 * mesh.n_edges() as f64);
    }

    #[test]
    fn a_target_must_be_given() {
        let curvature = "curvature: (error: 0.01, min: 0.1, max: 1)";
        let bad = "(curvature: (error: 0.01, min: 1, max: 0.1))";
        for text in ["()", &format!("(length: 1, {curvature})"), bad] {
            let (_, problems) = planned(&step(text), &shapes::icosahedron());
            assert_eq!(problems.len(), 1, "{text}");
            assert!(try_applied(&step(text), shapes::icosahedron()).is_err());
        }
        let (_, problems) = planned(&step(&format!("({curvature})")), &shapes::icosahedron());
        assert_eq!(problems, []);
    }

    #[test]
    fn features_and_pins_are_kept() {
        let cube = shapes::fans(&shapes::cube());
        let kept = applied(
            &step("(length: 0.3, features: Sharp(above: 40))"),
            cube.clone(),
        );
        assert!((geometry::volume(&kept) - 8.0).abs() < 1e-12);
        let pinned = applied(&step("(length: 5, pin: All)"), cube.clone());
        assert_eq!(pinned.positions(), cube.positions());
    }

    #[test]
    fn an_error_holds_or_the_step_is_refused() {
        let octahedron = shapes::octahedron();
        let near = applied(&step("(length: 0.5, error: 0.05)"), octahedron.clone());
        let distance = geometry::distance::Distance::between(&octahedron, &near, None).unwrap();
        assert!(distance.at_most() <= 0.05);
    }

    #[test]
    fn a_length_that_needs_too_much_memory_is_refused_before_the_work() {
        let mut mesh = shapes::icosahedron();
        let files = op::Files::default();
        let mut cx = Context::new(&op::NoProgress, &files);
        cx.budget = 100_000;
        let refused = step("(length: 0.01)")
            .apply(&mut mesh, &mut cx)
            .unwrap_err();
        assert!(matches!(refused, OpError::Budget(_)), "{refused}");
        assert_eq!(mesh, shapes::icosahedron());
    }

    #[test]
    fn messages_have_few_digits() {
        let mut huge = shapes::icosahedron();
        huge.positions_mut().iter_mut().for_each(|p| *p *= 1e150);
        for text in ["(length: 1)", "(length: 1e150, error: 1e-100)"] {
            let message = try_applied(&step(text), huge.clone())
                .unwrap_err()
                .to_string();
            assert!(message.len() < 140 && !message.contains("inf"), "{message}");
        }
    }

    #[test]
    fn the_plan_is_limited_by_the_budget() {
        let files = op::Files::default();
        for (budget, most) in [(54_000, 1000), (u64::MAX, MAX_FACES as u64)] {
            let cx = PlanContext {
                files: &files,
                on: None,
                budget,
            };
            let mut plan = MeshPlan::of(&shapes::icosahedron());
            assert_eq!(
                MeshOperation::plan(&step("(length: 1)"), &mut plan, &cx),
                []
            );
            assert_eq!(plan.faces, Range::between(1, most));
            assert_eq!(plan.vertices.max, 12 + 3 * most);
        }
    }

    #[test]
    fn polygons_are_refused_in_the_plan_and_in_the_run() {
        let (_, problems) = planned(&step("(length: 1)"), &shapes::cube());
        assert_eq!(problems.len(), 1);
        let refused = try_applied(&step("(length: 1)"), shapes::cube()).unwrap_err();
        assert!(matches!(
            refused,
            OpError::Refused {
                reason: Refusal::NotTriangle,
                ..
            }
        ));
    }
}
