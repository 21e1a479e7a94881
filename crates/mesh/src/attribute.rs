//! Attributes: named, typed columns of values on vertices, corners, edges and faces.
//!
//! A column holds one value for each element of its domain and a [`Rule`] that says what edits do
//! with the values. The values of a corner are stored at its half-edge: the one that leaves the
//! corner's vertex and lies on its face. Half-edges without a face have a value too, which means
//! nothing and is kept at zero where that is cheap.
//!
//! Well-known attributes have constants ([`UV`], [`VERTEX_NORMAL`], ...); any other name is free.

use std::fmt;
use std::marker::PhantomData;

use glam::{DVec2, DVec3, DVec4};
use rayon::prelude::*;

use crate::{EdgeId, FaceId, HalfEdgeId, Id, VertexId};

/// Texture coordinates of corners.
pub const UV: Attribute<HalfEdgeId, DVec2> = Attribute::new("uv", Rule::Interpolate);
/// Unit normals of vertices.
pub const VERTEX_NORMAL: Attribute<VertexId, DVec3> = Attribute::new("normal", Rule::Normal);
/// Unit normals of corners: normals that differ between the faces around a vertex.
pub const CORNER_NORMAL: Attribute<HalfEdgeId, DVec3> = Attribute::new("normal", Rule::Normal);
/// Unit tangents of vertices, along one direction of the surface.
pub const TANGENT: Attribute<VertexId, DVec3> = Attribute::new("tangent", Rule::Normal);
/// Red, green, blue and alpha of vertices, from 0 to 1.
pub const COLOR: Attribute<VertexId, DVec4> = Attribute::new("color", Rule::Interpolate);
/// The place of a face's material in the list of its object, from 0; -1 for none.
pub const MATERIAL: Attribute<FaceId, i32> = Attribute::new("material", Rule::Copy);
/// The smoothing group of a face; 0 for none.
pub const SMOOTHING: Attribute<FaceId, i32> = Attribute::new("smoothing", Rule::Copy);
/// The sharpness of an edge, from 0 (smooth) to 10 (infinitely sharp).
pub const CREASE: Attribute<EdgeId, f64> = Attribute::new("crease", Rule::Copy);
/// The sharpness of a vertex, from 0 (smooth) to 10 (infinitely sharp).
pub const CORNER: Attribute<VertexId, f64> = Attribute::new("corner", Rule::Copy);

/// What the values of a column belong to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Domain {
    /// One value for each vertex.
    Vertex,
    /// One value for each half-edge: the corner of its face at its origin.
    Corner,
    /// One value for each edge.
    Edge,
    /// One value for each face.
    Face,
}

impl Domain {
    /// All four domains.
    pub const ALL: [Self; 4] = [Self::Vertex, Self::Corner, Self::Edge, Self::Face];
}

impl fmt::Display for Domain {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Vertex => "vertex",
            Self::Corner => "corner",
            Self::Edge => "edge",
            Self::Face => "face",
        })
    }
}

