//! Subdivision surfaces: from a coarse mesh to ever finer ones.
//!
//! Every level puts new vertices on edges and in faces, joins them to smaller faces, and, where the scheme
//! is smooth, moves each vertex to a mean of those around it. [`Rules`] name the scheme and its choices;
//! [`subdivide`] makes so many levels.
//!
//! | scheme | faces become | old vertices | limit surface |
//! | --- | --- | --- | --- |
//! | [`Loop`](Scheme::Loop) | 4 triangles each | move | smooth, curvature continuous away from valence ≠ 6 |
//! | [`CatmullClark`](Scheme::CatmullClark) | a quad for each corner | move | smooth, curvature continuous away from valence ≠ 4 |
//! | [`Midpoint`](Scheme::Midpoint) | 4 triangles, or a quad for each corner | stay | the mesh itself |
//! | [`Butterfly`](Scheme::Butterfly) | 4 triangles each | stay | smooth, through all vertices |
//! | [`Sqrt3`](Scheme::Sqrt3) | 3 triangles each, turned | move | smooth |
//! | [`DooSabin`](Scheme::DooSabin) | one, and one for each old edge and vertex | are cut off | smooth |
//!
//! A level is not a sequence of edits: its arrays are computed in closed form from the old ones, each
//! element by itself, in parallel, with the same bytes for any number of threads. How the numbers of new
//! elements follow from the old is written in the modules `halves`, `triangles`, `quads`, `doo_sabin` and
//! `sqrt3`; the means are in `masks`, creases in `sharpness`.
//!
//! # Convergence
//!
//! [`limit`] says where the vertices go. The largest distance from a vertex to its limit, for Loop:
//!
//! ```text
//! 1    |
//!      |  +
//!      |  o
//! 1e-1 |        +
//!      |        o
//!      |              +
//!      |              o
//! 1e-2 |                    +
//!      |                    o
//!      |                          +
//! 1e-3 |                          o
//!      |                                *
//!      |
//! 1e-4 |                                      *
//!      |                                            o
//!      |                                            +     o
//!      |
//! 1e-5 |                                                  +
//!      |
//!      +------------------------------------------------------
//!        0     1     2     3     4     5     6     7     8   level
//! ```
//!
//! \+ is a torus of regular valence: what is left is quadratic in the length of edges, so each level divides
//! it by 4. o is an icosahedron: around its vertices of valence 5 a level scales the surface, and at last
//! the distance too, by the subdominant eigenvalue 3/8 + cos(2π/5)/4 = 0.452.
//!
//! # Examples
//!
//! ```
//! use subdivision::{Rules, Scheme};
//!
//! let rules = Rules::of(Scheme::CatmullClark);
//! let mesh = subdivision::subdivide(&geometry::shapes::cube(), rules, 2, &op::NoProgress)?;
//! assert_eq!((mesh.n_vertices(), mesh.n_edges(), mesh.n_faces()), (98, 192, 96));
//! # Ok::<(), op::OpError>(())
//! ```

mod attributes;
mod chosen;
mod doo_sabin;
mod face_varying;
mod forecast;
mod halves;
mod level;
mod limit;
mod links;
mod local;
mod masks;
mod matrix;
mod meter;
mod operation;
mod quads;
mod rules;
mod sharpness;
mod sqrt3;
mod triangles;

pub use limit::{Limit, limit};
pub use local::refine_faces;
pub use matrix::{SparseMatrix, subdivision_matrix};
pub use operation::{MAX_LEVELS, Step, Until};
pub use rules::{Boundary, Creasing, FaceVarying, LoopWeights, Rules, Scheme, Split};

use mesh::{FaceId, Mesh};
use op::{OpError, Progress, Refusal};
use rayon::prelude::*;

use doo_sabin::DooSabin;
use forecast::Size;
use level::Topology;
use masks::{AnyMasks, ButterflyMasks, CatmullClarkMasks, LoopMasks, MidpointMasks};
use meter::Meter;
use quads::Quads;
use sharpness::Sharpness;
use sqrt3::Sqrt3;
use triangles::Triangles;

