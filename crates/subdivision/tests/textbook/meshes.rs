//! Test meshes with sharpness and corner values. Positions are jittered, so that no two neighborhoods are
//! equal.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use mesh::{DVec2, DVec3};

use crate::charts::Charts;
use crate::polygons::{Adjacency, Polygons};

/// A pseudo-random generator with a fixed seed: Steele, Lea and Flood, "Fast Splittable Pseudorandom Number
/// Generators", 2014.
#[derive(Debug)]
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// Returns a number from 0, inclusive, to 1, exclusive.
    pub(crate) fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        (z >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Returns one of the given values at random.
    pub(crate) fn one_of<T: Copy>(&mut self, values: &[T]) -> T {
        let k = values.len() as f64 * self.unit();
        let index = (1..values.len()).filter(|&i| i as f64 <= k).count();
        values[index]
    }

    /// Returns true with probability `p`.
    pub(crate) fn chance(&mut self, p: f64) -> bool {
        self.unit() < p
    }
}

/// A mesh with a name.
pub(crate) type Named = (String, Polygons);

/// Moves each vertex by a random vector, by at most 0.2 along each axis.
fn jittered(mut mesh: Polygons, random: &mut Random) -> Polygons {
    for p in &mut mesh.positions {
        let by = DVec3::new(random.unit(), random.unit(), random.unit()) - 0.5;
        *p += 0.4 * by;
    }
    mesh
}

/// Returns a point on a circle.
fn on_circle(i: usize, n: usize, radius: f64, z: f64) -> DVec3 {
    let (sin, cos) = libm::sincos(TAU * i as f64 / n as f64);
    DVec3::new(radius * cos, radius * sin, z)
}

/// Returns a closed surface of triangles with two vertices of valence n.
fn double_pyramid(n: usize) -> Polygons {
    let mut positions: Vec<DVec3> = (0..n).map(|i| on_circle(i, n, 2.0, 0.0)).collect();
    positions.extend([DVec3::Z, -DVec3::Z]);
    let faces = (0..n).flat_map(|i| {
        let j = (i + 1) % n;
        [vec![i, j, n], vec![j, i, n + 1]]
    });
    Polygons::new(positions, faces.collect())
}

/// Returns a disk of triangles with an inner vertex of valence n. If `wide`, the neighbors of this vertex are
/// inner vertices too.
fn disk(n: usize, wide: bool) -> Polygons {
    let mut positions = vec![DVec3::ZERO];
    positions.extend((0..n).map(|i| on_circle(i, n, 1.5, 0.0)));
    let mut faces: Vec<Vec<usize>> = (0..n).map(|i| vec![0, 1 + i, 1 + (i + 1) % n]).collect();
    if wide {
        positions.extend((0..n).map(|i| on_circle(2 * i + 1, 2 * n, 3.5, 0.5)));
        for i in 0..n {
            let (j, inner, outer) = ((i + 1) % n, 1 + i, 1 + n + i);
            faces.push(vec![inner, outer, 1 + j]);
            faces.push(vec![outer, 1 + n + j, 1 + j]);
        }
    }
    Polygons::new(positions, faces)
}

/// Returns n quads around a vertex. Each outer corner of this disk belongs to only one quad.
fn star(n: usize) -> Polygons {
    let mut positions = vec![DVec3::ZERO];
    positions
        .extend((0..2 * n).map(|i| on_circle(i, 2 * n, if i % 2 == 0 { 1.5 } else { 2.5 }, 0.3)));
    let corner = |i: usize| 1 + i % (2 * n);
    let faces = (0..n).map(|i| vec![0, corner(2 * i), corner(2 * i + 1), corner(2 * i + 2)]);
    Polygons::new(positions, faces.collect())
}

