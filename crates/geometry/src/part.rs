//! Splits a mesh into parts.
//!
//! ```text
//!    +---+---+          +---+   +---+        +---+               +---+
//!    | p | q |          | p |   | q |        | p |               | p |
//!    +---+---+   -->    +---+   +---+        +---v---+    -->    +---v       v'--+
//!    | p | q |          | p |   | q |            | p |                       | p |
//!    +---+---+          +---+   +---+            +---+                       +---+
//! ```
//!
//! Faces that are adjacent in the mesh and belong to the same part stay connected. A fan is a set of faces around a
//! vertex that are connected by edges at this vertex. At a vertex of the new boundary, each fan has one boundary
//! half-edge that ends at the vertex and one that leaves the vertex. The half-edge that leaves the vertex becomes the
//! successor of the half-edge that ends there. If a vertex has several fans, the first fan keeps the vertex and each of
//! the other fans gets a copy.

use mesh::{Connectivity, Domain, EdgeId, FaceId, HalfEdgeId, Mesh, Sources, VertexId};

use crate::components;

/// Returns, for each face, the index of its connected component. Entry i belongs to the face with the index i.
/// Components are numbered from 0 in the order of the lowest face id of each component. The index of a dead (removed)
/// face is `usize::MAX`.
pub fn face_components(mesh: &Mesh) -> Vec<usize> {
    let of_vertex = components(mesh);
    let mut number = vec![usize::MAX; of_vertex.len()];
    let mut components = vec![usize::MAX; mesh.domain_len(Domain::Face)];
    let mut n = 0;
    for f in mesh.faces() {
        let component = of_vertex[mesh.origin(mesh.face_half_edge(f)).index()];
        if number[component] == usize::MAX {
            number[component] = n;
            n += 1;
        }
        components[f.index()] = number[component];
    }
    components
}

/// Returns each connected component as a separate mesh. The meshes are in the order of the lowest face id of each
/// component.
///
/// Elements keep their order and all their values. Isolated vertices are left out; [`Mesh::n_isolated_vertices`] counts
/// them. The returned meshes are dense: their ids have no gaps. The time is linear in the size of the mesh, for any
/// number of components.
///
/// # Examples
///
/// ```
/// use mesh::{DVec3, Mesh};
///
/// let points = (0..6).map(|i| DVec3::new(f64::from(i), f64::from(i * i), 0.0)).collect();
/// let (mesh, _) = Mesh::from_polygons(points, &[[0, 1, 2], [3, 4, 5]])?;
/// let parts = geometry::separated(&mesh);
/// assert_eq!(parts.len(), 2);
/// assert_eq!(parts[1].positions(), &mesh.positions()[3..]);
/// # Ok::<(), mesh::BuildError>(())
/// ```
pub fn separated(mesh: &Mesh) -> Vec<Mesh> {
    parts(mesh, &face_components(mesh))
}

/// Splits the mesh into separate meshes. `part_of_face` has one value for each face index; faces with the same value
/// form one part. Parts are in ascending order of these values. Faces with the value `usize::MAX` and isolated vertices
/// are left out.
///
/// Elements keep their order and their values. An edge between two parts is copied to both parts. A fan is a set of
/// faces around a vertex that are connected by edges at this vertex. If the faces of a part form several fans around a
/// vertex, the fan whose boundary half-edge has the lowest index keeps the vertex. Each of the other fans gets a copy
/// of the vertex. The copies are numbered after all other vertices. A part with a new boundary loses the attribute
/// columns whose rule is [`Rule::Drop`](mesh::Rule::Drop). The parts are dense: their ids have no gaps. Apart from
/// sorting the faces, the time is linear in the size of the mesh, for any number of parts.
///
/// # Panics
///
/// Panics if `part_of_face` does not have one value for each face, including dead faces.
pub fn parts(mesh: &Mesh, part_of_face: &[usize]) -> Vec<Mesh> {
    assert_eq!(
        part_of_face.len(),
        mesh.domain_len(Domain::Face),
        "one number for each face"
    );
    let number = |f: FaceId| part_of_face[f.index()];
    let mut faces: Vec<FaceId> = mesh.faces().filter(|&f| number(f) != usize::MAX).collect();
    // The sort is stable (it keeps the order of equal elements), so the faces of a part keep their order.
    faces.sort_by_key(|&f| number(f));
    let mut builder = PartBuilder {
        mesh,
        vertices: vec![VertexId::NONE; mesh.domain_len(Domain::Vertex)],
        edges: vec![EdgeId::NONE; mesh.domain_len(Domain::Edge)],
    };
    faces
        .chunk_by(|&f, &g| number(f) == number(g))
        .map(|faces| builder.part(faces))
        .collect()
}

