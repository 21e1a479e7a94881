//! Simplify: removes triangles, and changes the surface as little as possible.
//!
//! ```text
//!     +---+---+---+---+           +-------+-------+
//!     | / | / | / | / |           |     /  \      |
//!     +---+---+---+---+    -->    |  /        \   |
//!     | / | / | / | / |           | /            \|
//!     +---+---+---+---+           +---------------+
//! ```

use geometry::simplify::{Blocked, Options, SimplifyError, simplify};
use geometry::uv::overlapping_faces;
use mesh::{Column, Domain, Rule, UV, Values, counted, is_rig_name};
use op::Refusal;
use op::prelude::*;

/// Removes triangles from meshes, and changes the surface as little as possible.
///
/// Edges are collapsed, starting with the edges whose collapse changes the surface least. A collapse merges the two
/// ends of an edge into one vertex. The change is measured by the squared distance of this vertex to the planes of the
/// original triangles around the merged vertices (Garland, Heckbert, 1997). The step ends when the number of faces
/// given by `faces` or `ratio` is reached. It also ends when every remaining collapse would change a property that must
/// be kept (see the list below) or could exceed `error`. At least one of `faces`, `ratio` and `error` must be given,
/// but not both `faces` and `ratio`. All faces must be triangles.
///
/// The following properties are kept:
///
/// - Topology: the numbers of holes, handles and separate parts do not change.
/// - Lines: lines consist of boundary edges, seams of texture coordinates or normals, edges between faces with
///   different tags or materials, tagged edges, creases, and the edges that `features` selects. A line can lose
///   vertices, but its ends, and the vertices where lines meet, keep their exact positions.
/// - Attributes: changes of texture coordinates, normals, colors and other numbers count as changes of the surface
///   (Hoppe, 1999). New vertices get the values that fit best. Values are never mixed across a line, and no triangle is
///   turned over in the texture. Stored normals are kept, so that a simplified mesh is shaded like the original. The
///   vertex attributes that `Measure` stores also influence the result, and the report lists their names. To avoid this
///   influence, use `Measure` after this step.
/// - Vertex tags: vertices with different tags, different sharpness, or different values of a whole-number attribute
///   are not merged.
///
/// Seams divide a texture into charts. The borders of charts are also simplified, and a simplified border can cross a
/// neighboring chart in the texture. The report counts the faces that overlap in the texture. To leave more space
/// between charts, use `PackUvs` with a larger `padding` before this step.
///
/// No collapse turns a triangle over. Remaining elements get new ids, in the order of their old ids. If `error` is not
/// given and the number of faces cannot be reached, the step is refused (reason: `Unreached`), and the message states
/// why. With `on_refusal: Skip`, the step instead simplifies the mesh as far as it can.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Simplify {
    /// The number of faces to reach, for each mesh. The result can have one face fewer, because a collapse inside the
    /// mesh removes two faces. A mesh that already has at most this number of faces does not change.
    #[serde(default)]
    pub faces: Option<Count<0>>,
    /// The number of faces to reach, as a fraction of the number of faces of each mesh.
    #[serde(default)]
    pub ratio: Option<Fraction>,
    /// The largest allowed Hausdorff distance between the old and the new surface, in scene units. The limit is
    /// guaranteed: for each collapse, the step computes an upper bound of how far the surface moves, and adds up these
    /// bounds. The sum overestimates the true distance. If the step ends because of this limit, the true distance is
    /// usually at least a third of the limit. If omitted, there is no limit.
    #[serde(default)]
    pub error: Option<PositiveLength>,
    /// Edges to keep as lines, in addition to the lines that are always kept. For example, `Sharp(above: 30)`. If
    /// omitted, no additional edges.
    #[serde(default)]
    pub features: Option<EdgeSelection>,
    /// Vertices that are never removed and keep their exact positions, for example `Boundary`. If omitted, no vertices.
    #[serde(default)]
    pub pin: Option<VertexSelection>,
    /// Whether the step is allowed to make faces intersect each other. Intersections can occur where parts of the
    /// surface are close together.
    #[serde(default)]
    pub intersections: Intersections,
    /// What to do if the mesh cannot be reduced to the requested number of faces.
    #[serde(default)]
    pub on_refusal: OnRefusal,
}

