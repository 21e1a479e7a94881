//! Measures how much a texture is stretched.

use mesh::{DVec2, DVec3, HalfEdgeId, Mesh};

use crate::tangent::triangles;

/// Measures of how much a texture is stretched. A small circle on a triangle of the surface becomes an ellipse in the
/// texture. The aspect is the ratio of the longer to the shorter axis of the ellipse: 1 if angles are preserved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// The 95th percentile of the aspect: on 95 % of the area of the surface, the aspect is at most this value. The
    /// value is infinite if more than 5 % of the surface is mapped to zero area in the texture.
    pub aspect: f64,
    /// The largest aspect of any triangle.
    pub max_aspect: f64,
    /// The number of triangles that are mirrored in the texture: their corners are in clockwise order, with v pointing
    /// upwards.
    pub n_mirrored: usize,
    /// The ratio of the largest to the smallest area scale. The area scale of a triangle is its area in the texture,
    /// divided by its area on the surface. The ratio leaves out the 2.5 % of the surface with the largest scales and
    /// the 2.5 % with the smallest scales. The ratio is 1 if the scale is the same everywhere in the texture.
    pub scales: f64,
}

/// Measures how much a texture is stretched. Triangles with zero area on the surface are ignored. Polygons are
/// triangulated. Returns `None` if all triangles have zero area.
pub fn stretch(mesh: &Mesh, uvs: &[DVec2]) -> Option<Stretch> {
    let mut n_mirrored = 0;
    let mut aspects = Vec::new();
    let mut scales = Vec::new();
    for triangle in triangles(mesh) {
        let Some((map, area)) = jacobian(mesh, uvs, triangle) else {
            continue;
        };
        let determinant = map[0].perp_dot(map[1]);
        n_mirrored += usize::from(determinant < 0.0);
        aspects.push((aspect(map), area));
        scales.push((determinant.abs(), area));
    }
    let total: f64 = aspects.iter().map(|(_, area)| area).sum();
    if total.is_nan() || total <= 0.0 {
        return None;
    }
    let aspect = percentile(&mut aspects, 0.95 * total);
    let low = percentile(&mut scales, 0.025 * total);
    let high = percentile(&mut scales, 0.975 * total);
    Some(Stretch {
        aspect,
        max_aspect: aspects.last()?.0,
        n_mirrored,
        scales: if low > 0.0 { high / low } else { f64::INFINITY },
    })
}

/// Returns the triangles of all faces, each with its aspect (see [`Stretch`]). The aspect is at least 1; it is 1 if the
/// texture preserves the angles of the triangle. Triangles with zero area on the surface are left out.
pub fn aspects(mesh: &Mesh, uvs: &[DVec2]) -> impl Iterator<Item = ([HalfEdgeId; 3], f64)> {
    triangles(mesh).into_iter().filter_map(|triangle| {
        let (map, _) = jacobian(mesh, uvs, triangle)?;
        Some((triangle, aspect(map)))
    })
}

/// Sorts pairs (value, weight) by value, and adds up their weights in this order. Returns the value at which the sum
/// first reaches `weight`.
pub(super) fn percentile(values: &mut [(f64, f64)], weight: f64) -> f64 {
    values.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut sum = 0.0;
    let mut at = values.iter().skip_while(|(_, w)| {
        sum += w;
        sum < weight
    });
    at.next().or(values.last()).map_or(1.0, |(value, _)| *value)
}

/// Returns the derivatives of the texture coordinates along two perpendicular unit vectors in the plane of a triangle,
/// and the area of the triangle on the surface. Returns `None` if this area is zero or not finite.
fn jacobian(mesh: &Mesh, uvs: &[DVec2], triangle: [HalfEdgeId; 3]) -> Option<([DVec2; 2], f64)> {
    jacobian_at(
        triangle.map(|h| mesh.position(mesh.origin(h))),
        triangle.map(|h| uvs[h.index()]),
    )
}

/// Returns the result of [`jacobian`] for a triangle with these positions and texture coordinates.
pub(super) fn jacobian_at(at: [DVec3; 3], uvs: [DVec2; 3]) -> Option<([DVec2; 2], f64)> {
    let [a, b, c] = at;
    let along = (b - a).try_normalize()?;
    let length = (b - a).length();
    let x = (c - a).dot(along);
    let y = ((c - a) - along * x).length();
    let area = length * y / 2.0;
    if area.is_nan() || area <= 0.0 || area.is_infinite() {
        return None;
    }
    let [a, b, c] = uvs;
    let first = (b - a) / length;
    Some(([first, (c - a - first * x) / y], area))
}

/// Returns the ratio of the larger to the smaller singular value of the 2 x 2 matrix with the columns `a` and `b`.
pub(super) fn aspect([a, b]: [DVec2; 2]) -> f64 {
    let (e, f, g) = (a.dot(a), a.dot(b), b.dot(b));
    let middle = f64::midpoint(e, g);
    let radius = (((e - g) * (e - g)) / 4.0 + f * f).sqrt();
    // The product of both singular values is the absolute value of the determinant. The smaller value is therefore the
    // determinant divided by the larger value. This formula is accurate, because it does not subtract nearly equal
    // numbers.
    let long = (middle + radius).sqrt();
    let short = a.perp_dot(b).abs() / long;
    if short > 0.0 {
        (long / short).max(1.0)
    } else {
        f64::INFINITY
    }
}
