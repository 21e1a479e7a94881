//! How a surface looks, in the terms of glTF's metallic-roughness model.

/// A material.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// The name.
    pub name: String,
    /// Linear red, green, blue and alpha, from 0 to 1.
    pub base_color: [f64; 4],
    /// From 0 (no metal) to 1 (metal).
    pub metallic: f64,
    /// From 0 (mirror) to 1 (matt).
    pub roughness: f64,
    /// The path of the picture that the base color is multiplied with, as the file gives it.
    pub base_color_texture: Option<String>,
}

impl Material {
    /// A white, matt material.
    pub fn new(name: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            base_color: [1.0; 4],
            metallic: 0.0,
            roughness: 1.0,
            base_color_texture: None,
        }
    }
}
