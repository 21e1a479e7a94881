//! Random sequences of local edits, held against lists of polygons that are edited the naive way.

use std::sync::LazyLock;

use glam::DVec3;
use mesh::{Domain, EdgeId, EditError, FaceId, Mesh, VertexId, shapes};
use proptest::prelude::*;

use crate::fixtures;

/// An edit with the number of its element; numbers beyond the last one are tried too.
#[derive(Clone, Copy, Debug)]
enum Edit {
    Flip(usize),
    /// At so many quarters of the edge; 0 and 4 are no places on it.
    Split(usize, u8),
    DeleteFace(usize),
    Compact,
}

fn edit() -> impl Strategy<Value = Edit> {
    prop_oneof![
        5 => any::<usize>().prop_map(Edit::Flip),
        4 => (any::<usize>(), 0..=4_u8).prop_map(|(e, quarters)| Edit::Split(e, quarters)),
        3 => any::<usize>().prop_map(Edit::DeleteFace),
        1 => Just(Edit::Compact),
    ]
}

/// The fixtures that are small enough to be copied at each edit, and two with attributes.
static MESHES: LazyLock<Vec<Mesh>> = LazyLock::new(|| {
    let mut meshes: Vec<Mesh> = fixtures::meshes()
        .into_iter()
        .map(|(_, mesh)| mesh)
        .filter(|mesh| mesh.n_faces() < 100)
        .collect();
    for mesh in [shapes::grid(3, 3), shapes::fans(&shapes::grid(3, 3))] {
        let object = fixtures::dressed(mesh);
        meshes.push(object.as_mesh().expect("a mesh").as_ref().clone());
    }
    meshes
});

proptest! {
    #![proptest_config(ProptestConfig::with_cases(600))]

    #[test]
    fn edits_keep_a_mesh_valid_and_do_what_they_say(
        which in 0..MESHES.len(),
        coordinates in proptest::collection::vec(-2..=2_i8, 64),
        edits in proptest::collection::vec(edit(), 1..24),
    ) {
        let mut mesh = MESHES[which].clone();
        // Small whole numbers: vertices coincide and triangles have no area at once.
        let mut numbers = coordinates.iter().cycle().map(|&x| f64::from(x));
        for p in mesh.positions_mut() {
            *p = DVec3::from_array([(); 3].map(|()| numbers.next().expect("they repeat")));
        }
        let mut oracle = Polygons::of(&mesh);
        for &edit in &edits {
            step(&mut mesh, &mut oracle, edit)?;
        }
    }
}

/// Does an edit on both and compares.
fn step(mesh: &mut Mesh, oracle: &mut Polygons, edit: Edit) -> Result<(), TestCaseError> {
    let before = mesh.clone();
    let (expected, euler) = expected(mesh, oracle, edit);
    let done = match edit {
        Edit::Flip(e) => mesh.flip_edge(edge(mesh, e)),
        Edit::Split(e, quarters) => {
            let made = mesh.split_edge(edge(mesh, e), f64::from(quarters) / 4.0);
            // The new vertex is the last one.
            made.map(|m| assert_eq!(m.index() + 1, mesh.positions().len()))
        }
        Edit::DeleteFace(f) => mesh.delete_face(face(mesh, f)),
        Edit::Compact => {
            mesh.compact();
            prop_assert!(mesh.is_dense());
            Ok(())
        }
    };
    prop_assert_eq!(mesh.defects(), vec![], "after {:?}", edit);
    if done.is_ok() {
        prop_assert_eq!(mesh.euler_characteristic(), euler, "after {:?}", edit);
    } else {
        prop_assert_eq!(
            &*mesh,
            &before,
            "{:?} was refused, but the mesh is another",
            edit
        );
    }
    let found = Polygons::of(mesh);
    // A list of polygons cannot tell two edges between the same vertices apart.
    if has_parallel_edges(&before) || has_parallel_edges(mesh) {
        *oracle = found;
        return Ok(());
    }
    agree(done, expected, oracle)?;
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

/// What an edit must give, and V - E + F after it.
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
            // Vertices stay; the face goes, and the edges that have no other.
            let sides = mesh.face_half_edges(f);
            let rims = sides.filter(|&h| mesh.face(h.twin()).is_none()).count();
            let rims = i64::try_from(rims).expect("a few");
            (oracle.delete(&corners(mesh, f)), euler - 1 + rims)
        }
        Edit::Compact => (Ok(oracle.clone()), euler),
    }
}

fn edge(mesh: &Mesh, number: usize) -> EdgeId {
    EdgeId::new(number % (mesh.domain_len(Domain::Edge) + 1))
}

fn face(mesh: &Mesh, number: usize) -> FaceId {
    FaceId::new(number % (mesh.domain_len(Domain::Face) + 1))
}

