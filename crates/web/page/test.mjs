// Tests the page in Chromium: test.mjs PAGE TOOLS CHROMIUM. Pictures of the page are written to TOOLS.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { deflateRawSync } from "node:zlib";
import { chromium, serve } from "./browser.mjs";

const [folder, tools, executable] = process.argv.slice(2).map((path) => resolve(path));
const root = new URL("../../../", import.meta.url).pathname;
const server = await serve(folder);
let origin = `http://127.0.0.1:${server.address().port}`;
let browser = await chromium(tools, executable);

/// Opens the page in a new profile, and records errors and requests to other servers, which must not happen.
async function open({ fragment = "", size = [1280, 800], scheme = "light", before = () => {} } = {}) {
    const context = await browser.newContext({ viewport: { width: size[0], height: size[1] }, colorScheme: scheme });
    const page = await context.newPage();
    page.failures = [];
    page.on("console", (message) => message.type() === "error" && page.failures.push(message.text()));
    page.on("pageerror", (error) => page.failures.push(String(error)));
    page.on("dialog", (dialog) => { page.failures.push(`dialog: ${dialog.message()}`); dialog.dismiss(); });
    page.on("request", (request) => {
        if (!request.url().startsWith(`${origin}/`) && !request.url().startsWith(`blob:${origin}/`)) {
            page.failures.push(`request to ${request.url()}`);
        }
    });
    await page.addInitScript(() => {
        document.addEventListener("securitypolicyviolation", (event) => console.error(`policy: ${event.violatedDirective}`));
    });
    await before(page);
    page.begin = performance.now();
    await page.goto(`${origin}/${fragment}`);
    return page;
}

async function close(page) {
    assert.deepEqual(page.failures, []);
    await page.context().close();
}

const ready = (page) => page.waitForSelector("body[data-ready]");
const text = (page, selector) => page.locator(selector).innerText();

/// Replaces the recipe, as if a visitor pasted a text.
async function write(page, recipe) {
    await page.locator(".cm-content").click();
    await page.keyboard.press("Control+A");
    await page.keyboard.insertText(recipe);
}

/// Runs the recipe, and returns its digest, which is empty if the run failed.
async function run(page) {
    await page.locator("#run").click();
    await page.waitForSelector("#run:visible");
    return text(page, "#digest");
}

/// Drops a file. `content` is a string or bytes.
async function drop(page, name, content) {
    await page.evaluate(([name, base64]) => {
        const transfer = new DataTransfer();
        transfer.items.add(new File([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], name));
        for (const type of ["dragover", "drop"]) {
            document.body.dispatchEvent(new DragEvent(type, { dataTransfer: transfer, bubbles: true, cancelable: true }));
        }
    }, [name, Buffer.from(content).toString("base64")]);
}

/// The built program; `undefined` if it is not built.
const program = [process.env.CARGO_TARGET_DIR ?? join(root, "target")]
    .flatMap((target) => ["release", "debug"].map((profile) => join(target, profile, "meshwright"))).find(existsSync);

/// Runs a recipe with the program, and returns its digest.
function nativeDigest(recipe, files = {}) {
    const folder = join(tools, "native");
    mkdirSync(folder, { recursive: true });
    for (const [name, content] of Object.entries({ ...files, "recipe.ron": recipe })) {
        writeFileSync(join(folder, name), content);
    }
    const output = execFileSync(program, ["run", "--no-cache", "recipe.ron"], { cwd: folder, encoding: "utf8" });
    return output.match(/^digest (\S+)$/m)[1];
}

async function downloaded(page, action) {
    const waiting = page.waitForEvent("download");
    await action();
    return readFileSync(await (await waiting).path());
}

/// Returns the number of vertices that are outside of the view. This function is evaluated in the page.
function outside() {
    const { view, meshes: [mesh] } = meshwright.stage;
    const box = document.querySelector("#canvas").getBoundingClientRect();
    const places = Array.from({ length: mesh.positions.length / 3 }, (_, v) => view.project(mesh, v));
    return places.filter(([x, y]) => x < box.left || x > box.right || y < box.top || y > box.bottom).length;
}

const screenshot = (page, name) => page.screenshot({ path: join(tools, `${name}.png`) });

