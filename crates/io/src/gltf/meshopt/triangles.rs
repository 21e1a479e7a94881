//! Triangles: most continue from an edge of one of the last triangles, with a vertex that is next in turn
//! or was there lately.
//!
//! ```text
//! 0xe1 | a code for each triangle | numbers | 16 pairs of halves of a byte
//! ```

use super::input::{Input, header, zigzag};
use crate::fault::Fault;

/// The length of the table of pairs at the end.
const TABLE: u8 = 16;

/// The shortest stream of triangles with `count` corners, in bytes.
pub(super) fn shortest(count: u64) -> u64 {
    (count / 3).saturating_add(1 + u64::from(TABLE))
}

/// Decodes `n` triangles into the slots, three for each.
///
/// # Errors
///
/// The place at which the stream breaks the rules.
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
        let triangle = state.triangle(code, table).map_err(|wrong| match wrong {
            Wrong::Stream(broken) => broken,
            Wrong::Code => Fault::byte(
                first + i,
                format!("the code {code:#04x} refers to an edge or a vertex before the first"),
            ),
        })?;
        for (index, slot) in triangle.into_iter().zip(&mut slots) {
            slot(index);
        }
    }
    state.input.end()
}

/// Why there is no triangle for a code.
enum Wrong {
    /// It refers to what has not been there.
    Code,
    Stream(Fault),
}

impl From<Fault> for Wrong {
    fn from(broken: Fault) -> Self {
        Self::Stream(broken)
    }
}

struct State<'a> {
    input: Input<'a>,
    /// The first vertex that has not been there.
    next: u32,
    /// The last vertex that was spelled out.
    last: u32,
    edges: Recent<[u32; 2]>,
    vertices: Recent<u32>,
}

impl State<'_> {
    fn triangle(&mut self, code: u8, table: &[u8]) -> Result<[u32; 3], Wrong> {
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
            self.spelled_out()?
        } else {
            self.unseen()
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

    /// A triangle at one of the last edges.
    fn beside(&mut self, edge: u8, third: u8) -> Result<[u32; 3], Wrong> {
        let [a, b] = self.edges.get(edge).ok_or(Wrong::Code)?;
        let c = match third {
            0 => self.unseen(),
            1..13 => self.vertices.get(third).ok_or(Wrong::Code)?,
            13 => {
                self.last = self.last.wrapping_sub(1);
                self.last
            }
            14 => {
                self.last = self.last.wrapping_add(1);
                self.last
            }
            _ => self.spelled_out()?,
        };
        self.edges.push([c, b]);
        self.edges.push([a, c]);
        if !(1..13).contains(&third) {
            self.vertices.push(c);
        }
        Ok([a, b, c])
    }

    fn unseen(&mut self) -> u32 {
        let unseen = self.next;
        self.next = unseen.wrapping_add(1);
        unseen
    }

    /// The vertex that half a byte stands for.
    fn vertex(&mut self, half: u8) -> Result<u32, Wrong> {
        match half {
            0 => Ok(self.unseen()),
            15 => Ok(self.spelled_out()?),
            _ => self.vertices.get(half - 1).ok_or(Wrong::Code),
        }
    }

    fn spelled_out(&mut self) -> Result<u32, Fault> {
        let number = self.input.number()?;
        self.last = self.last.wrapping_add(zigzag(number));
        Ok(self.last)
    }
}

/// The last 16 of what has been there.
struct Recent<T> {
    all: [T; 16],
    /// How many have been there.
    n: usize,
}

impl<T: Copy + Default> Recent<T> {
    fn new() -> Self {
        Self {
            all: [T::default(); 16],
            n: 0,
        }
    }

    fn push(&mut self, one: T) {
        self.all[self.n % 16] = one;
        self.n += 1;
    }

    /// The one that came `back` before the latest.
    fn get(&self, back: u8) -> Option<T> {
        let place = self.n.checked_sub(1 + usize::from(back))?;
        Some(self.all[place % 16])
    }
}
