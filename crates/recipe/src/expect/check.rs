//! Checks an expectation against a scene.

use mesh::{Domain, Mesh};
use op::{Elements, FaceSelection, Progress};
use scene::Object;

use super::places::double_edges;
use super::subject::{EdgeByVertices, Subject, selected, smallest_corner_angle};
use super::violation::{
    ActualValue, Violation, check_count, check_integer, check_number, fails_unless, rounded,
};
use super::{Expectation, OtherMesh, PlacedSubject, attribute, output, same, symmetry, textures};
use geometry::distance::{Distance, TOLERANCE, diagonal};

impl Expectation {
    /// Checks the expectation against a scene. An expectation about positions or sizes of meshes, such as `Bounds` or
    /// `Area`, is checked against every instance of an object, in scene space.
    ///
    /// # Errors
    ///
    /// Returns a [`Violation`]. If the expectation does not hold, its message gives the expected and the actual value.
    /// If the expectation cannot be checked, its message gives the reason.
    pub fn check(&self, subject: Subject) -> Result<(), Violation> {
        if self.measures_space() && !subject.scene.graph().is_empty() {
            let placed = PlacedSubject::new(subject, self.other_object())?;
            return self.check_as_is(placed.subject());
        }
        self.check_as_is(subject)
    }

    /// Whether the expectation is checked against the instances of objects in scene space.
    pub(crate) fn measures_space(&self) -> bool {
        matches!(
            self,
            Self::Area { .. }
                | Self::Volume { .. }
                | Self::Bounds { .. }
                | Self::DihedralAngle { .. }
                | Self::EdgeLength { .. }
                | Self::MinAngle { .. }
                | Self::MeanMinAngle { .. }
                | Self::Thickness { .. }
                | Self::MeanFaceArea { .. }
                | Self::Position { .. }
                | Self::Same { .. }
                | Self::DistanceTo { .. }
                | Self::SymmetricUnder { .. }
        )
    }

    /// Returns the name of the object with which the expectation compares the meshes. `None` if the expectation
    /// compares the meshes with a mesh in a file, or does not compare meshes.
    fn other_object(&self) -> Option<&str> {
        match self {
            Self::Same {
                r#as: OtherMesh::Object(name),
                ..
            }
            | Self::DistanceTo {
                other: OtherMesh::Object(name),
                ..
            } => Some(name),
            _ => None,
        }
    }

