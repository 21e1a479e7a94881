//! Decodes a scene from its canonical form, which is the sequence of bytes that [`Scene::encode`] writes. The bytes can
//! be corrupt. The decoder therefore checks each length before it allocates memory, and validates the arrays of each
//! mesh.

use std::sync::Arc;

use bezier::{BezierError, Curve, Patch};
use bytemuck::{AnyBitPattern, NoUninit};
use glam::DVec3;
use mesh::{Column, Connectivity, Defect, Domain, Mesh, Values};

use crate::digest::{FILTERS, FORM, GRAPH, MORE, RULES, TEXTURES, WRAPS};
use crate::{
    AlphaMode, DuplicateName, Geometry, Image, Material, Object, Sampler, Scene, Texture,
    TextureNames, TextureTransform,
};

/// A source of the long arrays that [`Scene::encode_with_separate_arrays`] separated from the canonical form.
pub trait ArraySource {
    /// Returns the size of the next array in bytes; `None` if no array is left.
    fn next_len(&self) -> Option<u64>;

    /// Reads the next array into `bytes`, which must be as long as the array.
    ///
    /// # Errors
    ///
    /// Returns [`DecodeError::Array`] with the reason why the array cannot be read.
    fn read(&mut self, bytes: &mut [u8]) -> Result<(), DecodeError>;
}

/// A source that has no arrays. It is used for a canonical form that contains the contents of all arrays.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoArrays;

impl ArraySource for NoArrays {
    fn next_len(&self) -> Option<u64> {
        None
    }

    fn read(&mut self, _: &mut [u8]) -> Result<(), DecodeError> {
        Err(DecodeError::Array("no separate arrays exist"))
    }
}

