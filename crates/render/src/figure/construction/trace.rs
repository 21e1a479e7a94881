//! A Bezier curve of any degree as a path of SVG, which knows degrees 1, 2 and 3.

use bezier::Curve;
use glam::DVec2;

use crate::figure::svg::Command;

/// A path is no farther from its curve than this, in pixels.
const TOLERANCE: f64 = 0.02;

/// How often the parameter interval is halved at most.
const MAX_HALVINGS: u32 = 10;

/// The path of a curve whose control points are in pixels: the curve itself up to degree 3, else cubic pieces
/// between points of the curve, which have its tangents there.
///
/// A piece from t to t + h takes the inner control points c(t) + c'(t) h / 3 and c(t + h) - c'(t + h) h / 3
/// (Hermite's interpolation; Farin, "Curves and Surfaces for CAGD", 5th edition, 2002, §7.5); an interval is halved
/// until a quarter, the half and three quarters of its piece lie on the curve. An end where the curve stands
/// still is drawn as the point that it is.
pub(super) fn trace(curve: &Curve<DVec2>) -> Vec<Command> {
    let points = curve.points();
    let mut path = vec![('M', points[..1].to_vec())];
    match points {
        // With round ends, a line without length is a dot.
        [_] => path.push(('L', points.to_vec())),
        [_, rest @ ..] if rest.len() <= 3 => {
            path.push((['L', 'Q', 'C'][rest.len() - 1], rest.to_vec()));
        }
        _ => path.extend(pieces(curve).iter().map(|piece| ('C', piece.to_vec()))),
    }
    path
}

/// The pieces of a curve, each without its first point.
fn pieces(curve: &Curve<DVec2>) -> Vec<[DVec2; 3]> {
    let mut pieces = Vec::new();
    // Intervals that are left, the first one last: (start, halvings).
    let mut left = vec![(0.0, 0)];
    while let Some((t, halvings)) = left.pop() {
        let h = 1.0 / f64::from(1_u32 << halvings);
        let piece = hermite(curve, t, h);
        // A whole curve is symmetric too often to trust three points of it.
        if halvings >= 2 && (halvings == MAX_HALVINGS || is_near(curve, &piece, t, h)) {
            let [_, b, c, d] = piece;
            pieces.push([b, c, d]);
        } else {
            left.push((t + h / 2.0, halvings + 1));
            left.push((t, halvings + 1));
        }
    }
    pieces
}

fn hermite(curve: &Curve<DVec2>, t: f64, h: f64) -> [DVec2; 4] {
    let [a, d] = [curve.point(t), curve.point(t + h)];
    let [from, to] = [curve.derivative(t), curve.derivative(t + h)].map(|v| v * (h / 3.0));
    [a, a + from, d - to, d]
}

fn is_near(curve: &Curve<DVec2>, piece: &[DVec2; 4], t: f64, h: f64) -> bool {
    Curve::new(piece.to_vec()).is_ok_and(|piece| {
        let is_near = |s| piece.point(s).distance(curve.point(t + s * h)) < TOLERANCE;
        [0.25, 0.5, 0.75].into_iter().all(is_near)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A curve with this many control points here and there in a picture.
    fn curve(n: usize) -> Curve<DVec2> {
        let place = |i: usize| (i * 7919 % 613) as f64;
        let points = (0..n).map(|i| DVec2::new(place(i + 3), place(i * i + 11)));
        Curve::new(points.collect()).unwrap()
    }

    #[test]
    fn pieces_stay_on_the_curve_and_join() {
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
            // Every sample lies on the curve, which is fine enough a chain of segments here.
            let fine: Vec<DVec2> = curve.sample(20_000).collect();
            let distance = |p: DVec2, a: DVec2, b: DVec2| {
                let way = b - a;
                let along = ((p - a).dot(way) / way.length_squared().max(1e-30)).clamp(0.0, 1.0);
                p.distance(a + way * along)
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
    fn low_degrees_are_the_curves_themselves() {
        let written = |n| {
            let mut svg = crate::figure::Svg::new(1.0, 1.0);
            svg.path(&trace(&curve(n)), &crate::figure::Paint::fill([0; 4]));
            let xml = svg.finish(None);
            let data = xml.split("d=\"").nth(1).unwrap();
            data.split('"').next().unwrap().to_owned()
        };
        let letters = |data: &str| data.replace(|c: char| !c.is_ascii_alphabetic(), "");
        assert_eq!(
            [1, 2, 3, 4].map(written).map(|d| letters(&d)),
            ["ML", "ML", "MQ", "MC"]
        );
        assert!(letters(&written(5)).starts_with("MCCC"));
    }

    #[test]
    fn a_curve_in_one_place_ends() {
        for n in 1..9 {
            let curve = Curve::new(vec![DVec2::ONE; n]).unwrap();
            assert!(pieces(&curve).iter().flatten().all(|p| *p == DVec2::ONE));
        }
    }
}