const tests = {
    async "a first visit runs the first recipe"(page) {
        await page.waitForSelector("#digest-part:visible");
        console.log(`  load and first picture: ${Math.round(performance.now() - page.begin)} ms`);
        await ready(page);
        assert.equal(await text(page, "#met"), "3 of 3 met");
        // Shortly after the run, the page checks the text. This check must not remove the results of the run.
        await page.waitForTimeout(300);
        assert.match(await text(page, "#summary"), /^6 of 6 steps/);
        await screenshot(page, "first");
    },

    async "the teapot of the gallery has the digest of the program"(page) {
        await ready(page);
        await page.locator("#open-gallery").click();
        await screenshot(page, "gallery");
        await page.getByRole("button", { name: "teapot" }).click();
        await page.waitForSelector("#digest-part:visible");
        const [, digest] = readFileSync(join(root, "tests/digests.txt"), "utf8").match(/^teapot (\S+)$/m);
        assert.equal(await text(page, "#digest"), digest);
        assert.equal(await page.locator("#expectations .unmet").count(), 0);
        await screenshot(page, "teapot");
        const output = await downloaded(page, () => page.getByRole("button", { name: "Download teapot.png" }).click());
        // The provenance in this file and in the stored file differs, but both files have the same size. The recipe
        // itself compares the pixels.
        assert.equal(output.length, readFileSync(join(root, "scenes/assets/goldens/teapot.png")).length);
        // The gallery replaces the text as one change.
        await page.locator(".cm-content").click();
        await page.keyboard.press("Control+Z");
        assert.match(await page.evaluate(() => meshwright.editor.text), /jack/);
    },

    async "keys undo a step that was added outside of the text"(page) {
        await ready(page);
        await page.locator("#open-gallery").click();
        await page.getByRole("button", { name: "Start from a cube" }).click();
        const faces = (n) => page.waitForFunction((n) => {
            const shown = [...document.querySelectorAll("#steps tr.done td:nth-child(4)")].at(-1)?.textContent;
            return document.querySelector("#status").textContent === "Done" && shown === String(n);
        }, n);
        await faces(6);
        await page.evaluate(() => {
            meshwright.editor.addStep("CatmullClark(levels: 1)");
            document.activeElement.blur();
        });
        assert.equal(await text(page, "#status"), "Changed since the last run");
        await page.keyboard.press("Control+Enter");
        await faces(24);
        await page.keyboard.press("Control+z");
        await faces(6);
        // Undo does not remove the first text of the page.
        for (let i = 0; i < 5; i += 1) {
            await page.keyboard.press("Control+z");
        }
        assert.match(await page.evaluate(() => meshwright.editor.text), /jack/);
    },

    async "a mistyped operation is shown at its line while typing, and below its line after a run"(page) {
        await ready(page);
        await write(page, "(recipe: 1, steps: [\n    Cube(name: \"a\"),\n    Flipedges(edges: Between(0, 1)),\n])");
        await page.waitForSelector("#problem-list .error");
        assert.match(await text(page, "#problem-list"), /3:5\s*error\s*unknown operation `Flipedges`\s*did you mean `FlipEdges`/);
        assert.equal(await text(page, ".cm-lintRange-error"), "Flipedges");
        assert.equal(await page.locator(".line-message").count(), 0);
        await run(page);
        assert.match(await text(page, ".line-message"), /unknown operation/);
        assert.equal(await page.locator("#digest-part").isVisible(), false);
        await screenshot(page, "problem");
        await page.locator("#problem-list button").press("Enter");
        assert.equal(await page.evaluate(() => getSelection().toString()), "Flipedges");
        const milliseconds = await page.evaluate(async () => {
            const begin = performance.now();
            for (let i = 0; i < 20; i += 1) {
                await meshwright.engine.check(meshwright.editor.text, {});
            }
            return (performance.now() - begin) / 20;
        });
        console.log(`  a check takes ${milliseconds.toFixed(1)} ms`);
        assert(milliseconds < 20);
    },

    async "a failed step and an unmet expectation are shown"(page) {
        await ready(page);
        await write(page, "(recipe: 1, steps: [\n    Cube(name: \"a\", triangles: true),\n    FlipEdges(edges: Expect(count: 3, of: Between(0, 1))),\n])");
        assert.equal(await run(page), "");
        assert.equal(await page.locator("tr.failed th").innerText(), "2 FlipEdges");
        assert.equal(await page.locator(".line-message").count(), 1);
        await write(page, "(recipe: 1, steps: [Cube(name: \"a\")], expect: [Faces(eq: 6), Faces(eq: 7)])");
        await run(page);
        assert.match(await text(page, "#expectations"), /✓ met\s*Faces\(eq: 6\)\s*✗ not met\s*Faces\(eq: 7\)/);
    },

    async "completion offers operations, fields and values"(page) {
        await ready(page);
        const offered = async (before) => {
            await write(page, before);
            await page.keyboard.press("Control+Space");
            await page.waitForSelector(".cm-tooltip-autocomplete li");
            return (await page.locator(".cm-tooltip-autocomplete li .cm-completionLabel").allInnerTexts());
        };
        const operations = await offered("(recipe: 1, steps: [Cube(name: \"a\"), FlipE");
        assert.equal(operations[0], "FlipEdges");
        await screenshot(page, "completion");
        await page.waitForTimeout(100);
        await page.keyboard.press("Enter");
        assert.match(await page.evaluate(() => meshwright.editor.text), /FlipEdges\(edges: All\),/);
        assert((await offered("(recipe: 1, steps: [(id: \"x\", run: FlipEdges(")).includes("edges"));
        assert((await offered("(recipe: 1, steps: [FlipEdges(edges: Or([Bet")).includes("Between"));
        assert.deepEqual(await offered("(recipe: 1, steps: [FlipEdges(edges: All, on_refusal: S")
            .then((all) => all.slice(0, 1)), ["Skip"]);
        assert((await offered("(recipe: 1, ste")).includes("steps"));
    },

    async "a slider runs only the steps that depend on it"(page) {
        await ready(page);
        await write(page, `(recipe: 1, params: { "levels": Int(default: 3, min: 0, max: 5), "angle": Float(default: 10, min: 0, max: 90) },
            presets: { "coarse": { "levels": 1, "angle": 45 } },
            steps: [Cube(name: "a"), CatmullClark(levels: arg("levels")), Twist(axis: Y, angle: arg("angle"))], expect: [Closed])`);
        await page.waitForFunction(() => /^3 steps, at most [\d.]+ kB of memory for meshes$/.test(document.querySelector("#summary").textContent));
        const first = await run(page);
        const times = () => page.locator("#steps tr.done td:nth-child(5)").allInnerTexts();
        assert.match((await times()).join(), /^[\d.]+ ms,[\d.]+ ms,[\d.]+ ms$/);
        const changed = async (action) => {
            const before = await text(page, "#digest");
            await action();
            await page.waitForFunction((before) => !["", before].includes(document.querySelector("#digest").textContent), before);
            await page.waitForSelector("#run:visible");
        };
        await changed(() => page.locator("#fields input[type=range]").nth(1).fill("20"));
        assert.match((await times()).join(), /^cached,cached,[\d.]+ ms$/);
        assert.equal(await text(page, "#met"), "1 of 1 met");
        await changed(() => page.locator("#reset").click());
        assert.equal(await text(page, "#digest"), first);
        await changed(() => page.locator("#preset").selectOption("coarse"));
        assert.match((await times()).join(), /^cached,[\d.]+ ms,[\d.]+ ms$/);
        assert.equal(await page.locator("#parameter-levels").inputValue(), "1");
        assert.equal(await page.locator("#parameter-angle").inputValue(), "45");
    },

    async "a slider runs the recipe with another value"(page) {
        await ready(page);
        const faces = () => page.locator("#steps tr.done").nth(4).locator("td").nth(2).innerText();
        assert.equal(await faces(), "3,456");
        await page.locator("#fields input[type=range]").nth(2).fill("1");
        await page.waitForFunction(() => /Reset/.test(document.querySelector("#parameters").innerText)
            && document.querySelector("#steps tr:nth-child(9) td:nth-child(4)").textContent === "216");
        assert.equal(await page.locator("#parameter-levels").inputValue(), "1");
        // If the shared recipe is opened, it has the value of the slider, and the same digest.
        const digest = await text(page, "#digest");
        await page.locator("#share").click();
        await page.waitForSelector("#link:visible");
        const url = await page.locator("#link").inputValue();
        assert.match(url, /p\.levels=1/);
        const other = await open({ fragment: url.slice(url.indexOf("#")) });
        await ready(other);
        assert.equal(await text(other, "#digest"), digest);
        await close(other);
        await page.locator("#close-link").click();
        await page.locator("#reset").click();
        await page.waitForFunction(() => document.querySelector("#steps tr:nth-child(9) td:nth-child(4)").textContent === "3,456");
    },

    async "a dropped model is loaded by a recipe"(page) {
        await ready(page);
        await drop(page, "roof.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
        await page.getByRole("button", { name: "New recipe" }).click();
        assert.match(await run(page), /^[0-9a-f]{32}$/);
        assert.match(await text(page, "#steps"), /Load\s*4\s*4\s*1/);
        await screenshot(page, "dropped");
        await page.getByRole("button", { name: "Remove roof.obj" }).click();
        await page.waitForSelector("#problem-list .error");
        // The view still shows the mesh, and can color it by another quantity.
        await page.locator("#color-by").selectOption({ label: "area" });
        await page.waitForFunction(() => document.querySelector("#legend").textContent.startsWith("area"));
        assert.equal(await page.locator("#notice").isVisible(), false);
    },

    async "models of all formats are dropped"(page) {
        const { run: runInNode } = await import(pathToFileURL(join(folder, "../meshwright.js")).href);
        const { outputs } = await runInNode(`(recipe: 1, steps: [Cube(name: "a"), Triangulate(),
            Save(path: "a.gltf"), Save(path: "a.glb"), Save(path: "a.ply"), Save(path: "a.stl"), Save(path: "a.off")])`);
        const models = [...Object.entries(outputs), ["teapot.bez", readFileSync(join(root, "scenes/assets/teapot.bez"))]];
        assert(models.length >= 6);
        await ready(page);
        for (const [name, content] of models) {
            await drop(page, name, content);
            await page.getByRole("button", { name: name.endsWith(".bin") ? "Close the message" : "New recipe" }).click();
        }
        for (const [name] of models.filter(([name]) => !name.endsWith(".bin"))) {
            await write(page, `(recipe: 1, steps: [Load(path: "${name}")])`);
            assert.match(await run(page), /^[0-9a-f]{32}$/, name);
            assert.match(await text(page, "#steps"), name.endsWith(".bez") ? /Load\s*0\s*0\s*0/ : /Load\s*8\s*18\s*12/, name);
        }
    },

    async "a dropped folder keeps its structure"(page) {
        await ready(page);
        const model = join(tools, "model");
        mkdirSync(join(model, "textures/.hidden"), { recursive: true });
        writeFileSync(join(model, "roof.obj"), "mtllib roof.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nusemtl a\nf 1/1 2/2 3/3\n");
        writeFileSync(join(model, "roof.mtl"), "newmtl a\nmap_Kd textures/red.png\n");
        writeFileSync(join(model, "textures/red.png"), readFileSync(join(folder, "gallery/teapot.png")));
        writeFileSync(join(model, "textures/.hidden/secret.txt"), "");
        const session = await page.context().newCDPSession(page);
        for (const type of ["dragEnter", "dragOver", "drop"]) {
            await session.send("Input.dispatchDragEvent", { type, x: 600, y: 300, data: { items: [], files: [model], dragOperationsMask: 1 } });
        }
        await page.waitForSelector("#notice button");
        const paths = ["model/roof.mtl", "model/roof.obj", "model/textures/red.png"];
        assert.deepEqual((await page.locator("#inputs .path").allInnerTexts()).sort(), paths);
        await write(page, "(recipe: 1, steps: [Load(path: \"model/roof.obj\"), Save(path: \"a.glb\")])");
        assert.match(await run(page), /^[0-9a-f]{32}$/);
        assert.equal((await page.locator(".notes:visible").allInnerTexts()).join(), "", "nothing is lost");
        for (const path of paths) {
            await page.getByRole("button", { name: `Remove ${path}` }).click();
        }
        await page.locator("#folder-input").setInputFiles(model);
        await page.waitForFunction(() => document.querySelectorAll("#inputs .path").length === 3);
        assert.deepEqual((await page.locator("#inputs .path").allInnerTexts()).sort(), paths);
    },

    async "a file of 100 MB is loaded"(page) {
        // A binary STL file with a sheet of triangles.
        const size = 1000;
        const bytes = Buffer.alloc(84 + 50 * 2 * size * size);
        bytes.writeUInt32LE(2 * size * size, 80);
        let at = 84;
        for (let i = 0; i < size; i += 1) {
            for (let j = 0; j < size; j += 1) {
                for (const corners of [[[0, 0], [1, 0], [1, 1]], [[0, 0], [1, 1], [0, 1]]]) {
                    at += 12;
                    for (const [x, y] of corners) {
                        bytes.writeFloatLE(i + x, at);
                        bytes.writeFloatLE(j + y, at + 4);
                        bytes.writeFloatLE(((i + x) * (j + y)) % 7, at + 8);
                        at += 12;
                    }
                    at += 2;
                }
            }
        }
        writeFileSync(join(tools, "large.stl"), bytes);
        await ready(page);
        page.setDefaultTimeout(120_000);
        await page.locator("#file-input").setInputFiles(join(tools, "large.stl"));
        await page.getByRole("button", { name: "New recipe" }).click();
        const begin = performance.now();
        const digest = await run(page);
        console.log(`  ${(bytes.length / 1e6).toFixed(0)} MB are loaded and shown after ${((performance.now() - begin) / 1000).toFixed(1)} s`);
        assert.match(await text(page, "#steps"), /Load\s*1,002,001\s*3,002,000\s*2,000,000/);
        if (program) {
            assert.equal(digest, nativeDigest("(recipe: 1, steps: [Load(path: \"large.stl\")])", { "large.stl": bytes }));
        }
    },

    async "pictures are downloaded"(page) {
        await ready(page);
        const picture = () => downloaded(page, () => page.locator("#save-picture").click());
        const isPng = (bytes) => bytes.subarray(0, 8).equals(Buffer.from("\x89PNG\r\n\x1a\n", "latin1"));
        assert(isPng(await picture()));
        // The view does not show patches, so the engine renders the picture of this recipe.
        await page.locator("#open-gallery").click();
        await page.getByRole("button", { name: "teapot" }).click();
        await page.waitForSelector("#digest-part:visible");
        await write(page, "(recipe: 1, steps: [Load(path: \"assets/teapot.bez\")])");
        assert.notEqual(await run(page), "");
        const rendered = await picture();
        assert(isPng(rendered));
        assert.deepEqual([rendered.readUInt32BE(16), rendered.readUInt32BE(20)], [1280, 960]);
    },

    async "the page works without the gallery"(page) {
        await page.route("**/scenes.json", (route) => route.abort());
        await page.reload();
        await ready(page);
        await page.waitForSelector("#digest-part:visible");
        await page.locator("#open-gallery").click();
        await page.waitForFunction(() => /cannot be loaded/.test(document.querySelector("#scenes").textContent));
        await page.keyboard.press("Escape");
        // A link that needs no scene does not load the scenes.
        let requests = 0;
        await page.unroute("**/scenes.json");
        await page.route("**/scenes.json", (route) => { requests += 1; return route.abort(); });
        await page.evaluate((fragment) => (location.hash = fragment),
            `#r=${deflateRawSync("(recipe: 1, steps: [Cube()])").toString("base64url")}`);
        await page.waitForSelector("#notice:visible");
        assert.match(await run(page), /^[0-9a-f]{32}$/);
        assert.equal(requests, 0);
        await page.unroute("**/scenes.json");
        await page.locator("#open-gallery").click();
        await page.locator("#scenes button").first().click();
        await page.waitForSelector("#digest-part:visible");
        page.failures = page.failures.filter((failure) => !failure.includes("ERR_FAILED"));
    },

    async "the help lists keys, and links the reference of operations"(page) {
        await ready(page);
        await page.locator("#open-help").click();
        assert.match(await text(page, "#help"), /Ctrl Enter\s*Run the recipe/);
        await screenshot(page, "help");
        const [reference] = await Promise.all([page.context().waitForEvent("page"), page.locator("#help a").click()]);
        await reference.waitForLoadState();
        assert.equal(await reference.locator("h2#flipedges").innerText(), "FlipEdges");
        assert(await reference.locator("#flipedges ~ p img").first().evaluate((image) => {
            image.loading = "eager";
            return image.decode().then(() => image.naturalWidth > 0);
        }));
        await reference.evaluate(() => document.querySelector("#flipedges").scrollIntoView());
        await screenshot(reference, "operations");
        // The search finds an operation if its name or its summary contains all words.
        const entries = () => reference.locator("body > ul:first-of-type > li:visible a").allInnerTexts();
        const all = (await entries()).length;
        assert.equal(await text(reference, "#found"), `${all} of ${all} operations`);
        await reference.locator("#search").fill("SPLIT smooth");
        assert.deepEqual((await entries()).slice(0, 2), ["LoopSubdivide", "CatmullClark"]);
        assert.equal(await reference.locator("#loopsubdivide").isVisible(), true);
        assert.equal(await reference.locator("#flipedges").isVisible(), false);
        assert.equal(await reference.locator("h2:visible").count(), (await entries()).length);
        await screenshot(reference, "search");
        await reference.evaluate(() => (location.hash = "#flipedges"));
        await reference.waitForSelector("#flipedges:visible");
        await page.keyboard.press("Escape");
        assert.equal(await page.locator("#help").isVisible(), false);
    },

    async "a picked edge is inserted, flipped and split, and the output loads again"(page) {
        await ready(page);
        await write(page, "(recipe: 1, steps: [\n    Cube(name: \"cube\", triangles: true),\n])");
        await run(page);
        await page.getByLabel("Edge", { exact: true }).check();
        // The edge between the front and the right side of the cube. The camera sees this edge.
        const [v, w, x, y] = await page.evaluate(() => {
            const { view, meshes: [mesh] } = meshwright.stage;
            const corners = [0, 1, 2, 3, 4, 5, 6, 7].filter((i) => mesh.positions[3 * i] > 0 && mesh.positions[3 * i + 2] > 0);
            const [p, q] = corners.map((vertex) => view.project(mesh, vertex));
            return [...corners, (p[0] + q[0]) / 2, (p[1] + q[1]) / 2];
        });
        await page.mouse.click(x, y);
        assert.match(await text(page, "#picked"), new RegExp(`vertices (${v} and ${w}|${w} and ${v}), length 2$`));
        await screenshot(page, "picked");
        await write(page, "(recipe: 1, steps: [\n    Cube(name: \"cube\", triangles: true),\n    FlipEdges(edges: ");
        await page.locator("#insert").click();
        await page.keyboard.insertText("),\n    Save(path: \"flipped.obj\"),\n])");
        const recipe = await page.evaluate(() => meshwright.editor.text);
        assert.match(recipe, /FlipEdges\(edges: Between\(\d, \d\)\),/);
        const digest = await run(page);
        assert.match(digest, /^[0-9a-f]{32}$/);
        if (program) {
            assert.equal(digest, nativeDigest(recipe));
        } else {
            console.log("  the program is not built, so its digest is not compared");
        }
        // The edge is picked by its number, as people without a mouse do.
        await page.locator("#number").fill("0");
        const flipped = await downloaded(page, () => page.getByRole("button", { name: "Download flipped.obj" }).click());
        await page.locator("#add-step").selectOption({ label: "SplitEdges" });
        assert.match(await page.evaluate(() => meshwright.editor.text), /SplitEdges\(edges: Between\(\d, \d\)\),\n\]/);
        assert.notEqual(await run(page), "");
        await drop(page, "again.obj", flipped.toString());
        await page.getByRole("button", { name: "New recipe" }).click();
        assert.notEqual(await run(page), "");
        assert.match(await text(page, "#steps"), /Load\s*8\s*18\s*12/);
    },

    async "a run is canceled at once, and another can run"(page) {
        await ready(page);
        await page.locator("#color-by").selectOption({ label: "valence" });
        await page.waitForFunction(() => document.querySelector("#legend").textContent.startsWith("valence"));
        await write(page, "(recipe: 1, steps: [\n    Cube(name: \"a\"), Triangulate(), LoopSubdivide(levels: 8), Simplify(ratio: 0.1),\n])");
        await page.locator("#run").click();
        await page.waitForSelector("tr.running");
        const milliseconds = await page.evaluate(() => new Promise((resolve) => {
            const begin = performance.now();
            new MutationObserver(() => resolve(performance.now() - begin)).observe(document.querySelector("#run"), { attributes: true });
            document.querySelector("#cancel").click();
        }));
        console.log(`  a cancel takes ${milliseconds.toFixed(1)} ms`);
        assert(milliseconds < 1000);
        assert.match(await text(page, "#steps"), /canceled/);
        // The view keeps the meshes of the first run, and their colors. The new engine has no scene for other colors.
        assert.notEqual(await page.evaluate(() => meshwright.stage.meshes.length), 0);
        assert.match(await text(page, "#legend"), /^valence/);
        assert.equal(await page.locator("#color-by").isDisabled(), true);
        await write(page, "(recipe: 1, steps: [Cube(name: \"a\")])");
        const begin = performance.now();
        assert.match(await run(page), /^[0-9a-f]{32}$/);
        console.log(`  the next run ends after ${Math.round(performance.now() - begin)} ms`);
        assert.equal(await page.locator("#color-by").isDisabled(), false);
        assert.match(await text(page, "#legend"), /^valence/);
    },

    async "hostile file names and contents do nothing"(page) {
        await ready(page);
        const triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
        for (const [name, kept] of [["<img src=x onerror=alert(1)>.obj", null], ["..\\..\\x.obj", "x.obj"], ["../y.obj", "y.obj"],
            ["/a/../.. /./b\u0000\u001b/z.obj", "a/b/z.obj"], ["a\"), Save(path: \"b.obj", "a\"), Save(path: \"b.obj"]]) {
            await drop(page, name, triangle);
            await page.getByRole("button", { name: "New recipe" }).click();
            assert.notEqual(await run(page), "", name);
            assert.equal((await page.locator("#steps tr.done").count()), 1, "only the model is loaded");
            const path = (await page.locator("#inputs .path").allInnerTexts()).at(-1);
            assert(kept === null || path === kept, path);
        }
        await drop(page, "..", triangle);
        await drop(page, "broken.glb", "glTF\u0002\u0000\u0000\u0000");
        await page.getByRole("button", { name: "New recipe" }).click();
        assert.equal(await run(page), "");
        assert.equal(await page.locator("img[onerror], main script").count(), 0);
    },

    async "the meshes of the run before are shown for comparison"(page) {
        await ready(page);
        const picture = () => page.evaluate(async () => {
            const bytes = new Uint8Array(await (await meshwright.stage.view.picture()).arrayBuffer());
            return btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(""));
        });
        const compare = (share) => page.locator("#compare-share").fill(String(share));
        await write(page, "(recipe: 1, steps: [Cube(name: \"a\"), Tetrahedron(name: \"b\")])");
        assert.notEqual(await run(page), "");
        await page.locator("#fit").click();
        const before = await picture();
        await write(page, "(recipe: 1, steps: [Cube(name: \"a\"), Midpoint(levels: 2, into: Quads), Tetrahedron(name: \"b\")])");
        assert.notEqual(await run(page), "");
        await compare(0);
        const after = await picture();
        assert.notEqual(after, before);
        await compare(100);
        assert.equal(await picture(), before);
        await compare(50);
        const both = await picture();
        assert.ok(both !== before && both !== after);
        await screenshot(page, "compared");
        await compare(0);
        assert.equal(await picture(), after);
        // The meshes of another recipe are not compared with these meshes.
        await page.locator("#open-gallery").click();
        await page.locator("#scenes button").first().click();
        await page.waitForSelector("#run:visible");
        await page.waitForFunction(() => document.querySelector("#compare").hidden);
    },

    async "a new line is indented like the list"(page) {
        await ready(page);
        for (const [start, expected] of [["(recipe: 1, steps: [", "\n    Cube"], ["(\n    recipe: 1,\n    steps: [", "\n        Cube"]]) {
            await write(page, start);
            await page.keyboard.press("Enter");
            await page.keyboard.insertText("Cube(),");
            assert((await page.evaluate(() => meshwright.editor.text)).includes(expected), expected);
        }
    },

    async "instances are shown where nodes place them, and picked there"(page) {
        await ready(page);
        await write(page, "(recipe: 1, steps: [Grid(name: \"ground\", columns: 2, rows: 2), Cube(name: \"tree\"), " +
            "Transform(scale: (0.1, 0.1, 0.1)), Scatter(surface: \"ground\", object: \"tree\", count: 9, seed: 3)])");
        assert.notEqual(await run(page), "");
        const [, tree] = await page.evaluate(() => meshwright.stage.meshes.map(({ placements }) => placements.length / 16));
        assert.equal(tree, 9);
        await page.locator("#fit").click();
        const before = await page.evaluate(() => meshwright.stage.view.project(meshwright.stage.meshes[1], 7));
        await page.mouse.click(...before);
        assert.match(await text(page, "#picked"), /^Face \d of tree: vertices/);
        await screenshot(page, "instances");
    },

    async "quantities are shown as colors, with a legend"(page) {
        await ready(page);
        const picture = () => page.evaluate(async () => {
            const bytes = new Uint8Array(await (await meshwright.stage.view.picture()).arrayBuffer());
            return btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(""));
        });
        const color = async (label) => {
            await page.locator("#color-by").selectOption({ label });
            await page.waitForFunction((label) => document.querySelector("#legend").textContent.startsWith(label), label);
        };
        await write(page, "(recipe: 1, steps: [Torus(major: 1, minor: 0.4), Cube(), (on: [\"torus\"], run: Measure(of: MeanCurvature, name: \"bend\"))])");
        assert.notEqual(await run(page), "");
        await page.locator("#edges").click();
        const plain = await picture();
        const seen = new Set([plain]);
        const labels = await page.locator("#color-by option").allInnerTexts();
        assert(labels.includes("bend") && labels.includes("min angle [°]"), String(labels));
        for (const label of labels.slice(1)) {
            await color(label);
            const now = await picture();
            assert(label === "bend" || !seen.has(now), label);
            seen.add(now);
        }
        await color("valence");
        assert.equal(await text(page, "#legend"), "valence\n 3\n 4");
        await color("mean curvature");
        assert.match(await text(page, "#legend"), /^mean curvature\n-[\d.]+\n[\d.]+$/);
        await screenshot(page, "colors");
        // The next run keeps the chosen quantity if its meshes have this quantity.
        await color("bend");
        await write(page, "(recipe: 1, steps: [Cube()])");
        await run(page);
        assert.equal(await page.locator("#color-by").inputValue(), "");
        assert.equal(await page.locator("#legend").isVisible(), false);
        await color("area");
        await run(page);
        assert.match(await text(page, "#legend"), /^area\n4\n4$/);
        await page.locator("#color-by").selectOption({ label: "Plain" });
        await page.waitForFunction(() => document.querySelector("#legend").hidden);
    },

    async "every recipe of the book runs from a link"(page) {
        await ready(page);
        const chapters = readdirSync(join(root, "book/src")).filter((name) => name.endsWith(".md"));
        const recipes = chapters.flatMap((name) => {
            const chapter = readFileSync(join(root, "book/src", name), "utf8");
            return [...chapter.matchAll(/^```ron\n(.*?)^```$/gms)].map((match) => [name, match[1]]);
        });
        assert.ok(recipes.length > 10);
        for (const [name, recipe] of recipes) {
            await page.goto(`${origin}/?book#r=${deflateRawSync(recipe).toString("base64url")}`);
            await page.reload();
            await ready(page);
            assert.equal(await page.evaluate(() => meshwright.editor.text), recipe);
            // The recipe of the link has run without a click on Run.
            assert.match(await text(page, "#digest"), /^[0-9a-f]{32}$/, `${name}:\n${recipe}`);
        }
    },

    async "hostile links give a message or a recipe that does no harm"(page) {
        await ready(page);
        const link = (content) => `#r=${deflateRawSync(content).toString("base64url")}`;
        const cases = [
            [link("<img src=x onerror=alert(1)><script>alert(2)</script>"), /comes from a link/],
            [link("(recipe: 1, steps: [Cube(name: \"<img src=x onerror=alert(1)>\")])"), /comes from a link/, 1],
            ["#r=%%%", /damaged/], ["#r=AAAA", /damaged/], ["#r=", /damaged/],
            [link(Buffer.alloc(10_000_000)), /larger than 1 MB/],
            [`#r=${"A".repeat(100_000)}`, /too long/],
            [link("(recipe: 1, steps: [Cube(name: \"a\")])") + "&p.__proto__=1&p.x=<b>", /comes from a link/, 1],
            [link("(recipe: 1, steps: [Load(path: \"absent.obj\")])"), /comes from a link/],
        ];
        for (const [fragment, expected, count = 0] of cases) {
            await page.evaluate((fragment) => {
                document.querySelector("#notice").replaceChildren();
                document.querySelector("#steps").replaceChildren();
                location.hash = fragment;
            }, fragment);
            await page.waitForSelector("#notice [role=status]");
            assert.match(await text(page, "#notice"), expected);
            await page.waitForTimeout(150);
            await page.waitForSelector("#run:visible");
            assert.equal(await page.locator("#steps tr.done").count(), count, fragment.slice(0, 99));
        }
        assert.match(await text(page, "#stage-note"), /it was not run: absent.obj/);
        assert.equal(await page.locator("main img[onerror], main script, main b").count(), 0);
        // The recipe of a link does not replace the visitor's own text, because the visitor has not edited this recipe.
        await page.goto(`${origin}/?again`);
        await ready(page);
        assert.match(await page.evaluate(() => meshwright.editor.text), /jack/);
    },

    async "the text is kept for the next visit, which runs it unless its last run did not end"(page) {
        await ready(page);
        await write(page, "(recipe: 1, steps: [Cube(name: \"kept\")])");
        await page.reload();
        await ready(page);
        assert.match(await page.evaluate(() => meshwright.editor.text), /kept/);
        assert.match(await text(page, "#digest"), /^[0-9a-f]{32}$/);
        await page.locator(".cm-line").getByText("Cube").hover();
        await page.waitForSelector(".tip");
        assert.match(await text(page, ".tip"), /Create a cube/);
        await write(page, "(recipe: 1, steps: [Cube(name: \"a\"), Triangulate(), LoopSubdivide(levels: 9)])");
        await page.locator("#run").click();
        await page.waitForSelector("#steps tr:nth-child(5).running");
        // If the visitor leaves the page during a run, the recipe runs again at the next visit.
        await page.reload();
        await page.waitForSelector("#steps tr:nth-child(5).running");
        await page.locator("#cancel").click();
        await page.waitForSelector("#run:visible");
        await page.reload();
        await ready(page);
        assert.equal(await page.locator("#steps tr.done").count(), 0);
        assert.match(await text(page, "#stage-note"), /did not end.*Press Run/);
        await page.locator("#run").click();
        await page.waitForSelector("#steps tr.running");
        await page.locator("#cancel").click();
    },

    async "a click on a step shows the meshes after it, and a step can be added there"(page) {
        await ready(page);
        await write(page, `(recipe: 1, params: { "n": Int(default: 2) }, steps: [
            Cube(name: "a"), // a cube
            Repeat(times: arg("n"), steps: [CatmullClark(levels: 1)]),
            (id: "last", run: Save(path: "a.obj"))
        ], expect: [(after: "last", that: Faces(eq: 96))])`);
        const digest = await run(page);
        const recipe = await page.evaluate(() => meshwright.editor.text);
        const step = (number) => page.locator("#steps th button").nth(number - 1).click();
        const faces = () => page.evaluate(() => new Set(meshwright.stage.meshes[0].faces).size);
        const shown = (expected) => page.waitForFunction((expected) =>
            document.querySelector("#step-text").textContent === expected && document.querySelector("#run").checkVisibility(), expected);
        await step(1);
        await shown("After step 1 of 4: Cube");
        assert.equal(await faces(), 6);
        assert.equal(await page.locator("#steps tr.shown").count(), 1);
        // The cube is larger than the meshes after the last step. The camera has moved so that the cube fits the view.
        assert.equal(await page.evaluate(outside), 0);
        await screenshot(page, "step");
        // The text and the results of the whole run are still shown.
        assert.equal(await page.evaluate(() => meshwright.editor.text), recipe);
        assert.equal(await text(page, "#digest"), digest);
        assert.equal(await page.locator("#problem-list li").count(), 0);
        assert.equal(await page.getByRole("button", { name: "Download a.obj" }).isDisabled(), true);
        // The second step is repeated, so the view shows the meshes after the last repetition.
        await step(2);
        await shown("After step 3 of 4: CatmullClark#2");
        assert.equal(await faces(), 96);
        await step(1);
        await shown("After step 1 of 4: Cube");
        await page.locator("#show-end").click();
        await page.waitForSelector("#step-shown", { state: "hidden" });
        await page.waitForSelector("#run:visible");
        assert.equal(await faces(), 96);
        assert.equal(await text(page, "#digest"), digest);
        assert.equal(await page.getByRole("button", { name: "Download a.obj" }).isDisabled(), false);
        await step(1);
        await shown("After step 1 of 4: Cube");
        await page.locator("#number").fill("0");
        assert.equal(await page.locator("#add-step option").first().innerText(), "Add after step 1");
        await page.locator("#add-step").selectOption({ label: "PokeFaces" });
        await page.waitForFunction(() => /PokeFaces\s*9/.test(document.querySelector("#steps").textContent));
        assert.match(await page.evaluate(() => meshwright.editor.text), /Cube\(name: "a"\),\n {12}PokeFaces\(faces: Faces\(\[0\]\)\), \/\/ a cube\n/);
    },

    async "subdivision is offered for picked faces and for the whole mesh, and picked elements stay picked"(page) {
        await ready(page);
        await page.locator("#open-gallery").click();
        await page.getByRole("button", { name: "Start from a cube" }).click();
        await page.waitForSelector("#digest-part:visible");
        const offered = (group) => page.locator(`#add-step optgroup[label="${group}"] option`).allInnerTexts();
        const done = (pattern) => page.waitForFunction((pattern) => document.querySelector("#run").checkVisibility()
            && new RegExp(pattern).test(document.querySelector("#steps").textContent), pattern);
        assert.deepEqual((await offered("Subdivide the mesh")).slice(0, 2), ["LoopSubdivide", "CatmullClark"]);
        assert((await offered("Whole mesh")).includes("Smooth"));
        await page.locator("#number").fill("3");
        assert((await offered("Picked face")).includes("ExtrudeFaces"));
        assert.equal(await page.locator("#add-step option", { hasText: "CatmullClark" }).first().getAttribute("value"),
            "CatmullClark(faces: Faces([3]), levels: 2)");
        assert((await offered("Subdivide the mesh")).includes("CatmullClark"));
        await page.locator("#add-step").selectOption({ label: "ExtrudeFaces" });
        await done("ExtrudeFaces\\s*12");
        assert.match(await text(page, "#picked"), /^Face 3: vertices/);
        assert.equal(await page.locator("#number").inputValue(), "3");
        // A picked edge is identified by its vertices, because its number can change. After the edge is split, no edge
        // has these vertices.
        await page.getByLabel("Edge", { exact: true }).check();
        await page.locator("#number").fill("0");
        const vertices = (await text(page, "#picked")).match(/vertices \d+ and \d+/)[0];
        await page.locator("#add-step").selectOption({ label: "TagEdges" });
        await done("TagEdges");
        assert((await text(page, "#picked")).includes(vertices));
        await page.locator("#add-step").selectOption({ label: "SplitEdges" });
        await done("SplitEdges");
        assert.equal(await text(page, "#picked"), "Click an element of a mesh to pick it.");
        // After a step for the whole mesh, the numbers belong to other elements, so no elements stay picked.
        await page.locator("#number").fill("0");
        await page.locator("#add-step").selectOption("CatmullClark(levels: 2)");
        await done("CatmullClark");
        assert.equal(await text(page, "#picked"), "Click an element of a mesh to pick it.");
    },

    async "a form changes the numbers of the step at the cursor"(page) {
        await ready(page);
        await write(page, "(recipe: 1, steps: [\n    Cube(name: \"a\"),\n])");
        await run(page);
        await page.locator("#number").fill("0");
        await page.locator("#add-step").selectOption({ label: "ExtrudeFaces" });
        await page.waitForFunction(() => document.querySelector("#step-title").textContent === "Step: ExtrudeFaces");
        const step = async (pattern) => {
            await page.waitForFunction((pattern) => new RegExp(pattern).test(meshwright.editor.text), pattern);
            await page.waitForFunction(() => document.querySelector("#status").textContent === "Done");
        };
        const top = () => page.evaluate(() => Math.max(...meshwright.stage.meshes[0].positions) - Math.min(...meshwright.stage.meshes[0].positions));
        await page.getByLabel("by: Distance").fill("3");
        await step("ExtrudeFaces\\(faces: Faces\\(\\[0\\]\\), by: Distance\\(3\\)\\),");
        assert.equal(await top(), 5);
        // The input of a field that the step does not set shows the default value as a placeholder.
        assert.equal(await page.getByLabel("scale").getAttribute("placeholder"), "1");
        await page.getByLabel("scale").fill("0.5");
        await step("by: Distance\\(3\\), scale: 0.5\\),");
        await page.locator("#add-step").selectOption({ label: "CatmullClark" });
        await page.getByLabel("levels").fill("1");
        await step("CatmullClark\\(faces: Faces\\(\\[0\\]\\), levels: 1\\),");
        await page.getByLabel("boundary").selectOption("EdgesAndCorners");
        await step("levels: 1, boundary: EdgesAndCorners\\),");
        await page.locator("#add-step").selectOption("CatmullClark(levels: 2)");
        await page.waitForFunction(() => document.querySelector("#step-fields input").value === "2");
        await page.getByLabel("to_limit").check();
        await step("CatmullClark\\(levels: 2, to_limit: true\\),");
        await screenshot(page, "form");
        // A click on a step moves the cursor there.
        await page.locator("#steps th button").nth(1).click();
        await page.waitForFunction(() => document.querySelector("#step-title").textContent === "Step: ExtrudeFaces");
        assert.equal(await page.getByLabel("by: Distance").inputValue(), "3");
    },

    async "Fit keeps the direction of the view, and a double click resets it"(page) {
        await ready(page);
        const place = () => page.evaluate(() => [0, 7].flatMap((v) => meshwright.stage.view.project(meshwright.stage.meshes[0], v)).map(Math.round));
        const first = await place();
        await page.locator("#canvas").focus();
        await page.keyboard.press("ArrowLeft");
        await page.locator("#fit").click();
        const turned = await place();
        assert.notDeepEqual(turned, first);
        await page.locator("#canvas").focus();
        for (let i = 0; i < 9; i += 1) {
            await page.keyboard.press("+");
        }
        assert.notEqual(await page.evaluate(outside), 0);
        await page.locator("#fit").click();
        assert.deepEqual(await place(), turned);
        await page.locator("#fit").dblclick();
        assert.deepEqual(await place(), first);
    },

    async "messages name no commands of the program"(page) {
        await ready(page);
        const helps = {
            "steps: [Xyzzy()]": "the reference, linked below the recipe, lists all operations",
            "steps: [Cube(), FlipEdges(edges: Xyzzy)]": "Ctrl+Space lists all selections",
            "steps: [Cube()], expect: [Xyzzy]": "Ctrl+Space lists all expectations",
        };
        for (const [content, help] of Object.entries(helps)) {
            await write(page, `(recipe: 1, ${content})`);
            await page.waitForFunction((help) => document.querySelector("#problem-list .help")?.textContent === help, help);
            await run(page);
            assert((await text(page, ".line-message")).includes(help));
        }
        const [reference] = await Promise.all([page.context().waitForEvent("page"), page.locator("#problems a").click()]);
        await reference.waitForSelector("#flipedges");
    },

    async "the layout shows the digest, long steps and picked elements"(page) {
        await ready(page);
        const isInside = (selector) => page.evaluate((selector) => {
            const { left, right, top, bottom } = document.querySelector(selector).getBoundingClientRect();
            return left >= 0 && top >= 0 && right <= innerWidth && bottom <= innerHeight;
        }, selector);
        assert(await isInside("#copy-digest"));
        await page.evaluate(() => {
            const faces = Array.from({ length: 60 }, (_, i) => i).join(", ");
            meshwright.editor.addStep(`ExtrudeFaces(faces: Faces([${faces}]), by: Distance(0.01))`);
        });
        assert.notEqual(await run(page), "");
        assert(await isInside("#digest"));
        for (const selector of ["html", "body", "main", ".cm-scroller"]) {
            assert(await page.evaluate((selector) => {
                const { scrollLeft, scrollWidth, clientWidth } = document.querySelector(selector);
                return scrollLeft === 0 && scrollWidth <= clientWidth;
            }, selector), `${selector} does not scroll sideways`);
        }
        for (const kind of ["Edge", "Vertex", "Face"]) {
            await page.getByLabel(kind, { exact: true }).check();
            await page.locator("#number").fill("1234");
            assert.match(await text(page, "#picked"), new RegExp(`^${kind} 1234: `));
            assert(await page.locator("#picked").evaluate((part) => part.scrollWidth <= part.clientWidth && part.scrollHeight <= part.clientHeight), kind);
            assert(await isInside("#add-step"));
        }
    },

    async "the view turns with keys, and a selection has several elements"(page) {
        await ready(page);
        await write(page, "(recipe: 1, steps: [\n    Cube(name: \"cube\"),\n])");
        await run(page);
        const place = () => page.evaluate(() => meshwright.stage.view.project(meshwright.stage.meshes[0], 7));
        const before = await place();
        await page.locator("#canvas").focus();
        await page.keyboard.press("ArrowLeft");
        await page.keyboard.press("ArrowDown");
        assert.notDeepEqual(await place(), before);
        const box = await page.locator("#canvas").boundingBox();
        const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
        await page.locator("#several").click();
        await page.mouse.click(x, y);
        await page.mouse.click(x, y - box.height * 0.3);
        assert.equal(await text(page, "#picked"), "2 faces");
        await screenshot(page, "faces");
        // A step that is added for picked elements runs at once.
        await page.locator("#add-step").selectOption({ label: "ExtrudeFaces" });
        assert.match(await page.evaluate(() => meshwright.editor.text), /\n    ExtrudeFaces\(faces: Faces\(\[\d, \d\]\), by: Distance\(0.5\)\),\n\]/);
        await page.waitForFunction(() => /ExtrudeFaces\s*1\d/.test(document.querySelector("#steps").textContent));
        await page.waitForSelector("#run:visible");
        // The larger cube fits the view too, because the camera moves back.
        await write(page, "(recipe: 1, steps: [Cube(name: \"cube\"),\n    Transform(scale: (1.5, 1.5, 1.5)),\n])");
        assert.notEqual(await run(page), "");
        assert.equal(await page.evaluate(outside), 0);
    },

    async "every scene of the gallery runs without a failure"(page) {
        await ready(page);
        await page.waitForSelector("#scenes button", { state: "attached" });
        const count = await page.locator("#scenes button").count();
        const begin = performance.now();
        for (let i = 0; i < count; i += 1) {
            await page.locator("#open-gallery").click();
            await page.locator("#scenes button").nth(i).click();
            await page.waitForSelector("#digest-part:visible", { timeout: 60_000 });
            const [name, digest] = readFileSync(join(root, "tests/digests.txt"), "utf8").split("\n")[i].split(" ");
            assert.equal(await text(page, "#digest"), digest, name);
        }
        console.log(`  ${count} scenes in ${((performance.now() - begin) / 1000).toFixed(1)} s, with the digests of the program`);
    },
};

