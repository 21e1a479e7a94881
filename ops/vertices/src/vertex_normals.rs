//! Vertex normals: a unit normal for every vertex, from the faces around it.
//!
//! ```text
//!           n                 n(v) = N / |N|,   N = sum over the faces f around v of w(f, v) n(f)
//!           ^
//!      .----|----.            weight     w(f, v)
//!     /  f  |  g  \           Area       area of f
//!    /______v______\          Angle      angle of f at v
//!    \     / \     /          Uniform    1
//!     \ i /   \ h /
//! ```
//!
//! n(f) is the unit normal of f. The area vector of f is half the sum of the cross products of consecutive corners
//! (Newell's method), and the area of f is the length of this vector. The area vector is also defined for polygons that
//! are not flat. With the weight `Area`, N is the sum of the area vectors.
//!
//! The best weight depends on the surface that the mesh approximates. Max, "Weights for Computing Vertex Normals
//! from Facet Normals", 1999, compares the weights. With `Angle`, the normals do not depend on how faces are
//! triangulated. Source: Thürmer and Wüthrich, "Computing Vertex Normals from Polygonal Facets", 1998.

mod gather;

use mesh::{CORNER_NORMAL, Domain, VERTEX_NORMAL};
use op::prelude::*;

pub use gather::normals;

/// Computes a unit normal for every vertex, from the faces around it.
///
/// The normals are written to the vertex attribute `normal`, which is replaced if it exists. Corner normals are
/// removed, because they would contradict the vertex normals. The normal of a vertex is the zero vector if the vertex
/// has no faces, if all its faces have zero area, or if their normals cancel each other out. The report counts these
/// vertices.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct VertexNormals {
    /// How the normals of the faces around a vertex are weighted.
    #[serde(default)]
    pub weight: Weight,
}

/// How much the normal of a face counts in the normal of one of its vertices.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Weight {
    /// The area of the face.
    #[default]
    Area,
    /// The angle of the face at the vertex. An angle above 180 degrees counts as its difference from 360 degrees.
    Angle,
    /// The same weight for all faces.
    Uniform,
}