/// What an edit does with the values of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// A new element gets the weighted mean of the elements it comes from.
    Interpolate,
    /// A unit vector: interpolated, then scaled to length 1; turned by transforms; dropped by
    /// operations that move vertices in another way, because it would be wrong afterwards.
    Normal,
    /// A new element gets the value of the one element it is a part of, or the zero value if there
    /// is none: the halves of a split edge are tagged as the edge was, an edge inside a face is not.
    Copy,
    /// The column is removed by the first edit that changes connectivity.
    Drop,
}

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
            let mut new = crate::zeroed::<T>(n);
            new.par_iter_mut()
                .with_min_len(crate::blocks::BLOCK)
                .enumerate()
                .for_each(|(i, slot)| {
                    if let Some(s) = source(i) {
                        *slot = old[s];
                    }
                });
            T::wrap(new)
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
            let mut new = crate::zeroed::<T>(n);
            new.par_iter_mut()
                .with_min_len(crate::blocks::BLOCK)
                .enumerate()
                .for_each(|(i, slot)| {
                    weights(i, &mut |source, w| *slot = add(*slot, old[source], w));
                });
            T::wrap(new)
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
    fn grow(&mut self, n: usize) {
        fn run<T: Value>(v: &mut Vec<T>, n: usize) {
            v.resize(n, T::default());
        }
        each!(self, v => run(v, n));
    }

    fn copy(&mut self, from: usize, to: usize) {
        each!(self, v => v[to] = v[from]);
    }

    /// Sets the value at `i` to the only one of `other`, which has the same type.
    fn set(&mut self, i: usize, other: &Self) {
        match (self, other) {
            (Self::Float(a), Self::Float(b)) => a[i] = b[0],
            (Self::Vec2(a), Self::Vec2(b)) => a[i] = b[0],
            (Self::Vec3(a), Self::Vec3(b)) => a[i] = b[0],
            (Self::Vec4(a), Self::Vec4(b)) => a[i] = b[0],
            (Self::Int(a), Self::Int(b)) => a[i] = b[0],
            (Self::Tag(a), Self::Tag(b)) => a[i] = b[0],
            _ => unreachable!("blended from the same column"),
        }
    }

    /// Puts the numbers of the value at `i` behind `numbers`.
    pub(crate) fn push_numbers(&self, i: usize, numbers: &mut Vec<f64>) {
        match self {
            Self::Float(v) => numbers.push(v[i]),
            Self::Vec2(v) => numbers.extend(v[i].to_array()),
            Self::Vec3(v) => numbers.extend(v[i].to_array()),
            Self::Vec4(v) => numbers.extend(v[i].to_array()),
            Self::Int(v) => numbers.push(f64::from(v[i])),
            Self::Tag(v) => numbers.push(f64::from(u8::from(v[i]))),
        }
    }

    /// Takes the numbers of the value at `i` from the end of `numbers`, as
    /// [`push_numbers`](Self::push_numbers) put them there.
    pub(crate) fn pop_numbers(&mut self, i: usize, numbers: &mut Vec<f64>) {
        let mut pop = || numbers.pop().expect("pushed before");
        // The last component was pushed last.
        match self {
            Self::Float(v) => v[i] = pop(),
            Self::Vec2(v) => (v[i].y, v[i].x) = (pop(), pop()),
            Self::Vec3(v) => (v[i].z, v[i].y, v[i].x) = (pop(), pop(), pop()),
            Self::Vec4(v) => (v[i].w, v[i].z, v[i].y, v[i].x) = (pop(), pop(), pop(), pop()),
            #[expect(clippy::cast_possible_truncation, reason = "it was an i32")]
            Self::Int(v) => v[i] = pop() as i32,
            Self::Tag(v) => v[i] = pop() != 0.0,
        }
    }

    /// Takes the values from `n` on away and returns them.
    pub(crate) fn split_off(&mut self, n: usize) -> Self {
        match self {
            Self::Float(v) => Self::Float(v.split_off(n)),
            Self::Vec2(v) => Self::Vec2(v.split_off(n)),
            Self::Vec3(v) => Self::Vec3(v.split_off(n)),
            Self::Vec4(v) => Self::Vec4(v.split_off(n)),
            Self::Int(v) => Self::Int(v.split_off(n)),
            Self::Tag(v) => Self::Tag(v.split_off(n)),
        }
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
        match (self, other) {
            (Self::Float(a), Self::Float(b)) => a.extend_from_slice(b),
            (Self::Vec2(a), Self::Vec2(b)) => a.extend_from_slice(b),
            (Self::Vec3(a), Self::Vec3(b)) => a.extend_from_slice(b),
            (Self::Vec4(a), Self::Vec4(b)) => a.extend_from_slice(b),
            (Self::Int(a), Self::Int(b)) => a.extend_from_slice(b),
            (Self::Tag(a), Self::Tag(b)) => a.extend_from_slice(b),
            _ => return false,
        }
        true
    }

    /// The weighted mean of two values, for the kinds that have one.
    fn mix(&mut self, a: usize, b: usize, t: f64, to: usize) {
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
pub trait Value: Copy + Default + PartialEq + Send + Sync + bytemuck::Zeroable + 'static {
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
                if let Values::$kind(v) = values {
                    Some(v)
                } else {
                    None
                }
            }
            fn of_mut(values: &mut Values) -> Option<&mut [Self]> {
                if let Values::$kind(v) = values {
                    Some(v)
                } else {
                    None
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

/// The name, domain, type and rule of an attribute, known when the program is compiled.
#[derive(Debug)]
pub struct Attribute<I, T> {
    /// The name of the column.
    pub name: &'static str,
    /// What edits do with its values.
    pub rule: Rule,
    kind: PhantomData<fn() -> (I, T)>,
}

impl<I, T> Attribute<I, T> {
    /// An attribute of this name and rule.
    pub const fn new(name: &'static str, rule: Rule) -> Self {
        Self {
            name,
            rule,
            kind: PhantomData,
        }
    }
}

impl<I, T> Clone for Attribute<I, T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<I, T> Copy for Attribute<I, T> {}

/// One attribute: a name, a rule and a value for each element of a domain.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// The name, unique in its domain.
    pub name: String,
    /// What edits do with the values.
    pub rule: Rule,
    /// The values.
    pub values: Values,
}

/// All attributes of a mesh, in order of their names in each domain.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Attributes {
    columns: [Vec<Column>; 4],
}