/// Returns a closed surface of two n-gons and n quads.
fn prism(n: usize) -> Polygons {
    let ring = |z: f64| (0..n).map(move |i| on_circle(i, n, 2.0, z));
    let positions = ring(-1.0).chain(ring(1.0)).collect();
    let mut faces: Vec<Vec<usize>> = (0..n)
        .map(|i| vec![i, (i + 1) % n, n + (i + 1) % n, n + i])
        .collect();
    faces.push((0..n).rev().collect());
    faces.push((n..2 * n).collect());
    Polygons::new(positions, faces)
}

/// Returns a rectangle of squares, without the squares for which `holes` is true. Opposite ends are connected
/// in the directions in which `wraps` is true.
fn sheet(
    [columns, rows]: [usize; 2],
    wraps: [bool; 2],
    holes: impl Fn(usize, usize) -> bool,
) -> Polygons {
    let [w, h] = [
        columns + usize::from(!wraps[0]),
        rows + usize::from(!wraps[1]),
    ];
    let at = |x: usize, y: usize| (y % h) * w + x % w;
    let place = |x: usize, y: usize| match wraps {
        [true, true] => {
            let across = on_circle(y, h, 1.0, 0.0);
            on_circle(x, w, 3.0 + across.x, across.y)
        }
        [true, false] => on_circle(x, w, 2.0, y as f64),
        _ => DVec3::new(x as f64, y as f64, 0.0),
    };
    let positions = (0..h)
        .flat_map(|y| (0..w).map(move |x| (x, y)))
        .map(|(x, y)| place(x, y));
    let squares = (0..rows).flat_map(|y| (0..columns).map(move |x| (x, y)));
    let faces = squares
        .filter(|&(x, y)| !holes(x, y))
        .map(|(x, y)| vec![at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)])
        .collect();
    Polygons::new(positions.collect(), faces)
}

/// Cuts each quad along a random diagonal, or along the first diagonal if `random` is `None`.
fn cut_quads(mesh: &Polygons, mut random: Option<&mut Random>) -> Polygons {
    let mut faces = Vec::new();
    for face in &mesh.faces {
        let &[a, b, c, d] = face.as_slice() else {
            panic!("a quad")
        };
        if random.as_mut().is_some_and(|random| random.chance(0.5)) {
            faces.extend([vec![a, b, d], vec![b, c, d]]);
        } else {
            faces.extend([vec![a, b, c], vec![a, c, d]]);
        }
    }
    Polygons::new(mesh.positions.clone(), faces)
}

/// Combines several meshes into one.
fn combined(meshes: &[Polygons]) -> Polygons {
    let mut all = Polygons::default();
    for mesh in meshes {
        let first = all.positions.len();
        let apart = DVec3::X * 10.0 * first as f64;
        all.positions
            .extend(mesh.positions.iter().map(|p| *p + apart));
        all.faces.extend(
            mesh.faces
                .iter()
                .map(|face| face.iter().map(|v| v + first).collect()),
        );
    }
    Polygons::new(all.positions, all.faces)
}

/// Returns an isolated vertex.
fn isolated_vertex() -> Polygons {
    Polygons::new(vec![DVec3::ONE], Vec::new())
}

/// Returns a mesh of one face.
fn polygon(n: usize) -> Polygons {
    Polygons::new(
        (0..n).map(|i| on_circle(i, n, 1.0, 0.0)).collect(),
        vec![(0..n).collect()],
    )
}

