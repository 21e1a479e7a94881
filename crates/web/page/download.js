// Starts the download of the engine before the other scripts are loaded. Browsers share memory between threads only if
// the page is isolated from other origins.
globalThis.download = (async () => {
    if (globalThis.crossOriginIsolated) {
        const response = await fetch("threads/core_bg.wasm");
        if (response.ok) {
            return { response, folder: "threads/" };
        }
    }
    return { response: await fetch("core_bg.wasm"), folder: "" };
})();
