//! Prepares the deformation of a mesh for writing: sets of four joints with weights, and deltas of morph targets.

use std::cmp::Ordering;

use glam::DVec3;
use mesh::{Domain, Mesh, VertexId};
use scene::{Graph, Object};

use super::deform::WEIGHT_TOLERANCE;
use crate::loss::Losses;
use mesh::parallel;

/// The joints, weights and morph targets of an object, in the form that glTF requires.
#[derive(Default)]
pub(super) struct Deformation<'a> {
    /// The number of sets of four joints. 0 if the object is written without a skin.
    pub(super) sets: usize,
    /// For each vertex of the mesh, four joints for each set. Joints with larger weights come first.
    joints: Vec<u16>,
    /// The weights of `joints`. At each vertex, the weights add up to 1.
    weights: Vec<f32>,
    /// The deltas of each morph target. `None` if all deltas of the target are 0.
    pub(super) morphs: Vec<Option<&'a [DVec3]>>,
}

impl<'a> Deformation<'a> {
    /// Converts the deformation of an object to the form that glTF requires, and adds losses for the content that is
    /// not written. `sets` is the maximum number of sets of joints. If it is `None`, the maximum is the number of sets
    /// in the file from which the object was read, or 1.
    pub(super) fn new(
        object: &Object,
        mesh: &'a Mesh,
        graph: &Graph,
        sets: Option<u32>,
        losses: &mut Losses,
    ) -> Self {
        let mut deformation = Self {
            morphs: morphs(object, mesh, graph, losses),
            ..Self::default()
        };
        let nodes = graph.nodes().iter();
        let nodes = nodes.filter(|node| node.object.as_deref() == Some(&object.name));
        let skins = nodes.filter_map(|node| node.skin);
        let n_joints = skins.map(|skin| graph.skins[skin].joints.len()).min();
        let columns = mesh.attributes().joints();
        let n = mesh.n_vertices();
        let Some(n_joints) = n_joints else {
            let reason = "no node with a skin references the object";
            let n = if columns.is_empty() { 0 } else { n };
            losses.add(Domain::Vertex, "joint weights", n, reason);
            return deformation;
        };
        let (known, unknown): (Vec<_>, Vec<_>) = columns
            .into_iter()
            .partition(|(joint, _)| *joint < n_joints.min(1 << 16));
        let is_weighted = |v: usize| unknown.iter().any(|(_, weights)| weights[v] > 0.0);
        let reason = "the weights refer to joints that the skin does not have";
        losses.add(
            Domain::Vertex,
            "joint weights",
            parallel::count(n, is_weighted),
            reason,
        );
        if known.is_empty() {
            let reason = "the mesh has no joint weights, so it is written without its skin";
            losses.add(None, "skins", 1, reason);
            return deformation;
        }
        let in_file = graph
            .label(&object.name)
            .map_or(1, |label| label.weight_sets);
        let sets = sets.unwrap_or(in_file).max(1) as usize;
        deformation.sets = sets.min(known.len().div_ceil(4)).min(1 << 14);
        deformation.bind(mesh, &known, losses);
        deformation
    }

    /// Chooses the joints of each vertex.
    fn bind(&mut self, mesh: &Mesh, columns: &[(usize, &[f64])], losses: &mut Losses) {
        let most = 4 * self.sets;
        let bound = parallel::blocks(mesh.n_vertices(), |vertices| {
            let mut bound = Bound::default();
            let mut own: Vec<(u16, f64)> = Vec::new();
            for v in vertices {
                own.clear();
                for (joint, weights) in columns {
                    let weight = weights[v];
                    if weight != 0.0 {
                        own.push((u16::try_from(*joint).unwrap_or(u16::MAX), weight));
                    }
                }
                let is_used = mesh.vertex_half_edge(VertexId::new(v)).is_some();
                bound.push(&mut own, most, is_used);
            }
            bound
        });
        let (mut truncated, mut invalid, mut unbound) = (0, 0, 0);
        for block in bound {
            self.joints.extend(block.joints);
            self.weights.extend(block.weights);
            truncated += block.truncated;
            invalid += block.invalid;
            unbound += block.unbound;
        }
        let reason =
            format!("the file stores at most {most} weights for each vertex: the largest ones");
        losses.add(Domain::Vertex, "influences", truncated, reason);
        let reason = "negative or not finite, so written as 0";
        losses.add(Domain::Vertex, "joint weights", invalid, reason);
        let reason = "vertices without weights follow the first joint";
        losses.add(Domain::Vertex, "joint weights", unbound, reason);
    }

    /// The joints of vertex `v` in a set (a group of four joints).
    pub(super) fn joints(&self, v: usize, set: usize) -> [u16; 4] {
        let start = 4 * (v * self.sets + set);
        std::array::from_fn(|i| self.joints[start + i])
    }

    /// The weights of vertex `v` for a set (a group of four joints).
    pub(super) fn weights(&self, v: usize, set: usize) -> [f32; 4] {
        let start = 4 * (v * self.sets + set);
        std::array::from_fn(|i| self.weights[start + i])
    }

    /// Whether the indices of all joints fit in a byte.
    pub(super) fn is_short(&self) -> bool {
        self.joints.iter().all(|&joint| joint < 256)
    }

