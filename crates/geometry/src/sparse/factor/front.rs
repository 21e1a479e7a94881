//! Dense fronts (the matrices of single supernodes): assembles them, and eliminates their pivots.

use crate::sparse::symbolic::Supernode;
use mesh::parallel;

/// The number of columns of a tile. All columns of a tile are updated together. Each step takes as many pivot columns
/// as a tile has columns, and subtracts multiples of these pivot columns from each column of the tile.
const TILE: usize = 4;
/// The number of pivot columns in a block. Before a block is factored, its columns are updated in parallel, from the
/// columns of all earlier blocks.
const BLOCK: usize = 64;
/// If an update of columns takes fewer multiplications than about this number, one thread computes it.
const PARALLEL_WORK: usize = 1 << 20;

/// The matrix that the elimination of a supernode adds to the front of its parent.
pub(super) struct Update {
    /// The rows, in ascending order. The matrix is symmetric, so its columns have the same indices as its rows.
    rows: Vec<u32>,
    /// The entries of the lower triangle, column by column.
    values: Vec<f64>,
}

/// Eliminates supernodes one after another.
pub(super) struct Front {
    /// The entries of L for all supernodes that were eliminated so far, column by column.
    pub(super) values: Vec<f64>,
    /// The pivots of all supernodes that were eliminated so far.
    pub(super) pivots: Vec<f64>,
    /// For each row of the matrix, its position in the current front. The list is allocated when the first supernode is
    /// eliminated.
    place: Vec<u32>,
    n: usize,
}

impl Front {
    /// Creates an empty state for the fronts of a matrix with `n` rows.
    pub(super) fn new(n: usize) -> Self {
        Self {
            values: Vec::new(),
            pivots: Vec::new(),
            place: Vec::new(),
            n,
        }
    }

    /// Frees the memory that is not needed after the last elimination.
    pub(super) fn finish(&mut self) {
        self.place = Vec::new();
        self.values.shrink_to_fit();
    }

    /// Eliminates the pivots of a supernode. The updates of the children are taken from the end of `updates`. If the
    /// supernode has a parent, the update for the parent is appended to `updates`. If a pivot is zero, negative,
    /// infinite or NaN, returns an error with the column and the value of the pivot.
    pub(super) fn eliminate<I: Iterator<Item = (u32, f64)>>(
        &mut self,
        supernode: &Supernode,
        column: impl Fn(usize) -> I,
        updates: &mut Vec<Update>,
    ) -> Result<(), (usize, f64)> {
        let (k, m) = (supernode.columns.len(), supernode.rows.len());
        if self.place.is_empty() {
            self.place = vec![0; self.n];
        }
        for (at, &i) in (0..).zip(&supernode.rows) {
            self.place[i as usize] = at;
        }
        let start = self.values.len();
        self.values.resize(start + m * k, 0.0);
        let panel = &mut self.values[start..];
        let rest = m - k;
        let mut update = vec![0.0; rest * (rest + 1) / 2];
        for (c, j) in supernode.columns.clone().enumerate() {
            for (i, a) in column(j).filter(|&(i, _)| i as usize >= j) {
                panel[c * m + self.place[i as usize] as usize] += a;
            }
        }
        for child in updates.drain(updates.len() - supernode.n_children..) {
            let mut values = &child.values[..];
            for (c, &j) in child.rows.iter().enumerate() {
                let (column, others) = values.split_at(child.rows.len() - c);
                values = others;
                let j = self.place[j as usize] as usize;
                let target = if j < k {
                    &mut panel[j * m + j..(j + 1) * m]
                } else {
                    let start = packed_start(rest, j - k);
                    &mut update[start..start + m - j]
                };
                for (&i, &value) in child.rows[c..].iter().zip(column) {
                    target[self.place[i as usize] as usize - j] += value;
                }
            }
        }
        let pivots = self.pivots.len();
        self.pivots.resize(pivots + k, 0.0);
        let pivots = &mut self.pivots[pivots..];
        factor_panel(panel, m, pivots).map_err(|(c, d)| (supernode.columns.start + c, d))?;
        if rest > 0 {
            let tiles = tiles(&mut update, k, m, m, true);
            let subtract = |mut tile: Tile| tile.subtract(panel, m, pivots);
            if rest * rest * k < PARALLEL_WORK {
                tiles.into_iter().for_each(subtract);
            } else {
                parallel::consume(tiles, |_, tile| subtract(tile));
            }
            updates.push(Update {
                rows: supernode.rows[k..].to_vec(),
                values: update,
            });
        }
        Ok(())
    }
}

/// Returns the start of a column in a packed lower triangle with `n` rows.
fn packed_start(n: usize, column: usize) -> usize {
    column * n - column * column.saturating_sub(1) / 2
}