/// Builds parts of a mesh, one after another. Holds the new ids of the elements of the part that is being built.
struct PartBuilder<'m> {
    mesh: &'m Mesh,
    vertices: Vec<VertexId>,
    edges: Vec<EdgeId>,
}

impl PartBuilder<'_> {
    /// Builds the mesh that consists of the given faces. `faces` is in ascending order.
    fn part(&mut self, faces: &[FaceId]) -> Mesh {
        let old = self.mesh;
        let sides = || faces.iter().flat_map(|&f| old.face_half_edges(f));
        let mut edges: Vec<EdgeId> = sides().map(HalfEdgeId::edge).collect();
        let mut vertices: Vec<VertexId> = sides().map(|h| old.origin(h)).collect();
        edges.sort_unstable();
        edges.dedup();
        vertices.sort_unstable();
        vertices.dedup();
        for (i, e) in edges.iter().enumerate() {
            self.edges[e.index()] = EdgeId::new(i);
        }
        for (i, v) in vertices.iter().enumerate() {
            self.vertices[v.index()] = VertexId::new(i);
        }

        let half_edge = |h: HalfEdgeId| self.edges[h.edge().index()].half_edges()[h.index() % 2];
        let n = 2 * edges.len();
        let mut c = Connectivity {
            next: vec![HalfEdgeId::NONE; n],
            face: vec![FaceId::NONE; n],
            origin: Vec::with_capacity(n),
            vertex_half_edge: vec![HalfEdgeId::NONE; vertices.len()],
            face_half_edge: Vec::with_capacity(faces.len()),
        };
        for e in &edges {
            let ends = old.edge_vertices(*e);
            c.origin.extend(ends.map(|v| self.vertices[v.index()]));
        }
        let mut prev = vec![HalfEdgeId::NONE; n];
        for (i, &f) in faces.iter().enumerate() {
            for h in old.face_half_edges(f) {
                let (this, next) = (half_edge(h), half_edge(old.next(h)));
                c.next[this.index()] = next;
                c.face[this.index()] = FaceId::new(i);
                prev[next.index()] = this;
            }
            c.face_half_edge.push(half_edge(old.face_half_edge(f)));
        }
        // Each vertex stores one of its half-edges. A vertex inside the part keeps the stored half-edge. A vertex on
        // the boundary of the part gets a half-edge later, in `link_boundary`.
        for (v, slot) in vertices.iter().zip(&mut c.vertex_half_edge) {
            let h = old
                .vertex_half_edge(*v)
                .expect("a vertex of a face has a half-edge");
            if self.edges[h.edge().index()] != EdgeId::NONE {
                *slot = half_edge(h);
            }
        }
        let mut corners: Vec<HalfEdgeId> = edges.iter().flat_map(|e| e.half_edges()).collect();
        let mut is_cut = false;
        for (h, source) in (0..n).map(HalfEdgeId::new).zip(&mut corners) {
            if c.face[h.index()] == FaceId::NONE && old.face(*source).is_some() {
                is_cut = true;
                *source = HalfEdgeId::NONE;
            }
        }
        link_boundary(&mut c, &prev, &mut vertices);

        for e in &edges {
            self.edges[e.index()] = EdgeId::NONE;
        }
        for v in &vertices {
            self.vertices[v.index()] = VertexId::NONE;
        }
        let mut attributes = old.attributes().gathered(Sources {
            vertices: &vertices,
            corners: &corners,
            edges: &edges,
            faces,
        });
        if is_cut {
            attributes.drop_by_rule();
        }
        let positions = vertices.iter().map(|&v| old.position(v)).collect();
        let mut part = Mesh::from_arrays(c, positions);
        part.set_attributes(attributes);
        part
    }
}

