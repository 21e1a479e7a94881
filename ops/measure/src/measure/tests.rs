use geometry::shapes;
use mesh::DVec3;
use op::test::{read, run, try_applied};
use scene::Object;

use super::*;

fn parse(text: &str) -> Measure {
    read(text).unwrap()
}

/// Runs the step. Returns the values of the new attribute, and the notes of the report.
fn measured(text: &str, mesh: Mesh) -> (Vec<f64>, Vec<String>) {
    let step = parse(text);
    let (mesh, report) = try_applied(&step, mesh).unwrap();
    (values(&mesh, step.of.domain(), step.name()), report.notes)
}

fn values(mesh: &Mesh, domain: Domain, name: &str) -> Vec<f64> {
    match &mesh.attributes().column(domain, name).unwrap().values {
        Values::Float(values) => values.clone(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn faces_and_vertices_get_numbers_and_a_note() {
    let (areas, notes) = measured("(of: Area)", shapes::cube());
    assert_eq!(areas, [4.0; 6]);
    assert_eq!(notes, ["\"mesh\": area from 4 to 4, mean 4"]);
    assert_eq!(measured("(of: VertexArea)", shapes::cube()).0, [3.0; 8]);
    let (angles, _) = measured("(of: MinAngle, name: \"a b\")", shapes::cube());
    assert!(angles.iter().all(|angle| (angle - 90.0).abs() < 1e-12));
    let (ratios, _) = measured("(of: AspectRatio)", shapes::icosahedron());
    assert!(ratios.iter().all(|ratio| (ratio - 1.0).abs() < 1e-12));
}

#[test]
fn gauss_bonnet_holds_for_the_attributes() {
    let mesh = shapes::torus(12, 8, 2.0, 0.5);
    let (curvature, _) = measured("(of: GaussianCurvature)", mesh.clone());
    let (area, _) = measured("(of: VertexArea)", mesh);
    let total: f64 = curvature.iter().zip(area).map(|(k, a)| k * a).sum();
    assert!(total.abs() < 1e-9, "{total}");
}

#[test]
fn curvatures_of_a_sphere_are_one() {
    for of in [
        "MeanCurvature",
        "PrincipalCurvature(Largest)",
        "PrincipalCurvature(Smallest)",
    ] {
        let (values, _) = measured(&format!("(of: {of})"), shapes::uv_sphere(64, 32));
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        assert!((mean - 1.0).abs() < 0.02, "{of} {mean}");
    }
}

#[test]
fn elements_without_a_value_are_counted() {
    let mut mesh = shapes::cube();
    mesh.positions_mut().fill(DVec3::ONE);
    let (ratios, notes) = measured("(of: AspectRatio)", mesh.clone());
    assert_eq!(ratios, [-1.0; 6]);
    assert_eq!(
        notes,
        [
            "\"mesh\": elements that get the value -1, because aspect_ratio is not defined for them: 6"
        ]
    );
    let (curvatures, _) = measured("(of: MeanCurvature)", mesh.clone());
    assert_eq!(curvatures, [0.0; 8]);
    let (curvatures, _) = measured("(of: MeanCurvature, missing: 7)", mesh);
    assert_eq!(curvatures, [7.0; 8]);
}

#[test]
fn only_attributes_of_the_same_elements_and_type_are_replaced() {
    let (twice, _) = try_applied(&parse("(of: Area, name: \"x\")"), shapes::cube()).unwrap();
    let (again, _) = try_applied(&parse("(of: MinAngle, name: \"x\")"), twice.clone()).unwrap();
    let angles = values(&again, Domain::Face, "x");
    assert!((angles[0] - 90.0).abs() < 1e-12);
    let refused = try_applied(&parse("(of: MeanCurvature, name: \"x\")"), twice);
    let message = refused.unwrap_err().to_string();
    assert!(
        message.contains("already has the face attribute \"x\""),
        "{message}"
    );
    for name in ["uv", "normal", "", "joint:0"] {
        let text = format!("(of: Area, name: \"{name}\")");
        assert!(read::<Measure>(&text).is_err(), "{name}");
    }
}

#[test]
fn distances_are_measured_to_the_other_object_which_stays() {
    let mut scene = nested();
    let report = run(&parse("(of: Distance(to: \"b\"))"), &mut scene).unwrap();
    assert_eq!(report.notes, ["\"a\": distance from 2 to 2, mean 2"]);
    let mesh = |name: &str| scene.object(name).unwrap().as_mesh().unwrap();
    assert_eq!(values(mesh("a"), Domain::Vertex, "distance"), [2.0; 8]);
    assert_eq!(mesh("b").attributes().iter().count(), 0);
    let unknown = run(&parse("(of: Distance(to: \"c\"))"), &mut scene.clone());
    assert!(matches!(unknown, Err(OpError::Object(_))));
}

/// Returns a scene with a large cube "b" around a cube "a".
fn nested() -> Scene {
    let mut large = shapes::cube();
    for p in large.positions_mut() {
        *p *= 3.0;
    }
    let mut scene = Scene::new();
    scene.insert(Object::mesh("a", shapes::cube())).unwrap();
    scene.insert(Object::mesh("b", large)).unwrap();
    scene
}

#[test]
fn signed_distances_are_negative_inside() {
    for (text, expected) in [
        ("(of: Distance(to: \"b\", signed: true))", -2.0),
        ("(of: Winding(of: \"b\"))", 1.0),
    ] {
        let (mut scene, step) = (nested(), parse(text));
        run(&step, &mut scene).unwrap();
        let mesh = scene.object("a").unwrap().as_mesh().unwrap();
        for x in values(mesh, Domain::Vertex, step.name()) {
            assert!((x - expected).abs() < 0.01, "{x}");
        }
    }
}

#[test]
fn geodesics_start_at_the_selected_vertices() {
    let text = "(of: Geodesic(from: Vertices([0])), missing: 99)";
    let (found, _) = measured(text, shapes::cube());
    assert_eq!(found[0], 0.0);
    assert!(found[1..].iter().all(|d| *d > 1.0 && *d < 5.0), "{found:?}");
    // The farthest vertex is the opposite corner of the cube. The shortest path to it crosses two sides and has the
    // length 2 √5.
    let (far, _) =
        (found.iter().zip(0..)).fold((0.0, 0), |a, (d, v)| if *d > a.0 { (*d, v) } else { a });
    assert!((far - 20_f64.sqrt()).abs() < 0.5, "{far}");
    let (unreached, notes) = measured("(of: Geodesic(from: Not(All)))", shapes::cube());
    assert_eq!(unreached, [-1.0; 8]);
    assert_eq!(
        notes,
        ["\"mesh\": elements that get the value -1, because geodesic is not defined for them: 8"]
    );
    assert!(read::<Measure>("(of: Geodesic())").is_err());
}

#[test]
fn thickness_and_occlusion_are_measured_by_rays() {
    let (found, _) = measured("(of: Thickness, name: \"wall\")", shapes::cube());
    assert!(found.iter().all(|d| (d - 2.0).abs() < 1e-6), "{found:?}");
    let (found, _) = measured("(of: Thickness)", shapes::grid(2, 2));
    assert_eq!(found, [-1.0; 9]);
    let (found, _) = measured("(of: Occlusion())", shapes::cube());
    assert_eq!(found, [0.0; 8]);
    assert!(read::<Measure>("(of: Occlusion(rays: 0))").is_err());
}

#[test]
fn every_quantity_scales_exactly_or_is_refused() {
    let scene = |factor: f64| {
        let mut scene = Scene::new();
        for (name, mut mesh) in [
            ("mesh", shapes::torus(12, 8, 2.0, 0.5)),
            ("other", shapes::torus(10, 6, 2.1, 0.6)),
        ] {
            mesh.positions_mut().iter_mut().for_each(|p| *p *= factor);
            scene
                .insert(Object::new(name, Geometry::Mesh(mesh.into())))
                .unwrap();
        }
        scene
    };
    for (of, dimension) in [
        ("MeanCurvature", -1),
        ("GaussianCurvature", -2),
        ("PrincipalCurvature(Largest)", -1),
        ("PrincipalCurvature(Smallest)", -1),
        ("Area", 2),
        ("VertexArea", 2),
        ("MinAngle", 0),
        ("AspectRatio", 0),
        ("Distance(to: \"other\")", 1),
        ("Distance(to: \"other\", signed: true)", 1),
        ("Geodesic(from: Vertices([0]))", 1),
        ("Thickness", 1),
        ("Occlusion(rays: 16)", 0),
        ("Winding(of: \"other\")", 0),
    ] {
        let step = parse(&format!("(of: {of}, name: \"x\")"));
        let at = |k: i32| -> Result<Vec<f64>, OpError> {
            let mut scene = scene(libm::scalbn(1.0, k));
            run(&step, &mut scene)?;
            let mesh = scene.object("mesh").unwrap().as_mesh().unwrap();
            Ok(values(mesh, step.of.domain(), "x"))
        };
        let expected = at(0).unwrap();
        for k in [-500, -300, 300, 500] {
            let expected = expected.iter().map(|x| libm::scalbn(*x, dimension * k));
            let expected: Vec<f64> = expected.collect();
            match at(k) {
                Ok(found) => assert_eq!(found, expected, "{of} 2^{k}"),
                // At the scale 2^500, Gaussian curvatures that are nearly 0 underflow.
                Err(OpError::Refused { .. }) => assert_eq!((dimension, k), (-2, 500)),
                Err(other) => panic!("{of} 2^{k}: {other}"),
            }
        }
        for k in [-700, 700] {
            let is_refused = matches!(at(k), Err(OpError::Refused { .. }));
            assert_eq!(is_refused, dimension.abs() == 2, "{of} 2^{k}");
        }
    }
}
