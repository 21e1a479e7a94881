//! Picked elements, and selections of recipes that mean them.

mod change;
mod picked;
mod propose;

pub use picked::Picked;
pub use propose::{Proposal, propose};
