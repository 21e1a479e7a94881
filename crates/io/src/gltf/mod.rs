//! glTF 2.0, as JSON text (`.gltf`) and in one binary file (`.glb`).
//!
//! ```text
//! node --- node --- mesh --- primitive --- accessor --- buffer view --- buffer
//!  |  placement      |        |  attributes: POSITION, NORMAL, TEXCOORD_0, COLOR_0
//!  `- node           |        |  indices
//!                    |        `- material
//!                    `- primitive
//! ```
//!
//! Each node with a mesh is an object, with the placements of the nodes above it applied. What the parts of
//! a file become:
//!
//! | glTF | in the scene |
//! | --- | --- |
//! | a node with a mesh | an object, named as the node, else as the mesh, else as the file; names become unique |
//! | `matrix`, `translation`, `rotation`, `scale` | applied to positions and normals; mirrors turn faces round |
//! | the scene that `scene` names, else the first | all of the nodes in it; without scenes all nodes |
//! | triangles, strips and fans, with or without indices | triangles |
//! | points, lines | left out, and counted |
//! | `POSITION` | positions; vertices at exactly the same place become one |
//! | `NORMAL` | `normal` of vertices if the corners of each agree, and otherwise of corners |
//! | `TEXCOORD_0`, `TEXCOORD_n` | corner attributes `uv` and `uvn`, with v upwards: v becomes 1 - v |
//! | `COLOR_0` | `color` of vertices or corners; without alpha it is 1 |
//! | `_NAME` | `NAME` of vertices or corners, of 1 to 4 floats |
//! | `TANGENT`, `COLOR_1`, `JOINTS_n`, `WEIGHTS_n` | left out, and counted |
//! | `material` | face attribute `material` and the object's materials |
//! | textures, samplers, images | textures of the materials: the path of a file, or the bytes of a picture |
//! | cameras, lights, skins, animations, morph targets, other scenes | left out, and counted |
//!
//! Accessors may be interleaved, sparse, without a view (zeros), of integers, normalized or not. Buffers are
//! files beside the document, never outside of its folder, data URIs, or the second chunk of a GLB file.
//!
//! | extension | |
//! | --- | --- |
//! | `KHR_mesh_quantization` | read: integers in place of floats |
//! | `EXT_meshopt_compression`, `KHR_meshopt_compression` | read |
//! | `KHR_texture_transform` | read and written: the transform of a texture |
//! | `KHR_materials_emissive_strength`, `KHR_materials_unlit` | read and written |
//! | others that are required, such as `KHR_draco_mesh_compression` | the file is refused |
//! | others that are only used | left out, and counted |
//!
//! The writer goes the other way: glTF has a vertex for each side of a seam, so vertices are split where
//! their corners differ, and the reader joins them again. There is one primitive for each material. What is
//! written and read again is the same, except that
//!
//! - numbers have 32 bits: positions that 32 bits cannot hold are refused, other values become 0,
//! - polygons are cut into triangles,
//! - faces come back in the order of their materials,
//! - vertices at exactly the same position become one,
//! - normals have length 1, colors are between 0 and 1,
//! - isolated vertices, empty meshes, tangents, whole numbers, tags, texture coordinates behind a gap in
//!   their numbers, and what edges and faces have (but `material`) are lost.
//!
//! What is lost or cut is a [`Loss`](crate::Loss), what is left out or in the way a [`Note`](crate::Note).
//!
//! What is repeated, such as a mesh that many nodes show, may take 64 times the size of the file, and 16 MiB in
//! any case.
//!
//! The JSON is deserialised piece by piece into the types of `gltf_json`, so that an error knows its
//! JSON pointer and what is not read cannot be in the way.

mod accessor;
mod budget;
mod buffers;
mod document;
mod faces;
mod fill;
mod materials;
mod meshopt;
mod names;
mod nodes;
mod numbers;
mod peek;
mod pieces;
mod prepare;
mod primitives;
mod read;
mod split;
mod streams;
mod surface;
mod views;
mod write;
mod write_document;
mod write_materials;

pub(crate) use buffers::document_of;
pub(crate) use peek::peek;
pub(crate) use read::read;
pub(crate) use write::write;
