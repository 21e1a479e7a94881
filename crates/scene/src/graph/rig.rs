//! Skins and animations: the parts of a graph that deform and move objects.

use glam::{DAffine3, DMat4};

use super::Graph;

/// A skin: the joints that deform a mesh. The vertex attribute [`mesh::joint_name`]`(j)` has the weights of joint j.
///
/// A skinned point p is drawn at the weighted mean of G B p over all joints. G maps the space of the joint to the
/// scene, and B is the inverse bind matrix of the joint. The placement of the node of the mesh has no effect (glTF
/// 2.0 specification, 3.7.3).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Skin {
    /// The name.
    pub name: Option<String>,
    /// The indices of the nodes that are the joints.
    pub joints: Vec<usize>,
    /// The index of the inverse bind matrices in [`Graph::arrays`]: 16 numbers for each joint, column by column. `None`
    /// if all inverse bind matrices are the identity.
    pub inverse_bind_matrices: Option<usize>,
    /// The index of the node that is the root of the joints. It has no effect on the pose, but other programs can need
    /// it.
    pub skeleton: Option<usize>,
    /// Application-specific data (`extras` in glTF), as JSON.
    pub extras: Option<String>,
}

/// An animation: values over time for properties of nodes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Animation {
    /// The name.
    pub name: Option<String>,
    /// The values over time. Channels refer to these samplers by index.
    pub samplers: Vec<AnimationSampler>,
    /// The channels. Each channel applies a sampler to a property of a node.
    pub channels: Vec<Channel>,
    /// Application-specific data (`extras` in glTF), as JSON.
    pub extras: Option<String>,
}

/// The keyframes of a property: values at given times.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AnimationSampler {
    /// The index of an array in [`Graph::arrays`]: the times of the keyframes in seconds, in ascending order.
    pub input: usize,
    /// The index of an array in [`Graph::arrays`]: the values of the keyframes.
    pub output: usize,
    /// How values between keyframes are computed.
    pub interpolation: Interpolation,
    /// Application-specific data (`extras` in glTF), as JSON.
    pub extras: Option<String>,
}

/// How values between keyframes are computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Interpolation {
    /// Linear interpolation, along the shortest arc for rotations.
    #[default]
    Linear,
    /// The value of the previous keyframe is used.
    Step,
    /// Cubic splines. Each keyframe has an incoming tangent, a value and an outgoing tangent.
    CubicSpline,
}

/// A channel: the property of a node that a sampler changes.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// The index of the sampler in its animation.
    pub sampler: usize,
    /// The index of the node.
    pub node: usize,
    /// The property of the node.
    pub property: AnimatedProperty,
    /// Application-specific data (`extras` in glTF), as JSON.
    pub extras: Option<String>,
}

/// A property of a node that an animation can change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AnimatedProperty {
    /// The translation of the placement.
    Translation,
    /// The rotation of the placement.
    Rotation,
    /// The scale of the placement.
    Scale,
    /// The weights of morph targets.
    Weights,
}

impl Interpolation {
    /// All interpolation modes. In the canonical form of a scene, a mode is encoded as its index in this array.
    pub(crate) const ALL: [Self; 3] = [Self::Linear, Self::Step, Self::CubicSpline];

    /// Returns the name in glTF.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Linear => "LINEAR",
            Self::Step => "STEP",
            Self::CubicSpline => "CUBICSPLINE",
        }
    }

    /// Returns the number of values for each keyframe.
    pub const fn values_per_key(self) -> usize {
        match self {
            Self::Linear | Self::Step => 1,
            Self::CubicSpline => 3,
        }
    }
}

impl AnimatedProperty {
    /// All properties. In the canonical form of a scene, a property is encoded as its index in this array.
    pub(crate) const ALL: [Self; 4] = [
        Self::Translation,
        Self::Rotation,
        Self::Scale,
        Self::Weights,
    ];

    /// Returns the name in glTF.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Translation => "translation",
            Self::Rotation => "rotation",
            Self::Scale => "scale",
            Self::Weights => "weights",
        }
    }
}

impl Graph {
    /// Returns the number of channels of all animations.
    pub fn n_channels(&self) -> usize {
        self.animations.iter().map(|a| a.channels.len()).sum()
    }

    /// Returns one flag for each node: whether an animation changes the placement of the node.
    pub fn animated_flags(&self) -> Vec<bool> {
        let mut flags = vec![false; self.nodes.len()];
        for channel in self.animations.iter().flat_map(|a| &a.channels) {
            flags[channel.node] |= channel.property != AnimatedProperty::Weights;
        }
        flags
    }

