//! Converts a `<geometry>` to polygons.

use std::collections::BTreeMap;
use std::rc::Rc;

use glam::{DVec2, DVec3, DVec4};
use mesh::{COLOR, CORNER_NORMAL, Domain, UV};

use super::cost;
use super::document::{
    Document, Node, child, elements, error_at, named, natural, number_of, required, word_error,
};
use super::outline::{Outline, shape};
use super::sources::{Vectors, vectors};
use crate::Polygons;
use crate::fault::Fault;

/// The maximum number of sets of texture coordinates.
const MAX_UV_SETS: usize = 8;

/// The polygons of a geometry in its local coordinates.
#[derive(Debug, Default)]
pub(super) struct Surface<'a> {
    /// The polygons, without materials.
    pub(super) polygons: Polygons,
    /// The material symbols of the polygons, in order of first occurrence.
    pub(super) symbols: Vec<&'a str>,
    /// For each polygon, the index of its material symbol in `symbols`, or -1 if the polygon has no symbol.
    pub(super) symbol_of: Vec<i32>,
}

impl Surface<'_> {
    /// The approximate size of the polygons in bytes.
    pub(super) fn cost(&self) -> usize {
        let polygons = &self.polygons;
        let columns = polygons.attributes.of(Domain::Corner).len();
        let names: usize = self.symbols.iter().map(|name| name.len()).sum();
        cost::VERTEX * polygons.positions.len()
            + (cost::CORNER + cost::VALUE * columns) * polygons.corners.len()
            + cost::MATERIAL * self.symbols.len()
            + names
    }
}

/// Reads geometries. If several inputs refer to the same source, its vectors are read only once.
pub(super) struct Geometries<'a, 'd> {
    pub(super) document: &'d Document<'a>,
    sources: BTreeMap<(u32, usize), Rc<Vectors>>,
}

/// The meaning of the vectors of an `<input>` element.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Normal,
    Color,
    Uv(usize),
}

struct Input<'a> {
    kind: Kind,
    /// Each corner has several indices. This field is the position, counted from 0, of the index that this input uses.
    offset: usize,
    source: Node<'a>,
}

/// The `<input>` elements of a list of polygons.
struct Inputs<'a> {
    /// The number of indices of each corner.
    stride: usize,
    /// The position of the vertex index among the indices of a corner, counted from 0.
    vertex: usize,
    /// The element with the positions.
    vertices: Node<'a>,
    attributes: Vec<Input<'a>>,
}

/// Attributes of corners. Each attribute is empty or has one value for each corner.
#[derive(Default)]
struct Columns {
    normals: Vec<DVec3>,
    colors: Vec<DVec4>,
    uvs: BTreeMap<usize, Vec<DVec2>>,
}

impl<'a, 'd> Geometries<'a, 'd> {
    pub(super) fn new(document: &'d Document<'a>) -> Self {
        let sources = BTreeMap::new();
        Self { document, sources }
    }

