//! Writes quantized attributes, which are integers instead of floats (`KHR_mesh_quantization`).
//!
//! ```text
//! node of the scene        name, placement, children, extras, ...: the same as without quantization
//!  `- grid node             the same name, mesh, translation, scale
//! ```
//!
//! The positions of an object are rounded to points of a grid. An additional node, the grid node, references the mesh
//! and maps the grid to the space of the object. Each node that references the object gets a grid node as a child, so
//! the other nodes do not change. If no node references the object, only the grid node is written. The scale of the
//! grid is the same along all axes, so normals keep their directions.
//!
//! Normals are rounded on an octahedron. The octahedral filter of compressed files rounds normals in the same way.
//! Therefore, compressing a quantized file does not change its content.
#![expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "values are rounded and inside the range, and casts saturate"
)]

use std::collections::BTreeMap;

use glam::{DAffine3, DVec3};
use gltf_json::accessor::{ComponentType, Type};
use gltf_json::mesh::Semantic;
use mesh::Domain;
use scene::Graph;
use serde_json::{Value, json};

use super::meshopt::Filter;
use super::prepare::PreparedObject;
use super::streams::Stream;
use crate::loss::Losses;
use crate::packing::{Bits, PackingReport, Quantization};
use crate::weld;
use mesh::parallel;

/// The name of the extension.
pub(super) const QUANTIZATION: &str = "KHR_mesh_quantization";

/// Quantizes attributes, and collects data for the report.
#[derive(Default)]
pub(super) struct Quantizer<'a> {
    options: Option<Quantization>,
    is_compressed: bool,
    grids: BTreeMap<&'a str, Grid>,
    /// Whether the document uses the extension `KHR_mesh_quantization`.
    pub(super) uses_extension: bool,
    pub(super) report: PackingReport,
}

/// The grid of the positions of an object.
struct Grid {
    origin: [f32; 3],
    /// The scale factor of the grid node. Because readers convert the normalized integer 65535 to 1, the factor is the
    /// length of 65535 steps of the grid.
    scale: f32,
    /// The largest error of a position, in the space of the object.
    error: f64,
}

/// The values of an attribute, converted to integers.
pub(super) struct Integers {
    /// The integers as bytes, `stride` bytes for each element.
    pub(super) bytes: Vec<u8>,
    pub(super) stride: usize,
    pub(super) component: ComponentType,
    pub(super) kind: Type,
    /// The filter that the reader must apply to the bytes.
    pub(super) filter: Filter,
}

impl<'a> Quantizer<'a> {
    /// Creates a quantizer. `is_compressed` is true if the file is compressed. Only readers of compressed files apply
    /// filters.
    pub(super) fn new(options: Option<Quantization>, is_compressed: bool) -> Self {
        Self {
            options,
            is_compressed,
            ..Self::default()
        }
    }

