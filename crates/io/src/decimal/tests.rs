//! Tests that compare the reading and writing of numbers with the standard library.

use proptest::prelude::*;

use super::*;

fn written(x: f64) -> String {
    let mut out = Vec::new();
    push_number(&mut out, x);
    String::from_utf8(out).unwrap()
}

/// Returns the result of `leading_number` if the number is the whole text.
fn parse_all(text: &str) -> Option<f64> {
    leading_number(text.as_bytes()).and_then(|(x, length)| (length == text.len()).then_some(x))
}

#[test]
fn a_number_ends_after_its_last_digit() {
    for (text, x, length) in [
        ("1.5 2.5", 1.5, 3),
        ("-12345678901234567\n", -12_345_678_901_234_568.0, 18),
        (".25/3", 0.25, 3),
        ("5.x", 5.0, 2),
        ("1e2,", 100.0, 3),
        ("123456789", 123_456_789.0, 9),
        ("99999999999999999999", 1e20, 20),
        ("1e+ 2", 1.0, 1),
    ] {
        assert_eq!(leading_number(text.as_bytes()), Some((x, length)), "{text}");
    }
    for text in [
        "",
        "-",
        ".",
        "+.",
        "e5",
        "nan",
        "-inf",
        "+infinity",
        "1e999",
    ] {
        assert_eq!(leading_number(text.as_bytes()), None, "{text}");
    }
}

#[test]
fn ties_round_to_even() {
    for text in [
        "9007199254740993.0",
        "9007199254740995.0",
        "9007199254740992.50",
        "4503599627370496.5",
        "4503599627370497.5",
        "45035996273704.96875",
        "18446744073709551615e-1",
        "1000000000000000000.1",
        "9007199254740993e-27",
    ] {
        assert_eq!(parse_all(text), text.parse().ok(), "{text}");
    }
}

#[test]
fn the_sign_of_zero_is_written() {
    assert_eq!(written(-0.0), "-0");
    assert_eq!(written(0.0), "0");
}

#[test]
fn large_and_small_numbers_are_written_with_an_exponent() {
    assert_eq!(written(1e300), "1e300");
    assert_eq!(written(2.5e-9), "2.5e-9");
    assert_eq!(written(123_456.75), "123456.75");
}

#[test]
fn integers_are_written_as_their_digits() {
    let large = [99_999_999, 100_000_000, 123_456_789, usize::MAX];
    for value in (0..200_000).chain(large) {
        let mut out = Vec::new();
        push_whole(&mut out, value);
        assert_eq!(out, value.to_string().as_bytes());
    }
}

/// Returns the text that the standard library writes. The text has an exponent if the magnitude is outside the range
/// from 1e-5 to 1e16.
fn expected(x: f64) -> String {
    if x == 0.0 || (1e-5..1e16).contains(&x.abs()) {
        format!("{x}")
    } else {
        format!("{x:e}")
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn numbers_are_parsed_as_by_the_standard_library(
        text in "[-+]?[0-9]{0,19}\\.?[0-9]{0,19}(e[-+]?[0-9]{1,2})?",
    ) {
        if let Some(x) = parse_all(&text) {
            prop_assert_eq!(Some(x.to_bits()), text.parse::<f64>().ok().map(f64::to_bits));
        }
    }

    #[test]
    fn written_numbers_are_parsed_unchanged(x in -1e9..1e9_f64) {
        prop_assert_eq!(parse_all(&written(x)).map(f64::to_bits), Some(x.to_bits()));
    }

    #[test]
    fn numbers_halfway_between_two_floats_are_rounded_correctly(bits: u64, decimals in 1..12_usize) {
        // The text has seven more digits than an `f64` needs, and is close to the midpoint between two `f64` numbers.
        let x = f64::from_bits(((1023 + 20) << 52) | (bits >> 12));
        let next = f64::from_bits(x.to_bits() + 1);
        let middle = format!("{:.1$}", x, decimals + 6);
        let text = format!("{:.1$}", f64::midpoint(x, next), decimals);
        for text in [middle, text] {
            if let Some(x) = parse_all(&text) {
                prop_assert_eq!(Some(x.to_bits()), text.parse::<f64>().ok().map(f64::to_bits));
            }
        }
    }

    #[test]
    fn integers_of_up_to_eight_digits_are_written_as_their_digits(value in 0..100_000_000_usize) {
        let mut out = Vec::new();
        push_whole(&mut out, value);
        prop_assert_eq!(out, value.to_string().into_bytes());
    }

    #[test]
    fn short_texts_are_appended_completely(text in "[0-9]{0,24}") {
        let mut out = b"x".to_vec();
        push_short(&mut out, text.as_bytes());
        prop_assert_eq!(out, format!("x{text}").into_bytes());
    }

    #[test]
    fn numbers_have_the_form_of_the_standard_library(bits: u64, small in -1e-4..1e-4_f64, size in -8..20_i32) {
        let round = format!("1e{size}").parse::<f64>().unwrap();
        for x in [f64::from_bits(bits), small, round, small * round] {
            prop_assume!(x.is_finite());
            // Two texts can be equally short and equally close to the number. In this case, both are valid.
            let (text, theirs) = (written(x), expected(x));
            prop_assert_eq!(text.len(), theirs.len(), "{} {}", text, theirs);
            prop_assert_eq!(text.find(['.', 'e']), theirs.find(['.', 'e']));
            prop_assert_eq!(text.parse::<f64>().unwrap().to_bits(), x.to_bits());
        }
    }
}
