//! Compares random sequences of local edits with a naive implementation on polygon lists.

use std::sync::LazyLock;

use geometry::shapes;
use glam::DVec3;
use mesh::{Domain, EdgeId, EditError, FaceId, Mesh, VertexId};
use proptest::prelude::*;

use crate::fixtures;

/// A random edit. The first number of a variant determines the id of the element to edit. This id can be higher than
/// the ids of all elements.
#[derive(Clone, Copy, Debug)]
enum Edit {
    Flip(usize),
    /// Splits an edge. The second number is the position on the edge, in quarters of the length of the edge; 0 and 4
    /// are invalid.
    Split(usize, u8),
    DeleteFace(usize),
    /// Collapses an edge. The second number is the position on the edge, in quarters of the length of the edge; 5 is
    /// invalid.
    Collapse(usize, u8),
    Compact,
}

fn edit() -> impl Strategy<Value = Edit> {
    prop_oneof![
        5 => any::<usize>().prop_map(Edit::Flip),
        4 => (any::<usize>(), 0..=4_u8).prop_map(|(e, quarters)| Edit::Split(e, quarters)),
        3 => any::<usize>().prop_map(Edit::DeleteFace),
        4 => (any::<usize>(), 0..=5_u8).prop_map(|(e, quarters)| Edit::Collapse(e, quarters)),
        1 => Just(Edit::Compact),
    ]
}

/// Two meshes with attributes, and all test meshes that are small enough to be cloned for each edit.
static MESHES: LazyLock<Vec<Mesh>> = LazyLock::new(|| {
    let mut meshes: Vec<Mesh> = fixtures::meshes()
        .into_iter()
        .map(|(_, mesh)| mesh)
        .filter(|mesh| mesh.n_faces() < 100)
        .collect();
    for mesh in [shapes::grid(3, 3), shapes::fans(&shapes::grid(3, 3))] {
        let object = fixtures::with_attributes(mesh);
        meshes.push(object.as_mesh().expect("a mesh").as_ref().clone());
    }
    meshes
});

proptest! {
    #![proptest_config(ProptestConfig::with_cases(600))]

    #[test]
    fn edits_keep_a_mesh_valid_and_agree_with_the_oracle(
        which in 0..MESHES.len(),
        coordinates in proptest::collection::vec(-2..=2_i8, 64),
        edits in proptest::collection::vec(edit(), 1..24),
    ) {
        let mut mesh = MESHES[which].clone();
        // Coordinates are small integers, so that some vertices coincide and some triangles have zero area.
        let mut numbers = coordinates.iter().cycle().map(|&x| f64::from(x));
        for p in mesh.positions_mut() {
            *p = DVec3::from_array([(); 3].map(|()| numbers.next().expect("the numbers are cyclic")));
        }
        let mut oracle = Polygons::of(&mesh);
        for &edit in &edits {
            step(&mut mesh, &mut oracle, edit)?;
        }
    }
}

/// Applies an edit to the mesh and to the polygon list `oracle`, and compares the results.
fn step(mesh: &mut Mesh, oracle: &mut Polygons, edit: Edit) -> Result<(), TestCaseError> {
    let before = mesh.clone();
    let (expected, euler) = expected(mesh, oracle, edit);
    let result = match edit {
        Edit::Flip(e) => mesh.flip_edge(edge(mesh, e)),
        Edit::Split(e, quarters) => {
            let split = mesh.split_edge(edge(mesh, e), f64::from(quarters) / 4.0);
            // The new vertex has the last index.
            split.map(|m| assert_eq!(m.index() + 1, mesh.positions().len()))
        }
        Edit::DeleteFace(f) => mesh.delete_face(face(mesh, f)),
        Edit::Collapse(e, quarters) => {
            let t = f64::from(quarters) / 4.0;
            mesh.collapse_edge_at(edge(mesh, e), t).map(drop)
        }
        Edit::Compact => {
            mesh.compact();
            prop_assert!(mesh.is_dense());
            Ok(())
        }
    };
    prop_assert_eq!(mesh.defects(), vec![], "after {:?}", edit);
    if result.is_ok() {
        prop_assert_eq!(mesh.euler_characteristic(), euler, "after {:?}", edit);
    } else {
        prop_assert_eq!(
            &*mesh,
            &before,
            "{:?} was refused, but the mesh has changed",
            edit
        );
    }
    let found = Polygons::of(mesh);
    // A polygon list cannot distinguish two edges between the same vertices.
    if has_parallel_edges(&before) || has_parallel_edges(mesh) {
        *oracle = found;
        return Ok(());
    }
    check_agreement(result, expected, oracle)?;
    prop_assert_eq!(&found, oracle, "after {:?}", edit);
    Ok(())
}

