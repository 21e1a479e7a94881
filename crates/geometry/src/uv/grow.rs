//! Grows charts: makes the first division of a surface into sets of faces.
//!
//! Regions are connected sets of coplanar faces, and are never divided. Each chart starts with the largest region that
//! is not in a chart. Then the neighboring region with the lowest cost is added, again and again, until the cost of
//! every neighboring region exceeds a limit. Later, charts are cut and joined; see `cut.rs`. The cost of a region is
//! higher if its normal forms a large angle with the mean normal of the chart. The cost is also higher if the region
//! makes the border of the chart longer and more winding, or if sharp edges lie between the chart and the region. These
//! costs are from the program xatlas (Young, 2018).

use std::cmp::{Ordering, Reverse};
use std::collections::{BTreeMap, BinaryHeap};

use mesh::DVec3;
use progress::{Cancelled, Progress};

use super::number;
use super::surface::Surface;

const NORMAL_WEIGHT: f64 = 2.0;
const ROUNDNESS_WEIGHT: f64 = 0.01;
const STRAIGHTNESS_WEIGHT: f64 = 6.0;
const CREASE_WEIGHT: f64 = 4.0;
const MAX_COST: f64 = 2.0;
/// The cosine of about 0.25 degrees. Faces count as coplanar if the angle between their normals is at most this angle.
const COPLANAR: f64 = 1.0 - 1e-5;
const NONE: u32 = u32::MAX;

/// Describes the common border of two regions or charts: its length, and the sum of `length * (1 - cosine)` over its
/// edges. Here, `cosine` is the cosine of the angle between the normals of the two faces at an edge.
#[derive(Clone, Copy, Default)]
pub(super) struct Meeting {
    pub(super) length: f64,
    pub(super) crease: f64,
}

/// Properties of a set of faces: the sum of the normals, the total area, and the length of the border.
#[derive(Clone, Copy, Default)]
pub(super) struct Totals {
    /// The sum of the normals of the faces, weighted by area.
    pub(super) normal: DVec3,
    pub(super) area: f64,
    /// The length of the border of the set.
    pub(super) border: f64,
}

impl Totals {
    pub(super) fn joined(self, other: Self, meeting: Meeting) -> Self {
        Self {
            normal: self.normal + other.normal,
            area: self.area + other.area,
            border: (self.border + other.border - 2.0 * meeting.length).max(0.0),
        }
    }
}

/// Returns the [`Totals`] of each of `n` sets of faces, and for each set, its common border with each neighboring set.
/// For each face, `set_of` contains the index of its set, or [`u32::MAX`] if the face is in no set.
pub(super) fn meetings(
    surface: &Surface,
    smooth: &[DVec3],
    set_of: &[u32],
    n: usize,
) -> (Vec<Totals>, Vec<BTreeMap<u32, Meeting>>) {
    let mut totals = vec![Totals::default(); n];
    let mut links = vec![BTreeMap::<u32, Meeting>::new(); n];
    for (f, &set) in set_of.iter().enumerate().filter(|(_, set)| **set != NONE) {
        let total = &mut totals[set as usize];
        total.normal += smooth[f] * surface.areas[f];
        total.area += surface.areas[f];
        for h in surface.half_edges(number(f)) {
            let other = surface.across(h).map(|g| (g, set_of[g as usize]));
            if other.is_some_and(|(_, other)| other == set) {
                continue;
            }
            let length = surface.length(h);
            total.border += length;
            if let Some((g, other)) = other.filter(|(_, other)| *other != NONE) {
                let cosine = surface.normals[f].dot(surface.normals[g as usize]);
                let meeting = links[set as usize].entry(other).or_default();
                meeting.length += length;
                meeting.crease += length * (1.0 - cosine).max(0.0);
            }
        }
    }
    (totals, links)
}

/// Returns smoothed normals of the faces. The normal of each face is averaged several times with the normals of the
/// neighboring faces. Neighbors whose normals differ by more than 30 degrees are left out. Without averaging, the
/// borders of charts on noisy scans would be ragged.
pub(super) fn smooth_normals(surface: &Surface) -> Vec<DVec3> {
    const ROUNDS: usize = 8;
    const COS_30: f64 = 0.866_025_403_784_438_6;
    let faces = 0..number(surface.areas.len());
    let neighbors: Vec<Vec<u32>> = faces
        .map(|f| {
            let normal = surface.normals[f as usize];
            let near = surface.neighbors(f).map(|(_, g)| g);
            near.filter(|&g| surface.normals[g as usize].dot(normal) >= COS_30)
                .collect()
        })
        .collect();
    let weighted = surface.normals.iter().zip(&surface.areas);
    let mut normals: Vec<DVec3> = weighted.map(|(n, &area)| *n * area).collect();
    for _ in 0..ROUNDS {
        let sum = |(f, near): (usize, &Vec<u32>)| {
            near.iter()
                .fold(normals[f], |sum, &g| sum + normals[g as usize])
        };
        normals = neighbors.iter().enumerate().map(sum).collect();
    }
    let pairs = normals.iter().zip(&surface.normals);
    pairs
        .map(|(smooth, &normal)| smooth.normalize_or(normal))
        .collect()
}

/// Finds the regions, which are connected sets of coplanar faces. Returns the index of the region of each face, and the
/// number of regions.
fn regions(surface: &Surface) -> (Vec<u32>, usize) {
    let mut region_of = vec![NONE; surface.areas.len()];
    let mut n = 0;
    for seed in 0..number(surface.areas.len()) {
        if region_of[seed as usize] != NONE || surface.areas[seed as usize] <= 0.0 {
            continue;
        }
        let normal = surface.normals[seed as usize];
        region_of[seed as usize] = n;
        let mut stack = vec![seed];
        while let Some(f) = stack.pop() {
            for (_, g) in surface.neighbors(f) {
                let is_coplanar = surface.normals[g as usize].dot(normal) >= COPLANAR;
                if region_of[g as usize] == NONE && is_coplanar {
                    region_of[g as usize] = n;
                    stack.push(g);
                }
            }
        }
        n += 1;
    }
    (region_of, n as usize)
}

