//! Lines: chains of edges that simplification and remeshing preserve, for example boundaries and seams. This module
//! finds the edges of these lines, and determines how vertices on lines are allowed to move.

use mesh::{CREASE, Column, Domain, EdgeId, FaceId, Mesh, Values, VertexId, parallel};

/// How a vertex is allowed to move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// The vertex is on no line, and is allowed to move anywhere.
    Inside,
    /// The vertex is on one line. In simplification, a vertex on a line moves only when it merges with a neighbor on
    /// the line. In remeshing, a vertex on a line moves along the line.
    Line,
    /// The vertex does not move. The vertex is pinned, is the end of a line or a meeting point of lines, or joins two
    /// edges of a line that have different attributes.
    Fixed,
}

/// Returns, for each edge, whether it is a part of a line. These edges are parts of lines: boundary edges, seams, edges
/// with a tag or a crease, and the `features`. An edge is also a part of a line if a tag, the material or another
/// whole-number attribute differs between its two faces. The mesh must be [dense](mesh::Mesh::is_dense).
pub(crate) fn lines(mesh: &Mesh, features: &[EdgeId]) -> Vec<bool> {
    let faces: Vec<&Column> = labels(mesh, Domain::Face).collect();
    let tags: Vec<&[bool]> = labels(mesh, Domain::Edge)
        .filter_map(|column| match &column.values {
            Values::Tag(tag) => Some(tag.as_slice()),
            _ => None,
        })
        .collect();
    let creases = mesh.get(CREASE);
    let differ = |f: FaceId, g: FaceId| {
        let mut columns = faces.iter();
        columns.any(|column| !column.values.are_equal(f.index(), g.index()))
    };
    let mut lines: Vec<bool> = parallel::collect(mesh.n_edges(), |e| {
        let e = EdgeId::new(e);
        match mesh.edge_faces(e) {
            [Some(f), Some(g)] => {
                mesh.is_seam(e)
                    || differ(f, g)
                    || tags.iter().any(|tag| tag[e.index()])
                    || creases.is_some_and(|creases| creases[e.index()] > 0.0)
            }
            _ => true,
        }
    });
    for e in features {
        lines[e.index()] = true;
    }
    lines
}

/// Returns how each vertex is allowed to move. `lines` tells which edges are parts of lines. The mesh must be
/// [dense](mesh::Mesh::is_dense).
pub(crate) fn kinds(mesh: &Mesh, lines: &[bool], pinned: &[VertexId]) -> Vec<Kind> {
    let columns = mesh.attributes().of(Domain::Edge);
    let mut kinds: Vec<Kind> = parallel::collect(mesh.n_vertices(), |v| {
        let mut around = mesh
            .vertex_half_edges(VertexId::new(v))
            .map(|h| h.edge().index())
            .filter(|&e| lines[e]);
        match (around.next(), around.next(), around.next()) {
            (None, ..) => Kind::Inside,
            (Some(e), Some(f), None) if columns.iter().all(|c| c.values.are_equal(e, f)) => {
                Kind::Line
            }
            _ => Kind::Fixed,
        }
    });
    for v in pinned {
        kinds[v.index()] = Kind::Fixed;
    }
    kinds
}

/// Returns the attribute columns of a domain (vertices, edges, faces or corners) whose values are labels: tags or whole
/// numbers. Labels cannot be averaged.
pub(crate) fn labels(mesh: &Mesh, domain: Domain) -> impl Iterator<Item = &Column> {
    let is_label = |column: &&Column| matches!(column.values, Values::Tag(_) | Values::Int(_));
    mesh.attributes().of(domain).iter().filter(is_label)
}

/// Returns the power of two p for which `length` times p is at least 1 and less than 2. The result is limited to the
/// range from 2^-1000 to 2^1000. Returns 1 if `length` is 0 or not finite.
pub(crate) fn inverse_power_of_two(length: f64) -> f64 {
    if length > 0.0 && length.is_finite() {
        let (_, exponent) = libm::frexp(length);
        libm::ldexp(1.0, (1 - exponent).clamp(-1000, 1000))
    } else {
        1.0
    }
}
