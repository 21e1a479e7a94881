//! The commands of the program. Each command returns whether it succeeded.

pub(crate) mod batch;
pub(crate) mod cache;
pub(crate) mod check;
pub(crate) mod convert;
pub(crate) mod diff;
mod diff_runs;
pub(crate) mod edit;
pub(crate) mod info;
pub(crate) mod man;
pub(crate) mod new;
pub(crate) mod new_op;
pub(crate) mod ops;
pub(crate) mod picture;
mod reference;
pub(crate) mod reproduce;
pub(crate) mod run;
pub(crate) mod select;
pub(crate) mod shrink;
pub(crate) mod sweep;
pub(crate) mod test;
mod test_update;
pub(crate) mod upgrade;
pub(crate) mod watch;
pub(crate) mod web;
