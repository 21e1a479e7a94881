// Owns the engine. The page sends `{ id, call, args }`, and receives `{ id, value }` or `{ id, error, fatal }`. During
// a run, the page also receives messages `{ event }`. The first message has the compiled engine and the files.
import { Session } from "meshwright";
import { inPage } from "./messages.js";

let session;

export const calls = {
    async start(module, files) {
        session = await Session.create(module);
        for (const [path, bytes] of files) {
            session.write(path, bytes);
        }
    },
    write: (path, bytes) => session.write(path, bytes),
    read: (path) => session.read(path),
    remove: (path) => session.remove(path),
    check(recipe, set, preset) {
        const checked = session.check(recipe, { set, preset });
        return { ...checked, problems: inPage(checked.problems) };
    },
    run(recipe, set) {
        const result = session.run(recipe, { set, onEvent: (event) => postMessage({ event }) });
        const meshes = result.objects.filter((object) => object.kind === "mesh");
        return { ...result, problems: inPage(result.problems), quantities: session.quantities(), meshes: meshes.map(({ name }) => ({ name, placements: session.placements(name), ...session.mesh(name) })) };
    },
    colors: (quantity) => session.colors(quantity),
    picture: (options) => session.picture(options),
    describe: () => ({ schema: session.schema(), operations: session.operations() }),
};

/// Returns the arrays of a value, which move to the page without a copy.
function buffers(value) {
    const owned = value instanceof Uint8Array ? [value] : (value?.meshes ?? []).flatMap((mesh) => Object.values(mesh));
    return owned.filter(ArrayBuffer.isView).map((array) => array.buffer);
}

onmessage = async ({ data: { id, call, args } }) => {
    try {
        const value = await calls[call](...args);
        postMessage({ id, value }, buffers(value));
    } catch (error) {
        // After a trap, the engine cannot be used again.
        postMessage({ id, error: String(error.message ?? error), fatal: error instanceof WebAssembly.RuntimeError });
    }
};