/// Whether the step is allowed to create intersections of faces.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Intersections {
    /// New intersections are allowed. The step does not search for them.
    #[default]
    Allow,
    /// The step refuses every change that would make a changed face intersect another face. A mesh without
    /// self-intersections therefore stays without self-intersections. The search for intersections makes the step
    /// slower.
    Refuse,
}

impl Simplify {
    /// Returns the number of faces that the step must reach in a mesh with `n_faces` faces.
    fn goal(&self, n_faces: u64) -> u64 {
        match (self.faces, self.ratio) {
            (Some(faces), _) => u64::from(faces.get()),
            (None, Some(ratio)) => part(n_faces, ratio),
            (None, None) => 0,
        }
    }
}

/// Returns `n_faces` times `ratio`, rounded up.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_precision_loss,
    reason = "numbers of faces are below 2^32"
)]
pub(crate) fn part(n_faces: u64, ratio: Fraction) -> u64 {
    (n_faces as f64 * ratio.get()).ceil() as u64
}

/// Records in the plan that the mesh is reduced to the number of faces in `goal`. A collapse can remove two faces, so
/// the result can have one face fewer than `goal.min`.
pub(crate) fn plan_goal(plan: &mut MeshPlan, goal: Range, is_certain: bool) {
    let least = goal.min.saturating_sub(1).min(plan.faces.min);
    let most = if is_certain {
        goal.max.min(plan.faces.max)
    } else {
        plan.faces.max
    };
    plan.faces = Range {
        min: least,
        max: most.max(least),
    };
    plan.vertices = plan.vertices.or_less();
    plan.edges = plan.edges.or_less();
}

/// Returns a problem if all faces of the mesh certainly have more than three corners.
pub(crate) fn triangles_problem(name: &str, plan: &MeshPlan) -> Option<Problem> {
    (plan.degrees.min > 3 && plan.faces.max > 0).then(|| {
        let least = plan.degrees.min;
        let message =
            format!("{name} needs triangles, but the faces have at least {least} corners");
        Problem::error(message).help("triangulate the faces first, with Triangulate")
    })
}

/// Converts an error of [`simplify`] to an error of an operation.
pub(crate) fn error(error: &SimplifyError) -> OpError {
    match error {
        SimplifyError::Cancelled(_) => OpError::Cancelled,
        SimplifyError::NotTriangle(f) => {
            let message =
                format!("{f} is not a triangle; triangulate the faces first, with Triangulate");
            OpError::refused(Refusal::NotTriangle, message).about([*f])
        }
    }
}

/// Returns the error for a mesh that could not be reduced to `goal` faces.
pub(crate) fn unreached(n_faces: usize, goal: u64, blocked: &[(Blocked, usize)]) -> OpError {
    let reasons: Vec<String> = blocked
        .iter()
        .map(|(reason, n)| format!("{n} {reason}"))
        .collect();
    let n_edges: usize = blocked.iter().map(|(_, n)| n).sum();
    let faces = if n_faces == 1 {
        "face was"
    } else {
        "faces were"
    };
    let edges = counted(n_edges, "edge");
    let message = format!(
        "{n_faces} {faces} left, more than the requested {goal}, because no further edge can be collapsed: of {edges}, {}",
        reasons.join(", ")
    );
    OpError::refused(Refusal::Unreached, message)
}

