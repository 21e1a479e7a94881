//! Cleans polygons according to the [`Policies`] of the reader, before a mesh is built from them.

use std::sync::atomic::Ordering::Relaxed;

use glam::DVec3;
use mesh::{Domain, Elements, VertexId};

use crate::note::{NoteKind, Notes};
use crate::polygons::gather;
use crate::{CleanupPolicy, Policies, Polygons};
use mesh::parallel;

/// A face is degenerate if its area is at most this fraction of the square of its longest side. The fraction is not 0,
/// because the computed area of a zero-area face is rarely exactly 0.
const DEGENERATE_RATIO: f64 = 1e-14;

/// To find duplicate faces, the faces are divided into this number of groups. The hash of a face determines its group,
/// so duplicate faces are always in the same group. The groups are processed in parallel.
const N_GROUPS: usize = 16;

/// For each polygon, its index in the file; `None` if all polygons have the same indices as in the file.
pub(crate) type SourcePolygons = Option<Vec<u32>>;

/// Removes each corner that repeats the vertex of the previous corner, and removes the faces and vertices that the
/// policies drop. Returns, for each remaining polygon, its index in the file.
pub(crate) fn clean(
    polygons: &mut Polygons,
    policies: Policies,
    notes: &mut Notes,
) -> SourcePolygons {
    let mut is_corner_kept = vec![];
    let repeated = repeated_corners(polygons, &mut is_corner_kept);
    let unwanted: [(_, fn(&Polygons) -> _, _, _, _); 2] = [
        (
            policies.degenerate,
            degenerate,
            "degenerate-faces-dropped",
            "zero-area face dropped",
            "zero-area faces dropped",
        ),
        (
            policies.duplicates,
            duplicates,
            "duplicate-faces-dropped",
            "duplicate face dropped",
            "duplicate faces dropped",
        ),
    ];
    let mut is_dropped = vec![];
    for (policy, find, code, one, several) in unwanted {
        if policy == CleanupPolicy::Drop {
            let faces: Vec<usize> = find(polygons);
            is_dropped.resize(polygons.n_faces(), false);
            for &f in &faces {
                is_dropped[f] = true;
            }
            let what = if faces.len() == 1 { one } else { several };
            note(polygons, code, what, Elements::Faces(faces), notes);
        }
    }
    let what = "faces with repeated corners: repetitions removed";
    let code = "corners-repeated";
    note(polygons, code, what, Elements::Faces(repeated), notes);
    let kept = keep(polygons, &is_dropped, &is_corner_kept);
    if policies.isolated == CleanupPolicy::Drop {
        drop_isolated(polygons, notes);
    }
    kept
}

/// Adds a note about changed or removed elements, with their positions.
fn note(
    polygons: &Polygons,
    code: &'static str,
    what: &str,
    elements: Elements,
    notes: &mut Notes,
) {
    let places = polygons.arrays().places(&elements);
    notes.elements(code, NoteKind::Changed, what, elements, places);
}

// ---- Repeated corners --------------------------------------------------------------------------

/// The corners of polygon `f`.
fn corners(polygons: &Polygons, f: usize) -> &[u32] {
    &polygons.corners[polygons.offsets[f] as usize..polygons.offsets[f + 1] as usize]
}

/// Returns the polygons that have repeated corners and at least three other corners. A corner is repeated if it has the
/// same vertex as the previous corner. Sets the flags in `is_kept` to false for the repeated corners of these polygons.
fn repeated_corners(polygons: &Polygons, is_kept: &mut Vec<bool>) -> Vec<usize> {
    let kept_in = |corners: &[u32]| {
        let before = corners.iter().cycle().skip(corners.len().max(1) - 1);
        let pairs = corners.iter().zip(before);
        pairs.filter(|(v, before)| v != before).count()
    };
    let is_repaired = |f: usize| {
        let corners = corners(polygons, f);
        let n = kept_in(corners);
        n >= 3 && n < corners.len()
    };
    let repaired = parallel::filter(polygons.n_faces(), is_repaired);
    if !repaired.is_empty() {
        is_kept.resize(polygons.corners.len(), true);
    }
    for &f in &repaired {
        let corners = corners(polygons, f);
        let first = polygons.offsets[f] as usize;
        for (i, &v) in corners.iter().enumerate() {
            // If consecutive corners have the same vertex, the first of them is kept. The first and the last corner of
            // a polygon are also consecutive.
            is_kept[first + i] = v != corners[(i + corners.len() - 1) % corners.len()];
        }
    }
    repaired
}

