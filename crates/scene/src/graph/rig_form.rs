//! The canonical form of skins, morph weights and animations. These parts follow the other parts of a graph. Earlier
//! versions of the canonical form did not have these parts. A graph without skins, morph weights and animations is
//! still written as in the earlier versions.

use super::rig::{AnimatedProperty, Animation, AnimationSampler, Channel, Interpolation, Skin};
use super::{Graph, MeshLabel};
use crate::decode::{DecodeError, Decoder};
use crate::digest::Encoder;

/// The string that precedes the skins, morph weights and animations in the canonical form.
pub(crate) const RIG: &str = "rig";

impl Graph {
    /// Whether the graph has skins, morph weights or animations.
    pub(crate) fn has_rig(&self) -> bool {
        !self.skins.is_empty()
            || !self.animations.is_empty()
            || !self.arrays.is_empty()
            || self.labels.values().any(MeshLabel::is_deformed)
            || self
                .nodes
                .iter()
                .any(|n| n.skin.is_some() || !n.weights.is_empty())
    }
}

impl Encoder<'_> {
    pub(crate) fn rig(&mut self, graph: &Graph) {
        self.len(graph.arrays.len());
        for numbers in &graph.arrays {
            self.array(numbers, 4);
        }
        self.len(graph.skins.len());
        for skin in &graph.skins {
            self.optional_text(skin.name.as_deref());
            self.optional_text(skin.extras.as_deref());
            self.optional_index(skin.inverse_bind_matrices);
            self.optional_index(skin.skeleton);
            self.len(skin.joints.len());
            for &joint in &skin.joints {
                self.len(joint);
            }
        }
        self.len(graph.animations.len());
        for animation in &graph.animations {
            self.animation(animation);
        }
        for node in &graph.nodes {
            self.optional_index(node.skin);
            self.array(&node.weights, 8);
        }
        for label in graph.labels.values() {
            self.array(&label.weights, 8);
            self.len(label.weight_sets as usize);
        }
    }

    fn animation(&mut self, animation: &Animation) {
        self.optional_text(animation.name.as_deref());
        self.optional_text(animation.extras.as_deref());
        self.len(animation.samplers.len());
        for sampler in &animation.samplers {
            self.len(sampler.input);
            self.len(sampler.output);
            self.code(&Interpolation::ALL, &sampler.interpolation);
            self.optional_text(sampler.extras.as_deref());
        }
        self.len(animation.channels.len());
        for channel in &animation.channels {
            self.len(channel.sampler);
            self.len(channel.node);
            self.code(&AnimatedProperty::ALL, &channel.property);
            self.optional_text(channel.extras.as_deref());
        }
    }

    fn code<T: PartialEq>(&mut self, all: &[T], value: &T) {
        self.len(all.iter().position(|other| other == value).unwrap_or(0));
    }
}

impl Decoder<'_> {
    /// Reads the skins, morph weights and animations of a graph with these nodes and labels.
    pub(crate) fn rig(&mut self, graph: &mut Graph) -> Result<(), DecodeError> {
        graph.arrays = self.list(|d| d.array::<f32>(4))?;
        let (n_arrays, n_nodes) = (graph.arrays.len() as u64, graph.nodes.len() as u64);
        graph.skins = self.list(|d| {
            let (name, extras) = (d.optional_text()?, d.optional_text()?);
            Ok(Skin {
                name,
                extras,
                inverse_bind_matrices: d.index(n_arrays)?,
                skeleton: d.index(n_nodes)?,
                joints: d.list(|d| d.required_index(n_nodes))?,
            })
        })?;
        for skin in &graph.skins {
            let matrices = skin.inverse_bind_matrices.map(|array| &graph.arrays[array]);
            if matrices.is_some_and(|numbers| numbers.len() < 16 * skin.joints.len()) {
                return Err(DecodeError::Expected("a matrix for each joint of a skin"));
            }
        }
        graph.animations = self.list(|d| d.animation(n_arrays, n_nodes))?;
        let n_skins = graph.skins.len() as u64;
        for node in &mut graph.nodes {
            node.skin = self.index(n_skins)?;
            node.weights = self.array(8)?;
        }
        for label in graph.labels.values_mut() {
            label.weights = self.array(8)?;
            let sets = u32::try_from(self.len()?);
            label.weight_sets = sets.map_err(|_| DecodeError::Expected("a number of sets"))?;
        }
        let to_scene = graph.to_scene();
        for skin in 0..graph.skins.len() {
            let maps = graph.joint_maps(skin, &to_scene);
            if !maps.iter().all(glam::DAffine3::is_finite) {
                return Err(DecodeError::Expected("finite placements of joints"));
            }
        }
        Ok(())
    }

    fn animation(&mut self, n_arrays: u64, n_nodes: u64) -> Result<Animation, DecodeError> {
        let (name, extras) = (self.optional_text()?, self.optional_text()?);
        let samplers = self.list(|d| {
            Ok(AnimationSampler {
                input: d.required_index(n_arrays)?,
                output: d.required_index(n_arrays)?,
                interpolation: d.of_code(&Interpolation::ALL)?,
                extras: d.optional_text()?,
            })
        })?;
        let n_samplers = samplers.len() as u64;
        let channels = self.list(|d| {
            Ok(Channel {
                sampler: d.required_index(n_samplers)?,
                node: d.required_index(n_nodes)?,
                property: d.of_code(&AnimatedProperty::ALL)?,
                extras: d.optional_text()?,
            })
        })?;
        Ok(Animation {
            name,
            samplers,
            channels,
            extras,
        })
    }

    /// Reads an index, which must be less than `n`.
    fn required_index(&mut self, n: u64) -> Result<usize, DecodeError> {
        let index = self.len()?;
        let index = usize::try_from(index).ok().filter(|_| index < n);
        index.ok_or(DecodeError::Expected("an index of a part of the graph"))
    }

    fn of_code<T: Copy>(&mut self, all: &[T]) -> Result<T, DecodeError> {
        Ok(all[self.required_index(all.len() as u64)?])
    }
}
