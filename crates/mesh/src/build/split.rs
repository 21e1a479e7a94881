//! Splits vertices whose faces form several fans.

use std::borrow::Cow;

use glam::DVec3;

use super::BuildError;
use super::buckets::Buckets;
use super::pair::PairedSides;
use super::polygons::{Polygons, to_u32};
use super::star::Star;
use crate::VertexId;

/// The result of [`split_vertices`].
pub(super) struct Split<'a> {
    /// For each corner, its vertex after the split.
    pub(super) origins: Cow<'a, [u32]>,
    /// Each pair consists of a vertex that was split and one of its copies.
    pub(super) copies: Vec<(VertexId, VertexId)>,
}

/// Splits the vertices whose faces form several fans. The first fan keeps the vertex, and each other fan gets a copy of
/// it. The copies are appended after all other vertices.
///
/// # Errors
///
/// Returns an error if the number of vertices, including the copies, would exceed the number of ids.
pub(super) fn split_vertices<'a>(
    positions: &mut Vec<DVec3>,
    polygons: &Polygons<'a>,
    buckets: &Buckets,
    paired: &mut PairedSides,
) -> Result<Split<'a>, BuildError> {
    let mut origins = Cow::Borrowed(polygons.corners);
    let mut copies = Vec::new();
    let mut star = Star::default();
    for &v in &paired.pinched {
        let corners = buckets.of(v as usize);
        star.set(polygons, corners);
        let mut fans = star.fans(corners).into_iter();
        if let Some(first) = fans.next() {
            paired.outgoing[v as usize] = first.outgoing;
        }
        for fan in fans {
            let copy = to_u32(positions.len(), "vertices")?;
            positions.push(positions[v as usize]);
            paired.outgoing.push(fan.outgoing);
            for c in fan.corners {
                origins.to_mut()[c as usize] = copy;
            }
            copies.push([v, copy].map(|v| VertexId::new(v as usize)).into());
        }
    }
    Ok(Split { origins, copies })
}
