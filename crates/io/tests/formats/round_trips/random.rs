//! Random meshes with random values and unusual names.

use glam::{DVec2, DVec3, DVec4};
use mesh::{Domain, MATERIAL, Mesh, Rule, Values, VertexId};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use scene::{Material, Object};

use super::check_laws;
use super::flat::fits;
use super::models::{column, one};

/// Names of attributes that are reserved in some format, or that some writers must change or quote.
const NAMES: [&str; 22] = [
    "heat",
    "uv",
    "uv1",
    "normal",
    "color",
    "material",
    "smoothing",
    "crease",
    "tangent",
    "x",
    "nx",
    "red",
    "s",
    "a b",
    "žluť",
    "#a",
    "o:a",
    "",
    "_a",
    "vertex_indices",
    "color_index",
    "Heat",
];

const RULES: [Rule; 4] = [Rule::Interpolate, Rule::Normal, Rule::Copy, Rule::Drop];

/// Returns any finite number: a random number, or a number that programs often write incorrectly.
fn number() -> impl Strategy<Value = f64> {
    let any = any::<u64>().prop_map(f64::from_bits);
    let any = any.prop_filter("finite", |x| x.is_finite());
    let known = [
        0.0,
        -0.0,
        1.0,
        -1.0,
        0.5,
        0.1,
        1.0 / 3.0,
        1e300,
        5e-324,
        1e-310,
        1e22,
        123_456_789.0,
    ];
    prop_oneof![any, prop::sample::select(known.to_vec())]
}

/// A random attribute. Its values are repeated until every element has a value.
#[derive(Clone, Debug)]
struct Sketch {
    domain: Domain,
    name: &'static str,
    rule: Rule,
    kind: usize,
    numbers: Vec<f64>,
}

fn sketch() -> impl Strategy<Value = Sketch> {
    (
        prop::sample::select(Domain::ALL.to_vec()),
        prop::sample::select(NAMES.to_vec()),
        prop::sample::select(RULES.to_vec()),
        0..6_usize,
        prop::collection::vec(number(), 5..9),
    )
        .prop_map(|(domain, name, rule, kind, numbers)| Sketch {
            domain,
            name,
            rule,
            kind,
            numbers,
        })
}

impl Sketch {
    fn values(&self, n: usize) -> Values {
        let x = |i: usize| self.numbers[i % self.numbers.len()];
        match self.kind {
            0 => Values::Float((0..n).map(x).collect()),
            1 => Values::Vec2((0..n).map(|i| DVec2::new(x(i), x(i + 1))).collect()),
            2 if self.rule == Rule::Normal => Values::Vec3(
                (0..n)
                    .map(|i| [DVec3::X, DVec3::NEG_Z, DVec3::Y][i * 7 % 3])
                    .collect(),
            ),
            2 => Values::Vec3(
                (0..n)
                    .map(|i| DVec3::new(x(i), x(i + 1), x(i + 2)))
                    .collect(),
            ),
            3 => Values::Vec4(
                (0..n)
                    .map(|i| DVec4::new(x(i), x(i + 1), x(i + 2), x(i + 3)))
                    .collect(),
            ),
            4 => Values::Int(
                (0..n)
                    .map(|i| i32::try_from(x(i).to_bits() % 7).unwrap() - 2)
                    .collect(),
            ),
            _ => Values::Tag((0..n).map(|i| x(i) > 0.5).collect()),
        }
    }

    /// Adds the column. Values of half-edges without a face are zero, because files do not store them.
    fn add(&self, mesh: &mut Mesh) {
        let mut values = self.values(mesh.domain_len(self.domain));
        if self.domain == Domain::Corner {
            let no_face: Vec<bool> = mesh.half_edges().map(|h| mesh.face(h).is_none()).collect();
            values = values.gather(no_face.len(), |h| (!no_face[h]).then_some(h));
        }
        if fits(self.rule, &values) {
            column(mesh, self.domain, self.name, self.rule, values);
        }
    }
}

