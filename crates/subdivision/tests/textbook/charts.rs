//! Corner values and their subdivision, like the face-varying data of OpenSubdiv.
//!
//! If several corners at a vertex have equal texture coordinates, they share one value. The rule for a value is decided
//! on each level, from the sharpness on that level. OpenSubdiv decides only once which of two values depends on the
//! other. The results differ only if, on one side of a vertex, the sharpness falls to 0 on an earlier level than on the
//! other side.

use std::collections::{BTreeMap, BTreeSet};

use mesh::DVec2;
use subdivision::{Boundary, FaceVarying, Rules, Scheme};

use crate::masks;
use crate::polygons::{Adjacency, Edge, Polygons, ahead, behind, edge};
use crate::sharpness::{Sharpness, is_semi_sharp};
use crate::split::{self, Place};

/// How a value changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    /// The value is smoothed with the same weights as the position of its vertex.
    Regular,
    /// The value does not change.
    Corner,
    /// The value is smoothed along the border of the faces that share it.
    Crease,
    /// The value stays unchanged while the vertex, or an edge between the faces that share the value, is semi-sharp. On
    /// later levels, it is smoothed along the border of these faces.
    Sharp,
    /// The vertex has two values, this one and another one. This value stays unchanged while an edge between two faces
    /// that share the other value is semi-sharp.
    Dependent,
}

/// Corner values.
#[derive(Clone, Debug)]
pub(crate) struct Charts {
    /// The values. Each value belongs to one vertex.
    values: Vec<DVec2>,
    /// For each corner of each face, the index of its value.
    corners: Vec<Vec<usize>>,
    /// Inner edges whose two sides have different values at one end or at both ends.
    seams: BTreeSet<Edge>,
}

impl Charts {
    /// Creates corner values from the texture coordinates of each corner of each face.
    pub(crate) fn new(faces: &[Vec<usize>], numbers: &[Vec<DVec2>]) -> Self {
        let mut index_of: BTreeMap<(usize, [u64; 2]), usize> = BTreeMap::new();
        let mut values = Vec::new();
        let mut corners = Vec::new();
        for (face, numbers) in faces.iter().zip(numbers) {
            let of_corner = |(&v, &number): (&usize, &DVec2)| {
                *index_of
                    .entry((v, number.to_array().map(f64::to_bits)))
                    .or_insert_with(|| {
                        values.push(number);
                        values.len() - 1
                    })
            };
            corners.push(face.iter().zip(numbers).map(of_corner).collect());
        }
        let mut charts = Self {
            values,
            corners,
            seams: BTreeSet::new(),
        };
        let n_vertices = faces.iter().flatten().max().map_or(0, |&v| v + 1);
        for (e, sides) in &Adjacency::new(n_vertices, faces).sides {
            if let &[a, b] = sides.as_slice()
                && (charts.at(a, 0) != charts.at(b, 1) || charts.at(a, 1) != charts.at(b, 0))
            {
                charts.seams.insert(*e);
            }
        }
        charts
    }

    /// Returns the texture coordinates of each corner of each face.
    pub(crate) fn numbers(&self) -> Vec<Vec<DVec2>> {
        let numbers = |face: &Vec<usize>| face.iter().map(|&x| self.values[x]).collect();
        self.corners.iter().map(numbers).collect()
    }

    /// Returns the index of the value at corner `i + by` of face `f`.
    fn at(&self, (f, i): (usize, usize), by: usize) -> usize {
        let face = &self.corners[f];
        face[(i + by) % face.len()]
    }

    /// Returns the index of the value at the corner before corner `i` of face `f`.
    fn before(&self, (f, i): (usize, usize)) -> usize {
        let face = &self.corners[f];
        face[behind(i, face.len())]
    }

    /// Returns the mean of the values at the corners of a face.
    fn center(&self, f: usize) -> DVec2 {
        let face = &self.corners[f];
        face.iter().map(|&x| self.values[x]).sum::<DVec2>() / face.len() as f64
    }

