//! Encodes edits of a mesh as numbers, for the random tests and the fuzzer. An edit is a local edit, or an algorithm
//! that changes the whole surface.

use geometry::surface_index::{SurfaceIndex, Winding};
use geometry::{deform, remesh, simplify, smooth, uv};
use op::{Context, Files, MeshOperation, NoProgress};
use ops_surface::Transfer;
use scene::{Object, Scene};

use mesh::{DVec3, Domain, EdgeId, EditError, FaceId, HalfEdgeId, Mesh, Seams, VertexId};

/// The number of kinds of edits.
const KINDS: u8 = 40;

/// An encoded edit: its kind, and numbers that determine its elements and parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct EditCode {
    /// The kind of edit.
    pub(crate) kind: u8,
    /// Determines the first element.
    pub(crate) a: u16,
    /// Determines the second element.
    pub(crate) b: u16,
    /// A small integer, from which positions and fractions are computed.
    pub(crate) place: i8,
}

impl EditCode {
    /// Decodes an edit from six bytes.
    pub(crate) const fn from_bytes([kind, a0, a1, b0, b1, place]: [u8; 6]) -> Self {
        Self {
            kind: kind % KINDS,
            a: u16::from_le_bytes([a0, a1]),
            b: u16::from_le_bytes([b0, b1]),
            place: place.cast_signed() % 4,
        }
    }

    /// Whether the edit, according to its documentation, can connect two vertices by a second edge.
    pub(crate) const fn can_duplicate_edges(self) -> bool {
        matches!(self.kind, SPLIT | SYMMETRIZE)
    }
}

/// The number of the last kind of edit that changes single elements. Kinds with higher numbers change or measure the
/// whole surface.
pub(crate) const LAST_LOCAL: u8 = 26;

const SPLIT: u8 = 1;
const SYMMETRIZE: u8 = 31;
const UNWRAP: u8 = 32;

/// Applies the edit. Ids can be beyond the last element, or belong to deleted elements.
///
/// # Errors
/// Returns the reason for which the edit was refused.
pub(crate) fn edit(mesh: &mut Mesh, code: EditCode) -> Result<(), EditError> {
    let EditCode { kind, a, b, place } = code;
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
        LAST_LOCAL => {
            mesh.compact();
            Ok(())
        }
        _ => {
            mesh.compact();
            change_surface(mesh, code);
            Ok(())
        }
    }
}

/// Applies an edit that changes or measures the whole surface of a mesh. The ids of the mesh must have no gaps.
/// Algorithms for triangles change nothing if a face is not a triangle.
fn change_surface(mesh: &mut Mesh, code: EditCode) {
    let EditCode { kind, a, b, place } = code;
    let vertices: Vec<VertexId> = mesh.vertices().collect();
    match kind {
        27 => {
            let options = simplify::Options {
                faces: mesh.n_faces() * usize::from(a % 4) / 4,
                error: (place > 0).then(|| f64::from(place)),
                refuse_intersections: place == 0,
                ..simplify::Options::default()
            };
            if let Ok(simplified) = simplify::simplify(mesh, &options, &NoProgress) {
                assert!(simplified.mesh.n_faces() <= mesh.n_faces());
                mesh.replace(simplified.mesh);
            }
        }
        28 => {
            let options = remesh::Options {
                length: remesh::Length::Uniform(0.5 + f64::from(b % 4)),
                passes: 1 + u32::from(a % 3),
                max_faces: 400,
                ..remesh::Options::default()
            };
            if let Ok(remeshed) = remesh::remesh(mesh, &options, &NoProgress) {
                mesh.replace(remeshed.mesh);
            }
        }
        29 => {
            let method = match place {
                0 => smooth::Method::Implicit { time: 0.1 },
                1 => smooth::Method::Denoise {
                    angle: 30.0,
                    vertex_passes: 2,
                },
                _ => smooth::Method::Laplacian {
                    weights: smooth::Weights::Cotangent,
                    factor: 0.5,
                },
            };
            let is_free = vec![true; vertices.len()];
            let smoothing = smooth::Smoothing {
                method,
                passes: 1 + u32::from(a % 3),
                is_free: &is_free,
                boundary: smooth::Boundary::Free,
                keep_volume: b % 2 == 1,
            };
            let mut smoothed = mesh.clone();
            if smooth::smooth(&mut smoothed, &smoothing, &NoProgress).is_ok() {
                mesh.replace(smoothed);
            }
        }
        30 => {
            let lattice = deform::Lattice {
                min: DVec3::splat(-2.0),
                max: DVec3::splat(2.0),
                size: [2, 2, 2],
                offsets: (0..8)
                    .map(|i| DVec3::splat(f64::from((a >> i) & 1)))
                    .collect(),
            };
            for v in vertices {
                let p = mesh.position(v);
                mesh.set_position(v, lattice.point(p));
            }
        }
        SYMMETRIZE => {
            let mut mirrored = mesh.clone();
            let normal = [DVec3::X, DVec3::Y, DVec3::Z, DVec3::ONE][usize::from(a % 4)];
            let point = DVec3::splat(f64::from(place) / 2.0);
            if geometry::symmetrize(&mut mirrored, point, normal.normalize()).is_ok() {
                mesh.replace(mirrored);
            }
        }
        UNWRAP => {
            let options = uv::UnwrapOptions {
                seams: &some(mesh, Domain::Edge, a, b, EdgeId::new)
                    .into_iter()
                    .filter(|&e| mesh.has_edge(e))
                    .collect::<Vec<_>>(),
                max_angle: 60.0,
                max_stretch: 4.0,
                page: uv::Page {
                    size: 256,
                    padding: 0,
                },
            };
            if let Ok(unwrapped) = uv::unwrap(mesh, &options, &NoProgress) {
                assert!(unwrapped.uvs.iter().all(|uv| uv.is_finite()));
                let mut with_uvs = mesh.clone();
                with_uvs.set(mesh::UV, unwrapped.uvs);
                mesh.replace(with_uvs);
            }
            // Measuring the mesh must not panic.
            let is_source: Vec<bool> = (0..vertices.len()).map(|v| v == usize::from(b)).collect();
            geometry::geodesic_distances(mesh, &is_source, &NoProgress).ok();
            geometry::thickness(mesh, &NoProgress).ok();
            geometry::principal_curvatures(mesh);
        }
        _ => change_surface_further(mesh, code),
    }
}

