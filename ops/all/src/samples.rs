//! Parameters of each operation as recipes write them: the first ones stand in the reference, and all of them
//! are tried in the tests.

const SAMPLES: &[(&str, &[&str])] = &[
    (
        "Load",
        &[
            r#"(path: "teapot.bez")"#,
            r#"(path: "curve.bzc", name: "new")"#,
            r#"(path: "bunny.obj", non_manifold: Refuse)"#,
        ],
    ),
    (
        "Polygons",
        &[
            r#"(name: "new", points: [(0, 0, 0), (1, 0, 0), (0, 1, 0)], faces: [[0, 1, 2]])"#,
            // A bow-tie, which is split, and a point without a face.
            r#"(name: "new", points: [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (-1, 0, 0),
                (-1, -1, 0)], faces: [[0, 1, 2], [0, 4, 5]])"#,
            r#"(name: "new", points: [(0, 0, 0)], faces: [[0, 1, 2]])"#,
        ],
    ),
    (
        "Cube",
        &[
            r#"(name: "new", size: 3, center: (1, 2, 3))"#,
            r#"(name: "new", triangles: true)"#,
            r#"(name: "mesh")"#,
        ],
    ),
    (
        "Tetrahedron",
        &[r#"(name: "new")"#, r#"(name: "new", radius: 0.5)"#],
    ),
    (
        "Octahedron",
        &[r#"(name: "new")"#, r#"(name: "new", radius: 0.5)"#],
    ),
    (
        "Icosahedron",
        &[r#"(name: "new")"#, r#"(name: "new", radius: 0.5)"#],
    ),
    (
        "Grid",
        &[
            r#"(name: "new", columns: 3, rows: 2)"#,
            r#"(name: "new", columns: 70, rows: 70, size: 0.1, center: (0, 0, 1))"#,
        ],
    ),
    (
        "Torus",
        &[r#"(name: "new", around: 7, across: 5, major: 2, minor: 0.5)"#],
    ),
    (
        "Cylinder",
        &[
            r#"(name: "new", around: 6, radius: 1, height: 2, caps: true)"#,
            r#"(name: "new", around: 6, radius: 1, height: 2, caps: false)"#,
        ],
    ),
    (
        "UvSphere",
        &[r#"(name: "new", around: 8, rings: 4, radius: 2)"#],
    ),
    (
        "Tessellate",
        &[
            "(segments: 3)",
            "(segments: 1, faces: Quads, uvs: true, normals: true)",
            "(segments: 5, faces: Triangles, uvs: true, normals: true)",
        ],
    ),
    ("SampleCurve", &["(segments: 1)", "(segments: 9)"]),
    ("CurveLevels", &["(t: 0)", "(t: 0.25)"]),
    (
        "MoveControlPoint",
        &["(index: 1, to: (2, -3.5))", "(index: 99, to: (0, 0))"],
    ),
    (
        "Copy",
        &[
            r#"(from: "mesh", to: "new")"#,
            r#"(from: "curve", to: "new")"#,
        ],
    ),
    (
        "Delete",
        &[
            r#"(objects: ["mesh"])"#,
            r#"(objects: ["patches", "curve"])"#,
        ],
    ),
    (
        "Rename",
        &[
            r#"(from: "mesh", to: "new")"#,
            r#"(from: "mesh", to: "other")"#,
        ],
    ),
    (
        "Join",
        &[
            r#"(objects: ["mesh", "other"], name: "joined")"#,
            r#"(objects: ["other", "mesh"], name: "mesh", tag_parts: false)"#,
            r#"(objects: ["mesh"], name: "alone")"#,
        ],
    ),
    (
        "Transform",
        &[
            "()",
            "(scale: (2, 1, 0.5), move: (1, 2, 3))",
            "(scale: (-1, 1, 1), about: Center)",
            "(rotate: [(axis: Z, angle: 90), (axis: X, angle: 33)], about: Point(1, 0, 0))",
            "(rotate: [(axis: Z, angle: 30)])",
        ],
    ),
    (
        "Separate",
        &[
            r#"(object: "mesh")"#,
            r#"(object: "mesh", count: 2)"#,
            r#"(object: "mesh", by: Material, count: 3)"#,
            r#"(object: "mesh", by: Tag("marked"), count: 2)"#,
        ],
    ),
    (
        "Bisect",
        &[
            "(normal: (0, 0, 1))",
            "(normal: (1, 2, 3), point: (0.3, 0.2, 0.1), keep: Front)",
            r#"(normal: (1, 0, 0), keep: Back, tag: "cut")"#,
            r#"(normal: (1, 1, 0), point: (0.5, 0.5, 0), tag: "marked")"#,
        ],
    ),
    (
        "Reverse",
        &[
            "()",
            "(faces: Faces([0, 1, 2, 3]))",
            r#"(faces: Tagged("marked"))"#,
        ],
    ),
    (
        "Triangulate",
        &["()", "(faces: Degree(5))", "(faces: Faces([0]))"],
    ),
    (
        "FlipEdges",
        &[
            "(edges: All)",
            "(edges: All, on_refusal: Skip)",
            "(edges: Random(count: 9, seed: 7), on_refusal: Skip, seams: Drop)",
            "(edges: Between(0, 2))",
            r#"(edges: Tagged("marked"), on_refusal: Skip)"#,
            "(edges: All, until: Delaunay)",
            "(edges: Flat(below: 30), until: Delaunay, passes: 2, seams: Drop)",
            "(edges: All, until: Valence)",
        ],
    ),
    (
        "SplitEdges",
        &[
            "(edges: All)",
            "(edges: Boundary, at: 0.25)",
            "(edges: Between(1, 0), at: 0.125)",
            "(edges: Expect(count: 3, of: Longest(count: 3)), on_refusal: Skip)",
            "(edges: EdgesOf(Grow(Faces([0]))))",
        ],
    ),
    (
        "PokeFaces",
        &[
            "()",
            "(faces: Degree(4), distance: 0.25)",
            "(faces: Random(count: 3, seed: 7), on_refusal: Skip)",
            r#"(faces: Tagged("marked"))"#,
        ],
    ),
    (
        "SplitFaces",
        &[
            "(between: [])",
            "(between: [(0, 3)])",
            "(between: [(0, 5), (6, 1), (2, 2), (0, 99), (0, 3)], on_refusal: Skip)",
        ],
    ),
    (
        "DeleteFaces",
        &[
            "(faces: All)",
            "(faces: Faces([0]), keep_vertices: true)",
            "(faces: FacesAround(Nearest(to: (1, 1, 1))))",
            "(faces: Random(count: 9, seed: 7), on_refusal: Skip)",
            r#"(faces: Tagged("marked"), on_refusal: Skip)"#,
        ],
    ),
    (
        "DissolveEdges",
        &[
            "(edges: Between(0, 1))",
            "(edges: Longest(count: 1))",
            "(edges: All, on_refusal: Skip)",
            "(edges: Random(count: 9, seed: 7), on_refusal: Skip, seams: Drop)",
        ],
    ),
    (
        "DissolveVertices",
        &[
            "(vertices: Vertices([1]))",
            "(vertices: All, on_refusal: Skip)",
            "(vertices: Random(count: 5, seed: 7), on_refusal: Skip, seams: Drop)",
        ],
    ),
    (
        "ExtrudeFaces",
        &[
            "(faces: Faces([0]), by: Distance(0.5))",
            r#"(faces: Boundary, by: Offset((0, 0, 1)), tag: "marked")"#,
            r#"(faces: Random(count: 9, seed: 3), by: Distance(-0.25), scale: 0.5, tag: "new")"#,
            "(faces: All, by: Offset((1, 2, 3)), scale: 2, rotate: [(axis: Z, angle: 30)])",
        ],
    ),
    (
        "InsetFaces",
        &[
            "(faces: All, fraction: 0.25)",
            "(faces: Degree(4), fraction: 0.5, on_refusal: Skip)",
            "(faces: Expect(count: 2, of: Random(count: 2, seed: 5)), fraction: 0.125)",
        ],
    ),
    (
        "BevelFaces",
        &[
            "(faces: All, fraction: 0.25, distance: 0.5)",
            "(faces: Faces([0]), fraction: 0.5, distance: -0.25)",
            "(faces: Boundary, fraction: 0.75, distance: 0, on_refusal: Skip)",
        ],
    ),
    (
        "BevelEdges",
        &[
            "(edges: Between(0, 2), fraction: 0.25)",
            "(edges: All, fraction: 0.25, on_refusal: Skip)",
            "(edges: Random(count: 20, seed: 2), fraction: 0.75, on_refusal: Skip)",
        ],
    ),
    (
        "BevelVertices",
        &[
            "(vertices: All, fraction: 0.25)",
            "(vertices: All, fraction: 0.5, on_refusal: Skip)",
            "(vertices: Vertices([0]), fraction: 0.75)",
        ],
    ),
    (
        "Stitch",
        &[
            "(distance: 0)",
            "(distance: 0.5)",
            "(distance: 0.001, on_refusal: Skip)",
            "(distance: 100, on_refusal: Skip)",
        ],
    ),
    (
        "Cut",
        &[
            "(edges: All)",
            "(edges: All, on_refusal: Skip)",
            "(edges: Sharp(above: 30))",
            "(edges: EdgesOf(Faces([0])), on_refusal: Skip)",
            "(edges: Random(count: 9, seed: 7), on_refusal: Skip)",
        ],
    ),
    (
        "FillHoles",
        &[
            "()",
            "(with: Face)",
            "(around: Vertices([0]), with: Face, on_refusal: Skip)",
            "(around: Boundary, max_edges: 4, on_refusal: Skip)",
        ],
    ),
    (
        "BridgeLoops",
        &[
            "(first: 0, second: 5)",
            "(first: 0, second: 3)",
            "(first: 3, second: 0)",
        ],
    ),
    (
        "CollapseEdges",
        &[
            "(edges: All, on_refusal: Skip)",
            "(edges: Between(0, 1))",
            "(edges: Between(1, 0), at: 0.125)",
            "(edges: Boundary, at: 1, on_refusal: Skip)",
            "(edges: Longest(count: 1), at: 0)",
            "(edges: Random(count: 9, seed: 7), on_refusal: Skip)",
            r#"(edges: Tagged("marked"), on_refusal: Skip)"#,
        ],
    ),
    (
        "Crease",
        &[
            "(edges: Sharp(above: 40), sharpness: 2.5)",
            "(edges: Boundary, vertices: Boundary, sharpness: 10)",
            "(vertices: Vertices([0]), sharpness: 1)",
            "(edges: All, sharpness: 0)",
        ],
    ),
    (
        "TagVertices",
        &[
            r#"(name: "some", vertices: Boundary)"#,
            r#"(name: "some", vertices: Component(Vertices([0])))"#,
        ],
    ),
    (
        "TagEdges",
        &[
            r#"(name: "marked", edges: EdgeLoop(Longest(count: 2)))"#,
            r#"(name: "some", edges: EdgeRing(Random(count: 3, seed: 1)))"#,
            r#"(name: "some", edges: Path(from: 0, to: 1))"#,
        ],
    ),
    (
        "TagFaces",
        &[
            r#"(name: "some", faces: Facing(direction: (0, 0, 1), within: 45))"#,
            r#"(name: "some", faces: Expand(to_angle: 30, of: Faces([0])))"#,
        ],
    ),
    (
        "LoopSubdivide",
        &[
            "(levels: 0)",
            "(levels: 1)",
            "(levels: 2)",
            "(weights: Loop, boundary: Fixed, face_varying: Boundaries, to_limit: true)",
            "(until: EdgeLength(below: 0.4), levels: 5)",
            "(levels: 2, faces: Random(count: 2, seed: 3))",
        ],
    ),
    (
        "CatmullClark",
        &[
            "(levels: 0)",
            "(levels: 1)",
            "(levels: 2, boundary: EdgesAndCorners, creasing: Chaikin, face_varying: CornersPlus1)",
            "(levels: 1, to_limit: true)",
            "(until: LimitDistance(below: 0.05), levels: 4)",
            "(levels: 2, faces: Random(count: 2, seed: 3))",
        ],
    ),
    (
        "Midpoint",
        &[
            "(levels: 0)",
            "(levels: 1)",
            "(levels: 2, into: Quads)",
            "(levels: 1, faces: Random(count: 2, seed: 3))",
        ],
    ),
    ("Butterfly", &["(levels: 0)", "(levels: 1)", "(levels: 2)"]),
    ("Sqrt3", &["(levels: 0)", "(levels: 1)", "(levels: 2)"]),
    ("DooSabin", &["(levels: 0)", "(levels: 1)", "(levels: 2)"]),
    (
        "Weld",
        &["(distance: 0)", "(distance: 0.5)", "(distance: 100)"],
    ),
    (
        "VertexNormals",
        &["()", "(weight: Angle)", "(weight: Uniform)"],
    ),
    (
        "Picture",
        &[
            r#"(path: "a.png", size: (64, 48), highlight: Edges(Sharp(above: 30)), style: (wireframe: ()))"#,
            r#"(path: "b/a.png", size: (32, 24), views: [Fit(from: Front), Fit(from: Top, projection: Orthographic)], style: (shading: Flat, background: Transparent))"#,
            r#"(path: "valence.png", size: (48, 36), color_by: (of: Valence))"#,
            r#"(path: "a.gif", size: (24, 18), turntable: (frames: 3), style: (shading: Matcap, boundary: (), ids: Vertices))"#,
        ],
    ),
    (
        "CurveFigure",
        &[
            r#"(path: "figure.svg", t: [0.25, 0.5])"#,
            r#"(path: "a/figure.png", width: 100, scale: 1)"#,
            r#"(path: "figure.svg", t: [], labels: false, legend: false)"#,
        ],
    ),
    (
        "Save",
        &[
            r#"(path: "a.obj")"#,
            r#"(path: "b/a.glb")"#,
            r#"(path: "a.gltf")"#,
            r#"(path: "a.bez")"#,
            r#"(path: "a.bzc")"#,
        ],
    ),
];

/// Parameters for a step of the built-in operation of this name, as in `(levels: 2)`, to show and to try; none for
/// other names. Most of them work on a mesh that is there.
pub fn samples(operation: &str) -> &'static [&'static str] {
    let found = SAMPLES.iter().find(|(name, _)| *name == operation);
    found.map_or(&[], |(_, samples)| samples)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_operation_has_samples() {
        let registry = crate::registry();
        let missing: Vec<_> = registry
            .entries()
            .iter()
            .map(|entry| entry.name)
            .filter(|name| samples(name).is_empty())
            .collect();
        assert!(
            missing.is_empty(),
            "this table has no parameters to try for: {}",
            missing.join(", ")
        );
    }

    #[test]
    fn every_sample_is_of_an_operation() {
        let registry = crate::registry();
        for (name, samples) in SAMPLES {
            let entry = registry.get(name);
            let entry = entry.unwrap_or_else(|| panic!("{name} is not in the registry"));
            for sample in *samples {
                if let Err(error) = entry.parse(sample) {
                    panic!("{name}{sample}: {error}");
                }
            }
        }
    }
}
