//! Expectations: what must hold for the scene after a step or at the end.

mod distance;
mod same;
mod symmetry;

use std::fmt;
use std::path::Path;
use std::sync::Arc;

use mesh::{DVec3, Domain, EdgeId, FaceId, Mesh};
use op::{
    Context, EdgeSelection, FaceSelection, Files, NoProgress, OpError, Select, Vector,
    VertexSelection,
};
use scene::{Geometry, Object, Scene};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use symmetry::Group;

/// What must hold for a scene. Where it speaks of the mesh, it means all meshes together, or those of
/// the objects that `on:` names.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Expectation {
    /// How many objects there are.
    Objects {
        /// Exactly so many.
        eq: Option<u64>,
        /// At least so many.
        min: Option<u64>,
        /// At most so many.
        max: Option<u64>,
    },
    /// How many vertices; points of polylines count too.
    Vertices {
        /// Exactly so many.
        eq: Option<u64>,
        /// At least so many.
        min: Option<u64>,
        /// At most so many.
        max: Option<u64>,
    },
    /// How many edges.
    Edges {
        /// Exactly so many.
        eq: Option<u64>,
        /// At least so many.
        min: Option<u64>,
        /// At most so many.
        max: Option<u64>,
    },
    /// How many faces.
    Faces {
        /// Exactly so many.
        eq: Option<u64>,
        /// At least so many.
        min: Option<u64>,
        /// At most so many.
        max: Option<u64>,
    },
    /// How many connected parts.
    Components {
        /// Exactly so many.
        eq: Option<u64>,
        /// At least so many.
        min: Option<u64>,
        /// At most so many.
        max: Option<u64>,
    },
    /// How many holes.
    BoundaryLoops {
        /// Exactly so many.
        eq: Option<u64>,
        /// At least so many.
        min: Option<u64>,
        /// At most so many.
        max: Option<u64>,
    },
    /// V - E + F.
    EulerCharacteristic {
        /// Exactly this.
        eq: Option<i64>,
        /// At least this.
        min: Option<i64>,
        /// At most this.
        max: Option<i64>,
    },
    /// How many handles.
    Genus {
        /// Exactly so many.
        eq: Option<i64>,
        /// At least so many.
        min: Option<i64>,
        /// At most so many.
        max: Option<i64>,
    },
    /// The sum of the areas of the faces.
    Area {
        /// This, within the tolerance.
        eq: Option<f64>,
        /// At least this.
        min: Option<f64>,
        /// At most this.
        max: Option<f64>,
        /// How far from `eq` it may be.
        #[serde(default = "tolerance")]
        #[schemars(range(min = 0.0))]
        tolerance: f64,
    },
    /// The volume inside.
    Volume {
        /// This, within the tolerance.
        eq: Option<f64>,
        /// At least this.
        min: Option<f64>,
        /// At most this.
        max: Option<f64>,
        /// How far from `eq` it may be.
        #[serde(default = "tolerance")]
        #[schemars(range(min = 0.0))]
        tolerance: f64,
    },
    /// The lowest and highest coordinates of all points.
    Bounds {
        /// The lowest coordinates.
        min: Vector,
        /// The highest coordinates.
        max: Vector,
        /// How far each coordinate may be from that.
        #[serde(default = "tolerance")]
        #[schemars(range(min = 0.0))]
        tolerance: f64,
    },
    /// There is a mesh, and every mesh is a valid manifold; so is each that this program builds, and
    /// this checks it anew. No two edges join the same vertices.
    Manifold,
    /// There is a mesh, and no edge is on a boundary.
    Closed,
    /// How many elements a selection has.
    Count {
        /// Which elements.
        of: Elements,
        /// Exactly so many.
        eq: Option<u64>,
        /// At least so many.
        min: Option<u64>,
        /// At most so many.
        max: Option<u64>,
    },
    /// The valences of all vertices of a selection, which must not be empty.
    Valence {
        /// Which vertices.
        #[serde(default)]
        of: VertexSelection,
        /// The lowest is at least this.
        min: Option<u64>,
        /// The highest is at most this.
        max: Option<u64>,
    },
    /// The angles, in degrees, by which the faces turn at all edges of a selection that have two; there
    /// must be one.
    DihedralAngle {
        /// Which edges.
        #[serde(default)]
        of: EdgeSelection,
        /// The smallest is at least this.
        min: Option<f64>,
        /// The largest is at most this.
        max: Option<f64>,
        /// Some angle is at least this.
        reaches: Option<f64>,
    },
    /// The mean area of the faces of a selection, in proportion to the median area of all faces.
    MeanFaceArea {
        /// Which faces.
        of: FaceSelection,
        /// At least this; 1 is the median.
        min: Option<f64>,
        /// At most this; 1 is the median.
        max: Option<f64>,
    },
    /// The place of the one vertex of a selection.
    Position {
        /// Which vertex.
        of: VertexSelection,
        /// Where it is.
        is: Vector,
        /// How far it may be from there.
        #[serde(default = "tolerance")]
        #[schemars(range(min = 0.0))]
        tolerance: f64,
    },
    /// The place of a point of a polyline.
    Point {
        /// Which polyline of the object, from 0.
        #[serde(default)]
        line: u32,
        /// Which of its points, from 0.
        index: u32,
        /// Where it is.
        is: Vector,
        /// How far it may be from there.
        #[serde(default = "tolerance")]
        #[schemars(range(min = 0.0))]
        tolerance: f64,
    },
    /// The mesh has the same vertices as another, up to their order, and the same faces.
    Same {
        /// The other.
        r#as: Other,
        /// How far vertices may lie apart.
        #[serde(default)]
        #[schemars(range(min = 0.0))]
        tolerance: f64,
        /// Whether the faces must be the same too.
        #[serde(default = "yes")]
        connectivity: bool,
    },
    /// The largest distance between the mesh and another: from the vertices and the middles of edges
    /// and faces of each to the surface of the other.
    DistanceTo {
        /// The other.
        other: Other,
        /// Less than this.
        #[schemars(range(min = 0.0))]
        below: f64,
    },
    /// The mesh comes back onto itself under the motions of a group about the origin: under all of them
    /// unless a number is given.
    SymmetricUnder {
        /// The group.
        group: Group,
        /// Under exactly so many, the one that moves nothing included.
        eq: Option<u64>,
        /// Under at least so many.
        min: Option<u64>,
        /// Under at most so many.
        max: Option<u64>,
        /// How far a moved vertex may be from another one.
        #[serde(default = "tolerance")]
        #[schemars(range(min = 0.0))]
        tolerance: f64,
        /// Whether faces must come onto faces too.
        #[serde(default = "yes")]
        connectivity: bool,
    },
    /// Every mesh has an attribute.
    HasAttribute {
        /// On what.
        domain: AttributeDomain,
        /// Of this name.
        name: String,
    },
    /// The digest of the scene, as `run` prints it.
    Digest(String),
    /// The contrary holds. What cannot be told, as about a file that cannot be read, does not.
    Not(Box<Self>),
}

