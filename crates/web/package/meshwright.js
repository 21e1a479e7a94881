// The engine as an ES module, for browsers and Node. Types and documentation are in `meshwright.d.ts`.
import init, { Session as Core } from "./core.js";

let loading;

export function load(source) {
    loading ??= start(source).catch((error) => {
        // A later call can try again, for example after the network is back.
        loading = undefined;
        throw error;
    });
    return loading;
}

async function start(source) {
    let wasm = source ?? new URL("core_bg.wasm", import.meta.url);
    if (wasm instanceof URL && wasm.protocol === "file:") {
        // Node does not fetch files.
        const { readFile } = await import("node:fs/promises");
        wasm = await readFile(wasm);
    }
    await init({ module_or_path: wasm });
}

const encoder = new TextEncoder();

export class Session {
    #core;

    static async create(source) {
        await load(source);
        return new Session();
    }

    constructor() {
        this.#core = new Core();
    }

    write(path, content) {
        this.#core.write(path, typeof content === "string" ? encoder.encode(content) : content);
    }

    read(path) {
        return this.#core.read(path);
    }

    remove(path) {
        this.#core.remove(path);
    }

    check(recipe, { path = "recipe.ron", preset, set = {} } = {}) {
        return JSON.parse(this.#core.check(path, recipe, preset, JSON.stringify(set)));
    }

    run(recipe, { path = "recipe.ron", preset, set = {}, onEvent } = {}) {
        const listener = { event: (json) => onEvent?.(JSON.parse(json)) !== false };
        return JSON.parse(this.#core.run(path, recipe, preset, JSON.stringify(set), listener));
    }

    picture({ width = 800, height = 600, wireframe = false, up = "auto" } = {}) {
        return this.#core.picture(width, height, wireframe, up);
    }

    mesh(object) {
        const view = this.#core.mesh(object);
        if (view === undefined) {
            return undefined;
        }
        try {
            return {
                center: view.center(),
                positions: view.positions(),
                triangles: view.triangles(),
                faces: view.faces(),
                edges: view.edges(),
            };
        } finally {
            view.free();
        }
    }

    placements(object) {
        return this.#core.placements(object);
    }

    quantities() {
        return JSON.parse(this.#core.quantities());
    }

    colors(quantity) {
        const colored = this.#core.colors(JSON.stringify(quantity));
        try {
            const { legend, meshes } = JSON.parse(colored.described());
            return { legend, meshes: meshes.map((mesh, i) => ({ ...mesh, colors: colored.colors(i) })) };
        } finally {
            colored.free();
        }
    }

    schema() {
        return JSON.parse(this.#core.schema());
    }

    operations() {
        return JSON.parse(this.#core.operations());
    }

    free() {
        this.#core.free();
    }
}

export async function run(recipe, files = {}, options = {}) {
    const session = await Session.create();
    try {
        for (const [path, content] of Object.entries(files)) {
            session.write(path, content);
        }
        const result = session.run(recipe, options);
        const outputs = Object.fromEntries(result.files.map((path) => [path.replace(/^out\//, ""), session.read(path)]));
        const meshes = result.objects.filter((object) => object.kind === "mesh");
        return { ...result, outputs, meshes: Object.fromEntries(meshes.map(({ name }) => [name, session.mesh(name)])) };
    } finally {
        session.free();
    }
}
