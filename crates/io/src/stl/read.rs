//! From the facets of an STL file to polygons.

use std::collections::BTreeMap;
use std::path::Path;

use glam::DVec3;
use mesh::{Domain, Rule, zeroed};
use rayon::prelude::*;

use super::{binary, text};
use crate::error::ReadError;
use crate::note::Notes;
use crate::peek::{PeekGeometry, PeekMesh};
use crate::weld::weld;
use crate::{Found, Polygons};

/// What the tag of a solid begins with, as that of an object in OBJ.
const SOLID_TAG: &str = "o:";
/// Tags take a byte for each face. Solids beyond this many bytes, or this number, get none.
const MOST_TAG_BYTES: usize = 1 << 28;
const MOST_TAGS: usize = 4096;

/// Facets as they stand in a file.
#[derive(Debug, Default)]
pub(super) struct Facets {
    /// Three for each facet.
    pub(super) corners: Vec<DVec3>,
    pub(super) normals: Normals,
    /// How many facets have attribute bytes.
    pub(super) colored: usize,
    /// The names of solids, and the first facet of each.
    pub(super) solids: Vec<(String, usize)>,
}

/// How facet normals agree with the corners.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Normals {
    turned: usize,
    tilted: usize,
}

impl Normals {
    pub(super) fn add(&mut self, side: Side) {
        self.turned += usize::from(side == Side::Turned);
        self.tilted += usize::from(side == Side::Tilted);
    }

