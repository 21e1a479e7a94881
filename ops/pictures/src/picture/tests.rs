//! Tests of the whole operation. Most tests read a step from text, run it, and check the bytes of the written file.

use geometry::shapes;
use op::{Context, Files, NoProgress, OpError, Operation, Plan, PlanContext, PlannedGeometry};
use scene::{Object, Scene};

use crate::picture::Picture;

fn picture(fields: &str) -> Picture {
    op::test::read(&format!("(size: (32, 24), {fields})"))
        .unwrap_or_else(|error| panic!("{fields}: {error}"))
}

fn scene() -> Scene {
    let mut scene = Scene::new();
    scene.insert(Object::mesh("cube", shapes::cube())).unwrap();
    scene
        .insert(Object::mesh("torus", shapes::torus(12, 8, 3.0, 0.5)))
        .unwrap();
    scene
}

/// Runs a step, and returns the bytes of the file that it writes.
fn written(fields: &str, on: Option<&[String]>) -> Result<Vec<u8>, OpError> {
    let folder = tempfile::tempdir().unwrap();
    let files = Files {
        output: folder.path().into(),
        input: folder.path().into(),
        provenance: Some("meshwright 1, recipe \"a\"".to_owned()),
        ..Files::default()
    };
    let mut cx = Context::new(&NoProgress, &files);
    cx.on = on;
    cx.budget = 1 << 30;
    let mut scene = scene();
    let before = scene.clone();
    let picture = picture(fields);
    picture.apply(&mut scene, &mut cx)?;
    assert_eq!(scene, before);
    Ok(std::fs::read(folder.path().join(&picture.path)).unwrap())
}

/// Decodes the width, height and pixels of a PNG file without alpha.
fn decoded(bytes: &[u8]) -> (u32, u32, Vec<[u8; 3]>) {
    let mut reader = png::Decoder::new(std::io::Cursor::new(bytes))
        .read_info()
        .unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    assert_eq!(info.color_type, png::ColorType::Rgb);
    (info.width, info.height, pixels.as_chunks().0.to_vec())
}

#[test]
fn a_picture_has_the_requested_size_and_the_stamp() {
    let bytes = written("path: \"a/b.png\"", None).unwrap();
    let (width, height, pixels) = decoded(&bytes);
    assert_eq!((width, height), (32, 24));
    assert!(pixels.iter().any(|p| *p != [255; 3]) && pixels[0] == [255; 3]);
    let stamp = b"recipe \"a\"";
    assert!(bytes.windows(stamp.len()).any(|w| w == stamp));
}

#[test]
fn only_the_chosen_objects_are_drawn() {
    let drawn = |on: &[String]| decoded(&written("path: \"a.png\"", Some(on)).unwrap()).2;
    let [cube, torus] = ["cube", "torus"].map(|name| drawn(&[name.to_owned()]));
    assert_ne!(cube, torus);
    // The axis of the torus points towards the camera, and the background is visible through its hole.
    let bytes = written(
        "path: \"a.png\", camera: Fit(from: Front)",
        Some(&["torus".to_owned()]),
    );
    assert_eq!(decoded(&bytes.unwrap()).2[12 * 32 + 16], [255; 3]);
}

#[test]
fn views_are_placed_side_by_side() {
    let views = "path: \"a.png\", views: [Fit(from: Front), Fit(from: Top), Fit(from: Left)]";
    let (width, height, _) = decoded(&written(views, None).unwrap());
    assert_eq!((width, height), (96, 24));
    let (width, height, _) = decoded(&written(&format!("{views}, columns: 2"), None).unwrap());
    assert_eq!((width, height), (64, 48));
}

#[test]
fn highlights_and_colors_change_the_picture() {
    let plain = written("path: \"a.png\"", None).unwrap();
    for parameter in [
        "highlight: Edges(Sharp(above: 30))",
        "highlight: Faces(All)",
        "marks: [(of: Vertices(All), color: \"blue\", width: 3)]",
        "color_by: (of: Valence)",
        "color_by: (of: MeanCurvature, legend: false)",
        "color_by: (of: MinAngle, map: Gray, range: (0, 90))",
        "color_by: (of: DihedralAngle)",
    ] {
        let bytes = written(&format!("path: \"a.png\", {parameter}"), None).unwrap();
        assert_ne!(decoded(&bytes).2, decoded(&plain).2, "{parameter}");
    }
}

