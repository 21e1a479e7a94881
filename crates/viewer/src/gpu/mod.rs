//! Draws scenes with the graphics card.
//!
//! ```text
//!   scene --render::build--> drawing --geometry--> buffers --shader.wgsl--> texture --egui--> window
//! ```
//!
//! [`Painter`] keeps the buffers of each object. An object is converted and uploaded again only if its geometry, which
//! is compared by address, or the [`Look`] changes. The picture depends only on the scene, the look, the overlay and
//! the camera, not on earlier pictures.

mod geometry;
mod objects;
mod pipelines;
mod target;

use bytemuck::{Pod, Zeroable};
use eframe::wgpu;
use glam::{DVec2, DVec3};
use render::{Color, ColorMap, Image, Shading};
use scene::Scene;
use view::{ColorBy, Quantity};
use wgpu::util::DeviceExt;

use crate::camera::{Camera, UpAxis};
pub use geometry::LineInstance;
use geometry::{SurfaceLook, narrow};
use objects::{Key, Uploaded};
use pipelines::Pipelines;
use target::Target;

/// The lines of surfaces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wireframe {
    /// No lines.
    None,
    /// Lines on top of the shaded surface.
    #[default]
    Shaded,
    /// Lines only; the surface hides the lines behind it.
    HiddenLine,
    /// All lines, and no surface.
    Lines,
}

/// The appearance of a scene.
#[derive(Clone, Debug, PartialEq)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "the switches are independent"
)]
pub struct Look {
    /// The lighting.
    pub shading: Shading,
    /// The lines of surfaces.
    pub wireframe: Wireframe,
    /// Whether boundary edges are drawn.
    pub boundary: bool,
    /// Whether creases are drawn.
    pub creases: bool,
    /// Whether the seams of texture coordinates are drawn.
    pub seams: bool,
    /// Whether vertex normals are drawn.
    pub normals: bool,
    /// Whether vertices are drawn.
    pub vertices: bool,
    /// Whether control nets of patches and control polygons of curves are drawn.
    pub control_nets: bool,
    /// Whether a grid is drawn on the ground.
    pub grid: bool,
    /// The numbers that are shown as colors.
    pub color_by: Option<ColorBy>,
    /// Whether the background is dark.
    pub is_dark: bool,
}

impl Default for Look {
    fn default() -> Self {
        Self {
            shading: Shading::Smooth,
            wireframe: Wireframe::default(),
            boundary: true,
            creases: true,
            seams: false,
            normals: false,
            vertices: false,
            control_nets: true,
            grid: true,
            color_by: None,
            is_dark: true,
        }
    }
}

impl Look {
    /// Returns the colors at the bottom and at the top of the background, in sRGB.
    pub fn background(&self) -> [Color; 2] {
        if self.is_dark {
            [Color::rgb(0x1b, 0x1f, 0x27), Color::rgb(0x33, 0x3a, 0x47)]
        } else {
            [Color::rgb(0xe4, 0xe8, 0xee), Color::rgb(0xfb, 0xfc, 0xfd)]
        }
    }

    /// Returns the color of the wireframe.
    fn wire(&self) -> [f32; 4] {
        let on_surface = Color([22, 28, 42, 125]);
        let color = match (self.wireframe, self.is_dark) {
            (Wireframe::HiddenLine | Wireframe::Lines, true) => Color([196, 206, 222, 235]),
            (Wireframe::HiddenLine | Wireframe::Lines, false) => Color([30, 38, 54, 235]),
            _ => on_surface,
        };
        color.linear()
    }
}

/// Elements that are drawn on top of the scene, in scene coordinates.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Overlay {
    /// Lines and dots. Later lines are drawn on top.
    pub lines: Vec<OverlayLine>,
    /// Triangles with an sRGB color and opacity.
    pub triangles: Vec<([DVec3; 3], [u8; 4])>,
}

/// A line, or a dot if both ends are equal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OverlayLine {
    /// The ends.
    pub ends: [DVec3; 2],
    /// The width in points of the screen.
    pub width: f32,
    /// The opacity where a surface hides the line.
    pub hidden: f32,
    /// sRGB color and opacity.
    pub color: [u8; 4],
}

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

/// The distance between the uniforms of two objects in bytes. A multiple of every alignment that devices ask for.
const STRIDE: u64 = 256;

/// Draws a scene into a texture.
pub struct Painter {
    device: wgpu::Device,
    queue: wgpu::Queue,
    pipelines: Pipelines,
    globals: wgpu::Buffer,
    globals_group: wgpu::BindGroup,
    objects: Vec<Uploaded>,
    /// The lowest and the highest coordinates of the scene.
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

    /// Returns the upward axis of a scene that stands on a plane: z if the scene stands on the plane z = 0 but not on the
    /// plane y = 0, else y.
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

