//! Sparse symmetric matrices, and a direct solver for positive definite ones.
//!
//! The solver is a sparse Cholesky factorization P A Pᵀ = L D Lᵀ, without square roots:
//!
//! | step | method | file |
//! | --- | --- | --- |
//! | ordering P | approximate minimum degree: Amestoy, Davis, Duff, 1996 | `order.rs` |
//! | pattern of L | elimination tree and supernodes: Liu, 1990 | `symbolic.rs` |
//! | L and D | multifrontal method with dense fronts: Duff, Reid, 1983 | `factor.rs` |
//! | solutions | substitution, then refinement until the residual is small | `factor.rs` |
//!
//! Each number is computed by one thread, with additions in a fixed order. The result is therefore identical bit for
//! bit for any number of threads.

mod factor;
mod order;
mod symbolic;
#[cfg(test)]
mod tests;

use mesh::parallel;
use std::ops::{Add, Mul, Sub};

use progress::Cancelled;

pub use factor::Factor;

/// A symmetric matrix with few nonzero entries, in compressed rows (CSR). Both the upper and the lower triangle are
/// stored.
///
/// # Examples
///
/// ```
/// use geometry::sparse::{Factor, SymmetricMatrix};
/// use progress::NoProgress;
///
/// // Rows (4, 1) and (1, 3).
/// let a = SymmetricMatrix::from_entries(2, vec![(0, 0, 4.0), (1, 0, 1.0), (1, 1, 3.0)]);
/// let mut x = [0.0; 2];
/// Factor::new(&a, &NoProgress)?.solve(&[6.0, 7.0], &mut x)?;
/// assert!((x[0] - 1.0_f64).abs() < 1e-14 && (x[1] - 2.0_f64).abs() < 1e-14);
/// # Ok::<(), geometry::sparse::SolveError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SymmetricMatrix {
    /// The entries of row i have the indices from `starts[i]` up to but not including `starts[i + 1]`.
    starts: Vec<usize>,
    /// The column of each entry. Within each row, the columns are in ascending order.
    columns: Vec<u32>,
    values: Vec<f64>,
}

/// The type of one entry of a right-hand side or a solution: a number or a vector. If the entries are `DVec3`,
/// one call of `solve` computes the solutions for three right-hand sides.
pub trait Entry:
    Copy + Default + Send + Sync + Add<Output = Self> + Sub<Output = Self> + Mul<f64, Output = Self>
{
    /// Returns the largest absolute value of the components of the entry.
    fn magnitude(self) -> f64;
}

impl Entry for f64 {
    fn magnitude(self) -> f64 {
        self.abs()
    }
}

impl Entry for mesh::DVec2 {
    fn magnitude(self) -> f64 {
        self.abs().max_element()
    }
}

impl Entry for mesh::DVec3 {
    fn magnitude(self) -> f64 {
        self.abs().max_element()
    }
}

