//! Reads the attributes that deform a mesh: joints with weights, and morph targets.

use std::collections::{BTreeMap, BTreeSet};

use bytemuck::Pod;
use glam::{DVec3, DVec4};
use gltf_json::accessor::{ComponentType, Type};
use gltf_json::mesh::{MorphTarget, Primitive, Semantic};
use gltf_json::validation::Checked;
use gltf_json::{Accessor, Index};
use mesh::{
    CORNER_TANGENT, Column, Rule, Value, joint_name, morph_name, morph_normal_name,
    morph_tangent_name,
};

use super::deformers::Deformers;
use super::views::Reader;
use crate::fault::Fault;

/// The weights of a vertex count as normalized if their sum differs from 1 by at most this tolerance times the number
/// of weights. The Khronos validator uses the same tolerance.
pub(super) const WEIGHT_TOLERANCE: f64 = 2e-7;

/// Counts the values that are repaired or left out while attributes are read. The keys of both maps are the texts of
/// the notes.
#[derive(Default)]
pub(super) struct Repairs {
    pub(super) changed: BTreeMap<String, usize>,
    pub(super) left_out: BTreeMap<String, usize>,
}

impl Repairs {
    fn change(&mut self, count: usize, what: impl FnOnce() -> String) {
        if count > 0 {
            *self.changed.entry(what()).or_default() += count;
        }
    }
}

/// Reads the joint weights of a primitive with `n` vertices. Returns a column of weights for each joint that has a
/// weight other than 0. `here` is the location of the primitive, for errors.
///
/// # Errors
///
/// Returns an error if an accessor is invalid, or if a vertex refers to a joint that the skin does not have.
pub(super) fn joints(
    reader: &Reader,
    primitive: &Primitive,
    n: usize,
    deformers: Deformers,
    here: &str,
    repairs: &mut Repairs,
) -> Result<Vec<Column>, Fault> {
    let accessor = |semantic: Semantic| {
        let at = format!("{here}/attributes/{}", semantic.to_string());
        let accessor = primitive.attributes.get(&Checked::Valid(semantic))?;
        Some((accessor.value(), at))
    };
    let mut sets = Vec::new();
    for set in 0.. {
        let found = [Semantic::Joints(set), Semantic::Weights(set)].map(accessor);
        let [Some((joints, joints_at)), Some((weights, weights_at))] = found else {
            break;
        };
        let integers = [ComponentType::U8, ComponentType::U16];
        reader.expect_components(joints, &joints_at, &integers)?;
        let numbers = [ComponentType::F32, ComponentType::U8, ComponentType::U16];
        reader.expect_components(weights, &weights_at, &numbers)?;
        let read = |accessor, at: &str| {
            let values = reader.vectors(accessor, at, &[Type::Vec4], 0.0, DVec4::from_array)?;
            expect_len(values.len(), n, at)?;
            Ok(values)
        };
        let (joints, weights) = (read(joints, &joints_at)?, read(weights, &weights_at)?);
        sets.push((joints, weights, joints_at, weights_at));
    }
    let Some((.., weights_at)) = sets.first() else {
        return Ok(Vec::new());
    };
    let weights_at = weights_at.clone();
    let mut used = vec![false; 1 << 16];
    let mut negative = 0;
    for (joints, weights, joints_at, _) in &mut sets {
        for (v, (joints, weights)) in joints.iter().zip(weights.iter_mut()).enumerate() {
            negative += usize::from(weights.min_element() < 0.0);
            *weights = weights.max(DVec4::ZERO);
            for (joint, weight) in joints.to_array().into_iter().zip(weights.to_array()) {
                if weight == 0.0 {
                    continue;
                }
                let joint = index(joint);
                if let Some(count) = deformers.joints.filter(|&count| joint >= count) {
                    let message = format!(
                        "element {v} of the accessor refers to joint {joint}, but the skin has only {count} joints"
                    );
                    return Err(Fault::json(joints_at.clone(), message));
                }
                used[joint] = true;
            }
        }
    }
    repairs.change(negative, || {
        format!("negative weights in {weights_at}: set to 0")
    });
    let used: Vec<usize> = (0..used.len()).filter(|&joint| used[joint]).collect();
    let bytes = (used.len() as u64).saturating_mul(n as u64 * 8);
    if !reader.budget.has(2 * bytes) {
        let what = format!(
            "joints left out: their weights need {bytes} bytes, which exceeds the memory limit for a file of this size"
        );
        *repairs.left_out.entry(what).or_default() += used.len();
        return Ok(Vec::new());
    }
    let mut place = vec![0; used.last().map_or(0, |last| last + 1)];
    for (k, &joint) in used.iter().enumerate() {
        place[joint] = k;
    }
    let mut columns: Vec<Vec<f64>> = used.iter().map(|_| mesh::zeroed(n)).collect();
    let (mut unweighted, mut scaled) = (0, 0);
    for v in 0..n {
        let influences = || {
            let sets = sets.iter().flat_map(|(joints, weights, ..)| {
                let joints = joints[v].to_array().into_iter();
                joints.zip(weights[v].to_array())
            });
            sets.filter(|(_, weight)| *weight != 0.0)
        };
        let sum: f64 = influences().map(|(_, weight)| weight).sum();
        let tolerance = WEIGHT_TOLERANCE * influences().count() as f64;
        let is_normalized = sum == 0.0 || (sum - 1.0).abs() <= tolerance;
        unweighted += usize::from(sum == 0.0);
        scaled += usize::from(!is_normalized);
        let divisor = if is_normalized { 1.0 } else { sum };
        for (joint, weight) in influences() {
            columns[place[index(joint)]][v] += weight / divisor;
        }
    }
    let what = || format!("vertices without weights in {weights_at}: they follow the first joint");
    repairs.change(unweighted, what);
    let what = || {
        format!(
            "vertices whose weights in {weights_at} did not add up to 1: the weights were divided by their sum"
        )
    };
    repairs.change(scaled, what);
    let columns = used.into_iter().zip(columns);
    let column = |(joint, values)| Column {
        name: joint_name(joint),
        rule: Rule::Interpolate,
        values: f64::wrap(values),
    };
    Ok(columns.map(column).collect())
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the number was read from 16 bits"
)]
fn index(joint: f64) -> usize {
    joint as usize
}

