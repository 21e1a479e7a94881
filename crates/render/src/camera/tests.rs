//! Tests of cameras.

use super::*;

/// Calls `each` with the corners of a box.
fn corners(each: &mut dyn FnMut(DVec3)) {
    for i in 0..8 {
        let side = |bit: u8, low: f64, high: f64| if i >> bit & 1 == 0 { low } else { high };
        each(DVec3::new(
            side(0, -1.0, 3.0),
            side(1, 0.0, 1.0),
            side(2, 7.0, 9.0),
        ));
    }
}

fn fit(from: Side, up: Up, projection: Projection, margin: f64, steady: bool) -> Camera {
    Camera::Fit {
        from,
        up,
        projection,
        margin,
        steady,
    }
}

const PROJECTIONS: [Projection; 3] = [
    Projection::Orthographic,
    Projection::Perspective { angle: 25.0 },
    Projection::Perspective { angle: 90.0 },
];

#[test]
fn a_fitted_camera_shows_all_points_inside_its_margins() {
    let size = [200, 100];
    for projection in PROJECTIONS {
        for from in [Side::Front, Side::Isometric, Side::Top, Side::ThreeQuarter] {
            let camera = fit(from, Up::Z, projection, 0.1, false);
            let view = View::new(&camera, &corners, size).unwrap();
            let (mut min, mut max) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
            corners(&mut |p| {
                let seen = view.screen_point(p).unwrap();
                (min, max) = (min.min(seen.at), max.max(seen.at));
            });
            // The points touch the left and the right margin, or the upper and the lower margin. They do not overlap
            // the other two margins.
            let margin = DVec2::new(20.0, 10.0);
            let (low, high) = (min - margin, DVec2::new(200.0, 100.0) - margin - max);
            assert!(low.min_element() > -1e-6 && high.min_element() > -1e-6);
            let gap = (low + high).min_element();
            assert!(gap < 1e-6, "{from:?} {projection:?}: {low} {high}");
        }
    }
}

#[test]
fn a_steady_camera_shows_the_bounding_sphere_from_all_sides_at_the_same_scale() {
    let (center, radius) = sphere(&corners);
    for projection in PROJECTIONS {
        let mut scales = Vec::new();
        for azimuth in [0.0, 33.0, 180.0] {
            let from = Side::Angles {
                azimuth,
                elevation: 20.0,
            };
            let camera = fit(from, Up::Y, projection, 0.0, true);
            let view = View::new(&camera, &corners, [100, 100]).unwrap();
            let [x, _, _] = view.axes();
            let middle = view.screen_point(center).unwrap();
            assert!((middle.at - 50.0).length() < 1e-6);
            scales.push(view.screen_point(center + x * radius).unwrap().at.x);
        }
        assert!(
            scales
                .iter()
                .all(|s| (s - scales[0]).abs() < 1e-6 && *s < 100.001)
        );
    }
}

#[test]
fn each_side_has_its_axes() {
    for (up, side, right, above) in [
        (Up::Y, Side::Front, DVec3::X, DVec3::Y),
        (Up::Y, Side::Back, DVec3::NEG_X, DVec3::Y),
        (Up::Y, Side::Right, DVec3::NEG_Z, DVec3::Y),
        (Up::Y, Side::Left, DVec3::Z, DVec3::Y),
        (Up::Y, Side::Top, DVec3::X, DVec3::NEG_Z),
        (Up::Y, Side::Bottom, DVec3::X, DVec3::Z),
        (Up::Z, Side::Front, DVec3::X, DVec3::Z),
        (Up::Z, Side::Right, DVec3::Y, DVec3::Z),
        (Up::Z, Side::Top, DVec3::X, DVec3::Y),
    ] {
        let [x, y, z] = side.axes(up);
        assert_eq!((x, y), (right, above), "{side:?} with {up:?} upwards");
        assert_eq!(z, x.cross(y));
    }
    let [_, _, towards] = Side::Isometric.axes(Up::Y);
    assert!((towards - DVec3::ONE.normalize()).length() < 1e-12);
}

