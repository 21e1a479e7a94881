//! Texts that hold one thing on each line, between empty lines and comments.

use crate::text::Cursor;

/// Stands on the first line that has a word, or at the end.
pub(crate) fn skip_empty_lines(cursor: &mut Cursor) {
    loop {
        cursor.skip_white();
        let mut line = cursor.clone();
        if cursor.is_at_end() || line.argument().is_some() {
            return;
        }
        cursor.skip_line();
    }
}

/// Passes over all lines that are left, and says how many have words and which is the first.
pub(crate) fn count_rest(cursor: &mut Cursor) -> (usize, usize) {
    skip_empty_lines(cursor);
    let first = cursor.place().line;
    let mut lines = 0;
    while !cursor.is_at_end() {
        lines += 1;
        cursor.skip_line();
        skip_empty_lines(cursor);
    }
    (lines, first)
}
