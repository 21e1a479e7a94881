//! Predicts the size of a subdivided mesh before it is computed.

use std::ops::Range;

use mesh::{Domain, Mesh, VertexId, readable_bytes};

use crate::attributes;
use crate::doo_sabin::is_inner_of_valence_2;
use crate::parallel::of_blocks;
use crate::rules::{Scheme, Split};

/// The largest number of elements of one kind: the highest id is 2^32 - 2.
const MAX_ELEMENTS: u64 = u32::MAX as u64;

/// A number of elements: an exact number, or a range if the number is not known yet. The arithmetic saturates: a result
/// that is too large becomes the largest value of the type.
pub trait Count: Copy {
    /// Returns the sum of two counts.
    #[must_use]
    fn plus(self, other: Self) -> Self;

    /// Returns the difference of two counts, or 0 if it would be negative.
    #[must_use]
    fn minus(self, other: Self) -> Self;

    /// Returns `n` times this count.
    #[must_use]
    fn times(self, n: u64) -> Self;

    /// Returns the lowest possible value of this count.
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
    /// The number of vertices.
    pub vertices: N,
    /// The number of edges.
    pub edges: N,
    /// The number of faces.
    pub faces: N,
    /// The total number of corners of all faces.
    pub corners: N,
    /// The number of isolated vertices, which is the same on all levels.
    pub isolated: N,
    /// The number of inner vertices of valence 2.
    pub inner_of_valence_2: N,
    /// For each domain, the number of bytes that all attributes together take for one element. The order is: vertices,
    /// corners, edges, faces.
    pub attributes: [u64; 4],
}

impl Size {
    /// Returns the size of a mesh without deleted elements.
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
        let inner_of_valence_2 = of_blocks(mesh.n_vertices(), &|block| {
            let vertices = block.map(VertexId::new);
            vertices.filter(|&v| is_inner_of_valence_2(mesh, v)).count()
        });
        Self {
            vertices: mesh.n_vertices() as u64,
            edges: mesh.n_edges() as u64,
            faces: mesh.n_faces() as u64,
            corners: corners as u64,
            isolated: mesh.n_isolated_vertices() as u64,
            inner_of_valence_2: inner_of_valence_2.into_iter().sum::<usize>() as u64,
            attributes,
        }
    }

    /// Estimates how much the given levels of a mesh of this size add to the progress [`Meter`](progress::Meter). For
    /// most schemes, a level adds one for each new vertex, one for each old edge, and one for each new face. For Sqrt3
    /// and Doo-Sabin, a level adds one for each new vertex and one for each new edge.
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
    /// Returns the size of the mesh after one more level of a scheme. `level` is the index of this level, counted from
    /// 0.
    #[must_use]
    pub fn after(self, scheme: Scheme, level: u32) -> Self {
        let Self {
            vertices,
            edges,
            faces,
            corners,
            isolated,
            inner_of_valence_2,
            ..
        } = self;
        // Each boundary edge has one half-edge without a face. All other half-edges have a corner.
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
                // On odd levels, a face at the boundary gets two vertices on its boundary edge instead of one vertex in
                // its center.
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
                    .minus(inner_of_valence_2),
                // Isolated vertices and inner vertices of valence 2 do not become faces.
                faces
                    .plus(edges)
                    .plus(vertices.minus(isolated).minus(inner_of_valence_2)),
                corners
                    .plus(edges.times(6))
                    .plus(boundary)
                    .minus(inner_of_valence_2.times(2)),
            ],
        };
        let keeps_valence_2 = u64::from(scheme != Scheme::DooSabin);
        Self {
            vertices,
            edges,
            faces,
            corners,
            inner_of_valence_2: inner_of_valence_2.times(keeps_valence_2),
            ..self
        }
    }

    /// Returns the minimum number of bytes of the mesh, counted as [`Mesh::bytes`] does.
    pub fn bytes(self) -> u64 {
        let [vertex, corner, edge, face] = self.attributes;
        let vertices = self.vertices.least().times(28 + vertex);
        let edges = self.edges.least().times(24 + 2 * corner + edge);
        vertices
            .plus(edges)
            .plus(self.faces.least().times(4 + face))
    }

    /// Checks the size that a mesh of this size has after the given levels. There must be enough ids for all elements,
    /// and the mesh must take at most `budget` bytes.
    ///
    /// # Errors
    ///
    /// Returns [`TooLarge`] if the mesh after the last level would be too large. The error contains the highest of the
    /// given levels that is not too large, if there is one.
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
        counts.into_iter().all(|n| n <= MAX_ELEMENTS)
    }
}

