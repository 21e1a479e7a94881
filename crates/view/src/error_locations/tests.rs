//! Tests of pictures of error locations.

use geometry::shapes;
use mesh::Element;
use progress::NoProgress;
use scene::Object;

use super::*;

fn draw(scene: &Scene, locations: &[ErrorLocation], caption: &str) -> Option<Image> {
    draw_error_locations(scene, locations, caption, 1 << 30, &NoProgress).unwrap()
}

fn scene(mesh: Mesh) -> Scene {
    let mut scene = Scene::new();
    scene.insert(Object::mesh("mesh", mesh)).unwrap();
    scene
}

/// Returns the number of pixels with this color in these columns.
fn count(image: &Image, color: Color, columns: std::ops::Range<u32>) -> usize {
    let width = image.width;
    let pixels = (0..).zip(&image.pixels);
    pixels
        .filter(|(i, pixel)| columns.contains(&(i % width)) && **pixel == color.0)
        .count()
}

/// Returns a face, a half-edge, an edge and a vertex.
fn elements(mesh: &Mesh) -> [Element; 4] {
    let f = mesh.faces().next().unwrap();
    let h = mesh.face_half_edges(f).next().unwrap();
    [f.into(), h.into(), h.edge().into(), mesh.origin(h).into()]
}

#[test]
fn a_location_is_marked_in_the_overview_and_larger_in_the_close_up() {
    for mesh in [shapes::torus(40, 20, 2.0, 0.5), shapes::square()] {
        let scene = scene(mesh);
        let mesh = scene.objects()[0].as_mesh().unwrap();
        for element in elements(mesh) {
            let location = ErrorLocation::of("mesh", mesh, element).unwrap();

            let image = draw(&scene, &[location], "an error").unwrap();

            let middle = image.width / 2;
            let [left, right] =
                [0..middle, middle..image.width].map(|side| count(&image, ERROR, side));
            assert!(left >= 30, "{element}: {left}");
            assert!(right >= 120, "{element}: {right}");
        }
    }
}

#[test]
fn other_objects_do_not_hide_a_location() {
    let mut scene = scene(shapes::icosahedron());
    let mesh = scene.objects()[0].as_mesh().unwrap().clone();
    let location = ErrorLocation::of("mesh", &mesh, mesh.faces().next().unwrap()).unwrap();
    let alone = draw(&scene, std::slice::from_ref(&location), "");
    scene
        .insert(Object::mesh("around", shapes::uv_sphere(24, 12)))
        .unwrap();

    assert_eq!(draw(&scene, &[location], ""), alone);
}

#[test]
fn a_location_is_visible_on_every_side_of_a_sphere() {
    let scene = scene(shapes::uv_sphere(24, 12));
    let mesh = scene.objects()[0].as_mesh().unwrap();
    for v in mesh.vertices().step_by(37) {
        let location = ErrorLocation::of("mesh", mesh, v).unwrap();
        let image = draw(&scene, &[location], "").unwrap();
        assert!(count(&image, ERROR, 0..image.width / 2) >= 30, "{v}");
    }
}

#[test]
fn the_expected_position_of_a_missing_element_has_a_different_color() {
    let scene = scene(shapes::cube());
    let expected = ErrorLocation {
        object: String::new(),
        name: ErrorLocation::EXPECTED.to_owned(),
        points: vec![DVec3::splat(1.2)],
    };

    let image = draw(&scene, &[expected], "").unwrap();

    assert!(count(&image, EXPECTED, 0..image.width) > 100);
    assert_eq!(count(&image, ERROR, 0..image.width), 0);
}

#[test]
fn without_locations_there_is_only_the_overview_and_no_image_of_an_empty_scene() {
    let scene = scene(shapes::cube());
    let one_view = draw(&scene, &[], "a caption").unwrap();
    let mesh = scene.objects()[0].as_mesh().unwrap();
    let location = ErrorLocation::of("mesh", mesh, mesh.vertices().next().unwrap()).unwrap();
    let two_views = draw(&scene, &[location], "a caption").unwrap();

    assert!(two_views.width > 2 * SIZE[0] && one_view.width < 2 * SIZE[0]);
    assert!(draw(&Scene::new(), &[], "a caption").is_none());
}

#[test]
fn a_scene_of_one_point_with_very_distant_locations_is_drawn() {
    let point = vec![vec![DVec3::new(1.0, 2.0, 3.0)]];
    let mut scene = Scene::new();
    let lines = scene::Geometry::Polylines(point);
    scene.insert(Object::new("point", lines)).unwrap();
    for at in [DVec3::ZERO, DVec3::splat(1e300), DVec3::splat(-1e-300)] {
        let location = ErrorLocation {
            object: "point".to_owned(),
            name: "p".to_owned(),
            points: vec![at],
        };
        assert!(draw(&scene, &[location], "far").is_some(), "{at}");
    }
}

#[test]
fn many_locations_give_the_same_bytes_for_any_number_of_threads() {
    let scene = scene(shapes::torus(40, 20, 2.0, 0.5));
    let mesh = scene.objects()[0].as_mesh().unwrap();
    let locations: Vec<ErrorLocation> = (mesh.faces())
        .filter_map(|f| ErrorLocation::of("mesh", mesh, f))
        .collect();
    let with_threads = |n| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n).build();
        pool.unwrap()
            .install(|| draw(&scene, &locations, "all faces"))
    };

    assert_eq!(with_threads(1), with_threads(3));
}
