//! Sparse matrices in compressed row storage.

use ::subdivision::{LoopWeights, Rules, Scheme, Split, subdivision_matrix};
use geometry::Laplacian;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::array::Array;
use crate::interrupt::run;
use crate::mesh_views::Mesh;

/// Returns the cotangent Laplacian in compressed row storage, and the areas of the vertices. The result is four arrays.
/// The first has the index of the first entry of each matrix row, and the number of all entries as the last element.
/// The second has the column of each entry, the third the value of each entry, and the fourth the area of each vertex.
#[pyfunction]
pub(crate) fn laplacian(py: Python<'_>, mesh: &Mesh) -> PyResult<(Array, Array, Array, Array)> {
    let (starts, columns, values, areas) = run(py, None, |progress| {
        let Laplacian { stiffness, areas } = Laplacian::new(&mesh.0, progress)?;
        let mut starts = Vec::with_capacity(stiffness.len() + 1);
        let mut columns = Vec::with_capacity(stiffness.n_entries());
        let mut values = Vec::with_capacity(stiffness.n_entries());
        starts.push(0);
        for i in 0..stiffness.len() {
            for (j, value) in stiffness.row(i) {
                columns.push(j);
                values.push(value);
            }
            starts.push(columns.len() as u64);
        }
        Ok::<_, op::Cancelled>((starts, columns, values, areas))
    })?
    .map_err(|cancelled| PyValueError::new_err(cancelled.to_string()))?;
    Ok((
        Array::indices(starts),
        Array::ids(columns),
        Array::floats(values),
        Array::floats(areas),
    ))
}

/// Returns the matrix that maps positions to refined positions, in compressed row storage. The first value of the
/// result is an array with the index of the first entry of each matrix row, and the number of all entries as the last
/// element. The second is an array with the column of each entry, the third an array with the value of each entry, and
/// the fourth the number of columns of the matrix.
#[pyfunction]
pub(crate) fn subdivision(
    py: Python<'_>,
    mesh: &Mesh,
    scheme: &str,
    levels: u32,
) -> PyResult<(Array, Array, Array, usize)> {
    let scheme = match scheme {
        "loop" => Scheme::Loop(LoopWeights::Warren),
        "catmull_clark" => Scheme::CatmullClark,
        "midpoint" => Scheme::Midpoint(Split::Triangles),
        "butterfly" => Scheme::Butterfly,
        "sqrt3" => Scheme::Sqrt3,
        _ => {
            return Err(PyValueError::new_err(format!(
                "unknown scheme {scheme:?}: expected \"loop\", \"catmull_clark\", \"midpoint\", \"butterfly\" or \"sqrt3\""
            )));
        }
    };
    let matrix = run(py, None, |progress| {
        subdivision_matrix(&mesh.0, Rules::of(scheme), levels, progress)
    })?;
    let matrix = matrix.map_err(|error| PyValueError::new_err(error.to_string()))?;
    let starts = matrix.offsets.iter().map(|&start| start as u64).collect();
    Ok((
        Array::indices(starts),
        Array::ids(matrix.columns),
        Array::floats(matrix.weights),
        matrix.n_columns,
    ))
}
