//! Split faces: cuts each face in two with an edge between two of its corners.
//!
//! ```text
//!    +-----w          +-----w
//!    |     |          |   / |
//!    |     |   -->    |  /  |         between: [(v, w)]
//!    |     |          | /   |
//!    v-----+          v-----+
//! ```

use mesh::VertexId;
use op::prelude::*;

/// Cuts each face in two with an edge between two of its corners.
///
/// Each pair (v, w) of vertices in `between` cuts the face that has both vertices as corners. The new edge joins the
/// two vertices. Each cut adds 1 edge and 1 face. Cuts are made in the order of the list, so a face can be cut several
/// times. A cut from v to w divides the face into two parts. Seen from outside, the part to the right of the line from
/// v to w becomes the new face. The other part keeps the id of the old face. New edges and faces get the highest ids.
/// Corners keep their values. The new face has the values of the old face, and the new edge has zero values (no crease,
/// no tags).
///
/// A cut is refused if the two vertices are the same or are already joined by an edge. A cut is also refused if no face
/// has both vertices as corners. If several faces have both vertices as corners, the cut is refused because it is
/// ambiguous.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct SplitFaces {
    /// The cuts, as a list of pairs of vertex ids, for example `[(0, 2), (5, 9)]`.
    pub between: Vec<(u32, u32)>,
    /// What to do when a cut is refused.
    #[serde(default)]
    pub on_refusal: OnRefusal,
}

impl MeshOperation for SplitFaces {
    const NAME: &'static str = "SplitFaces";
    const SUMMARY: &'static str = "Cut each face in two with an edge between two of its corners";
    const EXAMPLE: &'static str = "SplitFaces(between: [])";
    const WORDS: &'static [&'static str] = &["knife", "connect"];

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        let problem = self.problem(plan);
        let n = self.between.len() as u64;
        let cuts = self.on_refusal.done(Range::exactly(n));
        plan.grow(Range::exactly(0), cuts, cuts);
        if n > 0 {
            plan.degrees.min = 3;
        }
        Vec::from_iter(problem)
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        let ends = |&(v, w): &(u32, u32)| [vertex(v), vertex(w)];
        let cuts: Vec<_> = self.between.iter().map(ends).collect();
        edit_each(
            mesh,
            &cuts,
            self.on_refusal,
            "cut faces",
            cx,
            |mesh, [v, w]| mesh.connect_vertices(v, w).map(drop),
        )
    }
}

impl SplitFaces {
    /// Returns a problem if a cut will certainly be refused.
    fn problem(&self, plan: &MeshPlan) -> Option<Problem> {
        let mut cuts = self.between.iter();
        let message = if plan.is_triangles() && !self.between.is_empty() {
            Some(
                "all faces are triangles, which cannot be cut between two of their corners"
                    .to_owned(),
            )
        } else {
            let missing = cuts
                .clone()
                .find_map(|(v, w)| plan.missing_vertex_message(*v.max(w)));
            let twice = |(v, w)| {
                (v == w)
                    .then(|| format!("a cut needs two different vertices, found vertex {v} twice"))
            };
            missing.or_else(|| cuts.find_map(|&cut| twice(cut)))
        };
        let problem = self.on_refusal.problem(message?);
        Some(problem.at(["between"]))
    }
}

