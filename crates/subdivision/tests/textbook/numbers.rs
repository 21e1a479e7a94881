//! Tests the documentation: the ids of new elements, copied columns, and errors.

use mesh::{Attribute, DVec3, FaceId, MATERIAL, Mesh, Rule, VertexId};
use progress::NoProgress;
use subdivision::{LoopWeights, Rules, Scheme, Split, subdivide};

use crate::compare::{difference, mesh_of};
use crate::meshes::{self, Named};
use crate::polygons::Polygons;
use crate::textbook;

const LOOP: Scheme = Scheme::Loop(LoopWeights::Warren);
const MARK: Attribute<VertexId, f64> = Attribute::new("mark", Rule::Copy);

/// Returns a mesh and its next level. Before the subdivision, each vertex and each face is marked with its id plus 1.
fn marked(mesh: &Polygons, scheme: Scheme) -> (Mesh, Mesh) {
    let mut mesh = mesh_of(mesh);
    let marks = (0..mesh.n_vertices()).map(|i| i as f64 + 1.0).collect();
    mesh.set(MARK, marks);
    let materials = (1..).take(mesh.n_faces()).collect();
    mesh.set(MATERIAL, materials);
    let fine = subdivide(&mesh, Rules::of(scheme), 1, &NoProgress).unwrap();
    (mesh, fine)
}

/// Returns the schemes that split triangles and the schemes that split polygons, each with suitable meshes.
fn schemes_and_meshes() -> [(Vec<Scheme>, Vec<Named>); 2] {
    let four = vec![LOOP, Scheme::Midpoint(Split::Triangles), Scheme::Butterfly];
    let quads = vec![Scheme::CatmullClark, Scheme::Midpoint(Split::Quads)];
    [(four, meshes::triangles()), (quads, meshes::polygons())]
}

#[test]
fn old_vertices_keep_their_ids_and_new_ones_follow() {
    for (schemes, meshes) in schemes_and_meshes() {
        for scheme in schemes {
            for (name, mesh) in &meshes {
                let (mesh, fine) = marked(mesh, scheme);
                let marks = fine.get(MARK).unwrap();
                let n = mesh.n_vertices();
                assert_eq!(marks[..n], *mesh.get(MARK).unwrap(), "{name}, {scheme:?}");
                assert!(
                    marks[n..].iter().all(|&mark| mark == 0.0),
                    "{name}, {scheme:?}"
                );
                for e in mesh.edges() {
                    let on_edge = VertexId::new(n + e.index());
                    for end in mesh.edge_vertices(e) {
                        let edge = fine.find_half_edge(end, on_edge);
                        assert!(edge.is_some(), "{name}, {scheme:?}, {e:?}");
                    }
                }
            }
        }
    }
}

#[test]
fn parts_of_faces_are_in_order() {
    for (schemes, meshes) in schemes_and_meshes() {
        for scheme in schemes {
            for (name, mesh) in &meshes {
                let (mesh, fine) = marked(mesh, scheme);
                let into = |f: FaceId| {
                    if matches!(
                        scheme,
                        Scheme::CatmullClark | Scheme::Midpoint(Split::Quads)
                    ) {
                        mesh.degree(f)
                    } else {
                        4
                    }
                };
                let expected: Vec<i32> = (mesh.faces().zip(1..))
                    .flat_map(|(f, material)| vec![material; into(f)])
                    .collect();
                assert_eq!(fine.get(MATERIAL).unwrap(), expected, "{name}, {scheme:?}");
            }
        }
    }
}

#[test]
fn vertices_in_faces_follow_those_on_edges() {
    for (name, mesh) in meshes::polygons() {
        let (mesh, fine) = marked(&mesh, Scheme::CatmullClark);
        for f in mesh.faces() {
            let center = VertexId::new(mesh.n_vertices() + mesh.n_edges() + f.index());
            let away = (fine.position(center) - mesh.face_center(f)).length();
            assert!(away < 1e-12, "{name}");
        }
    }
    for (name, mesh) in meshes::triangles() {
        let (mesh, fine) = marked(&mesh, Scheme::Sqrt3);
        let marks = fine.get(MARK).unwrap();
        assert_eq!(
            marks[..mesh.n_vertices()],
            *mesh.get(MARK).unwrap(),
            "{name}"
        );
        for f in mesh.faces() {
            let center = VertexId::new(mesh.n_vertices() + f.index());
            let away = (fine.position(center) - mesh.face_center(f)).length();
            assert!(away < 1e-12, "{name}");
        }
    }
}

#[test]
fn dead_elements_are_ignored() {
    for (scheme, meshes) in [
        (LOOP, meshes::triangles()),
        (Scheme::CatmullClark, meshes::polygons()),
        (Scheme::Butterfly, meshes::triangles()),
        (Scheme::Sqrt3, meshes::triangles()),
        (Scheme::DooSabin, meshes::polygons()),
    ] {
        for (name, mesh) in meshes {
            let mut mesh = mesh_of(&mesh);
            // Deletes one face, with the edges and vertices that have no other face.
            if mesh.n_faces() < 6 || mesh.delete_faces(&[FaceId::new(2)]).is_err() {
                continue;
            }
            let living: Vec<VertexId> = mesh.vertices().collect();
            let place = |v: VertexId| living.iter().position(|&w| w == v).unwrap();
            let positions: Vec<DVec3> = living.iter().map(|&v| mesh.position(v)).collect();
            let faces = mesh
                .faces()
                .map(|f| mesh.face_vertices(f).map(place).collect());
            let rest = Polygons::new(positions, faces.collect());
            for levels in 1..=2 {
                let rules = Rules::of(scheme);
                let fine = subdivide(&mesh, rules, levels, &NoProgress).unwrap();
                let difference = difference(&fine, &textbook(&rest, rules, levels));
                assert_eq!(difference, None, "{name}, {scheme:?}, {levels} levels");
            }
        }
    }
}

#[test]
fn schemes_for_triangles_return_errors_for_polygons() {
    let (_, mesh) = &meshes::polygons()[0];
    for scheme in [
        LOOP,
        Scheme::Midpoint(Split::Triangles),
        Scheme::Butterfly,
        Scheme::Sqrt3,
    ] {
        let fine = subdivide(&mesh_of(mesh), Rules::of(scheme), 1, &NoProgress);
        assert!(fine.is_err(), "{scheme:?}");
    }
}
