//! Algorithms on a [`Mesh`](mesh::Mesh). Most of these algorithms work on large parts of the mesh, not only on one
//! element and its neighbors.
//!
//! | items | contents |
//! | --- | --- |
//! | [`shapes`] | simple meshes |
//! | [`area`], [`volume`], [`bounds`], [`genus`], [`components`] | measures of whole meshes |
//! | [`gaussian_curvatures`], [`mean_curvatures`], [`principal_curvatures`] | discrete curvature |
//! | [`min_angle`], [`aspect_ratio`] | the shape of faces |
//! | [`geodesic_distances`], [`thickness`] | distances along the surface and through the solid |
//! | [`occlusion`] | ambient occlusion |
//! | [`distance`] | the distance between two surfaces |
//! | [`surface_index`] | nearest points, rays, intersections and winding numbers of a surface |
//! | [`predicates`] | exact tests on which side of a line or plane a point lies |
//! | [`merge_vertices`], [`parts`] | merging vertices, splitting a mesh into parts |
//! | [`triangulate`], [`fill_hole_triangles`] | triangulation of faces and holes |
//! | [`remesh`](mod@remesh) | nearly equilateral triangles of a given size |
//! | [`simplify`] | fewer triangles for nearly the same surface |
//! | [`bisect`], [`symmetrize`], [`bevel`] | cutting along a plane, mirroring one half, beveling |
//! | [`deform`] | bending, twisting, tapering, lattices, falloff, noise |
//! | [`smooth`](mod@smooth) | smoothing and denoising |
//! | [`Laplacian`], [`sparse`] | the cotangent Laplacian; sparse symmetric matrices and their solver |
//! | [`Scaled`] | very small and very large meshes in a suitable unit of length |
//! | [`samples`] | evenly spread points on a surface |
//! | [`uv`] | texture coordinates: charts, unwrapping, packing, stretch and overlaps |
//! | [`tangents`] | tangents for normal maps |

pub mod bevel;
mod bisect;
mod curvature;
pub mod deform;
pub mod distance;
mod face_quality;
mod fill_hole;
mod geodesic;
mod laplacian;
mod lines;
mod measure;
mod merge;
mod part;
pub mod predicates;
pub mod remesh;
mod sample;
mod scaled;
pub mod shapes;
pub mod simplify;
pub mod smooth;
pub mod sparse;
pub mod surface_index;
mod tangent;
pub mod triangulate;
pub mod uv;
mod visibility;

pub use bisect::{Bisection, SymmetrizeError, Symmetrized, bisect, symmetrize};
pub use curvature::{gaussian_curvatures, mean_curvatures, principal_curvatures, vertex_areas};
pub use face_quality::{aspect_ratio, min_angle};
pub use fill_hole::fill_hole_triangles;
pub use geodesic::geodesic_distances;
pub use laplacian::Laplacian;
pub use measure::{
    area, bounds, components, genus, n_components, sin_cos_degrees, valences, volume,
};
pub use merge::{MergeError, Merged, clusters, first_equal, merge_clusters, merge_vertices};
pub use part::{face_components, parts, separated};
pub use sample::{Sample, samples};
pub use scaled::Scaled;
pub use tangent::{Tangents, tangents};
pub use visibility::{occlusion, thickness};
