//! The values of a column, of any supported type.

use bytemuck::{CheckedBitPattern, NoUninit, Zeroable};
use glam::{DVec2, DVec3, DVec4};

use crate::parallel;

/// A function that gets the index of a new value and a callback. For each old value that contributes to the new value,
/// the function calls the callback with the index and the weight of the old value.
type Weights<'a> = dyn Fn(usize, &mut dyn FnMut(usize, f64)) + Sync + 'a;

/// In a list with the source of each new value, this entry means that the new value has no source and is zero.
const NO_SOURCE: usize = usize::MAX;

/// The values of a column, one for each element of its domain.
#[derive(Debug, PartialEq)]
pub enum Values {
    /// One number for each element.
    Float(Vec<f64>),
    /// A vector of two numbers for each element.
    Vec2(Vec<DVec2>),
    /// A vector of three numbers for each element.
    Vec3(Vec<DVec3>),
    /// A vector of four numbers for each element.
    Vec4(Vec<DVec4>),
    /// A whole number for each element.
    Int(Vec<i32>),
    /// The flags of a tag, which is a named selection.
    Tag(Vec<bool>),
}

/// Runs `$body` with `$v` bound to the vector inside `$values`, for any type of values.
macro_rules! each {
    ($values:expr, $v:ident => $body:expr) => {
        match $values {
            Values::Float($v) => $body,
            Values::Vec2($v) => $body,
            Values::Vec3($v) => $body,
            Values::Vec4($v) => $body,
            Values::Int($v) => $body,
            Values::Tag($v) => $body,
        }
    };
}

impl Clone for Values {
    fn clone(&self) -> Self {
        each!(self, v => Value::wrap(parallel::copied(v)))
    }
}

impl Values {
    /// Returns the number of values.
    pub fn len(&self) -> usize {
        each!(self, v => v.len())
    }

    /// Whether the list of values is empty.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns the size of all values in bytes.
    pub fn bytes(&self) -> usize {
        each!(self, v => size_of_val(v.as_slice()))
    }

    /// Returns the size of one value in bytes.
    pub fn bytes_per_value(&self) -> usize {
        fn run<T>(_: &[T]) -> usize {
            size_of::<T>()
        }
        each!(self, v => run(v))
    }

    /// Returns the number of components of one value: from 1 to 4.
    pub fn n_components(&self) -> usize {
        match self {
            Self::Float(_) | Self::Int(_) | Self::Tag(_) => 1,
            Self::Vec2(_) => 2,
            Self::Vec3(_) => 3,
            Self::Vec4(_) => 4,
        }
    }

    /// Returns a component of the value at `i` as a number. The flag of a tag is returned as 1 or 0.
    ///
    /// # Panics
    ///
    /// Panics if `i` or `component` is out of range.
    pub fn component(&self, i: usize, component: usize) -> f64 {
        match self {
            Self::Float(v) => v[i],
            Self::Vec2(v) => v[i][component],
            Self::Vec3(v) => v[i][component],
            Self::Vec4(v) => v[i][component],
            Self::Int(v) => v[i].into(),
            Self::Tag(v) => f64::from(u8::from(v[i])),
        }
    }

