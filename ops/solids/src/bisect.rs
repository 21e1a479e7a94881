//! Bisect: cuts meshes along a plane.
//!
//! ```text
//!    +-------+-------+           +-------+-------+                 +-------+-------+
//!    |       |       |           |       |       |      or, if     |       |       |
//!    |       |       |    -->    m-------m-------m    `keep` is    m-------m-------m
//!    |       |       |           |       |       |     `Front`
//!    +-------+-------+           +-------+-------+
//! ```

use mesh::Domain;
use op::prelude::*;

/// Cuts meshes along a plane.
///
/// Every edge that crosses the plane gets a new vertex at the crossing point. Every face that crosses the plane is cut
/// along the plane. A concave face can be cut in several places. A vertex near the plane is treated as if it were on
/// the plane, and is not moved. A vertex is near the plane if its distance from the plane is at most 1e-9 times the
/// longest side of the bounding box. A vertex is also near if this distance is at most 1e-14 times the largest absolute
/// coordinate. Every edge has two half-edges. When an edge is cut, one part keeps the id of the edge: the part that
/// contains the start of the half-edge with the lower id. When a face is cut, the part that contains the first corner
/// keeps the id of the face. New elements get the highest ids. Where an edge crosses the plane, attributes are
/// interpolated. At a seam (an edge whose corner values, such as UVs, differ between its two sides), the corner values
/// of each side are interpolated separately.
///
/// With `keep: Front`, the part of the mesh behind the plane is removed. With `keep: Back`, the part in front of the
/// plane is removed. A face in the plane whose normal points to the front belongs to the back, because the face closes
/// the solid behind the plane. Vertices that are left without a face are removed. If the remaining faces around a
/// vertex form several fans (groups of faces connected across edges), each fan gets a separate copy of the vertex. No
/// faces are added to close the cut. To close the cut, use `FillHoles` in a later step.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Bisect {
    /// A point on the plane.
    #[serde(default)]
    pub point: Vector,
    /// The normal of the plane. The normal points to the front side. The length of the normal does not matter but must
    /// not be 0.
    pub normal: Direction,
    /// The part of the mesh to keep: one side of the plane, or both sides.
    #[serde(default)]
    pub keep: Keep,
    /// The name of a tag for the edges on the plane. Edges that already have the tag keep it. If omitted, no edges are
    /// tagged.
    #[serde(default)]
    pub tag: Option<TagName>,
}

/// The part of a mesh to keep: one side of a plane, or both sides.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Keep {
    /// Both sides. The two sides stay connected at the cut.
    #[default]
    Both,
    /// The side in front of the plane: the normal of the plane points to this side.
    Front,
    /// The side behind the plane: the normal of the plane points away from this side.
    Back,
}

impl MeshOperation for Bisect {
    const NAME: &'static str = "Bisect";
    const SUMMARY: &'static str = "Cut meshes along a plane";
    const EXAMPLE: &'static str = "Bisect(normal: (0, 0, 1))";
    const WORDS: &'static [&'static str] = &["slice", "clip", "plane"];

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        // The plane crosses each side of a face at most once. The number of cuts through a face is half the number of
        // sides that the plane crosses.
        let per_face = plan.degrees.max / 2;
        let crossings = plan.edges.or_less();
        let cuts = plan.faces.by(per_face).capped(crossings.max).or_less();
        plan.grow(crossings, crossings.plus(cuts), cuts);
        plan.degrees = Range::between(3, plan.degrees.max.saturating_add(per_face));
        if self.keep != Keep::Both {
            // If several fans of faces meet at a vertex, each fan gets its own copy of the vertex. Each fan has at
            // least two of the edges at the vertex, so the number of copies is at most the number of edges.
            plan.vertices = plan.vertices.plus(plan.edges).or_less();
            plan.edges = plan.edges.or_less();
            plan.faces = plan.faces.or_less();
        }
        if let Some(tag) = &self.tag {
            plan.provide(Domain::Edge, tag.as_str());
        }
        Vec::new()
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        cx.advance("bisect", 0, 2)?;
        let cut = geometry::bisect(mesh, self.point.get(), self.normal.get())?;
        if let Some(tag) = &self.tag {
            let mut marks = tag.marks(mesh, Domain::Edge)?;
            for e in &cut.edges {
                marks[e.index()] = true;
            }
            tag.write(mesh, Domain::Edge, marks);
        }
        cx.advance("bisect", 1, 2)?;
        let n_faces = mesh.n_faces();
        let kept = match self.keep {
            Keep::Both => return Ok(Report::changed(cut.edges.len())),
            Keep::Front => &cut.front,
            Keep::Back => &cut.back,
        };
        let mut part_of_face = vec![usize::MAX; mesh.domain_len(Domain::Face)];
        for f in kept {
            part_of_face[f.index()] = 0;
        }
        let part = geometry::parts(mesh, &part_of_face).pop();
        mesh.replace(part.unwrap_or_else(|| empty_mesh(mesh)));
        let removed = n_faces - mesh.n_faces();
        Ok(Report::changed(cut.edges.len()).note(format!("faces removed: {removed}")))
    }
}

