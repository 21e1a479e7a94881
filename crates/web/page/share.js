// Share links: the recipe in the fragment of the URL, which browsers do not send to servers. `#r=` has the recipe,
// compressed with deflate and written as base64url; `&p.NAME=VALUE` has values of parameters.

/// The maximum length of a link in characters. Chats and mail programs cut longer links.
const MAX_LINK = 32_000;

/// The maximum size of a shared recipe in bytes.
const MAX_TEXT = 1_000_000;

/// The error if a link cannot be created or opened. Its message is shown to the visitor.
export class LinkError extends Error {}

/// Returns the link to a recipe with values of parameters, or throws `LinkError` if the link would be too long. `page`
/// is the URL of this page.
export async function link(recipe, set, page = location.href) {
    const stream = new Blob([recipe]).stream().pipeThrough(new CompressionStream("deflate-raw"));
    const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
    const binary = Array.from(bytes, (byte) => String.fromCharCode(byte)).join("");
    const text = btoa(binary).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
    const fragment = new URLSearchParams({ r: text });
    for (const [name, value] of Object.entries(set)) {
        fragment.set(`p.${name}`, value);
    }
    const url = new URL(page);
    url.hash = fragment;
    if (url.href.length > MAX_LINK) {
        throw new LinkError("The recipe is too long for a link. Download the recipe and send the file instead.");
    }
    return url.href;
}

/// Returns the recipe and the values of a fragment such as `#r=..`; `null` if the fragment has no recipe. Throws
/// `LinkError` if the recipe cannot be read.
export async function shared(fragment) {
    const fields = new URLSearchParams(fragment.replace(/^#/, ""));
    const text = fields.get("r");
    if (text === null) {
        return null;
    }
    if (fragment.length > MAX_LINK) {
        throw new LinkError("The link is too long, so its recipe was not opened.");
    }
    const recipe = await inflate(text);
    const set = {};
    for (const [key, value] of fields) {
        if (key.startsWith("p.")) {
            Object.defineProperty(set, key.slice(2), { value, enumerable: true, configurable: true });
        }
    }
    return { recipe, set };
}

async function inflate(text) {
    try {
        const binary = atob(text.replaceAll("-", "+").replaceAll("_", "/"));
        const bytes = Uint8Array.from(binary, (c) => c.charCodeAt(0));
        const reader = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw")).getReader();
        const decoder = new TextDecoder("utf-8", { fatal: true });
        let recipe = "";
        let size = 0;
        for (let part = await reader.read(); !part.done; part = await reader.read()) {
            size += part.value.length;
            if (size > MAX_TEXT) {
                await reader.cancel();
                throw new LinkError("The recipe of the link is larger than 1 MB, so it was not opened.");
            }
            recipe += decoder.decode(part.value, { stream: true });
        }
        return recipe + decoder.decode();
    } catch (error) {
        throw error instanceof LinkError ? error
            : new LinkError("The link is damaged, so its recipe cannot be opened. Ask for the link again.");
    }
}
