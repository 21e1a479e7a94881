//! Numbers of meshes that are shown as colors.

use std::path::Path;

use geometry::distance;
use mesh::{Domain, EdgeId, FaceId, Mesh, Values, VertexId};
use render::figure::legend::{Legend, Scale};
use render::{ColorMap, Coloring, PictureError};
use scene::Scene;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Numbers that are shown as colors of the surface, with a legend.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct ColorBy {
    /// Which numbers.
    pub of: Quantity,
    /// How they become colors; unless told otherwise, as it suits them.
    #[serde(default)]
    pub map: Option<ColorMap>,
    /// The numbers of the first and the last color, as in `(0, 60)`; unless told otherwise those that are found,
    /// without the outermost 2 % of curvatures.
    #[serde(default)]
    pub range: Option<[f64; 2]>,
    /// Whether the colors are explained in a corner.
    #[serde(default = "yes")]
    pub legend: bool,
}

fn yes() -> bool {
    true
}

/// Numbers of a mesh.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Quantity {
    /// How many edges each vertex has.
    Valence,
    /// The smallest angle of each face, in degrees: 60 in a regular triangle, 0 in a sliver.
    SmallestAngle,
    /// The area of each face, in scene units².
    Area,
    /// The angle between the faces at each edge, in degrees: 0 where they are flat. Edges become lines.
    DihedralAngle,
    /// The mean curvature at each vertex, in 1 / scene unit: positive where the surface bulges.
    MeanCurvature,
    /// The Gaussian curvature at each vertex, in 1 / scene unit²: negative at saddles.
    GaussianCurvature,
    /// An attribute: of vertices, else of faces, else of corners, else of edges.
    Attribute {
        /// Its name.
        name: String,
        /// Which of its components, from 0; the length of a vector if this is left out.
        #[serde(default)]
        #[schemars(range(max = 3))]
        component: Option<u32>,
    },
    /// How far each vertex is from the nearest point of the meshes of a file, seen from the recipe's folder; in
    /// scene units.
    DistanceTo(String),
}

/// The numbers of a scene.
pub struct Numbers {
    /// Those of each mesh.
    pub colorings: Vec<Coloring>,
    pub(crate) shown: Shown,
}

/// What the colors of numbers mean.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Shown {
    title: String,
    map: ColorMap,
    /// The numbers of the first and the last color.
    pub(crate) range: [f64; 2],
    /// The numbers that there are, if each has a color of its own.
    classes: Vec<f64>,
    /// Whether the picture says it.
    legend: bool,
}

impl ColorBy {
    /// Numbers alone, in colors that suit them.
    pub fn new(of: Quantity) -> Self {
        Self {
            of,
            map: None,
            range: None,
            legend: true,
        }
    }

    /// The numbers of all meshes of a scene, all in one range. `others` are the meshes that [`Quantity::DistanceTo`]
    /// measures to.
    ///
    /// # Errors
    ///
    /// [`PictureError::Style`] if no mesh has these numbers.
    pub fn numbers(&self, scene: &Scene, others: &[Mesh]) -> Result<Numbers, PictureError> {
        let mut found = Vec::new();
        for object in scene.objects() {
            if let Some(mesh) = object.as_mesh() {
                let values = self.of.values(mesh, others);
                found.extend(values.map(|(domain, values)| (&object.name, domain, values)));
            }
        }
        if found.is_empty() {
            let meshes = scene.objects().iter().filter_map(|o| o.as_mesh());
            let names = meshes.flat_map(|m| m.attributes().iter().map(|(_, c)| c.name.as_str()));
            let message = match &self.of {
                Quantity::Attribute { name, .. } => {
                    format!("{}: {}", no_attribute(name), there_are(names.collect()))
                }
                _ => "there is no mesh here whose numbers could be shown".to_owned(),
            };
            return Err(PictureError::Style(message));
        }
        let map = self.map.unwrap_or_else(|| self.of.map());
        let all = found.iter().flat_map(|(_, _, values)| values).copied();
        let range = self.range.unwrap_or_else(|| self.of.range(all.collect()));
        let colorings = found.into_iter().map(|(object, domain, values)| Coloring {
            object: object.clone(),
            domain,
            values,
            map,
            range,
        });
        let colorings: Vec<Coloring> = colorings.collect();
        let mut shown = Shown {
            title: self.of.title(),
            map,
            range,
            classes: Vec::new(),
            legend: self.legend,
        };
        if map == ColorMap::Classes {
            let values = colorings.iter().flat_map(|coloring| &coloring.values);
            shown
                .classes
                .extend(values.filter(|x| x.is_finite()).map(|x| x.floor()));
            shown.sort_classes();
        }
        Ok(Numbers { colorings, shown })
    }
}

/// What is wrong if no mesh has an attribute of this name.
pub fn no_attribute(name: &str) -> String {
    format!("no mesh has an attribute \"{name}\" here")
}

