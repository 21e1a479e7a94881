//! The numerical factorization L D Lᵀ, and the solution of equations.
//!
//! Each supernode has a front: a dense symmetric matrix of the rows of the supernode. The front is the sum of two
//! parts. The first part has the entries of the matrix in the columns of the supernode. The second part is the sum of
//! the updates U from the children of the supernode in the tree. Eliminating the pivots P gives the columns of L and
//! the update for the parent:
//!
//! ```text
//!     | P      |   pivots        | L      |
//!     |        |          -->    |        |        U = Q - R P^-1 R^T
//!     | R    Q |                 | R'   U |
//! ```
//! The rows of R and R' are the rows of the front below the pivots. The block Q is the rest of the front.

mod front;

use mesh::parallel;
use progress::{Meter, Progress};

use super::order::minimum_degree;
use super::symbolic::{Supernode, Symbolic, inverse};
use super::{Entry, SolveError, SymmetricMatrix};
use front::{Front, Update};

/// The largest number of entries of a factor. This number of entries takes 16 GiB.
const MAX_ENTRIES: u64 = 1 << 31;
/// A solution is accepted if its residual is at most this number times the size of the terms of the equations. For each
/// equation, the absolute values of its terms are added up. The size of the terms is the largest of these sums.
const MAX_RESIDUAL: f64 = 1e-9;
/// The refinement of a solution stops when its relative residual is at most this number, when the residual hardly
/// decreases, or after [`REFINEMENTS`] steps.
const GOOD_RESIDUAL: f64 = 1e-14;
const REFINEMENTS: usize = 3;
/// The text that progress reports show for the factorization.
const TASK: &str = "factor the matrix";

/// The factorization of a symmetric positive definite matrix. The same factorization solves the equations for any
/// number of right-hand sides. Unknowns can be pinned to given values.
#[derive(Debug)]
pub struct Factor<'a> {
    matrix: &'a SymmetricMatrix,
    /// The rows of the free unknowns: the unknowns that are not pinned.
    free: Vec<u32>,
    symbolic: Symbolic,
    /// The entries of L, as a list of parts. Each part has the entries of consecutive supernodes. A supernode is a
    /// range of columns with entries in the same rows. The entries of a supernode are one slice of a part, column by
    /// column.
    values: Vec<Vec<f64>>,
    /// For each supernode, where its entries are: the index of a part of `values`, and the index of the first entry in
    /// that part.
    places: Vec<(usize, usize)>,
    diagonal: Vec<f64>,
}

impl std::fmt::Debug for Symbolic {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} supernodes", self.supernodes.len())
    }
}

impl<'a> Factor<'a> {
    /// Factors a symmetric positive definite matrix.
    ///
    /// # Errors
    ///
    /// Returns [`SolveError::NotPositiveDefinite`], [`SolveError::TooLarge`], or [`SolveError::Cancelled`].
    pub fn new(matrix: &'a SymmetricMatrix, progress: &dyn Progress) -> Result<Self, SolveError> {
        Self::with_pins(matrix, &vec![false; matrix.len()], progress)
    }

    /// Factors a part of a symmetric matrix: the rows and columns of the unknowns that are not pinned. This part of the
    /// matrix must be positive definite.
    ///
    /// # Errors
    ///
    /// Returns the same errors as [`new`](Self::new).
    ///
    /// # Panics
    ///
    /// Panics if `is_pinned` does not have one entry for each row.
    pub fn with_pins(
        matrix: &'a SymmetricMatrix,
        is_pinned: &[bool],
        progress: &dyn Progress,
    ) -> Result<Self, SolveError> {
        assert_eq!(is_pinned.len(), matrix.len(), "one entry for each row");
        let rows = 0..u32::try_from(matrix.len()).expect("rows fit 32 bits");
        let free: Vec<u32> = rows.filter(|&i| !is_pinned[i as usize]).collect();
        let mut place = vec![u32::MAX; matrix.len()];
        for (at, &i) in (0..).zip(&free) {
            place[i as usize] = at;
        }
        let neighbors = |at: usize| {
            let row = matrix.row(free[at] as usize);
            row.map(|(j, _)| place[j as usize])
                .filter(|&j| j != u32::MAX)
        };
        let graph = (0..free.len()).map(|at| neighbors(at).filter(|&j| j as usize != at).collect());
        let order = minimum_degree(graph.collect(), progress)?;
        let symbolic = Symbolic::new(&order, neighbors);
        let needed = symbolic.n_entries();
        if needed > MAX_ENTRIES {
            let limit = MAX_ENTRIES;
            return Err(SolveError::TooLarge { needed, limit });
        }
        let position = inverse(&symbolic.order);
        let mut factor = Self {
            matrix,
            diagonal: vec![0.0; free.len()],
            free,
            values: Vec::new(),
            places: Vec::with_capacity(symbolic.supernodes.len()),
            symbolic,
        };
        let column = |j: usize| {
            let row = factor.free[factor.symbolic.order[j] as usize];
            let entries = matrix.row(row as usize);
            entries.filter_map(|(i, a)| match place[i as usize] {
                u32::MAX => None,
                i => Some((position[i as usize], a)),
            })
        };
        let (values, diagonals) = factor.eliminate(column, progress)?;
        let (mut s, supernodes) = (0, &factor.symbolic.supernodes);
        for (part, (values, pivots)) in values.iter().zip(&diagonals).enumerate() {
            let (mut start, mut at) = (0, 0);
            while start < values.len() {
                let n = supernodes[s].columns.len();
                factor.diagonal[supernodes[s].columns.clone()].copy_from_slice(&pivots[at..at + n]);
                factor.places.push((part, start));
                start += n * supernodes[s].rows.len();
                at += n;
                s += 1;
            }
        }
        factor.values = values;
        Ok(factor)
    }

