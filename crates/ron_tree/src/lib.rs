//! A parser for RON that keeps the span of every value and recovers from syntax errors.
//!
//! ```text
//! text --Lexer--> tokens --parse--> tree of values with spans --Deserialize--> Rust types
//!   ^                                        |
//!   +---------------- replace <--------------+
//! ```
//!
//! The `ron` crate stops at the first syntax error and gives little information about its location. This parser
//! continues after an error, so that all errors are reported. Spans have two uses: later checks report them in their
//! errors, and programs use them to rewrite recipes without losing comments. [`Value`] is a [`serde::Deserializer`], so
//! a value is read into a Rust type without parsing the text again.

mod attribute;
mod brackets;
mod de;
mod diagnostic;
mod edit;
mod group;
mod json;
mod lexer;
mod literal;
mod parser;
mod path;
mod recovery;
mod tree;

pub use de::{Error, from_str};
pub use diagnostic::{Diagnostic, LineIndex, Severity, Span};
pub use edit::{EditOverlap, replace};
pub use json::to_json;
pub use lexer::{Bracket, Lexer, Token, TokenKind};
pub use literal::Number;
pub use parser::{MAX_BYTES, MAX_DEPTH, MAX_VALUES, Parsed, parse};
pub use path::field_span;
pub use tree::{Call, Field, Name, Struct, Value, ValueKind, string_literal};

#[cfg(test)]
mod tests;