    /// Returns the faces around `v` whose corner at `v` has the value with the given index.
    fn span(&self, v: usize, value: usize, adjacency: &Adjacency) -> Span {
        let fan = adjacency.fan(v);
        let n = fan.len();
        let is_inner = !adjacency.is_boundary_vertex(v);
        let is_seam = |c: (usize, usize)| self.seams.contains(&edge(v, adjacency.at(c, 1)));
        let has_value = |i: usize| self.at(fan[i], 0) == value;
        if is_inner && (0..n).all(has_value) {
            let seams: Vec<usize> = (0..n).filter(|&i| is_seam(fan[i])).collect();
            return Span {
                size: n,
                is_torn: seams.len() != 1,
                ends: [fan[seams[0]], fan[behind(seams[0], n)]],
                inner: fan
                    .iter()
                    .filter(|&&c| !is_seam(c))
                    .map(|&c| adjacency.at(c, 1))
                    .collect(),
            };
        }
        let (mut inner, mut starts, mut size, mut is_torn) = (Vec::new(), Vec::new(), 0, false);
        for i in (0..n).filter(|&i| has_value(i)) {
            size += 1;
            if (is_inner || i > 0) && has_value(behind(i, n)) {
                inner.push(adjacency.at(fan[i], 1));
                is_torn |= is_seam(fan[i]);
            } else {
                starts.push(i);
            }
        }
        is_torn |= starts.len() != 1;
        let ends = [fan[starts[0]], fan[(starts[0] + size - 1) % n]];
        Span {
            size,
            is_torn,
            inner,
            ends,
        }
    }
}

/// The faces around a vertex that share one value.
#[derive(Debug)]
struct Span {
    /// The number of faces.
    size: usize,
    /// Whether the faces are not consecutive, or a seam runs between them.
    is_torn: bool,
    /// For each edge between two of the faces, the end that is not the common vertex of the faces.
    inner: Vec<usize>,
    /// The corners of the first and the last face, counter-clockwise.
    ends: [(usize, usize); 2],
}

impl Span {
    /// Whether an inner edge is infinitely sharp.
    fn is_hard(&self, v: usize, sharpness: &Sharpness) -> bool {
        let mut inside = self.inner.iter().map(|&w| sharpness.of_edge(v, w));
        inside.any(|s| s > 0.0 && !is_semi_sharp(s))
    }

    /// Whether an inner edge is semi-sharp.
    fn is_semi_sharp(&self, v: usize, sharpness: &Sharpness, when: When) -> bool {
        let mut inside = self.inner.iter().map(|&w| match when {
            When::Now => sharpness.of_edge(v, w),
            When::Next => sharpness.of_half(v, w),
        });
        inside.any(is_semi_sharp)
    }
}

/// The level whose sharpness is used.
#[derive(Clone, Copy, Debug)]
enum When {
    /// The level of the old mesh.
    Now,
    /// The next level.
    Next,
}

/// Returns the indices of the values at `v`, in ascending order.
fn values_at(charts: &Charts, v: usize, adjacency: &Adjacency) -> Vec<usize> {
    let values: BTreeSet<usize> = adjacency.corners[v]
        .iter()
        .map(|&c| charts.at(c, 0))
        .collect();
    values.into_iter().collect()
}

