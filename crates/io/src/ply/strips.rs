//! Reads triangle strips. Some PLY files contain strips instead of faces, for example the files of the Stanford scans.

use super::columns::item_at;
use super::table::Table;

/// The vertices of the triangles (three for each), the number of strips, and the number of triangles that are left out
/// because they visit a vertex twice.
type Strips = (Vec<u32>, usize, usize);

/// Converts the triangle strips in a list property to triangles. In a list, -1 ends a strip. Every second triangle of a
/// strip is reversed, so that all triangles have the same orientation.
///
/// # Errors
///
/// Returns the row and the index of the first item that is neither a vertex index nor -1, and a message.
pub(super) fn triangles_of_strips(
    table: &Table,
    list: usize,
    n_vertices: usize,
) -> Result<Strips, (usize, usize, String)> {
    let (mut corners, mut strips, mut stitches) = (Vec::new(), 0, 0);
    for row in 0..table.rows {
        let (mut last, mut length) = ([0, 0], 0_usize);
        for item in 0..table.count(list, row) {
            let value = item_at(table, list, row, item);
            if value == -1 {
                length = 0;
                continue;
            }
            let v = u32::try_from(value).ok();
            let Some(v) = v.filter(|&v| (v as usize) < n_vertices) else {
                let message =
                    format!("expected -1 or a vertex index below {n_vertices}, found {value}");
                return Err((row, item, message));
            };
            length += 1;
            strips += usize::from(length == 1);
            let [a, b] = last;
            if length >= 3 {
                if a == b || b == v || v == a {
                    stitches += 1;
                } else if corners.len() + 3 >= u32::MAX as usize {
                    let message = format!("expected fewer than {} corners, found more", u32::MAX);
                    return Err((row, item, message));
                } else if length % 2 == 1 {
                    corners.extend([a, b, v]);
                } else {
                    corners.extend([b, a, v]);
                }
            }
            last = [b, v];
        }
    }
    Ok((corners, strips, stitches))
}
