//! Converts scenes to lists of bits, and finds the differences between two scenes.

use std::collections::{BTreeMap, BTreeSet};

use geometry::triangulate::Cutter;
use glam::DVec3;
use mesh::{Column, Domain, HalfEdgeId, Mesh, Rule, Values, VertexId};
use scene::{Geometry, Image, Material, Object};

/// The part of an object that differs. A key with a domain stands for the positions or for an attribute: the name says
/// which of them. A key without a domain stands for another part of the object, such as its materials. The names are
/// the same as in reported losses.
pub(super) type Key = (Option<Domain>, String);

/// The kind of difference between two scenes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Difference {
    /// The numbers are equal after rounding to 32 bits.
    Rounded,
    /// Any other difference.
    Other,
}

pub(super) type Differences = BTreeMap<Key, Difference>;

pub(super) fn key(domain: impl Into<Option<Domain>>, name: &str) -> Key {
    (domain.into(), name.to_owned())
}

/// An attribute value or a position: the bits of each of its numbers.
type Row = Vec<u64>;

/// The type of attribute values, and the rule by which edits change them.
type Kind = (&'static str, Rule);

/// A mesh as plain lists. Corner values are in the order of the faces and their corners.
#[derive(Clone, Debug, PartialEq)]
struct Flat {
    positions: Vec<Row>,
    faces: Vec<Vec<usize>>,
    columns: BTreeMap<Key, (Kind, Vec<Row>)>,
    /// For each edge, its vertex with the lower id, its vertex with the higher id, and the index of its values.
    edges: Vec<([usize; 2], usize)>,
}

/// Returns the differences between a scene and the scene that was read back from a file. If `soup` is true, the format
/// stores separate triangles, and the order of vertices and faces can change.
pub(super) fn differences(before: &[Object], after: &[Object], soup: bool) -> Differences {
    let mut all = Differences::new();
    if before.len() != after.len() {
        all.insert(key(None, "name"), Difference::Other);
        return all;
    }
    for (a, b) in before.iter().zip(after) {
        if a.name != b.name {
            all.insert(key(None, "name"), Difference::Other);
        }
        materials(a, b, &mut all);
        match (&a.geometry, &b.geometry) {
            (Geometry::Mesh(a), Geometry::Mesh(b)) => meshes(a, b, soup, &mut all),
            (a, b) if a == b => {}
            _ => add(&mut all, key(None, "geometry"), Difference::Other),
        }
    }
    all
}

fn add(all: &mut Differences, key: Key, difference: Difference) {
    let known = all.entry(key).or_insert(difference);
    *known = difference.max(*known);
}

fn materials(a: &Object, b: &Object, all: &mut Differences) {
    // The format determines whether an image is a file or embedded, so this difference is ignored.
    let with_bytes = |object: &Object| {
        let mut materials = object.materials.clone();
        for texture in materials.iter_mut().flat_map(Material::textures_mut) {
            if let Image::Loaded { bytes, .. } | Image::Embedded { bytes, .. } = &texture.image {
                let (mime, bytes) = (String::new(), bytes.clone());
                texture.image = Image::Embedded { mime, bytes };
            }
        }
        materials
    };
    if with_bytes(a) != with_bytes(b) {
        add(all, key(None, "materials"), Difference::Other);
    }
}

fn meshes(a: &Mesh, b: &Mesh, soup: bool, all: &mut Differences) {
    let cuts = soup && a.faces().any(|f| !a.is_triangle(f));
    let mut before = Flat::of(a, cuts);
    let mut after = Flat::of(b, false);
    if cuts {
        add(all, key(Domain::Face, "polygon"), Difference::Other);
    }
    if soup {
        if before.drop_isolated() {
            add(all, key(Domain::Vertex, "position"), Difference::Other);
        }
        if before.has_equal_positions() {
            add(all, key(Domain::Vertex, "merged"), Difference::Other);
            return;
        }
        let places = |flat: &Flat| {
            (0..flat.positions.len())
                .map(|v| flat.place(v))
                .collect::<Vec<_>>()
        };
        if places(&before) != places(&after) {
            add(all, key(None, "order"), Difference::Other);
        } else if before.faces != after.faces {
            add(all, key(None, "order of faces"), Difference::Other);
        }
        before.sort();
        after.sort();
    }
    let of_corners = |(domain, name): &Key| {
        let is_there = |domain| after.columns.contains_key(&key(domain, name));
        let moved = *domain == Some(Domain::Corner);
        moved && is_there(Domain::Vertex) && !is_there(Domain::Corner)
    };
    let moved: Vec<Key> = before
        .columns
        .keys()
        .filter(|key| of_corners(key))
        .cloned()
        .collect();
    for (_, name) in moved {
        if before.agree(&name) {
            add(all, key(None, "domain"), Difference::Other);
        }
    }
    if let Some(difference) = rows_differ(&before.positions, &after.positions) {
        add(all, key(Domain::Vertex, "position"), difference);
    }
    if before.faces != after.faces {
        add(all, key(Domain::Face, "polygon"), Difference::Other);
    }
    let names: BTreeSet<&Key> = before.columns.keys().chain(after.columns.keys()).collect();
    for name in names {
        let difference = match (before.columns.get(name), after.columns.get(name)) {
            (Some((kind, a)), Some((other, b))) if kind.0 == other.0 => {
                if kind.1 != other.1 {
                    add(all, key(None, "rule"), Difference::Other);
                }
                if name.0 == Some(Domain::Edge) {
                    rows_differ(&before.of_edges(a), &after.of_edges(b))
                } else {
                    rows_differ(a, b)
                }
            }
            _ => Some(Difference::Other),
        };
        if let Some(difference) = difference {
            add(all, name.clone(), difference);
        }
    }
}

/// Returns the kind of difference between numbers. The check for equality after rounding to 32 bits is only
/// approximate, because glTF stores 1 - v instead of the texture coordinate v.
fn rows_differ(a: &[Row], b: &[Row]) -> Option<Difference> {
    if a == b {
        return None;
    }
    let is_near = |(a, b): (&u64, &u64)| {
        let [a, b] = [*a, *b].map(f64::from_bits);
        (a - b).abs() <= a.abs().clamp(1.0, 1e300) / f64::from(1 << 24)
    };
    let all_near = |(a, b): (&Row, &Row)| a.len() == b.len() && a.iter().zip(b).all(is_near);
    let same = a.len() == b.len() && a.iter().zip(b).all(all_near);
    Some(if same {
        Difference::Rounded
    } else {
        Difference::Other
    })
}

impl Flat {
    fn of(mesh: &Mesh, cuts: bool) -> Self {
        let mut cutter = Cutter::default();
        let mut corners: Vec<Vec<HalfEdgeId>> = Vec::new();
        let mut sources = Vec::new();
        for f in mesh.faces() {
            let around: Vec<HalfEdgeId> = mesh.face_half_edges(f).collect();
            if cuts && around.len() > 3 {
                for triangle in cutter.cut(mesh, f).triangles() {
                    corners.push(triangle.iter().map(|&k| around[k as usize]).collect());
                    sources.push(f.index());
                }
            } else {
                corners.push(around);
                sources.push(f.index());
            }
        }
        let column = |(domain, column): (Domain, &Column)| {
            let Column { name, rule, values } = column;
            let rows = match domain {
                Domain::Vertex | Domain::Edge => {
                    (0..values.len()).map(|i| row(values, i)).collect()
                }
                Domain::Corner => {
                    let all = corners.iter().flatten();
                    all.map(|h| row(values, h.index())).collect()
                }
                Domain::Face => sources.iter().map(|&f| row(values, f)).collect(),
            };
            let kind = (values.type_name(), *rule);
            (key(domain, name), (kind, rows))
        };
        let faces = corners.iter().map(|corners| {
            let vertices = corners.iter().map(|&h| mesh.origin(h).index());
            vertices.collect()
        });
        let edges = mesh.edges().map(|e| {
            let mut ends = mesh.edge_vertices(e).map(VertexId::index);
            ends.sort_unstable();
            (ends, e.index())
        });
        Self {
            positions: mesh
                .positions()
                .iter()
                .map(|p| bits(&p.to_array()))
                .collect(),
            faces: faces.collect(),
            edges: edges.collect(),
            columns: mesh
                .attributes()
                .iter()
                .filter(|(_, column)| !has_only_default_values(column))
                .map(column)
                .collect(),
        }
    }

    /// Returns the values of the edges, sorted by the vertices of the edges. Each row starts with these two vertices.
    fn of_edges(&self, rows: &[Row]) -> Vec<Row> {
        let with_ends = self.edges.iter().map(|([a, b], place)| {
            let ends = [*a, *b].map(|v| v as u64);
            [&ends, &rows[*place][..]].concat()
        });
        let mut all: Vec<Row> = with_ends.collect();
        all.sort_unstable();
        all
    }

    fn place(&self, v: usize) -> [u32; 3] {
        #[expect(
            clippy::cast_possible_truncation,
            reason = "positions are compared in 32 bits"
        )]
        let narrow = |k: usize| (f64::from_bits(self.positions[v][k]) as f32 + 0.0).to_bits();
        [narrow(0), narrow(1), narrow(2)]
    }

    fn has_equal_positions(&self) -> bool {
        let places: BTreeSet<_> = (0..self.positions.len()).map(|v| self.place(v)).collect();
        places.len() < self.positions.len()
    }

    /// Keeps only the vertices in `order`, in this order.
    fn renumber(&mut self, order: &[usize]) {
        let mut new = vec![usize::MAX; self.positions.len()];
        for (to, &from) in order.iter().enumerate() {
            new[from] = to;
        }
        let pick = |rows: &[Row]| order.iter().map(|&v| rows[v].clone()).collect();
        self.positions = pick(&self.positions);
        for ((domain, _), (_, rows)) in &mut self.columns {
            if *domain == Some(Domain::Vertex) {
                *rows = pick(rows);
            }
        }
        for v in self.faces.iter_mut().flatten() {
            *v = new[*v];
        }
        for (ends, _) in &mut self.edges {
            *ends = ends.map(|v| new[v]);
            ends.sort_unstable();
        }
    }

    fn drop_isolated(&mut self) -> bool {
        let used: BTreeSet<usize> = self.faces.iter().flatten().copied().collect();
        let dropped = used.len() < self.positions.len();
        if dropped {
            self.renumber(&used.into_iter().collect::<Vec<_>>());
        }
        dropped
    }

    /// Sorts vertices by position, and corners and faces by their vertices.
    fn sort(&mut self) {
        let mut order: Vec<usize> = (0..self.positions.len()).collect();
        order.sort_by_key(|&v| self.place(v));
        self.renumber(&order);
        let starts: Vec<usize> = self
            .faces
            .iter()
            .scan(0, |end, face| {
                *end += face.len();
                Some(*end - face.len())
            })
            .collect();
        // The corners of each face, in order, starting at the lowest vertex.
        let mut turned: Vec<(Vec<usize>, Vec<usize>, usize)> = Vec::new();
        for (f, face) in self.faces.iter().enumerate() {
            let n = face.len();
            let first = (0..n).min_by_key(|&i| face[i]).unwrap_or(0);
            let places: Vec<usize> = (0..n).map(|i| (first + i) % n).collect();
            turned.push((
                places.iter().map(|&i| face[i]).collect(),
                places.iter().map(|&i| starts[f] + i).collect(),
                f,
            ));
        }
        turned.sort();
        for ((domain, _), (_, rows)) in &mut self.columns {
            let sources: Vec<usize> = match domain {
                Some(Domain::Corner) => turned.iter().flat_map(|t| t.1.clone()).collect(),
                Some(Domain::Face) => turned.iter().map(|t| t.2).collect(),
                _ => continue,
            };
            *rows = sources.iter().map(|&i| rows[i].clone()).collect();
        }
        self.faces = turned.into_iter().map(|t| t.0).collect();
    }

    /// Moves the corner values with this name to the vertices if all corners of each vertex have the same value. Does
    /// nothing if the vertices already have values with this name.
    fn agree(&mut self, name: &str) -> bool {
        let (from, to) = (key(Domain::Corner, name), key(Domain::Vertex, name));
        let (kind, rows) = &self.columns[&from];
        let width = rows.first().map_or(0, Vec::len);
        let mut values: Vec<Option<&Row>> = vec![None; self.positions.len()];
        let mut corners = self.faces.iter().flatten().zip(rows);
        let agrees = corners.all(|(&v, row)| {
            let known = values[v].replace(row);
            known.is_none_or(|known| same_numbers(known, row))
        });
        if !agrees || self.columns.contains_key(&to) {
            return false;
        }
        let values = values.into_iter();
        let values = values.map(|value| value.cloned().unwrap_or_else(|| vec![0; width]));
        let column = (*kind, values.collect());
        self.columns.remove(&from);
        self.columns.insert(to, column);
        true
    }
}

