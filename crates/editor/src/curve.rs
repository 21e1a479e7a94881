//! Control points of curves and patches.

use glam::DAffine3;
use mesh::{DVec2, DVec3};
use scene::{Geometry, Object, Scene};

use crate::edit::{Command, CommandError, Editor};
use crate::panel::number;
use crate::pick::{PICK_RADIUS, Projection};

/// Returns the control points of a curve or of patches, in the space of the object. A patch has 16 points, row by row.
/// For all other objects, the list is empty.
pub fn control_points(object: &Object) -> Vec<DVec3> {
    match &object.geometry {
        Geometry::Curve(curve) => curve.points().iter().map(|p| p.extend(0.0)).collect(),
        Geometry::Patches(patches) => patches
            .iter()
            .flat_map(|patch| patch.points().as_flattened().to_vec())
            .collect(),
        Geometry::Mesh(_) | Geometry::Polylines(_) => Vec::new(),
    }
}

/// A control point in the view.
#[derive(Clone, Debug, PartialEq)]
pub struct ControlPoint {
    /// The name of the object.
    pub object: String,
    /// The index of the control point in the list that [`control_points`] returns for the object.
    pub index: usize,
    /// The position in scene space.
    pub point: DVec3,
    to_scene: DAffine3,
    is_of_curve: bool,
}

impl ControlPoint {
    /// Returns where the control point moves when it is dragged to a pixel. The position is in the space of the object.
    /// A control point of a curve is dragged within the plane of the curve. A control point of a patch is dragged
    /// within the plane that contains the point and is parallel to the picture. Returns `None` if no point of this
    /// plane is visible at the pixel.
    pub fn dragged_to(&self, view: &Projection, pixel: DVec2) -> Option<DVec3> {
        let of_object = view.of_object(self.to_scene);
        let at = if self.is_of_curve {
            let (near, along) = of_object.ray(pixel);
            let t = -near.z / along.z;
            (0.0..=1.0)
                .contains(&t)
                .then(|| (near + along * t).with_z(0.0))?
        } else {
            let (_, depth) = view.to_pixel(self.point)?;
            of_object.point_at(pixel, depth)
        };
        at.is_finite().then_some(at)
    }
}

/// Returns the control point that is nearest to a pixel, within [`PICK_RADIUS`]. If several control points are equally
/// near to the pixel, returns the control point that is nearest to the camera.
pub fn pick_control_point(scene: &Scene, view: &Projection, pixel: DVec2) -> Option<ControlPoint> {
    let mut best: Option<([f64; 2], ControlPoint)> = None;
    for instance in scene.instances() {
        let object = instance.object;
        for (index, point) in control_points(object).into_iter().enumerate() {
            let point = instance.to_scene.transform_point3(point);
            let Some((at, depth)) = view.to_pixel(point) else {
                continue;
            };
            let key = [at.distance(pixel), depth];
            let is_nearer = best.as_ref().is_none_or(|(known, _)| key < *known);
            if key[0] <= PICK_RADIUS && is_nearer {
                let found = ControlPoint {
                    object: object.name.clone(),
                    index,
                    point,
                    to_scene: instance.to_scene,
                    is_of_curve: matches!(object.geometry, Geometry::Curve(_)),
                };
                best = Some((key, found));
            }
        }
    }
    best.map(|(_, found)| found)
}

impl Editor {
    /// Moves a control point of a curve or patch. The control point must exist in the scene after the last step before
    /// the step cursor. A step `MoveControlPoint` or `MovePatchPoint` is inserted at the cursor. The new position `to`
    /// is in the space of the object. In this space, a curve lies in the plane z = 0. If the step before the cursor
    /// already moves the same control point, the parameter `to` of that step is changed instead. Several movements of
    /// the same control point therefore become one step. If `is_preview` is true, the movement is only previewed, and
    /// the text does not change.
    ///
    /// # Errors
    ///
    /// Returns [`CommandError::NoControlPoints`] if the object is neither a curve nor a set of patches. Also returns
    /// the errors of [`Editor::apply`].
    pub fn move_control_point(
        &mut self,
        object: &str,
        index: usize,
        to: DVec3,
        is_preview: bool,
    ) -> Result<(), CommandError> {
        let scene = self.view().scene;
        let found = scene.object(object).map(|o| &o.geometry);
        let [x, y, z] = to.to_array().map(number);
        let (operation, to) = match found {
            Some(Geometry::Curve(_)) => ("MoveControlPoint", format!("({x}, {y})")),
            Some(Geometry::Patches(_)) => ("MovePatchPoint", format!("({x}, {y}, {z})")),
            _ => return Err(CommandError::NoControlPoints(object.to_owned())),
        };
        let is_same_kind = |o: &&Object| Some(o.geometry.kind()) == found.map(Geometry::kind);
        let is_one = scene.objects().iter().filter(is_same_kind).count() == 1;
        if let Some(step) = self.cursor().checked_sub(1) {
            let written = &self.outline().steps[step];
            let is_on = written
                .on
                .as_ref()
                .map_or(is_one, |on| on.as_slice() == [object]);
            let is_same = written.name == operation
                && is_on
                && written.enabled
                && self.parameter(step, &["index"]) == Some(index.to_string().as_str());
            if is_same && is_preview {
                return self.preview_parameter(step, &["to"], &to);
            } else if is_same {
                return self.set_parameter(step, &["to"], Some(&to));
            }
        }
        let mut command = Command::new(operation)
            .with("index", &index.to_string())
            .with("to", &to);
        command.on = (!is_one).then(|| object.to_owned());
        if is_preview {
            self.preview(&command)
        } else {
            self.apply(&command)
        }
    }
}
