//! Converts the statements of an OBJ file to an object.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::atomic::Ordering::Relaxed;

use bytemuck::Zeroable;
use glam::DVec3;
use mesh::{CORNER_NORMAL, Column, Domain, Rule, UV, Values};
use scene::{Geometry, Material};

use super::file::{LeftOut, NONE, ObjFile, Run};
use super::material::read_libraries;
use super::parse::parse;
use crate::assets::Assets;
use crate::fault::Fault;
use crate::note::Notes;
use crate::polygons::{OBJECT_TAG, most_tags};
use crate::{Polygons, Shape};
use mesh::parallel;

/// The note about polylines in a file with faces.
pub(super) const POLYLINES: &str = "polylines (`l`) left out: the object is a mesh";

/// Reads an OBJ file, given as bytes, and its material libraries.
///
/// # Errors
///
/// Returns an error if a line violates the format; the error describes the first such line. Also returns an error if a
/// material library is needed but its path is not inside the folder of the OBJ file.
pub(crate) fn read(bytes: &[u8], assets: &mut Assets, notes: &mut Notes) -> Result<Shape, Fault> {
    let mut file = parse(bytes)?;
    note_left_out(&file, notes);
    use_mrgb_colors(&mut file, notes);
    let n_lines = file.line_offsets.len() - 1;
    if file.offsets.len() == 1 && n_lines > 0 {
        let lines = polylines(&file, notes);
        return Ok(Shape::Geometry(Geometry::Polylines(lines)));
    }
    notes.left_out("polylines", n_lines, None, POLYLINES);
    let materials = read_libraries(assets, &file, notes)?;
    Ok(Shape::Polygons(polygons(file, materials, notes)))
}

/// Uses the colors in `#MRGB` comments of `ZBrush` as vertex colors.
fn use_mrgb_colors(file: &mut ObjFile, notes: &mut Notes) {
    let mrgb_colors = std::mem::take(&mut file.mrgb_colors);
    if mrgb_colors.is_empty() {
        return;
    }
    if mrgb_colors.len() != file.positions.len() || !file.colors.is_empty() {
        let what = "colors of `#MRGB` comments left out: their number differs from the number of vertices, or `v` statements also define colors";
        notes.left_out("colors", mrgb_colors.len(), None, what);
        return;
    }
    let masked = mrgb_colors
        .iter()
        .filter(|&&color| color >> 24 != 0xff)
        .count();
    notes.left_out("masks", masked, None, "masks of `#MRGB` comments left out");
    let color = |color: &u32| {
        let [_, red, green, blue] = color.to_be_bytes().map(f64::from);
        (DVec3::new(red, green, blue) / 255.0).extend(1.0)
    };
    file.colors = mrgb_colors.iter().map(color).collect();
}

fn polylines(file: &ObjFile, notes: &mut Notes) -> Vec<Vec<DVec3>> {
    let line = |w: &[u32]| {
        let corners = file.line_corners[w[0] as usize..w[1] as usize].iter();
        corners.map(|&v| file.positions[v as usize]).collect()
    };
    let unused = unused(file.positions.len(), &file.line_corners);
    notes.left_out(
        "vertices-unused",
        unused,
        None,
        "vertices left out: not used by any polyline",
    );
    let colors = file.colors.len();
    notes.left_out(
        "colors",
        colors,
        None,
        "vertex colors left out: polylines cannot have colors",
    );
    file.line_offsets.windows(2).map(line).collect()
}

fn polygons(mut file: ObjFile, materials: Vec<Material>, notes: &mut Notes) -> Polygons {
    let mut polygons = Polygons {
        positions: std::mem::take(&mut file.positions),
        offsets: std::mem::take(&mut file.offsets),
        corners: std::mem::take(&mut file.corners[0]),
        ..Polygons::default()
    };
    if !file.colors.is_empty() {
        polygons.insert_known(mesh::COLOR, std::mem::take(&mut file.colors));
    }
    let [_, of_uvs, of_normals] = &file.corners;
    let what = "texture coordinates (`vt`) left out: not used by any face";
    notes.left_out("uvs-unused", unused(file.uvs.len(), of_uvs), None, what);
    let what = "normals (`vn`) left out: not used by any face";
    notes.left_out(
        "normals-unused",
        unused(file.normals.len(), of_normals),
        None,
        what,
    );
    if !of_uvs.is_empty() {
        polygons.insert_known(UV, values(&file.uvs, of_uvs));
        let what = "face corners without texture coordinates: set to 0 0";
        notes.changed("uvs-missing", missing(of_uvs), None, what);
    }
    if !of_normals.is_empty() {
        polygons.insert_known(CORNER_NORMAL, values(&file.normals, of_normals));
        let what = "face corners without a normal: set to 0 0 0";
        notes.changed("normals-missing", missing(of_normals), None, what);
    }
    set_materials(&mut polygons, &file, &materials);
    if file.runs.iter().any(|run| run.smoothing != 0) {
        let values = on_faces(&polygons, &file, |run| run.smoothing);
        polygons.insert_known(mesh::SMOOTHING, values);
    }
    set_tags(&mut polygons, &file, notes);
    polygons.materials = materials;
    polygons
}