/// Why a system of equations was not solved.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum SolveError {
    /// A pivot is zero, negative, infinite or NaN: the matrix is not positive definite, or it only seems so because of
    /// rounding errors.
    #[error(
        "the matrix is not positive definite: the pivot of row {row} is {pivot}; pin an unknown of each component, or add \
         a positive diagonal"
    )]
    NotPositiveDefinite {
        /// The row of the matrix to which the pivot belongs.
        row: usize,
        /// The pivot, which can be NaN.
        pivot: f64,
    },
    /// The computed solution does not satisfy the equations accurately enough.
    #[error(
        "the solution is not accurate: the relative residual is {0:e}, but at most 1e-9 is accepted"
    )]
    Residual(f64),
    /// The factor would have more entries than are supported.
    #[error(
        "the system of equations is too large: its factorization needs {needed} entries, but at most {limit} are supported"
    )]
    TooLarge {
        /// The required number of entries of the factor.
        needed: u64,
        /// The largest supported number of entries.
        limit: u64,
    },
    /// The computation was canceled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl SymmetricMatrix {
    /// Creates a matrix with `n` rows from entries (row, column, value) in any order. Pass each off-diagonal
    /// entry only once: the symmetric entry at (column, row) is added automatically. Entries with the same row
    /// and column are added up in the order of the list.
    ///
    /// # Panics
    ///
    /// Panics if a row or column is not less than `n`.
    pub fn from_entries(n: usize, entries: Vec<(u32, u32, f64)>) -> Self {
        let mut starts = vec![0; n + 1];
        for &(i, j, _) in &entries {
            starts[i as usize + 1] += 1;
            if i != j {
                starts[j as usize + 1] += 1;
            }
        }
        for i in 0..n {
            starts[i + 1] += starts[i];
        }
        let mut ends = starts.clone();
        let mut placed = vec![(0_u32, 0.0); starts[n]];
        let mut place = |i: u32, j: u32, value| {
            placed[ends[i as usize]] = (j, value);
            ends[i as usize] += 1;
        };
        for (i, j, value) in entries {
            place(i, j, value);
            if i != j {
                place(j, i, value);
            }
        }
        Self::from_rows(n, |i, row| {
            row.extend_from_slice(&placed[starts[i]..starts[i + 1]]);
        })
    }

    /// Creates a matrix with `n` rows. `row` appends the entries (column, value) of one row to an empty list, in any
    /// order. Entries of the same column are added up in the order of this list. The entries at (i, j) and (j, i) must
    /// be identical bit for bit.
    pub(crate) fn from_rows(n: usize, row: impl Fn(usize, &mut Vec<(u32, f64)>) + Sync) -> Self {
        let blocks = parallel::blocks(n, |rows| {
            let mut lengths: Vec<usize> = Vec::new();
            let mut entries: Vec<(u32, f64)> = Vec::new();
            let mut buffer = Vec::new();
            for i in rows {
                buffer.clear();
                row(i, &mut buffer);
                buffer.sort_by_key(|&(j, _)| j);
                let before = entries.len();
                for &(j, value) in &buffer {
                    match entries[before..].last_mut() {
                        Some((last, sum)) if *last == j => *sum += value,
                        _ => entries.push((j, value)),
                    }
                }
                lengths.push(entries.len() - before);
            }
            (lengths, entries)
        });
        let mut matrix = Self {
            starts: Vec::with_capacity(n + 1),
            ..Self::default()
        };
        matrix.starts.push(0);
        let total = blocks.iter().map(|block| block.1.len()).sum();
        matrix.columns.reserve_exact(total);
        matrix.values.reserve_exact(total);
        let mut end = 0;
        for (lengths, entries) in blocks {
            for length in lengths {
                end += length;
                matrix.starts.push(end);
            }
            matrix.columns.extend(entries.iter().map(|e| e.0));
            matrix.values.extend(entries.iter().map(|e| e.1));
        }
        matrix
    }

    /// Returns the number of rows.
    pub fn len(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// Whether the matrix has no rows.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns the number of stored entries, in the upper and the lower triangle together.
    pub fn n_entries(&self) -> usize {
        self.columns.len()
    }

    /// Returns the columns of row `i` in ascending order, with their values.
    pub fn row(&self, i: usize) -> impl ExactSizeIterator<Item = (u32, f64)> + Clone + '_ {
        let range = self.starts[i]..self.starts[i + 1];
        let columns = self.columns[range.clone()].iter().copied();
        columns.zip(self.values[range].iter().copied())
    }

    /// Returns the entry at row `i` and column `j`. Returns 0 if this entry is not stored.
    pub fn get(&self, i: usize, j: usize) -> f64 {
        let row = &self.columns[self.starts[i]..self.starts[i + 1]];
        let found = u32::try_from(j).map(|j| row.binary_search(&j));
        match found {
            Ok(Ok(at)) => self.values[self.starts[i] + at],
            _ => 0.0,
        }
    }

    /// Returns the product of this matrix and the vector `x`.
    ///
    /// # Panics
    ///
    /// Panics if `x` does not have one entry for each row.
    pub fn times<T: Entry>(&self, x: &[T]) -> Vec<T> {
        assert_eq!(x.len(), self.len(), "one entry for each row");
        parallel::collect(self.len(), |i| {
            let terms = self.row(i).map(|(j, a)| x[j as usize] * a);
            terms.fold(T::default(), |sum, term| sum + term)
        })
    }

    /// Returns this matrix times `factor`, plus the diagonal matrix with the entries `diagonal`.
    ///
    /// # Panics
    ///
    /// Panics if `diagonal` does not have one entry for each row.
    #[must_use]
    pub fn scaled_plus_diagonal(&self, factor: f64, diagonal: &[f64]) -> Self {
        assert_eq!(diagonal.len(), self.len(), "one entry for each row");
        Self::from_rows(self.len(), |i, row| {
            row.extend(self.row(i).map(|(j, a)| (j, factor * a)));
            row.push((u32::try_from(i).expect("columns fit 32 bits"), diagonal[i]));
        })
    }
}