/// The elements that [`Expectation::Count`] counts.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Elements {
    /// Vertices.
    Vertices(VertexSelection),
    /// Edges.
    Edges(EdgeSelection),
    /// Faces.
    Faces(FaceSelection),
}

/// Another mesh to compare with.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Other {
    /// An object of the scene.
    Object(String),
    /// The first mesh in a file, seen from the recipe's folder.
    File(String),
}

/// What an attribute belongs to.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum AttributeDomain {
    /// Vertices.
    Vertex,
    /// Corners.
    Corner,
    /// Edges.
    Edge,
    /// Faces.
    Face,
}

impl From<AttributeDomain> for Domain {
    fn from(domain: AttributeDomain) -> Self {
        match domain {
            AttributeDomain::Vertex => Self::Vertex,
            AttributeDomain::Corner => Self::Corner,
            AttributeDomain::Edge => Self::Edge,
            AttributeDomain::Face => Self::Face,
        }
    }
}

const fn tolerance() -> f64 {
    1e-9
}

const fn yes() -> bool {
    true
}

/// Reads the objects of a file.
pub type ReadObjects<'a> = &'a (dyn Fn(&Path) -> Result<Vec<Object>, String> + Sync);

/// Why an expectation does not hold.
enum Failure {
    /// The scene is not as expected.
    Unmet(String),
    /// There is nothing to hold it against: then its contrary does not hold either.
    Unknown(String),
}

