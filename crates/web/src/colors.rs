//! The colors of quantities, as a view draws them.

use mesh::{Domain, Mesh};
use render::figure::legend::{Legend, Scale};
use render::{Coloring, PictureError, to_srgb};
use scene::Scene;
use serde::Serialize;
use serde_json::{Value as Json, json};
use view::{ColorBy, Quantity};

use crate::arrays::each_triangle;

/// The colors of all meshes of a scene, with a common scale.
#[derive(Clone, Debug, PartialEq)]
pub struct Colors {
    /// The title and the colors of the scale.
    pub legend: Json,
    /// The colors of each mesh that has the quantity.
    pub meshes: Vec<MeshColors>,
}

/// The colors of a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshColors {
    /// The name of the object.
    pub object: String,
    /// The elements that have colors.
    pub per: Per,
    /// The red, green and blue values of each element in sRGB, one element after another.
    pub colors: Vec<u8>,
}

/// The elements that have colors.
#[derive(Clone, Copy, Debug, Eq, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Per {
    /// The vertices, in the order of their ids.
    Vertex,
    /// The corners of the triangles, in the order of [`Arrays`](crate::Arrays).
    Corner,
    /// The edges, in the order of [`Arrays`](crate::Arrays).
    Edge,
}

impl Colors {
    /// Shows a quantity of a scene as colors.
    ///
    /// # Errors
    ///
    /// Returns [`PictureError::Style`] if no mesh has this quantity.
    pub fn new(scene: &Scene, quantity: Quantity) -> Result<Self, PictureError> {
        let numbers = ColorBy::new(quantity).numbers(scene, &[])?;
        let meshes = numbers.colorings.iter().filter_map(|coloring| {
            let mesh = scene.object(&coloring.object)?.as_mesh()?;
            Some(MeshColors::new(mesh, coloring))
        });
        Ok(Self {
            meshes: meshes.collect(),
            legend: numbers.legend().map_or(Json::Null, described),
        })
    }
}

impl MeshColors {
    fn new(mesh: &Mesh, coloring: &Coloring) -> Self {
        let mut colors = Vec::new();
        let mut add = |element: usize| {
            let value = coloring.values[element];
            colors.extend(coloring.map.linear(value, coloring.range).map(to_srgb));
        };
        let per = match coloring.domain {
            Domain::Vertex => {
                (0..coloring.values.len()).for_each(add);
                Per::Vertex
            }
            Domain::Edge => {
                mesh.edges().for_each(|e| add(e.index()));
                Per::Edge
            }
            Domain::Face => {
                each_triangle(mesh, |f, _| (0..3).for_each(|_| add(f.index())));
                Per::Corner
            }
            Domain::Corner => {
                each_triangle(mesh, |_, corners| {
                    for h in corners {
                        add(h.index());
                    }
                });
                Per::Corner
            }
        };
        Self {
            object: coloring.object.clone(),
            per,
            colors,
        }
    }
}

/// Describes a legend: `title`, and either `low`, `high` and `colors`, or `classes` with pairs of a name and a color.
/// Colors are as in `#4477aa`.
fn described(legend: Legend) -> Json {
    let color = |rgba| render::Color(rgba).to_string();
    match legend.scale {
        Scale::Continuous { low, high, colors } => {
            let colors: Vec<_> = colors.into_iter().map(color).collect();
            json!({ "title": legend.title, "low": low, "high": high, "colors": colors })
        }
        Scale::Discrete(classes) => {
            let classes: Vec<_> = classes.into_iter().map(|(n, c)| (n, color(c))).collect();
            json!({ "title": legend.title, "classes": classes })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Arrays;
    use geometry::shapes;
    use scene::Object;

    fn scene(mesh: Mesh) -> Scene {
        let mut scene = Scene::new();
        scene.insert(Object::mesh("a", mesh)).unwrap();
        scene
    }

    fn colors(scene: &Scene, quantity: Quantity) -> Colors {
        Colors::new(scene, quantity).unwrap()
    }

    /// For each quantity, each array of colors has one color for each element that the view draws.
    #[test]
    fn all_elements_of_the_arrays_have_colors() {
        let scene = scene(shapes::cylinder(7, true));
        let arrays = Arrays::new(scene.object("a").unwrap().as_mesh().unwrap());
        for quantity in Quantity::of_scene(&scene) {
            let colors = colors(&scene, quantity.clone());
            let [mesh] = &colors.meshes[..] else {
                panic!("one mesh")
            };
            let expected = match mesh.per {
                Per::Vertex => arrays.positions.len(),
                Per::Corner => 3 * arrays.triangles.len(),
                Per::Edge => 3 * arrays.edges.len() / 2,
            };
            assert_eq!(mesh.colors.len(), expected, "{quantity:?}");
            assert_eq!(colors.legend["title"], quantity.title());
        }
    }

    /// In a box with faces of two sizes, the smaller faces have the first color of the legend, and the larger faces
    /// have the last color.
    #[test]
    fn the_colors_are_those_of_the_legend() {
        let mut mesh = shapes::cube();
        for p in mesh.positions_mut() {
            p.x *= 2.0;
        }
        let scene = scene(mesh);
        let found = colors(&scene, Quantity::Area);
        let hex = |rgb: &[u8]| json!(render::Color::rgb(rgb[0], rgb[1], rgb[2]).to_string());
        let ends = [&found.legend["colors"][0], &found.legend["colors"][32]];
        let area = |f| scene.object("a").unwrap().as_mesh().unwrap().face_area(f);
        let arrays = Arrays::new(scene.object("a").unwrap().as_mesh().unwrap());
        for (corner, rgb) in found.meshes[0].colors.chunks(3).enumerate() {
            let face = arrays.faces[corner / 3] as usize;
            let is_large =
                area(mesh::FaceId::new(face)) > 1.5 * found.legend["low"].as_f64().unwrap();
            assert_eq!(&hex(rgb), ends[usize::from(is_large)], "corner {corner}");
        }
        let valences = colors(&scene, Quantity::Valence);
        let class = &valences.legend["classes"][0];
        assert_eq!(
            (&class[0], &class[1]),
            (&json!("3"), &hex(&valences.meshes[0].colors[..3]))
        );
    }
}