/// The error for a subdivided mesh that would be too large.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("level {levels} would have {faces} faces and {}", self.excess())]
pub struct TooLarge {
    /// The highest level that was checked. Level 0 is the mesh before subdivision, and level n is the mesh after n
    /// levels.
    pub levels: u32,
    /// The number of faces at this level.
    pub faces: u64,
    /// The number of half-edges at this level.
    pub half_edges: u64,
    /// The number of bytes of the mesh at this level; `None` if the mesh would have more elements than there are ids.
    pub bytes: Option<u64>,
    /// The memory budget in bytes.
    pub budget: u64,
    /// The highest checked level whose mesh is not too large; `None` if there is no such level.
    pub fits: Option<u32>,
}

impl TooLarge {
    /// Returns the help for an error message: the highest level that fits.
    pub fn help(&self) -> String {
        match self.fits {
            Some(level) => format!("the highest level that fits is {level}"),
            None => "no level fits".to_owned(),
        }
    }

    fn excess(&self) -> String {
        match self.bytes {
            Some(bytes) => format!(
                "take {}, but the memory budget is {}",
                readable_bytes(bytes),
                readable_bytes(self.budget)
            ),
            None => format!(
                "{} half-edges, but the highest id is 2^32 - 2",
                self.half_edges
            ),
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
    fn a_level_of_loop_multiplies_the_triangles_by_four() {
        let c = icosahedron().after(LOOP, 0).after(LOOP, 1);
        assert_eq!([c.vertices, c.edges, c.faces], [162, 480, 320]);
    }

    #[test]
    fn bytes_equal_those_of_the_mesh() {
        let mut mesh = shapes::torus(5, 4, 2.0, 1.0);
        mesh.set(mesh::COLOR, vec![mesh::DVec4::ONE; mesh.n_vertices()]);
        mesh.set(mesh::MATERIAL, vec![0; mesh.n_faces()]);
        mesh.set(mesh::UV, vec![mesh::DVec2::ONE; mesh.n_half_edges()]);
        mesh.set(mesh::CREASE, vec![1.0; mesh.n_edges()]);
        assert_eq!(Size::of(&mesh).bytes(), mesh.bytes() as u64);
    }

    #[test]
    fn ids_end_before_fourteen_levels_of_an_icosahedron() {
        // The ids suffice for 60 * 4^13 = 4.03e9 half-edges, but not for 60 * 4^14.
        assert_eq!(icosahedron().check(LOOP, 0..13, u64::MAX), Ok(()));
        let too_large = icosahedron().check(LOOP, 0..14, u64::MAX).unwrap_err();
        assert_eq!(too_large.fits, Some(13));
        assert_eq!(
            too_large.to_string(),
            "level 14 would have 5368709120 faces and 16106127360 half-edges, but the highest id is 2^32 - 2"
        );
        assert_eq!(too_large.help(), "the highest level that fits is 13");
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
    fn counts_near_the_largest_integer_do_not_overflow() {
        let largest = Size {
            vertices: u64::MAX,
            edges: u64::MAX,
            faces: u64::MAX,
            corners: u64::MAX,
            isolated: 0,
            inner_of_valence_2: 0,
            attributes: [16; 4],
        };
        assert_eq!(largest.check(LOOP, 0..16, u64::MAX).unwrap_err().fits, None);
    }
}
