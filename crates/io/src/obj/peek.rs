//! Counting the statements of an OBJ file without keeping them.

use super::file::NO_MATERIAL;
use crate::peek::{PeekGeometry, PeekMesh};
use crate::text::Cursor;

/// The counts of an OBJ file. Numbers and indices are not looked at, so a broken file has counts too.
pub(crate) fn peek(bytes: &[u8]) -> PeekGeometry {
    let mut mesh = PeekMesh::default();
    let (mut lines, mut points) = (0, 0);
    let mut material = false;
    let mut cursor = Cursor::new(bytes);
    while !cursor.is_at_end() {
        match cursor.argument().map_or(&b""[..], |(_, word)| word) {
            b"v" => {
                mesh.vertices += 1;
                // Colors are on all vertices or on none, as a rule: one look is enough.
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
                    mesh.materials |= material;
                }
            }
            b"l" => {
                lines += 1;
                points += arguments(&mut cursor);
            }
            b"usemtl" => {
                let name = cursor.rest_of_line();
                material = !name.is_empty() && name != NO_MATERIAL;
            }
            _ => {}
        }
        cursor.skip_line();
    }
    if mesh.faces == 0 && lines > 0 {
        return PeekGeometry::Polylines { lines, points };
    }
    PeekGeometry::Mesh(mesh)
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
    fn statements_are_counted() {
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
    fn lines_alone_are_polylines() {
        let expected = PeekGeometry::Polylines {
            lines: 2,
            points: 5,
        };
        assert_eq!(peek(b"v 0 0 0\nv 1 0 0\nl 1 2\nl 1 2 1"), expected);
    }
}