/// Applies an edit whose `kind` is 33 or more to a mesh without gaps in its ids. These edits change or measure the
/// whole surface.
fn change_surface_further(mesh: &mut Mesh, code: EditCode) {
    let EditCode { kind, a, b, place } = code;
    let t = f64::from(place) / 4.0;
    match kind {
        33 => {
            let frame = deform::Frame {
                origin: DVec3::ZERO,
                axes: [DVec3::X, DVec3::Y, DVec3::Z],
                from: -f64::from(a % 3),
                to: f64::from(b % 3),
            };
            for p in mesh.positions_mut() {
                let moved = match a % 4 {
                    0 => deform::Bend { frame, angle: t }.point(*p),
                    1 => deform::Twist { frame, angle: t }.point(*p),
                    _ => deform::Taper { frame, factor: t }.point(*p),
                };
                // Operations refuse to move a vertex to a position that is not finite. So this edit does not move
                // vertices to such positions.
                if moved.is_finite() {
                    *p = moved;
                }
            }
        }
        34 => {
            let normals = deform::vertex_directions(mesh);
            for (p, normal) in mesh.positions_mut().iter_mut().zip(normals) {
                *p += t * deform::noise::gradient(b.into(), *p) * normal;
            }
        }
        35 => {
            let selected: Vec<bool> = (0..mesh.n_vertices()).map(|v| v % 3 == 0).collect();
            let weights = deform::falloff(mesh.positions(), &selected, f64::from(a % 3));
            let index = SurfaceIndex::new(mesh);
            for (p, weight) in mesh.positions_mut().iter_mut().zip(weights) {
                *p += weight * t * DVec3::ONE;
                if let (Some(index), 0) = (&index, b % 2) {
                    *p = index.nearest(*p, 0).point;
                }
            }
        }
        36 => {
            let page = uv::Page {
                size: 256,
                padding: 2,
            };
            if let Some(uvs) = mesh.get(mesh::UV).map(<[_]>::to_vec)
                && let Ok(packed) = uv::pack(mesh, &uvs, page, &NoProgress)
            {
                assert!(packed.uvs.iter().all(|uv| uv.is_finite()));
                mesh.set(mesh::UV, packed.uvs);
            }
        }
        37 => {
            let features: Vec<EdgeId> = mesh.edges().step_by(1 + usize::from(b % 4)).collect();
            let options = remesh::Options {
                length: remesh::Length::Curvature {
                    error: 0.1,
                    min: 0.5,
                    max: 2.0,
                },
                error: (place != 0).then_some(t.abs()),
                features: &features,
                passes: 1 + u32::from(a % 3),
                max_faces: 400,
                ..remesh::Options::default()
            };
            if let Ok(remeshed) = remesh::remesh(mesh, &options, &NoProgress) {
                mesh.replace(remeshed.mesh);
            }
        }
        38 => transfer(mesh, a),
        _ => measure(mesh, a),
    }
}

