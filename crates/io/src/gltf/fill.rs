//! Writes arrays into the buffer in parallel.

use glam::Vec3;
use mesh::{FaceId, Mesh, VertexId};

use super::faces::{Faces, corners};
use super::split::Split;
use super::streams::Stream;
use mesh::parallel::{self, BLOCK};

/// Writes elements of N bytes each.
fn fill<const N: usize>(out: &mut [u8], value: impl Fn(usize) -> [u8; N] + Sync) {
    parallel::consume(out.chunks_mut(N * BLOCK), |block, out| {
        for (i, slot) in (block * BLOCK..).zip(out.as_chunks_mut().0) {
            *slot = value(i);
        }
    });
}

pub(super) fn fill_positions(out: &mut [u8], mesh: &Mesh, split: &Split) {
    fill(out, |i| {
        let position = mesh.position(split.vertex(mesh, i)).as_vec3();
        bytemuck::cast::<[[u8; 4]; 3], [u8; 12]>(position.to_array().map(f32::to_le_bytes))
    });
}

pub(super) fn fill_stream(out: &mut [u8], mesh: &Mesh, split: &Split, stream: &Stream) {
    let size = stream.kind.multiplicity() * size_of::<f32>();
    parallel::consume(out.chunks_mut(size * BLOCK), |block, out| {
        for (i, slot) in (block * BLOCK..).zip(out.chunks_exact_mut(size)) {
            let (v, h) = split.corner(mesh, i);
            let (value, _) = stream.at(mesh, v, h);
            for (slot, x) in slot.as_chunks_mut().0.iter_mut().zip(value) {
                *slot = x.to_le_bytes();
            }
        }
    });
}

pub(super) fn fill_indices(out: &mut [u8], mesh: &Mesh, split: &Split, faces: &Faces, short: bool) {
    let triangle = |i: usize| match &faces.corners {
        None => corners(mesh, split, FaceId::new(i)),
        Some(corners) => [corners[3 * i], corners[3 * i + 1], corners[3 * i + 2]],
    };
    if short {
        let bytes = |v: u32| u16::try_from(v).unwrap_or(u16::MAX).to_le_bytes();
        fill(out, |i| {
            bytemuck::cast::<[[u8; 2]; 3], [u8; 6]>(triangle(i).map(bytes))
        });
    } else {
        fill(out, |i| {
            bytemuck::cast::<[[u8; 4]; 3], [u8; 12]>(triangle(i).map(u32::to_le_bytes))
        });
    }
}

/// Writes vectors of N floats.
pub(super) fn fill_floats<const N: usize>(
    out: &mut [u8],
    value: impl Fn(usize) -> [f32; N] + Sync,
) {
    let size = N * size_of::<f32>();
    parallel::consume(out.chunks_mut(size * BLOCK), |block, out| {
        for (i, slot) in (block * BLOCK..).zip(out.chunks_exact_mut(size)) {
            for (slot, x) in slot.as_chunks_mut().0.iter_mut().zip(value(i)) {
                *slot = x.to_le_bytes();
            }
        }
    });
}

/// Writes four joints for each element, with 1 or 2 bytes for each joint.
pub(super) fn fill_joints(out: &mut [u8], size: usize, value: impl Fn(usize) -> [u16; 4] + Sync) {
    parallel::consume(out.chunks_mut(4 * size * BLOCK), |block, out| {
        for (i, slot) in (block * BLOCK..).zip(out.chunks_exact_mut(4 * size)) {
            for (slot, joint) in slot.chunks_exact_mut(size).zip(value(i)) {
                slot.copy_from_slice(&joint.to_le_bytes()[..size]);
            }
        }
    });
}

/// Computes the bounding box of `n` finite vectors.
pub(super) fn bounds_of(n: usize, value: impl Fn(usize) -> [f32; 3] + Sync) -> Bounds {
    let blocks = parallel::blocks(n, |range| {
        let all = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        let values = range.map(|i| Vec3::from_array(value(i)));
        values.fold(all, |(min, max), p| (min.min(p), max.max(p)))
    });
    let min = blocks
        .iter()
        .fold(Vec3::INFINITY, |min, block| min.min(block.0));
    let max = blocks
        .iter()
        .fold(Vec3::NEG_INFINITY, |max, block| max.max(block.1));
    Bounds {
        min: (min + 0.0).to_array(),
        max: (max + 0.0).to_array(),
    }
}

/// The bounding box of positions, or of the deltas of a morph target.
#[derive(Clone, Copy)]
pub(super) struct Bounds {
    pub(super) min: [f32; 3],
    pub(super) max: [f32; 3],
}

/// Computes the bounding box of positions rounded to 32 bits.
///
/// # Errors
///
/// Returns the first vertex whose rounded position is not finite.
pub(super) fn bounds(mesh: &Mesh, split: &Split) -> Result<Bounds, VertexId> {
    let position = |i| mesh.position(split.vertex(mesh, i)).as_vec3();
    let blocks = parallel::blocks(split.n, |vertices| {
        let all = (Vec3::INFINITY, Vec3::NEG_INFINITY, true);
        vertices.map(position).fold(all, |(min, max, finite), p| {
            (min.min(p), max.max(p), finite && p.is_finite())
        })
    });
    let min = blocks
        .iter()
        .fold(Vec3::INFINITY, |min, block| min.min(block.0));
    let max = blocks
        .iter()
        .fold(Vec3::NEG_INFINITY, |max, block| max.max(block.1));
    let finite = blocks.iter().all(|block| block.2);
    if !finite {
        let non_finite = (0..split.n).find(|&i| !position(i).is_finite());
        return Err(non_finite.map_or(VertexId::new(0), |i| split.vertex(mesh, i)));
    }
    // Adding 0 turns -0 into 0, so that the result does not depend on the order of the vertices.
    Ok(Bounds {
        min: (min + 0.0).to_array(),
        max: (max + 0.0).to_array(),
    })
}
