//! Tessellating patches into polygons.
//!
//! ```text
//!   (0,n) ------------ (n,n)      every patch is divided into n by n cells at u = i/n, v = j/n
//!     |  |  |  |  |  |  |
//!     |--d-----c--|--|--|         quads:      a b c d
//!     |  |   / |  |  |  |         triangles:  a b c  and  a c d, always along this diagonal
//!     |--a-----b--|--|--|
//!     |  |  |  |  |  |  |         v
//!   (0,0) ------------ (n,0)      ^  faces are counter-clockwise when seen from the side
//!                                 +-> u   that du x dv points to
//! ```
//!
//! Vertex ids increase along u first, then along v, then from patch to patch. Different patches share no vertices. To
//! join neighboring patches, weld the vertices of the result. Two patches can have the same control points on a common
//! boundary, in the same or in reverse order. Their vertices on this boundary then have the same positions, bit for
//! bit.
//!
//! A side of a patch is collapsed if its points coincide, as at the pole of a teapot's lid. A collapsed side becomes
//! one vertex. Adjacent collapsed sides together become one vertex. A cell (the area between neighboring samples) with
//! one collapsed side becomes a triangle. A cell with two or more collapsed sides is left out. To test whether a side
//! is collapsed, its boundary curve is sampled at i/m for i from 0 to m. The number m is n or 3, whichever is smaller,
//! where n is the number of segments. A side is collapsed if the coordinates of every sample differ from the
//! coordinates of the first sample by at most the tolerance. The tolerance is 1e-12 times the longest side of the
//! bounding box of the control points of the patch. The sides have the order v = 0, u = 1, v = 1, u = 0, and run
//! counter-clockwise around the patch. Adjacent collapsed sides become a vertex at the start of the first of these
//! sides. The UV and the normal of this vertex are the values at the middle of the first side.
//!
//! A patch is a curve or a point if all its rows of control points are the same or all its columns are the same. The
//! tolerance is the same as for collapsed sides. If a patch is a curve or a point, or if none of its cells becomes a
//! face, its tessellation has no vertices and no faces. The result lists these patches.
//!
//! The tessellation detects collapsed sides, and patches that are a curve or a point. It detects no other degeneracies.
//! Faces can have zero area if a patch folds onto itself. With too few segments, the corners of a cell can be
//! collinear, as at the tip of the teapot's spout with one segment.

use std::num::NonZero;

use glam::DVec2;

use crate::collapse::Sides;
use crate::weights::Weights;
use crate::{BezierError, Counts, Faces, Patch, Tessellation};

/// Tessellates `patches`, each into `segments` by `segments` cells.
///
/// The [module](self) documents the order of the vertex ids and how collapsed sides are handled. To report
/// progress or to allow cancellation, call [`tessellate_patch`] in a loop instead.
///
/// # Errors
///
/// Returns the errors of [`counts`] before anything is computed. Returns [`BezierError::OutOfMemory`] if there is not
/// enough memory.
pub fn tessellate(
    patches: &[Patch],
    segments: u32,
    faces: Faces,
) -> Result<Tessellation, BezierError> {
    let mut out = Tessellation::default();
    out.reserve(counts(patches, segments, faces)?)?;
    for patch in patches {
        tessellate_patch(patch, segments, faces, &mut out)?;
    }
    Ok(out)
}

/// Tessellates one patch and appends it to `out`. Existing ids do not change.
///
/// # Errors
///
/// Returns the errors of [`counts`] for the number of elements that `out` would have after the call. Returns
/// [`BezierError::OutOfMemory`] if there is not enough memory. If an error is returned, `out` is unchanged.
pub fn tessellate_patch(
    patch: &Patch,
    segments: u32,
    faces: Faces,
    out: &mut Tessellation,
) -> Result<(), BezierError> {
    let n = NonZero::new(segments).ok_or(BezierError::NoSegments)?.get();
    let sides = Sides::of(patch, n);
    let added = sides.counts(n, faces);
    out.counts().plus(&added).check()?;
    out.reserve(added)?;
    if added.faces == 0 {
        out.empty_patches.push(out.patches);
    } else {
        let mut tessellator = PatchTessellator {
            patch,
            n,
            sides,
            max_steps: patch.max_steps(),
            collapsed: [None; 4],
        };
        let mut below = tessellator.push_row(0, out);
        for j in 1..=n {
            let above = tessellator.push_row(j, out);
            push_faces(&below, &above, faces, out);
            below = above;
        }
    }
    out.patches += 1;
    Ok(())
}

