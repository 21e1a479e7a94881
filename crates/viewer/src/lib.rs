//! The window of the editor. The window draws the scenes that the crate `editor` computes, and passes the input of the
//! user to `editor`.
//!
//! - [`App`]: the window's contents, for eframe and for tests.
//! - [`camera`]: the camera of the view.
//! - [`gpu`]: draws scenes with the graphics card.

mod app;
mod banners;
pub mod camera;
mod code;
mod controls;
mod export;
mod field;
mod files;
pub mod gpu;
mod help;
mod inspector;
mod keyboard;
mod overlay;
mod palette;
mod paths;
mod player;
mod steps_pane;
mod text_pane;
pub mod theme;
mod top_bar;
mod view_pane;
mod widgets;

use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::{Arc, OnceLock};

use eframe::egui;
use op::Registry;
use view_pane::Loss;

pub use app::{App, Opened, Start};

/// The text that explains how to start the program.
const USAGE: &str = "\
Edits a mesh in a window. Every edit becomes a step of a recipe.

Usage: meshwright-viewer [FILE]

FILE is a model or a recipe (.ron). Press H in the window for the list of all keys.";

/// Runs the program with these operations and arguments. Returns 0 if the window was closed, and 2 if the arguments are
/// wrong. Returns 1 if the window could not be opened, or if the graphics adapter was lost.
#[expect(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "this is a program"
)]
pub fn run(registry: Registry, arguments: &[String]) -> ExitCode {
    let path = match arguments {
        [] => None,
        [flag] if flag == "--help" || flag == "-h" => {
            println!("{USAGE}");
            return ExitCode::SUCCESS;
        }
        [flag] if flag == "--version" || flag == "-V" => {
            println!("meshwright-viewer {}", env!("CARGO_PKG_VERSION"));
            return ExitCode::SUCCESS;
        }
        [path] if !path.starts_with('-') || path == "-" => Some(PathBuf::from(path)),
        _ => {
            eprintln!("error: expected at most one file, found {arguments:?}\n\n{USAGE}");
            return ExitCode::from(2);
        }
    };
    let start = Start {
        registry: Arc::new(registry),
        path,
        state_folder: state_folder(),
        has_dialogs: true,
    };
    let remembered = app::Remembered::read(start.state_folder.as_deref());
    let options = eframe::NativeOptions {
        viewport: egui::ViewportBuilder::default()
            .with_title("Meshwright")
            .with_app_id("meshwright")
            .with_inner_size(remembered.size.unwrap_or([1440.0, 900.0]))
            .with_maximized(remembered.is_maximized)
            .with_min_inner_size([720.0, 480.0])
            .with_drag_and_drop(true),
        renderer: eframe::Renderer::Wgpu,
        ..eframe::NativeOptions::default()
    };
    // The engine computes the scene while the window and the graphics device are created.
    let opened = start.open();
    let loss = Arc::new(OnceLock::new());
    let to_loss = loss.clone();
    let result = eframe::run_native(
        "Meshwright",
        options,
        Box::new(move |cc| {
            let app = App::with(&cc.egui_ctx, cc.wgpu_render_state.as_ref(), opened);
            to_loss.get_or_init(|| app.loss());
            Ok(Box::new(app))
        }),
    );
    if let Some(reason) = loss.get().and_then(Loss::reason) {
        eprintln!(
            "error: the graphics adapter was lost: {reason}\n\
             help: start the editor again; it offers the unsaved text of the recipe"
        );
        return ExitCode::FAILURE;
    }
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!(
                "error: the window cannot be opened: {error}\n\
                 help: the window needs a display, and a graphics adapter with Vulkan, Metal or Direct3D 12. \
                 On Debian, `apt-get install mesa-vulkan-drivers` installs a software renderer."
            );
            ExitCode::FAILURE
        }
    }
}

/// Returns the folder for recent files and journals.
fn state_folder() -> Option<PathBuf> {
    use etcetera::BaseStrategy;
    let strategy = etcetera::choose_base_strategy().ok()?;
    let folder = strategy.state_dir().unwrap_or_else(|| strategy.data_dir());
    Some(folder.join("meshwright"))
}
