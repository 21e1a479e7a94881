use super::noise::{gradient, random};
use super::*;
use crate::shapes;

const FRAME: Frame = Frame {
    origin: DVec3::ZERO,
    axes: [DVec3::X, DVec3::Y, DVec3::Z],
    from: -1.0,
    to: 3.0,
};

fn points() -> impl Iterator<Item = DVec3> {
    (0..200).map(|i| DVec3::from_array([0, 1, 2].map(|k| 4.0 * random(3 * i + k, 5))))
}

#[test]
fn twists_follow_the_closed_form_and_the_opposite_angle_is_the_inverse() {
    let twist = Twist {
        frame: FRAME,
        angle: 180.0,
    };
    let back = Twist {
        angle: -180.0,
        ..twist
    };
    // At a quarter of the height, the twist is 45 degrees. Beyond the end of the axis, it is 180 degrees.
    let h = 0.5_f64.sqrt();
    assert!(twist.point(DVec3::X).distance(DVec3::new(h, h, 0.0)) < 1e-15);
    assert_eq!(
        twist.point(DVec3::new(1.0, 2.0, 9.0)),
        DVec3::new(-1.0, -2.0, 9.0)
    );
    assert_eq!(
        twist.point(DVec3::new(1.0, 2.0, -9.0)),
        DVec3::new(1.0, 2.0, -9.0)
    );
    for p in points() {
        assert!(back.point(twist.point(p)).distance(p) < 1e-12);
    }
}

#[test]
fn tapers_follow_the_closed_form() {
    let taper = Taper {
        frame: FRAME,
        factor: 0.2,
    };
    assert!(
        taper
            .point(DVec3::new(1.0, -2.0, 1.0))
            .distance(DVec3::new(0.6, -1.2, 1.0))
            < 1e-15
    );
    assert_eq!(
        taper.point(DVec3::new(5.0, 0.0, 3.0)),
        DVec3::new(1.0, 0.0, 3.0)
    );
    assert_eq!(
        taper.point(DVec3::new(5.0, 0.0, 4.0)),
        DVec3::new(1.0, 0.0, 4.0)
    );
    assert_eq!(
        taper.point(DVec3::new(5.0, 0.0, -4.0)),
        DVec3::new(5.0, 0.0, -4.0)
    );
}

#[test]
fn a_tapered_column_has_the_volume_of_a_frustum() {
    let mut mesh = shapes::cube();
    let frame = Frame {
        from: -1.0,
        to: 1.0,
        ..FRAME
    };
    let taper = Taper { frame, factor: 0.5 };
    mesh.positions_mut()
        .iter_mut()
        .for_each(|p| *p = taper.point(*p));
    assert!((crate::volume(&mesh) - 2.0 / 3.0 * (4.0 + 1.0 + 2.0)).abs() < 1e-13);
}

#[test]
fn bends_put_the_axis_on_a_circle_and_keep_its_length() {
    use std::f64::consts::PI;
    // The axis has length 4. The bend maps it to a quarter of a circle with the radius 8 / pi.
    let bend = Bend {
        frame: FRAME,
        angle: 90.0,
    };
    let radius = 8.0 / PI;
    let center = DVec3::new(radius, 0.0, -1.0);
    for i in 0..=40 {
        let z = -1.0 + f64::from(i) / 10.0;
        for x in [-0.5, 0.0, 1.0] {
            let p = bend.point(DVec3::new(x, 0.25, z));
            assert!((p.with_y(0.0).distance(center) - (radius - x)).abs() < 1e-14);
            let angle = libm::atan2(p.z - center.z, center.x - p.x);
            assert!((angle * radius - (z + 1.0)).abs() < 1e-13);
            assert_eq!(p.y, 0.25);
        }
    }
    // Beyond its end, the bent axis continues straight in the direction x.
    let end = bend.point(DVec3::new(0.0, 0.0, 3.0));
    let beyond = bend.point(DVec3::new(0.0, 0.0, 5.0));
    assert!(beyond.distance(end + 2.0 * DVec3::X) < 1e-14);
    // Points below the start of the axis do not move.
    assert_eq!(
        bend.point(DVec3::new(1.0, 2.0, -7.0)),
        DVec3::new(1.0, 2.0, -7.0)
    );
}

#[test]
fn small_angles_bend_continuously() {
    for p in points() {
        let at = |angle| {
            Bend {
                frame: FRAME,
                angle,
            }
            .point(p)
        };
        assert!(at(0.0).distance(p) < 1e-14);
        assert!(at(1e-300).distance(p) < 1e-14);
        assert!(at(1e-9).distance(p) < 1e-9);
        let mirrored = Bend {
            frame: FRAME,
            angle: -50.0,
        }
        .point(DVec3::new(-p.x, p.y, p.z));
        assert!(at(50.0).distance(DVec3::new(-mirrored.x, mirrored.y, mirrored.z)) < 1e-13);
    }
}

