//! The window, driven by clicks and keys as a person would.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use eframe::egui::{Key, Modifiers, PointerButton, Pos2, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use engine::{Engine, Options, Run, Silent};
use mesh::DVec3;
use render::Image;
use viewer::{App, Start};

use crate::adapter::setup;

/// The largest number of pixels that may differ from a stored picture. Software renderers differ a little.
const MAX_DIFFERENT: usize = 6000;

struct Window {
    harness: Harness<'static, App>,
    folder: tempfile::TempDir,
}

impl Window {
    /// Opens a window with a file of this name and content. `None` if there is no graphics adapter.
    fn open(name: &str, content: &str) -> Option<Self> {
        let setup = setup()?;
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(name);
        std::fs::write(&path, content).unwrap();
        let start = Start {
            path: Some(path),
            state_folder: Some(folder.path().join("state")),
        };
        let harness = Harness::builder()
            .with_size(Vec2::new(1280.0, 800.0))
            .with_theme(eframe::egui::Theme::Dark)
            .with_max_steps(60)
            .wgpu_setup(setup)
            .build_eframe(|cc| App::new(&cc.egui_ctx, cc.wgpu_render_state.as_ref(), &start));
        let mut window = Self { harness, folder };
        window.settle();
        Some(window)
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Waits until the run has ended and the window is still.
    fn settle(&mut self) {
        let end = Instant::now() + Duration::from_mins(1);
        loop {
            self.harness.run_steps(2);
            if !self.harness.state().editor().is_running() {
                break;
            }
            assert!(Instant::now() < end, "the run does not end");
            std::thread::sleep(Duration::from_millis(5));
        }
        // The spatial index of the new mesh is built in the background.
        let scene = self.harness.state().editor().view().scene;
        for object in scene.objects() {
            if let Some(mesh) = object.as_mesh() {
                self.harness.state().editor().indexes().wait_for(mesh);
            }
        }
        self.harness.run_steps(4);
    }

    fn text(&self) -> String {
        self.harness.state().editor().text().to_owned()
    }

    fn press(&mut self, key: Key) {
        self.harness.key_press(key);
        self.settle();
    }

    fn press_with(&mut self, modifiers: Modifiers, key: Key) {
        self.harness.key_press_modifiers(modifiers, key);
        self.settle();
    }

    /// Returns the position of a point of the scene on the screen.
    fn at(&self, point: DVec3) -> Pos2 {
        let view = self.harness.get_by(|node| {
            node.label()
                .is_some_and(|label| label.starts_with("3D view"))
        });
        let [x, y] = self.harness.state().pixel_of(point).unwrap();
        view.rect().min + Vec2::new(narrow(x), narrow(y))
    }

    fn click(&mut self, at: Pos2, modifiers: Modifiers) {
        use eframe::egui::Event;
        self.harness.hover_at(at);
        self.harness.run_steps(1);
        for pressed in [true, false] {
            self.harness.event_modifiers(
                Event::PointerButton {
                    pos: at,
                    button: PointerButton::Primary,
                    pressed,
                    modifiers,
                },
                modifiers,
            );
            self.harness.run_steps(1);
        }
        self.harness.run_steps(1);
    }

    /// Returns the middle of the edge between two vertices of the only object.
    fn edge_middle(&self, v: usize, w: usize) -> DVec3 {
        let scene = self.harness.state().editor().view().scene;
        let mesh = scene.objects()[0].as_mesh().unwrap().clone();
        let [p, q] = [v, w].map(|i| mesh.position(mesh::VertexId::new(i)));
        0.5 * (p + q)
    }

    /// Returns an edge between two faces that both face the camera, as the numbers of its vertices.
    fn visible_edge(&self) -> [usize; 2] {
        let scene = self.harness.state().editor().view().scene;
        let mesh = scene.objects()[0].as_mesh().unwrap().clone();
        let from = DVec3::new(0.46, 0.37, 0.8);
        let visible =
            |f: Option<mesh::FaceId>| f.is_some_and(|f| mesh.face_normal(f).dot(from) > 0.3);
        let e = mesh
            .edges()
            .find(|&e| mesh.edge_faces(e).into_iter().all(visible))
            .unwrap();
        mesh.edge_vertices(e).map(mesh::VertexId::index)
    }

    fn picture(&mut self) -> Image {
        let image = self.harness.render().unwrap();
        let (width, height) = image.dimensions();
        let pixels = image.pixels().map(|pixel| pixel.0).collect();
        Image {
            width,
            height,
            pixels,
        }
    }

    /// Compares the window with a stored picture. With the environment variable `UPDATE_PICTURES`, stores it.
    fn check_picture(&mut self, name: &str) {
        self.harness.remove_cursor();
        self.settle();
        let image = self.picture();
        let file = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("../../book/src/images")
            .join(format!("editor_{name}.png"));
        let found = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("editor_{name}.png"));
        std::fs::write(&found, image.to_png(&[]).unwrap()).unwrap();
        if std::env::var_os("UPDATE_PICTURES").is_some() {
            std::fs::write(&file, image.to_png(&[]).unwrap()).unwrap();
        }
        let bytes =
            std::fs::read(&file).unwrap_or_else(|_| panic!("{} is missing", file.display()));
        let expected = Image::from_png(&bytes).unwrap();
        assert_eq!(
            (expected.width, expected.height),
            (image.width, image.height)
        );
        let differs =
            |(p, q): (&[u8; 4], &[u8; 4])| p.iter().zip(q).any(|(x, y)| x.abs_diff(*y) > 24);
        let n = expected
            .pixels
            .iter()
            .zip(&image.pixels)
            .filter(|&pair| differs(pair))
            .count();
        assert!(
            n <= MAX_DIFFERENT,
            "{n} pixels differ: compare {} with {}, and set UPDATE_PICTURES=1 to replace it",
            found.display(),
            file.display()
        );
    }
}

