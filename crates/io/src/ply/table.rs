//! Where the values of an element are in the bytes of a file.

use rayon::prelude::*;

use super::header::{Element, Property};
use super::types::{Type, whole};

/// Rows that one task works on.
pub(super) const BLOCK: usize = 4096;

/// The rows of one element and where each of its values is.
#[derive(Debug)]
pub(super) struct Table<'a> {
    pub(super) properties: &'a [Property],
    pub(super) rows: usize,
    pub(super) big: bool,
    /// The bytes from the first row on.
    pub(super) bytes: &'a [u8],
    /// Where they are in the file.
    pub(super) start: usize,
    layout: Layout,
}

/// Where rows begin. Behind a list whose length differs between the rows a new segment begins, with
/// its own list of places.
#[derive(Debug)]
enum Layout {
    /// Every row has the same length: the same count in each list.
    Even {
        stride: usize,
        /// For each property its place in a row: of a list, that of its first item.
        places: Vec<usize>,
        /// For each property the count of its list; 0 if it is none.
        counts: Vec<usize>,
    },
    Uneven {
        /// For each property its segment and its place there: of a list, that of its first item.
        places: Vec<(usize, usize)>,
        /// For each segment where it begins in each row; empty where nothing is asked for.
        starts: Vec<Vec<usize>>,
        /// For each property the counts of its list in each row; empty if it is none.
        counts: Vec<Vec<u32>>,
    },
}

/// What is wrong with the bytes of an element, and where.
#[derive(Debug)]
pub(super) struct Broken {
    /// From the start of the file.
    pub(super) offset: usize,
    pub(super) message: String,
}

impl<'a> Table<'a> {
    /// Finds the rows of an element in `file` from `start` on, and where they end.
    ///
    /// # Errors
    ///
    /// If the file is too short for them, or a list has a negative count. Nothing is allocated for rows
    /// that the file has no bytes for.
    pub(super) fn locate(
        element: &'a Element,
        file: &'a [u8],
        start: usize,
        big: bool,
    ) -> Result<(Self, usize), Broken> {
        let bytes = &file[start..];
        let shortest = element.properties.iter().map(|p| match p.count {
            Some(count) => count.size(),
            None => p.value.size(),
        });
        let shortest: usize = shortest.sum();
        let least = shortest.checked_mul(element.rows);
        if least.is_none_or(|least| least > bytes.len()) {
            let message = format!(
                "expected {} rows of element `{}` of {shortest} bytes or more, found {} bytes",
                element.rows,
                element.name.escape_debug(),
                bytes.len()
            );
            return Err(Broken {
                offset: start,
                message,
            });
        }
        let mut table = Self {
            properties: &element.properties,
            rows: if element.properties.is_empty() {
                0
            } else {
                element.rows
            },
            big,
            bytes,
            start,
            layout: Layout::Even {
                stride: 0,
                places: Vec::new(),
                counts: Vec::new(),
            },
        };
        if table.rows == 0 {
            table.layout = Layout::Even {
                stride: shortest,
                places: vec![0; element.properties.len()],
                counts: vec![0; element.properties.len()],
            };
            return Ok((table, start));
        }
        let (layout, length) = match table.even() {
            Some(found) => found,
            None => table.scanned(element)?,
        };
        table.layout = layout;
        table.bytes = &bytes[..length];
        Ok((table, start + length))
    }

