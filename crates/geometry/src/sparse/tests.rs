use super::*;
use mesh::DVec3;
use progress::NoProgress;
use proptest::prelude::*;

/// Solves the equations by Gaussian elimination on a full matrix.
fn dense_solution(matrix: &SymmetricMatrix, b: &[f64]) -> Vec<f64> {
    let n = matrix.len();
    let mut rows: Vec<Vec<f64>> = (0..n)
        .map(|i| (0..n).map(|j| matrix.get(i, j)).chain([b[i]]).collect())
        .collect();
    for c in 0..n {
        let best = (c..n).max_by(|&i, &j| rows[i][c].abs().total_cmp(&rows[j][c].abs()));
        rows.swap(c, best.unwrap());
        let pivot = rows[c].clone();
        for row in &mut rows[c + 1..] {
            let factor = row[c] / pivot[c];
            for (entry, p) in row.iter_mut().zip(&pivot) {
                *entry -= factor * p;
            }
        }
    }
    let mut x = vec![0.0; n];
    for i in (0..n).rev() {
        let known: f64 = (i + 1..n).map(|j| rows[i][j] * x[j]).sum();
        x[i] = (rows[i][n] - known) / rows[i][i];
    }
    x
}

/// Returns the graph Laplacian of a grid, plus `shift` on the diagonal.
fn grid(side: u32, shift: f64) -> SymmetricMatrix {
    let mut entries = Vec::new();
    let mut edge = |i, j| entries.extend([(i, j, -1.0), (i, i, 1.0), (j, j, 1.0)]);
    for y in 0..side {
        for x in 0..side {
            let i = y * side + x;
            if x + 1 < side {
                edge(i, i + 1);
            }
            if y + 1 < side {
                edge(i, i + side);
            }
        }
    }
    entries.extend((0..side * side).map(|i| (i, i, shift)));
    SymmetricMatrix::from_entries((side * side) as usize, entries)
}

fn solved(matrix: &SymmetricMatrix, b: &[f64]) -> Vec<f64> {
    let factor = Factor::new(matrix, &NoProgress).unwrap();
    let mut x = vec![f64::NAN; b.len()];
    factor.solve(b, &mut x).unwrap();
    x
}

#[test]
fn entries_are_symmetric_and_added_up() {
    let a = SymmetricMatrix::from_entries(3, vec![(2, 0, 1.0), (1, 1, 2.0), (1, 1, 3.0)]);
    assert_eq!(a.row(0).collect::<Vec<_>>(), [(2, 1.0)]);
    assert_eq!(a.row(1).collect::<Vec<_>>(), [(1, 5.0)]);
    assert_eq!(a.row(2).collect::<Vec<_>>(), [(0, 1.0)]);
    assert_eq!((a.get(0, 2), a.get(0, 1), a.n_entries()), (1.0, 0.0, 3));
    assert_eq!(a.times(&[1.0, 2.0, 3.0]), [3.0, 10.0, 1.0]);
    let b = a.scaled_plus_diagonal(2.0, &[1.0, 0.0, 0.0]);
    assert_eq!((b.get(0, 0), b.get(1, 1), b.get(0, 2)), (1.0, 10.0, 2.0));
}

#[test]
fn empty_systems_are_solved() {
    let empty = SymmetricMatrix::default();
    assert!(solved(&empty, &[]).is_empty());
    let a = grid(3, 1.0);
    let factor = Factor::with_pins(&a, &[true; 9], &NoProgress).unwrap();
    let mut x = [0.5; 9];
    factor.solve(&[1.0; 9], &mut x).unwrap();
    assert_eq!(x, [0.5; 9]);
}

#[test]
fn large_fronts_agree_with_the_known_solution() {
    // The matrix is large enough for several subtrees, blocks of pivots and parallel updates.
    let a = grid(150, 1e-3);
    let expected: Vec<DVec3> = (0..a.len())
        .map(|i| DVec3::new(1.0, (i % 7) as f64, -((i % 11) as f64)))
        .collect();
    let b = a.times(&expected);
    let factor = Factor::new(&a, &NoProgress).unwrap();
    let mut x = vec![DVec3::ZERO; a.len()];
    factor.solve(&b, &mut x).unwrap();
    for (x, e) in x.iter().zip(&expected) {
        assert!((*x - *e).length() < 1e-9, "{x} {e}");
    }
}

#[test]
fn a_dense_matrix_is_one_front() {
    let n = 150;
    let entries = (0..n).flat_map(|i| {
        (0..=i).map(move |j| {
            (
                i,
                j,
                if i == j {
                    200.0
                } else {
                    f64::from((i * 7 + j * 3) % 5) / 5.0
                },
            )
        })
    });
    let a = SymmetricMatrix::from_entries(n as usize, entries.collect());
    let b: Vec<f64> = (0..n).map(f64::from).collect();
    for (x, e) in solved(&a, &b).iter().zip(dense_solution(&a, &b)) {
        assert!((x - e).abs() < 1e-12, "{x} {e}");
    }
}