#[test]
fn the_volume_element_of_a_bend_is_one_minus_curvature_times_x() {
    let bend = Bend {
        frame: FRAME,
        angle: 100.0,
    };
    let k = 100.0_f64.to_radians() / 4.0;
    for p in points().filter(|p| p.z > -0.9 && p.z < 2.9) {
        let step = 1e-5;
        let d = |e: DVec3| (bend.point(p + step * e) - bend.point(p - step * e)) / (2.0 * step);
        let determinant = d(DVec3::X).dot(d(DVec3::Y).cross(d(DVec3::Z)));
        assert!((determinant - (1.0 - k * p.x)).abs() < 1e-8);
    }
}

#[test]
fn a_turned_frame_deforms_like_the_turned_mesh() {
    let turned = |p: DVec3| DVec3::new(p.z, p.x, p.y) + DVec3::ONE;
    let axes = FRAME.axes.map(|a| turned(a) - DVec3::ONE);
    let frame = Frame {
        origin: DVec3::ONE,
        axes,
        ..FRAME
    };
    for p in points() {
        let expected = turned(
            Bend {
                frame: FRAME,
                angle: 70.0,
            }
            .point(p),
        );
        assert!(
            Bend { frame, angle: 70.0 }
                .point(turned(p))
                .distance(expected)
                < 1e-13
        );
        let expected = turned(
            Twist {
                frame: FRAME,
                angle: 70.0,
            }
            .point(p),
        );
        assert!(
            Twist { frame, angle: 70.0 }
                .point(turned(p))
                .distance(expected)
                < 1e-13
        );
    }
}

#[test]
fn weights_fall_with_the_distance_from_the_nearest_selected_point() {
    let all: Vec<DVec3> = points().collect();
    let is_selected: Vec<bool> = (0..all.len()).map(|i| i % 4 == 0).collect();
    for radius in [0.1, 1.0, 100.0] {
        let weights = falloff(&all, &is_selected, radius);
        for (i, p) in all.iter().enumerate() {
            let distances = all
                .iter()
                .zip(&is_selected)
                .filter(|q| *q.1)
                .map(|q| q.0.distance(*p));
            let d = distances.fold(f64::INFINITY, f64::min).min(radius) / radius;
            let expected = (1.0 - d * d) * (1.0 - d * d);
            assert!((weights[i] - expected).abs() < 1e-14);
        }
    }
    assert_eq!(falloff(&all[..3], &[false; 3], 1.0), [0.0; 3]);
}

#[test]
fn noise_is_bounded_smooth_and_different_for_each_seed() {
    let (mut largest, mut different) = (0.0, 0);
    for p in points() {
        let value = gradient(1, p);
        assert!(value.abs() <= 1.0);
        assert!((gradient(1, p + DVec3::splat(1e-7)) - value).abs() < 1e-6);
        assert_eq!(gradient(1, p.floor()), 0.0);
        largest = f64::max(largest, value.abs());
        different += usize::from(value != gradient(2, p));
    }
    assert!(largest > 0.3 && different > 190, "{largest} {different}");
    assert!(gradient(1, DVec3::splat(1e300)).is_finite());
    // The numbers are identical bit for bit on every machine.
    assert_eq!(
        gradient(7, DVec3::new(0.25, 1.5, -2.75)).to_bits(),
        0xbfb5_b310_0000_0000
    );
    assert_eq!(random(7, 3).to_bits(), 0x3fed_4e8a_689a_555c);
}

#[test]
fn random_numbers_have_the_moments_of_a_uniform_distribution() {
    let n = 100_000;
    let [mut mean, mut square] = [0.0, 0.0];
    for i in 0..n {
        let x = random(9, i);
        assert!((-1.0..1.0).contains(&x));
        mean += x / n as f64;
        square += x * x / n as f64;
    }
    assert!(mean.abs() < 0.01 && (square - 1.0 / 3.0).abs() < 0.01);
}

#[test]
fn directions_are_the_diagonals_of_a_cube_at_any_size() {
    for factor in [1e-300, 1.0, 1e300] {
        let mut mesh = shapes::cube();
        mesh.positions_mut().iter_mut().for_each(|p| *p *= factor);
        for (n, p) in vertex_directions(&mesh).iter().zip(mesh.positions()) {
            assert!(n.distance((*p / factor).normalize()) < 1e-14);
        }
    }
}
