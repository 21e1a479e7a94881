//! Locates the values of an element in the bytes of a file.

use super::header::{Element, Property};
use super::types::{Type, number, read_all, whole};
use crate::fault::Fault;
use mesh::{counted, parallel};

/// The rows of one element, and the positions of their values.
#[derive(Debug)]
pub(super) struct Table<'a> {
    pub(super) properties: &'a [Property],
    pub(super) rows: usize,
    pub(super) big: bool,
    /// The bytes of all rows.
    pub(super) bytes: &'a [u8],
    /// The position of `bytes` in the file.
    pub(super) start: usize,
    layout: Layout,
}

/// Where the values of a row are. If the lengths of lists differ between rows, each row is divided into segments, and a
/// new segment begins after each list. The position of each segment is then stored for each row.
#[derive(Debug)]
enum Layout {
    /// All rows have the same length, because each list has the same number of items in every row.
    Even {
        stride: usize,
        /// For each property, the offset of its value in a row. For a list, this is the offset of its first item.
        places: Vec<usize>,
        /// For each property, the number of items in its list; 0 if the property is not a list.
        counts: Vec<usize>,
    },
    Uneven {
        /// For each property, the segment that contains its value, and the offset of the value in this segment. For a
        /// list, this is the offset of its first item.
        places: Vec<(usize, usize)>,
        /// For each segment, the position at which it begins in each row. Empty if no property is in the segment.
        starts: Vec<Vec<usize>>,
        /// For each property, the number of items of its list in each row. Empty if the property is not a list.
        counts: Vec<Vec<u32>>,
    },
}

impl<'a> Table<'a> {
    /// Locates the rows of an element in `file`, beginning at `start`. Returns the table and the position after its
    /// last row.
    ///
    /// # Errors
    ///
    /// Returns an error if the file is too short for the rows, or if a list has a negative count. Memory is allocated
    /// only if the file is long enough for the rows.
    pub(super) fn locate(
        element: &'a Element,
        file: &'a [u8],
        start: usize,
        big: bool,
    ) -> Result<(Self, usize), Fault> {
        let bytes = &file[start..];
        let Element {
            properties, rows, ..
        } = element;
        let shortest = properties.iter().map(|p| p.count.unwrap_or(p.value).size());
        let shortest: usize = shortest.sum();
        let least = shortest.checked_mul(*rows);
        if least.is_none_or(|least| least > bytes.len()) {
            let message = format!(
                "the rest of the file is too short for all rows of {element} (rows: {rows}, bytes in each row: at least {shortest}, bytes left: {})",
                bytes.len()
            );
            return Err(Fault::byte(start, message));
        }
        let rows = if properties.is_empty() { 0 } else { *rows };
        let (layout, length) = match even(properties, rows, bytes, big) {
            _ if rows == 0 => {
                let layout = Layout::Even {
                    stride: shortest,
                    places: vec![0; properties.len()],
                    counts: vec![0; properties.len()],
                };
                (layout, 0)
            }
            Some(found) => found,
            None => scanned(element, bytes, start, big)?,
        };
        let table = Self {
            properties,
            rows,
            big,
            bytes: &bytes[..length],
            start,
            layout,
        };
        Ok((table, start + length))
    }

    /// Reads the values of a scalar property, beginning with `row`.
    pub(super) fn read(&self, property: usize, row: usize, out: &mut [f64]) {
        let kind = self.properties[property].value;
        if let Layout::Even { stride, places, .. } = &self.layout {
            let bytes = &self.bytes[row * stride + places[property]..];
            return read_all(kind, self.big, bytes, *stride, out);
        }
        for (row, x) in (row..).zip(out) {
            *x = number(kind, self.big, &self.bytes[self.at(property, row)..]);
        }
    }

    /// The position of a value in [`bytes`](Self::bytes). For a list, the position of its first item.
    #[inline]
    pub(super) fn at(&self, property: usize, row: usize) -> usize {
        match &self.layout {
            Layout::Even { stride, places, .. } => row * stride + places[property],
            Layout::Uneven { places, starts, .. } => {
                let (segment, place) = places[property];
                starts[segment][row] + place
            }
        }
    }

    /// The number of items in the list of a row.
    #[inline]
    pub(super) fn count(&self, property: usize, row: usize) -> usize {
        match &self.layout {
            Layout::Even { counts, .. } => counts[property],
            Layout::Uneven { counts, .. } => counts[property][row] as usize,
        }
    }