/// Why bytes cannot be decoded as a scene.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DecodeError {
    /// The bytes end before the scene is complete.
    #[error("the bytes end before the scene is complete")]
    Truncated,
    /// More bytes or arrays follow after the end of the scene.
    #[error("expected the end of the scene, found more data")]
    TrailingData,
    /// The bytes are not in the canonical form. The value describes the expected bytes.
    #[error("expected {0}")]
    Expected(&'static str),
    /// A long array cannot be read.
    #[error("{0}")]
    Array(&'static str),
    /// The arrays do not form a valid mesh.
    #[error("the arrays do not form a valid mesh: {0}")]
    Mesh(#[from] Defect),
    /// Two objects have the same name.
    #[error(transparent)]
    Name(#[from] DuplicateName),
    /// The points do not form a valid curve or patch.
    #[error(transparent)]
    Bezier(#[from] BezierError),
}

impl Scene {
    /// Decodes a scene from its canonical form. The contents of arrays of at least `min_long` bytes are read from
    /// `arrays`, because the form does not contain them. To decode the output of [`encode`](Self::encode), pass
    /// `usize::MAX` and [`NoArrays`].
    ///
    /// # Errors
    ///
    /// Returns a [`DecodeError`] if the bytes are not the canonical form of a scene.
    pub fn decode(
        bytes: &[u8],
        min_long: usize,
        arrays: &mut dyn ArraySource,
    ) -> Result<Self, DecodeError> {
        let mut decoder = Decoder {
            rest: bytes,
            min_long,
            arrays,
        };
        if decoder.text()? != FORM {
            return Err(DecodeError::Expected("the scene format of this version"));
        }
        let mut scene = Self::new();
        for _ in 0..decoder.len()? {
            scene.insert(decoder.object()?)?;
        }
        if !decoder.rest.is_empty() {
            let marker = [&(GRAPH.len() as u64).to_le_bytes(), GRAPH.as_bytes()].concat();
            if !decoder.rest.starts_with(&marker) {
                return Err(DecodeError::TrailingData);
            }
            decoder.take(marker.len())?;
            scene.graph = Arc::new(decoder.graph(&scene)?);
        }
        if decoder.rest.is_empty() && decoder.arrays.next_len().is_none() {
            Ok(scene)
        } else {
            Err(DecodeError::TrailingData)
        }
    }
}

pub(crate) struct Decoder<'a> {
    rest: &'a [u8],
    min_long: usize,
    arrays: &'a mut dyn ArraySource,
}

impl<'a> Decoder<'a> {
    fn take(&mut self, n: usize) -> Result<&'a [u8], DecodeError> {
        let (taken, rest) = self
            .rest
            .split_at_checked(n)
            .ok_or(DecodeError::Truncated)?;
        self.rest = rest;
        Ok(taken)
    }

    pub(crate) fn is_at_end(&self) -> bool {
        self.rest.is_empty()
    }

    pub(crate) fn len(&mut self) -> Result<u64, DecodeError> {
        let bytes = self.take(8)?.try_into().expect("eight bytes");
        Ok(u64::from_le_bytes(bytes))
    }

    pub(crate) fn text(&mut self) -> Result<&'a str, DecodeError> {
        let n = usize::try_from(self.len()?).map_err(|_| DecodeError::Truncated)?;
        std::str::from_utf8(self.take(n)?).map_err(|_| DecodeError::Expected("a text in UTF-8"))
    }

    /// Reads a name and returns the value with this name in `all`. If `all` does not contain the name, returns an error
    /// with the text `expected`.
    fn named<T: Copy>(
        &mut self,
        all: &[(&str, T)],
        expected: &'static str,
    ) -> Result<T, DecodeError> {
        let name = self.text()?;
        let entry = all.iter().find(|(other, _)| *other == name);
        entry
            .map(|(_, value)| *value)
            .ok_or(DecodeError::Expected(expected))
    }

    /// Reads an array whose elements are numbers or structs of numbers. Each number has `width` bytes.
    pub(crate) fn array<T: AnyBitPattern + NoUninit>(
        &mut self,
        width: usize,
    ) -> Result<Vec<T>, DecodeError> {
        let n = usize::try_from(self.len()?).map_err(|_| DecodeError::Truncated)?;
        let n_bytes = n
            .checked_mul(size_of::<T>())
            .ok_or(DecodeError::Truncated)?;
        let mut values: Vec<T>;
        if n_bytes < self.min_long {
            let bytes = self.take(n_bytes)?;
            values = bytemuck::zeroed_vec(n);
            bytemuck::cast_slice_mut(&mut values).copy_from_slice(bytes);
        } else {
            if self.arrays.next_len() != Some(n_bytes as u64) {
                return Err(DecodeError::Expected(
                    "a separate array of the declared length",
                ));
            }
            values = mesh::zeroed(n);
            let bytes = bytemuck::cast_slice_mut(&mut values);
            self.arrays.read(bytes)?;
        }
        if cfg!(target_endian = "big") {
            let bytes: &mut [u8] = bytemuck::cast_slice_mut(&mut values);
            for number in bytes.chunks_exact_mut(width) {
                number.reverse();
            }
        }
        Ok(values)
    }

    /// Reads an array that must contain exactly `N` numbers.
    fn numbers<const N: usize>(&mut self) -> Result<[f64; N], DecodeError> {
        let numbers = self.array::<f64>(8)?;
        numbers
            .try_into()
            .map_err(|_| DecodeError::Expected("an array of the required length"))
    }

    /// Reads the length of a list, then the list. `next` reads one element.
    pub(crate) fn list<T>(
        &mut self,
        mut next: impl FnMut(&mut Self) -> Result<T, DecodeError>,
    ) -> Result<Vec<T>, DecodeError> {
        // The list grows while it is read, because memory that is reserved for a corrupt length could be huge.
        let n = self.len()?;
        (0..n).try_fold(Vec::new(), |mut list, _| {
            list.push(next(self)?);
            Ok(list)
        })
    }

    fn object(&mut self) -> Result<Object, DecodeError> {
        let name = self.text()?.to_owned();
        let materials = self.list(Self::material)?;
        let geometry = match self.text()? {
            "mesh" => Geometry::Mesh(Arc::new(self.mesh()?)),
            "patches" => {
                let points = |d: &mut Self| match d.array::<DVec3>(8)?.as_chunks() {
                    (&[a, b, c, e], []) => Ok(Patch::new([a, b, c, e])?),
                    _ => Err(DecodeError::Expected("16 points of a patch")),
                };
                Geometry::Patches(self.list(points)?)
            }
            "curve" => Geometry::Curve(Curve::new(self.array(8)?)?),
            "polylines" => Geometry::Polylines(self.list(|d| d.array(8))?),
            _ => return Err(DecodeError::Expected("a kind of geometry")),
        };
        Ok(Object {
            name,
            geometry,
            materials,
        })
    }

    fn material(&mut self) -> Result<Material, DecodeError> {
        let mut m = Material::new(self.text()?);
        m.base_color = self.numbers()?;
        [m.metallic, m.roughness] = self.numbers()?;
        let path = self.text()?;
        if !path.is_empty() {
            m.base_color_texture = Some(Texture::file(path));
        }
        if m.base_color[3] < 1.0 {
            m.alpha = AlphaMode::Blend;
        }
        // The marker `MORE` follows only if other properties of the material were written, too.
        if !self.rest.starts_with(&MORE.to_le_bytes()) {
            return Ok(m);
        }
        self.len()?;
        for _ in 0..self.len()? {
            let field = self.named(&TEXTURES, "a texture of a material")?;
            *field(&mut m) = Some(self.texture()?);
        }
        for _ in 0..self.len()? {
            let name = self.text()?;
            if name == "emissive" {
                m.emissive = self.numbers()?;
                continue;
            }
            let values = self.array::<f64>(8)?;
            match (name, &values[..]) {
                ("normal scale", &[scale]) => m.normal_scale = scale,
                ("occlusion strength", &[strength]) => m.occlusion_strength = strength,
                ("emissive strength", &[strength]) => m.emissive_strength = strength,
                ("alpha", [0.0]) => m.alpha = AlphaMode::Opaque,
                ("alpha", &[1.0, cutoff]) => m.alpha = AlphaMode::Mask(cutoff),
                ("alpha", [2.0]) => m.alpha = AlphaMode::Blend,
                ("double sided", [1.0]) => m.double_sided = true,
                ("unlit", [1.0]) => m.unlit = true,
                _ => return Err(DecodeError::Expected("a numeric property of a material")),
            }
        }
        if self.rest.starts_with(&MORE.to_le_bytes()) {
            self.len()?;
            m.extras = Some(self.text()?.to_owned());
        }
        Ok(m)
    }

    fn texture(&mut self) -> Result<Texture, DecodeError> {
        let image = match self.text()? {
            "file" => Image::File(self.text()?.to_owned()),
            "loaded" => Image::Loaded {
                path: self.text()?.to_owned(),
                bytes: self.array::<u8>(1)?.into(),
            },
            "embedded" => Image::Embedded {
                mime: self.text()?.to_owned(),
                bytes: self.array::<u8>(1)?.into(),
            },
            _ => return Err(DecodeError::Expected("an image")),
        };
        let wrap = |code| value_of_code(&WRAPS, code, "the wrap mode of a texture");
        let filter = |code| value_of_code(&FILTERS, code, "the filter of a texture");
        let codes = self.array::<u32>(4)?;
        let &[uv_set, u, v, magnify, minify, mipmap] = &codes[..] else {
            return Err(DecodeError::Expected("the sampler of a texture"));
        };
        let sampler = Sampler {
            wrap: [wrap(u)?, wrap(v)?],
            magnify: filter(magnify)?,
            minify: filter(minify)?,
            mipmap: filter(mipmap)?,
        };
        let [u, v, rotation, x, y] = self.numbers()?;
        let mut names = TextureNames::default();
        if self.rest.starts_with(&MORE.to_le_bytes()) {
            self.len()?;
            names = TextureNames {
                texture: self.optional_text()?,
                image: self.optional_text()?,
                sampler: self.optional_text()?,
            };
        }
        Ok(Texture {
            image,
            uv_set,
            sampler,
            transform: TextureTransform {
                offset: [u, v],
                rotation,
                scale: [x, y],
            },
            names,
        })
    }

    fn mesh(&mut self) -> Result<Mesh, DecodeError> {
        let connectivity = Connectivity {
            next: self.array(4)?,
            origin: self.array(4)?,
            face: self.array(4)?,
            vertex_half_edge: self.array(4)?,
            face_half_edge: self.array(4)?,
        };
        let positions = self.array(8)?;
        let mut mesh = Mesh::try_from_arrays(connectivity, positions)?;
        for _ in 0..self.len()? {
            let (domain, column) = self.column()?;
            if column.values.len() != mesh.domain_len(domain) {
                let name = column.name;
                return Err(Defect::ColumnLength { domain, name }.into());
            }
            mesh.insert_column(domain, column);
        }
        Ok(mesh)
    }

    fn column(&mut self) -> Result<(Domain, Column), DecodeError> {
        let (domain, name) = self
            .text()?
            .split_once(' ')
            .ok_or(DecodeError::Expected("a domain and a name"))?;
        let mut domains = Domain::ALL.into_iter();
        let domain = domains.find(|d| d.to_string() == domain);
        let domain = domain.ok_or(DecodeError::Expected("a domain"))?;
        let rule = self.named(&RULES, "a rule")?;
        let values = match self.text()? {
            "number" => Values::Float(self.array(8)?),
            "2 numbers" => Values::Vec2(self.array(8)?),
            "3 numbers" => Values::Vec3(self.array(8)?),
            "4 numbers" => Values::Vec4(self.array(8)?),
            "whole number" => Values::Int(self.array(4)?),
            "tag" => Values::Tag(flags(&self.array(1)?)?),
            _ => return Err(DecodeError::Expected("a type of values")),
        };
        let column = Column {
            name: name.to_owned(),
            rule,
            values,
        };
        Ok((domain, column))
    }
}

/// Returns the value at index `code` in `all`. If the index is too large, returns an error with the text `expected`.
fn value_of_code<T: Copy>(all: &[T], code: u32, expected: &'static str) -> Result<T, DecodeError> {
    let value = all.get(code as usize).copied();
    value.ok_or(DecodeError::Expected(expected))
}

fn flags(bytes: &[u8]) -> Result<Vec<bool>, DecodeError> {
    if bytes.iter().any(|&byte| byte > 1) {
        return Err(DecodeError::Expected("tag values of 0 or 1"));
    }
    Ok(bytes.iter().map(|&byte| byte == 1).collect())
}

#[cfg(test)]
mod tests;
