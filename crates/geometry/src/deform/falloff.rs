//! Weights that decrease with the distance from selected points.

use mesh::{DVec3, parallel};

/// Returns a weight for each point. Let d be the distance of the point from the nearest selected point. The weight is
/// (1 - (d / radius)²)² if d is less than `radius`, and 0 otherwise. Selected points have the weight 1. The weight and
/// its derivative are continuous at the distances 0 and `radius`.
pub fn falloff(points: &[DVec3], is_selected: &[bool], radius: f64) -> Vec<f64> {
    let selected = points.iter().zip(is_selected).filter(|p| *p.1);
    let mut selected: Vec<DVec3> = selected.map(|p| *p.0).collect();
    sort(&mut selected, 0);
    parallel::collect(points.len(), |i| {
        if is_selected[i] {
            return 1.0;
        }
        let square = nearest(&selected, points[i], radius * radius, 0) / (radius * radius);
        if square < 1.0 {
            (1.0 - square) * (1.0 - square)
        } else {
            0.0
        }
    })
}

/// A part of the tree with at most this number of points is not divided further: the search computes the distances to
/// all points of the part.
const LEAF: usize = 16;

/// Sorts points into the order of a balanced k-d tree. The median point along `axis` divides the points in two halves.
/// Each half is then divided in the same way along the next axis. Source: Bentley, "Multidimensional Binary Search
/// Trees Used for Associative Searching", 1975.
fn sort(points: &mut [DVec3], axis: usize) {
    if points.len() > LEAF {
        let middle = points.len() / 2;
        points.select_nth_unstable_by(middle, |a, b| a[axis].total_cmp(&b[axis]));
        let (left, right) = points.split_at_mut(middle);
        sort(left, (axis + 1) % 3);
        sort(&mut right[1..], (axis + 1) % 3);
    }
}

/// Returns the squared distance from `p` to the nearest point of the tree. Returns `best`, which is also a squared
/// distance, if no point of the tree is nearer.
fn nearest(tree: &[DVec3], p: DVec3, best: f64, axis: usize) -> f64 {
    if tree.len() <= LEAF {
        let squares = tree.iter().map(|q| q.distance_squared(p));
        return squares.fold(best, f64::min);
    }
    let middle = tree.len() / 2;
    let (left, right) = (&tree[..middle], &tree[middle + 1..]);
    let offset = p[axis] - tree[middle][axis];
    let (near, far) = if offset < 0.0 {
        (left, right)
    } else {
        (right, left)
    };
    let next = (axis + 1) % 3;
    let best = f64::min(best, tree[middle].distance_squared(p));
    let best = nearest(near, p, best, next);
    if offset * offset < best {
        nearest(far, p, best, next)
    } else {
        best
    }
}
