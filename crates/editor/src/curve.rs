//! Control points of curves and patches.

use bezier::Curve;
use mesh::{DVec2, DVec3};
use scene::{Geometry, Object};

use crate::edit::{Command, CommandError, Editor};
use crate::panel::number;

/// Returns the control points of a curve or of patches, in the space of the object. A patch has 16 points, row by row. Empty
/// for other objects.
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

/// Returns the segments of the control net of a curve or of patches, as pairs of indices of
/// [`control_points`].
pub fn control_net(object: &Object) -> Vec<[usize; 2]> {
    match &object.geometry {
        Geometry::Curve(curve) => (1..curve.points().len()).map(|i| [i - 1, i]).collect(),
        Geometry::Patches(patches) => {
            let of_patch = |p: usize| {
                let at = move |row: usize, column: usize| 16 * p + 4 * row + column;
                let rows = (0..4).flat_map(move |r| (0..3).map(move |c| [at(r, c), at(r, c + 1)]));
                rows.chain((0..4).flat_map(move |c| (0..3).map(move |r| [at(r, c), at(r + 1, c)])))
            };
            (0..patches.len()).flat_map(of_patch).collect()
        }
        Geometry::Mesh(_) | Geometry::Polylines(_) => Vec::new(),
    }
}

/// Returns all levels of de Casteljau's algorithm on a curve at `t`: the control points first, the point of the curve last.
pub fn de_casteljau(curve: &Curve<DVec2>, t: f64) -> Vec<Vec<DVec2>> {
    curve.levels(t)
}

impl Editor {
    /// Moves a control point of a curve of the scene at the cursor. If the step before the cursor moves the same control
    /// point, its `to` is changed, so that dragging gives one step. With `is_preview`, the text stays as it is.
    ///
    /// # Errors
    ///
    /// [`CommandError::NotCurve`] if the object is not a curve; other errors as [`Editor::apply`].
    pub fn move_control_point(
        &mut self,
        object: &str,
        index: usize,
        to: DVec2,
        is_preview: bool,
    ) -> Result<(), CommandError> {
        let view = self.view();
        let curves = view
            .scene
            .objects()
            .iter()
            .filter(|o| matches!(o.geometry, Geometry::Curve(_)));
        let is_one = curves.clone().count() == 1;
        if !curves.clone().any(|curve| curve.name == object) {
            return Err(CommandError::NotCurve(object.to_owned()));
        }
        let to = format!("({}, {})", number(to.x), number(to.y));
        if let Some(step) = self.cursor().checked_sub(1) {
            let written = &self.outline().steps[step];
            let is_on = written
                .on
                .as_ref()
                .map_or(is_one, |on| on.as_slice() == [object]);
            let is_same = written.name == "MoveControlPoint"
                && is_on
                && written.enabled
                && self.parameter(step, &["index"]) == Some(index.to_string().as_str());
            if is_same && is_preview {
                return self.preview_parameter(step, &["to"], &to);
            } else if is_same {
                return self.set_parameter(step, &["to"], Some(&to));
            }
        }
        let mut command = Command::new("MoveControlPoint")
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
