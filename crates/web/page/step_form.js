// A form for the step at the cursor: inputs for its numbers, switches and choices, which change the text.
import { byId, element } from "./dom.js";
import { outline, stepAt, written } from "./ron.js";

/// The maximum number of inputs for a value. A value with more numbers, such as a list of points, has no inputs.
const MAX_NUMBERS = 4;

export class StepForm {
    #editor;
    #onChange;
    #inputs = [];
    /// The inputs that the form has. The form is built again only if other inputs are needed.
    #layout = "";
    /// Describes the fields of operations. `null` until the schema is known.
    completions = null;

    /// `onChange` is called after an input has changed the text.
    constructor(editor, onChange) {
        this.#editor = editor;
        this.#onChange = onChange;
        byId("step-fields").addEventListener("submit", (event) => event.preventDefault());
    }

    /// Shows inputs for the step at the cursor. An input that the visitor is using keeps its value.
    show() {
        const { text, cursor } = this.#editor;
        const index = stepAt(text, cursor);
        const step = index === null ? null : written(text, outline(text).steps[index]);
        const fields = (step && this.completions?.inputs(step.name)) ?? [];
        const needed = fields.flatMap((field) => this.#needed(field, step));
        byId("step-part").hidden = needed.length === 0;
        const layout = JSON.stringify([index, step?.name, needed.map(({ place, ...input }) => ({ ...input, value: null }))]);
        if (layout !== this.#layout) {
            this.#layout = layout;
            byId("step-title").textContent = step ? `Step: ${step.name}` : "";
            this.#inputs = needed.map((input, i) => this.#created(input, (value) => this.#change(i, value)));
            byId("step-fields").replaceChildren(...needed.map((input, i) => element("div", { class: "field", title: input.info },
                element("label", { for: `step-${i}` }, input.label), this.#inputs[i])));
        }
        needed.forEach(({ type, value }, i) => {
            const input = this.#inputs[i];
            if (type === "boolean") {
                input.checked = value === "true";
            } else if (input !== document.activeElement) {
                input.value = value;
            }
            input.id = `step-${i}`;
        });
    }

    /// Returns the inputs for a field. `place` is `{ from, to, before }`: the range of the text that a new value
    /// replaces, and the text that must be written before the value.
    #needed(field, step) {
        const { name, names, type, standard } = field;
        const parts = names.map((other) => step.fields.get(other)).find(Boolean);
        const input = (label, value, place) => [{ ...field, label, value, place }];
        if (!parts) {
            return type === "other" ? [] : input(name, type === "number" ? "" : String(standard), { ...step.next, before: `${step.next.before}${name}: ` });
        }
        if (type === "other") {
            const numbers = parts.filter(({ kind }) => kind === "number");
            const isPlain = parts.every(({ kind }) => kind !== "[" && kind !== "string") && numbers.length <= MAX_NUMBERS;
            const label = parts[0].kind === "word" ? `${name}: ${parts[0].text}` : name;
            return isPlain ? numbers.flatMap(({ text, start, end }, i) =>
                input(numbers.length > 1 ? `${label} ${i + 1}` : label, text, { from: start, to: end, before: "" })) : [];
        }
        // A value such as `arg("levels")` has no input.
        const [{ text, kind, start, end }] = parts;
        return parts.length === 1 && (kind === "number") === (type === "number") ? input(name, text, { from: start, to: end, before: "" }) : [];
    }

    #created({ type, of, min, max, whole, standard }, change) {
        if (type === "choice") {
            return element("select", { onchange: ({ target }) => change(target.value) }, ...of.map((choice) => element("option", {}, choice)));
        }
        return type === "boolean" ? element("input", { type: "checkbox", onchange: ({ target }) => change(String(target.checked)) })
            : element("input", { type: "number", min, max, step: whole ? 1 : "any", placeholder: standard ?? "",
                oninput: ({ target }) => target.value !== "" && change(target.value) });
    }

    /// Writes the value of an input into the text, which may have changed since the form was built.
    #change(index, value) {
        const { text, cursor } = this.#editor;
        const step = written(text, outline(text).steps[stepAt(text, cursor)]);
        const { place: { from, to, before } } = this.completions.inputs(step.name).flatMap((field) => this.#needed(field, step))[index];
        this.#editor.replace(from, to, before + value);
        this.#onChange();
    }
}