/// Both edited, or both refused for the same reason.
fn agree(
    done: Result<(), EditError>,
    expected: Result<Polygons, EditError>,
    oracle: &mut Polygons,
) -> Result<(), TestCaseError> {
    match (done, expected) {
        (Ok(()), Ok(edited)) => *oracle = edited,
        (done, expected) => {
            let kind = |error: EditError| std::mem::discriminant(&error);
            let (done, expected) = (done.map_err(kind), expected.map(|_| ()).map_err(kind));
            prop_assert_eq!(done, expected);
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

/// The same loop of vertices, beginning at the lowest number.
fn lowest_first(mut face: Vec<u32>) -> Vec<u32> {
    let low = (0..face.len()).min_by_key(|&i| face[i]).unwrap_or(0);
    face.rotate_left(low);
    face
}

/// A mesh as a list of faces in any order. Vertices are never taken away, so their numbers are those of
/// the mesh.
#[derive(Clone, Debug, PartialEq)]
struct Polygons {
    positions: Vec<DVec3>,
    /// Sorted, each beginning at its lowest vertex.
    faces: Vec<Vec<u32>>,
}

impl Polygons {
    fn of(mesh: &Mesh) -> Self {
        let faces = mesh.faces().map(|f| corners(mesh, f)).collect();
        Self::new(mesh.positions().to_vec(), faces)
    }

    fn new(positions: Vec<DVec3>, faces: Vec<Vec<u32>>) -> Self {
        let mut faces: Vec<_> = faces.into_iter().map(lowest_first).collect();
        faces.sort();
        Self { positions, faces }
    }

    /// The face with a side from a to b.
    fn with_side(&self, a: u32, b: u32) -> Option<usize> {
        let has_side = |face: &Vec<u32>| sides(face).any(|side| side == (a, b));
        self.faces.iter().position(has_side)
    }

    /// With the edge between two triangles turned. Reasons are given in the order of the checks.
    fn flip(&self, [a, b]: [u32; 2], e: EdgeId) -> Result<Self, EditError> {
        let (Some(f), Some(g)) = (self.with_side(a, b), self.with_side(b, a)) else {
            return Err(EditError::Boundary(e));
        };
        let opposite = |f: usize| match self.faces[f][..] {
            [x, y, z] => Ok(x + y + z - a - b),
            _ => Err(EditError::NotTriangle(FaceId::new(f))),
        };
        let (c, d) = (opposite(f)?, opposite(g)?);
        let v = |v: u32| VertexId::new(v as usize);
        if c == d {
            return Err(EditError::SameOpposite(e, v(c)));
        }
        if self.with_side(c, d).or(self.with_side(d, c)).is_some() {
            return Err(EditError::DuplicateEdge(v(c), v(d)));
        }
        let mut faces = self.faces.clone();
        faces[f] = vec![d, c, a];
        faces[g] = vec![c, d, b];
        Ok(Self::new(self.positions.clone(), faces))
    }

    /// With a vertex on the edge from a to b, joined to the far corners of triangles.
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
                (Some((x, _)), _) => {
                    let mut face = face.clone();
                    let place = face.iter().position(|&v| v == x).expect("a corner");
                    face.insert(place + 1, m);
                    faces.push(face);
                }
            }
        }
        Ok(Self::new(positions, faces))
    }

    /// Without a face, unless one of its vertices would then have two fans of faces.
    fn delete(&self, face: &[u32]) -> Result<Self, EditError> {
        let place = self.faces.iter().position(|f| f == face);
        let mut faces = self.faces.clone();
        faces.remove(place.expect("the mesh has the face, so the list has it"));
        let rest = Self::new(self.positions.clone(), faces);
        match face.iter().find(|&&v| rest.n_fans(v) > 1) {
            Some(&v) => Err(EditError::Pinch(VertexId::new(v as usize))),
            None => Ok(rest),
        }
    }

    /// How many groups the faces at a vertex form, where faces that share an edge at it are together.
    fn n_fans(&self, v: u32) -> usize {
        let mut fans: Vec<Vec<u32>> = Vec::new();
        for face in self.faces.iter().filter(|face| face.contains(&v)) {
            // The neighbors of v in this face name the two edges.
            let mut fan: Vec<u32> = sides(face)
                .filter_map(|(x, y)| match v {
                    _ if x == v => Some(y),
                    _ if y == v => Some(x),
                    _ => None,
                })
                .collect();
            fans.retain(|other| {
                let is_joined = other.iter().any(|w| fan.contains(w));
                if is_joined {
                    fan.extend(other);
                }
                !is_joined
            });
            fans.push(fan);
        }
        fans.len()
    }
}

/// The sides of a polygon: each corner with the next one.
fn sides(face: &[u32]) -> impl Iterator<Item = (u32, u32)> {
    let next = face.iter().cycle().skip(1);
    face.iter().copied().zip(next.copied())
}
