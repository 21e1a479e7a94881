//! The canonical form of a scene as bytes, and its digest.
//!
//! In the canonical form, every array and every string is preceded by its length. Numbers are little-endian and are
//! written with all their bits. Two scenes have the same canonical form if and only if they have the same graph and the
//! same objects in the same order, bit for bit. Removed elements of meshes are not written.
//!
//! If the scene has a graph, the graph follows the objects. The first version of the canonical form had no graphs. A
//! scene without a graph is still written as in the first version.
//!
//! A material is written as its name, base color, metalness, roughness and the path of its base color texture. Other
//! properties are written only if they differ from their defaults: the marker [`MORE`] comes first, then each property
//! with its name. Without these other properties, a material is still written as in the first version of the form. If a
//! material has extras, or a texture has names, they follow after another marker.

use std::fmt;

use bytemuck::NoUninit;
use mesh::{Mesh, Rule, Values};

use crate::{
    AlphaMode, Filter, Geometry, Image, Material, Object, Sampler, Scene, Texture,
    TextureTransform, Wrap,
};

/// The first 16 bytes of the BLAKE3 hash of the canonical form of a scene.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Digest([u8; 16]);

impl Digest {
    /// Returns the digest as bytes.
    pub const fn to_bytes(self) -> [u8; 16] {
        self.0
    }

    /// Creates a digest from the bytes that [`to_bytes`](Self::to_bytes) returned.
    pub const fn from_bytes(bytes: [u8; 16]) -> Self {
        Self(bytes)
    }
}

impl fmt::Display for Digest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|byte| write!(f, "{byte:02x}"))
    }
}

impl fmt::Debug for Digest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl Scene {
    /// Returns the digest of the canonical form of the scene. The digest is the same on every machine.
    pub fn digest(&self) -> Digest {
        let mut hasher = blake3::Hasher::new();
        self.encode(&mut |bytes| {
            // Hashing with several threads is faster only for long arrays.
            if bytes.len() < 1 << 17 {
                hasher.update(bytes);
            } else {
                hasher.update_rayon(bytes);
            }
        });
        let mut digest = [0; 16];
        digest.copy_from_slice(&hasher.finalize().as_bytes()[..16]);
        Digest(digest)
    }

    /// Passes the canonical form to `sink`, piece by piece.
    pub fn encode(&self, sink: &mut impl FnMut(&[u8])) {
        self.encode_to(&mut |bytes, _| sink(bytes));
    }

    /// Returns the canonical form without the contents of long arrays. An array is long if it has at least `min_long`
    /// bytes. Each long array is passed to `array` in one piece, in order. [`decode`](Self::decode) needs both the form
    /// and the arrays.
    pub fn encode_with_separate_arrays(
        &self,
        min_long: usize,
        array: &mut dyn FnMut(&[u8]),
    ) -> Vec<u8> {
        let mut rest = Vec::new();
        self.encode_to(&mut |bytes, is_array| {
            if is_array && bytes.len() >= min_long {
                array(bytes);
            } else {
                rest.extend_from_slice(bytes);
            }
        });
        rest
    }

    /// Passes the canonical form to `sink`, piece by piece. Each piece has a flag that is true if the piece is the
    /// content of an array.
    fn encode_to(&self, sink: &mut dyn FnMut(&[u8], bool)) {
        let mut encoder = Encoder { sink };
        encoder.text(FORM);
        encoder.len(self.objects().len());
        for object in self.objects() {
            encoder.object(object);
        }
        if !self.graph().is_empty() {
            encoder.text(GRAPH);
            encoder.graph(self.graph());
        }
    }
}

/// The string that precedes the graph in the canonical form. If the graph is empty, the form has neither this string
/// nor the graph.
pub(crate) const GRAPH: &str = "graph";

/// The first string of the canonical form. The string contains the version of the canonical form.
pub(crate) const FORM: &str = "meshwright scene 1";
/// The marker that precedes the optional parts of a material, such as its extras. Where the marker is missing, the form
/// ends or continues with the length of a string or list. This length is never `u64::MAX`, so a decoder cannot confuse
/// it with the marker.
pub(crate) const MORE: u64 = u64::MAX;