/// Decides how each of the values at `v` changes.
fn decide(
    charts: &Charts,
    v: usize,
    rules: Rules,
    adjacency: &Adjacency,
    sharpness: &Sharpness,
    when: When,
) -> Vec<State> {
    let choice = rules.face_varying;
    let values = values_at(charts, v, adjacency);
    let all = |state: State| vec![state; values.len()];
    let is_boundary = adjacency.is_boundary_vertex(v);
    let has_seam = adjacency.neighbors[v]
        .iter()
        .any(|&w| charts.seams.contains(&edge(v, w)));
    let is_single = adjacency.corners[v].len() == 1
        && choice != FaceVarying::None
        && rules.boundary != Boundary::EdgesAndCorners;
    let is_linear = choice == FaceVarying::Boundaries;
    if !(has_seam || is_single || is_linear && is_boundary) {
        return all(State::Regular);
    }

    let own = match when {
        When::Now => sharpness.of_vertex(v),
        When::Next => sharpness.of_child(v),
    };
    let plus_two = choice == FaceVarying::CornersPlus2;
    let depends = plus_two || choice == FaceVarying::CornersPlus1;
    let is_dart = values.len() == 1 && !is_boundary;
    let is_infinite = own > 0.0 && !is_semi_sharp(own);
    if is_linear || is_infinite || (depends && values.len() > 2) || (plus_two && is_dart) {
        return all(State::Corner);
    }
    let spans: Vec<Span> = values
        .iter()
        .map(|&value| charts.span(v, value, adjacency))
        .collect();
    if depends && values.len() == 2 {
        let sharpens = |s: &Span| s.is_torn || s.is_hard(v, sharpness) || (plus_two && s.size == 1);
        if spans.iter().any(sharpens) {
            return all(State::Corner);
        }
    }
    let semi = |span: &Span| span.is_semi_sharp(v, sharpness, when);
    let one_is_semi = depends && spans.len() == 2 && semi(&spans[0]) != semi(&spans[1]);
    let state = |span: &Span| {
        let is_point = span.size == 1 && choice != FaceVarying::None;
        if span.is_torn || span.is_hard(v, sharpness) || is_point {
            State::Corner
        } else if semi(span) || is_semi_sharp(own) {
            State::Sharp
        } else if one_is_semi {
            State::Dependent
        } else {
            State::Crease
        }
    };
    spans.iter().map(state).collect()
}

/// Computes the corner values of the next level. `numbers` has the index of the new vertex on each edge.
pub(crate) fn refine(
    charts: &Charts,
    mesh: &Polygons,
    rules: Rules,
    adjacency: &Adjacency,
    sharpness: &Sharpness,
    numbers: &BTreeMap<Edge, usize>,
) -> Charts {
    let mut values = vec![DVec2::ZERO; charts.values.len()];
    for v in (0..mesh.positions.len()).filter(|&v| !adjacency.corners[v].is_empty()) {
        let of_vertex = Vertex {
            charts,
            v,
            rules,
            adjacency,
            sharpness,
        };
        for (x, number) in of_vertex.refined() {
            values[x] = number;
        }
    }

    // Adds one value for each edge, or two if the edge is a seam: one for each side. Then adds a value for the center
    // of each face.
    let mut of_sides: BTreeMap<(usize, usize), usize> = BTreeMap::new();
    for (&e, sides) in &adjacency.sides {
        let is_seam = charts.seams.contains(&e);
        for (k, &side) in sides.iter().enumerate() {
            if k == 0 || is_seam {
                values.push(of_edge(charts, e, side, sides, rules, sharpness));
            }
            of_sides.insert(side, values.len() - 1);
        }
    }
    let mut corners = Vec::new();
    for (f, face) in mesh.faces.iter().enumerate() {
        let center = values.len();
        let value = |place: &Place| match *place {
            Place::Corner(i) => charts.at((f, i), 0),
            Place::Side(i) => of_sides[&(f, i)],
            Place::Center => center,
        };
        let pieces = split::pieces(rules.scheme, face.len());
        corners.extend(pieces.iter().map(|piece| piece.iter().map(value).collect()));
        values.push(charts.center(f));
    }
    let halves = |&(a, b): &Edge| {
        let middle = numbers[&(a, b)];
        [edge(a, middle), edge(b, middle)]
    };
    let seams = charts.seams.iter().flat_map(halves).collect();
    Charts {
        values,
        corners,
        seams,
    }
}

/// Whether values are interpolated linearly within each face.
fn is_linear(rules: Rules) -> bool {
    rules.face_varying == FaceVarying::All || matches!(rules.scheme, Scheme::Midpoint(_))
}

