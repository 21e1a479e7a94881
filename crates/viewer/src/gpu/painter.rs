//! Draws a scene into a texture.

use std::sync::Arc;

use bytemuck::{Pod, Zeroable};
use eframe::wgpu;
use glam::{DVec2, DVec3};
use render::{Color, ColorMap, Image, Shading};
use scene::Scene;
use wgpu::util::DeviceExt;

use super::geometry::{LineInstance, PatchVertex, SurfaceLook, narrow};
use super::grid::grid;
use super::objects::{self, Key, Uploaded};
use super::patch::patch;
use super::pipelines::Pipelines;
use super::target::Target;
use super::textures::Textures;
use super::{Look, Overlay, OverlayLine, Wireframe};
use crate::camera::{Camera, UpAxis};

/// The contents of the uniform `Globals` of the shader.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Globals {
    projection: [[f32; 4]; 4],
    rotation: [[f32; 4]; 4],
    size: [f32; 4],
    modes: [u32; 4],
    wire: [f32; 4],
    widths: [f32; 4],
    background: [f32; 4],
    background_top: [f32; 4],
}

/// The contents of the uniform `Object` of the shader.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct ObjectUniform {
    offset: [f32; 4],
    look: SurfaceLook,
}

/// The distance in bytes from the start of one uniform to the start of the next. A multiple of every alignment that
/// devices require.
const STRIDE: u64 = 256;

/// Draws a scene into a texture.
pub struct Painter {
    device: wgpu::Device,
    queue: wgpu::Queue,
    pipelines: Pipelines,
    textures: Textures,
    globals: wgpu::Buffer,
    globals_group: wgpu::BindGroup,
    objects: Vec<Uploaded>,
    /// Two opposite corners of the bounding box of the scene: the lowest and the highest coordinates.
    bounds: Option<[DVec3; 2]>,
    overlay: Uploaded,
    overlay_key: Option<(Overlay, f32)>,
    grid: Uploaded,
    target: Option<Target>,
    legend: Option<(String, ColorMap, [f64; 2])>,
    /// The number of objects that have been uploaded since the start.
    n_uploads: usize,
}

