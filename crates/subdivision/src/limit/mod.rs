//! The limit surface at the vertices of a mesh: where they go if subdivision never ends, and the plane
//! that touches the surface there.
//!
//! Where nothing is sharp, or what is sharp stays so, the limit is a mask over the neighborhood: the left
//! eigenvectors of the matrix that makes the next level's neighborhood (Halstead, Kass and DeRose, "Efficient,
//! Fair Interpolation using Catmull-Clark Surfaces", 1993; Hoppe et al., "Piecewise Smooth Surface
//! Reconstruction", 1994; Biermann, Levin and Zorin, "Piecewise Smooth Subdivision Surfaces with Normal
//! Control", 2000). Where sharpness ends on a later level the neighborhood is refined up to that level. At a
//! dart, where one sharp edge ends, there is no closed form: the neighborhood is refined until it stands
//! still.

mod masks;
mod star;

use mesh::{DVec3, FaceId, HalfEdgeId, Mesh, VertexId};
use progress::{Cancelled, Meter, Progress};

use crate::error::SubdivisionError;
use crate::input::{check_faces, dense};
use crate::parallel::{any, computed, fill_uncounted, in_blocks, of_blocks};
use crate::rules::Rules;
use crate::sharpness::Sharpness;
use masks::Plane;
use star::Star;

/// The limit surface at the vertices of a mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Limit {
    /// Where each vertex goes.
    pub positions: Vec<DVec3>,
    /// Two vectors that span the tangent plane at each vertex, of any length. Their cross product points
    /// outside. At a crease inside the mesh they belong to one of its sides; for an isolated vertex they
    /// are zero.
    pub tangents: Vec<[DVec3; 2]>,
    /// Where faces meet sharply inside the mesh, the unit normal of each corner by its half-edge, zero for
    /// half-edges without a face. `None` if one normal for each vertex says it all.
    pub corner_normals: Option<Vec<DVec3>>,
}

impl Limit {
    /// The unit normal at each vertex, from the tangents; zero where they span no plane.
    pub fn normals(&self) -> Vec<DVec3> {
        self.tangents.iter().map(normal).collect()
    }
}

fn normal([a, b]: &[DVec3; 2]) -> DVec3 {
    a.normalize_or_zero()
        .cross(b.normalize_or_zero())
        .normalize_or_zero()
}

/// The limit surface at the vertices of a mesh, for [`Scheme::Loop`](crate::Scheme::Loop) and [`Scheme::CatmullClark`](crate::Scheme::CatmullClark).
///
/// A mesh with dead elements is compacted first, and the numbers are those of the compacted mesh.
///
/// # Errors
///
/// Those of [`subdivide`](crate::subdivide), and [`SubdivisionError::NoLimit`] for other schemes.
///
/// # Examples
///
/// ```
/// use subdivision::{Rules, Scheme};
///
/// let cube = geometry::shapes::cube();
/// let rules = Rules::of(Scheme::CatmullClark);
/// let limit = subdivision::limit(&cube, rules, &progress::NoProgress)?;
/// // Valence 3: 3/8 of the corner, and 4/24 and 1/24 of its neighbors and the corners opposite.
/// assert!((limit.positions[7] - mesh::DVec3::splat(0.5)).length() < 1e-15);
/// # Ok::<(), subdivision::SubdivisionError>(())
/// ```
pub fn limit(
    mesh: &Mesh,
    rules: Rules,
    progress: &dyn Progress,
) -> Result<Limit, SubdivisionError> {
    let mesh = dense(mesh);
    let at = At::checked(&mesh, rules)?;
    let meter = Meter::new(progress, "limit surface", mesh.n_vertices() as u64);
    Ok(at.limit(&meter)?)
}

