//! Drives the real program in temporary folders.

mod files;
mod folder;
mod interrupt;
mod new_op;
mod ops;
mod refusals;
mod reproduce;
mod run;
mod test;
mod usage;
