//! Renders pictures of scenes without a GPU.
//!
//! Everything is computed on the CPU, in parallel, and gives the same bytes on every machine and for any number of
//! threads. The crate depends on meshes, curves and scenes, but not on operations or recipes. The crate reads and
//! writes no files.
//!
//! ```text
//!   scene, style, overlays --build--> drawing --render--> image --to_png--> bytes
//!                                        camera --View::new--^
//! ```
//!
//! [`picture`] runs the stages `build`, `View::new` and `render` of this diagram, but not `to_png`. [`build()`]
//! converts a scene to a [`Drawing`] of triangles, lines and points. [`render`] finds the triangle that is visible at
//! each of 16 samples per pixel, and computes colors in linear light.
//!
//! [`figure`] draws in the plane: constructions of curves, legends and labels. [`animation`] encodes a sequence of
//! images.
//!
//! # Examples
//!
//! ```
//! use geometry::shapes;
//! use render::{Camera, Overlays, Style, picture};
//! use scene::{Object, Scene};
//!
//! let mut scene = Scene::new();
//! scene.insert(Object::mesh("ball", shapes::icosahedron())).unwrap();
//! let (picture, _) = picture(
//!     &scene,
//!     &Camera::default(),
//!     &Style::default(),
//!     &Overlays::default(),
//!     [64, 48],
//!     1 << 30,
//!     &mut |_| None,
//! )?;
//! assert_eq!(picture.image.pixels.len(), 64 * 48);
//! # Ok::<(), render::PictureError>(())
//! ```

#![forbid(unsafe_code)]

pub mod animation;
mod blend;
mod build;
mod camera;
mod color;
mod colormap;
mod difference;
mod drawing;
mod error;
pub mod figure;
mod heights;
mod image;
pub mod palette;
mod raster;
mod style;
mod texture;
mod work;

use progress::NoProgress;

pub use build::{
    Coloring, Elements, Highlight, Overlays, PALETTE, Stroke, build, build_within, extent,
};
pub use camera::{Camera, Projection, ScreenPoint, Side, Up, View};
pub use color::{Color, NAMES, ParseColorError, to_linear, to_srgb};
pub use colormap::ColorMap;
pub use difference::{compare, difference};
pub use drawing::{Channel, Drawing, Label, Line, NO_FACE, Part, Surface};
pub use error::PictureError;
pub use heights::Heights;
pub use image::{Image, LARGEST_SIDE, checked_size};
pub use raster::{PlacedLabel, Rendered, bytes_needed, pixel_bytes, render};
pub use style::{Background, Ids, Lines, Look, Shading, Style};
pub use texture::{Alpha, Texture, TextureCache};

