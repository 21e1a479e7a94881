//! The texture that the scene is drawn into.

use eframe::wgpu;
use render::Image;

/// The number of samples per pixel.
pub(super) const SAMPLES: u32 = 4;
/// The format for drawing: the device converts linear light to sRGB.
pub(super) const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;
/// The format for egui, which reads sRGB values as they are.
const SHOWN: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
/// The format of depths.
pub(super) const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

pub(super) struct Target {
    pub(super) size: [u32; 2],
    samples: wgpu::TextureView,
    depth: wgpu::TextureView,
    texture: wgpu::Texture,
    resolved: wgpu::TextureView,
    /// The picture for egui.
    pub(super) shown: wgpu::TextureView,
}

impl Target {
    pub(super) fn new(device: &wgpu::Device, size: [u32; 2]) -> Self {
        let texture = |label, sample_count, format, usage, view_formats: &[wgpu::TextureFormat]| {
            device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d {
                    width: size[0],
                    height: size[1],
                    depth_or_array_layers: 1,
                },
                mip_level_count: 1,
                sample_count,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage,
                view_formats,
            })
        };
        let attachment = wgpu::TextureUsages::RENDER_ATTACHMENT;
        let view =
            |texture: &wgpu::Texture| texture.create_view(&wgpu::TextureViewDescriptor::default());
        let samples = view(&texture("samples", SAMPLES, FORMAT, attachment, &[]));
        let depth = view(&texture("depth", SAMPLES, DEPTH, attachment, &[]));
        let usage =
            attachment | wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_SRC;
        let texture = texture("picture", 1, SHOWN, usage, &[FORMAT]);
        Self {
            size,
            samples,
            depth,
            resolved: texture.create_view(&wgpu::TextureViewDescriptor {
                format: Some(FORMAT),
                usage: Some(attachment),
                ..wgpu::TextureViewDescriptor::default()
            }),
            shown: view(&texture),
            texture,
        }
    }

    /// Begins a pass that draws the whole picture.
    pub(super) fn begin<'e>(&self, encoder: &'e mut wgpu::CommandEncoder) -> wgpu::RenderPass<'e> {
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("scene"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &self.samples,
                resolve_target: Some(&self.resolved),
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
                    store: wgpu::StoreOp::Discard,
                },
                depth_slice: None,
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.depth,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(1.0),
                    store: wgpu::StoreOp::Discard,
                }),
                stencil_ops: None,
            }),
            ..wgpu::RenderPassDescriptor::default()
        })
    }

    /// Copies the picture to memory. `None` if the device is lost.
    pub(super) fn read(&self, device: &wgpu::Device, queue: &wgpu::Queue) -> Option<Image> {
        let [width, height] = self.size;
        let alignment = wgpu::COPY_BYTES_PER_ROW_ALIGNMENT;
        let row = (4 * width).next_multiple_of(alignment);
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("picture"),
            size: u64::from(row) * u64::from(height),
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.copy_texture_to_buffer(
            self.texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(row),
                    rows_per_image: None,
                },
            },
            self.texture.size(),
        );
        queue.submit([encoder.finish()]);
        let slice = buffer.slice(..);
        let (sender, receiver) = std::sync::mpsc::channel();
        slice.map_async(wgpu::MapMode::Read, move |result| drop(sender.send(result)));
        device.poll(wgpu::PollType::wait_indefinitely()).ok()?;
        receiver.recv().ok()?.ok()?;
        let bytes = slice.get_mapped_range().ok()?;
        let row = usize::try_from(row).ok()?;
        let used = usize::try_from(4 * width).ok()?;
        let pixels = bytes
            .chunks_exact(row)
            .flat_map(|row| row[..used].chunks_exact(4));
        let pixels = pixels.map(|p| [p[0], p[1], p[2], 255]).collect();
        Some(Image {
            width,
            height,
            pixels,
        })
    }
}
