//! The parts of an OBJ file are parsed in parallel. Joins these parts in the order of the file.

use std::collections::BTreeMap;

use bytemuck::Zeroable;
use glam::DVec4;

use super::corner::Counts;
use super::file::{LeftOut, NONE, ObjFile, Run};
use super::part::{Indices, Names, Part, PartRun, to_u32};
use super::statement::MAX_LISTED_WORDS;
use crate::text::TextPosition;
use mesh::parallel;

/// Whether every index in the parts refers to an existing element of the file, and all counts of the file fit in 32
/// bits.
pub(super) fn fits(parts: &[Part]) -> bool {
    let mut before = Counts::default();
    let mut highest = Counts::default();
    let (mut corners, mut line_corners) = (0, 0);
    for part in parts {
        if !covers(before, part.reach) {
            return false;
        }
        for (k, count) in part.counts().into_iter().enumerate() {
            before[k] += count;
            highest[k] = highest[k].max(part.highest[k]);
        }
        corners += part.n_corners();
        line_corners += part.line_corners.len();
    }
    let most = NONE as usize;
    covers([most; 3], before) && covers(before, highest) && corners.max(line_corners) <= most
}

fn covers(a: Counts, b: Counts) -> bool {
    a.iter().zip(b).all(|(a, b)| *a >= b)
}

/// Joins parts for which [`fits`] returns true.
pub(super) fn join(mut parts: Vec<Part>) -> ObjFile {
    let mut file = ObjFile::default();
    states(&parts, &mut file);
    left_out(&mut parts, &mut file);

    let before = |count: &dyn Fn(&Part) -> usize| starts(parts.iter().map(count));
    let counts = [0, 1, 2].map(|k| before(&|part| part.counts()[k]));
    let corners = before(&Part::n_corners);
    let line_corners = before(&|part| part.line_corners.len());

    let of_faces = parts.iter_mut().map(|part| &mut part.face_ends);
    file.offsets = ends(of_faces, &corners);
    file.corners = [0, 1, 2].map(|k| {
        let of_corners = parts.iter_mut().map(|part| &mut part.corners[k]);
        column(of_corners, &counts[k], &corners)
    });
    let ends_of_lines = parts.iter_mut().map(|part| &mut part.line_ends);
    file.line_offsets = ends(ends_of_lines, &line_corners);
    let of_lines = parts.iter_mut().map(|part| &mut part.line_corners);
    file.line_corners = column(of_lines, &counts[0], &line_corners);

    if parts.iter().any(|part| !part.colors.is_empty()) {
        for part in &mut parts {
            part.colors.resize(part.positions.len(), DVec4::ONE);
        }
    }
    file.colors = together(parts.iter_mut().map(|part| &mut part.colors));
    file.positions = together(parts.iter_mut().map(|part| &mut part.positions));
    file.mrgb_colors = together(parts.iter_mut().map(|part| &mut part.mrgb_colors));
    file.uvs = together(parts.iter_mut().map(|part| &mut part.uvs));
    file.normals = together(parts.iter_mut().map(|part| &mut part.normals));
    file
}

// ---- Arrays ------------------------------------------------------------------------------------

/// Returns the position at which each piece starts in the joined array, followed by the length of the joined array.
fn starts(lengths: impl Iterator<Item = usize>) -> Vec<usize> {
    let mut starts = vec![0];
    let mut end = 0;
    for length in lengths {
        end += length;
        starts.push(end);
    }
    starts
}

/// Joins pieces into an array. `fill` copies a piece to its place in the array. Each piece is freed after it is copied.
fn filled<T, P>(
    pieces: Vec<P>,
    starts: &[usize],
    fill: impl Fn(usize, &mut [T], P) + Sync,
) -> Vec<T>
where
    T: Zeroable + Send,
    P: Send,
{
    let mut all = mesh::zeroed(starts.last().copied().unwrap_or(0));
    let rooms = parallel::split_at_ends(&mut all, starts[1..].iter().copied());
    let tasks = pieces.into_iter().zip(rooms);
    parallel::consume(tasks, |i, (piece, room)| fill(i, room, piece));
    all
}

fn together<'a, T: Zeroable + Copy + Send + Sync + 'a>(
    pieces: impl Iterator<Item = &'a mut Vec<T>>,
) -> Vec<T> {
    let mut pieces: Vec<Vec<T>> = pieces.map(std::mem::take).collect();
    if let [only] = &mut pieces[..] {
        return std::mem::take(only);
    }
    let starts = starts(pieces.iter().map(Vec::len));
    filled(pieces, &starts, |_, room, piece| {
        room.copy_from_slice(&piece);
    })
}

