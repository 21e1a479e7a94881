//! Clusters of points that are connected by steps of at most a given distance.
//!
//! Points are sorted into a tree of boxes (a k-d tree: every box is split at the median along its longest side). Pairs
//! of boxes are then compared. A comparison has three possible results:
//!
//! ```text
//!    +-----+        +---+      smallest distance above the limit: nothing to do
//!    |  A  |<------>| B |      largest distance within the limit: all of A and B are one cluster
//!    +-----+        +---+      otherwise: compare the halves of the box with more points
//! ```
//!
//! A grid whose cells are as wide as the given distance would be simpler. However, the cell indices of a grid overflow
//! for tiny distances, and a million points in one cell would need about 10^12 comparisons. In the tree, a box of equal
//! or very close points becomes a cluster immediately, for any number of points. The search only computes differences
//! of coordinates. For nearby points, these differences neither overflow nor lose precision.
//!
//! For the distance 0, [`first_equal`] finds the clusters without a tree.

use mesh::DVec3;
use progress::{Cancelled, Meter, Progress};

use super::equal::first_equal;
use super::union_find::UnionFind;

/// A box with at most this number of points is not split, because comparing all pairs of its points is faster.
const LEAF: usize = 8;
/// The maximum number of points in a box whose halves are processed one after the other. The halves of larger boxes are
/// processed in parallel.
const TASK: usize = 8192;

/// Returns, for each point, the lowest index of a point in the same cluster. A cluster is a set of points that are
/// connected by steps of at most `distance`.
///
/// Two points are one step apart if the rounded length of their difference is at most `distance`. `distance` must be
/// finite and not negative. Positions must be finite, and there must be fewer than 2³² positions.
///
/// # Errors
///
/// Returns [`Cancelled`] if `progress` asks to stop.
pub fn clusters(
    positions: &[DVec3],
    distance: f64,
    progress: &dyn Progress,
) -> Result<Vec<u32>, Cancelled> {
    let n = u32::try_from(positions.len()).expect("ids of a mesh fit 32 bits");
    let meter = Meter::new(progress, "weld", u64::from(n)).every(TASK as u64);
    meter.add(0)?;
    if distance == 0.0 {
        let lowest = first_equal(positions);
        meter.finish()?;
        return Ok(lowest);
    }
    let mut points: Vec<Point> = positions
        .iter()
        .zip(0..)
        .map(|(&at, index)| Point { at, index })
        .collect();
    sort_into_tree(&mut points);
    let search = Search {
        reach: Reach::new(distance),
        sets: UnionFind::new(n),
        meter,
    };
    if !points.is_empty() {
        search.join_within(&Tree::of(&points, &search.reach))?;
    }
    search.meter.finish()?;
    Ok(search.sets.into_lowest())
}

#[derive(Clone, Copy)]
struct Point {
    at: DVec3,
    index: u32,
}

/// Sorts points into the order of the tree. The points are split at the median along the longest side of their box.
/// Both halves are then sorted in the same way.
fn sort_into_tree(points: &mut [Point]) {
    let (min, max) = bounds(points);
    if points.len() <= LEAF || min == max {
        return;
    }
    // The sides of the box are compared by half their length, because the difference of two finite numbers can
    // be infinite.
    let axis = (0.5 * max - 0.5 * min).max_position();
    let n = points.len();
    let middle = n / 2;
    points.select_nth_unstable_by(middle, |p, q| {
        let by_coordinate = p.at[axis].total_cmp(&q.at[axis]);
        by_coordinate.then(p.index.cmp(&q.index))
    });
    let (low, high) = points.split_at_mut(middle);
    run_both(n, || sort_into_tree(low), || sort_into_tree(high));
}