#[test]
fn a_turntable_has_the_requested_number_of_frames() {
    let bytes = written("path: \"a.apng\", turntable: (frames: 5, seconds: 1)", None).unwrap();
    let reader = png::Decoder::new(std::io::Cursor::new(bytes))
        .read_info()
        .unwrap();
    assert_eq!(reader.info().animation_control().unwrap().num_frames, 5);
    let bytes = written("path: \"a.gif\", turntable: (frames: 3)", None).unwrap();
    assert_eq!(&bytes[..6], b"GIF89a");
}

#[test]
fn the_distances_of_a_mesh_to_itself_are_zero() {
    let folder = tempfile::tempdir().unwrap();
    let files = Files {
        output: folder.path().into(),
        input: folder.path().into(),
        ..Files::default()
    };
    let mut scene = Scene::new();
    scene.insert(Object::mesh("cube", shapes::cube())).unwrap();
    let path = folder.path().join("cube.obj");
    mesh_io::write(
        &store::Disk,
        &path,
        &scene,
        &mesh_io::WriteOptions::default(),
    )
    .unwrap();
    let picture = picture("path: \"a.png\", color_by: (of: DistanceTo(\"cube.obj\"))");
    let numbers = picture.color_by.as_ref().unwrap();
    let cx = Context::new(&NoProgress, &files);
    let targets = super::colors::distance_targets(numbers, &cx).unwrap();
    let found = numbers.numbers(&scene, &targets).unwrap();
    assert_eq!(found.colorings[0].values, [0.0; 8]);
}

#[test]
fn invalid_parameters_are_problems_of_the_plan() {
    let files = Files {
        output: "out".into(),
        ..Files::default()
    };
    let cx = PlanContext {
        files: &files,
        on: None,
        budget: 1 << 20,
    };
    let problems = |fields: &str| {
        let mut plan = Plan::default();
        let cube = op::MeshPlan::of(&shapes::cube());
        plan.insert("a", PlannedGeometry::Mesh(cube));
        let found = picture(fields).plan(&mut plan, &cx);
        found.into_iter().map(|p| p.message).collect::<Vec<_>>()
    };
    assert_eq!(problems("path: \"a.png\""), [""; 0]);
    for (fields, message) in [
        ("path: \"a.jpg\"", "unknown picture format of \"a.jpg\""),
        (
            "path: \"a.gif\"",
            "the animation \"a.gif\" needs `turntable`",
        ),
        (
            "path: \"../a.png\"",
            "the output path \"../a.png\" must stay inside the output folder: use a relative path \
             without the folders \".\" and \"..\" and without the characters \"\\\" and \":\"",
        ),
        (
            "path: \"a.png\", style: (sharp: 200)",
            "expected `sharp` from 0 to 180, found 200",
        ),
        (
            "path: \"a.png\", camera: LookAt(from: (0, 0, 0), to: (0, 0, 0))",
            "expected `from` and `to` of the camera to be two different finite points",
        ),
        (
            "path: \"a.png\", color_by: (of: Attribute(name: \"heat\"))",
            "no mesh has the attribute \"heat\"",
        ),
        (
            "path: \"a.png\", color_by: (of: Valence, range: (2, 1))",
            "expected two finite numbers, the lower one first, found 2 and 1",
        ),
        (
            "path: \"a.png\", turntable: (frames: 720)",
            "the images take 2.1 MiB, which exceeds the memory budget of 1.0 MiB",
        ),
    ] {
        let found = problems(fields);
        assert!(found.iter().any(|m| m == message), "{fields}: {found:?}");
    }
    let error = written("path: \"a.png\", highlight: Faces(Tagged(\"nose\"))", None);
    assert!(matches!(error, Err(OpError::Refused { .. })), "{error:?}");
}

#[test]
fn an_empty_scene_gives_an_empty_picture() {
    let files = Files::default();
    let mut cx = Context::new(&NoProgress, &files);
    let (images, notes) = picture("path: \"a.png\"")
        .draw(&[(&Scene::new(), "")], None, &mut cx)
        .unwrap();
    assert!(images[0].pixels.iter().all(|p| *p == [255; 4]) && notes.is_empty());
}

