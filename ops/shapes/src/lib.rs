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

use op::{Count, PositiveLength, Registry};

pub use cube::Cube;
pub use cylinder::Cylinder;
pub use grid::Grid;
pub use icosahedron::Icosahedron;
pub use octahedron::Octahedron;
pub use polygons::Polygons;
pub use tetrahedron::Tetrahedron;
pub use torus::Torus;
pub use uv_sphere::UvSphere;

/// Adds the operations of this group to the registry. The list in `ops/README.md` has the same order.
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

const fn ten() -> Count<1> {
    Count::literal(10)
}

const fn thirty_two() -> Count<3> {
    Count::literal(32)
}

const fn yes() -> bool {
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use op::Operation;
    use op::prelude::*;

    /// Runs an operation with default parameters twice in the same scene. Returns the names of the two objects.
    fn twice<O: Operation + serde::de::DeserializeOwned>() -> Vec<String> {
        let mut scene = Scene::new();
        let mut plan = Plan::default();
        let files = op::Files::default();
        let cx = PlanContext::new(&files);
        for _ in 0..2 {
            let step: O = op::test::read("()").unwrap();
            assert_eq!(step.plan(&mut plan, &cx), []);
            op::test::run(&step, &mut scene).unwrap();
        }
        let names: Vec<String> = scene.objects().iter().map(|o| o.name.clone()).collect();
        let planned: Vec<String> = plan.objects().iter().map(|o| o.name.clone()).collect();
        assert_eq!(planned, names);
        names
    }

    #[test]
    fn shapes_need_no_parameters_and_get_free_names() {
        assert_eq!(twice::<Cube>(), ["cube", "cube.2"]);
        assert_eq!(twice::<Tetrahedron>(), ["tetrahedron", "tetrahedron.2"]);
        assert_eq!(twice::<Octahedron>(), ["octahedron", "octahedron.2"]);
        assert_eq!(twice::<Icosahedron>(), ["icosahedron", "icosahedron.2"]);
        assert_eq!(twice::<Grid>(), ["grid", "grid.2"]);
        assert_eq!(twice::<Torus>(), ["torus", "torus.2"]);
        assert_eq!(twice::<Cylinder>(), ["cylinder", "cylinder.2"]);
        assert_eq!(twice::<UvSphere>(), ["uvsphere", "uvsphere.2"]);
    }
}
