//! Formats numbers in messages for people.

/// Formats a number for people, with six significant digits. Numbers whose magnitude is below 1e-5 or at least 1e15 are
/// in scientific notation. All other numbers keep all digits before the decimal point.
pub fn readable(x: f64) -> String {
    if x == 0.0 || !x.is_finite() {
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