/// Returns the value at each index, or zero for [`NONE`].
fn values<T: Copy + Send + Sync + Zeroable>(values: &[T], indices: &[u32]) -> Vec<T> {
    parallel::collect(indices.len(), |i| match indices[i] {
        NONE => T::zeroed(),
        index => values[index as usize],
    })
}

fn missing(indices: &[u32]) -> usize {
    parallel::count(indices.len(), |i| indices[i] == NONE)
}

/// Counts the elements to which no index refers. There are `n` elements.
fn unused(n: usize, indices: &[u32]) -> usize {
    let used = parallel::index_flags(n, indices);
    used.iter().filter(|used| !used.load(Relaxed)).count()
}

// ---- Values of faces ---------------------------------------------------------------------------

/// Returns the faces of run `i`. A run consists of consecutive faces with the same groups, object, material and
/// smoothing group.
fn faces_of_run(file: &ObjFile, i: usize, n_faces: usize) -> Range<usize> {
    let next = file.runs.get(i + 1);
    file.runs[i].first_face..next.map_or(n_faces, |next| next.first_face)
}

/// Returns a value for each face. `of_run` gives the value for all faces of a run.
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
    let names = materials.iter().map(|material| material.name.as_str());
    let by_name: BTreeMap<&str, i32> = names.zip(0..).collect();
    let place_of = |name: &String| by_name.get(name.as_str()).copied().unwrap_or(-1);
    let places: Vec<i32> = file.material_names.iter().map(place_of).collect();
    let of_run = |run: &Run| run.material.map_or(-1, |m| places[m]);
    let values = on_faces(polygons, file, of_run);
    polygons.insert_known(mesh::MATERIAL, values);
}

fn set_tags(polygons: &mut Polygons, file: &ObjFile, notes: &mut Notes) {
    let n_faces = polygons.n_faces();
    let objects = file.object_names.len();
    let n = objects + file.group_names.len();
    let n_columns = n.min(most_tags(n_faces));
    let what = format!(
        "groups and objects left out: a mesh with {n_faces} faces can store at most {n_columns} groups and objects as face tags"
    );
    notes.left_out("too-many-names", n - n_columns, None, what);
    let mut columns: Vec<Vec<bool>> = vec![vec![false; n_faces]; n_columns];
    // If there are too many tags, tags of groups are left out first, because the columns of objects come before those
    // of groups.
    for (i, run) in file.runs.iter().enumerate() {
        let groups = file.group_sets[run.groups].iter();
        let of_groups = groups.map(|&g| objects + g as usize);
        // The indices in a set of groups are sorted. Therefore, if one group is left out, all later groups of the set
        // are also left out.
        let of_groups = of_groups.take_while(|&column| column < n_columns);
        for column in run.object.into_iter().chain(of_groups) {
            if let Some(marks) = columns.get_mut(column) {
                marks[faces_of_run(file, i, n_faces)].fill(true);
            }
        }
    }
    let tag = |name: &String| format!("{OBJECT_TAG}{name}");
    let object_tags = file.object_names.iter().map(tag);
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
                // If a group has the same name as the tag of an object, the group and the object become one tag.
                for (mark, known) in marks.iter_mut().zip(known) {
                    *mark |= known;
                }
                name
            }
            Some(_) => {
                let what = format!(
                    "group `{name}` renamed to `{name} group`, because another attribute is named `{name}`"
                );
                notes.changed("groups-renamed", 1, None, what);
                format!("{name} group")
            }
        };
        polygons.insert(Domain::Face, name, Rule::Copy, marks);
    }
    let what = "groups and objects left out: they have no faces";
    notes.left_out("groups-empty", without_faces, None, what);
}

pub(super) fn note_left_out(file: &ObjFile, notes: &mut Notes) {
    for (what, &(count, line)) in &file.left_out {
        let (code, text) = match what {
            LeftOut::Statement(keyword) => {
                let text = format!("statements `{keyword}` left out: not supported");
                ("statements", text)
            }
            LeftOut::Unknown(word) => {
                let word = word.escape_debug();
                let text = format!("lines left out: unknown statement `{word}`");
                ("unknown-statements", text)
            }
            LeftOut::OtherUnknown => {
                let text = "lines with further unknown statements left out";
                ("unknown-statements", text.to_owned())
            }
            LeftOut::Points => ("points", "points (`p`) left out".to_owned()),
            LeftOut::SmallFaces => {
                let text = "faces with fewer than 3 corners left out";
                ("faces-too-small", text.to_owned())
            }
            LeftOut::Weights => {
                let text = "vertex weights other than 1 left out";
                ("vertex-weights", text.to_owned())
            }
            LeftOut::Depths => {
                let text = "third texture coordinates other than 0 left out";
                ("third-uvs", text.to_owned())
            }
            LeftOut::NotFinite => {
                let what = "non-finite numbers in texture coordinates and normals: set to 0";
                notes.changed("values-not-finite", count, line, what);
                continue;
            }
        };
        notes.left_out(code, count, line, text);
    }
}
