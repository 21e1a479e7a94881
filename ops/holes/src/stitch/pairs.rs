//! Finds pairs of boundary edges that coincide.
//!
//! Edges are sorted into a grid of cubic cells by their midpoints. If the ends of two edges are close together, so are
//! their midpoints. An edge is therefore compared only with the edges in its cell and the 26 neighboring cells.

use mesh::{DVec3, HalfEdgeId, Mesh};
use op::{Context, OpError};

/// The boundary edges that coincide, as half-edges without a face.
pub(crate) struct Pairs {
    /// Pairs of edges that coincide only with each other, in order of the lower half-edge.
    pub(crate) pairs: Vec<[HalfEdgeId; 2]>,
    /// Edges that coincide with several edges, in order of the half-edges.
    pub(crate) ambiguous: Vec<HalfEdgeId>,
}

/// A boundary half-edge with its ends.
struct Rim {
    half_edge: HalfEdgeId,
    ends: [DVec3; 2],
}

/// The boundary edges that coincide with an edge.
#[derive(Clone, Copy, PartialEq)]
enum Matches {
    None,
    One(usize),
    Several,
}

impl Pairs {
    pub(crate) fn of(mesh: &Mesh, distance: f64, cx: &Context) -> Result<Self, OpError> {
        let rim = |h| Rim {
            half_edge: h,
            ends: [mesh.origin(h), mesh.target(h)].map(|v| mesh.position(v)),
        };
        let outer = mesh.half_edges().filter(|&h| mesh.face(h).is_none());
        let rims: Vec<Rim> = outer.map(rim).collect();
        let grid = Grid::of(&rims, distance);
        let total = rims.len() as u64;
        cx.advance("find coinciding edges", 0, total)?;
        let mut matches = Vec::with_capacity(rims.len());
        for i in 0..rims.len() {
            matches.push(grid.matches(&rims, i, distance));
            if matches.len() % 1024 == 0 {
                cx.advance("find coinciding edges", i as u64, total)?;
            }
        }
        let mut result = Self {
            pairs: Vec::new(),
            ambiguous: Vec::new(),
        };
        for (i, rim) in rims.iter().enumerate() {
            match matches[i] {
                Matches::One(j) if i < j && matches[j] == Matches::One(i) => {
                    result.pairs.push([rim.half_edge, rims[j].half_edge]);
                }
                Matches::Several => result.ambiguous.push(rim.half_edge),
                Matches::One(_) | Matches::None => {}
            }
        }
        Ok(result)
    }
}

/// Boundary half-edges, sorted by the grid cells of their midpoints.
struct Grid {
    least: DVec3,
    size: f64,
    /// Cells and indices of half-edges, in order of the cells, then of the indices.
    cells: Vec<([i64; 3], usize)>,
}

impl Grid {
    fn of(rims: &[Rim], distance: f64) -> Self {
        let midpoints = || rims.iter().map(midpoint);
        let least = midpoints().reduce(DVec3::min).unwrap_or_default();
        let most = midpoints().reduce(DVec3::max).unwrap_or_default();
        // Cells of twice the distance leave room for rounding. The second term limits the number of cells along an
        // axis.
        let size = (2.0 * distance).max(1e-9 * (most - least).max_element());
        let mut grid = Self {
            least,
            size: if size > 0.0 { size } else { 1.0 },
            cells: Vec::new(),
        };
        grid.cells = midpoints().map(|p| grid.cell(p)).zip(0..).collect();
        grid.cells.sort_unstable();
        grid
    }

    #[expect(clippy::cast_possible_truncation, reason = "at most 1e12")]
    fn cell(&self, p: DVec3) -> [i64; 3] {
        let place = (p - self.least) / self.size;
        // The limit applies only where the division overflows: all of these points are in the last cell.
        place.to_array().map(|x| x.floor().min(1e12) as i64)
    }

    /// Returns the boundary half-edges that coincide with half-edge `i` of `rims`.
    fn matches(&self, rims: &[Rim], i: usize, distance: f64) -> Matches {
        let mut matches = Matches::None;
        let [x, y, z] = self.cell(midpoint(&rims[i]));
        for (dx, dy) in (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (dx, dy))) {
            let [first, last] = [z - 1, z + 1].map(|z| [x + dx, y + dy, z]);
            let begin = self.cells.partition_point(|(cell, _)| *cell < first);
            let row = self.cells[begin..].iter();
            for &(_, j) in row.take_while(|(cell, _)| *cell <= last) {
                if i != j && coincide(&rims[i], &rims[j], distance) {
                    match matches {
                        Matches::None => matches = Matches::One(j),
                        _ => return Matches::Several,
                    }
                }
            }
        }
        matches
    }
}

fn midpoint(rim: &Rim) -> DVec3 {
    0.5 * rim.ends[0] + 0.5 * rim.ends[1]
}

/// Whether corresponding ends are within `distance`. Matching half-edges have opposite directions.
fn coincide(a: &Rim, b: &Rim, distance: f64) -> bool {
    // Divides before squaring, so that squares neither overflow nor underflow.
    let is_near = |p: DVec3, q: DVec3| {
        p == q || distance > 0.0 && ((p - q) / distance).length_squared() <= 1.0
    };
    is_near(a.ends[0], b.ends[1]) && is_near(a.ends[1], b.ends[0])
}