    /// Returns the name of the type of the values.
    pub fn type_name(&self) -> &'static str {
        match self {
            Self::Float(_) => "number",
            Self::Vec2(_) => "2 numbers",
            Self::Vec3(_) => "3 numbers",
            Self::Vec4(_) => "4 numbers",
            Self::Int(_) => "whole number",
            Self::Tag(_) => "tag",
        }
    }

    /// Returns `n` new values: value i is the old value at `source(i)`, or zero if `source(i)` is `None`.
    #[must_use]
    pub fn gather(&self, n: usize, source: impl Fn(usize) -> Option<usize> + Sync) -> Self {
        self.gather_blocks(n, &|first, sources| {
            for (i, slot) in (first..).zip(sources) {
                *slot = source(i).unwrap_or(NO_SOURCE);
            }
        })
    }

    /// Does the same as [`gather`](Self::gather), but takes a `dyn` closure: a generic function would be compiled again
    /// for each closure. `sources(i, list)` fills `list` with the sources of consecutive new values, beginning with new
    /// value i.
    fn gather_blocks(&self, n: usize, sources: &(dyn Fn(usize, &mut [usize]) + Sync)) -> Self {
        const SOURCES: usize = 128;
        fn run<T: Value>(
            old: &[T],
            n: usize,
            sources: &(dyn Fn(usize, &mut [usize]) + Sync),
        ) -> Values {
            let mut new = crate::zeroed::<T>(n);
            parallel::fill(&mut new, |first, new| {
                let mut from = [0; SOURCES];
                for (first, new) in (first..).step_by(SOURCES).zip(new.chunks_mut(SOURCES)) {
                    let from = &mut from[..new.len()];
                    sources(first, from);
                    for (slot, &source) in new.iter_mut().zip(&*from) {
                        if source != NO_SOURCE {
                            *slot = old[source];
                        }
                    }
                }
            });
            Value::wrap(new)
        }
        each!(self, v => run(v, n, sources))
    }

    /// Returns `n` new values, each a weighted sum of old values: `weights(i, add)` calls
    /// `add(source, weight)` for each term of new value i. Integers and tags cannot be interpolated: they get the value
    /// of the source with the largest weight. If several sources have the largest weight, the first of them
    /// is used.
    #[must_use]
    pub fn blend(
        &self,
        n: usize,
        weights: impl Fn(usize, &mut dyn FnMut(usize, f64)) + Sync,
    ) -> Self {
        self.blend_by(n, &weights)
    }

    fn blend_by(&self, n: usize, weights: &Weights) -> Self {
        fn sum<T: Value>(
            old: &[T],
            n: usize,
            add: impl Fn(T, T, f64) -> T + Sync,
            weights: &Weights,
        ) -> Values {
            let mut new = crate::zeroed::<T>(n);
            parallel::fill(&mut new, |first, new| {
                for (i, slot) in (first..).zip(new) {
                    weights(i, &mut |source, w| *slot = add(*slot, old[source], w));
                }
            });
            Value::wrap(new)
        }
        match self {
            Self::Float(v) => sum(v, n, |a, b, w| a + b * w, weights),
            Self::Vec2(v) => sum(v, n, |a, b, w| a + b * w, weights),
            Self::Vec3(v) => sum(v, n, |a, b, w| a + b * w, weights),
            Self::Vec4(v) => sum(v, n, |a, b, w| a + b * w, weights),
            Self::Int(_) | Self::Tag(_) => self.gather(n, |i| {
                let mut best = None;
                weights(i, &mut |source, w| {
                    if best.is_none_or(|(_, max)| w > max) {
                        best = Some((source, w));
                    }
                });
                best.map(|(source, _)| source)
            }),
        }
    }

    /// Appends zeros until the list has `n` values.
    pub(super) fn grow(&mut self, n: usize) {
        fn run<T: Value>(v: &mut Vec<T>, n: usize) {
            v.resize(n, T::default());
        }
        each!(self, v => run(v, n));
    }

    pub(crate) fn copy(&mut self, from: usize, to: usize) {
        each!(self, v => v[to] = v[from]);
    }

    /// Exchanges two values.
    pub(crate) fn swap(&mut self, a: usize, b: usize) {
        each!(self, v => v.swap(a, b));
    }

    /// Sets the value at `i` to the first value of `other`, which must have the same type.
    pub(super) fn set(&mut self, i: usize, other: &Self) {
        each!(self, v => v[i] = Value::of(other).expect("blended from the same column")[0]);
    }

    /// Appends the bytes of the value at `i` to `bytes`.
    pub(crate) fn push_bytes(&self, i: usize, bytes: &mut Vec<u8>) {
        each!(self, v => bytes.extend(bytemuck::bytes_of(&v[i])));
    }

    /// Stores the last value of `bytes` at `i`, and removes the value from `bytes`. [`push_bytes`](Self::push_bytes)
    /// must have appended this value.
    pub(crate) fn pop_bytes(&mut self, i: usize, bytes: &mut Vec<u8>) {
        each!(self, v => v[i] = pop_value(bytes));
    }

    /// Removes and returns all values whose index is at least `n`.
    pub(crate) fn split_off(&mut self, n: usize) -> Self {
        each!(self, v => Value::wrap(v.split_off(n)))
    }

    /// Whether the values at `a` and `b` are equal.
    ///
    /// # Panics
    ///
    /// Panics if an index is out of range.
    pub fn are_equal(&self, a: usize, b: usize) -> bool {
        each!(self, v => v[a] == v[b])
    }

    /// Appends the values of `other`. Returns false, and changes nothing, if the values of `other` have a different
    /// type.
    pub fn append(&mut self, other: &Self) -> bool {
        each!(self, v => Value::of(other).map(|more| v.extend_from_slice(more)).is_some())
    }

    /// Sets the value at `to` to the weighted mean of the values at `a` and `b`, where `t` is the weight of `b`.
    /// Integers and tags are not averaged: the value with the larger weight is used. If both weights are equal, the
    /// value at `b` is used.
    pub(super) fn mix(&mut self, a: usize, b: usize, t: f64, to: usize) {
        match self {
            Self::Float(v) => v[to] = v[a] * (1.0 - t) + v[b] * t,
            Self::Vec2(v) => v[to] = v[a] * (1.0 - t) + v[b] * t,
            Self::Vec3(v) => v[to] = v[a] * (1.0 - t) + v[b] * t,
            Self::Vec4(v) => v[to] = v[a] * (1.0 - t) + v[b] * t,
            Self::Int(v) => v[to] = v[if t < 0.5 { a } else { b }],
            Self::Tag(v) => v[to] = v[if t < 0.5 { a } else { b }],
        }
    }
}