/// Links the half-edges without a face into boundary loops, and gives each additional fan at a vertex a copy of the
/// vertex. `vertices` lists, for each new vertex, the old vertex from which it comes. For each copy, this function
/// appends an entry to the list.
fn link_boundary(c: &mut Connectivity, prev: &[HalfEdgeId], vertices: &mut Vec<VertexId>) {
    let boundary: Vec<HalfEdgeId> = (0..c.next.len())
        .map(HalfEdgeId::new)
        .filter(|h| c.face[h.index()] == FaceId::NONE)
        .collect();
    for &h in &boundary {
        // Walks around the target of h, through the faces of the fan, to the boundary half-edge that leaves the
        // target.
        let mut leaving = h.twin();
        while c.face[leaving.index()] != FaceId::NONE {
            leaving = prev[leaving.index()].twin();
        }
        c.next[h.index()] = leaving;
    }
    let mut has_fan = vec![false; vertices.len()];
    for &h in &boundary {
        let v = c.origin[h.index()];
        if !std::mem::replace(&mut has_fan[v.index()], true) {
            c.vertex_half_edge[v.index()] = h;
            continue;
        }
        let copy = VertexId::new(vertices.len());
        vertices.push(vertices[v.index()]);
        c.vertex_half_edge.push(h);
        let mut leaving = h;
        loop {
            c.origin[leaving.index()] = copy;
            leaving = c.next[leaving.twin().index()];
            if leaving == h {
                break;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{area, n_components, shapes};
    use mesh::{CREASE, Column, DVec2, DVec3, MATERIAL, Rule, UV, Values};

    /// Returns a mesh that consists of several shapes, and the list of these shapes. The mesh has attributes, and the
    /// faces of the shapes are interleaved.
    fn mixed() -> (Mesh, Vec<Mesh>) {
        let shapes = vec![
            shapes::cube(),
            shapes::grid(3, 2),
            shapes::tetrahedron(),
            shapes::cylinder(5, false),
        ];
        let mut positions = Vec::new();
        let mut polygons = Vec::new();
        for (i, shape) in shapes.iter().enumerate() {
            let first = positions.len();
            positions.extend(shape.positions().iter().map(|&p| p + 9.0 * i as f64));
            for f in shape.faces() {
                let number = |v: VertexId| u32::try_from(first + v.index()).unwrap();
                let corners: Vec<u32> = shape.face_vertices(f).map(number).collect();
                polygons.push((f, i, corners));
            }
        }
        positions.push(DVec3::splat(-5.0));
        polygons.sort();
        let polygons: Vec<Vec<u32>> = polygons.into_iter().map(|(_, _, p)| p).collect();
        let (mut mesh, _) = Mesh::from_polygons(positions, &polygons).unwrap();
        let uv = |h: HalfEdgeId| DVec2::new(h.index() as f64, 0.0);
        mesh.set(UV, mesh.half_edges().map(uv).collect());
        mesh.set(MATERIAL, (0..).take(mesh.n_faces()).collect());
        mesh.set(CREASE, (0..mesh.n_edges()).map(|e| e as f64).collect());
        let column = Column {
            name: "passing".into(),
            rule: Rule::Drop,
            values: Values::Int(vec![1; mesh.n_faces()]),
        };
        mesh.insert_column(Domain::Face, column);
        (mesh, shapes)
    }

    #[test]
    fn components_become_meshes_in_order_of_their_faces() {
        let (mesh, shapes) = mixed();
        let parts = separated(&mesh);
        assert_eq!(parts.len(), shapes.len());
        let mut materials = Vec::new();
        for (part, shape) in parts.iter().zip(&shapes) {
            assert_eq!(part.defects(), []);
            assert_eq!(n_components(part), 1);
            assert_eq!(part.n_vertices(), shape.n_vertices());
            assert_eq!(part.n_edges(), shape.n_edges());
            assert_eq!(part.n_faces(), shape.n_faces());
            assert!((area(part) - area(shape)).abs() < 1e-9);
            assert_eq!(part.n_boundary_loops(), shape.n_boundary_loops());
            // No edge was cut, so the part has all attribute columns of the mesh.
            assert_eq!(part.attributes().iter().count(), 4);
            let part_materials = part.get(MATERIAL).unwrap();
            assert!(part_materials.is_sorted());
            materials.extend_from_slice(part_materials);
            for h in part.half_edges() {
                let source = part.get(UV).unwrap()[h.index()].x;
                let crease = part.get(CREASE).unwrap()[h.edge().index()];
                assert_eq!((source / 2.0).floor(), crease);
            }
        }
        materials.sort_unstable();
        assert!((0..).zip(&materials).all(|(i, &m): (i32, _)| i == m));
    }

    #[test]
    fn a_mesh_of_one_component_is_unchanged() {
        for shape in [
            shapes::grid(4, 3),
            shapes::torus(5, 4, 2.0, 0.5),
            shapes::cylinder(6, true),
            shapes::fans(&shapes::grid(2, 2)),
        ] {
            assert_eq!(separated(&shape), [shape]);
        }
        assert_eq!(separated(&Mesh::default()), []);
    }

    #[test]
    fn dead_elements_are_ignored() {
        let mut mesh = mixed().0;
        mesh.delete_face(FaceId::new(0)).unwrap();
        let mut dense = mesh.clone();
        dense.compact();
        assert_eq!(separated(&mesh), separated(&dense));
    }

    #[test]
    fn edges_between_parts_are_in_both_parts() {
        let mut mesh = shapes::grid(4, 1);
        mesh.set(UV, mesh.half_edges().map(|_| DVec2::ONE).collect());
        let parts = parts(&mesh, &[usize::MAX - 1, usize::MAX - 1, usize::MAX, 0]);
        let counts = |m: &Mesh| (m.n_vertices(), m.n_edges(), m.n_faces());
        assert_eq!(
            parts.iter().map(counts).collect::<Vec<_>>(),
            [(4, 4, 1), (6, 7, 2)]
        );
        for part in &parts {
            assert_eq!(part.defects(), []);
            let uv = part.get(UV).unwrap();
            let expected = |h| part.face(h).map_or(uv[h.index()], |_| DVec2::ONE);
            assert!(part.half_edges().all(|h| uv[h.index()] == expected(h)));
        }
    }

    #[test]
    fn parts_with_a_new_boundary_lose_columns_with_the_drop_rule() {
        let (mesh, _) = mixed();
        let part_of_face: Vec<usize> = (0..mesh.n_faces()).map(|f| f % 2).collect();
        for part in parts(&mesh, &part_of_face) {
            assert_eq!(part.defects(), []);
            assert!(part.attributes().column(Domain::Face, "passing").is_none());
        }
    }

    #[test]
    fn each_fan_at_a_shared_vertex_gets_a_separate_vertex() {
        // The two parts are the dark and the light squares of a checkerboard, so the faces of a part touch only at
        // vertices.
        let board = shapes::grid(5, 5);
        let color: Vec<usize> = (0..25).map(|f| f % 2).collect();
        for (part, n) in parts(&board, &color).iter().zip([13, 12]) {
            assert_eq!(part.defects(), []);
            assert_eq!((part.n_faces(), n_components(part)), (n, n));
            assert_eq!((part.n_vertices(), part.n_edges()), (4 * n, 4 * n));
        }
        let sphere = shapes::uv_sphere(8, 5);
        let all: Vec<usize> = (0..sphere.n_faces()).map(|f| f % 3).collect();
        let parts = parts(&sphere, &all);
        assert!(parts.iter().all(|part| part.defects().is_empty()));
        let sum: f64 = parts.iter().map(area).sum();
        assert!((sum - area(&sphere)).abs() < 1e-12);
    }

    #[test]
    fn many_components_take_linear_time() {
        let n = 100_000_u32;
        let points = (0..3 * n).map(|i| DVec3::new(f64::from(i), f64::from(i % 3), 0.0));
        let polygons: Vec<[u32; 3]> = (0..n).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        let (mesh, _) = Mesh::from_polygons(points.collect(), &polygons).unwrap();
        let parts = separated(&mesh);
        assert_eq!(parts.len(), n as usize);
        assert_eq!(
            parts[70_000].positions(),
            &mesh.positions()[210_000..210_003]
        );
    }
}
