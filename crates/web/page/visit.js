// Data that the browser keeps between visits: the text of the recipe, and the run that has not ended.

/// Keeps the text for the next visit.
export function remember(text) {
    keep("recipe", text);
}

/// Returns the text of the last visit; `null` if there is none.
export function remembered() {
    return kept("recipe");
}

/// Notes that a run of this text with these values has begun.
export function runBegins(run) {
    keep("unfinished", run);
}

/// Notes that the run has ended, or that the visitor has left the page.
export function runEnds() {
    keep("unfinished", "");
}

/// Returns whether the last run was a run of this text with these values, and has not ended. A run does not end if it
/// is canceled or exhausts the memory, or if the browser ends the page.
export function isUnfinished(run) {
    return kept("unfinished") === run;
}

function keep(key, text) {
    try {
        localStorage.setItem(key, text);
    } catch {
        // If the browser does not allow the page to store data, the text is lost when the page is closed.
    }
}

function kept(key) {
    try {
        return localStorage.getItem(key);
    } catch {
        return null;
    }
}
