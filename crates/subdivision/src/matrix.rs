//! The subdivision matrix. With this matrix, several lists of vertex values of the same mesh can be refined without
//! subdividing the mesh again.

use std::ops::Range;

use mesh::{Attributes, CREASE, Domain, Mesh, VERTEX_SHARPNESS};
use progress::{Cancelled, Meter, Progress};
use rayon::prelude::*;

use crate::error::SubdivisionError;
use crate::input::{check_faces, dense};
use crate::level;
use crate::parallel::of_blocks;
use crate::rules::Rules;
use crate::sharpness::Sharpness;
use crate::size::Size;

/// A sparse matrix in compressed row storage: row i has the weights `weights[r]` in the columns `columns[r]`,
/// for r from `offsets[i]` up to but not including `offsets[i + 1]`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SparseMatrix {
    /// The number of columns.
    pub n_columns: usize,
    /// The start of each row, and the end of the last row: one entry more than there are rows.
    pub offsets: Vec<usize>,
    /// The columns of the entries, ascending in each row.
    pub columns: Vec<u32>,
    /// The weights of the entries.
    pub weights: Vec<f64>,
}

impl SparseMatrix {
    /// Returns the number of rows.
    pub fn n_rows(&self) -> usize {
        self.offsets.len() - 1
    }

    /// Iterates over the columns and weights of row `i`.
    pub fn row(&self, i: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let row = self.range(i);
        let columns = self.columns[row.clone()].iter().map(|&c| c as usize);
        columns.zip(self.weights[row].iter().copied())
    }

    fn range(&self, i: usize) -> Range<usize> {
        self.offsets[i]..self.offsets[i + 1]
    }

    /// Multiplies the matrix by a list of numbers or vectors, one for each column of the matrix.
    ///
    /// # Panics
    ///
    /// Panics if `values` has no entry for a column in which the matrix has a weight.
    pub fn apply<T>(&self, values: &[T]) -> Vec<T>
    where
        T: mesh::Value + std::ops::Add<Output = T> + std::ops::Mul<f64, Output = T>,
    {
        let sum = |i: usize| {
            self.row(i)
                .fold(T::default(), |sum, (column, w)| sum + values[column] * w)
        };
        (0..self.n_rows()).into_par_iter().map(sum).collect()
    }

    /// Builds a matrix from its rows. `row(i, add)` adds the entries of row i; entries of the same column are
    /// summed.
    fn of_rows(
        n_rows: usize,
        n_columns: usize,
        meter: &Meter,
        row: impl Fn(usize, &mut dyn FnMut(usize, f64)) + Sync,
    ) -> Result<Self, Cancelled> {
        // Computes blocks of rows independently, then concatenates them.
        let parts = of_blocks(n_rows, &|block| {
            let mut part = Self::default();
            let mut entries: Vec<(usize, f64)> = Vec::new();
            for i in block {
                entries.clear();
                row(i, &mut |column, w| entries.push((column, w)));
                // The sort is stable, so that the weights of one column are summed in the order in which they
                // were added.
                entries.sort_by_key(|&(column, _)| column);
                for same in entries.chunk_by(|a, b| a.0 == b.0) {
                    let weight = same.iter().map(|&(_, w)| w).sum();
                    let column = u32::try_from(same[0].0).expect("vertex ids fit into 32 bits");
                    part.columns.push(column);
                    part.weights.push(weight);
                }
                part.offsets.push(part.columns.len());
            }
            meter.add(part.offsets.len())?;
            Ok(part)
        });
        let mut whole = Self {
            n_columns,
            offsets: vec![0],
            ..Self::default()
        };
        for part in parts {
            let part: Self = part?;
            let start = whole.columns.len();
            whole.offsets.extend(part.offsets.iter().map(|o| start + o));
            whole.columns.extend(part.columns);
            whole.weights.extend(part.weights);
        }
        Ok(whole)
    }
}

/// Returns the matrix that maps the positions of a mesh to the positions after `levels` levels. The matrix has a
/// row for each vertex of the refined mesh and a column for each vertex of the given mesh.
///
/// [`SparseMatrix::apply`] multiplies the matrix by a list of vertex values. This refines the values with the same
/// weights as the positions.
///
/// A mesh with dead (deleted) elements is compacted first, and the columns are the vertices of the compacted mesh.
///
/// # Errors
///
/// Returns an error in the same cases as [`subdivide`](crate::subdivide).
///
/// # Examples
///
/// ```
/// use subdivision::{LoopWeights, Rules, Scheme};
///
/// let mesh = geometry::shapes::icosahedron();
/// let rules = Rules::of(Scheme::Loop(LoopWeights::Warren));
/// let matrix = subdivision::subdivision_matrix(&mesh, rules, 2, &progress::NoProgress)?;
/// let heights: Vec<f64> = mesh.positions().iter().map(|p| p.z).collect();
/// assert_eq!(matrix.apply(&heights).len(), 162);
/// # Ok::<(), subdivision::SubdivisionError>(())
/// ```
pub fn subdivision_matrix(
    mesh: &Mesh,
    rules: Rules,
    levels: u32,
    progress: &dyn Progress,
) -> Result<SparseMatrix, SubdivisionError> {
    let mut mesh = dense(mesh).into_owned();
    keep_sharpness(&mut mesh);
    check_faces(&mesh, rules.scheme)?;
    let mut size = Size::of(&mesh);
    size.check(rules.scheme, 0..levels, u64::MAX)?;
    let work = size.work(rules.scheme, 0..levels).saturating_mul(2);
    let meter = Meter::new(progress, "subdivision matrix", work);
    let n = mesh.n_vertices();
    let mut matrix = SparseMatrix::of_rows(n, n, &meter, |i, add| add(i, 1.0))?;
    for level in 0..levels {
        let old = matrix;
        // Multiplies the matrix of this level by the matrix of all levels before it.
        size = size.after(rules.scheme, level);
        let n_rows = usize::try_from(size.vertices).expect("ids fit");
        let sharpness = Sharpness::of(&mesh, rules);
        matrix = level::with_level(&mesh, rules, level, sharpness, |_, masks| {
            SparseMatrix::of_rows(n_rows, n, &meter, |i, add| {
                masks.mask(i, &mut |source, w| {
                    for (column, weight) in old.row(source) {
                        add(column, w * weight);
                    }
                });
            })
        })?;
        if level + 1 < levels {
            mesh = level::finer(&mesh, rules, level, &meter)?;
        }
    }
    meter.finish()?;
    Ok(matrix)
}

/// Removes all attributes except sharpness. Sharpness is kept, because it changes the weights.
fn keep_sharpness(mesh: &mut Mesh) {
    let mut kept = Attributes::default();
    for (domain, name) in [
        (Domain::Edge, CREASE.name),
        (Domain::Vertex, VERTEX_SHARPNESS.name),
    ] {
        if let Some(column) = mesh.attributes().column(domain, name) {
            kept.insert(domain, column.clone());
        }
    }
    mesh.set_attributes(kept);
}