/// Reads the deltas of the morph targets of a primitive with `n` vertices. Returns a column for each morph target of
/// the mesh. The deltas are zero if the primitive does not have the target. `here` is the location of the primitive,
/// for errors.
///
/// # Errors
///
/// Returns an error if an accessor is invalid.
pub(super) fn morphs(
    reader: &Reader,
    primitive: &Primitive,
    n: usize,
    deformers: Deformers,
    here: &str,
    repairs: &mut Repairs,
) -> Result<Vec<Column>, Fault> {
    let targets = primitive.targets.as_deref().unwrap_or_default();
    let bytes = (deformers.targets as u64).saturating_mul(n as u64 * 24);
    if !reader.budget.has(2 * bytes) {
        let what = format!(
            "morph targets left out: their deltas need {bytes} bytes, which exceeds the memory limit for a file of this size"
        );
        *repairs.left_out.entry(what).or_default() += deformers.targets;
        return Ok(Vec::new());
    }
    let mut columns = Vec::new();
    for t in 0..deformers.targets {
        let target = targets.get(t);
        let deltas = match target.and_then(|target| target.positions.as_ref()) {
            None => mesh::zeroed(n),
            Some(accessor) => {
                let at = format!("{here}/targets/{t}/POSITION");
                let kinds = &[Type::Vec3];
                let deltas =
                    reader.vectors(accessor.value(), &at, kinds, 0.0, DVec3::from_array)?;
                expect_len(deltas.len(), n, &at)?;
                deltas
            }
        };
        columns.push(Column {
            name: morph_name(t),
            rule: Rule::Interpolate,
            values: DVec3::wrap(deltas),
        });
    }
    if targets.len() < deformers.targets {
        let what = || format!("missing morph targets of {here}: set to 0");
        repairs.change(deformers.targets - targets.len(), what);
    }
    Ok(columns)
}

/// The normals or tangents of a mesh, and the morph targets that change them.
pub(super) struct Directions {
    semantic: Semantic,
    /// Returns the accessor that stores how a morph target changes the normals or tangents.
    changes: fn(&MorphTarget) -> Option<&Index<Accessor>>,
    /// Returns the name of the mesh attribute that stores the changed normals or tangents of the morph target with this
    /// index.
    name: fn(usize) -> String,
    rule: Rule,
    /// The indices of the morph targets that change the normals or tangents, in ascending order.
    targets: Vec<usize>,
}

