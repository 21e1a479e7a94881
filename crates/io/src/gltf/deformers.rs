//! Counts the joints and the morph targets that deform each mesh of a document.

use gltf_json::mesh::Semantic;
use gltf_json::validation::Checked;

use super::document::Document;

/// How many joints and morph targets deform a mesh, according to the JSON.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Deformers {
    /// The number of sets of joints and weights (`JOINTS_n` and `WEIGHTS_n`).
    pub(super) weight_sets: u32,
    /// The number of morph targets.
    pub(super) targets: usize,
    /// The number of joints that vertices can refer to. If several skins deform the mesh, this is the number of joints
    /// of the smallest skin. `None` if no node with the mesh has a skin.
    pub(super) joints: Option<usize>,
}

impl Deformers {
    /// Returns the maximum number of joints that can have weights.
    pub(super) fn n_joints(&self) -> usize {
        if self.weight_sets == 0 {
            return 0;
        }
        self.joints.unwrap_or(0)
    }

    /// Returns how many joints and morph targets deform each mesh of a document.
    pub(super) fn of_meshes(document: &Document) -> Vec<Self> {
        let meshes = document.meshes.iter();
        let mut all: Vec<Self> = meshes
            .map(|mesh| {
                let mut deformers = Self::default();
                for primitive in &mesh.primitives {
                    let targets = primitive.targets.as_ref().map_or(0, Vec::len);
                    deformers.targets = deformers.targets.max(targets);
                    let has =
                        |semantic| primitive.attributes.contains_key(&Checked::Valid(semantic));
                    let sets = (0..u32::MAX).take_while(|&set| {
                        has(Semantic::Joints(set)) && has(Semantic::Weights(set))
                    });
                    let sets = u32::try_from(sets.count()).unwrap_or(u32::MAX);
                    deformers.weight_sets = deformers.weight_sets.max(sets);
                }
                deformers
            })
            .collect();
        for node in &document.nodes {
            let skin = node.skin.and_then(|skin| document.skins.get(skin));
            let mesh = node.mesh.and_then(|mesh| all.get_mut(mesh));
            if let (Some(skin), Some(mesh)) = (skin, mesh) {
                let n = skin.joints.len();
                mesh.joints = Some(mesh.joints.map_or(n, |joints| joints.min(n)));
            }
        }
        all
    }
}
