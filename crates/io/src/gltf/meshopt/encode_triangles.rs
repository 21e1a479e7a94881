//! Writes streams of triangles; see [`triangles`](super::triangles) for the layout.

use super::triangles::Recent;

/// The table at the end of each stream. Each byte is a pair of 4-bit values. The code of a triangle can refer to one of
/// these pairs. The format allows any table. This table contains pairs that are frequent in real meshes
/// (`kCodeAuxEncodingTable` of meshoptimizer).
const PAIRS: [u8; 16] = [
    0x00, 0x76, 0x87, 0x56, 0x67, 0x78, 0xa9, 0x86, 0x65, 0x89, 0x68, 0x98, 0x01, 0x69, 0, 0,
];

/// The number of pairs in the table that the code of a triangle can refer to.
const N_PAIRS: usize = 14;

/// Encodes triangles whose indices have N bytes, without changing their order. If a triangle shares an edge with an
/// earlier triangle, it is stored with the two ends of this edge as its first corners. Therefore, decoding can give the
/// triangle (b, c, a) instead of (a, b, c).
pub(in super::super) fn encode<const N: usize>(
    bytes: &[u8],
    index: impl Fn([u8; N]) -> u32,
) -> Vec<u8> {
    let indices = bytes.as_chunks().0;
    let triangles = indices.as_chunks().0;
    let mut state = State {
        numbers: Vec::new(),
        next: 0,
        last: 0,
        edges: Recent::new(),
        vertices: Recent::new(),
    };
    let mut out = Vec::with_capacity(1 + 2 * triangles.len() + PAIRS.len());
    out.push(0xe1);
    for triangle in triangles {
        let triangle: [u32; 3] = triangle.map(&index);
        let code = state
            .beside(triangle)
            .unwrap_or_else(|| state.apart(triangle));
        out.push(code);
    }
    out.extend(state.numbers);
    out.extend(PAIRS);
    out
}

/// The bytes written so far, and the state of a decoder that has decoded all triangles encoded so far.
struct State {
    /// The bytes that follow the codes in the stream.
    numbers: Vec<u8>,
    /// The index of the next new vertex. New vertices have consecutive indices.
    next: u32,
    /// The last vertex that was stored explicitly.
    last: u32,
    edges: Recent<[u32; 2]>,
    vertices: Recent<u32>,
}

impl State {
    /// If the triangle shares one of the last 15 edges, encodes it and returns its code. Otherwise, returns `None`.
    fn beside(&mut self, [a, b, c]: [u32; 3]) -> Option<u8> {
        let rotations = [[a, b, c], [b, c, a], [c, a, b]];
        let found = (0..15).find_map(|back| {
            let edge = self.edges.get(back)?;
            let found = rotations.iter().find(|[a, b, _]| edge == [*a, *b])?;
            Some((back, *found))
        });
        let (edge, [a, b, c]) = found?;
        let recent = self.recent(c).filter(|back| (1..13).contains(back));
        let third = if let Some(recent) = recent {
            recent
        } else if c == self.next {
            self.next = self.next.wrapping_add(1);
            0
        } else if c.wrapping_add(1) == self.last {
            self.last = c;
            13
        } else if c == self.last.wrapping_add(1) {
            self.last = c;
            14
        } else {
            self.explicit_vertex(c);
            15
        };
        self.edges.push([c, b]);
        self.edges.push([a, c]);
        if recent.is_none() {
            self.vertices.push(c);
        }
        Some(edge << 4 | third)
    }

    /// Encodes a triangle without using a shared edge, and returns its code.
    fn apart(&mut self, [a, b, c]: [u32; 3]) -> u8 {
        let rotations = [[a, b, c], [b, c, a], [c, a, b]];
        let new_first = rotations.iter().find(|[a, ..]| *a == self.next);
        let [a, b, c] = *new_first.unwrap_or(&rotations[0]);
        // An explicit `pair` of 0 tells the decoder to restart the indices of new vertices at 0.
        let restarts = self.next > 0 && [a, b, c] == [0, 1, 2];
        if restarts {
            self.next = 0;
        }
        let is_new = self.take_if_next(a);
        let (z, w) = if restarts {
            self.next = 3;
            (0, 0)
        } else {
            (self.half(b), self.half(c))
        };
        let pair = z << 4 | w;
        let known = PAIRS[..N_PAIRS].iter().position(|&known| known == pair);
        let code = match known.and_then(|known| u8::try_from(known).ok()) {
            Some(known) if is_new && !restarts => 0xf0 | known,
            _ => {
                self.numbers.push(pair);
                if is_new { 0xfe } else { 0xff }
            }
        };
        for (vertex, is_explicit) in [(a, !is_new), (b, z == 15), (c, w == 15)] {
            if is_explicit {
                self.explicit_vertex(vertex);
            }
        }
        for edge in [[b, a], [c, b], [a, c]] {
            self.edges.push(edge);
        }
        self.vertices.push(a);
        for (vertex, half) in [(b, z), (c, w)] {
            if half == 0 || half == 15 {
                self.vertices.push(vertex);
            }
        }
        code
    }

    /// Returns the 4-bit value that refers to a vertex.
    fn half(&mut self, vertex: u32) -> u8 {
        match self.recent(vertex) {
            Some(back) if back < 14 => back + 1,
            _ if self.take_if_next(vertex) => 0,
            _ => 15,
        }
    }

    fn take_if_next(&mut self, vertex: u32) -> bool {
        let is_next = vertex == self.next;
        self.next = self.next.wrapping_add(is_next.into());
        is_next
    }

    /// Returns the position of a vertex among the last 16 vertices, or `None` if it is not one of them.
    fn recent(&self, vertex: u32) -> Option<u8> {
        (0..16).find(|&back| self.vertices.get(back) == Some(vertex))
    }

    fn explicit_vertex(&mut self, vertex: u32) {
        let difference = vertex.wrapping_sub(self.last);
        self.last = vertex;
        let mut number = (difference << 1) ^ (difference >> 31).wrapping_neg();
        while number >= 0x80 {
            self.numbers.push(number.to_le_bytes()[0] | 0x80);
            number >>= 7;
        }
        self.numbers.push(number.to_le_bytes()[0]);
    }
}
