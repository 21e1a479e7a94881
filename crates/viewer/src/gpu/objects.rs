//! The buffers of objects.

use std::sync::Arc;

use bytemuck::Pod;
use eframe::wgpu;
use glam::DVec3;
use render::{
    Channel, Color, Coloring, Lines, Overlays, PALETTE, Part, PictureError, Shading, Style,
};
use scene::{Geometry, Material, Object, Scene};
use wgpu::util::DeviceExt;

use super::geometry::{self, LineInstance, PatchVertex, SurfaceLook};
use super::pipelines::Pipelines;
use super::textures::Textures;
use super::{Look, Wireframe};

/// Everything that the buffers of an object depend on.
#[derive(Clone, Debug)]
pub(super) struct Key {
    pub(super) geometry: Geometry,
    materials: Vec<Material>,
    color: Color,
    pub(super) style: Style,
    seams: bool,
    coloring: Option<Coloring>,
}

impl Key {
    /// Whether the buffers of the two objects can differ only because of their geometry. Both objects must have the
    /// same color and style. Both objects must be without seams, without materials and without colors that show
    /// numbers, because the buffers also depend on these.
    pub(super) fn looks_like(&self, other: &Self) -> bool {
        self.color == other.color
            && self.style == other.style
            && !self.seams
            && !other.seams
            && self.materials.is_empty()
            && other.materials.is_empty()
            && self.coloring.is_none()
            && other.coloring.is_none()
    }
}

impl PartialEq for Key {
    fn eq(&self, other: &Self) -> bool {
        // Meshes are compared by address, because comparing their contents takes a long time.
        let same_geometry = match (&self.geometry, &other.geometry) {
            (Geometry::Mesh(a), Geometry::Mesh(b)) => Arc::ptr_eq(a, b),
            (a, b) => a == b,
        };
        same_geometry
            && self.color == other.color
            && self.style == other.style
            && self.seams == other.seams
            && self.materials == other.materials
            && same_coloring(self.coloring.as_ref(), other.coloring.as_ref())
    }
}

/// Whether two colorings are equal. Values are compared bit by bit, so that NaN equals NaN.
fn same_coloring(a: Option<&Coloring>, b: Option<&Coloring>) -> bool {
    match (a, b) {
        (Some(a), Some(b)) => {
            let same = |(x, y): (&f64, &f64)| x.to_bits() == y.to_bits();
            (a.domain, a.map, a.range) == (b.domain, b.map, b.range)
                && a.values.len() == b.values.len()
                && a.values.iter().zip(&b.values).all(same)
        }
        (None, None) => true,
        _ => false,
    }
}

impl Key {
    /// Returns the key of the object with this index in its scene.
    pub(super) fn new(
        object: &Object,
        index: usize,
        look: &Look,
        coloring: Option<&Coloring>,
    ) -> Self {
        Self {
            geometry: object.geometry.clone(),
            materials: object.materials.clone(),
            color: PALETTE[index % PALETTE.len()],
            style: style(look, &object.geometry),
            seams: look.seams,
            coloring: coloring.cloned(),
        }
    }
}

/// Returns the style with which the crate `render` must draw an object.
fn style(look: &Look, geometry: &Geometry) -> Style {
    let line = |color: Color, width: f64, hidden: f64| Lines {
        width,
        color,
        hidden,
    };
    let (orange, violet) = (Color::rgb(0xf0, 0x9a, 0x2e), Color::rgb(0xd0, 0x62, 0xd8));
    let net = if look.is_dark {
        Color([150, 190, 255, 200])
    } else {
        Color([52, 88, 160, 200])
    };
    // The shader draws the wireframe of a mesh. A patch gets a grid of lines instead.
    let is_mesh = matches!(geometry, Geometry::Mesh(_));
    Style {
        shading: match look.shading {
            Shading::Flat | Shading::Plain => Shading::Flat,
            _ => Shading::Smooth,
        },
        wireframe: (look.wireframe != Wireframe::None && !is_mesh)
            .then(|| line(Color([22, 28, 42, 130]), 1.0, 0.0)),
        boundary: look.boundary.then(|| line(orange, 2.2, 0.25)),
        creases: look.creases.then(|| line(violet, 2.0, 0.25)),
        normals: look.normals.then_some(0.05),
        points: look.vertices.then_some(5.0),
        control_nets: look.control_nets.then(|| line(net, 1.2, 0.35)),
        ..Style::default()
    }
}

