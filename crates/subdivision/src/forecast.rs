//! How large a mesh becomes, known before anything is computed.

use std::{fmt, ops};

use mesh::{Domain, Mesh, VertexId};
use op::{MeshPlan, Range};
use rayon::prelude::*;

use crate::doo_sabin::has_two_edges_inside;
use crate::{Scheme, Split};

/// Ids end at 2^32 - 2, so this many elements of a kind can be numbered.
const IDS: u64 = u32::MAX as u64;

/// The size of a mesh. Numbers that do not fit into 64 bits stay at the highest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Size {
    pub(crate) vertices: Range,
    pub(crate) edges: Range,
    pub(crate) faces: Range,
    /// The corners of all faces.
    corners: Range,
    /// The vertices without an edge. They stay so.
    isolated: Range,
    /// The vertices inside that have two edges.
    with_two_edges: Range,
    /// The bytes of all attributes of one vertex, corner, edge and face.
    attributes: [u64; 4],
}

impl Size {
    /// The size of an existing mesh.
    pub(crate) fn of(mesh: &Mesh) -> Self {
        let attributes = Domain::ALL.map(|domain| {
            let columns = mesh.attributes().of(domain).iter();
            columns
                .filter(|column| crate::attributes::is_carried(column))
                .map(|column| column.values.gather(1, |_| None).bytes() as u64)
                .sum()
        });
        let faces = mesh.connectivity().face.iter();
        let corners = faces.filter(|f| f.some().is_some()).count();
        let with_two_edges = (0..mesh.n_vertices())
            .into_par_iter()
            .filter(|&i| has_two_edges_inside(mesh, VertexId::new(i)))
            .count();
        Self {
            vertices: Range::exactly(mesh.n_vertices() as u64),
            edges: Range::exactly(mesh.n_edges() as u64),
            faces: Range::exactly(mesh.n_faces() as u64),
            corners: Range::exactly(corners as u64),
            isolated: Range::exactly(mesh.n_isolated_vertices() as u64),
            with_two_edges: Range::exactly(with_two_edges as u64),
            attributes,
        }
    }

    /// The size of a planned mesh: attributes count as in [`MeshPlan::bytes`].
    pub(crate) fn of_plan(plan: &MeshPlan) -> Self {
        let attributes = Domain::ALL.map(|domain| {
            let columns = plan.attributes.iter().filter(|a| a.domain == domain);
            16 * columns.count() as u64
        });
        let halves = plan.edges.by(2);
        Self {
            vertices: plan.vertices,
            edges: plan.edges,
            faces: plan.faces,
            corners: plan.faces.times(plan.degrees).capped(Range {
                min: u64::MAX,
                max: halves.max,
            }),
            isolated: plan.vertices.or_less(),
            with_two_edges: plan.vertices.or_less(),
            attributes,
        }
    }

    /// The size after level number `level` (from 0) of a scheme.
    pub(crate) fn after(self, scheme: Scheme, level: u32) -> Self {
        let Self {
            vertices,
            edges,
            faces,
            corners,
            isolated,
            with_two_edges,
            ..
        } = self;
        // Each edge of the boundary has one half without a face.
        let boundary = edges.by(2).minus(corners);
        let [vertices, edges, faces, corners] = match scheme {
            Scheme::Loop(_) | Scheme::Butterfly | Scheme::Midpoint(Split::Triangles) => [
                vertices.plus(edges),
                edges.by(2).plus(corners),
                faces.by(4),
                corners.by(4),
            ],
            Scheme::CatmullClark | Scheme::Midpoint(Split::Quads) => [
                vertices.plus(edges).plus(faces),
                edges.by(2).plus(corners),
                corners,
                corners.by(4),
            ],
            Scheme::Sqrt3 if level.is_multiple_of(2) => [
                vertices.plus(faces),
                edges.plus(corners),
                faces.by(3),
                corners.by(3),
            ],
            // Faces at the boundary get two vertices on it and none in the middle.
            Scheme::Sqrt3 => [
                vertices.plus(faces).plus(boundary),
                edges.plus(corners).plus(boundary),
                faces.by(3),
                corners.by(3),
            ],
            Scheme::DooSabin => [
                corners.plus(boundary.by(2)).plus(isolated),
                corners
                    .plus(edges.by(2))
                    .plus(boundary.by(2))
                    .minus(with_two_edges),
                // Vertices without an edge, and inside with two, become no face.
                faces
                    .plus(edges)
                    .plus(vertices.minus(isolated).minus(with_two_edges)),
                corners
                    .plus(edges.by(6))
                    .plus(boundary)
                    .minus(with_two_edges.by(2)),
            ],
        };
        Self {
            vertices,
            edges,
            faces,
            corners,
            with_two_edges: match scheme {
                Scheme::DooSabin => Range::exactly(0),
                _ => with_two_edges,
            },
            ..self
        }
    }

