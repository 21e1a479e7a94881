// Inputs for the parameters of the recipe.
import { byId, element } from "./dom.js";

export class Parameters {
    /// The values that the visitor has set, by the names of the parameters.
    values = {};
    /// The presets and parameters for which the inputs were made, as JSON.
    #declared = "[]";

    /// `onChange` is called after a value has changed. `onPreset` is called with the name of the preset that the
    /// visitor has chosen.
    constructor(onChange, onPreset) {
        this.onChange = onChange;
        byId("preset").addEventListener("change", ({ target }) => {
            onPreset(target.value);
            target.value = "";
        });
        byId("fields").addEventListener("submit", (event) => event.preventDefault());
        byId("reset").addEventListener("click", () => this.setAll({}));
    }

    /// Replaces all values that are set.
    setAll(values) {
        this.values = values;
        this.onChange();
    }

    /// Shows inputs for the parameters of a checked recipe, and the names of its presets. If the presets and the
    /// parameters are the same as before, an input that the visitor is using keeps its value.
    show(parameters, presets) {
        for (const name of Object.keys(this.values)) {
            if (!parameters.some((parameter) => parameter.name === name)) {
                delete this.values[name];
            }
        }
        byId("reset").hidden = Object.keys(this.values).length === 0;
        const declared = JSON.stringify([presets, parameters.map((parameter) => ({ ...parameter, value: null }))]);
        if (declared === this.#declared) {
            this.#update(parameters);
            return;
        }
        this.#declared = declared;
        byId("preset").hidden = presets.length === 0;
        byId("preset").replaceChildren(element("option", { value: "" }, "Preset"),
            ...presets.map((name) => element("option", { value: name }, name)));
        byId("fields").replaceChildren(...parameters.map((parameter) => this.#row(parameter)));
        byId("parameters").classList.toggle("empty", parameters.length === 0);
    }

    /// Writes values into inputs that are not in use.
    #update(parameters) {
        for (const { name, type, value } of parameters) {
            for (const input of byId("fields").querySelectorAll("[data-name]")) {
                if (input.dataset.name === name && input !== document.activeElement) {
                    if (input.type === "checkbox") {
                        input.checked = value === "true";
                    } else {
                        input.value = written(type, value);
                    }
                }
            }
        }
    }

    #set(name, value) {
        Object.defineProperty(this.values, name, { value, enumerable: true, configurable: true, writable: true });
        byId("reset").hidden = false;
        this.onChange();
    }

    #row(parameter) {
        const { name, type, doc, value, min, max, of } = parameter;
        const id = `parameter-${name}`;
        const inputs = [];
        const input = (attributes, tag = "input", ...children) => {
            const created = element(tag, { "data-name": name, oninput: () => {
                const text = created.type === "checkbox" ? String(created.checked) : created.value;
                for (const other of inputs) {
                    other.value = text;
                }
                if (text !== "" || type === "Text") {
                    this.#set(name, text);
                }
            }, ...attributes }, ...children);
            inputs.push(created);
            return created;
        };
        const isNumber = type === "Int" || type === "Float";
        if (type === "Bool") {
            input({ id, type: "checkbox" }).checked = value === "true";
        } else if (type === "Choice") {
            input({ id }, "select", ...of.map((choice) => element("option", {}, choice))).value = value;
        } else if (isNumber) {
            if (min !== null && max !== null) {
                input({ type: "range", min, max, step: type === "Int" ? 1 : step(min, max), "aria-label": `${name}, slider` });
            }
            input({ id, type: "number", min, max, step: type === "Int" ? 1 : "any" });
        } else {
            input({ id, type: "text", spellcheck: "false" });
        }
        if (type !== "Bool") {
            inputs.forEach((created) => (created.value = written(type, value)));
        }
        return element("div", { class: "field" }, element("label", { for: id, title: doc }, name), ...inputs,
            doc && element("small", {}, doc));
    }
}

/// Returns the text that an input shows for a value.
function written(type, value) {
    return type === "Int" || type === "Float" ? String(Number(value)) : value;
}

/// Returns the step of a slider, which is a power of ten. The slider then has 100 to 1000 positions.
function step(min, max) {
    return 10 ** Math.floor(Math.log10((max - min) / 100)) || "any";
}
