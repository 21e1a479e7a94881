//! Transform: scales, rotates and moves objects.
//!
//! ```text
//!                                                         +---+
//!    +---+       +------+         +---+                   |   |
//!    |   |  -->  |      |  -->    |   |        -->        |   |
//!    c---+       c------+         |   |                   |   |
//!                             +---c                   +---c
//!             scale: (2, 1, 1)   rotate: [(axis: Z, angle: 90)]   move: (3, 1, 0)
//! ```
//!
//! A point p moves to R S (p - c) + c + m, where S scales, R rotates, m is the parameter `move`, and c is the point
//! that `about` defines.

mod map;
mod nodes;

use std::sync::Arc;

use bezier::{Curve, Patch};
use glam::DVec3;
use mesh::{Domain, Rule, Values, morph_name, parallel};
use op::prelude::*;
use op::{Loss, Operation, target_names};
use scene::Geometry;

use crate::transform::map::Map;

/// Scales, rotates and moves objects.
///
/// Points are first scaled, then rotated, then moved. The step changes the points of meshes, patches, curves and
/// polylines. If nodes of the scene (as in glTF) place an object and `space` is `Scene`, the step changes the
/// transforms of these nodes instead of the points. The descendants of these nodes move with them. A skinned mesh
/// follows its joints, so with `space: Scene`, the step moves the joints. If the transform of a node is animated, the
/// animation would overwrite the change. The step therefore gives this node a new parent and moves the parent. Root
/// nodes without an object, such as the nodes of cameras and lights, also move if three conditions hold: `space` is
/// `Scene`, the step has no `on`, and `about` is not `Center`. The step fails if a curve would leave the plane z = 0.
///
/// Ids do not change. If the points of a mesh change, its normals, its tangents and the deltas of its morph targets are
/// also transformed. Other attributes do not change. If the points are mirrored (one or three negative factors in
/// `scale`), the faces are also reversed, so that they stay counter-clockwise seen from outside. In a reversed face,
/// the first corner stays first, and the other corners follow in reverse order. In mirrored patches, u and v are
/// exchanged, so that the same side of the surface remains the outside. Attributes with the edit rule `Drop`, such as
/// tangents of corners, are removed by every step that changes the connectivity. Mirroring the points reverses the
/// faces, so it also removes the attributes with this rule.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Transform {
    /// The scale factors along x, y and z. Factors must not be 0. A negative factor mirrors along its axis.
    #[serde(default = "ones")]
    pub scale: Factors,
    /// The rotations, applied in the order of the list.
    #[serde(default)]
    pub rotate: Vec<Turn>,
    /// The distances to move along x, y and z, in scene units.
    #[serde(default, rename = "move")]
    pub translate: Vector,
    /// The point that scaling and rotation do not move.
    #[serde(default)]
    pub about: About,
    /// The coordinate system in which objects are scaled, rotated and moved.
    #[serde(default)]
    pub space: Space,
}

/// The coordinate system in which objects are scaled, rotated and moved.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Space {
    /// The space of the scene. If nodes place an object in the scene, the step changes the transforms of these nodes.
    /// If no node places the object, the step changes the points of the object.
    #[default]
    Scene,
    /// The coordinate system in which the object stores its points. The step changes the points of the object, so all
    /// instances of the object change.
    Object,
}

const fn ones() -> Factors {
    Factors::literal(1.0, 1.0, 1.0)
}

/// The point that scaling and rotation do not move.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum About {
    /// The origin.
    #[default]
    Origin,
    /// The center of the bounding box of each object. The bounding box contains the vertices of a mesh, the control
    /// points of patches or curves, or the points of polylines. With `space: Scene`, the box contains the points of all
    /// instances of the object.
    Center,
    /// A point with the coordinates x, y, z.
    Point(f64, f64, f64),
}

impl Transform {
    /// Returns the affine transform that the parameters define.
    fn map(&self) -> Map {
        Map::new(self.scale.get(), &self.rotate, self.translate.into())
    }

    /// Returns the point that scaling and rotation do not move. `points` are the points of the object.
    fn center(&self, points: impl Iterator<Item = DVec3>) -> DVec3 {
        match self.about {
            About::Origin => DVec3::ZERO,
            About::Point(x, y, z) => DVec3::new(x, y, z),
            About::Center => {
                let bounds = points.fold(None, |bounds: Option<[DVec3; 2]>, p| {
                    let [min, max] = bounds.unwrap_or([p, p]);
                    Some([min.min(p), max.max(p)])
                });
                // Each number is halved before the addition, because the sum of two large finite numbers can be
                // infinite.
                bounds.map_or(DVec3::ZERO, |[min, max]| 0.5 * min + 0.5 * max)
            }
        }
    }

