//! Any local edit of a mesh, chosen by numbers: what random tests and the fuzzer share.

use mesh::{DVec3, Domain, EdgeId, EditError, FaceId, HalfEdgeId, Mesh, Seams, VertexId};

/// How many kinds of edits there are.
const KINDS: u8 = 27;

/// An edit: its kind, and numbers that choose its elements and places.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Code {
    /// Which edit.
    pub(crate) kind: u8,
    /// Chooses the first element.
    pub(crate) a: u16,
    /// Chooses a second one.
    pub(crate) b: u16,
    /// A small whole number, for a place.
    pub(crate) place: i8,
}

impl Code {
    /// The edit that six bytes stand for.
    pub(crate) const fn from_bytes([kind, a0, a1, b0, b1, place]: [u8; 6]) -> Self {
        Self {
            kind: kind % KINDS,
            a: u16::from_le_bytes([a0, a1]),
            b: u16::from_le_bytes([b0, b1]),
            place: place.cast_signed() % 4,
        }
    }

    /// Whether the edit may join two vertices by a second edge, as its documentation says.
    pub(crate) const fn may_join_twice(self) -> bool {
        self.kind == SPLIT
    }
}

const SPLIT: u8 = 1;

/// Does the edit. Numbers beyond the last element, and dead elements, are tried too.
///
/// # Errors
///
/// Why the edit was refused.
pub(crate) fn edit(mesh: &mut Mesh, code: Code) -> Result<(), EditError> {
    let Code { kind, a, b, place } = code;
    let e = EdgeId::new(pick(mesh, Domain::Edge, a));
    let f = FaceId::new(pick(mesh, Domain::Face, a));
    let v = VertexId::new(pick(mesh, Domain::Vertex, a));
    let h = HalfEdgeId::new(pick(mesh, Domain::Corner, a));
    let t = f64::from(place) / 4.0;
    let point = DVec3::new(f64::from(place), f64::from(b % 5), f64::from(a % 3));
    let seams = if place == 0 {
        Seams::Drop
    } else {
        Seams::Refuse
    };
    match kind {
        0 => mesh.flip_edge_with(e, seams),
        SPLIT => mesh.split_edge(e, t).map(drop),
        2 => mesh.collapse_edge(e).map(drop),
        3 => mesh.collapse_edge_to(e, point).map(drop),
        4 => mesh.split_face(h, later(mesh, h, b)).map(drop),
        5 => mesh.poke_face(f).map(drop),
        6 => mesh.split_vertex(h, around(mesh, h, b), point).map(drop),
        7 => mesh.dissolve_edge_with(e, seams).map(drop),
        8 => mesh.dissolve_vertex_with(v, seams).map(drop),
        9 => mesh.delete_face(f),
        10 => mesh.delete_faces(&some(mesh, Domain::Face, a, b, FaceId::new)),
        11 => mesh.delete_edge(e),
        12 => mesh.delete_vertex(v),
        13 => {
            let faces = some(mesh, Domain::Face, a, b, FaceId::new);
            mesh.extrude_faces(&faces, point).map(drop)
        }
        14 => mesh.fill_hole(hole(mesh, h)).map(drop),
        15 => geometry::fill_hole_triangles(mesh, hole(mesh, h)).map(drop),
        16 => {
            let other = HalfEdgeId::new(pick(mesh, Domain::Corner, b));
            mesh.bridge_loops(hole(mesh, h), hole(mesh, other))
                .map(drop)
        }
        17 => {
            let other = HalfEdgeId::new(pick(mesh, Domain::Corner, b));
            mesh.stitch_edges(hole(mesh, h), hole(mesh, other))
                .map(drop)
        }
        18 => {
            let h = hole(mesh, h);
            mesh.stitch_edges(h, later(mesh, h, 1)).map(drop)
        }
        19 => {
            let edges = some(mesh, Domain::Edge, a, b, EdgeId::new);
            mesh.cut_edges(&edges).map(drop)
        }
        20 => mesh.reverse_faces(&some(mesh, Domain::Face, a, b, FaceId::new)),
        21 => mesh.inset_face(f, t).map(drop),
        22 => mesh.bevel_face(f, 0.25, f64::from(place)).map(drop),
        23 => mesh.bevel_vertex(v, t).map(drop),
        24 => mesh.bevel_edge(e, t).map(drop),
        25 => {
            if mesh.has_vertex(v) {
                mesh.set_position(v, point);
            }
            mesh.delete_isolated_vertices();
            Ok(())
        }
        _ => {
            mesh.compact();
            Ok(())
        }
    }
}

/// The number of an element, or one that is not there.
fn pick(mesh: &Mesh, domain: Domain, number: u16) -> usize {
    usize::from(number) % (mesh.domain_len(domain) + 1)
}

/// One to four elements in a row.
fn some<I>(mesh: &Mesh, domain: Domain, a: u16, b: u16, id: fn(usize) -> I) -> Vec<I> {
    let first = pick(mesh, domain, a);
    (first..=first + usize::from(b % 4)).map(id).collect()
}

fn is_there(mesh: &Mesh, h: HalfEdgeId) -> bool {
    mesh.has_edge(h.edge())
}

/// The half-edge so many steps further around the face or the hole.
fn later(mesh: &Mesh, h: HalfEdgeId, steps: u16) -> HalfEdgeId {
    if is_there(mesh, h) {
        (0..steps % 6).fold(h, |h, _| mesh.next(h))
    } else {
        h
    }
}

/// The half-edge so many steps further around the vertex.
fn around(mesh: &Mesh, h: HalfEdgeId, steps: u16) -> HalfEdgeId {
    if is_there(mesh, h) {
        (0..steps % 6).fold(h, |h, _| mesh.next(h.twin()))
    } else {
        h
    }
}

/// A half-edge of a hole, the first from `h` on, or `h` itself if there is none.
fn hole(mesh: &Mesh, h: HalfEdgeId) -> HalfEdgeId {
    let n = mesh.domain_len(Domain::Corner);
    (0..n)
        .map(|i| HalfEdgeId::new((h.index() + i) % n))
        .find(|&h| is_there(mesh, h) && mesh.face(h).is_none())
        .unwrap_or(h)
}

/// Does the edit and holds it to what every edit promises: the mesh stays valid, no two vertices are joined
/// twice where none were, and a refused edit has changed nothing.
///
/// # Panics
///
/// If a promise is broken.
pub(crate) fn edit_and_check(mesh: &mut Mesh, code: Code) {
    let before = mesh.clone();
    let done = edit(mesh, code);
    assert_eq!(mesh.defects(), [], "after {code:?}: {done:?}");
    match done {
        Err(refusal) => assert!(
            *mesh == before,
            "{code:?} was refused ({refusal}) and changed the mesh"
        ),
        Ok(()) if code.may_join_twice() => {}
        Ok(()) => assert!(
            joined_twice(mesh) == 0 || joined_twice(&before) > 0,
            "{code:?} joined two vertices twice"
        ),
    }
}

/// How many edges join vertices that an earlier one joins.
fn joined_twice(mesh: &Mesh) -> usize {
    let mut ends: Vec<[VertexId; 2]> = mesh.edges().map(|e| mesh.edge_vertices(e)).collect();
    for pair in &mut ends {
        pair.sort_unstable();
    }
    ends.sort_unstable();
    ends.windows(2).filter(|pair| pair[0] == pair[1]).count()
}
