//! Counting the statements of an OBJ file without keeping them.

use super::file::NO_MATERIAL;
use super::parse::{PART, cut};
use crate::parallel;
use crate::peek::{PeekGeometry, PeekMesh};
use crate::text::Cursor;

/// Returns the counts of an OBJ file. Numbers and indices are not checked, so a broken file has counts too.
pub(crate) fn peek(bytes: &[u8]) -> PeekGeometry {
    peek_in_parts(bytes, PART)
}

fn peek_in_parts(bytes: &[u8], size: usize) -> PeekGeometry {
    let parts = parallel::consume(cut(bytes, size), |_, part| Counts::of_part(part));
    let mut all = Counts::default();
    for part in parts {
        all.add(&part);
    }
    if all.mesh.faces == 0 && all.lines > 0 {
        return PeekGeometry::Polylines {
            lines: all.lines,
            points: all.points,
        };
    }
    PeekGeometry::Mesh(all.mesh)
}

/// The counts of a part of the text.
#[derive(Default)]
struct Counts {
    mesh: PeekMesh,
    lines: u64,
    points: u64,
    /// Whether there are faces before the first `usemtl`.
    faces_first: bool,
    /// Whether the last `usemtl` sets a material; `None` without `usemtl`.
    material: Option<bool>,
}

impl Counts {
    fn of_part(bytes: &[u8]) -> Self {
        let mut counts = Self::default();
        let mesh = &mut counts.mesh;
        let mut cursor = Cursor::new(bytes);
        while !cursor.is_at_end() {
            match cursor.argument().map_or(&b""[..], |(_, word)| word) {
                b"v" => {
                    mesh.vertices += 1;
                    // Usually all vertices have colors or none does, so only the first is checked.
                    mesh.colors |= mesh.vertices == 1 && arguments(&mut cursor) >= 6;
                }
                b"f" | b"fo" => {
                    let mut degree = 0;
                    while let Some((_, corner)) = cursor.argument() {
                        if degree == 0 {
                            let mut fields = corner.split(|&byte| byte == b'/').skip(1);
                            mesh.uvs |= fields.next().is_some_and(|field| !field.is_empty());
                            mesh.normals |= fields.next().is_some_and(|field| !field.is_empty());
                        }
                        degree += 1;
                    }
                    if degree >= 3 {
                        mesh.add_faces(1, degree);
                        mesh.materials |= counts.material == Some(true);
                        counts.faces_first |= counts.material.is_none();
                    }
                }
                b"l" => {
                    counts.lines += 1;
                    counts.points += arguments(&mut cursor);
                }
                b"usemtl" => {
                    let name = cursor.rest_of_line();
                    counts.material = Some(!name.is_empty() && name != NO_MATERIAL);
                }
                _ => {}
            }
            cursor.skip_line();
        }
        counts
    }

    /// Adds the counts of the next part.
    fn add(&mut self, next: &Self) {
        let (mesh, other) = (&mut self.mesh, &next.mesh);
        mesh.colors |= mesh.vertices == 0 && other.colors;
        mesh.vertices += other.vertices;
        mesh.add(other);
        mesh.uvs |= other.uvs;
        mesh.normals |= other.normals;
        mesh.materials |= other.materials || next.faces_first && self.material == Some(true);
        self.faces_first |= next.faces_first && self.material.is_none();
        self.material = next.material.or(self.material);
        self.lines += next.lines;
        self.points += next.points;
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
            normals: false,
            colors: true,
            materials: true,
        };
        assert_eq!(peek(text), PeekGeometry::Mesh(expected));
    }

    #[test]
    fn counts_do_not_depend_on_the_parts() {
        let text = b"v 0 0 0\nv 1 0 0 1 1 1\nf 1 2 3\nusemtl a\nv 1 1 0\nf 1 2 3 4\nl 1 2\nf 1/1 2 3 \\\n4 5\n\
            usemtl\nf 1//1 2 3\nl 3 4 5\n";
        for text in [&text[..], &text[..60], &text[20..], &text[24..40]] {
            let whole = peek_in_parts(text, usize::MAX);
            for size in 1..text.len() {
                assert_eq!(peek_in_parts(text, size), whole, "{size}");
            }
        }
    }

    #[test]
    fn a_file_with_lines_only_is_polylines() {
        let expected = PeekGeometry::Polylines {
            lines: 2,
            points: 5,
        };
        assert_eq!(peek(b"v 0 0 0\nv 1 0 0\nl 1 2\nl 1 2 1"), expected);
    }
}
