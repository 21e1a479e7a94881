//! Accessors: typed arrays in the buffers, with strides, normalized integers and sparse parts.

use std::borrow::Cow;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

use bytemuck::Zeroable;
use gltf_json::Accessor;
use gltf_json::accessor::{ComponentType, IndexComponentType, Type};
use gltf_json::validation::Checked;
use mesh::Value;
use rayon::prelude::*;

use super::JsonError;
use super::budget::Budget;
use super::document::{Document, get};

/// An accessor without a buffer view is all zeros. It may have this many elements even in a tiny file.
const FREE_ZEROS: u64 = 1 << 16;
/// How many elements are converted by one task at least.
const BLOCK: usize = 1 << 13;

/// Reads arrays out of the buffers of a document.
pub(super) struct Reader<'a> {
    pub(super) document: &'a Document,
    pub(super) buffers: &'a [Cow<'a, [u8]>],
    pub(super) budget: &'a Budget,
}

impl<'a> Reader<'a> {
    /// How many elements an accessor has.
    ///
    /// # Errors
    ///
    /// If there is no such accessor; `pointer` is the place that refers to it.
    pub(super) fn count(&self, index: usize, pointer: &str) -> Result<u64, JsonError> {
        Ok(self.accessor(index, pointer)?.count.0)
    }

    /// The type of an accessor.
    ///
    /// # Errors
    ///
    /// As [`count`](Self::count), or if the type is unknown.
    pub(super) fn kind(&self, index: usize, pointer: &str) -> Result<Type, JsonError> {
        let accessor = self.accessor(index, pointer)?;
        Ok(kinds(accessor, &format!("/accessors/{index}"))?.0)
    }

    fn accessor(&self, index: usize, pointer: &str) -> Result<&Accessor, JsonError> {
        let accessors = &self.document.accessors;
        get(accessors, index, || pointer.to_owned(), "accessor")
    }

    /// The elements of an accessor, each converted from N numbers. Components that its type does not
    /// have are `fill`; normalized integers are between 0 and 1, or between -1 and 1.
    ///
    /// # Errors
    ///
    /// If the accessor is of none of the `types`, does not fit its buffer, or has a value that is not
    /// finite. `pointer` is the place that refers to it.
    pub(super) fn vectors<const N: usize, T: Value>(
        &self,
        index: usize,
        pointer: &str,
        types: &[Type],
        fill: f64,
        convert: impl Fn([f64; N]) -> T + Sync,
    ) -> Result<Vec<T>, JsonError> {
        let accessor = self.accessor(index, pointer)?;
        let here = format!("/accessors/{index}");
        let (kind, component) = kinds(accessor, &here)?;
        if !types.contains(&kind) {
            return Err(JsonError::new(
                format!("{here}/type"),
                format!("expected {}, found {}", one_of(types), type_name(kind)),
            ));
        }
        let used = kind.multiplicity().min(N);
        let size = component.size();
        // Not a number, if it comes to that, is found by a second look.
        let broken = AtomicBool::new(false);
        let general = |bytes: &[u8]| {
            let mut vector = [fill; N];
            for (slot, bytes) in vector.iter_mut().zip(bytes.chunks_exact(size)).take(used) {
                *slot = number(bytes, component, accessor.normalized);
            }
            vector
        };
        let floats = |bytes: &[u8]| {
            let mut vector = [0.0; N];
            for (slot, bytes) in vector.iter_mut().zip(bytes.as_chunks().0) {
                *slot = f64::from(f32::from_le_bytes(*bytes));
            }
            vector
        };
        let checked = |vector: [f64; N]| {
            if !vector.iter().all(|x| x.is_finite()) {
                broken.store(true, Relaxed);
            }
            convert(vector)
        };
        let mut zero = [fill; N];
        zero[..used].fill(0.0);
        let zero = convert(zero);
        let multiplicity = kind.multiplicity();
        let values = if component == ComponentType::F32 && multiplicity == N {
            self.elements(index, N, component, zero, |bytes| checked(floats(bytes)))?
        } else {
            let value = |bytes: &[u8]| checked(general(bytes));
            self.elements(index, multiplicity, component, zero, value)?
        };
        if broken.into_inner() {
            let finite = |bytes: &[u8]| i32::from(general(bytes).iter().all(|x| x.is_finite()));
            let finite = self.elements(index, multiplicity, component, 1, finite)?;
            // A sparse part may have replaced it.
            if let Some(i) = finite.iter().position(|&is| is == 0) {
                let message = format!("element {i} is not a finite number");
                return Err(JsonError::new(here, message));
            }
        }
        Ok(values)
    }

