//! Unwrapping: new texture coordinates for a surface.

use mesh::{DVec2, DVec3, EdgeId, FaceId, HalfEdgeId, Mesh};
use progress::Progress;
use uvunwrap::{Atlas, Density, MeshInput, Options, OutputVertex, Stage, generate_with_progress};

use super::{Charts, Page, UvError, charts, number};
use crate::tangent::triangles;

/// How a surface is unwrapped.
#[derive(Clone, Copy, Debug)]
pub struct UnwrapOptions<'a> {
    /// Edges that become borders of charts.
    pub seams: &'a [EdgeId],
    /// The largest angle between the normal of a face and the mean normal of its chart, in degrees, strictly between 0
    /// and 90.
    pub max_angle: f64,
    /// The largest ratio between the area scale of a triangle and that of its chart, at least 1.
    pub max_stretch: f64,
    /// The size of the texture.
    pub page: Page,
}

/// The texture coordinates of an unwrapped mesh.
#[derive(Clone, Debug)]
pub struct Unwrapped {
    /// The coordinates for each half-edge, from 0 to 1; zero for half-edges without a face.
    pub uvs: Vec<DVec2>,
    /// The charts.
    pub charts: Charts,
    /// The area of the charts, as a fraction of the page.
    pub coverage: f64,
    /// The faces with a triangle whose area in the texture is zero, or too small for 32-bit numbers.
    pub flat: Vec<FaceId>,
    /// The polygons that are bent so far that they overlap themselves in the texture.
    pub bent: Vec<FaceId>,
}

/// Computes texture coordinates for all faces of a dense mesh, without overlaps except in the faces of
/// [`Unwrapped::bent`].
///
/// Charts grow from flat regions. Each chart is flattened by least squares conformal maps (Levy, Petitjean, Ray,
/// Maillot, "Least Squares Conformal Maps for Automatic Texture Atlas Generation", 2002), then by the
/// as-rigid-as-possible method (Liu, Zhang, Xu, Gotsman, Gortler, "A Local/Global Approach to Mesh Parameterization",
/// 2008), and split where it would overlap itself or be stretched too much. All charts have the same scale and are
/// packed by their shapes. No chart is mirrored, and no polygon is split.
///
/// The computation uses 32-bit positions relative to the bounding box. Its result does not depend on the number of
/// threads or the processor.
///
/// # Errors
///
/// Returns an [`UvError`] if the surface cannot be unwrapped.
pub fn unwrap(
    mesh: &Mesh,
    options: &UnwrapOptions,
    progress: &dyn Progress,
) -> Result<Unwrapped, UvError> {
    let triangles = triangles(mesh);
    let mut uvs = vec![DVec2::ZERO; mesh.n_half_edges()];
    let mut unwrapped = Unwrapped {
        uvs: Vec::new(),
        charts: charts(mesh, &uvs),
        coverage: 0.0,
        flat: Vec::new(),
        bent: Vec::new(),
    };
    if triangles.is_empty() {
        unwrapped.uvs = uvs;
        return Ok(unwrapped);
    }
    let atlas = atlas(mesh, &triangles, options, progress)?;
    let output = &atlas.meshes[0];
    let (width, height) = (f64::from(atlas.width), f64::from(atlas.height));
    let size = f64::from(options.page.size);
    let mut placed = vec![None; mesh.n_half_edges()];
    for (triangle, vertices) in triangles.iter().zip(output.indices.chunks_exact(3)) {
        let vertices = [0, 1, 2].map(|k| output.vertices[vertices[k] as usize]);
        let at = vertices.map(|v| position(&v) * DVec2::new(width, height) / size);
        let area = (at[1] - at[0]).perp_dot(at[2] - at[0]) / 2.0;
        let face = mesh.face(triangle[0]);
        if area > 0.0 {
            unwrapped.coverage += area;
        } else {
            unwrapped.flat.extend(face);
        }
        for (h, (vertex, uv)) in triangle.iter().zip(vertices.iter().zip(at)) {
            match placed[h.index()] {
                None => {
                    placed[h.index()] = Some(vertex.chart);
                    uvs[h.index()] = uv;
                }
                Some(_) if uvs[h.index()] != uv => unwrapped.bent.extend(face),
                Some(_) => {}
            }
        }
    }
    unwrapped.flat.dedup();
    unwrapped.bent.dedup();
    unwrapped.charts = charts(mesh, &uvs);
    unwrapped.uvs = uvs;
    Ok(unwrapped)
}