/// Which attributes there are instead.
pub fn there_are(mut names: Vec<&str>) -> String {
    names.sort_unstable();
    names.dedup();
    if names.is_empty() {
        return "there are none".to_owned();
    }
    let names: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).collect();
    format!("there are {}", names.join(", "))
}

impl Quantity {
    /// One number for each element, by its place, not a number where there is none; `None` if the mesh does
    /// not have this.
    fn values(&self, mesh: &Mesh, others: &[Mesh]) -> Option<(Domain, Vec<f64>)> {
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
            Self::SmallestAngle => faces(&|f| {
                let angles = mesh.face_half_edges(f).map(|h| mesh.corner_angle(h));
                angles
                    .fold(f64::INFINITY, |least, a| if a < least { a } else { least })
                    .to_degrees()
            }),
            Self::Area => faces(&|f| mesh.face_area(f)),
            Self::DihedralAngle => each(Domain::Edge, &|i| {
                let e = EdgeId::new(i);
                let angle = mesh.has_edge(e).then(|| mesh.dihedral_angle(e)).flatten();
                angle.map(f64::to_degrees)
            }),
            Self::MeanCurvature => (Domain::Vertex, geometry::mean_curvatures(mesh)),
            Self::GaussianCurvature => (Domain::Vertex, geometry::gaussian_curvatures(mesh)),
            Self::Attribute { name, component } => attribute(mesh, name, *component)?,
            Self::DistanceTo(_) => {
                let mut least = vec![f64::NAN; mesh.domain_len(Domain::Vertex)];
                for other in others {
                    let distances = distance::vertex_distances(mesh, other)?;
                    for (least, d) in least.iter_mut().zip(distances) {
                        if least.is_nan() || d < *least {
                            *least = d;
                        }
                    }
                }
                (Domain::Vertex, least)
            }
        })
    }

    /// The colors that suit it.
    fn map(&self) -> ColorMap {
        match self {
            Self::Valence => ColorMap::Classes,
            Self::MeanCurvature | Self::GaussianCurvature => ColorMap::Diverging,
            _ => ColorMap::Viridis,
        }
    }

    /// The numbers of the first and the last color, for these values.
    fn range(&self, mut values: Vec<f64>) -> [f64; 2] {
        values.retain(|x| x.is_finite());
        values.sort_unstable_by(f64::total_cmp);
        let (Some(&low), Some(&high)) = (values.first(), values.last()) else {
            return [0.0, 1.0];
        };
        match self {
            Self::SmallestAngle => [0.0, if high > 60.0 { 90.0 } else { 60.0 }],
            Self::DihedralAngle => [0.0, if high > 90.0 { 180.0 } else { 90.0 }],
            Self::DistanceTo(_) => [0.0, high],
            // The middle of the colors is 0; a few corners must not leave the rest without color.
            Self::MeanCurvature | Self::GaussianCurvature => {
                let cut = values.len() / 50;
                let (low, high) = (values[cut], values[values.len() - 1 - cut]);
                let most = low.abs().max(high.abs());
                [-most, most]
            }
            _ => [low, high],
        }
    }

    fn title(&self) -> String {
        match self {
            Self::Valence => "valence".to_owned(),
            Self::SmallestAngle => "smallest angle [°]".to_owned(),
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

/// The values of the first attribute of this name.
fn attribute(mesh: &Mesh, name: &str, component: Option<u32>) -> Option<(Domain, Vec<f64>)> {
    let domains = [Domain::Vertex, Domain::Face, Domain::Corner, Domain::Edge];
    let mut columns = domains.into_iter().filter_map(|domain| {
        let column = mesh.attributes().column(domain, name)?;
        Some((domain, &column.values))
    });
    let (domain, values) = columns.next()?;
    let of = |parts: &[f64]| match component {
        Some(i) => parts.get(i as usize).copied().unwrap_or(f64::NAN),
        None if parts.len() == 1 => parts[0],
        None => parts.iter().map(|x| x * x).sum::<f64>().sqrt(),
    };
    let values = match values {
        Values::Float(list) => list.iter().map(|&x| of(&[x])).collect(),
        Values::Vec2(list) => list.iter().map(|v| of(&v.to_array())).collect(),
        Values::Vec3(list) => list.iter().map(|v| of(&v.to_array())).collect(),
        Values::Vec4(list) => list.iter().map(|v| of(&v.to_array())).collect(),
        Values::Int(list) => list.iter().map(|&i| of(&[i.into()])).collect(),
        Values::Tag(list) => list.iter().map(|&t| of(&[u8::from(t).into()])).collect(),
    };
    Some((domain, values))
}

impl Shown {
    /// Takes what is shown of another scene in, too.
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

    /// What the colors mean, if the picture says it.
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
