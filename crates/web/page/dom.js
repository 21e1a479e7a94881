// Elements of the page. Text from recipes, files and errors always becomes text nodes, never markup.

/// Returns the element with an id.
export function byId(id) {
    return document.getElementById(id);
}

/// Creates an element: `element("button", { class: "plain", onclick }, "Text", child, ..)`. Functions become listeners.
/// Attributes that are `null` or `false` are left out.
export function element(name, attributes = {}, ...children) {
    const created = document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) {
        if (typeof value === "function") {
            created.addEventListener(key.slice(2), value);
        } else if (value !== null && value !== undefined && value !== false) {
            created.setAttribute(key, value === true ? "" : value);
        }
    }
    created.append(...children.filter((child) => child !== null && child !== undefined));
    return created;
}

/// Returns a count with its noun: `counted(2, "mesh", "meshes")`.
export function counted(n, one, many = `${one}s`) {
    return `${n.toLocaleString("en")} ${n === 1 ? one : many}`;
}

/// Returns a text for a size in bytes, such as `1.50 kB`.
export function sizeText(bytes) {
    return bytes < 1000 ? counted(bytes, "byte")
        : bytes < 1e6 ? `${(bytes / 1e3).toPrecision(3)} kB`
            : bytes < 999e6 ? `${(bytes / 1e6).toPrecision(3)} MB` : `${(bytes / 1e9).toPrecision(3)} GB`;
}

/// Returns a function that calls `action` with a delay of the given number of milliseconds. If the returned function is
/// called again during the delay, the delay restarts.
export function debounced(milliseconds, action) {
    let timer;
    return (...values) => {
        clearTimeout(timer);
        timer = setTimeout(() => action(...values), milliseconds);
    };
}

/// Offers bytes to the visitor as a download.
export function download(name, content, type = "application/octet-stream") {
    const url = URL.createObjectURL(content instanceof Blob ? content : new Blob([content], { type }));
    element("a", { href: url, download: name }).click();
    setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

/// Shows a message in the status bar, with a button for each action that is offered: `{ label: action, .. }`.
export function notify(text, actions = {}) {
    const bar = byId("notice");
    const buttons = Object.entries(actions).map(([label, action]) =>
        element("button", { type: "button", onclick: () => { bar.hidden = true; action(); } }, label));
    const close = element("button", { type: "button", class: "plain", "aria-label": "Close the message",
        onclick: () => { bar.hidden = true; } }, "×");
    bar.replaceChildren(element("span", { role: "status" }, text), ...buttons, close);
    bar.hidden = false;
}
