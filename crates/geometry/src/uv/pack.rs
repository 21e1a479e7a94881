//! Packing: moves existing charts to one page, and scales them so that all have the same scale.

use std::collections::BTreeMap;

use mesh::{DVec2, HalfEdgeId, Mesh};
use progress::Progress;
use uvunwrap::{Atlas, Density, MeshInput, Options, OutputMesh, Packing, generate_with_progress};

use super::overlap::upright;
use super::surface::unit_positions;
use super::{Page, UvError, charts};
use crate::tangent::triangles;

/// The texture coordinates of packed charts.
#[derive(Clone, Debug)]
pub struct Packed {
    /// The texture coordinates of each half-edge, from 0 to 1. For half-edges without a face, they are zero.
    pub uvs: Vec<DVec2>,
    /// The number of charts.
    pub n_charts: usize,
    /// The number of charts with zero area on the surface or in the texture. All texture coordinates of these charts
    /// become (0, 0).
    pub n_flat: usize,
    /// The number of charts that overlap themselves. For the packing, the shape of a chart that overlaps itself is
    /// replaced by its convex hull.
    pub n_overlapping: usize,
    /// The area of all charts together, as a fraction of the area of the page.
    pub coverage: f64,
}

/// If there are at most this number of charts, the charts are nested: small charts can lie in the hollows of large
/// charts. Otherwise, all charts are packed in rows, because the time for nesting grows faster than the number of
/// charts. For 3,324 charts on a page of 4096 texels, packing in rows is 15 times as fast as nesting. However, the
/// charts then cover only 61 % of the page instead of 66 %.
const MAX_NESTED: usize = 256;

/// A triangle whose area is at most this fraction of the area of its chart is ignored when the chart is packed.
const MIN_AREA: f64 = 1e-11;

/// The smallest height of a triangle of a convex hull, as a fraction of the diagonal of the hull's bounding box.
/// Thinner triangles are left out: the crate `uvunwrap` ignores triangles whose height is below 1e-6 times the
/// diagonal.
const MIN_HEIGHT: f64 = 4e-6;

/// A shape with more triangles than this number is replaced by its convex hull, unless the area of the hull is larger
/// than the sum of the areas of the triangles.
const MAX_CONVEX: usize = 256;

/// Two areas count as equal if their relative difference is at most this number.
const HULL_MARGIN: f64 = 1e-4;

/// A chart before the packing.
struct Chart {
    /// The triangles of the chart, each with its three corners.
    triangles: Vec<[HalfEdgeId; 3]>,
    /// The factor by which the texture coordinates of the chart are multiplied, so that all charts have the same scale.
    /// `None` for a zero-area chart.
    scale: Option<f64>,
    /// The middle of the bounding box of the chart in the old texture.
    middle: DVec2,
    /// The rotation of the chart before the packing, as a complex number. The rotation makes the bounding boxes of
    /// thin, oblique triangles small. This saves time, because the crate `uvunwrap` compares two triangles of a chart
    /// if their bounding boxes overlap.
    turn: DVec2,
    /// The area of the chart on the surface.
    area: f64,
}

/// The triangles of a chart, in the form that the crate `uvunwrap` packs.
#[derive(Default)]
struct Shape {
    positions: Vec<[f32; 3]>,
    uvs: Vec<[f32; 2]>,
    indices: Vec<u32>,
    /// The same points as in `positions` and `uvs`, but as 64-bit numbers.
    points: Vec<DVec2>,
}

