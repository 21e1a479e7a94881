//! Whole columns of values, decoded by all threads: what the types are is looked at once for each
//! column, not once for each value.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

use glam::{DVec2, DVec3, DVec4};
use mesh::{Value, Values, zeroed};
use rayon::prelude::*;

use super::table::{BLOCK, Table};
use super::types::{Scalar, number, with_scalar};

/// The type of a column of a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Tag,
    Int,
    Float,
    Vec2,
    Vec3,
    Vec4,
}

impl Kind {
    pub(super) fn of(values: &Values) -> Self {
        match values {
            Values::Tag(_) => Self::Tag,
            Values::Int(_) => Self::Int,
            Values::Float(_) => Self::Float,
            Values::Vec2(_) => Self::Vec2,
            Values::Vec3(_) => Self::Vec3,
            Values::Vec4(_) => Self::Vec4,
        }
    }

    /// How many numbers a value has.
    pub(super) fn size(self) -> usize {
        match self {
            Self::Tag | Self::Int | Self::Float => 1,
            Self::Vec2 => 2,
            Self::Vec3 => 3,
            Self::Vec4 => 4,
        }
    }

    /// The word for it in a comment.
    pub(super) fn word(self) -> &'static str {
        match self {
            Self::Tag => "tag",
            Self::Int => "int",
            Self::Float => "float",
            Self::Vec2 => "vec2",
            Self::Vec3 => "vec3",
            Self::Vec4 => "vec4",
        }
    }

    pub(super) fn parse(word: &str) -> Option<Self> {
        let all = [
            Self::Tag,
            Self::Int,
            Self::Float,
            Self::Vec2,
            Self::Vec3,
            Self::Vec4,
        ];
        all.into_iter().find(|kind| kind.word() == word)
    }
}

/// The whole number that a number of at most 32 bits is.
#[expect(
    clippy::cast_possible_truncation,
    reason = "the type of the property fits"
)]
fn to_int([x]: [f64; 1]) -> i32 {
    x as i32
}

/// The values of `kind` whose numbers are in the scalar properties from `first` on.
pub(super) fn values(table: &Table, first: usize, kind: Kind) -> Values {
    let next = |i: usize| first + i;
    match kind {
        Kind::Tag => Values::Tag(numbers(table, [first], |[x]| x != 0.0)),
        Kind::Int => Values::Int(numbers(table, [first], to_int)),
        Kind::Float => Values::Float(numbers(table, [first], |[x]| x)),
        Kind::Vec2 => Values::Vec2(numbers(table, std::array::from_fn(next), DVec2::from_array)),
        Kind::Vec3 => Values::Vec3(numbers(table, std::array::from_fn(next), DVec3::from_array)),
        Kind::Vec4 => Values::Vec4(numbers(table, std::array::from_fn(next), DVec4::from_array)),
    }
}

/// Decodes the rows from a number on, as many as there are values.
type Decode<'a, V> = Box<dyn Fn(usize, &mut [V]) + Sync + 'a>;

/// One value for each row, made of `N` scalar properties.
pub(super) fn numbers<const N: usize, V: Value>(
    table: &Table,
    properties: [usize; N],
    make: impl Fn([f64; N]) -> V + Sync,
) -> Vec<V> {
    let types = properties.map(|p| table.properties[p].value);
    // One parallel loop calls all of these: a loop for each type is what compilers take minutes for.
    let decode: Decode<V> = if types.iter().all(|&t| t == types[0]) {
        with_scalar!(types[0], table.big, S => alike::<S, N, V>(table, properties, &make))
    } else {
        Box::new(|first, out| {
            for (row, value) in (first..).zip(out) {
                *value = make(std::array::from_fn(|i| {
                    let at = table.at(properties[i], row);
                    number(types[i], table.big, &table.bytes[at..])
                }));
            }
        })
    };
    let mut out = zeroed(table.rows);
    let blocks = out.par_chunks_mut(BLOCK).enumerate();
    blocks.for_each(|(block, out)| decode(block * BLOCK, out));
    out
}

