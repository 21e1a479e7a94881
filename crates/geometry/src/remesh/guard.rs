//! The limit on the distance between the original surface and the result.
//!
//! While the mesh changes, two distances are limited: from sample points of new triangles to the original surface, and
//! from removed points to the new triangles. At the end, the Hausdorff distance is measured; it takes all points of
//! both surfaces into account.

use mesh::{DVec3, FaceId, Mesh};
use progress::{Cancelled, Progress};

use super::original::Original;
use super::size::Sizes;
use super::work::Work;
use crate::Scaled;
use crate::distance::Distance;
use crate::surface_index::SurfaceIndex;
use crate::surface_index::triangle::nearest_on_triangle;

/// The largest allowed distance of a sample point from the other surface, as a fraction of the error limit. The rest of
/// the limit is a margin for the points between the samples.
const SHARE: f64 = 0.7;

/// The largest allowed distance between a sample point of a new triangle and the original surface, as a fraction of the
/// target length. This bound also applies if the caller gives no error limit. The bound prevents new edges from cutting
/// through ridges of the surface that are not marked as features.
const SOFT: f64 = 0.1;

/// The tolerance of the distance that is measured at the end, as a fraction of the error limit.
const TOLERANCE: f64 = 0.01;

impl Work<'_> {
    /// Whether a step that replaces triangles could move the surface too far. The limits are [`SHARE`] times the error
    /// limit, and [`SOFT`] times the target length. `new` lists the new triangles, each with an existing face of the
    /// same chart (a region between lines). `gone` lists points of the old triangles; their distances from the new
    /// triangles are tested.
    pub(super) fn is_far(&self, new: &[(FaceId, [DVec3; 3])], gone: &[DVec3]) -> bool {
        let sizes = new.iter().flat_map(|&(f, _)| self.mesh.face_vertices(f));
        let size = sizes.fold(f64::INFINITY, |size, v| size.min(self.sizes[v.index()]));
        let limit = (SHARE * self.limit.unwrap_or(f64::INFINITY)).min(SOFT * size);
        let is_far_from_new = |p: &DVec3| {
            let mut distances = new
                .iter()
                .map(|(_, t)| nearest_on_triangle(*p, t).distance(*p));
            distances.all(|distance| distance > limit)
        };
        let is_far_from_original = |&(f, [a, b, c]): &(FaceId, [DVec3; 3])| {
            let index = &self.original.indexes[self.charts[f.index()] as usize];
            let mut hint = self.hint_of(f);
            let middles = [0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)];
            [a / 3.0 + b / 3.0 + c / 3.0]
                .into_iter()
                .chain(middles)
                .any(|p| !index.is_within(p, limit, &mut hint))
        };
        gone.iter().any(is_far_from_new) || new.iter().any(is_far_from_original)
    }
}

/// Measures the distance between the original and the result. The measurement gives an upper bound of the distance.
/// Returns this bound if it is above the limit, and `None` otherwise.
pub(super) fn excess(
    source: &Mesh,
    result: &Mesh,
    limit: f64,
    progress: &dyn Progress,
) -> Result<Option<f64>, Cancelled> {
    if limit == f64::INFINITY {
        return Ok(None);
    }
    let distance = Distance::between_with(source, result, Some(TOLERANCE * limit), progress)?;
    let at_most = distance.map_or(0.0, |distance| distance.at_most());
    Ok((at_most > limit).then_some(at_most))
}

/// Halves the target lengths where the distance between the result and the original is more than half the limit.
pub(super) fn refine(
    original: &Original,
    sizes: &mut Sizes,
    result: &Mesh,
    limit: f64,
    progress: &dyn Progress,
) -> Result<(), Cancelled> {
    let [result, source] = Scaled::pair(result, original.source);
    let limit = source.scaled(limit);
    let (result, source) = (result.mesh(), source.mesh());
    let (Some(new), Some(old)) = (
        SurfaceIndex::with_progress(result, progress)?,
        SurfaceIndex::with_progress(source, progress)?,
    ) else {
        return Ok(());
    };
    let mut is_marked = vec![false; original.mesh.n_vertices()];
    let is_far = |distance: f64| distance > 0.5 * limit;
    for f in source.faces() {
        let center = source.face_center(f);
        if f.index() % 1024 == 0 {
            progress.report(super::WHAT, 0, 1)?;
        }
        let is_near_far = |p: DVec3| is_far(new.nearest(p, 0).distance);
        if is_near_far(center)
            || source
                .face_vertices(f)
                .any(|v| is_near_far(source.position(v)))
        {
            for v in source.face_vertices(f) {
                is_marked[v.index()] = true;
            }
        }
    }
    for f in result.faces() {
        if f.index() % 1024 == 0 {
            progress.report(super::WHAT, 0, 1)?;
        }
        let corners: Vec<DVec3> = result
            .face_vertices(f)
            .map(|v| result.position(v))
            .collect();
        let middles = (0..3).map(|i| 0.5 * (corners[i] + corners[(i + 1) % 3]));
        for p in middles.chain([result.face_center(f)]) {
            let nearest = old.nearest(p, 0);
            if is_far(nearest.distance) {
                for v in old.triangle(nearest.triangle).vertices {
                    is_marked[v.index()] = true;
                }
            }
        }
    }
    sizes.halve(original, &is_marked);
    Ok(())
}