#[test]
fn a_camera_straight_above_has_the_front_at_the_bottom() {
    for (up, from, front) in [
        (Up::Y, [0.0, 5.0, 0.0], DVec3::Z),
        (Up::Z, [0.0, 0.0, 5.0], DVec3::NEG_Y),
    ] {
        let camera = Camera::LookAt {
            from,
            to: [0.0; 3],
            up,
            projection: Projection::default(),
        };
        let view = View::new(&camera, &|_| {}, [10, 10]).unwrap();
        let seen = view.screen_point(front).unwrap().at;
        assert!(seen.y > 6.0 && (seen.x - 5.0).abs() < 1e-9, "{seen}");
    }
}

#[test]
fn the_ray_through_a_point_of_the_picture_meets_the_point_projected_there() {
    for projection in PROJECTIONS {
        let camera = fit(Side::ThreeQuarter, Up::Y, projection, 0.05, false);
        let view = View::new(&camera, &corners, [64, 48]).unwrap();
        let p = DVec3::new(0.3, 0.8, 8.1);
        let seen = view.screen_point(p).unwrap();
        let (origin, direction) = view.ray(seen.at);
        let aside = (p - origin).cross(direction).length();
        assert!(aside < 1e-9, "{aside}");
        let depth = view
            .plane_depth(p, DVec3::new(0.1, 0.2, 0.9), seen.at)
            .unwrap();
        assert!((depth - seen.depth).abs() < 1e-9);
    }
}

#[test]
fn cameras_with_invalid_numbers_are_refused() {
    let look_at = |from, to| Camera::LookAt {
        from,
        to,
        up: Up::Y,
        projection: Projection::default(),
    };
    let angle = |angle| Projection::Perspective { angle };
    let side = Side::Angles {
        azimuth: f64::NAN,
        elevation: 0.0,
    };
    for camera in [
        look_at([1.0; 3], [1.0; 3]),
        look_at([f64::INFINITY; 3], [1.0; 3]),
        fit(Side::Front, Up::Y, angle(0.0), 0.0, false),
        fit(Side::Front, Up::Y, angle(180.0), 0.0, false),
        fit(Side::Front, Up::Y, Projection::Orthographic, 0.5, false),
        fit(side, Up::Y, Projection::Orthographic, 0.0, false),
    ] {
        let refused = View::new(&camera, &corners, [10, 10]);
        assert!(
            matches!(refused, Err(PictureError::Camera(_))),
            "{camera:?}"
        );
    }
}

#[test]
fn the_extreme_points_of_all_parts_give_the_same_view_as_all_points() {
    // The points form two clouds, which are far from each other and from the origin.
    let cloud = |seed: u32, middle: DVec3| -> Vec<DVec3> {
        let mut state = seed;
        let mut number = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state >> 8) / f64::from(1 << 24) - 0.5
        };
        let point = |_| middle + DVec3::new(number(), number(), number());
        (0..500).map(point).collect()
    };
    let parts = [
        cloud(1, DVec3::splat(20.0)),
        cloud(2, DVec3::new(22.0, 20.5, 19.0)),
    ];
    let all = parts.concat();
    let each = |list: &[DVec3], each: &mut dyn FnMut(DVec3)| list.iter().for_each(|&p| each(p));
    let size = [200, 100];
    for projection in PROJECTIONS {
        for (from, up) in [(Side::Front, Up::Y), (Side::ThreeQuarter, Up::Z)] {
            let camera = fit(from, up, projection, 0.1, false);
            let extreme: Vec<DVec3> = parts
                .iter()
                .flat_map(|part| camera.extreme_points(&|f| each(part, f), size).unwrap())
                .collect();
            assert!(extreme.len() <= 22);
            let view = View::new(&camera, &|f| each(&all, f), size).unwrap();
            let same = View::new(&camera, &|f| each(&extreme, f), size).unwrap();
            for p in &all {
                let (a, b) = (
                    view.screen_point(*p).unwrap(),
                    same.screen_point(*p).unwrap(),
                );
                assert!(a.at.distance(b.at) < 1e-9, "{from:?} {projection:?}");
            }
            // A steady camera must also show all points, but can show them at a smaller scale.
            let steady = fit(from, up, projection, 0.0, true);
            let extreme = steady.extreme_points(&|f| each(&all, f), size).unwrap();
            let view = View::new(&steady, &|f| each(&extreme, f), size).unwrap();
            for p in &all {
                let at = view.screen_point(*p).unwrap().at;
                assert!(at.min_element() >= 0.0 && at.x <= 200.0 && at.y <= 100.0);
            }
        }
    }
    let none =
        fit(Side::Front, Up::Y, Projection::default(), 0.1, true).extreme_points(&|_| {}, size);
    assert_eq!(none.unwrap(), []);
}

