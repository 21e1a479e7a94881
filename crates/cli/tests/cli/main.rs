//! Tests the program in temporary folders.

mod batch;
mod cache;
mod capsule;
mod diff;
mod faults;
mod files;
mod folder;
mod interrupt;
mod memory;
mod new;
mod new_op;
mod ops;
mod outputs;
mod picture;
mod pixels;
mod readme;
mod refusals;
mod reproduce;
mod run;
mod select;
mod sweep;
mod sweep_sheet;
mod test;
mod upgrade;
mod usage;
mod watch;
