//! One level: the connectivity by a topology, the values at vertices by masks, the attributes by both.

use mesh::{Connectivity, EdgeId, HalfEdgeId, Mesh};
use op::OpError;

use crate::Rules;
use crate::attributes;
use crate::masks::AnyMasks;
use crate::meter::Meter;
use crate::sharpness::Sharpness;

/// How the elements of the next level lie in a dense mesh.
pub(crate) trait Topology: Sync {
    /// The connectivity of the next level.
    fn connectivity(&self, meter: &Meter) -> Result<Connectivity, OpError>;

    /// Where the corner of new half-edge `i` lies in the old mesh.
    fn corner(&self, i: usize) -> Place;

    /// The old vertex that new vertex `i` is, if any. By default old vertices come first, and a number above
    /// theirs is none.
    fn vertex(&self, i: usize) -> Option<usize> {
        Some(i)
    }

    /// The old edge that new edge `i` is a part of.
    fn edge(&self, i: usize) -> Option<usize>;

    /// The old face that new face `i` is a part of.
    fn face(&self, i: usize) -> Option<usize>;

    /// The old half-edge whose part at the origin new edge `i` is. Where there are creases, each edge has two
    /// parts, which come first unless this says otherwise.
    fn half(&self, i: usize) -> Option<HalfEdgeId> {
        self.edge(i).map(|_| HalfEdgeId::new(i))
    }

    /// Whether an old vertex, and what is there, is smoothed where the scheme smooths; otherwise it stays.
    fn moves(&self, _: usize) -> bool {
        true
    }

    /// Whether what is new on an edge is smoothed where the scheme smooths; otherwise it lies in the
    /// middle.
    fn smooths(&self, _: EdgeId) -> bool {
        true
    }
}

/// Where a corner of the next level lies in an old face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Place {
    /// At the origin of this half-edge.
    At(HalfEdgeId),
    /// In the middle of this half-edge.
    On(HalfEdgeId),
    /// In the center of this face.
    In(mesh::FaceId),
    /// At the Doo-Sabin point that is pulled in from the origin of this half-edge.
    Pulled(HalfEdgeId),
    /// On an edge, one n-th of the way from the origin of the first half-edge to that of the second.
    Toward([HalfEdgeId; 2], u32),
    /// Nowhere: the half-edge is on the boundary.
    Outside,
}

/// The next level of a dense mesh. Creases fade by their sharpness, if the scheme uses it; otherwise their
/// numbers are handed on.
pub(crate) fn finer(
    mesh: &Mesh,
    rules: Rules,
    meter: &Meter,
    topology: &dyn Topology,
    masks: &dyn AnyMasks,
    sharpness: Option<Sharpness>,
) -> Result<Mesh, OpError> {
    let connectivity = topology.connectivity(meter)?;
    let positions = masks.values(mesh.positions(), meter)?;
    let mut finer = Mesh::from_arrays(connectivity, positions);
    if mesh.attributes().iter().next().is_some() {
        let from = attributes::From {
            mesh,
            topology,
            masks,
            sharpness,
            rules,
        };
        let attributes = from.attributes(&finer, meter)?;
        finer.set_attributes(attributes);
    }
    Ok(finer)
}
