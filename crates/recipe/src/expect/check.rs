//! Holding an expectation against a scene.

use mesh::{Domain, Mesh};
use op::{Elements, Files};
use scene::Object;

use super::places::double_edges;
use super::subject::{Failure, Found, Subject, ends, fails_unless, near, selected, within};
use super::{Expectation, output, same, symmetry};
use geometry::distance::{Distance, TOLERANCE, diagonal};

/// An expectation that does not hold.
#[derive(Clone, Debug, PartialEq)]
pub struct Broken {
    /// What was expected and what was found, in one line.
    pub message: String,
    /// What was found, if a value that the expectation records is another one.
    pub found: Option<Found>,
}

impl Expectation {
    /// Holds the expectation against a scene.
    ///
    /// # Errors
    ///
    /// What was expected and what was found, in one line.
    pub fn check(&self, subject: Subject) -> Result<(), String> {
        self.hold(subject).map_err(|broken| broken.message)
    }

    /// The same, with what was found in place of a value that the expectation records.
    ///
    /// # Errors
    ///
    /// As [`check`](Self::check).
    pub fn hold(&self, subject: Subject) -> Result<(), Broken> {
        self.ask(subject).map_err(|failure| match failure {
            Failure::Recorded(message, found) => Broken {
                message,
                found: Some(found),
            },
            Failure::Unmet(message) | Failure::Unknown(message) => Broken {
                message,
                found: None,
            },
        })
    }

