//! Reads the skins and animations of a glTF file.

use std::collections::BTreeMap;

use gltf_json::accessor::Type;
use scene::{AnimatedProperty, Animation, AnimationSampler, Channel, Graph, Interpolation, Skin};

use super::nodes::PlacedNodes;
use super::rig_json::{AnimationJson, SkinJson};
use super::views::Reader;
use crate::fault::Fault;
use crate::note::Notes;

/// Reads the skins and animations, and the arrays of numbers that they refer to. Each accessor is read only once.
pub(super) struct RigReader<'a, 'r> {
    pub(super) reader: &'a Reader<'r>,
    /// For each accessor that was read, the index of its array. The key consists of the index of the accessor and the
    /// number of components of an element.
    known: BTreeMap<(usize, usize), usize>,
    arrays: Vec<Vec<f32>>,
    has_numbers: bool,
}

impl<'a, 'r> RigReader<'a, 'r> {
    pub(super) fn new(reader: &'a Reader<'r>) -> Self {
        Self {
            reader,
            known: BTreeMap::new(),
            arrays: Vec::new(),
            has_numbers: true,
        }
    }

    /// Creates a reader that reads only the JSON, and leaves out the arrays of numbers, which are in the buffers.
    pub(super) fn without_numbers(reader: &'a Reader<'r>) -> Self {
        Self {
            has_numbers: false,
            ..Self::new(reader)
        }
    }

    /// Adds the skins and animations of the file to the graph. Their references to nodes of the file become references
    /// to nodes of the graph.
    ///
    /// # Errors
    ///
    /// Returns an error if an accessor is invalid.
    pub(super) fn fill(
        mut self,
        nodes: &PlacedNodes,
        graph: &mut Graph,
        notes: &mut Notes,
    ) -> Result<(), Fault> {
        let document = self.reader.document;
        let mut lost_channels = LostChannels::default();
        for (i, json) in document.skins.iter().enumerate() {
            let inverse_bind_matrices = self.matrices(i, json)?;
            let place = |&node: &usize| nodes.places[node].unwrap_or_default();
            graph.skins.push(Skin {
                name: json.name.clone(),
                joints: json.joints.iter().map(place).collect(),
                inverse_bind_matrices,
                skeleton: json.skeleton.and_then(|node| nodes.places[node]),
                extras: json.extras.as_ref().map(ToString::to_string),
            });
        }
        // A skin is left out if one of its joints is not in the scene.
        let complete: Vec<bool> = (document.skins.iter())
            .map(|skin| skin.joints.iter().all(|&node| nodes.places[node].is_some()))
            .collect();
        let what = "skins left out: a joint is not in the scene";
        let n = complete.iter().filter(|is| !**is).count();
        notes.left_out("skins", n, None, what);
        graph.retain_skins(&complete);
        let n = document
            .animations
            .iter()
            .filter(|a| a.channels.is_empty())
            .count();
        let what = "animations without channels left out";
        notes.left_out("animations", n, None, what);
        for (i, json) in document.animations.iter().enumerate() {
            let animation = self.animation(i, json, nodes, &mut lost_channels)?;
            if !animation.channels.is_empty() {
                graph.animations.push(animation);
            }
        }
        lost_channels.note(notes);
        graph.arrays = self.arrays;
        Ok(())
    }

    /// Reads the inverse bind matrices of a skin, and returns the index of the array that stores them.
    ///
    /// # Errors
    ///
    /// Returns an error if there are fewer matrices than joints, or a matrix is not affine.
    pub(super) fn matrices(&mut self, i: usize, skin: &SkinJson) -> Result<Option<usize>, Fault> {
        let Some(accessor) = skin.inverse_bind_matrices.filter(|_| self.has_numbers) else {
            return Ok(None);
        };
        let pointer = format!("/skins/{i}/inverseBindMatrices");
        let array = self.array(accessor, &pointer, Type::Mat4)?;
        let (matrices, _) = self.arrays[array].as_chunks::<16>();
        let here = format!("/accessors/{accessor}");
        if matrices.len() < skin.joints.len() {
            let (expected, found) = (skin.joints.len(), matrices.len());
            let message = format!(
                "expected at least {expected} inverse bind matrices, one for each joint, found {found}"
            );
            return Err(Fault::json(here, message));
        }
        let is_affine = |m: &[f32; 16]| [3, 7, 11, 15].map(|k| m[k]) == [0.0, 0.0, 0.0, 1.0];
        if let Some(k) = matrices.iter().position(|m| !is_affine(m)) {
            let message =
                format!("expected the last row of inverse bind matrix {k} to be 0, 0, 0, 1");
            return Err(Fault::json(here, message));
        }
        Ok(Some(array))
    }

    /// Returns the array with this index.
    pub(super) fn numbers(&self, array: usize) -> &[f32] {
        &self.arrays[array]
    }

