// The search field of the reference of operations. The reference lists operations, and the types of their parameters.
// An entry is shown only if every word of the search field occurs in its name or in its summary.
const field = document.querySelector("#search");
const entries = [...document.querySelectorAll("h2")].map((heading) => {
    const parts = [heading];
    for (let next = heading.nextElementSibling; next && next.tagName !== "H2"; next = next.nextElementSibling) {
        parts.push(next);
    }
    // The list at the top has the names and summaries of operations. The summary of a type is its first paragraph.
    const item = document.querySelector(`body > ul > li:has(> a[href="#${heading.id}"])`);
    const text = item?.textContent ?? heading.textContent + parts[1]?.textContent;
    return { text: text.toLowerCase(), isOperation: Boolean(item), parts: item ? [item, ...parts] : parts };
});

function search() {
    const words = field.value.toLowerCase().split(/\s+/);
    const found = new Set(entries.filter(({ text }) => words.every((word) => text.includes(word))));
    for (const entry of entries) {
        entry.parts.forEach((part) => (part.hidden = !found.has(entry)));
    }
    const count = (all) => [...all].filter(({ isOperation }) => isOperation).length;
    document.querySelector("#found").textContent = `${count(found)} of ${count(entries)} operations`;
}

field.addEventListener("input", () => {
    search();
    scrollTo(0, 0);
});
// A link to a hidden entry ends the search.
addEventListener("hashchange", () => {
    const target = document.getElementById(location.hash.slice(1));
    if (target?.hidden) {
        field.value = "";
        search();
        target.scrollIntoView();
    }
});
search();