/// All columns with their domains, in the order of [`Attributes::iter`].
impl IntoIterator for Attributes {
    type Item = (Domain, Column);
    type IntoIter = std::vec::IntoIter<(Domain, Column)>;

    fn into_iter(self) -> Self::IntoIter {
        let domains = Domain::ALL.into_iter().zip(self.columns);
        let columns = domains.flat_map(|(d, columns)| columns.into_iter().map(move |c| (d, c)));
        columns.collect::<Vec<_>>().into_iter()
    }
}

/// For each element of a new mesh the element of the old one that it takes its values from,
/// `NONE` for zero values.
#[derive(Clone, Copy, Debug)]
pub struct Sources<'a> {
    /// One for each new vertex.
    pub vertices: &'a [VertexId],
    /// One for each new half-edge.
    pub corners: &'a [HalfEdgeId],
    /// One for each new edge.
    pub edges: &'a [EdgeId],
    /// One for each new face.
    pub faces: &'a [FaceId],
}

impl Attributes {
    /// The columns of a domain, in order of their names.
    pub fn of(&self, domain: Domain) -> &[Column] {
        &self.columns[domain as usize]
    }

    /// All columns with their domains, in a fixed order.
    pub fn iter(&self) -> impl Iterator<Item = (Domain, &Column)> {
        Domain::ALL
            .into_iter()
            .flat_map(|d| self.of(d).iter().map(move |c| (d, c)))
    }

    /// The column of this domain and name.
    pub fn column(&self, domain: Domain, name: &str) -> Option<&Column> {
        self.of(domain).iter().find(|c| c.name == name)
    }

    pub(crate) fn of_mut(&mut self, domain: Domain) -> &mut [Column] {
        &mut self.columns[domain as usize]
    }

    pub(crate) fn column_mut(&mut self, domain: Domain, name: &str) -> Option<&mut Column> {
        self.columns[domain as usize]
            .iter_mut()
            .find(|c| c.name == name)
    }

    /// Puts a column into a domain, in place of one of the same name. Its length must be that of
    /// the domain in the mesh that gets these attributes.
    pub fn insert(&mut self, domain: Domain, column: Column) {
        let columns = &mut self.columns[domain as usize];
        match columns.binary_search_by(|c| c.name.cmp(&column.name)) {
            Ok(i) => columns[i] = column,
            Err(i) => columns.insert(i, column),
        }
    }

    /// Takes a column out.
    pub fn remove(&mut self, domain: Domain, name: &str) -> Option<Column> {
        let columns = &mut self.columns[domain as usize];
        columns
            .iter()
            .position(|c| c.name == name)
            .map(|i| columns.remove(i))
    }

