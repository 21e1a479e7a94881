//! Values on the corners of a mesh: where they go when a mesh is read, and numbering the different
//! ones when it is written.

use mesh::{Attribute, Built, HalfEdgeId, Mesh, Value, VertexId};

/// One value for each half-edge: that of the corner of the input that became it, zero elsewhere.
pub(crate) fn on_half_edges<T: Value>(built: &Built, value: impl Fn(usize) -> T) -> Vec<T> {
    let mut values = vec![T::default(); built.mesh.n_half_edges()];
    for (c, h) in built.half_edge_of_corner.iter().enumerate() {
        if let Some(h) = h.some() {
            values[h.index()] = value(c);
        }
    }
    values
}

/// Stores one value for each half-edge as an attribute of the vertices if the corners around each
/// vertex agree, and as one of the corners otherwise. Isolated vertices take it from `isolated`.
pub(crate) fn set_on_vertices_or_corners<T: Value>(
    mesh: &mut Mesh,
    on_vertices: Attribute<VertexId, T>,
    on_corners: Attribute<HalfEdgeId, T>,
    corners: Vec<T>,
    isolated: impl Fn(VertexId) -> T,
) {
    match agreed(mesh, &corners, isolated) {
        Some(values) => mesh.set(on_vertices, values),
        None => mesh.set(on_corners, corners),
    }
}

/// For each vertex the value of its corners; `None` if two corners of a vertex differ.
fn agreed<T: Value>(
    mesh: &Mesh,
    corners: &[T],
    isolated: impl Fn(VertexId) -> T,
) -> Option<Vec<T>> {
    let one = |v| {
        let mut values = mesh
            .vertex_half_edges(v)
            .filter(|&h| mesh.face(h).is_some())
            .map(|h| corners[h.index()]);
        match values.next() {
            None => Some(isolated(v)),
            Some(first) => values.all(|value| value == first).then_some(first),
        }
    };
    mesh.vertices().map(one).collect()
}

/// Numbers the different values that stand at each of many places, in the order in which they come.
///
/// Made for few values at a place. Of a crowd only the latest [`Numbering::LOOKED_AT`] are compared, so
/// that a vertex with a million corners costs no more than others; a value may then get a second
/// number.
#[derive(Debug)]
pub(crate) struct Numbering<K> {
    /// For each place its latest number.
    latest: Vec<u32>,
    /// For each number its value and the number that its place got before.
    entries: Vec<(K, u32)>,
}

impl<K: PartialEq> Numbering<K> {
    const LOOKED_AT: usize = 64;

    pub(crate) fn new(n_places: usize) -> Self {
        Self {
            latest: vec![u32::MAX; n_places],
            entries: Vec::new(),
        }
    }

    /// The number of `key` at `place`, and whether it is new.
    pub(crate) fn number(&mut self, place: usize, key: K) -> (u32, bool) {
        let mut at = self.latest[place];
        for _ in 0..Self::LOOKED_AT {
            let Some((known, before)) = self.entries.get(at as usize) else {
                break;
            };
            if *known == key {
                return (at, false);
            }
            at = *before;
        }
        let number = u32::try_from(self.entries.len()).unwrap_or(u32::MAX);
        self.entries.push((key, self.latest[place]));
        self.latest[place] = number;
        (number, true)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_values_at_one_place_share_a_number() {
        let mut numbering = Numbering::new(2);
        assert_eq!(numbering.number(0, 'a'), (0, true));
        assert_eq!(numbering.number(0, 'b'), (1, true));
        assert_eq!(numbering.number(1, 'a'), (2, true));
        assert_eq!(numbering.number(0, 'a'), (0, false));
        assert_eq!(numbering.number(1, 'a'), (2, false));
    }

    #[test]
    fn a_crowd_at_one_place_takes_no_quadratic_time() {
        let mut numbering = Numbering::new(1);
        for i in 0..200_000 {
            assert_eq!(numbering.number(0, i), (i, true));
        }
    }

    #[test]
    fn values_that_agree_go_to_the_vertices() {
        let mut mesh = mesh::shapes::cube();
        let same = vec![1.0; mesh.n_half_edges()];
        let mut other = same.clone();
        other[0] = 2.0;
        let on_vertices: Attribute<VertexId, f64> = Attribute::new("x", mesh::Rule::Copy);
        let on_corners: Attribute<HalfEdgeId, f64> = Attribute::new("x", mesh::Rule::Copy);

        set_on_vertices_or_corners(&mut mesh, on_vertices, on_corners, same, |_| 0.0);
        assert!(mesh.get(on_vertices).is_some() && mesh.get(on_corners).is_none());

        let mut mesh = mesh::shapes::cube();
        set_on_vertices_or_corners(&mut mesh, on_vertices, on_corners, other, |_| 0.0);
        assert!(mesh.get(on_vertices).is_none() && mesh.get(on_corners).is_some());
    }
}
