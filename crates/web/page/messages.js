// Messages of the engine name commands of the command-line program. In the page, other texts replace these commands.

const IN_PAGE = [
    ["`meshwright ops` lists all operations", "the reference, linked below the recipe, lists all operations"],
    ["`meshwright ops --selections` lists all selections", "Ctrl+Space lists all selections"],
    ["`meshwright expectations` lists all expectations", "Ctrl+Space lists all expectations"],
    ["run `meshwright upgrade` to replace old names in the recipe", "replace the old name in the recipe"],
    [" or the memory budget (`--budget`)", ""],
];

/// Returns the problems with changed messages: each command of the command-line program is replaced by what the page
/// has instead. If the page has nothing instead, the message says that the command belongs to the command-line program.
export function inPage(problems) {
    return problems.map((problem) => ({ ...problem, message: translated(problem.message), help: problem.help && translated(problem.help) }));
}

function translated(text) {
    const replaced = IN_PAGE.reduce((text, [from, to]) => text.replace(from, to), text);
    return replaced.includes("`meshwright ") ? `${replaced} (with the command-line program)` : replaced;
}
