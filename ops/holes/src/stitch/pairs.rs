//! Which boundary edges lie on each other.
//!
//! Edges are sorted into a grid of cubes by their middles. Where the ends of two edges are near each other
//! so are their middles, so an edge is compared with those in its own and the 26 cubes around it.

use mesh::{DVec3, HalfEdgeId, Mesh};
use op::{Context, OpError};

/// The boundary edges that lie on each other, by their half-edges without a face.
pub(crate) struct Pairs {
    /// Those that lie on one other alone, in order of the lower one.
    pub(crate) pairs: Vec<[HalfEdgeId; 2]>,
    /// Those that lie on several others, in order.
    pub(crate) crowded: Vec<HalfEdgeId>,
}

/// A boundary half-edge with its ends.
struct Rim {
    half_edge: HalfEdgeId,
    ends: [DVec3; 2],
}

/// How many others lie on an edge.
#[derive(Clone, Copy, PartialEq)]
enum Others {
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
        cx.advance("find edges that lie on each other", 0, total)?;
        let mut others = Vec::with_capacity(rims.len());
        for i in 0..rims.len() {
            others.push(grid.others(&rims, i, distance));
            if others.len() % 1024 == 0 {
                cx.advance("find edges that lie on each other", i as u64, total)?;
            }
        }
        let mut found = Self {
            pairs: Vec::new(),
            crowded: Vec::new(),
        };
        for (i, rim) in rims.iter().enumerate() {
            match others[i] {
                Others::One(j) if i < j && others[j] == Others::One(i) => {
                    found.pairs.push([rim.half_edge, rims[j].half_edge]);
                }
                Others::Several => found.crowded.push(rim.half_edge),
                Others::One(_) | Others::None => {}
            }
        }
        Ok(found)
    }
}

/// Rims by the cube that their middle lies in.
struct Grid {
    least: DVec3,
    size: f64,
    /// In order of the cubes, then of the rims.
    cells: Vec<([i64; 3], usize)>,
}

impl Grid {
    fn of(rims: &[Rim], distance: f64) -> Self {
        let middles = || rims.iter().map(middle);
        let least = middles().reduce(DVec3::min).unwrap_or_default();
        let most = middles().reduce(DVec3::max).unwrap_or_default();
        // Twice the distance leaves room for rounding; and never more cubes along an axis than numbers.
        let size = (2.0 * distance).max(1e-9 * (most - least).max_element());
        let mut grid = Self {
            least,
            size: if size > 0.0 { size } else { 1.0 },
            cells: Vec::new(),
        };
        grid.cells = middles().map(|p| grid.cell(p)).zip(0..).collect();
        grid.cells.sort_unstable();
        grid
    }

    #[expect(clippy::cast_possible_truncation, reason = "at most 1e12")]
    fn cell(&self, p: DVec3) -> [i64; 3] {
        let place = (p - self.least) / self.size;
        // Above 1e9 only where the numbers of the cubes overflow: all of these are in one row.
        place.to_array().map(|x| x.floor().min(1e12) as i64)
    }

    /// The rims that lie on rim `i`.
    fn others(&self, rims: &[Rim], i: usize, distance: f64) -> Others {
        let mut found = Others::None;
        let [x, y, z] = self.cell(middle(&rims[i]));
        for (dx, dy) in (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (dx, dy))) {
            let [first, last] = [z - 1, z + 1].map(|z| [x + dx, y + dy, z]);
            let begin = self.cells.partition_point(|(cell, _)| *cell < first);
            let row = self.cells[begin..].iter();
            for &(_, j) in row.take_while(|(cell, _)| *cell <= last) {
                if i != j && lie_on_each_other(&rims[i], &rims[j], distance) {
                    match found {
                        Others::None => found = Others::One(j),
                        _ => return Others::Several,
                    }
                }
            }
        }
        found
    }
}

fn middle(rim: &Rim) -> DVec3 {
    0.5 * rim.ends[0] + 0.5 * rim.ends[1]
}

/// Whether each end of the one is near that of the other; they run against each other.
fn lie_on_each_other(a: &Rim, b: &Rim, distance: f64) -> bool {
    // Divided first, so that no square overflows or vanishes where it matters.
    let is_near = |p: DVec3, q: DVec3| {
        p == q || distance > 0.0 && ((p - q) / distance).length_squared() <= 1.0
    };
    is_near(a.ends[0], b.ends[1]) && is_near(a.ends[1], b.ends[0])
}