/// The name of a texture in the canonical form, and a function that returns the field of a material for this texture.
type NamedTexture = (&'static str, fn(&mut Material) -> &mut Option<Texture>);

/// The textures of a material, with their names in the canonical form. The base color texture is in this list because
/// it can have properties in addition to its path.
pub(crate) const TEXTURES: [NamedTexture; 5] = [
    ("base color texture", |m| &mut m.base_color_texture),
    ("metallic roughness texture", |m| {
        &mut m.metallic_roughness_texture
    }),
    ("normal texture", |m| &mut m.normal_texture),
    ("occlusion texture", |m| &mut m.occlusion_texture),
    ("emissive texture", |m| &mut m.emissive_texture),
];

/// The edit rules of attributes, with their names in the canonical form.
pub(crate) const RULES: [(&str, Rule); 4] = [
    ("interpolate", Rule::Interpolate),
    ("normal", Rule::Normal),
    ("copy", Rule::Copy),
    ("drop", Rule::Drop),
];

/// All wrap modes. The index of a mode in this list is its code in the canonical form.
pub(crate) const WRAPS: [Wrap; 3] = [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp];

/// All filters. The index of a filter in this list is its code in the canonical form.
pub(crate) const FILTERS: [Option<Filter>; 3] = [None, Some(Filter::Nearest), Some(Filter::Linear)];

/// Returns the index of `value` in `all`, or 0 if `all` does not contain the value.
fn code<T: PartialEq>(all: &[T], value: &T) -> u32 {
    (0..)
        .zip(all)
        .find_map(|(i, candidate)| (candidate == value).then_some(i))
        .unwrap_or(0)
}

/// Returns the numeric properties of a material with their names. Base color, metalness and roughness are left out,
/// because they are always written, without a name.
fn named_numbers(m: &Material) -> [(&'static str, Vec<f64>); 7] {
    let flag = |is: bool| vec![f64::from(u8::from(is))];
    let alpha = match m.alpha {
        AlphaMode::Opaque => vec![0.0],
        AlphaMode::Mask(cutoff) => vec![1.0, cutoff],
        AlphaMode::Blend => vec![2.0],
    };
    [
        ("normal scale", vec![m.normal_scale]),
        ("occlusion strength", vec![m.occlusion_strength]),
        ("emissive", m.emissive.to_vec()),
        ("emissive strength", vec![m.emissive_strength]),
        ("alpha", alpha),
        ("double sided", flag(m.double_sided)),
        ("unlit", flag(m.unlit)),
    ]
}

pub(crate) struct Encoder<'a> {
    /// A function with two arguments: bytes, and a flag that is true if the bytes are the content of an array.
    sink: &'a mut dyn FnMut(&[u8], bool),
}

impl Encoder<'_> {
    pub(crate) fn len(&mut self, n: usize) {
        (self.sink)(&(n as u64).to_le_bytes(), false);
    }

    pub(crate) fn text(&mut self, text: &str) {
        self.len(text.len());
        (self.sink)(text.as_bytes(), false);
    }

    /// Writes an array whose elements are numbers or structs of numbers. Each number has `width` bytes.
    pub(crate) fn array<T: NoUninit>(&mut self, values: &[T], width: usize) {
        self.len(values.len());
        let bytes: &[u8] = bytemuck::cast_slice(values);
        if cfg!(target_endian = "little") {
            (self.sink)(bytes, true);
        } else {
            let mut little_endian = bytes.to_vec();
            for number in little_endian.chunks_exact_mut(width) {
                number.reverse();
            }
            (self.sink)(&little_endian, true);
        }
    }

    fn object(&mut self, object: &Object) {
        self.text(&object.name);
        self.len(object.materials.len());
        for m in &object.materials {
            self.material(m);
        }
        self.text(object.geometry.kind());
        match &object.geometry {
            Geometry::Mesh(mesh) => self.mesh(mesh),
            Geometry::Patches(patches) => {
                self.len(patches.len());
                for patch in patches {
                    self.array(patch.points().as_flattened(), 8);
                }
            }
            Geometry::Curve(curve) => self.array(curve.points(), 8),
            Geometry::Polylines(lines) => {
                self.len(lines.len());
                for line in lines {
                    self.array(line, 8);
                }
            }
        }
    }

    fn material(&mut self, m: &Material) {
        self.text(&m.name);
        self.array(&m.base_color, 8);
        self.array(&[m.metallic, m.roughness], 8);
        let path = m.base_color_texture.as_ref().and_then(Texture::path);
        self.text(path.unwrap_or(""));

        let mut default = Material::new("");
        // The first version of the canonical form had no alpha mode. A surface was drawn as transparent if and only if
        // the alpha of its base color was less than 1. The default mode reproduces this rule.
        if m.base_color[3] < 1.0 {
            default.alpha = AlphaMode::Blend;
        }
        let mut remaining = m.clone();
        remaining.base_color_texture.take_if(|t| is_only_path(t));
        let texture = |(name, field): (_, fn(&mut Material) -> &mut Option<Texture>)| {
            Some((name, field(&mut remaining).take()?))
        };
        let textures: Vec<_> = TEXTURES.into_iter().filter_map(texture).collect();
        let numbers = named_numbers(m).into_iter().zip(named_numbers(&default));
        let numbers: Vec<_> = numbers
            .filter(|(actual, default)| actual != default)
            .collect();
        if textures.is_empty() && numbers.is_empty() && m.extras.is_none() {
            return;
        }
        (self.sink)(&MORE.to_le_bytes(), false);
        self.len(textures.len());
        for (name, texture) in textures {
            self.text(name);
            self.texture(&texture);
        }
        self.len(numbers.len());
        for ((name, values), _) in numbers {
            self.text(name);
            self.array(&values, 8);
        }
        if let Some(extras) = &m.extras {
            (self.sink)(&MORE.to_le_bytes(), false);
            self.text(extras);
        }
    }

    fn texture(&mut self, texture: &Texture) {
        match &texture.image {
            Image::File(path) => {
                self.text("file");
                self.text(path);
            }
            Image::Loaded { path, bytes } => {
                self.text("loaded");
                self.text(path);
                self.array(bytes, 1);
            }
            Image::Embedded { mime, bytes } => {
                self.text("embedded");
                self.text(mime);
                self.array(bytes, 1);
            }
        }
        let Sampler {
            wrap,
            magnify,
            minify,
            mipmap,
        } = texture.sampler;
        let [u, v] = wrap.map(|wrap| code(&WRAPS, &wrap));
        let [magnify, minify, mipmap] = [magnify, minify, mipmap].map(|f| code(&FILTERS, &f));
        self.array(&[texture.uv_set, u, v, magnify, minify, mipmap], 4);
        let TextureTransform {
            offset: [u, v],
            rotation,
            scale: [x, y],
        } = texture.transform;
        self.array(&[u, v, rotation, x, y], 8);
        let names = &texture.names;
        if names.iter().next().is_some() {
            (self.sink)(&MORE.to_le_bytes(), false);
            for name in [&names.texture, &names.image, &names.sampler] {
                self.optional_text(name.as_deref());
            }
        }
    }

    fn mesh(&mut self, mesh: &Mesh) {
        let dense;
        let mesh = if mesh.is_dense() {
            mesh
        } else {
            let mut compacted = mesh.clone();
            compacted.compact();
            dense = compacted;
            &dense
        };
        let c = mesh.connectivity();
        self.array(&c.next, 4);
        self.array(&c.origin, 4);
        self.array(&c.face, 4);
        self.array(&c.vertex_half_edge, 4);
        self.array(&c.face_half_edge, 4);
        self.array(mesh.positions(), 8);
        self.len(mesh.attributes().iter().count());
        for (domain, column) in mesh.attributes().iter() {
            self.text(&format!("{domain} {}", column.name));
            let (rule, _) = RULES[code(&RULES.map(|(_, rule)| rule), &column.rule) as usize];
            self.text(rule);
            self.text(column.values.type_name());
            match &column.values {
                Values::Float(v) => self.array(v, 8),
                Values::Vec2(v) => self.array(v, 8),
                Values::Vec3(v) => self.array(v, 8),
                Values::Vec4(v) => self.array(v, 8),
                Values::Int(v) => self.array(v, 4),
                Values::Tag(v) => self.array(v, 1),
            }
        }
    }
}

