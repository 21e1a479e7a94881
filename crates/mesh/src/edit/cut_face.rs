//! Cutting a face along several diagonals at once.

use crate::{EditError, FaceId, HalfEdgeId, Mesh};

/// Returns the parts into which diagonals divide a polygon with `n` corners, each part as a list of half-edges
/// in order. Corners are numbered from 0 along the face. For i from 0 to n - 1, half-edge i is the side that starts
/// at corner i. Half-edge n + 2k is diagonal k from its first corner to its second, and n + 2k + 1 is its twin.
///
/// ```text
///    3 --- 2 --- 2        n = 4, diagonals [[0, 2]]:
///    |         / |        parts [0, 1, 5] and [2, 3, 4]
///    3    4/5    1
///    | /         |
///    0 --- 0 --- 1
/// ```
///
/// Each part starts with its lowest half-edge. The parts are ordered by their first half-edges. Returns `None`
/// if diagonals cross, or if a part would have fewer than three sides.
pub fn polygon_parts(n: usize, diagonals: &[[u32; 2]]) -> Option<Vec<Vec<usize>>> {
    // The diagonals at each corner, counter-clockwise from the side that starts at the corner. At each corner, the
    // diagonal to the nearest following corner comes first. Each entry is (corner, distance to the other corner,
    // half-edge).
    let mut outgoing: Vec<(usize, usize, usize)> = Vec::with_capacity(2 * diagonals.len());
    for (k, diagonal) in diagonals.iter().enumerate() {
        let [a, b] = diagonal.map(|corner| corner as usize);
        outgoing.push((a, (b + n - a) % n, n + 2 * k));
        outgoing.push((b, (a + n - b) % n, n + 2 * k + 1));
    }
    outgoing.sort_unstable();
    // A half-edge that ends at a corner is followed by the next outgoing half-edge, clockwise around this corner.
    let mut next: Vec<usize> = (1..=n).map(|i| i % n).collect();
    next.resize(n + outgoing.len(), 0);
    let twin = |h: usize| n + ((h - n) ^ 1);
    let mut clockwise = 0;
    for (i, &(corner, _, h)) in outgoing.iter().enumerate() {
        let is_first = i == 0 || outgoing[i - 1].0 != corner;
        next[twin(h)] = if is_first { corner } else { clockwise };
        // The side that ends at the corner is followed by the last diagonal at the corner. Each diagonal overwrites
        // this entry, so the entry of the last diagonal remains.
        next[(corner + n - 1) % n] = h;
        clockwise = h;
    }

    let mut parts = Vec::with_capacity(diagonals.len() + 1);
    let mut is_used = vec![false; next.len()];
    for start in 0..next.len() {
        let mut part = Vec::new();
        let mut h = start;
        while !is_used[h] {
            is_used[h] = true;
            part.push(h);
            h = next[h];
        }
        if !part.is_empty() {
            parts.push(part);
        }
    }
    // If k diagonals do not cross, they divide the face into k + 1 parts. If diagonals cross, the traversal above finds
    // fewer parts, by Euler's formula.
    let is_flat = parts.len() == diagonals.len() + 1;
    (is_flat && parts.iter().all(|part| part.len() >= 3)).then_some(parts)
}

impl Mesh {
    /// Cuts a face along diagonals, given as pairs of corner indices. The face is divided into the parts that
    /// [`polygon_parts`] returns.
    ///
    /// The diagonals become edges, in order, each from its first corner to its second. The first part keeps the id and
    /// the first corner of the face. The other parts become new faces, numbered in order, with the values of the old
    /// face. The new corners at the ends of a diagonal have the values of the old corners there. The attribute values
    /// of new edges are zero. A diagonal can join two vertices that already share an edge.
    ///
    /// Returns all parts as faces, in the order of [`polygon_parts`].
    ///
    /// # Errors
    ///
    /// Returns [`EditError::Pinch`] if both ends of a diagonal are at the same vertex, which the face contains twice.
    /// Returns [`EditError::NoCut`] if any two diagonals cross or are equal, or if a diagonal joins neighboring
    /// corners. This error always names the ends of the first diagonal in the list. Returns [`EditError::NoSuchFace`]
    /// if the face does not exist, and [`EditError::Full`] if there are not enough ids for the new elements. After an
    /// error, the mesh is unchanged.
    ///
    /// # Panics
    ///
    /// Panics if a diagonal refers to a corner that the face does not have.
    pub fn cut_face(
        &mut self,
        f: FaceId,
        diagonals: &[[u32; 2]],
    ) -> Result<Vec<FaceId>, EditError> {
        self.check_face(f)?;
        let sides: Vec<HalfEdgeId> = self.face_half_edges(f).collect();
        let ends = |diagonal: &[u32; 2]| diagonal.map(|corner| self.origin(sides[corner as usize]));
        if let Some([v, _]) = diagonals.iter().map(ends).find(|[v, w]| v == w) {
            return Err(EditError::Pinch(v));
        }
        let Some(parts) = polygon_parts(sides.len(), diagonals) else {
            let [v, w] = ends(&diagonals[0]);
            return Err(EditError::NoCut(v, w));
        };
        self.check_room(2 * diagonals.len())?;
        self.drop_columns_by_rule();
        let mut half_edges = sides.clone();
        for diagonal in diagonals {
            let [x, y] = diagonal.map(|corner| sides[corner as usize]);
            half_edges.extend(self.push_diagonal(x, y));
        }
        let mut faces = Vec::with_capacity(parts.len());
        for part in parts {
            let around: Vec<HalfEdgeId> = part.iter().map(|&h| half_edges[h]).collect();
            let face = if faces.is_empty() {
                f
            } else {
                self.push_copy_of_face(f, around[0])
            };
            self.link_around(face, &around);
            faces.push(face);
        }
        Ok(faces)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_come_in_order_of_their_lowest_half_edge() {
        assert_eq!(polygon_parts(3, &[]).unwrap(), [[0, 1, 2]]);
        assert_eq!(polygon_parts(4, &[[0, 2]]).unwrap(), [[0, 1, 5], [2, 3, 4]]);
        assert_eq!(polygon_parts(4, &[[2, 0]]).unwrap(), [[0, 1, 4], [2, 3, 5]]);
        // The inner triangle of a hexagon has no side of the hexagon.
        let inner = polygon_parts(6, &[[0, 2], [2, 4], [0, 4]]).unwrap();
        assert_eq!(inner, [[0, 1, 7], [2, 3, 9], [4, 5, 10], [6, 8, 11]]);
    }

    #[test]
    fn diagonals_that_cross_or_repeat_or_follow_a_side_give_no_parts() {
        for diagonals in [
            vec![[0, 2], [1, 3]],
            vec![[0, 2], [2, 0]],
            vec![[0, 1]],
            vec![[4, 0]],
            vec![[1, 4], [0, 2], [2, 4]],
        ] {
            assert_eq!(polygon_parts(5, &diagonals), None, "{diagonals:?}");
        }
    }
}
