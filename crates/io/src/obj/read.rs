//! From the statements of an OBJ file to an object.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::Path;
use std::sync::atomic::AtomicBool;
use std::sync::atomic::Ordering::Relaxed;

use bytemuck::Zeroable;
use glam::DVec3;
use mesh::{CORNER_NORMAL, Column, Domain, Rule, UV, Values};
use rayon::prelude::*;
use scene::{Geometry, Material};

use super::OBJECT_TAG;
use super::file::{LeftOut, NONE, ObjFile, Run};
use super::material::read_libraries;
use super::parse::parse;
use crate::error::ReadError;
use crate::note::Notes;
use crate::{Found, Polygons};

/// Tags take a byte for each face. Groups and objects beyond this many bytes are left out.
const MOST_TAG_BYTES: usize = 1 << 28;
/// Groups and objects beyond this number are left out.
const MOST_TAGS: usize = 4096;

/// Reads an OBJ file from its bytes; `path` is where its material libraries are looked for.
///
/// # Errors
///
/// The first line that breaks the rules of the format.
pub(crate) fn read(
    path: &Path,
    bytes: &[u8],
    name: String,
    notes: &mut Notes,
) -> Result<Found, ReadError> {
    let mut file = parse(bytes).map_err(|error| error.in_file(path))?;
    note_left_out(&file, notes);
    take_paint(&mut file, notes);
    let n_lines = file.line_offsets.len() - 1;
    if file.faces.len() == 0 && n_lines > 0 {
        let lines = polylines(&file, notes);
        return Ok(Found::other(name, Geometry::Polylines(lines)));
    }
    notes.left_out(
        n_lines,
        None,
        "polylines (`l`) left out: the object is a mesh",
    );
    let materials = read_libraries(path, &file, notes)?;
    Ok(Found::polygons(name, polygons(file, materials, notes)))
}

/// Makes colors of vertices of what comments of `ZBrush` say.
fn take_paint(file: &mut ObjFile, notes: &mut Notes) {
    let painted = std::mem::take(&mut file.painted);
    if painted.is_empty() {
        return;
    }
    if painted.len() != file.positions.len() || !file.colors.is_empty() {
        let what = "colors of `#MRGB` comments left out: not one for each vertex, or beside others";
        notes.left_out(painted.len(), None, what);
        return;
    }
    let masked = painted.iter().filter(|&&color| color >> 24 != 0xff).count();
    notes.left_out(masked, None, "masks of `#MRGB` comments left out");
    let color = |color: &u32| {
        let [_, red, green, blue] = color.to_be_bytes().map(f64::from);
        (DVec3::new(red, green, blue) / 255.0).extend(1.0)
    };
    file.colors = painted.iter().map(color).collect();
}

fn polylines(file: &ObjFile, notes: &mut Notes) -> Vec<Vec<DVec3>> {
    let mut used = vec![false; file.positions.len()];
    let corners = |w: &[u32]| &file.line_corners[w[0] as usize..w[1] as usize];
    let mut lines = Vec::with_capacity(file.line_offsets.len() - 1);
    for line in file.line_offsets.windows(2).map(corners) {
        for &v in line {
            used[v as usize] = true;
        }
        lines.push(line.iter().map(|&v| file.positions[v as usize]).collect());
    }
    let unused = used.iter().filter(|&&used| !used).count();
    notes.left_out(unused, None, "vertices left out: no polyline uses them");
    let colors = file.colors.len();
    notes.left_out(colors, None, "vertex colors left out: polylines have none");
    lines
}

fn polygons(mut file: ObjFile, materials: Vec<Material>, notes: &mut Notes) -> Polygons {
    let mut polygons = Polygons {
        positions: std::mem::take(&mut file.positions),
        offsets: std::mem::take(&mut file.faces.offsets),
        corners: std::mem::take(&mut file.faces.positions),
        ..Polygons::default()
    };
    if !file.colors.is_empty() {
        polygons.insert_vertices(mesh::COLOR, std::mem::take(&mut file.colors));
    }
    let faces = &file.faces;
    notes.left_out(
        unused(file.uvs.len(), &faces.uvs),
        None,
        "texture coordinates (`vt`) left out: no face uses them",
    );
    notes.left_out(
        unused(file.normals.len(), &faces.normals),
        None,
        "normals (`vn`) left out: no face uses them",
    );
    if !faces.uvs.is_empty() {
        polygons.insert_corners(UV, values(&file.uvs, &faces.uvs));
        notes.changed(
            missing(&faces.uvs),
            None,
            "face corners without texture coordinate: taken as 0 0",
        );
    }
    if !faces.normals.is_empty() {
        polygons.insert_corners(CORNER_NORMAL, values(&file.normals, &faces.normals));
        notes.changed(
            missing(&faces.normals),
            None,
            "face corners without normal: taken as 0 0 0",
        );
    }
    set_materials(&mut polygons, &file, &materials);
    if file.runs.iter().any(|run| run.smoothing != 0) {
        let values = on_faces(&polygons, &file, |run| run.smoothing);
        polygons.insert_faces(mesh::SMOOTHING, values);
    }
    set_tags(&mut polygons, &file, notes);
    polygons.materials = materials;
    polygons
}

/// Smaller pieces are not worth the trouble of dividing them among threads.
const MIN_TASK: usize = 1 << 14;

/// The value of each index, zero for [`NONE`].
fn values<T: Copy + Send + Sync + Zeroable>(values: &[T], indices: &[u32]) -> Vec<T> {
    let mut all = mesh::zeroed(indices.len());
    let places = all.par_iter_mut().zip(indices).with_min_len(MIN_TASK);
    places.for_each(|(value, &index)| {
        if index != NONE {
            *value = values[index as usize];
        }
    });
    all
}

