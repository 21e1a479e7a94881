//! Delete faces: removes faces and leaves holes.
//!
//! ```text
//!    +---+---+---+          +---+---+---+
//!    |   | f |   |          |   |   |   |
//!    +---+---+---+   -->    +---+   +---+
//!    |   | g |   |          |   |   |   |
//!    +---+---+---+          +---+   +---+
//! ```

use mesh::{EditError, FaceId, VertexId};
use op::prelude::*;

/// Removes faces and leaves holes.
///
/// All faces are removed at once, so their order does not matter. Edges left without a face are removed. Vertices that
/// lose their last edge are also removed, unless `keep_vertices` is true. Vertices that had no edge before the step are
/// kept. The remaining elements keep their order and their values but get new ids. To delete edges or vertices together
/// with their faces, select the faces with `FacesBeside(edges)` or `FacesAround(vertices)`.
///
/// The removal is refused if the remaining faces around a vertex would form several fans that meet only at this vertex.
/// A fan is a group of faces that are connected across edges. With `on_refusal: Skip`, the step then tries to remove
/// the faces one by one, in order of their ids. The step repeats these attempts until no more selected faces can be
/// removed. Selected faces that still cannot be removed are kept, and the report counts them as refused.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct DeleteFaces {
    /// The faces to delete.
    pub faces: FaceSelection,
    /// What to do when some of the faces cannot be removed.
    #[serde(default)]
    pub on_refusal: OnRefusal,
    /// Whether to keep vertices that are left without an edge.
    #[serde(default)]
    pub keep_vertices: bool,
}

impl MeshOperation for DeleteFaces {
    const NAME: &'static str = "DeleteFaces";
    const SUMMARY: &'static str = "Delete faces and leave holes";
    const EXAMPLE: &'static str = "DeleteFaces(faces: All)";
    const WORDS: &'static [&'static str] = &["remove"];
    const DONE: &'static str = "deleted";

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        let chosen = self.faces.count(plan);
        if chosen.max == 0 {
            return Vec::new();
        }
        let removed = self.on_refusal.done(chosen);
        plan.faces = plan.faces.minus(removed);
        plan.edges = plan.edges.or_less();
        if plan.faces.max == 0 {
            plan.edges = Range::exactly(0);
        }
        if !self.keep_vertices {
            plan.vertices = plan.vertices.or_less();
        }
        Vec::new()
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        let faces = self.faces.resolve(mesh, cx)?;
        cx.advance("delete faces", 0, faces.len() as u64)?;
        let mut corners: Vec<VertexId> = Vec::new();
        if !self.keep_vertices {
            corners.extend(faces.iter().flat_map(|&f| mesh.face_vertices(f)));
        }
        let report = match mesh.delete_faces(&faces) {
            Ok(()) if faces.is_empty() => Report::default().note("nothing was selected"),
            Ok(()) => Report::changed(faces.len()),
            Err(refusal) if self.on_refusal == OnRefusal::Error => {
                return Err(OpError::from(refusal).skippable());
            }
            Err(_) => one_by_one(mesh, faces, cx)?,
        };
        for v in corners {
            if mesh.has_vertex(v) && mesh.vertex_half_edge(v).is_none() {
                mesh.delete_vertex(v)?;
            }
        }
        Ok(report)
    }
}

