//! Divides a surface into charts: cuts and joins flattened charts until each flattened chart has no overlaps and little stretch.

use std::collections::BTreeSet;

use mesh::{DVec3, parallel};
use progress::{Cancelled, Meter, Progress};

use super::chart::{Chart, Failure, Limits, MAX_CREASE, chart, nearest};
use super::dissolve::dissolve;
use super::grow::{Totals, grow, meetings, smooth_normals};
use super::number;
use super::surface::Surface;

/// Two charts are joined only if their common border is long enough. Let b be the border length of the chart with the
/// shorter border. The length of the common border must be at least this fraction of b.
const MIN_SHARED: f64 = 0.1;
/// A chart is small if its area is less than this fraction of the area of a neighboring chart. A small chart can be
/// joined to this neighbor even if the angles between the two charts are larger than [`MAX_CREASE`] allows.
const SMALL: f64 = 0.1;

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

/// Joins pairs of charts with a common border, until no pair can be joined within the limits. For each pair, the length
/// of the common border is divided by the smaller one of the border lengths of the two charts. The pairs with the
/// largest quotients are joined first.
fn join(
    surface: &Surface,
    smooth: &[DVec3],
    mut charts: Vec<Chart>,
    limits: Limits,
    progress: &dyn Progress,
) -> Result<Vec<Chart>, Cancelled> {
    // Identifies a chart by its lowest face id and its number of faces. A chart that changes gets more faces, so its
    // key changes, and pairs that failed before are tried again.
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

/// Whether the smoothed normals of all faces of a chart are close enough to the mean normal of the joined chart.
fn is_cone(chart: &Chart, joined: &Totals, smooth: &[DVec3], limits: Limits) -> bool {
    let axis = joined.normal.normalize_or_zero();
    let mut normals = chart.part.faces.iter().map(|&f| smooth[f as usize]);
    normals.all(|normal| normal.dot(axis) >= limits.min_cosine)
}