    /// Quantizes the positions of an object. Returns the quantized positions and their bounds. Adds a loss if different
    /// positions become equal. Returns `None` if positions are not quantized.
    pub(super) fn positions(
        &mut self,
        prepared: &'a PreparedObject<'a>,
        losses: &mut Losses,
    ) -> Option<(Integers, [[u16; 3]; 2])> {
        let bits = self.options?.position;
        let PreparedObject { mesh, split, .. } = prepared;
        let name = &prepared.object.name;
        if !prepared.deformation.is_none() {
            // Positions of meshes with joints or morph targets are not quantized. Readers ignore the transform of the
            // node of a skinned mesh, so a grid node would have no effect. In a mesh with morph targets, the deltas
            // would have to be quantized to the same grid.
            let reason = "the object has joints or morph targets".to_owned();
            let what = (name.clone(), "positions".to_owned(), reason);
            self.report.unquantized.push(what);
            return None;
        }
        let Some(grid) = Grid::over(prepared, bits) else {
            let reason = "the size of the object is outside the range of 32-bit numbers".to_owned();
            let what = (name.clone(), "positions".to_owned(), reason);
            self.report.unquantized.push(what);
            return None;
        };
        let blocks = parallel::blocks(split.n, |block| {
            let mut bytes = Vec::with_capacity(8 * block.len());
            let (mut min, mut max, mut error) = ([u16::MAX; 3], [0; 3], 0.0_f64);
            for i in block {
                let position = mesh.position(split.vertex(mesh, i));
                let steps = grid.steps(position, bits);
                error = error.max(grid.position(steps).distance(position));
                for (k, step) in steps.into_iter().enumerate() {
                    (min[k], max[k]) = (step.min(min[k]), step.max(max[k]));
                    bytes.extend(step.to_le_bytes());
                }
                bytes.extend([0, 0]);
            }
            (bytes, [min, max], error)
        });
        let mut bounds = [[u16::MAX; 3], [0; 3]];
        let mut bytes = Vec::with_capacity(8 * split.n);
        let mut error = 0.0_f64;
        for (block, [min, max], block_error) in blocks {
            bytes.extend(block);
            error = error.max(block_error);
            for k in 0..3 {
                bounds[0][k] = bounds[0][k].min(min[k]);
                bounds[1][k] = bounds[1][k].max(max[k]);
            }
        }
        let merged = weld::n_merged_as(mesh, |p| DVec3::from(grid.steps(p, bits).map(f64::from)));
        let merged = merged.saturating_sub(weld::n_merged(mesh));
        let reason = "quantized to the position of another vertex, so readers merge these vertices";
        losses.add(Domain::Vertex, "position", merged, reason);
        self.grids.insert(name, Grid { error, ..grid });
        self.uses_extension = true;
        let integers = Integers {
            bytes,
            stride: 8,
            component: ComponentType::U16,
            kind: Type::Vec3,
            filter: Filter::None,
        };
        Some((integers, bounds))
    }

    /// Quantizes an attribute. Returns `None` if the attribute is not quantized.
    pub(super) fn stream(
        &mut self,
        prepared: &PreparedObject,
        stream: &Stream,
    ) -> Option<Integers> {
        let options = self.options?;
        match stream.semantic {
            Semantic::Normals | Semantic::Tangents => {
                Some(self.directions(prepared, stream, options.normal))
            }
            Semantic::Colors(_) => Some(fractions(prepared, stream, options.color).0),
            Semantic::TexCoords(_) => {
                let PreparedObject { mesh, split, .. } = prepared;
                let is_inside = parallel::all(split.n, |i| {
                    let (v, h) = split.corner(mesh, i);
                    let ([x, y, ..], _) = stream.at(mesh, v, h);
                    (0.0..=1.0).contains(&x) && (0.0..=1.0).contains(&y)
                });
                if !is_inside {
                    let reason = "coordinates are outside the range from 0 to 1".to_owned();
                    let name = prepared.object.name.clone();
                    let what = (name, stream.column.name.clone(), reason);
                    self.report.unquantized.push(what);
                    return None;
                }
                let (integers, error) = fractions(prepared, stream, options.uv);
                raise(&mut self.report.uv_error, error);
                Some(integers)
            }
            _ => None,
        }
    }

    /// Rounds unit vectors on an octahedron. The fourth component of a tangent, its sign, does not change.
    fn directions(&mut self, prepared: &PreparedObject, stream: &Stream, bits: Bits) -> Integers {
        let PreparedObject { mesh, split, .. } = prepared;
        let filter = Filter::Octahedral;
        let (stride, largest) = if bits.is_byte() {
            (4, 127.0)
        } else {
            (8, 32767.0)
        };
        let is_compressed = self.is_compressed;
        let blocks = parallel::blocks(split.n, |block| {
            let at = |i: usize| {
                let (v, h) = split.corner(mesh, i);
                stream.at(mesh, v, h).0.map(f64::from)
            };
            let mut bytes = Vec::with_capacity(stride * block.len());
            for i in block.clone() {
                let [x, y, z, w] = at(i);
                let last = (w * largest).round() as i16;
                let [x, y, one] = octahedral(DVec3::new(x, y, z), bits);
                for number in [x, y, one, last] {
                    bytes.extend_from_slice(&number.to_le_bytes()[..stride / 4]);
                }
            }
            let mut decoded = bytes.clone();
            filter.apply(&mut decoded, stride);
            let mut error = 0.0_f64;
            for (i, element) in block.zip(decoded.chunks_exact(stride)) {
                let [x, y, z, _] = at(i);
                let number = |k: usize| match *element {
                    [x, y, z, _] => f64::from([x, y, z][k].cast_signed()),
                    _ => f64::from(i16::from_le_bytes([element[2 * k], element[2 * k + 1]])),
                };
                let (a, b) = (
                    DVec3::new(x, y, z),
                    DVec3::new(number(0), number(1), number(2)),
                );
                error = error.max(libm::atan2(a.cross(b).length(), a.dot(b)));
            }
            (if is_compressed { bytes } else { decoded }, error)
        });
        let mut bytes = Vec::with_capacity(stride * split.n);
        for (block, error) in blocks {
            bytes.extend(block);
            raise(&mut self.report.normal_error, error.to_degrees());
        }
        self.uses_extension = true;
        Integers {
            bytes,
            stride,
            component: if stride == 4 {
                ComponentType::I8
            } else {
                ComponentType::I16
            },
            kind: stream.kind,
            filter: if is_compressed { filter } else { Filter::None },
        }
    }

