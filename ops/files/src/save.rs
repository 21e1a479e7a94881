//! Save: writes objects to a file.

use std::path::Path;

use mesh_io::{Compression, Format, Images, Quantization, Rows, WriteOptions};
use op::prelude::*;
use op::{Loss, Operation, target_scene};

use crate::save_plan;

/// Writes objects to a file.
///
/// The extension determines the format: `.obj`, `.gltf`, `.glb`, `.ply`, `.stl` or `.off` for meshes, `.bez` for Bezier
/// patches, `.bzc` for a curve, and `.mws` for a complete scene without any loss. A `.csv` file is a table of the
/// positions and attributes of vertices, faces or corners. An `.npz` file stores the arrays of a mesh for the Python
/// library `NumPy`. `Load` cannot read `.csv` and `.npz` files. If `path` ends with `.gz`, as in `a.obj.gz`, the file
/// is compressed with gzip. Files in the formats `.glb`, `.mws` and `.npz` cannot be compressed with gzip. If the
/// format cannot store some of the content of the objects, the report lists this content. The file is created only if
/// all steps of the recipe succeed and all expectations of the recipe (checks of the result) are met.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Save {
    /// The file. The path is relative to the output folder. In the path, `{name.stem}` stands for a file name without
    /// its extension. The file name is taken from the recipe parameter `name`, whose value must be a file path. For
    /// example, `{input.stem}.glb` becomes `bunny.glb` if the parameter `input` is `models/bunny.obj`.
    pub path: String,
    /// What to do with the images of materials. If omitted, images are embedded in `.glb` files. For `.gltf` and
    /// `.obj`, the image files of the loaded model are copied to the folder of the output file. If images are embedded
    /// in the loaded model, a `.gltf` file also embeds them. For `.obj`, embedded images are written to separate files,
    /// because OBJ cannot embed images.
    #[serde(default)]
    pub images: Option<Images>,
    /// How to compress the geometry of `.glb` and `.gltf` files without loss. If omitted, the geometry is not
    /// compressed.
    #[serde(default)]
    pub compress: Option<Compression>,
    /// The number of bits for each attribute of the geometry in `.glb` and `.gltf` files. If omitted, numbers are
    /// stored as 32-bit floats. `quantize: ()` uses the default number of bits for each attribute. The report states
    /// the largest rounding errors of this step: in positions, in normals and tangents, and in texture coordinates.
    #[serde(default)]
    pub quantize: Option<Quantization>,
    /// For a skinned mesh in a `.gltf` or `.glb` file, the largest number of sets of joints for each vertex. A set has
    /// four joints and their weights. For example, if the limit is 2, up to eight joints move a vertex. If omitted, the
    /// limit is the number of sets in the file that the mesh was loaded from, or 1 if this number is not known.
    #[serde(default)]
    pub weight_sets: Option<Count<1, 8>>,
    /// For `.csv`, the elements that have a row in the table: vertices, faces or corners. If omitted, vertices.
    #[serde(default)]
    pub rows: Option<Rows>,
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
        let is_obj = Format::from_path(Path::new(&self.path)) == Some(Format::Obj);
        if is_obj && self.images == Some(Images::Embed) {
            let problem = Problem::error("OBJ files cannot embed images");
            problems.push(problem.at(["images"]).help("use `images: Copy`"));
        }
        let format = Format::from_path(Path::new(&self.path));
        let packs = format.is_none_or(Format::packs);
        let asked = [
            ("compress", self.compress.is_some()),
            ("quantize", self.quantize.is_some()),
        ];
        for (field, _) in asked.into_iter().filter(|(_, asked)| *asked && !packs) {
            let problem =
                Problem::error("only .glb and .gltf files can be compressed or quantized");
            problems.push(problem.at([field]));
        }
        if self.rows.is_some() && format.is_some_and(|format| format != Format::Csv) {
            problems.push(Problem::error("only .csv files have rows").at(["rows"]));
        }
        problems.extend(save_plan::plan(self, plan, cx));
        if plan.objects().is_empty() && !plan.incomplete {
            problems.push(Problem::error(
                "the scene has no objects to save at this point of the recipe",
            ));
        }
        problems
    }

    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError> {
        cx.advance("write", 0, 1)?;
        let files = cx.files();
        let path = files
            .to_write(&self.path)
            .map_err(|e| files.output_error(e))?;
        files
            .make_folder_of(&path)
            .map_err(|e| files.output_error(e))?;
        let chosen = target_scene(scene, cx);
        let options = WriteOptions {
            provenance: files.provenance.clone(),
            images: self.images,
            compression: self.compress,
            quantization: self.quantize,
            weight_sets: self.weight_sets.map(Count::get),
            rows: self.rows,
            strict: false,
        };
        let written = mesh_io::write(&cx.cancellable_store(), &path, &chosen, &options);
        if written.is_err() {
            // If writing failed because the run was canceled, the step returns `Cancelled` instead of the error of the
            // writer.
            cx.advance("write", 0, 1)?;
        }
        let written = written.map_err(|e| files.output_error(e))?;
        let mut report = Report::changed(chosen.objects().len());
        report
            .notes
            .extend(written.packing.map(|packing| packing.to_string()));
        report.losses = written
            .losses
            .into_iter()
            .map(|loss| Loss {
                code: loss.code(),
                count: Some(loss.count as u64),
                what: loss.what(),
                object: loss.object,
                name: loss.attribute,
                reason: loss.reason,
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
    fn a_compressed_file_reports_progress_while_it_is_written() {
        struct Counter(std::sync::atomic::AtomicUsize);
        impl op::Progress for Counter {
            fn advance(&self, _: &str, _: u64, _: u64) -> bool {
                self.0.fetch_add(1, std::sync::atomic::Ordering::Relaxed) < 20
            }
        }
        let folder = tempfile::tempdir().unwrap();
        let files = Files {
            output: folder.path().into(),
            ..Files::default()
        };
        let mut scene = Scene::new();
        let torus = shapes::torus(200, 200, 2.0, 1.0);
        scene.insert(Object::mesh("torus", torus)).unwrap();
        let counter = Counter(0.into());
        let mut cx = Context::new(&counter, &files);
        let saved = save("torus.obj.gz").apply(&mut scene, &mut cx);
        assert!(matches!(saved, Err(OpError::Cancelled)), "{saved:?}");
        assert_eq!(folder.path().read_dir().unwrap().count(), 0);
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
    fn an_error_names_the_file_as_in_the_recipe() {
        let folder = tempfile::tempdir().unwrap();
        let files = Files {
            output: folder.path().into(),
            ..Files::default()
        };
        let mut scene = Scene::new();
        scene.insert(Object::mesh("cube", shapes::cube())).unwrap();
        let mut cx = Context::new(&NoProgress, &files);
        let error = save("a/cube.bez").apply(&mut scene, &mut cx).unwrap_err();
        let text = error.to_string();
        assert!(text.contains("a/cube.bez"), "{text}");
        assert!(!text.contains(&*folder.path().to_string_lossy()), "{text}");
    }

    #[test]
    fn images_of_a_loaded_model_are_embedded_copied_or_named() {
        let folder = tempfile::tempdir().unwrap();
        let files = Files {
            input: folder.path().into(),
            output: folder.path().join("out"),
            ..Files::default()
        };
        let write = |name: &str, bytes: &[u8]| {
            std::fs::write(folder.path().join(name), bytes).unwrap();
        };
        write(
            "a.obj",
            b"mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n",
        );
        write("a.mtl", b"newmtl m\nmap_Kd wood.png\n");
        write("wood.png", b"\x89PNG...");
        let mut scene = Scene::new();
        let load: crate::Load = op::test::read(r#"(path: "a.obj")"#).unwrap();
        let mut cx = Context::new(&NoProgress, &files);
        let report = load.apply(&mut scene, &mut cx).unwrap();
        assert_eq!(report.notes, Vec::<String>::new());
        for (text, copied) in [
            (r#"(path: "1/a.glb")"#, false),
            (r#"(path: "2/a.gltf")"#, true),
            (r#"(path: "3/a.obj")"#, true),
            (r#"(path: "4/a.glb", images: Copy)"#, true),
            (r#"(path: "5/a.gltf", images: Embed)"#, false),
            (r#"(path: "6/a.obj", images: Keep)"#, false),
        ] {
            let save: Save = op::test::read(text).unwrap();
            let report = save.apply(&mut scene, &mut cx).unwrap();
            assert_eq!(report.losses, [], "{text}");
            let folder = files.output.join(&save.path[..1]);
            assert_eq!(folder.join("wood.png").exists(), copied, "{text}");
        }
        let save: Save = op::test::read(r#"(path: "a.obj", images: Embed)"#).unwrap();
        let plan = PlanContext::new(&files);
        let mut planned = Plan::default();
        planned.insert("a", PlannedGeometry::Patches(Range::ANY));
        let problems = save.plan(&mut planned, &plan);
        assert_eq!(problems[0].message, "OBJ files cannot embed images");
    }

    #[test]
    fn compressed_and_quantized_files_are_read_back_and_reported() {
        let folder = tempfile::tempdir().unwrap();
        let files = Files {
            output: folder.path().into(),
            ..Files::default()
        };
        let mut scene = Scene::new();
        scene
            .insert(Object::mesh("ball", shapes::torus(90, 60, 2.0, 1.0)))
            .unwrap();
        let mut cx = Context::new(&NoProgress, &files);
        for (text, words) in [
            (r#"(path: "a.glb")"#, None),
            (
                r#"(path: "b.glb", compress: Meshopt)"#,
                Some("bytes instead of"),
            ),
            (
                r#"(path: "c.glb", quantize: ())"#,
                Some("positions by at most"),
            ),
            (
                r#"(path: "d.gltf", compress: Meshopt, quantize: (position: 12))"#,
                Some("positions by at most"),
            ),
        ] {
            let save: Save = op::test::read(text).unwrap();
            let report = save.apply(&mut scene, &mut cx).unwrap();
            match words {
                Some(words) => assert!(report.notes[0].contains(words), "{:?}", report.notes),
                None => assert_eq!(report.notes, [""; 0]),
            }
            let path = folder.path().join(&save.path);
            let back =
                mesh_io::read(&store::Disk, &path, &mesh_io::ReadOptions::default()).unwrap();
            assert_eq!(back.objects[0].as_mesh().unwrap().n_vertices(), 5400);
        }
        assert!(op::test::read::<Save>(r#"(path: "a.glb", quantize: (position: 17))"#).is_err());
        assert!(op::test::read::<Save>(r#"(path: "a.glb", quantize: (normal: 7))"#).is_err());
        let plan = PlanContext::new(&files);
        let mut planned = Plan::default();
        planned.insert("a", PlannedGeometry::Patches(Range::ANY));
        let save: Save = op::test::read(r#"(path: "a.ply", compress: Meshopt)"#).unwrap();
        let problems = save.plan(&mut planned, &plan);
        assert_eq!(
            problems[0].message,
            "only .glb and .gltf files can be compressed or quantized"
        );
    }

    #[test]
    fn invalid_paths_are_problems_of_the_plan() {
        let files = Files {
            output: "out".into(),
            ..Files::default()
        };
        let cx = PlanContext::new(&files);
        let mut plan = Plan::default();
        plan.insert("a", PlannedGeometry::Polylines);
        assert_eq!(save("a.obj").plan(&mut plan, &cx), []);
        for path in ["a.obj", "../a.obj", "a.xyz", "a.dae", "{none.stem}.obj"] {
            assert_eq!(save(path).plan(&mut plan, &cx).len(), 1, "{path}");
        }
    }
}
