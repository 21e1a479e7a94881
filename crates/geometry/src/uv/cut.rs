//! Flattens charts, and cuts and joins them until each flattened chart has no overlaps and little stretch.

use std::collections::BTreeSet;

use mesh::{DVec2, DVec3, FaceId, parallel};
use progress::{Cancelled, Meter, Progress};

use super::dissolve::dissolve;
use super::flatten::{flatten, project};
use super::grow::{Totals, grow, meetings, smooth_normals};
use super::measure::{aspect, jacobian_at, percentile};
use super::number;
use super::overlap::{Flat, first_overlap};
use super::surface::{Part, Surface, is_solid};
use crate::sparse::SolveError;

/// A chart is nearly flat if its projection to a plane has an aspect (see [`Stretch`](super::Stretch)) of at most this
/// number everywhere. A nearly flat chart is flattened by this projection.
const FLAT: f64 = 1.0 + 1e-6;
/// Two charts are joined only if their common border is long enough. Its length must be at least this fraction of the
/// border length of the chart with the shorter border.
const MIN_SHARED: f64 = 0.1;
/// Two charts are not joined if the mean of `1 - cosine` along their common border is above this number. Here, `cosine`
/// is the cosine of the angle between the normals of the two faces at an edge.
pub(super) const MAX_CREASE: f64 = 0.5;
/// A chart is small if its area is less than this fraction of the area of a neighboring chart. A small chart can be
/// joined to this neighbor even if the angles between the two charts are larger than [`MAX_CREASE`] allows.
const SMALL: f64 = 0.1;

/// The limits that a chart must not exceed.
#[derive(Clone, Copy)]
pub(super) struct Limits {
    /// The smallest allowed cosine of the angle between the smoothed normal of a face of the chart and the mean normal
    /// of the chart.
    pub(super) min_cosine: f64,
    /// The largest allowed ratio between two area scales: the scale of a triangle and the mean scale of the chart, the
    /// larger scale divided by the smaller one. The area scale of a triangle is its area in the plane, divided by its
    /// area on the surface.
    pub(super) max_stretch: f64,
}

/// The limits that the map of a chart into the plane must not exceed.
struct Allowed {
    /// The largest allowed ratio between area scales; see [`Limits::max_stretch`].
    stretch: f64,
    /// The largest allowed aspect (see [`Stretch`](super::Stretch)). Some triangles can exceed this limit, as long as
    /// their total area is at most the fraction `except` of the area of the chart.
    aspect: f64,
    except: f64,
    /// The largest allowed mean of a ratio over the triangles of the chart, weighted by area. The ratio compares the
    /// area scale of a triangle with the mean scale of the chart: the larger scale divided by the smaller one.
    spread: f64,
}

impl Allowed {
    /// Returns the limits for a chart of several faces. A chart that exceeds these limits is cut.
    fn of_charts(limits: Limits) -> Self {
        Self {
            stretch: limits.max_stretch,
            aspect: 1.15,
            except: 0.05,
            spread: 1.1,
        }
    }
}

/// A chart that has been flattened: mapped into the plane.
pub(super) struct Chart {
    pub(super) part: Part,
    /// The positions of the vertices of `part` in the plane.
    pub(super) uvs: Vec<DVec2>,
    /// Whether the chart is a single polygon that overlaps itself in the plane.
    pub(super) is_bent: bool,
}

/// Why a set of faces is not a valid chart.
pub(super) enum Failure {
    /// These two faces overlap in the plane; both are the same if a face overlaps itself.
    Overlap([FaceId; 2]),
    /// A triangle is mirrored in the plane, or the stretch is too large.
    Stretch,
}

/// A progress listener that only checks for cancellation. The reported progress is dropped.
struct Quiet<'a, 'b>(&'a Meter<'b>);

impl Progress for Quiet<'_, '_> {
    fn advance(&self, _: &str, _: u64, _: u64) -> bool {
        self.0.add(0).is_ok()
    }
}