/// Renders a picture of a scene. Returns the picture, and a message for each texture that cannot be drawn.
///
/// `size` is the width and height in pixels. Rendering uses at most about `budget` bytes of memory in addition to the
/// scene and its drawing. `images` is called with the path of an image file, as written in a material, and returns the
/// bytes of this file.
///
/// # Errors
///
/// Returns [`PictureError::Budget`] if the budget is too small for the pixels, for the drawing and its textures (see
/// [`build_within`]), or for rendering. The memory for the pixels is checked first. Also returns the errors of
/// [`build()`], [`View::new`] and [`render`].
pub fn picture(
    scene: &scene::Scene,
    camera: &Camera,
    style: &Style,
    overlays: &Overlays,
    size: [u32; 2],
    budget: u64,
    images: &mut dyn FnMut(&str) -> Option<Vec<u8>>,
) -> Result<(Rendered, Vec<String>), PictureError> {
    PictureError::check_budget(pixel_bytes(size), budget)?;
    let textures = &mut TextureCache::default();
    let (drawing, missing) = build_within(scene, style, overlays, budget, textures, images)?;
    let look = style.look();
    let view = View::new(camera, &|each| drawing.each_point(each), size)?;
    PictureError::check_budget(bytes_needed(&drawing, &view, size, &look), budget)?;
    let rendered = render(&drawing, &view, size, &look, &NoProgress)?;
    Ok((rendered, missing))
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use mesh::{Domain, FaceId};
    use scene::{Material, Object, Scene};

    fn scene(object: Object) -> Scene {
        let mut scene = Scene::new();
        scene.insert(object).unwrap();
        scene
    }

    fn draw(
        scene: &Scene,
        style: &Style,
        overlays: &Overlays,
        size: [u32; 2],
        budget: u64,
    ) -> Result<(Rendered, Vec<String>), PictureError> {
        picture(
            scene,
            &Camera::default(),
            style,
            overlays,
            size,
            budget,
            &mut |_| None,
        )
    }

    #[test]
    fn a_picture_that_needs_too_much_memory_is_refused_before_it_is_drawn() {
        let cube = scene(Object::mesh("a", shapes::cube()));
        let draw =
            |size, budget| draw(&cube, &Style::default(), &Overlays::default(), size, budget);
        let side = LARGEST_SIDE;
        // The pixels need 1 GiB, and the budget is half of that.
        let refused = draw([side, side], 1 << 29);
        assert!(matches!(refused, Err(PictureError::Budget { needed, .. }) if needed > 1 << 30));
        assert!(draw([100, 100], 1 << 29).is_ok());
        for size in [[0, 1], [side + 1, 1], [u32::MAX, u32::MAX]] {
            let refused = draw(size, u64::MAX);
            assert!(
                matches!(refused, Err(PictureError::Size { .. })),
                "{size:?}"
            );
        }
    }

    #[test]
    fn missing_images_are_named_and_the_rest_is_drawn() {
        let mut material = Material::new("wood");
        material.base_color_texture = Some(scene::Texture::file("wood.png"));
        let cube = scene(Object {
            materials: vec![material],
            ..Object::mesh("a", shapes::cube())
        });
        let (style, none) = (Style::default(), Overlays::default());
        let (picture, missing) = draw(&cube, &style, &none, [32, 32], 1 << 30).unwrap();
        assert_eq!(missing, ["wood.png: not found"]);
        assert!(picture.image.pixels.iter().any(|p| *p != [255; 4]));
    }

    #[test]
    fn meshes_without_texture_coordinates_for_their_textures_are_named() {
        let mut material = Material::new("wood");
        material.base_color_texture = Some(scene::Texture::file("wood.png"));
        let cube = scene(Object {
            materials: vec![material],
            ..Object::mesh("a", shapes::cube())
        });
        let wood = Image::filled(1, 1, [150, 90, 30, 255])
            .unwrap()
            .to_png(&[])
            .unwrap();
        let (style, none) = (Style::default(), Overlays::default());
        let mut images = |_: &str| Some(wood.clone());
        let (_, missing) = build(&cube, &style, &none, &mut images).unwrap();
        let message = "\"a\" has textures but no texture coordinates for them";
        assert_eq!(missing, [message]);
    }

    #[test]
    fn a_mesh_with_deleted_elements_is_drawn_like_its_compacted_copy() {
        let mut sparse = shapes::grid(5, 4);
        for i in [0, 1, 13] {
            sparse.delete_face(FaceId::new(i)).unwrap();
        }
        sparse.delete_isolated_vertices();
        let mut compact = sparse.clone();
        compact.compact();
        let style = Style {
            wireframe: Some(Lines::default()),
            points: Some(3.0),
            ..Style::default()
        };
        let picture = |mesh| {
            let scene = scene(Object::mesh("a", mesh));
            let (picture, _) =
                draw(&scene, &style, &Overlays::default(), [80, 60], 1 << 30).unwrap();
            picture.image
        };
        assert!(picture(sparse) == picture(compact));
    }

    #[test]
    fn styles_and_overlays_that_do_not_match_the_scene_are_refused() {
        let cube = scene(Object::mesh("a", shapes::cube()));
        let refused = |style: Style, overlays: Overlays| {
            let result = draw(&cube, &style, &overlays, [8, 8], 1 << 30);
            matches!(result, Err(PictureError::Style(_)))
        };
        let coloring = Coloring {
            object: "a".into(),
            domain: Domain::Vertex,
            values: vec![1.0; 7],
            map: ColorMap::default(),
            range: [0.0, 1.0],
        };
        let with_occlusion = |occlusion| Style {
            occlusion,
            ..Style::default()
        };
        assert!(refused(with_occlusion(1.5), Overlays::default()));
        assert!(refused(with_occlusion(f64::NAN), Overlays::default()));
        let colorings = vec![coloring];
        assert!(refused(
            Style::default(),
            Overlays {
                colorings,
                ..Overlays::default()
            }
        ));
        let highlights = vec![Highlight {
            object: "b".into(),
            elements: Elements::Faces(Vec::new()),
            color: Color::rgb(0, 0, 0),
            size: 1.0,
            hidden: 0.0,
        }];
        assert!(refused(
            Style::default(),
            Overlays {
                highlights,
                ..Overlays::default()
            }
        ));
        let grid = scene(Object::mesh("a", shapes::grid(60, 60)));
        let style = Style {
            ids: Some(Ids::Faces),
            ..Style::default()
        };
        let too_many = draw(&grid, &style, &Overlays::default(), [8, 8], 1 << 30);
        assert!(matches!(too_many, Err(PictureError::Style(_))));
    }

    #[test]
    fn a_picture_of_an_empty_scene_shows_only_the_background() {
        let empty = Scene::new();
        let style = Style {
            background: Background::Plain(Color::rgb(10, 20, 30)),
            ..Style::default()
        };
        let (picture, _) = draw(&empty, &style, &Overlays::default(), [5, 5], 1 << 30).unwrap();
        assert!(picture.image.pixels.iter().all(|p| *p == [10, 20, 30, 255]));
    }
}
