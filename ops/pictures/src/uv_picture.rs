//! UV picture: draws the charts of texture coordinates into a file.

use geometry::uv::charts;
use mesh::{DVec2, Domain, UV, Value};
use op::prelude::*;
use op::{Operation, Refusal, target_scene};
use render::figure::uv_layout::{self, uv_layout};

use crate::figure_file;

/// Draws the charts of the texture coordinates of a mesh into an image file.
///
/// A gray frame shows the page of the texture, where u and v are from 0 to 1; v points upwards. Thick lines are the
/// borders of charts, and thin lines are the other edges. Charts outside the page are also drawn. To make room for
/// these charts, the figure is made higher, or everything in it is drawn smaller. The extension of the file determines
/// the format: `.svg` or `.png`. The file is written only if the whole recipe succeeds. The scene does not change.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct UvPicture {
    /// The file. The path is relative to the output folder. If `name` is a recipe parameter whose value is a file,
    /// `{name.stem}` is replaced by the name of this file without its extension.
    pub path: String,
    /// The name of the texture coordinates. Defaults to `uv`.
    #[serde(default = "uv")]
    pub uv: String,
    /// What the colors inside charts show.
    #[serde(default)]
    pub fill: UvFill,
    /// Whether edges inside charts are drawn.
    #[serde(default = "yes")]
    pub edges: bool,
    /// The width of the figure in SVG pixels.
    #[serde(default = "width")]
    pub width: Count<80, 8192>,
    /// The width and height of one SVG pixel, in pixels of a `.png` file. Has no effect on `.svg` files.
    #[serde(default = "scale")]
    pub scale: Count<1, 8>,
}

/// What the colors inside charts show.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum UvFill {
    /// No colors.
    None,
    /// The charts: each chart has one of eight colors. If there are more than eight charts, the colors repeat.
    #[default]
    Charts,
    /// The distortion of angles. A small circle on the surface becomes an ellipse in the texture. The color shows the
    /// ratio of the longer to the shorter axis of the ellipse, from dark for 1 to bright for 1.5 or more.
    Stretch,
}

fn uv() -> String {
    UV.name.to_owned()
}

const fn yes() -> bool {
    true
}

const fn width() -> Count<80, 8192> {
    Count::literal(640)
}

const fn scale() -> Count<1, 8> {
    Count::literal(2)
}

impl Operation for UvPicture {
    const NAME: &'static str = "UvPicture";
    const SUMMARY: &'static str = "Draw the UV layout (the UV charts of a mesh)";
    const EXAMPLE: &'static str = r#"UvPicture(path: "uv.svg")"#;
    const WORDS: &'static [&'static str] = &["texture", "atlas", "layout", "diagram"];
    const TAKES_ON: bool = true;

    fn plan(&self, plan: &mut Plan, cx: &PlanContext) -> Vec<Problem> {
        let mut problems = figure_file::plan(&self.path, plan, cx);
        let is_chosen = |name: &String| cx.on.is_none_or(|on| on.contains(name));
        let objects = plan.objects().iter().filter(|o| is_chosen(&o.name));
        let mut meshes = objects.filter_map(|object| match &object.geometry {
            PlannedGeometry::Mesh(mesh) => Some(mesh),
            _ => None,
        });
        match (meshes.next(), meshes.count()) {
            (Some(mesh), 0) => {
                let mut attributes = mesh.attributes.iter();
                let has_uv = attributes.any(|a| a.domain == Domain::Corner && a.name == self.uv);
                if !has_uv && !mesh.has_unlisted_attributes {
                    problems.push(Problem::error(self.missing()).at(["uv"]));
                }
            }
            _ if plan.incomplete => {}
            (first, others) => {
                let n = others + usize::from(first.is_some());
                let message = format!("expected one mesh to draw, found {n}");
                problems.push(Problem::error(message).help(CHOOSE_MESH));
            }
        }
        problems
    }

    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError> {
        cx.advance("draw", 0, 1)?;
        let targets = target_scene(scene, cx);
        let mut meshes = targets.objects().iter().filter_map(scene::Object::as_mesh);
        let (Some(mesh), None) = (meshes.next(), meshes.next()) else {
            let message = format!("expected one mesh to draw: {CHOOSE_MESH}");
            return Err(OpError::Object(message));
        };
        let column = mesh.attributes().column(Domain::Corner, &self.uv);
        let uvs = column.and_then(|column| DVec2::of(&column.values));
        let uvs = uvs.ok_or_else(|| OpError::refused(Refusal::Missing, self.missing()))?;
        let charts = charts(mesh, uvs);
        let fill = match self.fill {
            UvFill::None => uv_layout::UvFill::None,
            UvFill::Charts => uv_layout::UvFill::Charts,
            UvFill::Stretch => uv_layout::UvFill::Stretch,
        };
        let width = f64::from(self.width.get());
        let figure = uv_layout(mesh, uvs, &charts, width, fill, self.edges);
        figure_file::write(&self.path, &figure, self.scale, cx)?;
        cx.advance("draw", 1, 1)?;
        Ok(Report::changed(0).count("charts", charts.n))
    }
}

const CHOOSE_MESH: &str = "choose one with `on`";

impl UvPicture {
    fn missing(&self) -> String {
        format!(
            "the mesh has no texture coordinates `{}`; compute them first, for example with Unwrap",
            self.uv
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use op::{Files, NoProgress};
    use scene::Object;

    fn run(parameters: &str, on: &[&str]) -> Result<(Report, Vec<u8>), OpError> {
        let mut scene = Scene::new();
        let mut grid = shapes::grid(2, 1);
        let uvs = grid.half_edges().map(|h| {
            let p = grid.position(grid.origin(h));
            p.truncate() / 4.0 + 0.5
        });
        let uvs = uvs.collect();
        grid.set(UV, uvs);
        for (name, mesh) in [("grid", grid), ("cube", shapes::cube())] {
            scene.insert(Object::mesh(name, mesh)).unwrap();
        }
        let folder = tempfile::tempdir().unwrap();
        let files = Files {
            output: folder.path().into(),
            ..Files::default()
        };
        let on: Vec<String> = on.iter().map(|&name| name.to_owned()).collect();
        let mut cx = Context::new(&NoProgress, &files);
        cx.on = (!on.is_empty()).then_some(&on);
        let step: UvPicture = op::test::read(parameters).unwrap();
        let before = scene.clone();
        let report = step.apply(&mut scene, &mut cx)?;
        assert_eq!(scene, before);
        Ok((
            report,
            std::fs::read(folder.path().join(step.path)).unwrap(),
        ))
    }

    #[test]
    fn the_charts_of_one_mesh_are_drawn() {
        let (report, bytes) = run(r#"(path: "a.svg")"#, &["grid"]).unwrap();
        assert_eq!(report.notes, ["charts: 1"]);
        let text = String::from_utf8(bytes).unwrap();
        assert!(text.contains("id=\"borders\""), "{text}");
        let png = run(
            r#"(path: "a.png", width: 100, fill: Stretch, edges: false)"#,
            &["grid"],
        );
        assert_eq!(png.unwrap().1[16..20], 200_u32.to_be_bytes());
    }

    #[test]
    fn several_meshes_and_missing_coordinates_are_refused() {
        for (on, words) in [
            (vec![], "expected one mesh"),
            (vec!["cube"], "no texture coordinates `uv`"),
        ] {
            let refused = run(r#"(path: "a.svg")"#, &on).unwrap_err().to_string();
            assert!(refused.contains(words), "{refused}");
        }
    }
}
