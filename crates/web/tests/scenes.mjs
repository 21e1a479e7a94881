// Runs every recipe in scenes/ that tests/digests.txt lists, and compares its digest with the digest in the list. Then
// reads the corpus of the fuzz tests, which contains malformed files. No file may crash the engine. At the end, checks
// which files npm would publish. Usage: scenes.mjs PACKAGE
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync, readdirSync } from "node:fs";
import { extname, join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const root = new URL("../../../", import.meta.url).pathname;
const { Session, run } = await import(pathToFileURL(join(resolve(process.argv[2]), "meshwright.js")).href);

const filesBelow = (folder) => readdirSync(join(root, folder), { recursive: true, withFileTypes: true })
    .filter((entry) => entry.isFile())
    .map((entry) => join(entry.parentPath ?? entry.path, entry.name).slice(root.length));

const session = await Session.create();
for (const path of filesBelow("scenes")) {
    session.write(path, readFileSync(join(root, path)));
}

const digests = readFileSync(join(root, "tests/digests.txt"), "utf8").trim().split("\n").map((line) => line.split(" "));
assert(digests.length > 20);
for (const [name, digest] of digests) {
    const path = `scenes/${name}.ron`;
    const begin = performance.now();
    const result = session.run(readFileSync(join(root, path), "utf8"), { path });
    const seconds = ((performance.now() - begin) / 1000).toFixed(2);
    assert(result.succeeded, `${name}: ${JSON.stringify(result.problems, null, 1)}`);
    assert.equal(result.digest, digest, `${name}: the digest differs from tests/digests.txt`);
    assert(result.expectations.every((expectation) => expectation.met));
    console.log(`${name} ${digest} ${seconds} s`);
}
console.log(`${digests.length} digests are the same in WebAssembly`);
session.free();

// The function `run` needs no session.
const result = await run(`(recipe: 1, steps: [Load(path: "a.obj", name: "a"), Save(path: "b.obj")])`,
    { "a.obj": "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n" });
assert(result.succeeded, JSON.stringify(result.problems));
assert.deepEqual([...result.meshes.a.triangles], [0, 1, 2]);
assert(new TextDecoder().decode(result.outputs["b.obj"]).includes("f 1 2 3"));

// The colors of a quantity contain one color for each element of the mesh.
const colored = await Session.create();
colored.run("(recipe: 1, steps: [Torus(major: 1, minor: 0.4, name: \"a\")])");
const arrays = colored.mesh("a");
const sizes = { vertex: arrays.positions.length, corner: 3 * arrays.triangles.length, edge: 1.5 * arrays.edges.length };
for (const { title, quantity } of colored.quantities()) {
    const { legend, meshes: [mesh] } = colored.colors(quantity);
    assert.equal(legend.title, title);
    assert.equal(mesh.colors.length, sizes[mesh.per], title);
}
assert.throws(() => colored.colors({ Attribute: { name: "missing" } }), /missing/);
colored.free();

// If a parameter has changed, the steps before the first step that uses the parameter do not run again.
const slider = await Session.create();
const twisted = `(recipe: 1, params: { "twist": Float(default: 10), "levels": Int(default: 2) }, presets: { "fine": { "levels": 3 } },
    steps: [Cube(name: "a"), CatmullClark(levels: arg("levels")), Twist(axis: Y, angle: arg("twist"))])`;
const cached = (options) => {
    const changed = slider.run(twisted, options);
    assert.equal(changed.digest, new Session().run(twisted, options).digest);
    return changed.steps.map((step) => step.cached);
};
assert.deepEqual(cached({}), [false, false, false]);
assert.deepEqual(cached({ set: { twist: 20 } }), [true, true, false]);
assert.deepEqual(cached({ preset: "fine" }), [true, false, false]);
assert.deepEqual(slider.check(twisted, { preset: "fine" }).presets, ["fine"]);
slider.free();

// A check is fast enough to run after each key press.
const checker = await Session.create();
const text = readFileSync(join(root, "scenes/cube_flip.ron"), "utf8");
checker.check(text);
const begin = performance.now();
for (let i = 0; i < 20; i += 1) {
    checker.check(text);
}
const milliseconds = (performance.now() - begin) / 20;
console.log(`a check takes ${milliseconds.toFixed(1)} ms`);

// Each file of the corpus of the fuzz tests is either read, or refused with a message. Earlier versions of the readers
// failed on some of these files.
let n = 0;
for (const path of filesBelow("tests/fuzz/corpus")) {
    const format = path.split("/")[3];
    const extension = extname(path) || `.${format}`;
    checker.write(`odd/file${extension}`, readFileSync(join(root, path)));
    const { problems } = checker.run(`(recipe: 1, steps: [Load(path: "odd/file${extension}", name: "a")])`);
    assert(Array.isArray(problems), path);
    n += 1;
}
console.log(`${n} odd files were read or refused`);

// The package has its license, its README and its types.
const [{ files }] = JSON.parse(execFileSync("npm", ["pack", "--dry-run", "--json", resolve(process.argv[2])], { encoding: "utf8" }));
assert.deepEqual(files.map(({ path }) => path).sort(), ["LICENSE-APACHE", "LICENSE-MIT", "README.md", "core.d.ts", "core.js",
    "core_bg.wasm", "core_bg.wasm.d.ts", "meshwright.d.ts", "meshwright.js", "package.json"]);
console.log(`npm would publish ${files.length} files`);
