//! Functions that several writers share.

use std::borrow::Cow;

use glam::DVec2;
use mesh::{Column, Domain, Mesh, Value, Values};

use crate::corners::vertex_values;
use crate::loss::Losses;
use mesh::parallel;

/// Returns the mesh itself if its arrays have no gaps from removed elements. Otherwise, returns a copy without gaps.
pub(crate) fn dense(mesh: &Mesh) -> Cow<'_, Mesh> {
    if mesh.is_dense() {
        return Cow::Borrowed(mesh);
    }
    let mut copy = mesh.clone();
    copy.compact();
    Cow::Owned(copy)
}

/// Appends a comment. `word` is written at the beginning of each line of the comment.
pub(crate) fn push_comment(out: &mut Vec<u8>, word: &str, comment: Option<&str>) {
    for line in comment
        .into_iter()
        .flat_map(|text| text.split(['\n', '\r']))
    {
        out.extend_from_slice(format!("{word} {line}\n").as_bytes());
    }
}

/// Converts a color component to the nearest multiple of 1/255, as a byte.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the cast saturates at 0 and 255"
)]
pub(crate) fn to_byte(x: f64) -> u8 {
    (x * 255.0).round() as u8
}

/// Whether a color component is exactly a multiple of 1/255.
pub(crate) fn is_byte(x: f64) -> bool {
    (f64::from(to_byte(x)) / 255.0).to_bits() == x.to_bits()
}

/// Returns the texture coordinates of each vertex if all corners of each vertex have bitwise equal texture coordinates.
/// Otherwise, returns `None`. Vertices without a corner get zero.
pub(crate) fn uvs_of_vertices(mesh: &Mesh, uvs: &Values) -> Option<Values> {
    let bits = |h: usize| DVec2::of(uvs).map(|uvs| uvs[h].to_array().map(f64::to_bits));
    vertex_values(mesh, uvs, |a, b| bits(a) == bits(b))
}

/// The reason that is reported if non-finite numbers are lost.
pub(crate) const NOT_FINITE: &str = "non-finite numbers, written as 0";

/// Returns the values of a column, with non-finite values replaced by zero. Adds a loss for the replaced values.
pub(crate) fn finite<'a>(
    domain: Domain,
    column: &'a Column,
    losses: &mut Losses,
) -> Cow<'a, Values> {
    let mut values = Cow::Borrowed(&column.values);
    if !all_finite(&values) {
        let broken = zero_non_finite(values.to_mut());
        losses.add(domain, &column.name, broken, NOT_FINITE);
    }
    values
}

/// Whether all numbers are finite.
fn all_finite(values: &Values) -> bool {
    parallel::all(values.len(), |i| is_finite(values, i))
}

fn is_finite(values: &Values, i: usize) -> bool {
    match values {
        Values::Float(values) => values[i].is_finite(),
        Values::Vec2(values) => values[i].is_finite(),
        Values::Vec3(values) => values[i].is_finite(),
        Values::Vec4(values) => values[i].is_finite(),
        Values::Int(_) | Values::Tag(_) => true,
    }
}

/// Replaces non-finite values with zero, and counts them.
pub(crate) fn zero_non_finite(values: &mut Values) -> usize {
    if all_finite(values) {
        return 0;
    }
    let n = values.len();
    let broken = parallel::count(n, |i| !is_finite(values, i));
    *values = values.gather(n, |i| is_finite(values, i).then_some(i));
    broken
}