/// Divides a surface into charts, and flattens each of them.
pub(super) fn charts(
    surface: &Surface,
    limits: Limits,
    progress: &dyn Progress,
) -> Result<Vec<Chart>, Cancelled> {
    progress.report("grow charts", 0, 1)?;
    let smooth = smooth_normals(surface);
    let (chart_of, n) = grow(surface, &smooth, limits.min_cosine, progress)?;
    progress.report("grow charts", 1, 1)?;
    let mut open = vec![Vec::new(); n];
    for (f, &chart) in chart_of.iter().enumerate() {
        if let Some(faces) = open.get_mut(chart as usize) {
            faces.push(number(f));
        }
    }
    let meter = Meter::new(progress, "flatten charts", surface.areas.len() as u64);
    let mut charts = Vec::new();
    while !open.is_empty() {
        let results: Result<Vec<_>, Cancelled> = parallel::consume(open, |_, faces| {
            let n = faces.len();
            let result = chart(surface, faces, limits, &Quiet(&meter))?;
            if result.is_ok() {
                meter.add(n)?;
            }
            Ok(match result {
                Ok(chart) => Ok(chart),
                Err((part, failure)) => Err(split(surface, &part.faces, &failure, &Quiet(&meter))?),
            })
        })
        .into_iter()
        .collect();
        let results = results?;
        open = Vec::new();
        for result in results {
            match result {
                Ok(chart) => charts.push(chart),
                Err(halves) => open.extend(halves),
            }
        }
    }
    let charts = join(surface, &smooth, charts, limits, &Quiet(&meter))?;
    dissolve(surface, &smooth, charts, limits, &Quiet(&meter))
}

/// Flattens a set of faces, and checks the result. Returns the chart, or the reason why the faces cannot form a chart.
pub(super) fn chart(
    surface: &Surface,
    faces: Vec<u32>,
    limits: Limits,
    progress: &dyn Progress,
) -> Result<Result<Chart, (Part, Failure)>, Cancelled> {
    let part = Part::new(surface, faces);
    let projected = project(&part);
    let whole = |part, uvs, is_bent| Ok(Ok(Chart { part, uvs, is_bent }));
    let flat = Allowed {
        aspect: FLAT,
        except: 0.0,
        ..Allowed::of_charts(limits)
    };
    if check(&part, &projected, &flat, progress)?.is_ok() {
        return whole(part, projected, false);
    }
    // A chart of a single polygon is never cut, so any stretch is allowed, and only overlaps matter.
    let is_single = part.faces.len() == 1;
    let allowed = if is_single {
        Allowed {
            stretch: f64::INFINITY,
            aspect: f64::INFINITY,
            except: 0.0,
            spread: f64::INFINITY,
        }
    } else {
        Allowed::of_charts(limits)
    };
    let mut failure = Failure::Stretch;
    match flatten(&part, progress) {
        Ok(maps) => {
            for uvs in maps {
                match check(&part, &uvs, &allowed, progress)? {
                    Ok(()) => return whole(part, uvs, false),
                    Err(found) => failure = found,
                }
            }
        }
        Err(SolveError::Cancelled(cancelled)) => return Err(cancelled),
        // If triangles are extremely thin, the equations possibly have no accurate solution. The chart then counts as
        // stretched too much.
        Err(_) => {}
    }
    if is_single {
        return whole(part, projected, true);
    }
    Ok(Err((part, failure)))
}

