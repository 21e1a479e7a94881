//! Shows where the errors of a scene are: draws an overview of the objects with errors, and a close-up of the first
//! error location.

use std::collections::{HashMap, HashSet};

use glam::DVec3;
use mesh::{FaceId, Mesh};
use progress::Progress;
use render::{
    Camera, Color, Elements, Highlight, Image, Label, Lines, Overlays, PictureError, Projection,
    Side, Stroke, Style, Up, extent,
};
use scene::{ErrorLocation, Scene};

use crate::position_bits::bits;
use crate::sheet::{Cell, SheetStyle, sheet};
use crate::shot::{Shot, Subject};
use crate::viewpoint::{Target, clear_direction};

/// The size of each of the two views, in pixels.
const SIZE: [u32; 2] = [720, 540];
/// The color of surfaces: a pale color on which marks are visible.
const SURFACE: Color = Color::rgb(0xcf, 0xd8, 0xe3);
/// The color of the locations of errors.
const ERROR: Color = Color::rgb(0xd6, 0x20, 0x28);
/// The color of the expected positions of missing elements.
const EXPECTED: Color = Color::rgb(0x1b, 0x8e, 0x3d);
/// The color of the border around marks.
const HALO: Color = Color([255, 255, 255, 220]);
/// The opacity of marks where a surface hides them.
const HIDDEN: f64 = 0.4;
/// The overview marks a location with a dot if the location is too small to see. If there are more locations than this
/// maximum, the overview has no dots.
const MAX_DOTTED: usize = 200;
/// The maximum number of names in the close-up.
const MAX_NAMES: usize = 24;
/// The maximum number of faces in a scene for which the overview draws edges. In scenes with more faces, the edges would
/// cover the surface.
const MAX_FACES_WITH_EDGES: usize = 5_000;
/// The tangent of half of 25 degrees, the default field of view.
const TANGENT: f64 = 0.221_694_662_642_939_43;

/// Draws a scene with the locations of errors in a strong color.
///
/// The left view shows all objects that contain a location of an error. If the object of a location is unknown, the
/// left view shows the whole scene. The right view is a close-up of the first location, with the names of elements. If
/// `locations` is empty, or the first location is so far away that distances overflow, there is only the left view.
/// `caption` is written below the left view. Returns `None` if the scene is empty.
///
/// # Errors
///
/// Returns [`PictureError::Budget`] if the instances of the scene need more than `budget` bytes. Also returns the
/// errors of [`Shot::draw`].
pub fn draw_error_locations(
    scene: &Scene,
    locations: &[ErrorLocation],
    caption: &str,
    budget: u64,
    progress: &dyn Progress,
) -> Result<Option<Image>, PictureError> {
    let bytes = scene.placed_bytes();
    if !scene.graph().is_empty() && bytes > budget {
        return Err(PictureError::Budget {
            needed: bytes,
            budget,
        });
    }
    let locations = &placed(scene, locations);
    let scene = &objects_with_errors(scene.placed().into_owned(), locations);
    let Some((center, radius)) = extent(scene) else {
        return Ok(None);
    };
    let surroundings = Surroundings::new(scene, locations);
    let focus = locations.first().map(|first| {
        let (middle, size) = sphere(&first.points);
        let size = size
            .max(1.2 * surroundings.mean_edge_length)
            .max(0.01 * radius);
        // The radius of the area that the close-up shows is at most the radius of the scene.
        let visible = (1.6 * size).min(radius);
        (
            middle,
            visible.max(1e-6 * middle.abs().max_element()) / TANGENT,
        )
    });
    // If the squared distance of the camera overflows, there is no close-up.
    let focus = focus.filter(|(_, distance)| (distance * distance).is_finite());
    let mut direction = preferred_direction(surroundings.normal, locations, center);
    if let (Some(first), Some((middle, distance))) = (locations.first(), focus) {
        let target = Target {
            points: &first.points,
            middle,
            normal: surroundings.normal,
        };
        direction = clear_direction(scene, &target, direction, distance);
    }
    let (azimuth, elevation) = angles(direction);

    let draw = |camera, has_edges, overlays| {
        let style = style(has_edges);
        let shot = Shot {
            size: SIZE,
            cameras: &[camera],
            columns: None,
            style: &style,
            frames: 1,
            budget,
        };
        let (subject, _) = Subject::new(scene, "", &style, overlays, None, budget, &mut |_| None)?;
        let mut images = shot.draw(&[subject], None, progress)?;
        Ok::<_, PictureError>(images.remove(0))
    };
    let overview = Camera::Fit {
        from: Side::Angles { azimuth, elevation },
        up: Up::default(),
        projection: Projection::default(),
        margin: 0.05,
        steady: false,
    };
    // Dots mark the locations that are too small to see.
    let dot_limit = (locations.len() <= MAX_DOTTED).then_some(0.05 * radius);
    let overlays = marks(locations, &surroundings, [4.0, 14.0], dot_limit);
    let has_edges = surroundings.n_faces <= MAX_FACES_WITH_EDGES;
    let left = draw(overview, has_edges, overlays)?;
    let mut images = vec![(left, caption.to_owned())];
    if let Some((middle, distance)) = focus {
        let close_up = Camera::LookAt {
            from: (middle + direction * distance).into(),
            to: middle.into(),
            up: Up::default(),
            projection: Projection::default(),
        };
        let mut overlays = marks(locations, &surroundings, [6.0, 16.0], None);
        overlays.labels = labels(locations, label_offset(direction, distance));
        let right = draw(close_up, true, overlays)?;
        images.push((right, names(locations)));
    }
    let cells: Vec<Cell> = (images.iter())
        .map(|(image, caption)| Cell { image, caption })
        .collect();
    let style = SheetStyle {
        columns: 2,
        ..SheetStyle::default()
    };
    sheet(&cells, &style, budget).map(Some)
}

