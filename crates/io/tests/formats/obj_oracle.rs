//! Tests that compare the result of reading OBJ files with the result of the crate `tobj`.

use std::sync::Arc;

use glam::DVec2;
use mesh::UV;
use proptest::prelude::*;
use scene::{Geometry, Object};

use crate::{Folder, assert_same, only, polygons, read, write};

/// Returns the text of an OBJ file with a bumpy grid. If `cut` is true, the grid consists of triangles instead of
/// quads.
fn grid_text(columns: usize, rows: usize, cut: bool, uvs: bool, normals: bool) -> String {
    use std::fmt::Write;
    let mut text = String::new();
    for j in 0..=rows {
        for i in 0..=columns {
            let height = (i * 7 + j * 3) % 5;
            writeln!(text, "v {i} {j} 0.{height}\nvt 0.{i} 0.{j}\nvn 0 0 1").unwrap();
        }
    }
    let corner = |v: usize| match (uvs, normals) {
        (true, true) => format!("{v}/{v}/{v}"),
        (true, false) => format!("{v}/{v}"),
        (false, true) => format!("{v}//{v}"),
        (false, false) => v.to_string(),
    };
    for j in 0..rows {
        if j == rows / 2 {
            text.push_str("g upper\nusemtl other\n");
        }
        for i in 0..columns {
            let a = j * (columns + 1) + i + 1;
            let [a, b, c, d] = [a, a + 1, a + columns + 2, a + columns + 1].map(corner);
            if cut {
                writeln!(text, "f {a} {b} {c}\nf {a} {c} {d}").unwrap();
            } else {
                writeln!(text, "f {a} {b} {c} {d}").unwrap();
            }
        }
    }
    text
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    /// The crate `tobj` splits and renumbers vertices, so corners are compared by value.
    #[test]
    fn tobj_reads_the_same_triangles(
        columns in 1..6_usize, rows in 1..6_usize, cut: bool, uvs: bool, normals: bool,
    ) {
        type Corner = ([u64; 3], [u64; 2]);
        let text = grid_text(columns, rows, cut, uvs, normals);
        let options = tobj::LoadOptions { triangulate: false, ..tobj::LoadOptions::default() };
        let (models, _) = tobj::load_obj_buf(&mut text.as_bytes(), &options, |_| {
            Ok(Default::default())
        }).unwrap();
        let mut theirs: Vec<Vec<Corner>> = Vec::new();
        for tobj::Model { mesh, .. } in &models {
            let mut at = 0;
            let degrees: Vec<u32> = if mesh.face_arities.is_empty() {
                vec![3; mesh.indices.len() / 3]
            } else {
                mesh.face_arities.clone()
            };
            for degree in degrees {
                let corners = at..at + degree as usize;
                at = corners.end;
                theirs.push(corners.map(|c| {
                    let p = mesh.indices[c] as usize;
                    let uv = if mesh.texcoord_indices.is_empty() { [0.0; 2] } else {
                        let t = mesh.texcoord_indices[c] as usize;
                        [mesh.texcoords[2 * t], mesh.texcoords[2 * t + 1]]
                    };
                    let position = [0, 1, 2].map(|k| mesh.positions[3 * p + k].to_bits());
                    (position, uv.map(f64::to_bits))
                }).collect());
            }
        }
        let folder = Folder::new();
        let loaded = read(&folder.with("a.obj", &text)).unwrap();
        let mesh = loaded.objects[0].as_mesh().unwrap();
        prop_assert_eq!(mesh.get(UV).is_some(), uvs);
        let ours: Vec<Vec<Corner>> = mesh.faces().map(|f| mesh.face_half_edges(f).map(|h| {
            let uv = mesh.get(UV).map_or(DVec2::ZERO, |uvs| uvs[h.index()]);
            let position = mesh.position(mesh.origin(h)).to_array();
            (position.map(f64::to_bits), uv.to_array().map(f64::to_bits))
        }).collect()).collect();
        prop_assert_eq!(ours, theirs);
    }

    #[test]
    fn polygons_of_grids_survive_a_round_trip(
        columns in 1..6_usize, rows in 1..6_usize, cut: bool, uvs: bool, normals: bool,
    ) {
        let folder = Folder::new();
        let text = grid_text(columns, rows, cut, uvs, normals);
        let first = read(&folder.with("a.obj", text)).unwrap().objects.remove(0);
        let path = folder.path("b.obj");
        write(&path, [Object { name: "b".into(), ..first.clone() }]);
        let second = only(&path);
        let (Geometry::Mesh(a), Geometry::Mesh(b)) = (&first.geometry, &second.geometry) else {
            panic!("{second:?}")
        };
        prop_assert_eq!(polygons(a), polygons(b));
        assert_same(a, b);
        prop_assert_eq!(Arc::strong_count(a), 1);
    }
}
