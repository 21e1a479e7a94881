// The page: a recipe is checked while it is typed, and run in the worker of the engine.
import { Completions } from "./completion.js";
import { prepareDialogs, showLink } from "./dialogs.js";
import { byId, debounced, download, notify } from "./dom.js";
import { Editor } from "./editor.js";
import { Ended, Engine } from "./engine.js";
import { Files } from "./files.js";
import { namedFiles, prepareGallery } from "./gallery.js";
import { Parameters } from "./parameters.js";
import { Steps, showProblems } from "./results.js";
import { StepForm } from "./step_form.js";
import { LinkError, shared } from "./share.js";
import { Stage } from "./stage.js";
import { CUBE, STARTER } from "./starter.js";
import { isUnfinished, remember, remembered, runBegins, runEnds } from "./visit.js";

const engine = new Engine();
const loaded = engine.load(globalThis.download);

/// Whether the engine is busy with a run, or not loaded yet.
let running = true;
/// Whether a check, or a run, was requested while the engine was busy.
let checkAgain = false;
let runAgain = false;
/// Whether the recipe runs when an input changes or a step is added. If the last run of the recipe did not end, changes
/// only check the recipe, and the visitor must press Run to run it again.
let trusted = true;
/// The step whose meshes are shown: `{ number, total, label, written }`, where `written` is the number of steps of the
/// text that have run; `null` for the last step.
let shown = null;
/// Whether the engine runs the recipe only up to a step. The list of steps then keeps the results of the last run.
let showing = false;
/// Whether the last run was a run of the same recipe, so that the view keeps its camera.
let sameRecipe = false;
/// The axis that points upwards: "y", "z" or "auto".
let up = "auto";
/// True while the page opens a text that is not the visitor's own. The browser must not keep this text for the next
/// visit.
let foreign = false;
/// The text and the values of the last run. The problems and steps of this run are shown until the text or a value
/// changes.
let lastRun;
/// A promise that is settled once the files of a shared recipe are written.
let arriving = Promise.resolve();
let completions;