    fn array(&mut self, accessor: usize, pointer: &str, kind: Type) -> Result<usize, Fault> {
        let key = (accessor, kind.multiplicity());
        if let Some(&known) = self.known.get(&key) {
            return Ok(known);
        }
        let numbers = self.reader.floats(accessor, pointer, kind)?;
        self.arrays.push(numbers);
        self.known.insert(key, self.arrays.len() - 1);
        Ok(self.arrays.len() - 1)
    }

    fn animation(
        &mut self,
        i: usize,
        json: &AnimationJson,
        nodes: &PlacedNodes,
        lost: &mut LostChannels,
    ) -> Result<Animation, Fault> {
        let mut animation = Animation {
            name: json.name.clone(),
            extras: json.extras.as_ref().map(ToString::to_string),
            ..Animation::default()
        };
        // For each sampler that was read, its index in `animation`. The key is the index of the sampler in the file.
        let mut samplers: BTreeMap<usize, usize> = BTreeMap::new();
        for channel in &json.channels {
            let property = match channel.target.path.as_str() {
                "translation" => AnimatedProperty::Translation,
                "rotation" => AnimatedProperty::Rotation,
                "scale" => AnimatedProperty::Scale,
                "weights" => AnimatedProperty::Weights,
                _ => {
                    lost.properties += 1;
                    continue;
                }
            };
            let Some(node) = channel.target.node.and_then(|node| nodes.places[node]) else {
                lost.nodes += 1;
                continue;
            };
            let n_targets = channel.target.node.map_or(0, |node| nodes.targets[node]);
            let here = format!("/animations/{i}/samplers/{}", channel.sampler);
            let Some(sampler) = self.sampler(json, channel.sampler, property, n_targets, &here)?
            else {
                *lost.samplers.entry(here).or_default() += 1;
                continue;
            };
            let n = animation.samplers.len();
            let place = *samplers.entry(channel.sampler).or_insert(n);
            if place == n {
                animation.samplers.push(sampler);
            }
            animation.channels.push(Channel {
                sampler: place,
                node,
                property,
                extras: channel.extras.as_ref().map(ToString::to_string),
            });
        }
        Ok(animation)
    }

    /// Reads a sampler. Returns `None` if the sampler has invalid times or a wrong number of values.
    fn sampler(
        &mut self,
        json: &AnimationJson,
        i: usize,
        property: AnimatedProperty,
        n_targets: usize,
        here: &str,
    ) -> Result<Option<AnimationSampler>, Fault> {
        let sampler = &json.samplers[i];
        let interpolation = match sampler.interpolation.as_deref() {
            None | Some("LINEAR") => Interpolation::Linear,
            Some("STEP") => Interpolation::Step,
            Some("CUBICSPLINE") => Interpolation::CubicSpline,
            Some(other) => {
                let message = format!(
                    "expected the interpolation LINEAR, STEP or CUBICSPLINE, found {other:?}"
                );
                return Err(Fault::json(format!("{here}/interpolation"), message));
            }
        };
        let with_arrays = |[input, output]: [usize; 2]| AnimationSampler {
            input,
            output,
            interpolation,
            extras: sampler.extras.as_ref().map(ToString::to_string),
        };
        if !self.has_numbers {
            return Ok(Some(with_arrays([0, 0])));
        }
        let (kind, n) = match property {
            AnimatedProperty::Translation | AnimatedProperty::Scale => (Type::Vec3, 1),
            AnimatedProperty::Rotation => (Type::Vec4, 1),
            AnimatedProperty::Weights => (Type::Scalar, n_targets),
        };
        let input = self.array(sampler.input, &format!("{here}/input"), Type::Scalar)?;
        let output = self.array(sampler.output, &format!("{here}/output"), kind)?;
        let times = &self.arrays[input];
        let expected = [interpolation.values_per_key(), kind.multiplicity(), n];
        let expected = expected
            .iter()
            .try_fold(times.len(), |n, &k| n.checked_mul(k));
        let increases = times.windows(2).all(|pair| pair[0] < pair[1]);
        let is_valid = expected == Some(self.arrays[output].len())
            && !times.is_empty()
            && times[0] >= 0.0
            && increases;
        Ok(is_valid.then(|| with_arrays([input, output])))
    }
}

/// Counts the channels that are left out.
#[derive(Default)]
struct LostChannels {
    nodes: usize,
    properties: usize,
    samplers: BTreeMap<String, usize>,
}

impl LostChannels {
    fn note(self, notes: &mut Notes) {
        let what = "animation channels left out: the animated node is not in the scene";
        notes.left_out("animations", self.nodes, None, what);
        let what = "animation channels left out: the property is not part of glTF 2.0";
        notes.left_out("animations", self.properties, None, what);
        for (sampler, count) in self.samplers {
            let what = format!(
                "animation channels left out: {sampler} has times that do not increase, negative times, no times, or a \
                 wrong number of values"
            );
            notes.left_out("animations", count, None, what);
        }
    }
}
