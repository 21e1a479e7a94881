//! Curve figure: draws de Casteljau's construction of Bezier curves into a file.
//!
//! ```text
//!      p1 --- o --- p2
//!     /     / * \     \        the control polygon, each level in its color, the point *, the curve;
//!    o ---- o   o ---- o       a panel for each parameter
//!   /                   \
//! p0                     p3
//! ```

use bezier::Curve;
use glam::DVec2;
use op::Operation;
use op::named_object;
use op::prelude::*;
use render::figure::Svg;
use render::figure::construction::{
    Layout, MAX_CONSTRUCTED, MAX_DRAWN, MAX_PANELS, MAX_POINTS, Panel, construction,
};
use scene::{Geometry, Object};

use crate::figure_file;

/// Draws Bezier curves, and de Casteljau's construction of their points, into an image file.
///
/// The figure has one panel for each combination of a curve and a value of `t`. With `by_level`, the figure has one
/// panel for each combination of a curve, a value of `t` and a level of de Casteljau's algorithm. A panel shows the
/// curve, its control polygon, every level of the algorithm in a different color, and the constructed point. Both axes
/// have the same scale. With `by_level`, the panels for a curve and a value of `t` form a sequence. The first panel
/// shows only the first level of the algorithm, and each further panel shows one level more. Only the last of these
/// panels shows the constructed point. The extension of the file determines the format: `.svg` or `.png`. The file is
/// written only if the whole recipe succeeds. The scene does not change.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct CurveFigure {
    /// The file. The path is relative to the output folder. If `name` is a recipe parameter whose value is a file,
    /// `{name.stem}` is replaced by the name of this file without its extension.
    pub path: String,
    /// The curve parameters at which points are constructed, from 0 (start of the curve) to 1 (end). If empty, only the
    /// curves and their control polygons are drawn.
    #[serde(default = "half")]
    pub t: Vec<ClosedFraction>,
    /// Whether each level of the algorithm has its own panel. If false, one panel shows all levels.
    #[serde(default)]
    pub by_level: bool,
    /// The name of another curve, such as an older version of the drawn curve. This other curve is drawn faintly behind
    /// each drawn curve. If both curves have the same degree, an arrow leads from each control point of the other curve
    /// to the same control point of the drawn curve. Control points that have moved by at most 28 SVG pixels have no
    /// arrow.
    #[serde(default)]
    pub before: Option<String>,
    /// The width of the figure in SVG pixels. The font size is 12 pixels in narrow panels and up to 19 pixels in wide
    /// panels.
    #[serde(default = "width")]
    pub width: Count<80, 8192>,
    /// The number of panels in each row. If omitted, each row has one panel for each value of `t`, but at most 4
    /// panels. With `by_level`, each row then has one panel for each level of the curve, but at most 4 panels.
    #[serde(default)]
    pub columns: Option<Count<1, 256>>,
    /// In a `.png` file, each SVG pixel becomes a square of `scale` by `scale` pixels. Has no effect on `.svg` files.
    #[serde(default = "scale")]
    pub scale: Count<1, 8>,
    /// Whether points are labeled with their names.
    #[serde(default = "yes")]
    pub labels: bool,
    /// Whether there is a legend below the panels.
    #[serde(default = "yes")]
    pub legend: bool,
}

fn half() -> Vec<ClosedFraction> {
    vec![ClosedFraction::literal(0.5)]
}

const fn width() -> Count<80, 8192> {
    Count::literal(640)
}

const fn scale() -> Count<1, 8> {
    Count::literal(2)
}

const fn yes() -> bool {
    true
}

impl Operation for CurveFigure {
    const NAME: &'static str = "CurveFigure";
    const SUMMARY: &'static str = "Draw de Casteljau's construction of Bezier curves";
    const EXAMPLE: &'static str = r#"CurveFigure(path: "figure.svg", t: [0.25, 0.5])"#;
    const TAKES_ON: bool = true;