    /// The same columns on a new mesh, each value taken from the element that it came from.
    #[must_use]
    pub fn gathered(&self, sources: Sources) -> Self {
        fn run<I: Id>(columns: &[Column], from: &[I]) -> Vec<Column> {
            let source = |i: usize| (from[i] != I::NONE).then(|| from[i].index());
            columns
                .iter()
                .map(|c| Column {
                    values: c.values.gather(from.len(), source),
                    ..c.clone_empty()
                })
                .collect()
        }
        Self {
            columns: [
                run(self.of(Domain::Vertex), sources.vertices),
                run(self.of(Domain::Corner), sources.corners),
                run(self.of(Domain::Edge), sources.edges),
                run(self.of(Domain::Face), sources.faces),
            ],
        }
    }

    /// Puts the values of `other` behind these. `lens` are the counts of elements of this mesh,
    /// `other_lens` those of the other. A column that only one of the two has gets zero values for
    /// the other's elements; of columns with one name and two types the second is left out, and its
    /// domain and name are returned.
    pub fn append(
        &mut self,
        lens: [usize; 4],
        other: &Self,
        other_lens: [usize; 4],
    ) -> Vec<(Domain, String)> {
        let mut left_out = Vec::new();
        for domain in Domain::ALL {
            let (len, other_len) = (lens[domain as usize], other_lens[domain as usize]);
            for column in other.of(domain) {
                if self.column(domain, &column.name).is_none() {
                    let values = column.values.gather(len, |_| None);
                    self.insert(
                        domain,
                        Column {
                            values,
                            ..column.clone_empty()
                        },
                    );
                }
                let mine = self
                    .column_mut(domain, &column.name)
                    .expect("inserted above");
                if !mine.values.append(&column.values) {
                    left_out.push((domain, column.name.clone()));
                }
            }
            for column in &mut self.columns[domain as usize] {
                column.values.grow(len + other_len);
            }
        }
        left_out
    }

    /// Grows all columns of a domain to `n` values.
    pub(crate) fn grow(&mut self, domain: Domain, n: usize) {
        for column in &mut self.columns[domain as usize] {
            column.values.grow(n);
        }
    }

    /// Gives element `to` the values of element `from`.
    pub(crate) fn copy<I: Id>(&mut self, from: I, to: I) {
        for column in &mut self.columns[I::DOMAIN as usize] {
            column.values.copy(from.index(), to.index());
        }
    }

    /// Exchanges the values of two elements.
    pub(crate) fn swap<I: Id>(&mut self, a: I, b: I) {
        for column in &mut self.columns[I::DOMAIN as usize] {
            each!(&mut column.values, v => v.swap(a.index(), b.index()));
        }
    }

    /// Whether a domain has a column of normals.
    pub(crate) fn has_normals(&self, domain: Domain) -> bool {
        self.of(domain).iter().any(|c| c.rule == Rule::Normal)
    }

    /// Turns the normals of an element over.
    pub(crate) fn turn_over<I: Id>(&mut self, element: I) {
        for column in &mut self.columns[I::DOMAIN as usize] {
            if let Some(normals) = column.normals_mut() {
                normals[element.index()] = DVec3::ZERO - normals[element.index()];
            }
        }
    }

    /// Gives element `to`, which lies between `a` and `b`, the values that the rules say.
    pub(crate) fn mix<I: Id>(&mut self, a: I, b: I, t: f64, to: I) {
        for column in &mut self.columns[I::DOMAIN as usize] {
            column.mix(a.index(), b.index(), t, to.index());
        }
    }

    /// Gives corner `to`, in each column where it has the value of a corner `sides[_][end]`, the value
    /// between the two corners of that side. None of them is `to`.
    pub(crate) fn follow(
        &mut self,
        sides: [Option<[HalfEdgeId; 2]>; 2],
        end: usize,
        t: f64,
        to: HalfEdgeId,
    ) {
        for column in &mut self.columns[Domain::Corner as usize] {
            let is_same =
                |side: &&[HalfEdgeId; 2]| column.values.same(side[end].index(), to.index());
            if let Some([a, b]) = sides.iter().flatten().find(is_same) {
                column.mix(a.index(), b.index(), t, to.index());
            }
        }
    }