    /// Returns the delta of a morph target at a vertex of the mesh, or zero if the delta is not finite.
    pub(super) fn delta(&self, target: usize, v: usize) -> [f32; 3] {
        let delta = self.morphs[target]
            .map_or(DVec3::ZERO, |deltas| deltas[v])
            .as_vec3();
        if delta.is_finite() {
            delta.to_array()
        } else {
            [0.0; 3]
        }
    }

    /// Whether the mesh has deltas of this morph target, and the target is written.
    pub(super) fn has_deltas(&self, target: usize) -> bool {
        self.morphs.get(target).is_some_and(Option::is_some)
    }

    /// Whether the object is written with neither joints nor morph targets.
    pub(super) fn is_none(&self) -> bool {
        self.sets == 0 && self.morphs.is_empty()
    }

    /// Compares the joints, weights and deltas that are written for two vertices of the mesh. The reader merges the two
    /// vertices only if all of these values are equal.
    pub(super) fn compare(&self, a: usize, b: usize) -> Ordering {
        let row = |v: usize| 4 * v * self.sets..4 * (v + 1) * self.sets;
        let by_joints = self.joints[row(a)].cmp(&self.joints[row(b)]);
        let bits = |v: usize| self.weights[row(v)].iter().map(|weight| weight.to_bits());
        let by_weights = || bits(a).cmp(bits(b));
        let delta = |v: usize, t: usize| self.delta(t, v).map(|x| (x + 0.0).to_bits());
        let by_deltas = || {
            let mut orders = (0..self.morphs.len()).map(|t| delta(a, t).cmp(&delta(b, t)));
            orders
                .find(|order| order.is_ne())
                .unwrap_or(Ordering::Equal)
        };
        by_joints.then_with(by_weights).then_with(by_deltas)
    }
}

/// The joints and weights of a block of vertices.
#[derive(Default)]
struct Bound {
    joints: Vec<u16>,
    weights: Vec<f32>,
    truncated: usize,
    invalid: usize,
    unbound: usize,
}

impl Bound {
    /// Adds a vertex with these joints and weights.
    #[expect(
        clippy::cast_possible_truncation,
        reason = "glTF stores 32-bit numbers"
    )]
    fn push(&mut self, own: &mut Vec<(u16, f64)>, most: usize, is_used: bool) {
        let n = own.len();
        own.retain(|(_, weight)| *weight > 0.0 && weight.is_finite());
        self.invalid += usize::from(own.len() < n && is_used);
        // Weights that become 0 when they are rounded to 32 bits have no effect and are removed.
        own.retain(|(_, weight)| *weight as f32 > 0.0);
        own.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
        self.truncated += usize::from(own.len() > most && is_used);
        own.truncate(most);
        if own.is_empty() {
            self.unbound += usize::from(is_used);
            own.push((0, 1.0));
        }
        let sum: f64 = own
            .iter()
            .map(|(_, weight)| f64::from(*weight as f32))
            .sum();
        let is_normalized = (sum - 1.0).abs() <= WEIGHT_TOLERANCE * own.len() as f64;
        let sum: f64 = own.iter().map(|(_, weight)| *weight).sum();
        let divisor = if is_normalized { 1.0 } else { sum };
        let end = self.joints.len() + most;
        for &(joint, weight) in own.iter() {
            let weight = (weight / divisor) as f32;
            self.joints.push(if weight > 0.0 { joint } else { 0 });
            self.weights.push(weight);
        }
        self.joints.resize(end, 0);
        self.weights.resize(end, 0.0);
    }
}

/// Returns the morph targets of an object. In the graph, the weights of the morph targets are in the
/// [`MeshLabel`](scene::MeshLabel) of the object. The number of targets in the result is the number of weights or the
/// number of targets with deltas, whichever is larger. If the mesh has no deltas, the result is empty.
fn morphs<'a>(
    object: &Object,
    mesh: &'a Mesh,
    graph: &Graph,
    losses: &mut Losses,
) -> Vec<Option<&'a [DVec3]>> {
    let columns = mesh.attributes().morphs();
    let in_file = graph
        .label(&object.name)
        .map_or(0, |label| label.weights.len());
    let last = columns.last().map(|(target, _)| target + 1);
    let Some(last) = last else {
        let reason = "the mesh has no deltas of morph targets";
        losses.add(None, "morph targets", in_file, reason);
        return Vec::new();
    };
    // The number of morph targets is limited to the number of columns or the number of weights, whichever is larger.
    // Without this limit, a single column with a large number in its name would give many targets.
    let n = last.max(in_file).min(columns.len().max(in_file));
    let mut morphs = vec![None; n];
    let mut unnumbered = 0;
    for (target, deltas) in columns {
        match morphs.get_mut(target) {
            Some(slot) => *slot = Some(deltas),
            None => unnumbered += 1,
        }
    }
    let reason = "the indices of the morph targets have gaps, so the last targets are not written";
    losses.add(Domain::Vertex, "morph targets", unnumbered, reason);
    let missing = morphs.iter().filter(|deltas| deltas.is_none()).count();
    let reason = "the mesh has no deltas for the morph target, so zeros are written";
    losses.add(None, "morph targets", missing, reason);
    let is_lost = |v: usize| {
        morphs
            .iter()
            .flatten()
            .any(|deltas| !deltas[v].as_vec3().is_finite())
    };
    let lost = parallel::count(mesh.n_vertices(), is_lost);
    let reason = "not finite when rounded to 32 bits, so written as 0";
    losses.add(Domain::Vertex, "morph targets", lost, reason);
    morphs
}
