//! Decimal numbers as text: reading them correctly rounded, writing the shortest that reads back the
//! same.

/// The number that `text` begins with, correctly rounded, and how many bytes spell it.
///
/// `None` for what takes longer to read: no digits, more digits than a u64 holds, powers of ten beyond the
/// usual. The standard library knows all of that.
#[inline]
pub(crate) fn leading_number(text: &[u8]) -> Option<(f64, usize)> {
    let negative = text.first() == Some(&b'-');
    let mut at = usize::from(negative || text.first() == Some(&b'+'));
    let start = at;
    let mut mantissa = 0;
    at += digits(&text[at..], &mut mantissa)?;
    let mut n_digits = at - start;
    let mut decimals = 0;
    if text.get(at) == Some(&b'.') {
        decimals = digits(&text[at + 1..], &mut mantissa)?;
        n_digits += decimals;
        at += 1 + decimals;
    }
    if n_digits == 0 {
        return None;
    }
    let mut power = -i32::try_from(decimals).ok()?;
    if let Some(b'e' | b'E') = text.get(at) {
        let (exponent, length) = exponent(&text[at + 1..])?;
        power += exponent;
        at += 1 + length;
    }
    let magnitude = scaled(mantissa, power)?;
    Some((if negative { -magnitude } else { magnitude }, at))
}

/// A whole number of at most three digits with an optional sign, and its length.
fn exponent(text: &[u8]) -> Option<(i32, usize)> {
    let negative = text.first() == Some(&b'-');
    let sign = usize::from(negative || text.first() == Some(&b'+'));
    let mut value = 0;
    let n = digits(&text[sign..], &mut value)?;
    if n == 0 || n > 3 {
        return None;
    }
    let value = i32::try_from(value).ok()?;
    Some((if negative { -value } else { value }, sign + n))
}

/// Appends the digits that `text` begins with to the decimal number `value` and returns how many there
/// are; `None` if the number becomes too large.
#[inline]
fn digits(text: &[u8], value: &mut u64) -> Option<usize> {
    let mut n = 0;
    loop {
        let (some, count) = up_to_eight_digits(text, n);
        if count > 0 {
            let shift = WHOLE_POWERS_OF_TEN[count];
            *value = value.checked_mul(shift)?.checked_add(some)?;
            n += count;
        }
        if count < 8 {
            return Some(n);
        }
    }
}

/// The number that the digits at `at` spell, and how many they are: at most eight are looked at.
///
/// All at once, as bytes of one word (Lemire, "Quickly parsing eight digits", 2018).
#[inline]
pub(crate) fn up_to_eight_digits(text: &[u8], at: usize) -> (u64, usize) {
    let word = eight_bytes(text, at) ^ 0x3030_3030_3030_3030;
    // The high bit of each byte that is no digit, up to the first such.
    let others = (word.wrapping_add(0x7676_7676_7676_7676) | word) & 0x8080_8080_8080_8080;
    let count = others.trailing_zeros() / 8;
    if count == 0 {
        return (0, 0);
    }
    // The digits move to the end of the word, and zeros come before them.
    let digits = word << (64 - 8 * count);
    let pairs = digits.wrapping_mul(10).wrapping_add(digits >> 8);
    let low = (pairs & 0x0000_00ff_0000_00ff).wrapping_mul(0x000f_4240_0000_0064);
    let high = ((pairs >> 16) & 0x0000_00ff_0000_00ff).wrapping_mul(0x0000_2710_0000_0001);
    (low.wrapping_add(high) >> 32, count as usize)
}

/// The bytes from `at` on, the first as the lowest of the word; zeros stand for bytes beyond the end.
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

/// `mantissa` times ten to the `power`, correctly rounded; `None` if that takes longer.
#[inline]
fn scaled(mantissa: u64, power: i32) -> Option<f64> {
    // Both factors exact in an f64: one multiplication or division rounds once (Clinger, "How to read
    // floating point numbers accurately", 1990).
    if power == 0 || mantissa == 0 {
        return Some(mantissa as f64);
    }
    let size = power.unsigned_abs() as usize;
    if mantissa <= 1 << 53
        && let Some(&ten) = POWERS_OF_TEN.get(size)
    {
        let exact = mantissa as f64;
        return Some(if power < 0 { exact / ten } else { exact * ten });
    }
    if power < 0 {
        DIVISORS
            .get(size)
            .map(|divisor| divisor.quotient(mantissa, size))
    } else {
        None
    }
}

/// A power of five that fits a u64, prepared for divisions.
#[derive(Clone, Copy)]
struct Divisor {
    /// Shifted left until its highest bit is set.
    normal: u64,
    /// How far.
    shift: u32,
    /// (2^128 - 1) / `normal` - 2^64.
    reciprocal: u64,
}