/// Whether an attribute of materials or smoothing groups has only default values. For other attributes: whether the
/// attribute has no values.
pub(super) fn has_only_default_values(column: &Column) -> bool {
    match (&column.values, column.name.as_str()) {
        (Values::Int(values), "material") => values.iter().all(|&m| m == -1),
        (Values::Int(values), "smoothing") => values.iter().all(|&group| group == 0),
        (values, _) => values.is_empty(),
    }
}

fn same_numbers(a: &Row, b: &Row) -> bool {
    let equal = |(a, b): (&u64, &u64)| f64::from_bits(*a) == f64::from_bits(*b);
    a.iter().zip(b).all(equal)
}

fn bits(numbers: &[f64]) -> Row {
    numbers.iter().map(|x| x.to_bits()).collect()
}

fn row(values: &Values, i: usize) -> Row {
    match values {
        Values::Float(v) => bits(&[v[i]]),
        Values::Vec2(v) => bits(&v[i].to_array()),
        Values::Vec3(v) => bits(&DVec3::to_array(&v[i])),
        Values::Vec4(v) => bits(&v[i].to_array()),
        Values::Int(v) => bits(&[f64::from(v[i])]),
        Values::Tag(v) => bits(&[f64::from(u8::from(v[i]))]),
    }
}

/// Whether these values can have this edit rule. The rule for unit vectors requires vectors of three numbers.
pub(super) fn fits(rule: Rule, values: &Values) -> bool {
    rule != Rule::Normal || matches!(values, Values::Vec3(_))
}