/// What decodes properties that all have the same type.
fn alike<'a, S: Scalar, const N: usize, V: Value>(
    table: &'a Table,
    properties: [usize; N],
    make: &'a (impl Fn([f64; N]) -> V + Sync),
) -> Decode<'a, V> {
    if let Some((stride, places)) = table.stride(properties) {
        Box::new(move |first, out| {
            let rows = table.bytes[first * stride..].chunks_exact(stride);
            for (value, row) in out.iter_mut().zip(rows) {
                *value = make(places.map(|at| S::number(&row[at..at + S::SIZE])));
            }
        })
    } else {
        Box::new(move |first, out| {
            for (row, value) in (first..).zip(out) {
                *value = make(properties.map(|p| S::number(&table.bytes[table.at(p, row)..])));
            }
        })
    }
}

/// Where the list of each row begins, and the items of all.
type Lists = (Vec<u32>, Vec<u32>);

/// The lists of a table one behind the other as vertices: where each begins, and the vertices.
///
/// # Errors
///
/// The row and the item of the first that is no vertex; `None` if there are too many for 32 bits.
pub(super) fn indices(
    table: &Table,
    property: usize,
    n_vertices: usize,
) -> Result<Lists, Option<(usize, usize)>> {
    let (offsets, total) = offsets(table, property).ok_or(None)?;
    let mut corners = zeroed::<u32>(total);
    let bad = AtomicBool::new(false);
    let limit = i64::try_from(n_vertices).unwrap_or(i64::MAX);
    let kind = table.properties[property].value;
    with_scalar!(kind, table.big, S => {
        for_blocks(&offsets, &mut corners, &|rows, mut out| {
            let mut all = true;
            for row in rows {
                let n = (offsets[row + 1] - offsets[row]) as usize;
                let at = table.at(property, row);
                let items = &table.bytes[at..at + n * S::SIZE];
                let (these, others) = out.split_at_mut(n);
                for (corner, item) in these.iter_mut().zip(items.chunks_exact(S::SIZE)) {
                    let v = S::whole(item);
                    all &= (0..limit).contains(&v);
                    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked above")]
                    {
                        *corner = v as u32;
                    }
                }
                out = others;
            }
            if !all {
                bad.store(true, Ordering::Relaxed);
            }
        });
    });
    if bad.into_inner() {
        let is_bad = |&(row, item): &(usize, usize)| {
            !(0..limit).contains(&item_at(table, property, row, item))
        };
        let items = |row| (0..table.count(property, row)).map(move |item| (row, item));
        return Err((0..table.rows).flat_map(items).find(is_bad));
    }
    Ok((offsets, corners))
}

/// The whole number that is an item of a list.
pub(super) fn item_at(table: &Table, property: usize, row: usize, item: usize) -> i64 {
    let kind = table.properties[property].value;
    let at = table.at(property, row) + item * kind.size();
    super::types::whole(kind, table.big, &table.bytes[at..])
}

/// Where the list of each row begins if all are written one behind the other, and how many items there
/// are; `None` if there are too many for 32 bits.
fn offsets(table: &Table, property: usize) -> Option<(Vec<u32>, usize)> {
    if let Some(n) = table.even_count(property) {
        let total = table.rows.checked_mul(n)?;
        if total >= u32::MAX as usize || table.rows >= u32::MAX as usize {
            return None;
        }
        let mut offsets = zeroed::<u32>(table.rows + 1);
        let place = |row: usize| u32::try_from(row * n).expect("the total fits");
        let all = offsets.par_iter_mut().with_min_len(BLOCK).enumerate();
        all.for_each(|(row, offset)| *offset = place(row));
        return Some((offsets, total));
    }
    let mut offsets = Vec::with_capacity(table.rows + 1);
    let mut total = 0_usize;
    offsets.push(0);
    for row in 0..table.rows {
        total += table.count(property, row);
        offsets.push(u32::try_from(total).ok().filter(|&n| n < u32::MAX)?);
    }
    Some((offsets, total))
}

