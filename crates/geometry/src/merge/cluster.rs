//! Which points are connected by steps of at most a distance.
//!
//! Points are sorted into a tree of boxes (a k-d tree: every box is cut at its median along its longest
//! side), and pairs of boxes are compared from the root down:
//!
//! ```text
//!    +-----+        +---+      nearest corners farther than the distance: nothing to do
//!    |  A  |<------>| B |      farthest corners within it: all of A and B are one cluster
//!    +-----+        +---+      otherwise: compare the halves of the larger one
//! ```
//!
//! A grid of cells as wide as the distance would be simpler, but its cell numbers overflow for tiny
//! distances, and a million points in one cell take a million squared comparisons. Here boxes of equal
//! or crowded points are clusters at once, however many points they hold, and only differences of
//! coordinates are ever computed, which neither overflow nor round where it matters.

use mesh::DVec3;
use progress::{Cancelled, Meter, Progress};

use super::union_find::UnionFind;

/// Boxes of at most this many points are not cut: comparing all pairs is faster.
const LEAF: usize = 8;
/// Boxes of fewer points are not worth a task of their own.
const TASK: usize = 8192;

/// For each point the lowest number of its cluster: the points that are connected by steps of at most
/// `distance`, which is finite and not negative.
///
/// Two points are a step apart if the length of their difference, rounded, is at most the distance.
/// Positions must be finite and fewer than 2³².
///
/// # Errors
///
/// [`Cancelled`] if `progress` asks to stop.
pub fn clusters(
    positions: &[DVec3],
    distance: f64,
    progress: &dyn Progress,
) -> Result<Vec<u32>, Cancelled> {
    let n = u32::try_from(positions.len()).expect("ids of a mesh fit 32 bits");
    let meter = Meter::new(progress, "weld", u64::from(n)).every(TASK as u64);
    meter.add(0)?;
    let mut points: Vec<Point> = positions
        .iter()
        .zip(0..)
        .map(|(&at, index)| Point { at, index })
        .collect();
    arrange(&mut points);
    let search = Search {
        reach: Reach::new(distance),
        sets: UnionFind::new(n),
        meter,
    };
    if !points.is_empty() {
        search.within(&Tree::of(&points, &search.reach))?;
    }
    search.meter.finish()?;
    Ok(search.sets.into_lowest())
}

#[derive(Clone, Copy)]
struct Point {
    at: DVec3,
    index: u32,
}

/// Sorts points so that each half, and each half of a half, lies on its side of a median.
fn arrange(points: &mut [Point]) {
    let (min, max) = bounds(points);
    if points.len() <= LEAF || min == max {
        return;
    }
    // Halves, because the difference of two finite numbers may be infinite.
    let axis = (0.5 * max - 0.5 * min).max_position();
    let n = points.len();
    let middle = n / 2;
    points.select_nth_unstable_by(middle, |p, q| {
        let by_coordinate = p.at[axis].total_cmp(&q.at[axis]);
        by_coordinate.then(p.index.cmp(&q.index))
    });
    let (low, high) = points.split_at_mut(middle);
    both(n, || arrange(low), || arrange(high));
}

/// Both halves of some work on `n` points, at once if that is worth a task.
fn both<T: Send>(
    n: usize,
    low: impl FnOnce() -> T + Send,
    high: impl FnOnce() -> T + Send,
) -> (T, T) {
    if n > TASK {
        rayon::join(low, high)
    } else {
        (low(), high())
    }
}

/// The lowest and the highest coordinates.
fn bounds(points: &[Point]) -> (DVec3, DVec3) {
    let start = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    points
        .iter()
        .fold(start, |(min, max), p| (min.min(p.at), max.max(p.at)))
}

/// A box around points that are arranged.
struct Tree<'p> {
    min: DVec3,
    max: DVec3,
    points: &'p [Point],
    /// Whether any two points of the box are a step apart at most.
    is_one: bool,
    halves: Option<Box<[Tree<'p>; 2]>>,
}

impl<'p> Tree<'p> {
    fn of(points: &'p [Point], reach: &Reach) -> Self {
        let n = points.len();
        let halves = (n > LEAF).then(|| {
            let (low, high) = points.split_at(n / 2);
            let halves = both(n, || Self::of(low, reach), || Self::of(high, reach));
            Box::new(<[Self; 2]>::from(halves))
        });
        let (min, max) = match halves.as_deref() {
            Some([a, b]) => (a.min.min(b.min), a.max.max(b.max)),
            None => bounds(points),
        };
        Self {
            min,
            max,
            points,
            is_one: reach.covers(max - min),
            halves,
        }
    }
}

/// Which differences of positions are a step.
#[derive(Clone, Copy)]
struct Reach {
    /// A power of two that brings the distance near 1, so that squares neither overflow nor vanish.
    scale: f64,
    /// The square of the scaled distance; 0 for the distance 0.
    squared: f64,
}