/// Returns a scene with only the objects that contain error locations, because other objects could hide these
/// locations. Returns the whole scene if the object of a location is unknown.
fn objects_with_errors(scene: Scene, locations: &[ErrorLocation]) -> Scene {
    let names: HashSet<&str> = locations.iter().map(|location| &*location.object).collect();
    let objects = scene.objects().iter();
    let others = objects.filter(|object| !names.contains(&*object.name));
    let others: Vec<String> = others.map(|object| object.name.clone()).collect();
    if names.contains("") || others.len() == scene.objects().len() {
        return scene;
    }
    let mut scene = scene;
    for name in others {
        scene.remove(&name);
    }
    scene
}

/// Returns a style with pale surfaces, so that marks are visible on them.
fn style(has_edges: bool) -> Style {
    Style {
        color: Some(SURFACE),
        wireframe: has_edges.then(|| Lines {
            width: 1.0,
            ..Lines::default()
        }),
        ..Style::default()
    }
}

/// Properties of the scene and of its faces at the error locations.
#[derive(Default)]
struct Surroundings {
    /// The number of faces of the scene.
    n_faces: usize,
    /// The sum of the area vectors of the faces that touch the first location.
    normal: DVec3,
    /// The mean edge length of the faces that touch the first location.
    mean_edge_length: f64,
    /// For each object, the faces that are error locations.
    faces: Vec<(String, Vec<FaceId>)>,
}

/// Returns the locations in scene space. Each location is placed at the first instance of its object.
fn placed(scene: &Scene, locations: &[ErrorLocation]) -> Vec<ErrorLocation> {
    let mut placed = locations.to_vec();
    if scene.graph().is_empty() {
        return placed;
    }
    let instances = scene.instances();
    for location in &mut placed {
        let instance = instances.iter().find(|i| i.object.name == location.object);
        if let Some(instance) = instance {
            location.object.clone_from(&instance.name);
            for point in &mut location.points {
                *point = instance.to_scene.transform_point3(*point);
            }
        }
    }
    placed
}

