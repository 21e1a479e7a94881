//! The steps with which general properties are tested. The list contains the example of each operation, and the steps
//! below.

use op::{Entry, Registry};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::Index;
use ron_tree::{Lexer, ValueKind};

const MORE_STEPS: &[&str] = &[
    r#"Load(path: "curve.bzc", name: "new")"#,
    r#"Load(path: "bunny.obj", non_manifold: Refuse)"#,
    // These polygons have a bow-tie vertex, which is split, and a point without a face.
    r#"Polygons(name: "new", points: [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (-1, 0, 0),
        (-1, -1, 0)], faces: [[0, 1, 2], [0, 4, 5]])"#,
    r#"Polygons(name: "new", points: [(0, 0, 0)], faces: [[0, 1, 2]])"#,
    r#"Cube(name: "new", triangles: true)"#,
    r#"Cube(name: "mesh")"#,
    r#"Tetrahedron(name: "new", radius: 0.5)"#,
    r#"Octahedron(name: "new", radius: 0.5)"#,
    r#"Icosahedron(name: "new", radius: 0.5)"#,
    r#"Grid(name: "new", columns: 70, rows: 70, size: 0.1, center: (0, 0, 1))"#,
    r#"Cylinder(name: "new", around: 6, radius: 1, height: 2, caps: false)"#,
    "Tessellate(segments: 1, faces: Quads, uvs: true, normals: true)",
    "Tessellate(segments: 5, faces: Triangles, uvs: true, normals: true)",
    "SampleCurve(segments: 9)",
    "CurveLevels(t: 0.25)",
    "MoveControlPoint(index: 99, to: (0, 0))",
    r#"Copy(from: "curve", to: "new")"#,
    r#"Delete(objects: ["patches", "curve"])"#,
    r#"Rename(from: "mesh", to: "other")"#,
    r#"Join(objects: ["other", "mesh"], name: "mesh", tag_parts: false)"#,
    r#"Join(objects: ["mesh"], name: "alone")"#,
    "Unwrap(seams: Longest(count: 3), max_angle: 30, page: 64, padding: 0, uv: \"light\")",
    "Unwrap(on_refusal: Skip, max_stretch: 1.5)",
    "PackUvs(page: 128, padding: 1)",
    r#"Scatter(object: "curve", surface: "mesh", count: 3, align: Y)"#,
    "Symmetrize(normal: (1, 2, 3), point: (0.2, 0.1, 0), from: Back)",
    "Lattice(size: (2, 3, 4), moves: [((1, 2, 3), (1, 0, 0)), ((0, 0, 0), (0, 9, 0))], max: (0, 0, 0))",
    "Transform(scale: (2, 1, 0.5), move: (1, 2, 3))",
    "Transform(scale: (-1, 1, 1), about: Center)",
    "Transform(rotate: [(axis: Z, angle: 90), (axis: X, angle: 33)], about: Point(1, 0, 0))",
    "Transform(rotate: [(axis: Z, angle: 30)])",
    r#"Separate(object: "mesh", count: 2)"#,
    r#"Separate(object: "mesh", by: Material, count: 3)"#,
    r#"Separate(object: "mesh", by: Tag("marked"), count: 2)"#,
    "Bisect(normal: (1, 2, 3), point: (0.3, 0.2, 0.1), keep: Front)",
    r#"Bisect(normal: (1, 0, 0), keep: Back, tag: "cut")"#,
    r#"Bisect(normal: (1, 1, 0), point: (0.5, 0.5, 0), tag: "marked")"#,
    "Reverse(faces: Faces([0, 1, 2, 3]))",
    r#"Reverse(faces: Tagged("marked"))"#,
    "Triangulate(faces: Degree(5))",
    "Triangulate(faces: Faces([0]))",
    "FlipEdges(edges: All, on_refusal: Skip)",
    "FlipEdges(edges: Random(count: 9, seed: 7), on_refusal: Skip, seams: Drop)",
    "FlipEdges(edges: Between(0, 2))",
    r#"FlipEdges(edges: Tagged("marked"), on_refusal: Skip)"#,
    "FlipEdges(edges: All, until: Delaunay)",
    "FlipEdges(edges: Flat(below: 30), until: Delaunay, passes: 2, seams: Drop)",
    "FlipEdges(edges: All, until: Valence)",
    "SplitEdges(edges: Boundary, at: 0.25)",
    "SplitEdges(edges: Between(1, 0), at: 0.125)",
    "SplitEdges(edges: Expect(count: 3, of: Longest(count: 3)), on_refusal: Skip)",
    "SplitEdges(edges: EdgesOf(Grow(Faces([0]))))",
    "PokeFaces(faces: Degree(4), distance: 0.25)",
    "PokeFaces(faces: Random(count: 3, seed: 7), on_refusal: Skip)",
    r#"PokeFaces(faces: Tagged("marked"))"#,
    "SplitFaces(between: [(0, 3)])",
    "SplitFaces(between: [(0, 5), (6, 1), (2, 2), (0, 99), (0, 3)], on_refusal: Skip)",
    "DeleteFaces(faces: Faces([0]), keep_vertices: true)",
    "DeleteFaces(faces: FacesAround(Nearest(to: (1, 1, 1))))",
    "DeleteFaces(faces: Random(count: 9, seed: 7), on_refusal: Skip)",
    r#"DeleteFaces(faces: Tagged("marked"), on_refusal: Skip)"#,
    "DissolveEdges(edges: Longest(count: 1))",
    "DissolveEdges(edges: All, on_refusal: Skip)",
    "DissolveEdges(edges: Random(count: 9, seed: 7), on_refusal: Skip, seams: Drop)",
    "DissolveVertices(vertices: All, on_refusal: Skip)",
    "DissolveVertices(vertices: Random(count: 5, seed: 7), on_refusal: Skip, seams: Drop)",
    r#"ExtrudeFaces(faces: Boundary, by: Offset((0, 0, 1)), tag: "marked")"#,
    r#"ExtrudeFaces(faces: Random(count: 9, seed: 3), by: Distance(-0.25), scale: 0.5, tag: "new")"#,
    "ExtrudeFaces(faces: All, by: Offset((1, 2, 3)), scale: 2, rotate: [(axis: Z, angle: 30)])",
    "InsetFaces(faces: Degree(4), fraction: 0.5, on_refusal: Skip)",
    "InsetFaces(faces: Expect(count: 2, of: Random(count: 2, seed: 5)), fraction: 0.125)",
    "BevelFaces(faces: Faces([0]), fraction: 0.5, distance: -0.25)",
    "BevelFaces(faces: Boundary, fraction: 0.75, distance: 0, on_refusal: Skip)",
    "BevelEdges(edges: All, fraction: 0.25, on_refusal: Skip)",
    "BevelEdges(edges: Random(count: 20, seed: 2), width: 0.05, on_refusal: Skip)",
    "BevelVertices(vertices: All, fraction: 0.5, on_refusal: Skip)",
    "BevelVertices(vertices: Vertices([0]), fraction: 0.75)",
    "Stitch(distance: 0.5)",
    "Stitch(distance: 0.001, on_refusal: Skip)",
    "Stitch(distance: 100, on_refusal: Skip)",
    "Cut(edges: All, on_refusal: Skip)",
    "Cut(edges: Sharp(above: 30))",
    "Cut(edges: EdgesOf(Faces([0])), on_refusal: Skip)",
    "Cut(edges: Random(count: 9, seed: 7), on_refusal: Skip)",
    "FillHoles(with: Face)",
    "FillHoles(around: Vertices([0]), with: Face, on_refusal: Skip)",
    "FillHoles(around: Boundary, max_edges: 4, on_refusal: Skip)",
    "BridgeLoops(first: 0, second: 3)",
    "BridgeLoops(first: 3, second: 0)",
    "CollapseEdges(edges: Between(0, 1))",
    "CollapseEdges(edges: Between(1, 0), at: 0.125)",
    "CollapseEdges(edges: Boundary, at: 1, on_refusal: Skip)",
    "CollapseEdges(edges: Longest(count: 1), at: 0)",
    "CollapseEdges(edges: Random(count: 9, seed: 7), on_refusal: Skip)",
    r#"CollapseEdges(edges: Tagged("marked"), on_refusal: Skip)"#,
    "Crease(edges: Boundary, vertices: Boundary, sharpness: 10)",
    "Crease(vertices: Vertices([0]), sharpness: 1)",
    "Crease(edges: All, sharpness: 0)",
    r#"TagVertices(name: "some", vertices: Component(Vertices([0])))"#,
    r#"TagEdges(name: "some", edges: EdgeRing(Random(count: 3, seed: 1)))"#,
    r#"TagEdges(name: "some", edges: Path(from: 0, to: 1))"#,
    r#"TagFaces(name: "some", faces: Expand(to_angle: 30, of: Faces([0])))"#,
    "LoopSubdivide(levels: 1)",
    "LoopSubdivide(levels: 2)",
    "LoopSubdivide(weights: Loop, boundary: Fixed, face_varying: Boundaries, to_limit: true)",
    "LoopSubdivide(until: EdgeLength(below: 0.4), levels: 5)",
    "LoopSubdivide(levels: 2, faces: Random(count: 2, seed: 3))",
    "CatmullClark(levels: 1)",
    "CatmullClark(levels: 2, boundary: EdgesAndCorners, creasing: Chaikin, face_varying: CornersPlus1)",
    "CatmullClark(levels: 1, to_limit: true)",
    "CatmullClark(until: LimitDistance(below: 0.05), levels: 4)",
    "CatmullClark(levels: 2, faces: Random(count: 2, seed: 3))",
    "Midpoint(levels: 1)",
    "Midpoint(levels: 2, into: Quads)",
    "Midpoint(levels: 1, faces: Random(count: 2, seed: 3))",
    "Butterfly(levels: 1)",
    "Butterfly(levels: 2)",
    "Sqrt3(levels: 1)",
    "Sqrt3(levels: 2)",
    "DooSabin(levels: 1)",
    "DooSabin(levels: 2)",
    "Weld(distance: 0.5)",
    "Weld(distance: 100)",
    "Smooth(by: Laplacian(), passes: 2, boundary: Free)",
    "Smooth(by: Laplacian(weights: Cotangent, factor: 1), pin: Boundary, passes: 3)",
    "Smooth(by: Taubin(weights: Cotangent), vertices: Random(count: 4, seed: 1), boundary: Free)",
    "Smooth(by: Implicit(time: 0.1))",
    "Smooth(by: Implicit(time: 1e300), passes: 2, boundary: Free)",
    "Smooth(by: Denoise(), passes: 3)",
    "Smooth(by: Denoise(angle: 0), boundary: Free, keep_volume: true)",
    "MoveVertices(vertices: Random(count: 2, seed: 1), by: Distance(-0.1), falloff: 0.7)",
    "MoveVertices(vertices: Vertices([0]), by: To((1, 2, 3)))",
    "Displace(by: Random(seed: 3), distance: 0.01, vertices: Boundary)",
    r#"Displace(by: Attribute(name: "height"), distance: 1)"#,
    "Measure(of: GaussianCurvature)",
    "Measure(of: PrincipalCurvature(Largest), name: \"k\")",
    "Measure(of: VertexArea)",
    "Measure(of: MinAngle, missing: 3)",
    "Measure(of: AspectRatio)",
    r#"Measure(of: Distance(to: "mesh"))"#,
    r#"Measure(of: Distance(to: "other", signed: true), name: "height")"#,
    "Measure(of: Geodesic(from: Vertices([0])))",
    "Measure(of: Thickness)",
    "Measure(of: Occlusion(rays: 8, seed: 3))",
    r#"Measure(of: Winding(of: "mesh"))"#,
    "Bend(axis: X, angle: -200, towards: Z, about: (0.1, 0.2, 0.3), from: 0)",
    "Twist(axis: Y, angle: 720, from: -0.5, to: 0.5, vertices: Random(count: 4, seed: 1))",
    "Taper(axis: X, factor: 2, to: 0.5)",
    "VertexNormals(weight: Angle)",
    "VertexNormals(weight: Uniform)",
    r#"Tangents(uv: "uv1")"#,
    r#"Picture(path: "b/a.png", size: (32, 24), views: [Fit(from: Front), Fit(from: Top, projection: Orthographic)], style: (shading: Flat, background: Transparent))"#,
    r#"Picture(path: "valence.png", size: (48, 36), color_by: (of: Valence))"#,
    r#"Picture(path: "a.gif", size: (24, 18), turntable: (frames: 3), style: (shading: Matcap, boundary: (), ids: Vertices))"#,
    r#"CurveFigure(path: "a/figure.png", width: 100, scale: 1)"#,
    r#"CurveFigure(path: "figure.svg", t: [], labels: false, legend: false)"#,
    r#"Save(path: "b/a.glb")"#,
    r#"Save(path: "a.gltf")"#,
    r#"Save(path: "a.bez")"#,
    r#"Save(path: "a.bzc")"#,
    r#"PokeFaces(faces: InsideOf("other"), on_refusal: Skip)"#,
    "PokeFaces(faces: SelfIntersecting)",
    r#"Project(onto: "mesh")"#,
    r#"Project(onto: "mesh", along: Normal, distance: 0.5)"#,
    r#"Project(onto: "other", along: Direction((1, 2, 3)), vertices: Boundary)"#,
    r#"Transfer(from: "mesh", attributes: ["uv"])"#,
    r#"Transfer(from: "mesh", attributes: ["uv"], within: 0.1)"#,
    r#"Transfer(from: "other", attributes: ["uv", "color"])"#,
];

