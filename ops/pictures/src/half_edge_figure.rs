//! Half-edge figure: draws the half-edges of faces into a file.

use op::prelude::*;
use op::{FaceSelection, Operation, Select, target_scene};
use render::figure::half_edges::{MAX_FACES, half_edges};

use crate::figure_file;

/// Draws the half-edges of some faces of a mesh into an image file.
///
/// Each half-edge is drawn as an arrow beside its edge and inside its face, and is labeled with its name. A thin curve
/// leads from the head of the arrow to the next half-edge of the face. The twin of a half-edge is on the other side of
/// the edge. At a boundary edge, the half-edge without a face is also drawn, in gray. The viewer looks at the faces
/// from the direction of their mean normal. A face is left out if its normal points away from the viewer, or if it is
/// seen nearly edge-on. The report counts these faces. The extension of the file determines the format: `.svg` or
/// `.png`. The file is written only if the whole recipe succeeds. The scene does not change.
///
/// The name of an element is a letter followed by the id of the element: `v` for vertices, `h` for half-edges, `f` for
/// faces. The half-edges with the ids `2e` and `2e + 1` belong to the edge with the id `e`.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct HalfEdgeFigure {
    /// The file. The path is relative to the output folder. If `name` is a recipe parameter whose value is a file,
    /// `{name.stem}` is replaced by the name of this file without its extension.
    pub path: String,
    /// The faces to draw, at most 200.
    #[serde(default)]
    pub faces: FaceSelection,
    /// The width of the figure in SVG pixels.
    #[serde(default = "width")]
    pub width: Count<80, 8192>,
    /// The width and height of one SVG pixel, in pixels of a `.png` file. Has no effect on `.svg` files.
    #[serde(default = "scale")]
    pub scale: Count<1, 8>,
}

const fn width() -> Count<80, 8192> {
    Count::literal(640)
}

const fn scale() -> Count<1, 8> {
    Count::literal(2)
}

impl Operation for HalfEdgeFigure {
    const NAME: &'static str = "HalfEdgeFigure";
    const SUMMARY: &'static str = "Draw the half-edges of faces";
    const EXAMPLE: &'static str = r#"HalfEdgeFigure(path: "figure.svg")"#;
    const WORDS: &'static [&'static str] = &["next", "twin", "diagram"];
    const TAKES_ON: bool = true;

    fn plan(&self, plan: &mut Plan, cx: &PlanContext) -> Vec<Problem> {
        let mut problems = figure_file::plan(&self.path, plan, cx);
        let is_chosen = |name: &String| cx.on.is_none_or(|on| on.contains(name));
        let mut meshes = Vec::new();
        for object in plan.objects().iter().filter(|o| is_chosen(&o.name)) {
            if let PlannedGeometry::Mesh(mesh) = &object.geometry {
                meshes.push((&object.name, self.faces.count(mesh).min));
            }
        }
        match meshes[..] {
            [(name, n_faces)] if n_faces > MAX_FACES as u64 => {
                let problem = Problem::error(too_many(n_faces, name)).at(["faces"]);
                problems.push(problem.help(SELECT_FACES));
            }
            [_] => {}
            _ if plan.incomplete => {}
            _ => {
                let message = format!("expected one mesh to draw, found {}", meshes.len());
                problems.push(Problem::error(message).help(CHOOSE_MESH));
            }
        }
        problems
    }

    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError> {
        cx.advance("draw", 0, 1)?;
        let targets = target_scene(scene, cx);
        let mut meshes = (targets.objects().iter()).filter_map(|o| Some((&o.name, o.as_mesh()?)));
        let (Some((name, mesh)), None) = (meshes.next(), meshes.next()) else {
            let message = format!("expected one mesh to draw: {CHOOSE_MESH}");
            return Err(OpError::Object(message));
        };
        let faces = self.faces.resolve(mesh, cx)?;
        if faces.len() > MAX_FACES {
            let message = too_many(faces.len() as u64, name);
            return Err(OpError::Parameter(format!("{message}: {SELECT_FACES}")));
        }
        let (figure, n_hidden) = half_edges(mesh, &faces, f64::from(self.width.get()));
        figure_file::write(&self.path, &figure, self.scale, cx)?;
        cx.advance("draw", 1, 1)?;
        Ok(Report::changed(0).count(
            "faces not drawn, because their normals point away from the viewer or they are seen nearly edge-on",
            n_hidden,
        ))
    }
}

const CHOOSE_MESH: &str = "choose one with `on`";
const SELECT_FACES: &str = "select fewer faces with `faces`";

fn too_many(n_faces: u64, name: &str) -> String {
    format!("expected at most {MAX_FACES} faces to draw, but \"{name}\" has {n_faces}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use op::{Files, NoProgress};
    use scene::Object;

    fn scene() -> Scene {
        let mut scene = Scene::new();
        for (name, mesh) in [("cube", shapes::cube()), ("square", shapes::square())] {
            scene.insert(Object::mesh(name, mesh)).unwrap();
        }
        scene
    }

    fn run(parameters: &str, on: &[&str]) -> Result<(Report, String), OpError> {
        let folder = tempfile::tempdir().unwrap();
        let files = Files {
            output: folder.path().into(),
            ..Files::default()
        };
        let (mut after, before) = (scene(), scene());
        let on: Vec<String> = on.iter().map(|&name| name.to_owned()).collect();
        let mut cx = Context::new(&NoProgress, &files);
        cx.on = (!on.is_empty()).then_some(&on);
        let step: HalfEdgeFigure = op::test::read(parameters).unwrap();
        let report = step.apply(&mut after, &mut cx)?;
        assert_eq!(after, before);
        Ok((
            report,
            std::fs::read_to_string(folder.path().join(step.path)).unwrap(),
        ))
    }

    #[test]
    fn the_selected_faces_of_one_mesh_are_drawn() {
        let (_, text) = run(r#"(path: "a.svg")"#, &["square"]).unwrap();
        assert!(text.starts_with("<svg") && text.contains(">h0<") && text.contains(">f0<"));
        let (_, text) = run(
            r#"(path: "a.svg", faces: Facing(direction: (0, 0, 1), within: 1))"#,
            &["cube"],
        )
        .unwrap();
        assert_eq!(text.matches(">h").count(), 4);
    }

    #[test]
    fn other_numbers_of_meshes_and_too_many_faces_are_refused() {
        let refused = run(r#"(path: "a.svg")"#, &[]).unwrap_err().to_string();
        assert!(refused.contains("expected one mesh"), "{refused}");
        assert!(too_many(201, "a").contains("at most 200 faces"));
    }
}