impl Surroundings {
    fn new(scene: &Scene, locations: &[ErrorLocation]) -> Self {
        let mut surroundings = Self::default();
        // The error locations that are faces. The key in the map is the bit pattern of the first point of the face.
        let mut face_locations: HashMap<[u64; 3], Vec<&ErrorLocation>> = HashMap::new();
        for location in locations {
            if let [first, _, _, ..] = location.points[..] {
                face_locations
                    .entry(bits(first))
                    .or_default()
                    .push(location);
            }
        }
        let points = locations.first().map_or(&[][..], |first| &first.points);
        let points: HashSet<[u64; 3]> = points.iter().map(|&p| bits(p)).collect();
        let (mut length_sum, mut n_lengths) = (0.0, 0_u32);
        for object in scene.objects() {
            let Some(mesh) = object.as_mesh() else {
                continue;
            };
            surroundings.n_faces += mesh.n_faces();
            let is_in_object = |location: &&ErrorLocation| {
                location.object.is_empty() || location.object == object.name
            };
            let first = locations.first().filter(is_in_object).map(|_| &points);
            let mut faces = Vec::new();
            for f in mesh.faces() {
                let corners = || mesh.face_vertices(f).map(|v| mesh.position(v));
                if first.is_some_and(|first| corners().any(|p| first.contains(&bits(p)))) {
                    surroundings.normal += mesh.area_vector(f);
                    for h in mesh.face_half_edges(f) {
                        length_sum += mesh.length(h);
                        n_lengths += 1;
                    }
                }
                let is_location = || is_face_location(mesh, f, &face_locations, is_in_object);
                if !face_locations.is_empty() && is_location() {
                    faces.push(f);
                }
            }
            if !faces.is_empty() {
                surroundings.faces.push((object.name.clone(), faces));
            }
        }
        surroundings.mean_edge_length = length_sum / f64::from(n_lengths.max(1));
        surroundings
    }
}

/// Whether a face is one of the error locations. `face_locations` maps the first point of each location to the
/// location.
fn is_face_location(
    mesh: &Mesh,
    f: FaceId,
    face_locations: &HashMap<[u64; 3], Vec<&ErrorLocation>>,
    is_in_object: impl Fn(&&ErrorLocation) -> bool,
) -> bool {
    mesh.face_half_edges(f).any(|first| {
        let candidates = face_locations.get(&bits(mesh.position(mesh.origin(first))));
        let mut candidates = candidates
            .into_iter()
            .flatten()
            .filter(|location| is_in_object(location));
        candidates.any(|location| {
            let half_edges = std::iter::successors(Some(first), |&h| Some(mesh.next(h)));
            let points = half_edges.map(|h| mesh.position(mesh.origin(h)));
            let n = mesh.degree(f);
            location.points.len() == n && points.take(n).eq(location.points.iter().copied())
        })
    })
}

/// Returns the preferred direction from the first location to the camera. This direction is between the normal of the
/// surface and the direction of the default view.
fn preferred_direction(normal: DVec3, locations: &[ErrorLocation], center: DVec3) -> DVec3 {
    let default = DVec3::new(0.5, 0.4, 1.0).normalize();
    let middle = locations
        .first()
        .map_or(center, |first| sphere(&first.points).0);
    let outward = normal.normalize_or((middle - center).normalize_or_zero());
    let direction = (outward + 0.45 * default).normalize_or(default);
    // The elevation is limited to 75 degrees. If the camera looked almost straight down, the upward direction of the
    // picture would be unstable.
    let (azimuth, elevation) = angles(direction);
    let (sin, cos) = geometry::sin_cos_degrees(azimuth);
    let (up, horizontal) = geometry::sin_cos_degrees(elevation.clamp(-75.0, 75.0));
    DVec3::new(sin * horizontal, up, cos * horizontal)
}

/// Returns the azimuth and the elevation of a direction, in degrees.
fn angles(direction: DVec3) -> (f64, f64) {
    let azimuth = libm::atan2(direction.x, direction.z).to_degrees();
    let elevation = libm::asin(direction.y.clamp(-1.0, 1.0)).to_degrees();
    (azimuth, elevation)
}

