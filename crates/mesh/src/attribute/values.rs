//! The values of a column, whatever their type.

use bytemuck::{CheckedBitPattern, NoUninit, Zeroable};
use glam::{DVec2, DVec3, DVec4};
use rayon::prelude::*;

/// The values of a column, one for each element of its domain.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Numbers.
    Float(Vec<f64>),
    /// Pairs of numbers.
    Vec2(Vec<DVec2>),
    /// Triples of numbers.
    Vec3(Vec<DVec3>),
    /// Quadruples of numbers.
    Vec4(Vec<DVec4>),
    /// Whole numbers.
    Int(Vec<i32>),
    /// Marks: a named selection.
    Tag(Vec<bool>),
}

/// Runs `$body` with `$v` bound to the vector inside `$values`, whatever its type.
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

impl Values {
    /// How many values there are.
    pub fn len(&self) -> usize {
        each!(self, v => v.len())
    }

    /// Whether there are no values.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The bytes that the values take.
    pub fn bytes(&self) -> usize {
        each!(self, v => size_of_val(v.as_slice()))
    }

    /// The bytes that one value takes.
    pub fn bytes_each(&self) -> usize {
        fn run<T>(_: &[T]) -> usize {
            size_of::<T>()
        }
        each!(self, v => run(v))
    }

    /// The name of the type of the values.
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

    /// New values of length `n`: the i-th is the value at `source(i)`, or zero where that is `None`.
    #[must_use]
    pub fn gather(&self, n: usize, source: impl Fn(usize) -> Option<usize> + Sync) -> Self {
        fn run<T: Value>(
            old: &[T],
            n: usize,
            source: impl Fn(usize) -> Option<usize> + Sync,
        ) -> Values {
            filled(n, |i, slot: &mut T| {
                if let Some(s) = source(i) {
                    *slot = old[s];
                }
            })
        }
        each!(self, v => run(v, n, source))
    }

    /// New values of length `n`: `weights(i, add)` calls `add(source, weight)` for each value that the
    /// i-th is a sum of. Whole numbers and tags cannot be added: for them the source of the
    /// largest weight is taken, the first of equals.
    #[must_use]
    pub fn blend(
        &self,
        n: usize,
        weights: impl Fn(usize, &mut dyn FnMut(usize, f64)) + Sync,
    ) -> Self {
        fn sum<T: Value>(
            old: &[T],
            n: usize,
            add: impl Fn(T, T, f64) -> T + Sync,
            weights: impl Fn(usize, &mut dyn FnMut(usize, f64)) + Sync,
        ) -> Values {
            filled(n, |i, slot: &mut T| {
                weights(i, &mut |source, w| *slot = add(*slot, old[source], w));
            })
        }
        match self {
            Self::Float(v) => sum(v, n, |a, b, w| a + b * w, weights),
            Self::Vec2(v) => sum(v, n, |a, b, w| a + b * w, weights),
            Self::Vec3(v) => sum(v, n, |a, b, w| a + b * w, weights),
            Self::Vec4(v) => sum(v, n, |a, b, w| a + b * w, weights),
            Self::Int(_) | Self::Tag(_) => self.gather(n, |i| {
                let mut best = None;
                weights(i, &mut |source, w| {
                    if best.is_none_or(|(_, most)| w > most) {
                        best = Some((source, w));
                    }
                });
                best.map(|(source, _)| source)
            }),
        }
    }

    /// Adds zero values until there are `n`.
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

    /// Sets the value at `i` to the only one of `other`, which has the same type.
    pub(super) fn set(&mut self, i: usize, other: &Self) {
        each!(self, v => v[i] = Value::of(other).expect("blended from the same column")[0]);
    }

    /// Puts the bytes of the value at `i` behind `bytes`.
    pub(crate) fn push_bytes(&self, i: usize, bytes: &mut Vec<u8>) {
        each!(self, v => bytes.extend(bytemuck::bytes_of(&v[i])));
    }

    /// Takes the value at `i` from the end of `bytes`, where [`push_bytes`](Self::push_bytes) put it.
    pub(crate) fn pop_bytes(&mut self, i: usize, bytes: &mut Vec<u8>) {
        each!(self, v => v[i] = pop_value(bytes));
    }

    /// Takes the values from `n` on away and returns them.
    pub(crate) fn split_off(&mut self, n: usize) -> Self {
        each!(self, v => Value::wrap(v.split_off(n)))
    }

    /// Whether the values at `a` and `b` are equal.
    ///
    /// # Panics
    ///
    /// If there is no such value.
    pub fn same(&self, a: usize, b: usize) -> bool {
        each!(self, v => v[a] == v[b])
    }

    pub(crate) fn append(&mut self, other: &Self) -> bool {
        each!(self, v => Value::of(other).map(|more| v.extend_from_slice(more)).is_some())
    }

    /// The weighted mean of two values, for the kinds that have one.
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
    /// Values of this type.
    fn wrap(values: Vec<Self>) -> Values;
    /// The values, if they are of this type.
    fn of(values: &Values) -> Option<&[Self]>;
    /// The values to change, if they are of this type.
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

/// Takes a value from the end of `bytes`, where its bytes were put before.
pub(crate) fn pop_value<T: CheckedBitPattern>(bytes: &mut Vec<u8>) -> T {
    let start = bytes.len() - size_of::<T>();
    let value = bytemuck::checked::pod_read_unaligned(&bytes[start..]);
    bytes.truncate(start);
    value
}

/// Values that start at zero and are written by all threads.
fn filled<T: Value>(n: usize, fill: impl Fn(usize, &mut T) + Sync) -> Values {
    let mut new = crate::zeroed(n);
    new.par_iter_mut()
        .with_min_len(crate::blocks::BLOCK)
        .enumerate()
        .for_each(|(i, slot)| fill(i, slot));
    T::wrap(new)
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
    fn blended_numbers_are_weighted_sums_and_blended_tags_the_heaviest() {
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
