//! Flattens a set of faces to a chart, and checks the result.

use std::collections::BTreeSet;

use mesh::{DVec2, DVec3, FaceId};
use progress::{Cancelled, Progress};

use super::flatten::{flatten, project};
use super::measure::{aspect, jacobian_at, percentile};
use super::overlap::{Flat, first_overlap};
use super::surface::{Part, Surface, is_solid};
use crate::sparse::SolveError;

/// A chart is nearly flat if its projection to a plane has an aspect (see [`Stretch`](super::Stretch)) of at most this
/// number everywhere. A nearly flat chart is flattened by this projection.
const FLAT: f64 = 1.0 + 1e-6;
/// Two charts are not joined if the mean of `1 - cosine` along their common border is above this number. Here, `cosine`
/// is the cosine of the angle between the normals of the two faces at an edge.
pub(super) const MAX_CREASE: f64 = 0.5;

/// The limits that a chart must not exceed.
#[derive(Clone, Copy)]
pub(super) struct Limits {
    /// The smallest allowed cosine of the angle between two normals: the smoothed normal of a face, and the mean normal
    /// of its chart.
    pub(super) min_cosine: f64,
    /// The largest allowed ratio between the area scale of a triangle and the mean scale of the chart. The ratio is the
    /// larger of the two scales, divided by the smaller. The area scale of a triangle is its area in the plane, divided
    /// by its area on the surface.
    pub(super) max_stretch: f64,
}

/// The limits that the map of a chart into the plane must not exceed.
struct Allowed {
    /// The largest allowed ratio between area scales; see [`Limits::max_stretch`].
    stretch: f64,
    /// The largest allowed aspect (see [`Stretch`](super::Stretch)). Some triangles can exceed this limit if their
    /// total area is at most the fraction `except` of the area of the chart.
    aspect: f64,
    except: f64,
    /// The largest allowed mean ratio between the area scale of a triangle and the mean scale of the chart. The ratio
    /// is the larger of the two scales, divided by the smaller; the mean over all triangles is weighted by area.
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
    /// Two faces overlap in the plane, or one face overlaps itself. If a face overlaps itself, both ids are the id of
    /// this face.
    Overlap([FaceId; 2]),
    /// A triangle is mirrored in the plane, or the stretch is too large.
    Stretch,
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

/// Checks the positions of a part in the plane. Triangles must neither be mirrored nor overlap each other, and the
/// stretch must be within the limits.
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
    // The queue compares the bits of `f64` numbers. For non-negative numbers, the bits (read as an integer) have the
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
