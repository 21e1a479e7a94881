//! Operations: edits of faces.

mod bevel_faces;
mod delete_faces;
mod extrude_faces;
mod inset_faces;
mod poke_faces;
mod split_faces;

use op::Registry;

pub use bevel_faces::BevelFaces;
pub use delete_faces::DeleteFaces;
pub use extrude_faces::{By, ExtrudeFaces};
pub use inset_faces::InsetFaces;
pub use poke_faces::PokeFaces;
pub use split_faces::SplitFaces;

/// Adds the operations of this group, in the order of the reference.
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
