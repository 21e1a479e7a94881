//! What is seen of a failure.

use geometry::shapes;
use mesh::Element;
use progress::NoProgress;
use scene::Object;

use super::*;

fn drawn(scene: &Scene, places: &[ErrorLocation], caption: &str) -> Option<Image> {
    draw_places(scene, places, caption, 1 << 30, &NoProgress).unwrap()
}

fn scene(mesh: Mesh) -> Scene {
    let mut scene = Scene::new();
    scene.insert(Object::mesh("mesh", mesh)).unwrap();
    scene
}

/// How many pixels of columns `from..to` have a color.
fn count(image: &Image, color: Color, columns: std::ops::Range<u32>) -> usize {
    let width = image.width;
    let pixels = (0..).zip(&image.pixels);
    pixels
        .filter(|(i, pixel)| columns.contains(&(i % width)) && **pixel == color.0)
        .count()
}

fn every_kind(mesh: &Mesh) -> [Element; 4] {
    let f = mesh.faces().next().unwrap();
    let h = mesh.face_half_edges(f).next().unwrap();
    [f.into(), h.into(), h.edge().into(), mesh.origin(h).into()]
}

#[test]
fn a_place_is_marked_in_the_whole_scene_and_large_from_near() {
    for mesh in [shapes::torus(40, 20, 2.0, 0.5), shapes::square()] {
        let scene = scene(mesh);
        let mesh = scene.objects()[0].as_mesh().unwrap();
        for element in every_kind(mesh) {
            let place = ErrorLocation::of("mesh", mesh, element).unwrap();

            let image = drawn(&scene, &[place], "what is wrong").unwrap();

            let middle = image.width / 2;
            let [left, right] =
                [0..middle, middle..image.width].map(|side| count(&image, WRONG, side));
            assert!(left >= 30, "{element}: {left}");
            assert!(right >= 120, "{element}: {right}");
        }
    }
}

#[test]
fn a_place_on_the_far_side_is_seen_too() {
    let scene = scene(shapes::uv_sphere(24, 12));
    let mesh = scene.objects()[0].as_mesh().unwrap();
    for v in mesh.vertices().step_by(37) {
        let place = ErrorLocation::of("mesh", mesh, v).unwrap();
        let image = drawn(&scene, &[place], "").unwrap();
        assert!(count(&image, WRONG, 0..image.width / 2) >= 30, "{v}");
    }
}

#[test]
fn where_something_should_be_has_a_color_of_its_own() {
    let scene = scene(shapes::cube());
    let expected = ErrorLocation {
        object: String::new(),
        name: ErrorLocation::EXPECTED.to_owned(),
        points: vec![DVec3::splat(1.2)],
    };

    let image = drawn(&scene, &[expected], "").unwrap();

    assert!(count(&image, RIGHT, 0..image.width) > 100);
    assert_eq!(count(&image, WRONG, 0..image.width), 0);
}

#[test]
fn without_places_only_the_scene_is_drawn_and_nothing_of_an_empty_one() {
    let scene = scene(shapes::cube());
    let one = drawn(&scene, &[], "a caption").unwrap();
    let mesh = scene.objects()[0].as_mesh().unwrap();
    let place = ErrorLocation::of("mesh", mesh, mesh.vertices().next().unwrap()).unwrap();
    let two = drawn(&scene, &[place], "a caption").unwrap();

    assert!(two.width > 2 * SIZE[0] && one.width < 2 * SIZE[0]);
    assert!(drawn(&Scene::new(), &[], "a caption").is_none());
}

#[test]
fn a_scene_of_one_point_and_places_far_away_can_be_drawn() {
    let point = vec![vec![DVec3::new(1.0, 2.0, 3.0)]];
    let mut scene = Scene::new();
    let lines = scene::Geometry::Polylines(point);
    scene.insert(Object::new("point", lines)).unwrap();
    for at in [DVec3::ZERO, DVec3::splat(1e300), DVec3::splat(-1e-300)] {
        let place = ErrorLocation {
            object: "point".to_owned(),
            name: "p".to_owned(),
            points: vec![at],
        };
        assert!(drawn(&scene, &[place], "far").is_some(), "{at}");
    }
}

#[test]
fn many_places_are_drawn_with_the_same_bytes_on_any_number_of_threads() {
    let scene = scene(shapes::torus(40, 20, 2.0, 0.5));
    let mesh = scene.objects()[0].as_mesh().unwrap();
    let places: Vec<ErrorLocation> = (mesh.faces())
        .filter_map(|f| ErrorLocation::of("mesh", mesh, f))
        .collect();
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.unwrap()
            .install(|| drawn(&scene, &places, "all faces"))
    };

    assert_eq!(on(1), on(3));
}