/// Joins the corner indices of all parts. `before` contains, for each part, the number of elements that earlier parts
/// define. This number is added to the relative indices of the part.
fn column<'a>(
    pieces: impl Iterator<Item = &'a mut Indices>,
    before: &[usize],
    corners: &[usize],
) -> Vec<u32> {
    let mut pieces: Vec<Indices> = pieces.map(std::mem::take).collect();
    if let [only] = &mut pieces[..] {
        return std::mem::take(&mut only.values);
    }
    if pieces.iter().all(|piece| piece.len() == 0) {
        return Vec::new();
    }
    filled(pieces, corners, |i, room, piece| {
        if piece.len() == 0 {
            room.fill(NONE);
            return;
        }
        room.copy_from_slice(&piece.values);
        for &at in &piece.relative {
            let index = &mut room[at as usize];
            *index = index.wrapping_add(to_u32(before[i]));
        }
    })
}

/// Each part stores where its faces or polylines end. Converts these ends to offsets in the joined list of corners. The
/// offsets are the start of each face or polyline, followed by the end of the last one.
fn ends<'a>(pieces: impl Iterator<Item = &'a mut Vec<u32>>, corners: &[usize]) -> Vec<u32> {
    let mut pieces: Vec<Vec<u32>> = pieces.map(std::mem::take).collect();
    // The first face or polyline starts at 0.
    pieces.insert(0, vec![0]);
    let starts = starts(pieces.iter().map(Vec::len));
    filled(pieces, &starts, |i, room, piece| {
        let before = to_u32(corners[i.saturating_sub(1)]);
        for (to, end) in room.iter_mut().zip(piece) {
            *to = before + end;
        }
    })
}

// ---- Names and runs ----------------------------------------------------------------------------

/// Joins the runs (consecutive faces with the same groups, object, material and smoothing group) and the names that the
/// runs refer to.
fn states(parts: &[Part], file: &mut ObjFile) {
    let (mut groups, mut objects, mut materials) =
        (Names::default(), Names::default(), Names::default());
    let mut sets = BTreeMap::from([(Vec::new(), 0)]);
    file.group_sets = vec![Vec::new()];
    let mut now = Run::default();
    let mut first_face = 0;
    for part in parts {
        let groups = places(&part.groups, &mut groups);
        let objects = places(&part.objects, &mut objects);
        let materials = places(&part.materials, &mut materials);
        let mut set_places = Vec::with_capacity(part.group_sets.len());
        for set in &part.group_sets {
            let set = set.iter();
            let set = set.filter_map(|&group| groups[group as usize].map(to_u32));
            let mut set: Vec<u32> = set.collect();
            set.sort_unstable();
            let next = file.group_sets.len();
            let place = *sets.entry(set.clone()).or_insert(next);
            if place == next {
                file.group_sets.push(set);
            }
            set_places.push(place);
        }
        let resolved = |run: &PartRun, before: Run| Run {
            first_face: first_face + run.first_face,
            groups: run.groups.map_or(before.groups, |set| set_places[set]),
            object: run.object.map_or(before.object, |object| objects[object]),
            material: run.material.map_or(before.material, |m| materials[m]),
            smoothing: run.smoothing.unwrap_or(before.smoothing),
        };
        for run in &part.runs {
            let run = resolved(run, now);
            let differs = |last: &Run| {
                run != Run {
                    first_face: run.first_face,
                    ..*last
                }
            };
            if file.runs.last().is_none_or(differs) {
                file.runs.push(run);
            }
        }
        now = resolved(&part.last, now);
        first_face += part.face_ends.len();
    }
    file.group_names = groups.list;
    file.object_names = objects.list;
    file.material_names = materials.list;
}

/// Adds the names of a part to `all`. Returns, for each name of the part, its index in `all`, or `None` if the name is
/// empty.
fn places(of_part: &Names, all: &mut Names) -> Vec<Option<usize>> {
    let place = |name: &String| (!name.is_empty()).then(|| all.index_of(name.clone()));
    of_part.list.iter().map(place).collect()
}

// ---- Libraries and left-out content ------------------------------------------------------------------------

fn left_out(parts: &mut [Part], file: &mut ObjFile) {
    let mut lines = 0;
    let mut listed = 0;
    for part in parts {
        for (place, libraries) in part.libraries.drain(..) {
            let line = place.line + lines;
            file.libraries
                .push((TextPosition { line, ..place }, libraries));
        }
        let mut in_order: Vec<_> = std::mem::take(&mut part.left_out).into_iter().collect();
        in_order.sort_by_key(|&(_, (_, line))| line);
        for (mut what, (count, line)) in in_order {
            if matches!(what, LeftOut::Unknown(_)) && !file.left_out.contains_key(&what) {
                if listed < MAX_LISTED_WORDS {
                    listed += 1;
                } else {
                    what = LeftOut::OtherUnknown;
                }
            }
            file.left_out.entry(what).or_insert((0, line + lines)).0 += count;
        }
        lines += part.n_lines;
    }
}