/// 5^0 to 5^27.
static DIVISORS: [Divisor; 28] = {
    let mut all = [Divisor {
        normal: 0,
        shift: 0,
        reciprocal: 0,
    }; 28];
    let mut power: u64 = 1;
    let mut i = 0;
    while i < all.len() {
        let shift = power.leading_zeros();
        let normal = power << shift;
        let reciprocal = low(u128::MAX / (normal as u128));
        all[i] = Divisor {
            normal,
            shift,
            reciprocal,
        };
        if i + 1 < all.len() {
            power *= 5;
        }
        i += 1;
    }
    all
};

#[expect(clippy::cast_possible_truncation, reason = "the lower half is wanted")]
const fn low(x: u128) -> u64 {
    x as u64
}

const fn high(x: u128) -> u64 {
    low(x >> 64)
}

impl Divisor {
    /// `mantissa`, not 0, divided by ten to the `power`, correctly rounded.
    ///
    /// `mantissa` / 10^power = (`mantissa` / 5^power) / 2^power: the quotient of whole numbers gives more
    /// bits than an f64 holds, and whether there is a remainder decides what lies half way. The division is
    /// that of Möller and Granlund, "Improved division by invariant integers", 2011, algorithm 4.
    #[inline]
    fn quotient(self, mantissa: u64, power: usize) -> f64 {
        let zeros = mantissa.leading_zeros();
        let dividend = mantissa << zeros;
        // The dividend times 2^63: its upper half is less than the divisor.
        let (u1, u0) = (dividend >> 1, dividend << 63);
        let product = u128::from(self.reciprocal) * u128::from(u1)
            + ((u128::from(u1) << 64) | u128::from(u0));
        let mut quotient = high(product).wrapping_add(1);
        let mut rest = u0.wrapping_sub(quotient.wrapping_mul(self.normal));
        if rest > low(product) {
            quotient = quotient.wrapping_sub(1);
            rest = rest.wrapping_add(self.normal);
        }
        if rest >= self.normal {
            quotient = quotient.wrapping_add(1);
            rest -= self.normal;
        }
        // The quotient has 63 or 64 bits, the f64 53, the remainder decides a tie.
        let top = quotient.leading_zeros();
        let bits = (quotient << top) | u64::from(rest != 0);
        let rounded = (bits >> 11) + u64::from(bits & 0x7ff > 0x400 - (bits >> 11 & 1));
        // mantissa = dividend / 2^zeros, quotient = dividend 2^63 / (5^power 2^shift).
        // quotient = bits / 2^top, and bits = rounded 2^11.
        let exponent = 1023 + 52 + 11 + u64::from(self.shift)
            - 63
            - u64::from(top)
            - u64::from(zeros)
            - power as u64;
        // A carry out of the 53 bits of `rounded` belongs to the exponent.
        f64::from_bits(((exponent - 1) << 52) + rounded)
    }
}

/// The powers of ten that an f64 holds exactly.
const POWERS_OF_TEN: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
    1e17, 1e18, 1e19, 1e20, 1e21, 1e22,
];

const WHOLE_POWERS_OF_TEN: [u64; 9] = [
    1,
    10,
    100,
    1_000,
    10_000,
    100_000,
    1_000_000,
    10_000_000,
    100_000_000,
];

/// Appends the shortest decimal number that reads back as `x`, which is finite: in plain digits where
/// that is short, with an exponent where it is not (`1e300`, `2.5e-9`).
pub(crate) fn push_number(out: &mut Vec<u8>, x: f64) {
    let mut buffer = zmij::Buffer::new();
    let text = buffer.format_finite(x).as_bytes();
    if x.abs() < 1e16 {
        push_short(out, text.strip_suffix(b".0").unwrap_or(text));
    } else {
        out.extend(text.iter().filter(|&&byte| byte != b'+'));
    }
}

/// Appends a text of at most 24 bytes: copies of a known length need no call.
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
            let known = 8 * (room - text.len());
            let rest = u64::from_le_bytes(end).checked_shr(u32::try_from(known).unwrap_or(0));
            push_bytes(out, rest.unwrap_or(0), text.len() - start);
        }
        _ => out.extend_from_slice(&text[start..]),
    }
}

/// Appends the lowest `n` bytes of a word.
#[inline]
fn push_bytes(out: &mut Vec<u8>, word: u64, n: usize) {
    let end = out.len() + n;
    out.extend_from_slice(&word.to_le_bytes());
    out.truncate(end);
}

/// Appends a whole number.
#[inline]
pub(crate) fn push_whole(out: &mut Vec<u8>, value: usize) {
    match u64::try_from(value) {
        Ok(value) if value < 100_000_000 => {
            // All eight digits at once: halves, then quarters, then digits, the first in the lowest
            // byte. The products stand for divisions by 100 and 10.
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
