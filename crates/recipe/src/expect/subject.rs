//! The subject of an expectation (the scene to check), and measurements that several expectations use.

use std::borrow::Cow;
use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use mesh::{DVec3, EdgeId, FaceId, Mesh};
use op::{
    Context, EdgeSelection, FaceSelection, Files, OpError, Progress, Select, Vector,
    VertexSelection,
};
use scene::{Geometry, Object, Scene};

use super::OtherMesh;

/// Reads the files that expectations refer to.
pub trait Reader: Sync {
    /// Reads the scene in a file. Reports each file that is read to [`Files::has_read`].
    ///
    /// # Errors
    ///
    /// Returns a [`Violation`] if the file cannot be read. Its message gives the path and the reason.
    fn scene(&self, path: &Path, files: &Files) -> Result<Scene, Violation>;

    /// Compares the pixels of two PNG files, each given by its path and bytes. Returns a description of the differences
    /// that are larger than `tolerance` steps of 1/255, or `None` if there are no such differences.
    ///
    /// # Errors
    ///
    /// Returns a [`Violation`] if one of the files cannot be read. Its message gives the path and the reason.
    fn compare_pictures(
        &self,
        found: (&Path, &[u8]),
        expected: (&Path, &[u8]),
        tolerance: u8,
    ) -> Result<Option<String>, Violation>;
}

/// Why an expectation does not hold, or why an expectation or a metric cannot be evaluated.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{message}")]
pub struct Violation {
    /// The expected and the actual value, in one line.
    pub message: String,
    /// The actual value, if the expectation would hold with this value as the expected value.
    pub found: Option<ActualValue>,
    /// Whether the expectation could not be checked, for example because a file cannot be read. In this case, `Not(..)`
    /// of the expectation does not hold either.
    pub(super) is_unknown: bool,
}

impl Violation {
    /// Creates a violation without an actual value, so that `meshwright test --update` does not change the expectation.
    pub(super) fn unmet(message: impl Into<String>) -> Self {
        Self {
            message: message.into(),
            found: None,
            is_unknown: false,
        }
    }

    /// Creates a violation with the actual value, which can replace the expected value in the recipe.
    pub(super) fn with_actual(message: String, found: ActualValue) -> Self {
        Self {
            found: Some(found),
            ..Self::unmet(message)
        }
    }
}

/// Creates a violation for an expectation or a metric that cannot be evaluated.
impl From<String> for Violation {
    fn from(message: String) -> Self {
        Self {
            is_unknown: true,
            ..Self::unmet(message)
        }
    }
}

impl From<&str> for Violation {
    fn from(message: &str) -> Self {
        message.to_owned().into()
    }
}

/// The actual value, which can replace the expected value in the recipe.
#[derive(Clone, Debug, PartialEq)]
pub enum ActualValue {
    /// An integer, which can replace the value of `eq`.
    Count(i128),
    /// A number, which can replace the value of `eq`.
    Number(f64),
    /// The digest of the scene.
    Digest(String),
    /// A reference file beside the recipe.
    File {
        /// The path of the reference file.
        golden: PathBuf,
        /// The contents of the file that the step has written.
        bytes: Vec<u8>,
        /// The allowed difference between the colors of two pictures, in steps of 1/255.
        tolerance: u8,
    },
    /// A position, which can replace the value of `is`.
    Position {
        /// The actual position.
        at: DVec3,
        /// The allowed distance from the expected position.
        tolerance: f64,
    },
    /// A bounding box, which can replace the two corners in `Bounds`.
    Bounds {
        /// The lowest coordinates.
        min: DVec3,
        /// The highest coordinates.
        max: DVec3,
        /// The allowed deviation of each coordinate.
        tolerance: f64,
    },
}