/// Packs the charts of a dense mesh: moves, turns and scales them in the texture. Afterwards, no two charts overlap
/// each other, and all charts have the same scale: their areas in the texture are proportional to their areas on the
/// surface. Angles and ratios of lengths inside a chart are preserved, and mirrored charts remain mirrored. If there
/// are at most 256 charts, small charts can lie in the hollows and holes of large charts. If there are more than 256
/// charts, all of them are packed in rows, which is much faster.
///
/// # Errors
///
/// Returns an [`UvError`] if the charts cannot be packed.
pub fn pack(
    mesh: &Mesh,
    uvs: &[DVec2],
    page: Page,
    progress: &dyn Progress,
) -> Result<Packed, UvError> {
    let charts = chart_list(mesh, uvs);
    let places = |chart: &Chart, h: HalfEdgeId| {
        let place = chart.turn.rotate(uvs[h.index()] - chart.middle);
        place * chart.scale.unwrap_or(0.0)
    };
    let solid: Vec<&Chart> = charts
        .iter()
        .filter(|chart| chart.scale.is_some())
        .collect();
    // All coordinates are divided by the largest absolute coordinate of all charts, so that they fit into 32-bit
    // floating-point numbers.
    let largest = solid.iter().flat_map(|chart| {
        let corners = chart.triangles.iter().flatten();
        corners.map(|&h| places(chart, h).abs().max_element())
    });
    let unit = 1.0 / largest.fold(f64::MIN_POSITIVE, f64::max);
    let mut shapes: Vec<Shape> = solid
        .iter()
        .map(|chart| Shape::of_triangles(&chart.triangles, |h| places(chart, h) * unit))
        .collect();
    let mut packed = Packed {
        uvs: vec![DVec2::ZERO; uvs.len()],
        n_charts: charts.len(),
        n_flat: charts.len() - solid.len(),
        n_overlapping: 0,
        coverage: 0.0,
    };
    for shape in &mut shapes {
        packed.n_overlapping += usize::from(shape.simplify());
    }
    if solid.is_empty() {
        return Ok(packed);
    }
    let mut atlas = pack_shapes(&shapes, page, progress)?;
    let n_known = packed.n_overlapping;
    for (shape, output) in shapes.iter_mut().zip(&atlas.meshes) {
        // If a chart overlaps itself, the packing has cut it into several charts. The convex hull of a chart that
        // overlaps itself is packed instead.
        if n_charts(output) != 1 {
            *shape = shape.hull().0;
            packed.n_overlapping += 1;
        }
    }
    if packed.n_overlapping > n_known {
        atlas = pack_shapes(&shapes, page, progress)?;
    }
    let density = f64::from(atlas.texels_per_unit) / f64::from(page.size);
    for ((chart, shape), output) in solid.iter().zip(&shapes).zip(&atlas.meshes) {
        let motion = Motion::new(shape, output, &atlas, page, density);
        for &h in chart.triangles.iter().flatten() {
            packed.uvs[h.index()] = motion.apply(places(chart, h) * unit);
        }
        packed.coverage += chart.area * unit * unit * density * density;
    }
    Ok(packed)
}

/// Returns the list of all charts, each with its triangles, scale and area.
fn chart_list(mesh: &Mesh, uvs: &[DVec2]) -> Vec<Chart> {
    let numbers = charts(mesh, uvs);
    let positions = unit_positions(mesh);
    let mut list: Vec<Chart> = (0..numbers.n)
        .map(|_| Chart {
            triangles: Vec::new(),
            scale: None,
            middle: DVec2::ZERO,
            turn: DVec2::X,
            area: 0.0,
        })
        .collect();
    for triangle in triangles(mesh) {
        if let Some(f) = mesh.face(triangle[0]) {
            let number = numbers.of_face[f.index()] as usize;
            list[number].triangles.push(triangle);
        }
    }
    for chart in &mut list {
        let mut corners = chart.triangles.iter().flatten().map(|h| uvs[h.index()]);
        let first = corners.next().unwrap_or_default();
        let (low, high) = corners.fold((first, first), |(low, high), p| (low.min(p), high.max(p)));
        chart.middle = (low + high) / 2.0;
        chart.turn = upright(chart.triangles.iter().map(|t| t.map(|h| uvs[h.index()])));
        let mut in_texture = 0.0;
        for triangle in &chart.triangles {
            let [a, b, c] = triangle.map(|h| positions[mesh.origin(h).index()]);
            chart.area += (b - a).cross(c - a).length() / 2.0;
            let [a, b, c] = triangle.map(|h| uvs[h.index()]);
            in_texture += ((b - a).perp_dot(c - a) / 2.0).abs();
        }
        let scale = (chart.area / in_texture).sqrt();
        chart.scale = (scale.is_finite() && scale > 0.0).then_some(scale);
    }
    list
}

fn pack_shapes(shapes: &[Shape], page: Page, progress: &dyn Progress) -> Result<Atlas, UvError> {
    let inputs: Vec<MeshInput> = shapes
        .iter()
        .map(|shape| MeshInput {
            existing_uvs: Some(&shape.uvs),
            ..MeshInput::new(&shape.positions, &shape.indices)
        })
        .collect();
    generate(&inputs, page, progress)
}