#[test]
fn a_long_chain_does_not_overflow_the_stack() {
    let n = 100_000;
    let mut entries: Vec<(u32, u32, f64)> = (0..n).map(|i| (i, i, 2.5)).collect();
    entries.extend((1..n).map(|i| (i, i - 1, -1.0)));
    let a = SymmetricMatrix::from_entries(n as usize, entries);
    let b = a.times(&vec![1.0; n as usize]);
    assert!(solved(&a, &b).iter().all(|x| (x - 1.0).abs() < 1e-12));
}

#[test]
fn the_fill_of_a_grid_is_near_n_log_n() {
    // If the unknowns of a square grid are ordered by nested dissection, the factor has about 7.75 n log2(side) entries
    // (George, 1973).
    let side = 100_u32;
    let a = grid(side, 1.0);
    let entries = Factor::new(&a, &NoProgress).unwrap().n_entries() as f64;
    let n = f64::from(side * side);
    assert!(
        entries < 7.75 * n * libm::log2(f64::from(side)),
        "{entries}"
    );
}

#[test]
fn indefinite_singular_and_bad_matrices_are_refused() {
    let singular = grid(5, 0.0);
    let negative = grid(5, -0.5);
    let mut nan = grid(5, 1.0);
    nan.values.fill(f64::NAN);
    for matrix in [singular, negative, nan] {
        let refused = Factor::new(&matrix, &NoProgress).map(|f| f.n_entries());
        let is_refused = match refused {
            Err(SolveError::NotPositiveDefinite { row, .. }) => row < 25,
            // The last pivot of the singular matrix is a rounding error, so it can be positive. The matrix is then
            // accepted.
            other => other.is_ok() && matrix.get(0, 0) == 2.0,
        };
        assert!(is_refused);
    }
}

#[test]
fn pinned_unknowns_keep_their_bits_and_a_line_between_them_is_straight() {
    let entries = (1..11_u32).flat_map(|i| [(i, i - 1, -1.0), (i, i, 1.0), (i - 1, i - 1, 1.0)]);
    let laplacian = SymmetricMatrix::from_entries(11, entries.collect());
    let mut is_pinned = [false; 11];
    is_pinned[0] = true;
    is_pinned[10] = true;
    let factor = Factor::with_pins(&laplacian, &is_pinned, &NoProgress).unwrap();
    let mut x = [7.0; 11];
    (x[0], x[10]) = (-0.0, 1.0);
    factor.solve(&[0.0; 11], &mut x).unwrap();
    assert_eq!((x[0].to_bits(), x[10]), ((-0.0_f64).to_bits(), 1.0));
    for (i, x) in (0..).zip(x) {
        assert!((x - 0.1 * f64::from(i)).abs() < 1e-14);
    }
}

#[test]
fn the_number_of_threads_changes_no_bit() {
    let a = grid(160, 0.1);
    let b: Vec<f64> = (0..a.len()).map(|i| libm::sin(i as f64)).collect();
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| solved(&a, &b))
    };
    let one = with(1);
    assert!(one == with(2) && one == with(8));
}

proptest! {
    #[test]
    fn random_systems_agree_with_gaussian_elimination(
        n in 1..40_u32,
        links in prop::collection::vec((0..40_u32, 0..40_u32, -1.0..1.0_f64), 0..150),
        pins in prop::collection::vec(prop::bool::weighted(0.2), 40),
        b in prop::collection::vec(-1.0..1.0_f64, 40),
    ) {
        let mut entries: Vec<_> = (0..n).map(|i| (i, i, 0.1)).collect();
        for (i, j, w) in links {
            let (i, j) = (i % n, j % n);
            if i != j {
                entries.extend([(i, j, w), (i, i, w.abs()), (j, j, w.abs())]);
            }
        }
        let a = SymmetricMatrix::from_entries(n as usize, entries);
        let (pins, b) = (&pins[..n as usize], &b[..n as usize]);
        let factor = Factor::with_pins(&a, pins, &NoProgress).unwrap();
        let mut x = vec![0.25; n as usize];
        factor.solve(b, &mut x).unwrap();
        // The expected solution comes from the same equations, but the rows and columns of the pinned unknowns are
        // replaced by those of the identity matrix.
        let mut replaced = Vec::new();
        for i in 0..n {
            for (j, value) in a.row(i as usize).filter(|&(j, _)| j <= i) {
                let is_pinned = pins[i as usize] || pins[j as usize];
                replaced.push((i, j, if !is_pinned { value } else if i == j { 1.0 } else { 0.0 }));
            }
        }
        let replaced = SymmetricMatrix::from_entries(n as usize, replaced);
        let right: Vec<f64> = (0..n as usize).map(|i| {
            if pins[i] {
                return 0.25;
            }
            let row = a.row(i).filter(|&(j, _)| pins[j as usize]);
            b[i] - row.map(|(_, value)| 0.25 * value).sum::<f64>()
        }).collect();
        for (x, e) in x.iter().zip(dense_solution(&replaced, &right)) {
            prop_assert!((x - e).abs() < 1e-9, "{x} {e}");
        }
    }
}