fn has_parallel_edges(mesh: &Mesh) -> bool {
    let mut ends: Vec<[VertexId; 2]> = mesh.edges().map(|e| mesh.edge_vertices(e)).collect();
    for pair in &mut ends {
        pair.sort_unstable();
    }
    ends.sort_unstable();
    ends.windows(2).any(|pair| pair[0] == pair[1])
}

/// Returns the expected result of an edit, and the expected value of V - E + F, the Euler characteristic.
fn expected(mesh: &Mesh, oracle: &Polygons, edit: Edit) -> (Result<Polygons, EditError>, i64) {
    let euler = mesh.euler_characteristic();
    match edit {
        Edit::Flip(e) => {
            let e = edge(mesh, e);
            let flipped = ends(mesh, e).and_then(|ends| oracle.flip(ends, e));
            let is_seam = mesh.has_edge(e) && mesh.is_seam(e);
            let refused_at_seams = |flipped| {
                if is_seam {
                    Err(EditError::Seam(e))
                } else {
                    Ok(flipped)
                }
            };
            (flipped.and_then(refused_at_seams), euler)
        }
        Edit::Split(e, quarters) => {
            let t = f64::from(quarters) / 4.0;
            let split = ends(mesh, edge(mesh, e)).and_then(|ends| oracle.split(ends, t));
            (split, euler)
        }
        Edit::DeleteFace(f) => {
            let f = face(mesh, f);
            if !mesh.has_face(f) {
                return (Err(EditError::NoSuchFace(f)), euler);
            }
            // If a face is deleted, its edges that have no other face are also removed. All vertices are kept.
            let sides = mesh.face_half_edges(f);
            let n_removed = sides.filter(|&h| mesh.face(h.twin()).is_none()).count();
            let n_removed = i64::try_from(n_removed).expect("a small number");
            (oracle.delete(&corners(mesh, f)), euler - 1 + n_removed)
        }
        Edit::Collapse(e, quarters) => {
            let (e, t) = (edge(mesh, e), f64::from(quarters) / 4.0);
            let collapsed = ends(mesh, e).and_then(|ends| oracle.collapse(ends, t, e));
            (collapsed, euler)
        }
        Edit::Compact => (Ok(oracle.compact()), euler),
    }
}

fn edge(mesh: &Mesh, number: usize) -> EdgeId {
    EdgeId::new(number % (mesh.domain_len(Domain::Edge) + 1))
}

fn face(mesh: &Mesh, number: usize) -> FaceId {
    FaceId::new(number % (mesh.domain_len(Domain::Face) + 1))
}

/// Checks that the edits of the mesh and of the polygon list both succeeded, or that both were refused for the same
/// reason. If both edits succeeded, sets `oracle` to the edited list.
fn check_agreement(
    result: Result<(), EditError>,
    expected: Result<Polygons, EditError>,
    oracle: &mut Polygons,
) -> Result<(), TestCaseError> {
    match (result, expected) {
        (Ok(()), Ok(edited)) => *oracle = edited,
        (result, expected) => {
            let kind = |error: EditError| std::mem::discriminant(&error);
            let (result, expected) = (result.map_err(kind), expected.map(|_| ()).map_err(kind));
            prop_assert_eq!(result, expected);
        }
    }
    Ok(())
}

fn ends(mesh: &Mesh, e: EdgeId) -> Result<[u32; 2], EditError> {
    if !mesh.has_edge(e) {
        return Err(EditError::NoSuchEdge(e));
    }
    Ok(mesh.edge_vertices(e).map(number))
}

fn number(v: VertexId) -> u32 {
    u32::try_from(v.index()).expect("ids have 32 bits")
}

fn corners(mesh: &Mesh, f: FaceId) -> Vec<u32> {
    lowest_first(mesh.face_vertices(f).map(number).collect())
}