/// The scene against which an expectation is checked.
#[derive(Clone, Copy)]
pub struct Subject<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The names of the objects to check. If `None`, all objects are checked.
    pub on: Option<&'a [String]>,
    /// The input and output folders, and the store of files.
    pub files: &'a Files,
    /// Reads the files that the expectation refers to.
    pub reader: &'a dyn Reader,
    /// Receives progress reports of the check, and can cancel it. A canceled check fails.
    pub progress: &'a dyn Progress,
}

impl<'a> Subject<'a> {
    pub(crate) fn objects(&self) -> Result<Vec<&'a Object>, Violation> {
        let Some(on) = self.on else {
            return Ok(self.scene.objects().iter().collect());
        };
        on.iter().map(|name| self.object(name)).collect()
    }

    fn object(&self, name: &str) -> Result<&'a Object, Violation> {
        let object = self.scene.object(name);
        object.ok_or_else(|| format!("no object is named \"{name}\"").into())
    }

    pub(super) fn meshes(&self) -> Result<Vec<(&'a Object, &'a Mesh)>, Violation> {
        let objects = self.objects()?.into_iter();
        Ok(objects
            .filter_map(|o| o.as_mesh().map(|m| (o, m.as_ref())))
            .collect())
    }

    pub(crate) fn one_mesh(&self) -> Result<(&'a Object, &'a Mesh), Violation> {
        match self.meshes()?[..] {
            [one] => Ok(one),
            ref meshes => {
                let n = meshes.len();
                Err(format!(
                    "this expectation needs exactly 1 mesh, found {n}: name the mesh with `on:`"
                )
                .into())
            }
        }
    }

    pub(crate) fn sum<T: std::iter::Sum>(&self, term: impl Fn(&Mesh) -> T) -> Result<T, Violation> {
        Ok(self.meshes()?.into_iter().map(|(_, mesh)| term(mesh)).sum())
    }

    pub(super) fn each_mesh(
        &self,
        check: impl Fn(&str, &Mesh) -> Result<(), Violation>,
    ) -> Result<(), Violation> {
        let meshes = self.meshes()?;
        if meshes.is_empty() {
            return Err("expected a mesh, found none".into());
        }
        meshes
            .into_iter()
            .try_for_each(|(object, mesh)| check(&object.name, mesh))
    }

    /// Returns all points: vertices of meshes, points of polylines, and control points of patches and curves.
    pub(crate) fn points(&self) -> Result<Vec<DVec3>, Violation> {
        let mut points = Vec::new();
        for object in self.objects()? {
            match &object.geometry {
                Geometry::Mesh(mesh) => points.extend(mesh.vertices().map(|v| mesh.position(v))),
                Geometry::Patches(patches) => {
                    points.extend(patches.iter().flat_map(|p| p.points().as_flattened()));
                }
                Geometry::Curve(curve) => {
                    points.extend(curve.points().iter().map(|p| p.extend(0.0)));
                }
                Geometry::Polylines(lines) => points.extend(lines.iter().flatten()),
            }
        }
        Ok(points)
    }

    pub(crate) fn other_mesh(&self, other: &OtherMesh) -> Result<Arc<Mesh>, Violation> {
        match other {
            OtherMesh::Object(name) => {
                let mesh = self.object(name)?.as_mesh().cloned();
                mesh.ok_or_else(|| format!("\"{name}\" is not a mesh").into())
            }
            OtherMesh::File(path) => {
                let scene = self.reader.scene(&self.files.to_read(path), self.files)?;
                let first = scene
                    .instances()
                    .into_iter()
                    .find(|i| i.object.as_mesh().is_some());
                let first = first.map(|instance| instance.placed());
                let mesh = first.as_ref().and_then(Object::as_mesh).cloned();
                mesh.ok_or_else(|| format!("{path} does not contain a mesh").into())
            }
        }
    }

    pub(super) fn bounds(&self, min: Vector, max: Vector, tolerance: f64) -> Result<(), Violation> {
        let points = self.points()?;
        let Some(&first) = points.first() else {
            return Err("expected at least 1 point, found none".into());
        };
        let low = points.iter().fold(first, |a, &b| a.min(b));
        let high = points.iter().fold(first, |a, &b| a.max(b));
        let deviation = |a: DVec3, b: Vector| (a - DVec3::from(b)).abs().max_element();
        if deviation(low, min) <= tolerance && deviation(high, max) <= tolerance {
            return Ok(());
        }
        let (min, max) = (DVec3::from(min), DVec3::from(max));
        let message = format!("expected bounds from {min} to {max}, found {low} to {high}");
        let found = ActualValue::Bounds {
            min: low,
            max: high,
            tolerance,
        };
        Err(Violation::with_actual(message, found))
    }

    /// Calls `check` for every element of a selection, and fails if the selection is empty.
    pub(super) fn each_selected<S: Select>(
        &self,
        of: &S,
        mut check: impl FnMut(&Mesh, S::Id) -> Result<(), Violation>,
    ) -> Result<(), Violation> {
        self.selected_in_each_mesh(of, |mesh, ids| {
            ids.iter().try_for_each(|&id| check(mesh, id))
        })
    }

    /// Calls `check` for each mesh with the elements of a selection in it, and fails if the selections of all meshes are
    /// empty.
    fn selected_in_each_mesh<S: Select>(
        &self,
        of: &S,
        mut check: impl FnMut(&Mesh, &[S::Id]) -> Result<(), Violation>,
    ) -> Result<(), Violation> {
        let mut is_empty = true;
        for (object, mesh) in self.meshes()? {
            let ids = selected(of, object, mesh, *self)?;
            is_empty &= ids.is_empty();
            check(mesh, &ids)?;
        }
        if is_empty {
            let message = format!("the selection contains no {}", S::WORD);
            return Err(message.into());
        }
        Ok(())
    }

    pub(super) fn dihedral(
        &self,
        of: &EdgeSelection,
        [min, max, reaches]: [Option<f64>; 3],
    ) -> Result<(), Violation> {
        let mut largest: Option<f64> = None;
        self.selected_in_each_mesh(of, |mesh, edges| {
            let angles = mesh.dihedral_angles();
            edges.iter().try_for_each(|&e| {
                let Some(angle) = angles(e).map(f64::to_degrees) else {
                    return Ok(());
                };
                largest = Some(largest.map_or(angle, |l| l.max(angle)));
                let what = format_args!("{} to have a dihedral angle", EdgeByVertices(mesh, e));
                check_number(what, angle, [None, min, max], 0.0)
            })
        })?;
        let largest = largest.ok_or("the selection contains no edges between two faces")?;
        check_number(
            "a largest dihedral angle",
            largest,
            [None, reaches, None],
            0.0,
        )
    }

    /// Returns the smallest corner angle of all selected faces, in degrees, and the face with this angle.
    pub(crate) fn smallest_angle(&self, of: &FaceSelection) -> Result<(f64, FaceId), Violation> {
        let mut smallest = (f64::INFINITY, FaceId::NONE);
        self.each_selected(of, |mesh, f| {
            let angle = smallest_corner_angle(mesh, f);
            if angle < smallest.0 {
                smallest = (angle, f);
            }
            Ok(())
        })?;
        Ok(smallest)
    }

    pub(super) fn thickness(
        &self,
        of: &VertexSelection,
        bounds: [Option<f64>; 3],
    ) -> Result<(), Violation> {
        let mut is_empty = true;
        for (object, mesh) in self.meshes()? {
            let vertices = selected(of, object, mesh, *self)?;
            if vertices.is_empty() {
                continue;
            }
            is_empty = false;
            let thickness = geometry::thickness(mesh, self.progress);
            let thickness = thickness.map_err(|cancelled| cancelled.to_string())?;
            for v in vertices {
                let what = format_args!("{v} to have a thickness");
                check_number(what, thickness[v.index()], bounds, 0.0)?;
            }
        }
        if is_empty {
            return Err("the selection contains no vertices".into());
        }
        Ok(())
    }

    pub(super) fn mean_area(
        &self,
        of: &FaceSelection,
        bounds: [Option<f64>; 3],
    ) -> Result<(), Violation> {
        let (object, mesh) = self.one_mesh()?;
        let chosen = selected(of, object, mesh, *self)?;
        let mut areas: Vec<f64> = mesh.faces().map(|f| mesh.face_area(f)).collect();
        areas.sort_by(f64::total_cmp);
        if chosen.is_empty() {
            return Err("the selection contains no faces".into());
        }
        let sum: f64 = chosen.iter().map(|&f| mesh.face_area(f)).sum();
        let found = sum / chosen.len() as f64 / areas[areas.len() / 2];
        check_number("a ratio of mean to median face area", found, bounds, 0.0)
    }

    pub(super) fn position(
        &self,
        of: &VertexSelection,
        is: DVec3,
        tolerance: f64,
    ) -> Result<(), Violation> {
        let (object, mesh) = self.one_mesh()?;
        let chosen = selected(of, object, mesh, *self)?;
        let [v] = chosen[..] else {
            let message = format!("expected exactly 1 selected vertex, found {}", chosen.len());
            return Err(message.into());
        };
        let found = mesh.position(v);
        check_position(found, is, tolerance, || v.to_string())
    }

    /// Returns the polylines of the object that has polylines. There must be exactly one such object.
    pub(super) fn polylines(&self) -> Result<&'a [Vec<DVec3>], Violation> {
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
            let message =
                format!("this expectation needs exactly 1 object with polylines, found {n}");
            return Err(message.into());
        };
        Ok(lines)
    }

    pub(super) fn point(
        &self,
        line: u32,
        index: u32,
        is: DVec3,
        tolerance: f64,
    ) -> Result<(), Violation> {
        let lines = self.polylines()?;
        let Some(&found) = lines.get(line as usize).and_then(|l| l.get(index as usize)) else {
            let message = format!("point {index} of polyline {line} does not exist");
            return Err(Violation::unmet(message));
        };
        check_position(found, is, tolerance, || {
            format!("point {index} of polyline {line}")
        })
    }
}

