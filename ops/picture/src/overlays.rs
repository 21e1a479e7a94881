//! What is shown beside the surfaces: marked elements, and numbers as colors.

use op::{Context, OpError, Selected};
use render::{Color, Highlight, Overlays};
use scene::Scene;

use crate::numbers::Numbers;
use crate::{Picture, orange};

/// The width of marked edges and the diameter of marked vertices, in pixels of a picture that is 960 high.
const EDGES: f64 = 4.0;
const VERTICES: f64 = 13.0;

/// How much of marked edges and vertices is seen through a surface.
const HIDDEN: f64 = 0.25;

pub(crate) fn of(
    picture: &Picture,
    scene: &Scene,
    numbers: Option<&Numbers>,
    cx: &mut Context,
) -> Result<Overlays, OpError> {
    let mut overlays = Overlays {
        colorings: numbers.map(|n| n.colorings.clone()).unwrap_or_default(),
        ..Overlays::default()
    };
    let scale = (f64::from(picture.size[1]) / 960.0).clamp(0.4, 8.0);
    let first = picture.highlight.iter().map(|of| (of, orange(), None));
    let marks = picture.marks.iter().map(|m| (&m.of, m.color, m.width));
    for (of, color, width) in first.chain(marks) {
        for object in scene.objects() {
            let Some(mesh) = object.as_mesh() else {
                continue;
            };
            cx.materials = object.materials.iter().map(|m| m.name.clone()).collect();
            let selected = of.resolve(mesh, cx);
            cx.materials.clear();
            let marked = highlight(&object.name, selected?, color, width, scale);
            overlays.highlights.push(marked);
        }
    }
    Ok(overlays)
}

/// What is said where nothing can be marked.
pub(crate) fn unmarked(picture: &Picture, scene: &Scene) -> Option<String> {
    let has_marks = picture.highlight.is_some() || !picture.marks.is_empty();
    let has_mesh = scene.objects().iter().any(|o| o.as_mesh().is_some());
    (has_marks && !has_mesh && !scene.objects().is_empty()).then(|| {
        "nothing is marked: elements of meshes can be, and there is no mesh here; `style: (points: 8)` \
         shows the points of polylines, and `style: (control_nets: ())` control points"
            .to_owned()
    })
}

fn highlight(
    object: &str,
    selected: Selected,
    color: Color,
    width: Option<f64>,
    scale: f64,
) -> Highlight {
    let (elements, usual) = match selected {
        Selected::Vertices(list) => (render::Elements::Vertices(list), VERTICES),
        Selected::Edges(list) => (render::Elements::Edges(list), EDGES),
        Selected::Faces(list) => (render::Elements::Faces(list), 0.0),
    };
    Highlight {
        object: object.to_owned(),
        elements,
        color,
        size: width.unwrap_or(usual * scale),
        hidden: HIDDEN,
    }
}
