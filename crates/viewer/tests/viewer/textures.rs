//! Compares pictures of textured surfaces: one drawn by the graphics card, the other by the crate `render` without a
//! graphics card.

use geometry::shapes;
use mesh::{DVec2, Mesh};
use render::{Image, Shading};
use scene::{AlphaMode, Filter, Material, Object, Scene, Texture, TextureTransform, Wrap};
use viewer::gpu::{Look, Overlay};

use crate::adapter::device;
use crate::drawing::{Stage, assert_near, bare, keep};

fn plain() -> Look {
    Look {
        shading: Shading::Plain,
        ..bare()
    }
}

/// Encodes an image of 6 x 4 fields with different colors. Each field has 8 x 8 pixels. Every second field has the
/// given alpha.
fn fields(alpha: u8) -> Vec<u8> {
    let color = |i: u32| {
        let [x, y] = [i % 48 / 8, i / 48 / 8];
        let [r, g] = [x * 40, y * 60].map(|c| u8::try_from(c).unwrap());
        [r, g, 90, if (x + y) % 2 == 0 { 255 } else { alpha }]
    };
    let image = Image {
        width: 48,
        height: 32,
        pixels: (0..48 * 32).map(color).collect(),
    };
    image.to_png(&[]).unwrap()
}

fn material(alpha: u8) -> Material {
    let mut texture = Texture::new(scene::Image::Embedded {
        mime: "image/png".to_owned(),
        bytes: fields(alpha).into(),
    });
    texture.sampler.magnify = Some(Filter::Nearest);
    Material {
        base_color_texture: Some(texture),
        double_sided: true,
        ..Material::new("fields")
    }
}

/// Returns a scene with the unit square, whose texture coordinates reach from `min` to `max`.
fn square(material: Material, [min, max]: [f64; 2]) -> Scene {
    let mut mesh: Mesh = shapes::square();
    let uv = |h| DVec2::splat(min) + (max - min) * mesh.position(mesh.origin(h)).truncate();
    let uvs: Vec<DVec2> = mesh.half_edges().map(uv).collect();
    mesh.set(mesh::UV, uvs);
    mesh.set(mesh::MATERIAL, vec![0; mesh.n_faces()]);
    let mut scene = Scene::new();
    let object = Object {
        materials: vec![material],
        ..Object::mesh("a", mesh)
    };
    scene.insert(object).unwrap();
    scene
}

#[test]
fn textures_have_the_colors_of_the_renderer_without_a_graphics_card() {
    let Some(state) = device() else { return };
    let moved = TextureTransform {
        offset: [0.2, 0.1],
        rotation: 0.5,
        scale: [1.5, 0.7],
    };
    for (i, (wrap, transform, range)) in [
        (Wrap::Repeat, TextureTransform::default(), [0.0, 1.0]),
        (Wrap::Repeat, TextureTransform::default(), [-1.2, 1.7]),
        (Wrap::Mirror, moved, [-1.2, 1.7]),
        (Wrap::Clamp, moved, [-0.5, 1.5]),
    ]
    .into_iter()
    .enumerate()
    {
        let mut material = material(255);
        let texture = material.base_color_texture.as_mut().unwrap();
        texture.sampler.wrap = [wrap; 2];
        texture.transform = transform;
        let scene = square(material, range);
        let mut stage = Stage::new(&state, &scene, &plain());
        let found = stage.draw(&plain(), &Overlay::default());
        keep(&format!("texture-{i}"), &found);
        assert_near(&found, &stage.expected(&scene, Shading::Plain), 95);
    }
}

#[test]
fn surfaces_are_invisible_where_their_texture_is_cut_out() {
    let Some(state) = device() else { return };
    for alpha in [AlphaMode::Mask(0.5), AlphaMode::Blend] {
        let cut = Material {
            alpha,
            ..material(0)
        };
        let scene = square(cut, [0.0, 1.0]);
        let mut stage = Stage::new(&state, &scene, &plain());
        let found = stage.draw(&plain(), &Overlay::default());
        keep(&format!("cut-{alpha:?}"), &found);
        let expected = stage.expected(&scene, Shading::Plain);
        assert!(found.pixels.iter().all(|p| p[3] == 255));
        assert_near(&found, &expected, 95);
        let opaque = square(material(0), [0.0, 1.0]);
        let mut stage = Stage::new(&state, &opaque, &plain());
        let opaque = stage.draw(&plain(), &Overlay::default());
        // Half of the 24 fields of the texture are transparent, so about half of the pixels of the square are cut out.
        let differs = |(p, q): &(&[u8; 4], &[u8; 4])| p != q;
        let n_cut = found
            .pixels
            .iter()
            .zip(&opaque.pixels)
            .filter(differs)
            .count();
        let n_kept = expected.pixels.iter().filter(|p| p[3] == 255).count();
        assert!(
            n_cut * 10 > n_kept * 9 && n_cut * 10 < n_kept * 12,
            "{n_cut} {n_kept}"
        );
    }
}

#[test]
fn surfaces_emit_light() {
    let Some(state) = device() else { return };
    let glowing = Material {
        emissive: [0.2, 0.0, 0.1],
        ..material(255)
    };
    let scene = square(glowing, [0.0, 1.0]);
    let look = Look {
        shading: Shading::Phong,
        ..bare()
    };
    let mut stage = Stage::new(&state, &scene, &look);
    let found = stage.draw(&look, &Overlay::default());
    assert_near(&found, &stage.expected(&scene, Shading::Phong), 95);
}