/// Returns the elements of one object that a selection matches. A selection is refused, for example, if it names a
/// missing edge. A refused selection violates the expectation, so `Not(..)` of the expectation holds.
pub(super) fn selected<S: Select>(
    selection: &S,
    object: &Object,
    mesh: &Mesh,
    subject: Subject,
) -> Result<Vec<S::Id>, Violation> {
    let mut cx = Context::new(subject.progress, subject.files);
    cx.set_object(subject.scene, &object.name);
    selection.resolve(mesh, &cx).map_err(|error| match error {
        OpError::Refused { message, .. } => Violation::unmet(message),
        other => other.to_string().into(),
    })
}

/// Displays an edge as "the edge v0-v1".
pub(super) struct EdgeByVertices<'m>(pub(super) &'m Mesh, pub(super) EdgeId);

impl fmt::Display for EdgeByVertices<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [v, w] = self.0.edge_vertices(self.1);
        write!(f, "the edge {v}-{w}")
    }
}

/// Returns the smallest corner angle of a face, in degrees.
pub(super) fn smallest_corner_angle(mesh: &Mesh, f: FaceId) -> f64 {
    geometry::min_angle(mesh, f).to_degrees()
}

fn check_position(
    at: DVec3,
    is: DVec3,
    tolerance: f64,
    what: impl FnOnce() -> String,
) -> Result<(), Violation> {
    if at.distance(is) <= tolerance {
        return Ok(());
    }
    let message = format!("expected {} at {is}, found it at {at}", what());
    Err(Violation::with_actual(
        message,
        ActualValue::Position { at, tolerance },
    ))
}

