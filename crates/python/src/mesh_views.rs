//! Meshes: their counts, their arrays and their attributes.

use std::sync::Arc;

use geometry::distance::{Distance, OneSided};
use mesh::{Column, Domain, HalfEdgeId, Id, Mesh as Kernel, Rule, Values};
use pyo3::exceptions::{PyKeyError, PyValueError};
use pyo3::prelude::*;

use crate::array::{Array, Part, values_from};
use crate::errors::error;
use crate::interrupt::run;

/// A mesh, which never changes. The ids of its elements run from 0 without gaps.
#[pyclass(frozen, module = "meshwright._core")]
pub(crate) struct Mesh(pub(crate) Arc<Kernel>);

pub(crate) fn domain(name: &str) -> PyResult<Domain> {
    let found = Domain::ALL.into_iter().find(|d| d.to_string() == name);
    found.ok_or_else(|| {
        PyValueError::new_err(format!(
            "unknown domain {name:?}: expected \"vertex\", \"corner\", \"edge\" or \"face\""
        ))
    })
}

fn rule(name: &str) -> PyResult<Rule> {
    match name {
        "interpolate" => Ok(Rule::Interpolate),
        "normal" => Ok(Rule::Normal),
        "copy" => Ok(Rule::Copy),
        "drop" => Ok(Rule::Drop),
        _ => Err(PyValueError::new_err(format!(
            "unknown rule {name:?}: expected \"interpolate\", \"normal\", \"copy\" or \"drop\""
        ))),
    }
}

fn rule_name(rule: Rule) -> &'static str {
    match rule {
        Rule::Interpolate => "interpolate",
        Rule::Normal => "normal",
        Rule::Copy => "copy",
        Rule::Drop => "drop",
    }
}

/// Returns the half-edge of each corner, face by face.
fn corner_half_edges(mesh: &Kernel) -> Vec<HalfEdgeId> {
    mesh.faces().flat_map(|f| mesh.face_half_edges(f)).collect()
}

#[pymethods]
impl Mesh {
    /// The numbers of vertices, edges and faces.
    fn counts(&self) -> (usize, usize, usize) {
        (self.0.n_vertices(), self.0.n_edges(), self.0.n_faces())
    }

    /// One of the arrays of the mesh: `positions`, `next`, `origin`, `face`, `vertex_half_edge` or `face_half_edge`.
    fn array(&self, part: &str) -> PyResult<Array> {
        let part = match part {
            "positions" => Part::Positions,
            "next" => Part::Next,
            "origin" => Part::Origin,
            "face" => Part::Face,
            "vertex_half_edge" => Part::VertexHalfEdge,
            "face_half_edge" => Part::FaceHalfEdge,
            _ => return Err(PyKeyError::new_err(part.to_owned())),
        };
        Array::of(&self.0, part).ok_or_else(|| PyKeyError::new_err("array"))
    }

    /// Returns two arrays. The first has the vertex of each corner, face by face. The second has the index of the first
    /// corner of each face, followed by the number of all corners.
    fn polygons(&self, py: Python<'_>) -> PyResult<(Array, Array)> {
        let (corners, starts) = run(py, None, |_| {
            let mesh = &self.0;
            let mut starts = Vec::with_capacity(mesh.n_faces() + 1);
            let mut corners = Vec::with_capacity(mesh.n_half_edges());
            for f in mesh.faces() {
                starts.push(corners.len() as u64);
                corners.extend(mesh.face_vertices(f).map(number));
            }
            starts.push(corners.len() as u64);
            (corners, starts)
        })?;
        Ok((Array::ids(corners), Array::indices(starts)))
    }

    /// The half-edge of each corner, face by face.
    fn corner_half_edges(&self, py: Python<'_>) -> PyResult<Array> {
        let half_edges = run(py, None, |_| corner_half_edges(&self.0))?;
        Ok(Array::ids(half_edges.into_iter().map(number).collect()))
    }

    /// Returns the domain, the name, the type of the values and the rule of each attribute. The domain is the kind of
    /// elements that have the attribute. The rule says how edits compute new values.
    fn attributes(&self) -> Vec<(String, String, &'static str, &'static str)> {
        let columns = self.0.attributes().iter();
        let described = columns.map(|(domain, column)| {
            let kind = column.values.type_name();
            (
                domain.to_string(),
                column.name.clone(),
                kind,
                rule_name(column.rule),
            )
        });
        described.collect()
    }

    /// Returns the values of an attribute. The values of corners are copied, in the order of the corners, face by face.
    fn attribute(&self, py: Python<'_>, domain_name: &str, name: &str) -> PyResult<Array> {
        let domain = domain(domain_name)?;
        let missing = || PyKeyError::new_err(name.to_owned());
        let column = self
            .0
            .attributes()
            .column(domain, name)
            .ok_or_else(missing)?;
        if domain != Domain::Corner {
            let part = Part::Column(domain, name.to_owned());
            return Array::of(&self.0, part).ok_or_else(missing);
        }
        let values = run(py, None, |_| {
            let half_edges = corner_half_edges(&self.0);
            let source = |i: usize| Some(half_edges[i].index());
            column.values.gather(half_edges.len(), source)
        })?;
        Ok(Array::column(values))
    }