    #[expect(clippy::too_many_lines, reason = "one arm for each expectation")]
    fn ask(&self, subject: Subject) -> Result<(), Failure> {
        match self {
            Self::Not(inner) => match inner.ask(subject) {
                Ok(()) => Err(Failure::Unmet(format!(
                    "expected {inner} not to hold, but it does"
                ))),
                Err(Failure::Recorded(
                    message,
                    Found::File {
                        is_unknown: true, ..
                    },
                )) => Err(Failure::Unknown(message)),
                Err(Failure::Unmet(_) | Failure::Recorded(..)) => Ok(()),
                Err(unknown) => Err(unknown),
            },
            Self::Digest(expected) => {
                let found = subject.scene.digest().to_string();
                if *expected == found {
                    return Ok(());
                }
                let message = format!("expected the digest {expected}, found {found}");
                Err(Failure::Recorded(message, Found::Digest(found)))
            }
            Self::Output {
                path,
                r#as,
                tolerance,
            } => output::check(subject, path, r#as, *tolerance),
            Self::Objects { eq, min, max } => {
                within("objects", subject.objects()?.len() as u64, *eq, *min, *max)
            }
            Self::Vertices { eq, min, max } => {
                within("vertices", subject.points()?.len() as u64, *eq, *min, *max)
            }
            Self::Edges { eq, min, max } => within(
                "edges",
                subject.sum(|m| m.n_edges() as u64)?,
                *eq,
                *min,
                *max,
            ),
            Self::Faces { eq, min, max } => within(
                "faces",
                subject.sum(|m| m.n_faces() as u64)?,
                *eq,
                *min,
                *max,
            ),
            Self::Components { eq, min, max } => within(
                "components",
                subject.sum(|m| geometry::n_components(m) as u64)?,
                *eq,
                *min,
                *max,
            ),
            Self::BoundaryLoops { eq, min, max } => {
                let found = subject.sum(|m| m.n_boundary_loops() as u64)?;
                within("boundary loops", found, *eq, *min, *max)
            }
            Self::EulerCharacteristic { eq, min, max } => {
                let found = subject.sum(Mesh::euler_characteristic)?;
                within("as Euler characteristic", found, *eq, *min, *max)
            }
            Self::Genus { eq, min, max } => {
                within("as genus", subject.sum(geometry::genus)?, *eq, *min, *max)
            }
            Self::Area {
                eq,
                min,
                max,
                tolerance,
            } => near(
                "an area",
                subject.sum(geometry::area)?,
                [*eq, *min, *max],
                *tolerance,
            ),
            Self::Volume {
                eq,
                min,
                max,
                tolerance,
            } => near(
                "a volume",
                subject.sum(geometry::volume)?,
                [*eq, *min, *max],
                *tolerance,
            ),
            Self::Bounds {
                min,
                max,
                tolerance,
            } => subject.bounds(*min, *max, *tolerance),
            Self::Manifold => subject.each_mesh(manifold),
            Self::Closed => subject.each_mesh(|name, mesh| {
                let open = mesh.edges().find(|&e| mesh.is_boundary_edge(e));
                open.map_or(Ok(()), |e| {
                    let edge = ends(mesh, e);
                    Err(Failure::Unmet(format!(
                        "expected no boundary, but {name} has one at {edge}"
                    )))
                })
            }),
            Self::Count { of, eq, min, max } => {
                let mut found = 0;
                for (object, mesh) in subject.meshes()? {
                    found += count(of, object, mesh, subject.files)?;
                }
                within(
                    &format!("selected {}", of.kind().word()),
                    found,
                    *eq,
                    *min,
                    *max,
                )
            }
            Self::Valence { of, min, max } => subject.valence(of, *min, *max),
            Self::DihedralAngle {
                of,
                min,
                max,
                reaches,
            } => subject.dihedral(of, *min, *max, *reaches),
            Self::EdgeLength { of, min, max } => subject.edge_length(of, *min, *max),
            Self::MinAngle { of, min, max } => {
                let (angle, at) = subject.smallest_angle(of)?;
                let what = format!("a smallest corner angle, that of {at},");
                near(&what, angle, [None, *min, *max], 0.0)
            }
            Self::MeanFaceArea { of, min, max } => subject.mean_area(of, *min, *max),
            Self::Position { of, is, tolerance } => subject.position(of, (*is).into(), *tolerance),
            Self::Point {
                line,
                index,
                is,
                tolerance,
            } => subject.point(*line, *index, (*is).into(), *tolerance),
            Self::Same {
                r#as,
                tolerance,
                connectivity,
            } => {
                let (_, mesh) = subject.one_mesh()?;
                same::check(
                    mesh,
                    subject.other(r#as)?.as_ref(),
                    *tolerance,
                    *connectivity,
                )
                .map_err(Failure::Unmet)
            }
            Self::DistanceTo { other, below } => {
                let (_, mesh) = subject.one_mesh()?;
                distance_below(mesh, subject.other(other)?.as_ref(), *below)
            }
            Self::SymmetricUnder {
                group,
                eq,
                min,
                max,
                tolerance,
                connectivity,
            } => {
                let (_, mesh) = subject.one_mesh()?;
                let motions = group.motions();
                let found = symmetry::count(mesh, &motions, *tolerance, *connectivity);
                let all = (eq.is_none() && min.is_none() && max.is_none())
                    .then_some(motions.len() as u64);
                within("symmetries", found, eq.or(all), *min, *max)
            }
            Self::HasAttribute { domain, name } => subject.each_mesh(|object, mesh| {
                let domain = Domain::from(*domain);
                fails_unless(mesh.attributes().column(domain, name).is_some(), || {
                    format!("expected the {domain} attribute \"{name}\", but {object} has none")
                })
            }),
        }
    }
}

fn count(of: &Elements, object: &Object, mesh: &Mesh, files: &Files) -> Result<u64, Failure> {
    let n = match of {
        Elements::Vertices(s) => selected(s, object, mesh, files)?.len(),
        Elements::Edges(s) => selected(s, object, mesh, files)?.len(),
        Elements::Faces(s) => selected(s, object, mesh, files)?.len(),
    };
    Ok(n as u64)
}

/// Whether the Hausdorff distance is below a limit for certain: what could be on either side of it is measured
/// as finely as it takes.
fn distance_below(mesh: &Mesh, other: &Mesh, below: f64) -> Result<(), Failure> {
    let size = diagonal(mesh, other);
    let tolerance = (TOLERANCE * size).min(1e-3 * below).max(1e-12 * size);
    let Some(found) = Distance::between(mesh, other, Some(tolerance)) else {
        let message = format!("expected a distance below {below}, but a mesh has no faces");
        return Err(Failure::Unmet(message));
    };
    fails_unless(found.at_most() < below, || {
        let (largest, worst) = (found.largest(), found.worst());
        let range = if largest < below {
            format!("{largest} to {}", found.at_most())
        } else {
            largest.to_string()
        };
        let (from, to) = (worst.from, worst.to);
        let way = if found.is_worst_forth() {
            format!("from {from} to {to} of the other")
        } else {
            format!("from {from} of the other to {to}")
        };
        format!("expected a distance below {below}, found {range}: {way}")
    })
}

fn manifold(name: &str, mesh: &Mesh) -> Result<(), Failure> {
    // All threads ask first: naming what is wrong takes longer.
    if !mesh.is_valid()
        && let Some(defect) = mesh.defects().first()
    {
        let message = format!("expected a manifold, but in {name} {defect}");
        return Err(Failure::Unmet(message));
    }
    double_edges(mesh).first().map_or(Ok(()), |&e| {
        let [v, w] = mesh.edge_vertices(e);
        Err(Failure::Unmet(format!(
            "expected a manifold, but in {name} several edges join {v} and {w}"
        )))
    })
}
