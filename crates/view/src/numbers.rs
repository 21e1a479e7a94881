//! Computes quantities of mesh elements, such as areas and curvatures, so that colors can show them.

use std::collections::BTreeSet;
use std::path::Path;

use geometry::distance;
use mesh::{Domain, EdgeId, FaceId, Mesh, Values, VertexId};
use render::figure::legend::{Legend, Scale};
use render::{ColorMap, Coloring, PictureError};
use scene::Scene;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Shows a quantity as colors of the surface, with a legend.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct ColorBy {
    /// The quantity that the colors show.
    pub of: Quantity,
    /// The color map. The default is `Classes` for valences, `Diverging` for curvatures, and `Viridis` for all other
    /// quantities.
    #[serde(default)]
    pub map: Option<ColorMap>,
    /// The values that the first and the last color represent, as in `(0, 60)`. If omitted, the range is computed from
    /// the values of the quantity. For curvatures, the range is symmetric about 0, and the lowest and the highest
    /// eighth of the values are ignored. If all remaining values are 0, only the lowest and the highest 2 % of the
    /// values are ignored, or no values.
    #[serde(default)]
    pub range: Option<[f64; 2]>,
    /// Whether a legend in a corner of the picture explains the colors.
    #[serde(default = "yes")]
    pub legend: bool,
}

fn yes() -> bool {
    true
}

/// A quantity of mesh elements: one number for each vertex, edge, face or corner.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Quantity {
    /// The number of edges of each vertex.
    Valence,
    /// The smallest angle of each face, in degrees: 60 in an equilateral triangle, 0 in a sliver.
    #[serde(alias = "SmallestAngle")]
    #[schemars(extend("aliases" = ["SmallestAngle"]))]
    MinAngle,
    /// The area of each face, in scene units².
    Area,
    /// The angle between the normals of the two faces at each edge, in degrees: 0 where the surface is flat. The edges
    /// are drawn as lines in the colors of their angles.
    DihedralAngle,
    /// The mean curvature at each vertex, in 1 / scene unit: positive where the surface is convex.
    MeanCurvature,
    /// The Gaussian curvature at each vertex, in 1 / scene unit²: negative at saddles.
    GaussianCurvature,
    /// An attribute. If several kinds of elements have an attribute of this name, the first kind in this order is used:
    /// vertices, faces, corners, edges.
    Attribute {
        /// The name of the attribute.
        name: String,
        /// The index of the component of a vector, counted from 0. If omitted, the length of the vector is used.
        #[serde(default)]
        #[schemars(range(max = 3))]
        component: Option<u32>,
    },
    /// The distance of each vertex from the nearest point of the meshes in another file, in scene units. The path of
    /// the file is relative to the folder of the recipe.
    DistanceTo(String),
}

/// The values of a quantity for the meshes of a scene.
pub struct Numbers {
    /// For each mesh that has the quantity: the value of each element, and the mapping from values to colors.
    pub colorings: Vec<Coloring>,
    pub(crate) scale: ColorScale,
}

impl Numbers {
    /// Returns the legend that explains the colors, or `None` if the pictures have no legend.
    pub fn legend(&self) -> Option<Legend> {
        self.scale.legend()
    }
}

/// The mapping from numbers to colors.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ColorScale {
    title: String,
    map: ColorMap,
    /// The numbers that the first and the last color represent.
    pub(crate) range: [f64; 2],
    /// The distinct values in the scene, rounded down. [`ColorMap::Classes`] lists them in the legend; other color maps
    /// do not use them.
    classes: Vec<f64>,
    /// Whether pictures have a legend.
    legend: bool,
}

impl ColorBy {
    /// Shows a quantity as colors, with the default color map, range and legend.
    pub fn new(of: Quantity) -> Self {
        Self {
            of,
            map: None,
            range: None,
            legend: true,
        }
    }

    /// Computes the values of the quantity for all meshes of a scene, with a common color range. `targets` are the
    /// meshes to which [`Quantity::DistanceTo`] measures distances.
    ///
    /// # Errors
    ///
    /// Returns [`PictureError::Style`] if no mesh has this quantity.
    pub fn numbers(&self, scene: &Scene, targets: &[Mesh]) -> Result<Numbers, PictureError> {
        let mut numbers = Vec::new();
        for object in scene.objects() {
            if let Some(mesh) = object.as_mesh() {
                let values = self.of.values(mesh, targets);
                numbers.extend(values.map(|(domain, values)| (&object.name, domain, values)));
            }
        }
        if numbers.is_empty() {
            let meshes = scene.objects().iter().filter_map(|o| o.as_mesh());
            let names = meshes.flat_map(|m| m.attributes().iter().map(|(_, c)| c.name.as_str()));
            let message = match &self.of {
                Quantity::Attribute { name, .. } => {
                    let existing = existing_attributes(names.collect());
                    format!("{}; {existing}", missing_attribute(name))
                }
                _ => "expected a mesh whose quantities can be shown as colors, found no mesh in the scene".to_owned(),
            };
            return Err(PictureError::Style(message));
        }
        let map = self.map.unwrap_or_else(|| self.of.map());
        let all = numbers.iter().flat_map(|(_, _, values)| values).copied();
        let range = self.range.unwrap_or_else(|| self.of.range(all.collect()));
        let colorings = numbers
            .into_iter()
            .map(|(object, domain, values)| Coloring {
                object: object.clone(),
                domain,
                values,
                map,
                range,
            });
        let colorings: Vec<Coloring> = colorings.collect();
        let mut scale = ColorScale {
            title: self.of.title(),
            map,
            range,
            classes: Vec::new(),
            legend: self.legend,
        };
        if map == ColorMap::Classes {
            let values = colorings.iter().flat_map(|coloring| &coloring.values);
            scale
                .classes
                .extend(values.filter(|x| x.is_finite()).map(|x| x.floor()));
            scale.sort_classes();
        }
        Ok(Numbers { colorings, scale })
    }
}