/// Returns triangle meshes.
pub(crate) fn triangles() -> Vec<Named> {
    let mut random = Random(1);
    let mut meshes: Vec<(String, Polygons)> = Vec::new();
    let mut add = |name: &str, mesh: Polygons| meshes.push((name.to_owned(), mesh));
    let tetrahedron = Polygons::new(
        vec![DVec3::ZERO, 2.0 * DVec3::X, 2.0 * DVec3::Y, 2.0 * DVec3::Z],
        vec![vec![0, 2, 1], vec![0, 1, 3], vec![1, 2, 3], vec![2, 0, 3]],
    );
    add("tetrahedron", tetrahedron.clone());
    for n in 3..=12 {
        add(&format!("double pyramid {n}"), double_pyramid(n));
        add(&format!("disk {n}"), disk(n, false));
        add(&format!("wide disk {n}"), disk(n, true));
    }
    let none = |_: usize, _: usize| false;
    add("triangle", polygon(3));
    add("two triangles", cut_quads(&polygon(4), None));
    let field = sheet([4, 4], [false, false], none);
    add("cut_quads sheet", cut_quads(&field, Some(&mut random)));
    add(
        "even sheet",
        cut_quads(&sheet([5, 4], [false, false], none), None),
    );
    let ring = sheet([4, 4], [false, false], |x, y| {
        (1..3).contains(&x) && (1..3).contains(&y)
    });
    add("sheet with a hole", cut_quads(&ring, Some(&mut random)));
    add(
        "torus of triangles",
        cut_quads(&sheet([5, 4], [true, true], none), Some(&mut random)),
    );
    add(
        "even torus of triangles",
        cut_quads(&sheet([5, 4], [true, true], none), None),
    );
    add(
        "tube of triangles",
        cut_quads(&sheet([5, 2], [true, false], none), Some(&mut random)),
    );
    let parts = [
        tetrahedron,
        isolated_vertex(),
        disk(5, true),
        polygon(3),
        isolated_vertex(),
        double_pyramid(7),
    ];
    add("parts of triangles", combined(&parts));
    meshes
        .into_iter()
        .map(|(name, mesh)| (name, jittered(mesh, &mut random)))
        .collect()
}

/// Returns a point on a plane.
fn on_plane(x: i32, y: i32) -> DVec3 {
    DVec3::new(f64::from(x), f64::from(y), 0.0)
}

/// Returns meshes of quads and other polygons.
pub(crate) fn polygons() -> Vec<Named> {
    let mut random = Random(2);
    let mut meshes: Vec<(String, Polygons)> = Vec::new();
    let mut add = |name: &str, mesh: Polygons| meshes.push((name.to_owned(), mesh));
    for n in 3..=12 {
        add(&format!("star {n}"), star(n));
        add(&format!("prism {n}"), prism(n));
    }
    let none = |_: usize, _: usize| false;
    for n in [3, 4, 5, 7] {
        add(&format!("{n}-gon"), polygon(n));
    }
    add("sheet", sheet([3, 3], [false, false], none));
    add(
        "bent sheet",
        sheet([4, 4], [false, false], |x, y| x > 1 && y > 1),
    );
    let ring = sheet([4, 4], [false, false], |x, y| {
        (1..3).contains(&x) && (1..3).contains(&y)
    });
    add("sheet with a hole of quads", ring);
    add("torus", sheet([5, 4], [true, true], none));
    add("tube", sheet([5, 2], [true, false], none));
    let concave = |faces| {
        let index = [[0, 0], [4, 0], [4, 4], [2, 1], [0, 4], [6, 2], [2, 6]];
        Polygons::new(index.map(|[x, y]| on_plane(x, y)).to_vec(), faces)
    };
    let dented = concave(vec![vec![0, 1, 2, 3, 4], vec![1, 5, 2], vec![4, 3, 6]]);
    add("dented", dented.clone());
    // Two faces share two consecutive edges.
    add(
        "filled dent",
        concave(vec![vec![0, 1, 2, 3, 4], vec![1, 5, 2], vec![4, 3, 2, 6]]),
    );
    add(
        "parts",
        combined(&[
            prism(5),
            isolated_vertex(),
            star(6),
            polygon(7),
            dented,
            isolated_vertex(),
        ]),
    );
    meshes
        .into_iter()
        .map(|(name, mesh)| (name, jittered(mesh, &mut random)))
        .collect()
}

/// A pattern of sharp edges and vertices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Pattern {
    /// Nothing is sharp.
    Smooth,
    /// Few sharp edges, which form darts and creases.
    FewEdges,
    /// Many sharp edges, which form corners too.
    ManyEdges,
    /// Few sharp vertices.
    Vertices,
    /// Many sharp edges and some sharp vertices.
    Mixed,
    /// Sharpness of at most 1, so that all sharp elements become smooth within one level.
    Fractions,
    /// Infinite sharpness.
    Infinite,
}

