//! A picture of places that an error is about: the whole scene and where in it they are, and the first one from
//! near.

use std::collections::{HashMap, HashSet};

use glam::DVec3;
use mesh::{FaceId, Mesh};
use progress::Progress;
use render::{
    Camera, Color, Elements, Highlight, Image, Label, Lines, Overlays, PictureError, Projection,
    Side, Stroke, Style, Up, extent,
};
use scene::{ErrorLocation, Scene};

use crate::sheet::{Cell, SheetStyle, sheet};
use crate::shot::{Shot, Subject};
use crate::sight;

/// The size of each of the two views, in pixels.
const SIZE: [u32; 2] = [720, 540];
/// Surfaces, so that marks stand out.
const SURFACE: Color = Color::rgb(0xcf, 0xd8, 0xe3);
/// What is wrong.
const WRONG: Color = Color::rgb(0xd6, 0x20, 0x28);
/// Where something should be.
const RIGHT: Color = Color::rgb(0x1b, 0x8e, 0x3d);
/// Around marks.
const HALO: Color = Color([255, 255, 255, 220]);
/// Of marks behind a surface so much is seen.
const HIDDEN: f64 = 0.4;
/// So many places get a dot in the whole scene, and so many their names from near.
const MOST_DOTS: usize = 200;
const MOST_NAMES: usize = 24;
/// Meshes of more faces are shown without their edges, which would cover the picture.
const MOST_EDGED: usize = 5_000;
/// Half of the angle of the camera, as a tangent: that of 25 degrees.
const TANGENT: f64 = 0.221_694_662_642_939_43;

