//! Unwrapping: new texture coordinates for a surface.

use mesh::{DVec2, EdgeId, FaceId, Mesh};
use progress::Progress;

use super::chart::Limits;
use super::cut;
use super::pack::pack;
use super::surface::Surface;
use super::{Charts, Page, UvError, charts};

/// The options of [`unwrap`].
#[derive(Clone, Copy, Debug)]
pub struct UnwrapOptions<'a> {
    /// Edges along which the surface is cut: they always become borders of charts.
    pub seams: &'a [EdgeId],
    /// The largest angle between the normal of a face and the mean normal of its chart, in degrees, strictly between 0
    /// and 90.
    pub max_angle: f64,
    /// The largest allowed ratio, at least 1, between the area scale of a triangle and the mean scale of its chart. The
    /// ratio is the larger of the two scales, divided by the smaller. The area scale of a triangle is its area in the
    /// texture, divided by its area on the surface.
    pub max_stretch: f64,
    /// The size of the texture, and the padding around the charts.
    pub page: Page,
}

/// The texture coordinates of an unwrapped mesh.
#[derive(Clone, Debug)]
pub struct Unwrapped {
    /// The texture coordinates of each half-edge, from 0 to 1. For half-edges without a face, they are zero.
    pub uvs: Vec<DVec2>,
    /// The charts.
    pub charts: Charts,
    /// The area of all charts together, as a fraction of the area of the page.
    pub coverage: f64,
    /// The faces that contain a triangle with zero area in the texture. A triangle whose area becomes zero when the
    /// coordinates are rounded to 32 bits counts too.
    pub flat: Vec<FaceId>,
    /// The polygons that are bent so strongly that each of them overlaps itself in the texture.
    pub bent: Vec<FaceId>,
}

/// Computes texture coordinates for all faces of a dense mesh. The faces do not overlap in the texture, except that
/// each face in [`Unwrapped::bent`] overlaps itself.
///
/// Charts grow from flat regions. Each chart is first flattened by a least squares conformal map (Levy, Petitjean, Ray,
/// Maillot, "Least Squares Conformal Maps for Automatic Texture Atlas Generation", 2002). Then the hybrid method
/// improves this map (Liu, Zhang, Xu, Gotsman, Gortler, "A Local/Global Approach to Mesh Parameterization", 2008). A
/// chart of several faces is cut in two if it would overlap itself or be stretched too much. In the result, each chart
/// of several faces has an aspect of at most 1.15 on 95 % of its area (see [`Stretch`](super::Stretch)). Two charts
/// with a common border are joined again if the joined chart neither overlaps itself nor is stretched too much.
/// Finally, a chart is dissolved if its faces can be divided among the charts around it without exceeding the same
/// limits. All charts have the same scale. No chart is mirrored, and no polygon is split. The charts are packed by
/// [`pack`].
///
/// The result does not depend on the number of threads or on the processor.
///
/// # Errors
///
/// Returns an [`UvError`] if the surface cannot be unwrapped.
pub fn unwrap(
    mesh: &Mesh,
    options: &UnwrapOptions,
    progress: &dyn Progress,
) -> Result<Unwrapped, UvError> {
    let mut is_seam = vec![false; mesh.n_edges()];
    for e in options.seams {
        is_seam[e.index()] = true;
    }
    let surface = Surface::new(mesh, is_seam);
    let limits = Limits {
        min_cosine: libm::cos(options.max_angle.to_radians()),
        max_stretch: options.max_stretch,
    };
    let list = cut::charts(&surface, limits, progress)?;
    let mut uvs = vec![DVec2::ZERO; mesh.n_half_edges()];
    // Before the packing, the charts are placed side by side. Otherwise, two charts could have the same coordinates at
    // a common edge, and would count as one chart.
    let mut at = 0.0;
    for chart in &list {
        let low = chart.uvs.iter().copied().fold(DVec2::MAX, DVec2::min);
        let high = chart.uvs.iter().copied().fold(DVec2::MIN, DVec2::max);
        for (h, &v) in chart.part.corners.iter().zip(&chart.part.vertices) {
            uvs[h.index()] = chart.uvs[v as usize] - low + DVec2::new(at, 0.0);
        }
        at += (high - low).x + 1.0;
    }
    let packed = pack(mesh, &uvs, options.page, progress)?;
    let mut uvs = packed.uvs;
    collapse(&surface, &mut uvs);
    let bent = list.iter().filter(|chart| chart.is_bent);
    let mut bent: Vec<FaceId> = bent
        .flat_map(|chart| &chart.part.faces)
        .map(|&f| FaceId::new(f as usize))
        .collect();
    bent.sort_unstable();
    let mut flat = Vec::new();
    for triangle in &surface.triangles {
        let [a, b, c] = triangle.map(|h| uvs[h.index()]);
        if (b - a).perp_dot(c - a) <= 0.0 {
            flat.extend(mesh.face(triangle[0]));
        }
    }
    flat.dedup();
    flat.retain(|f| bent.binary_search(f).is_err());
    Ok(Unwrapped {
        charts: charts(mesh, &uvs),
        coverage: packed.coverage,
        uvs,
        flat,
        bent,
    })
}

/// For each face with zero area, gives all corners the same texture coordinates, which are copied from a face with a
/// nonzero area at one of its vertices.
fn collapse(surface: &Surface, uvs: &mut [DVec2]) {
    let mesh = surface.mesh;
    for f in mesh.faces().filter(|f| surface.areas[f.index()] <= 0.0) {
        let around = mesh
            .face_vertices(f)
            .flat_map(|v| mesh.vertex_half_edges(v));
        let mut solid =
            around.filter(|&h| mesh.face(h).is_some_and(|g| surface.areas[g.index()] > 0.0));
        let at = solid.next().map_or(DVec2::ZERO, |h| uvs[h.index()]);
        for h in mesh.face_half_edges(f) {
            uvs[h.index()] = at;
        }
    }
}
