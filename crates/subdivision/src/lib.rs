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
mod chosen;
mod doo_sabin;
mod error;
mod face_varying;
mod halves;
mod input;
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
mod topology;
mod triangles;
mod whole;

pub use error::SubdivisionError;
pub use input::check_faces;
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
