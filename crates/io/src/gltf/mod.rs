//! Reads and writes glTF 2.0, as JSON text (`.gltf`) and as a binary file (`.glb`).
//!
//! ```text
//! node --- node --- mesh --- primitive --- accessor --- buffer view --- buffer
//!  |  transform      |        |  attributes: POSITION, NORMAL, TEXCOORD_0, COLOR_0
//!  `- node           |        |  indices
//!                    |        `- material
//!                    `- primitive
//! ```
//!
//! Each mesh that a node references becomes an object in its own space, and the nodes become the graph of the scene.
//! The parts of a file are converted as follows:
//!
//! | glTF | in the scene |
//! | --- | --- |
//! | a mesh of a node | an object with the name of the node, mesh or file (the first that exists); names are made unique |
//! | a mesh of several nodes | one object with the name of the mesh, first node or file (the first that exists) |
//! | a node | a node of the graph, with its placement, name, extras, camera and light; if the nodes equal those that the writer creates for objects without nodes (one root node for each object, with the name of the object), the graph has no nodes |
//! | the scene that `scene` refers to, or the first scene | the reader reads the nodes of this scene; if the file has no scenes, it reads all nodes |
//! | triangles, strips and fans, with or without indices | triangles |
//! | points, lines | left out, with a note |
//! | `POSITION` | positions; vertices at exactly the same position are merged if their weights and deltas agree |
//! | `NORMAL` | vertex attribute `normal` if the corners of each vertex agree, otherwise corner attribute |
//! | `TANGENT` | corner attribute `tangent` with four numbers |
//! | `TEXCOORD_0`, `TEXCOORD_n` | corner attributes `uv` and `uvn`, with 1 - v instead of v, because v points up in the scene |
//! | `COLOR_0` | vertex or corner attribute `color`; alpha defaults to 1 |
//! | `_NAME` | vertex or corner attribute `NAME` with 1 to 4 floats |
//! | `JOINTS_n`, `WEIGHTS_n` | for each used joint, a vertex attribute [`mesh::joint_name`] with its weights |
//! | `POSITION` of a morph target | a vertex attribute [`mesh::morph_name`] with the deltas |
//! | `NORMAL` of a morph target | a vertex or corner attribute [`mesh::morph_normal_name`] with the changed normals: each value is the sum of a normal and its change |
//! | `TANGENT` of a morph target | a corner attribute [`mesh::morph_tangent_name`] with the changed tangents; the signs are those of the tangents of the mesh |
//! | `TEXCOORD_n` and `COLOR_0` of a morph target | corner attributes [`mesh::morph_value_name`] with the changes of `uvn` or `color`, with -v instead of v; for `color`, a vertex attribute if the corners of each vertex agree |
//! | skins, animations | kept in the graph; the numbers are rounded to 32 bits |
//! | `COLOR_1`, attributes of morph targets that the primitive does not have | left out, with a note |
//! | `material` | face attribute `material`, and materials of the object |
//! | textures, samplers, images | textures of the materials, with their names: the path of an image file, or the bytes of an image |
//! | `extras` of materials | kept in the material unchanged |
//! | cameras, lights | kept in the graph unchanged |
//! | `asset.copyright`, name of the scene, `extras` of asset, scene, document and meshes | kept in the graph unchanged |
//! | other `extras` | left out, with a note |
//! | other scenes, and all parts that the scene does not use | left out, with a note |
//! | names of accessors, buffer views and buffers | not kept: the writer creates new ones |
//!
//! With [`Placements::Bake`](crate::Placements::Bake), each node with a mesh becomes an object. The transform of the
//! node is applied to the positions, normals and tangents, and the scene has no graph. Skinned meshes are deformed to
//! the pose of their joints. If a transform is a reflection, the orientation of the faces is reversed.
//!
//! Accessors can be interleaved or sparse. The elements of an accessor can be integers, including normalized integers.
//! If an accessor has no view, all its values are zero, unless sparse values replace them. Buffers are files inside the
//! folder of the document, data URIs, or the second chunk of a GLB file.
//!
//! | extension | support |
//! | --- | --- |
//! | `KHR_mesh_quantization` | read; written on request: integers instead of floats |
//! | `EXT_meshopt_compression` | read; written on request |
//! | `KHR_meshopt_compression` | read |
//! | `KHR_texture_transform` | read and written: the transform of a texture |
//! | `KHR_materials_emissive_strength`, `KHR_materials_unlit` | read and written |
//! | `KHR_lights_punctual` | read and written |
//! | `KHR_draco_mesh_compression` | read |
//! | other required extensions | the file is refused |
//! | other optional extensions | left out, with a note |
//!
//! The writer uses the first table from right to left, to convert a scene to glTF. A glTF file has a separate vertex
//! for each side of a seam. Therefore, the writer splits each vertex whose corners have different values, and the
//! reader merges the resulting vertices again. The writer creates one primitive for each material. Writing a scene and
//! reading it again preserves the scene, with these exceptions:
//!
//! - numbers are rounded to 32 bits: if a position or the transform of a node is outside the range of 32-bit floats,
//!   the scene is refused; texture coordinates, custom attributes and deltas of morph targets outside this range become
//!   0,
//! - polygons are triangulated,
//! - faces are ordered by material,
//! - vertices at exactly the same position are merged, unless their weights or deltas differ,
//! - each vertex has at most four joints, unless the mesh was read from a file with more joints for each vertex, or
//!   [`WriteOptions::weight_sets`](crate::WriteOptions::weight_sets) allows more,
//! - normals are normalized, and colors are clamped to 0 to 1,
//! - the following content is lost: isolated vertices, empty meshes, unused materials, embedded images other than PNG
//!   and JPEG, vertex tangents, tangents without normals, integer attributes, tags, sets of texture coordinates after a
//!   gap in their numbering, and attributes of edges and faces (except `material`).
//!
//! If the [`WriteOptions`](crate::WriteOptions) request it, the module `quantize` quantizes arrays, and the module
//! `compress` compresses them.
//!
//! Every loss is reported as a [`Loss`](crate::Loss), and content that the reader leaves out or changes is reported as
//! a [`Note`](crate::Note).
//!
//! A file can use the same content several times, such as a mesh that several nodes reference. However, the memory for
//! all content together is limited to 64 times the size of the file, or more if the content is compressed. The limit is
//! never less than 16 MiB.
//!
//! Each part of the JSON, such as a node, is deserialized separately. Therefore, errors have the JSON pointer of the
//! part in which they occur. Errors in parts that are not read are ignored.

mod accessor;
mod budget;
mod buffers;
mod compress;
mod deform;
mod deformers;
mod document;
mod draco;
mod draco_json;
mod extras;
mod faces;
mod fill;
mod left_out;
mod materials;
mod meshopt;
mod morph_json;
mod morph_values;
mod names;
mod node_json;
mod nodes;
mod numbers;
mod peek;
mod pieces;
mod prepare;
mod primitives;
mod quantize;
mod read;
mod reference;
mod reorder;
mod rig;
mod rig_json;
mod split;
mod storage;
mod streams;
mod surface;
mod views;
mod write;
mod write_deform;
mod write_document;
mod write_materials;
mod write_nodes;
mod write_rig;

pub(crate) use buffers::document_of;
pub(crate) use peek::peek;
pub(crate) use read::read;
pub(crate) use storage::storage;
pub(crate) use write::write;
