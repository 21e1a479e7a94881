//! How a surface looks, in the terms of glTF's metallic-roughness model.

use std::fmt;
use std::sync::Arc;

/// A material. Colors are linear; each texture multiplies the value beside it.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// The name.
    pub name: String,
    /// Linear red, green, blue and alpha, from 0 to 1.
    pub base_color: [f64; 4],
    /// Multiplies the base color.
    pub base_color_texture: Option<Texture>,
    /// From 0 (no metal) to 1 (metal).
    pub metallic: f64,
    /// From 0 (mirror) to 1 (matt).
    pub roughness: f64,
    /// Its green multiplies the roughness, its blue the metalness.
    pub metallic_roughness_texture: Option<Texture>,
    /// Normals in tangent space.
    pub normal_texture: Option<Texture>,
    /// What the x and y of the normal texture are multiplied with.
    pub normal_scale: f64,
    /// Its red says how much indirect light arrives.
    pub occlusion_texture: Option<Texture>,
    /// How much the occlusion texture darkens, from 0 (not at all) to 1.
    pub occlusion_strength: f64,
    /// Linear red, green and blue of the light that the surface gives off, from 0 to 1.
    pub emissive: [f64; 3],
    /// Multiplies the emitted light; may be more than 1.
    pub emissive_strength: f64,
    /// Multiplies the emitted light.
    pub emissive_texture: Option<Texture>,
    /// What alpha means.
    pub alpha: AlphaMode,
    /// Whether the back of a face is seen too.
    pub double_sided: bool,
    /// Whether the base color is shown as it is, without light.
    pub unlit: bool,
}

impl Material {
    /// A white, matt, opaque material.
    pub fn new(name: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            base_color: [1.0; 4],
            base_color_texture: None,
            metallic: 0.0,
            roughness: 1.0,
            metallic_roughness_texture: None,
            normal_texture: None,
            normal_scale: 1.0,
            occlusion_texture: None,
            occlusion_strength: 1.0,
            emissive: [0.0; 3],
            emissive_strength: 1.0,
            emissive_texture: None,
            alpha: AlphaMode::Opaque,
            double_sided: false,
            unlit: false,
        }
    }
}

/// What the alpha of a material means.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum AlphaMode {
    /// Nothing: the surface is opaque.
    #[default]
    Opaque,
    /// The surface is opaque where alpha is at least this, and not there elsewhere.
    Mask(f64),
    /// What is behind shines through.
    Blend,
}

/// A picture and how it lies on a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// The picture.
    pub image: Image,
    /// Which texture coordinates: 0 for the attribute `uv`, n for `uv` with the number n behind it.
    pub uv_set: u32,
    /// How it is sampled.
    pub sampler: Sampler,
    /// How texture coordinates are changed before they are looked up.
    pub transform: TextureTransform,
}

impl Texture {
    /// A picture as it is, on the first texture coordinates.
    pub fn new(image: Image) -> Self {
        Self {
            image,
            uv_set: 0,
            sampler: Sampler::default(),
            transform: TextureTransform::default(),
        }
    }

    /// The picture in a file.
    pub fn file(path: impl Into<String>) -> Self {
        Self::new(Image::File(path.into()))
    }

    /// The path of the picture, if it is a file.
    pub fn path(&self) -> Option<&str> {
        match &self.image {
            Image::File(path) => Some(path),
            Image::Embedded { .. } => None,
        }
    }
}

/// A picture.
#[derive(Clone, PartialEq)]
pub enum Image {
    /// The path of a file as the file that names it gives it, with `/` between its parts, or a URI with a
    /// scheme.
    File(String),
    /// The bytes of a picture file. Shared, so that copies of a material cost nothing.
    Embedded {
        /// Its type, such as `image/png`.
        mime: String,
        /// The bytes, as they are in a file of that type.
        bytes: Arc<[u8]>,
    },
}

/// Without the bytes: nobody reads them.
impl fmt::Debug for Image {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File(path) => f.debug_tuple("File").field(path).finish(),
            Self::Embedded { mime, bytes } => write!(f, "Embedded({mime}, {} bytes)", bytes.len()),
        }
    }
}

/// How a texture is sampled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sampler {
    /// What lies beyond the picture, along u and along v.
    pub wrap: [Wrap; 2],
    /// How pixels larger than those of the screen are mixed; `None` leaves it to the viewer.
    pub magnify: Option<Filter>,
    /// How pixels smaller than those of the screen are mixed; `None` leaves it to the viewer.
    pub minify: Option<Filter>,
    /// How the smaller copies of the picture are mixed; `None` if there are none. Only with `minify`.
    pub mipmap: Option<Filter>,
}

/// What lies beyond the edge of a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wrap {
    /// The picture again.
    #[default]
    Repeat,
    /// The picture mirrored, and again.
    Mirror,
    /// The color of the edge.
    Clamp,
}

/// How pixels are mixed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Filter {
    /// The nearest one is taken.
    Nearest,
    /// Neighbors are mixed.
    Linear,
}

/// How texture coordinates are changed before a picture is looked up, as `KHR_texture_transform` says it:
/// scaled, turned and then moved, all with v downwards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextureTransform {
    /// Added at the end.
    pub offset: [f64; 2],
    /// Counter-clockwise in radians.
    pub rotation: f64,
    /// Multiplied at first.
    pub scale: [f64; 2],
}

impl Default for TextureTransform {
    fn default() -> Self {
        Self {
            offset: [0.0; 2],
            rotation: 0.0,
            scale: [1.0; 2],
        }
    }
}
