// The text of the recipe: CodeMirror with colors, completion, and problems at their places.
import { autocompletion, closeBrackets, closeBracketsKeymap, completionKeymap } from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap, indentWithTab, isolateHistory, redo, undo } from "@codemirror/commands";
import { HighlightStyle, bracketMatching, indentUnit, syntaxHighlighting } from "@codemirror/language";
import { lintGutter, lintKeymap, setDiagnostics } from "@codemirror/lint";
import { highlightSelectionMatches, searchKeymap } from "@codemirror/search";
import { EditorState, StateEffect, StateField, Transaction } from "@codemirror/state";
import {
    Decoration, EditorView, WidgetType, drawSelection, highlightActiveLine, highlightActiveLineGutter, hoverTooltip, keymap,
    lineNumbers,
} from "@codemirror/view";
import { tags } from "@lezer/highlight";
import { element } from "./dom.js";
import { endOfSteps, outline, ron } from "./ron.js";

const colors = HighlightStyle.define([
    { tag: tags.comment, color: "var(--code-comment)", fontStyle: "italic" },
    { tag: tags.string, color: "var(--code-string)" },
    { tag: tags.number, color: "var(--code-number)" },
    { tag: [tags.bool, tags.keyword], color: "var(--code-keyword)" },
    { tag: tags.propertyName, color: "var(--code-field)" },
    { tag: tags.typeName, color: "var(--code-name)" },
    { tag: tags.punctuation, color: "var(--code-punctuation)" },
]);

/// A problem that is shown below its line.
class Message extends WidgetType {
    constructor(problem) {
        super();
        this.problem = problem;
    }

    eq(other) {
        return other.problem.message === this.problem.message && other.problem.help === this.problem.help;
    }

    toDOM() {
        const { severity, message, help } = this.problem;
        return element("div", { class: "line-message" },
            element("div", {}, `${severity}: ${message}`, help && element("span", {}, help)));
    }
}

const showMessages = StateEffect.define();

/// Shows problems below their lines until the text changes.
const messages = StateField.define({
    create: () => Decoration.none,
    update(shown, transaction) {
        const effect = transaction.effects.find((effect) => effect.is(showMessages));
        return effect ? effect.value : transaction.docChanged ? Decoration.none : shown;
    },
    provide: (field) => EditorView.decorations.from(field),
});

/// Describes the word under the pointer.
function tooltips(describe) {
    return hoverTooltip((view, position) => {
        const word = view.state.wordAt(position);
        const text = word && describe(view.state.doc.toString(), word.from, view.state.sliceDoc(word.from, word.to));
        return text ? { pos: word.from, end: word.to, above: true, create: () => ({ dom: element("div", { class: "tip" }, text) }) } : null;
    });
}

export class Editor {
    #view;

    /// Creates the editor. `onChange` is called after each change of the text, and `onMove` after the cursor or the
    /// text has changed. `complete` finds completions. `describe(text, position, word)` returns the description of a
    /// word or `null`. `run` is called when the keys that run the recipe are pressed.
    constructor(parent, { onChange, onMove, complete, describe, run }) {
        const extensions = [
            keymap.of([{ key: "Mod-Enter", run: () => { run(); return true; } }]),
            lineNumbers(), highlightActiveLine(), highlightActiveLineGutter(), lintGutter(), history(), drawSelection(),
            bracketMatching(), closeBrackets(), highlightSelectionMatches(), indentUnit.of("    "), ron,
            syntaxHighlighting(colors), autocompletion({ override: [complete] }), messages, tooltips(describe),
            EditorView.cspNonce.of(STYLE_NONCE),
            EditorView.lineWrapping,
            EditorView.contentAttributes.of({ "aria-label": "Recipe. Press Escape, then Tab to leave the editor.",
                spellcheck: "false" }),
            EditorView.updateListener.of((update) => {
                if (update.docChanged) {
                    onChange();
                }
                if (update.docChanged || update.selectionSet) {
                    onMove();
                }
            }),
            keymap.of([...closeBracketsKeymap, ...defaultKeymap, ...searchKeymap, ...historyKeymap, ...completionKeymap,
                ...lintKeymap, indentWithTab]),
        ];
        this.#view = new EditorView({ parent, state: EditorState.create({ extensions }) });
    }

    get text() {
        return this.#view.state.doc.toString();
    }

    /// The position of the cursor.
    get cursor() {
        return this.#view.state.selection.main.head;
    }

    /// Replaces a part of the text.
    replace(from, to, insert) {
        this.#view.dispatch({ changes: { from, to, insert } });
    }

