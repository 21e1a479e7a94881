use geometry::shapes;
use geometry::uv::{overlapping_faces, stretch};
use mesh::{DVec2, UV};
use op::NoProgress;
use op::test::{applied_as_planned, planned, try_applied};

use super::*;
use crate::Unwrap;

fn step(text: &str) -> PackUvs {
    op::test::read(text).unwrap()
}

/// Returns a cube whose charts overlap: face i covers the square from 0 to i + 1 in the texture.
fn stacked() -> Mesh {
    let mut mesh = shapes::cube();
    let square = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
    let mut uvs = vec![DVec2::ZERO; mesh.n_half_edges()];
    for (i, f) in mesh.faces().enumerate() {
        for (corner, h) in square.iter().zip(mesh.face_half_edges(f)) {
            uvs[h.index()] = *corner * (1.0 + i as f64);
        }
    }
    mesh.set(UV, uvs);
    mesh
}

#[test]
fn stacked_charts_are_separated_and_get_one_scale() {
    let mesh = applied_as_planned(&step("(page: 64, padding: 1)"), &stacked());
    let uvs = mesh.get(UV).unwrap();
    assert_eq!(overlapping_faces(&mesh, uvs, &NoProgress).unwrap(), []);
    let stretch = stretch(&mesh, uvs).unwrap();
    assert!((stretch.scales - 1.0).abs() < 1e-9 && (stretch.max_aspect - 1.0).abs() < 1e-9);
}

#[test]
fn unwrapped_charts_keep_their_shapes() {
    let unwrap: Unwrap = op::test::read("()").unwrap();
    let before = applied_as_planned(&unwrap, &shapes::torus(24, 12, 1.0, 0.4));
    let (after, report) = try_applied(&step("(page: 512)"), before.clone()).unwrap();
    let [old, new] = [&before, &after].map(|m| stretch(m, m.get(UV).unwrap()).unwrap());
    assert!((old.max_aspect - new.max_aspect).abs() < 1e-9);
    assert_eq!(new.n_mirrored, 0);
    assert!(report.changed > 1 && report.notes.len() == 1, "{report:?}");
}

#[test]
fn missing_texture_coordinates_are_refused_and_planned() {
    let (_, problems) = planned(&step("()"), &shapes::cube());
    assert_eq!(problems.len(), 1);
    let refused = try_applied(&step("()"), shapes::cube()).unwrap_err();
    assert!(refused.to_string().contains("no texture coordinates `uv`"));
}
