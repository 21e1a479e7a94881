// The picture of the meshes: three.js with an orbit camera, drawn only when something changes.
import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { paint } from "./colors.js";
import { nearest } from "./pick.js";
import { Marks } from "./marks.js";

/// Colors of the objects, which differ in hue and in lightness.
const COLORS = [0x8fa8c8, 0xd9b26f, 0x8fc0a0, 0xc98f8f, 0xb3a0cf, 0xb8b8a8];

/// At most this many instances of a mesh are drawn. Each instance makes drawing slower.
export const MAX_INSTANCES = 1000;

/// The vertical field of view in degrees, the same as in the pictures of recipes.
const ANGLE = 25;

export class View {
    #canvas;
    #renderer;
    #camera = new THREE.PerspectiveCamera(ANGLE, 1, 0.01, 100);
    #controls;
    #scene = new THREE.Scene();
    #content = new THREE.Group();
    /// The earlier meshes, which were shown before the current ones.
    #earlier = new THREE.Group();
    /// The width of the left part of the view, which shows the earlier meshes. The width is a fraction of the whole
    /// width, from 0 to 1.
    #split = 0;
    #marks = new Marks();
    #center = new THREE.Vector3();
    #radius = 1;
    #style = { smooth: false, edges: true, up: "y" };
    #waiting = false;
    /// Called with two arguments after a click. The first argument is the element, as
    /// `{ mesh, kind, number, vertices }`, or `null` for a click beside the meshes. The second argument says whether
    /// the click adds to the picked elements.
    onPick = () => {};
    kind = "face";
    /// Whether a click adds to the picked elements even without Shift.
    several = false;

