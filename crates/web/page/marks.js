// Marks on picked elements: a point, a thick line, or a colored face.
import * as THREE from "three";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import { faceTriangles } from "./pick.js";

const COLOR = 0xff7a1a;

export class Marks {
    group = new THREE.Group();
    #line = new LineMaterial({ color: COLOR, linewidth: 5, depthTest: false, transparent: true });
    #point = new THREE.PointsMaterial({ color: COLOR, size: 11, sizeAttenuation: false, depthTest: false,
        transparent: true });
    #face = new THREE.MeshBasicMaterial({ color: COLOR, side: THREE.DoubleSide, transparent: true, opacity: 0.65,
        polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -1 });

    /// Marks elements. `places(mesh)` returns a matrix for each instance of a mesh: the matrix from the space of the
    /// mesh to the space of the view.
    show(picks, places) {
        this.clear();
        for (const pick of picks) {
            for (const place of places(pick.mesh)) {
                const mark = this.#mark(pick);
                mark.matrixAutoUpdate = false;
                mark.matrix.copy(place);
                mark.renderOrder = 1;
                this.group.add(mark);
            }
        }
    }

    clear() {
        for (const child of this.group.children) {
            child.geometry.dispose();
        }
        this.group.clear();
    }

    resize(width, height) {
        this.#line.resolution.set(width, height);
    }

    #mark({ mesh, kind, number, vertices }) {
        const at = (v) => [...mesh.positions.subarray(3 * v, 3 * v + 3)];
        if (kind === "edge") {
            return new LineSegments2(new LineSegmentsGeometry().setPositions(vertices.flatMap(at)), this.#line);
        }
        const corners = kind === "vertex" ? vertices
            : faceTriangles(mesh, number).flatMap((i) => [...mesh.triangles.subarray(3 * i, 3 * i + 3)]);
        const geometry = new THREE.BufferGeometry();
        geometry.setAttribute("position", new THREE.Float32BufferAttribute(corners.flatMap(at), 3));
        return kind === "vertex" ? new THREE.Points(geometry, this.#point) : new THREE.Mesh(geometry, this.#face);
    }
}