/// Returns the error message for an attribute that no mesh has.
pub fn missing_attribute(name: &str) -> String {
    format!("no mesh has the attribute \"{name}\"")
}

/// Returns a help text with the names of the attributes of all meshes.
pub fn existing_attributes(mut names: Vec<&str>) -> String {
    names.sort_unstable();
    names.dedup();
    if names.is_empty() {
        return "the meshes have no attributes".to_owned();
    }
    let names: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).collect();
    format!("the meshes have the attributes {}", names.join(", "))
}

impl Quantity {
    /// Returns the quantities that can be shown for a scene without further input. The result contains all quantities
    /// that are computed from one mesh, and all attributes of the meshes of the scene.
    pub fn of_scene(scene: &Scene) -> Vec<Self> {
        let mut quantities = vec![
            Self::MeanCurvature,
            Self::GaussianCurvature,
            Self::Valence,
            Self::MinAngle,
            Self::Area,
            Self::DihedralAngle,
        ];
        let meshes = scene.objects().iter().filter_map(|o| o.as_mesh());
        let columns = meshes.flat_map(|mesh| mesh.attributes().iter());
        let names: BTreeSet<&str> = columns.map(|(_, column)| &*column.name).collect();
        quantities.extend(names.into_iter().map(|name| Self::Attribute {
            name: name.to_owned(),
            component: None,
        }));
        quantities
    }

    /// Returns the kind of elements that have the quantity, and one number for each element of this kind, in the order
    /// of the indices. The number of an element without a value is NaN. Returns `None` if the mesh does not have this
    /// quantity.
    fn values(&self, mesh: &Mesh, targets: &[Mesh]) -> Option<(Domain, Vec<f64>)> {
        let each = |domain, value: &dyn Fn(usize) -> Option<f64>| {
            let all = 0..mesh.domain_len(domain);
            let values = all.map(|i| value(i).unwrap_or(f64::NAN));
            (domain, values.collect())
        };
        let faces = |value: &dyn Fn(FaceId) -> f64| {
            let face = |i| Some(FaceId::new(i)).filter(|&f| mesh.has_face(f));
            each(Domain::Face, &|i| face(i).map(value))
        };
        Some(match self {
            #[expect(clippy::cast_precision_loss, reason = "a vertex has few edges")]
            Self::Valence => each(Domain::Vertex, &|i| {
                let v = VertexId::new(i);
                mesh.has_vertex(v).then(|| mesh.valence(v) as f64)
            }),
            Self::MinAngle => faces(&|f| geometry::min_angle(mesh, f).to_degrees()),
            Self::Area => faces(&|f| mesh.face_area(f)),
            Self::DihedralAngle => {
                let angle = mesh.dihedral_angles();
                each(Domain::Edge, &|i| {
                    let e = Some(EdgeId::new(i)).filter(|&e| mesh.has_edge(e));
                    e.and_then(&angle).map(f64::to_degrees)
                })
            }
            Self::MeanCurvature => (Domain::Vertex, geometry::mean_curvatures(mesh)),
            Self::GaussianCurvature => (Domain::Vertex, geometry::gaussian_curvatures(mesh)),
            Self::Attribute { name, component } => attribute(mesh, name, *component)?,
            Self::DistanceTo(_) => {
                let mut min_distances = vec![f64::NAN; mesh.domain_len(Domain::Vertex)];
                for target in targets {
                    let distances = distance::vertex_distances(mesh, target)?;
                    for (min, d) in min_distances.iter_mut().zip(distances) {
                        if min.is_nan() || d < *min {
                            *min = d;
                        }
                    }
                }
                (Domain::Vertex, min_distances)
            }
        })
    }

    /// Returns the default color map.
    fn map(&self) -> ColorMap {
        match self {
            Self::Valence => ColorMap::Classes,
            Self::MeanCurvature | Self::GaussianCurvature => ColorMap::Diverging,
            _ => ColorMap::Viridis,
        }
    }

