//! A bound on the distance by which a collapse moves the surface.
//!
//! The triangles around an edge, before and after its collapse, are projected along one direction. Suppose that both
//! the old and the new triangles cover the same region exactly once. Then each point of the old triangles forms a pair
//! with the point of the new triangles that is directly above or below it. A cell is the region that one old and one
//! new triangle share. Within a cell, the distance between the two points of a pair is largest at a corner of the cell.
//! The largest distance of all pairs is an upper bound of the Hausdorff distance. Source: Cohen, Manocha, Olano,
//! "Simplifying Polygonal Models Using Successive Mappings", 1997.

use mesh::{DVec3, EdgeId, FaceId};

use crate::surface_index::triangle::nearest_on_segment;

use super::Blocked;
use super::collapser::Collapser;
use super::target::Target;

impl Collapser<'_> {
    /// Returns the faces that remain around an edge after its collapse, each with a bound on its distance to the
    /// original surface. The bounds are in the scaled coordinates of the [`Collapser`]. If there is no error limit,
    /// returns an empty list.
    pub(super) fn errors_after(
        &self,
        e: EdgeId,
        target: &Target,
    ) -> Result<Vec<(FaceId, f64)>, Blocked> {
        let Some(limit) = self.options.error else {
            return Ok(Vec::new());
        };
        let [a, b] = self.mesh.edge_vertices(e);
        let (mut old, mut new, mut faces) = (Vec::new(), Vec::new(), Vec::new());
        for (v, other) in [(a, b), (b, a)] {
            for h in self.mesh.vertex_half_edges(v) {
                let Some(f) = self.mesh.face(h) else {
                    continue;
                };
                let next = self.mesh.next(h);
                let is_beside = [self.mesh.origin(next), self.mesh.target(next)].contains(&other);
                let triangle = self.triangle(h);
                // A triangle beside the edge has both ends as corners, so the loop visits the triangle twice. It is
                // listed once as an old triangle, and never as a new one, because the collapse removes it.
                if !is_beside || v == a {
                    old.push((triangle, self.errors[f.index()]));
                }
                if !is_beside {
                    new.push([target.point, triangle[1], triangle[2]]);
                    faces.push(f);
                }
            }
        }
        let patch = Patch {
            old,
            new,
            cut: self.cut(e, target),
        };
        let bounds = patch.bounds().ok_or(Blocked::Error)?;
        if bounds.iter().any(|&bound| bound > limit * self.scale) {
            return Err(Blocked::Error);
        }
        Ok(faces.into_iter().zip(bounds).collect())
    }

    /// If `e` is a boundary edge, returns three positions: the end of `e` that the collapse removes, and the two ends
    /// of a new edge. The new edge replaces the two boundary edges at the removed end.
    fn cut(&self, e: EdgeId, target: &Target) -> Option<(DVec3, [DVec3; 2])> {
        let h = e
            .half_edges()
            .into_iter()
            .find(|&h| self.mesh.face(h).is_none())?;
        let (first, last) = (self.mesh.origin(h), self.mesh.target(h));
        let [removed, neighbor] = if target.end == Some(last) {
            [first, self.mesh.origin(self.mesh.prev(h))]
        } else {
            [last, self.mesh.target(self.mesh.next(h))]
        };
        Some((
            self.position(removed),
            [target.point, self.position(neighbor)],
        ))
    }
}

/// The triangles around an edge before and after its collapse, each with its corners in counter-clockwise order.
struct Patch {
    /// The triangles before the collapse, each with the bound on its distance to the original surface.
    old: Vec<([DVec3; 3], f64)>,
    /// The triangles after the collapse. The first corner of each triangle is the new vertex.
    new: Vec<[DVec3; 3]>,
    /// If the collapsed edge is a boundary edge: the position of the removed end, and the two ends of a new edge. The
    /// new edge replaces the two boundary edges at the removed end.
    cut: Option<(DVec3, [DVec3; 2])>,
}

/// Each bound is increased by this fraction of itself to allow for rounding errors.
const SLACK: f64 = 1e-9;