impl Pattern {
    /// All patterns.
    pub(crate) const ALL: [Self; 7] = [
        Self::Smooth,
        Self::FewEdges,
        Self::ManyEdges,
        Self::Vertices,
        Self::Mixed,
        Self::Fractions,
        Self::Infinite,
    ];

    /// Returns a copy of the mesh in which random edges and vertices are sharp, as the pattern `self` specifies.
    pub(crate) fn on(self, mesh: &Polygons, random: &mut Random) -> Polygons {
        let levels = [-1.0, 12.0, 0.3, 0.7, 1.0, 1.7, 2.0, 2.5, 3.2, 10.0];
        let (edges, vertices, choice): (f64, f64, &[f64]) = match self {
            Self::Smooth => (0.0, 0.0, &levels),
            Self::FewEdges => (0.2, 0.0, &levels),
            Self::ManyEdges => (0.5, 0.0, &levels),
            Self::Vertices => (0.0, 0.3, &levels),
            Self::Mixed => (0.4, 0.2, &levels),
            Self::Fractions => (0.6, 0.3, &levels[2..5]),
            Self::Infinite => (0.4, 0.2, &levels[9..]),
        };
        let mut mesh = mesh.clone();
        let adjacency = Adjacency::new(mesh.positions.len(), &mesh.faces);
        // Adds noise to each sharpness that is not a whole number. Without noise, a sum of sharpness values could be 1
        // up to rounding.
        let sharpness = |random: &mut Random| {
            let s: f64 = random.one_of(choice);
            if s.fract() == 0.0 {
                s
            } else {
                s + 0.001 * random.unit()
            }
        };
        let mut crease = BTreeMap::new();
        for &e in adjacency.sides.keys() {
            if random.chance(edges) {
                crease.insert(e, sharpness(random));
            }
        }
        for s in &mut mesh.corner {
            if random.chance(vertices) {
                *s = sharpness(random);
            }
        }
        mesh.crease = crease;
        mesh
    }
}

/// A pattern of corner values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Islands {
    /// Each vertex has one value.
    One,
    /// Faces belong to one of two islands.
    Two,
    /// Faces belong to one of four islands.
    Four,
    /// At about 15 % of the vertices, each corner has one of two random values.
    Torn,
    /// At each vertex, each corner has one of two random values.
    Shattered,
}

impl Islands {
    /// All patterns.
    pub(crate) const ALL: [Self; 5] = [
        Self::One,
        Self::Two,
        Self::Four,
        Self::Torn,
        Self::Shattered,
    ];

    /// Returns a copy of the mesh with random corner values. The pattern `self` decides which corners at a vertex get
    /// the same value.
    pub(crate) fn on(self, mesh: &Polygons, random: &mut Random) -> Polygons {
        let n = 4;
        let numbers: Vec<Vec<DVec2>> = (mesh.positions.iter())
            .map(|_| {
                (0..n)
                    .map(|_| DVec2::new(random.unit(), random.unit()))
                    .collect()
            })
            .collect();
        let is_torn: Vec<bool> = (mesh.positions.iter())
            .map(|_| self == Self::Shattered || (self == Self::Torn && random.chance(0.15)))
            .collect();
        let corners: Vec<Vec<DVec2>> = (mesh.faces.iter())
            .map(|face| {
                let island = match self {
                    Self::Two => random.one_of(&[0, 1]),
                    Self::Four => random.one_of(&[0, 1, 2, 3]),
                    _ => 0,
                };
                let of_corner = |&v: &usize| {
                    let k = if is_torn[v] {
                        random.one_of(&[0, 1])
                    } else {
                        island
                    };
                    numbers[v][k]
                };
                face.iter().map(of_corner).collect()
            })
            .collect();
        let mut mesh = mesh.clone();
        mesh.charts = Some(Charts::new(&mesh.faces, &corners));
        mesh
    }
}