/// A type that a column can hold.
pub trait Value:
    Copy + Default + PartialEq + Send + Sync + Zeroable + NoUninit + CheckedBitPattern + 'static
{
    /// Converts a list of values of this type to [`Values`].
    fn wrap(values: Vec<Self>) -> Values;
    /// Returns the list of values, if they have this type.
    fn of(values: &Values) -> Option<&[Self]>;
    /// Returns the values mutably, if they have this type.
    fn of_mut(values: &mut Values) -> Option<&mut [Self]>;
}

macro_rules! value {
    ($type:ty, $kind:ident) => {
        impl Value for $type {
            fn wrap(values: Vec<Self>) -> Values {
                Values::$kind(values)
            }
            fn of(values: &Values) -> Option<&[Self]> {
                match values {
                    Values::$kind(v) => Some(v),
                    _ => None,
                }
            }
            fn of_mut(values: &mut Values) -> Option<&mut [Self]> {
                match values {
                    Values::$kind(v) => Some(v),
                    _ => None,
                }
            }
        }
    };
}
value!(f64, Float);
value!(DVec2, Vec2);
value!(DVec3, Vec3);
value!(DVec4, Vec4);
value!(i32, Int);
value!(bool, Tag);

/// Removes a value from the end of `bytes` and returns it.
pub(crate) fn pop_value<T: CheckedBitPattern>(bytes: &mut Vec<u8>) -> T {
    let start = bytes.len() - size_of::<T>();
    let value = bytemuck::checked::pod_read_unaligned(&bytes[start..]);
    bytes.truncate(start);
    value
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gathered_values_come_from_their_sources_or_are_zero() {
        let values = Values::Int(vec![5, 6, 7]);
        let new = values.gather(4, |i| [Some(2), None, Some(0), Some(0)][i]);
        assert_eq!(new, Values::Int(vec![7, 0, 5, 5]));
    }

    #[test]
    fn blended_numbers_are_weighted_sums_and_blended_tags_have_the_largest_weight() {
        let weights = |_: usize, add: &mut dyn FnMut(usize, f64)| {
            add(0, 0.25);
            add(1, 0.75);
        };
        assert_eq!(
            Values::Float(vec![4.0, 8.0]).blend(1, weights),
            Values::Float(vec![7.0])
        );
        assert_eq!(
            Values::Tag(vec![false, true]).blend(1, weights),
            Values::Tag(vec![true])
        );
    }
}