/// Whether a texture has only one property: a path, which is not empty.
fn is_only_path(texture: &Texture) -> bool {
    texture
        .path()
        .is_some_and(|path| !path.is_empty() && *texture == Texture::file(path))
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use mesh::DVec3;

    fn scene(mesh: Mesh) -> Scene {
        let mut scene = Scene::new();
        scene.insert(Object::mesh("a", mesh)).unwrap();
        scene
    }

    #[test]
    fn equal_scenes_have_equal_digests() {
        assert_eq!(
            scene(shapes::cube()).digest(),
            scene(shapes::cube()).digest()
        );
    }

    #[test]
    fn one_bit_of_a_position_changes_the_digest() {
        let mut moved = shapes::cube();
        moved.positions_mut()[3] += DVec3::new(f64::EPSILON, 0.0, 0.0);
        assert_ne!(scene(shapes::cube()).digest(), scene(moved).digest());
    }

    #[test]
    fn the_digest_of_a_known_scene_never_changes() {
        // The expected digest was recorded with the first version of the canonical form. If this digest changes, every
        // digest that users have recorded is wrong, and `FORM` needs a new version number.
        assert_eq!(
            scene(shapes::square()).digest().to_string(),
            "2387ae96ff730dac6ab311d51d5863e9"
        );
    }

    #[test]
    fn dead_elements_do_not_change_the_digest() {
        let mut with_dead = shapes::grid(2, 1);
        with_dead.delete_face(mesh::FaceId::new(0)).unwrap();
        with_dead.delete_isolated_vertices();
        let mut compacted = with_dead.clone();
        compacted.compact();
        assert_eq!(scene(with_dead).digest(), scene(compacted).digest());
    }

    /// Returns the digest of a square whose material was changed by `change`.
    fn digest_with(change: impl FnOnce(&mut Material)) -> String {
        let mut material = Material::new("a");
        change(&mut material);
        let mut scene = Scene::new();
        let object = Object {
            materials: vec![material],
            ..Object::mesh("a", shapes::square())
        };
        scene.insert(object).unwrap();
        scene.digest().to_string()
    }

    #[test]
    fn materials_without_other_properties_keep_their_digests() {
        // The expected digest was recorded when materials had only a base color, metalness, roughness and the path of a
        // texture.
        assert_eq!(digest_with(|_| {}), "ada3f121a9c1a3fae1913ce36d14aef1");
        let glass = digest_with(|m| {
            m.base_color = [0.5, 0.25, 1.0, 0.5];
            m.base_color_texture = Some(Texture::file("wood.png"));
            m.alpha = AlphaMode::Blend;
        });
        assert_eq!(glass, "47eb29ab11aa02c4f080b2cb20d7d3f5");
    }

    #[test]
    fn every_part_of_a_material_changes_the_digest() {
        let texture = || Texture::file("a.png");
        let bytes = |bytes: &[u8]| {
            Some(Texture::new(Image::Embedded {
                mime: "image/png".into(),
                bytes: bytes.into(),
            }))
        };
        let texture_digest = |change: fn(&mut Texture)| {
            let mut changed = texture();
            change(&mut changed);
            digest_with(|m| m.base_color_texture = Some(changed))
        };
        let digests = [
            digest_with(|_| {}),
            digest_with(|m| m.base_color_texture = Some(texture())),
            digest_with(|m| m.base_color_texture = Some(Texture::file(""))),
            digest_with(|m| m.base_color_texture = bytes(b"x")),
            digest_with(|m| m.base_color_texture = bytes(b"y")),
            digest_with(|m| m.metallic_roughness_texture = Some(texture())),
            digest_with(|m| m.normal_texture = Some(texture())),
            digest_with(|m| m.normal_scale = 0.5),
            digest_with(|m| m.occlusion_texture = Some(texture())),
            digest_with(|m| m.occlusion_strength = 0.5),
            digest_with(|m| m.emissive = [0.5, 0.0, 0.0]),
            digest_with(|m| m.emissive_strength = 0.5),
            digest_with(|m| m.emissive_texture = Some(texture())),
            digest_with(|m| m.alpha = AlphaMode::Mask(0.5)),
            digest_with(|m| m.alpha = AlphaMode::Mask(0.25)),
            digest_with(|m| m.alpha = AlphaMode::Blend),
            digest_with(|m| m.double_sided = true),
            digest_with(|m| m.unlit = true),
            digest_with(|m| m.extras = Some("1".into())),
            digest_with(|m| m.extras = Some("2".into())),
            texture_digest(|t| t.uv_set = 1),
            texture_digest(|t| t.sampler.wrap[0] = Wrap::Clamp),
            texture_digest(|t| t.sampler.wrap[1] = Wrap::Clamp),
            texture_digest(|t| t.sampler.magnify = Some(Filter::Linear)),
            texture_digest(|t| t.sampler.minify = Some(Filter::Linear)),
            texture_digest(|t| t.sampler.mipmap = Some(Filter::Nearest)),
            texture_digest(|t| t.transform.offset[1] = 0.5),
            texture_digest(|t| t.transform.rotation = 0.5),
            texture_digest(|t| t.transform.scale[0] = 0.5),
            texture_digest(|t| t.names.texture = Some("a".into())),
            texture_digest(|t| t.names.image = Some("a".into())),
            texture_digest(|t| t.names.sampler = Some("a".into())),
        ];
        let unique: std::collections::BTreeSet<_> = digests.iter().collect();
        assert_eq!(unique.len(), digests.len());
    }
}
