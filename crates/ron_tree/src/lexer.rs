//! Splits a recipe into tokens.
//!
//! Every byte of the text belongs to exactly one token. Therefore, concatenating the tokens gives the text again.
//! Invalid characters become tokens of their own kinds, and lexing continues after them. The lexer finds where literals
//! start and end; [`literal`](super::literal) reads their values.

use crate::diagnostic::Span;

/// A token of the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Token {
    /// The kind of the token.
    pub kind: TokenKind,
    /// The span of the token, which is never empty.
    pub span: Span,
}

/// The kinds of tokens.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TokenKind {
    /// Spaces and line ends.
    Whitespace,
    /// `// ..`, without the line feed.
    LineComment,
    /// `/* .. */`. A block comment can contain other block comments.
    BlockComment,
    /// `name` or `r#name`.
    Ident,
    /// Text that starts like a number, up to the next character that cannot be part of a number.
    Number,
    /// `".."`.
    String,
    /// `r".."`, `r#".."#` and so on.
    RawString,
    /// `b".."`, `br".."` or `b'.'`, which are valid in RON but not in recipes.
    Bytes,
    /// `'.'`.
    Char,
    /// `(`, `[` or `{`.
    Open(Bracket),
    /// `)`, `]` or `}`.
    Close(Bracket),
    /// `:`.
    Colon,
    /// `,`.
    Comma,
    /// `#`.
    Hash,
    /// `!`.
    Bang,
    /// `=`.
    Equals,
    /// `;`.
    Semicolon,
    /// Text in single quotes that is not exactly one character.
    BadChar,
    /// A string without a closing quote.
    UnclosedString,
    /// A block comment without `*/`. The token extends to the end of the text.
    UnclosedComment,
    /// Characters that cannot start any other kind of token.
    Unknown,
}

impl TokenKind {
    /// Whether the token is whitespace or a comment.
    pub fn is_trivia(self) -> bool {
        matches!(
            self,
            Self::Whitespace | Self::LineComment | Self::BlockComment
        )
    }
}

/// The three pairs of brackets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bracket {
    /// `( )`.
    Round,
    /// `[ ]`.
    Square,
    /// `{ }`.
    Curly,
}

impl Bracket {
    /// Returns the opening character.
    pub fn open(self) -> char {
        match self {
            Self::Round => '(',
            Self::Square => '[',
            Self::Curly => '{',
        }
    }

    /// Returns the closing character.
    pub fn close(self) -> char {
        match self {
            Self::Round => ')',
            Self::Square => ']',
            Self::Curly => '}',
        }
    }
}

/// The tokens of a source text, in order.
///
/// Lexing takes time linear in the length of the text, and constant memory.
#[derive(Clone, Debug)]
pub struct Lexer<'s> {
    source: &'s str,
    at: usize,
    /// Whether a `"` string must end in the line in which it starts.
    lines_end_strings: bool,
    /// The smallest number of hashes for which a search for the end of a raw string has failed. A later raw string with
    /// at least this number of hashes has no end either, so the lexer does not search for its end. This keeps the time
    /// for lexing linear.
    unclosed_hashes: usize,
}

impl<'s> Lexer<'s> {
    /// Creates a lexer for `source`.
    ///
    /// A string can span several lines. If a closing quote is missing, the rest of the text is misread: strings as
    /// other tokens, and other tokens as strings. Therefore, if a source text has an unclosed string, every string ends
    /// in the line in which it starts, except for raw strings. Only the line with the missing quote is then misread.
    pub fn new(source: &'s str) -> Self {
        let mut lexer = Self {
            source,
            at: 0,
            lines_end_strings: false,
            unclosed_hashes: usize::MAX,
        };
        let unbalanced = lexer.clone().any(|t| t.kind == TokenKind::UnclosedString);
        lexer.lines_end_strings = unbalanced;
        lexer
    }

