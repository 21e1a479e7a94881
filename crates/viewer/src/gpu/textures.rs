//! The images of materials on the graphics card.

use std::sync::Arc;

use eframe::wgpu;
use render::{Texture, TextureCache};
use scene::{Filter, Wrap};

/// An image on the graphics card, and the sampler for this image.
type Sampled = (wgpu::TextureView, wgpu::Sampler);

/// The textures of the objects that are drawn. A texture is decoded and uploaded once for all objects.
pub(super) struct Textures {
    device: wgpu::Device,
    queue: wgpu::Queue,
    pub(super) decoded: TextureCache,
    uploaded: Vec<(Arc<Texture>, Sampled)>,
    /// A white pixel, for surfaces without a texture.
    white: Sampled,
}

impl Textures {
    pub(super) fn new(device: &wgpu::Device, queue: &wgpu::Queue) -> Self {
        let white = create(device, [1, 1], 1, &wgpu::SamplerDescriptor::default());
        write(queue, &white.0, 0, [1, 1], &[[255; 4]]);
        Self {
            device: device.clone(),
            queue: queue.clone(),
            decoded: TextureCache::default(),
            uploaded: Vec::new(),
            white: view(white),
        }
    }

    /// Returns a texture on the graphics card. Without a texture, returns a white pixel.
    pub(super) fn get(&mut self, texture: Option<&Arc<Texture>>) -> Sampled {
        let Some(texture) = texture else {
            return self.white.clone();
        };
        let mut known = self.uploaded.iter();
        if let Some((_, known)) = known.find(|(of, _)| Arc::ptr_eq(of, texture)) {
            return known.clone();
        }
        let new = upload(&self.device, &self.queue, texture);
        self.uploaded.push((texture.clone(), new.clone()));
        new
    }

    /// Frees the textures for which `is_used` returns false.
    pub(super) fn retain(&mut self, is_used: impl Fn(&Arc<Texture>) -> bool) {
        self.uploaded.retain(|(texture, _)| is_used(texture));
        self.decoded.retain(is_used);
    }
}

/// Uploads a texture with its mipmap. If the image is too large for the device, its first mipmap levels are left out.
fn upload(device: &wgpu::Device, queue: &wgpu::Queue, texture: &Texture) -> Sampled {
    let largest = device.limits().max_texture_dimension_2d;
    let [width, height] = texture.size();
    let n_levels = width.max(height).max(1).ilog2() + 1;
    let first = (0..n_levels).find(|level| width.max(height) >> level <= largest);
    let first = first.unwrap_or(0);
    let size = [width, height].map(|n| (n >> first).max(1));
    let sampler = texture.sampler();
    let [address_mode_u, address_mode_v] = sampler.wrap.map(|wrap| match wrap {
        Wrap::Repeat => wgpu::AddressMode::Repeat,
        Wrap::Mirror => wgpu::AddressMode::MirrorRepeat,
        Wrap::Clamp => wgpu::AddressMode::ClampToEdge,
    });
    let sampler = wgpu::SamplerDescriptor {
        address_mode_u,
        address_mode_v,
        mag_filter: if sampler.magnify == Some(Filter::Nearest) {
            wgpu::FilterMode::Nearest
        } else {
            wgpu::FilterMode::Linear
        },
        min_filter: wgpu::FilterMode::Linear,
        mipmap_filter: wgpu::MipmapFilterMode::Linear,
        ..wgpu::SamplerDescriptor::default()
    };
    let created = create(device, size, n_levels - first, &sampler);
    for level in 0..n_levels - first {
        let image = texture.level(first + level);
        let size = [image.width, image.height];
        write(queue, &created.0, level, size, &image.pixels);
    }
    view(created)
}

fn create(
    device: &wgpu::Device,
    [width, height]: [u32; 2],
    n_levels: u32,
    sampler: &wgpu::SamplerDescriptor,
) -> (wgpu::Texture, wgpu::Sampler) {
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: Some("image"),
        size: wgpu::Extent3d {
            width,
            height,
            depth_or_array_layers: 1,
        },
        mip_level_count: n_levels,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba8UnormSrgb,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    (texture, device.create_sampler(sampler))
}

fn write(
    queue: &wgpu::Queue,
    texture: &wgpu::Texture,
    level: u32,
    [width, height]: [u32; 2],
    pixels: &[[u8; 4]],
) {
    let mut to = texture.as_image_copy();
    to.mip_level = level;
    let layout = wgpu::TexelCopyBufferLayout {
        offset: 0,
        bytes_per_row: Some(4 * width),
        rows_per_image: Some(height),
    };
    let size = wgpu::Extent3d {
        width,
        height,
        depth_or_array_layers: 1,
    };
    queue.write_texture(to, bytemuck::cast_slice(pixels), layout, size);
}

fn view((texture, sampler): (wgpu::Texture, wgpu::Sampler)) -> Sampled {
    let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
    (view, sampler)
}