/// Returns exactly how many elements the result of [`tessellate`] has, without computing the result.
///
/// # Errors
///
/// Returns [`BezierError::NoSegments`] if `segments` is 0. Returns [`BezierError::TooManyElements`] if the number of
/// vertices, faces or face corners does not fit 32-bit ids.
pub fn counts(patches: &[Patch], segments: u32, faces: Faces) -> Result<Counts, BezierError> {
    let n = NonZero::new(segments).ok_or(BezierError::NoSegments)?.get();
    let total = patches.iter().fold(Counts::default(), |total, patch| {
        total.plus(&Sides::of(patch, n).counts(n, faces))
    });
    total.check()?;
    Ok(total)
}

struct PatchTessellator<'a> {
    patch: &'a Patch,
    n: u32,
    sides: Sides,
    /// See [`Patch::max_steps`].
    max_steps: DVec2,
    /// Each chain of adjacent collapsed sides becomes one vertex, whose id is stored at the first side of the chain.
    /// `None` until the vertex is added.
    collapsed: [Option<u32>; 4],
}

impl PatchTessellator<'_> {
    /// Adds the vertices of row `j`, except the vertices of collapsed sides that were already added. Returns the ids of
    /// all vertices of the row, along u.
    fn push_row(&mut self, j: u32, out: &mut Tessellation) -> Vec<u32> {
        let (n, sides) = (self.n, self.sides);
        let chains = sides.chains();
        let mut row = Vec::new();
        for i in 0..=n {
            let on_side = [j == 0, i == n, j == n, i == 0];
            let collapsed = (0..4).find(|&k| on_side[k] && sides.collapsed[k]);
            row.push(match collapsed.map(|side| chains[side]) {
                None => self.push_vertex(i, j, out),
                Some(side) => *self.collapsed[side]
                    .get_or_insert_with(|| push_collapsed(self.patch, side, out)),
            });
        }
        row
    }

    /// Adds the vertex at (i/n, j/n).
    fn push_vertex(&self, i: u32, j: u32, out: &mut Tessellation) -> u32 {
        let (u, v) = (Weights::ratio(i, self.n), Weights::ratio(j, self.n));
        let normal = self.patch.normal_at(u, v, self.max_steps);
        out.push_vertex(self.patch.point_at(u, v), normal, DVec2::new(u.t, v.t))
    }
}

/// Adds the vertex of a collapsed side.
fn push_collapsed(patch: &Patch, side: usize, out: &mut Tessellation) -> u32 {
    let p = patch.points();
    let start = [p[0][0], p[0][3], p[3][3], p[3][0]][side];
    let [u, v] = [[0.5, 0.0], [1.0, 0.5], [0.5, 1.0], [0.0, 0.5]][side];
    out.push_vertex(start, patch.normal(u, v), DVec2::new(u, v))
}