impl From<String> for Failure {
    fn from(message: String) -> Self {
        Self::Unknown(message)
    }
}

/// What expectations are held against.
#[derive(Clone, Copy)]
pub struct Subject<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The objects that are meant; all if `None`.
    pub on: Option<&'a [String]>,
    /// Where files are.
    pub files: &'a Files,
    /// How files are read.
    pub read: ReadObjects<'a>,
}

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
                within("selected elements", found, *eq, *min, *max)
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

    /// What is wrong with the expectation itself: one that can never fail is an error.
    pub fn problem(&self) -> Option<&'static str> {
        let needs_bound = match self {
            Self::Objects { eq, min, max }
            | Self::Vertices { eq, min, max }
            | Self::Edges { eq, min, max }
            | Self::Faces { eq, min, max }
            | Self::Components { eq, min, max }
            | Self::BoundaryLoops { eq, min, max }
            | Self::Count { eq, min, max, .. } => eq.is_none() && min.is_none() && max.is_none(),
            Self::EulerCharacteristic { eq, min, max } | Self::Genus { eq, min, max } => {
                eq.is_none() && min.is_none() && max.is_none()
            }
            Self::Area { eq, min, max, .. } | Self::Volume { eq, min, max, .. } => {
                eq.is_none() && min.is_none() && max.is_none()
            }
            Self::Valence { min, max, .. } => min.is_none() && max.is_none(),
            Self::DihedralAngle {
                min, max, reaches, ..
            } => min.is_none() && max.is_none() && reaches.is_none(),
            Self::MeanFaceArea { min, max, .. } => min.is_none() && max.is_none(),
            Self::Not(inner) => return inner.problem(),
            _ => false,
        };
        needs_bound.then_some("it has no bound, so it can never fail")
    }

    /// The objects and files that it compares with.
    pub fn others(&self) -> Option<&Other> {
        match self {
            Self::Same { r#as, .. } => Some(r#as),
            Self::DistanceTo { other, .. } => Some(other),
            Self::Not(inner) => inner.others(),
            _ => None,
        }
    }
}

impl fmt::Display for Expectation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&ron::to_string(self).map_err(|_| fmt::Error)?)
    }
}

impl Elements {
    fn count(&self, object: &Object, mesh: &Mesh, files: &Files) -> Result<u64, Failure> {
        let n = match self {
            Self::Vertices(s) => selected(s, object, mesh, files)?.len(),
            Self::Edges(s) => selected(s, object, mesh, files)?.len(),
            Self::Faces(s) => selected(s, object, mesh, files)?.len(),
        };
        Ok(n as u64)
    }
}

