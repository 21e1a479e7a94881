//! Writes material libraries, and lists the content that they cannot store.

use scene::{AlphaMode, Material, Object, Sampler, Texture, TextureTransform};

use super::file::NO_MATERIAL;
use super::material::alpha_mode;
use super::states::fit_line;
use crate::decimal::push_number;
use crate::loss::Losses;
use crate::writing::push_comment;

/// Returns the text of a material library. The names of the materials must not contain line ends.
pub(super) fn write_library(materials: &[Material], comment: Option<&str>) -> Vec<u8> {
    let mut out = Vec::new();
    push_comment(&mut out, "#", comment);
    for material in materials {
        out.extend_from_slice(format!("newmtl {}\n", material.name).as_bytes());
        let [red, green, blue, alpha] = material.base_color;
        push_values(&mut out, "Kd", &[red, green, blue]);
        push_values(&mut out, "d", &[alpha]);
        push_values(&mut out, "Pm", &[material.metallic]);
        push_values(&mut out, "Pr", &[material.roughness]);
        // If a material has a texture `map_Ke` but no `Ke`, readers use 1 for `Ke`. Therefore, `Ke` is written here
        // even if it is 0.
        if material.emissive != [0.0; 3] || material.emissive_texture.is_some() {
            let light = material.emissive.map(|x| x * material.emissive_strength);
            push_values(&mut out, "Ke", &light);
        }
        push_picture(&mut out, "map_Kd", material.base_color_texture.as_ref());
        let both = material.metallic_roughness_texture.as_ref();
        push_picture(&mut out, "map_Pm", both);
        push_picture(&mut out, "map_Pr", both);
        push_picture(&mut out, "map_Ke", material.emissive_texture.as_ref());
        let mut keyword = b"norm".to_vec();
        if (material.normal_scale - 1.0).abs() > 0.0 {
            keyword.extend_from_slice(b" -bm ");
            push_number(&mut keyword, material.normal_scale);
        }
        let keyword = String::from_utf8_lossy(&keyword);
        push_picture(&mut out, &keyword, material.normal_texture.as_ref());
    }
    out
}

fn push_picture(out: &mut Vec<u8>, keyword: &str, texture: Option<&Texture>) {
    if let Some(path) = texture.and_then(Texture::path) {
        out.extend_from_slice(format!("{keyword} {}\n", fit_line(path)).as_bytes());
    }
}

/// Appends a line with a keyword and numbers.
pub(super) fn push_values(out: &mut Vec<u8>, keyword: &str, values: &[f64]) {
    out.extend_from_slice(keyword.as_bytes());
    for &value in values {
        out.push(b' ');
        push_number(out, value);
    }
    out.push(b'\n');
}

/// Adds a loss for each part of a material that [`write_library`] does not write.
fn note_losses(material: &Material, losses: &mut Losses) {
    let mut lose = |count: bool, what: &str| {
        let reason = format!("MTL cannot store {what}");
        losses.add(None, &material.name, usize::from(count), reason);
    };
    let is_implied = material.alpha == alpha_mode(material.base_color[3]);
    let cuts = matches!(material.alpha, AlphaMode::Mask(_));
    lose(cuts, "the alpha cutoff");
    let what = "an alpha mode other than the one that readers assume for the alpha value";
    lose(!cuts && !is_implied, what);
    lose(material.double_sided, "that the material is double-sided");
    lose(material.unlit, "that the material is unlit");
    lose(material.extras.is_some(), "extras");
    lose(
        material.occlusion_texture.is_some(),
        "the occlusion texture",
    );
    let textures = [
        &material.base_color_texture,
        &material.metallic_roughness_texture,
        &material.emissive_texture,
        &material.normal_texture,
    ];
    for texture in textures.into_iter().flatten() {
        lose(texture.path().is_none(), "embedded textures");
        let is_renamed = texture.path().is_some_and(|path| fit_line(path) != path);
        lose(is_renamed, "some characters in the file name of a texture");
        let is_plain = texture.sampler == Sampler::default()
            && texture.transform == TextureTransform::default()
            && texture.uv_set == 0;
        lose(!is_plain, "the sampling of a texture");
        let is_named = texture.names.iter().next().is_some();
        lose(
            is_named,
            "the names of a texture, its image and its sampler",
        );
    }
}

/// Appends a line with a keyword and a name.
pub(super) fn push_name(out: &mut Vec<u8>, keyword: &str, name: &str) {
    out.extend_from_slice(format!("{keyword} {name}\n").as_bytes());
}

/// The materials of all objects. The names of the materials are unique and have no line ends.
#[derive(Default)]
pub(super) struct Library {
    pub(super) materials: Vec<Material>,
    /// For each object, the indices of its materials in `materials`.
    pub(super) indices: Vec<Vec<usize>>,
}

impl Library {
    pub(super) fn add(&mut self, object: &Object, losses: &mut Losses) {
        let materials = object.materials.iter();
        let places = materials
            .map(|material| self.index_of(material, losses))
            .collect();
        self.indices.push(places);
    }

    /// Returns the index of a material in `materials`, and adds the material if no equal material exists yet. If the
    /// name already belongs to a different material, the new material is renamed.
    fn index_of(&mut self, material: &Material, losses: &mut Losses) -> usize {
        let mut base = fit_line(&material.name).into_owned();
        if base.is_empty() || base.as_bytes() == NO_MATERIAL {
            "unnamed".clone_into(&mut base);
        }
        let mut new = Material {
            name: base.clone(),
            ..material.clone()
        };
        for suffix in 2.. {
            let is_it = |known: &Material| known.name == new.name;
            match self.materials.iter().position(is_it) {
                None => break,
                Some(place) if self.materials[place] == new => return place,
                Some(_) => new.name = format!("{base}_{suffix}"),
            }
        }
        let renamed = usize::from(new.name != material.name);
        let reason = format!("the material is written as `{}`", new.name);
        losses.add(None, &material.name, renamed, reason);
        note_losses(material, losses);
        self.materials.push(new);
        self.materials.len() - 1
    }
}