impl MeshOperation for Simplify {
    const NAME: &'static str = "Simplify";
    const VERSION: u32 = 4;
    const SUMMARY: &'static str = "Remove triangles, and change the surface as little as possible";
    const EXAMPLE: &'static str = "Simplify(ratio: 0.5)";
    const WORDS: &'static [&'static str] = &["decimate", "reduce", "quadric", "lod", "polycount"];

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        let mut problems = Vec::from_iter(triangles_problem(Self::NAME, plan));
        let message = match (self.faces, self.ratio, self.error) {
            (Some(_), Some(_), _) => Some("`faces` and `ratio` cannot be combined"),
            (None, None, None) => Some("Simplify needs `faces`, `ratio` or `error`"),
            _ => None,
        };
        problems.extend(message.map(|message| {
            Problem::error(message).help("write, for example, `Simplify(faces: 5000)`")
        }));
        let goal = Range {
            min: self.goal(plan.faces.min),
            max: self.goal(plan.faces.max),
        };
        let is_certain = self.on_refusal == OnRefusal::Error && self.error.is_none();
        plan_goal(plan, goal, is_certain);
        problems
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        let features = match &self.features {
            Some(features) => features.resolve(mesh, cx)?,
            None => Vec::new(),
        };
        let pinned = match &self.pin {
            Some(pin) => pin.resolve(mesh, cx)?,
            None => Vec::new(),
        };
        let before = mesh.n_faces();
        let goal = self.goal(before as u64);
        let options = Options {
            faces: usize::try_from(goal).unwrap_or(usize::MAX),
            error: self.error.map(PositiveLength::get),
            features: &features,
            pinned: &pinned,
            refuse_intersections: self.intersections == Intersections::Refuse,
        };
        let simplified = simplify(mesh, &options, cx.progress()).map_err(|e| error(&e))?;
        let after = simplified.mesh.n_faces();
        let mut report = Report::changed(before - after);
        if after as u64 > goal && self.error.is_none() {
            self.on_refusal
                .refuse(unreached(after, goal, &simplified.blocked), &mut report)?;
        }
        if before as u64 <= goal {
            report = report.note(format!(
                "the mesh does not change, because it has {before} faces, and {goal} are allowed"
            ));
        }
        if after < before {
            note_quantities(mesh, &mut report);
            note_overlaps(mesh, &simplified.mesh, &mut report, cx)?;
            mesh.replace(simplified.mesh);
        }
        Ok(report)
    }
}

/// Adds a note with the names of the vertex attributes that hold one number, such as the attributes that `Measure`
/// stores. The note tells users that a measurement can influence the result, because changes of these attributes count
/// as changes of the surface.
pub(crate) fn note_quantities(mesh: &Mesh, report: &mut Report) {
    let columns = mesh.attributes().of(Domain::Vertex).iter();
    let is_quantity = |c: &&Column| {
        c.rule == Rule::Interpolate && matches!(c.values, Values::Float(_)) && !is_rig_name(&c.name)
    };
    let names: Vec<&str> = columns.filter(is_quantity).map(|c| &*c.name).collect();
    if !names.is_empty() {
        report.notes.push(format!(
            "attributes whose changes count as changes of the surface: {}",
            names.join(", ")
        ));
    }
}

