//! The subdivision matrix gives the same result as subdivision.

use mesh::{CREASE, DVec3, UV};
use progress::NoProgress;

use super::distance;
use crate::fixtures;
use crate::{LoopWeights, Rules, Scheme, Split, subdivide, subdivision_matrix};

#[test]
fn the_matrix_gives_the_positions_of_every_scheme() {
    let schemes = [
        Scheme::Loop(LoopWeights::Loop),
        Scheme::CatmullClark,
        Scheme::Midpoint(Split::Quads),
        Scheme::Butterfly,
    ];
    for (name, mut mesh) in fixtures::all() {
        mesh.set(UV, vec![mesh::DVec2::X; mesh.n_half_edges()]);
        let sharpness = [0.0, 1.4, 0.0, 10.0, 0.0, 0.0];
        let n = mesh.n_edges();
        mesh.set(CREASE, sharpness.iter().copied().cycle().take(n).collect());
        for scheme in schemes {
            for levels in 0..3 {
                let rules = Rules::of(scheme);
                let matrix = subdivision_matrix(&mesh, rules, levels, &NoProgress).unwrap();
                let fine = subdivide(&mesh, rules, levels, &NoProgress).unwrap();
                let far = distance(&matrix.apply(mesh.positions()), fine.positions());
                assert!(far < 1e-13, "{name} {scheme:?} {levels}: {far:e}");
                assert_eq!(matrix.n_columns, mesh.n_vertices());
                for i in 0..matrix.n_rows() {
                    let sum: f64 = matrix.row(i).map(|(_, w)| w).sum();
                    assert!((sum - 1.0).abs() < 1e-14, "{name} {scheme:?} row {i}");
                    let columns: Vec<usize> = matrix.row(i).map(|(c, _)| c).collect();
                    assert!(
                        columns.is_sorted_by(|a, b| a < b),
                        "{name} {scheme:?} row {i}"
                    );
                }
            }
        }
    }
}

#[test]
fn the_matrix_is_the_same_for_any_number_of_threads() {
    let mesh = fixtures::sheet(40, 30);
    let rules = Rules::of(Scheme::Loop(LoopWeights::Warren));
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.unwrap()
            .install(|| subdivision_matrix(&mesh, rules, 2, &NoProgress).unwrap())
    };
    let one = with(1);
    assert_eq!(
        one.apply(&vec![DVec3::ONE; mesh.n_vertices()]).len(),
        one.n_rows()
    );
    for threads in [2, 8] {
        assert!(with(threads) == one);
    }
}