const editor = new Editor(byId("editor"), {
    onChange: () => { edited(); checkSoon(); },
    onMove: () => showForm(),
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
const steps = new Steps(reveal, chooseStep);
const inputChanged = () => (trusted ? runSoon() : checkSoon());
const parameters = new Parameters(inputChanged, (preset) =>
    engine.presetValues(editor.text, preset).then((values) => parameters.setAll(values), report));
const form = new StepForm(editor, inputChanged);
const showForm = debounced(50, () => form.show());
/// Adds a step after the step whose meshes are shown, and runs the recipe if it is trusted.
function addStep(step) {
    if (!(shown ? editor.insertStep(step, shown.written) : editor.addStep(step))) {
        notify("The step was not added, because the recipe has no list of steps.");
        return;
    }
    form.show();
    byId("step-part").scrollIntoView({ block: "nearest" });
    if (trusted) {
        run();
    }
}

const stage = new Stage(engine, editor, addStep);
const files = new Files(engine, {
    openRecipe: (text, name) => openRecipe(text, { title: name }),
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
    const text = showing ? null : steps.event(event);
    if (text) {
        byId("status").textContent = text;
    }
};

/// Checks the recipe. If a recipe is running, the check starts after that run. With `keepSteps`, the list still shows
/// the steps of the last run.
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

/// Runs the recipe. If a recipe is already running, the new run starts after that run has ended. Returns whether the
/// run succeeded.
async function run() {
    if (running) {
        runAgain = true;
        return false;
    }
    setRunning(true);
    trusted = true;
    await arriving;
    await checkText();
    lastRun = current();
    steps.begin();
    let result;
    try {
        runBegins(lastRun);
        result = await engine.run(editor.text, parameters.values);
        runEnds();
        editor.show(result.problems, true);
        showProblems(result.problems, reveal);
        files.outputs(result.files);
        byId("status").textContent = result.succeeded ? "Done" : result.digest ? "The run failed" : "The recipe has errors";
        if (result.digest) {
            shown = null;
            await stage.show(result, sameRecipe, up);
            sameRecipe = result.objects.length > 0;
        } else {
            const { message } = result.problems.find(({ severity }) => severity === "error") ?? {};
            stage.keep(`The recipe has errors, so it was not run: ${message}`);
        }
    } catch (error) {
        report(error);
    }
    steps.end(result);
    ended();
    return Boolean(result?.succeeded);
}

/// Starts the run or the check that was requested while the engine was busy.
function ended() {
    setRunning(false);
    if (runAgain) {
        runAgain = checkAgain = false;
        run();
    } else if (checkAgain) {
        checkAgain = false;
        check();
    }
}

/// Shows the meshes after a step of the list, counted from 1, and moves the cursor to the line of the step.
async function chooseStep(number, line) {
    if (line) {
        editor.moveTo(line);
    }
    if (!running) {
        showTab("view");
        await (number === steps.total && lastRun === current() ? shown && run() : showStep(number));
    }
}

/// Runs the recipe up to a step, and shows the meshes after this step. Steps whose results the engine still has do not
/// run again.
async function showStep(number) {
    setRunning(true);
    showing = true;
    const { total } = steps;
    byId("status").textContent = `Running up to step ${number}`;
    try {
        const { result, written } = await engine.runTo(number, editor.text, parameters.values);
        if (result.steps.length) {
            const { label } = result.steps.at(-1);
            shown = { number: result.steps.length, total, label, written };
            await stage.show(result, sameRecipe, up, shown);
            sameRecipe = result.objects.length > 0;
            files.lock();
            steps.mark(shown.number);
            byId("status").textContent = `Step ${shown.number} of ${total} is shown`;
        } else {
            notify("There are no meshes to show, because this step or a step before it has an error.");
        }
    } catch (error) {
        report(error);
    }
    showing = false;
    ended();
}

/// Returns the text and the values as one string, so that runs can be compared.
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

/// Replaces the recipe. If `own` is false, the text is not kept for the next visit.
function openRecipe(text, { title, own = true, set = {}, axis = "auto" }) {
    sameRecipe = false;
    trusted = true;
    up = axis;
    parameters.values = set;
    foreign = !own;
    editor.text = text;
    foreign = false;
    shown = null;
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

/// Runs the recipe that was just opened. If the last run of this recipe did not end, it may have exhausted the memory.
/// The recipe is then only checked.
function runOpened() {
    trusted = !isUnfinished(current());
    if (trusted) {
        return run();
    }
    stage.keep("The last run of this recipe did not end: it was canceled, the memory was exhausted, or the browser ended the page. " +
        "Press Run to run the recipe again.");
    return check();
}

/// Opens and runs the recipe of the URL. Returns whether there is one.
async function openShared() {
    try {
        const found = await shared(location.hash);
        if (found) {
            arriving = writeNamed(found.recipe);
            await openRecipe(found.recipe, { title: "Shared recipe", own: false, set: found.set });
            notify("This recipe comes from a link.", { "Back to your recipe": () => {
                if (running && !byId("run").disabled) {
                    cancel();
                }
                openRecipe(remembered() ?? STARTER, { title: "Your recipe" });
                runOpened();
            } });
            runOpened();
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

/// Writes the files of the gallery that a recipe names. Without these files, the check reports which files are missing.
async function writeNamed(recipe) {
    const named = await namedFiles(recipe).catch(() => []);
    if (named.length) {
        write(named);
        lastRun = undefined;
        checkSoon();
    }
}

/// Keeps the text for the next visit, if the browser allows it. The recipe of a link is not kept before the visitor
/// edits it.
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
    remember(editor.text);
}

function showTab(tab) {
    document.body.dataset.tab = tab;
    for (const button of document.querySelectorAll("nav button")) {
        button.setAttribute("aria-pressed", String(button.dataset.tab === tab));
    }
}

function listen() {
    // On a narrow screen, the tab of the recipe hides the view, so a successful run opens the tab of the view.
    byId("run").addEventListener("click", async () => await run() && showTab("view"));
    byId("cancel").addEventListener("click", cancel);
    byId("show-end").addEventListener("click", run);
    byId("share").addEventListener("click", () => showLink(editor.text, parameters.values));
    byId("open-gallery").addEventListener("click", () => byId("gallery").showModal());
    byId("start-cube").addEventListener("click", () => {
        byId("gallery").close();
        openRecipe(CUBE, { title: "Cube" });
        run();
    });
    byId("open-help").addEventListener("click", () => byId("help").showModal());
    prepareDialogs();
    byId("save-recipe").addEventListener("click", () => download("recipe.ron", editor.text, "text/plain"));
    document.querySelector("nav").addEventListener("click", ({ target }) => target.dataset.tab && showTab(target.dataset.tab));
    addEventListener("hashchange", openShared);
    // If the visitor leaves the page during a run, the run counts as ended, because it was not the run that ended the
    // page.
    addEventListener("pagehide", () => running && runEnds());
    addEventListener("keydown", (event) => {
        if (event.key === "Enter" && (event.ctrlKey || event.metaKey) && !event.defaultPrevented) {
            event.preventDefault();
            run();
        }
        if (editor.undoOutside(event) && trusted) {
            run();
        }
    });
}

/// Shows the first text while the engine is loading, then runs it.
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
    // If Run was pressed already, the recipe runs in any case.
    const runs = runAgain;
    runAgain = checkAgain = false;
    await (runs ? run() : runOpened());
    form.completions = stage.completions = completions = new Completions(await engine.describe());
    form.show();
    // The gallery is loaded last, because nothing else needs it.
    prepareGallery(({ name, recipe, up: axis, files: needed }) => {
        write(needed);
        openRecipe(recipe, { title: name, axis });
        run();
    });
    // For tests, and for the console of the browser.
    globalThis.meshwright = { editor, engine, stage };
    document.body.dataset.ready = "";
}

await start();
