//! Builds polygons from the indices in an element such as `<polylist>`. The element lists triangles, polygons with any
//! number of corners, strips of triangles, or fans of triangles.

use super::document::{
    Document, Node, child, elements, error_at, is, named, natural, push_indices, required,
};
use crate::fault::Fault;

/// How the indices of a list form polygons.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Shape {
    Triangles,
    Counted,
    Single,
    Strips,
    Fans,
}

/// The kind of polygons in a list; `None` if the list has no polygons.
pub(super) fn shape(list: Node, document: &Document) -> Result<Option<Shape>, Fault> {
    let shape = match list.tag_name().name() {
        "triangles" => Shape::Triangles,
        "polylist" => Shape::Counted,
        "polygons" => Shape::Single,
        "tristrips" => Shape::Strips,
        "trifans" => Shape::Fans,
        _ => return Ok(None),
    };
    let empty = elements(list).all(|part| !is(part, "p") && !is(part, "ph"));
    if empty && natural(list, "count")?.is_some_and(|count| count > 0) {
        return Err(error_at(list, "expected indices in <p>, found none"));
    }
    if empty {
        document.left_out(
            1,
            list,
            ("primitives-empty", "empty lists of polygons left out"),
        );
        return Ok(None);
    }
    Ok(Some(shape))
}

/// The polygons of one list. Each corner refers to a group of indices.
#[derive(Default)]
pub(super) struct Outline<'a> {
    /// The elements that contain the indices.
    pub(super) lists: Vec<Node<'a>>,
    pub(super) indices: Vec<u32>,
    /// For each corner of the polygons, the number of its group of indices. Group k consists of the `stride` entries of
    /// `indices` that begin at `k * stride`.
    pub(super) order: Vec<usize>,
    pub(super) degrees: Vec<usize>,
}

impl Shape {
    /// Reads the indices of a list with `stride` indices for each corner.
    pub(super) fn read<'a>(
        self,
        list: Node<'a>,
        stride: usize,
        document: &Document,
    ) -> Result<Outline<'a>, Fault> {
        let mut outline = Outline::default();
        let mut holes = 0;
        // For each element that contains indices, the number of corners in the elements before it, followed by the
        // total number of corners.
        let mut starts = vec![0];
        for part in elements(list) {
            let indices = if is(part, "p") {
                part
            } else if is(part, "ph") {
                holes += named(part, "h").count();
                child(part, "p").ok_or_else(|| error_at(part, "expected <p>"))?
            } else {
                continue;
            };
            push_indices(indices, &mut outline.indices)?;
            outline.lists.push(indices);
            if !outline.indices.len().is_multiple_of(stride) {
                let n = outline.indices.len();
                let message = format!(
                    "expected {stride} indices for each corner, but the total number of indices, {n}, is not a multiple of {stride}"
                );
                return Err(error_at(indices, message));
            }
            starts.push(outline.indices.len() / stride);
        }
        document.left_out(holes, list, ("holes", "holes of polygons left out"));
        let n = outline.indices.len() / stride;
        let lists = starts.windows(2).map(|ends| ends[0]..ends[1]);
        let count = natural(list, "count")?;
        let mut small = 0;
        let found = match self {
            Self::Triangles => {
                outline.order = (0..n).collect();
                outline.degrees = vec![3; n / 3];
                if !n.is_multiple_of(3) {
                    let message = format!(
                        "expected 3 corners for each triangle, but the total number of corners, {n}, is not a multiple of 3"
                    );
                    return Err(error_at(list, message));
                }
                n / 3
            }
            Self::Counted => {
                let counts = child(list, "vcount")
                    .ok_or_else(|| error_at(list, "expected the numbers of corners in <vcount>"))?;
                let mut degrees = Vec::new();
                push_indices(counts, &mut degrees)?;
                let corners = degrees.iter().map(|&d| u64::from(d)).sum::<u64>();
                if corners != n as u64 {
                    let message = format!(
                        "expected indices of {corners} corners (the sum of the numbers in <vcount>), found indices of {n} corners"
                    );
                    return Err(error_at(counts, message));
                }
                let mut start = 0;
                for &degree in &degrees {
                    small += outline.push(start..start + degree as usize);
                    start += degree as usize;
                }
                degrees.len()
            }
            Self::Single => {
                lists.for_each(|list| small += outline.push(list));
                outline.lists.len()
            }
            Self::Strips | Self::Fans => {
                for list in lists {
                    small += usize::from(list.len() < 3);
                    for k in (list.start + 2)..list.end {
                        let (a, b) = match self {
                            Self::Fans => (list.start, k - 1),
                            _ if (k - list.start) % 2 == 0 => (k - 2, k - 1),
                            _ => (k - 1, k - 2),
                        };
                        outline.order.extend([a, b, k]);
                        outline.degrees.push(3);
                    }
                }
                outline.lists.len()
            }
        };
        let what = (
            "faces-too-small",
            "polygons with fewer than 3 corners left out",
        );
        document.left_out(small, list, what);
        if count.is_some_and(|count| count != found) {
            let count = required(list, "count")?;
            let message = format!(
                "expected {count} polygons according to the attribute `count`, found {found}"
            );
            return Err(error_at(list, message));
        }
        Ok(outline)
    }
}

impl Outline<'_> {
    /// Adds a polygon. Returns 1 if the polygon is left out because it has fewer than 3 corners, otherwise 0.
    fn push(&mut self, corners: std::ops::Range<usize>) -> usize {
        if corners.len() < 3 {
            return 1;
        }
        self.degrees.push(corners.len());
        self.order.extend(corners);
        0
    }
}