/// The elements of a selection on one object. A selection that is refused, as one that names an edge
/// that is not there, is an answer.
fn selected<S: Select>(
    selection: &S,
    object: &Object,
    mesh: &Mesh,
    files: &Files,
) -> Result<Vec<S::Id>, Failure> {
    let mut cx = Context::new(&NoProgress, files);
    cx.materials = object.materials.iter().map(|m| m.name.clone()).collect();
    selection.resolve(mesh, &cx).map_err(|error| match error {
        OpError::Refused { message, .. } => Failure::Unmet(message),
        other => Failure::Unknown(other.to_string()),
    })
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

fn ends(mesh: &Mesh, e: EdgeId) -> String {
    let [v, w] = mesh.edge_vertices(e);
    format!("the edge {v}-{w}")
}

impl<'a> Subject<'a> {
    fn objects(&self) -> Result<Vec<&'a Object>, String> {
        let Some(on) = self.on else {
            return Ok(self.scene.objects().iter().collect());
        };
        on.iter()
            .map(|name| {
                self.scene
                    .object(name)
                    .ok_or(format!("no object is named \"{name}\""))
            })
            .collect()
    }

    fn meshes(&self) -> Result<Vec<(&'a Object, &'a Mesh)>, String> {
        let objects = self.objects()?.into_iter();
        Ok(objects
            .filter_map(|o| o.as_mesh().map(|m| (o, m.as_ref())))
            .collect())
    }

    fn one_mesh(&self) -> Result<(&'a Object, &'a Mesh), String> {
        match self.meshes()?[..] {
            [one] => Ok(one),
            ref meshes => {
                let n = meshes.len();
                Err(format!(
                    "this expectation is about one mesh, found {n}: name it with `on:`"
                ))
            }
        }
    }

    fn sum<T: std::iter::Sum>(&self, term: impl Fn(&Mesh) -> T) -> Result<T, String> {
        Ok(self.meshes()?.into_iter().map(|(_, mesh)| term(mesh)).sum())
    }

    fn each_mesh(&self, ask: impl Fn(&str, &Mesh) -> Result<(), Failure>) -> Result<(), Failure> {
        let meshes = self.meshes()?;
        if meshes.is_empty() {
            return Err("expected a mesh, found none".to_owned().into());
        }
        meshes
            .into_iter()
            .try_for_each(|(object, mesh)| ask(&object.name, mesh))
    }

    /// All points: vertices of meshes and points of polylines, patches and curves.
    fn points(&self) -> Result<Vec<DVec3>, String> {
        let mut points = Vec::new();
        for object in self.objects()? {
            match &object.geometry {
                Geometry::Mesh(mesh) => points.extend(mesh.vertices().map(|v| mesh.position(v))),
                Geometry::Patches(patches) => {
                    points.extend(patches.iter().flat_map(|p| p.points().as_flattened()));
                }
                Geometry::Curve(curve) => {
                    points.extend(curve.points().iter().map(|p| p.extend(0.0)))
                }
                Geometry::Polylines(lines) => points.extend(lines.iter().flatten()),
            }
        }
        Ok(points)
    }

    fn other(&self, other: &Other) -> Result<Arc<Mesh>, String> {
        match other {
            Other::Object(name) => {
                let object = self
                    .scene
                    .object(name)
                    .ok_or(format!("no object is named \"{name}\""))?;
                object
                    .as_mesh()
                    .cloned()
                    .ok_or(format!("\"{name}\" is not a mesh"))
            }
            Other::File(path) => (self.read)(&self.files.to_read(path))?
                .iter()
                .find_map(Object::as_mesh)
                .cloned()
                .ok_or(format!("{path} holds no mesh")),
        }
    }

    fn bounds(&self, min: Vector, max: Vector, tolerance: f64) -> Result<(), Failure> {
        let points = self.points()?;
        let Some(&first) = points.first() else {
            return Err("expected points, found none".to_owned().into());
        };
        let low = points.iter().fold(first, |a, &b| a.min(b));
        let high = points.iter().fold(first, |a, &b| a.max(b));
        let off = |a: DVec3, b: Vector| (a - DVec3::from(b)).abs().max_element();
        let close = off(low, min) <= tolerance && off(high, max) <= tolerance;
        fails_unless(close, || {
            let (min, max) = (DVec3::from(min), DVec3::from(max));
            format!("expected bounds from {min} to {max}, found {low} to {high}")
        })
    }

    fn valence(
        &self,
        of: &VertexSelection,
        min: Option<u64>,
        max: Option<u64>,
    ) -> Result<(), Failure> {
        let mut n = 0;
        for (object, mesh) in self.meshes()? {
            for v in selected(of, object, mesh, self.files)? {
                n += 1;
                let valence = mesh.valence(v) as u64;
                within(&format!("edges at {v}"), valence, None, min, max)?;
            }
        }
        if n == 0 {
            return Err("expected vertices to be selected, found none"
                .to_owned()
                .into());
        }
        Ok(())
    }

    fn dihedral(
        &self,
        of: &EdgeSelection,
        min: Option<f64>,
        max: Option<f64>,
        reaches: Option<f64>,
    ) -> Result<(), Failure> {
        let mut largest: Option<f64> = None;
        for (object, mesh) in self.meshes()? {
            for e in selected(of, object, mesh, self.files)? {
                let Some(angle) = mesh.dihedral_angle(e).map(f64::to_degrees) else {
                    continue;
                };
                let what = format!("a dihedral angle at {}", ends(mesh, e));
                near(&what, angle, [None, min, max], 0.0)?;
                largest = Some(largest.map_or(angle, |l| l.max(angle)));
            }
        }
        let Some(largest) = largest else {
            let message = "expected edges between two faces to be selected, found none";
            return Err(message.to_owned().into());
        };
        near(
            "a largest dihedral angle",
            largest,
            [None, reaches, None],
            0.0,
        )
    }

    fn mean_area(
        &self,
        of: &FaceSelection,
        min: Option<f64>,
        max: Option<f64>,
    ) -> Result<(), Failure> {
        let (object, mesh) = self.one_mesh()?;
        let chosen = selected(of, object, mesh, self.files)?;
        let mut areas: Vec<f64> = mesh.faces().map(|f| mesh.face_area(f)).collect();
        areas.sort_by(f64::total_cmp);
        if chosen.is_empty() {
            return Err("expected faces to be selected, found none"
                .to_owned()
                .into());
        }
        let mean = chosen
            .iter()
            .map(|&f: &FaceId| mesh.face_area(f))
            .sum::<f64>()
            / chosen.len() as f64;
        let found = mean / areas[areas.len() / 2];
        near(
            "a mean face area over the median",
            found,
            [None, min, max],
            0.0,
        )
    }

    fn position(&self, of: &VertexSelection, is: DVec3, tolerance: f64) -> Result<(), Failure> {
        let (object, mesh) = self.one_mesh()?;
        let chosen = selected(of, object, mesh, self.files)?;
        let [v] = chosen[..] else {
            let message = format!("expected one vertex to be selected, found {}", chosen.len());
            return Err(message.into());
        };
        let found = mesh.position(v);
        fails_unless(found.distance(is) <= tolerance, || {
            format!("expected {v} at {is}, found it at {found}")
        })
    }

    fn point(&self, line: u32, index: u32, is: DVec3, tolerance: f64) -> Result<(), Failure> {
        let objects = self.objects()?;
        let lines: Vec<&Vec<Vec<DVec3>>> = objects
            .iter()
            .filter_map(|o| {
                if let Geometry::Polylines(l) = &o.geometry {
                    Some(l)
                } else {
                    None
                }
            })
            .collect();
        let [lines] = lines[..] else {
            let n = lines.len();
            let message = format!("this expectation is about one object of polylines, found {n}");
            return Err(message.into());
        };
        let Some(&found) = lines.get(line as usize).and_then(|l| l.get(index as usize)) else {
            let message = format!("there is no point {index} on a polyline {line}");
            return Err(Failure::Unmet(message));
        };
        fails_unless(found.distance(is) <= tolerance, || {
            format!("expected point {index} of polyline {line} at {is}, found it at {found}")
        })
    }
}

