//! Meshes from arrays.

use std::sync::Arc;

use mesh::{BuildError, NonManifold, Values};
use pyo3::buffer::PyBuffer;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;

use crate::array::{Array, values_from};
use crate::interrupt::run;
use crate::mesh_views::{Mesh, number};

/// Builds a mesh from three arrays. The first array has the positions (`float64`, three numbers for each vertex). The
/// second has the index of the first corner of each face, followed by the number of all corners (`uint32`). The third
/// has the vertex of each corner (`uint32`). Returns four values: the mesh, a description of each repair, and two
/// arrays of indices. The arrays have the index of the input position for each vertex, and the index of the input
/// polygon for each face.
#[pyfunction]
pub(crate) fn from_arrays(
    py: Python<'_>,
    positions: &Bound<'_, PyAny>,
    starts: &Bound<'_, PyAny>,
    corners: &Bound<'_, PyAny>,
    repair: bool,
) -> PyResult<(Mesh, Vec<String>, Array, Array)> {
    let Values::Vec3(positions) = values_from(positions, 3)? else {
        return Err(PyTypeError::new_err("positions must be numbers"));
    };
    let starts = PyBuffer::<u32>::get(starts)?.to_vec(py)?;
    let corners = PyBuffer::<u32>::get(corners)?.to_vec(py)?;
    let non_manifold = if repair {
        NonManifold::Split
    } else {
        NonManifold::RefuseAsGiven
    };
    let built = run(py, None, |_| {
        mesh::build(positions, &starts, &corners, non_manifold)
    })?;
    let built = built.map_err(|error: BuildError| PyValueError::new_err(error.to_string()))?;
    let repairs = built
        .report
        .repairs()
        .into_iter()
        .chain(built.report.dropped());
    let repairs = repairs.map(|repair| repair.to_string()).collect();
    let mut vertices: Vec<u32> = built.mesh.vertices().map(number).collect();
    for &(vertex, copy) in &built.report.split_vertices {
        vertices[copy.index()] = vertices[vertex.index()];
    }
    let mut faces = vec![0; built.mesh.n_faces()];
    for (polygon, face) in (0..).zip(&built.face_of_polygon) {
        if let Some(face) = face.some() {
            faces[face.index()] = polygon;
        }
    }
    let mesh = Mesh(Arc::new(built.mesh));
    Ok((mesh, repairs, Array::ids(vertices), Array::ids(faces)))
}
