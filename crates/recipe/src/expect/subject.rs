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

/// Why an expectation does not hold.
pub(super) enum Failure {
    /// The scene is not as expected.
    Unmet(String),
    /// A value that the recipe records is another one in the scene.
    Recorded(String, Found),
    /// There is nothing to hold it against: then its contrary does not hold either.
    Unknown(String),
}

impl Failure {
    /// What was expected and what was found.
    pub(super) fn into_message(self) -> String {
        match self {
            Self::Unmet(message) | Self::Recorded(message, _) | Self::Unknown(message) => message,
        }
    }
}

impl From<String> for Failure {
    fn from(message: String) -> Self {
        Self::Unknown(message)
    }
}

/// What was found in place of a value that an expectation records.
#[derive(Clone, Debug, PartialEq)]
pub enum Found {
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
        /// Whether there is none so far that could be compared.
        is_unknown: bool,
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
    pub(super) fn objects(&self) -> Result<Vec<&'a Object>, String> {
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

    pub(super) fn one_mesh(&self) -> Result<(&'a Object, &'a Mesh), String> {
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

    pub(super) fn sum<T: std::iter::Sum>(&self, term: impl Fn(&Mesh) -> T) -> Result<T, String> {
        Ok(self.meshes()?.into_iter().map(|(_, mesh)| term(mesh)).sum())
    }

    pub(super) fn each_mesh(
        &self,
        ask: impl Fn(&str, &Mesh) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let meshes = self.meshes()?;
        if meshes.is_empty() {
            return Err("expected a mesh, found none".to_owned().into());
        }
        meshes
            .into_iter()
            .try_for_each(|(object, mesh)| ask(&object.name, mesh))
    }

    /// All points: vertices of meshes and points of polylines, patches and curves.
    pub(super) fn points(&self) -> Result<Vec<DVec3>, String> {
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

    pub(super) fn other(&self, other: &Other) -> Result<Arc<Mesh>, String> {
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

    pub(super) fn bounds(&self, min: Vector, max: Vector, tolerance: f64) -> Result<(), Failure> {
        let points = self.points()?;
        let Some(&first) = points.first() else {
            return Err("expected points, found none".to_owned().into());
        };
        let low = points.iter().fold(first, |a, &b| a.min(b));
        let high = points.iter().fold(first, |a, &b| a.max(b));
        let off = |a: DVec3, b: Vector| (a - DVec3::from(b)).abs().max_element();
        if off(low, min) <= tolerance && off(high, max) <= tolerance {
            return Ok(());
        }
        let (min, max) = (DVec3::from(min), DVec3::from(max));
        let message = format!("expected bounds from {min} to {max}, found {low} to {high}");
        let found = Found::Bounds {
            min: low,
            max: high,
            tolerance,
        };
        Err(Failure::Recorded(message, found))
    }

    pub(super) fn valence(
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

    pub(super) fn dihedral(
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

    pub(super) fn edge_length(
        &self,
        of: &EdgeSelection,
        min: Option<f64>,
        max: Option<f64>,
    ) -> Result<(), Failure> {
        let mut n = 0;
        for (object, mesh) in self.meshes()? {
            for e in selected(of, object, mesh, self.files)? {
                n += 1;
                let [v, w] = mesh.edge_vertices(e).map(|v| mesh.position(v));
                let what = format!("a length of {}", ends(mesh, e));
                near(&what, v.distance(w), [None, min, max], 0.0)?;
            }
        }
        if n == 0 {
            let message = "expected edges to be selected, found none";
            return Err(message.to_owned().into());
        }
        Ok(())
    }

    /// The smallest corner angle of the faces of a selection, in degrees, and the face that has it.
    pub(super) fn smallest_angle(&self, of: &FaceSelection) -> Result<(f64, FaceId), Failure> {
        let mut smallest: Option<(f64, FaceId)> = None;
        for (object, mesh) in self.meshes()? {
            for f in selected(of, object, mesh, self.files)? {
                for angle in mesh.face_half_edges(f).map(|h| mesh.corner_angle(h)) {
                    if smallest.is_none_or(|(least, _)| angle < least) {
                        smallest = Some((angle, f));
                    }
                }
            }
        }
        smallest
            .map(|(angle, f)| (angle.to_degrees(), f))
            .ok_or_else(|| {
                "expected faces to be selected, found none"
                    .to_owned()
                    .into()
            })
    }

    pub(super) fn mean_area(
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

    pub(super) fn position(
        &self,
        of: &VertexSelection,
        is: DVec3,
        tolerance: f64,
    ) -> Result<(), Failure> {
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
    ) -> Result<(), Failure> {
        let lines = self.polylines()?;
        let Some(&found) = lines.get(line as usize).and_then(|l| l.get(index as usize)) else {
            let message = format!("there is no point {index} on a polyline {line}");
            return Err(Failure::Unmet(message));
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
) -> Result<Vec<S::Id>, Failure> {
    let mut cx = Context::new(&NoProgress, files);
    cx.materials = object.materials.iter().map(|m| m.name.clone()).collect();
    selection.resolve(mesh, &cx).map_err(|error| match error {
        OpError::Refused { message, .. } => Failure::Unmet(message),
        other => Failure::Unknown(other.to_string()),
    })
}

pub(super) fn ends(mesh: &Mesh, e: EdgeId) -> String {
    let [v, w] = mesh.edge_vertices(e);
    format!("the edge {v}-{w}")
}

fn found_at(
    at: DVec3,
    is: DVec3,
    tolerance: f64,
    what: impl FnOnce() -> String,
) -> Result<(), Failure> {
    if at.distance(is) <= tolerance {
        return Ok(());
    }
    let message = format!("expected {} at {is}, found it at {at}", what());
    Err(Failure::Recorded(
        message,
        Found::Position { at, tolerance },
    ))
}

pub(super) fn fails_unless(holds: bool, message: impl FnOnce() -> String) -> Result<(), Failure> {
    if holds {
        Ok(())
    } else {
        Err(Failure::Unmet(message()))
    }
}

pub(super) fn within<T: PartialOrd + fmt::Display + Copy + Into<i128>>(
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
        Some((word, Some(n), _)) => {
            let what = counted(what, n.into());
            let message = format!("expected {word}{n} {what}, found {found}");
            // A recorded value in place of the found one would not mend what is broken besides.
            Err(if word.is_empty() && bounds[1].2 && bounds[2].2 {
                Failure::Recorded(message, Found::Count(found.into()))
            } else {
                Failure::Unmet(message)
            })
        }
        _ => Ok(()),
    }
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
    what: &str,
    found: f64,
    [eq, min, max]: [Option<f64>; 3],
    tolerance: f64,
) -> Result<(), Failure> {
    const EQ: &str = "of ";
    let bounds = [
        (EQ, eq, eq.is_none_or(|x| (found - x).abs() <= tolerance)),
        ("of at least ", min, min.is_none_or(|x| found >= x)),
        ("of at most ", max, max.is_none_or(|x| found <= x)),
    ];
    match bounds.into_iter().find(|(_, _, holds)| !holds) {
        Some((word, Some(x), _)) => {
            let message = format!("expected {what} {word}{x}, found {found}");
            Err(if word == EQ && bounds[1].2 && bounds[2].2 {
                Failure::Recorded(message, Found::Number(found))
            } else {
                Failure::Unmet(message)
            })
        }
        _ => Ok(()),
    }
}
