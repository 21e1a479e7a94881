// The worker of the engine with threads.
import init, { start_threads as startThreads } from "core";
import { calls } from "./worker.js";

/// Returns the memory, which threads share.
calls.memory = async () => (await init()).memory;

/// Waits for `n` threads, which the page has started, and uses them.
calls.threads = (n) => startThreads(n);
