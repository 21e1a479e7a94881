//! Tests of figures of de Casteljau's construction.

use super::*;
use crate::figure::{pixel_size, pixels};
use roxmltree::Document;

fn curve(points: &[[f64; 2]]) -> Curve<DVec2> {
    Curve::new(points.iter().map(|&p| p.into()).collect()).unwrap()
}

fn panel(curve: &Curve<DVec2>, t: impl Into<Option<f64>>) -> Panel<'_> {
    Panel {
        curve,
        before: None,
        t: t.into(),
        levels: None,
        title: None,
    }
}

fn cubic() -> Curve<DVec2> {
    curve(&[[0.0, 0.0], [1.0, 3.0], [4.0, 4.0], [6.0, 0.0]])
}

/// Returns the centers of the circles of a figure.
fn circles(xml: &str) -> Vec<DVec2> {
    let document = Document::parse(xml).unwrap();
    let number = |node: &roxmltree::Node, name: &str| node.attribute(name)?.parse::<f64>().ok();
    document
        .descendants()
        .filter(|node| node.has_tag_name("circle"))
        .map(|node| DVec2::new(number(&node, "cx").unwrap(), number(&node, "cy").unwrap()))
        .collect()
}

/// Computes a point of a curve without de Casteljau's algorithm, as the sum of the control points times the Bernstein
/// polynomials.
fn bernstein(points: &[DVec2], t: f64) -> DVec2 {
    let n = points.len() - 1;
    let power = |x: f64, k: usize| (0..k).fold(1.0, |product, _| product * x);
    let binomial = |i: usize| (0..i).fold(1.0, |b, k| b * (n - k) as f64 / (k + 1) as f64);
    let terms = points.iter().enumerate();
    terms.fold(DVec2::ZERO, |sum, (i, &p)| {
        sum + p * (binomial(i) * power(t, i) * power(1.0 - t, n - i))
    })
}

#[test]
fn every_point_of_every_level_is_drawn_at_its_position() {
    let layout = Layout {
        legend: false,
        labels: false,
        ..Layout::default()
    };
    for curve in [
        cubic(),
        curve(&[[0.0, 0.0], [1.0, 3.0], [3.0, 4.0], [5.0, 1.0], [6.0, 3.0]]),
        curve(&[[7.0, -2.0], [1.0, 1.0]]),
        curve(&[
            [0.0, 0.0],
            [9.0, 1.0],
            [-4.0, 8.0],
            [2.0, 2.0],
            [3.0, 9.0],
            [0.0, 5.0],
        ]),
    ] {
        for t in [0.0, 0.25, 0.5, 0.8125, 1.0] {
            let panel = panel(&curve, t);
            let xml = construction(&[panel], &layout).unwrap().finish(None);
            let drawn = circles(&xml);
            let levels = curve.levels(t);
            assert_eq!(drawn.len(), levels.iter().map(Vec::len).sum::<usize>());
            // Two control points that differ in both coordinates determine the expected scale of the figure.
            let points = curve.points();
            let other = (1..points.len())
                .find(|&i| (points[i] - points[0]).min_element() != 0.0)
                .unwrap();
            let scale = (drawn[other] - drawn[0]) / (points[other] - points[0]);
            assert!((scale.x + scale.y).abs() < 0.01, "{scale}");
            let expected = levels.iter().flatten();
            for (&p, &q) in expected.zip(&drawn) {
                assert!((drawn[0] + (p - points[0]) * scale).distance(q) < 0.01);
            }
            let sum = bernstein(points, t);
            let last = *drawn.last().unwrap();
            assert!((drawn[0] + (sum - points[0]) * scale).distance(last) < 0.01);
        }
    }
}

#[test]
fn a_figure_is_well_formed_and_has_its_provenance() {
    let curve = cubic();
    for title in crate::figure::testing::ODD_TEXTS {
        let panel = Panel {
            title: Some(title),
            before: Some(&curve),
            ..panel(&curve, 0.5)
        };
        let svg = construction(&[panel], &Layout::default()).unwrap();
        let xml = svg.finish(Some("meshwright <1>"));
        let document = Document::parse(&xml).unwrap();
        let metadata = document.descendants().find(|n| n.has_tag_name("metadata"));
        assert_eq!(metadata.unwrap().text(), Some("meshwright <1>"));
        pixels(&svg, 0.5, [255; 4]).unwrap();
    }
}

#[test]
fn degenerate_curves_are_drawn_inside_the_figure() {
    let max = f64::MAX;
    let line: Vec<[f64; 2]> = (0..64).map(|i| [f64::from(i), 0.0]).collect();
    for points in [
        &[[3.0, 4.0]][..],
        &[[3.0, 4.0], [3.0, 4.0]],
        &[[3.0, 4.0]; 7],
        &[
            [max, max],
            [-max, -max],
            [max, -max],
            [0.0, 0.0],
            [1.0, 1.0],
        ],
        &[[5e-324, 0.0], [0.0, 5e-324], [0.0, 0.0]],
        &[
            [1e12, 1e12],
            [1e12 + 1e-3, 1e12],
            [1e12, 1e12 + 1e-3],
            [1e12, 1e12],
        ],
        &[[0.0, 0.0], [1.0, 0.0], [0.0, 0.0], [1.0, 0.0], [0.0, 0.0]],
        &line,
    ] {
        let curve = curve(points);
        for t in [None, Some(0.0), Some(0.3), Some(1.0)] {
            for columns in [1, 3] {
                let panels = vec![panel(&curve, t); 4];
                let layout = Layout {
                    columns,
                    width: 300.0,
                    ..Layout::default()
                };
                let svg = construction(&panels, &layout).unwrap();
                let size = DVec2::new(svg.width, svg.height);
                assert!(size.y > 20.0 && size.y < 2000.0);
                for p in circles(&svg.finish(None)) {
                    assert!(
                        p.cmpgt(DVec2::ZERO).all() && p.cmplt(size).all(),
                        "{p} {size}"
                    );
                }
                pixels(&svg, 1.0, [255; 4]).unwrap();
            }
        }
    }
}

