//! Patches, random numbers and assertions for the tests of this crate.

use glam::DVec3;

use crate::Patch;

/// The length of the first and last leg of a cubic that approximates a quarter of the unit circle.
const KAPPA: f64 = 0.552_284_749_830_793_4;

/// A linear congruential generator (Knuth's MMIX constants).
pub(crate) struct Lcg(u64);

impl Lcg {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// Returns a random number from 0 to 1.
    pub(crate) fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005);
        self.0 = self.0.wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Returns a random point in the cube from -1 to 1.
    pub(crate) fn point(&mut self) -> DVec3 {
        let mut coordinate = || 2.0 * self.unit() - 1.0;
        DVec3::new(coordinate(), coordinate(), coordinate())
    }

    /// Returns a patch with random control points.
    pub(crate) fn patch(&mut self) -> Patch {
        Patch::new([(); 4].map(|()| [(); 4].map(|()| self.point()))).unwrap()
    }
}

/// Returns the patch that a profile curve sweeps in a quarter turn about the z axis. The profile is a cubic, and its
/// control points are given as (radius, height). u runs around the axis, and v along the profile.
pub(crate) fn quarter_turn(profile: [[f64; 2]; 4]) -> Patch {
    let arc = [[1.0, 0.0], [1.0, KAPPA], [KAPPA, 1.0], [0.0, 1.0]];
    Patch::new(profile.map(|[r, z]| arc.map(|[x, y]| DVec3::new(r * x, r * y, z)))).unwrap()
}

/// Returns an eighth of a sphere: the row at v = 1 is the north pole, and normals point outward.
pub(crate) fn octant() -> Patch {
    quarter_turn([[1.0, 0.0], [1.0, KAPPA], [KAPPA, 1.0], [0.0, 1.0]])
}

/// Returns the patch x = u², y = v², z = x y. At the corner (0, 0), both derivatives are zero. The derivatives across
/// the edges u = 0 and v = 0 are zero. No edge is collapsed. The normal is (-y, -x, 1), normalized.
pub(crate) fn squared() -> Patch {
    // The control points of the function t², written as a cubic.
    let square = [0.0, 0.0, 1.0 / 3.0, 1.0];
    Patch::new(square.map(|y| square.map(|x| DVec3::new(x, y, x * y)))).unwrap()
}

/// Panics if the distance between `a` and `b` exceeds `tolerance` times m, where m is the largest of 1, the length of
/// `a` and the length of `b`.
#[track_caller]
pub(crate) fn assert_close(a: DVec3, b: DVec3, tolerance: f64) {
    let size = a.length().max(b.length()).max(1.0);
    assert!(
        (a - b).length() <= tolerance * size,
        "{a} is not close to {b}"
    );
}
