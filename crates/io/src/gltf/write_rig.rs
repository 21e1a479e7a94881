//! Writes the skins and animations of a scene.

use gltf_json::accessor::{ComponentType, Type};
use scene::{AnimatedProperty, Animation, Channel, Graph, Scene, Skin};
use serde_json::{Value, json};

use super::extras::optional_json;
use super::write_document::Writer;
use crate::error::Unwritable;
use crate::loss::Losses;

impl<'a> Writer<'a> {
    /// Adds the skins and animations of the graph.
    ///
    /// # Errors
    ///
    /// Returns an error if extras are not JSON.
    pub(super) fn rig(&mut self, scene: &'a Scene, losses: &mut Losses) -> Result<(), Unwritable> {
        let graph = scene.graph();
        for skin in &graph.skins {
            let skin = self.skin(graph, skin)?;
            self.nodes.skins.push(skin);
        }
        let mut lost = 0;
        for animation in &graph.animations {
            let n_written = self.animation(graph, animation)?;
            lost += animation.channels.len() - n_written;
        }
        let reason =
            "animation channels with invalid values, or for morph targets that do not exist";
        losses.add(None, "animations", lost, reason);
        Ok(())
    }

    fn skin(&mut self, graph: &'a Graph, skin: &Skin) -> Result<Value, Unwritable> {
        let n = 16 * skin.joints.len();
        let matrices = skin.inverse_bind_matrices.map(|array| {
            let numbers = graph.arrays[array].get(..n).unwrap_or_default();
            self.numbers(array, numbers, Type::Mat4)
        });
        Ok(json!({
            "name": skin.name,
            "joints": skin.joints,
            "inverseBindMatrices": matrices,
            "skeleton": skin.skeleton,
            "extras": optional_json(skin.extras.as_deref())?,
        }))
    }

    /// Adds an animation, if it has valid channels. Returns the number of valid channels.
    fn animation(&mut self, graph: &'a Graph, animation: &Animation) -> Result<usize, Unwritable> {
        let mut channels = Vec::new();
        let mut samplers = Vec::new();
        // For each sampler of the animation, its index in the file. `None` if the sampler is not written yet.
        let mut places = vec![None; animation.samplers.len()];
        for channel in &animation.channels {
            let Some(kind) = self.kind(graph, animation, channel) else {
                continue;
            };
            let place = if let Some(place) = places[channel.sampler] {
                place
            } else {
                let sampler = &animation.samplers[channel.sampler];
                let times = &graph.arrays[sampler.input];
                let input = self.numbers(sampler.input, times, Type::Scalar);
                self.accessors[input]["min"] = json!([times.first()]);
                self.accessors[input]["max"] = json!([times.last()]);
                let output = self.numbers(sampler.output, &graph.arrays[sampler.output], kind);
                samplers.push(json!({
                    "input": input,
                    "output": output,
                    "interpolation": sampler.interpolation.name(),
                    "extras": optional_json(sampler.extras.as_deref())?,
                }));
                samplers.len() - 1
            };
            places[channel.sampler] = Some(place);
            channels.push(json!({
                "sampler": place,
                "target": { "node": channel.node, "path": channel.property.name() },
                "extras": optional_json(channel.extras.as_deref())?,
            }));
        }
        let n = channels.len();
        if n > 0 {
            self.nodes.animations.push(json!({
                "name": animation.name,
                "channels": channels,
                "samplers": samplers,
                "extras": optional_json(animation.extras.as_deref())?,
            }));
        }
        Ok(n)
    }

    /// Returns the type of the values of a channel. Returns `None` if the values do not match the keyframes or the
    /// property that the channel changes.
    fn kind(&self, graph: &Graph, animation: &Animation, channel: &Channel) -> Option<Type> {
        let (kind, n) = match channel.property {
            AnimatedProperty::Translation | AnimatedProperty::Scale => (Type::Vec3, 1),
            AnimatedProperty::Rotation => (Type::Vec4, 1),
            AnimatedProperty::Weights => {
                let object = graph.nodes()[channel.node].object.as_deref()?;
                let n_targets = self.deformed.get(object)?.n_targets;
                (Type::Scalar, n_targets)
            }
        };
        let sampler = &animation.samplers[channel.sampler];
        let times = &graph.arrays[sampler.input];
        let values = sampler.interpolation.values_per_key() * kind.multiplicity();
        let expected = times.len().checked_mul(values)?.checked_mul(n)?;
        (expected > 0 && expected == graph.arrays[sampler.output].len()).then_some(kind)
    }

    /// Returns the accessor of an array. Adds the accessor if it does not exist yet.
    fn numbers(&mut self, array: usize, numbers: &'a [f32], kind: Type) -> usize {
        let key = (array, kind.multiplicity(), numbers.len());
        if let Some(&known) = self.number_accessors.get(&key) {
            return known;
        }
        let fill = move |out: &mut [u8]| {
            for (slot, x) in out.as_chunks_mut().0.iter_mut().zip(numbers) {
                *slot = x.to_le_bytes();
            }
        };
        let view = self.view(size_of_val(numbers), None, fill);
        let count = numbers.len() / kind.multiplicity();
        let accessor = self.accessor(view, count, ComponentType::F32, kind);
        self.number_accessors.insert(key, accessor);
        accessor
    }
}
