// Serves a folder over HTTP, and opens its pages in a Chromium browser without a screen.
import { readFile } from "node:fs/promises";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { extname, join, normalize } from "node:path";

const TYPES = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".wasm": "application/wasm", ".svg": "image/svg+xml",
    ".png": "image/png", ".json": "application/json" };

/// The headers that isolate a page from other origins, which threads need.
const ISOLATED = { "cross-origin-opener-policy": "same-origin", "cross-origin-embedder-policy": "require-corp" };

/// Serves a folder on a free port of this computer. Returns the server.
export async function serve(folder, isolated = false) {
    const server = createServer(async (request, response) => {
        const path = normalize(decodeURIComponent(new URL(request.url, "http://localhost").pathname));
        try {
            const bytes = await readFile(join(folder, path.endsWith("/") ? `${path}index.html` : path));
            response.writeHead(200, { "content-type": TYPES[extname(path)] ?? "text/html", ...isolated ? ISOLATED : {} }).end(bytes);
        } catch {
            response.writeHead(404).end();
        }
    });
    await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
    return server;
}

/// Starts Chromium with WebGL in software.
export function chromium(tools, executablePath, gl = true) {
    const playwright = createRequire(join(tools, "package.json"))("playwright-core");
    return playwright.chromium.launch({ executablePath, headless: true, args: [
        "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
        "--disable-component-update", "--disable-sync",
        ...gl ? ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"] : ["--disable-3d-apis"],
    ] });
}