impl MeshOperation for VertexNormals {
    const NAME: &'static str = "VertexNormals";
    const SUMMARY: &'static str = "Compute a unit normal for every vertex from the faces around it";
    const EXAMPLE: &'static str = "VertexNormals()";
    const WORDS: &'static [&'static str] = &["normals", "shade", "smooth"];

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        plan.drop_attribute(Domain::Corner, CORNER_NORMAL.name);
        plan.provide(Domain::Vertex, VERTEX_NORMAL.name);
        Vec::new()
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        cx.advance("normals", 0, 1)?;
        let (normals, without) = normals(mesh, self.weight);
        cx.advance("normals", 1, 1)?;
        mesh.remove_column(Domain::Corner, CORNER_NORMAL.name);
        mesh.set(VERTEX_NORMAL, normals);
        let report = Report::changed(mesh.n_vertices());
        Ok(if without == 0 {
            report
        } else {
            report.note(format!(
                "vertices without a normal: {without}; they have no faces, their faces have zero area, or the normals of their faces cancel out"
            ))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use mesh::{DVec3, VertexId};
    use op::test::{applied, try_applied};
    use proptest::prelude::*;
    use scene::{Object, Scene};

    const WEIGHTS: [Weight; 3] = [Weight::Area, Weight::Angle, Weight::Uniform];

    fn normals_of(mesh: Mesh, weight: Weight) -> Vec<DVec3> {
        let mesh = applied(&VertexNormals { weight }, mesh);
        mesh.get(VERTEX_NORMAL).unwrap().to_vec()
    }

    /// Computes vertex normals in another way, as a reference for the tests: every face adds its weighted normal to
    /// each of its vertices.
    fn scattered(mesh: &Mesh, weight: Weight) -> Vec<DVec3> {
        let mut sums = vec![DVec3::ZERO; mesh.n_vertices()];
        for f in mesh.faces() {
            for h in mesh.face_half_edges(f) {
                let w = match weight {
                    Weight::Area => mesh.face_area(f),
                    Weight::Angle => mesh.corner_angle(h),
                    Weight::Uniform => 1.0,
                };
                sums[mesh.origin(h).index()] += w * mesh.face_normal(f);
            }
        }
        sums.into_iter().map(DVec3::normalize_or_zero).collect()
    }

    /// Returns a closed fan of triangles around vertex 0, which is at height `peak`. `rim` contains, for each of the
    /// remaining vertices, its distance from the axis and its height.
    fn umbrella(rim: &[(f64, f64)], peak: f64) -> Mesh {
        let n = rim.len();
        let mut points = vec![DVec3::new(0.0, 0.0, peak)];
        points.extend(rim.iter().zip(0_u32..).map(|(&(r, z), i)| {
            let (sin, cos) = libm::sincos(std::f64::consts::TAU * f64::from(i) / n as f64);
            DVec3::new(r * cos, r * sin, z)
        }));
        let polygons: Vec<[u32; 3]> = (0..u32::try_from(n).unwrap())
            .map(|i| [0, 1 + i, 1 + (i + 1) % u32::try_from(n).unwrap()])
            .collect();
        Mesh::from_polygons(points, &polygons).unwrap().0
    }

    #[test]
    fn the_corners_of_a_cube_point_along_its_diagonals() {
        for weight in WEIGHTS {
            let cube = shapes::cube();
            for (n, p) in normals_of(cube.clone(), weight)
                .iter()
                .zip(cube.positions())
            {
                assert!(n.distance(p.normalize()) < 1e-15, "{weight:?} {n} {p}");
            }
        }
    }

    #[test]
    fn an_icosahedron_has_the_normals_of_its_sphere_under_all_weights() {
        for weight in WEIGHTS {
            let mesh = shapes::icosahedron();
            for (n, p) in normals_of(mesh.clone(), weight)
                .iter()
                .zip(mesh.positions())
            {
                assert!(n.distance(*p) < 1e-15, "{weight:?} {n} {p}");
            }
        }
    }

    #[test]
    fn normals_of_a_finer_sphere_are_closer_to_the_exact_normals() {
        for weight in WEIGHTS {
            let error = |n| {
                let sphere = shapes::uv_sphere(2 * n, n);
                let normals = normals_of(sphere.clone(), weight);
                let errors = normals
                    .iter()
                    .zip(sphere.positions())
                    .map(|(n, p)| n.distance(*p));
                errors.fold(0.0, f64::max)
            };
            let (coarse, fine) = (error(16), error(32));
            assert!(
                fine < coarse / 1.9 && fine < 0.03,
                "{weight:?} {coarse} {fine}"
            );
        }
    }

    #[test]
    fn the_area_weighted_normal_depends_on_the_rim_only() {
        // For any position of the center, the sum of the area vectors of a closed fan is the area vector of its rim.
        let rim = [
            (1.0, 0.0),
            (2.0, 0.5),
            (1.5, -0.25),
            (1.0, 0.75),
            (0.5, 0.0),
        ];
        let low = normals_of(umbrella(&rim, -3.0), Weight::Area)[0];
        let high = normals_of(umbrella(&rim, 7.0), Weight::Area)[0];
        assert!(low.distance(high) < 1e-14);
        let low = normals_of(umbrella(&rim, -3.0), Weight::Uniform)[0];
        let high = normals_of(umbrella(&rim, 7.0), Weight::Uniform)[0];
        assert!(low.distance(high) > 1e-3);
    }

    #[test]
    fn the_angle_weighted_normal_does_not_depend_on_the_triangulation() {
        let whole = shapes::cube();
        let mut polygons: Vec<Vec<u32>> = Vec::new();
        for f in whole.faces() {
            let c: Vec<u32> = whole
                .face_vertices(f)
                .map(|v| u32::try_from(v.index()).unwrap())
                .collect();
            polygons.push(vec![c[0], c[1], c[2]]);
            polygons.push(vec![c[0], c[2], c[3]]);
        }
        let (cut, _) = Mesh::from_polygons(whole.positions().to_vec(), &polygons).unwrap();
        let pairs = normals_of(cut, Weight::Angle)
            .into_iter()
            .zip(normals_of(whole, Weight::Angle));
        assert!(pairs.into_iter().all(|(a, b)| a.distance(b) < 1e-15));
    }

    #[test]
    fn isolated_vertices_and_faces_that_cancel_get_zero_and_are_counted() {
        let points = vec![DVec3::ZERO, DVec3::X * 0.1, DVec3::Y * 0.3, DVec3::Z];
        // The mesh consists of two triangles with the same vertices and opposite orientations, and of the isolated
        // vertex 3.
        let (mesh, _) = Mesh::from_polygons(points, &[[0, 1, 2], [0, 2, 1]]).unwrap();
        for weight in WEIGHTS {
            let (mesh, report) = try_applied(&VertexNormals { weight }, mesh.clone()).unwrap();
            assert_eq!(mesh.get(VERTEX_NORMAL).unwrap(), [DVec3::ZERO; 4]);
            assert!(report.notes[0].starts_with("vertices without a normal: 4;"));
        }
    }

    #[test]
    fn very_small_and_very_large_meshes_have_the_same_normals() {
        for weight in WEIGHTS {
            let expected = normals_of(shapes::torus(7, 5, 2.0, 0.5), weight);
            for scale in [1e-300, 1e-150, 1e150, 1e300] {
                let mut mesh = shapes::torus(7, 5, 2.0, 0.5);
                mesh.positions_mut().iter_mut().for_each(|p| *p *= scale);
                for (n, e) in normals_of(mesh, weight).iter().zip(&expected) {
                    assert!(n.distance(*e) < 1e-12, "{weight:?} {scale} {n} {e}");
                }
            }
        }
    }

    #[test]
    fn a_mesh_of_one_point_has_no_normals() {
        let mut mesh = shapes::cube();
        mesh.positions_mut().fill(DVec3::new(1e300, -1e300, 1.0));
        for weight in WEIGHTS {
            assert_eq!(normals_of(mesh.clone(), weight), [DVec3::ZERO; 8]);
        }
    }

    #[test]
    fn corner_normals_are_removed_and_the_loss_is_reported() {
        let mut mesh = shapes::cube();
        mesh.set(CORNER_NORMAL, vec![DVec3::Z; mesh.n_half_edges()]);
        let (after, report) = try_applied(&VertexNormals::default(), mesh).unwrap();
        assert!(after.get(CORNER_NORMAL).is_none());
        assert_eq!(report.losses.len(), 1);
        assert_eq!(report.losses[0].what, "the corner attribute \"normal\"");
    }

    #[test]
    fn an_empty_mesh_gets_no_normals() {
        assert_eq!(normals_of(Mesh::default(), Weight::Area), []);
    }

    #[test]
    fn the_number_of_threads_changes_nothing() {
        let mesh = shapes::torus(97, 61, 2.0, 0.7);
        for weight in WEIGHTS {
            let with = |threads| {
                let pool = rayon::ThreadPoolBuilder::new()
                    .num_threads(threads)
                    .build()
                    .unwrap();
                pool.install(|| normals_of(mesh.clone(), weight))
            };
            assert_eq!(with(1), with(2));
            assert_eq!(with(1), with(8));
        }
    }

    #[test]
    fn all_meshes_of_a_scene_get_normals() {
        let mut scene = Scene::new();
        for name in ["a", "b"] {
            scene.insert(Object::mesh(name, shapes::cube())).unwrap();
        }
        let report = op::test::run(&VertexNormals::default(), &mut scene).unwrap();
        assert_eq!(report.changed, 16);
        let has = |o: &Object| o.as_mesh().unwrap().get(VERTEX_NORMAL).is_some();
        assert!(scene.objects().iter().all(has));
    }

    #[test]
    fn parameters_are_read() {
        let parse = |text| op::test::read::<VertexNormals>(text);
        assert_eq!(parse("()").unwrap().weight, Weight::Area);
        assert_eq!(parse("(weight: Angle)").unwrap().weight, Weight::Angle);
        assert!(parse("(weight: Volume)").is_err());
    }

    proptest! {
        #[test]
        fn gathering_and_scattering_agree(
            moves in prop::collection::vec(prop::array::uniform3(-0.3..0.3_f64), 64),
            which in 0..4_usize,
            weight in prop::sample::select(&WEIGHTS),
        ) {
            let mut mesh = [
                shapes::grid(5, 4),
                shapes::torus(6, 5, 2.0, 0.7),
                shapes::cylinder(9, true),
                shapes::uv_sphere(6, 5),
            ][which].clone();
            for (p, m) in mesh.positions_mut().iter_mut().zip(moves) {
                *p += DVec3::from_array(m);
            }
            let expected = scattered(&mesh, weight);
            let found = normals_of(mesh.clone(), weight);
            for v in mesh.vertices().map(VertexId::index) {
                // The tolerance is large because rounding errors dominate where the normals of the faces nearly cancel
                // each other out.
                prop_assert!(found[v].distance(expected[v]) < 1e-9, "{v} {} {}", found[v], expected[v]);
            }
        }
    }
}