    fn rest(&self) -> &'s str {
        &self.source[self.at..]
    }

    /// Returns the kind and the length of the token at the start of `rest`, whose first character is `first`.
    fn token(&mut self, rest: &'s str, first: char) -> (TokenKind, usize) {
        use TokenKind as K;
        match first {
            '(' => (K::Open(Bracket::Round), 1),
            '[' => (K::Open(Bracket::Square), 1),
            '{' => (K::Open(Bracket::Curly), 1),
            ')' => (K::Close(Bracket::Round), 1),
            ']' => (K::Close(Bracket::Square), 1),
            '}' => (K::Close(Bracket::Curly), 1),
            ':' => (K::Colon, 1),
            ',' => (K::Comma, 1),
            '#' => (K::Hash, 1),
            '!' => (K::Bang, 1),
            '=' => (K::Equals, 1),
            ';' => (K::Semicolon, 1),
            '"' => self.string(rest, K::String),
            '\'' => quoted(rest),
            '/' if rest.starts_with("//") => {
                (K::LineComment, rest.find('\n').unwrap_or(rest.len()))
            }
            '/' if rest.starts_with("/*") => block_comment(rest),
            'b' if rest.starts_with("b\"") => after(1, self.string(&rest[1..], K::Bytes)),
            'b' if rest.starts_with("b'") => match quoted(&rest[1..]) {
                (K::Char, length) => (K::Bytes, length + 1),
                (kind, length) => (kind, length + 1),
            },
            'b' if rest.starts_with("br\"") || rest.starts_with("br#") => {
                after(2, self.raw_string(&rest[2..], K::Bytes))
            }
            'r' if is_raw_string(&rest[1..]) => after(1, self.raw_string(&rest[1..], K::RawString)),
            'r' if rest.starts_with("r#") => (
                K::Ident,
                2 + length_while(&rest[2..], is_raw_ident_character),
            ),
            // A byte order mark at the start of the text, which some editors write, counts as whitespace.
            '\u{FEFF}' if self.at == 0 => (K::Whitespace, first.len_utf8()),
            _ if is_whitespace(first) => (K::Whitespace, length_while(rest, is_whitespace)),
            _ if starts_ident(first) => (K::Ident, length_while(rest, continues_ident)),
            _ if starts_number(rest) => (K::Number, number_length(rest)),
            _ => (K::Unknown, unknown_length(rest)),
        }
    }

    /// Lexes the string whose opening quote is at the start of `text`.
    fn string(&self, text: &str, kind: TokenKind) -> (TokenKind, usize) {
        let bytes = text.as_bytes();
        let mut at = 1;
        loop {
            match bytes.get(at) {
                None => break,
                Some(b'\n') if self.lines_end_strings => break,
                Some(b'"') => {
                    let length = at + 1;
                    // In `"a.bez, name: "b"`, the closing quote after `a.bez` is missing, so the second quote opens the
                    // next string.
                    let opens_next =
                        self.lines_end_strings && text[length..].starts_with(char::is_alphanumeric);
                    if let (true, Some(end)) = (opens_next, next_field(&text[..at])) {
                        return (TokenKind::UnclosedString, end);
                    }
                    return (kind, length);
                }
                Some(b'\\') => at += 2,
                Some(_) => at += 1,
            }
        }
        let line = &text[..at.min(text.len())];
        if !self.lines_end_strings {
            return (TokenKind::UnclosedString, line.len());
        }
        // The closing quote is missing. The string ends where the quote was probably meant to be: before the next field
        // or before trailing brackets.
        let end = next_field(line).unwrap_or_else(|| {
            line.trim_end_matches([')', ']', '}', ',', ' ', '\t', '\r'])
                .len()
        });
        (TokenKind::UnclosedString, end.max(1))
    }

    /// Lexes a raw string after its prefix. `text` starts with the hashes or the quote that follow the prefix.
    fn raw_string(&mut self, text: &str, kind: TokenKind) -> (TokenKind, usize) {
        let hashes = length_while(text, |c| c == '#');
        let Some(inside) = text[hashes..].strip_prefix('"') else {
            return (TokenKind::Unknown, hashes);
        };
        let start = text.len() - inside.len();
        if hashes < self.unclosed_hashes {
            let end = format!("\"{}", &text[..hashes]);
            if let Some(found) = inside.find(&end) {
                return (kind, start + found + end.len());
            }
            self.unclosed_hashes = hashes;
        }
        (
            TokenKind::UnclosedString,
            text.find('\n').unwrap_or(text.len()),
        )
    }
}

impl Iterator for Lexer<'_> {
    type Item = Token;

    fn next(&mut self) -> Option<Token> {
        let rest = self.rest();
        let first = rest.chars().next()?;
        let (kind, mut length) = self.token(rest, first);
        // `string` skips two bytes for an escape. The second byte can be beyond the end of the text, or be the first
        // byte of a longer character, so the length is corrected here.
        length = length.clamp(first.len_utf8(), rest.len());
        while !rest.is_char_boundary(length) {
            length += 1;
        }
        let span = Span::new(self.at, self.at + length);
        self.at += length;
        Some(Token { kind, span })
    }
}

/// The maximum length of a line in which the lexer guesses where a quote is missing. The limit keeps the time for
/// lexing linear.
const MAX_GUESS_LEN: usize = 4096;