/// Checks a map of a part into the plane: triangles must neither be mirrored nor overlap each other, and the stretch
/// must be within the limits.
fn check(
    part: &Part,
    uvs: &[DVec2],
    allowed: &Allowed,
    progress: &dyn Progress,
) -> Result<Result<(), Failure>, Cancelled> {
    if !uvs.iter().all(|p| p.is_finite()) {
        return Ok(Err(Failure::Stretch));
    }
    let (mut aspects, mut scales, mut flat) = (Vec::new(), Vec::new(), Vec::new());
    for (t, &f) in part.triangles.iter().zip(&part.face_of) {
        let (points, at) = (
            t.map(|v| part.points[v as usize]),
            t.map(|v| uvs[v as usize]),
        );
        flat.extend(Flat::new(at, FaceId::new(f as usize)));
        if !is_solid(points) {
            continue;
        }
        let Some((map, area)) = jacobian_at(points, at) else {
            continue;
        };
        let scale = map[0].perp_dot(map[1]);
        if scale <= 0.0 {
            return Ok(Err(Failure::Stretch));
        }
        aspects.push((aspect(map), area));
        scales.push(scale);
    }
    let total: f64 = aspects.iter().map(|a| a.1).sum();
    let in_texture: f64 = aspects.iter().zip(&scales).map(|(a, s)| a.1 * s).sum();
    let mean = in_texture / total;
    let ratio = |scale: f64| (scale / mean).max(mean / scale);
    let (mut largest, mut spread) = (0.0_f64, 0.0);
    for (&(_, area), &scale) in aspects.iter().zip(&scales) {
        largest = largest.max(ratio(scale));
        spread += area * ratio(scale);
    }
    // The small margin is needed because rounding can change the scale of a flat chart a little.
    if largest > allowed.stretch * (1.0 + 1e-6)
        || spread > allowed.spread * total
        || percentile(&mut aspects, (1.0 - allowed.except) * total) > allowed.aspect
    {
        return Ok(Err(Failure::Stretch));
    }
    let found = first_overlap(flat, progress)?;
    Ok(found.map_or(Ok(()), |pair| Err(Failure::Overlap(pair))))
}

/// Divides a connected set of faces into two connected sets. First, two faces are chosen: two faces that overlap or, if
/// there are none, two faces that are far from each other. Each chosen face begins a set. Every other face is put in
/// the set of the chosen face that is nearer to it, measured along the surface.
fn split(
    surface: &Surface,
    faces: &[u32],
    failure: &Failure,
    progress: &dyn Progress,
) -> Result<[Vec<u32>; 2], Cancelled> {
    let index = |f: u32| faces.binary_search(&f).ok();
    let seeds = match failure {
        Failure::Overlap([f, g]) if f != g => [f, g].map(|f| index(number(f.index()))),
        _ => [None, None],
    };
    let farthest = |from: usize| {
        let (distance, _) = nearest(surface, faces, &[(from, 0)], progress)?;
        let order = |&a: &usize, &b: &usize| distance[a].total_cmp(&distance[b]).then(b.cmp(&a));
        Ok((0..faces.len()).max_by(order).unwrap_or(0))
    };
    let seeds = if let [Some(a), Some(b)] = seeds {
        [a, b]
    } else {
        let a = farthest(0)?;
        [a, farthest(a)?]
    };
    let seeds = [(seeds[0], 0), (seeds[1], 1)];
    let (_, side) = nearest(surface, faces, &seeds, progress)?;
    let of_side = |s: u32| {
        let pairs = faces.iter().zip(&side);
        pairs
            .filter(|(_, side)| **side == s)
            .map(|(f, _)| *f)
            .collect()
    };
    Ok([of_side(0), of_side(1)])
}

/// Returns, for each face of a connected set, the distance to the nearest seed and the label of this seed
/// (Dijkstra, 1959). A seed is given by the index of a face in the set, and by a label. The distance along a path of
/// neighboring faces is the sum of the distances between their centers.
pub(super) fn nearest(
    surface: &Surface,
    faces: &[u32],
    seeds: &[(usize, u32)],
    progress: &dyn Progress,
) -> Result<(Vec<f64>, Vec<u32>), Cancelled> {
    let center = |f: u32| {
        let corners = surface
            .half_edges(f)
            .map(|h| surface.positions[surface.mesh.origin(h).index()]);
        let (sum, n) = corners.fold((DVec3::ZERO, 0.0), |(sum, n), p| (sum + p, n + 1.0));
        sum / n
    };
    let mut distance = vec![f64::INFINITY; faces.len()];
    let mut side = vec![0; faces.len()];
    // The queue compares the bits of the numbers. Read as integers, the bits of non-negative `f64` numbers have the
    // same order as the numbers.
    let mut queue = BTreeSet::new();
    for &(seed, s) in seeds {
        distance[seed] = 0.0;
        side[seed] = s;
        queue.insert((0_u64, seed));
    }
    let mut n_visited = 0_u64;
    while let Some((_, i)) = queue.pop_first() {
        if n_visited.is_multiple_of(1024) {
            progress.report("split charts", n_visited, faces.len() as u64)?;
        }
        n_visited += 1;
        for (_, g) in surface.neighbors(faces[i]) {
            let Ok(j) = faces.binary_search(&g) else {
                continue;
            };
            let next = distance[i] + center(faces[i]).distance(center(g));
            if next < distance[j] {
                queue.remove(&(distance[j].to_bits(), j));
                queue.insert((next.to_bits(), j));
                distance[j] = next;
                side[j] = side[i];
            }
        }
    }
    Ok((distance, side))
}

