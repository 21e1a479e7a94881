//! Extrude faces: moves faces out of the surface and puts side faces between the old place and the new.
//!
//! ```text
//!                             +------ +
//!                            /   f   / |            f keeps its number, the rim is new there
//!     +-------- +           +------ +  |
//!    /    f    /     -->    |   s   | .+            s: one side face for each edge of the rim,
//!   +-------- +             +------ +               which stays where it was
//! ```
//!
//! Faces that share an edge move together, as a region. A point p of a region with the center c goes to
//! R s (p - c) + c + o: s scales, R turns, o is the offset, d times the normal for `Distance(d)`.

mod region;

use glam::{DMat3, DVec3};
use mesh::{Domain, FaceId};
use op::Turn;
use op::prelude::*;

use region::Region;

/// Moves faces out of the surface and puts side faces between the old place and the new.
///
/// Faces that share an edge move together, as one region, with one normal and one center. First a region
/// is scaled, then turned, both about the mean of its vertices, then moved. Side faces, all of four
/// corners, stand along its rim: along the edges that have one of its faces on one side only. A whole
/// sheet becomes a box that is open where the sheet was. A whole closed part has no rim: it only moves,
/// and has no normal, so that it needs an `Offset`.
///
/// The faces keep their numbers, so that the same selection can be extruded again, step after step: that is
/// how an arm grows out of a body, all in one piece. So do vertices and edges inside of a region. Those of
/// its rim stay where they were, and the moved faces get new ones. New side faces are numbered
/// behind all others: the regions in order of their lowest face, in each the faces in order of their numbers,
/// around each counter-clockwise from its first corner. New vertices come in the same order, each
/// above the one that its side face begins with.
///
/// Side faces have the values of the face that they stand on (material, tags), and their corners those that
/// its corners there have, so that textures go on without a seam, but without width on the sides. The new
/// edges of the rim have the values of the old ones (creases, tags), the upright ones none. Normals are
/// dropped.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct ExtrudeFaces {
    /// Which faces.
    pub faces: FaceSelection,
    /// How far and where to.
    pub by: By,
    /// The factor of size of each region about its center; above 0.
    #[serde(default = "one")]
    pub scale: PositiveFactor,
    /// Turns of each region about its center, one after the other.
    #[serde(default, alias = "turn")]
    #[schemars(extend("aliases" = ["turn"]))]
    pub rotate: Vec<Turn>,
    /// Marks the moved faces and their side faces with this tag; those that have it already keep it.
    #[serde(default)]
    pub tag: Option<TagName>,
}

/// How far faces move, and where to.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum By {
    /// So far along the normal of each region, in scene units; a negative distance moves inwards. The
    /// normal is the mean of the normals of its faces, weighted by area.
    Distance(Distance),
    /// So far along x, y and z, in scene units.
    Offset(Vector),
}

const fn one() -> PositiveFactor {
    PositiveFactor::literal(1.0)
}

impl ExtrudeFaces {
    fn offset(&self, mesh: &Mesh, region: &Region) -> Result<DVec3, OpError> {
        match self.by {
            By::Offset(offset) => Ok(offset.into()),
            By::Distance(d) => match region.normal(mesh) {
                Some(n) => Ok(d.get() * n),
                None => Err(OpError::Parameter(format!(
                    "by: the faces around {} have no normal to move along: they are closed, or have no \
                     area; `Offset` moves them",
                    region.faces[0]
                ))),
            },
        }
    }
}

impl MeshOperation for ExtrudeFaces {
    const NAME: &'static str = "ExtrudeFaces";
    const SUMMARY: &'static str = "Move faces out of the surface, with side faces behind them";
    const EXAMPLE: &'static str = "ExtrudeFaces(faces: Faces([0]), by: Distance(0.5))";

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        // The rim has no more edges than the faces have sides, and each edge is in it once at most.
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
        let turned_and_scaled = Turn::all(&self.rotate) * self.scale.get();
        cx.advance("extrude", 0, regions.len() as u64)?;

        mesh.remove_normals();
        let (mut n_faces, mut n_sides) = (0, 0);
        for (done, region) in (1..).zip(&regions) {
            let offset = self.offset(mesh, region)?;
            let sides = mesh.extrude_faces(&region.faces, offset)?;
            change(mesh, region, turned_and_scaled)?;
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
            Report::changed(n_faces).note(format!("regions: {n}, side faces: {n_sides}"))
        })
    }
}

/// Turns and scales a region about its center.
fn change(mesh: &mut Mesh, region: &Region, linear: DMat3) -> Result<(), OpError> {
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

/// Marks faces, which may be newer than the marks.
fn mark(marks: &mut Vec<bool>, faces: &[FaceId]) {
    for f in faces {
        marks.resize(marks.len().max(f.index() + 1), false);
        marks[f.index()] = true;
    }
}

#[cfg(test)]
mod tests;
