//! Converts the facets of an STL file to polygons.

use std::collections::BTreeMap;
use std::ops::Range;

use mesh::{Domain, Rule};

use super::facets::Facets;
use super::{binary, text};
use crate::Polygons;
use crate::fault::Fault;
use crate::note::Notes;
use crate::peek::PeekMesh;
use crate::polygons::{OBJECT_TAG, most_tags};
use crate::text::BYTE_ORDER_MARK;
use crate::weld::{Position, weld};

/// For binary files: the texts of the notes about content that is left out.
const REST: &str = "bytes left out after the last facet";
const COLORED: &str = "facets with attribute bytes (possibly colors): these bytes are left out";

/// Reads an STL file from its bytes.
///
/// # Errors
///
/// Returns an error for the first position that violates the format.
pub(crate) fn read(bytes: &[u8], notes: &mut Notes) -> Result<Polygons, Fault> {
    match kind(bytes)? {
        Kind::Text => polygons(text::read(bytes)?, notes),
        Kind::Binary(end) => {
            let rest = bytes.len() - end;
            notes.left_out("extra-content", rest, None, REST);
            polygons(binary::read(&bytes[binary::START..end])?, notes)
        }
    }
}

enum Kind {
    Text,
    /// A binary file. The field is the position at which the facets end, in bytes.
    Binary(usize),
}

/// Determines whether a file is text or binary. The size of the file is checked first, because many binary files also
/// begin with the word `solid`.
fn kind(bytes: &[u8]) -> Result<Kind, Fault> {
    let n_bytes = bytes.len();
    let length = binary::length(bytes);
    if length == Some(n_bytes as u64) {
        return Ok(Kind::Binary(n_bytes));
    }
    let start = bytes
        .strip_prefix(BYTE_ORDER_MARK)
        .unwrap_or(bytes)
        .trim_ascii_start();
    let word = start.get(..5).unwrap_or_default();
    // Both text files and binary files can begin with `solid`. A binary file usually has zero bytes near its beginning,
    // and a text file has none.
    if word.eq_ignore_ascii_case(b"solid") && !bytes[..n_bytes.min(512)].contains(&0) {
        return Ok(Kind::Text);
    }
    let (Some(length), Some(count)) = (length, binary::count(bytes)) else {
        let least = binary::START;
        let message = format!(
            "expected text that begins with `solid`, or a binary file of at least {least} bytes, found a file of {n_bytes} bytes"
        );
        return Err(Fault::byte(0, message));
    };
    match usize::try_from(length) {
        Ok(end) if end <= n_bytes => Ok(Kind::Binary(end)),
        _ => {
            let message = format!(
                "the file declares {count} facets, which need {length} bytes in total, but the file has only {n_bytes} bytes"
            );
            Err(Fault::byte(binary::HEADER, message))
        }
    }
}

fn polygons<P: Position>(facets: Facets<P>, notes: &mut Notes) -> Result<Polygons, Fault> {
    let n_corners = facets.corners.len();
    if n_corners >= u32::MAX as usize {
        let message = format!("expected fewer than {} facets, found more", u32::MAX / 3);
        return Err(Fault::byte(binary::HEADER, message));
    }
    let [_, tilted, turned] = facets.sides;
    let what = "facet normals recomputed from the corners because they point away from the front of the facet";
    notes.changed("normals-turned", turned, None, what);
    let what =
        "facet normals recomputed from the corners because they are not perpendicular to the facet";
    notes.changed("normals-tilted", tilted, None, what);
    notes.left_out("facet-attributes", facets.colored, None, COLORED);
    let (positions, corners) = weld(&facets.corners);
    drop(facets.corners);
    let n = positions.len();
    let what = format!("corners merged into {n} vertices with distinct positions");
    notes.changed("corners-merged", n_corners, None, what);
    let mut polygons = Polygons {
        positions,
        offsets: Polygons::even_offsets(n_corners / 3, 3),
        corners,
        ..Polygons::default()
    };
    set_tags(&mut polygons, &facets.solids, notes);
    Ok(polygons)
}

/// If there are several solids, adds a tag for each distinct name. The tag marks the faces of all solids with this
/// name.
fn set_tags(polygons: &mut Polygons, solids: &[(String, Range<usize>)], notes: &mut Notes) {
    if solids.len() < 2 {
        return;
    }
    let n_faces = polygons.n_faces();
    let room = most_tags(n_faces);
    let mut columns: BTreeMap<&str, Vec<bool>> = BTreeMap::new();
    let (mut empty, mut too_many) = (0, 0);
    for (name, facets) in solids {
        if facets.is_empty() {
            empty += 1;
        } else if columns.len() < room || columns.contains_key(name.as_str()) {
            let marks = columns.entry(name).or_insert_with(|| vec![false; n_faces]);
            marks[facets.clone()].fill(true);
        } else {
            too_many += 1;
        }
    }
    for (name, marks) in columns {
        let name = format!("{OBJECT_TAG}{name}");
        polygons.insert(Domain::Face, name, Rule::Copy, marks);
    }
    notes.left_out(
        "solids-empty",
        empty,
        None,
        "solids without facets left out",
    );
    let what = format!(
        "names of solids left out: a mesh with {n_faces} faces can store at most {room} of these names as face tags"
    );
    notes.left_out("too-many-names", too_many, None, what);
}

/// The names of attributes with their domains.
type AttributeNames = Vec<(Domain, String)>;

/// Returns how many vertices and triangles an STL file has. If the file is binary, adds notes on bytes that are left
/// out. The number of vertices is an upper bound, because corners are not compared.
///
/// # Errors
///
/// Returns an error if a binary file is too short for the number of triangles that it declares.
pub(crate) fn peek(
    bytes: &[u8],
    notes: &mut Notes,
) -> Result<(PeekMesh, Option<AttributeNames>), Fault> {
    let mut mesh = PeekMesh::default();
    // If a text file has several solids, the faces of each solid get a tag. The names of these tags are not determined
    // here, so the list of attributes is then unknown.
    let mut names = Some(Vec::new());
    let n = match kind(bytes)? {
        Kind::Text => {
            names = names.filter(|_| text::n_solids(bytes) <= 1);
            text::count(bytes)
        }
        Kind::Binary(end) => {
            mesh.add_simple(binary::n_simple(&bytes[binary::START..end]) as u64, 3);
            notes.left_out("extra-content", bytes.len() - end, None, REST);
            let colored = binary::n_colored(&bytes[binary::START..end]);
            notes.left_out("facet-attributes", colored, None, COLORED);
            binary::count(bytes).unwrap_or(0).into()
        }
    };
    mesh.vertices = 3 * n;
    mesh.add_faces(n, 3);
    Ok((mesh, names))
}
