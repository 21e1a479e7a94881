//! Denoising: filters the face normals, then moves the vertices so that the faces get the filtered normals.
//!
//! ```text
//!     n(f) <- normalized sum over the faces g around f of
//!             a(g) exp(-|c(f) - c(g)|² / 2 s²) exp(-|n(f) - n(g)|² / 2 t²) n(g)
//!     x(v) <- x(v) + mean over the faces f of v of  n(f) (n(f) . (c(f) - x(v)))
//! ```
//!
//! Here x are positions of vertices, and a, c and n are areas, centers and normals of faces. The length s is the mean
//! distance between the centers of adjacent faces. The number t = sin(angle / 2) comes from the parameter `angle` of
//! the method. The number t is half the distance between the ends of two unit normals that enclose this angle.

use mesh::{DVec3, Domain, FaceId, Mesh, VertexId, parallel};
use progress::{Cancelled, Meter, Progress};

use super::{SmoothError, Smoother};
use crate::sin_cos_degrees;

/// Two faces that share a vertex are neighbors. However, two faces that meet only at one vertex are not neighbors if
/// this vertex has more edges than this number. This rule keeps the work proportional to the number of faces.
const MAX_FAN: u8 = 64;
/// The number of faces between two checks for cancellation.
const CHECK: usize = 1024;

pub(super) fn denoise(
    smoother: &Smoother,
    mesh: &mut Mesh,
    angle: f64,
    vertex_passes: u32,
    progress: &dyn Progress,
) -> Result<(), SmoothError> {
    let passes = u64::from(smoother.smoothing.passes);
    let normals = filtered_normals(mesh, angle, passes, progress)?;
    for pass in 0..vertex_passes {
        progress.report("move vertices", pass.into(), vertex_passes.into())?;
        let centers = of_faces(mesh, Mesh::face_center);
        smoother.gather(mesh, |mesh, v, _| {
            let p = mesh.position(v);
            let (mut sum, mut n) = (DVec3::ZERO, 0.0);
            for f in mesh.vertex_faces(v) {
                let normal = normals[f.index()];
                sum += normal * normal.dot(centers[f.index()] - p);
                n += 1.0;
            }
            if n > 0.0 { p + sum / n } else { p }
        });
    }
    Ok(())
}

/// Computes a value for each face index. Dead (removed) faces get the default value.
fn of_faces<T: Send + Default>(mesh: &Mesh, value: impl Fn(&Mesh, FaceId) -> T + Sync) -> Vec<T> {
    parallel::collect(mesh.domain_len(Domain::Face), |f| {
        let f = FaceId::new(f);
        if mesh.has_face(f) {
            value(mesh, f)
        } else {
            T::default()
        }
    })
}

fn filtered_normals(
    mesh: &Mesh,
    angle: f64,
    passes: u64,
    progress: &dyn Progress,
) -> Result<Vec<DVec3>, SmoothError> {
    let vectors = of_faces(mesh, Mesh::area_vector);
    let areas: Vec<f64> = vectors.iter().map(|v| v.length()).collect();
    let mut normals: Vec<DVec3> = vectors.iter().map(|v| v.normalize_or_zero()).collect();
    let centers = of_faces(mesh, Mesh::face_center);
    let fans: Vec<u8> = parallel::collect(mesh.domain_len(Domain::Vertex), |v| {
        let v = VertexId::new(v);
        if !mesh.has_vertex(v) {
            return 0;
        }
        let n = mesh.vertex_half_edges(v).take(usize::from(u8::MAX)).count();
        u8::try_from(n).expect("at most 255")
    });
    let spread = spread_of_centers(mesh, &centers);
    // Half the distance between the end points of two unit normals that enclose the given angle.
    let (tolerance, _) = sin_cos_degrees(0.5 * angle);
    // The weight is exp(-d² / (2 s²)), where d² is `square` and s is `spread`. For d = 0, the weight is 1, even if s
    // is 0.
    let falloff = |square: f64, spread: f64| {
        if square == 0.0 {
            1.0
        } else if spread > 0.0 {
            libm::exp(-0.5 * square / (spread * spread))
        } else {
            0.0
        }
    };
    let total = passes.saturating_mul(normals.len() as u64);
    let meter = Meter::new(progress, "filter normals", total);
    for _ in 0..passes {
        let old = &normals;
        let filter = |f: usize, around: &mut Vec<FaceId>| {
            neighbors(mesh, &fans, FaceId::new(f), around);
            let weighted = around.iter().map(|&g| {
                let g = g.index();
                let near = falloff(centers[f].distance_squared(centers[g]), spread);
                let alike = falloff(old[f].distance_squared(old[g]), tolerance);
                areas[g] * near * alike * old[g]
            });
            let sum: DVec3 = weighted.sum();
            sum.try_normalize().unwrap_or(old[f])
        };
        let mut new = vec![DVec3::ZERO; old.len()];
        let parts = parallel::consume(new.chunks_mut(CHECK), |i, part| {
            let mut around = Vec::new();
            for (f, normal) in (i * CHECK..).zip(part.iter_mut()) {
                *normal = filter(f, &mut around);
            }
            meter.add(part.len())
        });
        parts.into_iter().collect::<Result<(), Cancelled>>()?;
        normals = new;
    }
    Ok(normals)
}

/// Replaces the contents of `around` by the face `f` and all faces that share a vertex with it, in ascending order. At
/// vertices with many edges, fewer faces are neighbors; see [`MAX_FAN`].
fn neighbors(mesh: &Mesh, fans: &[u8], f: FaceId, around: &mut Vec<FaceId>) {
    around.clear();
    if !mesh.has_face(f) {
        return;
    }
    around.push(f);
    for h in mesh.face_half_edges(f) {
        around.extend(mesh.face(h.twin()));
        if fans[mesh.origin(h).index()] <= MAX_FAN {
            around.extend(mesh.vertex_faces(mesh.origin(h)));
        }
    }
    around.sort_unstable();
    around.dedup();
}

/// Returns the mean distance between the centers of adjacent faces.
fn spread_of_centers(mesh: &Mesh, centers: &[DVec3]) -> f64 {
    let [sum, n] = parallel::fold(
        mesh.domain_len(Domain::Edge),
        [0.0, 0.0],
        |e| {
            let e = mesh::EdgeId::new(e);
            match mesh.has_edge(e).then(|| mesh.edge_faces(e)) {
                Some([Some(f), Some(g)]) => [centers[f.index()].distance(centers[g.index()]), 1.0],
                _ => [0.0, 0.0],
            }
        },
        |a, b| [a[0] + b[0], a[1] + b[1]],
    );
    if n > 0.0 { sum / n } else { 0.0 }
}
