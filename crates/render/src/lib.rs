//! Pictures of scenes, without a graphics processor.
//!
//! Everything here is computed on the processor, in parallel, and gives the same bytes on every machine and
//! for any number of threads. The crate knows meshes, curves and scenes, but no operations and no recipes; it
//! reads and writes no files.
//!
//! ```text
//!   scene, style, overlays --build--> drawing --render--> image --to_png--> bytes
//!                                        camera --View::new--^
//! ```
//!
//! [`picture`] does it all. [`build()`] makes a [`Drawing`] of triangles, lines and points out of a scene;
//! [`render`] finds for 16 samples a pixel what is seen, and shades it in linear light.
//!
//! [`figure`] draws in the plane: constructions of curves, legends and labels. [`sheet`] puts images side by side,
//! [`animation`] one after another.
//!
//! # Examples
//!
//! ```
//! use mesh::shapes;
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
mod drawing;
mod error;
pub mod figure;
mod image;
pub mod palette;
mod raster;
pub mod sheet;
mod style;
mod texture;

pub use build::{Coloring, Elements, Highlight, Overlays, PALETTE, build};
pub use camera::{Camera, Projection, Seen, Side, Up, View};
pub use color::{Color, NAMES, NoColor, to_linear, to_srgb};
pub use colormap::ColorMap;
pub use drawing::{Channel, Drawing, Label, Line, Mixed, NO_FACE, Normals, Part, Surface};
pub use error::PictureError;
pub use image::{Image, LARGEST_SIDE};
pub use raster::{Look, PlacedLabel, Rendered, bytes_needed, render};
pub use style::{Background, Ids, Lines, Shading, Style};
pub use texture::Texture;

/// A picture of a scene, `size` pixels wide and high, that takes at most `budget` bytes of memory beside the
/// scene; and which images of materials are missing and why. `images` gives the bytes of a picture file for its
/// path in a material.
///
/// # Errors
///
/// [`PictureError::Budget`] before anything large is allocated, and those of [`build()`], [`View::new`] and [`render`].
pub fn picture(
    scene: &scene::Scene,
    camera: &Camera,
    style: &Style,
    overlays: &Overlays,
    size: [u32; 2],
    budget: u64,
    images: &mut dyn FnMut(&str) -> Option<Vec<u8>>,
) -> Result<(Rendered, Vec<String>), PictureError> {
    let (drawing, missing) = build(scene, style, overlays, images)?;
    let look = style.look();
    let needed = bytes_needed(&drawing, size, &look);
    if needed > budget {
        return Err(PictureError::Budget { needed, budget });
    }
    let view = View::new(camera, &|each| drawing.each_point(each), size)?;
    Ok((render(&drawing, &view, size, &look)?, missing))
}