/// The buffers of triangles.
pub(super) struct ChunkBuffers {
    pub(super) group: wgpu::BindGroup,
    pub(super) n_corners: u32,
    pub(super) look: SurfaceLook,
    pub(super) texture: Option<Arc<render::Texture>>,
}

/// The buffers of a surface in which each triangle has the same index as its face in the mesh.
pub(super) struct Simple {
    /// The triangles of each chunk.
    pub(super) triangles: Vec<wgpu::Buffer>,
    /// The normals of the points. `None` if the surface is shaded flat, with the normals of its triangles.
    pub(super) normals: Option<wgpu::Buffer>,
    /// Whether the back of the surface has a color of its own.
    pub(super) has_back: bool,
}

/// The buffers of an object.
#[derive(Default)]
pub(super) struct Uploaded {
    /// `None` for grids and overlays.
    pub(super) key: Option<Key>,
    pub(super) center: DVec3,
    /// Two opposite corners of the bounding box, in scene units: the lowest and the highest coordinates.
    pub(super) bounds: Option<[DVec3; 2]>,
    pub(super) chunks: Vec<ChunkBuffers>,
    /// The buffers that are updated after a local change of the mesh. `None` if the whole object is converted after
    /// every change.
    pub(super) simple: Option<Simple>,
    /// The buffer of the lines, and the number of lines.
    pub(super) lines: Option<(wgpu::Buffer, u32)>,
    /// Whether the hidden parts of some lines are also drawn.
    pub(super) has_hidden: bool,
    /// The corners of colored triangles on surfaces: their buffer and their number.
    pub(super) patches: Option<(wgpu::Buffer, u32)>,
}

impl Uploaded {
    /// Uploads lines and triangles that are not part of an object.
    pub(super) fn of_lines(
        device: &wgpu::Device,
        center: DVec3,
        lines: &[LineInstance],
        corners: &[PatchVertex],
    ) -> Self {
        Self {
            center,
            has_hidden: lines.iter().any(|line| line.look[1] > 0.0),
            lines: vertices(device, lines),
            patches: vertices(device, corners),
            ..Self::default()
        }
    }

    /// Returns the number of triangles.
    pub(super) fn n_triangles(&self) -> usize {
        self.chunks.iter().map(|c| c.n_corners as usize / 3).sum()
    }
}

/// Uploads elements to a vertex buffer. If a buffer cannot hold all elements, only the first elements are uploaded.
/// Returns the buffer and the number of uploaded elements, or `None` if there are no elements.
fn vertices<T: Pod>(device: &wgpu::Device, elements: &[T]) -> Option<(wgpu::Buffer, u32)> {
    let most = device.limits().max_buffer_size / size_of::<T>() as u64;
    let most = usize::try_from(most).unwrap_or(usize::MAX);
    let elements = &elements[..elements.len().min(most)];
    let n = u32::try_from(elements.len()).ok().filter(|&n| n > 0)?;
    let buffer = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: Some("vertices"),
        contents: bytemuck::cast_slice(elements),
        usage: wgpu::BufferUsages::VERTEX,
    });
    Some((buffer, n))
}

/// Converts and uploads an object. Returns the buffers, and a message for each texture that cannot be drawn.
pub(super) fn upload(
    device: &wgpu::Device,
    pipelines: &Pipelines,
    textures: &mut Textures,
    object: &Object,
    key: Key,
    look: &Look,
    coloring: Option<&Coloring>,
) -> Result<(Uploaded, Vec<String>), PictureError> {
    let scene = alone(object, key.color);
    let overlays = Overlays {
        colorings: coloring.cloned().into_iter().collect(),
        ..Overlays::default()
    };
    let decoded = &mut textures.decoded;
    let (drawing, missing) = render::build_within(
        &scene,
        &key.style,
        &overlays,
        u64::MAX,
        decoded,
        &mut |_| None,
    )?;
    let mut bounds = None;
    drawing.each_point(&mut |p| {
        let [min, max] = bounds.unwrap_or([p, p]);
        bounds = Some([min.min(p), max.max(p)]);
    });
    let center = bounds.map_or(DVec3::ZERO, |[min, max]| 0.5 * (min + max));
    let mesh = object.as_mesh().map(AsRef::as_ref);
    let mut lines = geometry::lines(&drawing, center);
    if let Some(mesh) = mesh.filter(|_| look.seams) {
        for e in mesh.edges().filter(|&e| mesh.is_seam(e)) {
            let ends = mesh.edge_vertices(e).map(|v| mesh.position(v));
            lines.push(LineInstance::new(
                ends,
                center,
                2.0,
                0.2,
                [60, 190, 200, 255],
            ));
        }
    }
    let mut chunks = Vec::new();
    let mut simple = None;
    for part in &drawing.parts {
        let surfaces = geometry::surfaces(part, mesh, center);
        let is_one = drawing.parts.len() == 1 && surfaces.len() == 1 && lines.is_empty();
        for surface in surfaces {
            let (new, buffers) = buffers(device, pipelines, textures, &surface);
            chunks.extend(new);
            simple = (is_one && is_simple(part)).then_some(buffers);
        }
    }
    let uploaded = Uploaded {
        key: Some(key),
        bounds,
        chunks,
        simple,
        ..Uploaded::of_lines(device, center, &lines, &[])
    };
    Ok((uploaded, missing))
}