impl Directions {
    /// Describes the normals of a mesh with these primitives, and the morph targets that change them.
    pub(super) fn normals(primitives: &[Primitive]) -> Self {
        let normals = Self {
            semantic: Semantic::Normals,
            changes: |target| target.normals.as_ref(),
            name: morph_normal_name,
            rule: Rule::Normal,
            targets: Vec::new(),
        };
        normals.of(primitives)
    }

    /// Describes the tangents of a mesh with these primitives, and the morph targets that change them.
    pub(super) fn tangents(primitives: &[Primitive]) -> Self {
        let tangents = Self {
            semantic: Semantic::Tangents,
            changes: |target| target.tangents.as_ref(),
            name: morph_tangent_name,
            rule: CORNER_TANGENT.rule,
            targets: Vec::new(),
        };
        tangents.of(primitives)
    }

    /// Finds the morph targets that change the normals or tangents. If a primitive itself has no normals or tangents,
    /// the changes by its morph targets are ignored.
    fn of(mut self, primitives: &[Primitive]) -> Self {
        let semantic = Checked::Valid(self.semantic.clone());
        let primitives = primitives.iter();
        let primitives = primitives.filter(|p| p.attributes.contains_key(&semantic));
        let targets = primitives.flat_map(|p| p.targets.iter().flatten().enumerate());
        let changed = targets.filter(|(_, target)| (self.changes)(target).is_some());
        let changed: BTreeSet<usize> = changed.map(|(t, _)| t).collect();
        self.targets = changed.into_iter().collect();
        self
    }

    /// Returns the names of the attributes that store the changed normals or tangents.
    pub(super) fn names(&self) -> impl Iterator<Item = String> {
        self.targets.iter().map(|&t| (self.name)(t))
    }

    /// Reads how the morph targets change the normals or tangents of a primitive with `n` vertices. Returns a column
    /// for each target in `targets`: the normals or tangents that result if only this target is applied, with the
    /// weight 1. `own` contains the normals or tangents to which no morph target is applied. If `own` is `None`, the
    /// columns are zero. A value has three or more numbers, and morph targets change the first three. `here` is the
    /// location of the primitive, for errors.
    ///
    /// # Errors
    ///
    /// Returns an error if an accessor is invalid.
    pub(super) fn read<T: Value + Pod>(
        &self,
        reader: &Reader,
        primitive: &Primitive,
        own: Option<&[T]>,
        n: usize,
        here: &str,
        repairs: &mut Repairs,
    ) -> Result<Vec<Column>, Fault> {
        let targets = primitive.targets.as_deref().unwrap_or_default();
        let semantic = self.semantic.to_string();
        let bytes = (self.targets.len() as u64).saturating_mul((n * size_of::<T>()) as u64);
        if !reader.budget.has(2 * bytes) {
            let what = format!(
                "attributes {semantic} of morph targets left out: they need {bytes} bytes, which exceeds the memory limit for a file of this size"
            );
            *repairs.left_out.entry(what).or_default() += self.targets.len();
            return Ok(Vec::new());
        }
        let mut columns = Vec::new();
        for &t in &self.targets {
            let mut values = own.map_or_else(|| mesh::zeroed(n), <[T]>::to_vec);
            let accessor = targets.get(t).and_then(self.changes);
            if let Some(accessor) = accessor.filter(|_| own.is_some()) {
                let at = format!("{here}/targets/{t}/{semantic}");
                let kinds = &[Type::Vec3];
                let changes =
                    reader.vectors(accessor.value(), &at, kinds, 0.0, DVec3::from_array)?;
                expect_len(changes.len(), n, &at)?;
                let numbers: &mut [f64] = bytemuck::cast_slice_mut(&mut values);
                let size = size_of::<T>() / size_of::<f64>();
                for (value, change) in numbers.chunks_exact_mut(size).zip(changes) {
                    let sums = value.iter_mut().zip(change.to_array());
                    sums.for_each(|(number, change)| *number += change);
                }
            }
            columns.push(Column {
                name: (self.name)(t),
                rule: self.rule,
                values: T::wrap(values),
            });
        }
        Ok(columns)
    }
}

/// Checks that an accessor has `n` elements, one for each position. `at` is the location of the accessor.
///
/// # Errors
///
/// Returns an error if `found`, the number of elements of the accessor, is not `n`.
pub(super) fn expect_len(found: usize, n: usize, at: &str) -> Result<(), Fault> {
    if found == n {
        return Ok(());
    }
    let message = format!("expected {n} elements, one for each position, found {found}");
    Err(Fault::json(at.to_owned(), message))
}