fn missing(indices: &[u32]) -> usize {
    let indices = indices.par_iter().with_min_len(MIN_TASK);
    indices.filter(|&&index| index == NONE).count()
}

/// How many of `n` no index names.
fn unused(n: usize, indices: &[u32]) -> usize {
    let used: Vec<AtomicBool> = (0..n).map(|_| AtomicBool::new(false)).collect();
    let indices = indices.par_iter().with_min_len(MIN_TASK);
    let named = indices.filter(|&&index| index != NONE);
    named.for_each(|&index| used[index as usize].store(true, Relaxed));
    used.iter().filter(|used| !used.load(Relaxed)).count()
}

// ---- Values of faces ---------------------------------------------------------------------------

/// The faces of run number `i`.
fn faces_of_run(file: &ObjFile, i: usize, n_faces: usize) -> Range<usize> {
    let next = file.runs.get(i + 1);
    file.runs[i].first_face..next.map_or(n_faces, |next| next.first_face)
}

/// One value for each face, from its run.
fn on_faces<T: Copy + Default>(
    polygons: &Polygons,
    file: &ObjFile,
    of_run: impl Fn(&Run) -> T,
) -> Vec<T> {
    let n = polygons.n_faces();
    let mut values = vec![T::default(); n];
    for (i, run) in file.runs.iter().enumerate() {
        values[faces_of_run(file, i, n)].fill(of_run(run));
    }
    values
}

fn set_materials(polygons: &mut Polygons, file: &ObjFile, materials: &[Material]) {
    if file.runs.iter().all(|run| run.material.is_none()) {
        return;
    }
    let by_name: BTreeMap<&str, i32> = materials
        .iter()
        .zip(0..)
        .map(|(material, place)| (material.name.as_str(), place))
        .collect();
    let place_of = |name: &String| by_name.get(name.as_str()).copied().unwrap_or(-1);
    let places: Vec<i32> = file.material_names.iter().map(place_of).collect();
    let of_run = |run: &Run| run.material.map_or(-1, |m| places[m]);
    let values = on_faces(polygons, file, of_run);
    polygons.insert_faces(mesh::MATERIAL, values);
}

fn set_tags(polygons: &mut Polygons, file: &ObjFile, notes: &mut Notes) {
    let n_faces = polygons.n_faces();
    let room = MOST_TAGS.min(MOST_TAG_BYTES / n_faces.max(1));
    let too_many = |n: usize| n.saturating_sub(room);
    let objects = file.object_names.len();
    let groups = file.group_names.len();
    let left_out = too_many(objects + groups);
    notes.left_out(
        left_out,
        None,
        "groups and objects left out: too many for a mesh of this size",
    );
    let n_columns = objects + groups - left_out;
    let mut columns: Vec<Vec<bool>> = vec![vec![false; n_faces]; n_columns];
    // Objects come first: they matter more where not all fit.
    for (i, run) in file.runs.iter().enumerate() {
        let of_groups = file.group_sets[run.groups]
            .iter()
            .map(|&g| objects + g as usize);
        // Sets are in order: nothing is looked at behind the first group that is left out.
        let of_groups = of_groups.take_while(|&column| column < n_columns);
        for column in run.object.into_iter().chain(of_groups) {
            if let Some(marks) = columns.get_mut(column) {
                marks[faces_of_run(file, i, n_faces)].fill(true);
            }
        }
    }
    let object_tags = file
        .object_names
        .iter()
        .map(|name| format!("{OBJECT_TAG}{name}"));
    let names = object_tags.chain(file.group_names.iter().cloned());
    let mut without_faces = 0;
    for (name, mut marks) in names.zip(columns) {
        if !marks.contains(&true) {
            without_faces += 1;
            continue;
        }
        let name = match polygons.attributes.column(Domain::Face, &name) {
            None => name,
            Some(Column {
                values: Values::Tag(known),
                ..
            }) => {
                // A group named as the tag of an object.
                for (mark, known) in marks.iter_mut().zip(known) {
                    *mark |= known;
                }
                name
            }
            Some(_) => {
                notes.changed(
                    1,
                    None,
                    format!("group `{name}` is now called `{name} group`: the name is taken"),
                );
                format!("{name} group")
            }
        };
        polygons.insert(Domain::Face, name, Rule::Copy, marks);
    }
    notes.left_out(
        without_faces,
        None,
        "groups and objects left out: they have no faces",
    );
}

fn note_left_out(file: &ObjFile, notes: &mut Notes) {
    for (what, &(count, line)) in &file.left_out {
        let text = match what {
            LeftOut::Statement(keyword) => format!("statements `{keyword}` left out: not polygons"),
            LeftOut::Unknown(word) => {
                format!(
                    "lines left out: `{}` is no known statement",
                    word.escape_debug()
                )
            }
            LeftOut::OtherUnknown => "lines with other unknown statements left out".to_owned(),
            LeftOut::Points => "points (`p`) left out".to_owned(),
            LeftOut::SmallFaces => "faces with fewer than 3 corners left out".to_owned(),
            LeftOut::Weights => "weights of vertices other than 1 left out".to_owned(),
            LeftOut::NotFinite => {
                let what =
                    "numbers of texture coordinates and normals that are not finite: taken as 0";
                notes.changed(count, line, what);
                continue;
            }
            LeftOut::Depths => "third texture coordinates other than 0 left out".to_owned(),
        };
        notes.left_out(count, line, text);
    }
}
