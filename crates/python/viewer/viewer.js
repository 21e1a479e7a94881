// The viewer for notebooks. It shows triangles in colors, with an optional wireframe, and the mouse turns the view.
// `build.sh` bundles it with three.js.
import {
    BufferAttribute, BufferGeometry, Color, DirectionalLight, DoubleSide, HemisphereLight, LineBasicMaterial, LineSegments, Mesh,
    MeshStandardMaterial, PerspectiveCamera, Scene, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer;

/// Shows a mesh in an HTML element. `data` has the arrays `positions` (float32), `triangles` and `edges` (uint32), and
/// optionally `colors` (uint8), each encoded as base64. `caption` is a text, and `wireframe` says whether edges are
/// drawn at first.
export function show(element, data) {
    const positions = new BufferAttribute(new Float32Array(bytes(data.positions)), 3);
    const faces = new BufferGeometry();
    faces.setAttribute("position", positions);
    faces.setIndex(new BufferAttribute(new Uint32Array(bytes(data.triangles)), 1));
    if (data.colors) {
        faces.setAttribute("color", new BufferAttribute(new Uint8Array(bytes(data.colors)), 3, true));
    }
    const surface = new MeshStandardMaterial({
        color: data.colors ? 0xffffff : 0xb8c4d0, vertexColors: Boolean(data.colors), flatShading: true, roughness: 0.8,
        side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
    });
    const lines = new BufferGeometry();
    lines.setAttribute("position", positions);
    lines.setIndex(new BufferAttribute(new Uint32Array(bytes(data.edges)), 1));
    const wireframe = new LineSegments(lines, new LineBasicMaterial({ color: 0x303840 }));

    const scene = new Scene();
    scene.background = new Color(0xffffff);
    scene.add(new Mesh(faces, surface), wireframe, new HemisphereLight(0xffffff, 0x8090a0, 2));
    faces.computeBoundingSphere();
    const { center, radius } = faces.boundingSphere;
    const size = radius || 1;
    const camera = new PerspectiveCamera(35, 1, size / 100, size * 100);
    camera.position.copy(center).add(new Vector3(0.6, 0.5, 1).setLength(size * 3.6));
    const light = new DirectionalLight(0xffffff, 2);
    scene.add(light, light.target);
    light.target.position.copy(center);

    const renderer = new WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
    element.append(renderer.domElement);
    const controls = new OrbitControls(camera, renderer.domElement);
    controls.target.copy(center);
    // The view is drawn only after a change, so that a page that is not used takes no processor time.
    const draw = () => {
        light.position.copy(camera.position);
        renderer.render(scene, camera);
    };
    const resize = () => {
        const [width, height] = [element.clientWidth || 640, element.clientHeight || 480];
        renderer.setPixelRatio(window.devicePixelRatio);
        renderer.setSize(width, height);
        camera.aspect = width / height;
        camera.updateProjectionMatrix();
        draw();
    };
    controls.addEventListener("change", draw);
    new ResizeObserver(resize).observe(element);

    const button = document.createElement("button");
    button.textContent = "Wireframe";
    button.style.cssText = "position: absolute; top: 8px; left: 8px";
    wireframe.visible = data.wireframe;
    button.onclick = () => {
        wireframe.visible = !wireframe.visible;
        draw();
    };
    const caption = document.createElement("div");
    caption.textContent = data.caption;
    caption.style.cssText = "position: absolute; bottom: 8px; left: 8px; font: 13px sans-serif; color: #303840";
    element.append(button, caption);
    controls.update();
    resize();
}
