// The scenes of the gallery, with their pictures.
import { byId, element } from "./dom.js";

let loading;

/// Loads the scenes once. Returns `scenes`, and `files`: the content of each file by its path, as base64.
function shipped() {
    loading ??= fetched().catch((error) => {
        // The next call tries again, for example after the network is back.
        loading = undefined;
        throw error;
    });
    return loading;
}

async function fetched() {
    const response = await fetch("gallery/scenes.json");
    if (!response.ok) {
        throw new Error(`the server answers ${response.status}`);
    }
    return response.json();
}

/// Returns those files of the gallery that a recipe names, as a list of `[path, bytes]`.
export async function namedFiles(recipe) {
    if (!/"(assets|lib)\//.test(recipe)) {
        return [];
    }
    const { files } = await shipped();
    return Object.keys(files).filter((path) => recipe.includes(`"${path}"`)).map((path) => [path, decoded(files[path])]);
}

const decoded = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));

/// Fills the gallery. If the scenes cannot be loaded now, the gallery is filled when it is opened. `open` is called
/// with the recipe that the visitor chooses, and its files: `{ name, recipe, up, files }`.
export function prepareGallery(open) {
    const fill = () => shipped().then((found) => show(found, open), (error) => {
        byId("scenes").replaceChildren(element("li", { class: "hint" },
            `The scenes cannot be loaded: ${error.message}. Open the gallery again to try once more.`));
    });
    byId("open-gallery").addEventListener("click", () => {
        if (!byId("scenes").querySelector("button")) {
            fill();
        }
    });
    return fill();
}

function show({ scenes, files }, open) {
    byId("scenes").replaceChildren(...scenes.map(({ name, about, recipe, reads, up }) => {
        const show = () => {
            byId("gallery").close();
            open({ name, recipe, up, files: reads.map((path) => [path, decoded(files[path])]) });
        };
        return element("li", {}, element("button", { type: "button", onclick: show },
            element("img", { src: `gallery/${name}.png`, alt: "", width: 240, height: 180 }),
            element("strong", {}, name.replaceAll("_", " ")), element("span", {}, about)));
    }));
}
