//! Properties of every scheme.

use mesh::{COLOR, DVec2, DVec3, DVec4, Mesh, UV};
use progress::NoProgress;

use super::{SCHEMES, distance, level, levels, topology};
use crate::{Rules, Scheme, Size, fixtures, subdivide};

#[test]
fn topology_is_kept() {
    for (name, mesh) in fixtures::all() {
        for scheme in SCHEMES {
            let new = levels(scheme, 2, &mesh);
            assert_eq!(topology(&new), topology(&mesh), "{name} {scheme:?}");
        }
    }
}

#[test]
fn subdividing_commutes_with_affine_maps() {
    let map = |p: DVec3| {
        let sheared = DVec3::new(p.x + 0.5 * p.y, 2.0 * p.y - p.z, 0.3 * p.x + p.z);
        sheared + DVec3::new(3.0, -2.0, 1.0)
    };
    for (name, mesh) in fixtures::all() {
        for scheme in SCHEMES {
            let twice = |m: &Mesh| levels(scheme, 2, m);
            let mut mapped = mesh.clone();
            mapped.positions_mut().iter_mut().for_each(|p| *p = map(*p));
            let new = twice(&mesh);
            let expected: Vec<DVec3> = new.positions().iter().map(|&p| map(p)).collect();
            let far = distance(twice(&mapped).positions(), &expected);
            assert!(far < 1e-13, "{name} {scheme:?} {far:e}");
        }
    }
}

#[test]
fn the_bytes_are_the_same_for_any_number_of_threads() {
    let mut mesh = fixtures::sheet(40, 30);
    let colors = mesh.positions().iter().map(|p| p.extend(1.0 / 3.0));
    let colors: Vec<DVec4> = colors.collect();
    mesh.set(COLOR, colors);
    let uvs = mesh.half_edges().map(|h| {
        let n = mesh.face(h).map_or(0, |_| h.index());
        DVec2::splat(n as f64 / 7.0)
    });
    let uvs: Vec<DVec2> = uvs.collect();
    mesh.set(UV, uvs);
    for scheme in SCHEMES {
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
            let pool = pool.build().unwrap();
            pool.install(|| subdivide(&mesh, Rules::of(scheme), 3, &NoProgress).unwrap())
        };
        // Compares bits, because `==` treats -0 and 0 as equal.
        let bits = |m: &Mesh| -> Vec<[u64; 3]> {
            let bits = m.positions().iter().map(|p| p.to_array().map(f64::to_bits));
            bits.collect()
        };
        let one = with(1);
        for threads in [2, 8] {
            let other = with(threads);
            assert_eq!(bits(&other), bits(&one), "{scheme:?} {threads}");
            assert!(other == one, "{scheme:?} {threads}");
        }
    }
}

#[test]
fn interpolating_schemes_keep_old_vertices() {
    let interpolates = |s: &Scheme| matches!(s, Scheme::Butterfly | Scheme::Midpoint(_));
    for (name, mesh) in fixtures::all() {
        for scheme in SCHEMES.into_iter().filter(interpolates) {
            let new = level(scheme, &mesh);
            let n = mesh.n_vertices();
            assert_eq!(new.positions()[..n], *mesh.positions(), "{name} {scheme:?}");
        }
    }
}

#[test]
fn levels_can_be_computed_one_by_one_and_zero_levels_change_nothing() {
    for (name, mesh) in fixtures::all() {
        for scheme in SCHEMES {
            assert!(levels(scheme, 0, &mesh) == mesh, "{name} {scheme:?}");
            // At a boundary, even and odd levels of Sqrt3 differ.
            let step = if scheme == Scheme::Sqrt3 { 2 } else { 1 };
            let twice = levels(scheme, step, &levels(scheme, step, &mesh));
            assert!(
                levels(scheme, 2 * step, &mesh) == twice,
                "{name} {scheme:?}"
            );
        }
    }
}

#[test]
fn the_predicted_size_of_every_level_is_exact() {
    for (name, mesh) in fixtures::all() {
        for scheme in SCHEMES {
            let mut size = Size::of(&mesh);
            for levels in 1..4 {
                size = size.after(scheme, levels - 1);
                let new = super::levels(scheme, levels, &mesh);
                assert_eq!(size, Size::of(&new), "{name} {scheme:?} {levels}");
            }
        }
    }
}
