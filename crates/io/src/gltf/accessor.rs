//! Reads accessors. An accessor is a typed array in a buffer. It can have a stride, normalized integers and sparse
//! values.

use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

use bytemuck::Zeroable;
use gltf_json::Accessor;
use gltf_json::accessor::{ComponentType, IndexComponentType, Type};
use gltf_json::validation::Checked;
use mesh::Value;

use super::numbers::{kinds, number, one_of, type_name, whole};
use super::reference::get;
use super::views::{Reader, Rows};
use crate::fault::Fault;
use mesh::parallel;

/// Limits the number of elements of an accessor without a buffer view. The limit is this number or the number of bytes
/// in all buffers, whichever is larger. All elements of such an accessor are zero, unless sparse values replace them.
const MIN_ZEROS: u64 = 1 << 16;
impl Reader<'_> {
    /// The number of elements of an accessor.
    ///
    /// # Errors
    ///
    /// Returns an error if the accessor does not exist. `pointer` is the JSON pointer to the index that refers to the
    /// accessor, for errors.
    pub(super) fn count(&self, index: usize, pointer: &str) -> Result<u64, Fault> {
        Ok(self.accessor(index, pointer)?.count.0)
    }

    /// The type of an accessor.
    ///
    /// # Errors
    ///
    /// Returns an error if the accessor does not exist or the type is unknown.
    pub(super) fn kind(&self, index: usize, pointer: &str) -> Result<Type, Fault> {
        let accessor = self.accessor(index, pointer)?;
        Ok(kinds(accessor, &format!("/accessors/{index}"))?.0)
    }

    fn accessor(&self, index: usize, pointer: &str) -> Result<&Accessor, Fault> {
        get(&self.document.accessors, index, pointer, "accessor")
    }

    /// Checks that the component type of an accessor is one of the allowed types.
    ///
    /// # Errors
    ///
    /// Returns an error if the accessor does not exist or its component type is not allowed.
    pub(super) fn expect_components(
        &self,
        index: usize,
        pointer: &str,
        expected: &[ComponentType],
    ) -> Result<(), Fault> {
        let accessor = self.accessor(index, pointer)?;
        let here = format!("/accessors/{index}");
        let (_, component) = kinds(accessor, &here)?;
        if expected.contains(&component) {
            return Ok(());
        }
        let numbers = expected.iter().map(|c| c.as_gl_enum().to_string());
        let numbers = numbers.collect::<Vec<_>>().join(", ");
        let message = format!("expected one of {numbers} for {pointer}");
        Err(Fault::json(format!("{here}/componentType"), message))
    }

    /// Reads the elements of an accessor, whose type must be `kind`. Returns the components of all elements in one
    /// list, rounded to 32 bits.
    ///
    /// # Errors
    ///
    /// Returns an error in the same cases as [`vectors`](Self::vectors).
    pub(super) fn floats(
        &self,
        index: usize,
        pointer: &str,
        kind: Type,
    ) -> Result<Vec<f32>, Fault> {
        match kind {
            Type::Scalar => self.float_arrays::<1>(index, pointer, kind),
            Type::Vec2 => self.float_arrays::<2>(index, pointer, kind),
            Type::Vec3 => self.float_arrays::<3>(index, pointer, kind),
            Type::Vec4 | Type::Mat2 => self.float_arrays::<4>(index, pointer, kind),
            Type::Mat3 => self.float_arrays::<9>(index, pointer, kind),
            Type::Mat4 => self.float_arrays::<16>(index, pointer, kind),
        }
    }

    #[expect(
        clippy::cast_possible_truncation,
        reason = "the numbers have at most 32 bits"
    )]
    fn float_arrays<const N: usize>(
        &self,
        index: usize,
        pointer: &str,
        expected: Type,
    ) -> Result<Vec<f32>, Fault>
    where
        [f32; N]: Zeroable,
    {
        let accessor = self.accessor(index, pointer)?;
        let here = format!("/accessors/{index}");
        let (kind, component) = kinds(accessor, &here)?;
        if kind != expected {
            let (expected, found) = (type_name(expected), type_name(kind));
            let message = format!(
                "expected the accessor of {pointer} to have the type {expected}, found {found}"
            );
            return Err(Fault::json(format!("{here}/type"), message));
        }
        let size = component.size();
        let values = self.elements(index, N, component, [0.0; N], |bytes| {
            let mut vector = [0.0; N];
            for (slot, bytes) in vector.iter_mut().zip(bytes.chunks_exact(size)) {
                *slot = number(bytes, component, accessor.normalized) as f32;
            }
            vector
        })?;
        let is_finite = |vector: &[f32; N]| vector.iter().all(|x| x.is_finite());
        if let Some(i) = values.iter().position(|vector| !is_finite(vector)) {
            let message = format!("element {i} is not a finite number");
            return Err(Fault::json(here, message));
        }
        Ok(values.into_flattened())
    }

    /// Reads the elements of an accessor. `convert` makes a value from the N numbers of an element. If the elements
    /// have fewer than N components, the missing components are set to `fill`. Normalized unsigned integers are scaled
    /// to the range from 0 to 1, and normalized signed integers to the range from -1 to 1.
    ///
    /// # Errors
    ///
    /// Returns an error if the type of the accessor is not in `types`, the accessor exceeds its buffer, or a value is
    /// not finite. `pointer` is the JSON pointer to the index that refers to the accessor, for errors.
    pub(super) fn vectors<const N: usize, T: Value>(
        &self,
        index: usize,
        pointer: &str,
        types: &[Type],
        fill: f64,
        convert: impl Fn([f64; N]) -> T + Sync,
    ) -> Result<Vec<T>, Fault> {
        let accessor = self.accessor(index, pointer)?;
        let here = format!("/accessors/{index}");
        let (kind, component) = kinds(accessor, &here)?;
        if !types.contains(&kind) {
            let message = format!("expected {}, found {}", one_of(types), type_name(kind));
            return Err(Fault::json(format!("{here}/type"), message));
        }
        let used = kind.multiplicity().min(N);
        let size = component.size();
        // While the elements are read, a flag records only whether any value is non-finite. If so, the elements are
        // read again to find the index of the first such value.
        let has_non_finite = AtomicBool::new(false);
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
                has_non_finite.store(true, Relaxed);
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
        if has_non_finite.into_inner() {
            let finite = |bytes: &[u8]| i32::from(general(bytes).iter().all(|x| x.is_finite()));
            let finite = self.elements(index, multiplicity, component, 1, finite)?;
            // If sparse values have replaced all non-finite values, there is no error.
            if let Some(i) = finite.iter().position(|&is| is == 0) {
                let message = format!("element {i} is not a finite number");
                return Err(Fault::json(here, message));
            }
        }
        Ok(values)
    }

    /// Reads the elements of an accessor of indices.
    ///
    /// # Errors
    ///
    /// Returns an error in the same cases as [`vectors`](Self::vectors).
    pub(super) fn indices(&self, index: usize, pointer: &str) -> Result<Vec<u32>, Fault> {
        let accessor = self.accessor(index, pointer)?;
        let here = format!("/accessors/{index}");
        let (kind, component) = kinds(accessor, &here)?;
        if kind != Type::Scalar {
            let message = format!("expected SCALAR for indices, found {}", type_name(kind));
            return Err(Fault::json(format!("{here}/type"), message));
        }
        match component {
            ComponentType::U8 | ComponentType::U16 => {
                self.elements(index, 1, component, 0, |bytes| whole(bytes, component))
            }
            // The constant component type allows the compiler to replace the loop with a copy of memory.
            ComponentType::U32 => self.elements(index, 1, component, 0, |bytes| {
                whole(bytes, ComponentType::U32)
            }),
            _ => {
                let message = "expected unsigned integers for indices";
                Err(Fault::json(format!("{here}/componentType"), message))
            }
        }
    }

    /// Reads all elements of an accessor from its buffer view. If the accessor has no view, all elements are `zero`.
    /// Then the sparse values of the accessor replace some of the elements.
    fn elements<T: Copy + Zeroable + Send>(
        &self,
        index: usize,
        components: usize,
        component: ComponentType,
        zero: T,
        value: impl Fn(&[u8]) -> T + Sync,
    ) -> Result<Vec<T>, Fault> {
        let size = components * component.size();
        self.blocks(index, size, zero, &|rows, elements| {
            if rows.stride == size {
                for (slot, bytes) in elements.iter_mut().zip(rows.bytes.chunks_exact(size)) {
                    *slot = value(bytes);
                }
            } else {
                for (slot, bytes) in elements.iter_mut().zip(rows.iter()) {
                    *slot = value(bytes);
                }
            }
        })
    }

    /// Reads all elements in blocks, in parallel. `size` is the number of bytes of an element.
    fn blocks<T: Copy + Zeroable + Send>(
        &self,
        index: usize,
        size: usize,
        zero: T,
        read: &(dyn Fn(Rows, &mut [T]) + Sync),
    ) -> Result<Vec<T>, Fault> {
        let (rows, n) = self.dense(index, size, size_of::<T>())?;
        let mut elements = match rows {
            Some(rows) => {
                let mut elements = mesh::zeroed::<T>(n);
                parallel::fill(&mut elements, |first, elements| {
                    read(rows.block(first, elements.len()), elements);
                });
                elements
            }
            None => vec![zero; n],
        };
        if let Some((targets, rows)) = self.sparse(index, size)? {
            for (i, target) in targets.into_iter().enumerate() {
                read(rows.block(i, 1), &mut elements[target as usize..][..1]);
            }
        }
        Ok(elements)
    }

    /// Returns the rows of an accessor and the number of its elements. The rows are the bytes of the elements in the
    /// buffer view. The rows are `None` if the accessor has no view.
    fn dense(
        &self,
        index: usize,
        size: usize,
        element_size: usize,
    ) -> Result<(Option<Rows<'_>>, usize), Fault> {
        let accessor = &self.document.accessors[index];
        let here = format!("/accessors/{index}");
        let count = accessor.count.0;
        let bytes = count.saturating_mul(element_size as u64);
        let (rows, n) = if let Some(view) = accessor.buffer_view {
            let offset = accessor.byte_offset.unwrap_or_default().0;
            let rows = self.rows(view.value(), offset, count, size, &here)?;
            (Some(rows), rows.count)
        } else {
            (None, self.zeros(count, &here)?)
        };
        self.budget.spend(bytes, &here)?;
        Ok((rows, n))
    }

    /// Sparse values replace some elements of an accessor. Returns the indices of the replaced elements, and the bytes
    /// of the sparse values. Returns `None` if the accessor has no sparse values.
    fn sparse(&self, index: usize, size: usize) -> Result<Option<(Vec<u32>, Rows<'_>)>, Fault> {
        let accessor = &self.document.accessors[index];
        let Some(sparse) = &accessor.sparse else {
            return Ok(None);
        };
        let here = format!("/accessors/{index}/sparse");
        let Checked::Valid(IndexComponentType(index_type)) = sparse.indices.component_type else {
            let pointer = format!("{here}/indices/componentType");
            return Err(Fault::json(
                pointer,
                "expected unsigned integers for indices",
            ));
        };
        let n = sparse.count.0;
        // Sparse values need no additional memory. Their size is subtracted from the memory budget each time the
        // accessor is read, to limit the total time for reading.
        self.budget.spend(n.saturating_mul(size as u64), &here)?;
        let (indices, values) = (&sparse.indices, &sparse.values);
        let (at, view) = (format!("{here}/indices"), indices.buffer_view.value());
        let targets = self.rows(view, indices.byte_offset.0, n, index_type.size(), &at)?;
        let targets: Vec<u32> = targets
            .iter()
            .map(|target| whole(target, index_type))
            .collect();
        let count = accessor.count.0;
        if let Some(target) = targets.iter().find(|&&target| u64::from(target) >= count) {
            let message = format!(
                "a sparse index refers to element {target}, but the accessor has only {count} elements"
            );
            return Err(Fault::json(at, message));
        }
        let (at, view) = (format!("{here}/values"), values.buffer_view.value());
        let values = self.rows(view, values.byte_offset.0, n, size, &at)?;
        Ok(Some((targets, values)))
    }

    /// Checks that an accessor without a buffer view does not declare too many elements, and returns the number of
    /// elements as a `usize`.
    fn zeros(&self, count: u64, here: &str) -> Result<usize, Fault> {
        let all: u64 = self.buffers.iter().map(|buffer| buffer.len() as u64).sum();
        let limit = all.max(MIN_ZEROS);
        let allowed = usize::try_from(count).ok().filter(|_| count <= limit);
        allowed.ok_or_else(|| {
            let message = format!(
                "the accessor declares {count} elements without a buffer view, but a file of this size can \
                have at most {limit}"
            );
            Fault::json(format!("{here}/count"), message)
        })
    }
}
