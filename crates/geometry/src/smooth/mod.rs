//! Smoothing: moves vertices so that noise disappears.
//!
//! | method | idea | file |
//! | --- | --- | --- |
//! | [`Method::Laplacian`] | move each vertex towards the mean of its neighbors | `explicit.rs` |
//! | [`Method::Taubin`] | a low-pass filter that alternates shrinking and expanding steps | `explicit.rs` |
//! | [`Method::Implicit`] | one backward Euler step of mean curvature flow | `implicit.rs` |
//! | [`Method::Denoise`] | filter the normals of the faces, then fit the vertices | `denoise.rs` |
//!
//! The result is identical bit for bit for any number of threads. The implicit method uses the solver of
//! [`sparse`](crate::sparse), whose results do not depend on the number of threads. In all other methods, each new
//! position is computed by a single thread, from positions of the previous iteration only.

mod denoise;
mod explicit;
mod implicit;
#[cfg(test)]
mod tests;

use mesh::{DVec3, Domain, Mesh, VertexId, parallel, readable};
use progress::{Cancelled, Progress};

use crate::laplacian::{exponent, scaled};
use crate::sparse::SolveError;
use crate::volume;

/// How vertices are moved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Method {
    /// Moves each vertex towards the weighted mean of its neighbors, by the fraction `factor` of the way.
    Laplacian {
        /// The weights of the neighbors.
        weights: Weights,
        /// The fraction of the way to the mean by which a vertex moves, from 0 to 1.
        factor: f64,
    },
    /// Alternates two Laplacian steps: one with `factor`, and one with a negative factor μ. The number μ is chosen so
    /// that `pass_band` = 1 / factor + 1 / μ. Source: Taubin, "A Signal Processing Approach to Fair Surface Design",
    /// 1995. One pass consists of both steps.
    Taubin {
        /// The weights of the neighbors.
        weights: Weights,
        /// The factor of the first step, from 0 to 1. The method must be [stable](Method::is_stable) with the chosen
        /// `factor` and `pass_band`.
        factor: f64,
        /// The pass band, from 0 to 1: the filter does not remove frequencies below this number. The frequencies of a
        /// mesh are the eigenvalues of its normalized Laplacian, which are between 0 and 2.
        pass_band: f64,
    },
    /// Solves (M + time L) x' = M x for the new positions x'. Here x are the old positions, L is the
    /// [`Laplacian`](crate::Laplacian), and M is the diagonal matrix of the vertex areas. Source: Desbrun, Meyer,
    /// Schröder, Barr, "Implicit Fairing of Irregular Meshes Using Diffusion and Curvature Flow", 1999.
    Implicit {
        /// The time of the flow, in scene unit². The longest time is 1000 times the squared diagonal of the
        /// bounding box; a longer time has the same effect.
        time: f64,
    },
    /// Filters the normals of the faces, then moves the vertices so that the faces have the filtered normals. Each
    /// filtered normal is a weighted mean of the normals of neighboring faces. The weights decrease with the distance
    /// between the faces and with the angle between their normals. Sources: Zheng, Fu, Au, Tai, "Bilateral Normal
    /// Filtering for Mesh Denoising", 2011; Sun, Rosin, Martin, Langbein, "Fast and Effective Feature-Preserving Mesh
    /// Denoising", 2007.
    Denoise {
        /// If the normals of two faces form this angle, the weight is multiplied by exp(-2) = 0.14. The angle is in
        /// degrees, from 0 to 180.
        angle: f64,
        /// The number of vertex passes: how often the vertices are moved after the normals were filtered.
        vertex_passes: u32,
    },
}

impl Method {
    /// Whether the method is stable. A method is stable if no pass increases the amplitude of a frequency above the
    /// pass band.
    ///
    /// A Taubin pass multiplies the amplitude of the frequency k by (1 - factor k)(1 - μ k). At the highest frequency,
    /// k = 2, the absolute value of this product must be at most 1.
    pub fn is_stable(&self) -> bool {
        match *self {
            Self::Taubin {
                factor, pass_band, ..
            } => {
                let negative = explicit::growing_factor(factor, pass_band);
                negative < 0.0 && ((1.0 - 2.0 * factor) * (1.0 - 2.0 * negative)).abs() <= 1.0
            }
            _ => true,
        }
    }
}

/// The weights of the neighbors of a vertex.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Weights {
    /// The same weight for all vertices that share an edge with the vertex.
    #[default]
    Uniform,
    /// The weights of the cotangent Laplacian, which are computed again for each step. Negative weights count as 0, so
    /// that a vertex stays between its neighbors.
    Cotangent,
}

/// How boundary vertices move.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Boundary {
    /// Boundary vertices stay in place.
    #[default]
    Fixed,
    /// The boundary is smoothed as a curve, without regard to the surface. With [`Method::Denoise`], boundary vertices
    /// move like all other vertices.
    Free,
}

