//! Attributes after subdivision.

use mesh::{
    COLOR, CREASE, Column, DVec2, DVec3, DVec4, Domain, FaceId, HalfEdgeId, MATERIAL, Mesh, Rule,
    UV, Values, VertexId,
};

use super::{is_corner, once};
use crate::fixtures::{self, sheet};

#[test]
fn vertex_values_have_the_masks_of_the_positions() {
    for (name, mut mesh) in fixtures::all() {
        let colors =
            |m: &Mesh| -> Vec<DVec4> { m.positions().iter().map(|p| p.extend(1.0)).collect() };
        mesh.set(COLOR, colors(&mesh));
        let new = once(&mesh);
        for (color, expected) in new.get(COLOR).unwrap().iter().zip(colors(&new)) {
            assert_eq!(color.truncate(), expected.truncate(), "{name}");
            assert!((color.w - 1.0).abs() < 1e-15, "{name}");
        }
    }
}

#[test]
fn affine_texture_coordinates_stay_affine_on_a_flat_sheet() {
    let mut mesh = sheet(4, 3);
    let affine = |p: DVec3| DVec2::new(0.5 * p.x + 1.0, p.y - 0.25 * p.x);
    let uvs = mesh
        .half_edges()
        .map(|h| affine(mesh.position(mesh.origin(h))));
    mesh.set(UV, uvs.collect());
    let new = once(&mesh);
    let uvs = new.get(UV).unwrap();
    let inside = |h: HalfEdgeId| new.face(h).is_some();
    // Subdivision moves the four corner vertices of the sheet, so their texture coordinates no longer match their
    // positions.
    let rounded = |v: VertexId| mesh.has_vertex(v) && is_corner(&mesh, v);
    let mut n = 0;
    for h in new
        .half_edges()
        .filter(|&h| inside(h) && !rounded(new.origin(h)))
    {
        assert_eq!(uvs[h.index()], affine(new.position(new.origin(h))), "{h}");
        n += 1;
    }
    assert!(n > 200);
}

#[test]
fn corner_values_stay_within_their_own_triangle() {
    for (name, mut mesh) in fixtures::all() {
        // Every triangle has different values, so every edge is a seam.
        let value = |h: HalfEdgeId| {
            mesh.face(h).map_or(DVec2::ZERO, |f| {
                DVec2::new(f.index() as f64, (7 * h.index() % 16) as f64)
            })
        };
        let uvs: Vec<DVec2> = mesh.half_edges().map(value).collect();
        mesh.set(UV, uvs.clone());
        let new = once(&mesh);
        let new_uvs = new.get(UV).unwrap();
        let around = |m: &Mesh, f: FaceId, uvs: &[DVec2]| {
            let mut h = m.face_half_edges(f).map(|h| uvs[h.index()]);
            [(); 3].map(|()| h.next().unwrap())
        };
        for f in mesh.faces() {
            let [a, b, c] = around(&mesh, f, &uvs);
            let [x, y, z] = [(a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0];
            let parts = [0, 1, 2, 3].map(|k| around(&new, FaceId::new(4 * f.index() + k), new_uvs));
            assert_eq!(parts[..3], [[a, x, z], [b, y, x], [c, z, y]], "{name} {f}");
            // The corners of the middle triangle are the three edge midpoints. Its first corner is z.
            assert_eq!(parts[3], [z, x, y], "{name} {f}");
        }
        for h in new.half_edges().filter(|&h| new.face(h).is_none()) {
            assert_eq!(new_uvs[h.index()], DVec2::ZERO, "{name} {h}");
        }
    }
}

#[test]
fn copied_values_are_inherited_by_the_parts_only() {
    let mut mesh = sheet(2, 2);
    let n = |domain| mesh.domain_len(domain);
    let tags = |n: usize| Values::Tag((0..n).map(|i| i % 3 == 0).collect());
    let columns = Domain::ALL.map(|d| (d, tags(n(d))));
    for (domain, values) in columns {
        let name = "chosen".to_owned();
        mesh.insert_column(
            domain,
            Column {
                name,
                rule: Rule::Copy,
                values,
            },
        );
    }
    mesh.set(MATERIAL, (0..).take(mesh.n_faces()).collect());
    mesh.set(CREASE, (0..mesh.n_edges()).map(|e| e as f64).collect());
    let new = once(&mesh);

    let tag = |d| new.tag(d, "chosen").unwrap();
    for (v, &chosen) in tag(Domain::Vertex).iter().enumerate() {
        assert_eq!(chosen, v < mesh.n_vertices() && v % 3 == 0, "v{v}");
    }
    for (e, &chosen) in tag(Domain::Edge).iter().enumerate() {
        assert_eq!(chosen, e < 2 * mesh.n_edges() && (e / 2) % 3 == 0, "e{e}");
        // A sharpness of 10 or more is infinite and becomes 10. A sharpness below 10 decreases by 1.
        let crease = match (e / 2) as f64 {
            _ if e >= 2 * mesh.n_edges() => 0.0,
            s if s >= 10.0 => 10.0,
            s => (s - 1.0).max(0.0),
        };
        assert_eq!(new.get(CREASE).unwrap()[e], crease);
    }
    for (f, &chosen) in tag(Domain::Face).iter().enumerate() {
        assert_eq!(chosen, (f / 4) % 3 == 0, "f{f}");
        assert_eq!(new.get(MATERIAL).unwrap()[f], i32::try_from(f / 4).unwrap());
    }
    let old_corners = mesh.tag(Domain::Corner, "chosen").unwrap();
    for h in new.half_edges().filter(|&h| new.face(h).is_some()) {
        let parent = FaceId::new(new.face(h).unwrap().index() / 4);
        let at = mesh
            .face_half_edges(parent)
            .find(|&old| mesh.origin(old) == new.origin(h));
        let expected = at.is_some_and(|old| old_corners[old.index()]);
        assert_eq!(tag(Domain::Corner)[h.index()], expected, "{h}");
    }
}
