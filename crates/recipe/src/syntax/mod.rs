//! The text of a recipe as a tree that keeps every place, comment and slip.
//!
//! ```text
//! text --Lexer--> tokens --parse--> tree of values with spans --substitute--> text without arg(..)
//!   ^                                        |
//!   +---------------- replace <--------------+
//! ```
//!
//! `ron` stops at the first slip, and says little about its place. This tree is read first: it
//! goes on behind slips, so that all of them are reported, and serves whatever must know where
//! something stands: problems found later, parameters, programs that rewrite recipes and keep
//! their comments.

mod attribute;
mod edit;
mod group;
mod json;
mod lexer;
mod literal;
mod parser;
mod path;
mod recovery;
mod substitute;
mod tree;

pub use edit::{EditOverlap, replace};
pub use json::to_json;
pub use lexer::{Bracket, Lexer, Token, TokenKind};
pub use literal::Number;
pub use parser::{MAX_BYTES, MAX_DEPTH, MAX_VALUES, Parsed, parse};
pub use path::{PathItem, field_span};
pub use substitute::{Substituted, substitute};
pub use tree::{Call, Field, Name, Struct, Value, ValueKind, string_literal};

/// The options with which `ron` reads what the tree and the schema let pass.
///
/// `Some(..)` may be left out. The depth is not limited here, because [`parse`] limits it.
pub fn ron_options() -> ron::Options {
    ron::Options::default()
        .with_default_extension(ron::extensions::Extensions::IMPLICIT_SOME)
        .without_recursion_limit()
}

#[cfg(test)]
mod tests;
