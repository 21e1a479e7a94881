//! The subject of an expectation (the scene to check), and measurements that several expectations use.

use std::fmt;
use std::path::Path;
use std::sync::Arc;

use mesh::{DVec3, EdgeId, FaceId, Mesh};
use op::{
    Context, EdgeSelection, FaceSelection, Files, OpError, Progress, Select, Vector,
    VertexSelection,
};
use scene::{Geometry, Object, Scene};

use super::OtherMesh;
use super::violation::{ActualValue, Violation, check_number, check_position};

/// Reads the files that expectations refer to.
pub trait Reader: Sync {
    /// Reads the scene in a file. Calls [`Files::has_read`] for each file that is read.
    ///
    /// # Errors
    ///
    /// If the file cannot be read, returns a [`Violation`] whose message gives the path and the reason.
    fn scene(&self, path: &Path, files: &Files) -> Result<Scene, Violation>;

    /// Compares the pixels of two PNG files, each given by its path and bytes. Returns a description of the differences
    /// that are larger than `tolerance` steps of 1/255. Returns `None` if there are no such differences.
    ///
    /// # Errors
    ///
    /// If one of the files cannot be read, returns a [`Violation`] whose message gives the path and the reason.
    fn compare_pictures(
        &self,
        found: (&Path, &[u8]),
        expected: (&Path, &[u8]),
        tolerance: u8,
    ) -> Result<Option<String>, Violation>;
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

    /// Calls `check` for each mesh, with the elements that the selection matches in this mesh. Fails if the selection
    /// matches no element in any mesh.
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

    /// Returns the polylines of the only object that has polylines. Fails unless exactly one object has polylines.
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

/// Returns the elements of one object that a selection matches. The selection can be refused, for example because it
/// names a missing edge. In this case, the expectation does not hold, and the expectation `Not(..)` around it holds.
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
