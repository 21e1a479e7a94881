//! Finds places for the labels of points where they hide little.

use glam::DVec2;

/// What labels keep away from.
#[derive(Clone, Debug, Default)]
pub(crate) struct Placing {
    /// Lines that are drawn.
    pub(crate) segments: Vec<[DVec2; 2]>,
    /// Points that are drawn, and how large.
    pub(crate) discs: Vec<(DVec2, f64)>,
    /// Labels that have their place: the middle and half of the size.
    pub(crate) boxes: Vec<[DVec2; 2]>,
    /// The corners of what is seen.
    pub(crate) area: [DVec2; 2],
}

/// How many directions are tried.
const DIRECTIONS: u32 = 24;

/// The distances from the point that are tried, in pixels.
const DISTANCES: [f64; 3] = [3.0, 8.0, 15.0];

impl Placing {
    /// The middle of a label of this size for the point `place` with this radius: where it hides least, if
    /// possible in the direction `outward`. The place is then taken.
    pub(crate) fn place(
        &mut self,
        place: DVec2,
        radius: f64,
        size: DVec2,
        outward: DVec2,
    ) -> DVec2 {
        let half = size / 2.0;
        let outward = outward.normalize_or_zero();
        let mut best = (f64::INFINITY, place);
        for (further, distance) in (0..).zip(DISTANCES) {
            for i in 0..DIRECTIONS {
                let angle = f64::from(i) / f64::from(DIRECTIONS) * std::f64::consts::TAU;
                let (sin, cos) = libm::sincos(angle);
                let way = DVec2::new(cos, sin);
                // From the middle of the label to its edge.
                let inside = (half / way.abs()).min_element();
                let middle = place + way * (radius + distance + inside);
                let cost =
                    self.cost(middle, half) + f64::from(further) * 8.0 - way.dot(outward) * 6.0;
                if cost < best.0 {
                    best = (cost, middle);
                }
            }
        }
        self.boxes.push([best.1, half]);
        best.1
    }

    /// How much a label hides there: pixels of lines, and more for points and other labels.
    fn cost(&self, middle: DVec2, half: DVec2) -> f64 {
        let around = half + DVec2::splat(2.0);
        let segments = self.segments.iter();
        let lines: f64 = segments.map(|&s| length_inside(s, middle, around)).sum();
        let near = |&&(p, radius): &&(DVec2, f64)| {
            ((p - middle).abs() - half).max(DVec2::ZERO).length() < radius + 1.0
        };
        let points = self.discs.iter().filter(near).count() as f64;
        let shared = |[other, half_other]: &[DVec2; 2]| {
            let shared = (around + *half_other - (middle - *other).abs()).max(DVec2::ZERO);
            shared.x * shared.y
        };
        let labels: f64 = self.boxes.iter().map(shared).sum();
        let [low, high] = self.area;
        let outside = (low - (middle - half))
            .max(middle + half - high)
            .max(DVec2::ZERO);
        lines + points * 40.0 + labels * 4.0 + (outside.x + outside.y) * 100.0
    }
}

/// How much of a segment lies in the box around `middle` (Liang and Barsky, "A new concept and method for line
/// clipping", 1984).
fn length_inside([a, b]: [DVec2; 2], middle: DVec2, half: DVec2) -> f64 {
    let (start, way) = (a - middle, b - a);
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for axis in 0..2 {
        let (p, d, h) = (start[axis], way[axis], half[axis]);
        if d == 0.0 {
            if p.abs() > h {
                return 0.0;
            }
            continue;
        }
        let (enter, leave) = ((-h - p) / d, (h - p) / d);
        from = from.max(enter.min(leave));
        to = to.min(enter.max(leave));
    }
    (to - from).max(0.0) * way.length()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_length_inside_a_box_is_that_of_the_part_inside() {
        let half = DVec2::new(2.0, 1.0);
        let inside =
            |a: [f64; 2], b: [f64; 2]| length_inside([a.into(), b.into()], DVec2::ZERO, half);
        assert!((inside([-5.0, 0.0], [5.0, 0.0]) - 4.0).abs() < 1e-12);
        assert!((inside([0.0, 0.0], [0.0, 5.0]) - 1.0).abs() < 1e-12);
        assert_eq!(inside([-5.0, 2.0], [5.0, 2.0]), 0.0);
        assert_eq!(inside([1.0, 0.5], [1.0, 0.5]), 0.0);
        assert!((inside([-3.0, -3.0], [3.0, 3.0]) - 8.0_f64.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn labels_keep_away_from_lines_and_from_each_other() {
        let mut placing = Placing {
            segments: vec![[DVec2::new(-50.0, 0.0), DVec2::new(50.0, 0.0)]],
            area: [DVec2::splat(-60.0), DVec2::splat(60.0)],
            ..Placing::default()
        };
        let size = DVec2::new(20.0, 10.0);
        let first = placing.place(DVec2::ZERO, 4.0, size, DVec2::Y);
        let second = placing.place(DVec2::ZERO, 4.0, size, DVec2::Y);
        assert!(first.y > 5.0 && second.y.abs() > 5.0);
        let apart = (first - second).abs();
        assert!(apart.x >= 20.0 || apart.y >= 10.0, "{first} {second}");
    }

    #[test]
    fn labels_stay_inside() {
        let mut placing = Placing {
            area: [DVec2::ZERO, DVec2::splat(100.0)],
            ..Placing::default()
        };
        let middle = placing.place(DVec2::splat(99.0), 4.0, DVec2::splat(20.0), DVec2::ONE);
        assert!(middle.max_element() <= 90.0);
    }
}
