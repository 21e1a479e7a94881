// Below each whole recipe of the book, adds a link that opens the recipe in the page for browsers. If the page was
// built before the book, the page and its script `share.js` are in the folder `page` of the book.
(async () => {
    const page = new URL("page/", document.currentScript.src);
    const recipes = document.querySelectorAll("code.language-ron:not(.step):not(.sweep)");
    if (recipes.length === 0) {
        return;
    }
    // A book that is opened from a folder without a server has no access to other files.
    const { link } = await import(new URL("share.js", page)).catch(() => ({}));
    if (link === undefined) {
        return;
    }
    for (const recipe of recipes) {
        const open = document.createElement("a");
        open.href = await link(recipe.textContent, {}, page);
        open.textContent = "Run it here";
        recipe.parentElement.after(open);
    }
})();
