//! The limit surface at the vertices of a mesh: the positions to which the vertices converge as the number of levels
//! grows, and the tangent planes at these positions.
//!
//! If the sharpness at a vertex is the same on all levels, the limit position is a weighted mean of the one-ring (the
//! vertex and the vertices around it). The tangents are then weighted sums of the one-ring. The weights, called limit
//! masks, are left eigenvectors of the matrix that maps a one-ring to the one-ring of the next level. Sources:
//! Halstead, Kass and DeRose, "Efficient, Fair Interpolation using Catmull-Clark Surfaces", 1993; Hoppe et al.,
//! "Piecewise Smooth Surface Reconstruction", 1994; Biermann, Levin and Zorin, "Piecewise Smooth Subdivision Surfaces
//! with Normal Control", 2000. If the vertex or one of its edges is semi-sharp (its sharpness falls to 0 after some
//! levels), the one-ring is refined until this sharpness is 0. For a dart, the end of a single sharp edge, there is no
//! closed formula: its one-ring is refined until it converges.

mod masks;
mod star;

use mesh::{DVec3, FaceId, HalfEdgeId, Mesh, VertexId};
use progress::{Cancelled, Meter, Progress};

use crate::error::SubdivisionError;
use crate::input::{check_faces, dense};
use crate::parallel::{any, computed, fill_uncounted, in_blocks, of_blocks};
use crate::rules::Rules;
use crate::sharpness::Sharpness;
use masks::Sector;
use star::Star;

/// The limit surface at the vertices of a mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Limit {
    /// The limit position of each vertex.
    pub positions: Vec<DVec3>,
    /// Two vectors that span the tangent plane at each vertex, not normalized. The cross product of the two
    /// vectors points outward. At an inner crease, the vectors span the tangent plane of one side of the
    /// crease. At an isolated vertex, the vectors are zero.
    pub tangents: Vec<[DVec3; 2]>,
    /// The unit normal of each corner, stored at the index of its half-edge. The normal is zero for half-edges without
    /// a face. The value is `None` if each vertex has only one tangent plane, because then one normal for each vertex
    /// is enough.
    pub corner_normals: Option<Vec<DVec3>>,
}

impl Limit {
    /// Returns the unit normal at each vertex, computed from the tangents. If the tangents do not span a plane, the
    /// normal is zero.
    pub fn normals(&self) -> Vec<DVec3> {
        self.tangents.iter().map(normal).collect()
    }
}

fn normal([a, b]: &[DVec3; 2]) -> DVec3 {
    a.normalize_or_zero()
        .cross(b.normalize_or_zero())
        .normalize_or_zero()
}

/// Computes the limit surface at the vertices of a mesh, for [`Scheme::Loop`](crate::Scheme::Loop) and
/// [`Scheme::CatmullClark`](crate::Scheme::CatmullClark).
///
/// A mesh with dead (deleted) elements is compacted first, and the ids are those of the compacted mesh.
///
/// # Errors
///
/// Returns [`SubdivisionError::NoLimit`] for other schemes, and [`SubdivisionError::NotTriangle`] if the scheme needs
/// triangles and a face is not a triangle. Returns [`SubdivisionError::TooFar`] if a coordinate is too large, and
/// [`SubdivisionError::Cancelled`] if the progress listener asks to stop.
///
/// # Examples
///
/// ```
/// use subdivision::{Rules, Scheme};
///
/// let cube = geometry::shapes::cube();
/// let rules = Rules::of(Scheme::CatmullClark);
/// let limit = subdivision::limit(&cube, rules, &progress::NoProgress)?;
/// // For valence 3 the weights are 3/8 for the vertex, 4/24 for each neighbor and 1/24 for each opposite corner.
/// assert!((limit.positions[7] - mesh::DVec3::splat(0.5)).length() < 1e-15);
/// # Ok::<(), subdivision::SubdivisionError>(())
/// ```
pub fn limit(
    mesh: &Mesh,
    rules: Rules,
    progress: &dyn Progress,
) -> Result<Limit, SubdivisionError> {
    let mesh = dense(mesh);
    let context = LimitContext::checked(&mesh, rules)?;
    let meter = Meter::new(progress, "limit surface", mesh.n_vertices() as u64);
    Ok(context.limit(&meter)?)
}