    #[expect(clippy::too_many_lines, reason = "one arm for each expectation")]
    fn check_as_is(&self, subject: Subject) -> Result<(), Violation> {
        match self {
            Self::Not(inner) => match inner.check(subject) {
                Ok(()) => Err(Violation::unmet(format!(
                    "expected {} not to hold, but it does",
                    inner.as_written()
                ))),
                Err(violation) if violation.is_unknown => Err(violation.message.into()),
                Err(_) => Ok(()),
            },
            Self::Digest(expected) => {
                let found = subject.scene.digest().to_string();
                if *expected == found {
                    return Ok(());
                }
                let message = format!("expected the scene to have the digest {expected}, found {found}");
                Err(Violation::with_actual(message, ActualValue::Digest(found)))
            }
            Self::Output {
                path,
                r#as,
                tolerance,
            } => output::check(subject, path, r#as, *tolerance),
            Self::Objects { eq, min, max } => {
                let found = subject.objects()?.len() as u64;
                check_count("objects", found, [*eq, *min, *max])
            }
            Self::Vertices { eq, min, max } => {
                let found = subject.points()?.len() as u64;
                check_count("vertices", found, [*eq, *min, *max])
            }
            Self::Edges { eq, min, max } => {
                let found = subject.sum(|m| m.n_edges() as u64)?;
                check_count("edges", found, [*eq, *min, *max])
            }
            Self::Faces { eq, min, max } => {
                let found = subject.sum(|m| m.n_faces() as u64)?;
                check_count("faces", found, [*eq, *min, *max])
            }
            Self::Components { eq, min, max } => {
                let found = subject.sum(|m| geometry::n_components(m) as u64)?;
                check_count("components", found, [*eq, *min, *max])
            }
            Self::BoundaryLoops { eq, min, max } => {
                let found = subject.sum(|m| m.n_boundary_loops() as u64)?;
                check_count("boundary loops", found, [*eq, *min, *max])
            }
            Self::EulerCharacteristic { eq, min, max } => {
                let found = subject.sum(Mesh::euler_characteristic)?;
                check_integer("an Euler characteristic", found, [*eq, *min, *max])
            }
            Self::Genus { eq, min, max } => {
                let found = subject.sum(geometry::genus)?;
                check_integer("a genus", found, [*eq, *min, *max])
            }
            Self::Area {
                eq,
                min,
                max,
                tolerance,
            } => {
                let found = subject.sum(geometry::area)?;
                check_number("an area", found, [*eq, *min, *max], *tolerance)
            }
            Self::Volume {
                eq,
                min,
                max,
                tolerance,
            } => {
                let found = subject.sum(geometry::volume)?;
                check_number("a volume", found, [*eq, *min, *max], *tolerance)
            }
            Self::Bounds {
                min,
                max,
                tolerance,
            } => subject.bounds(*min, *max, *tolerance),
            Self::Manifold => subject.each_mesh(manifold),
            Self::Closed => subject.each_mesh(|name, mesh| {
                let open = mesh.edges().find(|&e| mesh.is_boundary_edge(e));
                open.map_or(Ok(()), |e| {
                    let edge = EdgeByVertices(mesh, e);
                    Err(Violation::unmet(format!(
                        "expected no boundary edges, but {edge} of \"{name}\" is a boundary edge"
                    )))
                })
            }),
            Self::Count { of, eq, min, max } => {
                let mut found = 0;
                for (object, mesh) in subject.meshes()? {
                    found += count(of, object, mesh, subject)?;
                }
                let what = format_args!("selected {}", of.kind().word());
                check_count(what, found, [*eq, *min, *max])
            }
            Self::Valence { of, eq, min, max } => subject.each_selected(of, |mesh, v| {
                let valence = mesh.valence(v) as u64;
                check_count(format_args!("edges at {v}"), valence, [*eq, *min, *max])
            }),
            Self::DihedralAngle {
                of,
                min,
                max,
                reaches,
            } => subject.dihedral(of, [*min, *max, *reaches]),
            Self::EdgeLength { of, min, max } => subject.each_selected(of, |mesh, e| {
                let what = format_args!("{} to have a length", EdgeByVertices(mesh, e));
                check_number(what, mesh.length(e.half_edge()), [None, *min, *max], 0.0)
            }),
            Self::MinAngle { of, min, max } => {
                let (angle, face) = subject.smallest_angle(of)?;
                let what = format_args!("a smallest corner angle (at {face})");
                check_number(what, angle, [None, *min, *max], 0.0)
            }
            Self::MeanMinAngle { of, min, max } => {
                let (mut sum, mut n) = (0.0, 0.0);
                subject.each_selected(of, |mesh, f| {
                    sum += smallest_corner_angle(mesh, f);
                    n += 1.0;
                    Ok(())
                })?;
                check_number("a mean smallest corner angle", sum / n, [None, *min, *max], 0.0)
            }
            Self::Thickness { of, min, max } => subject.thickness(of, [None, *min, *max]),
            Self::SelfIntersections { eq, min, max } => {
                let mut found = 0;
                for (object, mesh) in subject.meshes()? {
                    let of = FaceSelection::SelfIntersecting;
                    found += selected(&of, object, mesh, subject)?.len() as u64;
                }
                check_count("self-intersecting faces", found, [*eq, *min, *max])
            }
            Self::MeanFaceArea { of, min, max } => subject.mean_area(of, [None, *min, *max]),
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
                let other = subject.other_mesh(r#as)?;
                same::check(mesh, &other, *tolerance, *connectivity)
            }
            Self::DistanceTo { other, below } => {
                let (_, mesh) = subject.one_mesh()?;
                distance_below(mesh, subject.other_mesh(other)?.as_ref(), *below, subject.progress)
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
                check_count("symmetries", found, [eq.or(all), *min, *max])
            }
            Self::Attribute {
                name,
                of,
                component,
                min,
                max,
            } => attribute::check(subject, name, of.as_ref(), *component, [None, *min, *max]),
            Self::UvStretch { uv, max } => {
                let found = textures::stretch(subject, uv)?;
                check_number("a stretch", found, [None, None, Some(*max)], 0.0)
            }
            Self::UvOverlap { uv, eq, min, max } => {
                let found = textures::n_overlapping(subject, uv)?;
                check_count("faces that overlap in the texture", found, [*eq, *min, *max])
            }
            Self::HasAttribute { domain, name } => subject.each_mesh(|object, mesh| {
                let domain = Domain::from(*domain);
                fails_unless(mesh.attributes().column(domain, name).is_some(), || {
                    format!("expected the {domain} attribute \"{name}\", but \"{object}\" does not have it")
                })
            }),
        }
    }
}

fn count(of: &Elements, object: &Object, mesh: &Mesh, subject: Subject) -> Result<u64, Violation> {
    let n = match of {
        Elements::Vertices(s) => selected(s, object, mesh, subject)?.len(),
        Elements::Edges(s) => selected(s, object, mesh, subject)?.len(),
        Elements::Faces(s) => selected(s, object, mesh, subject)?.len(),
    };
    Ok(n as u64)
}

/// Checks that the Hausdorff distance of two meshes is certainly below a limit. The smaller the limit, the smaller the
/// tolerance of the measurement, so that small limits can be checked, too.
fn distance_below(
    mesh: &Mesh,
    other: &Mesh,
    below: f64,
    progress: &dyn Progress,
) -> Result<(), Violation> {
    let size = diagonal(mesh, other);
    let tolerance = (TOLERANCE * size).min(1e-3 * below).max(1e-12 * size);
    let found = Distance::between_with(mesh, other, Some(tolerance), progress);
    let Some(found) = found.map_err(|cancelled| cancelled.to_string())? else {
        let message =
            format!("expected a distance below {below}, but one of the two meshes has no faces");
        return Err(Violation::unmet(message));
    };
    fails_unless(found.at_most() < below, || {
        let (largest, worst) = (found.largest(), found.worst());
        let range = if largest < below {
            format!("{largest} to {}", found.at_most())
        } else {
            rounded(largest, below)
        };
        let (from, to) = (worst.from, worst.to);
        let endpoints = if found.is_worst_forth() {
            format!("from {from} to {to} of the other mesh")
        } else {
            format!("from {from} of the other mesh to {to}")
        };
        format!(
            "expected a distance below {below}, found {range}; the distance is largest {endpoints}"
        )
    })
}

fn manifold(name: &str, mesh: &Mesh) -> Result<(), Violation> {
    // `is_valid` runs on all threads; `defects` is slower and needed only for the message.
    if !mesh.is_valid()
        && let Some(defect) = mesh.defects().first()
    {
        let message = format!("expected a manifold, but \"{name}\" has a defect: {defect}");
        return Err(Violation::unmet(message));
    }
    double_edges(mesh).first().map_or(Ok(()), |&e| {
        let [v, w] = mesh.edge_vertices(e);
        Err(Violation::unmet(format!(
            "expected a manifold, but several edges of \"{name}\" join the vertices {v} and {w}"
        )))
    })
}
