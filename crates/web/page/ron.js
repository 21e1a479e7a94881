// The language of recipes (RON): colors for the editor, and the structure around a position.
import { StreamLanguage } from "@codemirror/language";

const WORD = /[A-Za-z_][A-Za-z0-9_]*/y;
const NUMBER = /[+-]?(?:0x[0-9a-fA-F_]+|(?:[0-9][0-9_]*)?\.?[0-9][0-9_]*\.?(?:[eE][+-]?[0-9]+)?)/y;
const STRING = /"(?:[^"\\]|\\[^])*"?/y;
const COMMENT = /\/\/[^\n]*|\/\*[^]*?(?:\*\/|$)/y;
const SPACE = /\s+/y;

/// Yields the tokens of a text, without the white space between them: `{ kind, text, start, end }`. The kind is `word`,
/// `number`, `string` or `comment`. For all other tokens, the kind is the character itself.
export function* tokens(text) {
    let start = 0;
    const match = (pattern) => {
        pattern.lastIndex = start;
        return pattern.exec(text)?.[0];
    };
    while (start < text.length) {
        const space = match(SPACE);
        start += space?.length ?? 0;
        const found = [["comment", COMMENT], ["string", STRING], ["word", WORD], ["number", NUMBER]]
            .map(([kind, pattern]) => [kind, match(pattern)]).find(([, part]) => part);
        const [kind, part] = found ?? [text[start], text[start]];
        if (part === undefined) {
            return;
        }
        yield { kind, text: part, start, end: start + part.length };
        start += part.length;
    }
}

/// Returns the brackets around a position, from the outside in: `{ open, name, start, field, index, fields }`. `name`
/// is the name before a parenthesis, and `field` is the name of the field that contains the position. `index` is the
/// index of the item that contains the position, counted from 0. `fields` has the names of all fields before the
/// position. Returns `null` inside a string or a comment.
export function around(text, position) {
    const stack = [{ open: "", name: null, start: 0, field: null, index: 0, fields: [] }];
    let before = null;
    for (const token of tokens(text)) {
        const { kind, start, end } = token;
        const inside = start < position && position < end;
        if (kind === "comment" ? start < position && position <= end && text[end - 1] !== "/" : kind === "string" && inside) {
            return null;
        }
        // A word that ends at the position is being typed.
        if (start >= position || (kind === "word" && end >= position)) {
            break;
        }
        const top = stack.at(-1);
        if ("([{".includes(kind)) {
            const name = kind === "(" && before?.kind === "word" ? before.text : null;
            stack.push({ open: kind, name, start: name ? before.start : start, field: null, index: 0, fields: [] });
        } else if (")]}".includes(kind) && stack.length > 1) {
            stack.pop();
        } else if (kind === ":") {
            top.field = before?.text ?? null;
            top.fields.push(top.field);
        } else if (kind === ",") {
            top.field = null;
            top.index += 1;
        }
        if (kind !== "comment") {
            before = token;
        }
    }
    return stack;
}

/// Returns where another step can be added to the list of steps. `end` is the position after the last step and its
/// comma. `comma` says whether the last step has a comma, and `empty` says whether the list has no steps. Returns
/// `null` if the recipe has no list of steps.
export function endOfSteps(text) {
    let depth = 0;
    let before = [];
    let inSteps = false;
    for (const token of tokens(text)) {
        if (token.kind === "comment") {
            continue;
        }
        if ("([{".includes(token.kind)) {
            depth += 1;
            inSteps ||= depth === 2 && before[1]?.text === "steps" && before[0].kind === ":";
        } else if (")]}".includes(token.kind)) {
            if (inSteps && depth === 2) {
                return { end: before[0].end, comma: before[0].kind === ",", empty: before[0].kind === "[" };
            }
            depth -= 1;
        }
        before = [token, before[0]];
    }
    return null;
}

/// Returns the places of the steps and the expectations of a recipe. `steps` has the start and the end of each step.
/// `expect` has the start and the end of the field `expect`, including its comma. `expect` is `null` if the recipe has
/// no such field.
export function outline(text) {
    const steps = [];
    let expect = null;
    let depth = 0;
    let field = null;
    let step = null;
    let before = null;
    for (const token of tokens(text)) {
        const { kind, start, end } = token;
        if (kind === "comment") {
            continue;
        }
        const outside = depth;
        depth += "([{".includes(kind) ? 1 : ")]}".includes(kind) ? -1 : 0;
        const ends = kind === "," || depth < outside;
        if (outside === 1 && kind === ":") {
            field = { name: before?.text, start: before?.start };
        } else if (outside === 1 && ends) {
            if (field?.name === "expect") {
                expect = [field.start, kind === "," ? end : start];
            }
            field = null;
        } else if (field?.name === "steps" && outside >= 2) {
            if (outside > 2 || !ends) {
                step ??= [start, end];
                step[1] = end;
            } else if (step) {
                steps.push(step);
                step = null;
            }
        }
        before = token;
    }
    return { steps, expect };
}