/// Packs the given shapes into an atlas of a single page.
fn generate(input: &[MeshInput], page: Page, progress: &dyn Progress) -> Result<Atlas, UvError> {
    let settings = Options {
        density: Density::Auto {
            page_size: page.size,
        },
        padding: page.padding,
        packing: if input.len() <= MAX_NESTED {
            Packing::Shape
        } else {
            Packing::Fast
        },
        ..Options::default()
    };
    let listen = |report: uvunwrap::Progress| {
        let done = report.done as u64;
        // The total number of packing attempts is not always known in advance. If the number is unknown, one more
        // attempt is assumed.
        let total = report.total.map_or(done + 1, |total| total as u64);
        progress.advance("pack charts", done.min(total), total)
    };
    let atlas = generate_with_progress(input, &settings, listen);
    let atlas = atlas.map_err(|error| UvError::from_crate(&error, page))?;
    if atlas.page_count > 1 {
        return Err(UvError::PageTooSmall(page));
    }
    Ok(atlas)
}

fn n_charts(output: &OutputMesh) -> usize {
    let mut numbers: Vec<u32> = output.vertices.iter().filter_map(|v| v.chart).collect();
    numbers.sort_unstable();
    numbers.dedup();
    numbers.len()
}

impl Shape {
    /// Creates the shape of the given triangles. `place` returns the position of a corner in the plane. Mirrored
    /// triangles are turned over, so that all triangles of the shape are counter-clockwise.
    fn of_triangles(triangles: &[[HalfEdgeId; 3]], place: impl Fn(HalfEdgeId) -> DVec2) -> Self {
        let mut shape = Self::default();
        let mut numbers = BTreeMap::new();
        let area = |[a, b, c]: [DVec2; 3]| {
            let round = |p: DVec2| p.as_vec2().as_dvec2();
            (round(b) - round(a)).perp_dot(round(c) - round(a)) / 2.0
        };
        let all = triangles.iter().map(|triangle| triangle.map(&place));
        let total: f64 = all.clone().map(|t| area(t).abs()).sum();
        for points in all {
            // Rounding to 32-bit numbers can turn a thin triangle over. A triangle that rounding turns over is left out
            // of the shape of the chart. The corners of this triangle still get positions, because they move together
            // with the whole chart.
            let before = (points[1] - points[0]).perp_dot(points[2] - points[0]);
            if area(points) * before.signum() <= MIN_AREA * total {
                continue;
            }
            let mut corners = points.map(|p| {
                let key = p.to_array().map(f64::to_bits);
                *numbers.entry(key).or_insert_with(|| shape.push(p))
            });
            if (points[1] - points[0]).perp_dot(points[2] - points[0]) < 0.0 {
                corners.swap(1, 2);
            }
            shape.indices.extend(corners);
        }
        shape
    }

