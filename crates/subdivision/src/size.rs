//! How large a mesh becomes, known before anything is computed.

use std::ops::Range;

use mesh::{Domain, Mesh, VertexId};

use crate::attributes;
use crate::parallel::of_blocks;
use crate::rules::{Scheme, Split};

/// Ids end at 2^32 - 2, so this many elements of a kind can be numbered.
const IDS: u64 = u32::MAX as u64;

/// A number of elements: one that is known, or a range for planning. Numbers that do not fit stay at the highest.
pub trait Count: Copy {
    /// The sum of two counts.
    #[must_use]
    fn plus(self, other: Self) -> Self;

    /// This count without another one, not below 0.
    #[must_use]
    fn minus(self, other: Self) -> Self;

    /// `n` times this count.
    #[must_use]
    fn times(self, n: u64) -> Self;

    /// The lowest value.
    fn least(self) -> u64;
}

impl Count for u64 {
    fn plus(self, other: Self) -> Self {
        self.saturating_add(other)
    }

    fn minus(self, other: Self) -> Self {
        self.saturating_sub(other)
    }

    fn times(self, n: u64) -> Self {
        self.saturating_mul(n)
    }

    fn least(self) -> u64 {
        self
    }
}

/// The size of a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size<N = u64> {
    /// How many vertices there are.
    pub vertices: N,
    /// How many edges.
    pub edges: N,
    /// How many faces.
    pub faces: N,
    /// The corners of all faces.
    pub corners: N,
    /// The vertices without an edge. They stay so.
    pub isolated: N,
    /// The vertices inside that have two edges.
    pub with_two_edges: N,
    /// The bytes of all attributes of one vertex, corner, edge and face.
    pub attributes: [u64; 4],
}

/// Whether `v` is inside and has two edges.
pub(crate) fn has_two_edges_inside(mesh: &Mesh, v: VertexId) -> bool {
    mesh.vertex_half_edge(v).is_some_and(|h| {
        let k = mesh.next(h.twin());
        mesh.face(h).is_some() && mesh.next(k.twin()) == h
    })
}

impl Size {
    /// The size of a dense mesh.
    pub fn of(mesh: &Mesh) -> Self {
        let attributes = Domain::ALL.map(|domain| {
            let columns = mesh.attributes().of(domain).iter();
            columns
                .filter(|column| attributes::is_carried(column))
                .map(|column| attributes::gathered(column, 1, &|_| None).bytes() as u64)
                .sum()
        });
        let faces = mesh.connectivity().face.iter();
        let corners = faces.filter(|f| f.some().is_some()).count();
        let with_two_edges = of_blocks(mesh.n_vertices(), &|block| {
            let vertices = block.map(VertexId::new);
            vertices.filter(|&v| has_two_edges_inside(mesh, v)).count()
        });
        Self {
            vertices: mesh.n_vertices() as u64,
            edges: mesh.n_edges() as u64,
            faces: mesh.n_faces() as u64,
            corners: corners as u64,
            isolated: mesh.n_isolated_vertices() as u64,
            with_two_edges: with_two_edges.into_iter().sum::<usize>() as u64,
            attributes,
        }
    }

    /// How much these levels, of which the first begins here, add to the [`Meter`](progress::Meter): about one for
    /// each new vertex, and one for each old edge and new face or, in schemes of other edges, for each new edge.
    pub(crate) fn work(self, scheme: Scheme, levels: Range<u32>) -> u64 {
        let (mut size, mut sum) = (self, 0);
        for level in levels {
            let next = size.after(scheme, level);
            let elements = match scheme {
                Scheme::Sqrt3 | Scheme::DooSabin => next.edges,
                _ => size.edges.plus(next.faces),
            };
            sum = sum.plus(next.vertices).plus(elements);
            size = next;
        }
        sum
    }
}

impl<N: Count> Size<N> {
    /// The size after level number `level` (from 0) of a scheme.
    #[must_use]
    pub fn after(self, scheme: Scheme, level: u32) -> Self {
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
        let boundary = edges.times(2).minus(corners);
        let [vertices, edges, faces, corners] = match scheme {
            Scheme::Loop(_) | Scheme::Butterfly | Scheme::Midpoint(Split::Triangles) => [
                vertices.plus(edges),
                edges.times(2).plus(corners),
                faces.times(4),
                corners.times(4),
            ],
            Scheme::CatmullClark | Scheme::Midpoint(Split::Quads) => [
                vertices.plus(edges).plus(faces),
                edges.times(2).plus(corners),
                corners,
                corners.times(4),
            ],
            Scheme::Sqrt3 => {
                // On odd levels faces at the boundary get two vertices on it and none in the middle.
                let cut = boundary.times(u64::from(level % 2));
                [
                    vertices.plus(faces).plus(cut),
                    edges.plus(corners).plus(cut),
                    faces.times(3),
                    corners.times(3),
                ]
            }
            Scheme::DooSabin => [
                corners.plus(boundary.times(2)).plus(isolated),
                corners
                    .plus(edges.times(2))
                    .plus(boundary.times(2))
                    .minus(with_two_edges),
                // Vertices without an edge, and inside with two, become no face.
                faces
                    .plus(edges)
                    .plus(vertices.minus(isolated).minus(with_two_edges)),
                corners
                    .plus(edges.times(6))
                    .plus(boundary)
                    .minus(with_two_edges.times(2)),
            ],
        };
        let stay = u64::from(scheme != Scheme::DooSabin);
        Self {
            vertices,
            edges,
            faces,
            corners,
            with_two_edges: with_two_edges.times(stay),
            ..self
        }
    }