fn fails_unless(holds: bool, message: impl FnOnce() -> String) -> Result<(), Failure> {
    if holds {
        Ok(())
    } else {
        Err(Failure::Unmet(message()))
    }
}

fn within<T: PartialOrd + fmt::Display + Copy>(
    what: &str,
    found: T,
    eq: Option<T>,
    min: Option<T>,
    max: Option<T>,
) -> Result<(), Failure> {
    let bounds = [
        ("", eq, eq.is_none_or(|n| found == n)),
        ("at least ", min, min.is_none_or(|n| found >= n)),
        ("at most ", max, max.is_none_or(|n| found <= n)),
    ];
    match bounds.into_iter().find(|(_, _, holds)| !holds) {
        Some((word, Some(n), _)) => Err(Failure::Unmet(format!(
            "expected {word}{n} {what}, found {found}"
        ))),
        _ => Ok(()),
    }
}

fn near(
    what: &str,
    found: f64,
    [eq, min, max]: [Option<f64>; 3],
    tolerance: f64,
) -> Result<(), Failure> {
    let bounds = [
        ("of ", eq, eq.is_none_or(|x| (found - x).abs() <= tolerance)),
        ("of at least ", min, min.is_none_or(|x| found >= x)),
        ("of at most ", max, max.is_none_or(|x| found <= x)),
    ];
    match bounds.into_iter().find(|(_, _, holds)| !holds) {
        Some((word, Some(x), _)) => Err(Failure::Unmet(format!(
            "expected {what} {word}{x}, found {found}"
        ))),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests;
