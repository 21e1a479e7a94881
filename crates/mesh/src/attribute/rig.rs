//! The names of the vertex attributes that deform a mesh: weights of joints, and deltas of morph targets.
//!
//! For each vertex, the attribute `joint:j` has the weight of joint j of the skin. The attribute `morph:t` has the
//! vector by which morph target t moves the vertex. The rule of both attributes is
//! [`Rule::Interpolate`](crate::Rule::Interpolate). Therefore, an edit that averages positions averages the weights and
//! deltas in the same way. Each joint has a separate attribute, because lists of joints at the vertices could not be
//! interpolated.
//!
//! The attribute `morph_normal:t` has the normals of the vertices or corners when morph target t has the weight 1. The
//! values are the normals themselves, not their differences from the normals of the mesh. Like all normals, they follow
//! the rule [`Rule::Normal`](crate::Rule::Normal).
//!
//! The attribute `morph_tangent:t` has the tangents of the corners when morph target t has the weight 1. Its rule, and
//! the sign in the fourth number of each value, are the same as in [`CORNER_TANGENT`](crate::CORNER_TANGENT).
//!
//! The attribute `morph_uv:t` has the changes that morph target t makes to the attribute `uv` if the weight of the
//! target is 1. In the same way, `morph_uv1:t` belongs to `uv1`, and `morph_color:t` to `color`. Like `morph:t`, these
//! attributes store differences and follow the rule [`Rule::Interpolate`](crate::Rule::Interpolate).

use super::{Attributes, Values};
use crate::{COLOR, DVec3, Domain, UV};

const JOINT: &str = "joint:";
const MORPH: &str = "morph:";
const MORPH_NORMAL: &str = "morph_normal:";
const MORPH_TANGENT: &str = "morph_tangent:";
/// The names of attributes that store changes of texture coordinates or colors begin with this prefix. The prefix is
/// followed by the name of the changed attribute, a colon and the number of the morph target.
const MORPH_VALUE: &str = "morph_";

/// Returns the name of the attribute that stores the weights of a joint. The attribute has one `f64` for each vertex.
pub fn joint_name(joint: usize) -> String {
    format!("{JOINT}{joint}")
}

/// Returns the name of the attribute that stores the deltas of a morph target. The attribute has one vector for each
/// vertex.
pub fn morph_name(target: usize) -> String {
    format!("{MORPH}{target}")
}

/// Returns the name of the attribute that stores the normals of the mesh when a morph target has the weight 1.
pub fn morph_normal_name(target: usize) -> String {
    format!("{MORPH_NORMAL}{target}")
}

/// Returns the name of the attribute that stores the tangents of the mesh when a morph target has the weight 1.
pub fn morph_tangent_name(target: usize) -> String {
    format!("{MORPH_TANGENT}{target}")
}

/// A morph target can change texture coordinates and colors. The changes are stored in an attribute of their own; this
/// function returns its name. The parameter `changed` is the name of the attribute that the morph target changes.
pub fn morph_value_name(changed: &str, target: usize) -> String {
    format!("{MORPH_VALUE}{changed}:{target}")
}

/// If an attribute with this name stores the weights of a joint, returns the joint; otherwise, returns `None`.
pub fn joint_of(name: &str) -> Option<usize> {
    number(name.strip_prefix(JOINT)?)
}

/// If an attribute with this name stores the deltas of a morph target, returns the morph target; otherwise, returns
/// `None`.
pub fn morph_of(name: &str) -> Option<usize> {
    number(name.strip_prefix(MORPH)?)
}

/// If an attribute with this name stores the normals of a morph target, returns the morph target; otherwise, returns
/// `None`.
pub fn morph_normal_of(name: &str) -> Option<usize> {
    number(name.strip_prefix(MORPH_NORMAL)?)
}

/// If an attribute with this name stores the tangents of a morph target, returns the morph target; otherwise, returns
/// `None`.
pub fn morph_tangent_of(name: &str) -> Option<usize> {
    number(name.strip_prefix(MORPH_TANGENT)?)
}