/// How a mesh is smoothed.
#[derive(Clone, Debug)]
pub struct Smoothing<'a> {
    /// The method.
    pub method: Method,
    /// The number of times that the method is applied.
    pub passes: u32,
    /// For each vertex index, whether the vertex is allowed to move. All other vertices keep their exact positions.
    pub is_free: &'a [bool],
    /// How boundary vertices move.
    pub boundary: Boundary,
    /// Whether the volume of the mesh is preserved. If true, the mesh must be closed. After smoothing, all vertices
    /// that are allowed to move are shifted by the same distance along their normals.
    pub keep_volume: bool,
}

/// Why a mesh was not smoothed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SmoothError {
    /// The volume cannot be preserved, because the volume of a mesh with a boundary is not defined.
    #[error("the volume can be preserved only if the mesh is closed, but the mesh has a boundary")]
    NotClosed,
    /// To restore the volume, all vertices that are allowed to move are shifted by the same distance along their
    /// normals. No distance was found that restores the old volume.
    #[error(
        "the volume was {}, and moving the free vertices along their normals gives {} at best; smooth less, or do \
         not keep the volume",
        readable(*.before), readable(*.after)
    )]
    Volume {
        /// The volume before smoothing.
        before: f64,
        /// The volume nearest to `before` that was reached by moving the vertices.
        after: f64,
    },
    /// With the given factors, [`Method::Taubin`] would amplify the highest frequency.
    #[error(
        "this factor and pass band amplify noise: (1 - 2 factor)(1 - 2 μ) must be between -1 and 1, where \
         1 / μ = pass_band - 1 / factor; use a factor of at most 0.6"
    )]
    Unstable,
    /// A coordinate of the smoothed mesh would not be finite.
    #[error("a coordinate would exceed the largest number, 1.8e308; scale the mesh down first")]
    Overflow,
    /// The equations of [`Method::Implicit`] were not solved.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// The computation was canceled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Smooths the positions of a mesh. Returns the number of vertices that moved. Faces, ids and attributes do not
/// change; stored normals are not updated. Vertices without faces do not move.
///
/// # Errors
///
/// Returns a [`SmoothError`] if the mesh cannot be smoothed. The mesh is then unchanged.
///
/// # Panics
///
/// Panics if `is_free` does not have one entry for each vertex index.
pub fn smooth(
    mesh: &mut Mesh,
    smoothing: &Smoothing,
    progress: &dyn Progress,
) -> Result<usize, SmoothError> {
    let n = mesh.domain_len(Domain::Vertex);
    assert_eq!(smoothing.is_free.len(), n, "one entry for each vertex");
    if !smoothing.method.is_stable() {
        return Err(SmoothError::Unstable);
    }
    if smoothing.keep_volume && !mesh.is_closed() {
        return Err(SmoothError::NotClosed);
    }
    let before = mesh.positions().to_vec();
    // Scales the coordinates to a size near 1, so that squares of lengths are finite. The scale is a power of two, so
    // it causes no rounding errors.
    let exponent = exponent(&before);
    let scale = |points: &mut [DVec3], e: i32| {
        parallel::change(points, |p| *p = scaled(*p, e));
    };
    scale(mesh.positions_mut(), -exponent);
    let done = Smoother::new(mesh, smoothing).run(mesh, exponent, progress);
    scale(mesh.positions_mut(), exponent);
    let is_finite =
        |mesh: &Mesh| parallel::all(mesh.positions().len(), |v| mesh.positions()[v].is_finite());
    let is_good = match done {
        Ok(()) if is_finite(mesh) => Ok(()),
        Ok(()) => Err(SmoothError::Overflow),
        Err(error) => Err(error),
    };
    if let Err(error) = is_good {
        mesh.positions_mut().copy_from_slice(&before);
        return Err(error);
    }
    let mut moved = 0;
    let is_free = smoothing.is_free;
    for ((p, old), is_free) in mesh.positions_mut().iter_mut().zip(before).zip(is_free) {
        if !is_free {
            *p = old;
        }
        moved += usize::from(*p != old);
    }
    Ok(moved)
}

/// How the smoothing moves a vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Role {
    Pinned,
    /// The vertex is on a boundary that is smoothed as a curve.
    Rim,
    Free,
}

struct Smoother<'a> {
    smoothing: &'a Smoothing<'a>,
    roles: Vec<Role>,
}