async function check(name, test) {
    console.log(name);
    const page = await open();
    page.setDefaultTimeout(20_000);
    try {
        await test(page);
        await close(page);
    } catch (error) {
        await screenshot(page, "failed");
        console.log(page.failures);
        throw error;
    }
}

for (const [name, test] of Object.entries(tests)) {
    await check(name, test);
}

/// Runs two recipes, and measures the last step of the second run. The names of the objects differ, because otherwise
/// the step would not run again.
async function longest(page) {
    await ready(page);
    const recipe = (name) => `(recipe: 1, steps: [Cube(name: "${name}"), Triangulate(), LoopSubdivide(levels: 9)])`;
    const measure = async (recipe) => (await meshwright.engine.run(recipe, {})).steps.at(-1).milliseconds;
    await page.evaluate(measure, recipe("a"));
    return page.evaluate(measure, recipe("b"));
}

// On a server that isolates the page from other origins, the engine has threads.
if (existsSync(join(folder, "threads"))) {
    await check("a run without threads", async (page) => console.log(`  nine levels of Loop: ${Math.round(await longest(page))} ms`));
    const first = origin;
    const isolated = await serve(folder, true);
    origin = `http://127.0.0.1:${isolated.address().port}`;
    await check("a run with threads", async (page) => {
        console.log(`  nine levels of Loop: ${Math.round(await longest(page))} ms`);
        const [threads, processors] = await page.evaluate(() => [meshwright.engine.threads, navigator.hardwareConcurrency]);
        assert.equal(threads, Math.min(processors, 16));
        // If the engine is restarted, it has the same number of threads.
        await page.evaluate(() => meshwright.engine.restart());
        assert.equal(await page.evaluate(() => meshwright.engine.threads), threads);
    });
    for (const name of ["every scene of the gallery runs without a failure", "a run is canceled at once, and another can run"]) {
        await check(`with threads: ${name}`, tests[name]);
    }
    isolated.close();
    origin = first;
}