pub(super) fn fails_unless(holds: bool, message: impl FnOnce() -> String) -> Result<(), Violation> {
    if holds {
        Ok(())
    } else {
        Err(Violation::unmet(message()))
    }
}

/// Checks a count against `eq`, `min` and `max`. `what` is a noun in the plural, such as "faces".
pub(super) fn check_count(
    what: impl fmt::Display,
    found: u64,
    bounds: [Option<u64>; 3],
) -> Result<(), Violation> {
    check_exact(found, bounds, |word, n| {
        let what = what.to_string();
        let what = singular_if_one(n, &what);
        format!("expected {word}{n} {what}, found {found}")
    })
}

/// Checks an integer against `eq`, `min` and `max`. `what` is a noun with its article, such as "a genus".
pub(super) fn check_integer(
    what: &str,
    found: i64,
    bounds: [Option<i64>; 3],
) -> Result<(), Violation> {
    check_exact(found, bounds, |word, n| {
        format!("expected {what} of {word}{n}, found {found}")
    })
}

fn check_exact<T: PartialOrd + Copy + Into<i128>>(
    found: T,
    bounds: [Option<T>; 3],
    message: impl Fn(&str, T) -> String,
) -> Result<(), Violation> {
    let is_equal = bounds[0].is_none_or(|n| found == n);
    let actual = ActualValue::Count(found.into());
    check_bounds(found, bounds, is_equal, actual, message)
}

