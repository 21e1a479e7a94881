//! Converts `<material>` and `<effect>` elements to materials.

use std::collections::BTreeMap;

use scene::{AlphaMode, Material, Texture};

use super::document::{
    Document, Node, below, child, elements, error_at, exactly, is, named, number_of, numbers, text,
};
use crate::assets::inside_uri;
use crate::fault::Fault;

/// The value of a channel of a shader.
enum ChannelValue {
    Color([f64; 4]),
    /// The path of a texture file.
    Texture(String),
}

/// Reads the material of a `<material>` element. `known` contains the materials and effects that were read before. The
/// key is the index of the `<material>` or `<effect>` element. An effect is stored as a material without a name.
///
/// # Errors
///
/// Returns the first error in the material.
pub(super) fn material<'a>(
    document: &Document<'a>,
    node: Node<'a>,
    known: &mut BTreeMap<u32, Material>,
) -> Result<Material, Fault> {
    if let Some(material) = known.get(&number_of(node)) {
        return Ok(material.clone());
    }
    let name = node.attribute("name").filter(|name| !name.is_empty());
    let name = name.or(node.attribute("id")).unwrap_or_default();
    let mut material = Material::new(name);
    if let Some(instance) = child(node, "instance_effect") {
        match document.follow(instance, "url", &["effect"])? {
            None => document.left_out(
                1,
                instance,
                ("other-files", "effects in other files left out"),
            ),
            Some(effect) => {
                let appearance = match known.get(&number_of(effect)) {
                    Some(appearance) => appearance.clone(),
                    None => read_effect(document, effect)?,
                };
                known.insert(number_of(effect), appearance.clone());
                material = Material {
                    name: material.name,
                    ..appearance
                };
            }
        }
    }
    known.insert(number_of(node), material.clone());
    Ok(material)
}

/// Reads the appearance that an `<effect>` element defines, as a material without a name.
fn read_effect<'a>(document: &Document<'a>, effect: Node<'a>) -> Result<Material, Fault> {
    let mut material = Material::new("");
    let others = elements(effect).filter(|profile| {
        let name = profile.tag_name().name();
        name.starts_with("profile_") && name != "profile_COMMON"
    });
    let what = (
        "effect-profiles",
        "profiles of effects other than profile_COMMON left out",
    );
    document.left_out(others.count(), effect, what);
    let Some(profile) = child(effect, "profile_COMMON") else {
        return Ok(material);
    };
    let shader = child(profile, "technique").and_then(|technique| {
        let shaders = ["constant", "lambert", "phong", "blinn"];
        elements(technique).find(|node| shaders.iter().any(|name| is(*node, name)))
    });
    let Some(shader) = shader else {
        return Ok(material);
    };
    // The `constant` shader is unlit, so its color is the emission.
    let channel = if is(shader, "constant") {
        "emission"
    } else {
        "diffuse"
    };
    let others = elements(shader).filter(|node| {
        let name = node.tag_name().name();
        name != channel && name != "transparent" && name != "transparency"
    });
    let what = (
        "material-values",
        "effect parameters other than diffuse color and transparency left out",
    );
    document.left_out(others.count(), shader, what);
    let scope = Scope {
        document,
        scopes: [profile, effect],
    };
    let mut alpha = opacity(&scope, shader)?;
    match scope.channel_value(child(shader, channel))? {
        None => {}
        Some(ChannelValue::Texture(path)) => {
            material.base_color_texture = Some(Texture::file(path));
        }
        Some(ChannelValue::Color([red, green, blue, a])) => {
            material.base_color = [red, green, blue, 1.0].map(|x| x.clamp(0.0, 1.0));
            alpha = alpha.or(Some(a));
        }
    }
    material.base_color[3] = alpha.unwrap_or(1.0).clamp(0.0, 1.0);
    if material.base_color[3] < 1.0 {
        material.alpha = AlphaMode::Blend;
    }
    Ok(material)
}