    /// Creates the view. Throws if the browser has no WebGL.
    constructor(canvas) {
        this.#canvas = canvas;
        this.#renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true });
        this.#renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
        const light = new THREE.DirectionalLight(0xffffff, 2.2);
        light.position.set(-0.4, 0.6, 1);
        this.#camera.add(light, light.target);
        light.target.position.set(0, 0, -1);
        this.#scene.add(this.#camera, new THREE.HemisphereLight(0xffffff, 0x8890a0, 1.3), this.#content, this.#earlier,
            this.#marks.group);
        this.#controls = new OrbitControls(this.#camera, canvas);
        this.#controls.addEventListener("change", () => this.#draw());
        new ResizeObserver(() => this.#resize()).observe(canvas.parentElement);
        this.#listen();
        this.#resize();
    }

    /// Shows meshes: `{ name, center, positions, triangles, faces, edges, placements }`. If `keep` is true, the camera
    /// moves only if meshes would leave the view, or if the size of the scene changes by more than a factor of 2. `up`
    /// is the axis that points upwards: "y", "z", or "auto" for the axis that pictures of recipes use. Returns the
    /// axis.
    show(meshes, keep, up) {
        const before = this.#radius;
        const sawAll = this.#seesAll();
        const box = new THREE.Box3();
        // Positions are relative to the center of the first mesh, because numbers of 32 bits are precise only near the
        // origin.
        const center = meshes.length ? new THREE.Vector3(...meshes[0].center).applyMatrix4(placement(meshes[0], 0)) : new THREE.Vector3();
        this.#retire(keep, this.#center.clone().sub(center));
        this.#center = center;
        meshes.forEach((mesh, i) => {
            const geometry = new THREE.BufferGeometry();
            geometry.setAttribute("position", new THREE.BufferAttribute(mesh.positions, 3));
            geometry.setIndex(new THREE.BufferAttribute(mesh.triangles, 1));
            const lines = new THREE.BufferGeometry();
            lines.setAttribute("position", geometry.getAttribute("position"));
            lines.setIndex(new THREE.BufferAttribute(mesh.edges, 1));
            const count = Math.min(mesh.placements.length / 16, MAX_INSTANCES);
            for (let instance = 0; instance < count; instance += 1) {
                const surface = new THREE.Mesh(geometry, new THREE.MeshStandardMaterial({ color: COLORS[i % COLORS.length],
                    roughness: 0.75, side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 }));
                const dark = new THREE.LineBasicMaterial({ color: 0x101418, transparent: true, opacity: 0.45 });
                const group = new THREE.Group();
                group.add(surface, new THREE.LineSegments(lines, dark));
                group.userData.mesh = mesh;
                group.matrixAutoUpdate = false;
                group.matrix.makeTranslation(...mesh.center).premultiply(placement(mesh, instance))
                    .premultiply(new THREE.Matrix4().makeTranslation(center.clone().negate()));
                group.updateMatrixWorld();
                this.#content.add(group);
                box.expandByObject(surface);
            }
        });
        this.#radius = box.isEmpty() ? 1 : Math.max(box.getSize(new THREE.Vector3()).length() / 2, 1e-9);
        this.box = box;
        this.style({});
        if (!keep) {
            this.#style.up = up !== "auto" ? up : stands(box, center.toArray()) ? "z" : "y";
            this.fit();
        } else if (this.#radius > 2 * before || this.#radius < before / 2) {
            this.refit();
        } else {
            this.#keepAll(sawAll);
        }
        this.#draw();
        return this.#style.up;
    }

    /// Whether there are earlier meshes, which `compare` can show.
    get hasEarlier() {
        return this.#earlier.children.length > 0;
    }

    /// Shows the earlier meshes in the left part of the view. `fraction` is the width of this part, as a fraction of
    /// the whole width.
    compare(fraction) {
        this.#split = fraction;
        this.#draw();
    }

    /// Changes the style: `smooth`, `edges`, `up` ("y" or "z").
    style(changes) {
        Object.assign(this.#style, changes);
        for (const { children: [surface, lines] } of [...this.#content.children, ...this.#earlier.children]) {
            surface.material.flatShading = !this.#style.smooth;
            surface.material.needsUpdate = true;
            if (this.#style.smooth && !surface.geometry.hasAttribute("normal")) {
                surface.geometry.computeVertexNormals();
            }
            lines.visible = this.#style.edges || lines.material.vertexColors;
        }
        if (changes.up) {
            this.fit();
        }
        this.#draw();
    }

    /// Colors the meshes: `[{ name, per, colors }]`. Meshes without an entry have their own color.
    color(found) {
        for (const group of this.#content.children) {
            paint(group, found.find(({ name }) => name === group.userData.mesh.name));
        }
        this.style({});
    }

    /// Moves the camera so that all meshes fit the view. `front` is the direction to the camera. By default, the camera
    /// looks from the front, a little from the side and from above.
    fit(front = this.#style.up === "z" ? new THREE.Vector3(0.55, -1, 0.5) : new THREE.Vector3(0.55, 0.5, 1)) {
        const up = this.#style.up === "z" ? new THREE.Vector3(0, 0, 1) : new THREE.Vector3(0, 1, 0);
        const center = this.box?.isEmpty() === false ? this.box.getCenter(new THREE.Vector3()) : new THREE.Vector3();
        this.#camera.up.copy(up);
        this.#camera.position.copy(center).addScaledVector(front.normalize(), this.#distance(front, up, center));
        this.#camera.near = this.#radius / 100;
        this.#camera.far = this.#radius * 100;
        this.#camera.updateProjectionMatrix();
        this.#controls.dispose();
        this.#controls = new OrbitControls(this.#camera, this.#canvas);
        this.#controls.addEventListener("change", () => this.#draw());
        this.#controls.target.copy(center);
        this.#controls.update();
        this.#draw();
    }

    /// Marks the elements of a mesh.
    mark(picks) {
        this.#marks.show(picks, (mesh) => this.#instances(mesh).map((group) => group.matrixWorld));
        this.#draw();
    }

    #instances(mesh) {
        return this.#content.children.filter((group) => group.userData.mesh === mesh);
    }

    /// Returns where a vertex of the first instance of a mesh is on the page, in pixels.
    project(mesh, vertex) {
        return this.#project(this.#instances(mesh)[0], vertex);
    }

    #project(group, vertex) {
        const { mesh } = group.userData;
        const point = new THREE.Vector3().fromArray(mesh.positions, 3 * vertex).applyMatrix4(group.matrixWorld);
        point.project(this.#camera);
        const rect = this.#canvas.getBoundingClientRect();
        return [rect.left + ((point.x + 1) / 2) * rect.width, rect.top + ((1 - point.y) / 2) * rect.height];
    }

    /// Returns the picture as a PNG file.
    picture() {
        this.#render();
        return new Promise((resolve) => this.#canvas.toBlob(resolve));
    }

    /// Moves the camera so that all meshes fit the view, without turning it.
    refit() {
        this.fit(this.#camera.position.clone().sub(this.#controls.target));
    }

    /// If all meshes were in the view before a change but are not now, moves the camera so that all meshes are in the
    /// view.
    #keepAll(sawAll) {
        if (sawAll && !this.#seesAll()) {
            this.refit();
        }
    }

    /// Whether all vertices are in the view.
    #seesAll() {
        this.#camera.updateMatrixWorld();
        for (const point of this.#points(3e4)) {
            const { x, y } = point.project(this.#camera);
            if (Math.abs(x) > 1 || Math.abs(y) > 1) {
                return false;
            }
        }
        return true;
    }

    /// Yields vertices of the meshes. If there are more than about `most` vertices, some of them are skipped. All
    /// vertices are yielded as the same vector object, whose coordinates change.
    *#points(most) {
        const point = new THREE.Vector3();
        for (const { matrixWorld, userData: { mesh: { positions } } } of this.#content.children) {
            const stride = 3 * Math.ceil((positions.length * this.#content.children.length) / (3 * most));
            for (let k = 0; k < positions.length; k += stride) {
                yield point.fromArray(positions, k).applyMatrix4(matrixWorld);
            }
        }
    }

    /// Returns the smallest distance of the camera at which all vertices are visible, plus a margin.
    #distance(front, up, center) {
        const right = new THREE.Vector3().crossVectors(up, front).normalize();
        const upwards = new THREE.Vector3().crossVectors(front, right);
        const tangent = Math.tan(THREE.MathUtils.degToRad(ANGLE) / 2) * 0.9;
        let distance = this.#radius;
        for (const point of this.#points(1e5)) {
            point.sub(center);
            const across = Math.max(Math.abs(point.dot(right)) / this.#camera.aspect, Math.abs(point.dot(upwards)));
            distance = Math.max(distance, point.dot(front) + across / tangent);
        }
        return distance;
    }

    /// Moves the current meshes by `move`, and keeps them as the earlier meshes. If `keep` is false, drops both the
    /// current and the earlier meshes instead.
    #retire(keep, move) {
        for (const child of this.#earlier.children.flatMap((object) => object.children)) {
            child.geometry.dispose();
            child.material.dispose();
        }
        this.#earlier.clear();
        this.#marks.clear();
        for (const object of [...this.#content.children]) {
            // The legend is about the meshes of the last run only.
            paint(object);
            object.matrix.premultiply(new THREE.Matrix4().makeTranslation(move));
            this.#earlier.add(object);
        }
        if (!keep) {
            this.#retire(true, move);
        }
    }

    #render() {
        const { x: width, y: height } = this.#renderer.getSize(new THREE.Vector2());
        const middle = this.hasEarlier ? Math.round(width * this.#split) : 0;
        this.#renderer.setScissorTest(true);
        for (const [left, right, isEarlier] of [[0, middle, true], [middle, width, false]]) {
            this.#earlier.visible = isEarlier;
            this.#content.visible = this.#marks.group.visible = !isEarlier;
            this.#renderer.setScissor(left, 0, right - left, height);
            this.#renderer.render(this.#scene, this.#camera);
        }
    }

    #draw() {
        if (!this.#waiting) {
            this.#waiting = true;
            requestAnimationFrame(() => {
                this.#waiting = false;
                this.#render();
            });
        }
    }

    #resize() {
        const { clientWidth: width, clientHeight: height } = this.#canvas.parentElement;
        if (width && height) {
            const sawAll = this.#seesAll();
            this.#renderer.setSize(width, height, false);
            this.#camera.aspect = width / height;
            this.#camera.updateProjectionMatrix();
            this.#keepAll(sawAll);
            this.#marks.resize(width, height);
            this.#draw();
        }
    }

    #pick(event) {
        const rect = this.#canvas.getBoundingClientRect();
        const at = [event.clientX, event.clientY];
        const ray = new THREE.Raycaster();
        const across = ((at[0] - rect.left) / rect.width) * 2 - 1;
        const upwards = 1 - ((at[1] - rect.top) / rect.height) * 2;
        ray.setFromCamera(new THREE.Vector2(across, upwards), this.#camera);
        const surfaces = this.#content.children.map((group) => group.children[0]);
        const hit = ray.intersectObjects(surfaces, false)[0];
        const group = hit?.object.parent;
        const mesh = group?.userData.mesh;
        const place = (vertex) => this.#project(group, vertex);
        this.onPick(hit ? { mesh, ...nearest(mesh, hit.faceIndex, this.kind, at, place) } : null, this.several || event.shiftKey);
    }

    #listen() {
        let down;
        this.#canvas.addEventListener("pointerdown", (event) => (down = event));
        this.#canvas.addEventListener("pointerup", (event) => {
            // If the pointer has moved farther, the visitor has turned the view and has not clicked.
            if (down && Math.hypot(event.clientX - down.clientX, event.clientY - down.clientY) < 5 && event.button === 0) {
                this.#pick(event);
            }
            down = undefined;
        });
        const turns = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
        this.#canvas.addEventListener("keydown", (event) => {
            if (turns[event.key]) {
                this.#turn(...turns[event.key], 1);
            } else if (event.key === "+" || event.key === "-") {
                this.#turn(0, 0, event.key === "+" ? 0.85 : 1 / 0.85);
            } else {
                return;
            }
            event.preventDefault();
        });
    }

    /// Turns the camera by steps of 10 degrees about the target, and multiplies the distance from the target by
    /// `distance`.
    #turn(across, down, distance) {
        const { target } = this.#controls;
        const toY = new THREE.Quaternion().setFromUnitVectors(this.#camera.up, new THREE.Vector3(0, 1, 0));
        const offset = this.#camera.position.clone().sub(target).applyQuaternion(toY);
        const place = new THREE.Spherical().setFromVector3(offset);
        place.theta += (across * Math.PI) / 18;
        place.phi += (down * Math.PI) / 18;
        place.radius *= distance;
        this.#camera.position.setFromSpherical(place.makeSafe()).applyQuaternion(toY.invert()).add(target);
        this.#controls.update();
        this.#draw();
    }
}

/// Returns the matrix from the space of a mesh to the space of the scene.
function placement(mesh, instance) {
    return new THREE.Matrix4().fromArray(mesh.placements, 16 * instance);
}

/// Returns whether a scene stands on the plane z = 0 and not on y = 0. Pictures of recipes use the same rule.
function stands(box, center) {
    const tolerance = 1e-3 * Math.max(...box.getSize(new THREE.Vector3()));
    const on = (axis, k) => Math.abs(box.min[axis] + center[k]) <= tolerance && box.max[axis] + center[k] > tolerance;
    return !box.isEmpty() && on("z", 2) && !on("y", 1);
}
