//! Pictures and figures from outside.

mod extremes;
mod figures;
mod goldens;