    /// Sets the scene and its look. Uploads only objects that are new. Returns messages about what cannot be drawn.
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
            .map(|(coloring, by)| (title(&by.of), coloring.map, coloring.range));
        let mut old = std::mem::take(&mut self.objects);
        for (i, object) in scene.objects().iter().enumerate() {
            let coloring = colorings.iter().find(|c| c.object == object.name);
            let key = Key::new(object, i, look, coloring);
            if let Some(at) = old.iter().position(|o| o.key.as_ref() == Some(&key)) {
                self.objects.push(old.swap_remove(at));
                continue;
            }
            self.n_uploads += 1;
            match objects::upload(&self.device, &self.pipelines, object, key, look, coloring) {
                Ok((uploaded, missing)) => {
                    messages.extend(missing);
                    self.objects.push(uploaded);
                }
                Err(error) => messages.push(format!("\"{}\": {error}", object.name)),
            }
        }
        let bounds = self.objects.iter().filter_map(|o| o.bounds);
        self.bounds = bounds.reduce(|[a, b], [c, d]| [a.min(c), b.max(d)]);
        messages
    }

    /// Sets what is drawn on top of the scene.
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
            // Later lines are nearer to the camera than earlier ones.
            instance.look[2] = 0.5 + if i > 0 { 0.5 } else { 0.0 };
            instance
        };
        let lines: Vec<LineInstance> = overlay.lines.iter().enumerate().map(line).collect();
        let corners = overlay.triangles.iter().flat_map(|(corners, color)| {
            corners.map(|p| objects::PatchVertex {
                at: narrow(p - center),
                color: *color,
            })
        });
        let corners: Vec<objects::PatchVertex> = corners.collect();
        self.overlay = Uploaded::of_lines(&self.device, center, &lines, &corners);
        self.overlay_key = Some((overlay.clone(), scale));
    }

    /// Draws the scene. `size` is the size of the picture in pixels, and `scale` the number of pixels per point of the
    /// screen.
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
        // The grid is larger than the scene.
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

    /// Returns the values of each object and of each of its chunks, for dynamic offsets.
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
            // Surfaces are complete, so that lines are compared with all of them.
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

/// Returns the name of a quantity for people.
pub fn title(quantity: &Quantity) -> String {
    match quantity {
        Quantity::Valence => "valence".to_owned(),
        Quantity::MinAngle => "smallest angle [°]".to_owned(),
        Quantity::Area => "area".to_owned(),
        Quantity::DihedralAngle => "dihedral angle [°]".to_owned(),
        Quantity::MeanCurvature => "mean curvature".to_owned(),
        Quantity::GaussianCurvature => "Gaussian curvature".to_owned(),
        Quantity::Attribute {
            name,
            component: None,
        } => name.clone(),
        Quantity::Attribute {
            name,
            component: Some(component),
        } => format!("{name}[{component}]"),
        Quantity::DistanceTo(path) => format!("distance to {path}"),
    }
}

/// Returns the lines of a grid on the ground, which fade with the distance from the center. The distance of the lines is
/// 1, 2 or 5 times a power of ten.
fn grid(
    bounds: [DVec3; 2],
    (center, radius): (DVec3, f64),
    camera: &Camera,
    look: &Look,
) -> Vec<LineInstance> {
    /// The maximum number of lines on each side of the center.
    const HALF: f64 = 26.0;
    const SEGMENTS: u32 = 12;
    let [x, up, front] = camera.world_axes();
    // A power of ten, times 1, 2 or 5.
    let size = radius.max(1e-300) * 0.3;
    let power = libm::pow(10.0, libm::floor(libm::log10(size)));
    let step = power
        * if size >= 5.0 * power {
            5.0
        } else if size >= 2.0 * power {
            2.0
        } else {
            1.0
        };
    // The ground is as high as the lowest point of the scene.
    let level = bounds[0].dot(up).min(bounds[1].dot(up));
    let reach = 2.6 * radius;
    let n = libm::ceil(reach / step).min(HALF);
    let origin = |axis: DVec3| libm::round(center.dot(axis) / step);
    let (i0, j0) = (origin(x), origin(front));
    let gray = if look.is_dark {
        [150, 160, 178]
    } else {
        [120, 130, 148]
    };
    let mut lines = Vec::new();
    for (along, aside, along0, aside0) in [(x, front, i0, j0), (front, x, j0, i0)] {
        let mut k = -n;
        while k <= n {
            let number = aside0 + k;
            let is_axis = number == 0.0;
            let is_tenth = libm::fmod(number, 10.0) == 0.0;
            let point =
                |t: f64| along * ((along0 + t * n) * step) + aside * (number * step) + up * level;
            for s in 0..SEGMENTS {
                let [a, b] = [s, s + 1].map(|s| f64::from(2 * s) / f64::from(SEGMENTS) - 1.0);
                let middle = DVec2::new(0.5 * (a + b), k / n).length();
                let fade = (1.0 - middle).max(0.0);
                let strength = if is_axis {
                    0.75
                } else if is_tenth {
                    0.5
                } else {
                    0.26
                };
                let [r, g, b_] = if is_axis { axis_color(along) } else { gray };
                let alpha = alpha(strength * fade);
                if alpha > 3 {
                    let color = [r, g, b_, alpha];
                    let mut line = LineInstance::new([point(a), point(b)], center, 1.0, 0.0, color);
                    // The grid is behind surfaces that lie on the ground.
                    line.look[2] = -3.5;
                    lines.push(line);
                }
            }
            k += 1.0;
        }
    }
    lines
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the number is from 0 to 255"
)]
fn alpha(x: f64) -> u8 {
    (x.clamp(0.0, 1.0) * 255.0) as u8
}

/// Returns the color of an axis of the scene: red, green and blue for x, y and z.
pub fn axis_color(axis: DVec3) -> [u8; 3] {
    if axis.x != 0.0 {
        [224, 92, 92]
    } else if axis.y != 0.0 {
        [108, 190, 92]
    } else {
        [92, 140, 236]
    }
}
