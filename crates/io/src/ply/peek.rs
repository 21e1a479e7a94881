//! Counts the vertices, faces and corners of a PLY file from its header and the lengths of its lists.

use mesh::{COLOR, Domain, VERTEX_NORMAL};

use super::body::Body;
use super::header::{Element, Header, Property, parse};
use super::read::{attribute_comments, note_list};
use super::roles::{self, Roles};
use super::strips::triangles_of_strips;
use crate::fault::Fault;
use crate::note::Notes;
use crate::peek::{MAX_COMPARED, PeekMesh, differ};

/// Returns how many vertices, faces and corners a PLY file has, and adds notes on the elements that are left out.
/// Positions and the vertex indices of faces are not checked.
///
/// # Errors
///
/// Returns an error if the header violates the format, if the file is shorter than the header declares, or if a
/// triangle strip refers to a vertex that does not exist.
pub(crate) fn peek(bytes: &[u8], notes: &mut Notes) -> Result<(PeekMesh, Names), Fault> {
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
    let face = roles
        .face
        .map(|(place, list)| (&header.elements[place], list));
    for element in [Some((vertices, usize::MAX)), face].into_iter().flatten() {
        note_lists(element, &header, notes);
    }
    let mut mesh = PeekMesh {
        keeps_vertices: true,
        vertices: vertices.rows as u64,
        normals: roles::normal(vertices).is_some(),
        colors: roles::color(vertices).is_some(),
        ..PeekMesh::default()
    };
    if let Some((place, list)) = roles.face {
        let table = &tables[place];
        let size = table.properties[list].value.size();
        let degree = |row: usize| table.count(list, row);
        let is_simple = |row: &usize| {
            let n = degree(*row);
            let bytes = table.bytes.get(table.at(list, *row)..).unwrap_or_default();
            let items: Vec<&[u8]> = bytes
                .chunks_exact(size)
                .take(n.min(MAX_COMPARED + 1))
                .collect();
            n >= 3 && differ(&items)
        };
        for row in (0..table.rows).filter(is_simple) {
            mesh.add_simple(1, degree(row) as u64);
        }
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
    let mut names = names_of(Domain::Vertex, vertices, usize::MAX, &header);
    if let Some((element, list)) = face {
        names.extend(names_of(Domain::Face, element, list, &header));
    }
    Ok((mesh, names))
}

/// The domains and names of attributes.
type Names = Vec<(Domain, String)>;

/// Returns the mesh attributes that result from the properties of an element, except those that [`PeekMesh`] describes.
/// `used` is the index of the property that lists the vertices of faces.
fn names_of(domain: Domain, element: &Element, used: usize, header: &Header) -> Names {
    let mut names = Vec::new();
    let mut is_used = vec![false; element.properties.len()];
    let mut mark = |places: &[usize]| {
        for &place in places {
            if let Some(is_used) = is_used.get_mut(place) {
                *is_used = true;
            }
        }
    };
    mark(&[used]);
    for comment in attribute_comments(header) {
        let is_list = comment.domain == Domain::Corner;
        let is_here = comment.domain == domain || is_list && domain == Domain::Face;
        if let Some(first) = element.find(&comment.property, is_list).filter(|_| is_here) {
            let n = if is_list { 1 } else { comment.kind.size() };
            mark(&(first..first + n).collect::<Vec<_>>());
            names.push((comment.domain, comment.name));
        }
    }
    if let Some(normal) = roles::normal(element) {
        mark(&normal);
        names.extend((domain == Domain::Face).then(|| (domain, VERTEX_NORMAL.name.to_owned())));
    }
    if let Some((rgb, alpha)) = roles::color(element) {
        mark(&rgb);
        mark(alpha.as_slice());
        names.extend((domain == Domain::Face).then(|| (domain, COLOR.name.to_owned())));
    }
    if domain == Domain::Vertex {
        mark(&["x", "y", "z"].map(|name| element.scalar(name).unwrap_or(usize::MAX)));
        mark(roles::uv(element).as_ref().map_or(&[], |uv| uv.as_slice()));
    }
    let rest = element.properties.iter().zip(&is_used);
    let rest = rest.filter(|(property, is_used)| !**is_used && property.count.is_none());
    names.extend(rest.map(|(property, _)| (domain, property.name.clone())));
    names
}

/// Adds notes on the list properties of an element that the reader does not read. `used` is the index of the property
/// that lists the vertices of faces.
fn note_lists((element, used): (&Element, usize), header: &Header, notes: &mut Notes) {
    let described = attribute_comments(header);
    let is_used = |place: usize, property: &Property| {
        place == used
            || property.name == "texcoord" && element.name == "face"
            || described
                .iter()
                .any(|comment| comment.property == property.name)
    };
    for (place, property) in element.properties.iter().enumerate() {
        if property.count.is_some() && !is_used(place, property) {
            note_list(property, element, element.rows, notes);
        }
    }
}
