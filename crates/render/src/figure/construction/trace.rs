//! Converts a Bezier curve of any degree to an SVG path. SVG paths support only the degrees 1, 2 and 3.

use bezier::Curve;
use glam::DVec2;

use crate::figure::svg::Command;

/// The maximum distance, in pixels, between the curve and the tested points of a path.
const TOLERANCE: f64 = 0.02;

/// The maximum number of times that the parameter interval is halved.
const MAX_HALVINGS: u32 = 10;

/// Returns the path of a curve whose control points are in pixels.
///
/// For a curve c of degree 3 or less, the path is the curve itself. Otherwise, the path consists of cubic pieces. Each
/// piece starts and ends at points of the curve and has the tangents of the curve there. The piece from the parameter t
/// to t + h has the inner control points c(t) + c'(t) h / 3 and c(t + h) - c'(t + h) h / 3 (Hermite interpolation;
/// Farin, "Curves and Surfaces for CAGD", 5th edition, 2002, §7.5). An interval of the parameter is halved until its
/// piece is near the curve. This is tested at three points: at one quarter, one half and three quarters of the
/// interval.
pub(super) fn trace(curve: &Curve<DVec2>) -> Vec<Command> {
    let points = curve.points();
    let mut path = vec![('M', points[..1].to_vec())];
    match points {
        // A line of length 0 with round caps is drawn as a dot.
        [_] => path.push(('L', points.to_vec())),
        [_, rest @ ..] if rest.len() <= 3 => {
            path.push((['L', 'Q', 'C'][rest.len() - 1], rest.to_vec()));
        }
        _ => path.extend(pieces(curve).iter().map(|piece| ('C', piece.to_vec()))),
    }
    path
}

/// Returns the cubic pieces of a curve, each without its first control point.
fn pieces(curve: &Curve<DVec2>) -> Vec<[DVec2; 3]> {
    let mut pieces = Vec::new();
    // A stack of the remaining intervals. Each entry has the start of an interval and the number of halvings that led
    // to it.
    let mut remaining = vec![(0.0, 0)];
    while let Some((t, halvings)) = remaining.pop() {
        let h = 1.0 / f64::from(1_u32 << halvings);
        let piece = hermite(curve, t, h);
        // An interval is halved at least twice. Without this rule, the test at three points could accept a bad piece of
        // a symmetric curve by chance.
        if halvings >= 2 && (halvings == MAX_HALVINGS || is_near(curve, &piece, t, h)) {
            let [_, b, c, d] = piece;
            pieces.push([b, c, d]);
        } else {
            remaining.push((t + h / 2.0, halvings + 1));
            remaining.push((t, halvings + 1));
        }
    }
    pieces
}

/// Returns the control points of the cubic piece from t to t + h.
fn hermite(curve: &Curve<DVec2>, t: f64, h: f64) -> [DVec2; 4] {
    let [a, d] = [curve.point(t), curve.point(t + h)];
    let [from, to] = [curve.derivative(t), curve.derivative(t + h)].map(|v| v * (h / 3.0));
    [a, a + from, d - to, d]
}

/// Whether a piece is near the curve at three parameters.
fn is_near(curve: &Curve<DVec2>, piece: &[DVec2; 4], t: f64, h: f64) -> bool {
    Curve::new(piece.to_vec()).is_ok_and(|piece| {
        let is_near = |s| piece.point(s).distance(curve.point(t + s * h)) < TOLERANCE;
        [0.25, 0.5, 0.75].into_iter().all(is_near)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns a curve with `n` pseudo-random control points.
    fn curve(n: usize) -> Curve<DVec2> {
        let coordinate = |i: usize| (i * 7919 % 613) as f64;
        let points = (0..n).map(|i| DVec2::new(coordinate(i + 3), coordinate(i * i + 11)));
        Curve::new(points.collect()).unwrap()
    }

    #[test]
    fn pieces_are_connected_and_near_the_curve() {
        for n in [5, 6, 9, 33, 200] {
            let curve = curve(n);
            let mut end = curve.points()[0];
            let mut samples = Vec::new();
            for [b, c, d] in pieces(&curve) {
                let piece = Curve::new(vec![end, b, c, d]).unwrap();
                samples.extend(piece.sample(16));
                end = d;
            }
            assert_eq!(end, *curve.points().last().unwrap());
            // Distances are measured from a fine polyline on the curve, because the distance from a polyline is easy to
            // compute.
            let fine: Vec<DVec2> = curve.sample(20_000).collect();
            let distance = |p: DVec2, a: DVec2, b: DVec2| {
                let edge = b - a;
                let t = ((p - a).dot(edge) / edge.length_squared().max(1e-30)).clamp(0.0, 1.0);
                p.distance(a + edge * t)
            };
            for p in samples.iter().step_by(7) {
                let nearest = fine
                    .windows(2)
                    .map(|pair| distance(*p, pair[0], pair[1]))
                    .fold(f64::MAX, f64::min);
                assert!(nearest < 0.05, "{n} points: {nearest}");
            }
        }
    }

    #[test]
    fn curves_up_to_degree_3_are_one_command() {
        let path_data = |n| {
            let mut svg = crate::figure::Svg::new(1.0, 1.0);
            svg.path(&trace(&curve(n)), &crate::figure::Paint::fill([0; 4]));
            let xml = svg.finish(None);
            let data = xml.split("d=\"").nth(1).unwrap();
            data.split('"').next().unwrap().to_owned()
        };
        let letters = |data: &str| data.replace(|c: char| !c.is_ascii_alphabetic(), "");
        assert_eq!(
            [1, 2, 3, 4].map(path_data).map(|d| letters(&d)),
            ["ML", "ML", "MQ", "MC"]
        );
        assert!(letters(&path_data(5)).starts_with("MCCC"));
    }

    #[test]
    fn the_pieces_of_a_curve_with_equal_control_points_are_this_point() {
        for n in 1..9 {
            let curve = Curve::new(vec![DVec2::ONE; n]).unwrap();
            assert!(pieces(&curve).iter().flatten().all(|p| *p == DVec2::ONE));
        }
    }
}