/// Transfers all attributes from a slightly moved copy of the mesh to the mesh.
fn transfer(mesh: &mut Mesh, a: u16) {
    let mut from = mesh.clone();
    for p in from.positions_mut() {
        *p += DVec3::splat(f64::from(a % 4) / 8.0);
    }
    let names = |domain| from.attributes().of(domain).iter().map(|c| c.name.clone());
    let domains = [Domain::Vertex, Domain::Corner, Domain::Face];
    let attributes: Vec<String> = domains.into_iter().flat_map(names).collect();
    let mut scene = Scene::new();
    for (name, mesh) in [("mesh", mesh.clone()), ("from", from)] {
        scene
            .insert(Object::mesh(name, mesh))
            .expect("the name is free");
    }
    let files = Files::default();
    let mut cx = Context::new(&NoProgress, &files);
    cx.set_object(&scene, "mesh");
    let transfer = Transfer {
        from: "from".to_owned(),
        attributes,
        within: None,
    };
    let mut changed = mesh.clone();
    if transfer.apply(&mut changed, &mut cx).is_ok() {
        mesh.replace(changed);
    }
}

/// Measures the mesh and scatters points over it. Neither must panic.
fn measure(mesh: &Mesh, a: u16) {
    geometry::occlusion(mesh, 4, a.into(), &NoProgress).ok();
    let count = usize::from(a % 8);
    let points = geometry::samples(mesh, count, a.into(), &NoProgress).expect("never canceled");
    assert!(points.is_empty() || points.len() == count);
    if let Some(index) = SurfaceIndex::new(mesh) {
        let winding = Winding::new(&index, &NoProgress).expect("never canceled");
        let windings = winding.at_points(mesh.positions(), &NoProgress);
        assert!(windings.is_ok_and(|all| all.iter().all(|w| w.is_finite())));
    }
    geometry::distance::vertex_distances(mesh, mesh);
    geometry::gaussian_curvatures(mesh);
    geometry::mean_curvatures(mesh);
}

/// Returns the id of an element, or an id beyond the last element.
fn pick(mesh: &Mesh, domain: Domain, number: u16) -> usize {
    usize::from(number) % (mesh.domain_len(domain) + 1)
}

/// Returns one to four consecutive elements.
fn some<I>(mesh: &Mesh, domain: Domain, a: u16, b: u16, id: fn(usize) -> I) -> Vec<I> {
    let first = pick(mesh, domain, a);
    (first..=first + usize::from(b % 4)).map(id).collect()
}

fn exists(mesh: &Mesh, h: HalfEdgeId) -> bool {
    mesh.has_edge(h.edge())
}

/// Returns the half-edge k steps after `h` around the face or the hole, where k is `steps` modulo 6.
fn later(mesh: &Mesh, h: HalfEdgeId, steps: u16) -> HalfEdgeId {
    if exists(mesh, h) {
        (0..steps % 6).fold(h, |h, _| mesh.next(h))
    } else {
        h
    }
}

/// Returns the half-edge k steps after `h` around the vertex, where k is `steps` modulo 6.
fn around(mesh: &Mesh, h: HalfEdgeId, steps: u16) -> HalfEdgeId {
    if exists(mesh, h) {
        (0..steps % 6).fold(h, |h, _| mesh.next(h.twin()))
    } else {
        h
    }
}

/// Returns the first half-edge without a face. The search starts at `h` and follows the order of ids. After the highest
/// id, it continues with the lowest id. If the mesh has no hole, returns `h`.
fn hole(mesh: &Mesh, h: HalfEdgeId) -> HalfEdgeId {
    let n = mesh.domain_len(Domain::Corner);
    (0..n)
        .map(|i| HalfEdgeId::new((h.index() + i) % n))
        .find(|&h| exists(mesh, h) && mesh.face(h).is_none())
        .unwrap_or(h)
}

/// Applies the edit, and checks three guarantees. The mesh stays valid. If the mesh has no duplicate edges, the edit
/// creates no duplicate edges, unless its documentation allows this. If the edit is refused, nothing changes.
///
/// # Panics
///
/// Panics if a guarantee is broken.
pub(crate) fn edit_and_check(mesh: &mut Mesh, code: EditCode) {
    let before = mesh.clone();
    let result = edit(mesh, code);
    assert_eq!(mesh.defects(), [], "after {code:?}: {result:?}");
    match result {
        Err(refusal) => assert!(
            *mesh == before,
            "{code:?} was refused ({refusal}) but changed the mesh"
        ),
        Ok(()) if code.can_duplicate_edges() => {}
        Ok(()) => assert!(
            n_duplicate_edges(mesh) == 0 || n_duplicate_edges(&before) > 0,
            "{code:?} made a duplicate edge"
        ),
    }
}

fn n_duplicate_edges(mesh: &Mesh) -> usize {
    let mut ends: Vec<[VertexId; 2]> = mesh.edges().map(|e| mesh.edge_vertices(e)).collect();
    for pair in &mut ends {
        pair.sort_unstable();
    }
    ends.sort_unstable();
    ends.windows(2).filter(|pair| pair[0] == pair[1]).count()
}