/// Returns the offset of the first `, name:` in `line`, which is the rest of a line with a missing quote.
fn next_field(line: &str) -> Option<usize> {
    if line.len() > MAX_GUESS_LEN {
        return None;
    }
    line.match_indices(',').map(|(i, _)| i).find(|&i| {
        let rest = line[i + 1..].trim_start();
        let name = length_while(rest, continues_ident);
        name > 0 && rest[name..].trim_start().starts_with(':')
    })
}

/// Lexes text that starts with a single quote: a character, or an error.
fn quoted(text: &str) -> (TokenKind, usize) {
    let mut rest = text[1..].char_indices();
    let (first, second) = (rest.next(), rest.next());
    match (first, second) {
        (Some((_, '\\')), Some((i, escaped))) => {
            let from = 1 + i + escaped.len_utf8();
            // The longest escape, `\u{10ffff}`, has ten characters.
            let mut following = text[from..].char_indices().take(10);
            if let Some((end, _)) = following.find(|&(_, c)| c == '\'') {
                return (TokenKind::Char, from + end + 1);
            }
        }
        (Some((_, c)), Some((i, '\''))) if c != '\'' && c != '\n' => {
            return (TokenKind::Char, 1 + i + 1);
        }
        _ => {}
    }
    let close = text
        .char_indices()
        .skip(1)
        .take(MAX_GUESS_LEN)
        .find(|&(_, c)| c == '\'' || c == '\n');
    match close {
        Some((end, '\'')) => (TokenKind::BadChar, end + 1),
        _ => (TokenKind::Unknown, 1),
    }
}

fn block_comment(text: &str) -> (TokenKind, usize) {
    let bytes = text.as_bytes();
    let (mut at, mut depth) = (2, 1_usize);
    while depth > 0 {
        match bytes.get(at..at + 2) {
            Some(b"/*") => {
                depth += 1;
                at += 2;
            }
            Some(b"*/") => {
                depth -= 1;
                at += 2;
            }
            Some(_) => at += 1,
            None => return (TokenKind::UnclosedComment, text.len()),
        }
    }
    (TokenKind::BlockComment, at)
}

/// Returns the length of the number at the start of `text`. The length includes invalid characters that can only be
/// intended as part of the number, such as a unit.
fn number_length(text: &str) -> usize {
    let digits = text.trim_start_matches(['+', '-']);
    let hexadecimal = digits.starts_with("0x");
    let mut previous = ' ';
    let mut first = true;
    length_while(text, |c| {
        let sign_of_exponent = matches!(previous, 'e' | 'E') && !hexadecimal;
        let belongs = match c {
            '+' | '-' => first || sign_of_exponent,
            _ => c == '.' || continues_ident(c),
        };
        first = false;
        previous = c;
        belongs
    })
}

fn starts_number(text: &str) -> bool {
    let unsigned = text.strip_prefix(['+', '-']).unwrap_or(text);
    let signed = unsigned.len() < text.len();
    let digits = unsigned.strip_prefix('.').unwrap_or(unsigned);
    digits.starts_with(|c: char| c.is_ascii_digit())
        || (signed && (unsigned.starts_with("inf") || unsigned.starts_with("NaN")))
}

/// Returns the length of the run of invalid characters at the start of `text`.
fn unknown_length(text: &str) -> usize {
    let known = |i: usize, c: char| {
        is_whitespace(c)
            || starts_ident(c)
            || "()[]{}:,#!=;\"'/".contains(c)
            || (c.is_ascii() && starts_number(&text[i..]))
    };
    let mut characters = text.char_indices().skip(1);
    characters
        .find(|&(i, c)| known(i, c))
        .map_or(text.len(), |(i, _)| i)
}

fn after(prefix: usize, (kind, length): (TokenKind, usize)) -> (TokenKind, usize) {
    (kind, prefix + length)
}

/// Whether an `r` before this text starts a raw string. This is the case if the text starts with `"`, `#"` or `##`.
/// `ron` distinguishes raw strings from names such as `r#name` in the same way.
fn is_raw_string(rest: &str) -> bool {
    rest.starts_with('"') || rest.starts_with("#\"") || rest.starts_with("##")
}

/// Whether `ron` treats the character as whitespace.
fn is_whitespace(c: char) -> bool {
    matches!(
        c,
        ' ' | '\t'
            | '\n'
            | '\r'
            | '\x0B'
            | '\x0C'
            | '\u{85}'
            | '\u{200E}'
            | '\u{200F}'
            | '\u{2028}'
            | '\u{2029}'
    )
}

