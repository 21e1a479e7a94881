// Files of the visitor: drag and drop, the file button, and downloads. Nothing leaves the computer.
import { byId, counted, download, element, notify, sizeText } from "./dom.js";
import { quoted } from "./ron.js";

const MODELS = /\.(obj|gltf|glb|ply|stl|off|dae|bez|bzc|mws)(\.gz)?$/i;

/// The maximum size of a file in bytes. Meshes may have 1 GiB in total.
const MAX_SIZE = 2 ** 30;

/// Returns the name of a file without folders and control characters; `null` if nothing is left.
export function safeName(name) {
    const last = name.split(/[/\\]/).at(-1).replace(/[\u0000-\u001f\u007f]/g, "").trim();
    return /^\.*$/.test(last) ? null : last;
}

export class Files {
    #engine;
    #actions;

    /// `actions` are `openRecipe(text, name)`, `addStep(text)` and `changed()`.
    constructor(engine, actions) {
        this.#engine = engine;
        this.#actions = actions;
        const choose = () => byId("file-input").click();
        byId("open-files").addEventListener("click", choose);
        byId("add-files").addEventListener("click", choose);
        byId("file-input").addEventListener("change", ({ target }) => {
            this.add([...target.files]);
            target.value = "";
        });
        this.#listen();
        this.show();
    }

    /// Writes files, and offers what can be done with them.
    async add(list) {
        const added = [];
        for (const file of list) {
            const name = safeName(file.name);
            if (!name || file.size > MAX_SIZE) {
                notify(name ? `${name} is larger than 1 GiB, so it was not opened.` : "A file without a name was not opened.");
                continue;
            }
            const bytes = new Uint8Array(await file.arrayBuffer());
            // Not awaited, since the worker may be busy.
            this.#engine.write(name, bytes).catch((error) => notify(error.message));
            added.push([name, bytes]);
        }
        if (!added.length) {
            return;
        }
        this.show();
        this.#actions.changed();
        this.#offer(added);
    }

    #offer(added) {
        const [recipe, bytes] = added.find(([name]) => /\.ron$/i.test(name)) ?? [];
        const [model] = added.find(([name]) => MODELS.test(name)) ?? [];
        const names = added.length === 1 ? added[0][0] : counted(added.length, "file");
        const load = `Load(path: ${quoted(model ?? "")})`;
        if (recipe) {
            notify(`${names} can be read by the recipe now.`, { "Open as the recipe": () =>
                this.#actions.openRecipe(new TextDecoder().decode(bytes), recipe) });
        } else if (model) {
            notify(`${names} can be read by the recipe now.`, {
                "New recipe": () => this.#actions.openRecipe(`(\n    recipe: 1,\n    steps: [\n        ${load},\n    ],\n)\n`, model),
                "Add a step": () => this.#actions.addStep(load),
            });
        } else {
            notify(`${names} can be read by the recipe now.`);
        }
    }

    /// Shows the files that recipes can read.
    show() {
        const rows = [...this.#engine.files].map(([path, bytes]) => element("li", {}, element("span", { class: "path" }, path),
            element("small", {}, sizeText(bytes.length)),
            element("button", { type: "button", class: "plain", "aria-label": `Remove ${path}`, title: "Remove", onclick: () => {
                this.#engine.remove(path).catch((error) => notify(error.message));
                this.show();
                this.outputs([]);
                this.#actions.changed();
            } }, "×")));
        byId("inputs").replaceChildren(...rows.length ? rows : [element("li", { class: "hint" },
            "Drop OBJ, glTF, PLY, STL, OFF or Bezier files on the page.")]);
    }

    /// Shows the outputs of the last run.
    outputs(paths) {
        const rows = paths.map((path) => {
            const name = path.replace(/^out\//, "");
            const save = async () => download(name.split("/").at(-1), await this.#engine.read(path));
            return element("li", {}, element("span", { class: "path" }, name), element("button", { type: "button", class: "plain",
                "aria-label": `Download ${name}`, onclick: () => save().catch((error) => notify(error.message)) }, "Download"));
        });
        byId("outputs").replaceChildren(...rows.length ? rows : [element("li", { class: "hint" },
            "Steps such as Save(path: \"a.obj\") write files, which can be downloaded here.")]);
    }

    #listen() {
        const drop = byId("drop");
        const isFiles = (event) => event.dataTransfer?.types.includes("Files");
        addEventListener("dragover", (event) => {
            if (isFiles(event)) {
                event.preventDefault();
                drop.hidden = false;
            }
        });
        addEventListener("dragleave", (event) => (drop.hidden ||= event.relatedTarget === null));
        addEventListener("drop", (event) => {
            drop.hidden = true;
            if (isFiles(event)) {
                event.preventDefault();
                this.add([...event.dataTransfer.files]);
            }
        }, true);
    }
}