    /// This size or another one.
    pub(crate) fn or(self, other: Self) -> Self {
        Self {
            vertices: self.vertices.or(other.vertices),
            edges: self.edges.or(other.edges),
            faces: self.faces.or(other.faces),
            corners: self.corners.or(other.corners),
            with_two_edges: self.with_two_edges.or(other.with_two_edges),
            ..self
        }
    }

    /// How much these levels, of which the first begins here, add to the [`Meter`](crate::meter::Meter): about one for each new
    /// vertex, and one for each old edge and new face or, in schemes of other edges, for each new edge.
    pub(crate) fn work(self, scheme: Scheme, levels: ops::Range<u32>) -> u64 {
        let (mut size, mut sum) = (self, 0_u64);
        for level in levels {
            let next = size.after(scheme, level);
            let counts = match scheme {
                Scheme::Sqrt3 | Scheme::DooSabin => [next.vertices, next.edges, Range::exactly(0)],
                _ => [next.vertices, size.edges, next.faces],
            };
            for n in counts {
                sum = sum.saturating_add(n.max);
            }
            size = next;
        }
        sum
    }

    /// The least bytes that the mesh takes, as [`Mesh::bytes`] counts them.
    pub(crate) fn bytes(self) -> u64 {
        let [vertex, corner, edge, face] = self.attributes;
        [
            self.vertices.min.saturating_mul(28 + vertex),
            self.edges.min.saturating_mul(24 + 2 * corner + edge),
            self.faces.min.saturating_mul(4 + face),
        ]
        .into_iter()
        .fold(0, u64::saturating_add)
    }

    /// Whether the mesh after these levels, of which the first begins here, has ids for all elements and
    /// stays within the budget, in bytes.
    pub(crate) fn check(
        self,
        scheme: Scheme,
        levels: ops::Range<u32>,
        budget: u64,
    ) -> Result<(), TooLarge> {
        let mut size = self;
        let mut fits = None;
        for level in levels.start..=levels.end {
            if size.has_ids() && size.bytes() <= budget {
                fits = Some(level);
            }
            if level < levels.end {
                size = size.after(scheme, level);
            }
        }
        if fits == Some(levels.end) {
            return Ok(());
        }
        Err(size.too_large(levels.end, budget, fits))
    }

    /// Whether the mesh of this level, with the attributes of this one and these numbers of vertices, edges
    /// and faces, has ids for all elements and stays within the budget.
    pub(crate) fn check_counts(
        self,
        [vertices, edges, faces]: [u64; 3],
        level: u32,
        budget: u64,
    ) -> Result<(), TooLarge> {
        let result = Self {
            vertices: Range::exactly(vertices),
            edges: Range::exactly(edges),
            faces: Range::exactly(faces),
            ..self
        };
        if result.has_ids() && result.bytes() <= budget {
            return Ok(());
        }
        Err(result.too_large(level, budget, None))
    }

    fn too_large(self, levels: u32, budget: u64, fits: Option<u32>) -> TooLarge {
        TooLarge {
            levels,
            faces: self.faces.min,
            half_edges: self.edges.min.saturating_mul(2),
            bytes: self.has_ids().then(|| self.bytes()),
            budget,
            fits,
        }
    }

    fn has_ids(self) -> bool {
        self.vertices.min <= IDS && self.edges.min.saturating_mul(2) <= IDS && self.faces.min <= IDS
    }
}