/// Returns the opacity of a shader, or `None` if the shader does not declare an opacity that can be used.
///
/// COLLADA 1.4.1, "Determining transparency": `alpha` and `luminance` belong to the transparent color, and
/// `transparency` is a value of the effect. The opacity is `alpha * transparency` in the mode `A_ONE`,
/// `1 - alpha * transparency` in the mode `A_ZERO`, `luminance * transparency` in the mode `RGB_ONE`, and
/// `1 - luminance * transparency` in the mode `RGB_ZERO`.
fn opacity(scope: &Scope, shader: Node) -> Result<Option<f64>, Fault> {
    let transparent = child(shader, "transparent");
    let transparency = match child(shader, "transparency") {
        Some(node) => scope.float(node)?,
        None => None,
    };
    if transparent.is_none() && transparency.is_none() {
        return Ok(None);
    }
    let color = match scope.channel_value(transparent)? {
        Some(ChannelValue::Color(color)) => color,
        Some(ChannelValue::Texture(_)) => {
            let what = ("textures", "transparency textures left out");
            scope.document.left_out(1, shader, what);
            return Ok(None);
        }
        None => [0.0, 0.0, 0.0, 1.0],
    };
    let [red, green, blue, alpha] = color;
    let luminance = 0.212_671 * red + 0.715_160 * green + 0.072_169 * blue;
    let transparency = transparency.unwrap_or(1.0);
    let mode = transparent.and_then(|node| node.attribute("opaque"));
    let opacity = match mode.unwrap_or("A_ONE") {
        "A_ZERO" => 1.0 - alpha * transparency,
        "RGB_ZERO" => 1.0 - luminance * transparency,
        "RGB_ONE" => luminance * transparency,
        _ => alpha * transparency,
    };
    // Programs disagree about whether 0 or 1 means opaque. Therefore, a surface that would be completely invisible is
    // made opaque.
    if opacity <= 0.0 {
        let what = ("materials-opaque", "invisible materials made opaque");
        scope.document.changed(1, shader, what);
        return Ok(None);
    }
    Ok(Some(opacity))
}

/// Finds the parameters whose names a shader uses. The parameters of the profile come before those of the effect.
struct Scope<'a, 'd> {
    document: &'d Document<'a>,
    scopes: [Node<'a>; 2],
}

impl<'a> Scope<'a, '_> {
    fn channel_value(&self, channel: Option<Node>) -> Result<Option<ChannelValue>, Fault> {
        let Some(channel) = channel else {
            return Ok(None);
        };
        if let Some(color) = child(channel, "color") {
            return color4(color).map(|color| Some(ChannelValue::Color(color)));
        }
        if let Some(texture) = child(channel, "texture") {
            let sid = texture.attribute("texture");
            let path = sid.and_then(|sid| self.texture_path(sid));
            let what = ("textures", "textures without an image file left out");
            let is_missing = usize::from(path.is_none());
            self.document.left_out(is_missing, texture, what);
            return Ok(path.map(ChannelValue::Texture));
        }
        let parameter = self.parameter_of(channel);
        let color = parameter.and_then(|p| child(p, "float4").or(child(p, "float3")));
        color
            .map(|color| color4(color).map(ChannelValue::Color))
            .transpose()
    }

    fn float(&self, node: Node) -> Result<Option<f64>, Fault> {
        let parameter = self.parameter_of(node);
        let value = child(node, "float").or(parameter.and_then(|p| child(p, "float")));
        value
            .map(|value| exactly::<1>(value).map(|[x]| x))
            .transpose()
    }

    fn parameter_of(&self, node: Node) -> Option<Node<'a>> {
        self.parameter(child(node, "param")?.attribute("ref")?)
    }

    fn parameter(&self, sid: &str) -> Option<Node<'a>> {
        let scopes = self.scopes.into_iter();
        let mut parameters = scopes.flat_map(|scope| named(scope, "newparam"));
        parameters.find(|parameter| parameter.attribute("sid") == Some(sid))
    }

    /// Returns the path of the image of the sampler `sid`. In the files of some programs, `sid` is the id of the image
    /// itself.
    fn texture_path(&self, sid: &str) -> Option<String> {
        let mut image = sid;
        if let Some(sampler) = self.parameter(sid).and_then(|p| child(p, "sampler2D")) {
            if let Some(instance) = child(sampler, "instance_image") {
                image = instance.attribute("url")?.strip_prefix('#')?;
            } else {
                let surface = self.parameter(text(child(sampler, "source")?))?;
                image = text(below(surface, &["surface", "init_from"])?);
            }
        }
        let image = self.document.ids.get(image)?;
        let from = Some(*image).filter(|node| is(*node, "image"));
        let from = child(from?, "init_from")?;
        let path = text(child(from, "ref").unwrap_or(from));
        let inside = inside_uri(path).ok();
        let inside = inside.and_then(|path| Some(path.to_str()?.replace('\\', "/")));
        inside.or_else(|| (!path.is_empty()).then(|| path.to_owned()))
    }
}

/// Reads a color with three or four components.
fn color4(node: Node) -> Result<[f64; 4], Fault> {
    match numbers(node)?[..] {
        [red, green, blue] => Ok([red, green, blue, 1.0]),
        [red, green, blue, alpha] => Ok([red, green, blue, alpha]),
        ref found => {
            let message = format!("expected 3 or 4 numbers, found {}", found.len());
            Err(error_at(node, message))
        }
    }
}
