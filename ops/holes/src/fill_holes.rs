//! Fill holes: covers each hole with a face or with triangles.
//!
//! ```text
//!    +-----+-----+          +-----+-----+          +-----+-----+
//!    |           |          |           |          | \       / |
//!    |   hole    |   -->    |   Face    |    or    |   \   /   |    Triangles with the smallest area
//!    |           |          |           |          |     \/    |
//!    +-----+-----+          +-----+-----+          +-----+-----+
//! ```

use mesh::{CORNER_NORMAL, Domain, HalfEdgeId, VERTEX_NORMAL};
use op::prelude::*;

/// Covers holes with faces.
///
/// A hole is a boundary loop: a closed loop of edges, each of which has a face on one side only. The outer rim of an
/// open sheet is also a boundary loop; use `around` or `max_edges` to exclude it. No vertices are added, and existing
/// elements keep their ids. With `with: Face`, a hole with n edges gets one face with n corners. With
/// `with: Triangles`, the hole gets n - 2 triangles and n - 3 new edges.
///
/// For holes with up to 500 edges, the triangles have the smallest possible total area. A hole with more than 500 edges
/// is filled one triangle at a time. Each triangle cuts off a corner of the remaining hole: the corner whose two
/// neighboring vertices are closest to each other. Straight and reflex corners are cut off last. If the large hole is
/// far from convex, the triangles can overlap. In holes of any size, a new edge never joins two vertices that an
/// existing edge already joins. If the step finds no triangulation without duplicate edges, the hole is not filled
/// (reason: `DuplicateEdge`). A hole with only two edges cannot be filled (reason: `WrongPlace`). To close a hole with
/// two edges, use `Stitch`.
///
/// New faces have the values of a face beside the hole. A new corner has the values of an existing corner at the same
/// vertex. Normals are dropped if a hole was filled.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct FillHoles {
    /// Fill only holes with at least one of these vertices.
    #[serde(default)]
    pub around: VertexSelection,
    /// Fill only holes with at most this number of edges. If omitted, holes with any number of edges are filled.
    #[serde(default)]
    pub max_edges: Option<Count<3>>,
    /// The faces that cover a hole.
    #[serde(default)]
    pub with: Cover,
    /// What to do when a hole cannot be filled.
    #[serde(default)]
    pub on_refusal: OnRefusal,
}

/// The faces that cover a hole.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Cover {
    /// Triangles. In holes with up to 500 edges, the triangles have the smallest possible total area.
    #[default]
    Triangles,
    /// One face with all vertices of the hole as corners.
    Face,
}

impl MeshOperation for FillHoles {
    const NAME: &'static str = "FillHoles";
    const SUMMARY: &'static str = "Fill holes with a face or with triangles";
    const EXAMPLE: &'static str = "FillHoles()";
    const WORDS: &'static [&'static str] = &["hole", "close", "cap", "repair"];

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        // A filled hole has at least three edges, and an edge belongs to at most one hole. So the number of filled
        // holes is at most a third of the number of edges.
        match self.with {
            Cover::Face => {
                let corners = self.max_edges.map_or(u64::MAX, |most| most.get().into());
                plan.faces = plan.faces.plus(Range::at_most(plan.edges.max / 3));
                plan.degrees.max = plan.degrees.max.max(corners.min(plan.edges.max));
            }
            Cover::Triangles => {
                let most = plan.edges.or_less();
                plan.grow(Range::exactly(0), most, most);
            }
        }
        plan.degrees.min = plan.degrees.min.min(3);
        for attribute in &mut plan.attributes {
            let normal = match attribute.domain {
                Domain::Vertex => VERTEX_NORMAL.name,
                Domain::Corner => CORNER_NORMAL.name,
                Domain::Edge | Domain::Face => continue,
            };
            attribute.certain &= attribute.name != normal;
        }
        Vec::new()
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        let is_around = self.around.mask(mesh, cx)?;
        let mut holes = mesh.boundary_loops();
        holes.retain(|&h| {
            let mut rim = mesh.loop_half_edges(h);
            rim.any(|h| is_around[mesh.origin(h).index()])
        });
        let chosen = holes.len();
        if let Some(most) = self.max_edges {
            holes.retain(|&h| mesh.loop_half_edges(h).count() <= most.get() as usize);
        }
        let too_large = chosen - holes.len();
        let report = edit_each(mesh, &holes, self.on_refusal, "fill", cx, |mesh, h| {
            self.fill(mesh, h)
        })?;
        if report.changed > 0 {
            mesh.remove_normals();
        }
        Ok(report.count("holes with more edges than `max_edges`", too_large))
    }
}

