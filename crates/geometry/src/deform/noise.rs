//! Functions that return numbers that look random but depend only on the arguments. The numbers are computed only with
//! integer operations and basic floating-point operations, which every machine rounds in the same way. The numbers are
//! therefore identical bit for bit on every machine.

use mesh::DVec3;

/// Returns a number from -1 to 1 (excluding 1) for a seed and an index. The numbers come from the generator
/// `SplitMix64` of Steele, Lea, Flood, "Fast Splittable Pseudorandom Number Generators", 2014.
pub fn random(seed: u64, index: u64) -> f64 {
    let bits = mixed(mixed(seed).wrapping_add(index));
    // Keeps 53 bits, because an f64 represents every integer of 53 bits exactly.
    (bits >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

fn mixed(x: u64) -> u64 {
    let x = x.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let x = (x ^ (x >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    x ^ (x >> 31)
}

/// Returns smooth noise from -1 to 1 at a point. The noise is 0 at all points with integer coordinates, and its
/// wavelengths are about 1 to 2 units of these coordinates. The value and its first two derivatives are continuous.
/// Source: Perlin, "Improving Noise", 2002; in contrast to this source, the directions of the gradients depend on a
/// seed.
pub fn gradient(seed: u64, p: DVec3) -> f64 {
    let floor = p.floor();
    let inside = p - floor;
    let t = inside
        .to_array()
        .map(|t| t * t * t * (t * (t * 6.0 - 15.0) + 10.0));
    let mut sum = 0.0;
    for corner in 0..8_u8 {
        let at = DVec3::from_array([0, 1, 2].map(|axis| f64::from(corner >> axis & 1)));
        let weight: f64 = (0..3)
            .map(|i| if at[i] > 0.0 { t[i] } else { 1.0 - t[i] })
            .product();
        sum += weight * slope(seed, floor + at, inside - at);
    }
    sum
}

/// Returns the dot product of two vectors: the offset from a corner of the lattice, and the gradient at this corner.
/// The gradient is one of the twelve vectors from the center of a cube to the midpoints of its edges.
fn slope(seed: u64, corner: DVec3, offset: DVec3) -> f64 {
    // The numbers -0 and 0 have different bits but must give the same gradient. Adding 0 turns -0 into 0.
    let cell = corner.to_array().map(|x| (x + 0.0).to_bits());
    let hash = cell
        .iter()
        .fold(mixed(seed), |hash, &bits| mixed(hash ^ bits));
    let [x, y, z] = offset.to_array();
    let [a, b] = [[x, y], [y, z], [z, x]][(hash % 3) as usize];
    let sign = |bit: u64, value: f64| if hash >> bit & 1 == 0 { value } else { -value };
    sign(60, a) + sign(61, b)
}