impl Patch {
    /// Returns, for each new triangle, a bound on its distance to the original surface. The old and the new triangles
    /// are projected along the mean normal. Returns `None` if a projected triangle is turned over or degenerate, or if
    /// the new triangles make more than one full turn around the new vertex.
    fn bounds(&self) -> Option<Vec<f64>> {
        let twice_area = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a);
        let sum: DVec3 = self
            .old
            .iter()
            .map(|&(triangle, _)| twice_area(triangle))
            .sum();
        let z = sum.try_normalize()?;
        let x = z.any_orthonormal_vector();
        let y = z.cross(x);
        let origin = self.new.first()?[0];
        let seen = |p: DVec3| {
            DVec3::new(
                (p - origin).dot(x),
                (p - origin).dot(y),
                (p - origin).dot(z),
            )
        };
        let new: Vec<[DVec3; 3]> = self.new.iter().map(|t| t.map(seen)).collect();
        let old: Vec<([DVec3; 3], f64)> = self
            .old
            .iter()
            .map(|(t, bound)| (t.map(seen), *bound))
            .collect();
        let faces_ahead = |&t: &[DVec3; 3]| twice_area(t).z > 0.0;
        let all = || new.iter().chain(old.iter().map(|(t, _)| t));
        if !all().all(faces_ahead) || n_turns(&new) > 1 {
            return None;
        }
        // In the projection, a point between the old and the new boundary is covered either only by the old triangles
        // or only by the new triangles. If only the old triangles cover the point, its distance from the new triangles
        // is at most its distance from the new boundary. The same is true with old and new exchanged.
        let beyond = self.cut.map_or(0.0, |(removed, [p, q])| {
            let largest = self
                .old
                .iter()
                .fold(0.0, |largest: f64, &(_, bound)| largest.max(bound));
            largest + removed.distance(nearest_on_segment(removed, p, q))
        });
        let bound = |new: &[DVec3; 3]| {
            let cells = old
                .iter()
                .map(|&(old, before)| cell_gap(&old, new).map_or(0.0, |gap| before + gap));
            cells.fold(beyond, f64::max) * (1.0 + SLACK)
        };
        Some(new.iter().map(bound).collect())
    }
}

/// Returns how many full turns the triangles make around their common first corner, rounded up or down to a whole
/// number.
fn n_turns(triangles: &[[DVec3; 3]]) -> usize {
    // In each full turn around the corner, exactly one triangle crosses the half-line that starts at the corner in the
    // direction of the x axis.
    let crosses = |&&[p, a, b]: &&[DVec3; 3]| a.y < p.y && b.y >= p.y;
    triangles.iter().filter(crosses).count()
}

/// Returns the largest difference in height (z) between two triangles, measured where one is directly above or below
/// the other. Returns `None` if there is no such place.
fn cell_gap(old: &[DVec3; 3], new: &[DVec3; 3]) -> Option<f64> {
    // Clips the old triangle by the lines through the sides of the new triangle. Each cut adds at most one corner.
    let (mut cell, mut n) = ([DVec3::ZERO; 6], 3);
    cell[..3].copy_from_slice(old);
    for i in 0..3 {
        let (a, b) = (new[i], new[(i + 1) % 3]);
        let side = |p: DVec3| (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
        let (mut cut, mut m) = ([DVec3::ZERO; 6], 0);
        for j in 0..n {
            let (p, q) = (cell[j], cell[(j + 1) % n]);
            let (at_p, at_q) = (side(p), side(q));
            if at_p >= 0.0 {
                push(&mut cut, &mut m, p);
            }
            if (at_p < 0.0) != (at_q < 0.0) {
                push(&mut cut, &mut m, p + (q - p) * (at_p / (at_p - at_q)));
            }
        }
        (cell, n) = (cut, m);
        if n == 0 {
            return None;
        }
    }
    let [a, b, c] = *new;
    let normal = (b - a).cross(c - a);
    // The height of the plane of the new triangle directly above or below p.
    let height = |p: DVec3| a.z - (normal.x * (p.x - a.x) + normal.y * (p.y - a.y)) / normal.z;
    Some(
        cell[..n]
            .iter()
            .fold(0.0, |gap: f64, &p| gap.max((p.z - height(p)).abs())),
    )
}

/// Appends a corner to the polygon. Because of rounding, the clipped polygon can get more than six corners; in this
/// case, the new corner replaces the last one.
fn push(corners: &mut [DVec3; 6], n: &mut usize, p: DVec3) {
    corners[(*n).min(5)] = p;
    *n = (*n + 1).min(6);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_gap_of_a_cell_is_largest_at_its_corners() {
        let old = [(0.0, 0.0), (4.0, 0.0), (0.0, 4.0)].map(|(x, y)| DVec3::new(x, y, 0.0));
        let new = [(1.0, 1.0, 2.0), (9.0, 1.0, 2.0), (1.0, 9.0, 2.0)].map(DVec3::from);
        assert_eq!(cell_gap(&old, &new), Some(2.0));
        let tilted = [(0.0, 0.0, 0.0), (4.0, 0.0, 1.0), (0.0, 4.0, 0.0)].map(DVec3::from);
        assert_eq!(cell_gap(&old, &tilted), Some(1.0));
        let away = new.map(|p| p + DVec3::new(5.0, 5.0, 0.0));
        assert_eq!(cell_gap(&old, &away), None);
    }

    #[test]
    fn a_flat_patch_has_no_distance() {
        let [a, b, c, d] =
            [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| DVec3::new(x, y, 3.0));
        let middle = DVec3::new(0.5, 0.25, 3.0);
        let fan = [
            [middle, a, b],
            [middle, b, c],
            [middle, c, d],
            [middle, d, a],
        ];
        let old = fan.map(|triangle| (triangle, 0.25)).to_vec();
        let patch = Patch {
            old,
            new: vec![[b, c, d], [b, d, a]],
            cut: None,
        };
        let bounds = patch.bounds().unwrap();
        assert!(
            bounds.iter().all(|bound| (bound - 0.25).abs() < 1e-8),
            "{bounds:?}"
        );
    }
}