    /// The least bytes that the mesh takes, as [`Mesh::bytes`] counts them.
    pub fn bytes(self) -> u64 {
        let [vertex, corner, edge, face] = self.attributes;
        let vertices = self.vertices.least().times(28 + vertex);
        let edges = self.edges.least().times(24 + 2 * corner + edge);
        vertices
            .plus(edges)
            .plus(self.faces.least().times(4 + face))
    }

    /// Checks that the mesh after these levels, of which the first begins here, has ids for all elements and
    /// takes at most `budget` bytes.
    ///
    /// # Errors
    ///
    /// [`TooLarge`] with the highest level that fits.
    pub fn check(self, scheme: Scheme, levels: Range<u32>, budget: u64) -> Result<(), TooLarge> {
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
        Err(TooLarge {
            levels: levels.end,
            faces: size.faces.least(),
            half_edges: size.edges.least().times(2),
            bytes: size.has_ids().then(|| size.bytes()),
            budget,
            fits,
        })
    }

    fn has_ids(self) -> bool {
        let half_edges = self.edges.least().times(2);
        let counts = [self.vertices.least(), half_edges, self.faces.least()];
        counts.into_iter().all(|n| n <= IDS)
    }
}

/// The mesh would be too large.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("level {levels} has {faces} faces and {}", self.excess())]
pub struct TooLarge {
    /// The level at which it is.
    pub levels: u32,
    /// How many faces it has there.
    pub faces: u64,
    /// How many half-edges.
    pub half_edges: u64,
    /// The bytes that it takes; `None` if it has no ids for all elements.
    pub bytes: Option<u64>,
    /// How many bytes it may take.
    pub budget: u64,
    /// The highest level that fits, if any.
    pub fits: Option<u32>,
}

impl TooLarge {
    /// Which levels fit.
    pub fn help(&self) -> String {
        match self.fits {
            Some(level) => format!("level {level} fits"),
            None => "no level fits".to_owned(),
        }
    }

    fn excess(&self) -> String {
        match self.bytes {
            Some(bytes) => format!("takes {bytes} bytes, but the budget is {}", self.budget),
            None => format!("{} half-edges, but ids end at 2^32 - 2", self.half_edges),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rules::LoopWeights;
    use geometry::shapes;

    const LOOP: Scheme = Scheme::Loop(LoopWeights::Warren);

    fn icosahedron() -> Size {
        Size::of(&shapes::icosahedron())
    }

    #[test]
    fn a_level_of_loop_has_four_times_the_triangles() {
        let c = icosahedron().after(LOOP, 0).after(LOOP, 1);
        assert_eq!([c.vertices, c.edges, c.faces], [162, 480, 320]);
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
            "level 14 has 5368709120 faces and 16106127360 half-edges, but ids end at 2^32 - 2"
        );
        assert_eq!(too_large.help(), "level 13 fits");
    }

    #[test]
    fn a_budget_of_the_exact_bytes_fits_and_one_byte_less_does_not() {
        let bytes = (0..3)
            .fold(icosahedron(), |s, level| s.after(LOOP, level))
            .bytes();
        assert_eq!(icosahedron().check(LOOP, 0..3, bytes), Ok(()));
        let too_large = icosahedron().check(LOOP, 0..3, bytes - 1).unwrap_err();
        assert_eq!(too_large.fits, Some(2));
        assert!(too_large.to_string().contains("budget"), "{too_large}");
        assert_eq!(icosahedron().check(LOOP, 0..1, 100).unwrap_err().fits, None);
    }

    #[test]
    fn a_nearly_endless_mesh_is_too_large_without_overflow() {
        let endless = Size {
            vertices: u64::MAX,
            edges: u64::MAX,
            faces: u64::MAX,
            corners: u64::MAX,
            isolated: 0,
            with_two_edges: 0,
            attributes: [16; 4],
        };
        assert_eq!(endless.check(LOOP, 0..16, u64::MAX).unwrap_err().fits, None);
    }
}
