//! Picked elements, and selections of recipes that describe them.

mod change;
mod picked;
mod propose;

pub use picked::Picked;
pub(crate) use propose::propose_one;
pub use propose::{Proposal, propose};
