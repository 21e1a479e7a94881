//! Measures times and memory of the viewer. To run the measurements:
//! `cargo test -p meshwright-viewer times -- --ignored --nocapture --test-threads 1`.

use std::time::{Duration, Instant};

use editor::{PickMode, Picked};
use eframe::egui::Key;
use geometry::shapes;
use glam::DVec2;
use mesh::{EdgeId, Element};
use viewer::gpu::{Look, Overlay};

use crate::adapter::device;
use crate::drawing::{Stage, scene};
use crate::window::Window;

/// A recipe with a mesh of one million triangles.
const MILLION: &str =
    "(recipe: 1, steps: [Torus(name: \"torus\", around: 1000, across: 500), Triangulate()])";

/// Prints the times of converting, uploading and drawing meshes of increasing size.
#[test]
#[ignore = "a measurement"]
fn times_of_growing_meshes() {
    let Some(state) = device() else { return };
    for rings in [50, 160, 500, 1600] {
        let ball = scene(shapes::uv_sphere(2 * rings, rings));
        let look = Look {
            grid: false,
            ..Look::default()
        };
        let begin = Instant::now();
        let mut stage = Stage::new(&state, &ball, &look);
        let upload = begin.elapsed();
        stage.draw(&look, &Overlay::default());
        let begin = Instant::now();
        let n = 5;
        for _ in 0..n {
            stage.camera.orbit(DVec2::new(5.0, 0.0));
            stage.draw(&look, &Overlay::default());
        }
        let frame = begin.elapsed() / n;
        let triangles = stage.painter.n_triangles();
        eprintln!("{triangles} triangles: uploaded in {upload:.0?}, frame in {frame:.0?}");
    }
}

/// Prints three times: from the key press to the next frame, from the key press to the changed scene, and the time of
/// the step alone.
#[test]
#[ignore = "a measurement"]
fn times_of_an_edit_of_a_million_triangles() {
    let Some(mut window) = Window::open("a.ron", MILLION) else {
        return;
    };
    for (key, name) in [(Key::F, "flip"), (Key::S, "split"), (Key::F, "flip")] {
        let picked = Picked::one("torus", Element::Edge(EdgeId::new(4321)));
        window
            .harness
            .state_mut()
            .editor_mut()
            .set_picked(Some(picked));
        window.settle();
        let before = window.harness.state().editor().view().scene;
        let begin = Instant::now();
        window.harness.key_press(key);
        window.harness.run_steps(1);
        let pressed = begin.elapsed();
        while {
            let view = window.harness.state().editor().view();
            !view.is_current || std::sync::Arc::ptr_eq(&view.scene, &before)
        } {
            window.harness.run_steps(1);
            std::thread::sleep(Duration::from_millis(1));
        }
        let all = begin.elapsed();
        eprintln!("{name}: key {pressed:.0?}, frame after {all:.0?}");
        let run = window.harness.state().editor().run();
        let step = run.steps.last().and_then(|step| step.result.as_ref());
        eprintln!(
            "  the step alone {:.0?}",
            step.map(|result| result.done.time)
        );
        window.settle();
    }
}

/// Prints the times of the parts of an edit, without a window: selection, text, new scene, end of the run, and upload.
#[test]
#[ignore = "a measurement"]
fn times_of_the_engine_for_an_edit_of_a_million_triangles() {
    let registry = std::sync::Arc::new(ops_all::registry());
    let settings = editor::Settings::default();
    let store = std::sync::Arc::new(engine::Disk);
    let mut editor = editor::Editor::new(registry, store, settings);
    editor.set_text(MILLION);
    editor.wait(Duration::from_mins(1));
    let state = device();
    for name in ["FlipEdges", "SplitEdges", "FlipEdges"] {
        let picked = Picked::one("torus", Element::Edge(EdgeId::new(4321)));
        editor.set_picked(Some(picked));
        let before = editor.view().scene;
        let begin = Instant::now();
        let selection = editor.selection();
        let selected = begin.elapsed();
        let command = editor::Command {
            selection,
            ..editor::Command::new(name)
        };
        editor.apply(&command).unwrap();
        let applied = begin.elapsed();
        while std::sync::Arc::ptr_eq(&editor.view().scene, &before) {
            editor.poll();
            std::thread::sleep(Duration::from_micros(200));
        }
        let shown = begin.elapsed();
        editor.wait(Duration::from_mins(1));
        eprintln!(
            "{name}: selection {selected:.0?}, text {applied:.0?}, scene {shown:.0?}, end {:.0?}",
            begin.elapsed()
        );
        if let Some(state) = &state {
            let look = Look::default();
            let mut stage = Stage::new(state, &before, &look);
            let begin = Instant::now();
            stage.painter.set_scene(&editor.view().scene, &look);
            eprintln!("  conversion and upload {:.0?}", begin.elapsed());
        }
    }
}