/// Runs the two halves of a task that processes `n` points. The halves run in parallel if `n` is more than [`TASK`].
fn run_both<T: Send>(
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

/// Returns the bounding box of points: the minimum and the maximum of each coordinate.
fn bounds(points: &[Point]) -> (DVec3, DVec3) {
    let start = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    points
        .iter()
        .fold(start, |(min, max), p| (min.min(p.at), max.max(p.at)))
}

/// A box of the tree: the bounding box of some points, which are in the order of the tree.
struct Tree<'p> {
    min: DVec3,
    max: DVec3,
    points: &'p [Point],
    /// Whether the diagonal of the box is at most one step (the given distance) long, so that all points of the box
    /// belong to one cluster.
    is_cluster: bool,
    halves: Option<Box<[Tree<'p>; 2]>>,
}

impl<'p> Tree<'p> {
    fn of(points: &'p [Point], reach: &Reach) -> Self {
        let n = points.len();
        let halves = (n > LEAF).then(|| {
            let (low, high) = points.split_at(n / 2);
            let halves = run_both(n, || Self::of(low, reach), || Self::of(high, reach));
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
            is_cluster: reach.covers(max - min),
            halves,
        }
    }
}

/// Tests whether the difference of two positions is at most one step (the given distance) long.
#[derive(Clone, Copy)]
struct Reach {
    /// A power of two. The distance times this power is near 1, so that the square of the product neither overflows nor
    /// underflows.
    scale: f64,
    /// The square of the scaled distance.
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

    /// Whether the length of `difference` is at most one step (the given distance). If the result is true for one
    /// difference, the result is also true for every difference whose coordinates have smaller absolute values.
    fn covers(&self, difference: DVec3) -> bool {
        (self.scale * difference).length_squared() <= self.squared
    }
}

/// The search for clusters by comparison of boxes.
struct Search<'a> {
    reach: Reach,
    sets: UnionFind,
    meter: Meter<'a>,
}

impl Search<'_> {
    /// Joins the sets of any two points of a box that are connected by steps, directly or through other points of the
    /// box. A step is at most as long as the given distance.
    fn join_within(&self, tree: &Tree) -> Result<(), Cancelled> {
        if let (false, Some([a, b])) = (tree.is_cluster, tree.halves.as_deref()) {
            let (low, high) = run_both(
                tree.points.len(),
                || self.join_within(a),
                || self.join_within(b),
            );
            low.and(high)?;
            self.join_between(a, b);
            return Ok(());
        }
        if tree.is_cluster {
            self.join_all(tree, tree.points[0]);
        } else {
            for (i, p) in tree.points.iter().enumerate() {
                self.join_near(&tree.points[..i], *p);
            }
        }
        self.meter.add(tree.points.len())
    }

    /// Joins the sets of two points if one of them is in `a`, the other is in `b`, and they are at most one step apart.
    fn join_between(&self, a: &Tree, b: &Tree) {
        let gap = (b.min - a.max).max(a.min - b.max).max(DVec3::ZERO);
        if !self.reach.covers(gap) {
            return;
        }
        let (p, q) = (a.points[0], b.points[0]);
        let are_clusters = a.is_cluster && b.is_cluster;
        if are_clusters && self.sets.root(p.index) == self.sets.root(q.index) {
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
                self.join_between(low, b);
                self.join_between(high, b);
            }
            (_, Some([low, high])) => {
                self.join_between(a, low);
                self.join_between(a, high);
            }
            _ => {
                for p in a.points {
                    self.join_near(b.points, *p);
                }
            }
        }
    }

    /// Joins the set of `q` with the sets of all points of a box. The caller must know that these points belong to the
    /// cluster of `q`.
    fn join_all(&self, tree: &Tree, q: Point) {
        for p in tree.points {
            self.sets.join(p.index, q.index);
        }
    }

    /// Joins the set of `q` with the set of each of the `points` that is at most one step away from `q`.
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

    /// Computes clusters by comparing all pairs until nothing changes.
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

    /// Returns pseudo-random points in the cube [0, 1)³.
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
    fn a_million_close_points_become_one_cluster_quickly() {
        let equal = vec![DVec3::splat(0.1); 1_000_000];
        assert!(clustered(&equal, 0.0).iter().all(|&low| low == 0));
        // There are two groups of points. In the first case, the gap between the groups is smaller than the given
        // distance; in the second case, it is larger.
        for (apart, expected) in [(0.9, 1), (1.1, 2)] {
            let mut groups: Vec<DVec3> = noise(200_000).iter().map(|&p| p * 1e-3).collect();
            for p in &mut groups[100_000..] {
                p.x += apart;
            }
            let lowest = clustered(&groups, 1.0);
            let roots = (0..).zip(&lowest).filter(|&(v, &low): &(u32, _)| v == low);
            assert_eq!(roots.count(), expected);
        }
    }

    #[test]
    fn a_chain_is_one_cluster_with_its_lowest_number() {
        let chain: Vec<DVec3> = (0..10_000).rev().map(|i| DVec3::X * f64::from(i)).collect();
        assert!(clustered(&chain, 1.0).iter().all(|&low| low == 0));
        let apart = clustered(&chain, 0.999);
        assert!((0..).zip(apart).all(|(v, low): (u32, u32)| v == low));
    }

    #[test]
    fn distance_zero_joins_equal_positions_only() {
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
    fn points_at_exactly_the_distance_are_joined_at_any_scale() {
        for size in [1e-300_f64, 1e-160, 1e-3, 1.0, 1e160, 1e300] {
            // `unit` is a power of two, so its products with 3, 4 and 5 are exact.
            let unit = f64::from_bits(size.to_bits() >> 52 << 52);
            let points = [DVec3::ZERO, DVec3::new(3.0, 4.0, 0.0) * unit];
            assert_eq!(clustered(&points, 5.0 * unit), [0, 0], "{size}");
            assert_eq!(clustered(&points, 4.99 * unit), [0, 1], "{size}");
        }
    }

    #[test]
    fn clusters_are_the_same_for_any_number_of_threads() {
        let points = noise(100_000);
        // Above a certain distance, most points of this cloud merge into one cluster. One of the tested distances is
        // near this limit.
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
    fn a_cancelled_search_returns_an_error() {
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
        fn two_points_are_joined_if_and_only_if_they_are_within_the_distance(
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
                // The other points are far away from the first two points, and only make the tree deeper.
                points.extend(noise(others).iter().map(|&p| a + 1e4 * (p + 1.0)));
                // Skips cases in which the rounding of large coordinates could move a point by more than 1 % of the
                // distance.
                prop_assume!(offset.abs() * 1e-15 < 0.01 * distance);
                let lowest = clustered(&points, distance);
                prop_assert_eq!(lowest[1] == 0, near);
            }
        }

        #[test]
        fn clusters_equal_those_of_all_pairs(
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
