// The page: a recipe is checked while it is typed, and run in the worker of the engine.
import { Completions } from "./completion.js";
import { byId, debounced, download, notify } from "./dom.js";
import { Editor } from "./editor.js";
import { Ended, Engine } from "./engine.js";
import { Files } from "./files.js";
import { namedFiles, prepareGallery } from "./gallery.js";
import { Parameters } from "./parameters.js";
import { Steps, showProblems } from "./results.js";
import { LinkError, link, shared } from "./share.js";
import { Stage } from "./stage.js";
import { CUBE, STARTER } from "./starter.js";

const engine = new Engine();
const loaded = engine.load(globalThis.download);

/// Whether the engine is busy with a run, or not loaded yet.
let running = true;
/// Whether the text or a value has changed since the last check or run began.
let checkAgain = false;
let runAgain = false;
/// Whether the visitor has run the recipe. A shared recipe is only checked until then.
let trusted = true;
/// Whether the last run was a run of the same recipe, so that the view keeps its camera.
let sameRecipe = false;
/// The axis that points upwards: "y", "z" or "auto".
let up = "auto";
/// Whether the text that is being opened must not be kept for the next visit.
let foreign = false;
/// The text and the values of the last run. Its problems and steps are shown until the text or a value changes.
let lastRun;
/// A promise that is settled once the files of a shared recipe are written.
let arriving = Promise.resolve();
let completions;

const editor = new Editor(byId("editor"), {
    onChange: () => { edited(); checkSoon(); },
    complete: (context) => completions?.source(context) ?? null,
    describe: (...place) => completions?.describe(...place) ?? null,
    run,
});
const reveal = (range, line) => {
    if (line || range) {
        showTab("recipe");
        editor.reveal(range, line);
    }
};
const steps = new Steps(reveal);
const parameters = new Parameters(() => (trusted ? runSoon() : checkSoon()), choosePreset);
/// Adds a step, and runs the recipe if it is trusted.
function addStep(step) {
    if (!editor.addStep(step)) {
        notify("The recipe has no list of steps.");
    } else if (trusted) {
        run();
    }
}

const stage = new Stage(engine, editor, addStep);
const files = new Files(engine, {
    openRecipe: (text, name) => openRecipe(text, { title: name, trust: true }),
    addStep,
    changed: () => { lastRun = undefined; check(true); },
});
const checkSoon = debounced(100, () => check());
const runSoon = debounced(60, run);
engine.onLost = () => {
    stage.detach();
    files.outputs([]);
};
engine.onEvent = (event) => {
    const text = steps.event(event);
    if (text) {
        byId("status").textContent = text;
    }
};

/// Checks the recipe. If a recipe is running, the check starts after that run. With `keepSteps`, the steps of the last
/// run stay.
async function check(keepSteps = false) {
    if (running) {
        checkAgain = true;
    } else {
        await checkText(keepSteps);
    }
}

/// Checks the recipe, and shows problems, parameters and steps.
async function checkText(keepSteps) {
    const text = editor.text;
    if (lastRun === current()) {
        return;
    }
    lastRun = undefined;
    try {
        const checked = await engine.check(text, parameters.values);
        if (editor.text !== text) {
            return;
        }
        editor.show(checked.problems);
        showProblems(checked.problems, reveal);
        parameters.show(checked.parameters, checked.presets);
        if (!keepSteps) {
            steps.list(checked.steps, checked.peak_bytes);
        }
        if (completions) {
            completions.parameters = checked.parameters.map(({ name }) => name);
        }
    } catch (error) {
        report(error);
    }
}

