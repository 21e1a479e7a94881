// The pane of the picture: the view of the meshes or the engine's own picture, its buttons, and picked elements.
import { showLegend } from "./colors.js";
import { byId, download, element, notify } from "./dom.js";
import { Ended } from "./engine.js";
import { joining, numbered, selection } from "./pick.js";
import { quoted } from "./ron.js";
import { MAX_INSTANCES, View } from "./view.js";

/// Meshes with more faces are shown without edges, unless the visitor wants edges.
const MAX_FACES_WITH_EDGES = 5000;

export class Stage {
    #engine;
    #editor;
    #addStep;
    #picks = [];
    /// Whether the visitor has switched the edges of this recipe on or off.
    #choseEdges = false;
    #meshes = [];
    #completions = null;
    /// The step whose meshes are shown, as `{ number, total, label }`; `null` for the meshes after the last step.
    #shown = null;
    /// `null` if the browser has no WebGL.
    view = null;

    /// `addStep` adds a step to the recipe and runs it.
    constructor(engine, editor, addStep) {
        this.#engine = engine;
        this.#editor = editor;
        this.#addStep = addStep;
        try {
            this.view = new View(byId("canvas"));
            this.view.onPick = (pick, more) => this.#pick(pick, more);
        } catch {
            byId("canvas").hidden = true;
            for (const id of ["smooth", "fit", "kinds", "pick", "color-part"]) {
                byId(id).hidden = true;
            }
        }
        this.#listen();
    }

    /// Sets the completions when the schema is known, and offers steps from them.
    set completions(completions) {
        this.#completions = completions;
        this.#offerSteps();
    }

    /// Shows the scene of a run. The camera and the picked elements stay if `keep` is true. `up` is the axis that
    /// points upwards: "y", "z" or "auto". If the recipe was run only up to a step, `step` describes this step, as
    /// `{ number, total, label }`.
    async show({ meshes, objects, quantities }, keep, up, step = null) {
        this.#enable(true);
        this.#shown = step;
        byId("step-shown").hidden = !step;
        byId("step-text").textContent = step ? `After step ${step.number} of ${step.total}: ${step.label}` : "";
        this.#meshes = meshes;
        this.#offer(meshes.length ? quantities : []);
        const faces = objects.reduce((sum, object) => sum + (object.faces ?? 0), 0);
        if (this.view) {
            this.#choseEdges &&= keep;
            if (!this.#choseEdges) {
                this.#press("edges", faces <= MAX_FACES_WITH_EDGES);
            }
            const axis = this.view.show(meshes, keep, up);
            this.view.style({ edges: pressed("edges") });
            this.#press("up", axis === "z");
        } else if (!keep) {
            this.#press("up", up === "z");
        }
        this.#select(keep ? this.#kept() : []);
        byId("number-label").hidden = meshes.length !== 1;
        const rendered = objects.length > 0 && (!this.view || meshes.length === 0);
        for (const id of ["canvas", "kinds", "pick", "color-part"]) {
            byId(id).hidden = rendered || !this.view;
        }
        byId("picture").hidden = true;
        byId("compare").hidden = rendered || !this.view?.hasEarlier;
        const note = byId("stage-note");
        const hides = meshes.some(({ placements }) => placements.length > 16 * MAX_INSTANCES);
        note.hidden = objects.length > 0 && Boolean(this.view) && meshes.length === objects.length && !hides;
        note.textContent = objects.length === 0 ? "The scene is empty."
            : !this.view ? "This browser has no WebGL, so the engine renders the picture. The picture cannot be turned."
                : meshes.length === 0 ? "Curves and patches are rendered by the engine. The picture cannot be turned."
                    : hides ? `The first ${MAX_INSTANCES.toLocaleString("en")} instances of each mesh are shown.`
                        : "Curves and patches are not shown. Tessellate them to see them.";
        if (rendered) {
            await this.#render();
        } else {
            await this.#color();
        }
    }

