//! Save: writes objects to a file.

use mesh_io::{Format, WriteOptions};
use op::prelude::*;
use op::{Loss, Operation, target_scene};

/// Writes objects to a file in the output folder.
///
/// The extension chooses the format: `.obj`, `.gltf`, `.glb`, `.ply`, `.stl` or `.off` for meshes, `.bez` for
/// Bezier patches, `.bzc` for a curve, and `.mws` for a complete scene without any loss. Content that the format
/// cannot store is listed. The file is only created when the whole recipe has succeeded.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Save {
    /// The file. The path is relative to the output folder. `{name.stem}` is replaced by the name, without
    /// extension, of the file in the recipe parameter `name`.
    pub path: String,
}

impl Operation for Save {
    const NAME: &'static str = "Save";
    const SUMMARY: &'static str = "Write objects to a file";
    const EXAMPLE: &'static str = r#"Save(path: "a.obj")"#;
    const WORDS: &'static [&'static str] = &["export", "write"];
    const TAKES_ON: bool = true;

    fn plan(&self, plan: &mut Plan, cx: &PlanContext) -> Vec<Problem> {
        let mut problems = plan.write(cx, &self.path, |path| {
            let message = match Format::from_path(path) {
                Some(format) if format.can_write() => return None,
                Some(format) => format!("{format} files can be read, but not written"),
                None => format!("unknown file format: \"{}\"", self.path),
            };
            let help = format!(
                "extensions that can be written: {}",
                Format::writable_extensions()
            );
            Some(Problem::error(message).at(["path"]).help(help))
        });
        if plan.objects().is_empty() && !plan.incomplete {
            problems.push(Problem::error("no objects to save at this point"));
        }
        problems
    }

    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError> {
        cx.advance("write", 0, 1)?;
        let failed = |error: &dyn std::fmt::Display| OpError::File(error.to_string());
        let path = cx.files().to_write(&self.path).map_err(|e| failed(&e))?;
        cx.files().make_folder_of(&path).map_err(|e| failed(&e))?;
        let chosen = target_scene(scene, cx);
        let options = WriteOptions {
            provenance: cx.files().provenance.clone(),
        };
        let written =
            mesh_io::write(&*cx.files().store, &path, &chosen, &options).map_err(|e| failed(&e))?;
        let mut report = Report::changed(chosen.objects().len());
        report.losses = written
            .losses
            .into_iter()
            .map(|loss| {
                let domain = loss.domain.map(|d| format!("{d} ")).unwrap_or_default();
                let what = format!("{domain}\"{}\" ({})", loss.attribute, loss.count);
                Loss {
                    object: loss.object,
                    name: loss.attribute,
                    what,
                    reason: loss.reason,
                }
            })
            .collect();
        cx.advance("write", 1, 1)?;
        Ok(report)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use op::{Files, NoProgress, PlannedGeometry, Range};
    use scene::Object;

    fn save(path: &str) -> Save {
        op::test::read(&format!("(path: {path:?})")).unwrap()
    }

    #[test]
    fn saved_files_can_be_read_back() {
        let folder = tempfile::tempdir().unwrap();
        let files = Files {
            output: folder.path().into(),
            ..Files::default()
        };
        let mut scene = Scene::new();
        scene.insert(Object::mesh("cube", shapes::cube())).unwrap();
        let mut cx = Context::new(&NoProgress, &files);
        save("a/cube.obj").apply(&mut scene, &mut cx).unwrap();
        let path = folder.path().join("a/cube.obj");
        let back = mesh_io::read(&store::Disk, &path, &mesh_io::ReadOptions::default()).unwrap();
        let mesh = back.objects[0].as_mesh().unwrap();
        assert_eq!((mesh.n_vertices(), mesh.n_faces()), (8, 6));
        assert_eq!(mesh.positions(), shapes::cube().positions());
    }

    #[test]
    fn only_the_selected_objects_are_saved() {
        let folder = tempfile::tempdir().unwrap();
        let files = Files {
            output: folder.path().into(),
            ..Files::default()
        };
        let mut scene = Scene::new();
        scene.insert(Object::mesh("cube", shapes::cube())).unwrap();
        scene
            .insert(Object::mesh("torus", shapes::torus(4, 3, 2.0, 1.0)))
            .unwrap();
        let on = ["cube".to_owned()];
        let mut cx = Context::new(&NoProgress, &files);
        cx.on = Some(&on);
        save("cube.obj").apply(&mut scene, &mut cx).unwrap();
        let path = folder.path().join("cube.obj");
        let back = mesh_io::read(&store::Disk, &path, &mesh_io::ReadOptions::default()).unwrap();
        assert_eq!(back.objects[0].as_mesh().unwrap().n_faces(), 6);
    }

    #[test]
    fn invalid_paths_are_problems_of_the_plan() {
        let files = Files {
            output: "out".into(),
            ..Files::default()
        };
        let cx = PlanContext {
            files: &files,
            on: None,
            budget: u64::MAX,
        };
        let mut plan = Plan::default();
        plan.insert("a", PlannedGeometry::Patches(Range::ANY));
        assert_eq!(save("a.obj").plan(&mut plan, &cx), []);
        for path in ["a.obj", "../a.obj", "a.xyz", "a.dae", "{none.stem}.obj"] {
            assert_eq!(save(path).plan(&mut plan, &cx).len(), 1, "{path}");
        }
    }
}
