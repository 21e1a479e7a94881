//! Alpha compositing in integers, so that the result is the same on every processor.

/// Returns the color that results if the first color is drawn over the color `under`. Both colors have straight alpha:
/// their channels are not multiplied by alpha.
pub(crate) fn over([r, g, b, a]: [u8; 4], under: [u8; 4]) -> [u8; 4] {
    blended([r, g, b].map(|c| u32::from(c) * u32::from(a)), a, under)
}

/// Returns the result of drawing the color `over` on top of the color `under`. `over` has premultiplied alpha and
/// channels from 0 to 255 * 255; `under` has straight alpha. Let s and S be the alpha and the color of `over`, and let
/// d and D be the alpha and the color of `under`. The result has the alpha a = s + d (1 - s) and the color (S s + D d
/// (1 - s)) / a (Porter and Duff, "Compositing digital images", 1984).
pub(crate) fn blended(over: [u32; 3], alpha: u8, under: [u8; 4]) -> [u8; 4] {
    let s = u32::from(alpha);
    // Alphas are in units of 1/255. Products of two alphas are in units of 1/(255 * 255).
    let rest = u32::from(under[3]) * (255 - s);
    let sum = s * 255 + rest;
    if sum == 0 {
        return [0; 4];
    }
    let to_byte = |x: u32| u8::try_from(x).unwrap_or(u8::MAX);
    let channel = |i: usize| to_byte((over[i] * 255 + u32::from(under[i]) * rest + sum / 2) / sum);
    [
        channel(0),
        channel(1),
        channel(2),
        to_byte((sum + 127) / 255),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colors_are_composited_by_the_over_operator_of_porter_and_duff() {
        let below = [10, 20, 30, 255];
        assert_eq!(over([90, 90, 90, 0], below), below);
        assert_eq!(over([1, 2, 3, 255], below), [1, 2, 3, 255]);
        assert_eq!(over([200, 100, 50, 128], [0; 4]), [200, 100, 50, 128]);
        assert_eq!(over([9, 9, 9, 0], [9, 9, 9, 0]), [0; 4]);
        // Half-transparent black over white gives gray. If half-transparent black is drawn over half-transparent black,
        // the alpha of the result is 1 - 1/2 * 1/2.
        assert_eq!(over([0, 0, 0, 128], [255; 4]), [127, 127, 127, 255]);
        assert_eq!(over([0, 0, 0, 128], [0, 0, 0, 128])[3], 192);
    }

    #[test]
    fn every_pair_of_alphas_is_composited_to_the_nearest_byte() {
        for s in 0..=255 {
            for d in 0..=255 {
                let [r, g, _, a] = over([200, 0, 0, s], [100, 255, 0, d]);
                let exact = 255.0 - f64::from(255 - s) * f64::from(255 - d) / 255.0;
                assert!((f64::from(a) - exact).abs() <= 0.51);
                if a > 0 {
                    assert!((100..=200).contains(&r), "{s} {d}");
                    let rest = f64::from(d) * (1.0 - f64::from(s) / 255.0) / exact;
                    assert!((f64::from(g) - 255.0 * rest).abs() <= 0.51);
                }
            }
        }
    }
}
