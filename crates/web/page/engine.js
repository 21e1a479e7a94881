// The engine in its worker. The page keeps the files, so that a new worker can replace a worker that was canceled or
// has failed.
import { cut, outline } from "./ron.js";

/// The maximum number of threads. More threads would need much memory and save little time.
const MAX_THREADS = 16;

/// The engine was ended before it answered.
export class Ended extends Error {}

export class Engine {
    #module;
    #folder = "";
    #worker;
    #threads = [];
    /// A promise that is settled once the worker and its threads can be used.
    #ready;
    #waiting = new Map();
    #last = 0;
    /// Receives the events of runs.
    onEvent = () => {};
    /// Called when the scene and the outputs of the last run are lost.
    onLost = () => {};
    /// The content of each file by its path, without the outputs.
    files = new Map();

    /// Compiles the engine, and starts a worker. `download` gives the `response` that contains the engine, and the
    /// `folder` that contains the script of its worker. Until the engine is loaded, only `write` and `remove` can be
    /// used.
    async load(download) {
        const { response, folder } = await download;
        this.#folder = folder;
        this.#module = await compile(response);
        await this.#start();
    }

    /// The number of threads that a run uses.
    get threads() {
        return 1 + this.#threads.length;
    }

    #start() {
        this.#worker = this.#open("worker.js");
        this.#worker.onmessage = ({ data }) => this.#receive(data);
        this.#worker.onerror = (event) => this.#end(new Ended(event.message || "the engine could not be started"));
        const started = this.#send("start", this.#module, [...this.files]);
        this.#ready = this.#folder ? started.then(() => this.#startThreads()) : started;
        return this.#ready;
    }

    #open(script) {
        return new Worker(new URL(this.#folder + script, import.meta.url), { type: "module" });
    }

    /// Starts one thread fewer than there are processors, but at most `MAX_THREADS` - 1, because the worker is a
    /// thread, too. The page starts the threads, because the worker is blocked while it waits for them.
    async #startThreads() {
        const memory = await this.#send("memory");
        const count = Math.min(navigator.hardwareConcurrency, MAX_THREADS) - 1;
        const threads = Array.from({ length: count }, () => this.#open("thread.js"));
        this.#threads = threads;
        await Promise.all(threads.map((thread) => new Promise((resolve, reject) => {
            thread.onerror = (event) => reject(new Error(event.message || "a thread could not be started"));
            thread.onmessage = () => {
                // If a thread stopped, the worker would wait for it forever.
                thread.onerror = (event) => this.#threads === threads && this.#stopped(event.message);
                resolve();
            };
            thread.postMessage({ module: this.#module, memory });
        })));
        await this.#send("threads", count);
    }

    #receive({ id, value, error, fatal, event }) {
        if (event) {
            this.onEvent(event);
            return;
        }
        const { resolve, reject } = this.#waiting.get(id) ?? {};
        this.#waiting.delete(id);
        if (error === undefined) {
            resolve?.(value);
            return;
        }
        if (fatal) {
            this.#waiting.set(id, { resolve, reject });
            this.#stopped(error);
        } else {
            reject?.(new Error(error));
        }
    }

    /// Starts a new engine after the old engine has stopped with an error.
    #stopped(error) {
        this.#end(new Error(`The engine stopped (${error}), probably because memory is exhausted. The engine was started again.`));
        this.#start().catch(() => {});
    }

    #end(reason) {
        for (const worker of [this.#worker, ...this.#threads]) {
            worker.terminate();
        }
        this.#threads = [];
        this.onLost();
        for (const { reject } of this.#waiting.values()) {
            reject(reason);
        }
        this.#waiting.clear();
    }

    async #call(call, ...args) {
        await this.#ready;
        return this.#send(call, ...args);
    }

    #send(call, ...args) {
        this.#last += 1;
        const id = this.#last;
        return new Promise((resolve, reject) => {
            this.#waiting.set(id, { resolve, reject });
            this.#worker.postMessage({ id, call, args });
        });
    }

    /// Ends the worker at once, and starts another. Calls that have no answer yet fail with `Ended`. Outputs are lost,
    /// files are kept.
    restart() {
        this.#end(new Ended("canceled"));
        return this.#start();
    }

    /// Writes a file that recipes can read.
    async write(path, bytes) {
        this.files.set(path, bytes);
        try {
            await (this.#worker && this.#call("write", path, bytes));
        } catch (error) {
            // If the worker was ended, this is not an error, because the next worker gets all files.
            if (!(error instanceof Ended)) {
                this.files.delete(path);
                throw error;
            }
        }
    }

    /// Removes a file.
    async remove(path) {
        this.files.delete(path);
        try {
            await (this.#worker && this.#call("remove", path));
        } catch (error) {
            // If the worker was ended, this is not an error, because the next worker does not get the removed file.
            if (!(error instanceof Ended)) {
                throw error;
            }
        }
    }

    read(path) {
        return this.#call("read", path);
    }

    /// Checks a recipe. The values in `set` take precedence over the values of the preset with the name `preset`.
    check(recipe, set, preset) {
        return this.#call("check", recipe, set, preset);
    }

    /// Returns the values that a preset of a recipe changes.
    async presetValues(recipe, preset) {
        const [plain, chosen] = await Promise.all([this.check(recipe, {}), this.check(recipe, {}, preset)]);
        const changed = chosen.parameters.filter(({ value }, i) => value !== plain.parameters[i].value);
        return Object.fromEntries(changed.map(({ name, value }) => [name, value]));
    }

    run(recipe, set) {
        return this.#call("run", recipe, set);
    }

    /// Runs a recipe up to a step. `number` is the number of this step in the list that `check` returns, counted from
    /// 1. If the engine still has the result of a step, this step does not run again. Returns the result, and the
    /// number of steps of the text up to this step. This number can differ from `number`. For example, a `Repeat` is
    /// one step of the text, but several steps of the list that `check` returns.
    async runTo(number, recipe, set) {
        let [written, most] = [1, outline(recipe).steps.length];
        while (written < most) {
            const middle = Math.floor((written + most) / 2);
            const { steps } = await this.check(cut(recipe, middle), set);
            [written, most] = steps.length >= number ? [written, middle] : [middle + 1, most];
        }
        return { result: await this.run(cut(recipe, written), set), written };
    }

    /// Returns colors that show a quantity of the meshes of the last run.
    colors(quantity) {
        return this.#call("colors", quantity);
    }

    picture(options) {
        return this.#call("picture", options);
    }

    /// Returns the schema of recipes and the operations, even if the worker is replaced meanwhile.
    async describe() {
        try {
            return await this.#call("describe");
        } catch (error) {
            if (error instanceof Ended) {
                return this.describe();
            }
            throw error;
        }
    }
}

async function compile(response) {
    if (!response.ok) {
        throw new Error(`${response.url} cannot be loaded: ${response.status}`);
    }
    // Some servers do not know the type of WebAssembly files.
    return response.headers.get("content-type")?.startsWith("application/wasm")
        ? WebAssembly.compileStreaming(response)
        : WebAssembly.compile(await response.arrayBuffer());
}