    /// Offers the quantities of the meshes. The chosen quantity stays chosen if the meshes still have this quantity.
    #offer(quantities) {
        const select = byId("color-by");
        const chosen = select.value;
        const option = ({ title, quantity }) => {
            const value = JSON.stringify(quantity);
            return element("option", { value, selected: value === chosen }, title);
        };
        select.replaceChildren(element("option", { value: "" }, "Plain"), ...quantities.map(option));
    }

    /// Colors the meshes by the chosen quantity.
    async #color() {
        const chosen = byId("color-by").value;
        let found;
        try {
            found = chosen && this.#meshes.length ? await this.#engine.colors(JSON.parse(chosen)) : null;
        } catch (error) {
            if (error instanceof Ended) {
                return;
            }
            byId("color-by").value = "";
            notify(error.message);
        }
        // The visitor may have chosen another quantity while the engine computed the colors.
        if (chosen === byId("color-by").value || !found) {
            this.view?.color(found?.meshes ?? []);
            showLegend(found?.legend);
        }
    }

    /// Disables the controls that need the engine, after the engine has lost the scene. The current picture stays.
    detach() {
        this.#enable(false);
    }

    #enable(is) {
        byId("color-by").disabled = !is;
        byId("color-part").title = is ? "" : "Run the recipe to choose other colors";
        for (const id of ["edges", "up", "save-picture"]) {
            byId(id).disabled = !is && !byId("picture").hidden;
        }
    }

    /// Shows a note that says why there is no picture, or why the picture is from an earlier run.
    keep(reason) {
        this.detach();
        byId("stage-note").textContent = (this.#meshes.length ? "This is the scene of an earlier run. " : "") + reason;
        byId("stage-note").hidden = false;
    }

    /// Returns those picked elements that the meshes still have. Edges are identified by their vertices, because
    /// recipes also refer to edges by their vertices.
    #kept() {
        return this.#picks.flatMap((pick) => {
            const mesh = this.#meshes.find(({ name }) => name === pick.mesh.name);
            const found = mesh && (pick.kind === "edge" ? joining(mesh, pick.vertices) : numbered(mesh, pick.kind, pick.number));
            return found ? [{ mesh, ...found }] : [];
        });
    }

    /// The arrays of the meshes that are shown.
    get meshes() {
        return this.#meshes;
    }

    /// Renders the picture with the engine.
    async #render() {
        const { clientWidth, clientHeight } = byId("stage");
        const size = { width: Math.max(clientWidth, 320), height: Math.max(clientHeight, 240) };
        const png = await this.#engine.picture({ ...size, ...this.#look() });
        URL.revokeObjectURL(byId("picture").src);
        byId("picture").src = URL.createObjectURL(new Blob([png], { type: "image/png" }));
        byId("picture").hidden = false;
    }

    #look() {
        return { wireframe: pressed("edges"), up: pressed("up") ? "z" : "auto" };
    }

    #listen() {
        const toggle = (id, change) => byId(id).addEventListener("click", () => {
            this.#press(id, !pressed(id));
            change(pressed(id));
        });
        toggle("smooth", (smooth) => this.view.style({ smooth }));
        toggle("several", (several) => (this.view.several = several));
        toggle("up", (up) => {
            this.view?.style({ up: up ? "z" : "y" });
            if (!byId("picture").hidden) {
                this.#render();
            }
        });
        toggle("edges", (edges) => {
            this.#choseEdges = true;
            return byId("picture").hidden ? this.view?.style({ edges }) : this.#render();
        });
        byId("compare-share").addEventListener("input", ({ target }) => this.view.compare(target.valueAsNumber / 100));
        byId("color-by").addEventListener("change", () => this.#color());
        byId("fit").addEventListener("click", () => this.view.refit());
        byId("fit").addEventListener("dblclick", () => this.view.fit());
        byId("save-picture").addEventListener("click", async () => {
            const rendered = !byId("picture").hidden;
            try {
                const png = rendered ? await this.#engine.picture({ width: 1280, height: 960, ...this.#look() })
                    : await this.view.picture();
                download("picture.png", png, "image/png");
            } catch (error) {
                notify(error.message);
            }
        });
        byId("kinds").addEventListener("change", ({ target }) => {
            this.view.kind = target.value;
            this.#select([]);
        });
        byId("number").addEventListener("input", ({ target }) => {
            const number = target.valueAsNumber;
            const found = Number.isInteger(number) && number >= 0 ? numbered(this.#meshes[0], this.view.kind, number) : null;
            this.#select(found ? [{ mesh: this.#meshes[0], ...found }] : [], true);
            if (!found && target.value !== "") {
                byId("picked").textContent = `The mesh has no ${this.view.kind} with this number.`;
            }
        });
        byId("insert").addEventListener("click", () => this.#editor.insert(selection(this.#picks)));
        byId("add-step").addEventListener("change", ({ target }) => {
            const step = target.value;
            const isForPicked = target.selectedOptions[0].parentElement.label.startsWith("Picked");
            target.value = "";
            if (!isForPicked) {
                // After a step for the whole mesh, the numbers often belong to other elements, so no elements stay
                // picked.
                this.#select([]);
            }
            this.#addStep(step);
        });
    }

    #press(id, is) {
        byId(id).setAttribute("aria-pressed", String(is));
    }

    #pick(pick, more) {
        // The elements of one selection belong to one mesh.
        const others = more && pick ? this.#picks.filter(({ mesh }) => mesh === pick.mesh) : [];
        const again = others.some(({ number }) => number === pick.number);
        const rest = others.filter(({ number }) => number !== pick.number);
        this.#select(pick ? [...rest, ...again ? [] : [pick]] : more ? this.#picks : []);
    }

    #select(picks, typed = false) {
        this.#picks = picks;
        this.view?.mark(picks);
        byId("insert").hidden = picks.length === 0;
        if (!typed) {
            byId("number").value = picks.length === 1 ? picks[0].number : "";
        }
        byId("picked").textContent = picks.length ? this.#described(picks)
            : "Click an element of a mesh to pick it.";
        byId("insert").title = picks.length ? `Insert ${selection(picks)} at the cursor of the recipe` : "";
        this.#offerSteps();
    }

    /// Offers steps for the picked elements, and for whole meshes.
    #offerSteps() {
        const picks = this.#picks;
        const several = this.#meshes.length > 1;
        const on = (step) => (several && picks.length ? `(on: [${quoted(picks[0].mesh.name)}], run: ${step})` : step);
        const group = (label, steps = []) => element("optgroup", { label },
            ...steps.map(({ name, summary, text }) => element("option", { value: on(text), title: summary }, name)));
        const groups = [];
        if (picks.length) {
            const { kind } = picks[0];
            const steps = this.#completions?.stepsWith(kind[0].toUpperCase() + kind.slice(1), selection(picks));
            groups.push(group(`Picked ${picks.length > 1 ? plural(kind) : kind}`, steps));
        }
        groups.push(group(several && !picks.length ? "Subdivide the meshes" : "Subdivide the mesh", this.#completions?.subdivisions()));
        if (!picks.length) {
            groups.push(group(several ? "Whole meshes" : "Whole mesh", this.#completions?.onMeshes()));
        }
        const title = this.#shown ? `Add after step ${this.#shown.number}` : "Add a step";
        byId("add-step").replaceChildren(element("option", { value: "" }, title), ...groups);
    }

    #described(picks) {
        const { mesh, kind, number, vertices } = picks[0];
        const place = this.#meshes.length > 1 ? ` of ${mesh.name}` : "";
        if (picks.length > 1) {
            return `${picks.length} ${plural(kind)}${place}`;
        }
        const at = (v) => Array.from(mesh.positions.subarray(3 * v, 3 * v + 3), (x, k) => x + mesh.center[k]);
        const number6 = (x) => String(Number(x.toPrecision(6)));
        if (kind === "edge") {
            const [p, q] = vertices.map(at);
            return `Edge ${number}${place}: vertices ${vertices.join(" and ")}, length ${number6(Math.hypot(...p.map((x, k) => x - q[k])))}`;
        }
        return kind === "face" ? `Face ${number}${place}: vertices ${vertices.join(", ")}`
            : `Vertex ${number}${place}: ${at(number).map(number6).join(", ")}`;
    }
}

function plural(kind) {
    return kind === "vertex" ? "vertices" : `${kind}s`;
}

function pressed(id) {
    return byId(id).getAttribute("aria-pressed") === "true";
}