/// A region that can be added to the chart that is growing. Candidates are ordered by cost.
#[derive(PartialEq)]
struct Candidate {
    cost: f64,
    region: u32,
}

impl Eq for Candidate {}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        let by_cost = self.cost.total_cmp(&other.cost);
        by_cost.then(self.region.cmp(&other.region))
    }
}

/// The regions, and for each region, the chart to which it belongs.
struct Growth {
    totals: Vec<Totals>,
    links: Vec<BTreeMap<u32, Meeting>>,
    chart_of: Vec<u32>,
    min_cosine: f64,
}

impl Growth {
    /// Returns the common border of a region and a chart.
    fn meeting(&self, region: u32, chart: u32) -> Meeting {
        let links = self.links[region as usize].iter();
        let inside = links.filter(|(other, _)| self.chart_of[**other as usize] == chart);
        inside.fold(Meeting::default(), |sum, (_, m)| Meeting {
            length: sum.length + m.length,
            crease: sum.crease + m.crease,
        })
    }

    /// Returns the cost of adding a region to a chart. `totals` are the totals of the chart. Returns `None` if the
    /// region cannot be added.
    fn cost(&self, region: u32, chart: u32, totals: &Totals) -> Option<f64> {
        let added = &self.totals[region as usize];
        let cosine = added
            .normal
            .normalize_or_zero()
            .dot(totals.normal.normalize_or_zero());
        let meeting = self.meeting(region, chart);
        if cosine < self.min_cosine || meeting.length <= 0.0 {
            return None;
        }
        let outside = added.border - meeting.length;
        let joined = totals.joined(*added, meeting);
        let roundness = if totals.border > 0.0 && joined.border > 0.0 {
            let compact = |t: &Totals| t.border * t.border / t.area;
            1.0 - compact(totals) / compact(&joined)
        } else {
            0.0
        };
        let straightness = ((outside - meeting.length) / added.border).min(0.0);
        let cost = NORMAL_WEIGHT * (1.0 - cosine)
            + ROUNDNESS_WEIGHT * roundness
            + STRAIGHTNESS_WEIGHT * straightness
            + CREASE_WEIGHT * meeting.crease / meeting.length;
        (cost <= MAX_COST).then_some(cost)
    }

    /// Grows the chart with the number `chart` from the region `seed`. For each region that is added, calls `ask`,
    /// which checks for cancellation.
    fn grow(
        &mut self,
        seed: u32,
        chart: u32,
        mut ask: impl FnMut() -> Result<(), Cancelled>,
    ) -> Result<(), Cancelled> {
        let mut totals = self.totals[seed as usize];
        let mut heap = BinaryHeap::new();
        let mut added = seed;
        loop {
            ask()?;
            self.chart_of[added as usize] = chart;
            for &region in self.links[added as usize].keys() {
                if self.chart_of[region as usize] == NONE
                    && let Some(cost) = self.cost(region, chart, &totals)
                {
                    heap.push(Reverse(Candidate { cost, region }));
                }
            }
            // The chart has possibly grown since the cost of the region was computed, so the cost is computed again. If
            // the cost is now higher, the region goes back to the queue.
            added = loop {
                let Some(Reverse(candidate)) = heap.pop() else {
                    return Ok(());
                };
                let region = candidate.region;
                if self.chart_of[region as usize] != NONE {
                    continue;
                }
                match self.cost(region, chart, &totals) {
                    Some(cost) if cost > candidate.cost + 1e-9 => {
                        heap.push(Reverse(Candidate { cost, region }));
                    }
                    Some(_) => break region,
                    None => {}
                }
            };
            let meeting = self.meeting(added, chart);
            totals = totals.joined(self.totals[added as usize], meeting);
        }
    }
}

/// Divides the solid faces, which are the faces with a nonzero area, into connected charts. Returns the index of the
/// chart of each face, and the number of charts. The index is [`u32::MAX`] for faces with zero area. A region is added
/// to a chart only if its normal is close enough to the current mean normal of the chart. The cosine of the angle
/// between the two normals must be at least `min_cosine`.
pub(super) fn grow(
    surface: &Surface,
    smooth: &[DVec3],
    min_cosine: f64,
    progress: &dyn Progress,
) -> Result<(Vec<u32>, usize), Cancelled> {
    let (region_of, n) = regions(surface);
    let (totals, links) = meetings(surface, smooth, &region_of, n);
    let mut order: Vec<u32> = (0..number(n)).collect();
    let area = |r: u32| totals[r as usize].area;
    order.sort_by(|&a, &b| area(b).total_cmp(&area(a)).then(a.cmp(&b)));
    let mut growth = Growth {
        totals,
        links,
        chart_of: vec![NONE; n],
        min_cosine,
    };
    let (mut n_charts, mut n_added) = (0, 0_u64);
    let mut ask = || {
        n_added += 1;
        if n_added % 1024 == 1 {
            progress.report("grow charts", n_added, n as u64)?;
        }
        Ok(())
    };
    for seed in order {
        if growth.chart_of[seed as usize] == NONE {
            growth.grow(seed, n_charts, &mut ask)?;
            n_charts += 1;
        }
    }
    let chart = |&r: &u32| {
        if r == NONE {
            NONE
        } else {
            growth.chart_of[r as usize]
        }
    };
    Ok((region_of.iter().map(chart).collect(), n_charts as usize))
}