/// Factors a panel with `m` rows. A panel has the columns of a front that belong to the supernode. These columns are
/// replaced by columns of L, and the pivots are stored. If a pivot is zero, negative, infinite or NaN, returns an error
/// with the column and the value of the pivot.
fn factor_panel(panel: &mut [f64], m: usize, pivots: &mut [f64]) -> Result<(), (usize, f64)> {
    let k = pivots.len();
    for block in (0..k).step_by(BLOCK) {
        let end = k.min(block + BLOCK);
        let (done, open) = panel.split_at_mut(block * m);
        let open = &mut open[..(end - block) * m];
        if block > 0 {
            let tiles = tiles(open, block, end, m, false);
            let subtract = |mut tile: Tile| tile.subtract(done, m, &pivots[..block]);
            if m * (end - block) * block < PARALLEL_WORK {
                tiles.into_iter().for_each(subtract);
            } else {
                parallel::consume(tiles, |_, tile| subtract(tile));
            }
        }
        for c in block..end {
            let (column, later) = open[(c - block) * m..].split_at_mut(m);
            let d = column[c];
            // The condition is written as a negation, so that it also rejects NaN.
            if !(d > 0.0 && d.is_finite()) {
                return Err((c, d));
            }
            pivots[c] = d;
            let inverse = 1.0 / d;
            for l in &mut column[c + 1..] {
                *l *= inverse;
            }
            for (j, target) in (c + 1..end).zip(later.chunks_exact_mut(m)) {
                axpy(&mut target[j..], &column[j..], d * column[j]);
            }
        }
    }
    Ok(())
}

/// Subtracts `factor` times `column` from `target`.
fn axpy(target: &mut [f64], column: &[f64], factor: f64) {
    for (t, l) in target.iter_mut().zip(column) {
        *t -= factor * l;
    }
}

/// Some consecutive columns of a front, each from the diagonal down.
struct Tile<'a> {
    /// The index of the first column. The first entry of this column is on the diagonal, so its row has the same index.
    first: usize,
    columns: Vec<&'a mut [f64]>,
}

/// Divides the columns from `first` to `end` of a front with `m` rows into tiles. If `is_packed` is true, `values` has
/// only the part of each column from the diagonal down. Otherwise, each column in `values` starts at row 0.
fn tiles(values: &mut [f64], first: usize, end: usize, m: usize, is_packed: bool) -> Vec<Tile<'_>> {
    let mut tiles: Vec<Tile> = Vec::with_capacity((end - first).div_ceil(TILE));
    let mut rest = values;
    for j in first..end {
        let (above, below) = (if is_packed { 0 } else { j }, m - j);
        let (column, others) = rest.split_at_mut(above + below);
        rest = others;
        if (j - first).is_multiple_of(TILE) {
            let columns = Vec::with_capacity(TILE);
            tiles.push(Tile { first: j, columns });
        }
        let tile = tiles.last_mut().expect("just added");
        tile.columns.push(&mut column[above..]);
    }
    tiles
}

impl Tile<'_> {
    /// Updates the tile: subtracts products of the columns of a panel, which has `m` rows. Let l be the entries of the
    /// panel, and let d be the pivots. Entry (i, j) of the tile decreases by the sum of l(i, c) d(c) l(j, c) over the
    /// columns c of the panel.
    fn subtract(&mut self, panel: &[f64], m: usize, pivots: &[f64]) {
        let mut sources = panel.chunks_exact(m).zip(pivots);
        let first = self.first;
        if let [t0, t1, t2, t3] = &mut self.columns[..] {
            let groups = pivots.len() / TILE;
            for _ in 0..groups {
                let group: [(&[f64], f64); TILE] = std::array::from_fn(|_| {
                    let (column, &d) = sources.next().expect("counted");
                    (column, d)
                });
                subtract_4x4([t0, t1, t2, t3], first, &group);
            }
        }
        for (column, &d) in sources {
            for (j, target) in (first..).zip(&mut self.columns) {
                axpy(target, &column[j..], d * column[j]);
            }
        }
    }
}

/// Subtracts multiples of the four columns in `group` from four target columns. The target columns start at the rows
/// `first` to `first + 3`.
fn subtract_4x4(targets: [&mut [f64]; TILE], first: usize, group: &[(&[f64], f64); TILE]) {
    let factors: [[f64; TILE]; TILE] =
        std::array::from_fn(|q| std::array::from_fn(|c| group[c].1 * group[c].0[first + q]));
    let below = first + TILE;
    let [s0, s1, s2, s3] = std::array::from_fn(|c| &group[c].0[below..]);
    let mut rest: [&mut [f64]; TILE] = [&mut [], &mut [], &mut [], &mut []];
    for (q, target) in targets.into_iter().enumerate() {
        let (head, tail) = target.split_at_mut(TILE - q);
        for (i, t) in (first + q..).zip(head) {
            for ((column, _), factor) in group.iter().zip(factors[q]) {
                *t -= factor * column[i];
            }
        }
        rest[q] = tail;
    }
    let [t0, t1, t2, t3] = rest;
    let n = s0.len();
    let (s1, s2, s3) = (&s1[..n], &s2[..n], &s3[..n]);
    let (t0, t1, t2, t3) = (&mut t0[..n], &mut t1[..n], &mut t2[..n], &mut t3[..n]);
    let [f0, f1, f2, f3] = factors;
    for i in 0..n {
        let (a, b, c, d) = (s0[i], s1[i], s2[i], s3[i]);
        t0[i] -= (f0[0] * a + f0[1] * b) + (f0[2] * c + f0[3] * d);
        t1[i] -= (f1[0] * a + f1[1] * b) + (f1[2] * c + f1[3] * d);
        t2[i] -= (f2[0] * a + f2[1] * b) + (f2[2] * c + f2[3] * d);
        t3[i] -= (f3[0] * a + f3[1] * b) + (f3[2] * c + f3[3] * d);
    }
}