    /// Gives edge `to` the larger number and the mark of either of two edges.
    pub(crate) fn merge(&mut self, from: EdgeId, to: EdgeId) {
        let (from, to) = (from.index(), to.index());
        for column in &mut self.columns[Domain::Edge as usize] {
            match &mut column.values {
                Values::Float(v) if v[from] > v[to] => v[to] = v[from],
                Values::Tag(v) => v[to] |= v[from],
                _ => {}
            }
        }
    }

    /// Gives element `to` the mean of the values of `from`, where the rules say interpolate.
    pub(crate) fn average<I: Id>(&mut self, from: &[I], to: I) {
        for column in &mut self.columns[I::DOMAIN as usize] {
            if matches!(column.rule, Rule::Interpolate | Rule::Normal) {
                let weight = 1.0 / from.len().max(1) as f64;
                let weights = |_: usize, add: &mut dyn FnMut(usize, f64)| {
                    for i in from {
                        add(i.index(), weight);
                    }
                };
                let mean = column.values.blend(1, weights);
                column.values.set(to.index(), &mean);
                column.normalize(to.index());
            }
        }
    }

    /// The domain and name of a column whose rule is [`Rule::Drop`].
    #[inline]
    pub(crate) fn first_to_drop(&self) -> Option<(Domain, String)> {
        self.iter()
            .find(|(_, c)| c.rule == Rule::Drop)
            .map(|(domain, c)| (domain, c.name.clone()))
    }

    /// Whether any corner column has different values at `a` and `b`.
    pub(crate) fn corners_differ(&self, a: HalfEdgeId, b: HalfEdgeId) -> bool {
        self.of(Domain::Corner)
            .iter()
            .any(|c| !c.values.same(a.index(), b.index()))
    }

    /// Removes the columns whose rule is [`Rule::Drop`]: for whatever changes connectivity.
    pub fn drop_by_rule(&mut self) {
        for columns in &mut self.columns {
            columns.retain(|c| c.rule != Rule::Drop);
        }
    }
}

impl Column {
    /// Gives element `to`, which lies between `a` and `b`, the value that the rule says.
    fn mix(&mut self, a: usize, b: usize, t: f64, to: usize) {
        if matches!(self.rule, Rule::Interpolate | Rule::Normal) {
            self.values.mix(a, b, t, to);
            self.normalize(to);
        }
    }

    /// The values, if they are normals.
    fn normals_mut(&mut self) -> Option<&mut [DVec3]> {
        match (self.rule, &mut self.values) {
            (Rule::Normal, Values::Vec3(normals)) => Some(normals),
            _ => None,
        }
    }

    /// Scales the value at `i` to length 1 if the rule asks for that.
    fn normalize(&mut self, i: usize) {
        if let Some(normals) = self.normals_mut() {
            normals[i] = normals[i].normalize_or_zero();
        }
    }

    /// Turns all values over if they are normals. A difference, so that 0 stays 0 and not -0.
    pub(crate) fn turn_over(&mut self) {
        for normal in self.normals_mut().into_iter().flatten() {
            *normal = DVec3::ZERO - *normal;
        }
    }

    /// A column of the same name, rule and type without values.
    fn clone_empty(&self) -> Self {
        Self {
            name: self.name.clone(),
            rule: self.rule,
            values: self.values.gather(0, |_| None),
        }
    }
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

    #[test]
    fn appending_fills_what_one_side_lacks() {
        let mut a = Attributes::default();
        a.insert(
            Domain::Face,
            Column {
                name: "x".into(),
                rule: Rule::Copy,
                values: Values::Int(vec![1]),
            },
        );
        let mut b = Attributes::default();
        b.insert(
            Domain::Face,
            Column {
                name: "y".into(),
                rule: Rule::Copy,
                values: Values::Tag(vec![true, true]),
            },
        );
        assert_eq!(a.append([0, 0, 0, 1], &b, [0, 0, 0, 2]), vec![]);
        assert_eq!(
            a.column(Domain::Face, "x").unwrap().values,
            Values::Int(vec![1, 0, 0])
        );
        let tags = Values::Tag(vec![false, true, true]);
        assert_eq!(a.column(Domain::Face, "y").unwrap().values, tags);
    }
}