/// Returns the computed texture coordinates of a vertex.
fn position(vertex: &OutputVertex) -> DVec2 {
    DVec2::from(vertex.uv.map(f64::from))
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "the computation uses 32-bit numbers"
)]
fn atlas(
    mesh: &Mesh,
    triangles: &[[HalfEdgeId; 3]],
    options: &UnwrapOptions,
    progress: &dyn Progress,
) -> Result<Atlas, UvError> {
    let positions = unit_positions(mesh);
    let corners = triangles.iter().flatten();
    let indices: Vec<u32> = corners.map(|&h| number(mesh.origin(h).index())).collect();
    let faces = triangles.iter().map(|t| mesh.face(t[0]));
    let polygons: Vec<u32> = faces
        .map(|f| f.map_or(u32::MAX, |f| number(f.index())))
        .collect();
    let mut is_seam = vec![false; mesh.n_edges()];
    for e in options.seams {
        is_seam[e.index()] = true;
    }
    // Sides of triangles inside a polygon are not edges, and cannot be seams.
    let seam = |h: HalfEdgeId, g: HalfEdgeId| mesh.next(h) == g && is_seam[h.edge().index()];
    let seams: Vec<[bool; 3]> = triangles
        .iter()
        .map(|&[a, b, c]| [seam(a, b), seam(b, c), seam(c, a)])
        .collect();
    let input = MeshInput {
        polygons: Some(&polygons),
        seams: Some(&seams),
        ..MeshInput::new(&positions, &indices)
    };
    let settings = Options {
        max_chart_angle: options.max_angle as f32,
        max_area_distortion: options.max_stretch as f32,
        ..settings(options.page)
    };
    generate(&[input], &settings, options.page, progress)
}

/// The settings that unwrapping and packing share.
pub(super) fn settings(page: Page) -> Options {
    Options {
        density: Density::Auto {
            page_size: page.size,
        },
        padding: page.padding,
        ..Options::default()
    }
}

/// Makes an atlas of a single page.
pub(super) fn generate(
    input: &[MeshInput],
    settings: &Options,
    page: Page,
    progress: &dyn Progress,
) -> Result<Atlas, UvError> {
    let listen = |report: uvunwrap::Progress| {
        let task = match report.stage {
            Stage::Segmenting => "grow charts",
            Stage::Parameterizing => "flatten charts",
            _ => "pack charts",
        };
        let done = report.done as u64;
        // The number of packing attempts is not known in advance.
        let total = report.total.map_or(done + 1, |total| total as u64);
        progress.advance(task, done.min(total), total)
    };
    let atlas = generate_with_progress(input, settings, listen);
    let atlas = atlas.map_err(|error| UvError::from_crate(&error, page))?;
    if atlas.page_count > 1 {
        return Err(UvError::PageTooSmall(page));
    }
    Ok(atlas)
}

/// Returns the positions of all vertices, moved and scaled so that the bounding box has a size of 1.
fn unit_positions(mesh: &Mesh) -> Vec<[f32; 3]> {
    // First scales the coordinates so that later computations cannot overflow.
    let largest = |p: &DVec3| p.abs().max_element();
    let size = mesh.positions().iter().map(largest).fold(0.0, f64::max);
    let size = if size > 0.0 { size } else { 1.0 };
    let unit = |p: &DVec3| *p / size;
    let mut points = mesh.positions().iter().map(unit);
    let first = points.next().unwrap_or_default();
    let (low, high) = points.fold((first, first), |(low, high), p| (low.min(p), high.max(p)));
    let (middle, extent) = ((low + high) / 2.0, (high - low).max_element());
    let extent = if extent > 0.0 { extent } else { 1.0 };
    let points = mesh.positions().iter();
    let points = points.map(|p| ((unit(p) - middle) / extent).as_vec3());
    points.map(|p| p.to_array()).collect()
}
