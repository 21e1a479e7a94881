// Writes the page: bundles the scripts, copies the engine, and renders the gallery. Usage:
// bundle.mjs PACKAGE THREADS TOOLS OUT. THREADS is the folder of the package with threads, which may be missing.
import { copyFileSync, cpSync, existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createHash } from "node:crypto";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { brotliCompressSync } from "node:zlib";

const [engine, threaded, tools, out] = process.argv.slice(2).map((path) => resolve(path));
const here = new URL(".", import.meta.url).pathname;
const root = join(here, "../../..");
const esbuild = createRequire(join(tools, "package.json"))("esbuild");

rmSync(out, { recursive: true, force: true });
mkdirSync(join(out, "gallery"), { recursive: true });

/// The nonce of the styles of CodeMirror. The page is a static file, so the nonce is the same for all visitors. Only
/// injected markup could misuse the nonce, and the page never makes markup from texts.
const nonce = createHash("sha256").update(readFileSync(join(engine, "core_bg.wasm"))).digest("base64");

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
        define: { STYLE_NONCE: JSON.stringify(nonce) },
        // The licenses of bundled packages.
        legalComments: "eof",
        logLevel: "warning",
    });
}

await bundle([join(here, "main.js"), join(here, "worker.js")], out, engine);
if (existsSync(join(threaded, "core.js"))) {
    const worker = { in: join(here, "threaded.js"), out: "worker" };
    await bundle([worker, { in: join(here, "thread.js"), out: "thread" }], join(out, "threads"), threaded);
    for (const name of ["core_bg.wasm", "core_bg.wasm.br"]) {
        copyFileSync(join(threaded, name), join(out, "threads", name));
    }
}
for (const name of ["download.js", "style.css", "operations.css", "operations.js", "icon.svg"]) {
    copyFileSync(join(here, name), join(out, name));
}
writeFileSync(join(out, "index.html"), readFileSync(join(here, "index.html"), "utf8").replace("STYLE_NONCE", nonce));
for (const name of ["core_bg.wasm", "core_bg.wasm.br", "LICENSE-APACHE", "LICENSE-MIT"]) {
    copyFileSync(join(engine, name), join(out, name));
}
const licenses = ["@codemirror/view", "three"].map((name) =>
    `${name}\n\n${readFileSync(join(tools, "node_modules", name, "LICENSE"), "utf8")}`);
writeFileSync(join(out, "LICENSE-bundled.txt"), licenses.join("\n\n"));

// The reference of operations, with an anchor for each heading.
const { marked } = await import(pathToFileURL(createRequire(join(tools, "package.json")).resolve("marked")).href);
marked.use({ renderer: {
    heading({ tokens, depth, text }) {
        const id = text.toLowerCase().replace(/[^\w -]/g, "").replaceAll(" ", "-");
        return `<h${depth} id="${id}">${this.parser.parseInline(tokens)}</h${depth}>\n`;
    },
    image: ({ href, text }) => `<img src="${href}" alt="${text}" loading="lazy">`,
} });
const reference = readFileSync(join(root, "ops/README.md"), "utf8").replaceAll("](all/pictures/", "](pictures/");
const frame = readFileSync(join(here, "operations.html"), "utf8");
writeFileSync(join(out, "operations.html"), frame.replace("REFERENCE", () => marked.parse(reference)));
cpSync(join(root, "ops/all/pictures"), join(out, "pictures"), { recursive: true });

// The scenes of the gallery: a picture of each scene, and scenes.json with all recipes and the files that they read.
const { Session, load } = await import(pathToFileURL(join(engine, "meshwright.js")).href);
await load();
const names = readFileSync(join(root, "tests/digests.txt"), "utf8").trim().split("\n").map((line) => line.split(" ")[0]);
const files = {};
/// Scenes whose z axis points upwards although their recipes do not say so with `up: Z`.
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

// Writes compressed copies of the files, because some servers send compressed files. The engine is already compressed.
for (const name of ["main.js", "worker.js", "operations.html", "gallery/scenes.json"]) {
    writeFileSync(join(out, `${name}.br`), brotliCompressSync(readFileSync(join(out, name))));
}