/// Returns the lexicographically smallest rotation of a face. A face can have its lowest vertex at two corners.
fn lowest_first(face: Vec<u32>) -> Vec<u32> {
    let turned = |i: usize| [&face[i..], &face[..i]].concat();
    (0..face.len()).map(turned).min().unwrap_or(face)
}

/// A mesh as a polygon list. Vertices have the same ids as in the mesh.
#[derive(Clone, Debug, PartialEq)]
struct Polygons {
    positions: Vec<DVec3>,
    /// The vertices removed by collapses.
    removed: Vec<u32>,
    /// The faces, sorted, each starting at its lowest vertex.
    faces: Vec<Vec<u32>>,
}

impl Polygons {
    fn of(mesh: &Mesh) -> Self {
        let faces = mesh.faces().map(|f| corners(mesh, f)).collect();
        let all = (0..mesh.positions().len()).map(VertexId::new);
        let removed = all.filter(|&v| !mesh.has_vertex(v)).map(number).collect();
        Self::new(mesh.positions().to_vec(), removed, faces)
    }

    fn new(positions: Vec<DVec3>, removed: Vec<u32>, faces: Vec<Vec<u32>>) -> Self {
        let mut faces: Vec<_> = faces.into_iter().map(lowest_first).collect();
        faces.sort();
        Self {
            positions,
            removed,
            faces,
        }
    }

    fn with_faces(&self, faces: Vec<Vec<u32>>) -> Self {
        Self::new(self.positions.clone(), self.removed.clone(), faces)
    }

    /// Returns the list without removed vertices. The remaining vertices are renumbered.
    fn compact(&self) -> Self {
        let lower = |v: u32| self.removed.iter().filter(|&&w| w < v).count();
        let renumbered = |&v: &u32| v - u32::try_from(lower(v)).expect("at most v");
        let is_left = |(v, _): &(u32, &DVec3)| !self.removed.contains(v);
        let left = (0..).zip(&self.positions).filter(is_left);
        let faces = self.faces.iter();
        Self::new(
            left.map(|(_, &p)| p).collect(),
            Vec::new(),
            faces.map(|f| f.iter().map(renumbered).collect()).collect(),
        )
    }

    /// Returns the face with a side from a to b.
    fn with_side(&self, a: u32, b: u32) -> Option<usize> {
        let has_side = |face: &Vec<u32>| sides(face).any(|side| side == (a, b));
        self.faces.iter().position(has_side)
    }

    /// Flips the edge between two faces, so that each end moves to the next corner. The checks are in the same order as
    /// in `Mesh::flip_edge`.
    fn flip(&self, [a, b]: [u32; 2], e: EdgeId) -> Result<Self, EditError> {
        let (Some(f), Some(g)) = (self.with_side(a, b), self.with_side(b, a)) else {
            return Err(EditError::Boundary(e));
        };
        if f == g {
            return Err(EditError::SameFace(e));
        }
        // The lists of corners are rotated: the first face then starts with the corners a, b, c, and the second face
        // with b, a, d.
        let from = |f: usize, start: (u32, u32)| {
            let mut face = self.faces[f].clone();
            let place = sides(&face).position(|side| side == start);
            face.rotate_left(place.expect("the face has this side"));
            face.split_off(2)
        };
        let (mut left, mut right) = (from(f, (a, b)), from(g, (b, a)));
        let (c, d) = (left[0], right[0]);
        let v = |v: u32| VertexId::new(v as usize);
        if c == d {
            return Err(EditError::SameOpposite(e, v(c)));
        }
        if left.last() == Some(&d) || right.last() == Some(&c) {
            return Err(EditError::FewEdges(v(a)));
        }
        if self.with_side(c, d).or(self.with_side(d, c)).is_some() {
            return Err(EditError::DuplicateEdge(v(c), v(d)));
        }
        left.extend([a, d]);
        right.extend([b, c]);
        let mut faces = self.faces.clone();
        (faces[f], faces[g]) = (left, right);
        Ok(self.with_faces(faces))
    }