/// Returns the value of the new corners in the middle of an edge, in the face of `side`.
fn of_edge(
    charts: &Charts,
    e: Edge,
    side: (usize, usize),
    sides: &[(usize, usize)],
    rules: Rules,
    sharpness: &Sharpness,
) -> DVec2 {
    let ends = charts.values[charts.at(side, 0)] + charts.values[charts.at(side, 1)];
    if charts.seams.contains(&e) || is_linear(rules) {
        return 0.5 * ends;
    }
    let mask = masks::of_edge(e, rules, sharpness);
    let beside = |&side: &(usize, usize)| match rules.scheme {
        Scheme::CatmullClark => charts.center(side.0),
        _ => charts.values[charts.at(side, 2)],
    };
    mask.end * ends + mask.side * sides.iter().map(beside).sum::<DVec2>()
}

/// The data from which the new values at an old vertex are computed.
struct Vertex<'a> {
    charts: &'a Charts,
    v: usize,
    rules: Rules,
    adjacency: &'a Adjacency<'a>,
    sharpness: &'a Sharpness,
}

impl Vertex<'_> {
    /// For each value at the vertex, returns its index and its new value.
    fn refined(&self) -> Vec<(usize, DVec2)> {
        let Self {
            charts,
            v,
            rules,
            adjacency,
            sharpness,
        } = *self;
        let values = values_at(charts, v, adjacency);
        if is_linear(rules) {
            return values.iter().map(|&x| (x, charts.values[x])).collect();
        }
        let [states, next] = [When::Now, When::Next]
            .map(|when| decide(charts, v, rules, adjacency, sharpness, when));
        let number = |k: usize| match (states[k], next[k]) {
            (State::Regular, _) => self.regular(values[k]),
            (_, State::Crease) => {
                // If a value depends on the other value at the vertex, the other value determines the weight of the
                // blend.
                let source = if states[k] == State::Dependent {
                    1 - k
                } else {
                    k
                };
                let is_sharp = matches!(states[k], State::Sharp | State::Dependent);
                let w = if is_sharp {
                    self.fraction(values[source])
                } else {
                    0.0
                };
                w * charts.values[values[k]] + (1.0 - w) * self.crease(values[k])
            }
            _ => charts.values[values[k]],
        };
        (0..values.len()).map(|k| (values[k], number(k))).collect()
    }

    /// The old value is blended with the smoothed value. Returns the weight of the old value. It depends on the
    /// sharpness of the vertex and of the edges between the faces that share the value.
    fn fraction(&self, value: usize) -> f64 {
        let span = self.charts.span(self.v, value, self.adjacency);
        self.sharpness.fraction(self.v, &span.inner)
    }

    /// Smooths a value along the border of the faces that share it, and returns the result.
    fn crease(&self, value: usize) -> DVec2 {
        let charts = self.charts;
        let [first, last] = charts.span(self.v, value, self.adjacency).ends;
        let ends = charts.values[charts.at(first, 1)] + charts.values[charts.before(last)];
        0.75 * charts.values[value] + 0.125 * ends
    }

    /// Smooths a value with the same weights as the position of its vertex, and returns the result.
    fn regular(&self, value: usize) -> DVec2 {
        let Self {
            charts,
            v,
            rules,
            adjacency,
            sharpness,
        } = *self;
        let mask = masks::of_vertex(v, rules, adjacency, sharpness);
        let beyond = |w: usize| {
            let (f, i) = adjacency.sides[&edge(v, w)][0];
            let face = &charts.corners[f];
            let at_start = adjacency.at((f, i), 0) == w;
            charts.values[if at_start {
                face[i]
            } else {
                face[ahead(i, face.len())]
            }]
        };
        mask.own * charts.values[value]
            + mask
                .neighbors
                .iter()
                .map(|(&w, t)| *t * beyond(w))
                .sum::<DVec2>()
            + mask
                .centers
                .iter()
                .map(|(&f, t)| *t * charts.center(f))
                .sum::<DVec2>()
    }
}
