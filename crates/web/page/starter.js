/// A recipe to begin with.
export const CUBE = `(
    recipe: 1,
    steps: [
        Cube(name: "cube"),
    ],
)
`;

/// The recipe of a first visit.
export const STARTER = `// Move a slider, or change the text and press Run (Ctrl+Enter).
// Click a face in the view to add a step for it.
(
    recipe: 1,
    about: "A jack with six arms, made from a cube",
    params: {
        "reach": Float(default: 1.5, min: 0, max: 3, doc: "Length of the arms"),
        "twist": Float(default: 90, min: -180, max: 180, doc: "Degrees from bottom to top"),
        "levels": Int(default: 3, min: 0, max: 5, doc: "Levels of subdivision"),
    },
    steps: [
        Cube(name: "jack"),
        // A beveled face keeps its number, so the second BevelFaces makes the arms longer.
        BevelFaces(faces: All, fraction: 0.4, distance: arg("reach")),
        BevelFaces(faces: Faces([0, 1, 2, 3, 4, 5]), fraction: 0.2, distance: 1),
        CatmullClark(levels: arg("levels")),
        Twist(axis: Y, angle: arg("twist")),
        Save(path: "jack.obj"),
    ],
    expect: [Closed, Manifold, Components(eq: 1)],
)
`;
