//! Subdivision surfaces: each level refines the mesh, and the refined meshes converge to a surface.
//!
//! Each level adds vertices on edges, in faces, or both, and connects the vertices into smaller faces. Most smooth
//! schemes also move each old vertex to a weighted mean of its neighborhood. Butterfly keeps the old vertices in place,
//! and Doo-Sabin replaces them. [`Rules`] hold the scheme and its options; [`subdivide`] computes the given number of
//! levels.
//!
//! | scheme | faces become | old vertices | limit surface |
//! | --- | --- | --- | --- |
//! | [`Loop`](Scheme::Loop) | 4 triangles each | move | smooth, curvature continuous except at vertices whose valence is not 6 |
//! | [`CatmullClark`](Scheme::CatmullClark) | a quad for each corner | move | smooth, curvature continuous except at vertices whose valence is not 4 |
//! | [`Midpoint`](Scheme::Midpoint) | 4 triangles, or a quad for each corner | stay | the mesh itself |
//! | [`Butterfly`](Scheme::Butterfly) | 4 triangles each | stay | smooth, through all vertices |
//! | [`Sqrt3`](Scheme::Sqrt3) | 3 triangles each, then old edges are flipped | move | smooth |
//! | [`DooSabin`](Scheme::DooSabin) | one face each, plus one face for each old edge and vertex | are replaced by faces | smooth |
//!
//! A level is not computed by a sequence of edits of the mesh. The new arrays are computed directly from the old
//! arrays, each element independently and in parallel. The result is identical bit for bit for any number of threads.
//! The modules `halves`, `triangles`, `quads`, `doo_sabin` and `sqrt3` explain how the ids of new elements follow from
//! the old ids. The weights of the means are in the module `masks`, and the rules for creases are in the module
//! `sharpness`.
//!
//! # Convergence
//!
//! For Loop and Catmull-Clark, [`limit`](fn@limit) computes the position to which each vertex converges. The diagram
//! shows the largest distance from a vertex to its limit position after each level of Loop subdivision:
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
//! `+` is a torus of regular valence, and `o` is an icosahedron. `*` stands for `+` and `o` at the same place. Each
//! level halves the edges. On the torus, the distance is quadratic in the edge length, so each level divides the
//! distance by four. Around the vertices of valence 5 of the icosahedron, each level scales the surface by the
//! subdominant eigenvalue 3/8 + cos(2π/5)/4 = 0.452. After the first levels, each level also scales the distance from a
//! vertex to its limit position by this eigenvalue.
//!
//! # Examples
//!
//! ```
//! use progress::NoProgress;
//! use subdivision::{Rules, Scheme, SubdivisionError};
//!
//! let cube = geometry::shapes::cube();
//! let mesh = subdivision::subdivide(&cube, Rules::of(Scheme::CatmullClark), 2, &NoProgress)?;
//! assert_eq!((mesh.n_vertices(), mesh.n_edges(), mesh.n_faces()), (98, 192, 96));
//!
//! let error = subdivision::subdivide(&cube, Rules::of(Scheme::Butterfly), 1, &NoProgress).unwrap_err();
//! assert!(matches!(error, SubdivisionError::NotTriangle { degree: 4, .. }));
//! # Ok::<(), SubdivisionError>(())
//! ```

mod attributes;
mod doo_sabin;
mod error;
mod face_varying;
mod halves;
mod input;
mod large_faces;
mod level;
mod limit;
mod links;
mod local;
mod masks;
mod matrix;
mod parallel;
mod quads;
mod rules;
mod sharpness;
mod size;
mod sqrt3;
mod subset;
mod topology;
mod triangles;
mod whole;

pub use error::SubdivisionError;
pub use input::{MAX_COORDINATE, check_faces};
pub use limit::{Limit, limit, limit_distance};
pub use local::refine_faces;
pub use matrix::{SparseMatrix, subdivision_matrix};
pub use rules::{Boundary, Creasing, FaceVarying, LoopWeights, Rules, Scheme, Split};
pub use size::{Count, Size, TooLarge};
pub use whole::{subdivide, subdivide_within};

#[cfg(test)]
mod fixtures;
#[cfg(test)]
mod oracle;
#[cfg(test)]
mod tests;