    /// Reads the polygons of a geometry. Returns `None` if the geometry has no polygons.
    ///
    /// # Errors
    ///
    /// Returns the first error in the geometry.
    pub(super) fn surface(&mut self, geometry: Node<'a>) -> Result<Option<Surface<'a>>, Fault> {
        let Some(mesh) = child(geometry, "mesh") else {
            return Ok(None);
        };
        let mut surface = Surface::default();
        let mut symbols = BTreeMap::new();
        let mut columns = Columns::default();
        let mut vertices: Option<Node> = None;
        for list in elements(mesh) {
            let name = list.tag_name().name();
            if matches!(name, "lines" | "linestrips" | "points") {
                let count = natural(list, "count")?.unwrap_or(1);
                self.document
                    .left_out(count, list, ("polylines", "lines and points left out"));
            }
            let Some(shape) = shape(list, self.document)? else {
                continue;
            };
            let inputs = self.inputs(list)?;
            if *vertices.get_or_insert(inputs.vertices) != inputs.vertices {
                let message = "expected the same vertices for all polygons of a mesh";
                return Err(error_at(list, message));
            }
            let outline = shape.read(list, inputs.stride, self.document)?;
            let n_corners = outline.order.len();
            self.document.take(list, n_corners * cost::CORNER)?;
            self.add(list, &inputs, &outline, &mut surface.polygons, &mut columns)?;
            let mut new = 0;
            let symbol = list.attribute("material").map_or(-1, |symbol| {
                let next = surface.symbols.len();
                *symbols.entry(symbol).or_insert_with(|| {
                    surface.symbols.push(symbol);
                    new = cost::MATERIAL;
                    i32::try_from(next).unwrap_or(i32::MAX)
                })
            });
            self.document.take(list, new)?;
            surface.symbol_of.resize(surface.polygons.n_faces(), symbol);
        }
        let (Some(vertices), true) = (vertices, surface.polygons.n_faces() > 0) else {
            return Ok(None);
        };
        let positions = self.positions(vertices)?;
        self.document
            .take(vertices, positions.len() * cost::VERTEX)?;
        let position = |i| DVec3::from_array(positions.get(i, [0.0; 3]));
        surface.polygons.positions = (0..positions.len()).map(position).collect();
        columns.finish(&mut surface.polygons);
        Ok(Some(surface))
    }

    fn positions(&mut self, vertices: Node<'a>) -> Result<Rc<Vectors>, Fault> {
        let is_it = |input: &Node| input.attribute("semantic") == Some("POSITION");
        let position = named(vertices, "input").find(is_it);
        let position = position.ok_or_else(|| error_at(vertices, "expected an input POSITION"))?;
        let source = self.source_of(position)?;
        self.vectors(source, &["X", "Y", "Z"], 3)
    }

    fn source_of(&self, input: Node<'a>) -> Result<Node<'a>, Fault> {
        let source = self.document.follow(input, "source", &["source"])?;
        source.ok_or_else(|| error_at(input, "sources in other files are not supported"))
    }

    fn vectors(
        &mut self,
        source: Node<'a>,
        names: &[&str],
        least: usize,
    ) -> Result<Rc<Vectors>, Fault> {
        let key = (number_of(source), names.len());
        if let Some(known) = self.sources.get(&key) {
            return Ok(Rc::clone(known));
        }
        let (read, n_numbers) = vectors(self.document, source, names, least)?;
        let bytes = 8 * read.values.len() + cost::NUMBER * n_numbers;
        self.document.take(source, bytes)?;
        let read = Rc::new(read);
        self.sources.insert(key, Rc::clone(&read));
        Ok(read)
    }

    /// Reads the inputs of a list of polygons, followed by the inputs of its `<vertices>` element.
    fn inputs(&self, list: Node<'a>) -> Result<Inputs<'a>, Fault> {
        let mut stride = 0;
        let mut vertex = None;
        let mut attributes: Vec<Input> = Vec::new();
        let mut add = |input: Node<'a>, offset: usize| -> Result<(), Fault> {
            let kind = match required(input, "semantic")? {
                "VERTEX" | "POSITION" => return Ok(()),
                "NORMAL" => Some(Kind::Normal),
                "COLOR" => Some(Kind::Color),
                "TEXCOORD" => Some(Kind::Uv(natural(input, "set")?.unwrap_or(0))),
                _ => None,
            };
            match kind.filter(|kind| attributes.iter().all(|input| input.kind != *kind)) {
                Some(kind) if attributes.len() < MAX_UV_SETS + 2 => attributes.push(Input {
                    kind,
                    offset,
                    source: self.source_of(input)?,
                }),
                _ => {
                    let what = (
                        "inputs",
                        "inputs left out: repeated, too many, or with a semantic that is not supported",
                    );
                    self.document.left_out(1, input, what);
                }
            }
            Ok(())
        };
        for input in named(list, "input") {
            let offset = natural(input, "offset")?
                .ok_or_else(|| error_at(input, "expected an attribute `offset`"))?;
            if offset > 1000 {
                let message =
                    format!("expected the attribute `offset` to be at most 1000, found {offset}");
                return Err(error_at(input, message));
            }
            stride = stride.max(offset + 1);
            if input.attribute("semantic") == Some("VERTEX") && vertex.is_none() {
                vertex = Some((input, offset));
            }
            add(input, offset)?;
        }
        let (input, vertex) = vertex.ok_or_else(|| error_at(list, "expected an input VERTEX"))?;
        let vertices = self.document.follow(input, "source", &["vertices"])?;
        let vertices =
            vertices.ok_or_else(|| error_at(input, "vertices in other files are not supported"))?;
        let of_vertices: Vec<Node> = named(vertices, "input").collect();
        for &input in &of_vertices {
            add(input, vertex)?;
        }
        // The inputs of the `<vertices>` element are read again for each list of polygons that uses the element.
        // Therefore, the cost of these inputs is subtracted from the memory budget once for each list.
        self.document.take(list, cost::NUMBER * of_vertices.len())?;
        Ok(Inputs {
            stride,
            vertex,
            vertices,
            attributes,
        })
    }

    /// Appends the polygons of one list.
    fn add(
        &mut self,
        list: Node<'a>,
        inputs: &Inputs<'a>,
        outline: &Outline<'a>,
        polygons: &mut Polygons,
        columns: &mut Columns,
    ) -> Result<(), Fault> {
        let check = |offset: usize, n: usize, what: &str| {
            let of_input = outline.indices.iter().skip(offset).step_by(inputs.stride);
            match of_input.enumerate().find(|(_, i)| **i as usize >= n) {
                None => Ok(()),
                Some((corner, i)) => {
                    let k = corner * inputs.stride + offset;
                    let message = format!("expected a {what} index below {n}, found {i}");
                    Err(word_error(&outline.lists, k, message))
                }
            }
        };
        let before = polygons.corners.len();
        let index = |offset: usize| {
            let corners = outline.order.iter();
            corners.map(move |corner| outline.indices[corner * inputs.stride + offset])
        };
        let n_positions = self.positions(inputs.vertices)?.len();
        check(inputs.vertex, n_positions, "position")?;
        polygons.corners.extend(index(inputs.vertex));
        let mut end = before;
        for degree in &outline.degrees {
            end += degree;
            let end = u32::try_from(end).map_err(|_| error_at(list, "too many corners"))?;
            polygons.offsets.push(end);
        }
        for input in &inputs.attributes {
            let (names, what): (&[&str], _) = match input.kind {
                Kind::Normal => (&["X", "Y", "Z"], "normal"),
                Kind::Color => (&["R", "G", "B"], "color"),
                Kind::Uv(_) => (&["S", "T"], "texture coordinate"),
            };
            let vectors = self.vectors(input.source, names, names.len())?;
            check(input.offset, vectors.len(), what)?;
            self.document
                .take(list, outline.order.len() * cost::VALUE)?;
            let index = index(input.offset).map(|i| i as usize);
            match input.kind {
                Kind::Normal => {
                    let normal = |i| DVec3::from_array(vectors.get(i, [0.0; 3]));
                    columns.normals.resize(before, DVec3::ZERO);
                    columns.normals.extend(index.map(normal));
                }
                Kind::Color => {
                    let color = |i| DVec4::from_array(vectors.get(i, [1.0; 4]));
                    columns.colors.resize(before, DVec4::ONE);
                    columns.colors.extend(index.map(color));
                }
                Kind::Uv(set) => {
                    if !columns.uvs.contains_key(&set) && columns.uvs.len() == MAX_UV_SETS {
                        let message = format!(
                            "expected at most {MAX_UV_SETS} sets of texture coordinates, found more"
                        );
                        return Err(error_at(list, message));
                    }
                    let uv = |i| DVec2::from_array(vectors.get(i, [0.0; 2]));
                    let column = columns.uvs.entry(set).or_default();
                    column.resize(before, DVec2::ZERO);
                    column.extend(index.map(uv));
                }
            }
        }
        Ok(())
    }
}

impl Columns {
    /// Adds the attributes to `polygons`. If an attribute has no value for a corner, the corner gets zero or, for
    /// colors, white.
    fn finish(mut self, polygons: &mut Polygons) {
        let n = polygons.corners.len();
        if !self.normals.is_empty() {
            self.normals.resize(n, DVec3::ZERO);
            polygons.insert_known(CORNER_NORMAL, self.normals);
        }
        if !self.colors.is_empty() {
            self.colors.resize(n, DVec4::ONE);
            polygons.insert(Domain::Corner, COLOR.name, COLOR.rule, self.colors);
        }
        for (k, mut uvs) in self.uvs.into_values().enumerate() {
            uvs.resize(n, DVec2::ZERO);
            let name = match k {
                0 => UV.name.to_owned(),
                _ => format!("{}{k}", UV.name),
            };
            polygons.insert(Domain::Corner, name, UV.rule, uvs);
        }
    }
}
