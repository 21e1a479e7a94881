// Validates every glTF file below a folder with the Khronos validator. Allows no errors, warnings or notes, except the
// notes that texture coordinates or tangents are unused, that an image is a separate file, or that the validator does
// not decode EXT_meshopt_compression and so finds its buffer unused.
const fs = require("fs");
const path = require("path");

const root = path.resolve(process.argv[2]);
const validator = require(path.join(root, "validator/node_modules/gltf-validator"));

function* files(folder) {
    for (const entry of fs.readdirSync(folder, { withFileTypes: true })) {
        const full = path.join(folder, entry.name);
        if (entry.isDirectory() && entry.name !== "validator") yield* files(full);
        else if (/\.(glb|gltf)$/.test(entry.name)) yield full;
    }
}

(async () => {
    let checked = 0;
    for (const file of files(root)) {
        const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {
            externalResourceFunction: (uri) =>
                Promise.resolve(
                    new Uint8Array(fs.readFileSync(path.join(path.dirname(file), decodeURIComponent(uri)))),
                ),
        });
        const isExpected = ({ code, pointer, message }) =>
            (code === "UNUSED_OBJECT" && /\/TEXCOORD_\d+$/.test(pointer)) ||
            code === "UNUSED_MESH_TANGENT" ||
            code === "URI_GLB" ||
            (code === "UNSUPPORTED_EXTENSION" && message.includes("EXT_meshopt_compression")) ||
            (code === "UNUSED_OBJECT" && pointer === "/buffers/0" && /_compressed\.glb$/.test(file));
        const found = report.issues.messages.filter((message) => !isExpected(message));
        checked += 1;
        if (found.length > 0) {
            console.error(file, JSON.stringify(found.slice(0, 5), null, 2));
            process.exit(1);
        }
    }
    if (checked === 0) {
        console.error("found no glTF files");
        process.exit(1);
    }
    console.log(`${checked} glTF files are valid`);
})();