/// Returns a scene with the given object, in which this object has the given default color. The default color of an
/// object depends on its place in the list of objects. Therefore, empty objects are put before the given object.
fn alone(object: &Object, color: Color) -> Scene {
    let mut scene = Scene::new();
    let index = PALETTE.iter().position(|&c| c == color).unwrap_or(0);
    for i in 0..index {
        // This name is longer than the name of the object, so the two names differ.
        let name = format!("{}-{i}", object.name);
        let empty = Object::new(name, Geometry::Polylines(Vec::new()));
        scene.insert(empty).unwrap_or_default();
    }
    scene.insert(object.clone()).unwrap_or_default();
    scene
}

/// Whether all faces of a part are triangles with one material, without colors, and with at most one normal for each
/// point.
fn is_simple(part: &Part) -> bool {
    let is_smooth = matches!(part.normals, Channel::Point(_));
    let is_flat = matches!(part.normals, Channel::All([0.0, 0.0, 0.0]));
    part.faces.is_empty()
        && part.material_of_face.is_empty()
        && matches!(part.colors, Channel::All(_))
        && (is_smooth || is_flat)
}

/// Uploads the chunks of a surface.
fn buffers(
    device: &wgpu::Device,
    pipelines: &Pipelines,
    textures: &mut Textures,
    surface: &geometry::Surface,
) -> (Vec<ChunkBuffers>, Simple) {
    let storage = |label, contents: &[u8]| {
        // A buffer in a binding must not be empty.
        let contents = if contents.is_empty() {
            &[0; 8]
        } else {
            contents
        };
        device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some(label),
            contents,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
        })
    };
    let mut simple = Simple {
        triangles: Vec::new(),
        normals: None,
        has_back: surface.chunks.iter().any(|c| c.look.back[3] == 1.0),
    };
    let points = storage("points", bytemuck::cast_slice(&surface.points));
    let normals = storage("normals", bytemuck::cast_slice(&surface.normals));
    let colors = storage("colors", bytemuck::cast_slice(&surface.colors));
    let own = |label, values: &[u32], shared: &wgpu::Buffer| {
        if values.is_empty() {
            shared.clone()
        } else {
            storage(label, bytemuck::cast_slice(values))
        }
    };
    simple.normals = (!surface.normals.is_empty()).then(|| normals.clone());
    let mut all_triangles = Vec::new();
    let chunk = |chunk: &geometry::Chunk| {
        let triangles = storage("triangles", bytemuck::cast_slice(&chunk.triangles));
        all_triangles.push(triangles.clone());
        let all = [
            points.clone(),
            triangles,
            own("normals", &chunk.normals, &normals),
            own("colors", &chunk.colors, &colors),
            storage("texture coordinates", bytemuck::cast_slice(&chunk.uvs)),
        ];
        let (image, sampler) = textures.get(chunk.texture.as_ref());
        let resources = all.iter().map(wgpu::Buffer::as_entire_binding).chain([
            wgpu::BindingResource::TextureView(&image),
            wgpu::BindingResource::Sampler(&sampler),
        ]);
        let entries: Vec<wgpu::BindGroupEntry> = (0..)
            .zip(resources)
            .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource })
            .collect();
        ChunkBuffers {
            group: device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("chunk"),
                layout: &pipelines.chunk_layout,
                entries: &entries,
            }),
            n_corners: u32::try_from(3 * chunk.triangles.len()).unwrap_or(0),
            look: chunk.look,
            texture: chunk.texture.clone(),
        }
    };
    let chunks = surface.chunks.iter().map(chunk).collect();
    simple.triangles = all_triangles;
    (chunks, simple)
}