    /// Returns the default range for these values of the quantity: the numbers that the first and the last color
    /// represent.
    fn range(&self, mut values: Vec<f64>) -> [f64; 2] {
        values.retain(|x| x.is_finite());
        values.sort_unstable_by(f64::total_cmp);
        let (Some(&low), Some(&high)) = (values.first(), values.last()) else {
            return [0.0, 1.0];
        };
        match self {
            Self::MinAngle => [0.0, if high > 60.0 { 90.0 } else { 60.0 }],
            Self::DihedralAngle => [0.0, if high > 90.0 { 180.0 } else { 90.0 }],
            Self::DistanceTo(_) => [0.0, high],
            // The range is symmetric about 0. The range excludes the lowest and the highest eighth of the values.
            // Curvatures are very large at sharp corners and rims, and meshes often have many vertices there. If all
            // remaining values are 0, as on a flat surface with sharp edges, the range excludes only 2 % of the values
            // at each end. If the remaining 96 % are all 0 too, the range excludes no values.
            Self::MeanCurvature | Self::GaussianCurvature => {
                let max = [8, 50, usize::MAX].map(|part| {
                    let n_outliers = values.len() / part;
                    let (low, high) = (values[n_outliers], values[values.len() - 1 - n_outliers]);
                    low.abs().max(high.abs())
                });
                let max = max.into_iter().find(|&max| max > 0.0).unwrap_or_default();
                [-max, max]
            }
            _ => [low, high],
        }
    }

    /// Returns a title with the unit, for legends and lists.
    pub fn title(&self) -> String {
        match self {
            Self::Valence => "valence".to_owned(),
            Self::MinAngle => "min angle [°]".to_owned(),
            Self::Area => "area".to_owned(),
            Self::DihedralAngle => "dihedral angle [°]".to_owned(),
            Self::MeanCurvature => "mean curvature".to_owned(),
            Self::GaussianCurvature => "Gaussian curvature".to_owned(),
            Self::Attribute { name, component } => match component {
                Some(component) => format!("{name}[{component}]"),
                None => name.clone(),
            },
            Self::DistanceTo(path) => {
                let name = Path::new(path).file_name().unwrap_or_default();
                format!("distance to {}", name.to_string_lossy())
            }
        }
    }
}

/// Searches vertices, faces, corners and edges, in this order, for an attribute of this name. Returns the values of the
/// first such attribute.
fn attribute(mesh: &Mesh, name: &str, component: Option<u32>) -> Option<(Domain, Vec<f64>)> {
    let domains = [Domain::Vertex, Domain::Face, Domain::Corner, Domain::Edge];
    let mut columns = domains.into_iter().filter_map(|domain| {
        let column = mesh.attributes().column(domain, name)?;
        Some((domain, &column.values))
    });
    let (domain, values) = columns.next()?;
    let number = |components: &[f64]| match component {
        Some(i) => components.get(i as usize).copied().unwrap_or(f64::NAN),
        None if components.len() == 1 => components[0],
        None => components.iter().map(|x| x * x).sum::<f64>().sqrt(),
    };
    let values = match values {
        Values::Float(list) => list.iter().map(|&x| number(&[x])).collect(),
        Values::Vec2(list) => list.iter().map(|v| number(&v.to_array())).collect(),
        Values::Vec3(list) => list.iter().map(|v| number(&v.to_array())).collect(),
        Values::Vec4(list) => list.iter().map(|v| number(&v.to_array())).collect(),
        Values::Int(list) => list.iter().map(|&i| number(&[i.into()])).collect(),
        Values::Tag(list) => (list.iter())
            .map(|&t| number(&[u8::from(t).into()]))
            .collect(),
    };
    Some((domain, values))
}

impl ColorScale {
    /// Extends the range and the classes (the distinct values for the legend), so that they include those of another
    /// scene.
    pub(crate) fn join(&mut self, other: &Self) {
        let [low, high] = other.range;
        if low < self.range[0] {
            self.range[0] = low;
        }
        if high > self.range[1] {
            self.range[1] = high;
        }
        self.classes.extend(&other.classes);
        self.sort_classes();
    }

    fn sort_classes(&mut self) {
        self.classes.sort_unstable_by(f64::total_cmp);
        self.classes.dedup();
    }

    /// Returns the legend, if pictures have one.
    pub(crate) fn legend(&self) -> Option<Legend> {
        let opaque = |[r, g, b]: [u8; 3]| [r, g, b, 255];
        let scale = if self.map == ColorMap::Classes {
            let entry = |&class: &f64| (format!("{class}"), opaque(self.map.class(class)));
            Scale::Discrete(self.classes.iter().map(entry).collect())
        } else {
            let [low, high] = self.range;
            let colors = (0..=32).map(|i| opaque(self.map.srgb(f64::from(i) / 32.0)));
            Scale::Continuous {
                low,
                high,
                colors: colors.collect(),
            }
        };
        self.legend.then(|| Legend {
            title: self.title.clone(),
            scale,
        })
    }
}
