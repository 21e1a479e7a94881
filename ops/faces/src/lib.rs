//! Operations that edit faces.

mod bevel_faces;
mod delete_faces;
mod extrude_faces;
mod inset_faces;
mod poke_faces;
mod split_faces;

use op::{MeshPlan, Range, Registry};

pub use bevel_faces::BevelFaces;
pub use delete_faces::DeleteFaces;
pub use extrude_faces::{ExtrudeBy, ExtrudeFaces};
pub use inset_faces::InsetFaces;
pub use poke_faces::PokeFaces;
pub use split_faces::SplitFaces;

/// Adds the operations of this group to the registry. The list in `ops/README.md` has the same order.
#[rustfmt::skip]
pub fn register(registry: Registry) -> Registry {
    registry
        .with::<PokeFaces>()
        .with::<SplitFaces>()
        .with::<DeleteFaces>()
        .with::<ExtrudeFaces>()
        .with::<InsetFaces>()
        .with::<BevelFaces>()
}

/// Updates the predicted counts of a mesh for an operation that adds a ring of quadrilaterals inside some of the faces.
/// `faces` is the number of these faces.
fn plan_rings(plan: &mut MeshPlan, faces: Range) {
    let corners = plan.corners_of(faces);
    plan.grow(corners, corners.by(2), corners);
    if corners.max > 0 {
        plan.degrees = plan.degrees.or(Range::exactly(4));
    }
    plan.drop_normals();
}