    /// The layout if every row has the counts of the first, and how long the rows are together.
    fn even(&self) -> Option<(Layout, usize)> {
        let mut at = 0_usize;
        let (mut places, mut counts, mut lists) = (Vec::new(), Vec::new(), Vec::new());
        for property in self.properties {
            let Some(count_type) = property.count else {
                places.push(at);
                counts.push(0);
                at += property.value.size();
                continue;
            };
            let bytes = self.bytes.get(at..)?;
            let bytes = bytes.get(..count_type.size())?;
            let count = usize::try_from(whole(count_type, self.big, bytes)).ok()?;
            lists.push((at, count_type, count));
            at += count_type.size();
            places.push(at);
            counts.push(count);
            at = at.checked_add(count.checked_mul(property.value.size())?)?;
        }
        let stride = at;
        let length = stride.checked_mul(self.rows)?;
        let rows = self.bytes.get(..length)?;
        for (at, count_type, count) in lists {
            let same = |row: &[u8]| {
                usize::try_from(whole(count_type, self.big, &row[at..])).ok() == Some(count)
            };
            let blocks = rows.par_chunks(BLOCK * stride);
            // Most lists are counted by one byte: the type is looked at outside of the loop.
            let all = if count_type == Type::UInt8 {
                blocks.all(|block| {
                    block
                        .chunks_exact(stride)
                        .all(|row| usize::from(row[at]) == count)
                })
            } else {
                blocks.all(|block| block.chunks_exact(stride).all(same))
            };
            if !all {
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

    /// The layout of rows whose lists differ, found by walking over them.
    fn scanned(&self, element: &Element) -> Result<(Layout, usize), Broken> {
        let mut places = Vec::new();
        let (mut segment, mut place) = (0, 0);
        let mut needed = vec![false];
        for property in self.properties {
            if let Some(count) = property.count {
                places.push((segment, place + count.size()));
                needed[segment] = true;
                segment += 1;
                place = 0;
                needed.push(false);
            } else {
                places.push((segment, place));
                needed[segment] = true;
                place += property.value.size();
            }
        }
        let room = |needed: bool| Vec::with_capacity(if needed { self.rows } else { 0 });
        let mut starts: Vec<Vec<usize>> = needed.iter().map(|&needed| room(needed)).collect();
        let lists = self.properties.iter().map(|p| p.count.is_some());
        let mut counts: Vec<Vec<u32>> = lists
            .map(|list| Vec::with_capacity(if list { self.rows } else { 0 }))
            .collect();
        let mut at = 0;
        for row in 0..self.rows {
            let mut segment = 0;
            starts[0].push(at);
            for (p, property) in self.properties.iter().enumerate() {
                let Some(count_type) = property.count else {
                    at += property.value.size();
                    continue;
                };
                let broken = |message: String| Broken {
                    offset: self.start + at.min(self.bytes.len()),
                    message: format!(
                        "{message} in `{}` of row {row} of element `{}`",
                        property.name.escape_debug(),
                        element.name.escape_debug()
                    ),
                };
                let end = at + count_type.size();
                let Some(bytes) = self.bytes.get(at..end) else {
                    return Err(broken("expected a count, found the end of the file".into()));
                };
                let count = whole(count_type, self.big, bytes);
                let Ok(n) = u32::try_from(count) else {
                    return Err(broken(format!("expected a count, found {count}")));
                };
                let rest = self.bytes.len() - end;
                let size = property.value.size();
                if n as usize > rest / size {
                    return Err(broken(format!(
                        "expected {n} values of {size} bytes, found {rest} bytes"
                    )));
                }
                at = end + n as usize * size;
                counts[p].push(n);
                segment += 1;
                if needed[segment] {
                    starts[segment].push(at);
                }
            }
        }
        if at > self.bytes.len() {
            return Err(Broken {
                offset: self.start + self.bytes.len(),
                message: format!(
                    "expected {} rows of element `{}`, found the end of the file",
                    self.rows,
                    element.name.escape_debug()
                ),
            });
        }
        let layout = Layout::Uneven {
            places,
            starts,
            counts,
        };
        Ok((layout, at))
    }

    /// Where a value is in [`bytes`](Self::bytes); of a list, the first item.
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

    /// How long each row is and where these properties are in it, if all rows are alike.
    pub(super) fn stride<const N: usize>(
        &self,
        properties: [usize; N],
    ) -> Option<(usize, [usize; N])> {
        match &self.layout {
            Layout::Even { stride, places, .. } => Some((*stride, properties.map(|p| places[p]))),
            Layout::Uneven { .. } => None,
        }
    }

    /// How many items the list of a row has.
    #[inline]
    pub(super) fn count(&self, property: usize, row: usize) -> usize {
        match &self.layout {
            Layout::Even { counts, .. } => counts[property],
            Layout::Uneven { counts, .. } => counts[property][row] as usize,
        }
    }

    /// How many items the lists of all rows have, if they have the same number.
    pub(super) fn even_count(&self, property: usize) -> Option<usize> {
        match &self.layout {
            Layout::Even { counts, .. } => Some(counts[property]),
            Layout::Uneven { .. } => None,
        }
    }
}
