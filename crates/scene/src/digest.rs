//! The canonical form of a scene as bytes, and its digest.
//!
//! The canonical form writes every array with its length, numbers little-endian with all their bits,
//! and texts with their lengths. Two scenes have the same form exactly if they are the same objects
//! with the same arrays, in the same order.
//!
//! A material is its name, base color, metalness, roughness and the path of its base color texture. What
//! else it has follows behind a length that no text has, each thing with its name, so that materials
//! without it keep the form they had before there was more.

use std::fmt;

use bytemuck::NoUninit;
use mesh::{Mesh, Rule, Values};

use crate::{
    AlphaMode, Filter, Geometry, Image, Material, Object, Sampler, Scene, Texture,
    TextureTransform, Wrap,
};

/// BLAKE3 over the canonical form of a scene, 16 bytes of it.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Digest([u8; 16]);

impl Digest {
    /// The digest as bytes.
    pub const fn to_bytes(self) -> [u8; 16] {
        self.0
    }

    /// The digest of these bytes, as [`to_bytes`](Self::to_bytes) gave them.
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
    /// The digest of the scene: equal for equal scenes, on every machine.
    pub fn digest(&self) -> Digest {
        let mut hasher = blake3::Hasher::new();
        self.encode(&mut |bytes| {
            // Threads help with long arrays only.
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

    /// Hands the canonical form to `sink`, piece by piece.
    pub fn encode(&self, sink: &mut impl FnMut(&[u8])) {
        self.encode_to(&mut Together(sink));
    }

    /// The canonical form without the contents of arrays of at least `long` bytes, which go to `array`, each
    /// whole, in their order. [`decode`](Self::decode) puts both together again.
    pub fn encode_apart(&self, long: usize, array: &mut dyn FnMut(&[u8])) -> Vec<u8> {
        let mut sink = Apart {
            rest: Vec::new(),
            long,
            array,
        };
        self.encode_to(&mut sink);
        sink.rest
    }

    fn encode_to(&self, sink: &mut impl Sink) {
        let mut encoder = Encoder { sink };
        encoder.text(FORM);
        encoder.len(self.objects().len());
        for object in self.objects() {
            encoder.object(object);
        }
    }
}

/// The first text of the canonical form.
pub(crate) const FORM: &str = "meshwright scene 1";
/// Stands where the length of a text would be, before what else a material has.
pub(crate) const MORE: u64 = u64::MAX;

/// Takes the canonical form.
trait Sink {
    /// Some bytes.
    fn bytes(&mut self, bytes: &[u8]);
    /// The content of an array.
    fn array(&mut self, bytes: &[u8]);
}

struct Together<'a, F>(&'a mut F);

impl<F: FnMut(&[u8])> Sink for Together<'_, F> {
    fn bytes(&mut self, bytes: &[u8]) {
        (self.0)(bytes);
    }

    fn array(&mut self, bytes: &[u8]) {
        (self.0)(bytes);
    }
}

struct Apart<'a> {
    rest: Vec<u8>,
    long: usize,
    array: &'a mut dyn FnMut(&[u8]),
}

impl Sink for Apart<'_> {
    fn bytes(&mut self, bytes: &[u8]) {
        self.rest.extend_from_slice(bytes);
    }

    fn array(&mut self, bytes: &[u8]) {
        if bytes.len() < self.long {
            self.bytes(bytes);
        } else {
            (self.array)(bytes);
        }
    }
}

struct Encoder<'a, S> {
    sink: &'a mut S,
}

