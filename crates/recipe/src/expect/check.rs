//! Holding an expectation against a scene.

use mesh::{Domain, Mesh};
use op::Files;
use scene::Object;

use super::subject::{Failure, Subject, ends, fails_unless, near, selected, within};
use super::{Elements, Expectation, distance, same, symmetry};

impl Expectation {
    /// Holds the expectation against a scene.
    ///
    /// # Errors
    ///
    /// What was expected and what was found, in one line.
    pub fn check(&self, subject: Subject) -> Result<(), String> {
        self.ask(subject).map_err(|failure| match failure {
            Failure::Unmet(message) | Failure::Unknown(message) => message,
        })
    }

    #[expect(clippy::too_many_lines, reason = "one arm for each expectation")]
    fn ask(&self, subject: Subject) -> Result<(), Failure> {
        match self {
            Self::Not(inner) => match inner.ask(subject) {
                Ok(()) => Err(Failure::Unmet(format!(
                    "expected {inner} not to hold, but it does"
                ))),
                Err(Failure::Unmet(_)) => Ok(()),
                Err(unknown) => Err(unknown),
            },
            Self::Digest(expected) => {
                let found = subject.scene.digest().to_string();
                let same = *expected == found;
                fails_unless(same, || {
                    format!("expected the digest {expected}, found {found}")
                })
            }
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
                subject.sum(|m| m.n_components() as u64)?,
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
                within("as genus", subject.sum(Mesh::genus)?, *eq, *min, *max)
            }
            Self::Area {
                eq,
                min,
                max,
                tolerance,
            } => near(
                "an area",
                subject.sum(Mesh::area)?,
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
                subject.sum(Mesh::volume)?,
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
                    found += of.count(object, mesh, subject.files)?;
                }
                within(of.word(), found, *eq, *min, *max)
            }
            Self::Valence { of, min, max } => subject.valence(of, *min, *max),
            Self::DihedralAngle {
                of,
                min,
                max,
                reaches,
            } => subject.dihedral(of, *min, *max, *reaches),
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
                let found = distance::largest(mesh, subject.other(other)?.as_ref());
                fails_unless(found < *below, || {
                    format!("expected a distance below {below}, found {found}")
                })
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

impl Elements {
    fn word(&self) -> &'static str {
        match self {
            Self::Vertices(_) => "selected vertices",
            Self::Edges(_) => "selected edges",
            Self::Faces(_) => "selected faces",
        }
    }

    fn count(&self, object: &Object, mesh: &Mesh, files: &Files) -> Result<u64, Failure> {
        let n = match self {
            Self::Vertices(s) => selected(s, object, mesh, files)?.len(),
            Self::Edges(s) => selected(s, object, mesh, files)?.len(),
            Self::Faces(s) => selected(s, object, mesh, files)?.len(),
        };
        Ok(n as u64)
    }
}

fn manifold(name: &str, mesh: &Mesh) -> Result<(), Failure> {
    if let Some(defect) = mesh.defects().first() {
        let message = format!("expected a manifold, but in {name} {defect}");
        return Err(Failure::Unmet(message));
    }
    let mut pairs: Vec<_> = mesh
        .edges()
        .map(|e| {
            let [v, w] = mesh.edge_vertices(e);
            [v.min(w), v.max(w)]
        })
        .collect();
    pairs.sort_unstable();
    let double = pairs.windows(2).find(|w| w[0] == w[1]);
    double.map_or(Ok(()), |w| {
        let [v, w] = w[0];
        Err(Failure::Unmet(format!(
            "expected a manifold, but in {name} several edges join {v} and {w}"
        )))
    })
}
