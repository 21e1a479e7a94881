//! Pictures of scenes, without a graphics processor.
//!
//! Everything here is computed on the processor, in parallel, and gives the same bytes on every machine and
//! for any number of threads. The crate knows meshes, curves and scenes, but no operations and no recipes; it
//! reads and writes no files.

#![forbid(unsafe_code)]

mod error;
mod image;

pub use error::PictureError;
pub use image::{Image, LARGEST_SIDE};