impl<S: Sink> Encoder<'_, S> {
    fn len(&mut self, n: usize) {
        self.sink.bytes(&(n as u64).to_le_bytes());
    }

    fn text(&mut self, text: &str) {
        self.len(text.len());
        self.sink.bytes(text.as_bytes());
    }

    /// An array of numbers, or of structs of numbers of `width` bytes each.
    fn array<T: NoUninit>(&mut self, values: &[T], width: usize) {
        self.len(values.len());
        let bytes: &[u8] = bytemuck::cast_slice(values);
        if cfg!(target_endian = "little") {
            self.sink.array(bytes);
        } else {
            let mut turned = bytes.to_vec();
            for number in turned.chunks_exact_mut(width) {
                number.reverse();
            }
            self.sink.array(&turned);
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

        let plain = Material::new("");
        // A transparent color has always meant a transparent surface.
        let usual = if m.base_color[3] < 1.0 {
            AlphaMode::Blend
        } else {
            AlphaMode::Opaque
        };
        let base_color = m.base_color_texture.as_ref();
        let textures = [
            ("base color texture", base_color.filter(|&t| !is_path(t))),
            (
                "metallic roughness texture",
                m.metallic_roughness_texture.as_ref(),
            ),
            ("normal texture", m.normal_texture.as_ref()),
            ("occlusion texture", m.occlusion_texture.as_ref()),
            ("emissive texture", m.emissive_texture.as_ref()),
        ];
        let textures = textures
            .into_iter()
            .filter_map(|(name, t)| Some((name, t?)));
        let alpha = match m.alpha {
            AlphaMode::Opaque => vec![0.0],
            AlphaMode::Mask(cutoff) => vec![1.0, cutoff],
            AlphaMode::Blend => vec![2.0],
        };
        let flag = |is| vec![f64::from(u8::from(is))];
        let numbers = [
            (
                "normal scale",
                vec![m.normal_scale],
                m.normal_scale != plain.normal_scale,
            ),
            (
                "occlusion strength",
                vec![m.occlusion_strength],
                m.occlusion_strength != plain.occlusion_strength,
            ),
            (
                "emissive",
                m.emissive.to_vec(),
                m.emissive != plain.emissive,
            ),
            (
                "emissive strength",
                vec![m.emissive_strength],
                m.emissive_strength != plain.emissive_strength,
            ),
            ("alpha", alpha, m.alpha != usual),
            ("double sided", flag(m.double_sided), m.double_sided),
            ("unlit", flag(m.unlit), m.unlit),
        ];
        let numbers = numbers.into_iter().filter(|&(_, _, differs)| differs);
        let (textures, numbers): (Vec<_>, Vec<_>) = (textures.collect(), numbers.collect());
        if textures.is_empty() && numbers.is_empty() {
            return;
        }
        self.sink.bytes(&MORE.to_le_bytes());
        self.len(textures.len());
        for (name, texture) in textures {
            self.text(name);
            self.texture(texture);
        }
        self.len(numbers.len());
        for (name, values, _) in numbers {
            self.text(name);
            self.array(&values, 8);
        }
    }

    fn texture(&mut self, texture: &Texture) {
        match &texture.image {
            Image::File(path) => {
                self.text("file");
                self.text(path);
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
        let wrap = wrap.map(|wrap| match wrap {
            Wrap::Repeat => 0,
            Wrap::Mirror => 1,
            Wrap::Clamp => 2,
        });
        let filter = [magnify, minify, mipmap].map(|filter| match filter {
            None => 0,
            Some(Filter::Nearest) => 1,
            Some(Filter::Linear) => 2,
        });
        self.array(&[&[texture.uv_set], &wrap[..], &filter].concat(), 4);
        let TextureTransform {
            offset: [u, v],
            rotation,
            scale: [x, y],
        } = texture.transform;
        self.array(&[u, v, rotation, x, y], 8);
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
            self.text(match column.rule {
                Rule::Interpolate => "interpolate",
                Rule::Normal => "normal",
                Rule::Copy => "copy",
                Rule::Drop => "drop",
            });
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

/// Whether the path is all that there is to a texture.
fn is_path(texture: &Texture) -> bool {
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
        // The value that the first version of the canonical form gave. A change of it breaks every
        // digest that users have recorded, so it needs a new version in the form's first text.
        assert_eq!(
            scene(shapes::square()).digest().to_string(),
            "2387ae96ff730dac6ab311d51d5863e9"
        );
    }

    #[test]
    fn dead_elements_do_not_count() {
        let mut with_dead = shapes::grid(2, 1);
        with_dead.delete_face(mesh::FaceId::new(0)).unwrap();
        with_dead.delete_isolated_vertices();
        let mut compacted = with_dead.clone();
        compacted.compact();
        assert_eq!(scene(with_dead).digest(), scene(compacted).digest());
    }

    /// The digest of a square with this material.
    fn with(change: impl FnOnce(&mut Material)) -> String {
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
    fn materials_of_the_first_form_keep_their_digests() {
        // Recorded before materials had more than a color, two numbers and a path.
        assert_eq!(with(|_| {}), "ada3f121a9c1a3fae1913ce36d14aef1");
        let glass = with(|m| {
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
        let of = |change: fn(&mut Texture)| {
            let mut changed = texture();
            change(&mut changed);
            with(|m| m.base_color_texture = Some(changed))
        };
        let digests = [
            with(|_| {}),
            with(|m| m.base_color_texture = Some(texture())),
            with(|m| m.base_color_texture = Some(Texture::file(""))),
            with(|m| m.base_color_texture = bytes(b"x")),
            with(|m| m.base_color_texture = bytes(b"y")),
            with(|m| m.metallic_roughness_texture = Some(texture())),
            with(|m| m.normal_texture = Some(texture())),
            with(|m| m.normal_scale = 0.5),
            with(|m| m.occlusion_texture = Some(texture())),
            with(|m| m.occlusion_strength = 0.5),
            with(|m| m.emissive = [0.5, 0.0, 0.0]),
            with(|m| m.emissive_strength = 0.5),
            with(|m| m.emissive_texture = Some(texture())),
            with(|m| m.alpha = AlphaMode::Mask(0.5)),
            with(|m| m.alpha = AlphaMode::Mask(0.25)),
            with(|m| m.alpha = AlphaMode::Blend),
            with(|m| m.double_sided = true),
            with(|m| m.unlit = true),
            of(|t| t.uv_set = 1),
            of(|t| t.sampler.wrap[0] = Wrap::Clamp),
            of(|t| t.sampler.wrap[1] = Wrap::Clamp),
            of(|t| t.sampler.magnify = Some(Filter::Linear)),
            of(|t| t.sampler.minify = Some(Filter::Linear)),
            of(|t| t.sampler.mipmap = Some(Filter::Nearest)),
            of(|t| t.transform.offset[1] = 0.5),
            of(|t| t.transform.rotation = 0.5),
            of(|t| t.transform.scale[0] = 0.5),
        ];
        let different: std::collections::BTreeSet<_> = digests.iter().collect();
        assert_eq!(different.len(), digests.len());
    }
}
