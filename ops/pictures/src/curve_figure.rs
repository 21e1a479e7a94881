//! Curve figure: draws de Casteljau's construction of Bezier curves into a file.
//!
//! ```text
//!      p1 --- o --- p2
//!     /     / * \     \        the control polygon, each level in its color, the point *, the curve;
//!    o ---- o   o ---- o       a picture for each parameter
//!   /                   \
//! p0                     p3
//! ```

use std::path::Path;

use bezier::Curve;
use glam::DVec2;
use op::Operation;
use op::named_object;
use op::prelude::*;
use render::figure::construction::{
    Layout, MAX_CONSTRUCTED, MAX_DRAWN, MAX_PANELS, MAX_POINTS, Panel, construction,
};
use render::figure::{Svg, bytes_needed, pixel_size, pixels};
use scene::{Geometry, Object};

/// Draws Bezier curves with the construction of their points, into a file below the output folder.
///
/// For each curve and each `t` there is a picture: the control polygon, every level of de Casteljau's algorithm in
/// its own color, the point, and the curve, with the same scale in both directions. The ending chooses the format:
/// `.svg` or `.png`. The file appears when the whole recipe has succeeded; the scene stays as it is.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct CurveFigure {
    /// The file, seen from the output folder. `{name.stem}` stands for the name, without its ending, of
    /// the file that the parameter `name` of the recipe names.
    pub path: String,
    /// The parameters whose points are constructed, from 0 (start) to 1 (end). Without any, the curves and their
    /// control polygons are drawn alone.
    #[serde(default = "half")]
    pub t: Vec<ClosedFraction>,
    /// A curve that is drawn faintly behind, with arrows from its control points to those that moved: what a curve
    /// was before.
    #[serde(default)]
    pub before: Option<String>,
    /// How wide the figure is: pixels of an SVG, whose letters are 12 to 19 pixels high.
    #[serde(default = "width")]
    pub width: Count<80, 8192>,
    /// How many pictures stand in a row; unless told otherwise those of one curve, at most 4.
    #[serde(default)]
    pub columns: Option<Count<1, 256>>,
    /// How many pixels of a PNG stand for one of an SVG.
    #[serde(default = "scale")]
    pub scale: Count<1, 8>,
    /// Whether points have their names.
    #[serde(default = "yes")]
    pub labels: bool,
    /// Whether the colors are explained below.
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

/// The formats of figures.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
enum Format {
    Svg,
    Png,
}

impl Format {
    fn of(path: &Path) -> Option<Self> {
        let ending = path.extension()?.to_str()?.to_ascii_lowercase();
        match ending.as_str() {
            "svg" => Some(Self::Svg),
            "png" => Some(Self::Png),
            _ => None,
        }
    }
}

impl Operation for CurveFigure {
    const NAME: &'static str = "CurveFigure";
    const SUMMARY: &'static str = "Draw de Casteljau's construction of Bezier curves";
    const EXAMPLE: &'static str = r#"CurveFigure(path: "figure.svg", t: [0.25, 0.5])"#;
    const TAKES_ON: bool = true;

    fn plan(&self, plan: &mut Plan, cx: &PlanContext) -> Vec<Problem> {
        let mut problems = plan.write(cx, &self.path, |path| {
            let unknown = Problem::error(self.no_format()).at(["path"]);
            let help = "endings that can be written: .svg, .png";
            Format::of(path).is_none().then(|| unknown.help(help))
        });
        problems.extend(self.plan_curves(plan, cx));
        problems
    }

    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError> {
        cx.advance("draw", 0, 1)?;
        let failed = |error: &dyn std::fmt::Display| OpError::File(error.to_string());
        let path = cx.files().to_write(&self.path).map_err(|e| failed(&e))?;
        let figure = self.figure(scene, cx)?;
        let stamp = cx.files().provenance.as_deref();
        let bytes = match Format::of(&path) {
            Some(Format::Svg) => figure.finish(stamp).into_bytes(),
            Some(Format::Png) => self.png(&figure, stamp, cx.budget)?,
            None => {
                return Err(OpError::Parameter(self.no_format()));
            }
        };
        let store = &cx.files().store;
        store.write(&path, &bytes).map_err(|e| failed(&e))?;
        cx.advance("draw", 1, 1)?;
        Ok(Report::changed(0))
    }
}

impl CurveFigure {
    fn no_format(&self) -> String {
        format!("no format of figures is known for \"{}\"", self.path)
    }

