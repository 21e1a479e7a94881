//! The ranges of numbers that are shown as colors.

use render::{ColorMap, Coloring};

use super::Look;

/// Narrows the range of curvatures, so that most of the surface has strong colors: sharp edges have curvatures that are many
/// times as large as those of the surface beside them.
pub(super) fn narrow_range(colorings: &mut [Coloring], look: &Look) {
    /// The part of the values in the range.
    const WITHIN: f64 = 0.9;
    let is_chosen = look.color_by.as_ref().is_some_and(|by| by.range.is_some());
    let is_curvature = colorings.iter().all(|c| c.map == ColorMap::Diverging);
    if is_chosen || !is_curvature {
        return;
    }
    let values = colorings.iter().flat_map(|c| &c.values);
    let mut sizes: Vec<f64> = values.map(|x| x.abs()).filter(|x| x.is_finite()).collect();
    if sizes.is_empty() {
        return;
    }
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a part of a length"
    )]
    let at = ((sizes.len() - 1) as f64 * WITHIN) as usize;
    let (_, &mut largest, _) = sizes.select_nth_unstable_by(at, f64::total_cmp);
    if largest > 0.0 {
        for coloring in colorings {
            coloring.range = [-largest, largest];
        }
    }
}
