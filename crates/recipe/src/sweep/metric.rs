//! What a sweep keeps of each run: numbers, by the measures that expectations take.

use std::fmt;

use mesh::Mesh;
use op::{FaceSelection, Files};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::expect::{OtherMesh, Reader, Subject};
use crate::run::Outcome;
use geometry::distance::Distance;

/// What is kept of a run. Where it speaks of the mesh, it means all meshes at the end together.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Metric {
    /// How many objects there are.
    Objects,
    /// How many vertices; points of polylines count too.
    Vertices,
    /// How many edges.
    Edges,
    /// How many faces.
    Faces,
    /// How many connected parts.
    Components,
    /// How many holes.
    BoundaryLoops,
    /// V - E + F.
    EulerCharacteristic,
    /// How many handles.
    Genus,
    /// The sum of the areas of the faces, in square scene units.
    Area,
    /// The volume inside, in cubic scene units.
    Volume,
    /// The smallest angle between neighboring sides of a face, in degrees.
    MinAngle,
    /// The largest distance between the surfaces of the mesh and another, as the expectation of this name
    /// measures it, in scene units.
    DistanceTo {
        /// The other.
        other: OtherMesh,
        /// The object that is meant, if there are several meshes.
        on: Option<String>,
    },
    /// How long the steps took, in seconds: the only one that two runs do not share.
    Seconds,
    /// The digest of the scene.
    Digest,
}

/// A measure of a run.
#[derive(Clone, Debug, PartialEq)]
pub enum Measured {
    /// A whole number.
    Whole(i64),
    /// A number; infinite where there is nothing to measure, as the distance to a mesh without faces.
    Number(f64),
    /// A text.
    Text(String),
}

impl Metric {
    /// Measures a run that succeeded. `files` and `reader` serve to read what it is compared with.
    ///
    /// # Errors
    ///
    /// What is missing, in one line: an object, a file, a face.
    pub fn measure(
        &self,
        outcome: &Outcome,
        files: &Files,
        reader: &dyn Reader,
    ) -> Result<Measured, String> {
        let scene = outcome.scene.as_ref();
        let subject = Subject {
            scene: scene.ok_or("the scene stayed in the cache")?,
            on: None,
            files,
            reader,
        };
        let whole = |n: usize| Measured::Whole(i64::try_from(n).unwrap_or(i64::MAX));
        Ok(match self {
            Self::Objects => whole(subject.objects()?.len()),
            Self::Vertices => whole(subject.points()?.len()),
            Self::Edges => whole(subject.sum(Mesh::n_edges)?),
            Self::Faces => whole(subject.sum(Mesh::n_faces)?),
            Self::Components => whole(subject.sum(geometry::n_components)?),
            Self::BoundaryLoops => whole(subject.sum(Mesh::n_boundary_loops)?),
            Self::EulerCharacteristic => Measured::Whole(subject.sum(Mesh::euler_characteristic)?),
            Self::Genus => Measured::Whole(subject.sum(geometry::genus)?),
            Self::Area => Measured::Number(subject.sum(geometry::area)?),
            Self::Volume => Measured::Number(subject.sum(geometry::volume)?),
            Self::MinAngle => {
                let smallest = subject.smallest_angle(&FaceSelection::All);
                Measured::Number(smallest.map_err(|broken| broken.message)?.0)
            }
            Self::DistanceTo { other, on } => {
                let on = on.as_ref().map(std::slice::from_ref);
                let (_, mesh) = Subject { on, ..subject }.one_mesh()?;
                let other = subject.other_mesh(other)?;
                let distance = Distance::between(mesh, other.as_ref(), None);
                Measured::Number(distance.map_or(f64::INFINITY, |d| d.largest()))
            }
            Self::Seconds => {
                let times = outcome.steps.iter().map(|step| step.time);
                Measured::Number(times.sum::<std::time::Duration>().as_secs_f64())
            }
            Self::Digest => Measured::Text(outcome.digest.to_string()),
        })
    }

    /// The object or file that it compares with.
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