    /// Returns the number of items in each list of a property, if each list property of the element has the same list
    /// length in all rows. Otherwise, returns `None`.
    pub(super) fn even_count(&self, property: usize) -> Option<usize> {
        match &self.layout {
            Layout::Even { counts, .. } => Some(counts[property]),
            Layout::Uneven { .. } => None,
        }
    }
}

/// Returns the layout and the total length of the rows if each list property has the same list length in all rows.
/// Otherwise, returns `None`.
fn even(properties: &[Property], rows: usize, bytes: &[u8], big: bool) -> Option<(Layout, usize)> {
    let mut at = 0_usize;
    let (mut places, mut counts, mut lists) = (Vec::new(), Vec::new(), Vec::new());
    for property in properties {
        let mut count = 1;
        if let Some(kind) = property.count {
            let first = bytes.get(at..)?.get(..kind.size())?;
            count = usize::try_from(whole(kind, big, first)).ok()?;
            lists.push((at, kind, count));
            at += kind.size();
        }
        places.push(at);
        counts.push(if property.count.is_some() { count } else { 0 });
        at = at.checked_add(count.checked_mul(property.value.size())?)?;
    }
    let stride = at;
    let length = stride.checked_mul(rows)?;
    bytes.get(..length)?;
    for (at, kind, count) in lists {
        // The counts of most lists have one byte. For such counts, this loop is faster than the loop below.
        let is_same = if kind == Type::UInt8 {
            parallel::all(rows, |row| usize::from(bytes[row * stride + at]) == count)
        } else {
            let count = i64::try_from(count).ok()?;
            parallel::all(rows, |row| {
                whole(kind, big, &bytes[row * stride + at..]) == count
            })
        };
        if !is_same {
            return None;
        }
    }
    let layout = Layout::Even {
        stride,
        places,
        counts,
    };
    Some((layout, length))
}

/// Finds the positions of the values if the lengths of lists differ between rows. Returns the layout and the total
/// length of the rows.
fn scanned(
    element: &Element,
    all: &[u8],
    start: usize,
    big: bool,
) -> Result<(Layout, usize), Fault> {
    let mut places = Vec::new();
    let (mut segment, mut place) = (0, 0);
    let mut needed = vec![false];
    for property in &element.properties {
        needed[segment] = true;
        if let Some(count) = property.count {
            places.push((segment, place + count.size()));
            needed.push(false);
            (segment, place) = (segment + 1, 0);
        } else {
            places.push((segment, place));
            place += property.value.size();
        }
    }
    let room = |needed: bool| if needed { element.rows } else { 0 };
    let starts = needed
        .iter()
        .map(|&needed| Vec::with_capacity(room(needed)));
    let mut starts: Vec<Vec<usize>> = starts.collect();
    let lists = element.properties.iter().map(|p| p.count.is_some());
    let mut counts: Vec<Vec<u32>> = lists.map(|list| Vec::with_capacity(room(list))).collect();
    let mut at = 0;
    for row in 0..element.rows {
        let mut segment = 0;
        starts[0].push(at);
        for (p, property) in element.properties.iter().enumerate() {
            let size = property.value.size();
            let Some(kind) = property.count else {
                at += size;
                continue;
            };
            let error = |message: String| {
                let message = format!("{message} in {property} of row {row} of {element}");
                Fault::byte(start + at.min(all.len()), message)
            };
            let end = at + kind.size();
            let Some(bytes) = all.get(at..end) else {
                return Err(error(
                    "expected a list count, found the end of the file".into(),
                ));
            };
            let count = whole(kind, big, bytes);
            let Ok(n) = u32::try_from(count) else {
                return Err(error(format!(
                    "expected a non-negative list count, found {count}"
                )));
            };
            let rest = all.len() - end;
            if n as usize > rest / size {
                let message =
                    format!("expected {n} values of {size} bytes each, found only {rest} bytes");
                return Err(error(message));
            }
            at = end + n as usize * size;
            counts[p].push(n);
            segment += 1;
            if needed[segment] {
                starts[segment].push(at);
            }
        }
    }
    if at > all.len() {
        let rows = element.rows;
        let rows = counted(rows, "row");
        let message = format!("expected {rows} of {element}, found the end of the file");
        return Err(Fault::byte(start + all.len(), message));
    }
    let layout = Layout::Uneven {
        places,
        starts,
        counts,
    };
    Ok((layout, at))
}
