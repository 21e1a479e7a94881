//! Compares the speed of local edits in Meshwright and in other half-edge libraries for Rust.
//!
//! Each library edits the same torus of a million triangles. Each library flips every edge whose flip is legal, and
//! splits every edge. Each library except tri-mesh also collapses every edge whose collapse is legal. The edges are in
//! the same random order for all libraries. The measured time of an edit includes the checks that the library makes
//! before the edit.
//!
//! The far corners of an edge are the corners opposite to the edge in the two triangles beside it. A flip is illegal if
//!
//! 1. the edge is on the boundary,
//! 2. one face is on both sides of the edge,
//! 3. an end of the edge has too few edges,
//! 4. an edge already connects the far corners, so that the flip would make a double edge,
//! 5. the far corners are the same vertex, or
//! 6. the edge is a seam: the values of corners, such as UVs, differ between its two sides.
//!
//! | | checks of a flip |
//! | --- | --- |
//! | this crate | 1 to 6 |
//! | alum | 1, 2 and 3 |
//! | alum, with double-edge check | 1, 2 and 3, and 4 by a separate search |
//! | tri-mesh | 1 and 4 |
//!
//! A split adds a vertex on the edge and connects the vertex to the far corners. alum does not have this edit. The
//! function `split_edge` of alum leaves two quadrilaterals, which the benchmark splits by two calls of `insert_edge`.
//! In alum, a collapse moves one end of the edge to the other end. In Meshwright, a collapse moves both ends of the
//! edge to its midpoint. A collapse is legal if the topology of the surface stays the same (the link condition).
//! tri-mesh makes no checks before a collapse, so the collapses of tri-mesh are not measured. All positions are `f64`.
//!
//! In this benchmark, Meshwright prefetches the memory of the next edits. Meshwright also checks in each edit whether
//! the mesh has an open journal (a record for undoing edits), attribute columns, or dead elements (deleted elements
//! that are still stored). The measured mesh has none of these. Like Meshwright, alum marks deleted elements as dead.
//! tri-mesh finds its elements through hash maps.
//!
//! At the end, the program compares the libraries that check for double edges: all of them must have flipped the same
//! number of edges.

mod common;

use std::time::Duration;

use alum::{EditableTopology, HasIterators};
use criterion::measurement::WallTime;
use criterion::{
    BatchSize, BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main,
};
use mesh::{EdgeId, Mesh, VertexId};

type Alum = alum::PolyMeshF64;
type Group<'a> = BenchmarkGroup<'a, WallTime>;

fn peers(c: &mut Criterion) {
    let mesh = common::torus();
    let edges = common::shuffled(mesh.edges().collect());
    let ends = |&e: &EdgeId| mesh.edge_vertices(e).map(number);
    let ends: Vec<[u32; 2]> = edges.iter().map(ends).collect();

    let mut group = c.benchmark_group("every edge of 1 M triangles once, random order");
    group.sample_size(10).warm_up_time(Duration::from_secs(1));
    group.throughput(Throughput::Elements(edges.len() as u64));
    let tri_mesh_flips = tri_mesh_edits(&mut group, &tri_mesh_of(&mesh, &ends));
    let alum_flips = alum_edits(&mut group, &alum_of(&mesh, &ends));
    let start = Start {
        mesh,
        edges,
        copy: Mesh::clone,
    };
    let flips = start.measure(&mut group, "flip, Meshwright", |mesh, edges, i| {
        mesh.fetch_ahead(edges, i);
        mesh.flip_edge(edges[i]).is_ok()
    });
    start.measure(&mut group, "split, Meshwright", |mesh, edges, i| {
        mesh.fetch_ahead(edges, i);
        mesh.split_edge(edges[i], 0.5).is_ok()
    });
    let n = start.measure(&mut group, "collapse, Meshwright", |mesh, edges, i| {
        mesh.fetch_ahead(edges, i);
        mesh.collapse_edge(edges[i]).is_ok()
    });
    assert!(n > 300_000, "{n} collapses");
    group.finish();
    assert_eq!([alum_flips, tri_mesh_flips], [flips; 2], "the same edges");
}

/// Measures the edits of alum. Returns the number of flips that alum accepts with the separate check for double edges.
fn alum_edits(group: &mut Group, start: &Start<Alum, alum::EH>) -> usize {
    start.measure(group, "flip, alum", |mesh, edges, i| {
        mesh.swap_edge_ccw(edges[i]).is_ok()
    });
    start.measure(group, "split, alum", |mesh, edges, i| {
        alum_split(mesh, edges[i]).is_ok()
    });
    let n = start.measure(group, "collapse, alum", |mesh, edges, i| {
        let (h, _) = edges[i].halfedges();
        matches!(mesh.try_check_edge_collapse(h), Ok(true))
            && mesh.try_collapse_edge(h, &mut Vec::new()).is_ok()
    });
    assert!(n > 300_000, "{n} collapses");
    start.measure(
        group,
        "flip, alum, with double-edge check",
        |mesh, edges, i| {
            let e = edges[i];
            let (h, twin) = e.halfedges();
            let [c, d] = [h, twin].map(|h| h.next(mesh).head(mesh));
            mesh.find_halfedge(c, d).is_none() && mesh.swap_edge_ccw(e).is_ok()
        },
    )
}

