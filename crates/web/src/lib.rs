//! The engine for browsers and Node: recipes that run on files in memory.
//!
//! ```text
//! session.rs  Session: files, check, run, and the scene of the last run; plain Rust, tested natively
//! kept.rs     the results of the last run, so that the next run starts at the first step that changed
//! describe.rs problems, expectations, parameters and objects as JSON
//! arrays.rs   the arrays of a mesh that a view needs
//! colors.rs   the colors of quantities for these arrays
//! bindings.rs the same functions for JavaScript, through `wasm-bindgen`; only in WebAssembly
//! threads.rs  Web Workers as threads; only in a build with shared memory
//! ```
//!
//! `build.sh` builds the package in `target/web`. `package/meshwright.js` adds types and objects to the bindings.

mod arrays;
mod colors;
mod describe;
mod kept;
mod session;

#[cfg(target_arch = "wasm32")]
mod bindings;
#[cfg(all(target_arch = "wasm32", threads))]
mod threads;

pub use arrays::Arrays;
pub use colors::{Colors, MeshColors, Per};
pub use session::Session;