    /// Inserts a new parent between a node and its parent. The new parent gets the index `node`, and the indices of the
    /// node and of all later nodes grow by 1. The new parent has the identity placement, and no animation changes it.
    ///
    /// # Panics
    ///
    /// Panics if the node does not exist.
    pub fn insert_parent(&mut self, node: usize) {
        let parent = super::Node {
            parent: self.nodes[node].parent,
            ..super::Node::default()
        };
        self.nodes.insert(node, parent);
        let shift = |i: &mut usize| *i += usize::from(*i >= node);
        for later in &mut self.nodes[node + 1..] {
            later.parent.iter_mut().for_each(shift);
        }
        self.nodes[node + 1].parent = Some(node);
        for skin in &mut self.skins {
            (skin.joints.iter_mut().chain(&mut skin.skeleton)).for_each(shift);
        }
        for animation in &mut self.animations {
            animation
                .channels
                .iter_mut()
                .for_each(|c| shift(&mut c.node));
        }
    }

    /// Replaces the object `from` by the object `to` in all nodes. The nodes keep their skins and weights of morph
    /// targets, and `to` gets the label of `from`.
    pub fn show_instead(&mut self, from: &str, to: &str) {
        for node in &mut self.nodes {
            if node.object.as_deref() == Some(from) {
                node.object = Some(to.to_owned());
            }
        }
        if let Some(label) = self.labels.remove(from) {
            self.labels.insert(to.to_owned(), label);
        }
    }

    /// Returns one affine map for each joint of a skin, from points of the mesh in its bind pose to scene space.
    /// `to_scene` is the result of [`Graph::to_scene`].
    ///
    /// # Panics
    ///
    /// Panics if the skin does not exist.
    pub fn joint_maps(&self, skin: usize, to_scene: &[DAffine3]) -> Vec<DAffine3> {
        let skin = &self.skins[skin];
        let matrices = skin.inverse_bind_matrices.map(|array| &self.arrays[array]);
        let matrices = matrices.map(|numbers| numbers.as_chunks::<16>().0);
        let joints = skin.joints.iter().enumerate();
        let map = |(j, &node): (usize, &usize)| {
            let inverse = matrices.and_then(|matrices| matrices.get(j));
            inverse.map_or(to_scene[node], |matrix| {
                let matrix = DMat4::from_cols_array(&matrix.map(f64::from));
                to_scene[node] * DAffine3::from_mat4(matrix)
            })
        };
        joints.map(map).collect()
    }

    /// Returns one flag for each node: whether the node is a joint or the root of the joints of a skin.
    pub fn joint_flags(&self) -> Vec<bool> {
        let mut flags = vec![false; self.nodes.len()];
        for skin in &self.skins {
            for &node in skin.joints.iter().chain(&skin.skeleton) {
                flags[node] = true;
            }
        }
        flags
    }

    /// Updates skins and animations after nodes were removed. `places` contains the new index of each node, or `None`
    /// if the node was removed. Joints and roots of skins must not be removed. Channels of removed nodes are removed.
    /// Animations that then have no channel are removed too.
    pub(super) fn renumber_rig(&mut self, places: &[Option<usize>]) {
        for skin in &mut self.skins {
            for node in skin.joints.iter_mut().chain(&mut skin.skeleton) {
                *node = places[*node].expect("joints are kept");
            }
        }
        for animation in &mut self.animations {
            animation.channels.retain_mut(|channel| {
                let place = places[channel.node];
                channel.node = place.unwrap_or_default();
                place.is_some()
            });
        }
        self.animations.retain(|a| !a.channels.is_empty());
    }

    /// Removes the channels for which `is_kept` is false. Animations that then have no channel are removed too. Returns
    /// the number of removed channels.
    pub fn retain_channels(&mut self, is_kept: impl Fn(&Channel) -> bool) -> usize {
        let before = self.n_channels();
        for animation in &mut self.animations {
            animation.channels.retain(&is_kept);
        }
        let removed = before - self.n_channels();
        self.animations.retain(|a| !a.channels.is_empty());
        removed
    }

    /// Keeps only the skins whose flag in `keep` is true. A node whose skin is removed has no skin afterwards.
    pub fn retain_skins(&mut self, keep: &[bool]) {
        let mut n = 0;
        let places: Vec<Option<usize>> = (keep.iter())
            .map(|&is_kept| {
                n += usize::from(is_kept);
                is_kept.then(|| n - 1)
            })
            .collect();
        let mut kept = keep.iter();
        self.skins.retain(|_| *kept.next().unwrap_or(&true));
        for node in &mut self.nodes {
            node.skin = node.skin.and_then(|skin| places[skin]);
        }
    }
}
