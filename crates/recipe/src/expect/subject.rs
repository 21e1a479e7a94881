//! What expectations are held against, and the measures that several of them take.

use std::borrow::Cow;
use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use mesh::{DVec3, EdgeId, FaceId, Mesh};
use op::{
    Context, EdgeSelection, FaceSelection, Files, NoProgress, OpError, Select, Vector,
    VertexSelection,
};
use scene::{Geometry, Object, Scene};

use super::Other;

/// Reads the files that expectations name.
pub trait Reader: Sync {
    /// Reads the objects of a file, and tells [`Files::has_read`] what was read.
    ///
    /// # Errors
    ///
    /// Why the file cannot be read, with its path.
    fn objects(&self, path: &Path, files: &Files) -> Result<Vec<Object>, String>;

    /// How the pixels of two PNG files, each with its path, differ by more than `tolerance` steps of 255; `None` if they
    /// do not.
    ///
    /// # Errors
    ///
    /// Why one of them cannot be read, with its path.
    fn compare_pictures(
        &self,
        found: (&Path, &[u8]),
        expected: (&Path, &[u8]),
        tolerance: u8,
    ) -> Result<Option<String>, String>;
}

/// An expectation that does not hold.
#[derive(Clone, Debug, PartialEq)]
pub struct Violation {
    /// What was expected and what was found, in one line.
    pub message: String,
    /// What was found, if a value that the expectation records is another one.
    pub found: Option<ActualValue>,
    /// Whether nothing could be compared: then the contrary does not hold either.
    pub(super) is_unknown: bool,
}

impl Violation {
    /// The scene is not as expected.
    pub(super) fn unmet(message: impl Into<String>) -> Self {
        Self {
            message: message.into(),
            found: None,
            is_unknown: false,
        }
    }

    /// A value that the recipe records is another one in the scene.
    pub(super) fn recorded(message: String, found: ActualValue) -> Self {
        Self {
            found: Some(found),
            ..Self::unmet(message)
        }
    }
}

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

/// What was found in place of a value that an expectation records.
#[derive(Clone, Debug, PartialEq)]
pub enum ActualValue {
    /// A whole number, in place of `eq`.
    Count(i128),
    /// A number, in place of `eq`.
    Number(f64),
    /// The digest of the scene.
    Digest(String),
    /// A file, in place of the one beside the recipe.
    File {
        /// The file beside the recipe.
        golden: PathBuf,
        /// What it should hold.
        bytes: Vec<u8>,
        /// By how many steps of 255 the colors of a picture may differ.
        tolerance: u8,
    },
    /// A place, in place of `is`.
    Position {
        /// The place.
        at: DVec3,
        /// How far from there it might be.
        tolerance: f64,
    },
    /// The lowest and highest coordinates.
    Bounds {
        /// The lowest.
        min: DVec3,
        /// The highest.
        max: DVec3,
        /// How far from there each might be.
        tolerance: f64,
    },
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
    pub reader: &'a dyn Reader,
}

impl<'a> Subject<'a> {
    pub(crate) fn objects(&self) -> Result<Vec<&'a Object>, String> {
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

    pub(super) fn meshes(&self) -> Result<Vec<(&'a Object, &'a Mesh)>, String> {
        let objects = self.objects()?.into_iter();
        Ok(objects
            .filter_map(|o| o.as_mesh().map(|m| (o, m.as_ref())))
            .collect())
    }

