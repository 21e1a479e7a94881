//! Places labels beside points. The labels hide as little of the figure as possible.

use glam::DVec2;

/// The elements of a figure that labels should not hide, and the area for labels.
#[derive(Clone, Debug, Default)]
pub(crate) struct LabelPlacement {
    /// The lines of the figure.
    pub(crate) segments: Vec<[DVec2; 2]>,
    /// The points of the figure, and their radii.
    pub(crate) discs: Vec<(DVec2, f64)>,
    /// The labels that are already placed. Each entry has two vectors: the middle of a label, and half of the label's
    /// width and height.
    pub(crate) boxes: Vec<[DVec2; 2]>,
    /// Two opposite corners of the visible area.
    pub(crate) area: [DVec2; 2],
}

/// The number of directions around the point in which positions for the label are tried.
const DIRECTIONS: u32 = 24;

/// The distances from the point, in pixels, at which positions for the label are tried.
const DISTANCES: [f64; 3] = [3.0, 8.0, 15.0];

impl LabelPlacement {
    /// Places a label with this size beside a dot with this radius at `point`. Returns the middle of the label.
    ///
    /// Chooses the position at which the label hides the least of the figure, and prefers positions in the direction
    /// `outward`. Later labels avoid this label.
    pub(crate) fn place(
        &mut self,
        point: DVec2,
        radius: f64,
        size: DVec2,
        outward: DVec2,
    ) -> DVec2 {
        let half = size / 2.0;
        let outward = outward.normalize_or_zero();
        let mut best = (f64::INFINITY, point);
        for (step, distance) in (0..).zip(DISTANCES) {
            for i in 0..DIRECTIONS {
                let angle = f64::from(i) / f64::from(DIRECTIONS) * std::f64::consts::TAU;
                let (sin, cos) = libm::sincos(angle);
                let direction = DVec2::new(cos, sin);
                // The distance from the middle of the label to the border of the label, along `direction`.
                let inner = (half / direction.abs()).min_element();
                let middle = point + direction * (radius + distance + inner);
                let cost =
                    self.cost(middle, half) + f64::from(step) * 8.0 - direction.dot(outward) * 6.0;
                if cost < best.0 {
                    best = (cost, middle);
                }
            }
        }
        self.boxes.push([best.1, half]);
        best.1
    }

    /// Returns the cost of a label at a position: the length of the lines that the label hides, in pixels. Hidden
    /// points, hidden labels, and parts of the label outside of the visible area add to the cost.
    fn cost(&self, middle: DVec2, half: DVec2) -> f64 {
        let padded = half + DVec2::splat(2.0);
        let segments = self.segments.iter();
        let lines: f64 = segments.map(|&s| length_inside(s, middle, padded)).sum();
        let near = |&&(p, radius): &&(DVec2, f64)| {
            ((p - middle).abs() - half).max(DVec2::ZERO).length() < radius + 1.0
        };
        let points = self.discs.iter().filter(near).count() as f64;
        let overlap_area = |[other, half_other]: &[DVec2; 2]| {
            let overlap = (padded + *half_other - (middle - *other).abs()).max(DVec2::ZERO);
            overlap.x * overlap.y
        };
        let labels: f64 = self.boxes.iter().map(overlap_area).sum();
        let [low, high] = self.area;
        let outside = (low - (middle - half))
            .max(middle + half - high)
            .max(DVec2::ZERO);
        lines + points * 40.0 + labels * 4.0 + (outside.x + outside.y) * 100.0
    }
}

/// Returns the length of a segment after clipping it to the box around `middle` (Liang and Barsky, "A new concept and
/// method for line clipping", 1984).
fn length_inside([a, b]: [DVec2; 2], middle: DVec2, half: DVec2) -> f64 {
    let (start, edge) = (a - middle, b - a);
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for axis in 0..2 {
        let (p, d, h) = (start[axis], edge[axis], half[axis]);
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
    (to - from).max(0.0) * edge.length()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_length_inside_a_box_is_that_of_the_clipped_segment() {
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
    fn labels_overlap_neither_lines_nor_each_other() {
        let mut placement = LabelPlacement {
            segments: vec![[DVec2::new(-50.0, 0.0), DVec2::new(50.0, 0.0)]],
            area: [DVec2::splat(-60.0), DVec2::splat(60.0)],
            ..LabelPlacement::default()
        };
        let size = DVec2::new(20.0, 10.0);
        let first = placement.place(DVec2::ZERO, 4.0, size, DVec2::Y);
        let second = placement.place(DVec2::ZERO, 4.0, size, DVec2::Y);
        assert!(first.y > 5.0 && second.y.abs() > 5.0);
        let apart = (first - second).abs();
        assert!(apart.x >= 20.0 || apart.y >= 10.0, "{first} {second}");
    }

    #[test]
    fn labels_stay_inside_the_visible_area() {
        let mut placement = LabelPlacement {
            area: [DVec2::ZERO, DVec2::splat(100.0)],
            ..LabelPlacement::default()
        };
        let middle = placement.place(DVec2::splat(99.0), 4.0, DVec2::splat(20.0), DVec2::ONE);
        assert!(middle.max_element() <= 90.0);
    }
}
