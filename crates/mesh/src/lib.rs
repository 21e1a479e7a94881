//! A half-edge mesh of polygons in space.
//!
//! Every edge is a pair of half-edges that run in opposite directions, one on each side of the edge. A half-edge stores
//! the next half-edge around its face, its origin vertex, and its face:
//!
//! ```text
//!              c
//!            /   \
//!          /       \            h = half-edge from a to b, on face f
//!        /     f     \          next(h)      = from b to c
//!      /               \        origin(h)    = a, target(h) = b
//!    a ------- h ------> b      face(h)      = f
//!      <---- twin(h) ---        twin(h)      = from b to a, on the other face or on the boundary
//! ```
//!
//! Ids are plain numbers ([`VertexId`], [`HalfEdgeId`], [`EdgeId`], [`FaceId`]). The half-edges of edge e have the ids
//! 2e and 2e + 1, so `h.twin()` and `h.edge()` need no mesh. Faces are counter-clockwise when seen from outside.
//! Iterators around a vertex go clockwise.
//!
//! # Invariants
//!
//! [`Mesh::defects`] lists every broken invariant, with the element that breaks it:
//!
//! 1. Arrays with one entry for each element of the same kind (for example, for each half-edge) have the same length.
//!    The number of half-edges is even.
//! 2. Every stored id belongs to an element that was not removed.
//! 3. `next` is a permutation of the half-edges. The half-edge `next(h)` lies on the same face as `h` (or around the
//!    same hole), and starts where `h` ends: `origin(next(h)) == target(h)`.
//! 4. The two ends of an edge are different vertices, and each edge has a face on at least one side. Every edge has two
//!    half-edges. At a boundary edge, one half-edge h has no face: `face(h)` is `None`.
//! 5. A face has at least three corners. Its half-edges form one loop, which contains the
//!    [`face_half_edge`](Mesh::face_half_edge) of the face.
//! 6. The [`vertex_half_edge`](Mesh::vertex_half_edge) of a vertex is an outgoing half-edge of that vertex. At a
//!    boundary vertex, this half-edge has no face. Only an isolated vertex has no half-edge.
//! 7. The faces at a vertex form one connected fan with at most one gap: walking around the vertex reaches
//!    all of its outgoing half-edges.
//! 8. Positions are finite.
//! 9. An attribute column has one value for each element of its domain: vertex, corner, edge or face.
//!
//! # Editing
//!
//! A local edit checks whether it is possible before it changes the mesh. If it returns `Err`, the mesh is unchanged.
//!
//! | on | edits |
//! | --- | --- |
//! | edges | [`flip_edge`](Mesh::flip_edge), [`split_edge`](Mesh::split_edge), [`insert_vertex`](Mesh::insert_vertex), [`collapse_edge`](Mesh::collapse_edge), [`dissolve_edge`](Mesh::dissolve_edge), [`delete_edge`](Mesh::delete_edge), [`bevel_edge`](Mesh::bevel_edge), [`cut_edges`](Mesh::cut_edges), [`stitch_edges`](Mesh::stitch_edges) |
//! | faces | [`split_face`](Mesh::split_face), [`connect_vertices`](Mesh::connect_vertices), [`poke_face`](Mesh::poke_face), [`cut_face`](Mesh::cut_face), [`delete_faces`](Mesh::delete_faces), [`extrude_faces`](Mesh::extrude_faces), [`inset_face`](Mesh::inset_face), [`bevel_face`](Mesh::bevel_face), [`reverse_faces`](Mesh::reverse_faces) |
//! | vertices | [`split_vertex`](Mesh::split_vertex), [`dissolve_vertex`](Mesh::dissolve_vertex), [`delete_vertex`](Mesh::delete_vertex), [`bevel_vertex`](Mesh::bevel_vertex), [`set_position`](Mesh::set_position) |
//! | holes | [`fill_hole`](Mesh::fill_hole), [`fill_hole_by_ears`](Mesh::fill_hole_by_ears), [`bridge_loops`](Mesh::bridge_loops) |
//! | whole meshes | [`reverse`](Mesh::reverse) |
//!
//! In the documentation of the edits, V is the number of vertices, E the number of edges, and F the number of faces. If
//! an edit removes an element, the element is marked dead. The id of a dead element is not reused until
//! [`Mesh::compact`] renumbers the elements. If an edit that added elements is undone, later edits reuse the ids of
//! these elements.
//!
//! [`Mesh::begin`] starts to record edits. [`Mesh::rollback`] undoes the recorded edits and ends the recording.
//! [`Mesh::commit`] keeps the edits, ends the recording and returns a [`Change`]. Later, [`Mesh::revert`] can undo this
//! change; it returns another change, with which the edits can be redone. Operations on a whole mesh build a new mesh
//! from arrays ([`Mesh::from_arrays`]) or from polygons ([`build()`]), and replace the old mesh with [`Mesh::replace`].
//!
//! # Read in this order
//!
//! The following 19 files explain the data structure, and how edits change a mesh. The edits in other files follow the
//! pattern of `flip.rs` and `split.rs`. Of the other files in `build`, `polygons.rs`, `buckets.rs` and `star.rs` are
//! used for all input; `orient.rs`, `split.rs` and `report.rs` handle polygons that do not form a manifold.
//!
//! | files | contents |
//! | --- | --- |
//! | `id.rs`, `arrays.rs`, `traverse.rs` | ids and elements, the arrays of a mesh, walking around faces and vertices |
//! | `validate.rs` | the invariants above, as functions |
//! | `measure.rs` | areas, normals and angles of single elements |
//! | `attribute.rs`, `attribute/columns.rs`, `attribute/values.rs` | named columns of values |
//! | `attribute/rig.rs` | the names of the columns that deform a mesh |
//! | `marks.rs`, `write.rs`, `journal.rs`, `compact.rs` | dead elements, writing single entries, undo, renumbering |
//! | `edit/mod.rs`, `edit/flip.rs`, `edit/split.rs` | the reasons for refusing an edit, and two edits |
//! | `build/mod.rs`, `build/pair.rs`, `build/assemble.rs` | building a mesh from polygons |
//!
//! # Examples
//!
//! ```
//! use geometry::shapes;
//! use mesh::EditError;
//!
//! let mut mesh = shapes::icosahedron();
//! let e = mesh.edges().next().unwrap();
//! mesh.flip_edge(e)?;
//! let m = mesh.split_edge(e, 0.5)?;
//! assert_eq!(mesh.valence(m), 4);
//! assert_eq!(mesh.euler_characteristic(), 2);
//! assert!(mesh.defects().is_empty());
//! # Ok::<(), EditError>(())
//! ```