    fn plan(&self, plan: &mut Plan, cx: &PlanContext) -> Vec<Problem> {
        let mut problems = figure_file::plan(&self.path, plan, cx);
        problems.extend(self.plan_curves(plan, cx));
        problems
    }

    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError> {
        cx.advance("draw", 0, 1)?;
        let figure = self.figure(scene, cx)?;
        figure_file::write(&self.path, &figure, self.scale, cx)?;
        cx.advance("draw", 1, 1)?;
        Ok(Report::changed(0))
    }
}

impl CurveFigure {
    /// Returns the problems with the drawn objects, and with the numbers of panels and points.
    fn plan_curves(&self, plan: &Plan, cx: &PlanContext) -> Vec<Problem> {
        let mut problems = Vec::new();
        let before = self.before.as_deref();
        problems.extend(before.and_then(|name| plan.missing(name, ["before"])));
        let limit = if self.t.is_empty() {
            MAX_DRAWN
        } else {
            MAX_CONSTRUCTED
        };
        let (mut n_curves, mut n_panels, mut n_points) = (0, 0, 0_u64);
        for object in plan.objects() {
            let is_before = before == Some(&object.name);
            let is_chosen = match cx.on {
                Some(on) => on.contains(&object.name),
                None => !is_before,
            };
            if !is_chosen && !is_before {
                continue;
            }
            let limit = if is_chosen { limit } else { MAX_DRAWN };
            match object.geometry {
                PlannedGeometry::Curve(points) if points.min > limit as u64 => {
                    let (name, found) = (&object.name, points.min);
                    problems.push(Problem::error(format!(
                        "expected curves of at most {limit} control points, but \"{name}\" has {found}"
                    )));
                }
                PlannedGeometry::Curve(points) if is_chosen => {
                    n_curves += 1;
                    let n_levels = points.min.saturating_sub(1);
                    let n_panels_each = if self.has_levels() {
                        n_levels.max(1)
                    } else {
                        1
                    };
                    let n_new = n_panels_each * self.t.len().max(1) as u64;
                    n_panels += n_new;
                    let points_per_panel = points.min * (points.min + 1) / 2;
                    n_points += points_per_panel * if self.t.is_empty() { 0 } else { n_new };
                }
                PlannedGeometry::Curve(_) => {}
                // A step without `on` draws all curves and ignores all other objects.
                _ if is_chosen && cx.on.is_none() => {}
                _ => {
                    let message = not_a_curve(&object.name, object.geometry.kind());
                    problems.push(Problem::error(message));
                }
            }
        }
        if n_curves == 0 && problems.is_empty() && !plan.incomplete {
            let problem = Problem::error("expected a curve to draw, found none in the scene");
            problems.push(problem.help("load a .bzc file in an earlier step"));
        }
        if n_panels > MAX_PANELS as u64 {
            let message = format!(
                "expected at most {MAX_PANELS} panels in the figure, found {n_panels}: each curve has one panel for each `t`; with `by_level`, it has one panel for each `t` and each level"
            );
            problems.push(Problem::error(message).at(["t"]));
        } else if n_points > MAX_POINTS as u64 {
            let message = format!(
                "expected at most {MAX_POINTS} points in all panels of the figure together, found {n_points}"
            );
            problems.push(Problem::error(message).at(["t"]));
        }
        problems
    }

    /// Whether each level has its own panel.
    fn has_levels(&self) -> bool {
        self.by_level && !self.t.is_empty()
    }

