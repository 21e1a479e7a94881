// Completion from the schema of recipes: operations, fields, and the names that a value can have.
import { snippetCompletion, startCompletion } from "@codemirror/autocomplete";
import { around } from "./ron.js";

/// Operations on whole meshes. The example of each of these operations works for any mesh.
const ON_MESHES = ["Transform", "Triangulate", "FillHoles", "Reverse", "Symmetrize", "Simplify", "Remesh", "Smooth", "Displace", "Bend",
    "Twist", "Taper"];

/// Finds the words and texts that can be written at a position of a recipe, from the schema of recipes.
export class Completions {
    #schema;
    #examples;
    /// The names of the parameters of the recipe.
    parameters = [];

    constructor({ schema, operations }) {
        this.#schema = schema;
        this.#examples = new Map(operations.map((operation) => [operation.name, operation]));
    }

    /// Returns the completions in the form that CodeMirror needs.
    source = (context) => {
        const word = context.matchBefore(/[A-Za-z_][A-Za-z0-9_]*/);
        const before = context.state.sliceDoc(Math.max(0, context.pos - 2), context.pos);
        if (!word && !context.explicit && !/[([{,:]\s?$/.test(before)) {
            return null;
        }
        const from = word?.from ?? context.pos;
        const text = context.state.doc.toString();
        const options = this.options(text, from);
        return options.length ? { from, options, validFor: /^[A-Za-z_0-9]*$/ } : null;
    };

    /// Returns the completions that can be written at a position.
    options(text, position) {
        const stack = around(text, position);
        if (!stack || stack.length < 2) {
            return [];
        }
        let nodes = [this.#schema];
        for (const bracket of stack.slice(1, -1)) {
            nodes = this.#values(this.#inside(nodes, bracket), bracket);
        }
        const last = stack.at(-1);
        const inside = this.#inside(nodes, last);
        const records = last.open === "(" && last.field === null ? inside.filter((node) => node.properties) : [];
        if (records.length) {
            return records.flatMap((node) => this.#fields(node, last.fields));
        }
        const inSteps = stack.some((bracket) => bracket.field === "steps");
        const place = last.open === "[" && stack.at(-2).field === "steps" ? "step" : last.field === "run" ? "run" : "value";
        return this.#names(this.#values(inside, last), place, inSteps);
    }

    /// Returns the description of a word at a position; `null` if it has none.
    describe(text, position, word) {
        const found = this.options(text, position).find((option) => option.label === word);
        return [found?.detail, found?.info].filter(Boolean).join("\n") || null;
    }

    /// Returns the alternatives that a node of the schema stands for. Follows references (`$ref`), and replaces a
    /// choice (such as `oneOf`) by its alternatives.
    #alternatives(node) {
        if (!node || typeof node !== "object") {
            return [];
        }
        const target = node.$ref ? this.#schema.$defs[node.$ref.replace("#/$defs/", "")] : node;
        const choices = target.oneOf ?? target.anyOf ?? target.allOf;
        return choices ? choices.flatMap((choice) => this.#alternatives(choice)) : [target];
    }

    /// Returns the schema nodes that describe everything between two brackets.
    #inside(nodes, { open, name }) {
        const all = nodes.flatMap((node) => this.#alternatives(node));
        if (open === "(" && name) {
            const named = all.filter((node) => node.properties?.[name] && node.required?.includes(name));
            return named.flatMap((node) => this.#alternatives(node.properties[name]));
        }
        return all.filter((node) => !isVariant(node));
    }

    /// Returns the schema nodes that describe one value between two brackets.
    #values(inside, { open, name, field, index }) {
        return inside.flatMap((node) => {
            if (open === "{") {
                return node.additionalProperties ? [node.additionalProperties] : [];
            }
            if (open === "(" && node.properties) {
                return node.properties[field] ? [node.properties[field]] : [];
            }
            if (open === "(" && name && !node.prefixItems) {
                return [node];
            }
            const item = node.prefixItems?.[index] ?? node.items;
            return item ? [item] : [];
        });
    }

    #fields(node, written) {
        return Object.entries(node.properties).filter(([field]) => !written.includes(field)).map(([field, value]) => ({
            label: field,
            type: "property",
            detail: node.required?.includes(field) ? "required" : undefined,
            boost: node.required?.includes(field) ? 1 : 0,
            info: this.#description(value),
            apply: (view, _, from, to) => {
                view.dispatch({ changes: { from, to, insert: `${field}: ` }, selection: { anchor: from + field.length + 2 } });
                startCompletion(view);
            },
        }));
    }

    /// Returns the names of variants, operations and values. `place` is `step` in a list of steps, `run` after the
    /// field `run`, and otherwise `value`.
    #names(nodes, place, inSteps) {
        const all = nodes.flatMap((node) => this.#alternatives(node));
        const options = new Map();
        const add = (name, option) => options.has(name) || options.set(name, option);
        if (place === "step") {
            add("(id:", snippetCompletion("(id: \"${name}\", run: ${}),", { label: "(id: .., run: ..)", type: "text",
                detail: "A step with an id" }));
        }
        for (const node of all) {
            const name = isVariant(node) ? node.required[0] : node.const;
            const operation = this.#examples.get(name);
            if (place !== "value" && operation) {
                const template = escaped(operation.example) + (place === "step" ? "," : "");
                add(name, snippetCompletion(template, { label: name, type: "function",
                    detail: operation.summary, info: operation.example }));
            } else if (isVariant(node)) {
                const inner = this.#alternatives(node.properties[name])[0];
                const template = inner?.type === "array" && !inner.prefixItems ? `${name}([\${}])` : `${name}(\${})`;
                add(name, snippetCompletion(template, { label: name, type: "class", info: node.description }));
            } else if (typeof name === "string") {
                add(name, { label: name, type: "enum", info: node.description });
            } else if (node.type === "boolean") {
                add("true", { label: "true", type: "constant" });
                add("false", { label: "false", type: "constant" });
            }
        }
        if (inSteps && place === "value") {
            for (const parameter of this.parameters) {
                const label = `arg("${parameter}")`;
                add(label, { label, type: "variable", detail: "parameter", boost: -1 });
            }
        }
        return [...options.values()];
    }

    #description(node) {
        const text = node.description ?? this.#alternatives(node)[0]?.description ?? "";
        const standard = node.default === undefined || node.default === null ? "" : ` Defaults to ${JSON.stringify(node.default)}.`;
        return text.replaceAll("\n", " ") + standard || undefined;
    }

    /// Returns the operations that take a selection of elements. `kind` is `Vertex`, `Edge` or `Face`. Each operation
    /// has the text of a step that uses the given selection.
    stepsWith(kind, selection) {
        const reference = `#/$defs/${kind}Selection`;
        return [...this.#examples.values()].flatMap(({ name, example, summary }) => {
            const properties = this.#schema.$defs[name]?.properties ?? {};
            const takes = (node) => node.$ref === reference;
            const field = Object.keys(properties).find((key) => takes(properties[key]) || properties[key].anyOf?.some(takes));
            return field ? [{ name, summary, text: withField(example, field, selection) }] : [];
        });
    }

    /// Returns those fields of an operation for which a form can have inputs. `type` is `number`, `boolean`, `choice`
    /// or `other`. `names` has the name of the field and its earlier names, and `standard` is the default value.
    inputs(operation) {
        const properties = this.#examples.has(operation) ? this.#schema.$defs[operation]?.properties ?? {} : {};
        const fields = Object.entries(properties).filter(([, node]) => !JSON.stringify(node).includes("Selection\""));
        return fields.map(([name, node]) => {
            const all = this.#alternatives(node);
            const types = all.flatMap((choice) => choice.type ?? []).filter((type) => type !== "null");
            const of = all.flatMap((choice) => choice.const ?? choice.enum ?? null);
            const type = ["number", "integer"].includes(types[0]) && all.length === 1 ? "number"
                : types[0] === "boolean" && all.length === 1 ? "boolean"
                    : of.every((choice) => typeof choice === "string") && of.includes(node.default) ? "choice" : "other";
            const { minimum: min, maximum: max } = all[0] ?? {};
            return { name, names: [name, ...node.aliases ?? []], type, of, min, max, whole: types[0] === "integer",
                standard: node.default, info: this.#description(node) };
        });
    }

    /// Returns an example step for each operation that subdivides whole meshes. These are the operations with a
    /// parameter `levels`.
    subdivisions() {
        return this.#steps(({ name }) => this.#schema.$defs[name]?.properties?.levels);
    }

    /// Returns an example step for each operation that is often used on whole meshes.
    onMeshes() {
        return this.#steps(({ name }) => ON_MESHES.includes(name));
    }

    #steps(isOffered) {
        return [...this.#examples.values()].filter(isOffered).map(({ name, summary, example }) => ({ name, summary, text: example }));
    }
}

/// Returns whether a node is a variant with a value, such as `Between(..)`. Names of variants start in upper case, and
/// names of fields in lower case.
function isVariant(node) {
    return node.required?.length === 1 && /^[A-Z]/.test(node.required[0]);
}

function escaped(template) {
    return template.replace(/[\\{}$#]/g, (c) => ("{}".includes(c) ? `\\${c}` : c));
}

/// Sets a field in the text of a step to `value`, and returns the new text.
function withField(step, field, value) {
    const start = step.search(new RegExp(`[( ]${field}: `));
    if (start < 0) {
        return step.replace("(", `(${field}: ${value}${/\(\)$/.test(step) ? "" : ", "}`);
    }
    const from = start + 1 + field.length + 2;
    let depth = 0;
    let to = from;
    while (to < step.length && (depth > 0 || !",)".includes(step[to]))) {
        depth += "([{".includes(step[to]) ? 1 : ")]}".includes(step[to]) ? -1 : 0;
        to += 1;
    }
    return step.slice(0, from) + value + step.slice(to);
}
