// Files of the visitor: drag and drop, the file button, and downloads. Nothing leaves the computer.
import { byId, counted, download, element, notify, sizeText } from "./dom.js";
import { quoted } from "./ron.js";

const MODELS = /\.(obj|gltf|glb|ply|stl|off|dae|bez|bzc|mws)(\.gz)?$/i;

/// The maximum size of a file in bytes. All meshes of a run together can also use at most 1 GiB.
const MAX_SIZE = 2 ** 30;

/// The maximum number of files in a folder.
const MAX_FILES = 2000;

/// Changes a path so that it stays inside the folder of the recipe: removes control characters, and parts such as `..`.
/// Returns `null` if nothing is left.
export function safePath(path) {
    const parts = path.split(/[/\\]/).map((part) => part.replace(/[\u0000-\u001f\u007f]/g, "").trim());
    return parts.filter((part) => !/^\.*$/.test(part)).join("/") || null;
}

/// Returns the files that were dropped on the page, including those in folders, as `[path, file]`.
async function dropped(transfer) {
    // The items must be read before the event ends.
    const items = [...transfer.items].filter((item) => item.kind === "file")
        .map((item) => [item.webkitGetAsEntry?.(), item.getAsFile()]);
    const found = [];
    for (const [entry, file] of items) {
        if (entry?.isDirectory) {
            await collect(entry, found);
        } else if (file) {
            found.push([file.name, file]);
        }
    }
    return found;
}

/// Adds the files of a folder, apart from hidden ones, to a list. Stops after `MAX_FILES` files.
async function collect(folder, found) {
    const reader = folder.createReader();
    const read = () => new Promise((resolve, reject) => reader.readEntries(resolve, reject));
    for (let entries = await read(); entries.length; entries = await read()) {
        for (const entry of entries.filter(({ name }) => !name.startsWith("."))) {
            if (found.length > MAX_FILES) {
                return;
            }
            if (entry.isDirectory) {
                await collect(entry, found);
            } else {
                found.push([entry.fullPath, await new Promise((resolve, reject) => entry.file(resolve, reject))]);
            }
        }
    }
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
        byId("add-folder").addEventListener("click", () => byId("folder-input").click());
        for (const id of ["file-input", "folder-input"]) {
            byId(id).addEventListener("change", ({ target }) => {
                const files = [...target.files].map((file) => [file.webkitRelativePath || file.name, file]);
                this.add(files.filter(([path]) => !path.includes("/.")));
                target.value = "";
            });
        }
        this.#listen();
        this.show();
    }

    /// Writes files, given as `[path, file]`, and offers to open a recipe or to add a step that loads a model.
    async add(list) {
        if (list.length > MAX_FILES) {
            notify(`The folder was not opened: it has more than ${counted(MAX_FILES, "file")}.`);
            return;
        }
        const added = [];
        for (const [path, file] of list) {
            const name = safePath(path);
            if (!name || file.size > MAX_SIZE) {
                notify(name ? `${name} is larger than 1 GiB, so it was not opened.` : "A file without a name was not opened.");
                continue;
            }
            const bytes = new Uint8Array(await file.arrayBuffer());
            // The code does not wait for the worker here, because the worker may be busy.
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

    /// Disables the downloads if the engine has run only some of the steps, and therefore does not have all outputs.
    lock() {
        for (const button of byId("outputs").querySelectorAll("button")) {
            button.disabled = true;
            button.title = "Show the last step to download the outputs";
        }
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
                dropped(event.dataTransfer).then((files) => this.add(files)).catch((error) => notify(error.message));
            }
        }, true);
    }
}