/// Joins two charts that share a border, if the joined chart is within the limits, and repeats this until no more
/// charts can be joined. The two charts that share the largest fraction of their borders are joined first.
fn join(
    surface: &Surface,
    smooth: &[DVec3],
    mut charts: Vec<Chart>,
    limits: Limits,
    progress: &dyn Progress,
) -> Result<Vec<Chart>, Cancelled> {
    // Identifies a chart by its lowest face id and its number of faces. A chart that changes gets more faces, so a
    // failed attempt with the old chart does not count for the new chart.
    let key = |chart: &Chart| (chart.part.faces[0], chart.part.faces.len());
    let mut failed = BTreeSet::new();
    loop {
        let mut chart_of = vec![u32::MAX; surface.areas.len()];
        for (c, chart) in charts.iter().enumerate() {
            for &f in &chart.part.faces {
                chart_of[f as usize] = number(c);
            }
        }
        let (totals, links) = meetings(surface, smooth, &chart_of, charts.len());
        let mut pairs = Vec::new();
        for (a, links) in links.iter().enumerate() {
            for (&b, meeting) in links.range(number(a) + 1..) {
                let b = b as usize;
                let (x, y) = (&totals[a], &totals[b]);
                let shared = meeting.length / x.border.min(y.border);
                let joined = x.joined(*y, *meeting);
                let is_small = x.area.min(y.area) < SMALL * x.area.max(y.area);
                if shared >= MIN_SHARED
                    && (is_small || meeting.crease <= MAX_CREASE * meeting.length)
                    && !failed.contains(&(key(&charts[a]), key(&charts[b])))
                    && [a, b]
                        .iter()
                        .all(|&c| is_cone(&charts[c], &joined, smooth, limits))
                {
                    pairs.push((shared, a, b));
                }
            }
        }
        pairs.sort_by(|a, b| b.0.total_cmp(&a.0).then((a.1, a.2).cmp(&(b.1, b.2))));
        let mut is_taken = vec![false; charts.len()];
        pairs.retain(|&(_, a, b)| {
            let is_free = !is_taken[a] && !is_taken[b];
            is_taken[a] |= is_free;
            is_taken[b] |= is_free;
            is_free
        });
        if pairs.is_empty() {
            return Ok(charts);
        }
        let joined: Result<Vec<_>, Cancelled> = parallel::consume(&pairs, |_, &(_, a, b)| {
            let mut faces = charts[a].part.faces.clone();
            faces.extend(&charts[b].part.faces);
            faces.sort_unstable();
            Ok(chart(surface, faces, limits, progress)?.ok())
        })
        .into_iter()
        .collect();
        let joined = joined?;
        let mut charts_left: Vec<Option<Chart>> = charts.into_iter().map(Some).collect();
        for (&(_, a, b), joined) in pairs.iter().zip(joined) {
            if joined.is_some() {
                charts_left[a] = joined;
                charts_left[b] = None;
            } else if let (Some(a), Some(b)) = (&charts_left[a], &charts_left[b]) {
                failed.insert((key(a), key(b)));
            }
        }
        charts = charts_left.into_iter().flatten().collect();
    }
}

/// Whether the angles between the normals of the faces of a chart and the mean normal of the joined chart are within
/// the limit.
fn is_cone(chart: &Chart, joined: &Totals, smooth: &[DVec3], limits: Limits) -> bool {
    let axis = joined.normal.normalize_or_zero();
    let mut normals = chart.part.faces.iter().map(|&f| smooth[f as usize]);
    normals.all(|normal| normal.dot(axis) >= limits.min_cosine)
}