/// Calls `work` with the rows of each block and the part of `out` that is theirs.
fn for_blocks<V: Send>(
    offsets: &[u32],
    out: &mut [V],
    work: &(dyn Fn(Range<usize>, &mut [V]) + Sync),
) {
    let rows = offsets.len() - 1;
    let mut blocks = Vec::with_capacity(rows.div_ceil(BLOCK));
    let mut rest = out;
    for first in (0..rows).step_by(BLOCK) {
        let end = rows.min(first + BLOCK);
        let (block, others) = rest.split_at_mut((offsets[end] - offsets[first]) as usize);
        blocks.push((first..end, block));
        rest = others;
    }
    blocks
        .into_par_iter()
        .for_each(|(rows, block)| work(rows, block));
}

/// Values of corners whose numbers are in a list of each face; zero for faces whose list has not as many
/// as their corners need. Returns how many such faces there are, too.
pub(super) fn corner_values(
    table: &Table,
    property: usize,
    faces: &[u32],
    kind: Kind,
) -> (Values, usize) {
    match kind {
        Kind::Tag => items(table, property, faces, |[x]| x != 0.0),
        Kind::Int => items(table, property, faces, to_int),
        Kind::Float => items(table, property, faces, |[x]| x),
        Kind::Vec2 => items(table, property, faces, DVec2::from_array),
        Kind::Vec3 => items(table, property, faces, DVec3::from_array),
        Kind::Vec4 => items(table, property, faces, DVec4::from_array),
    }
}

fn items<const N: usize, V: Value>(
    table: &Table,
    property: usize,
    faces: &[u32],
    make: impl Fn([f64; N]) -> V + Sync,
) -> (Values, usize) {
    let mut out = zeroed::<V>(faces[faces.len() - 1] as usize);
    let kind = table.properties[property].value;
    let degree = |f: usize| (faces[f + 1] - faces[f]) as usize;
    with_scalar!(kind, table.big, S => {
        for_blocks(faces, &mut out, &|rows, mut out| {
            for row in rows {
                let (these, others) = out.split_at_mut(degree(row));
                out = others;
                if table.count(property, row) != N * these.len() {
                    continue;
                }
                let at = table.at(property, row);
                let items = &table.bytes[at..at + N * these.len() * S::SIZE];
                for (value, numbers) in these.iter_mut().zip(items.chunks_exact(N * S::SIZE)) {
                    *value = make(std::array::from_fn(|i| S::number(&numbers[i * S::SIZE..])));
                }
            }
        });
    });
    let short = (0..table.rows).filter(|&row| table.count(property, row) != N * degree(row));
    (V::wrap(out), short.count())
}

/// Whether all numbers are finite.
pub(super) fn all_finite(values: &Values) -> bool {
    fn run<V: Sync>(values: &[V], finite: impl Fn(&V) -> bool + Sync + Send) -> bool {
        values.par_iter().with_min_len(BLOCK).all(finite)
    }
    match values {
        Values::Float(values) => run(values, |x| x.is_finite()),
        Values::Vec2(values) => run(values, |x| x.is_finite()),
        Values::Vec3(values) => run(values, |x| x.is_finite()),
        Values::Vec4(values) => run(values, |x| x.is_finite()),
        Values::Int(_) | Values::Tag(_) => true,
    }
}

/// Puts zero in place of values that are not finite, and counts them.
pub(super) fn mend(values: &mut Values) -> usize {
    fn run<V: Value>(values: &mut [V], finite: impl Fn(&V) -> bool) -> usize {
        let bad = values.iter_mut().filter(|value| !finite(value));
        bad.map(|value| *value = V::default()).count()
    }
    if all_finite(values) {
        return 0;
    }
    match values {
        Values::Float(values) => run(values, |x| x.is_finite()),
        Values::Vec2(values) => run(values, |x| x.is_finite()),
        Values::Vec3(values) => run(values, |x| x.is_finite()),
        Values::Vec4(values) => run(values, |x| x.is_finite()),
        Values::Int(_) | Values::Tag(_) => 0,
    }
}
