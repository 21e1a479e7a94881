//! Operations that create meshes: polygons and standard shapes.

mod cube;
mod cylinder;
mod grid;
mod icosahedron;
mod octahedron;
mod polygons;
mod tetrahedron;
mod torus;
mod uv_sphere;

use op::{PositiveLength, Registry};

pub use cube::Cube;
pub use cylinder::Cylinder;
pub use grid::Grid;
pub use icosahedron::Icosahedron;
pub use octahedron::Octahedron;
pub use polygons::Polygons;
pub use tetrahedron::Tetrahedron;
pub use torus::Torus;
pub use uv_sphere::UvSphere;

/// Adds the operations of this group, in the order of the reference.
#[rustfmt::skip]
pub fn register(registry: Registry) -> Registry {
    registry
        .with::<Polygons>()
        .with::<Cube>()
        .with::<Tetrahedron>()
        .with::<Octahedron>()
        .with::<Icosahedron>()
        .with::<Grid>()
        .with::<Torus>()
        .with::<Cylinder>()
        .with::<UvSphere>()
}

// Defaults of parameters.

const fn one() -> PositiveLength {
    PositiveLength::literal(1.0)
}

const fn two() -> PositiveLength {
    PositiveLength::literal(2.0)
}

const fn yes() -> bool {
    true
}
