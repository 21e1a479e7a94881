//! The metrics of a sweep: the values that a sweep records for each run.

use std::fmt;

use mesh::Mesh;
use op::{FaceSelection, Files, Statistics};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::expect::{self, OtherMesh, PlacedSubject, Reader, Subject, Violation};
use crate::run::Outcome;
use geometry::distance::Distance;

/// A value that a sweep records for each run. The value is measured at the end of the run, for all meshes together.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Metric {
    /// The number of objects.
    Objects,
    /// The number of vertices, including the points of polylines, curves and patches.
    Vertices,
    /// The number of edges.
    Edges,
    /// The number of faces.
    Faces,
    /// The number of connected components.
    Components,
    /// The number of boundary loops: closed loops of boundary edges.
    BoundaryLoops,
    /// The Euler characteristic: vertices - edges + faces.
    EulerCharacteristic,
    /// The genus, which is the number of handles: 0 for a sphere, 1 for a torus.
    Genus,
    /// The sum of the areas of the faces, in square scene units.
    Area,
    /// The enclosed volume, in cubic scene units.
    Volume,
    /// The smallest corner angle of all faces, in degrees.
    MinAngle,
    /// The two-sided Hausdorff distance between the surface of the mesh and the surface of another mesh, in scene
    /// units.
    DistanceTo {
        /// The mesh to compare with.
        other: OtherMesh,
        /// The name of the object to measure. `on` is required if the scene has several meshes.
        on: Option<String>,
    },
    /// A statistic of the values of an attribute, for example of an attribute that `Measure` stored.
    Attribute {
        /// The name of the attribute. If several kinds of elements have an attribute of this name, the first of these
        /// kinds is used: vertices, faces, corners, edges.
        name: String,
        /// The statistic.
        statistic: Statistic,
        /// The index of the component of a vector, starting at 0. Required for vectors.
        #[schemars(range(max = 3))]
        component: Option<u32>,
        /// The name of the object to measure. If omitted, all meshes are measured together, and each mesh must have the
        /// attribute.
        on: Option<String>,
    },
    /// The time that the steps took, in seconds. This is the only metric that can differ if the same run is repeated.
    Seconds,
    /// The digest of the scene.
    Digest,
}

/// A statistic of the values of an attribute.
#[derive(Clone, Copy, Debug, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Statistic {
    /// The lowest value.
    Min,
    /// The mean of the values.
    Mean,
    /// The highest value.
    Max,
}

/// The value of a metric.
#[derive(Clone, Debug, PartialEq)]
pub enum Measured {
    /// A whole number.
    Whole(i64),
    /// A number. The number is infinite if there is nothing to measure. For example, the distance to a mesh without
    /// faces is infinite.
    Number(f64),
    /// A string.
    Text(String),
}

impl Metric {
    /// Measures a successful run. `files` and `reader` are used to read the mesh to compare with.
    ///
    /// # Errors
    ///
    /// Returns a [`Violation`] if the metric cannot be measured, for example because an object or a file is missing.
    pub fn measure(
        &self,
        outcome: &Outcome,
        files: &Files,
        reader: &dyn Reader,
    ) -> Result<Measured, Violation> {
        let scene = outcome.scene.as_ref();
        let subject = Subject {
            scene: scene.ok_or("the final scene was not loaded from the cache")?,
            on: None,
            files,
            reader,
            progress: &op::NoProgress,
        };
        let whole = |n: usize| Measured::Whole(i64::try_from(n).unwrap_or(i64::MAX));
        let placed = || PlacedSubject::new(subject, None);
        Ok(match self {
            Self::Objects => whole(subject.objects()?.len()),
            Self::Vertices => whole(subject.points()?.len()),
            Self::Edges => whole(subject.sum(Mesh::n_edges)?),
            Self::Faces => whole(subject.sum(Mesh::n_faces)?),
            Self::Components => whole(subject.sum(geometry::n_components)?),
            Self::BoundaryLoops => whole(subject.sum(Mesh::n_boundary_loops)?),
            Self::EulerCharacteristic => Measured::Whole(subject.sum(Mesh::euler_characteristic)?),
            Self::Genus => Measured::Whole(subject.sum(geometry::genus)?),
            Self::Area => Measured::Number(placed()?.subject().sum(geometry::area)?),
            Self::Volume => Measured::Number(placed()?.subject().sum(geometry::volume)?),
            Self::MinAngle => {
                let placed = placed()?;
                let (smallest, _) = placed.subject().smallest_angle(&FaceSelection::All)?;
                Measured::Number(smallest)
            }
            Self::DistanceTo { other, on } => {
                let on = on.as_ref().map(std::slice::from_ref);
                let name = match other {
                    OtherMesh::Object(name) => Some(name.as_str()),
                    OtherMesh::File(_) => None,
                };
                let placed = PlacedSubject::new(Subject { on, ..subject }, name)?;
                let (_, mesh) = placed.subject().one_mesh()?;
                let other = placed.subject().other_mesh(other)?;
                let distance = Distance::between(mesh, other.as_ref(), None);
                Measured::Number(distance.map_or(f64::INFINITY, |d| d.largest()))
            }
            Self::Attribute {
                name,
                statistic,
                component,
                on,
            } => {
                let on = on.as_ref().map(std::slice::from_ref);
                let values = expect::values(Subject { on, ..subject }, name, *component)?;
                let found = Statistics::of(&values).ok_or("no value is finite")?;
                Measured::Number(match statistic {
                    Statistic::Min => found.min,
                    Statistic::Mean => found.mean,
                    Statistic::Max => found.max,
                })
            }
            Self::Seconds => {
                let times = outcome.steps.iter().map(|step| step.time);
                Measured::Number(times.sum::<std::time::Duration>().as_secs_f64())
            }
            Self::Digest => Measured::Text(outcome.digest.to_string()),
        })
    }

    /// Returns the mesh that the metric compares with, if any.
    pub fn other(&self) -> Option<&OtherMesh> {
        match self {
            Self::DistanceTo { other, .. } => Some(other),
            _ => None,
        }
    }
}

impl fmt::Display for Measured {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Whole(n) => write!(f, "{n}"),
            Self::Number(x) => write!(f, "{x}"),
            Self::Text(text) => f.write_str(text),
        }
    }
}
