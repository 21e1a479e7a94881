//! Decodes streams of triangles. Most triangles share an edge with a recently decoded triangle, and their third vertex
//! is new or was used recently.
//!
//! ```text
//! 0xe1 | a code for each triangle | numbers | table of 16 bytes, each a pair of 4-bit values
//! ```

use super::input::{Input, header, zigzag};
use crate::fault::Fault;

/// The size in bytes of the table of pairs at the end of a stream.
const TABLE: u8 = 16;

/// A lower bound for the size of a stream of triangles with `count` corners, in bytes.
pub(super) fn shortest(count: u64) -> u64 {
    (count / 3).saturating_add(1 + u64::from(TABLE))
}

/// Decodes `n` triangles. The three indices of each triangle are stored in three slots (functions that store an index).
///
/// # Errors
///
/// Returns the first error in the stream, with its position.
pub(super) fn decode(
    stream: &[u8],
    n: usize,
    mut slots: impl Iterator<Item = impl FnOnce(u32)>,
) -> Result<(), Fault> {
    header(stream, 0xe1)?;
    let mut input = Input::new(stream, TABLE.into())?;
    let first = input.at;
    let codes = input.take(n)?;
    let table = &stream[input.bytes.len()..];
    let mut state = State {
        input,
        next: 0,
        last: 0,
        edges: Recent::new(),
        vertices: Recent::new(),
    };
    for (i, &code) in codes.iter().enumerate() {
        let triangle = state.triangle(code, table).map_err(|error| match error {
            TriangleError::Stream(fault) => fault,
            TriangleError::Code => Fault::byte(
                first + i,
                format!(
                    "the code {code:#04x} refers to an earlier edge or vertex that does not exist"
                ),
            ),
        })?;
        for (index, slot) in triangle.into_iter().zip(&mut slots) {
            slot(index);
        }
    }
    state.input.end()
}

/// The reason why a triangle cannot be decoded.
enum TriangleError {
    /// The code refers to an earlier edge or vertex that does not exist, because too few triangles precede this
    /// triangle.
    Code,
    Stream(Fault),
}

impl From<Fault> for TriangleError {
    fn from(fault: Fault) -> Self {
        Self::Stream(fault)
    }
}

struct State<'a> {
    input: Input<'a>,
    /// The index of the next new vertex. New vertices have consecutive indices.
    next: u32,
    /// The last vertex that was stored explicitly.
    last: u32,
    edges: Recent<[u32; 2]>,
    vertices: Recent<u32>,
}

impl State<'_> {
    fn triangle(&mut self, code: u8, table: &[u8]) -> Result<[u32; 3], TriangleError> {
        let (high, low) = (code >> 4, code & 15);
        if high < 15 {
            return self.beside(high, low);
        }
        let explicit = low >= 14;
        let pair = if explicit {
            self.input.byte()?
        } else {
            table[usize::from(low)]
        };
        if explicit && pair == 0 {
            self.next = 0;
        }
        let a = if code == 0xff {
            self.explicit_vertex()?
        } else {
            self.new_vertex()
        };
        let (z, w) = (pair >> 4, pair & 15);
        let b = self.vertex(z)?;
        let c = self.vertex(w)?;
        for edge in [[b, a], [c, b], [a, c]] {
            self.edges.push(edge);
        }
        self.vertices.push(a);
        for (vertex, half) in [(b, z), (c, w)] {
            if half == 0 || half == 15 {
                self.vertices.push(vertex);
            }
        }
        Ok([a, b, c])
    }

    /// Decodes a triangle that shares one of the last 15 edges.
    fn beside(&mut self, edge: u8, third: u8) -> Result<[u32; 3], TriangleError> {
        let [a, b] = self.edges.get(edge).ok_or(TriangleError::Code)?;
        let c = match third {
            0 => self.new_vertex(),
            1..13 => self.vertices.get(third).ok_or(TriangleError::Code)?,
            13 => {
                self.last = self.last.wrapping_sub(1);
                self.last
            }
            14 => {
                self.last = self.last.wrapping_add(1);
                self.last
            }
            _ => self.explicit_vertex()?,
        };
        self.edges.push([c, b]);
        self.edges.push([a, c]);
        if !(1..13).contains(&third) {
            self.vertices.push(c);
        }
        Ok([a, b, c])
    }

    fn new_vertex(&mut self) -> u32 {
        let vertex = self.next;
        self.next = vertex.wrapping_add(1);
        vertex
    }

    /// The vertex that a 4-bit value refers to.
    fn vertex(&mut self, half: u8) -> Result<u32, TriangleError> {
        match half {
            0 => Ok(self.new_vertex()),
            15 => Ok(self.explicit_vertex()?),
            _ => self.vertices.get(half - 1).ok_or(TriangleError::Code),
        }
    }

    fn explicit_vertex(&mut self) -> Result<u32, Fault> {
        let number = self.input.number()?;
        self.last = self.last.wrapping_add(zigzag(number));
        Ok(self.last)
    }
}

/// Stores the latest 16 values that were added.
pub(super) struct Recent<T> {
    all: [T; 16],
    /// The number of values that were added so far.
    n: usize,
}

impl<T: Copy + Default> Recent<T> {
    pub(super) fn new() -> Self {
        Self {
            all: [T::default(); 16],
            n: 0,
        }
    }

    pub(super) fn push(&mut self, one: T) {
        self.all[self.n % 16] = one;
        self.n += 1;
    }

    /// The value that was added `back` steps before the latest one.
    pub(super) fn get(&self, back: u8) -> Option<T> {
        let place = self.n.checked_sub(1 + usize::from(back))?;
        Some(self.all[place % 16])
    }
}