/// Returns an empty mesh with the attributes of `mesh`.
fn empty_mesh(mesh: &Mesh) -> Mesh {
    let mut empty = Mesh::default();
    empty.set_attributes(mesh.attributes().gathered(mesh::Sources {
        vertices: &[],
        corners: &[],
        edges: &[],
        faces: &[],
    }));
    empty
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use mesh::{Attribute, DVec3, EdgeId, Rule};
    use op::test::{applied, try_applied};

    fn step(text: &str) -> Bisect {
        op::test::read(text).unwrap()
    }

    #[test]
    fn both_sides_stay_connected() {
        let (cut, report) = try_applied(&step("(normal: (0, 0, 1))"), shapes::cube()).unwrap();
        assert_eq!(
            (cut.n_vertices(), cut.n_edges(), cut.n_faces()),
            (12, 20, 10)
        );
        assert_eq!(report, Report::changed(4));
    }

    #[test]
    fn front_and_back_together_have_the_area_of_the_mesh() {
        let torus = shapes::torus(16, 9, 2.0, 0.5);
        let side = |keep| {
            let text = format!("(point: (0.1, 0, 0.05), normal: (1, 2, 0.5), keep: {keep})");
            applied(&step(&text), torus.clone())
        };
        let [front, back] = ["Front", "Back"].map(side);
        assert!(
            (geometry::area(&front) + geometry::area(&back) - geometry::area(&torus)).abs() < 1e-12
        );
        for side in [&front, &back] {
            assert_eq!(side.n_boundary_loops(), 2);
            assert_eq!(geometry::n_components(side), 1);
        }
        let normal = DVec3::new(1.0, 2.0, 0.5);
        let height = |p: &DVec3| (*p - DVec3::new(0.1, 0.0, 0.05)).dot(normal);
        assert!(front.positions().iter().all(|p| height(p) > -1e-9));
        assert!(back.positions().iter().all(|p| height(p) < 1e-9));
    }

    #[test]
    fn a_plane_that_misses_the_mesh_keeps_all_or_nothing() {
        let cube = shapes::cube();
        let all = step("(point: (0, 0, -5), normal: (0, 0, 1), keep: Front)");
        assert_eq!(applied(&all, cube.clone()), cube);
        let none = step("(point: (0, 0, -5), normal: (0, 0, 1), keep: Back)");
        assert_eq!(applied(&none, cube), Mesh::default());
    }

    #[test]
    fn a_face_in_the_plane_belongs_to_the_solid_that_it_closes() {
        let cube = shapes::cube();
        let below = step("(point: (0, 0, 1), normal: (0, 0, 1), keep: Back)");
        assert_eq!(applied(&below, cube.clone()), cube);
        let above = step("(point: (0, 0, 1), normal: (0, 0, 1), keep: Front)");
        assert_eq!(applied(&above, cube.clone()).n_faces(), 0);
        let bottom = step("(point: (0, 0, -1), normal: (0, 0, 1), keep: Front)");
        assert_eq!(applied(&bottom, cube.clone()), cube);
    }

    #[test]
    fn the_cut_edges_can_be_tagged() {
        let tagged = |mesh: &Mesh| {
            let marks = mesh.tag(Domain::Edge, "cut").unwrap();
            marks.iter().filter(|&&m| m).count()
        };
        let cut = applied(&step(r#"(normal: (0, 0, 1), tag: "cut")"#), shapes::cube());
        assert_eq!(tagged(&cut), 4);
        let twice = applied(&step(r#"(normal: (0, 1, 0), tag: "cut")"#), cut.clone());
        assert_eq!(tagged(&twice), 12);
        let half = step(r#"(normal: (0, 0, 1), keep: Back, tag: "cut")"#);
        let half = applied(&half, shapes::cube());
        let marks = half.tag(Domain::Edge, "cut").unwrap();
        assert!(
            half.edges()
                .all(|e| half.is_boundary_edge(e) == marks[e.index()])
        );
        // `crease` is an attribute of numbers, not a tag.
        let mut creased = shapes::cube();
        let crease = Attribute::<EdgeId, f64>::new("crease", Rule::Copy);
        creased.set(crease, vec![0.0; 12]);
        let refused = try_applied(&step(r#"(normal: (0, 0, 1), tag: "crease")"#), creased);
        assert!(matches!(refused, Err(OpError::Parameter(_))));
    }

    #[test]
    fn the_normal_is_required() {
        assert!(op::test::read::<Bisect>("()").is_err());
        assert!(op::test::read::<Bisect>("(normal: (0, 0, 0))").is_err());
        assert!(op::test::read::<Bisect>("(normal: (0, 0, 1), fill: true)").is_err());
        assert_eq!(step("(normal: (0, 0, 1))").keep, Keep::Both);
    }
}