    /// Transforms the geometry of the object `name`. The report counts the points of the object.
    fn change(&self, name: &str, geometry: &mut Geometry, map: &Map) -> Result<Report, OpError> {
        let too_large =
            || OpError::overflow(&format!("Transform of `{name}`"), "scale, rotate and move");
        match geometry {
            Geometry::Mesh(mesh) => {
                let center = self.center(mesh.positions().iter().copied());
                let mesh = Arc::make_mut(mesh);
                parallel::change(mesh.positions_mut(), |p| *p = map.point(*p, center));
                let points = mesh.positions();
                if !parallel::all(points.len(), |v| points[v].is_finite()) {
                    return Err(too_large());
                }
                if !map.only_moves() {
                    transform_normals(mesh, map);
                    scene::transform_tangents(mesh, map.linear());
                    transform_deltas(mesh, map);
                }
                let mut report = Report::changed(mesh.n_vertices());
                if map.mirrors() {
                    let columns = mesh.attributes().iter();
                    let reason = "a mirror reverses the faces";
                    let lost = columns.filter(|(_, c)| c.rule == Rule::Drop);
                    let lost = lost.map(|(d, c)| Loss::attribute(name, d, &c.name, reason));
                    report.losses.extend(lost);
                    mesh.reverse();
                    mesh.compact();
                }
                Ok(report)
            }
            Geometry::Patches(patches) => {
                let points = patches.iter().flat_map(|p| p.points().as_flattened());
                let center = self.center(points.copied());
                for patch in &mut *patches {
                    let points = patch.points().map(|row| row.map(|p| map.point(p, center)));
                    *patch = Patch::new(points).map_err(|_| too_large())?;
                    if map.mirrors() {
                        *patch = patch.transposed();
                    }
                }
                Ok(Report::changed(16 * patches.len()))
            }
            Geometry::Curve(curve) => {
                let points = || curve.points().iter().map(|p| p.extend(0.0));
                let center = self.center(points());
                let moved: Vec<DVec3> = points().map(|p| map.point(p, center)).collect();
                if let Some((i, p)) = moved.iter().enumerate().find(|(_, p)| p.z != 0.0) {
                    return Err(OpError::Parameter(format!(
                        "the curve \"{name}\" must stay in the plane z = 0, but its control point {i} \
                         would get z = {}",
                        p.z
                    )));
                }
                let n = moved.len();
                *curve = Curve::new(moved.iter().map(|p| p.truncate()).collect())
                    .map_err(|_| too_large())?;
                Ok(Report::changed(n))
            }
            Geometry::Polylines(lines) => {
                let center = self.center(lines.iter().flatten().copied());
                for p in lines.iter_mut().flatten() {
                    *p = map.point(*p, center);
                    if !p.is_finite() {
                        return Err(too_large());
                    }
                }
                Ok(Report::changed(lines.iter().map(Vec::len).sum()))
            }
        }
    }

    /// Returns a problem if the transform moves a curve out of the plane z = 0.
    fn curve_problem(&self, name: &str) -> Option<Problem> {
        let center = match self.about {
            About::Point(x, y, z) => DVec3::new(x, y, z),
            // The center of a curve and the origin are both in the plane z = 0. The other coordinates of the center do
            // not change the result.
            About::Origin | About::Center => DVec3::ZERO,
        };
        match self.map().height_of_plane(center) {
            Some(0.0) => None,
            Some(z) => Some(Problem::error(format!(
                "the curve \"{name}\" must stay in the plane z = 0, but would get z = {z}"
            ))),
            None => Some(Problem::warning(format!(
                "the curve \"{name}\" must stay in the plane z = 0, but the rotation moves the curve out of \
                 the plane unless all points of the curve are on the axis"
            ))),
        }
    }
}

impl Operation for Transform {
    const NAME: &'static str = "Transform";
    const SUMMARY: &'static str = "Scale, rotate, move and mirror objects";
    const EXAMPLE: &'static str =
        "Transform(scale: (2, 1, 1), rotate: [(axis: Z, angle: 90)], move: (3, 1, 0))";
    const WORDS: &'static [&'static str] = &["move", "translate", "scale", "rotate", "mirror"];
    const TAKES_ON: bool = true;

    fn plan(&self, plan: &mut Plan, cx: &PlanContext) -> Vec<Problem> {
        let mut problems = Vec::new();
        let is_target = |name: &String| cx.on.is_none_or(|on| on.contains(name));
        let objects = plan.objects().iter();
        let objects: Vec<_> = objects.filter(|o| is_target(&o.name)).collect();
        if objects.is_empty() && !plan.incomplete {
            problems.push(Problem::error("Transform has no object to change"));
        }
        for object in objects {
            if let PlannedGeometry::Curve(_) = object.geometry {
                problems.extend(self.curve_problem(&object.name));
            }
        }
        problems.extend(self.plan_nodes(plan, cx));
        problems
    }

    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError> {
        let mut names = target_names(scene, cx, |_| true)?;
        let map = self.map();
        let mut report = Report::default();
        cx.advance("transform", 0, names.len() as u64)?;
        if self.space == Space::Scene && !scene.graph().is_empty() {
            report = self.move_nodes(scene, &mut names, &map, cx)?;
        }
        for (done, name) in (1..).zip(&names) {
            let (geometry, _) = scene.parts_mut(name).expect("a name of the scene");
            report.merge(self.change(name, geometry, &map)?);
            cx.advance("transform", done, names.len() as u64)?;
        }
        Ok(report)
    }
}

/// Transforms the values of all attributes that hold normals.
fn transform_normals(mesh: &mut Mesh, map: &Map) {
    let columns = mesh.attributes().iter();
    let normals = columns.filter(|(domain, column)| scene::holds_normals(*domain, column));
    let normals: Vec<_> = normals
        .map(|(domain, c)| (domain, c.name.clone()))
        .collect();
    for (domain, name) in normals {
        let mut column = mesh.remove_column(domain, &name).expect("listed above");
        if let Values::Vec3(values) = &mut column.values {
            parallel::change(values, |n| *n = map.normal(*n));
        }
        mesh.insert_column(domain, column);
    }
}

/// Transforms the deltas of morph targets.
fn transform_deltas(mesh: &mut Mesh, map: &Map) {
    let morphs = mesh.attributes().morphs().into_iter();
    let morphs: Vec<String> = morphs.map(|(target, _)| morph_name(target)).collect();
    for name in morphs {
        let mut column = (mesh.remove_column(Domain::Vertex, &name)).expect("listed above");
        if let Values::Vec3(values) = &mut column.values {
            parallel::change(values, |delta| *delta = map.vector(*delta));
        }
        mesh.insert_column(Domain::Vertex, column);
    }
}

#[cfg(test)]
mod node_tests;
#[cfg(test)]
mod tests;
