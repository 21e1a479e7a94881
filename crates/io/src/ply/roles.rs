//! Determines which elements and properties of a PLY file contain vertices, faces, normals, colors and texture
//! coordinates.

use super::header::{Element, Header};
use crate::fault::Fault;
use crate::note::Notes;
use crate::text::TextPosition;

/// The elements that become a mesh. The fields contain the indices of elements and properties.
#[derive(Debug)]
pub(super) struct Roles {
    pub(super) vertex: usize,
    /// The properties `x`, `y` and `z`.
    pub(super) position: [usize; 3],
    /// The element of the faces, and its list of vertex indices.
    pub(super) face: Option<(usize, usize)>,
    /// The element of the triangle strips and its list of vertex indices, if there are no faces.
    pub(super) strips: Option<(usize, usize)>,
}

impl Roles {
    /// # Errors
    ///
    /// Returns an error if there are no vertices, or if an element lacks a required property.
    pub(super) fn of(header: &Header) -> Result<Self, Fault> {
        let Some((vertex, vertices)) = header.element("vertex") else {
            let place = TextPosition::of_line(header.lines);
            return Err(place.error("expected an element `vertex`, but the header has none"));
        };
        let mut position = [0; 3];
        for (place, name) in position.iter_mut().zip(POSITION) {
            *place = scalar(vertices, name)?;
        }
        let with_rows = |name: &str| header.element(name).filter(|(_, e)| e.rows > 0);
        let corners = |found: Option<(usize, &Element)>| {
            found
                .map(|(e, element)| Ok((e, corner_list(element)?)))
                .transpose()
        };
        let face = corners(with_rows("face"))?;
        let strips = match face {
            None => corners(with_rows("tristrips"))?,
            Some(_) => None,
        };
        Ok(Self {
            vertex,
            position,
            face,
            strips,
        })
    }

    /// Whether the element at this index becomes a part of the mesh.
    pub(super) fn uses(&self, element: usize) -> bool {
        let faces = self.face.or(self.strips).map(|(e, _)| e);
        element == self.vertex || Some(element) == faces
    }

    /// Adds notes about the elements and texture files that do not become a part of the mesh.
    pub(super) fn note_unused(&self, header: &Header, notes: &mut Notes) {
        for (place, element) in header.elements.iter().enumerate() {
            if !self.uses(place) {
                let what = format!("rows of {element} left out");
                notes.left_out("elements", element.rows, element.place.line, what);
            }
        }
        let comments = header.comments.iter();
        let textures = comments.filter(|comment| comment.starts_with("TextureFile "));
        let what = "texture files of comments `TextureFile` left out";
        notes.left_out("textures", textures.count(), None, what);
    }
}

fn scalar(element: &Element, name: &str) -> Result<usize, Fault> {
    if let Some(found) = element.scalar(name) {
        return Ok(found);
    }
    let (place, found) = match element.list(name) {
        Some(list) => (element.properties[list].place, "a list"),
        None => (element.place, "none"),
    };
    Err(place.error(format!(
        "expected a scalar property `{name}` in {element}, found {found}"
    )))
}

/// Finds the list of the vertices of a face or strip.
fn corner_list(element: &Element) -> Result<usize, Fault> {
    if let Some(list) = CORNERS.iter().find_map(|name| element.list(name)) {
        let property = &element.properties[list];
        if property.value.is_float() {
            let found = property.value.name();
            let message = format!("expected a list of integers, found a list of type {found}");
            return Err(property.place.error(message));
        }
        return Ok(list);
    }
    let scalar = CORNERS.iter().find_map(|name| element.scalar(name));
    let place = scalar.map_or(element.place, |p| element.properties[p].place);
    let found = scalar.map_or("none", |_| "a scalar");
    Err(place.error(format!(
        "expected a list property `vertex_indices` in {element}, found {found}"
    )))
}

/// Each entry of `names` is a family of property names, such as `s` and `t`. Returns the property indices of the first
/// family whose properties all exist.
fn family<const N: usize>(element: &Element, names: &[[&str; N]]) -> Option<[usize; N]> {
    names.iter().find_map(|family| {
        let mut found = [0; N];
        for (place, name) in found.iter_mut().zip(family) {
            *place = element.scalar(name)?;
        }
        Some(found)
    })
}

const CORNERS: [&str; 2] = ["vertex_indices", "vertex_index"];
const POSITION: [&str; 3] = ["x", "y", "z"];
const NORMAL: [&str; 3] = ["nx", "ny", "nz"];
const UVS: [[&str; 2]; 4] = [
    ["s", "t"],
    ["u", "v"],
    ["texture_u", "texture_v"],
    ["texture_s", "texture_t"],
];
const COLORS: [[&str; 4]; 3] = [
    ["red", "green", "blue", "alpha"],
    [
        "diffuse_red",
        "diffuse_green",
        "diffuse_blue",
        "diffuse_alpha",
    ],
    ["r", "g", "b", "a"],
];

/// Returns the names of all properties with a known meaning, such as `s` and `t`. The writer does not use these names
/// for the properties of other attributes.
pub(super) fn names() -> impl Iterator<Item = &'static str> {
    let families = UVS.as_flattened().iter().chain(COLORS.as_flattened());
    let others = POSITION
        .iter()
        .chain(&NORMAL)
        .chain(&CORNERS)
        .chain(&["texcoord"]);
    families.chain(others).copied()
}

/// The properties of a normal.
pub(super) fn normal(element: &Element) -> Option<[usize; 3]> {
    family(element, &[NORMAL])
}

/// The properties of texture coordinates of vertices.
pub(super) fn uv(element: &Element) -> Option<[usize; 2]> {
    family(element, &UVS)
}

/// Returns the properties for red, green and blue, and the property for alpha if it exists.
pub(super) fn color(element: &Element) -> Option<([usize; 3], Option<usize>)> {
    COLORS
        .iter()
        .find_map(|&[r, g, b, a]| Some((family(element, &[[r, g, b]])?, element.scalar(a))))
}