    /// The elements of an accessor of indices.
    ///
    /// # Errors
    ///
    /// As [`vectors`](Self::vectors).
    pub(super) fn indices(&self, index: usize, pointer: &str) -> Result<Vec<u32>, JsonError> {
        let accessor = self.accessor(index, pointer)?;
        let here = format!("/accessors/{index}");
        let (kind, component) = kinds(accessor, &here)?;
        if kind != Type::Scalar {
            let message = format!("expected SCALAR for indices, found {}", type_name(kind));
            return Err(JsonError::new(format!("{here}/type"), message));
        }
        match component {
            ComponentType::U8 | ComponentType::U16 => {
                self.elements(index, 1, component, 0, |bytes| whole(bytes, component))
            }
            // Known to the compiler, it becomes a copy.
            ComponentType::U32 => self.elements(index, 1, component, 0, |bytes| {
                whole(bytes, ComponentType::U32)
            }),
            _ => {
                let message = "expected unsigned integers for indices";
                Err(JsonError::new(format!("{here}/componentType"), message))
            }
        }
    }

    /// Reads every element, from its view or as `zero`, and then the sparse ones.
    fn elements<T: Copy + Zeroable + Send + Sync>(
        &self,
        index: usize,
        components: usize,
        component: ComponentType,
        zero: T,
        value: impl Fn(&[u8]) -> T + Sync,
    ) -> Result<Vec<T>, JsonError> {
        let accessor = &self.document.accessors[index];
        let here = format!("/accessors/{index}");
        let size = components * component.size();
        let count = accessor.count.0;
        let bytes = count.saturating_mul(size_of::<T>() as u64);
        let mut elements = if let Some(view) = accessor.buffer_view {
            let offset = accessor.byte_offset.unwrap_or_default().0;
            let rows = self.rows(view.value(), offset, count, size, &here)?;
            self.budget.spend(bytes, &here)?;
            let mut elements = mesh::zeroed::<T>(rows.count);
            let blocks = elements.par_chunks_mut(BLOCK).enumerate();
            blocks.for_each(|(block, elements)| {
                let rows = rows.block(block * BLOCK, elements.len());
                if rows.stride == size {
                    for (slot, bytes) in elements.iter_mut().zip(rows.bytes.chunks_exact(size)) {
                        *slot = value(bytes);
                    }
                } else {
                    for (slot, bytes) in elements.iter_mut().zip(rows.iter()) {
                        *slot = value(bytes);
                    }
                }
            });
            elements
        } else {
            let n = self.zeros(count, &here)?;
            self.budget.spend(bytes, &here)?;
            vec![zero; n]
        };
        let Some(sparse) = &accessor.sparse else {
            return Ok(elements);
        };
        let here = format!("{here}/sparse");
        let Checked::Valid(IndexComponentType(index_type)) = sparse.indices.component_type else {
            let message = "expected unsigned integers for indices";
            return Err(JsonError::new(
                format!("{here}/indices/componentType"),
                message,
            ));
        };
        let n = sparse.count.0;
        // Not made, but looked at each time that the accessor is used.
        self.budget.spend(n.saturating_mul(size as u64), &here)?;
        let (indices, values) = (&sparse.indices, &sparse.values);
        let at = format!("{here}/indices");
        let places = self.rows(
            indices.buffer_view.value(),
            indices.byte_offset.0,
            n,
            index_type.size(),
            &at,
        )?;
        let at = format!("{here}/values");
        let values = self.rows(
            values.buffer_view.value(),
            values.byte_offset.0,
            n,
            size,
            &at,
        )?;
        for (place, bytes) in places.iter().zip(values.iter()) {
            let place = whole(place, index_type);
            let slot = elements.get_mut(place as usize).ok_or_else(|| {
                let message = format!("refers to element {place}, but there are {count}");
                JsonError::new(format!("{here}/indices"), message)
            })?;
            *slot = value(bytes);
        }
        Ok(elements)
    }

    /// Checks how many zeros an accessor without data says it has.
    fn zeros(&self, count: u64, here: &str) -> Result<usize, JsonError> {
        let all: u64 = self.buffers.iter().map(|buffer| buffer.len() as u64).sum();
        let limit = all.max(FREE_ZEROS);
        usize::try_from(count).ok().filter(|_| count <= limit).ok_or_else(|| {
            let message = format!(
                "the accessor has no buffer view and says {count} elements; a file of this size \
                 may have {limit}"
            );
            JsonError::new(format!("{here}/count"), message)
        })
    }

    /// The bytes of a view.
    ///
    /// # Errors
    ///
    /// If there is no such view or its buffer is too short; `pointer` is the place that refers to it.
    pub(super) fn view(
        &self,
        index: usize,
        pointer: impl Fn() -> String,
    ) -> Result<&[u8], JsonError> {
        let at = format!("/bufferViews/{index}");
        let view = get(&self.document.views, index, pointer, "buffer view")?;
        let buffer = view.buffer.value();
        let bytes = get(self.buffers, buffer, || format!("{at}/buffer"), "buffer")?;
        let start = view.byte_offset.unwrap_or_default().0;
        let end = start
            .checked_add(view.byte_length.0)
            .filter(|&end| end <= bytes.len() as u64);
        let range =
            end.and_then(|end| Some(usize::try_from(start).ok()?..usize::try_from(end).ok()?));
        range.map(|range| &bytes[range]).ok_or_else(|| {
            let message = format!(
                "the view says {} bytes from {start}, but buffer {buffer} has {}",
                view.byte_length.0,
                bytes.len()
            );
            JsonError::new(format!("{at}/byteLength"), message)
        })
    }