    /// Draws the figure of the curves that the field `on` of the step names. If the step has no `on`, draws all curves.
    fn figure(&self, scene: &Scene, cx: &Context) -> Result<Svg, OpError> {
        let chosen: Vec<&Object> = if let Some(on) = cx.on {
            let objects = on.iter().map(|name| named_object(scene, name));
            objects.collect::<Result<_, _>>()?
        } else {
            let curves = scene.objects().iter();
            let curves = curves.filter(|o| matches!(o.geometry, Geometry::Curve(_)));
            curves
                .filter(|o| self.before.as_ref() != Some(&o.name))
                .collect()
        };
        let before = self
            .before
            .as_ref()
            .map(|name| curve(named_object(scene, name)?));
        let before = before.transpose()?;
        let parameters: Vec<Option<f64>> = if self.t.is_empty() {
            vec![None]
        } else {
            self.t.iter().map(|t| Some(t.get())).collect()
        };
        let mut panels = Vec::new();
        for object in &chosen {
            let curve = curve(object)?;
            let levels: Vec<Option<usize>> = if self.has_levels() {
                (1..=curve.degree().max(1)).map(Some).collect()
            } else {
                vec![None]
            };
            for &t in &parameters {
                panels.extend(levels.iter().map(|&levels| Panel {
                    curve,
                    before,
                    t,
                    levels,
                    title: (chosen.len() > 1).then_some(object.name.as_str()),
                }));
            }
        }
        let n_in_row = if self.has_levels() {
            panels.len() / (parameters.len() * chosen.len()).max(1)
        } else {
            parameters.len()
        };
        let columns = (self.columns).map_or(n_in_row.min(4), |columns| columns.get() as usize);
        let layout = Layout {
            width: f64::from(self.width.get()),
            columns,
            labels: self.labels,
            legend: self.legend,
        };
        construction(&panels, &layout).map_err(|error| OpError::Parameter(error.to_string()))
    }
}

/// Returns the curve of an object.
fn curve(object: &Object) -> Result<&Curve<DVec2>, OpError> {
    match &object.geometry {
        Geometry::Curve(curve) => Ok(curve),
        other => Err(OpError::Object(not_a_curve(&object.name, other.kind()))),
    }
}