#[test]
fn auto_is_the_axis_on_whose_plane_the_scene_stands() {
    let axis = |low: [f64; 3], high: [f64; 3]| {
        let points = [DVec3::from(low), DVec3::from(high)];
        Up::Auto.resolved(&|f: &mut dyn FnMut(DVec3)| points.into_iter().for_each(f))
    };
    assert_eq!(axis([-1.0, -1.0, 0.0], [1.0, 1.0, 3.0]), Up::Z);
    assert_eq!(axis([-1.0, 0.0, -1.0], [1.0, 3.0, 1.0]), Up::Y);
    // The y axis points upwards if a scene stands on both planes y = 0 and z = 0, or on neither of them. A scene that
    // lies flat in a plane does not stand on it.
    assert_eq!(axis([0.0; 3], [1.0; 3]), Up::Y);
    assert_eq!(axis([-1.0; 3], [1.0; 3]), Up::Y);
    assert_eq!(axis([-1.0, -1.0, 0.0], [1.0, 1.0, 0.0]), Up::Y);
    assert_eq!(Up::Auto.resolved(&|_| {}), Up::Y);
}

#[test]
fn the_view_of_auto_is_that_of_its_axis() {
    let size = [200, 100];
    let standing = |each: &mut dyn FnMut(DVec3)| {
        for p in [[-1.0, -1.0, 0.0], [1.0, 1.0, 3.0], [1.0, -1.0, 0.0]] {
            each(p.into());
        }
    };
    let camera = |up| fit(Side::ThreeQuarter, up, Projection::default(), 0.05, false);
    let extreme = camera(Up::Auto).extreme_points(&standing, size).unwrap();
    let auto = View::new(
        &camera(Up::Auto),
        &|f| extreme.iter().copied().for_each(f),
        size,
    );
    let z = View::new(&camera(Up::Z), &standing, size);
    let at = |view: Result<View, _>| view.unwrap().screen_point(DVec3::ONE).unwrap().at;
    assert!(at(auto).distance(at(z)) < 1e-9);
}

#[test]
fn a_camera_that_looks_at_a_point_has_the_same_upward_axis_in_sheets_and_turntables() {
    let size = [200, 100];
    let standing = |each: &mut dyn FnMut(DVec3)| {
        for p in [[-1.0, -1.0, 0.0], [1.0, 1.0, 3.0], [1.0, -1.0, 0.0]] {
            each(p.into());
        }
    };
    let camera = |up| Camera::LookAt {
        from: [5.0, -7.0, 4.0],
        to: [0.0, 0.0, 1.0],
        up,
        projection: Projection::default(),
    };
    let at = |view: Result<View, _>| view.unwrap().screen_point(DVec3::ONE).unwrap().at;
    let expected = at(View::new(&camera(Up::Z), &standing, size));
    // A contact sheet (several pictures in one image) computes one view for all scenes, from the extreme points of each
    // scene.
    let extreme = camera(Up::Auto).extreme_points(&standing, size).unwrap();
    let each = |f: &mut dyn FnMut(DVec3)| extreme.iter().copied().for_each(f);
    assert!(extreme.len() <= 6);
    assert_eq!(at(View::new(&camera(Up::Auto), &each, size)), expected);
    assert_eq!(camera(Up::Z).extreme_points(&standing, size).unwrap(), []);
    // In a turntable animation, the camera moves around the upward axis.
    for degrees in [0.0, 70.0] {
        let [auto, z] = [Up::Auto, Up::Z].map(|up| camera(up).turned(degrees, &standing));
        assert_eq!(auto, z);
    }
    let Camera::LookAt { from, .. } = camera(Up::Auto).turned(90.0, &standing) else {
        unreachable!()
    };
    assert!(DVec3::from(from).distance(DVec3::new(7.0, 5.0, 4.0)) < 1e-12);
}
