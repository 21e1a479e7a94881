//! Dissolves charts: divides the faces of a chart among the charts around it, so that fewer charts remain.

use std::collections::{BTreeMap, BTreeSet};

use mesh::{DVec3, parallel};
use progress::{Cancelled, Progress};

use super::chart::{Chart, Limits, MAX_CREASE, chart, nearest};
use super::number;
use super::surface::Surface;

/// Flattening a face is estimated to take as much work as this number of comparisons of normals. In a comparison, the
/// normal of a face is compared with the mean normal of a chart.
const FLATTEN: usize = 64;

/// Tries to dissolve each chart, the charts with the smallest area first. A chart is dissolved if the charts around it
/// remain within the limits. The total work is limited to a multiple of the number of faces. Therefore, on noisy
/// surfaces with very many charts, some charts are not tried.
pub(super) fn dissolve(
    surface: &Surface,
    smooth: &[DVec3],
    charts: Vec<Chart>,
    limits: Limits,
    progress: &dyn Progress,
) -> Result<Vec<Chart>, Cancelled> {
    let mut chart_of = vec![u32::MAX; surface.areas.len()];
    let mut areas = vec![0.0; charts.len()];
    for (c, chart) in charts.iter().enumerate() {
        for &f in &chart.part.faces {
            chart_of[f as usize] = number(c);
            areas[c] += surface.areas[f as usize];
        }
    }
    let mut order: Vec<usize> = (0..charts.len()).collect();
    order.sort_by(|&a, &b| areas[a].total_cmp(&areas[b]).then(a.cmp(&b)));
    let mut charts: Vec<Option<Chart>> = charts.into_iter().map(Some).collect();
    // The work that can still be done, counted in comparisons of normals.
    let mut left = FLATTEN * (4 * surface.areas.len() + 20_000);
    for c in order {
        if left == 0 {
            break;
        }
        let Some(faces) = charts[c].as_ref().map(|c| c.part.faces.clone()) else {
            continue;
        };
        // The charts that would exceed the limits if the faces nearest to them were added.
        let mut refused = BTreeSet::from([number(c), u32::MAX]);
        loop {
            let grown = grow(surface, &faces, &chart_of, &charts, &refused, progress)?;
            if grown.is_empty() {
                break;
            }
            let n_faces: usize = grown.iter().map(|g| g.1.len()).sum();
            left = left.saturating_sub(n_faces);
            let steep = grown
                .iter()
                .filter(|g| !is_cone(surface, smooth, &g.1, limits));
            let mut failed: Vec<u32> = steep.map(|g| g.0).collect();
            if failed.is_empty() {
                left = left.saturating_sub(FLATTEN * n_faces);
                let flat: Result<Vec<_>, Cancelled> = parallel::consume(grown, |_, (d, faces)| {
                    Ok((d, chart(surface, faces, limits, progress)?.ok()))
                })
                .into_iter()
                .collect();
                let flat = flat?;
                failed.extend(flat.iter().filter(|f| f.1.is_none()).map(|f| f.0));
                if failed.is_empty() {
                    for (d, flat) in flat {
                        for &f in flat.iter().flat_map(|chart| &chart.part.faces) {
                            chart_of[f as usize] = d;
                        }
                        charts[d as usize] = flat;
                    }
                    charts[c] = None;
                    break;
                }
            }
            refused.extend(failed);
        }
    }
    Ok(charts.into_iter().flatten().collect())
}

/// Assigns each face of a chart to the nearest of the charts around it, measured along the surface. Returns the charts
/// that would grow, each with all its old and new faces. No face is assigned to a chart in `refused`. A chart can grow
/// only across an edge that is not sharp.
fn grow(
    surface: &Surface,
    faces: &[u32],
    chart_of: &[u32],
    charts: &[Option<Chart>],
    refused: &BTreeSet<u32>,
    progress: &dyn Progress,
) -> Result<Vec<(u32, Vec<u32>)>, Cancelled> {
    let normal = |f: u32| surface.normals[f as usize];
    let mut seeds = Vec::new();
    for (i, &f) in faces.iter().enumerate() {
        let mut flat = surface
            .neighbors(f)
            .filter(|&(_, g)| normal(f).dot(normal(g)) >= 1.0 - MAX_CREASE)
            .map(|(_, g)| chart_of[g as usize]);
        seeds.extend(flat.find(|d| !refused.contains(d)).map(|d| (i, d)));
    }
    if seeds.is_empty() {
        return Ok(Vec::new());
    }
    let (_, nearest) = nearest(surface, faces, &seeds, progress)?;
    let mut grown = BTreeMap::new();
    for (&f, &d) in faces.iter().zip(&nearest) {
        let of_chart = || charts[d as usize].iter().flat_map(|c| c.part.faces.clone());
        let list: &mut Vec<u32> = grown.entry(d).or_insert_with(|| of_chart().collect());
        list.push(f);
    }
    let sorted = grown.into_iter().map(|(d, mut faces)| {
        faces.sort_unstable();
        (d, faces)
    });
    Ok(sorted.collect())
}

/// Whether the smoothed normals of all given faces are close enough to the mean of these normals.
fn is_cone(surface: &Surface, smooth: &[DVec3], faces: &[u32], limits: Limits) -> bool {
    let weighted = |f: &u32| smooth[*f as usize] * surface.areas[*f as usize];
    let axis = faces
        .iter()
        .map(weighted)
        .sum::<DVec3>()
        .normalize_or_zero();
    let cosine = |f: &u32| smooth[*f as usize].dot(axis);
    faces.iter().all(|f| cosine(f) >= limits.min_cosine)
}
