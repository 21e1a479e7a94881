// Problems, steps, expectations and the digest.
import { byId, counted, element, sizeText } from "./dom.js";

/// Shows problems as a list. `reveal` moves the cursor to the place of a problem.
export function showProblems(problems, reveal) {
    const errors = problems.filter((problem) => problem.severity === "error").length;
    const warnings = problems.length - errors;
    const counts = [errors && counted(errors, "error"), warnings && counted(warnings, "warning")].filter(Boolean);
    byId("problem-count").textContent = counts.join(", ") || "No problems";
    byId("problem-list").replaceChildren(...problems.map((problem) => {
        const { severity, line, column, file, message, help, range } = problem;
        const place = !line ? "" : range || file === "recipe.ron" ? `${line}:${column}` : `${file}:${line}:${column}`;
        return element("li", { class: severity }, element("button", { type: "button", onclick: () => reveal(range, line) },
            element("span", { class: "place" }, place), element("strong", {}, severity), element("span", {}, message),
            help && element("span", { class: "help" }, help)));
    }));
}

function milliseconds(time) {
    return time < 1000 ? `${time < 10 ? time.toFixed(1) : Math.round(time)} ms` : `${(time / 1000).toFixed(2)} s`;
}

/// The list of steps, which fills during a run.
export class Steps {
    #rows = [];
    #steps = [];
    #begin = 0;

    /// `reveal` moves the cursor to a place of the recipe. `choose` is called with the number and the line of a step
    /// that is clicked.
    constructor(reveal, choose) {
        this.reveal = reveal;
        this.choose = choose;
    }

    /// The number of steps.
    get total() {
        return this.#steps.length;
    }

    /// Marks the step whose meshes are shown.
    mark(number) {
        this.#rows.forEach((row, i) => row.classList.toggle("shown", i === number - 1));
    }

    /// Shows steps that have not run. `bytes` is the predicted memory of their meshes, if it is known.
    list(steps, bytes) {
        this.#steps = steps;
        this.#rows = steps.map(({ label, operation, line }, i) => {
            const title = `Show the meshes after ${label}${line ? `, line ${line}` : ""}`;
            const name = element("button", { type: "button", title, onclick: () => this.choose(i + 1, line) },
                element("span", { class: "number" }, String(i + 1)), " ", label,
                label === operation ? null : element("span", { class: "operation" }, operation));
            const row = element("tr", {}, element("th", { scope: "row" }, name), ...Array.from({ length: 4 }, () => element("td")));
            row.notes = element("tr", { class: "notes", hidden: true }, element("td", { colspan: 5 }));
            return row;
        });
        byId("steps").replaceChildren(...this.#rows.flatMap((row) => [row, row.notes]));
        const memory = bytes ? `, at most ${sizeText(bytes)} of memory for meshes` : "";
        byId("summary").textContent = steps.length ? counted(steps.length, "step") + memory : "";
        byId("expectations-part").hidden = byId("digest-part").hidden = true;
        byId("digest").textContent = "";
    }

    /// Prepares a run.
    begin() {
        this.list(this.#steps);
        this.#begin = performance.now();
        byId("summary").textContent = "running";
    }

    /// Shows an event of the run. Returns a text for the status.
    event(event) {
        const progress = byId("progress");
        if (event.event === "progress") {
            progress.hidden = false;
            progress.max = Math.max(event.total, 1);
            progress.value = event.done;
            return `${event.what}: ${Math.floor((100 * event.done) / Math.max(event.total, 1))} %`;
        }
        const row = this.#rows[event.number - 1];
        if (event.event === "step") {
            row?.classList.add("running");
            row?.scrollIntoView({ block: "nearest", inline: "start" });
            return `Step ${event.number} of ${this.#rows.length}: ${event.label}`;
        }
        progress.hidden = true;
        if (row) {
            this.#done(row, event);
        }
        return null;
    }

    #done(row, done) {
        row.classList.remove("running");
        row.classList.add("done");
        const cells = [done.vertices, done.edges, done.faces].map((n) => n.toLocaleString("en"));
        [...cells, done.cached ? "cached" : milliseconds(done.milliseconds)].forEach((text, i) => (row.cells[i + 1].textContent = text));
        const notes = [
            ...done.refused.map(({ reason, count, first }) => `${counted(count, "edit")} refused (${reason}). The first: ${first}`),
            ...done.losses.map(({ name, message }) => `${name}: ${message}`),
            ...done.changes.map((change) => change.text),
            ...done.notes,
        ];
        row.notes.hidden = notes.length === 0;
        row.notes.cells[0].replaceChildren(...notes.map((note) => element("div", {}, note)));
    }

    /// Shows the end of a run.
    end(result) {
        byId("progress").hidden = true;
        for (const row of this.#rows) {
            if (row.classList.contains("running")) {
                row.classList.replace("running", "failed");
                row.cells[4].textContent = result?.cancelled !== false ? "canceled" : "failed";
            }
        }
        const done = this.#rows.filter((row) => row.classList.contains("done")).length;
        const time = milliseconds(performance.now() - this.#begin);
        byId("summary").textContent = `${done} of ${counted(this.#rows.length, "step")}, ${time}`;
        if (result?.succeeded) {
            byId("results").scrollTop = 0;
        }
        const expectations = result?.expectations ?? [];
        const met = expectations.filter((expectation) => expectation.met).length;
        byId("expectations-part").hidden = expectations.length === 0;
        byId("met").textContent = `${met} of ${expectations.length} met`;
        byId("expectations").replaceChildren(...expectations.map(({ line, text, met, file }) =>
            element("li", { class: met ? "met" : "unmet" }, element("button", { type: "button",
                onclick: () => file === "recipe.ron" && this.reveal(null, line) },
            element("span", { class: "mark" }, met ? "✓ met" : "✗ not met"), element("code", {}, text)))));
        byId("digest").textContent = result?.succeeded ? result.digest : "";
        byId("digest-part").hidden = !result?.succeeded;
    }
}
