// A thread of the engine. The page sends the compiled engine and its memory, and receives an empty message once the
// thread waits for work.
import init, { run_thread as runThread } from "core";

onmessage = async ({ data: { module, memory } }) => {
    await init({ module_or_path: module, memory, thread_stack_size: 2 ** 21 });
    postMessage(null);
    runThread();
};
