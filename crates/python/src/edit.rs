//! Edits of single elements.

use std::sync::{Arc, Mutex, PoisonError};

use mesh::{DVec3, EdgeId, EditError, FaceId, HalfEdgeId, Id, Mesh as Kernel, VertexId};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors::edit_error;
use crate::mesh_views::{Mesh, number};

/// A copy of a mesh for editing. The original mesh never changes. If an edit is refused, the method raises an error and
/// the copy does not change.
#[pyclass(frozen, module = "meshwright._core")]
pub(crate) struct Editor(Mutex<Kernel>);

/// Converts a number from Python to an id. Raises an error for the number that stands for "no element".
fn id<I: Id>(number: u32) -> PyResult<I> {
    if number == u32::MAX {
        return Err(PyValueError::new_err("an id must not exceed 2^32 - 2"));
    }
    Ok(I::new(number as usize))
}

fn ids<I: Id>(numbers: Vec<u32>) -> PyResult<Vec<I>> {
    numbers.into_iter().map(id).collect()
}

impl Editor {
    fn edit<T>(
        &self,
        py: Python<'_>,
        edit: impl FnOnce(&mut Kernel) -> Result<T, EditError>,
    ) -> PyResult<T> {
        let mut mesh = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        edit(&mut mesh).map_err(|refused| edit_error(py, refused))
    }
}

fn numbers<I: Id>(ids: Vec<I>) -> Vec<u32> {
    ids.into_iter().map(number).collect()
}

#[pymethods]
impl Editor {
    #[new]
    fn new(mesh: &Mesh) -> Self {
        Self(Mutex::new((*mesh.0).clone()))
    }

    /// Returns a copy of the mesh after the edits that were made so far. The elements of the copy are renumbered, so
    /// that the ids have no gaps.
    fn mesh(&self) -> Mesh {
        let mut mesh = self
            .0
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .clone();
        mesh.compact();
        Mesh(Arc::new(mesh))
    }

    /// The numbers of vertices, edges and faces.
    fn counts(&self) -> (usize, usize, usize) {
        let mesh = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        (mesh.n_vertices(), mesh.n_edges(), mesh.n_faces())
    }

    /// Returns the edge between two vertices, or `None` if no edge connects them.
    fn edge(&self, py: Python<'_>, v: u32, w: u32) -> PyResult<Option<u32>> {
        let (v, w) = (id::<VertexId>(v)?, id::<VertexId>(w)?);
        self.edit(py, |mesh| {
            for vertex in [v, w] {
                if !mesh.has_vertex(vertex) {
                    return Err(EditError::NoSuchVertex(vertex));
                }
            }
            Ok(mesh.find_half_edge(v, w).map(|h| number(h.edge())))
        })
    }

    /// The two vertices of an edge.
    fn edge_vertices(&self, py: Python<'_>, edge: u32) -> PyResult<[u32; 2]> {
        let e: EdgeId = id(edge)?;
        self.edit(py, |mesh| {
            if !mesh.has_edge(e) {
                return Err(EditError::NoSuchEdge(e));
            }
            Ok(mesh.edge_vertices(e).map(number))
        })
    }

    /// The vertices of a face.
    fn face_vertices(&self, py: Python<'_>, face: u32) -> PyResult<Vec<u32>> {
        let f: FaceId = id(face)?;
        self.edit(py, |mesh| {
            if !mesh.has_face(f) {
                return Err(EditError::NoSuchFace(f));
            }
            Ok(mesh.face_vertices(f).map(number).collect())
        })
    }

    fn flip(&self, py: Python<'_>, edge: u32) -> PyResult<()> {
        let e = id(edge)?;
        self.edit(py, |mesh| mesh.flip_edge(e))
    }

    fn split(&self, py: Python<'_>, edge: u32, at: f64) -> PyResult<u32> {
        let e = id(edge)?;
        self.edit(py, |mesh| mesh.split_edge(e, at).map(number))
    }

    fn collapse(&self, py: Python<'_>, edge: u32, at: f64) -> PyResult<u32> {
        let e = id(edge)?;
        self.edit(py, |mesh| mesh.collapse_edge_at(e, at).map(number))
    }

    fn dissolve_edge(&self, py: Python<'_>, edge: u32) -> PyResult<u32> {
        let e = id(edge)?;
        self.edit(py, |mesh| mesh.dissolve_edge(e).map(number))
    }

    fn dissolve_vertex(&self, py: Python<'_>, vertex: u32) -> PyResult<u32> {
        let v = id(vertex)?;
        self.edit(py, |mesh| mesh.dissolve_vertex(v).map(number))
    }

    fn connect(&self, py: Python<'_>, v: u32, w: u32) -> PyResult<u32> {
        let (v, w) = (id(v)?, id(w)?);
        self.edit(py, |mesh| mesh.connect_vertices(v, w).map(number))
    }

    fn poke(&self, py: Python<'_>, face: u32) -> PyResult<u32> {
        let f = id(face)?;
        self.edit(py, |mesh| mesh.poke_face(f).map(number))
    }

    fn inset(&self, py: Python<'_>, face: u32, fraction: f64) -> PyResult<Vec<u32>> {
        let f = id(face)?;
        self.edit(py, |mesh| mesh.inset_face(f, fraction).map(numbers))
    }

    fn extrude(&self, py: Python<'_>, faces: Vec<u32>, offset: [f64; 3]) -> PyResult<Vec<u32>> {
        let faces: Vec<FaceId> = ids(faces)?;
        let offset = DVec3::from_array(offset);
        self.edit(py, |mesh| mesh.extrude_faces(&faces, offset).map(numbers))
    }

    fn delete(&self, py: Python<'_>, faces: Vec<u32>) -> PyResult<()> {
        let faces: Vec<FaceId> = ids(faces)?;
        self.edit(py, |mesh| mesh.delete_faces(&faces))
    }

    fn fill_hole(&self, py: Python<'_>, half_edge: u32) -> PyResult<u32> {
        let h: HalfEdgeId = id(half_edge)?;
        self.edit(py, |mesh| mesh.fill_hole(h).map(number))
    }

    fn r#move(&self, py: Python<'_>, vertex: u32, position: [f64; 3]) -> PyResult<()> {
        let v: VertexId = id(vertex)?;
        let position = DVec3::from_array(position);
        self.edit(py, |mesh| {
            if !mesh.has_vertex(v) {
                return Err(EditError::NoSuchVertex(v));
            }
            if let Some(bad) = position.to_array().into_iter().find(|x| !x.is_finite()) {
                return Err(EditError::BadNumber(bad));
            }
            mesh.set_position(v, position);
            Ok(())
        })
    }
}