    pub(super) fn append(&mut self, other: Self) {
        self.turned += other.turned;
        self.tilted += other.tilted;
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    Same,
    /// More than a few degrees away from the normal of the corners.
    Tilted,
    /// Nearer to the other side.
    Turned,
}

/// Compares a facet normal with that of its corners. They agree if the sine of the angle between them is
/// at most 1/10 (6 degrees), which is more than the rounding of a sliver explains; a normal that is zero or
/// not finite, or a facet without area, says nothing.
#[inline]
pub(super) fn compare(normal: DVec3, [a, b, c]: [DVec3; 3]) -> Side {
    let area = (b - a).cross(c - a);
    let scale = area.length_squared() * normal.length_squared();
    if !(scale > 0.0 && scale.is_finite()) {
        return Side::Same;
    }
    let along = area.dot(normal);
    if along * along >= 0.99 * scale {
        return if along > 0.0 {
            Side::Same
        } else {
            Side::Turned
        };
    }
    // A sliver: its corners are rounded to 24 bits, and the area may be nothing but that.
    let size = a.abs().max(b.abs()).max(c.abs()).max_element();
    let longest = (b - a).length_squared().max((c - a).length_squared());
    let rounding = 4.0 / f64::from(1 << 24) * size;
    if area.length_squared() <= 400.0 * rounding * rounding * longest {
        return Side::Same;
    }
    if along < 0.0 {
        Side::Turned
    } else {
        Side::Tilted
    }
}

/// Reads an STL file from its bytes.
///
/// # Errors
///
/// The first place that breaks the rules of the format.
pub(crate) fn read(
    path: &Path,
    bytes: &[u8],
    name: String,
    notes: &mut Notes,
) -> Result<Found, ReadError> {
    let facets = match kind(path, bytes)? {
        Kind::Text => text::read(bytes).map_err(|error| error.in_file(path))?,
        Kind::Binary(end) => {
            let rest = bytes.len() - end;
            notes.left_out(rest, None, "bytes behind the last facet left out");
            let facets = binary::read(&bytes[binary::START..end]);
            facets.map_err(|(offset, found)| ReadError::Binary {
                path: path.to_path_buf(),
                offset,
                message: format!("expected a finite number, found {found}"),
            })?
        }
    };
    if u32::try_from(facets.corners.len()).is_ok_and(|n| n < u32::MAX) {
        return Ok(Found::polygons(name, polygons(facets, notes)));
    }
    Err(ReadError::Binary {
        path: path.to_path_buf(),
        offset: binary::HEADER,
        message: format!("expected fewer than {} facets, found more", u32::MAX / 3),
    })
}

enum Kind {
    Text,
    /// And where the facets end.
    Binary(usize),
}

/// What kind of file it is. Many binary files begin with the word `solid`, so their length decides.
fn kind(path: &Path, bytes: &[u8]) -> Result<Kind, ReadError> {
    let length = binary::length(bytes);
    let is_text = || {
        let start = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        let start = start.trim_ascii_start();
        let word = start
            .get(..5)
            .is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
        // A header may begin with the word, and be followed by bytes that no text has.
        word && !bytes[..bytes.len().min(512)].contains(&0)
    };
    if length == Some(bytes.len() as u64) {
        return Ok(Kind::Binary(bytes.len()));
    }
    if is_text() {
        return Ok(Kind::Text);
    }
    let error = |offset: usize, message: String| ReadError::Binary {
        path: path.to_path_buf(),
        offset,
        message,
    };
    let (Some(length), Some(count)) = (length, binary::count(bytes)) else {
        let message = format!(
            "expected `solid` or a header of {} bytes, found {} bytes",
            binary::START,
            bytes.len()
        );
        return Err(error(0, message));
    };
    if let Some(end) = usize::try_from(length)
        .ok()
        .filter(|&end| end <= bytes.len())
    {
        return Ok(Kind::Binary(end));
    }
    let message = format!(
        "expected {count} facets ({length} bytes in all), found {} bytes",
        bytes.len()
    );
    Err(error(binary::HEADER, message))
}

fn polygons(facets: Facets, notes: &mut Notes) -> Polygons {
    let n_corners = facets.corners.len();
    let n_faces = n_corners / 3;
    let Normals { turned, tilted } = facets.normals;
    let what = "facet normals left out that point to the other side of their corners";
    notes.changed(turned, None, what);
    let what = "facet normals left out that are not normal to their corners";
    notes.changed(tilted, None, what);
    let what = "facets have attribute bytes, perhaps colors: left out";
    notes.left_out(facets.colored, None, what);
    let (positions, corners) = weld(facets.corners);
    let what = format!(
        "corners became {} vertices by equal positions",
        positions.len()
    );
    notes.changed(n_corners, None, what);
    let mut offsets = zeroed::<u32>(n_faces + 1);
    let place = |f: usize| u32::try_from(3 * f).expect("checked by the caller");
    let all = offsets.par_iter_mut().with_min_len(4096).enumerate();
    all.for_each(|(f, offset)| *offset = place(f));
    let mut polygons = Polygons {
        positions,
        offsets,
        corners,
        ..Polygons::default()
    };
    set_tags(&mut polygons, &facets.solids, notes);
    polygons
}

/// Tags for the faces of each solid, if there are several.
fn set_tags(polygons: &mut Polygons, solids: &[(String, usize)], notes: &mut Notes) {
    if solids.len() < 2 {
        return;
    }
    let n_faces = polygons.n_faces();
    let room = MOST_TAGS.min(MOST_TAG_BYTES / n_faces.max(1));
    let mut columns: BTreeMap<&str, Vec<bool>> = BTreeMap::new();
    let (mut empty, mut too_many) = (0, 0);
    let ends = solids
        .iter()
        .skip(1)
        .map(|&(_, first)| first)
        .chain([n_faces]);
    for ((name, first), end) in solids.iter().zip(ends) {
        if *first == end {
            empty += 1;
        } else if columns.len() < room || columns.contains_key(name.as_str()) {
            let marks = columns.entry(name).or_insert_with(|| vec![false; n_faces]);
            marks[*first..end].fill(true);
        } else {
            too_many += 1;
        }
    }
    for (name, marks) in columns {
        polygons.insert(
            Domain::Face,
            format!("{SOLID_TAG}{name}"),
            Rule::Copy,
            marks,
        );
    }
    notes.left_out(empty, None, "solids left out: they have no facets");
    notes.left_out(
        too_many,
        None,
        "names of solids left out: too many for a mesh of this size",
    );
}

/// The counts of an STL file. There are no more vertices than said: corners are not compared.
///
/// # Errors
///
/// If a binary file is too short for what it says.
pub(crate) fn peek(path: &Path, bytes: &[u8]) -> Result<PeekGeometry, ReadError> {
    let n = match kind(path, bytes)? {
        Kind::Text => text::count(bytes),
        Kind::Binary(_) => binary::count(bytes).unwrap_or(0).into(),
    };
    let mut mesh = PeekMesh {
        vertices: 3 * n,
        ..PeekMesh::default()
    };
    mesh.add_faces(n, 3);
    Ok(PeekGeometry::Mesh(mesh))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_agree_within_a_few_degrees() {
        let corners = [DVec3::ZERO, DVec3::X, DVec3::Y];
        for (normal, side) in [
            (DVec3::Z, Side::Same),
            (DVec3::new(0.05, 0.0, 1.0), Side::Same),
            (DVec3::new(0.0, 0.0, 1e-9), Side::Same),
            (DVec3::ZERO, Side::Same),
            (DVec3::NAN, Side::Same),
            (DVec3::new(0.5, 0.0, 1.0), Side::Tilted),
            (DVec3::NEG_Z, Side::Turned),
            (DVec3::new(1.0, 0.0, -0.1), Side::Turned),
        ] {
            assert_eq!(compare(normal, corners), side, "{normal}");
        }
        assert_eq!(compare(DVec3::Z, [DVec3::ZERO; 3]), Side::Same);
    }

    #[test]
    fn the_rounding_of_a_sliver_does_not_tilt_it() {
        let far = DVec3::splat(100.0);
        let sliver = [far, far + 10.0 * DVec3::X, far + DVec3::new(5.0, 1e-5, 0.0)];
        assert_eq!(compare(DVec3::Y, sliver), Side::Same);
    }
}
