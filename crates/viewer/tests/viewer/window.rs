//! A window of the editor. Tests send clicks and keys to the window, as a person would.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use eframe::egui::{Key, Modifiers, PointerButton, Pos2, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use mesh::DVec3;
use render::Image;
use viewer::{App, Start};

use crate::adapter::setup;

/// The largest number of pixels that may differ from a stored picture. Software renderers differ a little.
const MAX_DIFFERENT: usize = 6000;

pub(crate) struct Window {
    pub(crate) harness: Harness<'static, App>,
    pub(crate) folder: tempfile::TempDir,
}

impl Window {
    /// Writes a file with this name and content, and opens a window with this file. Returns `None` if there is no
    /// graphics adapter.
    pub(crate) fn open(name: &str, content: &str) -> Option<Self> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(name);
        std::fs::write(&path, content).unwrap();
        Self::open_file(path, folder)
    }

    /// Opens a window with a file, and waits until the run has ended. Returns `None` if there is no graphics adapter.
    pub(crate) fn open_file(path: PathBuf, folder: tempfile::TempDir) -> Option<Self> {
        let mut window = Self::start(path, folder)?;
        window.settle();
        Some(window)
    }

    /// Opens a window with a file, but does not wait until the run has ended. Returns `None` if there is no graphics
    /// adapter.
    pub(crate) fn start(path: PathBuf, folder: tempfile::TempDir) -> Option<Self> {
        let setup = setup()?;
        let start = Start {
            path: Some(path),
            state_folder: Some(folder.path().join("state")),
            ..Start::default()
        };
        let opened = start.open();
        let harness = Harness::builder()
            .with_size(Vec2::new(1280.0, 800.0))
            .with_theme(eframe::egui::Theme::Dark)
            .with_max_steps(60)
            .wgpu_setup(setup)
            .build_eframe(|cc| App::with(&cc.egui_ctx, cc.wgpu_render_state.as_ref(), opened));
        Some(Self { harness, folder })
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Waits until the run of the recipe has ended and the window no longer changes.
    pub(crate) fn settle(&mut self) {
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

    pub(crate) fn text(&self) -> String {
        self.harness.state().editor().text().to_owned()
    }

    pub(crate) fn press(&mut self, key: Key) {
        self.harness.key_press(key);
        self.settle();
    }

    pub(crate) fn press_with(&mut self, modifiers: Modifiers, key: Key) {
        self.harness.key_press_modifiers(modifiers, key);
        self.settle();
    }

    /// Returns the position of a point of the scene on the screen.
    pub(crate) fn at(&self, point: DVec3) -> Pos2 {
        let view = self.harness.get_by(|node| {
            node.label()
                .is_some_and(|label| label.starts_with("3D view"))
        });
        let [x, y] = self.harness.state().pixel_of(point).unwrap();
        view.rect().min + Vec2::new(narrow(x), narrow(y))
    }

    pub(crate) fn click(&mut self, at: Pos2, modifiers: Modifiers) {
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

    /// Drags with the left button through these points.
    pub(crate) fn drag(&mut self, through: &[Pos2], modifiers: Modifiers) {
        use eframe::egui::Event;
        let button = |pos, pressed| Event::PointerButton {
            pos,
            button: PointerButton::Primary,
            pressed,
            modifiers,
        };
        let (Some(first), Some(last)) = (through.first(), through.last()) else {
            return;
        };
        self.harness.hover_at(*first);
        self.harness.event(Event::ModifiersChanged(modifiers));
        self.harness.run_steps(1);
        self.harness.event(button(*first, true));
        self.harness.run_steps(1);
        for at in through {
            self.harness.event(Event::PointerMoved(*at));
            self.harness.run_steps(1);
        }
        self.harness.event(button(*last, false));
        self.harness.run_steps(1);
        self.harness.event(Event::ModifiersChanged(Modifiers::NONE));
        self.harness.run_steps(2);
        self.settle();
    }

    /// Returns the middle of the edge between two vertices of the only object.
    pub(crate) fn edge_middle(&self, v: usize, w: usize) -> DVec3 {
        let scene = self.harness.state().editor().view().scene;
        let mesh = scene.objects()[0].as_mesh().unwrap().clone();
        let [p, q] = [v, w].map(|i| mesh.position(mesh::VertexId::new(i)));
        0.5 * (p + q)
    }

    /// Returns the indices of the two vertices of an edge whose two faces both face the camera.
    pub(crate) fn visible_edge(&self) -> [usize; 2] {
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

    pub(crate) fn picture(&mut self) -> Image {
        let image = self.harness.render().unwrap();
        let (width, height) = image.dimensions();
        let pixels = image.pixels().map(|pixel| pixel.0).collect();
        Image {
            width,
            height,
            pixels,
        }
    }

    /// Compares the window with a stored picture. If the environment variable `UPDATE_PICTURES` is set, first stores
    /// the picture of the window.
    pub(crate) fn check_picture(&mut self, name: &str) {
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

/// A recipe with a cube of triangles.
pub(crate) const CUBE: &str = "(
    recipe: 1,
    params: { \"size\": Float(default: 2.0, min: 1.0, max: 4.0, doc: \"The length of the edges.\") },
    steps: [
        // The start of everything.
        Cube(name: \"cube\", size: arg(\"size\"), triangles: true),
    ],
    expect: [Manifold, Closed],
)
";

#[expect(
    clippy::cast_possible_truncation,
    reason = "positions on the screen are small"
)]
fn narrow(x: f64) -> f32 {
    x as f32
}
