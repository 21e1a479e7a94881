//! Places in a scene that errors are about.

use mesh::{DVec3, Element, Mesh};

/// An element as it was when an error named it.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorLocation {
    /// The object that it is in.
    pub object: String,
    /// What it is called, as `e7`; empty for a place that has no name.
    pub name: String,
    /// Where it is, in scene units: one point, both ends of an edge, or the corners of a face in order.
    pub points: Vec<DVec3>,
}

impl ErrorLocation {
    /// Of so many elements that an error is about it is kept where they are.
    pub const MOST: usize = 10_000;

    /// The name of a place where something should be and is not.
    pub const EXPECTED: &'static str = "expected";

    /// The place of an element of an object; `None` if the mesh does not have it.
    pub fn of(object: &str, mesh: &Mesh, element: impl Into<Element>) -> Option<Self> {
        let element = element.into();
        let points = mesh.element_points(element);
        (!points.is_empty()).then(|| Self {
            object: object.to_owned(),
            name: element.to_string(),
            points,
        })
    }
}
