//! Code that several deformations share: coordinates along an axis, and moving vertices in parallel.

use geometry::deform::Frame;
use mesh::{DVec3, VertexId, parallel};
use op::Axis;
use op::prelude::*;

/// Moves each vertex to a new position if its entry in `mask` is true. Removes the normals. The report counts the
/// vertices that moved. `parameters` names the parameters that can make a coordinate too large.
pub(crate) fn moved(
    mesh: &mut Mesh,
    mask: &[bool],
    operation: &str,
    parameters: &str,
    position: impl Fn(VertexId, DVec3) -> DVec3 + Sync,
) -> Result<Report, OpError> {
    let old = mesh.positions();
    let new: Vec<DVec3> = parallel::collect(old.len(), |v| {
        if mask[v] {
            position(VertexId::new(v), old[v])
        } else {
            old[v]
        }
    });
    if !parallel::all(new.len(), |v| new[v].is_finite()) {
        return Err(OpError::overflow(operation, parameters));
    }
    let moved = new
        .iter()
        .zip(mesh.positions())
        .filter(|(p, q)| p != q)
        .count();
    mesh.positions_mut().copy_from_slice(&new);
    mesh.remove_normals();
    Ok(Report::changed(moved))
}

/// The part of an axis along which a deformation grows from zero to its full amount.
#[derive(Clone, Copy)]
pub(crate) struct Stretch {
    axis: Axis,
    about: Vector,
    from: Option<Distance>,
    to: Option<Distance>,
}

impl Stretch {
    /// Creates a part of the axis that goes through the point `about`. The part starts at the coordinate `from` and
    /// ends at the coordinate `to`. If `from` is `None`, the part starts at the lowest coordinate of the mesh along the
    /// axis. If `to` is `None`, the part ends at the highest coordinate.
    pub(crate) const fn new(
        axis: Axis,
        about: Vector,
        from: Option<Distance>,
        to: Option<Distance>,
    ) -> Self {
        Self {
            axis,
            about,
            from,
            to,
        }
    }

    /// Returns a problem if `from` is greater than `to`.
    pub(crate) fn problems(&self) -> Vec<Problem> {
        match (self.from, self.to) {
            (Some(from), Some(to)) if from > to => {
                let message = format!(
                    "`from` must not exceed `to`, found {} and {}",
                    from.get(),
                    to.get()
                );
                vec![Problem::error(message).at(["from"])]
            }
            _ => Vec::new(),
        }
    }

    /// Returns the coordinate frame with the unit vectors `towards`, axis × `towards`, and axis. If `from` or `to` is
    /// `None`, the corresponding end of the bounding box is used.
    pub(crate) fn frame(&self, mesh: &Mesh, towards: Axis) -> Result<Frame, OpError> {
        let axis = unit(self.axis);
        let [min, max] = geometry::bounds(mesh).unwrap_or_default();
        let from = self.from.map_or(axis.dot(min), Distance::get);
        let to = self.to.map_or(axis.dot(max), Distance::get);
        if from > to {
            return Err(OpError::Parameter(format!(
                "`from` must not exceed `to`, found {from} and {to}; an omitted end defaults to the end of the \
                 bounding box"
            )));
        }
        let about: DVec3 = self.about.into();
        let towards = unit(towards);
        Ok(Frame {
            // `from` and `to` are measured from the origin of the scene, not from `about`. The origin of the frame is
            // therefore the point of the axis at the coordinate 0.
            origin: about - axis * axis.dot(about),
            axes: [towards, axis.cross(towards), axis],
            from,
            to,
        })
    }
}

/// Returns the unit vector of an axis.
pub(crate) fn unit(axis: Axis) -> DVec3 {
    match axis {
        Axis::X => DVec3::X,
        Axis::Y => DVec3::Y,
        Axis::Z => DVec3::Z,
    }
}

/// Returns the axis after `axis` in the order x, y, z, x.
pub(crate) fn next(axis: Axis) -> Axis {
    match axis {
        Axis::X => Axis::Y,
        Axis::Y => Axis::Z,
        Axis::Z => Axis::X,
    }
}