    /// Moves the meshes of quantized objects to grid nodes, which map the grid of the positions to the space of the
    /// object. `nodes` begins with the nodes of the graph. The nodes after them reference the objects that no node of
    /// the graph references.
    pub(super) fn place(&mut self, graph: &Graph, nodes: &mut Vec<Value>) {
        let identity = DAffine3::IDENTITY;
        let maps = graph.to_scene();
        let of_graph: Vec<_> = graph
            .nodes()
            .iter()
            .map(|node| node.object.as_deref())
            .collect();
        for i in 0..nodes.len() {
            let name = match of_graph.get(i) {
                Some(object) => *object,
                None => nodes[i]["name"].as_str(),
            };
            let Some(grid) = name.and_then(|name| self.grids.get(name)) else {
                continue;
            };
            let (translation, scale) = (json!(grid.origin), json!(grid.scales()));
            let error = grid.error * stretch(maps.get(i).unwrap_or(&identity));
            raise(&mut self.report.position_error, error);
            if i >= of_graph.len() {
                nodes[i]["translation"] = translation;
                nodes[i]["scale"] = scale;
                continue;
            }
            // The grid node gets the name of its parent, because readers name an object after the node with the mesh.
            let child = json!({
                "name": nodes[i]["name"], "mesh": nodes[i]["mesh"].take(), "translation": translation, "scale": scale,
            });
            let index = nodes.len();
            if let Value::Array(children) = &mut nodes[i]["children"] {
                // The grid node is the first child of its parent, so that readers find the objects in the same order as
                // without quantization.
                children.insert(0, index.into());
            }
            nodes.push(child);
        }
    }
}

impl Grid {
    /// Creates the grid over the bounding box of an object. Returns `None` if 32-bit numbers cannot describe the grid.
    fn over(prepared: &PreparedObject, bits: Bits) -> Option<Self> {
        let PreparedObject { mesh, split, .. } = prepared;
        let blocks = parallel::blocks(split.n, |block| {
            let all = (DVec3::INFINITY, DVec3::NEG_INFINITY);
            block.fold(all, |(min, max), i| {
                let position = mesh.position(split.vertex(mesh, i));
                (min.min(position), max.max(position))
            })
        });
        let min = blocks
            .iter()
            .fold(DVec3::INFINITY, |min, block| min.min(block.0));
        let max = blocks
            .iter()
            .fold(DVec3::NEG_INFINITY, |max, block| max.max(block.1));
        let below = |x: f64| {
            let rounded = x as f32;
            if f64::from(rounded) > x {
                rounded.next_down()
            } else {
                rounded
            }
        };
        // Adding 0 turns -0 into 0, so that no coordinate of the origin is -0.
        let origin = min.to_array().map(|x| below(x) + 0.0);
        let size = (max - DVec3::from(origin.map(f64::from))).max_element();
        let exact = size * f64::from(u16::MAX) / f64::from(bits.largest());
        let rounded = exact as f32;
        let scale = if f64::from(rounded) < exact {
            rounded.next_up()
        } else {
            rounded
        };
        let scale = if size > 0.0 { scale } else { 1.0 };
        let is_valid = scale.is_normal() && origin.iter().all(|x| x.is_finite());
        let error = 0.0;
        is_valid.then_some(Self {
            origin,
            scale,
            error,
        })
    }

