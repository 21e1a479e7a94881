//! Arrays that `NumPy` reads without a copy, and functions that copy values from Python buffers.

use std::ffi::c_int;
use std::sync::Arc;

use mesh::{DVec2, DVec3, DVec4, Domain, Mesh, Values};
use pyo3::buffer::{ElementType, PyBuffer, PyUntypedBuffer};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::ffi;
use pyo3::prelude::*;

/// A read-only view of memory. `numpy.frombuffer` makes a `NumPy` array from this view without a copy. The memory is
/// not freed before the last of these arrays is freed.
#[pyclass(frozen, module = "meshwright._core")]
pub(crate) struct Array {
    memory: Memory,
    /// The type of the numbers, as a `NumPy` type name such as `float64`.
    #[pyo3(get)]
    dtype: &'static str,
    /// How many numbers each row has, such as 3 for positions.
    #[pyo3(get)]
    columns: usize,
}

/// Memory that never changes. The memory belongs to a mesh that several owners share, or to a single [`Array`].
enum Memory {
    Part(Arc<Mesh>, Part),
    Ids(Vec<u32>),
    Indices(Vec<u64>),
    Floats(Vec<f64>),
    Column(Values),
}

/// One of the arrays of a mesh.
#[derive(Clone)]
pub(crate) enum Part {
    Positions,
    Next,
    Origin,
    Face,
    VertexHalfEdge,
    FaceHalfEdge,
    Column(Domain, String),
}

impl Array {
    /// Returns a view of one of the arrays of a mesh. Returns `None` if `part` is an attribute that the mesh does not
    /// have.
    pub(crate) fn of(mesh: &Arc<Mesh>, part: Part) -> Option<Self> {
        let (dtype, columns) = match &part {
            Part::Positions => ("float64", 3),
            Part::Column(domain, name) => kind(&mesh.attributes().column(*domain, name)?.values),
            _ => ("uint32", 1),
        };
        Some(Self {
            memory: Memory::Part(mesh.clone(), part),
            dtype,
            columns,
        })
    }

    pub(crate) fn ids(ids: Vec<u32>) -> Self {
        Self {
            memory: Memory::Ids(ids),
            dtype: "uint32",
            columns: 1,
        }
    }

    pub(crate) fn indices(indices: Vec<u64>) -> Self {
        Self {
            memory: Memory::Indices(indices),
            dtype: "uint64",
            columns: 1,
        }
    }

    pub(crate) fn floats(floats: Vec<f64>) -> Self {
        Self {
            memory: Memory::Floats(floats),
            dtype: "float64",
            columns: 1,
        }
    }

    pub(crate) fn column(values: Values) -> Self {
        let (dtype, columns) = kind(&values);
        Self {
            memory: Memory::Column(values),
            dtype,
            columns,
        }
    }

    fn bytes(&self) -> &[u8] {
        match &self.memory {
            Memory::Ids(ids) => bytemuck::cast_slice(ids),
            Memory::Indices(indices) => bytemuck::cast_slice(indices),
            Memory::Floats(floats) => bytemuck::cast_slice(floats),
            Memory::Column(values) => bytes_of(values),
            Memory::Part(mesh, part) => {
                let c = mesh.connectivity();
                match part {
                    Part::Positions => bytemuck::cast_slice(mesh.positions()),
                    Part::Next => bytemuck::cast_slice(&c.next),
                    Part::Origin => bytemuck::cast_slice(&c.origin),
                    Part::Face => bytemuck::cast_slice(&c.face),
                    Part::VertexHalfEdge => bytemuck::cast_slice(&c.vertex_half_edge),
                    Part::FaceHalfEdge => bytemuck::cast_slice(&c.face_half_edge),
                    Part::Column(domain, name) => {
                        let column = mesh.attributes().column(*domain, name);
                        column.map_or(&[], |column| bytes_of(&column.values))
                    }
                }
            }
        }
    }
}

fn bytes_of(values: &Values) -> &[u8] {
    match values {
        Values::Float(v) => bytemuck::cast_slice(v),
        Values::Vec2(v) => bytemuck::cast_slice(v),
        Values::Vec3(v) => bytemuck::cast_slice(v),
        Values::Vec4(v) => bytemuck::cast_slice(v),
        Values::Int(v) => bytemuck::cast_slice(v),
        Values::Tag(v) => bytemuck::cast_slice(v),
    }
}

/// Returns the `NumPy` type and the number of the components that each value of an attribute has.
fn kind(values: &Values) -> (&'static str, usize) {
    let dtype = match values {
        Values::Int(_) => "int32",
        Values::Tag(_) => "bool",
        _ => "float64",
    };
    (dtype, values.n_components())
}

#[pymethods]
impl Array {
    fn __len__(&self) -> usize {
        self.bytes().len()
    }

    #[expect(
        unsafe_code,
        reason = "Python's buffers are pointers; without them each array would be copied"
    )]
    #[expect(
        clippy::needless_pass_by_value,
        reason = "PyO3 requires this signature"
    )]
    // SAFETY: `PyBuffer_FillInfo` stores the pointer and a reference to `slf` in `view`, and refuses requests for
    // writable memory. The bytes belong to `slf`, which is frozen, or to a mesh that `slf` shares. Such a mesh is never
    // changed. So the bytes stay valid and constant as long as the reference exists. Python passes a valid `view`.
    unsafe fn __getbuffer__(
        slf: Bound<'_, Self>,
        view: *mut ffi::Py_buffer,
        flags: c_int,
    ) -> PyResult<()> {
        let bytes = slf.get().bytes();
        let (pointer, len) = (bytes.as_ptr(), isize::try_from(bytes.len())?);
        let code = unsafe {
            ffi::PyBuffer_FillInfo(view, slf.as_ptr(), pointer.cast_mut().cast(), len, 1, flags)
        };
        if code == 0 {
            Ok(())
        } else {
            Err(PyErr::fetch(slf.py()))
        }
    }
}

/// Copies the values of a contiguous Python buffer. Each row of the buffer has `columns` numbers.
pub(crate) fn values_from(buffer: &Bound<'_, PyAny>, columns: usize) -> PyResult<Values> {
    let py = buffer.py();
    let untyped = PyUntypedBuffer::get(buffer)?;
    let kind = ElementType::from_format(untyped.format());
    let values = match (kind, columns) {
        (ElementType::Float { bytes: 8 }, 1..=4) => {
            let flat = PyBuffer::<f64>::get(buffer)?.to_vec(py)?;
            if flat.len() % columns != 0 {
                return Err(PyValueError::new_err("the last row is incomplete"));
            }
            match columns {
                1 => Values::Float(flat),
                2 => Values::Vec2(flat.chunks_exact(2).map(DVec2::from_slice).collect()),
                3 => Values::Vec3(flat.chunks_exact(3).map(DVec3::from_slice).collect()),
                _ => Values::Vec4(flat.chunks_exact(4).map(DVec4::from_slice).collect()),
            }
        }
        (ElementType::SignedInteger { bytes: 4 }, 1) => {
            Values::Int(PyBuffer::<i32>::get(buffer)?.to_vec(py)?)
        }
        (ElementType::UnsignedInteger { bytes: 1 }, 1) => {
            let flags = PyBuffer::<u8>::get(buffer)?.to_vec(py)?;
            Values::Tag(flags.into_iter().map(|flag| flag != 0).collect())
        }
        _ => {
            return Err(PyTypeError::new_err(
                "expected numbers of type float64 with 1 to 4 columns, int32 or uint8",
            ));
        }
    };
    Ok(values)
}