    /// Replaces the whole text, as one change, and puts the cursor after the last step. The change can be undone,
    /// except for the first text.
    set text(text) {
        const end = endOfSteps(text)?.end ?? text.length;
        const { length } = this.#view.state.doc;
        this.#view.dispatch({ changes: { from: 0, to: length, insert: text }, selection: { anchor: end },
            annotations: length ? isolateHistory.of("full") : Transaction.addToHistory.of(false) });
        this.#view.scrollDOM.scrollTop = 0;
    }

    /// Handles the keys of undo and redo if the focus is not in the editor, an input or a dialog. Returns whether the
    /// text has changed.
    undoOutside(event) {
        const key = (event.ctrlKey || event.metaKey) && !event.altKey ? event.key.toLowerCase() : "";
        if (!["y", "z"].includes(key) || event.defaultPrevented ||
            event.target.closest?.("input, textarea, select, dialog, .cm-editor")) {
            return false;
        }
        event.preventDefault();
        return (key === "y" || event.shiftKey ? redo : undo)(this.#view);
    }

    /// Puts a text in place of the selection.
    insert(text) {
        this.#view.dispatch(this.#view.state.replaceSelection(text), { scrollIntoView: true });
        this.#view.focus();
    }

    /// Adds a step after the last step. Returns false if the recipe has no list of steps.
    addStep(step) {
        const place = endOfSteps(this.text);
        if (!place) {
            return false;
        }
        const comma = place.comma || place.empty ? "" : ",";
        const { text } = this.#view.state.doc.lineAt(place.end);
        // `text` is the line of the last step or, if there are no steps, the line that opens the list of steps.
        const indent = text.match(/^ */)[0] + (/\bsteps\s*:/.test(text) ? "    " : "");
        const insert = `${comma}\n${indent}${step},`;
        const anchor = place.end + insert.length;
        this.#view.dispatch({ changes: { from: place.end, insert }, selection: { anchor }, scrollIntoView: true });
        return true;
    }

    /// Inserts a step after the first `count` steps of the text. Returns false if the text has fewer steps.
    insertStep(step, count) {
        const place = outline(this.text).steps[count - 1];
        if (!place) {
            return false;
        }
        const line = this.#view.state.doc.lineAt(place[0]);
        const indent = line.text.match(/^ */)[0] + (/\bsteps\s*:/.test(line.text) ? "    " : "");
        const insert = `,\n${indent}${step}`;
        this.#view.dispatch({ changes: { from: place[1], insert }, selection: { anchor: place[1] + insert.length },
            scrollIntoView: true });
        return true;
    }

    /// Moves the cursor to the start of a line, counted from 1, without moving the focus.
    moveTo(line) {
        const { doc } = this.#view.state;
        const anchor = doc.line(Math.min(Math.max(line, 1), doc.lines)).from;
        this.#view.dispatch({ selection: { anchor }, effects: EditorView.scrollIntoView(anchor, { y: "nearest", yMargin: 40 }) });
    }

    /// Selects a range or the start of a line, counted from 1, and moves the focus there.
    reveal(range, line) {
        const { doc } = this.#view.state;
        const [anchor, head] = range ?? Array(2).fill(doc.line(Math.min(Math.max(line, 1), doc.lines)).from);
        const selection = { anchor: Math.min(anchor, doc.length), head: Math.min(head, doc.length) };
        this.#view.dispatch({ selection, effects: EditorView.scrollIntoView(selection.anchor, { y: "center" }) });
        this.#view.focus();
    }

    /// Underlines problems of the current text. With `below`, errors also appear below their lines.
    show(problems, below = false) {
        const { doc } = this.#view.state;
        const placed = problems.filter((problem) => problem.range).map((problem) => {
            const [from, to] = problem.range.map((at) => Math.min(at, doc.length));
            return { ...problem, from, to: Math.max(to, Math.min(from + 1, doc.length)) };
        });
        const diagnostics = placed.map(({ from, to, severity, message, help }) =>
            ({ from, to, severity, message: help ? `${message}\n${help}` : message }));
        this.#view.dispatch(setDiagnostics(this.#view.state, diagnostics));
        const widgets = below ? placed.filter((problem) => problem.severity === "error").map((problem) =>
            Decoration.widget({ widget: new Message(problem), block: true, side: 1 }).range(doc.lineAt(problem.to).to)) : [];
        this.#view.dispatch({ effects: showMessages.of(Decoration.set(widgets, true)) });
        if (widgets.length) {
            this.#view.dispatch({ effects: EditorView.scrollIntoView(placed[0].from, { y: "nearest", yMargin: 60 }) });
        }
    }
}
