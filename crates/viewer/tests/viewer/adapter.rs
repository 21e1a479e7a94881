//! The graphics adapter of the tests.

use std::future::Future;
use std::pin::pin;
use std::task::{Context, Poll, Waker};

use eframe::egui_wgpu::{self, RenderState, WgpuSetup};
use eframe::wgpu;
use egui_kittest::wgpu::{create_render_state, default_wgpu_setup};

/// Returns the setup of a graphics adapter. A software renderer is preferred. Returns `None` if no adapter can draw
/// scenes.
pub(crate) fn setup() -> Option<WgpuSetup> {
    let mut setup = default_wgpu_setup();
    if let WgpuSetup::CreateNew(new) = &mut setup {
        // The painter of the viewer does not support OpenGL.
        new.instance_descriptor.backends.remove(wgpu::Backends::GL);
    }
    let instance = wait(setup.new_instance());
    if wait(instance.enumerate_adapters(wgpu::Backends::all())).is_empty() {
        let message = "skipped: no graphics adapter can draw scenes (on Debian: apt-get install mesa-vulkan-drivers)";
        #[expect(
            clippy::print_stderr,
            reason = "the reader of the tests must know that nothing was tested"
        )]
        {
            eprintln!("{message}");
        }
        return None;
    }
    Some(setup)
}

/// Returns a graphics device, or `None` if no adapter can draw scenes.
pub(crate) fn device() -> Option<RenderState> {
    let options = egui_wgpu::RendererOptions::PREDICTABLE;
    Some(create_render_state(setup()?, options))
}

/// Waits for a future that needs no executor.
fn wait<T>(future: impl Future<Output = T>) -> T {
    let mut future = pin!(future);
    loop {
        if let Poll::Ready(value) = future
            .as_mut()
            .poll(&mut Context::from_waker(Waker::noop()))
        {
            return value;
        }
        std::thread::yield_now();
    }
}
