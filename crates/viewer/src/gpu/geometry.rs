//! Converts an object of a scene to the arrays that the graphics card draws.

use std::sync::Arc;

use bytemuck::{Pod, Zeroable};
use glam::{DVec2, DVec3};
use mesh::{FaceId, Mesh};
use rayon::prelude::*;
use render::{Channel, Drawing, Part, Texture, to_srgb};

/// The largest number of triangles that are drawn by one command.
pub(super) const CHUNK: usize = 1 << 20;

/// The maximum number of points that share buffers. With this limit, no buffer exceeds 128 MiB. Every graphics card
/// supports buffers of this size.
const MAX_POINTS: usize = (128 << 20) / size_of::<[f32; 3]>();

/// This bit of a corner in [`Chunk::triangles`] is set if the side from this corner to the next corner is an edge of
/// the mesh.
pub(super) const EDGE: u32 = 1 << 31;

/// The encoded value for a point that has no normal.
const NO_NORMAL: u32 = 0x8000_8000;

/// Chunks of triangles that share their points.
pub(super) struct Surface {
    /// The positions of the points, relative to the center of the object.
    pub(super) points: Vec<[f32; 3]>,
    /// One unit vector for each point, in 4 bytes. Empty if the normals are not stored for each point.
    pub(super) normals: Vec<u32>,
    /// One sRGB color for each point. Empty if the colors are not stored for each point.
    pub(super) colors: Vec<u32>,
    pub(super) chunks: Vec<Chunk>,
}

/// Triangles that are drawn together.
pub(super) struct Chunk {
    /// Three points for each triangle, with the bit [`EDGE`] for sides that are edges of the mesh.
    pub(super) triangles: Vec<[u32; 3]>,
    /// The normals, as unit vectors of 4 bytes each. Empty if the chunk uses the normals of the points.
    pub(super) normals: Vec<u32>,
    /// sRGB colors. Empty if the chunk uses the colors of the points.
    pub(super) colors: Vec<u32>,
    /// The texture, if the surface has texture coordinates for it.
    pub(super) texture: Option<Arc<Texture>>,
    /// The position of each corner in the image of the texture. Empty without a texture.
    pub(super) uvs: Vec<[f32; 2]>,
    /// The appearance. It has all fields of the uniform `Object` of the shader, except for `offset`.
    pub(super) look: SurfaceLook,
}

/// The appearance of a chunk.
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[repr(C)]
pub(super) struct SurfaceLook {
    pub(super) color: [f32; 4],
    pub(super) back: [f32; 4],
    pub(super) modes: [u32; 4],
    pub(super) emissive: [f32; 3],
    pub(super) roughness: f32,
}

/// A corner of a colored triangle on a surface.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(super) struct PatchVertex {
    /// The position relative to the center of the object.
    pub(super) at: [f32; 3],
    /// sRGB color and opacity.
    pub(super) color: [u8; 4],
}

/// A line or a dot.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct LineInstance {
    /// The positions of the two ends of the line, relative to the center of the object. The two positions of a dot are
    /// equal.
    pub ends: [[f32; 3]; 2],
    /// Four numbers: the width in pixels, the opacity where the line is hidden, an offset towards the camera in pixels,
    /// and an unused number. The line is moved towards the camera by this offset plus 3 pixels.
    pub look: [f32; 4],
    /// sRGB color and opacity.
    pub color: [u8; 4],
}

impl LineInstance {
    /// Creates a line.
    pub fn new(ends: [DVec3; 2], center: DVec3, width: f32, hidden: f32, color: [u8; 4]) -> Self {
        Self {
            ends: ends.map(|p| narrow(p - center)),
            look: [width, hidden, 0.0, 0.0],
            color,
        }
    }
}

/// Returns a vector in single precision.
#[expect(
    clippy::cast_possible_truncation,
    reason = "the graphics card computes in single precision"
)]
pub(super) fn narrow(p: DVec3) -> [f32; 3] {
    p.to_array().map(|x| x as f32)
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "the graphics card computes in single precision"
)]
fn narrow_pair(p: DVec2) -> [f32; 2] {
    p.to_array().map(|x| x as f32)
}