// ---- Degenerate faces --------------------------------------------------------------------------

fn degenerate(polygons: &Polygons) -> Vec<usize> {
    let has_no_area = |f: usize| {
        let points = corners(polygons, f).iter();
        let points: Option<Vec<DVec3>> = points
            .map(|&v| polygons.positions.get(v as usize).copied())
            .collect();
        // A face with a vertex index out of range is not degenerate. Building the mesh reports this index as an error.
        points.is_some_and(|points| is_degenerate(&points))
    };
    parallel::filter(polygons.n_faces(), has_no_area)
}

fn is_degenerate(points: &[DVec3]) -> bool {
    let Some((&first, rest)) = points.split_first() else {
        return true;
    };
    let double: DVec3 = rest
        .windows(2)
        .map(|w| (w[0] - first).cross(w[1] - first))
        .sum();
    let sides = points.iter().zip(points.iter().cycle().skip(1));
    let longest = sides
        .map(|(a, b)| a.distance_squared(*b))
        .fold(0.0, f64::max);
    // If a number overflows and the result is NaN, this comparison is false, and the face is kept.
    double.length() <= 2.0 * DEGENERATE_RATIO * longest
}

// ---- Duplicates --------------------------------------------------------------------------------

/// Returns the polygons that have the same vertices as an earlier polygon, in the same or the opposite circular order.
fn duplicates(polygons: &Polygons) -> Vec<usize> {
    let hashes = parallel::collect(polygons.n_faces(), |f| sum_of_hashes(corners(polygons, f)));
    // Each task sorts the faces of one group by their hashes, so that faces with the same hash are next to each other.
    let shares = parallel::map(N_GROUPS, |share| {
        let own = hashes
            .iter()
            .zip(0..)
            .filter(|(hash, _)| **hash % N_GROUPS as u64 == share as u64);
        let mut keys: Vec<(u64, u32)> = own.map(|(&hash, f)| (hash, f)).collect();
        keys.sort_unstable();
        let mut duplicates = Vec::new();
        for same in keys
            .chunk_by(|a, b| a.0 == b.0)
            .filter(|same| same.len() > 1)
        {
            let cycle =
                |&(_, f): &(u64, u32)| (canonical(corners(polygons, f as usize)), f as usize);
            let mut cycles: Vec<(Vec<u32>, usize)> = same.iter().map(cycle).collect();
            cycles.sort_unstable();
            for equal in cycles.chunk_by(|a, b| a.0 == b.0) {
                duplicates.extend(equal[1..].iter().map(|&(_, f)| f));
            }
        }
        duplicates
    });
    let mut duplicates = shares.concat();
    duplicates.sort_unstable();
    duplicates
}

