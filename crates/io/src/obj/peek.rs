//! Counts the statements of an OBJ file without storing them.

use mesh::Domain;
use scene::{Material, Texture};

use super::file::{LeftOut, NO_MATERIAL, ObjFile};
use super::material::read_libraries;
use super::parse::{PART, cut};
use super::part::Names;
use super::read::{POLYLINES, note_left_out};
use super::statement::is_other_statement;
use crate::assets::Assets;
use crate::fault::Fault;
use crate::images::note_missing;
use crate::note::Notes;
use crate::peek::{MAX_COMPARED, PeekGeometry, PeekMesh, PeekObject, are_different};
use crate::polygons::OBJECT_TAG;
use crate::text::{Cursor, TextPosition, name};
use mesh::parallel;

/// Returns the element counts and the materials of an OBJ file. Adds notes on statements, images and material libraries
/// that are left out. Numbers and indices are not checked, so some invalid files cause no error.
///
/// # Errors
///
/// Returns an error if the path of a library is not inside the folder of the file.
pub(crate) fn peek(
    bytes: &[u8],
    name: &str,
    assets: &mut Assets,
    notes: &mut Notes,
) -> Result<PeekObject, Fault> {
    let all = Counts::of_file(bytes, PART);
    let file = ObjFile {
        libraries: all.libraries,
        material_names: all.materials.list,
        left_out: all.left_out.into_iter().collect(),
        ..ObjFile::default()
    };
    note_left_out(&file, notes);
    if all.mesh.faces == 0 && all.lines > 0 {
        let (lines, points) = (all.lines, all.points);
        let geometry = PeekGeometry::Polylines { lines, points };
        return Ok(PeekObject::new(name.to_owned(), geometry));
    }
    let n_lines = usize::try_from(all.lines).unwrap_or(usize::MAX);
    notes.left_out("polylines", n_lines, None, POLYLINES);
    let materials = read_libraries(assets, &file, notes)?;
    let textures = materials.iter().flat_map(Material::textures);
    note_missing(textures.filter_map(Texture::path), assets, notes);
    let tag = |name: &String| format!("{OBJECT_TAG}{name}");
    let objects = all.objects.list.iter().map(tag);
    let groups = all.groups.list.iter().map(|name| match name.as_str() {
        // The reader can rename these groups, because `material` and `smoothing` are names of other attributes.
        "material" | "smoothing" => format!("{name} group"),
        _ => name.clone(),
    });
    let tags = objects.chain(all.groups.list.iter().cloned()).chain(groups);
    let smoothing = all.smoothing.then(|| mesh::SMOOTHING.name.to_owned());
    let attributes = tags.chain(smoothing).map(|name| (Domain::Face, name));
    let object = PeekObject::new(name.to_owned(), PeekGeometry::Mesh(all.mesh));
    Ok(object
        .with_materials(&materials)
        .with_attributes(attributes.collect()))
}

/// The element counts of a part of the text.
#[derive(Debug, Default, PartialEq)]
struct Counts {
    mesh: PeekMesh,
    lines: u64,
    points: u64,
    /// Whether there are faces before the first `usemtl` statement.
    faces_first: bool,
    /// Whether the last `usemtl` statement sets a material. `None` if there is no `usemtl` statement.
    material: Option<bool>,
    materials: Names,
    objects: Names,
    groups: Names,
    /// Whether there is a smoothing group other than `off` and 0.
    smoothing: bool,
    /// The text after each `mtllib`, with its position.
    libraries: Vec<(TextPosition, String)>,
    /// For each kind of content that is left out, how often it occurs, and the first line in which it occurs. The list
    /// is in the order of these lines. Unknown statements are not counted.
    left_out: Vec<(LeftOut, (usize, usize))>,
    n_lines: usize,
}

impl Counts {
    /// Counts a file in parts of about `size` bytes.
    fn of_file(bytes: &[u8], size: usize) -> Self {
        let parts = parallel::consume(cut(bytes, size), |_, part| Self::of_part(part));
        let mut all = Self::default();
        all.mesh.keeps_vertices = true;
        for part in parts {
            all.add(part);
        }
        all
    }

    fn leave_out(&mut self, line: usize, count: usize, what: LeftOut) {
        match self.left_out.iter_mut().find(|(known, _)| *known == what) {
            Some((_, (n, _))) => *n += count,
            None if count > 0 => self.left_out.push((what, (count, line))),
            None => {}
        }
    }