/// Returns the largest distance from a vertex to its [`limit`] position.
///
/// # Errors
///
/// Returns an error in the same cases as [`limit`](limit()).
pub fn limit_distance(
    mesh: &Mesh,
    rules: Rules,
    progress: &dyn Progress,
) -> Result<f64, SubdivisionError> {
    let mesh = dense(mesh);
    let context = LimitContext::checked(&mesh, rules)?;
    let n = mesh.n_vertices();
    let meter = Meter::new(progress, "limit surface", n as u64);
    let largest = of_blocks(n, &|block| {
        let (mut star, mut largest, len) = (Star::default(), 0.0_f64, block.len());
        for v in block.map(VertexId::new) {
            if context.read_settled(&mut star, v) {
                largest = largest.max(star.limit().distance(mesh.position(v)));
            }
        }
        meter.add(len)?;
        Ok(largest)
    });
    let largest: Result<Vec<f64>, Cancelled> = largest.into_iter().collect();
    Ok(largest?.into_iter().fold(0.0, f64::max))
}

/// The limit surface at one vertex.
#[derive(Clone, Copy, Default)]
struct VertexLimit {
    position: DVec3,
    tangents: [DVec3; 2],
    /// Whether the faces around the vertex have different tangent planes.
    is_sharp: bool,
}

/// A mesh and the subdivision rules. The constructor checks that limits can be computed.
struct LimitContext<'a> {
    mesh: &'a Mesh,
    rules: Rules,
    sharpness: Sharpness<'a>,
}

impl<'a> LimitContext<'a> {
    fn checked(mesh: &'a Mesh, rules: Rules) -> Result<Self, SubdivisionError> {
        if !rules.scheme.has_limit() {
            return Err(SubdivisionError::NoLimit(rules.scheme));
        }
        check_faces(mesh, rules.scheme)?;
        Ok(Self {
            mesh,
            rules,
            sharpness: Sharpness::of(mesh, rules),
        })
    }

    fn limit(&self, meter: &Meter) -> Result<Limit, Cancelled> {
        let n = self.mesh.n_vertices();
        let mut limits = vec![VertexLimit::default(); n];
        in_blocks(&mut limits, &|start, limits| {
            let mut star = Star::default();
            for (i, limit) in (start..).zip(limits.iter_mut()) {
                *limit = self.vertex(&mut star, VertexId::new(i));
            }
            meter.add(limits.len())
        })?;
        let mut tangents = vec![[DVec3::ZERO; 2]; n];
        fill_uncounted(&mut tangents, meter, |i| limits[i].tangents)?;
        let is_sharp = any(n, |i| limits[i].is_sharp);
        let corner_normals = is_sharp.then(|| self.corner_normals(&limits, meter));
        Ok(Limit {
            positions: computed(n, meter, |i| limits[i].position)?,
            tangents,
            corner_normals: corner_normals.transpose()?,
        })
    }

    /// Reads the star of `v` (the vertex and its neighborhood), and refines the star until no element is semi-sharp.
    /// Returns `false` for an isolated vertex.
    fn read_settled(&self, star: &mut Star, v: VertexId) -> bool {
        let Some(start) = self.mesh.vertex_half_edge(v) else {
            return false;
        };
        star.read(self.mesh, &self.sharpness, self.rules, v, start);
        while !star.is_settled() {
            star.refine();
        }
        true
    }

    fn vertex(&self, star: &mut Star, v: VertexId) -> VertexLimit {
        if !self.read_settled(star, v) {
            return VertexLimit {
                position: self.mesh.position(v),
                ..VertexLimit::default()
            };
        }
        let n_sharp = star.spoke_sharpness.iter().filter(|&&s| s > 0.0).count();
        VertexLimit {
            position: star.limit(),
            tangents: star.tangents(Sector::of_face(star, 0)),
            // The two boundary edges at a boundary vertex are always sharp.
            is_sharp: n_sharp > if star.is_inner { 1 } else { 2 },
        }
    }

    fn corner_normals(
        &self,
        limits: &[VertexLimit],
        meter: &Meter,
    ) -> Result<Vec<DVec3>, Cancelled> {
        computed(self.mesh.n_half_edges(), meter, |i| {
            let h = HalfEdgeId::new(i);
            if self.mesh.connectivity().face[i] == FaceId::NONE {
                return DVec3::ZERO;
            }
            let v = self.mesh.origin(h);
            let limit = &limits[v.index()];
            if !limit.is_sharp {
                return normal(&limit.tangents);
            }
            let mut star = Star::default();
            self.read_settled(&mut star, v);
            // A star lists its spokes (the edges around the vertex) counter-clockwise, but `vertex_half_edges` lists
            // them clockwise.
            let spoke = self.mesh.vertex_half_edges(v).position(|other| other == h);
            let spoke = star.spokes.len()
                - 1
                - spoke.expect("h is one of the outgoing half-edges of its origin");
            normal(&star.tangents(Sector::of_face(&star, spoke)))
        })
    }
}