/// Returns the lines of a drawing, relative to `center`.
pub(super) fn lines(drawing: &Drawing, center: DVec3) -> Vec<LineInstance> {
    let line = |line: &render::Line| {
        let [r, g, b, a] = line.color;
        let color = [to_srgb(r), to_srgb(g), to_srgb(b), byte(a)];
        LineInstance::new(line.ends, center, line.width, line.hidden, color)
    };
    drawing.lines.iter().map(line).collect()
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the number is from 0 to 255"
)]
fn byte(x: f32) -> u8 {
    (x.clamp(0.0, 1.0) * 255.0).round() as u8
}

/// Converts a part of a drawing to surfaces for the graphics card. If the part is the surface of a mesh, `mesh` is this
/// mesh. The mesh shows whether a side of a triangle is an edge of the mesh or a diagonal of a polygon.
pub(super) fn surfaces(part: &Part, mesh: Option<&Mesh>, center: DVec3) -> Vec<Surface> {
    split(part, mesh, center, [CHUNK, MAX_POINTS])
}

fn split(
    part: &Part,
    mesh: Option<&Mesh>,
    center: DVec3,
    [most_triangles, most_points]: [usize; 2],
) -> Vec<Surface> {
    let all: Vec<u32> = (0..u32::try_from(part.triangles.len()).unwrap_or(u32::MAX)).collect();
    let groups = by_material(part, all);
    let chunks = groups.iter().flat_map(|(material, triangles)| {
        let chunks = triangles.chunks(most_triangles);
        chunks.map(|chunk| chunk_of(part, mesh, *material, chunk))
    });
    if part.points.len() <= most_points {
        return vec![Surface {
            points: map(part.points.len(), |i| narrow(part.points[i] - center)),
            normals: of_points(&part.normals, encode_normal),
            colors: of_points(&part.colors, encode_color),
            chunks: chunks.collect(),
        }];
    }
    let normals = of_points(&part.normals, encode_normal);
    let colors = of_points(&part.colors, encode_color);
    let mut renumbering = Renumbering::new(part.points.len());
    let renumbered = chunks.map(|mut chunk| {
        let used = renumbering.renumber(&mut chunk.triangles);
        let take = |values: &[u32]| -> Vec<u32> {
            let value = |&p: &u32| values.get(p as usize).copied();
            used.iter().filter_map(value).collect()
        };
        Surface {
            points: map(used.len(), |i| {
                narrow(part.points[used[i] as usize] - center)
            }),
            normals: take(&normals),
            colors: take(&colors),
            chunks: vec![chunk],
        }
    });
    renumbered.collect()
}

/// Converts the point indices of a part to the point indices of a chunk.
struct Renumbering {
    local: Vec<u32>,
    /// For each entry of `local`, the number of the chunk for which the entry is valid.
    owner: Vec<u32>,
    chunk: u32,
}

impl Renumbering {
    fn new(n_points: usize) -> Self {
        Self {
            local: vec![0; n_points],
            owner: vec![0; n_points],
            chunk: 0,
        }
    }

    /// Gives the points of a chunk new indices, in the order of their first use. Returns the old indices.
    fn renumber(&mut self, triangles: &mut [[u32; 3]]) -> Vec<u32> {
        self.chunk += 1;
        let mut used = Vec::new();
        for corner in triangles.as_flattened_mut() {
            let (point, flag) = (*corner & !EDGE, *corner & EDGE);
            let i = point as usize;
            if self.owner[i] != self.chunk {
                self.owner[i] = self.chunk;
                self.local[i] = u32::try_from(used.len()).unwrap_or(!EDGE);
                used.push(point);
            }
            *corner = self.local[i] | flag;
        }
        used
    }
}

fn chunk_of(part: &Part, mesh: Option<&Mesh>, material: usize, triangles: &[u32]) -> Chunk {
    let values = |channel: &Channel, encode: fn([f32; 3]) -> u32| -> Vec<u32> {
        match channel {
            Channel::All(value) => vec![encode(*value)],
            Channel::Face(values) => map(triangles.len(), |i| {
                encode(values[part.face(triangles[i] as usize)])
            }),
            Channel::Point(_) => Vec::new(),
            Channel::Corner(values) => map(3 * triangles.len(), |i| {
                let corner = part.corners[triangles[i / 3] as usize][i % 3];
                encode(values[corner as usize])
            }),
        }
    };
    let surface = part.materials.get(material);
    let texture = surface.and_then(|s| s.texture.as_ref().zip(part.uvs.get(s.uv_set)));
    let uvs = texture.map_or_else(Vec::new, |(texture, uvs)| {
        map(3 * triangles.len(), |i| {
            let corner = part.corners[triangles[i / 3] as usize][i % 3];
            narrow_pair(texture.position(uvs[corner as usize]))
        })
    });
    Chunk {
        triangles: map(triangles.len(), |i| {
            let t = triangles[i] as usize;
            let (corners, edges) = (part.triangles[t], edges(part, mesh, t));
            std::array::from_fn(|k| corners[k] | if edges[k] { EDGE } else { 0 })
        }),
        normals: values(&part.normals, encode_normal),
        colors: values(&part.colors, encode_color),
        look: look(part, surface, texture.is_some()),
        texture: texture.map(|(texture, _)| texture.clone()),
        uvs,
    }
}