/// Returns the vertex id with this number, or `NONE` if the number is too large for an id.
fn vertex(number: u32) -> VertexId {
    if number == u32::MAX {
        VertexId::NONE
    } else {
        VertexId::new(number as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use op::Refusal;
    use op::test::{applied, is_as_planned, planned, try_applied};
    use proptest::prelude::*;

    fn parse(text: &str) -> SplitFaces {
        op::test::read(text).unwrap()
    }

    fn refused(text: &str, mesh: Mesh) -> Refusal {
        op::test::refused(&parse(text), mesh)
    }

    #[test]
    fn a_square_is_cut_along_either_diagonal() {
        for (text, [v, w]) in [
            ("(between: [(0, 2)])", [0, 2]),
            ("(between: [(3, 1)])", [3, 1]),
        ] {
            let (mesh, report) = try_applied(&parse(text), shapes::square()).unwrap();
            assert_eq!((mesh.n_edges(), mesh.n_faces(), report.changed), (5, 2, 1));
            assert!(mesh.find_half_edge(vertex(v), vertex(w)).is_some());
            assert!(is_as_planned(&parse(text), &shapes::square(), &mesh));
        }
    }

    #[test]
    fn the_new_face_is_to_the_right_of_the_cut() {
        let mesh = applied(&parse("(between: [(0, 2)])"), shapes::square());
        let right = mesh.find_half_edge(vertex(0), vertex(1)).unwrap();
        assert_eq!(mesh.face(right).map(mesh::FaceId::index), Some(1));
    }

    #[test]
    fn a_face_can_be_cut_several_times() {
        let fan = parse("(between: [(0, 2), (0, 3), (0, 4)])");
        let mut hexagon = shapes::cylinder(6, true);
        hexagon
            .delete_faces(&(0..7).map(mesh::FaceId::new).collect::<Vec<_>>())
            .unwrap();
        hexagon.delete_isolated_vertices();
        hexagon.compact();
        let mesh = applied(&fan, hexagon.clone());
        assert!(mesh.faces().all(|f| mesh.is_triangle(f)));
        assert_eq!((mesh.n_faces(), mesh.valence(vertex(0))), (4, 5));
        assert!((geometry::area(&mesh) - geometry::area(&hexagon)).abs() < 1e-12);
    }

    #[test]
    fn impossible_and_ambiguous_cuts_are_refused() {
        assert_eq!(
            refused("(between: [(0, 1)])", shapes::cube()),
            Refusal::DuplicateEdge
        );
        assert_eq!(
            refused("(between: [(0, 7)])", shapes::cube()),
            Refusal::WrongPlace
        );
        assert_eq!(
            refused("(between: [(3, 3)])", shapes::cube()),
            Refusal::WrongPlace
        );
        assert_eq!(
            refused("(between: [(0, 8)])", shapes::cube()),
            Refusal::Missing
        );
        assert_eq!(
            refused("(between: [(0, 4294967295)])", shapes::cube()),
            Refusal::Missing
        );
        // The second cut repeats the first cut, so an edge already joins the two vertices of the second cut.
        assert_eq!(
            refused("(between: [(0, 3), (3, 0)])", shapes::cube()),
            Refusal::DuplicateEdge
        );
    }

    #[test]
    fn skipped_refusals_are_counted() {
        let skip = parse("(between: [(0, 7), (0, 3), (9, 9)], on_refusal: Skip)");
        let (mesh, report) = try_applied(&skip, shapes::cube()).unwrap();
        assert_eq!(
            (mesh.n_faces(), report.changed, report.refused.len()),
            (7, 1, 2)
        );
        assert!(is_as_planned(&skip, &shapes::cube(), &mesh));
    }

    #[test]
    fn the_plan_reports_impossible_cuts() {
        let problems = |text, mesh: &Mesh| planned(&parse(text), mesh).1;
        assert_eq!(problems("(between: [(0, 3)])", &shapes::cube()), []);
        assert_eq!(problems("(between: [])", &shapes::octahedron()), []);
        for text in ["(between: [(0, 3), (0, 8)])", "(between: [(0, 3), (5, 5)])"] {
            assert!(!problems(text, &shapes::cube())[0].is_warning);
        }
        let text = "(between: [(0, 1)], on_refusal: Skip)";
        assert!(problems(text, &shapes::octahedron())[0].is_warning);
    }

    proptest! {
        #[test]
        fn topology_and_plan_hold_for_any_cuts(
            between in proptest::collection::vec((0..14_u32, 0..14_u32), 0..20), which in 0..3_usize,
        ) {
            let before =
                [shapes::grid(3, 2), shapes::cube(), shapes::cylinder(7, true)][which].clone();
            let split = SplitFaces { between, on_refusal: OnRefusal::Skip };
            let after = applied(&split, before.clone());
            prop_assert!(is_as_planned(&split, &before, &after));
            prop_assert_eq!(after.euler_characteristic(), before.euler_characteristic());
            prop_assert_eq!(after.n_vertices(), before.n_vertices());
        }
    }
}