    fn scales(&self) -> [f32; 3] {
        [self.scale; 3]
    }

    fn steps(&self, position: DVec3, bits: Bits) -> [u16; 3] {
        let offset = position - DVec3::from(self.origin.map(f64::from));
        let steps = offset / f64::from(self.scale) * f64::from(u16::MAX);
        let most = f64::from(bits.largest());
        steps.to_array().map(|x| x.round().clamp(0.0, most) as u16)
    }

    /// Returns the position that a reader computes from grid coordinates. The position is in the space of the object.
    fn position(&self, steps: [u16; 3]) -> DVec3 {
        let fraction = DVec3::from(steps.map(f64::from)) / f64::from(u16::MAX);
        DVec3::from(self.origin.map(f64::from)) + fraction * f64::from(self.scale)
    }
}

/// Rounds the numbers of an attribute to integers. The numbers are in the range from 0 to 1. Returns the rounded
/// numbers and the largest error.
fn fractions(prepared: &PreparedObject, stream: &Stream, bits: Bits) -> (Integers, f64) {
    let PreparedObject { mesh, split, .. } = prepared;
    let (size, largest) = if bits.is_byte() {
        (1, 255.0)
    } else {
        (2, 65535.0)
    };
    let n = stream.kind.multiplicity();
    let stride = (size * n).next_multiple_of(4);
    let blocks = parallel::blocks(split.n, |block| {
        let mut bytes = Vec::with_capacity(stride * block.len());
        let mut error = 0.0_f64;
        for i in block {
            let (v, h) = split.corner(mesh, i);
            let end = bytes.len() + stride;
            for x in stream.at(mesh, v, h).0.into_iter().take(n).map(f64::from) {
                let most = f64::from(bits.largest());
                let stored = ((x * most).round() / most * largest).round();
                error = error.max((stored / largest - x).abs());
                bytes.extend_from_slice(&(stored as u16).to_le_bytes()[..size]);
            }
            bytes.resize(end, 0);
        }
        (bytes, error)
    });
    let error = blocks
        .iter()
        .fold(0.0, |most: f64, block| most.max(block.1));
    let bytes: Vec<_> = blocks.into_iter().map(|block| block.0).collect();
    let integers = Integers {
        bytes: bytes.concat(),
        stride,
        component: if size == 1 {
            ComponentType::U8
        } else {
            ComponentType::U16
        },
        kind: stream.kind,
        filter: Filter::None,
    };
    (integers, error)
}

/// Maps a point of the unit sphere to the unfolded octahedron and rounds it there. The first two numbers of the result
/// are the coordinates of the rounded point. The third number is the integer that represents 1.
///
/// Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors", 2014, section 3.3.
fn octahedral(v: DVec3, bits: Bits) -> [i16; 3] {
    let length = v.x.abs() + v.y.abs() + v.z.abs();
    let v = if length > 0.0 { v / length } else { DVec3::Z };
    // In the octahedral encoding, the lower half of the sphere is folded over the edges of the upper half.
    let [x, y] = if v.z >= 0.0 {
        [v.x, v.y]
    } else {
        [
            (1.0 - v.y.abs()).copysign(v.x),
            (1.0 - v.x.abs()).copysign(v.y),
        ]
    };
    let one = bits.largest() >> 1;
    [x, y, 1.0].map(|x| (x * f64::from(one)).round() as i16)
}

/// Returns an upper bound for the factor by which a map stretches lengths. The exact factor is the square root of the
/// largest eigenvalue of M^T M, where M is the matrix of the map. The largest sum of the absolute values in a column of
/// M^T M is an upper bound of the eigenvalues. The bound is exact if M scales along each axis and then rotates.
fn stretch(map: &DAffine3) -> f64 {
    let m = map.matrix3;
    let square = m.transpose() * m;
    let sum = |k: usize| square.col(k).abs().element_sum();
    sum(0).max(sum(1)).max(sum(2)).sqrt()
}

fn raise(most: &mut Option<f64>, error: f64) {
    *most = Some(most.map_or(error, |most| most.max(error)));
}