/// Adds the faces between two rows of vertices.
fn push_faces(below: &[u32], above: &[u32], faces: Faces, out: &mut Tessellation) {
    for (low, high) in below.windows(2).zip(above.windows(2)) {
        let [a, b, c, d] = [low[0], low[1], high[1], high[0]];
        match faces {
            Faces::Quads => out.push_face([a, b, c, d]),
            Faces::Triangles => {
                out.push_face([a, b, c]);
                out.push_face([a, c, d]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::fixtures::{Lcg, octant, quarter_turn, squared};

    const KINDS: [Faces; 2] = [Faces::Triangles, Faces::Quads];

    /// Returns patches for the tests: for every subset of the four sides, a patch in which exactly these sides are
    /// collapsed.
    fn collapsed_patches() -> Vec<Patch> {
        let mut random = Lcg::new(41);
        let sides = [
            [(0, 0), (0, 1), (0, 2), (0, 3)],
            [(0, 3), (1, 3), (2, 3), (3, 3)],
            [(3, 0), (3, 1), (3, 2), (3, 3)],
            [(0, 0), (1, 0), (2, 0), (3, 0)],
        ];
        let mut patches = Vec::new();
        for mask in 0..16 {
            let mut points = *random.patch().points();
            // Collapsing one side can move the end of an adjacent collapsed side. Therefore each chosen side is
            // collapsed twice, so that adjacent collapsed sides become the same point.
            for _ in 0..2 {
                for (k, side) in sides
                    .iter()
                    .enumerate()
                    .filter(|(k, _)| mask & (1 << k) != 0)
                {
                    let meets_0 = mask & 1 != 0 && (k == 1 || k == 3);
                    let meets_2 = mask & 4 != 0 && (k == 1 || k == 3);
                    let (r, c) = if meets_2 && !meets_0 {
                        side[3]
                    } else {
                        side[0]
                    };
                    let point = points[r][c];
                    for &(r, c) in side {
                        points[r][c] = point;
                    }
                }
            }
            patches.push(Patch::new(points).unwrap());
        }
        patches
    }

    fn bits(points: impl IntoIterator<Item = DVec3>) -> Vec<[u64; 3]> {
        points
            .into_iter()
            .map(|p| p.to_array().map(f64::to_bits))
            .collect()
    }

    /// Returns the positions along a side, in the direction of increasing u or v. Sides 0 to 3 are v = 0, u = 1, v = 1
    /// and u = 0.
    fn side_positions(patch: &Patch, n: u32, side: usize) -> Vec<DVec3> {
        let mesh = tessellate(&[*patch], n, Faces::Quads).unwrap();
        let m = n as usize;
        let p = |i: usize, j: usize| mesh.positions[j * (m + 1) + i];
        (0..=m)
            .map(|k| [p(k, 0), p(m, k), p(k, m), p(0, k)][side])
            .collect()
    }

    #[test]
    fn a_patch_with_two_segments_becomes_eight_triangles_or_four_quads() {
        let patch = Lcg::new(42).patch();
        let triangles = tessellate(&[patch], 2, Faces::Triangles).unwrap();
        let quads = tessellate(&[patch], 2, Faces::Quads).unwrap();

        assert_eq!((triangles.positions.len(), triangles.face_count()), (9, 8));
        assert_eq!(triangles.indices[..6], [0, 1, 4, 0, 4, 3]);
        assert_eq!((quads.positions.len(), quads.face_count()), (9, 4));
        assert_eq!(quads.faces().last().unwrap(), [4, 5, 8, 7]);
    }

    #[test]
    fn a_pole_becomes_one_vertex_with_a_fan_of_triangles() {
        let mesh = tessellate(&[octant()], 3, Faces::Quads).unwrap();
        let degrees: Vec<usize> = mesh.faces().map(<[u32]>::len).collect();

        assert_eq!(mesh.positions.len(), 13);
        assert_eq!(degrees, [4, 4, 4, 4, 4, 4, 3, 3, 3]);
        assert_eq!(mesh.positions[12], DVec3::Z);
        assert_eq!(mesh.uvs[12], DVec2::new(0.5, 1.0));
        assert!(mesh.normals[12].distance(DVec3::Z) < 1e-12);
    }

    #[test]
    fn counts_are_exact_for_every_set_of_collapsed_sides() {
        for (mask, patch) in collapsed_patches().iter().enumerate() {
            for n in 1..6 {
                for faces in KINDS {
                    let mesh = tessellate(&[*patch], n, faces).unwrap();
                    let expected = counts(&[*patch], n, faces).unwrap();
                    assert_eq!(mesh.counts(), expected, "sides {mask:04b}, {n} segments");
                    assert_eq!(mesh.empty_patches.is_empty(), expected.faces > 0);
                    // Every vertex belongs to a face, and no face contains a vertex twice.
                    let mut is_used = vec![false; mesh.positions.len()];
                    for face in mesh.faces() {
                        for &v in face {
                            is_used[v as usize] = true;
                        }
                        let mut sorted = face.to_vec();
                        sorted.sort_unstable();
                        assert!(sorted.windows(2).all(|pair| pair[0] != pair[1]));
                    }
                    assert!(
                        is_used.iter().all(|&is_used| is_used),
                        "sides {mask:04b}, {n} segments"
                    );
                }
            }
        }
    }

    #[test]
    fn faces_have_area_and_their_normals_are_near_the_exact_normals() {
        let lid = quarter_turn([[0.0, 3.15], [0.8, 3.15], [0.0, 2.85], [0.2, 2.7]]);
        let bottom = quarter_turn([[0.0, 0.0], [1.4, 0.0], [1.5, 0.1], [1.5, 0.2]]);
        for patch in [octant(), octant().transposed(), bottom, lid, squared()] {
            let mesh = tessellate(&[patch], 8, Faces::Triangles).unwrap();
            assert!(mesh.normals.iter().all(|n| n.is_normalized()));
            for face in mesh.faces() {
                let [a, b, c] = [0, 1, 2].map(|k| mesh.positions[face[k] as usize]);
                let area = (b - a).cross(c - a) / 2.0;
                assert!(area.length() > 1e-6);
                for &v in face {
                    assert!(area.normalize().dot(mesh.normals[v as usize]) > 0.3);
                }
            }
        }
    }

    #[test]
    fn positions_and_normals_are_those_of_the_patch() {
        let patch = Lcg::new(43).patch();
        let mesh = tessellate(&[patch], 5, Faces::Quads).unwrap();
        for ((uv, normal), position) in mesh.uvs.iter().zip(&mesh.normals).zip(&mesh.positions) {
            assert!(patch.normal(uv.x, uv.y).distance(*normal) < 1e-12);
            assert!(patch.point(uv.x, uv.y).distance(*position) < 1e-14);
        }
    }

    #[test]
    fn a_shared_boundary_is_equal_bit_for_bit_in_every_direction() {
        let mut random = Lcg::new(44);
        for n in [1, 2, 3, 7, 10, 49] {
            let shared = [(); 4].map(|()| random.point() * 100.0 + DVec3::splat(0.1));
            let mut expected = None;
            for side in 0..4 {
                for reversed in [false, true] {
                    let mut points = *random.patch().points();
                    for k in 0..4 {
                        let (r, c) = [(0, k), (k, 3), (3, k), (k, 0)][side];
                        points[r][c] = shared[if reversed { 3 - k } else { k }];
                    }
                    let mut positions = side_positions(&Patch::new(points).unwrap(), n, side);
                    if reversed {
                        positions.reverse();
                    }
                    let actual = bits(positions);
                    assert_eq!(&actual, expected.get_or_insert_with(|| actual.clone()));
                }
            }
        }
    }

    #[test]
    fn signed_zeros_of_a_shared_boundary_are_kept() {
        let mut random = Lcg::new(45);
        let shared = [1.0, -0.0, 0.0, -0.0].map(|x| DVec3::new(x, -0.0, 0.0));
        let mut sides = Vec::new();
        for _ in 0..2 {
            let mut points = *random.patch().points();
            points[0] = shared;
            let patch = Patch::new(points).unwrap();
            sides.push(bits(side_positions(&patch, 5, 0)));
            sides.push(bits(side_positions(&patch.transposed(), 5, 3)));
        }
        assert!(sides.iter().all(|side| *side == sides[0]));
    }

    #[test]
    fn elements_are_in_the_order_of_patches_and_empty_patches_are_listed() {
        let mut random = Lcg::new(46);
        let patches = [
            random.patch(),
            Patch::new([[DVec3::ONE; 4]; 4]).unwrap(),
            random.patch(),
        ];
        let mesh = tessellate(&patches, 2, Faces::Quads).unwrap();

        assert_eq!((mesh.patches, mesh.empty_patches), (3, vec![1]));
        assert_eq!(mesh.offsets, [0, 4, 8, 12, 16, 20, 24, 28, 32]);
        assert_eq!(mesh.indices[16..20], [9, 10, 13, 12]);
    }

    #[test]
    fn patches_without_area_give_no_elements_and_are_listed() {
        let mut random = Lcg::new(47);
        let curve = Patch::new([(); 4].map(|()| [random.point(); 4])).unwrap();
        let mesh = tessellate(&[curve, curve.transposed()], 9, Faces::Triangles).unwrap();
        assert_eq!(
            (mesh.counts(), mesh.empty_patches),
            (Counts::default(), vec![0, 1])
        );

        // The patch is a tube. With one segment around the tube, each cell would become a line.
        let mut points = *random.patch().points();
        for row in &mut points {
            row[3] = row[0];
        }
        let tube = [Patch::new(points).unwrap()];
        assert_eq!(
            tessellate(&tube, 1, Faces::Quads).unwrap().empty_patches,
            [0]
        );
        assert_eq!(tessellate(&tube, 2, Faces::Quads).unwrap().face_count(), 4);
    }

    #[test]
    fn too_many_elements_are_refused_before_anything_is_computed() {
        let patch = [octant()];
        assert_eq!(
            counts(&patch, 0, Faces::Quads),
            Err(BezierError::NoSegments)
        );
        for segments in [65_536, u32::MAX] {
            let error = tessellate(&patch, segments, Faces::Triangles).unwrap_err();
            assert!(matches!(error, BezierError::TooManyElements(_)), "{error}");
        }
        let mut out = tessellate(&patch, 2, Faces::Quads).unwrap();
        let before = out.clone();
        assert!(tessellate_patch(&patch[0], 40_000, Faces::Triangles, &mut out).is_err());
        assert_eq!(out, before);
        assert_eq!(
            counts(&patch, 20_000, Faces::Quads).unwrap(),
            Counts {
                vertices: 400_020_001,
                faces: 400_000_000,
                corners: 1_599_980_000
            }
        );
    }
}