const CUBE: &str = "(
    recipe: 1,
    params: { \"size\": Float(default: 2.0, min: 1.0, max: 4.0, doc: \"The length of the edges.\") },
    steps: [
        // The start of everything.
        Cube(name: \"cube\", size: arg(\"size\"), triangles: true),
    ],
    expect: [Manifold, Closed],
)
";

/// Runs a recipe without the window, and returns its digest.
fn digest(path: &Path) -> String {
    let registry = ops_all::registry();
    let engine = Engine::new(&registry);
    let recipe = engine.load(&engine.open(path).unwrap(), &Options::default());
    assert!(!recipe.has_errors(), "{:?}", recipe.diagnostics);
    recipe.run(Run::default(), &Silent).digest.to_string()
}

#[test]
fn a_cube_is_edited_by_clicks_and_keys_and_its_recipe_replays_to_the_same_digest() {
    let Some(mut window) = Window::open("cube.ron", CUBE) else {
        return;
    };
    let [v, w] = window.visible_edge();
    let at = window.at(window.edge_middle(v, w));
    window.click(at, Modifiers::NONE);
    assert!(
        window
            .harness
            .query_all_by_label_contains(&format!("edge {v} to {w}"))
            .next()
            .is_some()
    );
    window.check_picture("picked");

    window.press(Key::F);
    assert!(
        window
            .text()
            .contains(&format!("FlipEdges(edges: Between({v}, {w}))")),
        "{}",
        window.text()
    );
    let flipped = window.text();
    let [v, w] = window.visible_edge();
    let at = window.at(window.edge_middle(v, w));
    window.click(at, Modifiers::NONE);
    window.press(Key::S);
    assert!(window.text().contains("SplitEdges"), "{}", window.text());
    window.press_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(window.text(), flipped);
    window.press_with(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    assert!(window.text().contains("SplitEdges"));
    window.press(Key::L);
    assert!(
        window.text().contains("LoopSubdivide(levels: 1)"),
        "{}",
        window.text()
    );

    // A slider of the parameters of the step.
    window
        .harness
        .get_by_role_and_label(eframe::egui::accesskit::Role::Slider, "levels")
        .set_value_accesskit(3.0);
    window.settle();
    assert!(
        window.text().contains("LoopSubdivide(levels: 3)"),
        "{}",
        window.text()
    );
    window.check_picture("subdivided");

    window.press_with(Modifiers::COMMAND, Key::S);
    let saved = std::fs::read_to_string(window.path("cube.ron")).unwrap();
    assert_eq!(saved, window.text());
    assert!(saved.contains("// The start of everything."));
    let shown = window
        .harness
        .state()
        .editor()
        .run()
        .digest
        .unwrap()
        .to_string();
    assert_eq!(digest(&window.path("cube.ron")), shown);
}

#[test]
fn a_recipe_with_an_error_keeps_its_text_and_shows_the_message() {
    let text = CUBE.replace("Cube(", "Cubee(");
    let Some(mut window) = Window::open("cube.ron", &text) else {
        return;
    };
    assert!(
        window
            .harness
            .query_all_by_label_contains("Cubee")
            .next()
            .is_some()
    );
    assert_eq!(window.text(), text);
    window.check_picture("error");
    // Once the error is corrected, the cube is there.
    let corrected = text.replace("Cubee(", "Cube(");
    window.harness.state_mut().editor_mut().set_text(&corrected);
    window.settle();
    assert_eq!(
        window.harness.state().editor().view().scene.objects().len(),
        1
    );
}

#[test]
fn a_file_that_changes_on_disk_is_followed() {
    let Some(mut window) = Window::open("cube.ron", CUBE) else {
        return;
    };
    let changed = CUBE.replace(
        "size: arg(\"size\"), triangles: true",
        "size: 3, triangles: false",
    );
    std::fs::write(window.path("cube.ron"), &changed).unwrap();
    let end = Instant::now() + Duration::from_secs(30);
    while window.text() != changed {
        assert!(Instant::now() < end, "the change is not followed");
        std::thread::sleep(Duration::from_millis(20));
        window.settle();
    }
    assert_eq!(
        window.harness.state().editor().view().scene.objects()[0]
            .as_mesh()
            .unwrap()
            .n_faces(),
        6
    );
}

#[test]
fn an_idle_window_asks_for_no_repaint() {
    let Some(mut window) = Window::open("cube.ron", CUBE) else {
        return;
    };
    window.harness.run_steps(20);
    let delays: Vec<Duration> = window
        .harness
        .output()
        .viewport_output
        .values()
        .map(|output| output.repaint_delay)
        .collect();
    assert!(
        delays.iter().all(|delay| *delay > Duration::from_secs(10)),
        "{delays:?}"
    );
}

#[test]
fn the_palette_finds_operations_and_the_help_lists_all_keys() {
    let Some(mut window) = Window::open("cube.ron", CUBE) else {
        return;
    };
    window.press_with(Modifiers::COMMAND, Key::K);
    window
        .harness
        .get_by_label("Search operations")
        .type_text("poke");
    window.settle();
    window.check_picture("palette");
    window.press(Key::Enter);
    assert!(window.text().contains("PokeFaces"), "{}", window.text());
    window.press(Key::H);
    for text in [
        "Keys and mouse",
        "flip the picked edges",
        "search all operations",
    ] {
        assert!(
            window.harness.query_by_label_contains(text).is_some(),
            "{text}"
        );
    }
    window.check_picture("help");
    window.press(Key::Escape);
    assert!(
        window
            .harness
            .query_by_label_contains("Keys and mouse")
            .is_none()
    );
}

#[test]
fn an_unsaved_text_is_offered_after_a_crash() {
    let Some(mut window) = Window::open("cube.ron", CUBE) else {
        return;
    };
    window.press(Key::L);
    let lost = window.text();
    let Window { harness, folder } = window;
    // The window ends without the events of closing, as in a crash.
    std::mem::forget(harness);
    let start = Start {
        path: None,
        state_folder: Some(folder.path().join("state")),
    };
    let Some(setup) = setup() else { return };
    let harness = Harness::builder()
        .with_size(Vec2::new(1280.0, 800.0))
        .with_max_steps(60)
        .wgpu_setup(setup)
        .build_eframe(|cc| App::new(&cc.egui_ctx, cc.wgpu_render_state.as_ref(), &start));
    let mut window = Window { harness, folder };
    window.settle();
    window.harness.get_by_label("Recover").click();
    window.settle();
    assert_eq!(window.text(), lost);
}

#[test]
fn the_help_of_the_course_walks_around_half_edges() {
    let Some(mut window) = Window::open("cube.ron", CUBE) else {
        return;
    };
    let [v, w] = window.visible_edge();
    let at = window.at(window.edge_middle(v, w));
    window.click(at, Modifiers::NONE);
    let half_edge = |window: &Window| {
        window
            .harness
            .state()
            .editor()
            .picked()
            .unwrap()
            .half_edge
            .unwrap()
    };
    let start = half_edge(&window);
    window.press(Key::T);
    assert_eq!(half_edge(&window), start.twin());
    window.press(Key::T);
    for _ in 0..3 {
        window.press(Key::N);
    }
    assert_eq!(half_edge(&window), start);
    window.press(Key::N);
    window.press(Key::P);
    assert_eq!(half_edge(&window), start);
}

#[test]
fn the_teapot_is_colored_by_curvature_in_a_light_window() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/assets/teapot.bez");
    let teapot = std::fs::read_to_string(path).unwrap();
    let Some(mut window) = Window::open("teapot.bez", &teapot) else {
        return;
    };
    let text = window.text().replace("Load(path: \"teapot.bez\"),", "Load(path: \"teapot.bez\"),\n        Tessellate(segments: 10),\n        Weld(distance: 1e-6),");
    window.harness.state_mut().editor_mut().set_text(&text);
    window.harness.state_mut().editor_mut().set_cursor(3);
    window.settle();
    window.harness.state_mut().look_mut().color_by =
        Some(view::ColorBy::new(view::Quantity::MeanCurvature));
    window.harness.ctx.set_theme(eframe::egui::Theme::Light);
    window.press(Key::Space);
    window.check_picture("curvature");
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "positions on the screen are small"
)]
fn narrow(x: f64) -> f32 {
    x as f32
}