impl<'a> Smoother<'a> {
    fn new(mesh: &Mesh, smoothing: &'a Smoothing<'a>) -> Self {
        let role = |v: usize| {
            let is_free = smoothing.is_free[v];
            let v = VertexId::new(v);
            if !is_free || !mesh.has_vertex(v) || mesh.vertex_half_edge(v).is_none() {
                return Role::Pinned;
            }
            match smoothing.boundary {
                _ if !mesh.is_boundary_vertex(v) => Role::Free,
                Boundary::Fixed => Role::Pinned,
                Boundary::Free => Role::Rim,
            }
        };
        Self {
            smoothing,
            roles: parallel::collect(smoothing.is_free.len(), role),
        }
    }

    /// Smooths a mesh whose coordinates were divided by 2 to the power of `exponent`.
    fn run(
        &self,
        mesh: &mut Mesh,
        exponent: i32,
        progress: &dyn Progress,
    ) -> Result<(), SmoothError> {
        let volume_before = self.smoothing.keep_volume.then(|| volume(mesh));
        let passes = u64::from(self.smoothing.passes);
        if let Method::Denoise {
            angle,
            vertex_passes,
        } = self.smoothing.method
        {
            denoise::denoise(self, mesh, angle, vertex_passes, progress)?;
        } else {
            for pass in 0..passes {
                progress.report("smooth", pass, passes)?;
                match self.smoothing.method {
                    Method::Laplacian { weights, factor } => {
                        explicit::step(self, mesh, weights, factor, progress)?;
                    }
                    Method::Taubin {
                        weights,
                        factor,
                        pass_band,
                    } => {
                        explicit::step(self, mesh, weights, factor, progress)?;
                        let negative = explicit::growing_factor(factor, pass_band);
                        explicit::step(self, mesh, weights, negative, progress)?;
                    }
                    Method::Implicit { time } => {
                        let time = libm::scalbn(time, -2 * exponent);
                        implicit::step(self, mesh, time, progress)?;
                    }
                    Method::Denoise { .. } => {}
                }
            }
        }
        match volume_before {
            Some(before) => self.restore_volume(mesh, before, exponent),
            None => Ok(()),
        }
    }

    /// Computes the new positions of all vertices that are not pinned. Each new position is computed from the old
    /// positions only.
    fn gather(&self, mesh: &mut Mesh, position: impl Fn(&Mesh, VertexId, Role) -> DVec3 + Sync) {
        let new: Vec<DVec3> = parallel::collect(self.roles.len(), |v| match self.roles[v] {
            Role::Pinned => mesh.positions()[v],
            role => position(mesh, VertexId::new(v), role),
        });
        mesh.positions_mut().copy_from_slice(&new);
    }

    /// Moves vertices along their normals, so that the mesh has the volume `target`. Pinned vertices do not move; all
    /// other vertices move by the same distance. The first distance is computed from the derivative of the volume with
    /// respect to the distance. This derivative is the sum of the lengths of the area vectors at the vertices that
    /// move. `target` is a volume in the scaled coordinates, which are scene coordinates divided by 2 to the power of
    /// `exponent`.
    fn restore_volume(
        &self,
        mesh: &mut Mesh,
        target: f64,
        exponent: i32,
    ) -> Result<(), SmoothError> {
        const STEPS: usize = 50;
        let area_vectors = mesh.area_vectors();
        let area_vector = |v: VertexId| {
            let faces = mesh.vertex_faces(v).map(|f| area_vectors[f.index()]);
            faces.sum::<DVec3>() / 3.0
        };
        let vectors: Vec<DVec3> = parallel::collect(self.roles.len(), |v| match self.roles[v] {
            Role::Pinned => DVec3::ZERO,
            _ => area_vector(VertexId::new(v)),
        });
        let slope = parallel::sum(vectors.len(), |v| vectors[v].length());
        let start = mesh.positions().to_vec();
        let volume_at = |distance: f64, mesh: &mut Mesh| {
            let moved: Vec<DVec3> = parallel::collect(start.len(), |v| {
                start[v] + distance * vectors[v].normalize_or_zero()
            });
            mesh.positions_mut().copy_from_slice(&moved);
            volume(mesh)
        };
        let (mut distance, mut best) = (0.0, volume(mesh));
        // The loop is the secant method, which starts with the derivative of the volume as the slope.
        let (mut at, mut error, mut slope) = (0.0, target - best, slope);
        for _ in 0..STEPS {
            if error.abs() <= 1e-14 * target.abs() || slope == 0.0 || !slope.is_finite() {
                break;
            }
            let step = error / slope;
            let found = volume_at(at + step, mesh);
            slope = (found - (target - error)) / step;
            (at, error) = (at + step, target - found);
            if error.abs() < (target - best).abs() {
                (distance, best) = (at, found);
            }
        }
        volume_at(distance, mesh);
        if (target - best).abs() <= 1e-9 * target.abs() {
            Ok(())
        } else {
            // Converts the volumes to scene units.
            let [before, after] = [target, best].map(|v| libm::scalbn(v, 3 * exponent));
            Err(SmoothError::Volume { before, after })
        }
    }
}