    /// Splits the edge from a to b, and connects the new vertex to the opposite corners of triangles.
    fn split(&self, [a, b]: [u32; 2], t: f64) -> Result<Self, EditError> {
        if t <= 0.0 || t >= 1.0 {
            return Err(EditError::OutsideEdge(t));
        }
        let at = |v: u32| self.positions[v as usize];
        let mut positions = self.positions.clone();
        let m = u32::try_from(positions.len()).expect("a small mesh");
        positions.push((1.0 - t) * at(a) + t * at(b));
        let mut faces = Vec::new();
        for face in &self.faces {
            let side = sides(face).find(|&s| s == (a, b) || s == (b, a));
            match (side, &face[..]) {
                (None, _) => faces.push(face.clone()),
                (Some((x, y)), &[p, q, r]) => {
                    let far = p + q + r - x - y;
                    faces.extend([vec![x, m, far], vec![m, y, far]]);
                }
                (Some(side), _) => {
                    let place = sides(face).position(|s| s == side).expect("a side");
                    let mut face = face.clone();
                    face.insert(place + 1, m);
                    faces.push(face);
                }
            }
        }
        Ok(Self::new(positions, self.removed.clone(), faces))
    }

    /// Deletes a face, unless one of its vertices would then have two fans of faces, which touch only at this vertex.
    fn delete(&self, face: &[u32]) -> Result<Self, EditError> {
        let place = self.faces.iter().position(|f| f == face);
        let mut faces = self.faces.clone();
        faces.remove(place.expect("the mesh has the face, so the list has it"));
        let rest = self.with_faces(faces);
        match face.iter().find(|&&v| rest.n_fans(v) > 1) {
            Some(&v) => Err(EditError::Pinch(VertexId::new(v as usize))),
            None => Ok(rest),
        }
    }

    /// Collapses the edge from a to b, unless this would change the topology or make more elements coincide. The checks
    /// are in the same order as in `Mesh::collapse_edge`.
    fn collapse(&self, [a, b]: [u32; 2], t: f64, e: EdgeId) -> Result<Self, EditError> {
        if t > 1.0 {
            return Err(EditError::OutsideEdge(t));
        }
        let beside = [self.with_side(a, b), self.with_side(b, a)];
        if beside[0] == beside[1] {
            return Err(EditError::SameFace(e));
        }
        let (v, removed) = (a.min(b), a.max(b));
        let mut after = self.clone();
        after.positions[v as usize] =
            (1.0 - t) * self.positions[a as usize] + t * self.positions[b as usize];
        after.removed.push(removed);
        after.removed.sort_unstable();
        for corner in after.faces.iter_mut().flatten().filter(|v| **v == removed) {
            *corner = v;
        }
        for face in &mut after.faces {
            face.dedup();
            if face.last() == face.first() {
                face.pop();
            }
        }
        after.faces.retain(|face| face.len() > 2);
        let vanished = self.faces.len() - after.faces.len();
        let after = Self::new(after.positions, after.removed, after.faces);
        if after.has_topology_of(self, vanished) {
            return Ok(after);
        }

        let is_open = |v| {
            self.all_sides()
                .any(|(x, y)| x == v && self.with_side(y, x).is_none())
        };
        if !beside.contains(&None) && is_open(a) && is_open(b) {
            return Err(EditError::JoinsBoundaries(e));
        }
        // If a larger face is adjacent to all three sides of a triangle, the collapse would leave an edge with this
        // face on both sides.
        let around = |f: usize| sides(&self.faces[f]).map(|(x, y)| self.with_side(y, x));
        let is_within = |f: usize, g: usize| {
            let larger = self.faces[f].len() == 3 && self.faces[g].len() > 3;
            larger && around(f).all(|face| face == Some(g))
        };
        if let [Some(f), Some(g)] = beside
            && (is_within(f, g) || is_within(g, f))
        {
            return Err(EditError::SameFace(e));
        }
        let is_apex = |&v: &u32| {
            let mut triangles = beside.iter().flatten().map(|&f| &self.faces[f]);
            triangles.any(|face| face.len() == 3 && face.contains(&v))
        };
        let joined = |v, w| self.with_side(v, w).or(self.with_side(w, v)).is_some();
        let mut candidates = (0..v_count(&self.positions)).filter(|v| !is_apex(v));
        if let Some(x) = candidates.find(|&x| joined(a, x) && joined(b, x)) {
            return Err(EditError::Link(e, VertexId::new(x as usize)));
        }
        let has_both = |f: &usize| self.faces[*f].contains(&a) && self.faces[*f].contains(&b);
        let mut apart = (0..self.faces.len()).filter(|&f| !beside.contains(&Some(f)));
        if let Some(f) = apart.find(has_both) {
            return Err(EditError::VisitsTwice(
                FaceId::new(f),
                VertexId::new(v as usize),
            ));
        }
        Err(EditError::Vanishes(e))
    }