/// Returns random faces. The corners of a face are distinct vertices.
fn faces() -> impl Strategy<Value = Vec<Vec<u32>>> {
    let all: Vec<u32> = (0..9).collect();
    let face = (prop::sample::subsequence(all, 3..7)).prop_shuffle();
    prop::collection::vec(face, 0..5)
}

fn made(positions: Vec<DVec3>, faces: &[Vec<u32>], columns: &[Sketch]) -> Vec<Object> {
    let (mut mesh, _) = Mesh::from_polygons(positions, faces).unwrap();
    for column in columns {
        column.add(&mut mesh);
    }
    let mut objects = one(mesh);
    objects[0].materials = vec![Material::new("one"), Material::new("two")];
    objects
}

/// Whether two edges of the mesh have the same two vertices. Splitting can create such edges. A file cannot distinguish
/// two such edges, so reading splits their vertices again.
fn has_double_edges(objects: &[Object]) -> bool {
    let mesh = objects[0].as_mesh().unwrap();
    let mut ends: Vec<_> = mesh
        .edges()
        .map(|e| {
            let [a, b] = mesh.edge_vertices(e);
            [a.min(b), a.max(b)]
        })
        .collect();
    ends.sort();
    ends.windows(2).any(|pair| pair[0] == pair[1])
}

/// By default, every run tests the same cases. To test other cases, set environment variables, for example
/// `PROPTEST_RNG_SEED=2 PROPTEST_CASES=1000`.
fn cases() -> ProptestConfig {
    let config = ProptestConfig::default();
    match config.rng_seed {
        RngSeed::Random => ProptestConfig {
            rng_seed: RngSeed::Fixed(1),
            cases: 64,
            ..config
        },
        RngSeed::Fixed(_) => config,
    }
}

proptest! {
    #![proptest_config(cases())]

    #[test]
    fn random_polygons_with_random_values_survive_as_documented(
        numbers in prop::collection::vec(number(), 27),
        faces in faces(),
        columns in prop::collection::vec(sketch(), 0..4),
    ) {
        let positions = numbers.chunks(3).map(DVec3::from_slice).collect();
        let mut objects = made(positions, &faces, &columns);
        prop_assume!(!has_double_edges(&objects));
        for extension in ["obj", "ply", "off"] {
            prop_assert_eq!(check_laws(&objects, extension).map_err(|why| format!("{extension}: {why}")), Ok(()));
        }
        objects[0].materials.clear();
        for extension in ["obj", "ply", "off", "stl", "glb"] {
            prop_assert_eq!(check_laws(&objects, extension).map_err(|why| format!("{extension}: {why}")), Ok(()));
        }
    }

    #[test]
    fn random_triangles_of_32_bits_survive_as_documented(
        heights in prop::collection::vec(any::<i16>(), 16),
        keep in prop::collection::vec(any::<bool>(), 18),
        materials in prop::collection::vec(-1..2_i32, 18),
        columns in prop::collection::vec(sketch(), 0..3),
    ) {
        let grid = geometry::shapes::fans(&geometry::shapes::grid(3, 3));
        let faces: Vec<Vec<u32>> = grid.faces().zip(&keep).filter(|&(_, &is)| is).map(|(f, _)| {
            grid.face_vertices(f).map(|v| u32::try_from(VertexId::index(v)).unwrap()).collect()
        }).collect();
        let heights = heights.into_iter().map(|x| f64::from(x) / 1024.0);
        let positions = grid.positions().iter().zip(heights).map(|(p, z)| p.with_z(z)).collect();
        let mut objects = made(positions, &faces, &columns);
        let mut mesh = (**objects[0].as_mesh().unwrap()).clone();
        let n = mesh.n_faces();
        mesh.set(MATERIAL, materials[..n].to_vec());
        objects[0] = Object { materials: objects[0].materials.clone(), ..Object::mesh("it", mesh) };
        for extension in ["obj", "ply", "off", "stl", "glb", "gltf"] {
            prop_assert_eq!(check_laws(&objects, extension).map_err(|why| format!("{extension}: {why}")), Ok(()));
        }
    }
}