#[test]
fn highlights_in_a_scene_without_meshes_give_a_note() {
    let line = scene::Geometry::Polylines(vec![vec![glam::DVec3::ZERO, glam::DVec3::ONE]]);
    let mut scene = Scene::new();
    scene.insert(Object::new("line", line)).unwrap();
    let files = Files::default();
    let mut cx = Context::new(&NoProgress, &files);
    let mut notes = |fields: &str, scene: &Scene| {
        let (_, notes) = picture(fields).draw(&[(scene, "")], None, &mut cx).unwrap();
        notes
    };
    for parameter in ["highlight: Vertices(All)", "marks: [(of: Edges(All))]"] {
        let found = notes(&format!("path: \"a.png\", {parameter}"), &scene);
        assert!(found[0].starts_with("nothing is highlighted"), "{found:?}");
    }
    assert_eq!(notes("path: \"a.png\"", &scene), [""; 0]);
    scene.insert(Object::mesh("cube", shapes::cube())).unwrap();
    let highlighted = "path: \"a.png\", highlight: Vertices(All)";
    assert_eq!(notes(highlighted, &scene), [""; 0]);
}

/// Cancels the run when a task is half done. The field is the name of this task.
struct Halfway(&'static str);

impl op::Progress for Halfway {
    fn advance(&self, what: &str, done: u64, total: u64) -> bool {
        what != self.0 || 2 * done < total
    }
}

#[test]
fn a_picture_that_is_cancelled_halfway_writes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let files = Files {
        output: folder.path().into(),
        ..Files::default()
    };
    for what in ["draw", "encode"] {
        for fields in ["path: \"a.png\"", "path: \"a.gif\", turntable: (frames: 3)"] {
            let halfway = Halfway(what);
            let mut cx = Context::new(&halfway, &files);
            let result = picture(fields).apply(&mut scene(), &mut cx);
            assert!(matches!(result, Err(OpError::Cancelled)), "{what}");
            let written = std::fs::read_dir(folder.path()).unwrap().count();
            assert_eq!(written, 0, "{what}");
        }
    }
}

#[test]
fn scenes_drawn_separately_within_an_extent_look_as_if_drawn_together() {
    let files = Files::default();
    let cx = || Context::new(&NoProgress, &files);
    let [cube, torus] = ["cube", "torus"].map(|name| {
        let mut one = Scene::new();
        let objects = scene();
        let found = objects.objects().iter().find(|o| o.name == name);
        one.insert(found.unwrap().clone()).unwrap();
        one
    });
    for fields in [
        "path: \"a.png\"",
        "path: \"a.png\", color_by: (of: MinAngle)",
        "path: \"a.png\", color_by: (of: Area), views: [Fit(from: Top), Fit(from: Front, projection: Orthographic)]",
        "path: \"a.png\", camera: LookAt(from: (9, 9, 9), to: (0, 0, 0))",
    ] {
        let picture = picture(fields);
        let mut extent = picture.extent(&cube, &mut cx()).unwrap();
        extent.join(picture.extent(&torus, &mut cx()).unwrap());
        let one = picture
            .draw(&[(&cube, "")], Some(&extent), &mut cx())
            .unwrap()
            .0;
        // With the camera `Fit`, the cube appears smaller in a picture of the extent of both objects than in a picture
        // of the cube alone.
        let alone = picture.draw(&[(&cube, "")], None, &mut cx()).unwrap().0;
        assert_eq!(one != alone, !fields.contains("LookAt"), "{fields}");
        if picture.views.is_empty() && picture.color_by.is_none() {
            let beside = [(&cube, "a"), (&torus, "b")];
            let both = &picture.draw(&beside, None, &mut cx()).unwrap().0[0];
            let left: Vec<[u8; 4]> = (0..24)
                .flat_map(|y| both.pixels[y * 64..y * 64 + 32].to_vec())
                .collect();
            // The extent stores only the extreme points of the scenes, so the cameras of the two pictures can differ by
            // rounding errors.
            let pairs = left.iter().zip(&one[0].pixels);
            let differences = pairs.flat_map(|(a, b)| (0..3).map(|i| a[i].abs_diff(b[i])));
            assert!(differences.max() <= Some(2), "{fields}");
        }
    }
}

#[test]
fn a_joined_extent_has_the_color_range_of_all_scenes() {
    let files = Files::default();
    let mut cx = Context::new(&NoProgress, &files);
    let picture = picture("path: \"a.png\", color_by: (of: Area)");
    let extent = |size: f64, cx: &mut Context| {
        let mut scene = Scene::new();
        let mut cube = shapes::cube();
        cube.positions_mut().iter_mut().for_each(|p| *p *= size);
        scene.insert(Object::mesh("cube", cube)).unwrap();
        picture.extent(&scene, cx).unwrap()
    };
    let mut both = extent(1.0, &mut cx);
    let area = both.range().unwrap()[0];
    both.join(extent(2.0, &mut cx));
    assert_eq!(both.range(), Some([area, 4.0 * area]));
    both.join(view::Extent::default());
    assert_eq!(both.range(), Some([area, 4.0 * area]));
}