#[test]
fn invalid_panels_and_layouts_are_refused_with_a_reason() {
    let largest = curve(&[[0.0, 1.0]; MAX_CONSTRUCTED]);
    let (curve, too_large) = (cubic(), curve(&[[0.0, 1.0]; MAX_CONSTRUCTED + 1]));
    let default = Layout::default();
    let layout = |width, columns| Layout {
        width,
        columns,
        ..default
    };
    let good = panel(&curve, 0.5);
    for (panels, layout, reason) in [
        (vec![], default, "expected 1 to 256 panels"),
        (vec![good.clone(); MAX_PANELS + 1], default, "found 257"),
        (vec![panel(&curve, 1.5)], default, "from 0 to 1, found 1.5"),
        (vec![panel(&curve, f64::NAN)], default, "found NaN"),
        (
            vec![panel(&too_large, 0.5)],
            default,
            "at most 64 control points, found 65",
        ),
        (
            vec![panel(&largest, 0.5); 32],
            default,
            "at most 65536 points in all panels, found 66560",
        ),
        (
            vec![good.clone()],
            layout(60.0, 1),
            "expected a width from 72 to 8192 pixels for a figure with 1 column",
        ),
        (vec![good.clone()], layout(f64::NAN, 1), "found NaN pixels"),
        (
            vec![good.clone()],
            layout(1e9, 1),
            "found 1000000000 pixels",
        ),
        (vec![good.clone(); 9], layout(300.0, 9), "with 9 columns"),
    ] {
        let error = construction(&panels, &layout).unwrap_err().to_string();
        assert!(error.contains(reason), "{error}");
    }
    construction(&[panel(&too_large, None)], &default).unwrap();
    construction(&vec![good; 3], &layout(640.0, 0)).unwrap();
}

#[test]
fn panels_are_arranged_in_rows_and_columns() {
    let curve = cubic();
    let panels = vec![panel(&curve, 0.5); 5];
    let size = |columns| {
        let layout = Layout {
            columns,
            legend: false,
            ..Layout::default()
        };
        pixel_size(&construction(&panels, &layout).unwrap(), 1.0).unwrap()
    };
    let (width, height) = size(5);
    assert_eq!(width, 640);
    assert!(height < size(2).1 && size(2).1 < size(1).1);
    assert_eq!(size(5), size(99));
}

#[test]
fn points_have_names_if_the_layout_has_labels() {
    let curve = cubic();
    let texts = |labels| {
        let layout = Layout {
            labels,
            legend: false,
            ..Layout::default()
        };
        let xml = construction(&[panel(&curve, 0.5)], &layout)
            .unwrap()
            .finish(None);
        xml.matches("<text").count()
    };
    // The title has one text element. 10 points have a name: 4 control points, 3 + 2 points of levels, and c(t). Each
    // name has two text elements because of its halo.
    assert_eq!((texts(false), texts(true)), (1, 1 + 2 * 10));
}

#[test]
fn the_legend_lists_what_is_drawn() {
    let (curve, point) = (cubic(), curve(&[[1.0, 1.0]]));
    let texts = |panels: &[Panel]| {
        let svg = construction(panels, &Layout::default()).unwrap();
        let xml = svg.finish(None);
        let document = Document::parse(&xml).unwrap();
        let is_legend = |node: &roxmltree::Node| node.attribute("id") == Some("legend");
        let legend = document.descendants().find(is_legend).unwrap();
        let texts = legend
            .descendants()
            .filter(|node| node.has_tag_name("text"));
        let text = |node: roxmltree::Node| -> String {
            (node
                .descendants()
                .filter_map(|n| n.text().filter(|_| n.is_text())))
            .collect()
        };
        let texts: Vec<String> = texts.map(|node| text(node).trim().to_owned()).collect();
        texts[2..].join(", ")
    };
    let with_levels = |curve, levels| Panel {
        levels: Some(levels),
        ..panel(curve, 0.5)
    };
    assert_eq!(texts(&[panel(&curve, None)]), "");
    assert_eq!(texts(&[panel(&curve, 0.5)]), "level 1, level 2, c(t)");
    for (levels, expected) in [
        (0, ""),
        (1, "level 1"),
        (2, "level 1, level 2"),
        (3, "level 1, level 2, c(t)"),
        (9, "level 1, level 2, c(t)"),
    ] {
        assert_eq!(texts(&[with_levels(&curve, levels)]), expected, "{levels}");
    }
    assert_eq!(texts(&[with_levels(&point, 0)]), "c(t)");
    assert_eq!(
        texts(&[with_levels(&curve, 0), with_levels(&curve, 1)]),
        "level 1"
    );
}