impl Painter {
    /// Creates a painter for a device.
    pub fn new(device: &wgpu::Device, queue: &wgpu::Queue) -> Self {
        let pipelines = Pipelines::new(device);
        let globals = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("globals"),
            size: size_of::<Globals>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let globals_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("globals"),
            layout: &pipelines.globals_layout,
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: globals.as_entire_binding(),
            }],
        });
        Self {
            device: device.clone(),
            queue: queue.clone(),
            pipelines,
            textures: Textures::new(device, queue),
            globals,
            globals_group,
            objects: Vec::new(),
            bounds: None,
            overlay: Uploaded::default(),
            overlay_key: None,
            grid: Uploaded::default(),
            target: None,
            legend: None,
            n_uploads: 0,
        }
    }

    /// Returns the center and the radius of the scene. `None` for an empty scene.
    pub fn extent(&self) -> Option<(DVec3, f64)> {
        // The radius is never 0, even for a single point.
        let sphere = |[min, max]: [DVec3; 2]| {
            let center = 0.5 * (min + max);
            let radius = 0.5 * min.distance(max);
            (
                center,
                if radius > 0.0 {
                    radius
                } else {
                    center.abs().max_element().max(1.0) * 1e-3
                },
            )
        };
        self.bounds.map(sphere)
    }

    /// Guesses which axis of the scene points upwards. Returns z if the scene stands on the plane z = 0 but not on the
    /// plane y = 0, and y otherwise.
    pub fn up_axis(&self) -> UpAxis {
        let Some([min, max]) = self.bounds else {
            return UpAxis::Y;
        };
        let tolerance = 1e-3 * (max - min).max_element();
        let stands = |axis: usize| min[axis].abs() <= tolerance && max[axis] > tolerance;
        if stands(2) && !stands(1) {
            UpAxis::Z
        } else {
            UpAxis::Y
        }
    }

    /// Returns the title, the color map and the range of the numbers that are shown as colors.
    pub fn legend(&self) -> Option<(String, ColorMap, [f64; 2])> {
        self.legend.clone()
    }

    /// Returns the number of objects that have been converted and uploaded since the start.
    pub fn n_uploads(&self) -> usize {
        self.n_uploads
    }

    /// Returns the number of triangles of the scene.
    pub fn n_triangles(&self) -> usize {
        self.objects.iter().map(Uploaded::n_triangles).sum()
    }

    /// Sets the scene and its look. Uploads only objects that are new or have changed. Returns messages about objects,
    /// textures and colors that cannot be drawn.
    pub fn set_scene(&mut self, scene: &Scene, look: &Look) -> Vec<String> {
        let scene = scene.placed();
        let mut messages = Vec::new();
        let numbers = look
            .color_by
            .as_ref()
            .and_then(|by| match by.numbers(&scene, &[]) {
                Ok(numbers) => Some(numbers.colorings),
                Err(error) => {
                    messages.push(error.to_string());
                    None
                }
            });
        let colorings = numbers.unwrap_or_default();
        self.legend = colorings
            .first()
            .zip(look.color_by.as_ref())
            .map(|(coloring, by)| (by.of.title(), coloring.map, coloring.range));
        let mut old = std::mem::take(&mut self.objects);
        for (i, object) in scene.objects().iter().enumerate() {
            let coloring = colorings.iter().find(|c| c.object == object.name);
            let key = Key::new(object, i, look, coloring);
            if let Some(at) = old.iter().position(|o| o.key.as_ref() == Some(&key)) {
                self.objects.push(old.swap_remove(at));
                continue;
            }
            if let Some(at) = old.iter().position(|o| patch(&self.queue, o, &key)) {
                let mut patched = old.swap_remove(at);
                patched.key = Some(key);
                self.objects.push(patched);
                continue;
            }
            self.n_uploads += 1;
            let (device, pipelines) = (&self.device, &self.pipelines);
            let textures = &mut self.textures;
            match objects::upload(device, pipelines, textures, object, key, look, coloring) {
                Ok((uploaded, missing)) => {
                    messages.extend(missing);
                    self.objects.push(uploaded);
                }
                Err(error) => messages.push(format!("\"{}\": {error}", object.name)),
            }
        }
        let chunks = self.objects.iter().flat_map(|object| &object.chunks);
        let used: Vec<_> = chunks.filter_map(|c| c.texture.as_ref()).collect();
        self.textures
            .retain(|texture| used.iter().any(|u| Arc::ptr_eq(u, texture)));
        let bounds = self.objects.iter().filter_map(|o| o.bounds);
        self.bounds = bounds.reduce(|[a, b], [c, d]| [a.min(c), b.max(d)]);
        messages
    }

    /// Uploads the overlay, which is drawn on top of the scene, if the overlay or the scale has changed.
    fn upload_overlay(&mut self, overlay: &Overlay, scale: f32) {
        let is_known = self
            .overlay_key
            .as_ref()
            .is_some_and(|(known, at)| known == overlay && *at == scale);
        if is_known {
            return;
        }
        let center = self.extent().map_or(DVec3::ZERO, |(center, _)| center);
        let line = |(i, line): (usize, &OverlayLine)| {
            let mut instance = LineInstance::new(
                line.ends,
                center,
                line.width * scale,
                line.hidden,
                line.color,
            );
            // The first line of the overlay is half a pixel farther from the camera than the other lines. These lines
            // therefore cover the first line.
            instance.look[2] = 0.5 + if i > 0 { 0.5 } else { 0.0 };
            instance
        };
        let lines: Vec<LineInstance> = overlay.lines.iter().enumerate().map(line).collect();
        let corners = overlay.triangles.iter().flat_map(|(corners, color)| {
            corners.map(|p| PatchVertex {
                at: narrow(p - center),
                color: *color,
            })
        });
        let corners: Vec<PatchVertex> = corners.collect();
        self.overlay = Uploaded::of_lines(&self.device, center, &lines, &corners);
        self.overlay_key = Some((overlay.clone(), scale));
    }

    /// Draws the scene. `size` is the size of the picture in pixels, and `scale` is the number of picture pixels per
    /// logical pixel.
    pub fn draw(
        &mut self,
        camera: &Camera,
        look: &Look,
        overlay: &Overlay,
        size: [u32; 2],
        scale: f32,
    ) {
        let largest = self.device.limits().max_texture_dimension_2d;
        let size = size.map(|n| n.clamp(1, largest));
        if self.target.as_ref().is_none_or(|t| t.size != size) {
            self.target = Some(Target::new(&self.device, size));
        }
        self.upload_overlay(overlay, scale);
        self.write_globals(camera, look, size, scale);
        let group = self.object_group(camera);
        let mut encoder = self
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        self.draw_objects(&mut encoder, &group, look);
        self.queue.submit([encoder.finish()]);
    }

    /// Creates the grid, and writes the values that all objects share.
    fn write_globals(&mut self, camera: &Camera, look: &Look, size: [u32; 2], scale: f32) {
        let (center, radius) = self.extent().unwrap_or((camera.target, camera.distance));
        let pixels = DVec2::new(f64::from(size[0]), f64::from(size[1]));
        let bounds = self.bounds.filter(|_| look.grid);
        let lines = bounds.map_or_else(Vec::new, |bounds| {
            grid(bounds, (center, radius), camera, look)
        });
        self.grid = Uploaded::of_lines(&self.device, center, &lines, &[]);
        // The radius must cover everything that is drawn, and the grid is larger than the scene.
        let (rotation, projection) =
            camera.matrices(pixels, center, radius * if look.grid { 3.2 } else { 1.2 });
        let background = look.background().map(Color::linear);
        let globals = Globals {
            projection: projection.as_mat4().to_cols_array_2d(),
            rotation: rotation.as_mat4().to_cols_array_2d(),
            size: [
                narrow_number(pixels.x),
                narrow_number(pixels.y),
                narrow_number(camera.distance),
                narrow_number(camera.scale(pixels.y)),
            ],
            modes: [
                match look.shading {
                    Shading::Flat | Shading::Smooth => 0,
                    Shading::Phong => 1,
                    Shading::Matcap => 2,
                    Shading::Plain => 3,
                },
                match look.wireframe {
                    Wireframe::None => 0,
                    Wireframe::Shaded => 1,
                    Wireframe::HiddenLine => 2,
                    Wireframe::Lines => 3,
                },
                u32::from(camera.is_perspective),
                1,
            ],
            wire: look.wire(),
            widths: [1.1 * scale, 0.0, 0.0, 0.0],
            background: background[0],
            background_top: background[1],
        };
        self.queue
            .write_buffer(&self.globals, 0, bytemuck::bytes_of(&globals));
    }

    /// Returns the objects in the order in which they are drawn.
    fn uploaded(&self) -> impl Iterator<Item = &Uploaded> {
        self.objects.iter().chain([&self.grid, &self.overlay])
    }

    /// Returns a bind group with the values of all objects and of their chunks. A dynamic offset selects the values of
    /// one object or chunk.
    fn object_group(&self, camera: &Camera) -> wgpu::BindGroup {
        let mut uniforms: Vec<u8> = Vec::new();
        for uploaded in self.uploaded() {
            let [x, y, z] = narrow(uploaded.center - camera.target);
            let looks = uploaded.chunks.iter().map(|c| c.look);
            for look in looks.chain([SurfaceLook::default()]) {
                let uniform = ObjectUniform {
                    offset: [x, y, z, 0.0],
                    look,
                };
                let start = uniforms.len();
                uniforms.extend(bytemuck::bytes_of(&uniform));
                uniforms.resize(start + usize::try_from(STRIDE).unwrap_or(256), 0);
            }
        }
        let uniforms = self
            .device
            .create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: Some("objects"),
                contents: &uniforms,
                usage: wgpu::BufferUsages::UNIFORM,
            });
        self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("objects"),
            layout: &self.pipelines.object_layout,
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                    buffer: &uniforms,
                    offset: 0,
                    size: wgpu::BufferSize::new(size_of::<ObjectUniform>() as u64),
                }),
            }],
        })
    }

    fn draw_objects(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        group: &wgpu::BindGroup,
        look: &Look,
    ) {
        if let Some(target) = &self.target {
            let mut pass = target.begin(encoder);
            pass.set_bind_group(0, &self.globals_group, &[]);
            pass.set_pipeline(&self.pipelines.background);
            pass.draw(0..3, 0..1);
            let only_lines = look.wireframe == Wireframe::Lines;
            let surface = if only_lines {
                &self.pipelines.wire
            } else {
                &self.pipelines.surface
            };
            let mut offset = 0;
            let mut places = Vec::new();
            for uploaded in self.uploaded() {
                pass.set_pipeline(surface);
                for chunk in &uploaded.chunks {
                    pass.set_bind_group(1, group, &[offset]);
                    pass.set_bind_group(2, &chunk.group, &[]);
                    pass.draw(0..chunk.n_corners, 0..1);
                    offset += 256;
                }
                places.push((uploaded, offset));
                offset += 256;
            }
            // Lines are drawn after all surfaces, so that the surfaces of every object can hide them.
            for (uploaded, offset) in places {
                pass.set_bind_group(1, group, &[offset]);
                if let Some((buffer, n)) = &uploaded.patches {
                    pass.set_pipeline(&self.pipelines.patch);
                    pass.set_vertex_buffer(0, buffer.slice(..));
                    pass.draw(0..*n, 0..1);
                }
                if let Some((buffer, n)) = &uploaded.lines {
                    pass.set_vertex_buffer(0, buffer.slice(..));
                    if uploaded.has_hidden {
                        pass.set_pipeline(&self.pipelines.hidden);
                        pass.draw(0..4, 0..*n);
                    }
                    pass.set_pipeline(&self.pipelines.line);
                    pass.draw(0..4, 0..*n);
                }
            }
        }
    }

    /// Returns the texture of the last picture, with colors that are encoded as sRGB. `None` before the first picture.
    pub fn texture(&self) -> Option<&wgpu::TextureView> {
        self.target.as_ref().map(|t| &t.shown)
    }

    /// Copies the last picture to memory. `None` if there is no picture, or the device is lost.
    pub fn read(&self) -> Option<Image> {
        self.target.as_ref()?.read(&self.device, &self.queue)
    }
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "the graphics card computes in single precision"
)]
fn narrow_number(x: f64) -> f32 {
    x as f32
}