impl FillHoles {
    fn fill(&self, mesh: &mut Mesh, h: HalfEdgeId) -> Result<(), mesh::EditError> {
        match self.with {
            Cover::Face => mesh.fill_hole(h).map(drop),
            Cover::Triangles => geometry::fill_hole_triangles(mesh, h).map(drop),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use mesh::{DVec3, FaceId};
    use op::test::{applied, try_applied};

    fn parse(text: &str) -> FillHoles {
        op::test::read(text).unwrap()
    }

    /// Returns a torus with a hole of 4 edges, a hole of 6 edges, and normals.
    fn torus() -> Mesh {
        let mut mesh = shapes::torus(8, 6, 2.0, 1.0);
        for f in [0, 20, 21] {
            mesh.delete_face(FaceId::new(f)).unwrap();
        }
        mesh.compact();
        mesh.set(VERTEX_NORMAL, vec![DVec3::Z; mesh.n_vertices()]);
        mesh
    }

    #[test]
    fn a_tube_is_closed_with_faces_or_with_triangles() {
        let tube = shapes::cylinder(6, false);
        let faces = applied(&parse("(with: Face)"), tube.clone());
        assert!(faces.is_closed());
        assert_eq!((faces.n_faces(), faces.n_edges()), (8, 18));
        let triangles = applied(&parse("()"), tube);
        assert!(triangles.is_closed());
        assert_eq!((triangles.n_faces(), triangles.n_edges()), (14, 24));
        assert!(
            (geometry::volume(&triangles) - geometry::volume(&shapes::cylinder(6, true))).abs()
                < 1e-12
        );
    }

    #[test]
    fn only_the_selected_holes_are_filled() {
        let small = try_applied(&parse("(max_edges: Some(4), with: Face)"), torus()).unwrap();
        assert_eq!(small.0.n_boundary_loops(), 1);
        assert_eq!(small.1.notes, ["holes with more edges than `max_edges`: 1"]);
        let rim = torus().boundary_loops()[0];
        let v = torus().origin(rim).index();
        let near = parse(&format!("(around: Vertices([{v}]), with: Face)"));
        let (mesh, report) = try_applied(&near, torus()).unwrap();
        assert_eq!((mesh.n_boundary_loops(), report.changed), (1, 1));
    }

    #[test]
    fn normals_are_dropped_if_a_hole_is_filled_and_nothing_changes_otherwise() {
        let filled = applied(&parse("()"), torus());
        assert!(filled.is_closed());
        assert!(filled.get(VERTEX_NORMAL).is_none());
        let (same, report) = try_applied(&parse("(max_edges: Some(3))"), torus()).unwrap();
        assert_eq!(same, torus());
        assert_eq!(report.changed, 0);
    }

    #[test]
    fn unknown_fields_are_errors() {
        assert!(
            op::test::read::<FillHoles>("(around: Boundary, with: Face, on_refusal: Skip)").is_ok()
        );
        assert!(op::test::read::<FillHoles>("(with: Quads)").is_err());
        assert!(op::test::read::<FillHoles>("(max: 3)").is_err());
        assert_eq!(parse("()").with, Cover::Triangles);
    }
}
