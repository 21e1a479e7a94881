//! What the writers share.

use std::borrow::Cow;

use glam::DVec2;
use mesh::{Column, Domain, Mesh, Value, Values};

use crate::loss::Losses;
use crate::parallel;
use crate::polygons::agreed;

/// The mesh, or a compact copy if it has dead elements.
pub(crate) fn dense(mesh: &Mesh) -> Cow<'_, Mesh> {
    if mesh.is_dense() {
        return Cow::Borrowed(mesh);
    }
    let mut copy = mesh.clone();
    copy.compact();
    Cow::Owned(copy)
}

/// Appends a comment, each of its lines behind a word.
pub(crate) fn push_comment(out: &mut Vec<u8>, word: &str, comment: Option<&str>) {
    for line in comment
        .into_iter()
        .flat_map(|text| text.split(['\n', '\r']))
    {
        out.extend_from_slice(format!("{word} {line}\n").as_bytes());
    }
}

/// The number of 255ths that is nearest to a part of a color.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a cast ends at the lowest and the highest byte"
)]
pub(crate) fn to_byte(x: f64) -> u8 {
    (x * 255.0).round() as u8
}

/// Whether a part of a color is exactly a number of 255ths.
pub(crate) fn is_byte(x: f64) -> bool {
    (f64::from(to_byte(x)) / 255.0).to_bits() == x.to_bits()
}

/// Texture coordinates of vertices, if all corners of each have the same bits; zero where a vertex has no
/// corner.
pub(crate) fn uvs_of_vertices(mesh: &Mesh, uvs: &Values) -> Option<Values> {
    let bits = |h: usize| DVec2::of(uvs).map(|uvs| uvs[h].to_array().map(f64::to_bits));
    agreed(mesh, uvs, |a, b| bits(a) == bits(b))
}

/// What becomes of numbers for which texts have no word.
pub(crate) const NOT_FINITE: &str = "not finite: written as 0";

/// The values of a column with zero in place of those that are not finite, which are lost.
pub(crate) fn finite<'a>(
    domain: Domain,
    column: &'a Column,
    losses: &mut Losses,
) -> Cow<'a, Values> {
    let mut values = Cow::Borrowed(&column.values);
    if !all_finite(&values) {
        let broken = mend(values.to_mut());
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

/// Puts zero in place of values that are not finite, and counts them.
pub(crate) fn mend(values: &mut Values) -> usize {
    if all_finite(values) {
        return 0;
    }
    let n = values.len();
    let broken = parallel::count(n, |i| !is_finite(values, i));
    *values = values.gather(n, |i| is_finite(values, i).then_some(i));
    broken
}