// The text can be edited and run while the engine is loading.
const slow = await open({ before: (page) => page.route("**/core_bg.wasm", async (route) => {
    await new Promise((resolve) => setTimeout(resolve, 1500));
    await route.continue();
}) });
await slow.waitForSelector(".cm-line");
await write(slow, "(recipe: 1, steps: [Cube(name: \"early\")])");
await slow.keyboard.press("Control+Enter");
assert.equal(await slow.locator("#run").isDisabled(), true);
await ready(slow);
assert.match(await text(slow, "#steps"), /Cube\s*8\s*12\s*6/);
await close(slow);

// A missing engine is reported.
const missing = await open({ before: (page) => page.route("**/core_bg.wasm", (route) => route.fulfill({ status: 404 })) });
await missing.waitForFunction(() => /cannot be started/.test(document.querySelector("#status").textContent));
await missing.context().close();

// Injected styles are refused, apart from those with the nonce.
const styled = await open();
await ready(styled);
await styled.evaluate(() => {
    const style = document.createElement("style");
    style.textContent = "body { color: red }";
    document.head.append(style);
});
await styled.waitForFunction(() => getComputedStyle(document.body).color !== "rgb(255, 0, 0)");
assert(styled.failures.some((failure) => failure.includes("policy: style-src")), String(styled.failures));
await styled.context().close();

