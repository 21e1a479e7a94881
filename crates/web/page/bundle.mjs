// Writes the page: bundles the scripts, copies the engine, and renders the gallery: bundle.mjs PACKAGE THREADS TOOLS OUT. THREADS is
// the folder of the package with threads, which may be missing.
import { copyFileSync, existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [engine, threaded, tools, out] = process.argv.slice(2).map((path) => resolve(path));
const here = new URL(".", import.meta.url).pathname;
const root = join(here, "../../..");
const esbuild = createRequire(join(tools, "package.json"))("esbuild");

rmSync(out, { recursive: true, force: true });
mkdirSync(join(out, "gallery"), { recursive: true });

/// Bundles scripts. Workers contain the package; the page gives them the compiled engine.
function bundle(scripts, folder, engine) {
    return esbuild.build({
        entryPoints: scripts,
        outdir: folder,
        bundle: true,
        minify: true,
        format: "esm",
        target: "es2022",
        nodePaths: [join(tools, "node_modules")],
        alias: { meshwright: join(engine, "meshwright.js"), core: join(engine, "core.js") },
        external: ["node:fs/promises"],
        // The licenses of bundled packages.
        legalComments: "eof",
        logLevel: "warning",
    });
}

await bundle([join(here, "main.js"), join(here, "worker.js")], out, engine);
if (existsSync(join(threaded, "core.js"))) {
    const worker = { in: join(here, "threaded.js"), out: "worker" };
    await bundle([worker, { in: join(here, "thread.js"), out: "thread" }], join(out, "threads"), threaded);
    copyFileSync(join(threaded, "core_bg.wasm"), join(out, "threads/core_bg.wasm"));
}
for (const name of ["index.html", "download.js", "style.css", "icon.svg"]) {
    copyFileSync(join(here, name), join(out, name));
}
for (const name of ["core_bg.wasm", "LICENSE-APACHE", "LICENSE-MIT"]) {
    copyFileSync(join(engine, name), join(out, name));
}
const licenses = ["@codemirror/view", "three"].map((name) =>
    `${name}\n\n${readFileSync(join(tools, "node_modules", name, "LICENSE"), "utf8")}`);
writeFileSync(join(out, "LICENSE-bundled.txt"), licenses.join("\n\n"));

// The scenes, with their texts and files in one file, and a picture of each.
const { Session, load } = await import(pathToFileURL(join(engine, "meshwright.js")).href);
await load();
const names = readFileSync(join(root, "tests/digests.txt"), "utf8").trim().split("\n").map((line) => line.split(" ")[0]);
const files = {};
/// Scenes whose z-axis points upwards, apart from those whose recipes have a picture that says so.
const Z_UP = ["figure", "mirrored_head", "warrior"];
const scenes = names.map((name) => {
    const session = new Session();
    const recipe = readFileSync(join(root, `scenes/${name}.ron`), "utf8");
    const reads = [...recipe.matchAll(/"((?:assets|lib)\/[^"]+)"/g)].map((match) => match[1]);
    for (const path of reads) {
        const bytes = readFileSync(join(root, "scenes", path));
        files[path] = bytes.toString("base64");
        session.write(path, bytes);
    }
    const result = session.run(recipe);
    if (!result.succeeded) {
        throw new Error(`${name}: ${JSON.stringify(result.problems)}`);
    }
    const up = Z_UP.includes(name) || recipe.includes("up: Z") ? "z" : "auto";
    writeFileSync(join(out, `gallery/${name}.png`), session.picture({ width: 240, height: 180, up }));
    session.free();
    const about = recipe.match(/^ {4}about: "((?:[^"\\]|\\.)*)"/m)?.[1] ?? "";
    return { name, about, recipe, reads: [...new Set(reads)], up };
});
writeFileSync(join(out, "gallery/scenes.json"), JSON.stringify({ scenes, files }));