/// Prints the times of picks on a million triangles.
#[test]
#[ignore = "a measurement"]
fn times_of_picks_on_a_million_triangles() {
    let scene = scene(shapes::torus(1000, 500, 1.0, 0.4));
    let indexes = editor::Indexes::new();
    let mesh = scene.objects()[0].as_mesh().unwrap();
    let begin = Instant::now();
    indexes.wait_for(mesh);
    eprintln!("index of {} faces: {:.0?}", mesh.n_faces(), begin.elapsed());
    let size = DVec2::new(1280.0, 800.0);
    let mut camera = viewer::camera::Camera::default();
    camera.fit(mesh::DVec3::ZERO, 1.5, size);
    let view = editor::Projection::new(camera.clip_matrix(size, mesh::DVec3::ZERO, 1.5), size);
    let mut times: Vec<Duration> = (0..10_000_u32)
        .map(|i| {
            let at = DVec2::new(f64::from(i * 7919 % 1280), f64::from(i * 104_729 % 800));
            let begin = Instant::now();
            std::hint::black_box(editor::pick(&scene, &indexes, &view, at, PickMode::Any));
            begin.elapsed()
        })
        .collect();
    times.sort_unstable();
    eprintln!(
        "pick: median {:.0?}, 99 % below {:.0?}",
        times[5000], times[9900]
    );
}

/// Opens a file of a million triangles, and measures the time until the window shows the scene. Compares this time with
/// the time that `meshwright info` takes for the same file. Needs the program `meshwright` of the same profile.
#[test]
#[ignore = "a measurement"]
fn times_of_opening_a_file_of_a_million_triangles() {
    let model = million();
    let info = || {
        let test = std::env::current_exe().unwrap();
        let program = test.ancestors().nth(2).unwrap().join("meshwright");
        let begin = Instant::now();
        let mut command = std::process::Command::new(program);
        let result = command
            .arg("info")
            .arg(model.path().join("torus.glb"))
            .output();
        let is_found = result.is_ok_and(|info| info.status.success());
        is_found.then(|| begin.elapsed())
    };
    let (mut windows, mut scenes, mut frames, mut ratios) = (vec![], vec![], vec![], vec![]);
    for _ in 0..9 {
        let info = info();
        let folder = tempfile::tempdir().unwrap();
        let begin = Instant::now();
        let Some(mut window) = Window::start(model.path().join("torus.glb"), folder) else {
            return;
        };
        windows.push(begin.elapsed());
        while window
            .harness
            .state()
            .editor()
            .view()
            .scene
            .objects()
            .is_empty()
        {
            std::thread::sleep(Duration::from_millis(1));
            window.harness.state_mut().editor_mut().poll();
        }
        scenes.push(begin.elapsed());
        window.harness.run_steps(1);
        frames.push(begin.elapsed());
        if let Some(info) = info {
            ratios.push(begin.elapsed().as_secs_f64() / info.as_secs_f64());
        }
    }
    eprintln!(
        "window after {:.0?}, scene after {:.0?}, frame after {:.0?}",
        median(windows),
        median(scenes),
        median(frames),
    );
    if !ratios.is_empty() {
        eprintln!("relative to meshwright info: {:.2}", median(ratios));
    }
}

/// The memory of a window that shows a file with a million triangles.
#[test]
#[ignore = "a measurement"]
fn memory_of_a_file_of_a_million_triangles() {
    let folder = million();
    let path = folder.path().join("torus.glb");
    let before = resident();
    let Some(window) = Window::open_file(path, folder) else {
        return;
    };
    let memory = resident() - before;
    let scene = window.harness.state().editor().view().scene;
    let bytes = scene.objects()[0].as_mesh().unwrap().bytes();
    eprintln!("mesh {bytes} bytes, memory {memory} bytes");
}

/// Returns a folder with a file `torus.glb` of a million triangles.
fn million() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let options = mesh_io::WriteOptions::default();
    let torus = scene(shapes::torus(1000, 500, 1.0, 0.4));
    mesh_io::write(
        &engine::Disk,
        &folder.path().join("torus.glb"),
        &torus,
        &options,
    )
    .unwrap();
    folder
}

fn median<T: PartialOrd + Copy>(mut values: Vec<T>) -> T {
    values.sort_by(|a, b| a.partial_cmp(b).unwrap());
    values[values.len() / 2]
}

/// Returns the memory of this process in bytes, where it is known.
fn resident() -> usize {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"));
    let number = line.and_then(|line| line.split_whitespace().next()?.parse::<usize>().ok());
    number.unwrap_or(0) * 1024
}