    /// Returns the number of stored entries of L.
    pub fn n_entries(&self) -> u64 {
        self.symbolic.n_entries()
    }

    /// Computes the entries of L and of D. Returns the entries of L and the entries of D as two lists of parts. Each
    /// part has the entries of consecutive supernodes.
    #[expect(clippy::type_complexity, reason = "two lists of parts")]
    fn eliminate<I: Iterator<Item = (u32, f64)>>(
        &self,
        column: impl Fn(usize) -> I + Sync,
        progress: &dyn Progress,
    ) -> Result<(Vec<Vec<f64>>, Vec<Vec<f64>>), SolveError> {
        let supernodes = &self.symbolic.supernodes;
        let units = units(supernodes);
        let total = supernodes.iter().map(Supernode::work).sum();
        let meter = Meter::new(progress, TASK, total).every(10_000_000);
        let n = self.free.len();
        // First eliminates the subtrees in parallel, then the supernodes above them, one after another. A large front
        // is also processed in parallel; each of its numbers is computed in the same way for any number of threads.
        let subtrees: Result<Vec<_>, SolveError> = parallel::consume(&units, |_, unit| {
            let mut front = Front::new(n);
            if !unit.is_subtree {
                return Ok((front, Vec::new()));
            }
            let mut updates = Vec::new();
            for s in &supernodes[unit.range.clone()] {
                meter.add(usize::try_from(s.work()).unwrap_or(usize::MAX))?;
                front
                    .eliminate(s, &column, &mut updates)
                    .map_err(|e| self.at_row(e))?;
            }
            front.finish();
            Ok((front, updates))
        })
        .into_iter()
        .collect();
        let mut updates: Vec<Update> = Vec::new();
        let (mut values, mut diagonals) = (Vec::new(), Vec::new());
        let mut top = Front::new(n);
        for (unit, (mut front, from_subtree)) in units.iter().zip(subtrees?) {
            if unit.is_subtree {
                updates.extend(from_subtree);
            } else {
                let s = &supernodes[unit.range.start];
                meter.add(usize::try_from(s.work()).unwrap_or(usize::MAX))?;
                top.eliminate(s, &column, &mut updates)
                    .map_err(|e| self.at_row(e))?;
                front.values = std::mem::take(&mut top.values);
                front.pivots = std::mem::take(&mut top.pivots);
            }
            values.push(front.values);
            diagonals.push(front.pivots);
        }
        Ok((values, diagonals))
    }

    /// Creates the error for a pivot that is not positive. The error names the row of the matrix that belongs to the
    /// column of the factor.
    fn at_row(&self, (column, pivot): (usize, f64)) -> SolveError {
        let row = self.free[self.symbolic.order[column] as usize] as usize;
        SolveError::NotPositiveDefinite { row, pivot }
    }

