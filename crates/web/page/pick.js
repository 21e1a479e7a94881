// Finds the element of a mesh that is nearest to a click.

/// Finds the face that contains a triangle. If `kind` is "face", returns this face. If `kind` is "vertex" or "edge",
/// returns the vertex or edge of this face that is nearest to the point `at` of the page. The result is `{ kind,
/// number, vertices }`. `place` returns where a vertex is on the page.
export function nearest(mesh, triangle, kind, at, place) {
    const face = mesh.faces[triangle];
    const corners = faceCorners(mesh, face, triangle);
    if (kind === "face") {
        return { kind, number: face, vertices: [...new Set(corners)] };
    }
    const best = (candidates, distance) => candidates.map((c) => [distance(c), c]).reduce((a, b) => (b[0] < a[0] ? b : a))[1];
    if (kind === "vertex") {
        const number = best(corners, (vertex) => length(place(vertex), at));
        return { kind, number, vertices: [number] };
    }
    const edges = faceEdges(mesh, corners);
    const number = best(edges, (edge) => toSegment(at, ...ends(mesh, edge).map(place)));
    return { kind, number, vertices: ends(mesh, number) };
}

/// Returns an element by its number, in the form that `nearest` returns; `null` if the mesh has no such element.
export function numbered(mesh, kind, number) {
    if (kind === "face") {
        const triangle = mesh.faces.indexOf(number);
        return triangle < 0 ? null : { kind, number, vertices: [...new Set(faceCorners(mesh, number, triangle))] };
    }
    const count = kind === "edge" ? mesh.edges.length / 2 : mesh.positions.length / 3;
    return number < count ? { kind, number, vertices: kind === "edge" ? ends(mesh, number) : [number] } : null;
}

/// Returns the edge between two vertices, in the form that `nearest` returns; `null` if the mesh has no such edge.
export function joining(mesh, vertices) {
    for (let number = 0; number < mesh.edges.length / 2; number += 1) {
        const found = ends(mesh, number);
        if (vertices.every((vertex) => found.includes(vertex))) {
            return { kind: "edge", number, vertices: found };
        }
    }
    return null;
}

/// Returns the indices of the triangles of a face. These indices are consecutive.
export function faceTriangles(mesh, face, inside = mesh.faces.indexOf(face)) {
    let first = inside;
    while (mesh.faces[first - 1] === face) {
        first -= 1;
    }
    const all = [];
    for (let i = first; mesh.faces[i] === face; i += 1) {
        all.push(i);
    }
    return all;
}

/// Returns the selection of picked elements of one kind, as written in a recipe.
export function selection(picks) {
    if (picks[0].kind === "edge") {
        const between = picks.map(({ vertices: [v, w] }) => `Between(${v}, ${w})`);
        return between.length === 1 ? between[0] : `Or([${between.join(", ")}])`;
    }
    const numbers = picks.map((pick) => pick.number).sort((a, b) => a - b).join(", ");
    return picks[0].kind === "face" ? `Faces([${numbers}])` : `Vertices([${numbers}])`;
}

function faceCorners(mesh, face, triangle) {
    return faceTriangles(mesh, face, triangle).flatMap((i) => [...mesh.triangles.subarray(3 * i, 3 * i + 3)]);
}

/// Returns those sides of the triangles that are edges of the mesh, not diagonals of a polygon.
function faceEdges(mesh, corners) {
    const pairs = new Set();
    for (let i = 0; i < corners.length; i += 3) {
        for (let k = 0; k < 3; k += 1) {
            const [v, w] = [corners[i + k], corners[i + ((k + 1) % 3)]];
            pairs.add(`${Math.min(v, w)} ${Math.max(v, w)}`);
        }
    }
    const vertices = new Set(corners);
    const found = [];
    for (let edge = 0; edge < mesh.edges.length / 2; edge += 1) {
        const [v, w] = [mesh.edges[2 * edge], mesh.edges[2 * edge + 1]];
        if (vertices.has(v) && pairs.has(`${Math.min(v, w)} ${Math.max(v, w)}`)) {
            found.push(edge);
        }
    }
    return found;
}

function ends(mesh, edge) {
    return [mesh.edges[2 * edge], mesh.edges[2 * edge + 1]];
}

function length([x, y], [u, v]) {
    return Math.hypot(x - u, y - v);
}

function toSegment([x, y], [ax, ay], [bx, by]) {
    const square = (bx - ax) ** 2 + (by - ay) ** 2;
    const t = square > 0 ? Math.min(Math.max(((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / square, 0), 1) : 0;
    return Math.hypot(ax + t * (bx - ax) - x, ay + t * (by - ay) - y);
}
