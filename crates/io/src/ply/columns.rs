//! Decodes whole columns of values on all threads. For speed, the type of the values is checked once for each chunk of
//! a column instead of once for each value.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

use glam::{DVec2, DVec3, DVec4};
use mesh::{Value, Values, zeroed};

use super::table::Table;
use super::types::{read, read_all, whole, with_type};
use crate::Polygons;
use mesh::parallel::{self, BLOCK};

/// The type of a mesh attribute.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Tag,
    Int,
    Float,
    Vec2,
    Vec3,
    Vec4,
}

/// Each attribute type, its name in the comments of a PLY file, and the number of components of a value.
const KINDS: [(Kind, &str, usize); 6] = [
    (Kind::Tag, "tag", 1),
    (Kind::Int, "int", 1),
    (Kind::Float, "float", 1),
    (Kind::Vec2, "vec2", 2),
    (Kind::Vec3, "vec3", 3),
    (Kind::Vec4, "vec4", 4),
];

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

    /// The number of components of a value.
    pub(super) fn size(self) -> usize {
        KINDS[self as usize].2
    }

    /// The name of this attribute type in the comments of a PLY file.
    pub(super) fn word(self) -> &'static str {
        KINDS[self as usize].1
    }

    pub(super) fn parse(word: &str) -> Option<Self> {
        let found = KINDS.iter().find(|(_, name, _)| *name == word);
        found.map(|&(kind, ..)| kind)
    }
}

/// The properties of a PLY element that store the values of a mesh attribute.
#[derive(Clone, Copy)]
pub(super) enum Source<'a> {
    /// The components of a value are in consecutive scalar properties. The field is the index of the first of these
    /// properties.
    Scalars(usize),
    /// The components for all corners of a face are in one list property. The first field is the index of the property.
    /// The second field contains the index of the first corner of each face, followed by the total number of corners.
    List(usize, &'a [u32]),
}

/// Decodes the values of an attribute. Corner values are stored as a list for each face. If the length of a list
/// differs from the number of corners of its face, all corners of this face get zero. Returns the values and the number
/// of faces with a wrong list.
pub(super) fn values(table: &Table, source: Source, kind: Kind) -> (Values, usize) {
    #[expect(
        clippy::cast_possible_truncation,
        reason = "the property has values of this type"
    )]
    let to_int = |[x]: [f64; 1]| x as i32;
    match kind {
        Kind::Tag => column(table, source, |[x]| x != 0.0),
        Kind::Int => column(table, source, to_int),
        Kind::Float => column(table, source, |[x]| x),
        Kind::Vec2 => column(table, source, DVec2::from_array),
        Kind::Vec3 => column(table, source, DVec3::from_array),
        Kind::Vec4 => column(table, source, DVec4::from_array),
    }
}

fn column<const N: usize, V: Value>(
    table: &Table,
    source: Source,
    make: impl Fn([f64; N]) -> V + Sync,
) -> (Values, usize) {
    match source {
        Source::Scalars(first) => {
            let properties = std::array::from_fn(|i| first + i);
            (V::wrap(numbers(table, properties, make)), 0)
        }
        Source::List(property, faces) => of_corners(table, property, faces, make),
    }
}

/// Decodes one value for each row. A value consists of the numbers of `N` scalar properties.
pub(super) fn numbers<const N: usize, V: Value>(
    table: &Table,
    properties: [usize; N],
    make: impl Fn([f64; N]) -> V + Sync,
) -> Vec<V> {
    /// The number of rows that are decoded at a time. Their values fit in the first-level cache of the processor.
    const PIECE: usize = 256;
    let mut out = zeroed(table.rows);
    parallel::fill(&mut out, |first, out| {
        let mut numbers = [[0.0; PIECE]; N];
        for (piece, out) in out.chunks_mut(PIECE).enumerate() {
            let row = first + piece * PIECE;
            for (numbers, &property) in numbers.iter_mut().zip(&properties) {
                table.read(property, row, &mut numbers[..out.len()]);
            }
            for (i, value) in out.iter_mut().enumerate() {
                *value = make(std::array::from_fn(|k| numbers[k][i]));
            }
        }
    });
    out
}