/// Encodes the values of points. Empty if the values are not stored for each point.
fn of_points(channel: &Channel, encode: fn([f32; 3]) -> u32) -> Vec<u32> {
    match channel {
        Channel::Point(values) => map(values.len(), |i| encode(values[i])),
        _ => Vec::new(),
    }
}

/// Computes `n` values on all processors.
fn map<T: Send>(n: usize, of: impl Fn(usize) -> T + Send + Sync) -> Vec<T> {
    (0..n).into_par_iter().map(of).collect()
}

/// Returns the triangles of each material.
fn by_material(part: &Part, all: Vec<u32>) -> Vec<(usize, Vec<u32>)> {
    if part.material_of_face.is_empty() {
        return vec![(0, all)];
    }
    let mut groups = vec![Vec::new(); part.materials.len()];
    for t in all {
        let material = part.material_of_face[part.face(t as usize)] as usize;
        if let Some(group) = groups.get_mut(material) {
            group.push(t);
        }
    }
    let groups = groups.into_iter().enumerate();
    groups.filter(|(_, group)| !group.is_empty()).collect()
}

fn look(part: &Part, surface: Option<&render::Surface>, has_texture: bool) -> SurfaceLook {
    let base = if let Channel::All(color) = part.colors {
        color
    } else {
        [1.0; 3]
    };
    let of_material = surface.map_or([1.0; 4], |s| s.color);
    let mode = |channel: &Channel| match channel {
        Channel::All(_) => 0,
        Channel::Face(_) => 1,
        Channel::Point(_) => 2,
        Channel::Corner(_) => 3,
    };
    let [r, g, b] = std::array::from_fn(|i| base[i] * of_material[i]);
    let alpha = of_material[3];
    let back = part.back.unwrap_or_default();
    SurfaceLook {
        color: [r, g, b, alpha],
        back: [
            back[0],
            back[1],
            back[2],
            if part.back.is_some() { 1.0 } else { 0.0 },
        ],
        modes: [
            mode(&part.normals),
            mode(&part.colors),
            u32::from(surface.is_some_and(|s| s.unlit)),
            u32::from(has_texture),
        ],
        emissive: surface.map_or([0.0; 3], |s| s.emissive),
        roughness: surface.map_or(1.0, |s| s.roughness).clamp(0.0, 1.0),
    }
}

/// Whether the sides of a triangle are edges of the mesh.
fn edges(part: &Part, mesh: Option<&Mesh>, t: usize) -> [bool; 3] {
    let Some(mesh) = mesh else {
        return [false; 3];
    };
    if part.faces.is_empty() {
        return [true; 3];
    }
    let f = FaceId::new(part.face(t));
    if mesh.is_triangle(f) {
        return [true; 3];
    }
    let corners = part.triangles[t];
    let mut sides = [false; 3];
    for h in mesh.face_half_edges(f) {
        let (v, w) = (mesh.origin(h).index(), mesh.target(h).index());
        for k in 0..3 {
            let (p, q) = (corners[k] as usize, corners[(k + 1) % 3] as usize);
            sides[k] |= (p, q) == (v, w);
        }
    }
    sides
}

/// Encodes a direction in 4 bytes. Cigolle et al., "A Survey of Efficient Representations for Independent Unit
/// Vectors", 2014.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the numbers are clamped to the range of 16 bits"
)]
pub(super) fn encode_normal(n: [f32; 3]) -> u32 {
    let sum = n[0].abs() + n[1].abs() + n[2].abs();
    if !(sum > 0.0 && sum.is_finite()) {
        return NO_NORMAL;
    }
    let [x, y, z] = n.map(|c| c / sum);
    let sign = |c: f32| if c >= 0.0 { 1.0 } else { -1.0 };
    let (x, y) = if z < 0.0 {
        ((1.0 - y.abs()) * sign(x), (1.0 - x.abs()) * sign(y))
    } else {
        (x, y)
    };
    let word = |c: f32| u32::from((c.clamp(-1.0, 1.0) * 32767.0).round() as i16 as u16);
    word(x) | (word(y) << 16)
}