    /// `count` pieces of `size` bytes in a view, from `offset`, as far apart as the view says.
    fn rows(
        &self,
        index: usize,
        offset: u64,
        count: u64,
        size: usize,
        here: &str,
    ) -> Result<Rows<'_>, JsonError> {
        let bytes = self.view(index, || format!("{here}/bufferView"))?;
        let (view, at) = (&self.document.views[index], format!("/bufferViews/{index}"));
        let stride = view.byte_stride.map_or(0, |stride| stride.0);
        let stride = if stride == 0 { size } else { stride };
        if stride < size {
            let message =
                format!("expected at least {size}, the size of an element, found {stride}");
            return Err(JsonError::new(format!("{at}/byteStride"), message));
        }
        // The last element needs no room for the rest of its stride.
        let needed = match count {
            0 => Some(0),
            _ => (count - 1)
                .checked_mul(stride as u64)
                .and_then(|bytes| bytes.checked_add(size as u64))
                .and_then(|bytes| bytes.checked_add(offset)),
        };
        if needed.is_none_or(|needed| needed > bytes.len() as u64) {
            let message = format!(
                "{count} elements of {size} bytes, {stride} apart, from byte {offset} do not fit the \
                 {} bytes of the view",
                bytes.len()
            );
            return Err(JsonError::new(format!("{here}/count"), message));
        }
        // Both fit: they are no more than the length of the view.
        let [count, offset] = [count, offset].map(|n| usize::try_from(n).unwrap_or(0));
        Ok(Rows {
            bytes: bytes.get(offset..).unwrap_or_default(),
            count,
            size,
            stride,
        })
    }
}

/// Pieces of the same size, the same distance apart. The last one needs no room behind it.
#[derive(Clone, Copy)]
struct Rows<'a> {
    bytes: &'a [u8],
    count: usize,
    size: usize,
    stride: usize,
}

impl<'a> Rows<'a> {
    /// `count` rows from the one at `first`.
    fn block(self, first: usize, count: usize) -> Self {
        Self {
            bytes: &self.bytes[first * self.stride..],
            count,
            ..self
        }
    }

    fn iter(self) -> impl Iterator<Item = &'a [u8]> {
        (0..self.count).map(move |i| {
            let start = i * self.stride;
            &self.bytes[start..start + self.size]
        })
    }
}

fn kinds(accessor: &Accessor, here: &str) -> Result<(Type, ComponentType), JsonError> {
    let Checked::Valid(kind) = accessor.type_ else {
        return Err(JsonError::new(
            format!("{here}/type"),
            "expected SCALAR, VEC2, VEC3, ...",
        ));
    };
    let Checked::Valid(component) = accessor.component_type else {
        let message = "expected one of 5120, 5121, 5122, 5123, 5125, 5126";
        return Err(JsonError::new(format!("{here}/componentType"), message));
    };
    Ok((kind, component.0))
}

fn number(bytes: &[u8], component: ComponentType, normalized: bool) -> f64 {
    let (value, largest) = match (component, bytes) {
        (ComponentType::I8, &[a]) => (f64::from(i8::from_le_bytes([a])), 127.0),
        (ComponentType::U8, &[a]) => (f64::from(a), 255.0),
        (ComponentType::I16, &[a, b]) => (f64::from(i16::from_le_bytes([a, b])), 32767.0),
        (ComponentType::U16, &[a, b]) => (f64::from(u16::from_le_bytes([a, b])), 65535.0),
        (ComponentType::U32, &[a, b, c, d]) => (
            f64::from(u32::from_le_bytes([a, b, c, d])),
            f64::from(u32::MAX),
        ),
        (ComponentType::F32, &[a, b, c, d]) => return f64::from(f32::from_le_bytes([a, b, c, d])),
        _ => return f64::NAN,
    };
    // The lowest signed integer stands for -1 as well as the one above it.
    if normalized {
        (value / largest).max(-1.0)
    } else {
        value
    }
}

fn whole(bytes: &[u8], component: ComponentType) -> u32 {
    match (component, bytes) {
        (ComponentType::U8, &[a]) => u32::from(a),
        (ComponentType::U16, &[a, b]) => u32::from(u16::from_le_bytes([a, b])),
        (ComponentType::U32, &[a, b, c, d]) => u32::from_le_bytes([a, b, c, d]),
        _ => u32::MAX,
    }
}

fn type_name(kind: Type) -> &'static str {
    match kind {
        Type::Scalar => "SCALAR",
        Type::Vec2 => "VEC2",
        Type::Vec3 => "VEC3",
        Type::Vec4 => "VEC4",
        Type::Mat2 => "MAT2",
        Type::Mat3 => "MAT3",
        Type::Mat4 => "MAT4",
    }
}

fn one_of(types: &[Type]) -> String {
    types
        .iter()
        .map(|&kind| type_name(kind))
        .collect::<Vec<_>>()
        .join(" or ")
}