impl Reach {
    fn new(distance: f64) -> Self {
        let exponent = distance.to_bits() >> 52;
        let scale = f64::from_bits(2046_u64.saturating_sub(exponent).max(1) << 52);
        let scaled = distance * scale;
        Self {
            scale,
            squared: scaled * scaled,
        }
    }

    /// Whether the difference is a step. If it is, so is every one with smaller coordinates.
    fn covers(&self, difference: DVec3) -> bool {
        if self.squared == 0.0 {
            // The square of a tiny difference would be 0 too.
            difference == DVec3::ZERO
        } else {
            (self.scale * difference).length_squared() <= self.squared
        }
    }
}

/// The comparison of boxes.
struct Search<'a> {
    reach: Reach,
    sets: UnionFind,
    meter: Meter<'a>,
}

impl Search<'_> {
    /// Joins what is connected inside a box.
    fn within(&self, tree: &Tree) -> Result<(), Cancelled> {
        if let (false, Some([a, b])) = (tree.is_one, tree.halves.as_deref()) {
            let (low, high) = both(tree.points.len(), || self.within(a), || self.within(b));
            low.and(high)?;
            self.between(a, b);
            return Ok(());
        }
        if tree.is_one {
            self.join_all(tree, tree.points[0]);
        } else {
            for (i, p) in tree.points.iter().enumerate() {
                self.join_near(&tree.points[..i], *p);
            }
        }
        self.meter.add(tree.points.len())
    }

    /// Joins what is connected between two boxes.
    fn between(&self, a: &Tree, b: &Tree) {
        let gap = (b.min - a.max).max(a.min - b.max).max(DVec3::ZERO);
        if !self.reach.covers(gap) {
            return;
        }
        let (p, q) = (a.points[0], b.points[0]);
        let are_two = a.is_one && b.is_one;
        if are_two && self.sets.root(p.index) == self.sets.root(q.index) {
            return;
        }
        let span = (b.max - a.min).abs().max((a.max - b.min).abs());
        if self.reach.covers(span) {
            self.join_all(a, q);
            self.join_all(b, p);
            return;
        }
        match (a.halves.as_deref(), b.halves.as_deref()) {
            (Some([low, high]), other) if other.is_none() || a.points.len() >= b.points.len() => {
                self.between(low, b);
                self.between(high, b);
            }
            (_, Some([low, high])) => {
                self.between(a, low);
                self.between(a, high);
            }
            _ => {
                for p in a.points {
                    self.join_near(b.points, *p);
                }
            }
        }
    }

    /// Joins `q` and all points of a box, each of which is a step from it or from one that is.
    fn join_all(&self, tree: &Tree, q: Point) {
        for p in tree.points {
            self.sets.join(p.index, q.index);
        }
    }

    /// Joins `q` and those points that are a step from it.
    fn join_near(&self, points: &[Point], q: Point) {
        for p in points {
            if self.reach.covers(p.at - q.at) {
                self.sets.join(p.index, q.index);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use progress::NoProgress;
    use proptest::prelude::*;

    fn clustered(points: &[DVec3], distance: f64) -> Vec<u32> {
        clusters(points, distance, &NoProgress).unwrap()
    }

    /// The same by comparing all pairs, until nothing changes.
    fn by_all_pairs(points: &[DVec3], distance: f64) -> Vec<u32> {
        let mut lowest: Vec<u32> = (0..).take(points.len()).collect();
        loop {
            let before = lowest.clone();
            for i in 0..points.len() {
                for j in 0..points.len() {
                    if points[i].distance(points[j]) <= distance {
                        lowest[i] = lowest[i].min(lowest[j]);
                    }
                }
            }
            if lowest == before {
                return lowest;
            }
        }
    }

    /// Points of a generator with a seed, in [0, 1) cubed.
    fn noise(n: usize) -> Vec<DVec3> {
        let mut state = 1_u64;
        let mut next = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as f64 / f64::from(1_u32 << 31)
        };
        (0..n).map(|_| DVec3::new(next(), next(), next())).collect()
    }

    #[test]
    fn a_million_crowded_points_are_one_cluster_at_once() {
        let equal = vec![DVec3::splat(0.1); 1_000_000];
        assert!(clustered(&equal, 0.0).iter().all(|&low| low == 0));
        // Two crowds, nearer to each other than the distance, and farther.
        for (apart, expected) in [(0.9, 1), (1.1, 2)] {
            let mut crowds: Vec<DVec3> = noise(200_000).iter().map(|&p| p * 1e-3).collect();
            for p in &mut crowds[100_000..] {
                p.x += apart;
            }
            let lowest = clustered(&crowds, 1.0);
            let roots = (0..).zip(&lowest).filter(|&(v, &low): &(u32, _)| v == low);
            assert_eq!(roots.count(), expected);
        }
    }

    #[test]
    fn a_chain_is_one_cluster_and_its_lowest_number_the_first() {
        let chain: Vec<DVec3> = (0..10_000).rev().map(|i| DVec3::X * f64::from(i)).collect();
        assert!(clustered(&chain, 1.0).iter().all(|&low| low == 0));
        let apart = clustered(&chain, 0.999);
        assert!((0..).zip(apart).all(|(v, low): (u32, u32)| v == low));
    }

    #[test]
    fn distance_zero_links_equal_positions_only() {
        let tiny = f64::MIN_POSITIVE / 4.0;
        let points = [
            DVec3::ZERO,
            DVec3::new(-0.0, 0.0, -0.0),
            DVec3::X * tiny,
            DVec3::splat(f64::MAX),
            DVec3::splat(-f64::MAX),
            DVec3::splat(f64::MAX),
        ];
        assert_eq!(clustered(&points, 0.0), [0, 0, 2, 3, 4, 3]);
        assert_eq!(clustered(&points, tiny), [0, 0, 0, 3, 4, 3]);
        assert_eq!(clustered(&points, f64::MAX), [0, 0, 0, 3, 4, 3]);
        assert!(clustered(&[], 1.0).is_empty());
    }

    #[test]
    fn exact_distances_count_as_near_at_any_size() {
        for size in [1e-300_f64, 1e-160, 1e-3, 1.0, 1e160, 1e300] {
            // Powers of two keep 3, 4, 5 exact.
            let unit = f64::from_bits(size.to_bits() >> 52 << 52);
            let points = [DVec3::ZERO, DVec3::new(3.0, 4.0, 0.0) * unit];
            assert_eq!(clustered(&points, 5.0 * unit), [0, 0], "{size}");
            assert_eq!(clustered(&points, 4.99 * unit), [0, 1], "{size}");
        }
    }

    #[test]
    fn the_number_of_threads_changes_nothing() {
        let points = noise(100_000);
        // Near the distance at which clusters of such a cloud grow together.
        for distance in [0.005, 0.015, 0.02] {
            let with = |threads| {
                let pool = rayon::ThreadPoolBuilder::new()
                    .num_threads(threads)
                    .build()
                    .unwrap();
                pool.install(|| clustered(&points, distance))
            };
            assert_eq!(with(1), with(2));
            assert_eq!(with(1), with(8));
        }
    }

    #[test]
    fn it_stops_when_told_to() {
        struct Stop;
        impl Progress for Stop {
            fn advance(&self, _: &str, done: u64, _: u64) -> bool {
                assert!(done < 50_000);
                done == 0
            }
        }
        let stopped = clusters(&noise(50_000), 1e-3, &Stop);
        assert_eq!(stopped, Err(Cancelled));
    }

    proptest! {
        #[test]
        fn two_points_merge_within_the_distance_wherever_they_lie(
            at in prop::array::uniform3(-10.0..10.0_f64),
            direction in prop::array::uniform3(-1.0..1.0_f64),
            offset in prop::sample::select(vec![0.0, 1e3, -1e9]),
            distance in prop::sample::select(vec![1e-4, 0.03, 0.5, 7.0]),
            others in 0..40_usize,
        ) {
            let direction = DVec3::from_array(direction);
            prop_assume!(direction.length() > 1e-3);
            let direction = direction.normalize();
            let a = DVec3::from_array(at) + offset;
            for (factor, near) in [(0.9, true), (1.1, false)] {
                let mut points = vec![a, a + factor * distance * direction];
                // Far away, only to make the tree deep.
                points.extend(noise(others).iter().map(|&p| a + 1e4 * (p + 1.0)));
                // Rounding of the sum moves a point by less than this.
                prop_assume!(offset.abs() * 1e-15 < 0.01 * distance);
                let lowest = clustered(&points, distance);
                prop_assert_eq!(lowest[1] == 0, near);
            }
        }

        #[test]
        fn clusters_are_those_of_all_pairs(
            points in prop::collection::vec(prop::array::uniform3(0..8_i8), 0..120),
            distance in prop::sample::select(vec![0.0, 0.9, 1.0, 1.5, 2.0, 3.0]),
            flat in any::<bool>(),
            offset in prop::sample::select(vec![0.0, 1e12]),
        ) {
            let points: Vec<DVec3> = points
                .iter()
                .map(|p| {
                    let p = DVec3::from_array(p.map(f64::from));
                    if flat { DVec3::new(p.x, p.y, 0.0) + offset } else { 2.0 * p + offset }
                })
                .collect();
            prop_assert_eq!(clustered(&points, distance), by_all_pairs(&points, distance));
        }
    }
}
