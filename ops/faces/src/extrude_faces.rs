//! Extrude faces: moves faces out of the surface and connects them to their old rim with side faces.
//!
//! ```text
//!                             +------ +
//!                            /   f   / |            f keeps its id and gets a new rim
//!     +-------- +           +------ +  |
//!    /    f    /     -->    |   s   | .+            s: one side face for each edge of the old rim,
//!   +-------- +             +------ +               which does not move
//! ```
//!
//! Faces that share an edge move together, as a region. A point p of a region with the center c moves to `R s (p - c) +
//! c + o`, where s is the scale, R the rotation and o the offset. With `by: Distance(d)`, the offset o is the unit
//! normal of the region, multiplied by d.

mod region;

use glam::{DMat3, DVec3};
use mesh::{Domain, FaceId};
use op::Turn;
use op::prelude::*;

use region::Region;

/// Moves faces out of the surface and connects them to their old rim with side faces.
///
/// Selected faces that are connected across edges form a region. A region moves as a whole, and has one normal and one
/// center. A region is first scaled, then rotated, and then moved. Scaling and rotation are about the center of the
/// region, which is the mean position of its vertices. Side faces with four corners are added along the rim of the
/// region. An edge belongs to the rim if exactly one of its two sides has a face of the region. If all faces of an open
/// sheet are extruded, the result is a box that is open where the sheet was. A closed region (for example, all faces of
/// a cube) has no rim, so it moves without new side faces. A region has no normal if the area vectors of its faces
/// cancel each other out, as in a closed region. For a region without a normal, `by` must be an `Offset`.
///
/// The moved faces keep their ids. A later step can therefore extrude the same faces again, for example to grow an arm
/// out of a body. Vertices and edges inside a region also keep their ids. The vertices and edges of the old rim do not
/// move, and the moved faces get a new rim. New side faces get the highest ids. Side faces are ordered by region, and
/// within a region by the id of the adjacent moved face. Regions are ordered by their lowest face id. Around each moved
/// face, the order is counter-clockwise from its first corner. Each side face adds one new vertex, so the new vertices
/// are in the order of the side faces. A new vertex is a copy of a vertex on the old rim: the first vertex of its side
/// face.
///
/// A side face has the attribute values (material, tags) of the adjacent moved face. The corners of a side face have
/// the values of the corners of the moved face, so textures have no seam between the two faces. However, a side face
/// shows only one line of the texture: the line along the edge of the moved face. This line is stretched over the whole
/// side face. The edges of the new rim have the values of the edges of the old rim (creases, tags). The edges between
/// the old and the new rim have zero values (no crease, no tags). Normals are dropped.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct ExtrudeFaces {
    /// The faces to extrude.
    pub faces: FaceSelection,
    /// The distance or offset by which the faces move.
    pub by: ExtrudeBy,
    /// The factor by which each region is scaled about its center. More than 0.
    #[serde(default = "one")]
    pub scale: PositiveFactor,
    /// Rotations of each region about its center, applied in order.
    #[serde(default, alias = "turn")]
    #[schemars(extend("aliases" = ["turn"]))]
    pub rotate: Vec<Turn>,
    /// The name of a tag for the moved faces and their side faces. Faces that already have the tag keep it. If omitted,
    /// no faces are tagged.
    #[serde(default)]
    pub tag: Option<TagName>,
}

/// The distance or offset by which faces move.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum ExtrudeBy {
    /// The distance along the normal of each region, in scene units. A region consists of selected faces that are
    /// connected by edges. Its normal is the mean of the normals of these faces, weighted by area. A negative distance
    /// moves the faces inwards.
    Distance(Distance),
    /// The offset along x, y and z, in scene units.
    Offset(Vector),
}

const fn one() -> PositiveFactor {
    PositiveFactor::literal(1.0)
}

impl ExtrudeFaces {
    fn offset(&self, mesh: &Mesh, region: &Region) -> Result<DVec3, OpError> {
        match self.by {
            ExtrudeBy::Offset(offset) => Ok(offset.into()),
            ExtrudeBy::Distance(d) => match region.normal(mesh) {
                Some(n) => Ok(d.get() * n),
                None => Err(OpError::Parameter(format!(
                    "by: the region of face {} has no normal to move along, because the areas of its faces cancel \
                     out or are zero; use `Offset`",
                    region.faces[0].index()
                ))),
            },
        }
    }
}

impl MeshOperation for ExtrudeFaces {
    const NAME: &'static str = "ExtrudeFaces";
    const SUMMARY: &'static str = "Move faces out of the surface and add side faces";
    const EXAMPLE: &'static str = "ExtrudeFaces(faces: Faces([0]), by: Distance(0.5))";
    const WORDS: &'static [&'static str] = &["offset", "thicken"];

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        // All rims together have at most as many edges as the selected faces have sides. No edge is on two rims.
        let sides = self.faces.count(plan).times(plan.degrees);
        let rim = sides.capped(plan.edges.max).or_less();
        plan.grow(rim, rim.by(2), rim);
        if rim.max > 0 {
            plan.degrees = plan.degrees.or(Range::exactly(4));
        }
        plan.drop_normals();
        if let Some(tag) = &self.tag {
            plan.provide(Domain::Face, tag.as_str());
        }
        Vec::new()
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        let tag = self.tag.as_ref();
        let mut marks = tag.map(|tag| tag.marks(mesh, Domain::Face)).transpose()?;
        let regions = Region::all(mesh, &self.faces.mask(mesh, cx)?);
        let linear = Turn::all(&self.rotate) * self.scale.get();
        cx.advance("extrude", 0, regions.len() as u64)?;

        mesh.remove_normals();
        let (mut n_faces, mut n_sides) = (0, 0);
        for (done, region) in (1..).zip(&regions) {
            let offset = self.offset(mesh, region)?;
            let sides = mesh.extrude_faces(&region.faces, offset)?;
            transform(mesh, region, linear)?;
            n_faces += region.faces.len();
            n_sides += sides.len();
            if let Some(marks) = &mut marks {
                mark(marks, &region.faces);
                mark(marks, &sides);
            }
            if done % 1024 == 0 {
                cx.advance("extrude", done, regions.len() as u64)?;
            }
        }
        if let (Some(mut marks), Some(tag)) = (marks, tag) {
            marks.resize(mesh.domain_len(Domain::Face), false);
            tag.write(mesh, Domain::Face, marks);
        }
        Ok(if n_faces == 0 {
            Report::default().note("nothing was selected")
        } else {
            let n = regions.len();
            Report::changed(n_faces).note(format!(
                "connected regions of selected faces: {n}, new side faces: {n_sides}"
            ))
        })
    }
}

/// Applies the linear map `linear` to the vertices of a region. The center of the region does not move.
fn transform(mesh: &mut Mesh, region: &Region, linear: DMat3) -> Result<(), OpError> {
    if linear == DMat3::IDENTITY {
        return Ok(());
    }
    let vertices = region.vertices(mesh);
    let center = region::center(mesh, &vertices);
    for v in vertices {
        let p = linear * (mesh.position(v) - center) + center;
        if !p.is_finite() {
            return Err(OpError::overflow("ExtrudeFaces", "scale and rotate"));
        }
        mesh.set_position(v, p);
    }
    Ok(())
}

/// Sets the entry of each of the `faces` in `marks` to true. Extends `marks` if it has no entries for the newest faces.
fn mark(marks: &mut Vec<bool>, faces: &[FaceId]) {
    for f in faces {
        marks.resize(marks.len().max(f.index() + 1), false);
        marks[f.index()] = true;
    }
}

#[cfg(test)]
mod tests;
