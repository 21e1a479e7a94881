//! RON as a tree that keeps every place, comment and slip.
//!
//! ```text
//! text --Lexer--> tokens --parse--> tree of values with spans --Deserialize--> Rust types
//!   ^                                        |
//!   +---------------- replace <--------------+
//! ```
//!
//! `ron` stops at the first slip, and says little about its place. This tree goes on behind slips, so that all of them
//! are reported. It serves whatever must know where something stands: problems found later, parameters, and
//! programs that rewrite recipes and keep their comments. The tree is a [`serde::Deserializer`], so that a value is read
//! into its type without a second look at the text.

mod attribute;
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
