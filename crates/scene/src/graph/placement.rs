//! The placement of a node in the space of its parent.

use glam::{DAffine3, DMat3, DMat4, DQuat, DVec3};

/// The placement of a node in the space of its parent. The numbers are stored exactly as in the file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Placement {
    /// An affine matrix in column-major order. The last row is 0, 0, 0, 1.
    Matrix([f64; 16]),
    /// A scale, then a rotation, then a translation.
    Parts {
        /// The translation along x, y and z.
        translation: [f64; 3],
        /// The rotation as a quaternion x, y, z, w. The quaternion is normalized when it is used.
        rotation: [f64; 4],
        /// The scale along x, y and z.
        scale: [f64; 3],
    },
}

impl Default for Placement {
    fn default() -> Self {
        Self::IDENTITY
    }
}

impl Placement {
    /// The placement that leaves every point where it is.
    pub const IDENTITY: Self = Self::Parts {
        translation: [0.0; 3],
        rotation: [0.0, 0.0, 0.0, 1.0],
        scale: [1.0; 3],
    };

    /// To check the split of a map into scale, rotation and translation, these parts are composed into a matrix again.
    /// `TOLERANCE` is the largest allowed difference from the matrix of the map, relative to the largest number in that
    /// matrix.
    const TOLERANCE: f64 = 1e-12;

    /// Returns the map from the space of the node to the space of its parent. The map contains infinite numbers or NaN
    /// if a number of the placement is infinite or NaN, or if all numbers of the rotation are 0.
    pub fn to_affine(self) -> DAffine3 {
        match self {
            Self::Matrix(matrix) => DAffine3::from_mat4(DMat4::from_cols_array(&matrix)),
            Self::Parts {
                translation,
                rotation,
                scale,
            } => {
                let rotation = DQuat::from_array(rotation);
                // Files store rotations as 32-bit numbers, so the length of the quaternion is only approximately 1.
                let length = rotation.length();
                let rotation = DQuat::from_array(rotation.to_array().map(|x| x / length));
                DAffine3::from_scale_rotation_translation(
                    DVec3::from_array(scale),
                    rotation,
                    DVec3::from_array(translation),
                )
            }
        }
    }

    /// Returns the scale, the rotation and the translation of a map. Returns `None` if the map has a shear, is singular
    /// or is not finite.
    pub fn of(map: &DAffine3) -> Option<Self> {
        if map.matrix3 == DMat3::IDENTITY {
            return map.translation.is_finite().then_some(Self::Parts {
                translation: map.translation.to_array(),
                rotation: [0.0, 0.0, 0.0, 1.0],
                scale: [1.0; 3],
            });
        }
        let (scale, rotation, translation) = map.to_scale_rotation_translation();
        let parts = Self::Parts {
            translation: translation.to_array(),
            rotation: rotation.to_array(),
            scale: scale.to_array(),
        };
        let back = parts.to_affine();
        let [largest, difference] = [map.matrix3, back.matrix3 - map.matrix3].map(|matrix| {
            let numbers = matrix.to_cols_array().map(f64::abs);
            numbers
                .into_iter()
                .fold(0.0, |a: f64, b| if a > b { a } else { b })
        });
        let is_same =
            map.is_finite() && back.is_finite() && difference <= Self::TOLERANCE * largest;
        is_same.then_some(parts)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_of_a_map_give_the_map_again_and_a_shear_has_none() {
        let turn = DQuat::from_xyzw(0.1, 0.7, -0.3, 0.5).normalize();
        let shift = DVec3::new(1.0, -2.0, 0.25);
        for scale in [
            DVec3::ONE,
            DVec3::new(2.0, 0.5, 3.0),
            DVec3::new(-1.0, 1.0, 1.0),
        ] {
            let map = DAffine3::from_scale_rotation_translation(scale, turn, shift);
            let back = Placement::of(&map).unwrap().to_affine();
            assert!(back.abs_diff_eq(map, 1e-14), "{scale}");
        }
        let turned = DAffine3::from_quat(turn);
        let shear = DAffine3::from_scale(DVec3::new(1.0, 3.0, 1.0)) * turned;
        assert_eq!(Placement::of(&shear), None);
        assert_eq!(Placement::of(&DAffine3::from_translation(DVec3::NAN)), None);
        let moved = DAffine3::from_translation(shift);
        assert_eq!(Placement::of(&moved).unwrap().to_affine(), moved);
    }
}