/// The mesh would be too large.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct TooLarge {
    levels: u32,
    faces: u64,
    half_edges: u64,
    /// What the mesh takes; `None` if it has no ids for all elements.
    bytes: Option<u64>,
    budget: u64,
    /// The highest level that would do; `None` if the mesh itself is beyond the budget.
    pub(crate) fits: Option<u32>,
}

impl TooLarge {
    /// What is wrong.
    pub(crate) fn message(&self) -> String {
        let many = format!("level {} has {} faces", self.levels, self.faces);
        if let Some(bytes) = self.bytes {
            let budget = self.budget;
            format!("{many} and takes {bytes} bytes, but the budget is {budget}")
        } else {
            let half_edges = self.half_edges;
            format!("{many} and {half_edges} half-edges, but ids end at 2^32 - 2")
        }
    }

    /// The way out.
    pub(crate) fn help(&self) -> String {
        match self.fits {
            Some(level) => format!("level {level} fits"),
            None => "no level fits".to_owned(),
        }
    }
}

impl fmt::Display for TooLarge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}; {}", self.message(), self.help())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::LoopWeights;
    use geometry::shapes;

    const LOOP: Scheme = Scheme::Loop(LoopWeights::Warren);

    fn icosahedron() -> Size {
        Size::of(&shapes::icosahedron())
    }

    #[test]
    fn a_level_of_loop_has_four_times_the_triangles() {
        let c = icosahedron().after(LOOP, 0).after(LOOP, 1);
        let counts = [c.vertices, c.edges, c.faces].map(|n| n.min);
        assert_eq!(counts, [162, 480, 320]);
    }

    #[test]
    fn bytes_are_those_of_the_mesh() {
        let mut mesh = shapes::torus(5, 4, 2.0, 1.0);
        mesh.set(mesh::COLOR, vec![mesh::DVec4::ONE; mesh.n_vertices()]);
        mesh.set(mesh::MATERIAL, vec![0; mesh.n_faces()]);
        mesh.set(mesh::UV, vec![mesh::DVec2::ONE; mesh.n_half_edges()]);
        mesh.set(mesh::CREASE, vec![1.0; mesh.n_edges()]);
        assert_eq!(Size::of(&mesh).bytes(), mesh.bytes() as u64);
    }

    #[test]
    fn ids_end_before_fourteen_levels_of_an_icosahedron() {
        // 60 * 4^13 half-edges are 4.03e9, which ids can number; 60 * 4^14 are not.
        assert_eq!(icosahedron().check(LOOP, 0..13, u64::MAX), Ok(()));
        let too_large = icosahedron().check(LOOP, 0..14, u64::MAX).unwrap_err();
        assert_eq!(too_large.fits, Some(13));
        assert_eq!(
            too_large.to_string(),
            "level 14 has 5368709120 faces and 16106127360 half-edges, but ids end at 2^32 - 2; \
             level 13 fits"
        );
    }

    #[test]
    fn a_budget_of_the_exact_bytes_fits_and_one_byte_less_does_not() {
        let bytes = (0..3)
            .fold(icosahedron(), |s, level| s.after(LOOP, level))
            .bytes();
        assert_eq!(icosahedron().check(LOOP, 0..3, bytes), Ok(()));
        let too_large = icosahedron().check(LOOP, 0..3, bytes - 1).unwrap_err();
        assert_eq!(too_large.fits, Some(2));
        assert!(too_large.message().contains("budget"), "{too_large}");
        assert_eq!(icosahedron().check(LOOP, 0..1, 100).unwrap_err().fits, None);
    }

    #[test]
    fn a_nearly_endless_mesh_is_too_large_without_overflow() {
        let endless = Size {
            vertices: Range::exactly(u64::MAX),
            edges: Range::exactly(u64::MAX),
            faces: Range::exactly(u64::MAX),
            corners: Range::exactly(u64::MAX),
            isolated: Range::exactly(0),
            with_two_edges: Range::exactly(0),
            attributes: [16; 4],
        };
        assert_eq!(endless.check(LOOP, 0..16, u64::MAX).unwrap_err().fits, None);
    }
}