/// If more faces overlap in the texture coordinates `uv` after the simplification than before, adds a note with both
/// numbers of faces. Simplified borders of charts can cross other charts.
pub(crate) fn note_overlaps(
    before: &Mesh,
    after: &Mesh,
    report: &mut Report,
    cx: &Context,
) -> Result<(), OpError> {
    let overlaps = |mesh: &Mesh| match mesh.get(UV) {
        Some(uvs) => Ok(overlapping_faces(mesh, uvs, cx.progress())?.len()),
        None => Ok::<usize, OpError>(0),
    };
    let new = overlaps(after)?;
    if new > 0 {
        let old = overlaps(before)?;
        if new > old {
            let note = format!(
                "faces that overlap other faces in the texture: {new} after this step, {old} before"
            );
            report.notes.push(note);
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use op::test::{applied, planned, try_applied};

    fn step(text: &str) -> Simplify {
        op::test::read(text).unwrap()
    }

    #[test]
    fn intersections_are_refused_on_request() {
        // One sphere closely surrounds another sphere. If a sphere is simplified to few large triangles, the triangles
        // pass through the other sphere.
        let sphere = shapes::fans(&shapes::uv_sphere(40, 20));
        let n = u32::try_from(sphere.n_vertices()).unwrap();
        let number = |v: mesh::VertexId| u32::try_from(v.index()).unwrap();
        let (mut positions, mut faces) = (Vec::new(), Vec::<Vec<u32>>::new());
        for (first, size) in [(0, 1.0), (n, 0.96)] {
            positions.extend(sphere.positions().iter().map(|p| size * *p));
            let corners = |f| sphere.face_vertices(f).map(|v| first + number(v)).collect();
            faces.extend(sphere.faces().map(corners));
        }
        let spheres = Mesh::from_polygons(positions, &faces).unwrap().0;
        let crossing = |text: &str| {
            let mesh = applied(&step(text), spheres.clone());
            let faces = geometry::surface_index::self_intersecting_faces(&mesh, &op::NoProgress);
            faces.unwrap().len()
        };
        assert!(crossing("(faces: 60)") > 0);
        let refused = "(faces: 60, intersections: Refuse, on_refusal: Skip)";
        assert_eq!(crossing(refused), 0);
    }

    #[test]
    fn faces_and_ratio_are_goals() {
        let icosahedron = shapes::icosahedron();
        for (text, n) in [
            ("(faces: 12)", 12),
            ("(ratio: 0.5)", 10),
            ("(faces: 20)", 20),
            ("(faces: 99)", 20),
        ] {
            let (plan, problems) = planned(&step(text), &icosahedron);
            let (mesh, report) = try_applied(&step(text), icosahedron.clone()).unwrap();
            assert_eq!((mesh.n_faces(), report.changed), (n, 20 - n as u64));
            assert_eq!(problems, []);
            assert!(plan.faces.contains(n as u64), "{:?}", plan.faces);
        }
    }

    #[test]
    fn a_mesh_with_few_faces_is_noted_and_counts_have_the_right_number() {
        let (_, report) = try_applied(&step("(faces: 99)"), shapes::icosahedron()).unwrap();
        assert_eq!(
            report.notes,
            ["the mesh does not change, because it has 20 faces, and 99 are allowed"]
        );
        let triangle = vec![mesh::DVec3::ZERO, mesh::DVec3::X, mesh::DVec3::Y];
        let triangle = Mesh::from_polygons(triangle, &[[0, 1, 2]]).unwrap().0;
        let refused = try_applied(&step("(faces: 0)"), triangle)
            .unwrap_err()
            .to_string();
        let expected = "1 face was left, more than the requested 0";
        assert!(refused.starts_with(expected), "{refused}");
    }

    #[test]
    fn quantities_that_influence_the_result_are_noted() {
        let mut mesh = shapes::icosahedron();
        let n = mesh.n_vertices();
        for (name, rule) in [
            ("curvature", Rule::Interpolate),
            (&mesh::joint_name(0), Rule::Interpolate),
            ("label", Rule::Copy),
        ] {
            let values = Values::Float(vec![1.0; n]);
            let name = name.to_owned();
            mesh.insert_column(Domain::Vertex, Column { name, rule, values });
        }
        let (_, report) = try_applied(&step("(faces: 12)"), mesh.clone()).unwrap();
        let note = "attributes whose changes count as changes of the surface: curvature";
        assert_eq!(report.notes, [note]);
        let (_, report) = try_applied(&step("(faces: 20)"), mesh).unwrap();
        assert!(!report.notes.contains(&note.to_owned()));
    }

    #[test]
    fn pinned_vertices_are_never_removed() {
        let sphere = shapes::fans(&shapes::uv_sphere(16, 8));
        let text = "(faces: 0, pin: Vertices([3, 17, 40]), on_refusal: Skip)";
        let after = applied(&step(text), sphere.clone());
        assert!(after.n_vertices() < sphere.n_vertices());
        for i in [3, 17, 40] {
            assert!(after.positions().contains(&sphere.positions()[i]));
        }
    }

    #[test]
    fn new_overlaps_in_the_texture_are_counted() {
        // In the texture, half a ring closely surrounds a smaller half ring. If the larger half ring keeps only few
        // vertices, its inner border cuts through the smaller half ring in the texture.
        let (mut positions, mut faces) = (Vec::new(), Vec::<[u32; 3]>::new());
        for (inner, outer, n) in [(0.5, 1.0, 32), (1.005, 2.0, 27)] {
            let first = u32::try_from(positions.len()).unwrap();
            for i in 0..=n {
                let (sin, cos) = geometry::sin_cos_degrees(180.0 * f64::from(i) / f64::from(n));
                for r in [inner, outer] {
                    positions.push(mesh::DVec3::new(r * cos, r * sin, 0.0));
                }
            }
            for i in 0..n {
                let a = first + 2 * i;
                faces.extend([[a, a + 1, a + 3], [a, a + 3, a + 2]]);
            }
        }
        let mut mesh = Mesh::from_polygons(positions, &faces).unwrap().0;
        let uvs = (0..mesh.n_half_edges()).map(|h| {
            let v = mesh.origin(mesh::HalfEdgeId::new(h));
            mesh.position(v).truncate()
        });
        let uvs = uvs.collect();
        mesh.set(UV, uvs);
        let text = "(faces: 40, on_refusal: Skip)";
        let (after, report) = try_applied(&step(text), mesh).unwrap();
        let n = overlapping_faces(&after, after.get(UV).unwrap(), &op::NoProgress)
            .unwrap()
            .len();
        assert!(n > 0);
        let note =
            format!("faces that overlap other faces in the texture: {n} after this step, 0 before");
        assert_eq!(report.notes, [note]);
    }

    #[test]
    fn a_goal_must_be_given() {
        for text in ["()", "(faces: 5, ratio: 0.5)"] {
            let (_, problems) = planned(&step(text), &shapes::icosahedron());
            assert_eq!(problems.len(), 1);
        }
    }

    #[test]
    fn an_error_limits_the_distance() {
        let flat = shapes::fans(&shapes::grid(4, 4));
        let step = step("(error: 0.001)");
        let mesh = applied(&step, flat.clone());
        let (plan, problems) = planned(&step, &flat);
        assert_eq!((mesh.n_faces(), problems.len()), (2, 0));
        assert!(plan.faces.contains(2));
        let ball = applied(&step, shapes::icosahedron());
        assert_eq!(ball.n_faces(), 20);
    }

    #[test]
    fn an_unreached_goal_is_refused_with_the_reasons() {
        let refused = try_applied(&step("(faces: 2)"), shapes::tetrahedron()).unwrap_err();
        assert_eq!(
            refused.to_string(),
            "4 faces were left, more than the requested 2, because no further edge can be collapsed: of 6 edges, 6 would change the topology"
        );
        let skip = step("(faces: 2, on_refusal: Skip)");
        let (mesh, report) = try_applied(&skip, shapes::octahedron()).unwrap();
        assert_eq!(mesh.n_faces(), 4);
        assert_eq!((report.changed, report.refused[0].count), (4, 1));
    }

    #[test]
    fn polygons_are_refused_in_the_plan_and_in_the_run() {
        let (_, problems) = planned(&step("(faces: 4)"), &shapes::cube());
        assert_eq!(problems.len(), 1);
        let refused = try_applied(&step("(faces: 4)"), shapes::cube()).unwrap_err();
        assert!(matches!(
            refused,
            OpError::Refused {
                reason: Refusal::NotTriangle,
                ..
            }
        ));
    }

    #[test]
    fn features_and_pins_are_kept() {
        let cylinder = shapes::fans(&shapes::cylinder(32, true));
        let pinned = applied(
            &step("(faces: 20, pin: All, on_refusal: Skip)"),
            cylinder.clone(),
        );
        assert_eq!(pinned.n_faces(), cylinder.n_faces());
        let kept = applied(
            &step("(ratio: 0.5, features: Sharp(above: 40))"),
            cylinder.clone(),
        );
        assert!(
            kept.positions()
                .iter()
                .all(|p| (p.z.abs() - 1.0).abs() < 1e-6)
        );
    }
}
