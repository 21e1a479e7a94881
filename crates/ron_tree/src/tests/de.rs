//! Compares the deserializer with the deserializer of `ron`: both must give the same values and reject the same
//! source texts.

use std::collections::BTreeMap;

use proptest::prelude::*;
use serde::{Deserialize, Serialize};

use crate::{Lexer, from_str, parse};

/// Every kind of type that a parameter can have.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
#[expect(clippy::option_option, reason = "`ron` reads it, and so must the tree")]
struct Shapes {
    flag: bool,
    small: (i8, u8),
    whole: [i64; 2],
    unsigned: u64,
    single: f32,
    double: f64,
    letter: char,
    text: String,
    #[serde(default)]
    option: Option<Choice>,
    #[serde(default)]
    nested: Option<Option<u32>>,
    list: Vec<Choice>,
    map: BTreeMap<String, f64>,
    numbered: BTreeMap<i32, Option<bool>>,
    unit: (),
    marker: Marker,
    newtype: Newtype,
    pair: Pair,
    clear: Clear,
    #[serde(default, alias = "old")]
    renamed: Inner,
}

#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
enum Choice {
    Unit,
    #[serde(rename = "Wraps")]
    Newtype(Box<Self>),
    Tuple(u16, Inner),
    Struct {
        of: Vec<Self>,
        at: Option<f64>,
    },
    Option(Option<i32>),
    List(Vec<u8>),
    Nothing(()),
    Parts((f64, f64)),
    Inner(Inner),
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
struct Marker;

#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
struct Newtype(String);

#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
struct Pair(u32, Option<char>);

#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(transparent)]
struct Clear {
    only: Vec<[f64; 3]>,
}

#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
struct Inner {
    #[serde(default)]
    a: Option<f32>,
}

fn by_ron<T: serde::de::DeserializeOwned>(text: &str) -> Result<T, String> {
    let options = ron::Options::default()
        .with_default_extension(ron::extensions::Extensions::IMPLICIT_SOME)
        .without_recursion_limit();
    options.from_str(text).map_err(|error| error.to_string())
}

/// Returns a string that depends on every bit of each number. For example, `-0.0` and `0.0` give different strings.
fn bits(value: &impl Serialize) -> String {
    ron::to_string(value).expect("plain data")
}

fn any_double() -> impl Strategy<Value = f64> {
    prop_oneof![
        any::<f64>().prop_filter("NaN is not equal to itself", |x| !x.is_nan()),
        (-1e6..1e6_f64).prop_map(f64::round),
        Just(-0.0),
    ]
}

/// Generates any character except the line feed. `ron` writes a line feed without an escape, but recipes accept only
/// the escape `'\n'`.
fn any_char() -> impl Strategy<Value = char> {
    any::<char>().prop_filter("a line feed", |&c| c != '\n')
}

fn any_inner() -> impl Strategy<Value = Inner> {
    let single = prop::option::of((-1e9..1e9_f32).prop_map(|x| x));
    single.prop_map(|a| Inner { a })
}

fn any_choice() -> impl Strategy<Value = Choice> {
    let leaf = prop_oneof![
        Just(Choice::Unit),
        (any::<u16>(), any_inner()).prop_map(|(n, inner)| Choice::Tuple(n, inner)),
        any::<Option<i32>>().prop_map(Choice::Option),
        any::<Vec<u8>>().prop_map(Choice::List),
        Just(Choice::Nothing(())),
        (any_double(), any_double()).prop_map(Choice::Parts),
        any_inner().prop_map(Choice::Inner),
    ];
    leaf.prop_recursive(3, 12, 3, |inner| {
        let list = prop::collection::vec(inner.clone(), 0..3);
        prop_oneof![
            inner.prop_map(|c| Choice::Newtype(c.into())),
            (list, prop::option::of(any_double())).prop_map(|(of, at)| Choice::Struct { of, at }),
        ]
    })
}

prop_compose! {
    fn any_shapes()(
        (flag, small, whole, unsigned) in any::<(bool, (i8, u8), [i64; 2], u64)>(),
        single in (-1e9..1e9_f32),
        (double, letter, text) in (any_double(), any_char(), any::<String>()),
        option in prop::option::of(any_choice()),
        nested in any::<Option<u32>>().prop_map(|n| n.map(Some)),
        list in prop::collection::vec(any_choice(), 0..3),
        map in prop::collection::btree_map(any::<String>(), any_double(), 0..3),
        numbered in any::<BTreeMap<i32, Option<bool>>>(),
        (newtype, pair) in (any::<String>(), (any::<u32>(), prop::option::of(any_char()))),
        only in prop::collection::vec([any_double(), any_double(), any_double()], 0..3),
        renamed in any_inner(),
    ) -> Shapes {
        Shapes {
            flag, small, whole, unsigned, single, double, letter, text, option, nested, list, map, numbered,
            unit: (),
            marker: Marker,
            newtype: Newtype(newtype),
            pair: Pair(pair.0, pair.1),
            clear: Clear { only },
            renamed,
        }
    }
}

/// A source text that uses every way to write values in a recipe.
const WRITTEN: &str = "Shapes(flag: true, small: (-1, +7), whole: (0x10, -1_000), unsigned: 18446744073709551615, \
    single: 1_0.5, double: 3, letter: 'x', text: r#\"a\"b\"#, option: Wraps(Wraps(Unit)), nested: Some(Some(1)), \
    list: [Tuple(0b1, (a: 2)), Struct(of: [Unit], at: Some(1e-3)), Option(None), Nothing(()), Inner(Inner(a: None))], \
    map: {\"k\": -0.0, \"l\": inf,}, numbered: {1: true, -2: None}, unit: (), marker: Marker, newtype: Newtype(\"n\"), \
    pair: Pair(1, 'c'), clear: [(1, 2, 3)], old: ())";

fn tokens(text: &str) -> Vec<String> {
    let token = |token: crate::Token| token.span.of(text).to_owned();
    Lexer::new(text).map(token).collect()
}

proptest! {
    #[test]
    fn every_value_is_read_as_ron_reads_it(shapes in any_shapes(), pretty in any::<bool>()) {
        let text = if pretty {
            ron::ser::to_string_pretty(&shapes, ron::ser::PrettyConfig::new().struct_names(true)).unwrap()
        } else {
            ron::to_string(&shapes).unwrap()
        };
        let read: Shapes = from_str(&text).unwrap();
        prop_assert_eq!(bits(&read), bits(&by_ron::<Shapes>(&text).unwrap()));
        prop_assert_eq!(bits(&read), bits(&shapes));
    }

    /// If a source text is nearly valid, either both deserializers return the same value, or both reject the text.
    #[test]
    fn texts_that_ron_refuses_are_refused(
        edits in prop::collection::vec((0_usize..4, any::<prop::sample::Index>(), any::<prop::sample::Index>()), 0..3),
    ) {
        let mut spare = tokens(WRITTEN);
        spare.extend(["Some", "None", "-1", "1.5", "inf", "NaN", "256", "x", "()", "(", ")"].map(str::to_owned));
        let mut text = tokens(WRITTEN);
        for (edit, at, other) in edits {
            let (i, token) = (at.index(text.len()), spare[other.index(spare.len())].clone());
            match edit {
                0 => _ = text.remove(i),
                1 => text.insert(i, token),
                2 => text[i] = token,
                _ => {
                    let j = other.index(text.len());
                    text.swap(i, j);
                }
            }
        }
        let text = text.concat();
        let parsed = parse(&text);
        if parsed.diagnostics.is_empty() {
            let read = Shapes::deserialize(&parsed.value);
            // `ron` reads the printed value instead of the text, because `ron` does not accept whitespace in some
            // places.
            match by_ron::<Shapes>(&parsed.value.to_string()) {
                Ok(shapes) => prop_assert_eq!(bits(&read.unwrap()), bits(&shapes)),
                Err(error) => prop_assert!(read.is_err(), "{}\n{}", text, error),
            }
        }
    }

    #[test]
    fn numbers_have_the_bits_that_ron_gives_them(text in "-?[0-9]{1,20}([.][0-9]{0,20})?(e[-+]?[0-9]{1,3})?") {
        prop_assert_eq!(
            from_str::<f64>(&text).ok().map(f64::to_bits),
            by_ron::<f64>(&text).ok().map(f64::to_bits)
        );
        prop_assert_eq!(
            from_str::<f32>(&text).ok().map(f32::to_bits),
            by_ron::<f32>(&text).ok().map(f32::to_bits)
        );
        prop_assert_eq!(from_str::<u8>(&text).ok(), by_ron::<u8>(&text).ok());
        prop_assert_eq!(from_str::<i64>(&text).ok(), by_ron::<i64>(&text).ok());
    }
}

#[derive(Debug, Deserialize)]
#[serde(try_from = "f64")]
struct Positive;

impl TryFrom<f64> for Positive {
    type Error = &'static str;

