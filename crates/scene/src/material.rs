//! Materials, as in the metallic-roughness model of glTF.

use std::fmt;
use std::sync::Arc;

/// A material. Colors are linear.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// The name.
    pub name: String,
    /// Linear red, green, blue and alpha, from 0 to 1.
    pub base_color: [f64; 4],
    /// The texture that multiplies the base color.
    pub base_color_texture: Option<Texture>,
    /// The metalness, from 0 (not a metal) to 1 (metal).
    pub metallic: f64,
    /// The roughness, from 0 (mirror) to 1 (matte).
    pub roughness: f64,
    /// The texture whose green channel multiplies the roughness, and whose blue channel multiplies the metalness.
    pub metallic_roughness_texture: Option<Texture>,
    /// The texture with normals in tangent space.
    pub normal_texture: Option<Texture>,
    /// The factor for the x and y components of the normal texture.
    pub normal_scale: f64,
    /// The texture whose red channel is the amount of indirect light.
    pub occlusion_texture: Option<Texture>,
    /// The strength of the occlusion texture, from 0 (no effect) to 1.
    pub occlusion_strength: f64,
    /// Linear red, green and blue of the emitted light, from 0 to 1.
    pub emissive: [f64; 3],
    /// The factor for the emitted light; can be greater than 1.
    pub emissive_strength: f64,
    /// The texture that multiplies the emitted light.
    pub emissive_texture: Option<Texture>,
    /// How alpha is interpreted.
    pub alpha: AlphaMode,
    /// Whether back faces are visible.
    pub double_sided: bool,
    /// Whether the base color is drawn without lighting.
    pub unlit: bool,
    /// Application-specific data (`extras` in glTF), as JSON.
    pub extras: Option<String>,
}

impl Material {
    /// Returns the textures of the material.
    pub fn textures(&self) -> impl Iterator<Item = &Texture> {
        let textures = [
            &self.base_color_texture,
            &self.metallic_roughness_texture,
            &self.normal_texture,
            &self.occlusion_texture,
            &self.emissive_texture,
        ];
        textures.into_iter().flatten()
    }

    /// Returns mutable references to the textures of the material.
    pub fn textures_mut(&mut self) -> impl Iterator<Item = &mut Texture> {
        let textures = [
            &mut self.base_color_texture,
            &mut self.metallic_roughness_texture,
            &mut self.normal_texture,
            &mut self.occlusion_texture,
            &mut self.emissive_texture,
        ];
        textures.into_iter().flatten()
    }

    /// Creates a white, matte, opaque material.
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
            extras: None,
        }
    }
}

/// How the alpha of a material is interpreted.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum AlphaMode {
    /// Alpha is ignored: the surface is opaque.
    #[default]
    Opaque,
    /// The surface is opaque where alpha is greater than or equal to this cutoff, and invisible elsewhere.
    Mask(f64),
    /// The surface is blended with the background.
    Blend,
}

/// An image and how it is mapped to a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// The image.
    pub image: Image,
    /// The index of the set of texture coordinates: 0 for the attribute `uv`, 1 for `uv1`, 2 for `uv2`, and so on.
    pub uv_set: u32,
    /// How the image is sampled.
    pub sampler: Sampler,
    /// The transform of the texture coordinates before the lookup.
    pub transform: TextureTransform,
    /// The names that a file gives to the texture, the image and the sampler.
    pub names: TextureNames,
}

/// The names that a glTF file gives to the parts of a texture.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TextureNames {
    /// The name of the texture.
    pub texture: Option<String>,
    /// The name of the image.
    pub image: Option<String>,
    /// The name of the sampler.
    pub sampler: Option<String>,
}

impl TextureNames {
    /// Returns the names that are not `None`.
    pub fn iter(&self) -> impl Iterator<Item = &str> {
        let names = [&self.texture, &self.image, &self.sampler];
        names.into_iter().flatten().map(String::as_str)
    }
}

impl Texture {
    /// Creates a texture with the first set of texture coordinates, the default sampler, no transform and no names.
    pub fn new(image: Image) -> Self {
        Self {
            image,
            uv_set: 0,
            sampler: Sampler::default(),
            transform: TextureTransform::default(),
            names: TextureNames::default(),
        }
    }

    /// Creates a texture from an image file.
    pub fn file(path: impl Into<String>) -> Self {
        Self::new(Image::File(path.into()))
    }

    /// Returns the path of the image, if it is a file.
    pub fn path(&self) -> Option<&str> {
        match &self.image {
            Image::File(path) | Image::Loaded { path, .. } => Some(path),
            Image::Embedded { .. } => None,
        }
    }
}

/// An image.
#[derive(Clone, PartialEq)]
pub enum Image {
    /// The path of an image file that was not read, or a URI with a scheme. A path is stored as written in the model
    /// file, with `/` as the separator.
    File(String),
    /// An image file that was read from the folder of the model file. Copies of a material share the bytes, so that
    /// copying is cheap.
    Loaded {
        /// The path of the image file, in the form that [`Image::File`] describes.
        path: String,
        /// The content of the image file.
        bytes: Arc<[u8]>,
    },
    /// The bytes of an image that is embedded in the model file. Copies of a material share the bytes, so that copying
    /// is cheap.
    Embedded {
        /// The media type, such as `image/png`.
        mime: String,
        /// The content of the image file.
        bytes: Arc<[u8]>,
    },
}

/// Writes the number of bytes of the image file instead of the bytes themselves.
impl fmt::Debug for Image {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File(path) => f.debug_tuple("File").field(path).finish(),
            Self::Loaded { path, bytes } => write!(f, "Loaded({path:?}, {} bytes)", bytes.len()),
            Self::Embedded { mime, bytes } => write!(f, "Embedded({mime}, {} bytes)", bytes.len()),
        }
    }
}

/// How a texture is sampled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sampler {
    /// The wrap mode along u and along v.
    pub wrap: [Wrap; 2],
    /// The filter for places where pixels of the image are larger than pixels of the screen. If `None`, the viewer
    /// chooses a filter.
    pub magnify: Option<Filter>,
    /// The filter for places where pixels of the image are smaller than pixels of the screen. If `None`, the viewer
    /// chooses a filter.
    pub minify: Option<Filter>,
    /// The filter between mipmap levels. If `None`, mipmaps are not used. This filter has an effect only if `minify` is
    /// set.
    pub mipmap: Option<Filter>,
}

/// How a texture continues outside its image.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wrap {
    /// The image is repeated.
    #[default]
    Repeat,
    /// The image is repeated, and every second copy is mirrored.
    Mirror,
    /// The color of the nearest pixel at the border of the image.
    Clamp,
}

/// How the pixels of a texture are filtered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Filter {
    /// The nearest pixel.
    Nearest,
    /// Linear interpolation between neighboring pixels.
    Linear,
}

/// The transform of texture coordinates before the lookup, as in `KHR_texture_transform`. The coordinates are scaled,
/// then rotated, then moved. The v axis points down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextureTransform {
    /// The offset, which is added last.
    pub offset: [f64; 2],
    /// The rotation, counter-clockwise in radians.
    pub rotation: f64,
    /// The scale, which is applied first.
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
