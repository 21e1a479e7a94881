// The shipped scenes, with pictures.
import { byId, element } from "./dom.js";

/// Loads the scenes and fills the gallery. `open` is called with the recipe and its files: `{ name, recipe, up, files }`.
export async function fillGallery(open) {
    const dialog = byId("gallery");
    byId("open-gallery").addEventListener("click", () => dialog.showModal());
    byId("close-gallery").addEventListener("click", () => dialog.close());
    // A click beside the dialog.
    dialog.addEventListener("click", (event) => event.target === dialog && dialog.close());
    const { scenes, files } = await (await fetch("gallery/scenes.json")).json();
    const bytes = (path) => Uint8Array.from(atob(files[path]), (c) => c.charCodeAt(0));
    byId("scenes").replaceChildren(...scenes.map(({ name, about, recipe, reads, up }) => {
        const show = () => {
            dialog.close();
            open({ name, recipe, up, files: reads.map((path) => [path, bytes(path)]) });
        };
        return element("li", {}, element("button", { type: "button", onclick: show },
            element("img", { src: `gallery/${name}.png`, alt: "", width: 240, height: 180 }),
            element("strong", {}, name.replaceAll("_", " ")), element("span", {}, about)));
    }));
}
