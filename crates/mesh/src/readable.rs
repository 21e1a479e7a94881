//! Formats numbers and sizes in messages for people.

use std::fmt;

/// Formats a number for people, with six significant digits. Numbers whose magnitude is below 1e-5 or at least 1e15 are
/// in scientific notation. All other numbers keep all digits before the decimal point. A number that is not finite is
/// written as `too large`. Coordinates are always finite, so only an overflow produces such a number.
pub fn readable(x: f64) -> String {
    if !x.is_finite() {
        return "too large".to_owned();
    }
    if x == 0.0 {
        return x.to_string();
    }
    let scientific = format!("{x:.5e}");
    let exponent = scientific.split_once('e').and_then(|(_, e)| e.parse().ok());
    match exponent {
        Some(exponent @ -5..15) => {
            let decimals = usize::try_from(5 - exponent).unwrap_or(0);
            trimmed(&format!("{x:.decimals$}"))
        }
        _ => trimmed(&scientific),
    }
}

/// Removes trailing zeros after the decimal point.
fn trimmed(text: &str) -> String {
    let (digits, exponent) = text.find('e').map_or((text, ""), |e| text.split_at(e));
    let digits = if digits.contains('.') {
        digits.trim_end_matches('0').trim_end_matches('.')
    } else {
        digits
    };
    let digits = if digits == "-0" { "0" } else { digits };
    format!("{digits}{exponent}")
}

/// Formats a number of bytes for people: in bytes below 1 KiB, in KiB below 0.1 MiB, and otherwise in MiB.
pub fn readable_bytes(bytes: u64) -> String {
    let mebi = bytes as f64 / f64::from(1 << 20);
    match bytes {
        1 => "1 byte".to_owned(),
        0..1024 => format!("{bytes} bytes"),
        _ if mebi < 0.1 => format!("{:.1} KiB", bytes as f64 / 1024.0),
        _ if mebi < 10.0 => format!("{mebi:.1} MiB"),
        _ => format!("{mebi:.0} MiB"),
    }
}

/// Returns a number followed by its noun, such as "1 value", "2 values" or "0 vertices". `singular` must end with
/// "vertex", or form its plural with "s".
pub fn counted<N: Copy + fmt::Display + From<u8> + PartialEq>(n: N, singular: &str) -> String {
    if n == N::from(1) {
        return format!("{n} {singular}");
    }
    match singular.strip_suffix("vertex") {
        Some(start) => format!("{n} {start}vertices"),
        None => format!("{n} {singular}s"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nouns_agree_with_their_numbers() {
        assert_eq!(counted(0_u64, "face"), "0 faces");
        assert_eq!(counted(1_usize, "boundary loop"), "1 boundary loop");
        assert_eq!(counted(1_u32, "vertex"), "1 vertex");
        assert_eq!(counted(2_usize, "vertex"), "2 vertices");
    }

    #[test]
    fn bytes_are_formatted_with_a_unit_that_fits() {
        let cases = [
            (0, "0 bytes"),
            (1, "1 byte"),
            (1023, "1023 bytes"),
            (64 << 10, "64.0 KiB"),
            (1 << 20, "1.0 MiB"),
            (503 << 20, "503 MiB"),
        ];
        for (bytes, text) in cases {
            assert_eq!(readable_bytes(bytes), text);
        }
    }
}