/// Measures the edits of tri-mesh. Returns the number of flips that tri-mesh accepts.
fn tri_mesh_edits(group: &mut Group, start: &Start<tri_mesh::Mesh, tri_mesh::HalfEdgeID>) -> usize {
    start.measure(group, "split, tri-mesh", |mesh, edges, i| {
        let h = edges[i];
        let (v, w) = mesh.edge_positions(h);
        mesh.split_edge(h, 0.5 * (v + w));
        true
    });
    start.measure(group, "flip, tri-mesh", |mesh, edges, i| {
        mesh.flip_edge(edges[i]).is_ok()
    })
}

/// A mesh to edit, and its edges in the order in which they are edited.
struct Start<M, E> {
    mesh: M,
    edges: Vec<E>,
    copy: fn(&M) -> M,
}

impl<M, E: Copy> Start<M, E> {
    /// Edits every edge of a copy of the mesh, in the order of the list. Returns the number of accepted edits.
    fn measure(
        &self,
        group: &mut Group,
        name: &str,
        edit: impl Fn(&mut M, &[E], usize) -> bool,
    ) -> usize {
        let copy = || (self.copy)(&self.mesh);
        let run = |mut mesh: M| {
            let n = (0..self.edges.len())
                .filter(|&i| edit(&mut mesh, &self.edges, i))
                .count();
            (mesh, n)
        };
        group.bench_function(name, |b| {
            b.iter_batched(copy, run, BatchSize::PerIteration);
        });
        run(copy()).1
    }
}

fn number(v: VertexId) -> u32 {
    u32::try_from(v.index()).expect("ids have 32 bits")
}

/// Converts the mesh to alum. Also returns the alum edges that join the given pairs of vertices.
fn alum_of(mesh: &Mesh, ends: &[[u32; 2]]) -> Start<Alum, alum::EH> {
    let mut copy = Alum::with_capacity(mesh.n_vertices(), mesh.n_edges(), mesh.n_faces());
    for p in mesh.positions() {
        copy.add_vertex(alum::DVec3(p.x, p.y, p.z)).expect("room");
    }
    for f in mesh.faces() {
        let corners: Vec<alum::VH> = mesh.face_vertices(f).map(|v| number(v).into()).collect();
        copy.add_face(&corners).expect("a manifold");
    }
    let edge = |&[v, w]: &[u32; 2]| copy.find_halfedge(v.into(), w.into()).expect("an edge");
    let edges = ends.iter().map(|ends| edge(ends).edge()).collect();
    Start {
        edges,
        mesh: copy,
        copy: |mesh| mesh.try_clone().expect("nothing is borrowed"),
    }
}

/// Splits an edge between two triangles at its midpoint, and joins the new vertex to the far corners of the
/// triangles.
fn alum_split(mesh: &mut Alum, e: alum::EH) -> Result<(), alum::Error> {
    let (h, twin) = e.halfedges();
    let middle = (mesh.point(h.tail(mesh))? + mesh.point(h.head(mesh))?) * 0.5;
    let m = mesh.add_vertex(middle)?;
    let to_middle = mesh.split_edge(h, m, false)?;
    for into in [to_middle, twin] {
        mesh.insert_edge(into, into.prev(mesh), None)?;
    }
    Ok(())
}

/// Converts the mesh to tri-mesh. Also returns the tri-mesh edges that join the given pairs of vertices.
fn tri_mesh_of(mesh: &Mesh, ends: &[[u32; 2]]) -> Start<tri_mesh::Mesh, tri_mesh::HalfEdgeID> {
    let corners = mesh.faces().flat_map(|f| mesh.face_vertices(f).map(number));
    let place = |p: &mesh::DVec3| tri_mesh::vec3(p.x, p.y, p.z);
    let copy = tri_mesh::Mesh::new(&three_d_asset::TriMesh {
        positions: three_d_asset::Positions::F64(mesh.positions().iter().map(place).collect()),
        indices: three_d_asset::Indices::U32(corners.collect()),
        ..three_d_asset::TriMesh::default()
    });
    let mut vertices: Vec<tri_mesh::VertexID> = copy.vertex_iter().collect();
    vertices.sort_unstable();
    let edge = |ends: &[u32; 2]| {
        let [v, w] = ends.map(|v| vertices[v as usize]);
        copy.connecting_edge(v, w).expect("an edge")
    };
    let edges = ends.iter().map(edge).collect();
    Start {
        edges,
        mesh: copy,
        copy: tri_mesh::Mesh::clone,
    }
}

criterion_group!(benches, peers);
criterion_main!(benches);
