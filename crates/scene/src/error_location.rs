//! Error locations: the positions in a scene that errors refer to.

use mesh::{DVec3, Element, Mesh};

/// The location of an element that an error refers to. The positions are copied when the error occurs, so they stay the
/// same if the mesh changes later.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorLocation {
    /// The name of the object that contains the element.
    pub object: String,
    /// The name of the element, such as `e7`; empty if the location has no name.
    pub name: String,
    /// The positions, in scene units: one point, both ends of an edge, or the corners of a face in order.
    pub points: Vec<DVec3>,
}

impl ErrorLocation {
    /// The maximum number of locations that are stored for one error.
    pub const MAX_ELEMENTS: usize = 10_000;

    /// The name of a location whose element does not exist. Such a location shows where the element was expected.
    pub const EXPECTED: &'static str = "expected";

    /// Returns the location of an element of an object; `None` if the mesh does not have the element.
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
