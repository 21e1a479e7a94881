//! Splitting vertices between several fans.

use std::borrow::Cow;

use glam::DVec3;

use super::BuildError;
use super::buckets::Buckets;
use super::pair::Paired;
use super::polygons::{Polygons, to_u32};
use super::star::Star;
use crate::VertexId;

/// The vertices after splitting.
pub(super) struct Split<'a> {
    /// For each corner its vertex.
    pub(super) origins: Cow<'a, [u32]>,
    /// Each vertex that was split with its copy.
    pub(super) copies: Vec<(VertexId, VertexId)>,
}

/// Gives each fan of a pinched vertex but the first a copy of the vertex, behind all others.
///
/// # Errors
///
/// If there are too many vertices then.
pub(super) fn split_vertices<'a>(
    positions: &mut Vec<DVec3>,
    polygons: &Polygons<'a>,
    buckets: &Buckets,
    paired: &mut Paired,
) -> Result<Split<'a>, BuildError> {
    let mut origins = Cow::Borrowed(polygons.corners);
    let mut copies = Vec::new();
    let mut star = Star::default();
    for &v in &paired.pinched {
        let corners = buckets.of(v as usize);
        star.look(polygons, corners);
        let mut fans = star.fans(corners).into_iter();
        if let Some(first) = fans.next() {
            paired.leaving[v as usize] = first.leaving;
        }
        for fan in fans {
            let copy = to_u32(positions.len(), "vertices")?;
            positions.push(positions[v as usize]);
            paired.leaving.push(fan.leaving);
            for c in fan.corners {
                origins.to_mut()[c as usize] = copy;
            }
            copies.push([v, copy].map(|v| VertexId::new(v as usize)).into());
        }
    }
    Ok(Split { origins, copies })
}
