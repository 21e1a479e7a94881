// Shows dialogs, and copies texts to the clipboard.
import { byId, notify } from "./dom.js";
import { link } from "./share.js";

/// Shows the link to a recipe with values of parameters. The link also becomes the address of the page.
export async function showLink(recipe, set) {
    try {
        const url = await link(recipe, set);
        history.replaceState(null, "", url);
        byId("link").value = url;
        byId("link-dialog").showModal();
        byId("link").select();
    } catch (error) {
        notify(error.message);
    }
}

/// Prepares the buttons that close dialogs, and the buttons that copy texts.
export function prepareDialogs() {
    for (const dialog of document.querySelectorAll("dialog")) {
        dialog.querySelector(".heading button").addEventListener("click", () => dialog.close());
        // A click beside the dialog closes it.
        dialog.addEventListener("click", (event) => event.target === dialog && dialog.close());
    }
    byId("copy-link").addEventListener("click", ({ target }) => copy(byId("link").value, target));
    byId("copy-digest").addEventListener("click", ({ target }) => copy(byId("digest").textContent, target));
}

function copy(text, button) {
    navigator.clipboard.writeText(text).then(() => {
        button.textContent = "Copied";
        setTimeout(() => (button.textContent = "Copy"), 1500);
    }, () => notify("The browser does not allow copying. Select the text and copy it yourself."));
}