/// The largest distance from a vertex to its [`limit`].
///
/// # Errors
///
/// Those of [`limit`].
pub fn limit_distance(
    mesh: &Mesh,
    rules: Rules,
    progress: &dyn Progress,
) -> Result<f64, SubdivisionError> {
    let mesh = dense(mesh);
    let at = At::checked(&mesh, rules)?;
    let n = mesh.n_vertices();
    let meter = Meter::new(progress, "limit surface", n as u64);
    let largest = of_blocks(n, &|block| {
        let (mut star, mut largest, len) = (Star::default(), 0.0_f64, block.len());
        for v in block.map(VertexId::new) {
            if at.settled(&mut star, v) {
                largest = largest.max(star.limit().distance(mesh.position(v)));
            }
        }
        meter.add(len)?;
        Ok(largest)
    });
    let largest: Result<Vec<f64>, Cancelled> = largest.into_iter().collect();
    Ok(largest?.into_iter().fold(0.0, f64::max))
}

/// What is known at one vertex.
#[derive(Clone, Copy, Default)]
struct AtVertex {
    position: DVec3,
    tangents: [DVec3; 2],
    /// Whether the faces around it have different tangent planes.
    is_sharp: bool,
}

/// A mesh and its rules.
struct At<'a> {
    mesh: &'a Mesh,
    rules: Rules,
    sharpness: Sharpness<'a>,
}

impl<'a> At<'a> {
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
        let mut found = vec![AtVertex::default(); n];
        in_blocks(&mut found, &|start, found| {
            let mut star = Star::default();
            for (i, found) in (start..).zip(found.iter_mut()) {
                *found = self.vertex(&mut star, VertexId::new(i));
            }
            meter.add(found.len())
        })?;
        let mut tangents = vec![[DVec3::ZERO; 2]; n];
        fill_uncounted(&mut tangents, meter, |i| found[i].tangents)?;
        let is_sharp = any(n, |i| found[i].is_sharp);
        let corner_normals = is_sharp.then(|| self.corner_normals(&found, meter));
        Ok(Limit {
            positions: computed(n, meter, |i| found[i].position)?,
            tangents,
            corner_normals: corner_normals.transpose()?,
        })
    }

    /// Reads the star of `v` and refines it until it is settled; `false` for an isolated vertex.
    fn settled(&self, star: &mut Star, v: VertexId) -> bool {
        let Some(start) = self.mesh.vertex_half_edge(v) else {
            return false;
        };
        star.read(self.mesh, &self.sharpness, self.rules, v, start);
        while !star.is_settled() {
            star.refine();
        }
        true
    }

    fn vertex(&self, star: &mut Star, v: VertexId) -> AtVertex {
        if !self.settled(star, v) {
            return AtVertex {
                position: self.mesh.position(v),
                ..AtVertex::default()
            };
        }
        let n_sharp = star.sharp.iter().filter(|&&s| s > 0.0).count();
        AtVertex {
            position: star.limit(),
            tangents: star.tangents(Plane::of_face(star, 0)),
            // Both edges of the boundary are sharp.
            is_sharp: n_sharp > if star.is_inner { 1 } else { 2 },
        }
    }

    fn corner_normals(&self, found: &[AtVertex], meter: &Meter) -> Result<Vec<DVec3>, Cancelled> {
        computed(self.mesh.n_half_edges(), meter, |i| {
            let h = HalfEdgeId::new(i);
            if self.mesh.connectivity().face[i] == FaceId::NONE {
                return DVec3::ZERO;
            }
            let v = self.mesh.origin(h);
            let at = &found[v.index()];
            if !at.is_sharp {
                return normal(&at.tangents);
            }
            let mut star = Star::default();
            self.settled(&mut star, v);
            // Stars are counter-clockwise, circulators clockwise.
            let place = self.mesh.vertex_half_edges(v).position(|other| other == h);
            let place = star.spokes.len() - 1 - place.expect("a half-edge that leaves its origin");
            normal(&star.tangents(Plane::of_face(&star, place)))
        })
    }
}