    /// Solves the equations of the free unknowns for the right-hand side `b`. The pinned entries of `x` are inputs
    /// and do not change; the free entries are replaced by the solution. The residual of the free rows is checked.
    ///
    /// # Errors
    ///
    /// Returns [`SolveError::Residual`] if the residual is larger than 1e-9 times the size of the terms. For each
    /// equation, the absolute values of its terms are added up. The size of the terms is the largest of these sums.
    /// After this error, the free entries of `x` are unspecified.
    ///
    /// # Panics
    ///
    /// Panics if `b` or `x` does not have one entry for each row.
    pub fn solve<T: Entry>(&self, b: &[T], x: &mut [T]) -> Result<(), SolveError> {
        let n = self.matrix.len();
        assert!(b.len() == n && x.len() == n, "one entry for each row");
        for &i in &self.free {
            x[i as usize] = T::default();
        }
        // The free unknowns are 0 here, so the residual is the right-hand side minus the terms of the pinned unknowns.
        let (mut residual, _) = self.residual(b, x);
        let mut best = f64::INFINITY;
        for _ in 0..=REFINEMENTS {
            let step = self.substitute(&residual);
            for (&i, &step) in self.free.iter().zip(&step) {
                x[i as usize] = x[i as usize] + step;
            }
            let (next, size) = self.residual(b, x);
            let largest = next.iter().map(|r| r.magnitude()).fold(0.0, f64_max);
            let relative = if largest == 0.0 { 0.0 } else { largest / size };
            residual = next;
            if !relative.is_finite() {
                return Err(SolveError::Residual(relative));
            }
            let is_stuck = relative > 0.5 * best;
            best = relative;
            if relative <= GOOD_RESIDUAL || is_stuck {
                break;
            }
        }
        if best <= MAX_RESIDUAL {
            Ok(())
        } else {
            Err(SolveError::Residual(best))
        }
    }

    /// Returns the residual b - A x for the rows of the free unknowns. Also returns the size of the terms. For each
    /// row, the absolute values of its terms are added up; the size of the terms is the largest of these sums.
    fn residual<T: Entry>(&self, b: &[T], x: &[T]) -> (Vec<T>, f64) {
        let rows: Vec<(T, f64)> = parallel::collect(self.free.len(), |i| {
            let i = self.free[i] as usize;
            let (mut r, mut size) = (b[i], b[i].magnitude());
            for (j, a) in self.matrix.row(i) {
                let term = x[j as usize] * a;
                r = r - term;
                size += term.magnitude();
            }
            (r, size)
        });
        let size = rows.iter().map(|r| r.1).fold(0.0, f64_max);
        (rows.into_iter().map(|r| r.0).collect(), size)
    }

    /// Solves L D L^T x = b for the free unknowns by substitution, and returns x.
    fn substitute<T: Entry>(&self, b: &[T]) -> Vec<T> {
        let order = &self.symbolic.order;
        let mut x: Vec<T> = order.iter().map(|&i| b[i as usize]).collect();
        let columns = |s: usize| {
            let supernode = &self.symbolic.supernodes[s];
            let (part, start) = self.places[s];
            let m = supernode.rows.len();
            let values = &self.values[part][start..start + m * supernode.columns.len()];
            let columns = supernode.columns.clone().enumerate();
            columns
                .zip(values.chunks_exact(m))
                .map(|((c, j), column)| (j, &supernode.rows[c + 1..], &column[c + 1..]))
        };
        for s in 0..self.places.len() {
            for (j, rows, entries) in columns(s) {
                let xj = x[j];
                for (&i, &l) in rows.iter().zip(entries) {
                    x[i as usize] = x[i as usize] - xj * l;
                }
            }
        }
        for (x, d) in x.iter_mut().zip(&self.diagonal) {
            *x = *x * (1.0 / d);
        }
        for s in (0..self.places.len()).rev() {
            for (j, rows, entries) in columns(s).rev() {
                let mut xj = x[j];
                for (&i, &l) in rows.iter().zip(entries) {
                    xj = xj - x[i as usize] * l;
                }
                x[j] = xj;
            }
        }
        let mut solution = vec![T::default(); x.len()];
        for (&i, &x) in order.iter().zip(&x) {
            solution[i as usize] = x;
        }
        solution
    }
}

/// Returns the larger of two numbers, or NaN if one of them is NaN.
fn f64_max(a: f64, b: f64) -> f64 {
    if a > b || a.is_nan() { a } else { b }
}

/// A unit of the elimination: either a subtree, or a single supernode above the subtrees. One thread eliminates all
/// supernodes of a subtree.
struct Unit {
    range: std::ops::Range<usize>,
    is_subtree: bool,
}

/// Divides the tree of supernodes into units: subtrees of limited work, and the single supernodes above these subtrees.
fn units(supernodes: &[Supernode]) -> Vec<Unit> {
    let mut work: Vec<u64> = supernodes.iter().map(Supernode::work).collect();
    let mut first: Vec<usize> = (0..supernodes.len()).collect();
    let limit = work.iter().sum::<u64>() / 64;
    for (s, supernode) in supernodes.iter().enumerate() {
        if let Some(parent) = supernode.parent {
            work[parent] += work[s];
            first[parent] = first[parent].min(first[s]);
        }
    }
    let mut units = Vec::new();
    for (s, supernode) in supernodes.iter().enumerate() {
        let is_subtree = work[s] <= limit;
        if is_subtree && supernode.parent.is_some_and(|p| work[p] <= limit) {
            continue;
        }
        let range = if is_subtree { first[s] } else { s }..s + 1;
        units.push(Unit { range, is_subtree });
    }
    units
}