/// If an attribute with this name stores changes of texture coordinates or colors, returns two values: the name of the
/// changed attribute, and the number of the morph target. For example, `morph_uv1:2` gives `uv1` and 2. Returns `None`
/// for any other name.
pub fn morph_value_of(name: &str) -> Option<(&str, usize)> {
    let (changed, target) = name.strip_prefix(MORPH_VALUE)?.split_once(':')?;
    let has_changes = changed == COLOR.name || uv_set(changed).is_some();
    Some((changed, number(target).filter(|_| has_changes)?))
}

/// If an attribute with this name stores texture coordinates, returns the index of the set: 0 for `uv`, 1 for `uv1`,
/// and so on. Returns `None` for any other name.
pub fn uv_set(name: &str) -> Option<u32> {
    match name.strip_prefix(UV.name)? {
        "" => Some(0),
        digits => u32::try_from(number(digits)?).ok().filter(|&set| set > 0),
    }
}

/// Whether an attribute with this name stores normals or tangents of a morph target.
pub fn is_morph_direction(name: &str) -> bool {
    morph_normal_of(name).or(morph_tangent_of(name)).is_some()
}

/// Whether this is the name of an attribute of a joint or a morph target.
pub fn is_rig_name(name: &str) -> bool {
    let numbers = [joint_of, morph_of, morph_normal_of, morph_tangent_of];
    numbers.iter().any(|number| number(name).is_some()) || morph_value_of(name).is_some()
}

/// Parses a number that is written without leading zeros; `None` for any other text.
fn number(digits: &str) -> Option<usize> {
    let n: u32 = digits.parse().ok()?;
    (n.to_string() == digits).then_some(n as usize)
}

impl Attributes {
    /// Returns the joints that have weights, in ascending order. Each joint has a list with the weight of each vertex.
    pub fn joints(&self) -> Vec<(usize, &[f64])> {
        let columns = self.of(Domain::Vertex).iter();
        let joints = columns.filter_map(|column| match &column.values {
            Values::Float(values) => Some((joint_of(&column.name)?, &values[..])),
            _ => None,
        });
        let mut joints: Vec<_> = joints.collect();
        joints.sort_unstable_by_key(|(joint, _)| *joint);
        joints
    }

    /// Returns the morph targets in ascending order. Each target has a list with the delta of each vertex.
    pub fn morphs(&self) -> Vec<(usize, &[DVec3])> {
        let columns = self.of(Domain::Vertex).iter();
        let morphs = columns.filter_map(|column| match &column.values {
            Values::Vec3(values) => Some((morph_of(&column.name)?, &values[..])),
            _ => None,
        });
        let mut morphs: Vec<_> = morphs.collect();
        morphs.sort_unstable_by_key(|(target, _)| *target);
        morphs
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_have_one_form() {
        for n in [0, 7, 10, 65535] {
            assert_eq!(joint_of(&joint_name(n)), Some(n));
            assert_eq!(morph_of(&morph_name(n)), Some(n));
            assert_eq!(morph_normal_of(&morph_normal_name(n)), Some(n));
            assert_eq!(morph_tangent_of(&morph_tangent_name(n)), Some(n));
            for changed in ["uv", "uv1", "uv12", "color"] {
                let name = morph_value_name(changed, n);
                assert_eq!(morph_value_of(&name), Some((changed, n)));
                assert!(is_rig_name(&name));
            }
        }
        for name in [
            "morph_uv",
            "morph_uv0:1",
            "morph_uv01:1",
            "morph_uv:01",
            "morph_color1:0",
            "morph_:0",
            "morph_normal:0",
            "uv:0",
        ] {
            assert_eq!(morph_value_of(name), None, "{name}");
        }
        for name in [
            "joint:", "joint:01", "joint:+1", "joint:-1", "morph:0", "joint", "joint:a",
        ] {
            assert_eq!(joint_of(name), None, "{name}");
        }
        assert_eq!(morph_of("morph:99999999999"), None);
        assert_eq!(morph_of("morph_normal:1"), None);
    }
}