    fn of_part(bytes: &[u8]) -> Self {
        let mut counts = Self::default();
        counts.mesh.keeps_vertices = true;
        let mut cursor = Cursor::new(bytes);
        let mut corners: Vec<&[u8]> = Vec::new();
        while !cursor.is_at_end() {
            let mesh = &mut counts.mesh;
            let (place, keyword) = cursor.argument_or_nothing();
            match keyword {
                b"v" => {
                    mesh.vertices += 1;
                    mesh.colors = mesh.colors || arguments(&mut cursor) >= 6;
                }
                b"f" | b"fo" => {
                    let mut degree = 0;
                    corners.clear();
                    while let Some((_, corner)) = cursor.argument() {
                        let mut fields = corner.split(|&byte| byte == b'/');
                        corners.extend(fields.next().filter(|_| degree <= MAX_COMPARED as u64));
                        mesh.uvs |= fields.next().is_some_and(|field| !field.is_empty());
                        mesh.normals |= fields.next().is_some_and(|field| !field.is_empty());
                        degree += 1;
                    }
                    if degree >= 3 {
                        mesh.add_faces(1, degree);
                        mesh.add_simple(u64::from(are_different(&corners)), degree);
                        mesh.materials |= counts.material == Some(true);
                        counts.faces_first |= counts.material.is_none();
                    } else {
                        counts.leave_out(place.line, 1, LeftOut::SmallFaces);
                    }
                }
                b"l" => {
                    counts.lines += 1;
                    counts.points += arguments(&mut cursor);
                }
                b"usemtl" => {
                    let name = cursor.rest_of_line();
                    let is_set = !name.is_empty() && name != NO_MATERIAL;
                    counts.material = Some(is_set);
                    if is_set {
                        counts.materials.index_of_bytes(&name);
                    }
                }
                b"mtllib" => {
                    let words = name(&cursor.rest_of_line());
                    counts.libraries.push((place, words));
                }
                b"p" => {
                    let n = arguments(&mut cursor);
                    let n = usize::try_from(n).unwrap_or(usize::MAX);
                    counts.leave_out(place.line, n, LeftOut::Points);
                }
                // `#MRGB` comments contain vertex colors.
                b"" => mesh.colors = mesh.colors || cursor.rest_of_line().starts_with(b"#MRGB"),
                b"o" => {
                    let name = cursor.rest_of_line();
                    if !name.is_empty() {
                        counts.objects.index_of_bytes(&name);
                    }
                }
                b"g" => {
                    while let Some((_, name)) = cursor.argument() {
                        counts.groups.index_of_bytes(name);
                    }
                }
                b"s" => {
                    let group = cursor.argument().map(|(_, word)| word);
                    counts.smoothing |= !matches!(group, None | Some(b"off" | b"0"));
                }
                b"vt" | b"vn" => {}
                other => {
                    let word = name(&other[..other.len().min(40)]);
                    if is_other_statement(&word) {
                        counts.leave_out(place.line, 1, LeftOut::Statement(word));
                    }
                }
            }
            cursor.skip_line();
        }
        counts.n_lines = cursor.place().line - 1;
        counts
    }

    /// Adds the counts of the next part of the text to the counts of the parts before it.
    fn add(&mut self, next: Self) {
        let (mesh, other) = (&mut self.mesh, &next.mesh);
        mesh.colors |= other.colors;
        mesh.vertices += other.vertices;
        mesh.add(other);
        mesh.uvs |= other.uvs;
        mesh.normals |= other.normals;
        mesh.materials |= other.materials || next.faces_first && self.material == Some(true);
        self.faces_first |= next.faces_first && self.material.is_none();
        self.material = next.material.or(self.material);
        self.lines += next.lines;
        self.points += next.points;
        self.smoothing |= next.smoothing;
        for (names, next) in [
            (&mut self.materials, next.materials),
            (&mut self.objects, next.objects),
            (&mut self.groups, next.groups),
        ] {
            for name in next.list {
                names.index_of(name);
            }
        }
        for (place, words) in next.libraries {
            let line = place.line + self.n_lines;
            self.libraries.push((TextPosition { line, ..place }, words));
        }
        for (what, (count, line)) in next.left_out {
            self.leave_out(line + self.n_lines, count, what);
        }
        self.n_lines += next.n_lines;
    }
}

fn arguments(cursor: &mut Cursor) -> u64 {
    let mut n = 0;
    while cursor.argument().is_some() {
        n += 1;
    }
    n
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elements_are_counted() {
        let text = b"v 0 0 0 1 1 1\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nusemtl a\n\
            f 1/1 2/1 3/1 4/1 # a square\nf 1 2 \\\n3\nf 1 2\nl 1 2\n";
        let expected = PeekMesh {
            vertices: 4,
            faces: 2,
            corners: 7,
            min_degree: 3,
            max_degree: 4,
            uvs: true,
            colors: true,
            materials: true,
            simple_faces: 2,
            simple_corners: 7,
            keeps_vertices: true,
            ..PeekMesh::default()
        };
        assert_eq!(Counts::of_file(text, PART).mesh, expected);
    }

    #[test]
    fn counts_do_not_depend_on_the_parts() {
        let text = b"v 0 0 0\nv 1 0 0 1 1 1\nf 1 2 3\nusemtl a\nv 1 1 0\nf 1 2 3 4\nl 1 2\nf 1/1 2 3 \\\n4 5\n\
            usemtl\nf 1//1 2 3\nl 3 4 5\nmtllib a.mtl\nusemtl b\nlod 3\np 1 2\nlod 4\nf 1 2\np 3\nusemtl a\n";
        for text in [&text[..], &text[..60], &text[20..], &text[24..40]] {
            let whole = Counts::of_file(text, usize::MAX);
            for size in 1..text.len() {
                assert_eq!(Counts::of_file(text, size), whole, "{size}");
            }
        }
    }

    #[test]
    fn a_file_with_lines_only_is_polylines() {
        let counts = Counts::of_file(b"v 0 0 0\nv 1 0 0\nl 1 2\nl 1 2 1", PART);
        assert_eq!((counts.mesh.faces, counts.lines, counts.points), (0, 2, 5));
    }
}
