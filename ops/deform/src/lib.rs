//! Operations that move vertices and keep the faces.

mod bend;
mod displace;
mod lattice;
mod move_vertices;
mod moved;
mod project;
mod taper;
mod twist;

use op::Registry;

pub use bend::Bend;
pub use displace::{Displace, DisplaceBy};
pub use lattice::Lattice;
pub use move_vertices::{MoveBy, MoveVertices};
pub use project::{Project, ProjectAlong};
pub use taper::Taper;
pub use twist::Twist;

/// Adds the operations of this group to the registry. The list in `ops/README.md` has the same order.
#[rustfmt::skip]
pub fn register(registry: Registry) -> Registry {
    registry
        .with::<MoveVertices>()
        .with::<Displace>()
        .with::<Bend>()
        .with::<Twist>()
        .with::<Taper>()
        .with::<Lattice>()
        .with::<Project>()
}