fn starts_ident(c: char) -> bool {
    c == '_' || c.is_alphabetic()
}

fn continues_ident(c: char) -> bool {
    c == '_' || c.is_alphanumeric()
}

fn is_raw_ident_character(c: char) -> bool {
    matches!(c, '.' | '+' | '-') || continues_ident(c)
}

fn length_while(text: &str, mut belongs: impl FnMut(char) -> bool) -> usize {
    text.find(|c| !belongs(c)).unwrap_or(text.len())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn kinds(source: &str) -> Vec<TokenKind> {
        Lexer::new(source)
            .map(|t| t.kind)
            .filter(|k| !k.is_trivia())
            .collect()
    }

    fn texts(source: &str) -> Vec<&str> {
        let tokens = Lexer::new(source).filter(|t| !t.kind.is_trivia());
        tokens.map(|t| t.span.of(source)).collect()
    }

    #[test]
    fn a_step_is_split_into_tokens() {
        assert_eq!(
            texts("Load(path: \"a\\\"b\", at: -1.5e-3) // end"),
            [
                "Load",
                "(",
                "path",
                ":",
                "\"a\\\"b\"",
                ",",
                "at",
                ":",
                "-1.5e-3",
                ")"
            ]
        );
    }

    #[test]
    fn comments_nest_and_are_trivia() {
        assert_eq!(texts("/* a /* b */ c */ 1 // 2\n3"), ["1", "3"]);
    }

    #[test]
    fn raw_strings_end_at_their_hashes() {
        assert_eq!(
            texts(r##"r#"a"b"# r"c" r#type"##),
            [r##"r#"a"b"#"##, r#"r"c""#, "r#type"]
        );
    }

    #[test]
    fn every_form_of_number_is_one_token() {
        for number in [
            "0", "1_000", "0xFF_e", "0b10", "-5", "+.5", "1.", "1e+9", "-inf", "+NaN",
        ] {
            assert_eq!(kinds(number), [TokenKind::Number], "{number}");
        }
        assert_eq!(texts("0x1e+5"), ["0x1e", "+5"]);
    }

    #[test]
    fn characters_and_bytes_are_distinguished_from_errors() {
        use TokenKind::{BadChar, Bytes, Char, Unknown};

        assert_eq!(
            kinds(r"'a' '\n' '\u{1F600}' b'a' b'\xff'"),
            [Char, Char, Char, Bytes, Bytes]
        );
        assert_eq!(kinds(r##"b"x" br#"y"#"##), [Bytes, Bytes]);
        assert_eq!(kinds("'teapot.bez'"), [BadChar]);
        assert_eq!(kinds("'"), [Unknown]);
    }

    #[test]
    fn invalid_characters_become_one_token_and_lexing_continues() {
        assert_eq!(texts("1 @$% 2"), ["1", "@$%", "2"]);
        assert_eq!(kinds("@ a"), [TokenKind::Unknown, TokenKind::Ident]);
    }

    #[test]
    fn a_missing_quote_affects_only_its_line() {
        let lines = "(path: \"a.bez),\n(path: \"b.bez\")";
        assert_eq!(texts(lines)[3..7], ["\"a.bez", ")", ",", "("]);

        let fields = "(path: \"a.bez, name: \"b\")";
        assert_eq!(
            texts(fields)[3..],
            ["\"a.bez", ",", "name", ":", "\"b\"", ")"]
        );
    }

    #[test]
    fn strings_can_span_lines_if_every_quote_has_a_partner() {
        assert_eq!(texts("\"a\nb\" 1"), ["\"a\nb\"", "1"]);
    }

    #[test]
    fn hostile_texts_take_linear_time() {
        let n = 200_000;
        for part in [
            "\"",
            "'",
            "r#\"\n",
            "/*",
            "\"a, b:\\",
            "@",
            "r##",
            "b'",
            "\\\"",
            "-",
            ".",
        ] {
            let text = part.repeat(n);
            let length: usize = Lexer::new(&text).map(|t| t.span.len()).sum();
            assert_eq!(length, text.len());
        }
    }

    proptest! {
        #[test]
        fn the_concatenated_tokens_are_the_text(text in "(\\PC|[\\n\"'/*#rb()\\\\,:]){0,80}") {
            let mut end = 0;
            for token in Lexer::new(&text) {
                prop_assert_eq!(token.span.start, end);
                prop_assert!(!token.span.is_empty());
                prop_assert!(text.is_char_boundary(token.span.end));
                end = token.span.end;
            }
            prop_assert_eq!(end, text.len());
        }
    }
}
