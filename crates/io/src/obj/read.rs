//! From the statements of an OBJ file to an object.

use std::collections::BTreeMap;
use std::path::Path;

use glam::{DVec2, DVec3};
use mesh::{Built, CORNER_NORMAL, Column, Domain, Mesh, Rule, UV, VERTEX_NORMAL, Values};
use scene::{Geometry, Object};

use super::OBJECT_TAG;
use super::file::{Faces, LeftOut, NONE, ObjFile, Run};
use super::material::read_libraries;
use super::parse::parse;
use crate::ReadOptions;
use crate::build::{build_mesh, values_of_copies};
use crate::corners::{on_half_edges, set_on_vertices_or_corners};
use crate::error::ReadError;
use crate::note::Notes;

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
    options: &ReadOptions,
    notes: &mut Notes,
) -> Result<Object, ReadError> {
    let file = parse(bytes).map_err(|error| error.in_file(path))?;
    note_left_out(&file, notes);
    let n_lines = file.line_offsets.len() - 1;
    if file.faces.len() == 0 && n_lines > 0 {
        return Ok(Object::new(
            name,
            Geometry::Polylines(polylines(&file, notes)),
        ));
    }
    notes.left_out(
        n_lines,
        None,
        "polylines (`l`) left out: the object is a mesh",
    );
    let materials = read_libraries(path, &file, notes)?;
    let mesh = to_mesh(path, file, &materials, options, notes)?;
    Ok(Object {
        materials,
        ..Object::mesh(name, mesh)
    })
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

fn to_mesh(
    path: &Path,
    mut file: ObjFile,
    materials: &[scene::Material],
    options: &ReadOptions,
    notes: &mut Notes,
) -> Result<Mesh, ReadError> {
    let positions = std::mem::take(&mut file.positions);
    let faces = &file.faces;
    let mut built = build_mesh(
        path,
        positions,
        &faces.offsets,
        &faces.positions,
        options,
        notes,
    )?;
    if !file.colors.is_empty() {
        let colors = values_of_copies(std::mem::take(&mut file.colors), &built);
        built.mesh.set(mesh::COLOR, colors);
    }
    set_uvs(&mut built, &file.uvs, faces, notes);
    set_normals(&mut built, &file.normals, faces, notes);
    set_materials(&mut built, &file, materials);
    if file.runs.iter().any(|run| run.smoothing != 0) {
        let values = on_faces(&built, &file, |run| run.smoothing);
        built.mesh.set(mesh::SMOOTHING, values);
    }
    set_tags(&mut built, &file, notes);
    Ok(built.mesh)
}

fn set_uvs(built: &mut Built, uvs: &[DVec2], faces: &Faces, notes: &mut Notes) {
    notes.left_out(
        unused(uvs.len(), &faces.uvs),
        None,
        "texture coordinates (`vt`) left out: no face uses them",
    );
    if faces.uvs.is_empty() {
        return;
    }
    let values = on_half_edges(built, |c| value(uvs, faces.uvs[c]));
    built.mesh.set(UV, values);
    notes.changed(
        missing(&faces.uvs),
        None,
        "face corners without texture coordinate: taken as 0 0",
    );
}

fn set_normals(built: &mut Built, normals: &[DVec3], faces: &Faces, notes: &mut Notes) {
    notes.left_out(
        unused(normals.len(), &faces.normals),
        None,
        "normals (`vn`) left out: no face uses them",
    );
    if faces.normals.is_empty() {
        return;
    }
    let values = on_half_edges(built, |c| value(normals, faces.normals[c]));
    let zero = |_| DVec3::ZERO;
    set_on_vertices_or_corners(&mut built.mesh, VERTEX_NORMAL, CORNER_NORMAL, values, zero);
    notes.changed(
        missing(&faces.normals),
        None,
        "face corners without normal: taken as 0 0 0",
    );
}

fn value<T: Copy + Default>(values: &[T], index: u32) -> T {
    if index == NONE {
        T::default()
    } else {
        values[index as usize]
    }
}

fn missing(indices: &[u32]) -> usize {
    indices.iter().filter(|&&index| index == NONE).count()
}

fn unused(n: usize, indices: &[u32]) -> usize {
    let mut unused = vec![true; n];
    for &index in indices.iter().filter(|&&index| index != NONE) {
        unused[index as usize] = false;
    }
    unused.into_iter().filter(|&is| is).count()
}

// ---- Values of faces ---------------------------------------------------------------------------

/// One value for each face of the mesh, from the run of its polygon.
fn on_faces<T: Copy + Default>(
    built: &Built,
    file: &ObjFile,
    of_run: impl Fn(&Run) -> T,
) -> Vec<T> {
    let mut values = vec![T::default(); built.mesh.n_faces()];
    for (i, run) in file.runs.iter().enumerate() {
        let end = file
            .runs
            .get(i + 1)
            .map_or(file.faces.len(), |next| next.first_face);
        let value = of_run(run);
        for f in &built.face_of_polygon[run.first_face..end] {
            if let Some(f) = f.some() {
                values[f.index()] = value;
            }
        }
    }
    values
}

fn set_materials(built: &mut Built, file: &ObjFile, materials: &[scene::Material]) {
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
    let values = on_faces(built, file, |run| run.material.map_or(-1, |m| places[m]));
    built.mesh.set(mesh::MATERIAL, values);
}

fn set_tags(built: &mut Built, file: &ObjFile, notes: &mut Notes) {
    let n_faces = built.mesh.n_faces();
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
    let mut columns: Vec<Vec<bool>> = vec![vec![false; n_faces]; objects + groups - left_out];
    // Objects come first: they matter more where not all fit.
    for (i, run) in file.runs.iter().enumerate() {
        let end = file
            .runs
            .get(i + 1)
            .map_or(file.faces.len(), |next| next.first_face);
        let of_groups = file.group_sets[run.groups]
            .iter()
            .map(|&g| objects + g as usize);
        for column in run.object.into_iter().chain(of_groups) {
            let Some(marks) = columns.get_mut(column) else {
                continue;
            };
            for f in built.face_of_polygon[run.first_face..end]
                .iter()
                .filter_map(|f| f.some())
            {
                marks[f.index()] = true;
            }
        }
    }
    let object_tags = file
        .object_names
        .iter()
        .map(|name| format!("{OBJECT_TAG}{name}"));
    let names = object_tags.chain(file.group_names.iter().cloned());
    let mut without_faces = 0;
    for (name, marks) in names.zip(columns) {
        if !marks.contains(&true) {
            without_faces += 1;
        } else if let Some(Column {
            values: Values::Tag(known),
            ..
        }) = built.mesh.attributes().column(Domain::Face, &name)
        {
            // A group named as the tag of an object.
            let both = known.iter().zip(&marks).map(|(a, b)| a | b).collect();
            insert_tag(&mut built.mesh, name, both);
        } else if built
            .mesh
            .attributes()
            .column(Domain::Face, &name)
            .is_some()
        {
            notes.changed(
                1,
                None,
                format!("group `{name}` is now called `{name} group`: the name is taken"),
            );
            insert_tag(&mut built.mesh, format!("{name} group"), marks);
        } else {
            insert_tag(&mut built.mesh, name, marks);
        }
    }
    notes.left_out(
        without_faces,
        None,
        "groups and objects left out: they have no faces",
    );
}

fn insert_tag(mesh: &mut Mesh, name: String, marks: Vec<bool>) {
    let column = Column {
        name,
        rule: Rule::Copy,
        values: Values::Tag(marks),
    };
    mesh.insert_column(Domain::Face, column);
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
            LeftOut::Depths => "third texture coordinates other than 0 left out".to_owned(),
        };
        notes.left_out(count, line, text);
    }
}