    /// Whether this polygon list is a manifold with the same topology as `before`, and does not have a larger number of
    /// coinciding elements. The list must have one vertex, `vanished` faces and `vanished` + 1 edges less than
    /// `before`.
    fn has_topology_of(&self, before: &Self, vanished: usize) -> bool {
        let [mine, other] = [self, before].map(|polygons| {
            // The numbers of three kinds of coinciding elements: corners of a face at the same vertex, edges with the
            // same face on both sides, and pairs of opposite faces.
            let mut coincident = [0; 3];
            for face in &polygons.faces {
                let mut once = face.clone();
                once.sort_unstable();
                once.dedup();
                coincident[0] += face.len() - once.len();
                let within = |&(x, y): &(u32, u32)| sides(face).any(|side| side == (y, x));
                coincident[1] += sides(face).filter(within).count();
                let back = lowest_first(face.iter().rev().copied().collect());
                coincident[2] += polygons.faces.iter().filter(|f| **f == back).count();
            }
            coincident
        });
        let (edges, edges_before) = (self.edges(), before.edges());
        let mut ways: Vec<_> = self.all_sides().collect();
        ways.sort_unstable();
        ways.windows(2).all(|pair| pair[0] != pair[1])
            && edges.len() + 1 + vanished == edges_before.len()
            && self.n_vertices() + 1 == before.n_vertices()
            && self.n_holes() == before.n_holes()
            && (0..v_count(&self.positions)).all(|v| self.n_fans(v) <= 1)
            && mine.iter().zip(other).all(|(&mine, other)| mine <= other)
    }

    fn all_sides(&self) -> impl Iterator<Item = (u32, u32)> + '_ {
        self.faces.iter().flat_map(|face| sides(face))
    }

    /// Returns the edges, each with its lower vertex first.
    fn edges(&self) -> Vec<(u32, u32)> {
        let mut edges: Vec<_> = self
            .all_sides()
            .map(|(x, y)| (x.min(y), x.max(y)))
            .collect();
        edges.sort_unstable();
        edges.dedup();
        edges
    }

    /// Returns the number of vertices with a face.
    fn n_vertices(&self) -> usize {
        let mut used = self.faces.concat();
        used.sort_unstable();
        used.dedup();
        used.len()
    }

    /// Returns the number of boundary loops.
    fn n_holes(&self) -> usize {
        let is_open = |&(x, y): &(u32, u32)| self.with_side(y, x).is_none();
        let mut open: Vec<_> = self.all_sides().filter(is_open).collect();
        let mut n = 0;
        while let Some((_, mut end)) = open.pop() {
            while let Some(i) = open.iter().position(|&(x, _)| x == end) {
                end = open.swap_remove(i).1;
            }
            n += 1;
        }
        n
    }

    /// Returns the number of fans at a vertex. A fan is a group of corners that share edges at the vertex.
    fn n_fans(&self, v: u32) -> usize {
        let mut fans: Vec<Vec<u32>> = Vec::new();
        for face in &self.faces {
            let after = sides(face).cycle().skip(1);
            let corners = sides(face).zip(after).filter(|&((_, at), _)| at == v);
            for ((before, _), (_, after)) in corners {
                // This corner has two edges at v. Each edge is identified by its other end.
                let mut fan = vec![before, after];
                fans.retain(|other| {
                    let is_joined = other.iter().any(|w| fan.contains(w));
                    if is_joined {
                        fan.extend(other);
                    }
                    !is_joined
                });
                fans.push(fan);
            }
        }
        fans.len()
    }
}

fn v_count(positions: &[DVec3]) -> u32 {
    u32::try_from(positions.len()).expect("a small mesh")
}

/// Returns the sides of a polygon: each corner, paired with the corner after it.
fn sides(face: &[u32]) -> impl Iterator<Item = (u32, u32)> + Clone {
    let next = face.iter().cycle().skip(1);
    face.iter().copied().zip(next.copied())
}