/// Runs the recipe. If a recipe is already running, the new run starts after that run has ended. Returns whether the run
/// succeeded.
async function run() {
    if (running) {
        runAgain = true;
        return false;
    }
    setRunning(true);
    if (!trusted) {
        // Closes the message that the recipe comes from a link.
        byId("notice").hidden = true;
    }
    trusted = true;
    await arriving;
    await checkText();
    lastRun = current();
    steps.begin();
    let result;
    try {
        result = await engine.run(editor.text, parameters.values);
        editor.show(result.problems, true);
        showProblems(result.problems, reveal);
        files.outputs(result.files);
        byId("status").textContent = result.succeeded ? "Done" : result.digest ? "The run failed" : "The recipe has errors";
        if (result.digest) {
            await stage.show(result, sameRecipe, up);
            sameRecipe = result.objects.length > 0;
        } else {
            stage.keep();
        }
    } catch (error) {
        report(error);
    }
    steps.end(result);
    setRunning(false);
    if (runAgain) {
        runAgain = checkAgain = false;
        run();
    } else if (checkAgain) {
        checkAgain = false;
        check();
    }
    return Boolean(result?.succeeded);
}

/// Sets the parameters to the values of a preset.
async function choosePreset(name) {
    try {
        const text = editor.text;
        const [plain, chosen] = await Promise.all([engine.check(text, {}), engine.check(text, {}, name)]);
        const changed = chosen.parameters.filter(({ value }, i) => value !== plain.parameters[i].value);
        parameters.setAll(Object.fromEntries(changed.map(({ name, value }) => [name, value])));
    } catch (error) {
        report(error);
    }
}

/// Returns the text and the values as one key.
function current() {
    return JSON.stringify([editor.text, parameters.values]);
}

/// Ends the run at once. A new worker takes over.
function cancel() {
    runAgain = false;
    engine.restart().catch(report);
}

function setRunning(is) {
    running = is;
    byId("run").hidden = is;
    byId("cancel").hidden = !is;
    document.body.classList.toggle("running", is);
    (is && document.activeElement === document.body ? byId("cancel") : null)?.focus();
}

function report(error) {
    if (!(error instanceof Ended)) {
        byId("status").textContent = "";
        notify(error.message);
    } else {
        byId("status").textContent = "Canceled";
    }
}

/// Replaces the recipe. If `trust` is false, the recipe is only checked until the visitor runs it.
function openRecipe(text, { title, trust, set = {}, axis = "auto" }) {
    sameRecipe = false;
    trusted = trust;
    up = axis;
    parameters.values = set;
    foreign = !trust;
    editor.text = text;
    foreign = false;
    steps.list([]);
    byId("notice").hidden = true;
    byId("status").textContent = title;
    showTab("recipe");
    return check();
}

/// Gives files to the worker, which writes them before it reads the next recipe.
function write(needed) {
    for (const [path, bytes] of needed) {
        engine.write(path, bytes).catch(report);
    }
    files.show();
}

/// Opens the recipe of the URL. Returns whether there is one.
async function openShared() {
    try {
        const found = await shared(location.hash);
        if (found) {
            arriving = writeNamed(found.recipe);
            await openRecipe(found.recipe, { title: "Shared recipe", trust: false, set: found.set });
            notify("This recipe comes from a link. Press Run to see its meshes.",
                { "Back to your recipe": () => openRecipe(remembered() ?? STARTER, { title: "Your recipe", trust: true }) });
        }
        return Boolean(found);
    } catch (error) {
        if (!(error instanceof LinkError)) {
            throw error;
        }
        notify(error.message);
        return false;
    }
}

/// Writes the files of the scenes that a recipe names. Without them, the check reports which files are missing.
async function writeNamed(recipe) {
    const named = await namedFiles(recipe).catch(() => []);
    if (named.length) {
        write(named);
        lastRun = undefined;
        checkSoon();
    }
}

async function share() {
    try {
        const url = await link(editor.text, parameters.values);
        history.replaceState(null, "", url);
        byId("link").value = url;
        byId("link-dialog").showModal();
        byId("link").select();
    } catch (error) {
        notify(error.message);
    }
}

function copy(text, button) {
    navigator.clipboard.writeText(text).then(() => {
        button.textContent = "Copied";
        setTimeout(() => (button.textContent = "Copy"), 1500);
    }, () => notify("The browser does not allow copying. Select the text and copy it yourself."));
}