/// Returns `what`, a noun in the plural, or its singular if `n` is 1.
fn singular_if_one(n: u64, what: &str) -> Cow<'_, str> {
    if n != 1 {
        Cow::Borrowed(what)
    } else if let Some(stem) = what.strip_suffix("vertices") {
        Cow::Owned(format!("{stem}vertex"))
    } else if let Some(stem) = what.strip_suffix("ies") {
        Cow::Owned(format!("{stem}y"))
    } else {
        Cow::Borrowed(what.strip_suffix('s').unwrap_or(what))
    }
}

/// Checks a number against `eq` (within the tolerance), `min` and `max`. `what` follows the word "expected" in the
/// error message, for example "an area" or "v3 to have a thickness".
pub(super) fn check_number(
    what: impl fmt::Display,
    found: f64,
    bounds: [Option<f64>; 3],
    tolerance: f64,
) -> Result<(), Violation> {
    let is_equal = bounds[0].is_none_or(|x| (found - x).abs() <= tolerance);
    check_bounds(
        found,
        bounds,
        is_equal,
        ActualValue::Number(found),
        |word, x| {
            let found = if word.is_empty() {
                found.to_string()
            } else {
                rounded(found, x)
            };
            format!("expected {what} of {word}{x}, found {found}")
        },
    )
}

/// Formats a number that violates a limit, with six significant digits. If the rounded number would appear to satisfy
/// the limit, keeps all digits.
pub(super) fn rounded(found: f64, limit: f64) -> String {
    let short = mesh::readable(found);
    let order = short.parse::<f64>().ok().map(|x| x.total_cmp(&limit));
    if order == Some(found.total_cmp(&limit)) {
        short
    } else {
        found.to_string()
    }
}

/// Returns the violation of the first of the bounds `eq`, `min` and `max` that does not hold. The violation contains
/// the actual value only if `eq` does not hold but `min` and `max` do. If `min` or `max` does not hold, the expectation
/// would still fail with the actual value as `eq`.
fn check_bounds<T: PartialOrd + Copy>(
    found: T,
    [eq, min, max]: [Option<T>; 3],
    is_equal: bool,
    actual: ActualValue,
    message: impl Fn(&str, T) -> String,
) -> Result<(), Violation> {
    let is_high_enough = min.is_none_or(|min| found >= min);
    let is_low_enough = max.is_none_or(|max| found <= max);
    match (eq, min, max) {
        (Some(eq), ..) if !is_equal => Err(Violation {
            found: (is_high_enough && is_low_enough).then_some(actual),
            ..Violation::unmet(message("", eq))
        }),
        (_, Some(min), _) if !is_high_enough => Err(Violation::unmet(message("at least ", min))),
        (.., Some(max)) if !is_low_enough => Err(Violation::unmet(message("at most ", max))),
        _ => Ok(()),
    }
}
