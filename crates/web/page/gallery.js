// The shipped scenes, with pictures.
import { byId, element } from "./dom.js";

let loading;

/// Loads the scenes once. Returns `scenes` and `files`, whose contents are base64 by path.
function shipped() {
    loading ??= fetch("gallery/scenes.json").then((response) => response.json());
    return loading;
}

/// Returns the files of the scenes that a recipe names: `[path, bytes]`.
export async function namedFiles(recipe) {
    const { files } = await shipped();
    return Object.keys(files).filter((path) => recipe.includes(`"${path}"`)).map((path) => [path, decoded(files[path])]);
}

const decoded = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));

/// Fills the gallery. `open` is called with the recipe and its files: `{ name, recipe, up, files }`.
export async function fillGallery(open) {
    const dialog = byId("gallery");
    byId("open-gallery").addEventListener("click", () => dialog.showModal());
    byId("close-gallery").addEventListener("click", () => dialog.close());
    // A click beside the dialog.
    dialog.addEventListener("click", (event) => event.target === dialog && dialog.close());
    const { scenes, files } = await shipped();
    byId("scenes").replaceChildren(...scenes.map(({ name, about, recipe, reads, up }) => {
        const show = () => {
            dialog.close();
            open({ name, recipe, up, files: reads.map((path) => [path, decoded(files[path])]) });
        };
        return element("li", {}, element("button", { type: "button", onclick: show },
            element("img", { src: `gallery/${name}.png`, alt: "", width: 240, height: 180 }),
            element("strong", {}, name.replaceAll("_", " ")), element("span", {}, about)));
    }));
}
