//! The threads of the engine: Web Workers that share its memory.
//!
//! ```text
//! worker of the engine            page                           other workers
//!   Session.create()  -- memory -->  starts the workers  -- memory -->  load, ready
//!   start_threads(n)  <-------------  after all are ready               run_thread(), which never returns
//! ```
//!
//! Only builds with shared memory contain this module. Browsers share memory only if the page is isolated from other
//! origins.

#![expect(unreachable_pub, reason = "wasm-bindgen exports only public functions")]

use std::sync::{Condvar, Mutex, PoisonError};

use rayon::{ThreadBuilder, ThreadPoolBuilder};
use wasm_bindgen::prelude::*;

/// The threads that no worker runs yet.
static WAITING: Mutex<Vec<ThreadBuilder>> = Mutex::new(Vec::new());
static ADDED: Condvar = Condvar::new();

/// Creates the thread pool of the engine from the calling worker and `n` other workers. Blocks until the other workers
/// have called [`run_thread`].
#[wasm_bindgen]
pub fn start_threads(n: usize) -> Result<(), JsError> {
    let pool = ThreadPoolBuilder::new()
        .num_threads(n + 1)
        .use_current_thread()
        .spawn_handler(|thread| {
            let mut waiting = WAITING.lock().unwrap_or_else(PoisonError::into_inner);
            waiting.push(thread);
            ADDED.notify_one();
            Ok(())
        });
    pool.build_global()?;
    Ok(())
}

/// Works as a thread of the engine. Never returns.
#[wasm_bindgen]
pub fn run_thread() {
    let mut waiting = WAITING.lock().unwrap_or_else(PoisonError::into_inner);
    let thread = loop {
        if let Some(thread) = waiting.pop() {
            break thread;
        }
        waiting = (ADDED.wait(waiting)).unwrap_or_else(PoisonError::into_inner);
    };
    drop(waiting);
    thread.run();
}
