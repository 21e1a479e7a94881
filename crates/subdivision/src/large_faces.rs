//! Faces with many corners. The value at the center of a face depends on all corners of the face. The same holds for
//! the value at a Doo-Sabin point, which is a new vertex inside the face. If the sum over all corners were computed
//! again for each Doo-Sabin point, the time would grow with the square of the number of corners. Instead, three sums
//! over all corners are computed once. Every new value is a weighted sum of the three sums and of the value at one
//! corner.
//!
//! Let x(0), .., x(n - 1) be the values at the n corners of a face, and let a be 2π/n:
//!
//! ```text
//!     m = Σ x(j) / n        c = Σ cos(ja) x(j) / n        s = Σ sin(ja) x(j) / n
//!
//!     center of the face         = m
//!     Doo-Sabin point of x(k)    = x(k) - 3/4 x(k) + 3/4 m + 1/2 (cos(ka) c + sin(ka) s)
//! ```
//!
//! The second formula follows from the weights in `topology.rs` and cos((j - k)a) = cos(ja) cos(ka) + sin(ja) sin(ka).
//! The weight of x(k) is added as 1 and -3/4, not as 1/4. The reason is that integers and tags are not averaged: they
//! take the value with the largest weight. In this way, they take x(k).

use std::collections::HashMap;
use std::f64::consts::TAU;

use mesh::{FaceId, HalfEdgeId, Mesh};

use crate::parallel::any;

/// A face is large if it has more corners than this number. In other faces, the sum over all corners is computed again
/// for each Doo-Sabin point.
const MAX_SMALL: usize = 64;

/// Each large face has three sums, called m, c and s.
const SUMS: usize = 3;

/// The large faces of a mesh: the faces that have more than [`MAX_SMALL`] corners.
#[derive(Default)]
pub(crate) struct LargeFaces {
    faces: Vec<FaceId>,
    /// For each half-edge of a large face: the index of the face in `faces`, the position of the half-edge in the face,
    /// and the number of corners of the face.
    corners: HashMap<HalfEdgeId, (usize, usize, usize)>,
}

impl LargeFaces {
    pub(crate) fn of(mesh: &Mesh) -> Self {
        let is_large = |f: &FaceId| mesh.face_half_edges(*f).nth(MAX_SMALL).is_some();
        if !any(mesh.n_faces(), |f| is_large(&FaceId::new(f))) {
            return Self::default();
        }
        let faces: Vec<FaceId> = mesh.faces().filter(is_large).collect();
        let mut corners = HashMap::new();
        for (i, &f) in faces.iter().enumerate() {
            let n = mesh.degree(f);
            let half_edges = mesh.face_half_edges(f).enumerate();
            corners.extend(half_edges.map(|(j, h)| (h, (i, j, n))));
        }
        Self { faces, corners }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.faces.is_empty()
    }

    /// Returns the total number of sums of all large faces.
    pub(crate) fn n_sums(&self) -> usize {
        SUMS * self.faces.len()
    }

    /// Calls `add` for each corner of the face to which sum `i` belongs. The arguments are the half-edge that starts at
    /// the corner, and the weight of the corner in the sum.
    pub(crate) fn add_sum(&self, mesh: &Mesh, i: usize, mut add: impl FnMut(HalfEdgeId, f64)) {
        let f = self.faces[i / SUMS];
        let n = mesh.degree(f) as f64;
        for (j, h) in mesh.face_half_edges(f).enumerate() {
            let angle = TAU * (j as f64 / n);
            let w = match i % SUMS {
                0 => 1.0,
                1 => libm::cos(angle),
                _ => libm::sin(angle),
            };
            add(h, w / n);
        }
    }

    /// If face `f` is large, returns the index of its sum m, which is the value at the center of the face; otherwise,
    /// returns `None`.
    pub(crate) fn center(&self, mesh: &Mesh, f: FaceId) -> Option<usize> {
        let (i, ..) = self.corners.get(&mesh.face_half_edge(f))?;
        Some(SUMS * i)
    }

    /// The Doo-Sabin point of the corner at the origin of `h` is a weighted sum of values. Calls `add` with the index
    /// and the weight of each of these values. `own` is the index of the old value at this corner, and `sums` is the
    /// index of the first sum. Returns false, and does nothing else, if the face of `h` is not large.
    #[inline]
    pub(crate) fn add_doo_sabin(
        &self,
        h: HalfEdgeId,
        [own, sums]: [usize; 2],
        add: &mut (impl FnMut(usize, f64) + ?Sized),
    ) -> bool {
        let Some(&(i, k, n)) = self.corners.get(&h) else {
            return false;
        };
        let (angle, sum) = (TAU * (k as f64 / n as f64), sums + SUMS * i);
        add(own, 1.0);
        add(own, -0.75);
        add(sum, 0.75);
        add(sum + 1, 0.5 * libm::cos(angle));
        add(sum + 2, 0.5 * libm::sin(angle));
        true
    }
}