    fn try_from(value: f64) -> Result<Self, Self::Error> {
        (value > 0.0).then_some(Self).ok_or("expected more than 0")
    }
}

#[test]
fn an_error_of_a_custom_type_has_the_span_of_its_value() {
    for text in [r#"{"a": [1, 2], "b": [3, -1]}"#, r#"{"a": [-1, -2]}"#] {
        let read = from_str::<BTreeMap<String, Vec<Positive>>>(text);
        let error = read.unwrap_err();
        assert_eq!(error.span.unwrap().of(text), "-1");
        assert_eq!(error.message, "expected more than 0");
    }
}

#[test]
fn an_error_has_the_span_of_the_innermost_value() {
    let place = |text: &'static str| {
        let error = from_str::<Choice>(text).unwrap_err();
        (error.span.unwrap().of(text), error.message)
    };
    assert_eq!(
        place("Struct(of: [Unit, List([1, 300])])"),
        (
            "300",
            "expected a whole number in the allowed range, found 300".to_owned()
        )
    );
    assert_eq!(
        place("Struct(of: [], into: 1)"),
        (
            "into",
            "unknown field `into`, expected `of` or `at`".to_owned()
        )
    );
    assert_eq!(place("Wraps(Other(1))").0, "Other");
    assert_eq!(
        place("Struct(at: 1)"),
        ("(at: 1)", "missing field `of`".to_owned())
    );
    assert_eq!(place("Parts((1, 2, 3))").0, "3");
    assert_eq!(place("[1").1, "the text ends before this `[` is closed");
}