/// The mesh after so many levels.
///
/// Ids: with Loop, Butterfly and Midpoint old vertices keep their numbers, the vertex on edge e is V + e,
/// edge e becomes edges 2e and 2e + 1, and face f becomes faces 4f to 4f + 3, or, in quads, one for each
/// corner in order; the center of face f is V + E + f. With Doo-Sabin face f stays f, edge e becomes face
/// F + e and edges 2e and 2e + 1, and the faces of vertices follow. With Sqrt3 old vertices keep their
/// numbers and face f becomes faces 3f to 3f + 2. A mesh with dead elements is compacted first, and the ids
/// are those of the compacted mesh.
///
/// Vertex attributes are smoothed with the weights of the positions; corner values by
/// [`Rules::face_varying`]; parts of an edge or a face take the values of the whole. Normals are left out,
/// because they would be wrong. Sharpness ([`mesh::CREASE`], [`mesh::CORNER`]) shapes Loop and Catmull-Clark
/// surfaces and fades with the levels; other schemes hand it on.
///
/// Progress is reported from the threads that work.
///
/// # Errors
///
/// [`OpError::Refused`] with [`Refusal::NotTriangle`] if the scheme needs triangles and a face has more
/// corners, [`OpError::Budget`] if the elements would outnumber the ids, [`OpError::Cancelled`].
pub fn subdivide(
    mesh: &Mesh,
    rules: Rules,
    levels: u32,
    progress: &dyn Progress,
) -> Result<Mesh, OpError> {
    let mut mesh = mesh.clone();
    mesh.compact();
    check_faces(&mesh, rules.scheme)?;
    let size = Size::of(&mesh);
    size.check(rules.scheme, 0..levels, u64::MAX)
        .map_err(|too_large| OpError::Budget(too_large.to_string()))?;
    let meter = Meter::new(
        progress,
        rules.scheme.name(),
        size.work(rules.scheme, 0..levels),
    );
    for level in 0..levels {
        mesh = finer(&mesh, rules, level, &meter)?;
    }
    Ok(mesh)
}

/// Level number `level` (from 0) of a dense mesh whose faces the scheme takes and whose next level fits.
fn finer(mesh: &Mesh, rules: Rules, level: u32, meter: &Meter) -> Result<Mesh, OpError> {
    with_scheme(mesh, rules, level, |topology, masks, sharpness| {
        level::finer(mesh, rules, meter, topology, masks, sharpness)
    })
}

/// Gives the topology and the masks of a level of a scheme to `visit`, and the sharpness if the scheme uses it.
fn with_scheme<T>(
    mesh: &Mesh,
    rules: Rules,
    level: u32,
    visit: impl FnOnce(&dyn Topology, &dyn AnyMasks, Option<Sharpness>) -> T,
) -> T {
    let sharpness = Sharpness::of(mesh, rules);
    match rules.scheme {
        Scheme::Loop(weights) => {
            let masks = LoopMasks {
                mesh,
                sharpness,
                weights,
            };
            visit(&Triangles(mesh), &masks, Some(sharpness))
        }
        Scheme::CatmullClark => {
            let masks = CatmullClarkMasks { mesh, sharpness };
            visit(&Quads::new(mesh), &masks, Some(sharpness))
        }
        Scheme::Midpoint(split) => {
            let masks = MidpointMasks { mesh, split };
            match split {
                Split::Triangles => visit(&Triangles(mesh), &masks, None),
                Split::Quads => visit(&Quads::new(mesh), &masks, None),
            }
        }
        Scheme::Butterfly => visit(&Triangles(mesh), &ButterflyMasks(mesh), None),
        Scheme::DooSabin => {
            let topology = DooSabin::new(mesh);
            visit(&topology, &topology, None)
        }
        Scheme::Sqrt3 => {
            let topology = Sqrt3::new(mesh, level);
            visit(&topology, &topology, None)
        }
    }
}

fn check_faces(mesh: &Mesh, scheme: Scheme) -> Result<(), OpError> {
    if !scheme.needs_triangles() {
        return Ok(());
    }
    let is_polygon = |i: usize| !mesh.is_triangle(FaceId::new(i));
    match (0..mesh.n_faces())
        .into_par_iter()
        .position_first(is_polygon)
        .map(FaceId::new)
    {
        None => Ok(()),
        Some(f) => Err(OpError::refused(
            Refusal::NotTriangle,
            format!(
                "{} needs triangles, but {f} has {} corners",
                scheme.name(),
                mesh.degree(f)
            ),
        )
        .about([f])),
    }
}

#[cfg(test)]
mod fixtures;
#[cfg(test)]
mod oracle;
#[cfg(test)]
mod tests;
