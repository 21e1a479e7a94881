//! The same mesh with every face seen from the other side.
//!
//! ```text
//!       c                    c
//!     /   ^                ^   \         every half-edge keeps its id, its edge and its face,
//!   /   f   \     --->   /   f   \       and runs the other way:
//!  v         \          /         v        origin'(h) = target(h)
//!  a --- h -> b         a <- h --- b       next'(h)   = prev(h)
//! ```
//!
//! The half-edge that leaves a vertex v in a face becomes the one that arrives there, and the one
//! before it, which arrived, now leaves. So prev(h) stands where h stood for v (and if h was on the
//! boundary, so is prev(h)), for the first corner of a face, and for the values of a corner.
//! Reversed twice, every array is as it was.

use mesh::{Attributes, Column, Connectivity, Domain, HalfEdgeId, Mesh};

/// Turns every face of a dense mesh over. Vertices, edges and faces keep their ids, and the first corner
/// of a face stays the first; values of corners stay with their vertex and face.
pub(crate) fn reversed(mesh: &Mesh) -> Mesh {
    let old = mesh.connectivity();
    let mut prev = vec![HalfEdgeId::NONE; old.next.len()];
    for (h, next) in old.next.iter().enumerate() {
        prev[next.index()] = HalfEdgeId::new(h);
    }
    let before = |h: &HalfEdgeId| h.some().map_or(HalfEdgeId::NONE, |h| prev[h.index()]);
    let connectivity = Connectivity {
        origin: old
            .origin
            .chunks_exact(2)
            .flat_map(|ends| [ends[1], ends[0]])
            .collect(),
        face: old.face.clone(),
        vertex_half_edge: old.vertex_half_edge.iter().map(before).collect(),
        face_half_edge: old.face_half_edge.iter().map(before).collect(),
        next: prev,
    };
    let mut attributes = Attributes::default();
    for (domain, column) in mesh.attributes().iter() {
        let values = match domain {
            Domain::Corner => column
                .values
                .gather(old.next.len(), |h| Some(old.next[h].index())),
            _ => column.values.clone(),
        };
        let (name, rule) = (column.name.clone(), column.rule);
        attributes.insert(domain, Column { name, rule, values });
    }
    let mut reversed = Mesh::from_arrays(connectivity, mesh.positions().to_vec());
    reversed.set_attributes(attributes);
    reversed
}

#[cfg(test)]
mod tests {
    use super::*;
    use mesh::{DVec2, UV, shapes};

    fn meshes() -> Vec<Mesh> {
        let isolated = Mesh::from_polygons(vec![mesh::DVec3::ZERO], &[[0_u32; 3]; 0])
            .unwrap()
            .0;
        vec![
            Mesh::default(),
            isolated,
            shapes::square(),
            shapes::grid(3, 2),
            shapes::cube(),
            shapes::torus(4, 3, 2.0, 0.5),
            shapes::cylinder(5, false),
        ]
    }

    /// The mesh with the number of each half-edge as its corner value.
    fn numbered(mut mesh: Mesh) -> Mesh {
        let uv = (0..mesh.n_half_edges())
            .map(|h| DVec2::new(h as f64, 0.0))
            .collect();
        mesh.set(UV, uv);
        mesh
    }

    #[test]
    fn the_reversed_mesh_is_valid_and_inside_out() {
        for mesh in meshes() {
            let reversed = reversed(&mesh);
            assert_eq!(reversed.defects(), []);
            assert!((reversed.volume() + mesh.volume()).abs() < 1e-14);
            assert_eq!(reversed.positions(), mesh.positions());
        }
    }

    #[test]
    fn reversed_twice_is_the_same_mesh() {
        for mesh in meshes().into_iter().map(numbered) {
            assert_eq!(reversed(&reversed(&mesh)), mesh);
        }
    }

    #[test]
    fn corners_turn_around_their_first_and_keep_their_values() {
        for mesh in meshes().into_iter().map(numbered) {
            let reversed = reversed(&mesh);
            for f in mesh.faces() {
                let corners = |mesh: &Mesh| -> Vec<_> {
                    let uv = mesh.get(UV).unwrap();
                    mesh.face_half_edges(f)
                        .map(|h| (mesh.origin(h), uv[h.index()].x))
                        .collect()
                };
                let mut expected = corners(&mesh);
                expected[1..].reverse();
                assert_eq!(corners(&reversed), expected);
            }
        }
    }
}