fn encode_color(color: [f32; 3]) -> u32 {
    let [r, g, b] = color.map(to_srgb);
    u32::from_le_bytes([r, g, b, 255])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Decodes a direction, as the shader does.
    fn decode(word: u32) -> DVec3 {
        let part = |bits: u32| {
            let [low, high, ..] = bits.to_le_bytes();
            f64::from(i16::from_le_bytes([low, high])) / 32767.0
        };
        let (x, y) = (part(word), part(word >> 16));
        let z = 1.0 - x.abs() - y.abs();
        let sign = |c: f64| if c >= 0.0 { 1.0 } else { -1.0 };
        if z < 0.0 {
            let folded = DVec3::new((1.0 - y.abs()) * sign(x), (1.0 - x.abs()) * sign(y), z);
            return folded.normalize();
        }
        DVec3::new(x, y, z).normalize()
    }

    #[test]
    fn normals_of_four_bytes_are_exact_to_a_hundredth_of_a_degree() {
        for i in -4..=4 {
            for j in -4..=4 {
                for k in -4..=4 {
                    let n = DVec3::new(f64::from(i), f64::from(j), f64::from(k));
                    if n != DVec3::ZERO {
                        let found = decode(encode_normal(narrow(n)));
                        let sine = found.cross(n).length() / n.length();
                        assert!(found.dot(n) > 0.0 && sine < 1.7e-4, "{n} {found}");
                    }
                }
            }
        }
        assert_eq!(encode_normal([0.0; 3]), NO_NORMAL);
        assert_eq!(encode_normal([f32::NAN; 3]), NO_NORMAL);
    }

    #[test]
    fn the_diagonals_of_quadrilaterals_are_no_edges() {
        let cube = geometry::shapes::cube();
        let mut scene = scene::Scene::new();
        scene
            .insert(scene::Object::mesh("cube", cube.clone()))
            .unwrap();
        let style = render::Style::default();
        let overlays = render::Overlays::default();
        let (drawing, _) = render::build(&scene, &style, &overlays, &mut |_| None).unwrap();
        let surfaces = surfaces(&drawing.parts[0], Some(&cube), DVec3::ZERO);
        let [surface] = &surfaces[..] else { panic!() };
        assert_eq!((surface.points.len(), surface.chunks.len()), (8, 1));
        let corners = surface.chunks[0].triangles.as_flattened();
        let n_edges = corners.iter().filter(|&&t| t & EDGE != 0).count();
        // Each of the 12 edges is the side of two triangles.
        assert_eq!((corners.len(), n_edges), (36, 24));
    }

    #[test]
    fn triangles_stay_the_same_if_there_are_more_points_than_fit_into_a_buffer() {
        let torus = geometry::shapes::torus(40, 24, 1.0, 0.4);
        let mut scene = scene::Scene::new();
        scene
            .insert(scene::Object::mesh("torus", torus.clone()))
            .unwrap();
        let (style, overlays) = (render::Style::default(), render::Overlays::default());
        let (drawing, _) = render::build(&scene, &style, &overlays, &mut |_| None).unwrap();
        let part = &drawing.parts[0];
        // For each corner, in the order of drawing: its position, its normal and its flag.
        let drawn = |surfaces: &[Surface]| -> Vec<([f32; 3], u32, u32)> {
            let mut corners = Vec::new();
            for surface in surfaces {
                for chunk in &surface.chunks {
                    for &corner in chunk.triangles.as_flattened() {
                        let i = (corner & !EDGE) as usize;
                        corners.push((surface.points[i], surface.normals[i], corner & EDGE));
                    }
                }
            }
            corners
        };
        let one = split(part, Some(&torus), DVec3::ZERO, [CHUNK, MAX_POINTS]);
        let shared = split(part, Some(&torus), DVec3::ZERO, [500, MAX_POINTS]);
        let many = split(part, Some(&torus), DVec3::ZERO, [500, 959]);
        assert_eq!((one.len(), shared.len(), many.len()), (1, 1, 4));
        assert_eq!(shared[0].chunks.len(), 4);
        assert_eq!(drawn(&one).len(), 3 * 2 * 960);
        assert_eq!(drawn(&one), drawn(&shared));
        assert_eq!(drawn(&one), drawn(&many));
    }
}
