//! Finds, for each element of the target (the changed mesh), the elements of the source (the other mesh) from which it
//! takes its values.

use geometry::surface_index::{Nearest, SurfaceIndex, Triangle};
use mesh::{Domain, HalfEdgeId, Mesh, Values};
use op::prelude::*;

use super::charts::Charts;

/// The elements of the source from which one element of the target takes its values, each with a weight. `None` if the
/// source is too far away.
pub(super) type Origin = Option<[(usize, f64); 3]>;

/// The mesh from which attributes are copied, and its spatial index.
pub(super) struct Source<'a> {
    pub(super) mesh: &'a Mesh,
    pub(super) index: &'a SurfaceIndex,
    /// The largest distance from the source at which an element of the target takes a value.
    pub(super) within: f64,
}

impl Source<'_> {
    fn near(&self, hit: &Nearest) -> Option<Triangle> {
        (hit.distance <= self.within).then(|| self.index.triangle(hit.triangle))
    }

    pub(super) fn of_vertex(&self, hit: &Nearest) -> Origin {
        let triangle = self.near(hit)?;
        let weights = triangle.barycentric(hit.point);
        Some([0, 1, 2].map(|k| (triangle.vertices[k].index(), weights[k])))
    }

    pub(super) fn of_face(&self, hit: &Nearest) -> Origin {
        let face = self.near(hit)?.face.index();
        Some([(face, 1.0), (face, 0.0), (face, 0.0)])
    }

    /// Returns the origins of the corners of the target. The origin of a corner has the same index as the half-edge of
    /// this corner. `vertices` and `faces` contain the points of the source that are nearest to the vertices and to the
    /// face centers of the target.
    pub(super) fn of_corners(
        &self,
        target: &Mesh,
        values: &Values,
        vertices: &[Nearest],
        faces: &[Nearest],
        cx: &Context,
    ) -> Result<Vec<Origin>, OpError> {
        let mut charts = Charts::new(self.mesh, values, cx.progress())?;
        let mut origins = vec![None; target.domain_len(Domain::Corner)];
        for (i, (f, center)) in target.faces().zip(faces).enumerate() {
            if i % 1024 == 0 {
                cx.advance("transfer corners", i as u64, faces.len() as u64)?;
            }
            let hit_of = |h: HalfEdgeId| &vertices[target.origin(h).index()];
            let corners = || target.face_half_edges(f).map(hit_of);
            let farthest = corners().fold(center.distance, |d, hit| d.max(hit.distance));
            if farthest > self.within {
                continue;
            }
            let face_of = |hit: &Nearest| self.index.triangle(hit.triangle).face;
            let chart_of = |charts: &Charts, hit: &Nearest| charts.of_face[face_of(hit).index()];
            let mut candidates = vec![chart_of(&charts, center)];
            for chart in corners().map(|hit| chart_of(&charts, hit)) {
                if !candidates.contains(&chart) {
                    candidates.push(chart);
                }
            }
            let chart = charts.nearest(&candidates, target, f, cx.progress())?;
            let side = charts.side_under(chart, target, f, farthest, cx.progress())?;
            for h in target.face_half_edges(f) {
                let hit = hit_of(h);
                let position = target.position(target.origin(h));
                let (triangle, point) = match &side {
                    Some(side) if !side.faces.contains(&face_of(hit)) => {
                        let hit = side.index.nearest(position, 0);
                        (side.index.triangle(hit.triangle), hit.point)
                    }
                    None if chart_of(&charts, hit) != chart => {
                        let index = charts.index(chart, cx.progress())?;
                        let hit = index.nearest(position, 0);
                        (index.triangle(hit.triangle), hit.point)
                    }
                    _ => (self.index.triangle(hit.triangle), hit.point),
                };
                let weights = triangle.barycentric(point);
                origins[h.index()] =
                    Some([0, 1, 2].map(|k| (triangle.corners[k].index(), weights[k])));
            }
        }
        Ok(origins)
    }
}