// The page on a phone, in the dark.
const phone = await open({ size: [390, 844], scheme: "dark" });
await ready(phone);
await phone.evaluate(() => meshwright.editor.addStep("TagFaces(name: \"some\", faces: And([Facing(direction: (0, 0, 1), within: 45), All]))"));
await run(phone);
await phone.waitForFunction(() => document.body.dataset.tab === "view");
for (const tab of ["recipe", "view", "results"]) {
    await phone.locator(`nav [data-tab=${tab}]`).click();
    await phone.waitForTimeout(300);
    if (tab === "view") {
        assert.equal(await phone.evaluate(outside), 0, "the meshes fit the pane");
        await phone.getByLabel("Edge", { exact: true }).check();
        await phone.locator("#number").fill("1234");
        assert(await phone.locator("#picked").evaluate((part) => part.scrollWidth <= part.clientWidth && part.scrollHeight <= part.clientHeight));
    }
    await screenshot(phone, `phone-${tab}`);
    assert.equal(await phone.evaluate(() => document.documentElement.scrollWidth), 390, "the page is not wider than the phone");
}
assert(await phone.evaluate(() => document.querySelector("#digest").getBoundingClientRect().bottom <= innerHeight));
await phone.locator("#steps th button").first().click();
await phone.waitForSelector("#step-shown:visible");
await screenshot(phone, "phone-step");
await phone.locator("#open-help").click();
await screenshot(phone, "phone-help");
await close(phone);
await browser.close();

// A browser without WebGL shows the picture of the engine.
browser = await chromium(tools, executable, false);
const plain = await open();
plain.failures = plain.failures.filter((failure) => !failure.includes("WebGL"));
await plain.waitForSelector("#picture:visible");
assert.match(await text(plain, "#stage-note"), /no WebGL/);
assert(await plain.locator("#picture").evaluate((image) => image.decode().then(() => image.naturalWidth >= 320)));
await screenshot(plain, "no-webgl");
await browser.close();
server.close();
console.log("the page works in Chromium");
