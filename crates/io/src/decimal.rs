//! Reads and writes decimal numbers as text. Numbers are read with correct rounding. A number is written as the
//! shortest text that gives the same number when it is read.

/// Parses the finite number at the beginning of `text`, correctly rounded. Returns the number and the length of
/// its text in bytes.
#[inline]
pub(crate) fn leading_number(text: &[u8]) -> Option<(f64, usize)> {
    let unsigned = match text {
        [b'+' | b'-', rest @ ..] => rest,
        _ => text,
    };
    // After the sign, a number must start with a digit or a point. Words such as `nan` and `inf` are refused.
    matches!(unsigned, [b'0'..=b'9' | b'.', ..]).then_some(())?;
    let (x, length) = fast_float2::parse_partial::<f64, _>(text).ok()?;
    x.is_finite().then_some((x, length))
}

/// Parses up to eight digits, beginning at index `at`. Returns the integer that these digits represent, and the number
/// of digits.
///
/// Processes all digits at once as the bytes of one 64-bit word (Lemire, "Quickly parsing eight digits", 2018).
#[inline]
pub(crate) fn up_to_eight_digits(text: &[u8], at: usize) -> (u64, usize) {
    let word = eight_bytes(text, at) ^ 0x3030_3030_3030_3030;
    // In `non_digits`, a set high bit marks a byte that is not a digit. The marks are correct up to the first byte that
    // is not a digit. The marks of higher bytes can be wrong, so only the lowest mark is used.
    let non_digits = (word.wrapping_add(0x7676_7676_7676_7676) | word) & 0x8080_8080_8080_8080;
    let count = non_digits.trailing_zeros() / 8;
    if count == 0 {
        return (0, 0);
    }
    // Shifts the digits to the highest bytes of the word. The bytes below them become 0 and act as leading zeros.
    let digits = word << (64 - 8 * count);
    let pairs = digits.wrapping_mul(10).wrapping_add(digits >> 8);
    let low = (pairs & 0x0000_00ff_0000_00ff).wrapping_mul(0x000f_4240_0000_0064);
    let high = ((pairs >> 16) & 0x0000_00ff_0000_00ff).wrapping_mul(0x0000_2710_0000_0001);
    (low.wrapping_add(high) >> 32, count as usize)
}

/// Returns the eight bytes that begin at index `at`, as a 64-bit word. The first byte is the lowest byte of the word.
/// Bytes beyond the end of the text are 0.
#[inline]
fn eight_bytes(text: &[u8], at: usize) -> u64 {
    if let Some(&[a, b, c, d, e, f, g, h]) = text.get(at..at + 8) {
        return u64::from_le_bytes([a, b, c, d, e, f, g, h]);
    }
    let mut bytes = [0; 8];
    for (to, from) in bytes.iter_mut().zip(text.iter().skip(at)) {
        *to = *from;
    }
    u64::from_le_bytes(bytes)
}

/// Appends the shortest decimal number that a reader converts back to exactly `x`. `x` must be finite. Very large and
/// very small numbers get an exponent (`1e300`, `2.5e-9`).
pub(crate) fn push_number(out: &mut Vec<u8>, x: f64) {
    let mut buffer = zmij::Buffer::new();
    let text = buffer.format_finite(x).as_bytes();
    if x.abs() < 1e16 {
        push_short(out, text.strip_suffix(b".0").unwrap_or(text));
    } else {
        out.extend(text.iter().filter(|&&byte| byte != b'+'));
    }
}

/// Appends a text of at most 24 bytes. The text is copied in pieces of constant length, because the compiler inlines
/// copies of constant length.
#[inline]
fn push_short(out: &mut Vec<u8>, text: &[u8]) {
    let (room, start) = if let Some(start) = text.first_chunk::<16>() {
        out.extend_from_slice(start);
        (24, 16)
    } else if let Some(start) = text.first_chunk::<8>() {
        out.extend_from_slice(start);
        (16, 8)
    } else {
        (0, 0)
    };
    match text.last_chunk::<8>() {
        Some(&end) if text.len() <= room => {
            let copied_bits = 8 * (room - text.len());
            let rest = u64::from_le_bytes(end).checked_shr(u32::try_from(copied_bits).unwrap_or(0));
            push_bytes(out, rest.unwrap_or(0), text.len() - start);
        }
        _ => out.extend_from_slice(&text[start..]),
    }
}

/// Appends the lowest `n` bytes of a 64-bit word, beginning with the lowest byte.
#[inline]
fn push_bytes(out: &mut Vec<u8>, word: u64, n: usize) {
    let end = out.len() + n;
    out.extend_from_slice(&word.to_le_bytes());
    out.truncate(end);
}

/// Appends an integer as a decimal number.
#[inline]
pub(crate) fn push_whole(out: &mut Vec<u8>, value: usize) {
    match u64::try_from(value) {
        Ok(value) if value < 100_000_000 => {
            // All eight digits are computed at once, each in its own byte of `digits`. The value is split into two
            // halves, each half into two pairs of digits, and each pair into two digits. The first digit ends up in the
            // lowest byte. Multiplications replace the divisions by 100 and 10.
            let halves = (value / 10_000) | (value % 10_000) << 32;
            let hundreds = ((halves * 10_486) >> 20) & 0x0000_007f_0000_007f;
            let pairs = hundreds | (halves - 100 * hundreds) << 16;
            let tens = ((pairs * 103) >> 10) & 0x000f_000f_000f_000f;
            let digits = tens | (pairs - 10 * tens) << 8;
            let zeros = (digits.trailing_zeros() / 8).min(7);
            let text = (digits | 0x3030_3030_3030_3030) >> (8 * zeros);
            push_bytes(out, text, 8 - zeros as usize);
        }
        _ => out.extend_from_slice(itoa::Buffer::new().format(value).as_bytes()),
    }
}

#[cfg(test)]
mod tests;