    /// What is wrong with the objects.
    fn plan_curves(&self, plan: &Plan, cx: &PlanContext) -> Vec<Problem> {
        let mut problems = Vec::new();
        let before = self.before.as_deref();
        problems.extend(before.and_then(|name| plan.missing(name, ["before"])));
        let most = if self.t.is_empty() {
            MAX_DRAWN
        } else {
            MAX_CONSTRUCTED
        };
        let (mut n, mut points_of_all) = (0, 0_u64);
        for object in plan.objects() {
            let is_before = before == Some(&object.name);
            let is_chosen = match cx.on {
                Some(on) => on.contains(&object.name),
                None => !is_before,
            };
            if !is_chosen && !is_before {
                continue;
            }
            let most = if is_chosen { most } else { MAX_DRAWN };
            match object.geometry {
                PlannedGeometry::Curve(points) if points.min > most as u64 => {
                    let (name, found) = (&object.name, points.min);
                    problems.push(Problem::error(format!(
                        "expected curves of at most {most} control points, \"{name}\" has {found}"
                    )));
                }
                PlannedGeometry::Curve(points) if is_chosen => {
                    n += 1;
                    let levels = points.min * (points.min + 1) / 2;
                    points_of_all += levels * self.t.len() as u64;
                }
                PlannedGeometry::Curve(_) => {}
                // Without `on`, what is no curve is not drawn.
                _ if is_chosen && cx.on.is_none() => {}
                _ => {
                    let message = not_a_curve(&object.name, object.geometry.kind());
                    problems.push(Problem::error(message));
                }
            }
        }
        if n == 0 && problems.is_empty() && !plan.incomplete {
            let problem = Problem::error("CurveFigure finds no curve to draw");
            problems.push(problem.help("load a .bzc file in an earlier step"));
        }
        if n * self.t.len().max(1) > MAX_PANELS {
            let found = n * self.t.len().max(1);
            let message = format!("expected at most {MAX_PANELS} pictures, found {found}");
            problems.push(Problem::error(message).at(["t"]));
        } else if points_of_all > MAX_POINTS as u64 {
            let message = format!("expected at most {MAX_POINTS} points, found {points_of_all}");
            problems.push(Problem::error(message).at(["t"]));
        }
        problems
    }

    /// The figure of the chosen curves.
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
            panels.extend(parameters.iter().map(|&t| Panel {
                curve,
                before,
                t,
                title: (chosen.len() > 1).then_some(object.name.as_str()),
            }));
        }
        let columns = match self.columns {
            Some(columns) => columns.get() as usize,
            None => parameters.len().min(4),
        };
        let layout = Layout {
            width: f64::from(self.width.get()),
            columns,
            labels: self.labels,
            legend: self.legend,
        };
        construction(&panels, &layout).map_err(|error| OpError::Parameter(error.to_string()))
    }

    fn png(&self, figure: &Svg, stamp: Option<&str>, budget: u64) -> Result<Vec<u8>, OpError> {
        let scale = f64::from(self.scale.get());
        let failed = |error: render::PictureError| OpError::Parameter(error.to_string());
        let (width, height) = pixel_size(figure, scale).map_err(failed)?;
        let needed = bytes_needed(width, height);
        if needed > budget {
            let message = format!("the figure takes {needed} bytes, the budget is {budget}");
            return Err(OpError::Budget(message));
        }
        let image = pixels(figure, scale, [255; 4]).map_err(failed)?;
        let texts: Vec<(&str, &str)> = stamp.iter().map(|stamp| ("Software", *stamp)).collect();
        image.to_png(&texts).map_err(failed)
    }
}

fn curve(object: &Object) -> Result<&Curve<DVec2>, OpError> {
    match &object.geometry {
        Geometry::Curve(curve) => Ok(curve),
        other => Err(OpError::Object(not_a_curve(&object.name, other.kind()))),
    }
}

fn not_a_curve(name: &str, kind: &str) -> String {
    format!("CurveFigure draws curves, but \"{name}\" is {kind}")
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

    /// Runs a step with a stamp, and gives back what it has written.
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
    fn every_curve_has_a_picture_for_every_parameter() {
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
    fn a_png_is_so_many_times_as_large_and_carries_the_stamp() {
        let bytes = written(&step(r#"(path: "a.PNG", width: 200)"#), None, u64::MAX).unwrap();
        assert_eq!(bytes[..8], *b"\x89PNG\r\n\x1a\n");
        assert_eq!(bytes[16..20], 400_u32.to_be_bytes());
        let stamp = b"Software";
        assert!(bytes.windows(stamp.len()).any(|window| window == stamp));
    }

    #[test]
    fn a_curve_can_stand_behind_another_one() {
        let text = |parameters: &str| {
            let bytes = written(&step(parameters), None, u64::MAX).unwrap();
            String::from_utf8(bytes).unwrap()
        };
        let figure = text(r#"(path: "a.svg", before: "arch", t: [])"#);
        assert_eq!(figure.matches("<g id=\"before\">").count(), 1);
        assert!(!figure.contains("c(t)"));
    }

    #[test]
    fn what_does_not_go_is_refused() {
        let error = |parameters: &str, budget| {
            let refused = written(&step(parameters), None, budget);
            refused.unwrap_err().to_string()
        };
        for (parameters, reason) in [
            (r#"(path: "a.gif")"#, "no format of figures"),
            (r#"(path: "../a.svg")"#, "output folder"),
            (
                r#"(path: "a.svg", before: "lines")"#,
                "\"lines\" is polylines",
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
        assert!(error(r#"(path: "a.png")"#, 1000).contains("the budget is 1000"));
    }

    #[test]
    fn a_plan_tells_what_apply_would_refuse() {
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