/// Keeps the text for the next visit, if the browser allows it. The recipe of a link is kept only once it is edited.
function edited() {
    if (foreign) {
        return;
    }
    if (lastRun && lastRun !== current()) {
        byId("status").textContent = "Changed since the last run";
    }
    if (location.hash) {
        history.replaceState(null, "", location.pathname + location.search);
    }
    try {
        localStorage.setItem("recipe", editor.text);
    } catch {
        // If the browser does not allow it, the text is lost when the page is closed.
    }
}

function remembered() {
    try {
        return localStorage.getItem("recipe");
    } catch {
        return null;
    }
}

function showTab(tab) {
    document.body.dataset.tab = tab;
    for (const button of document.querySelectorAll("nav button")) {
        button.setAttribute("aria-pressed", String(button.dataset.tab === tab));
    }
}

function listen() {
    // On a narrow screen, the tabs hide the view.
    byId("run").addEventListener("click", async () => await run() && showTab("view"));
    byId("cancel").addEventListener("click", cancel);
    byId("share").addEventListener("click", share);
    byId("open-gallery").addEventListener("click", () => byId("gallery").showModal());
    byId("start-cube").addEventListener("click", () => {
        byId("gallery").close();
        openRecipe(CUBE, { title: "Cube", trust: true });
        run();
    });
    byId("open-help").addEventListener("click", () => byId("help").showModal());
    for (const dialog of document.querySelectorAll("dialog")) {
        dialog.querySelector(".heading button").addEventListener("click", () => dialog.close());
        // A click beside the dialog closes it.
        dialog.addEventListener("click", (event) => event.target === dialog && dialog.close());
    }
    byId("copy-link").addEventListener("click", ({ target }) => copy(byId("link").value, target));
    byId("copy-digest").addEventListener("click", ({ target }) => copy(byId("digest").textContent, target));
    byId("save-recipe").addEventListener("click", () => download("recipe.ron", editor.text, "text/plain"));
    document.querySelector("nav").addEventListener("click", ({ target }) => target.dataset.tab && showTab(target.dataset.tab));
    addEventListener("hashchange", openShared);
    addEventListener("keydown", (event) => {
        if (event.key === "Enter" && (event.ctrlKey || event.metaKey) && !event.defaultPrevented) {
            event.preventDefault();
            run();
        }
        undoOutside(event);
    });
}

/// Undoes or redoes a change of the recipe, and runs it if it is trusted, for a key that no text field gets.
function undoOutside(event) {
    const key = (event.ctrlKey || event.metaKey) && !event.altKey ? event.key.toLowerCase() : "";
    if (!["y", "z"].includes(key) || event.defaultPrevented ||
        event.target.closest?.("input, textarea, select, dialog, .cm-editor")) {
        return;
    }
    event.preventDefault();
    const changed = key === "y" || event.shiftKey ? editor.redo() : editor.undo();
    if (changed && trusted) {
        run();
    }
}

/// Shows the first text while the engine is loading, then runs or checks it.
async function start() {
    listen();
    files.outputs([]);
    const earlier = remembered() ?? STARTER;
    foreign = true;
    editor.text = earlier;
    foreign = false;
    const isShared = await openShared();
    try {
        await loaded;
    } catch (error) {
        byId("status").textContent = `The engine cannot be started: ${error.message}`;
        return;
    }
    byId("status").textContent = isShared ? "Shared recipe" : "Ready";
    byId("run").disabled = running = false;
    // A recipe of an earlier visit may be one that exhausts the memory, so it is only checked, unless Run was pressed already.
    trusted = runAgain || (!isShared && editor.text === STARTER);
    runAgain = checkAgain = false;
    await (trusted ? run() : check());
    stage.completions = completions = new Completions(await engine.describe());
    // The gallery is loaded last, because nothing else needs it.
    prepareGallery(({ name, recipe, up: axis, files: needed }) => {
        write(needed);
        openRecipe(recipe, { title: name, trust: true, axis });
        run();
    });
    // For tests, and for the console of the browser.
    globalThis.meshwright = { editor, engine, stage };
    document.body.dataset.ready = "";
}

await start();