/// Returns operations with samples of their parameters, such as `(levels: 2)`. Most of these operations need an
/// existing mesh.
pub(crate) fn samples(registry: &Registry) -> Vec<(&Entry, &'static str)> {
    let examples = registry.entries().iter().map(|entry| entry.example);
    examples
        .chain(MORE_STEPS.iter().copied())
        .map(|step| {
            let (name, _) = step.split_once('(').expect("a step has parameters");
            let entry = registry.get(name);
            (
                entry.unwrap_or_else(|| panic!("{step}: unknown operation")),
                &step[name.len()..],
            )
        })
        .collect()
}

#[test]
fn every_example_is_a_step_of_its_operation() {
    let registry = ops_all::registry();
    for (entry, (example_entry, parameters)) in registry.entries().iter().zip(samples(&registry)) {
        assert_eq!(
            entry.name, example_entry.name,
            "{} is the example of a different operation",
            entry.example
        );
        assert!(!parameters.contains('\n'), "an example is one line");
    }
    for (entry, parameters) in samples(&registry) {
        if let Err(error) = entry.parse(&ron_tree::parse(parameters).value) {
            panic!("{}{parameters}: {error}", entry.name);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4000, ..ProptestConfig::default() })]

    /// Checks that the recipe parser and the crate `ron` read the same step from a sample or a slightly changed sample,
    /// or both fail. Samples with syntax errors are skipped.
    #[test]
    fn samples_are_read_as_ron_reads_them(
        at in any::<Index>(),
        edits in vec((0_usize..4, any::<Index>(), any::<Index>()), 0..3),
    ) {
        let registry = ops_all::registry();
        let samples = samples(&registry);
        let (entry, parameters) = samples[at.index(samples.len())];
        let mut tokens: Vec<&str> = Lexer::new(parameters).map(|t| t.span.of(parameters)).collect();
        for (edit, at, other) in edits {
            let (i, j) = (at.index(tokens.len()), other.index(tokens.len()));
            match edit {
                0 => _ = tokens.remove(i),
                1 => tokens.insert(i, tokens[j]),
                2 => tokens[i] = ["-1", "1.5", "()", "None", "All", "inf"][other.index(6)],
                _ => tokens.swap(i, j),
            }
            if tokens.is_empty() {
                return Ok(());
            }
        }
        let parsed = ron_tree::parse(&tokens.concat());
        if parsed.diagnostics.is_empty() && matches!(parsed.value.kind, ValueKind::Struct(_) | ValueKind::Unit) {
            let by_tree = entry.parse(&parsed.value);
            // The crate `ron` does not accept white space in some places, so it reads the value as `ron_tree` prints
            // it.
            match entry.parse_by_ron(&parsed.value.to_string()) {
                Ok(step) => prop_assert_eq!(by_tree.unwrap().canonical(), step.canonical()),
                Err(error) => prop_assert!(by_tree.is_err(), "{}: {error}", tokens.concat()),
            }
        }
    }
}

#[test]
fn every_sample_is_read_as_ron_reads_it() {
    let registry = ops_all::registry();
    for (entry, parameters) in samples(&registry) {
        let by_tree = entry.parse(&ron_tree::parse(parameters).value).unwrap();
        let by_ron = entry.parse_by_ron(parameters).unwrap();
        assert_eq!(
            by_tree.canonical(),
            by_ron.canonical(),
            "{}{parameters}",
            entry.name
        );
    }
}