    /// Returns a copy of the mesh with an additional attribute. `values` is a contiguous buffer with one row for each
    /// element.
    fn with_attribute(
        &self,
        py: Python<'_>,
        domain_name: &str,
        name: &str,
        values: &Bound<'_, PyAny>,
        columns: usize,
        rule_name: &str,
    ) -> PyResult<Self> {
        let (domain, rule) = (domain(domain_name)?, rule(rule_name)?);
        let values = values_from(values, columns)?;
        let is_corner = domain == Domain::Corner;
        let half_edges = if is_corner {
            run(py, None, |_| corner_half_edges(&self.0))?
        } else {
            Vec::new()
        };
        let expected = if is_corner {
            half_edges.len()
        } else {
            self.0.domain_len(domain)
        };
        if values.len() != expected {
            let message = format!(
                "{name:?} has {} values, but the mesh has {expected} {}",
                values.len(),
                plural(domain)
            );
            return Err(PyValueError::new_err(message));
        }
        let is_finite =
            |i: usize| (0..values.n_components()).all(|c| values.component(i, c).is_finite());
        if let Some(bad) = (0..values.len()).find(|&i| !is_finite(i)) {
            return Err(PyValueError::new_err(format!(
                "{name:?}: the value at index {bad} is not finite"
            )));
        }
        let changed = run(py, None, |_| {
            let mut mesh = (*self.0).clone();
            let values = if is_corner {
                let mut corner = vec![usize::MAX; mesh.domain_len(Domain::Corner)];
                for (i, h) in half_edges.iter().enumerate() {
                    corner[h.index()] = i;
                }
                let source = |h: usize| Some(corner[h]).filter(|&c| c != usize::MAX);
                values.gather(mesh.domain_len(Domain::Corner), source)
            } else {
                values
            };
            let name = name.to_owned();
            mesh.insert_column(domain, Column { name, rule, values });
            mesh
        })?;
        Ok(Self(Arc::new(changed)))
    }

    /// A copy of the mesh without this attribute.
    fn without_attribute(&self, domain_name: &str, name: &str) -> PyResult<Self> {
        let mut mesh = (*self.0).clone();
        let removed = mesh.remove_column(domain(domain_name)?, name);
        removed.ok_or_else(|| PyKeyError::new_err(name.to_owned()))?;
        Ok(Self(Arc::new(mesh)))
    }

    /// Returns a copy of the mesh with new positions. `positions` is a contiguous buffer with three numbers for each
    /// vertex.
    fn with_positions(&self, py: Python<'_>, positions: &Bound<'_, PyAny>) -> PyResult<Self> {
        let Values::Vec3(positions) = values_from(positions, 3)? else {
            return Err(PyValueError::new_err("positions must be numbers"));
        };
        if positions.len() != self.0.n_vertices() {
            return Err(PyValueError::new_err(format!(
                "{} positions, but the mesh has {} vertices",
                positions.len(),
                self.0.n_vertices()
            )));
        }
        if let Some(bad) = positions.iter().position(|p| !p.is_finite()) {
            return Err(PyValueError::new_err(format!(
                "the position of vertex {bad} is not finite"
            )));
        }
        let changed = run(py, None, |_| {
            let mut mesh = (*self.0).clone();
            mesh.positions_mut().copy_from_slice(&positions);
            mesh.remove_normals();
            mesh
        })?;
        Ok(Self(Arc::new(changed)))
    }

    /// Whether every edge has two faces.
    fn is_closed(&self) -> bool {
        self.0.is_closed()
    }

    /// The sum of the areas of all faces.
    fn area(&self, py: Python<'_>) -> PyResult<f64> {
        run(py, None, |_| geometry::area(&self.0))
    }

    /// The volume that the mesh encloses, if the mesh is closed.
    fn volume(&self, py: Python<'_>) -> PyResult<f64> {
        run(py, None, |_| geometry::volume(&self.0))
    }

    /// The lowest and the highest coordinates of the vertices; `None` for a mesh without vertices.
    fn bounds(&self, py: Python<'_>) -> PyResult<Option<[[f64; 3]; 2]>> {
        let bounds = run(py, None, |_| geometry::bounds(&self.0))?;
        Ok(bounds.map(|bounds| bounds.map(|point| point.to_array())))
    }

    /// Returns the distances from this surface to another surface, and from the other surface to this one. Each
    /// direction has three numbers: the largest distance that was found, an upper bound of all distances, and the mean
    /// distance. Returns `None` if one of the meshes has no faces.
    fn distance(
        &self,
        py: Python<'_>,
        other: &Self,
        tolerance: Option<f64>,
    ) -> PyResult<Option<[[f64; 3]; 2]>> {
        let found = run(py, None, |monitor| {
            Distance::between_with(&self.0, &other.0, tolerance, monitor)
        })?;
        let found = found.map_err(|cancelled| error(py, &cancelled.to_string()))?;
        let numbers = |side: &OneSided| [side.largest, side.at_most, side.mean];
        Ok(found.map(|found| [numbers(&found.forth), numbers(&found.back)]))
    }

    /// The Euler characteristic: the number of vertices, minus the number of edges, plus the number of faces.
    fn euler_characteristic(&self) -> i64 {
        self.0.euler_characteristic()
    }

    /// Describes each violated invariant of the half-edge structure. The list is empty for every mesh that this package
    /// creates.
    fn defects(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        run(py, None, |_| {
            self.0.defects().iter().map(ToString::to_string).collect()
        })
    }

    /// The memory of all arrays, in bytes.
    fn bytes(&self) -> usize {
        self.0.bytes()
    }

    fn same(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0) || self.0 == other.0
    }
}

fn plural(domain: Domain) -> &'static str {
    match domain {
        Domain::Vertex => "vertices",
        Domain::Corner => "corners",
        Domain::Edge => "edges",
        Domain::Face => "faces",
    }
}

/// Returns the id of an element as a number.
pub(crate) fn number(id: impl Id) -> u32 {
    u32::try_from(id.index()).expect("ids have 32 bits")
}