/// Draws a scene and, in a strong color, places in it: on the left everything, on the right the first place from
/// near, with the names of elements. Without places only the scene. `caption` stands below. `None` if there is nothing
/// to see.
///
/// # Errors
///
/// As [`Shot::draw`].
pub fn draw_places(
    scene: &Scene,
    places: &[ErrorLocation],
    caption: &str,
    budget: u64,
    progress: &dyn Progress,
) -> Result<Option<Image>, PictureError> {
    let Some((center, radius)) = extent(scene) else {
        return Ok(None);
    };
    let around = Around::of(scene, places);
    let focus = places.first().map(|first| {
        let (middle, size) = sphere(&first.points);
        let size = size.max(1.2 * around.side).max(0.01 * radius);
        // Not from farther away than the whole.
        let seen = (1.6 * size).min(radius);
        (
            middle,
            seen.max(1e-6 * middle.abs().max_element()) / TANGENT,
        )
    });
    // No camera is that far away.
    let focus = focus.filter(|(_, distance)| (distance * distance).is_finite());
    let mut direction = direction(around.normal, places, center);
    if let (Some(first), Some((middle, distance))) = (places.first(), focus) {
        let place = sight::Place {
            points: &first.points,
            middle,
            normal: around.normal,
        };
        direction = sight::clear(scene, &place, direction, distance);
    }
    let (azimuth, elevation) = angles(direction);

    let one = |camera, has_edges, overlays| {
        let style = style(has_edges);
        let shot = Shot {
            size: SIZE,
            cameras: &[camera],
            columns: None,
            style: &style,
            frames: 1,
            budget,
        };
        let (subject, _) = Subject::new(scene, "", &style, overlays, None, &mut |_| None)?;
        let mut images = shot.draw(&[subject], None, progress)?;
        Ok::<_, PictureError>(images.remove(0))
    };
    let whole = Camera::Fit {
        from: Side::Angles { azimuth, elevation },
        up: Up::default(),
        projection: Projection::default(),
        margin: 0.05,
        steady: false,
    };
    // What is too small to be found gets a dot.
    let dots = (places.len() <= MOST_DOTS).then_some(0.05 * radius);
    let overlays = marks(places, &around, [4.0, 14.0], dots);
    let left = one(whole, around.n_faces <= MOST_EDGED, overlays)?;
    let mut images = vec![(left, caption.to_owned())];
    if let Some((middle, distance)) = focus {
        let near = Camera::LookAt {
            from: (middle + direction * distance).into(),
            to: middle.into(),
            up: Up::default(),
            projection: Projection::default(),
        };
        let mut overlays = marks(places, &around, [6.0, 16.0], None);
        overlays.labels = labels(places, beside(direction, distance));
        let right = one(near, true, overlays)?;
        images.push((right, names(places)));
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

/// A surface that marks stand out of.
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

/// What lies around places.
#[derive(Default)]
struct Around {
    /// The faces of the scene.
    n_faces: usize,
    /// The sum of the area vectors of the faces around the first place.
    normal: DVec3,
    /// The mean length of their sides.
    side: f64,
    /// The faces that are places, by object.
    faces: Vec<(String, Vec<FaceId>)>,
}

impl Around {
    fn of(scene: &Scene, places: &[ErrorLocation]) -> Self {
        let mut around = Self::default();
        let mut begin: HashMap<[u64; 3], Vec<&ErrorLocation>> = HashMap::new();
        for place in places {
            if let [first, _, _, ..] = place.points[..] {
                begin.entry(bits(first)).or_default().push(place);
            }
        }
        let points = places.first().map_or(&[][..], |first| &first.points);
        let points: HashSet<[u64; 3]> = points.iter().map(|&p| bits(p)).collect();
        let (mut sides, mut n_sides) = (0.0, 0_u32);
        for object in scene.objects() {
            let Some(mesh) = object.as_mesh() else {
                continue;
            };
            around.n_faces += mesh.n_faces();
            let is_meant =
                |place: &&ErrorLocation| place.object.is_empty() || place.object == object.name;
            let first = places.first().filter(is_meant).map(|_| &points);
            let mut faces = Vec::new();
            for f in mesh.faces() {
                let corners = || mesh.face_vertices(f).map(|v| mesh.position(v));
                if first.is_some_and(|first| corners().any(|p| first.contains(&bits(p)))) {
                    around.normal += mesh.area_vector(f);
                    for h in mesh.face_half_edges(f) {
                        sides += mesh.length(h);
                        n_sides += 1;
                    }
                }
                if !begin.is_empty() && is_among(mesh, f, &begin, is_meant) {
                    faces.push(f);
                }
            }
            if !faces.is_empty() {
                around.faces.push((object.name.clone(), faces));
            }
        }
        around.side = sides / f64::from(n_sides.max(1));
        around
    }
}

/// Whether a face is one of the places, which are found by their first points.
fn is_among(
    mesh: &Mesh,
    f: FaceId,
    begin: &HashMap<[u64; 3], Vec<&ErrorLocation>>,
    is_meant: impl Fn(&&ErrorLocation) -> bool,
) -> bool {
    mesh.face_half_edges(f).any(|first| {
        let places = begin.get(&bits(mesh.position(mesh.origin(first))));
        let mut places = places.into_iter().flatten().filter(|p| is_meant(p));
        places.any(|place| {
            let around = std::iter::successors(Some(first), |&h| Some(mesh.next(h)));
            let points = around.map(|h| mesh.position(mesh.origin(h)));
            let n = mesh.degree(f);
            place.points.len() == n && points.take(n).eq(place.points.iter().copied())
        })
    })
}

pub(crate) fn bits(p: DVec3) -> [u64; 3] {
    // Both zeros are one place.
    (p + DVec3::ZERO).to_array().map(f64::to_bits)
}

/// The direction to look from: on the surface, somewhat aside.
fn direction(normal: DVec3, places: &[ErrorLocation], center: DVec3) -> DVec3 {
    let aside = DVec3::new(0.5, 0.4, 1.0).normalize();
    let middle = places
        .first()
        .map_or(center, |first| sphere(&first.points).0);
    let direction = normal.normalize_or((middle - center).normalize_or_zero());
    let towards = (direction + 0.45 * aside).normalize_or(aside);
    // Not from straight above: which way is up would turn over.
    let (azimuth, elevation) = angles(towards);
    let (sin, cos) = geometry::sin_cos_degrees(azimuth);
    let (up, along) = geometry::sin_cos_degrees(elevation.clamp(-75.0, 75.0));
    DVec3::new(sin * along, up, cos * along)
}

/// Degrees from the front towards the right, and upwards.
fn angles(direction: DVec3) -> (f64, f64) {
    let azimuth = libm::atan2(direction.x, direction.z).to_degrees();
    let elevation = libm::asin(direction.y.clamp(-1.0, 1.0)).to_degrees();
    (azimuth, elevation)
}

/// The places in a strong color: lines and dots of these sizes in pixels; a dot too on what is smaller than `dots`.
fn marks(
    places: &[ErrorLocation],
    around: &Around,
    [width, dot]: [f64; 2],
    dots: Option<f64>,
) -> Overlays {
    let mut overlays = Overlays::default();
    for (object, faces) in &around.faces {
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
    for place in places {
        let is_expected = place.name == ErrorLocation::EXPECTED;
        let color = if is_expected { RIGHT } else { WRONG };
        let mut points = place.points.clone();
        let (middle, size) = sphere(&points);
        if points.len() > 2 {
            points.push(points[0]);
        }
        if points.len() > 1 && dots.is_some_and(|below| size < below) {
            stroke(vec![middle], color, dot);
        }
        let width = if points.len() == 1 { dot } else { width };
        stroke(points, color, width);
    }
    overlays.strokes.extend(strokes);
    overlays
}

/// From a mark to its name, to its right and above it and nearer to the camera, if that is so far away.
fn beside(direction: DVec3, distance: f64) -> DVec3 {
    let pixel = 2.0 * TANGENT * distance / f64::from(SIZE[1]);
    let right = DVec3::Y.cross(direction).normalize();
    let up = direction.cross(right);
    pixel * (22.0 * right + 18.0 * up + 30.0 * direction)
}

/// The names of the first places.
fn labels(places: &[ErrorLocation], beside: DVec3) -> Vec<Label> {
    let named = places.iter().filter(|place| !place.name.is_empty());
    // Names of faces stand in them, others beside a dot or a line.
    let label = |place: &ErrorLocation| {
        let is_face = place.points.len() > 2;
        let aside = if is_face { DVec3::ZERO } else { beside };
        Label {
            at: sphere(&place.points).0 + aside,
            text: place.name.clone(),
        }
    };
    named.take(MOST_NAMES).map(label).collect()
}

/// The names of the first places, and how many more there are.
fn names(places: &[ErrorLocation]) -> String {
    const SHOWN: usize = 8;
    let names = places.iter().map(|p| p.name.as_str());
    let names: Vec<&str> = names.filter(|n| !n.is_empty()).collect();
    let mut text = names[..names.len().min(SHOWN)].join(", ");
    if names.len() > SHOWN {
        text += &format!(" and {} more", names.len() - SHOWN);
    }
    text
}

/// The middle of a box around points, and the distance of the farthest from it.
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