    #[expect(
        clippy::cast_possible_truncation,
        reason = "packing uses 32-bit indices, which suffice because the ids of corners have 32 bits"
    )]
    fn push(&mut self, p: DVec2) -> u32 {
        let [x, y] = p.as_vec2().to_array();
        self.positions.push([x, y, 0.0]);
        self.uvs.push([x, y]);
        self.points.push(p);
        (self.points.len() - 1) as u32
    }

    /// Replaces the shape by its convex hull if two conditions hold: it has more than [`MAX_CONVEX`] triangles, and it
    /// is convex or certainly overlaps itself. The shape certainly overlaps itself if the sum of the areas of its
    /// triangles is larger than the area of the hull. Returns `true` if the shape was replaced because of an overlap,
    /// and `false` in all other cases. The replacement saves time: the crate `uvunwrap` compares two triangles if their
    /// bounding boxes overlap. If a face has many corners, almost all bounding boxes of its triangles can overlap each
    /// other.
    fn simplify(&mut self) -> bool {
        if self.indices.len() / 3 <= MAX_CONVEX {
            return false;
        }
        let (hull, of_hull) = self.hull();
        let area = self.area();
        if hull.indices.is_empty() || area < (1.0 - HULL_MARGIN) * of_hull {
            return false;
        }
        *self = hull;
        area > (1.0 + HULL_MARGIN) * of_hull
    }

    fn area(&self) -> f64 {
        let triangles = self.indices.chunks_exact(3);
        triangles
            .map(|t| {
                let [a, b, c] = [t[0], t[1], t[2]].map(|i| self.points[i as usize]);
                (b - a).perp_dot(c - a) / 2.0
            })
            .sum()
    }

    /// Returns a simplified convex hull of the shape, as triangles, and the area of the convex hull before the
    /// simplification. The convex hull is computed by Andrew's monotone chain algorithm (1979). The simplification
    /// removes corners that change the hull only slightly, as [`MIN_HEIGHT`] specifies. Source of the simplification:
    /// Douglas, Peucker, "Algorithms for the Reduction of the Number of Points Required to Represent a Digitized Line
    /// or its Caricature", 1973.
    fn hull(&self) -> (Self, f64) {
        let mut points = self.points.clone();
        points.sort_unstable_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
        let half = |points: &mut dyn Iterator<Item = DVec2>| {
            let mut chain: Vec<DVec2> = Vec::new();
            for p in points {
                while let [.., a, b] = chain[..]
                    && (b - a).perp_dot(p - a) <= 0.0
                {
                    chain.pop();
                }
                chain.push(p);
            }
            chain
        };
        // The lower half and the upper half of the hull both join the point with the smallest x to the point with the
        // largest x.
        let halves = [
            half(&mut points.iter().copied()),
            half(&mut points.iter().rev().copied()),
        ];
        let mut hull = Self::default();
        let (Some(&first), Some(&last)) = (points.first(), points.last()) else {
            return (hull, 0.0);
        };
        let (low, high) = points
            .iter()
            .fold((first, first), |(low, high), &p| (low.min(p), high.max(p)));
        let min_height = MIN_HEIGHT * low.distance(high);
        let ends = [first, last].map(|p| hull.push(p));
        for (chain, [from, to]) in halves.iter().zip([ends, [ends[1], ends[0]]]) {
            let mut open = vec![(chain.as_slice(), from, to)];
            while let Some((chain, from, to)) = open.pop() {
                let [a, inner @ .., b] = chain else {
                    continue;
                };
                let height = |p: &DVec2| (*p - *a).perp_dot(*b - *a);
                let highest =
                    |&i: &usize, &j: &usize| height(&inner[i]).total_cmp(&height(&inner[j]));
                let Some(i) = (0..inner.len()).max_by(highest) else {
                    continue;
                };
                let p = inner[i];
                let longest = a.distance(*b).max(a.distance(p)).max(b.distance(p));
                if height(&p) > min_height * longest {
                    let middle = hull.push(p);
                    hull.indices.extend([from, middle, to]);
                    open.push((&chain[..=i + 1], from, middle));
                    open.push((&chain[i + 1..], middle, to));
                }
            }
        }
        let sides = halves.iter().flat_map(|half| half.windows(2));
        let area = sides.map(|side| (side[0] - first).perp_dot(side[1] - first) / 2.0);
        (hull, area.sum())
    }
}

/// The motion of a chart: `p` moves to `turn * (p - from) + to`, in complex numbers.
struct Motion {
    turn: DVec2,
    from: DVec2,
    to: DVec2,
}

impl Motion {
    /// Returns the motion that best maps the points of a shape to their packed positions. The motion multiplies all
    /// lengths by `density`.
    fn new(shape: &Shape, output: &OutputMesh, atlas: &Atlas, page: Page, density: f64) -> Self {
        let size = DVec2::new(f64::from(atlas.width), f64::from(atlas.height));
        let size = size / f64::from(page.size);
        let placed = output.vertices.iter().filter(|v| v.chart.is_some());
        let pairs: Vec<[DVec2; 2]> = placed
            .map(|v| {
                let at = DVec2::from(v.uv.map(f64::from)) * size;
                [shape.points[v.xref as usize], at]
            })
            .collect();
        let n = pairs.len().max(1) as f64;
        let from = pairs.iter().map(|pair| pair[0]).sum::<DVec2>() / n;
        let to = pairs.iter().map(|pair| pair[1]).sum::<DVec2>() / n;
        // Here p is a point of the shape, and q is its packed position. With vectors as complex numbers, the direction
        // of the sum of conj(p - from) (q - to) is the best rotation.
        let turn = pairs.iter().fold(DVec2::ZERO, |sum, [p, q]| {
            let (p, q) = (*p - from, *q - to);
            sum + DVec2::new(p.dot(q), p.perp_dot(q))
        });
        Self {
            turn: turn.normalize_or(DVec2::X) * density,
            from,
            to,
        }
    }

    fn apply(&self, p: DVec2) -> DVec2 {
        self.turn.rotate(p - self.from) + self.to
    }
}
