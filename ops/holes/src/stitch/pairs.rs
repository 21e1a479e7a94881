//! Finds pairs of boundary edges that coincide.
//!
//! Edges are sorted into a grid of cubic cells by their midpoints. If two edges coincide, their midpoints are also
//! close together. An edge is therefore compared only with the edges in its cell and the 26 neighboring cells. The
//! edges are visited in the order of their cells, so that the edges in the neighboring cells are found without a
//! search.

use mesh::{DVec3, HalfEdgeId, Mesh};
use op::{Context, OpError};

/// The boundary edges that coincide, as half-edges without a face.
pub(crate) struct Pairs {
    /// Pairs of edges that coincide only with each other, sorted by the lower half-edge id of each pair.
    pub(crate) pairs: Vec<[HalfEdgeId; 2]>,
    /// Edges that coincide with several edges, sorted by half-edge id.
    pub(crate) ambiguous: Vec<HalfEdgeId>,
}

/// A boundary half-edge, the positions of its ends, and the grid cell that contains its midpoint.
#[derive(Clone, Copy)]
struct Rim {
    cell: [i64; 3],
    /// The index of the half-edge among all boundary half-edges.
    number: usize,
    ends: [DVec3; 2],
}

/// The number of other boundary edges that coincide with an edge: none, one or several.
#[derive(Clone, Copy, PartialEq)]
enum Matches {
    None,
    One(usize),
    Several,
}

impl Pairs {
    pub(crate) fn of(mesh: &Mesh, distance: f64, cx: &Context) -> Result<Self, OpError> {
        let outer = mesh.half_edges().filter(|&h| mesh.face(h).is_none());
        let outer: Vec<HalfEdgeId> = outer.collect();
        let rims = sorted_rims(mesh, &outer, distance, cx)?;
        let total = rims.len() as u64;
        cx.advance("find coinciding edges", 0, total)?;
        let mut matches = vec![Matches::None; rims.len()];
        // The cells around an edge form nine rows of three cells. For each row, `begins` contains the index in `rims`
        // at which the edges of the row begin. The edges are visited in the order of their cells, so these indices
        // never decrease from one edge to the next.
        let mut begins = [0; 9];
        for (i, rim) in rims.iter().enumerate() {
            matches[rim.number] = matches_of(&rims, rim, &mut begins, distance);
            if (i + 1) % 4096 == 0 {
                cx.advance("find coinciding edges", i as u64 + 1, total)?;
            }
        }
        let mut result = Self {
            pairs: Vec::new(),
            ambiguous: Vec::new(),
        };
        for (i, &h) in outer.iter().enumerate() {
            match matches[i] {
                Matches::One(j) if i < j && matches[j] == Matches::One(i) => {
                    result.pairs.push([h, outer[j]]);
                }
                Matches::Several => result.ambiguous.push(h),
                Matches::One(_) | Matches::None => {}
            }
        }
        Ok(result)
    }
}

/// Returns the boundary half-edges, sorted by the grid cells that contain the midpoints of the half-edges.
fn sorted_rims(
    mesh: &Mesh,
    outer: &[HalfEdgeId],
    distance: f64,
    cx: &Context,
) -> Result<Vec<Rim>, OpError> {
    let ends = |&h: &HalfEdgeId| [mesh.origin(h), mesh.target(h)].map(|v| mesh.position(v));
    let midpoints = || outer.iter().map(|h| midpoint(ends(h)));
    let least = midpoints().reduce(DVec3::min).unwrap_or_default();
    let most = midpoints().reduce(DVec3::max).unwrap_or_default();
    // The side of a cell is twice `distance`, although `distance` would be enough without rounding. The argument of
    // `max` limits the number of cells along an axis to about 1e9, even if the distance is tiny.
    let size = (2.0 * distance).max(1e-9 * (most - least).max_element());
    let size = if size > 0.0 { size } else { 1.0 };
    let rim = |(number, h)| Rim {
        cell: cell((midpoint(ends(h)) - least) / size),
        number,
        ends: ends(h),
    };
    let mut rims: Vec<Rim> = outer.iter().enumerate().map(rim).collect();
    // Short parts are sorted first and then merged. After each part, progress is reported and the run can be canceled.
    // Two sorted parts are merged by sorting their concatenation.
    let mut width = 1 << 16;
    loop {
        for (i, part) in rims.chunks_mut(width).enumerate() {
            cx.advance(
                "sort boundary edges",
                (i * width) as u64,
                outer.len() as u64,
            )?;
            part.sort_by_key(|rim| (rim.cell, rim.number));
        }
        if width >= rims.len() {
            return Ok(rims);
        }
        width *= 2;
    }
}

/// Returns the indices of the grid cell that contains the point `place`. The unit of `place` is the side length of a
/// cell.
#[expect(clippy::cast_possible_truncation, reason = "at most 1e12")]
fn cell(place: DVec3) -> [i64; 3] {
    // The limit of 1e12 applies only if the extent of the mesh overflows. The coordinate `x` is then NaN, and `min`
    // returns 1e12.
    place.to_array().map(|x| x.floor().min(1e12) as i64)
}

/// Finds the boundary half-edges that coincide with `rim`. The cell of `rim` and its neighbors form nine rows of three
/// cells. For each row, the function searches `rims` from the index in `begins`, and stores the index at which the row
/// begins. The next call can therefore start there, if its `rim` is at a later place in `rims`.
fn matches_of(rims: &[Rim], rim: &Rim, begins: &mut [usize; 9], distance: f64) -> Matches {
    let mut matches = Matches::None;
    let [x, y, z] = rim.cell;
    let rows = (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| [x + dx, y + dy]));
    for ([x, y], begin) in rows.zip(begins) {
        let [first, last] = [[x, y, z - 1], [x, y, z + 1]];
        while rims.get(*begin).is_some_and(|other| other.cell < first) {
            *begin += 1;
        }
        let row = rims[*begin..].iter().take_while(|other| other.cell <= last);
        for other in row {
            if other.number != rim.number && coincide(rim, other, distance) {
                match matches {
                    Matches::None => matches = Matches::One(other.number),
                    _ => return Matches::Several,
                }
            }
        }
    }
    matches
}

fn midpoint(ends: [DVec3; 2]) -> DVec3 {
    0.5 * ends[0] + 0.5 * ends[1]
}

/// Whether the corresponding ends of two boundary half-edges are at most `distance` apart. Matching half-edges have
/// opposite directions.
fn coincide(a: &Rim, b: &Rim, distance: f64) -> bool {
    // The difference is divided by `distance` before it is squared, so that squares neither overflow nor underflow.
    let is_near = |p: DVec3, q: DVec3| {
        p == q || distance > 0.0 && ((p - q) / distance).length_squared() <= 1.0
    };
    is_near(a.ends[0], b.ends[1]) && is_near(a.ends[1], b.ends[0])
}