/// Returns the recipe with only the first `count` steps of its text, and without expectations.
export function cut(text, count) {
    const { steps, expect } = outline(text);
    const removed = [[steps[count - 1][1], steps.at(-1)[1]], expect].filter(Boolean).sort((a, b) => b[0] - a[0]);
    return removed.reduce((left, [start, end]) => left.slice(0, start) + left.slice(end), text);
}

/// Returns the index of the step that contains a position. If no step contains the position, returns the index of the
/// first step that starts after the position on the same line. Returns `null` if no step starts there.
export function stepAt(text, position) {
    const { steps } = outline(text);
    const line = text.lastIndexOf("\n", position - 1) + 1;
    const lineEnd = `${text}\n`.indexOf("\n", position);
    // The comma after a step belongs to the step.
    const near = steps.filter(([start, end]) => start <= lineEnd && end + 1 >= position && (start <= position || start >= line));
    const found = near.findLast(([start]) => start <= position) ?? near[0];
    return found ? steps.indexOf(found) : null;
}

/// Returns the operation of a step, as `{ name, fields, next }`. `fields` has the tokens of the value of each field.
/// `next` says where another field can be written, and which text must come before this field. Returns `null` if the
/// text is incomplete.
export function written(text, [begin, finish]) {
    const all = [...tokens(text.slice(begin, finish))].filter(({ kind }) => kind !== "comment")
        .map((token) => ({ ...token, start: token.start + begin, end: token.end + begin }));
    const first = all[0].kind === "(" ? all.findIndex(({ kind }, i) => kind === ":" && all[i - 1]?.text === "run") + 1 : 0;
    if (all[first]?.kind !== "word" || all[first + 1]?.kind !== "(") {
        return null;
    }
    const fields = new Map();
    let depth = 1;
    let value = null;
    for (let i = first + 2; i < all.length; i += 1) {
        const { kind, text: word } = all[i];
        depth += "([{".includes(kind) ? 1 : ")]}".includes(kind) ? -1 : 0;
        if (depth === 0) {
            const last = all[i - 1];
            return { name: all[first].text, fields, next: { from: last.end, to: last.end, before: "(,".includes(last.kind) ? "" : ", " } };
        }
        if (depth === 1 && kind === "word" && all[i + 1]?.kind === ":") {
            value = [];
            fields.set(word, value);
            i += 1;
        } else if (!(depth === 1 && kind === ",")) {
            value?.push(all[i]);
        }
    }
    return null;
}

/// Returns a text as a recipe writes it: in quotes, with escapes, and without control characters.
export function quoted(text) {
    return `"${text.replace(/[\\"]/g, "\\$&").replace(/[\u0000-\u001f]/g, "")}"`;
}

function token(stream, state) {
    if (state.comment) {
        state.comment = !stream.match(/^.*?\*\//);
        if (state.comment) {
            stream.skipToEnd();
        }
        return "comment";
    }
    if (stream.eatSpace()) {
        return null;
    }
    if (stream.match("//")) {
        stream.skipToEnd();
        return "comment";
    }
    if (stream.match("/*")) {
        state.comment = true;
        return "comment";
    }
    if (stream.match(/^"(?:[^"\\]|\\.)*"?/)) {
        return "string";
    }
    if (stream.match(/^[+-]?\.?[0-9][0-9_a-fA-Fx.]*(?:[eE][+-]?[0-9]+)?/)) {
        return "number";
    }
    if (stream.match(/^[A-Za-z_][A-Za-z0-9_]*/)) {
        const word = stream.current();
        return word === "true" || word === "false" ? "bool"
            : word === "arg" ? "keyword"
                : stream.match(/^\s*:/, false) ? "propertyName" : "typeName";
    }
    const character = stream.next();
    if ("([{".includes(character)) {
        state.open.push(stream.indentation());
    } else if (")]}".includes(character)) {
        state.open.pop();
    }
    return "punctuation";
}

/// The language for CodeMirror.
export const ron = StreamLanguage.define({
    name: "ron",
    // For each open bracket, `open` has the indentation of its line.
    startState: () => ({ comment: false, open: [] }),
    token,
    indent: ({ open }, after, cx) => (open.length ? open.at(-1) + (/^\s*[)\]}]/.test(after) ? 0 : cx.unit) : 0),
    languageData: {
        commentTokens: { line: "//", block: { open: "/*", close: "*/" } },
        closeBrackets: { brackets: ["(", "[", "{", "\""] },
        indentOnInput: /^\s*[)\]}]$/,
    },
});
