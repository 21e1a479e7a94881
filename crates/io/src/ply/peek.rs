//! Counts the elements of a PLY file from its header and the counts of its lists.

use super::body::Body;
use super::header::{Element, parse};
use super::roles::{self, Roles};
use super::strips::triangles_of_strips;
use crate::fault::Fault;
use crate::note::Notes;
use crate::peek::PeekMesh;

/// Returns the counts of a PLY file, and adds notes on the elements that are left out. Positions and the vertices of
/// faces are not checked.
///
/// # Errors
///
/// If the header violates the format, or if the file is shorter than the header declares.
pub(crate) fn peek(bytes: &[u8], notes: &mut Notes) -> Result<PeekMesh, Fault> {
    let header = parse(bytes)?;
    let roles = Roles::of(&header)?;
    let lists = roles.face.or(roles.strips);
    let wanted = |element: &Element| {
        lists.is_some_and(|(place, _)| header.elements[place].name == element.name)
    };
    let body = Body::new(bytes, &header, wanted, notes)?;
    let tables = body.tables(notes)?;
    roles.note_unused(&header, notes);
    let vertices = &header.elements[roles.vertex];
    let mut mesh = PeekMesh {
        vertices: vertices.rows as u64,
        normals: roles::normal(vertices).is_some(),
        colors: roles::color(vertices).is_some(),
        ..PeekMesh::default()
    };
    if let Some((place, list)) = roles.face {
        let table = &tables[place];
        match table.even_count(list) {
            Some(n) if n < 3 => {}
            Some(n) => mesh.add_faces(table.rows as u64, n as u64),
            None => {
                for row in 0..table.rows {
                    let n = table.count(list, row);
                    mesh.add_faces(u64::from(n >= 3), n as u64);
                }
            }
        }
        let uvs = roles::uv(vertices).is_some();
        mesh.uvs = mesh.faces > 0 && (uvs || header.elements[place].list("texcoord").is_some());
        mesh.materials = header.elements[place].scalar("material").is_some();
    } else if let Some((place, list)) = roles.strips {
        let strips = triangles_of_strips(&tables[place], list, vertices.rows);
        let (corners, ..) = strips.map_err(|(row, item, message)| {
            body.error(&tables, (place, list, row, item), message)
        })?;
        mesh.add_faces(corners.len() as u64 / 3, 3);
        mesh.uvs = mesh.faces > 0 && roles::uv(vertices).is_some();
    }
    Ok(mesh)
}