fn not_a_curve(name: &str, kind: &str) -> String {
    format!("expected object \"{name}\" to be a curve, found {kind}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use op::{Files, NoProgress, Range};

    fn scene() -> Scene {
        let curve = |points: &[[f64; 2]]| {
            let points = points.iter().map(|&p| p.into()).collect();
            Geometry::Curve(Curve::new(points).unwrap())
        };
        let mut scene = Scene::new();
        for (name, geometry) in [
            ("arch", curve(&[[0.0, 0.0], [0.0, 4.0], [4.0, 4.0]])),
            (
                "wave",
                curve(&[[0.0, 0.0], [2.0, 4.0], [4.0, -4.0], [6.0, 0.0]]),
            ),
            ("lines", Geometry::Polylines(Vec::new())),
        ] {
            scene.insert(Object::new(name, geometry)).unwrap();
        }
        scene
    }

    fn step(parameters: &str) -> CurveFigure {
        op::test::read(parameters).unwrap()
    }

    /// Runs a step, and returns the bytes of the file. The run has a provenance (a line about the origin of its files),
    /// which the step stores in the file.
    fn written(step: &CurveFigure, on: Option<&[String]>, budget: u64) -> Result<Vec<u8>, OpError> {
        let folder = tempfile::tempdir().unwrap();
        let files = Files {
            output: folder.path().into(),
            provenance: Some("meshwright 1, recipe \"a\"".to_owned()),
            ..Files::default()
        };
        let (mut after, before) = (scene(), scene());
        let mut cx = Context::new(&NoProgress, &files);
        cx.on = on;
        cx.budget = budget;
        step.apply(&mut after, &mut cx)?;
        assert_eq!(after, before);
        Ok(std::fs::read(folder.path().join(&step.path)).unwrap())
    }

    #[test]
    fn every_curve_has_a_panel_for_every_parameter() {
        let step = step(r#"(path: "a/b.svg", t: [0.25, 0.5, 1], labels: false, legend: false)"#);
        let text = String::from_utf8(written(&step, None, u64::MAX).unwrap()).unwrap();
        assert_eq!(text.matches("<g id=\"curve\">").count(), 6);
        assert_eq!(text.matches(">arch   <").count(), 3);
        assert!(text.contains("meshwright 1, recipe"));
        let on = ["wave".to_owned()];
        let text = String::from_utf8(written(&step, Some(&on), u64::MAX).unwrap()).unwrap();
        assert_eq!(text.matches("<g id=\"curve\">").count(), 3);
    }

    #[test]
    fn every_level_can_have_a_panel() {
        let step = step(r#"(path: "a.svg", t: [0.25, 0.5], by_level: true, legend: false)"#);
        let on = ["wave".to_owned()];
        let text = String::from_utf8(written(&step, Some(&on), u64::MAX).unwrap()).unwrap();
        assert_eq!(text.matches("<g id=\"curve\">").count(), 6);
        for level in 1..=3 {
            assert_eq!(text.matches(&format!("level {level}<")).count(), 2);
        }
        // The constructed point c(t) is drawn only in the last panel of each row.
        assert_eq!(text.matches("#d52b1e\" stroke").count(), 2, "{text}");
    }

    #[test]
    fn a_png_file_is_scaled_and_has_the_stamp() {
        let bytes = written(&step(r#"(path: "a.PNG", width: 200)"#), None, u64::MAX).unwrap();
        assert_eq!(bytes[..8], *b"\x89PNG\r\n\x1a\n");
        assert_eq!(bytes[16..20], 400_u32.to_be_bytes());
        let stamp = b"Software";
        assert!(bytes.windows(stamp.len()).any(|window| window == stamp));
    }

    #[test]
    fn an_earlier_state_is_drawn_behind_the_curves() {
        let text = |parameters: &str| {
            let bytes = written(&step(parameters), None, u64::MAX).unwrap();
            String::from_utf8(bytes).unwrap()
        };
        let figure = text(r#"(path: "a.svg", before: "arch", t: [])"#);
        assert_eq!(figure.matches("<g id=\"before\">").count(), 1);
        assert!(!figure.contains("c(t)"));
    }

    #[test]
    fn invalid_parameters_are_refused() {
        let error = |parameters: &str, budget| {
            let refused = written(&step(parameters), None, budget);
            refused.unwrap_err().to_string()
        };
        for (parameters, reason) in [
            (r#"(path: "a.gif")"#, "unknown figure format"),
            (r#"(path: "../a.svg")"#, "output folder"),
            (
                r#"(path: "a.svg", before: "lines")"#,
                "expected object \"lines\" to be a curve, found polylines",
            ),
            (
                r#"(path: "a.svg", before: "none")"#,
                "no object is named \"none\"",
            ),
            (
                r#"(path: "a.svg", width: 80, columns: 4, t: [0, 0.5, 1])"#,
                "4 columns",
            ),
        ] {
            assert!(error(parameters, u64::MAX).contains(reason), "{parameters}");
        }
        let message = error(r#"(path: "a.png")"#, 1000);
        assert!(message.contains("memory budget of 1000 bytes"), "{message}");
    }

    #[test]
    fn the_plan_has_a_problem_for_each_invalid_step() {
        let files = Files {
            output: "out".into(),
            ..Files::default()
        };
        let cx = |on| PlanContext {
            files: &files,
            on,
            budget: u64::MAX,
        };
        let good = step(r#"(path: "a.svg")"#);
        assert_eq!(good.plan(&mut Plan::default(), &cx(None)).len(), 1);
        let mut plan = Plan::default();
        plan.insert("a", PlannedGeometry::Curve(Range::exactly(4)));
        plan.insert("many", PlannedGeometry::Curve(Range::exactly(65)));
        plan.insert("lines", PlannedGeometry::Polylines);
        let [a, lines] = [["a".to_owned()], ["lines".to_owned()]];
        assert_eq!(good.plan(&mut plan.clone(), &cx(None)).len(), 1);
        assert_eq!(good.plan(&mut plan.clone(), &cx(Some(&lines))).len(), 1);
        assert_eq!(good.plan(&mut plan, &cx(Some(&a))), []);
        for parameters in [
            r#"(path: "a.svg")"#,
            r#"(path: "b.obj")"#,
            r#"(path: "e.svg", before: "none")"#,
            r#"(path: "f.svg", before: "lines")"#,
            &format!(r#"(path: "g.svg", t: {:?})"#, vec![0.5; 257]),
        ] {
            let problems = step(parameters).plan(&mut plan, &cx(Some(&a)));
            assert_eq!(problems.len(), 1, "{parameters}");
        }
        let many = step(r#"(path: "h.svg", t: [], before: "many")"#);
        assert_eq!(many.plan(&mut plan, &cx(Some(&a))), []);
    }
}
