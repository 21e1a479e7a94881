//! Picked elements, and selections of recipes that mean them.

mod picked;
mod propose;

pub use picked::Picked;
pub use propose::{Proposal, propose};
