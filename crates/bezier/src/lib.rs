//! Bezier curves and patches: de Casteljau's algorithm, derivatives, exact normals, and tessellation of
//! patches into polygons.
//!
//! The crate works only on points and numbers, and does not depend on the crates for meshes, files or operations.
//!
//! - A **Bezier curve** c(t) of degree n has n + 1 *control points* `p_i`. The point c(t) is a weighted mean of the
//!   control points: the sum of `p_i B(n, i)(t)`, where B(n, i) are the Bernstein polynomials. See [`Curve`], in 2D and
//!   3D.
//! - **De Casteljau's algorithm** computes c(t) in levels. The line segments between consecutive points of a level are
//!   called legs. Each point of the next level divides one leg in the ratio t : 1 - t. See [`one_step`] and
//!   [`Curve::levels`].
//! - A **bicubic patch** s(u, v) has 4 by 4 control points: u runs along the rows, v across them. Each row defines a
//!   cubic curve in u. For a given u, the points of these four curves are the control points of a cubic curve in v. See
//!   [`Patch`].
//! - A **tessellation** samples patches at u = i/n, v = j/n and joins the samples by triangles or
//!   quads. See [`tessellate()`] and [`counts`].
//!
//! The corners of a face are in counter-clockwise order if the normal ds/du x ds/dv points to the viewer. If two
//! patches share a boundary, their tessellations into the same number of segments have the same vertex positions on
//! this boundary, bit for bit. A side of a patch is collapsed if all of its points coincide. A collapsed side becomes
//! one vertex of the tessellation, with an exact normal.
//!
//! # Examples
//!
//! ```
//! use bezier::{Curve, DVec2, DVec3, Faces, Patch, counts, tessellate};
//!
//! // A curve, and the construction of its point at t = 0.5.
//! let arch = Curve::new(vec![DVec2::ZERO, DVec2::new(0.0, 4.0), DVec2::new(4.0, 4.0)])?;
//! let levels = arch.levels(0.5);
//! assert_eq!(levels[1], [DVec2::new(0.0, 2.0), DVec2::new(2.0, 4.0)]);
//! assert_eq!(levels[2], [arch.point(0.5)]);
//!
//! // A hill over a square, tessellated into triangles.
//! let height = [0.0, 1.0, 1.0, 0.0];
//! let hill = Patch::new([0, 1, 2, 3].map(|r| {
//!     [0, 1, 2, 3].map(|c| DVec3::new(c as f64, r as f64, height[r] * height[c]))
//! }))?;
//! assert_eq!(hill.normal(0.5, 0.5), DVec3::Z);
//! let mesh = tessellate(&[hill], 8, Faces::Triangles)?;
//! assert_eq!((mesh.positions.len(), mesh.face_count()), (81, 128));
//! assert_eq!(counts(&[hill], 8, Faces::Triangles)?.faces, 128);
//! # Ok::<(), bezier::BezierError>(())
//! ```
//!
//! # Sources
//!
//! - de Casteljau, "Outillages méthodes calcul", Citroën, 1959: the algorithm.
//! - Farin, "Curves and Surfaces for CAGD", 5th edition, 2002: the names and the formulas.
//! - Newell, "The utilization of procedure models in digital image synthesis", 1975: the teapot,
//!   whose lid and bottom have collapsed sides.

mod collapse;
pub mod curve;
mod error;
#[cfg(test)]
mod fixtures;
pub mod normal;
#[cfg(test)]
mod oracle;
pub mod patch;
mod point;
pub mod polygons;
pub mod tessellate;
mod weights;

pub use curve::{Curve, MAX_POINTS, one_step};
pub use error::BezierError;
pub use glam::{DVec2, DVec3};
pub use patch::{MAX_COORDINATE, Patch};
pub use point::Point;
pub use polygons::{Counts, Faces, Tessellation};
pub use tessellate::{counts, tessellate, tessellate_patch};