/// Tries to remove the faces one by one, and then tries the remaining faces again. Stops when all `faces` are removed,
/// or when no further face can be removed.
fn one_by_one(mesh: &mut Mesh, faces: Vec<FaceId>, cx: &Context) -> Result<Report, OpError> {
    let total = faces.len();
    let mut refused: Vec<(FaceId, EditError)> = Vec::new();
    let mut remaining = faces;
    loop {
        for (done, &f) in remaining.iter().enumerate() {
            if let Err(refusal) = mesh.delete_face(f) {
                refused.push((f, refusal));
            }
            if done % 4096 == 4095 {
                let done = (total - remaining.len() + done) as u64;
                cx.advance("delete faces", done, total as u64)?;
            }
        }
        if refused.is_empty() || refused.len() == remaining.len() {
            break;
        }
        remaining = refused.drain(..).map(|(f, _)| f).collect();
    }
    let mut report = Report::changed(total - refused.len());
    for (_, refusal) in refused {
        report.refuse(refusal.into())?;
    }
    Ok(report)
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use op::Refusal;
    use op::test::{applied, is_as_planned, planned, try_applied};
    use proptest::prelude::*;

    fn parse(text: &str) -> DeleteFaces {
        op::test::read(text).unwrap()
    }

    fn counts(mesh: &Mesh) -> [usize; 3] {
        [mesh.n_vertices(), mesh.n_edges(), mesh.n_faces()]
    }

    #[test]
    fn a_face_leaves_a_hole() {
        let mesh = applied(&parse("(faces: Faces([4]))"), shapes::grid(3, 3));
        assert_eq!(counts(&mesh), [16, 24, 8]);
        assert_eq!(mesh.n_boundary_loops(), 2);
    }

    #[test]
    fn vertices_left_without_an_edge_are_removed_or_kept() {
        let all = parse("(faces: All)");
        let mut mesh = shapes::grid(2, 1);
        assert_eq!(counts(&applied(&all, mesh.clone())), [0, 0, 0]);
        let kept = applied(&parse("(faces: All, keep_vertices: true)"), mesh.clone());
        assert_eq!(counts(&kept), [6, 0, 0]);
        // A vertex that was isolated before the step is kept.
        mesh = applied(&parse("(faces: Faces([1]), keep_vertices: true)"), mesh);
        assert_eq!(counts(&mesh), [6, 4, 1]);
        assert_eq!(counts(&applied(&all, mesh)), [2, 0, 0]);
    }

    #[test]
    fn faces_can_be_removed_together_that_cannot_be_removed_alone() {
        // A ring of eight squares around a hole. Each corner square touches the hole with one vertex.
        let ring = applied(&parse("(faces: Faces([4]))"), shapes::grid(3, 3));
        let alone = try_applied(&parse("(faces: Faces([0]))"), ring.clone());
        let Err(OpError::Refused { reason, .. }) = alone else {
            panic!("expected a refusal, got {alone:?}");
        };
        assert_eq!(reason, Refusal::Pinch);
        let mesh = applied(&parse("(faces: Faces([0, 1]))"), ring);
        assert_eq!((mesh.n_faces(), mesh.n_boundary_loops()), (6, 1));
    }

    #[test]
    fn skipped_faces_are_kept_and_counted() {
        // Removing both diagonal squares would leave two fans at the vertex in the middle.
        let diagonal = "(faces: Faces([0, 3]), on_refusal: Skip)";
        let (mesh, report) = try_applied(&parse(diagonal), shapes::grid(2, 2)).unwrap();
        assert_eq!((mesh.n_faces(), report.changed), (3, 1));
        let refused: Vec<_> = report.refused.iter().map(|r| (r.reason, r.count)).collect();
        assert_eq!(refused, [(Refusal::Pinch, 1)]);
    }

    #[test]
    fn a_refused_face_is_tried_again_after_later_faces() {
        // As long as face 1 exists, removing face 0 would make a vertex non-manifold. Removing face 7, at the opposite
        // corner, would always make a vertex non-manifold.
        let ring = applied(&parse("(faces: Faces([4]))"), shapes::grid(3, 3));
        let numbers = "(faces: Faces([0, 1, 7]), on_refusal: Skip)";
        let (mesh, report) = try_applied(&parse(numbers), ring).unwrap();
        assert_eq!((mesh.n_faces(), report.changed), (6, 2));
        assert_eq!(report.refused[0].count, 1);
    }

    #[test]
    fn faces_beside_edges_and_around_vertices_are_removed() {
        let beside = parse("(faces: FacesBeside(Between(0, 1)))");
        assert_eq!(counts(&applied(&beside, shapes::cube())), [8, 11, 4]);
        let around = parse("(faces: FacesAround(Vertices([0])))");
        assert_eq!(counts(&applied(&around, shapes::cube())), [7, 9, 3]);
    }

    #[test]
    fn the_plan_has_the_exact_number_of_faces() {
        let (plan, problems) = planned(&parse("(faces: All)"), &shapes::cube());
        assert_eq!(problems, []);
        assert_eq!(
            (plan.faces, plan.edges),
            (Range::exactly(0), Range::exactly(0))
        );
        let (plan, _) = planned(
            &parse("(faces: Random(count: 2, seed: 1), keep_vertices: true)"),
            &shapes::cube(),
        );
        assert_eq!(
            (plan.faces, plan.vertices),
            (Range::exactly(4), Range::exactly(8))
        );
    }

    #[test]
    fn the_faces_are_required() {
        assert!(op::test::read::<DeleteFaces>("()").is_err());
    }

    proptest! {
        #[test]
        fn the_plan_holds_and_skipping_never_fails(
            count in 0..40_u32, seed in 0..1000_u64, which in 0..5_usize, keep_vertices: bool,
        ) {
            let before = [
                Mesh::default(),
                shapes::grid(6, 5),
                shapes::cube(),
                shapes::icosahedron(),
                shapes::torus(6, 5, 2.0, 1.0),
            ][which].clone();
            let faces = FaceSelection::Random { count, of: Box::default(), seed };
            let delete = DeleteFaces { faces, on_refusal: OnRefusal::Skip, keep_vertices };
            let (after, report) = try_applied(&delete, before.clone()).unwrap();
            prop_assert!(is_as_planned(&delete, &before, &after));
            prop_assert_eq!(after.n_faces() as u64 + report.changed, before.n_faces() as u64);
            let strict = DeleteFaces { on_refusal: OnRefusal::Error, ..delete };
            match try_applied(&strict, before.clone()) {
                Ok((strictly, _)) => {
                    prop_assert_eq!(&strictly, &after);
                    prop_assert!(is_as_planned(&strict, &before, &strictly));
                }
                Err(_) => prop_assert!(!report.refused.is_empty()),
            }
        }
    }
}
