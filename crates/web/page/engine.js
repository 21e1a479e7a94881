// The engine in its worker. The page keeps the files, so that a new worker can replace one that was canceled or has failed.

/// The engine was ended before it answered.
export class Ended extends Error {}

export class Engine {
    #module;
    #worker;
    #waiting = new Map();
    #last = 0;
    /// Receives the events of runs.
    onEvent = () => {};
    /// The content of each file by its path. Outputs are not among them.
    files = new Map();

    /// Downloads and compiles the engine, and starts a worker. Until then, files can be written, and nothing else.
    async load(url) {
        this.#module = await compile(url);
        await this.#start();
    }

    #start() {
        this.#worker = new Worker(new URL("worker.js", import.meta.url), { type: "module" });
        this.#worker.onmessage = ({ data }) => this.#receive(data);
        this.#worker.onerror = (event) => this.#end(new Ended(event.message || "the engine could not be started"));
        return this.#call("start", this.#module, [...this.files]);
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
        reject?.(new Error(fatal ? `The engine stopped (${error}), probably because memory is exhausted. Another one was started.`
            : error));
        if (fatal) {
            this.restart().catch(() => {});
        }
    }

    #end(reason) {
        this.#worker.terminate();
        for (const { reject } of this.#waiting.values()) {
            reject(reason);
        }
        this.#waiting.clear();
    }

    #call(call, ...args) {
        this.#last += 1;
        const id = this.#last;
        return new Promise((resolve, reject) => {
            this.#waiting.set(id, { resolve, reject });
            this.#worker.postMessage({ id, call, args });
        });
    }

    /// Ends the worker at once, and starts another. Calls that wait fail with `Ended`. Outputs are lost, files are kept.
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
            // The next worker gets all files.
            if (!(error instanceof Ended)) {
                this.files.delete(path);
                throw error;
            }
        }
    }

    /// Removes a file, which needs another worker.
    async remove(path) {
        this.files.delete(path);
        await (this.#worker && this.restart());
    }

    read(path) {
        return this.#call("read", path);
    }

    check(recipe, set) {
        return this.#call("check", recipe, set);
    }

    run(recipe, set) {
        return this.#call("run", recipe, set);
    }

    /// Returns the colors of a quantity of the meshes of the last run.
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

async function compile(url) {
    const response = await fetch(url);
    if (!response.ok) {
        throw new Error(`${url} cannot be loaded: ${response.status}`);
    }
    // Some servers do not know the type of WebAssembly files.
    return response.headers.get("content-type")?.startsWith("application/wasm")
        ? WebAssembly.compileStreaming(response)
        : WebAssembly.compile(await response.arrayBuffer());
}