fn of_corners<const N: usize, V: Value>(
    table: &Table,
    property: usize,
    faces: &[u32],
    make: impl Fn([f64; N]) -> V + Sync,
) -> (Values, usize) {
    let mut all = zeroed::<V>(faces[faces.len() - 1] as usize);
    let kind = table.properties[property].value;
    for_blocks(faces, &mut all, |rows, mut out| {
        let mut numbers = Vec::new();
        for row in rows {
            let (own, rest) = out.split_at_mut(degree(faces, row));
            out = rest;
            if table.count(property, row) == N * own.len() {
                numbers.resize(N * own.len(), 0.0);
                let items = &table.bytes[table.at(property, row)..];
                read_all(kind, table.big, items, kind.size(), &mut numbers);
                for (value, numbers) in own.iter_mut().zip(numbers.as_chunks().0) {
                    *value = make(*numbers);
                }
            }
        }
    });
    let is_short = |row: &usize| table.count(property, *row) != N * degree(faces, *row);
    (V::wrap(all), (0..table.rows).filter(is_short).count())
}

fn degree(offsets: &[u32], row: usize) -> usize {
    (offsets[row + 1] - offsets[row]) as usize
}

/// For each block, calls `work` with the rows of the block and the corresponding part of `out`.
fn for_blocks<V: Send>(
    offsets: &[u32],
    out: &mut [V],
    work: impl Fn(Range<usize>, &mut [V]) + Sync,
) {
    let rows = offsets.len() - 1;
    let end = |block: usize| rows.min((block + 1) * BLOCK);
    let ends = (0..rows.div_ceil(BLOCK)).map(|block| offsets[end(block)] as usize);
    parallel::consume(parallel::split_at_ends(out, ends), |block, out| {
        work(block * BLOCK..end(block), out);
    });
}

/// Two arrays. The second array contains the items of the lists of all rows, one list after the other. The first array
/// contains, for each list, the offset in the second array at which the list starts, followed by the total number of
/// items.
type Lists = (Vec<u32>, Vec<u32>);

/// Reads the lists of a table as vertex indices. Returns the offsets and the indices.
///
/// # Errors
///
/// The error is the row and the item of the first value that is not a vertex index. The error is `None` if the lists
/// have too many items for 32-bit offsets.
pub(super) fn indices(
    table: &Table,
    property: usize,
    n_vertices: usize,
) -> Result<Lists, Option<(usize, usize)>> {
    let (offsets, total) = offsets(table, property).ok_or(None)?;
    let mut corners = zeroed::<u32>(total);
    let bad = AtomicBool::new(false);
    let limit = n_vertices as f64;
    with_type!(table.properties[property].value, T => {
        for_blocks(&offsets, &mut corners, |rows, mut out| {
            let mut all = true;
            for row in rows {
                let (own, rest) = out.split_at_mut(degree(&offsets, row));
                out = rest;
                let items = table.bytes[table.at(property, row)..].chunks_exact(size_of::<T>());
                for (corner, item) in own.iter_mut().zip(items) {
                    let v = read::<T>(item, table.big);
                    all &= v >= 0.0 && v < limit;
                    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked above")]
                    {
                        *corner = v as u32;
                    }
                }
            }
            if !all {
                bad.store(true, Ordering::Relaxed);
            }
        });
    });
    if bad.into_inner() {
        let vertices = 0..i64::try_from(n_vertices).unwrap_or(i64::MAX);
        let is_bad = |&(row, item): &(usize, usize)| {
            !vertices.contains(&item_at(table, property, row, item))
        };
        let items = |row| (0..table.count(property, row)).map(move |item| (row, item));
        return Err((0..table.rows).flat_map(items).find(is_bad));
    }
    Ok((offsets, corners))
}

/// Reads an item of a list as an integer.
pub(super) fn item_at(table: &Table, property: usize, row: usize, item: usize) -> i64 {
    let kind = table.properties[property].value;
    let at = table.at(property, row) + item * kind.size();
    whole(kind, table.big, &table.bytes[at..])
}

/// Returns the offsets of the lists of all rows, and the total number of items. Returns `None` if the total number does
/// not fit in 32 bits.
fn offsets(table: &Table, property: usize) -> Option<(Vec<u32>, usize)> {
    if let Some(n) = table.even_count(property) {
        let total = table.rows.checked_mul(n)?;
        let fits = total.max(table.rows) < u32::MAX as usize;
        return fits.then(|| (Polygons::even_offsets(table.rows, n), total));
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