    pub(crate) fn one_mesh(&self) -> Result<(&'a Object, &'a Mesh), String> {
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

    pub(crate) fn sum<T: std::iter::Sum>(&self, term: impl Fn(&Mesh) -> T) -> Result<T, String> {
        Ok(self.meshes()?.into_iter().map(|(_, mesh)| term(mesh)).sum())
    }

    pub(super) fn each_mesh(
        &self,
        ask: impl Fn(&str, &Mesh) -> Result<(), Violation>,
    ) -> Result<(), Violation> {
        let meshes = self.meshes()?;
        if meshes.is_empty() {
            return Err("expected a mesh, found none".into());
        }
        meshes
            .into_iter()
            .try_for_each(|(object, mesh)| ask(&object.name, mesh))
    }

    /// All points: vertices of meshes and points of polylines, patches and curves.
    pub(crate) fn points(&self) -> Result<Vec<DVec3>, String> {
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

    pub(crate) fn other(&self, other: &Other) -> Result<Arc<Mesh>, String> {
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
            Other::File(path) => self
                .reader
                .objects(&self.files.to_read(path), self.files)?
                .iter()
                .find_map(Object::as_mesh)
                .cloned()
                .ok_or(format!("{path} holds no mesh")),
        }
    }

    pub(super) fn bounds(&self, min: Vector, max: Vector, tolerance: f64) -> Result<(), Violation> {
        let points = self.points()?;
        let Some(&first) = points.first() else {
            return Err("expected points, found none".into());
        };
        let low = points.iter().fold(first, |a, &b| a.min(b));
        let high = points.iter().fold(first, |a, &b| a.max(b));
        let off = |a: DVec3, b: Vector| (a - DVec3::from(b)).abs().max_element();
        if off(low, min) <= tolerance && off(high, max) <= tolerance {
            return Ok(());
        }
        let (min, max) = (DVec3::from(min), DVec3::from(max));
        let message = format!("expected bounds from {min} to {max}, found {low} to {high}");
        let found = ActualValue::Bounds {
            min: low,
            max: high,
            tolerance,
        };
        Err(Violation::recorded(message, found))
    }

    /// Asks about every element of a selection, of which there must be one.
    pub(super) fn each_selected<S: Select>(
        &self,
        of: &S,
        mut ask: impl FnMut(&Mesh, S::Id) -> Result<(), Violation>,
    ) -> Result<(), Violation> {
        let mut is_empty = true;
        for (object, mesh) in self.meshes()? {
            for id in selected(of, object, mesh, self.files)? {
                is_empty = false;
                ask(mesh, id)?;
            }
        }
        if is_empty {
            let message = format!("expected {} to be selected, found none", S::WORD);
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
        self.each_selected(of, |mesh, e| {
            let Some(angle) = mesh.dihedral_angle(e).map(f64::to_degrees) else {
                return Ok(());
            };
            largest = Some(largest.map_or(angle, |l| l.max(angle)));
            let what = format_args!("a dihedral angle at {}", Ends(mesh, e));
            near(what, angle, [None, min, max], 0.0)
        })?;
        let largest =
            largest.ok_or("expected edges between two faces to be selected, found none")?;
        near(
            "a largest dihedral angle",
            largest,
            [None, reaches, None],
            0.0,
        )
    }

    /// The smallest corner angle of the faces of a selection, in degrees, and the face that has it.
    pub(crate) fn smallest_angle(&self, of: &FaceSelection) -> Result<(f64, FaceId), Violation> {
        let mut smallest = (f64::INFINITY, FaceId::NONE);
        self.each_selected(of, |mesh, f| {
            let angle = least_angle(mesh, f);
            if angle < smallest.0 {
                smallest = (angle, f);
            }
            Ok(())
        })?;
        Ok(smallest)
    }

    pub(super) fn mean_area(
        &self,
        of: &FaceSelection,
        bounds: [Option<f64>; 3],
    ) -> Result<(), Violation> {
        let (object, mesh) = self.one_mesh()?;
        let chosen = selected(of, object, mesh, self.files)?;
        let mut areas: Vec<f64> = mesh.faces().map(|f| mesh.face_area(f)).collect();
        areas.sort_by(f64::total_cmp);
        if chosen.is_empty() {
            return Err("expected faces to be selected, found none".into());
        }
        let sum: f64 = chosen.iter().map(|&f| mesh.face_area(f)).sum();
        let found = sum / chosen.len() as f64 / areas[areas.len() / 2];
        near("a mean face area over the median", found, bounds, 0.0)
    }

    pub(super) fn position(
        &self,
        of: &VertexSelection,
        is: DVec3,
        tolerance: f64,
    ) -> Result<(), Violation> {
        let (object, mesh) = self.one_mesh()?;
        let chosen = selected(of, object, mesh, self.files)?;
        let [v] = chosen[..] else {
            let message = format!("expected one vertex to be selected, found {}", chosen.len());
            return Err(message.into());
        };
        let found = mesh.position(v);
        found_at(found, is, tolerance, || v.to_string())
    }

    /// The polylines of the one object that has any.
    pub(super) fn polylines(&self) -> Result<&'a [Vec<DVec3>], String> {
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
            return Err(format!(
                "this expectation is about one object of polylines, found {n}"
            ));
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
            let message = format!("there is no point {index} on a polyline {line}");
            return Err(Violation::unmet(message));
        };
        found_at(found, is, tolerance, || {
            format!("point {index} of polyline {line}")
        })
    }
}