/// Returns overlays that mark the locations: lines that are `width` pixels wide, dots with a diameter of `dot` pixels,
/// and colored faces. Locations that are smaller than `dot_limit`, in scene units, also get a dot.
fn marks(
    locations: &[ErrorLocation],
    surroundings: &Surroundings,
    [width, dot]: [f64; 2],
    dot_limit: Option<f64>,
) -> Overlays {
    let mut overlays = Overlays::default();
    for (object, faces) in &surroundings.faces {
        overlays.highlights.push(Highlight {
            object: object.clone(),
            elements: Elements::Faces(faces.clone()),
            color: Color::rgb(0xf2, 0x9a, 0x8e),
            size: 0.0,
            hidden: 0.0,
        });
    }
    let mut strokes = Vec::new();
    let mut stroke = |points: Vec<DVec3>, color: Color, width: f64| {
        overlays.strokes.push(Stroke {
            points: points.clone(),
            color: HALO,
            width: width + 4.0,
            hidden: HIDDEN,
        });
        strokes.push(Stroke {
            points,
            color,
            width,
            hidden: HIDDEN,
        });
    };
    for location in locations {
        let is_expected = location.name == ErrorLocation::EXPECTED;
        let color = if is_expected { EXPECTED } else { ERROR };
        let mut points = location.points.clone();
        let (middle, size) = sphere(&points);
        if points.len() > 2 {
            points.push(points[0]);
        }
        if points.len() > 1 && dot_limit.is_some_and(|limit| size < limit) {
            stroke(vec![middle], color, dot);
        }
        let width = if points.len() == 1 { dot } else { width };
        stroke(points, color, width);
    }
    overlays.strokes.extend(strokes);
    overlays
}

/// Returns the offset from a mark to its name, for a camera in this direction and at this distance. The name is to the
/// right of the mark, above the mark, and nearer to the camera than the mark.
fn label_offset(direction: DVec3, distance: f64) -> DVec3 {
    let pixel = 2.0 * TANGENT * distance / f64::from(SIZE[1]);
    let right = DVec3::Y.cross(direction).normalize();
    let up = direction.cross(right);
    pixel * (22.0 * right + 18.0 * up + 30.0 * direction)
}

/// Returns labels with the names of the first [`MAX_NAMES`] locations that have a name.
fn labels(locations: &[ErrorLocation], offset: DVec3) -> Vec<Label> {
    let named = locations
        .iter()
        .filter(|location| !location.name.is_empty());
    // The name of a face is in the middle of the face. The name of a vertex is beside its dot, and the name of an edge
    // is beside its line.
    let label = |location: &ErrorLocation| {
        let is_face = location.points.len() > 2;
        let offset = if is_face { DVec3::ZERO } else { offset };
        Label {
            at: sphere(&location.points).0 + offset,
            text: location.name.clone(),
        }
    };
    named.take(MAX_NAMES).map(label).collect()
}

/// Returns a text that lists the names of the first locations and says how many more names there are.
fn names(locations: &[ErrorLocation]) -> String {
    const MAX_LISTED: usize = 8;
    let names = locations.iter().map(|location| location.name.as_str());
    let names: Vec<&str> = names.filter(|n| !n.is_empty()).collect();
    let mut text = names[..names.len().min(MAX_LISTED)].join(", ");
    if names.len() > MAX_LISTED {
        text += &format!(" and {} more", names.len() - MAX_LISTED);
    }
    text
}

/// Returns the center of the bounding box of points, and the distance from the center to the farthest point.
fn sphere(points: &[DVec3]) -> (DVec3, f64) {
    let Some(&first) = points.first() else {
        return (DVec3::ZERO, 0.0);
    };
    let low = points.iter().fold(first, |a, &b| a.min(b));
    let high = points.iter().fold(first, |a, &b| a.max(b));
    let middle = 0.5 * low + 0.5 * high;
    let distances = points.iter().map(|p| p.distance(middle));
    (middle, distances.fold(0.0, f64::max))
}

#[cfg(test)]
mod tests;