#[cfg(test)]
extern crate self as mesh;

/// The unit tests of this crate cannot use `geometry` as a dependency. The functions of `geometry` take the type `Mesh`
/// of the library build of this crate; the test build defines a different type `Mesh`. Therefore, the unit tests
/// compile the files of `geometry` that they need.
#[cfg(test)]
#[path = "../../geometry/src"]
pub mod geometry {
    pub mod fill_hole;
    pub mod measure;
    pub mod shapes;

    pub use fill_hole::fill_hole_triangles;
    pub use measure::{area, genus, n_components, volume};
}
#[cfg(test)]
use crate::geometry::{shapes, volume};

mod arrays;
mod attribute;
pub mod build;
mod compact;
mod edit;
mod id;
mod journal;
mod marks;
mod measure;
pub mod parallel;
mod prefetch;
mod readable;
mod reverse;
mod traverse;
mod validate;
mod write;
mod zeroed;

pub use arrays::{Connectivity, Mesh};
pub use attribute::{
    Attribute, Attributes, COLOR, CORNER_NORMAL, CORNER_TANGENT, CREASE, Column, MATERIAL, Rule,
    SMOOTHING, Sources, TANGENT, UV, VERTEX_NORMAL, VERTEX_SHARPNESS, Value, Values,
    is_morph_direction, is_rig_name, joint_name, joint_of, morph_name, morph_normal_name,
    morph_normal_of, morph_of, morph_tangent_name, morph_tangent_of, morph_value_name,
    morph_value_of, uv_set,
};
pub use build::{BuildError, BuildOutput, BuildReport, Elements, NonManifold, Repair, build};
pub use compact::Renumbering;
pub use edit::{EditError, Seams, polygon_parts};
pub use glam::{DMat3, DVec2, DVec3, DVec4};
pub use id::{Domain, EdgeId, Element, FaceId, HalfEdgeId, Id, VertexId};
pub use journal::Change;
pub use measure::{angle_between, area_vector};
pub use prefetch::prefetch;
pub use readable::{counted, readable, readable_bytes};
pub use traverse::Orbit;
pub use validate::Defect;
pub use zeroed::{OutOfMemory, require_memory, zeroed};