/// Returns a hash of a face: the sum of the hashes of its vertices. The hash does not depend on the order of the
/// corners.
fn sum_of_hashes(corners: &[u32]) -> u64 {
    // The hash function is the finalizer of SplitMix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number
    // generators", 2014).
    let hashes = corners.iter().map(|&v| {
        let x = (u64::from(v) + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        x ^ (x >> 31)
    });
    hashes.fold(corners.len() as u64, u64::wrapping_add)
}

/// Lists the vertices of a polygon, beginning with the vertex that has the lowest index. Of the two directions around
/// the polygon, chooses the one that gives the lexicographically smaller list. Polygons with the same vertices in the
/// same or the opposite circular order give the same list.
fn canonical(corners: &[u32]) -> Vec<u32> {
    let Some(start) = (0..corners.len()).min_by_key(|&i| corners[i]) else {
        return Vec::new();
    };
    let n = corners.len();
    let ahead: Vec<u32> = (0..n).map(|i| corners[(start + i) % n]).collect();
    let back: Vec<u32> = (0..n).map(|i| corners[(start + n - i) % n]).collect();
    ahead.min(back)
}

fn id(n: usize) -> u32 {
    u32::try_from(n).unwrap_or(u32::MAX)
}

// ---- Removing -------------------------------------------------------------------------------

/// Removes the polygons for which `is_dropped` is true, and the corners for which `is_corner_kept` is false. If a list
/// of flags is empty, all polygons or all corners are kept.
pub(crate) fn keep(
    polygons: &mut Polygons,
    is_dropped: &[bool],
    is_corner_kept: &[bool],
) -> SourcePolygons {
    if is_dropped.is_empty() && is_corner_kept.is_empty() {
        return None;
    }
    let is_face = |f: usize| is_dropped.get(f).is_none_or(|is| !is);
    let is_corner = |c: usize| is_corner_kept.get(c).is_none_or(|&is| is);
    let kept: Vec<u32> = (0..polygons.n_faces())
        .filter(|&f| is_face(f))
        .map(id)
        .collect();
    let mut offsets = Vec::with_capacity(kept.len() + 1);
    let mut sources: Vec<u32> = Vec::with_capacity(polygons.corners.len());
    offsets.push(0);
    for &f in &kept {
        let ends = polygons.offsets[f as usize]..polygons.offsets[f as usize + 1];
        sources.extend(ends.filter(|&c| is_corner(c as usize)));
        offsets.push(id(sources.len()));
    }
    polygons.corners = sources
        .iter()
        .map(|&c| polygons.corners[c as usize])
        .collect();
    polygons.offsets = offsets;
    gather(&mut polygons.attributes, Domain::Corner, &sources);
    gather(&mut polygons.attributes, Domain::Face, &kept);
    Some(kept)
}

fn drop_isolated(polygons: &mut Polygons, notes: &mut Notes) {
    let n = polygons.positions.len();
    let used = parallel::index_flags(n, &polygons.corners);
    let (kept, isolated): (Vec<u32>, Vec<u32>) =
        (0..id(n)).partition(|&v| used[v as usize].load(Relaxed));
    if isolated.is_empty() {
        return;
    }
    let vertices = isolated.iter().map(|&v| VertexId::new(v as usize));
    let vertices = Elements::Vertices(vertices.collect());
    let what = if isolated.len() == 1 {
        "isolated vertex dropped"
    } else {
        "isolated vertices dropped"
    };
    note(polygons, "isolated-vertices-dropped", what, vertices, notes);
    let mut new = vec![u32::MAX; n];
    for (i, &v) in (0..).zip(&kept) {
        new[v as usize] = i;
    }
    let moved = |v: &mut u32| *v = new.get(*v as usize).copied().unwrap_or(u32::MAX);
    parallel::change(&mut polygons.corners, moved);
    let positions = &polygons.positions;
    polygons.positions = kept.iter().map(|&v| positions[v as usize]).collect();
    gather(&mut polygons.attributes, Domain::Vertex, &kept);
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    fn polygons_of(faces: &[&[u32]]) -> Polygons {
        let points = [
            [0.0, 0.0],
            [1.0, 0.0],
            [2.0, 0.0],
            [0.0, 1.0],
            [5.0, 5.0],
            [1.0, 1.0],
        ];
        let mut polygons = Polygons {
            positions: points.map(|[x, y]| DVec3::new(x, y, 0.0)).to_vec(),
            ..Polygons::default()
        };
        for face in faces {
            polygons.corners.extend_from_slice(face);
            polygons.offsets.push(id(polygons.corners.len()));
        }
        let rule = mesh::Rule::Copy;
        let corners = (0..polygons.corners.len()).map(|c| c as f64).collect();
        polygons.insert::<f64>(Domain::Corner, "c", rule, corners);
        let faces = (0..faces.len()).map(|f| f as f64).collect();
        polygons.insert::<f64>(Domain::Face, "f", rule, faces);
        let vertices = (0..6).map(f64::from).collect();
        polygons.insert::<f64>(Domain::Vertex, "v", rule, vertices);
        polygons
    }

    fn cleaned(faces: &[&[u32]], policies: Policies) -> (Polygons, SourcePolygons, Vec<String>) {
        let mut polygons = polygons_of(faces);
        let mut notes = Notes::of(Path::new("a"));
        let kept = clean(&mut polygons, policies, &mut notes);
        let notes = notes.into_vec().iter().map(ToString::to_string).collect();
        (polygons, kept, notes)
    }

    fn values(polygons: &Polygons, domain: Domain, name: &str) -> Vec<f64> {
        let column = polygons.attributes.column(domain, name).unwrap();
        <f64 as mesh::Value>::of(&column.values).unwrap().to_vec()
    }

    #[test]
    fn clean_polygons_stay_as_they_are() {
        let all = Policies {
            degenerate: CleanupPolicy::Drop,
            duplicates: CleanupPolicy::Drop,
            ..Policies::default()
        };
        let faces: &[&[u32]] = &[&[0, 1, 3], &[1, 2, 5]];
        let (polygons, _, notes) = cleaned(faces, all);
        assert_eq!(polygons, polygons_of(faces));
        assert!(notes.is_empty());
    }

    #[test]
    fn a_corner_that_repeats_the_one_before_is_removed() {
        let faces: &[&[u32]] = &[&[0, 1, 1, 3], &[3, 0, 1, 3, 3], &[0, 0, 1]];
        let (polygons, kept, notes) = cleaned(faces, Policies::default());
        assert_eq!(polygons.corners, [0, 1, 3, 0, 1, 3, 0, 0, 1]);
        assert_eq!(polygons.offsets, [0, 3, 6, 9]);
        assert_eq!(kept, Some(vec![0, 1, 2]));
        assert_eq!(
            notes,
            ["a: 2 faces with repeated corners: repetitions removed (faces 0, 1)"]
        );
    }

    #[test]
    fn faces_without_area_are_dropped_with_their_values() {
        let policies = Policies {
            degenerate: CleanupPolicy::Drop,
            ..Policies::default()
        };
        let (polygons, kept, notes) = cleaned(&[&[0, 1, 2], &[0, 1, 3]], policies);
        assert_eq!(polygons.corners, [0, 1, 3]);
        assert_eq!(kept, Some(vec![1]));
        assert_eq!(values(&polygons, Domain::Corner, "c"), [3.0, 4.0, 5.0]);
        assert_eq!(values(&polygons, Domain::Face, "f"), [1.0]);
        assert_eq!(notes, ["a: 1 zero-area face dropped (face 0)"]);
    }

    #[test]
    fn the_first_of_the_duplicates_in_either_direction_is_kept() {
        let policies = Policies {
            duplicates: CleanupPolicy::Drop,
            ..Policies::default()
        };
        let faces: &[&[u32]] = &[
            &[0, 1, 5, 3],
            &[5, 3, 0, 1],
            &[3, 5, 1, 0],
            &[0, 5, 1, 3],
            &[0, 1, 3],
        ];
        let (polygons, kept, notes) = cleaned(faces, policies);
        assert_eq!(kept, Some(vec![0, 3, 4]));
        assert_eq!(polygons.n_faces(), 3);
        assert_eq!(notes, ["a: 2 duplicate faces dropped (faces 1, 2)"]);
    }

    #[test]
    fn isolated_vertices_are_dropped_and_the_remaining_ones_renumbered() {
        let policies = Policies {
            isolated: CleanupPolicy::Drop,
            ..Policies::default()
        };
        let (polygons, _, notes) = cleaned(&[&[0, 1, 5]], policies);
        assert_eq!(polygons.corners, [0, 1, 2]);
        assert_eq!(polygons.positions[2], DVec3::new(1.0, 1.0, 0.0));
        assert_eq!(values(&polygons, Domain::Vertex, "v"), [0.0, 1.0, 5.0]);
        assert_eq!(notes, ["a: 3 isolated vertices dropped (v2, v3, v4)"]);
    }
}
