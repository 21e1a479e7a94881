//! The features that the graphics device must have.

use eframe::egui_wgpu::RenderState;

/// The number of storage buffers that the vertex shader of surfaces reads.
const N_STORAGE_BUFFERS: u32 = 5;

/// Whether a [`Painter`](super::Painter) can draw with this device. OpenGL adapters do not have all features that the
/// painter needs.
pub fn can_draw(state: &RenderState) -> bool {
    let limits = state.device.limits();
    let properties = state.adapter.get_downlevel_capabilities();
    limits.max_storage_buffers_per_shader_stage >= N_STORAGE_BUFFERS
        && properties.is_webgpu_compliant()
}