/// The elements of a selection on one object. A selection that is refused, as one that names an edge
/// that is not there, is an answer.
pub(super) fn selected<S: Select>(
    selection: &S,
    object: &Object,
    mesh: &Mesh,
    files: &Files,
) -> Result<Vec<S::Id>, Violation> {
    let mut cx = Context::new(&NoProgress, files);
    cx.materials = object.materials.iter().map(|m| m.name.clone()).collect();
    selection.resolve(mesh, &cx).map_err(|error| match error {
        OpError::Refused { message, .. } => Violation::unmet(message),
        other => other.to_string().into(),
    })
}

/// An edge by its vertices, as messages name it.
pub(super) struct Ends<'m>(pub(super) &'m Mesh, pub(super) EdgeId);

impl fmt::Display for Ends<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [v, w] = self.0.edge_vertices(self.1);
        write!(f, "the edge {v}-{w}")
    }
}

/// The smallest corner angle of a face, in degrees.
pub(super) fn least_angle(mesh: &Mesh, f: FaceId) -> f64 {
    let angles = mesh.face_half_edges(f).map(|h| mesh.corner_angle(h));
    angles.fold(f64::INFINITY, f64::min).to_degrees()
}

fn found_at(
    at: DVec3,
    is: DVec3,
    tolerance: f64,
    what: impl FnOnce() -> String,
) -> Result<(), Violation> {
    if at.distance(is) <= tolerance {
        return Ok(());
    }
    let message = format!("expected {} at {is}, found it at {at}", what());
    Err(Violation::recorded(
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

pub(super) fn within<T: PartialOrd + fmt::Display + Copy + Into<i128>>(
    what: impl fmt::Display,
    found: T,
    bounds: [Option<T>; 3],
) -> Result<(), Violation> {
    let is_equal = bounds[0].is_none_or(|n| found == n);
    bounded(
        found,
        bounds,
        is_equal,
        ActualValue::Count(found.into()),
        |word, n| {
            let what = what.to_string();
            let what = counted(&what, n.into());
            format!("expected {word}{n} {what}, found {found}")
        },
    )
}

/// The word for so many: `what` for several.
fn counted(what: &str, n: i128) -> Cow<'_, str> {
    let is_noun = !what.starts_with("as ");
    if n != 1 || !is_noun {
        Cow::Borrowed(what)
    } else if let Some(stem) = what.strip_suffix("vertices") {
        Cow::Owned(format!("{stem}vertex"))
    } else if let Some(stem) = what.strip_suffix("ies") {
        Cow::Owned(format!("{stem}y"))
    } else {
        Cow::Borrowed(what.strip_suffix('s').unwrap_or(what))
    }
}

pub(super) fn near(
    what: impl fmt::Display,
    found: f64,
    bounds: [Option<f64>; 3],
    tolerance: f64,
) -> Result<(), Violation> {
    let is_equal = bounds[0].is_none_or(|x| (found - x).abs() <= tolerance);
    bounded(
        found,
        bounds,
        is_equal,
        ActualValue::Number(found),
        |word, x| format!("expected {what} of {word}{x}, found {found}"),
    )
}

/// Fails with the first of the bounds `eq`, `min` and `max` that is broken. Only where `eq` alone is broken, recording
/// the found value mends it.
fn bounded<T: PartialOrd + Copy>(
    found: T,
    [eq, min, max]: [Option<T>; 3],
    is_equal: bool,
    recorded: ActualValue,
    message: impl Fn(&str, T) -> String,
) -> Result<(), Violation> {
    let is_high_enough = min.is_none_or(|min| found >= min);
    let is_low_enough = max.is_none_or(|max| found <= max);
    match (eq, min, max) {
        (Some(eq), ..) if !is_equal => Err(Violation {
            found: (is_high_enough && is_low_enough).then_some(recorded),
            ..Violation::unmet(message("", eq))
        }),
        (_, Some(min), _) if !is_high_enough => Err(Violation::unmet(message("at least ", min))),
        (.., Some(max)) if !is_low_enough => Err(Violation::unmet(message("at most ", max))),
        _ => Ok(()),
    }
}
