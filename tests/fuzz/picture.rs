//! Draws arbitrary meshes with arbitrary cameras and styles. Either the picture has the requested size, or drawing is
//! refused.

#![no_main]

mod any_mesh;

use libfuzzer_sys::fuzz_target;
use render::{Camera, Ids, Lines, Overlays, Projection, Shading, Side, Style, Up, picture};
use scene::{Object, Scene};

use any_mesh::take;

fuzz_target!(|bytes: &[u8]| {
    let mut bytes = bytes;
    let flags = take(&mut bytes);
    let mut number = || f64::from(take(&mut bytes).cast_signed());
    let camera = if flags & 1 == 0 {
        Camera::Fit {
            from: Side::Angles { azimuth: 3.0 * number(), elevation: number() },
            up: [Up::Y, Up::Z, Up::Auto][usize::from(flags >> 6).min(2)],
            projection: if flags & 2 == 0 {
                Projection::Orthographic
            } else {
                Projection::Perspective { angle: number().abs() + 1.0 }
            },
            margin: number().abs() / 300.0,
            steady: flags & 4 != 0,
        }
    } else {
        Camera::LookAt {
            from: [number(), number(), number()],
            to: [number(), number(), number()],
            up: Up::Y,
            projection: Projection::default(),
        }
    };
    let shadings = [Shading::Flat, Shading::Smooth, Shading::Phong, Shading::Matcap];
    let lines = (flags & 8 != 0).then(|| Lines { width: number().abs() / 8.0, ..Lines::default() });
    let style = Style {
        shading: shadings[usize::from(flags >> 4 & 3)],
        wireframe: lines,
        boundary: lines,
        normals: lines.map(|_| 0.1),
        ids: (flags & 16 != 0).then_some(Ids::Vertices),
        ..Style::default()
    };
    let size = [take(&mut bytes), take(&mut bytes)].map(|side| u32::from(side % 40));
    let Some(mesh) = any_mesh::mesh(&mut bytes) else {
        return;
    };
    let mut scene = Scene::new();
    scene.insert(Object::mesh("a", mesh)).expect("the scene is empty");
    let drawn = picture(&scene, &camera, &style, &Overlays::default(), size, 1 << 26, &mut |_| None);
    if let Ok((drawn, _)) = drawn {
        assert_eq!([drawn.image.width, drawn.image.height], size);
    }
});
