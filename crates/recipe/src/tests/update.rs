//! Tests that `update` replaces only recorded values.

use proptest::prelude::*;

use super::{read, run, steps};
use crate::update::{Update, update};

fn updated(text: &str) -> Update {
    let reading = read(text);
    let outcome = run(&reading);
    update(&reading.recipe, &outcome)
}

/// Returns a recipe that lifts a sheet of two squares by 1, with these expectations.
fn sheet(expect: &str) -> String {
    let recipe = steps("Sheet(columns: 2), (id: \"lift\", run: Lift(by: 1))");
    let recipe = recipe.strip_suffix(')').unwrap();
    format!("{recipe}, expect: [{expect}])")
}

fn updated_expectations(expect: &str) -> String {
    let update = updated(&sheet(expect));
    assert!(update.left.is_empty(), "{:#?}", update.left);
    let text = update.text.strip_prefix(&sheet("")[..sheet("").len() - 2]);
    text.unwrap().strip_suffix("])").unwrap().to_owned()
}

#[test]
fn every_kind_of_recorded_value_is_updated() {
    for (was, is) in [
        ("Faces(eq: 12)", "Faces(eq: 2)"),
        (
            "Vertices( eq: /* six */ 7, min: 1 )",
            "Vertices( eq: /* six */ 6, min: 1 )",
        ),
        ("Faces(eq: Some(1_200))", "Faces(eq: Some(2))"),
        ("EulerCharacteristic(eq: -1)", "EulerCharacteristic(eq: 1)"),
        (
            "Count(of: Edges(Boundary), eq: 3)",
            "Count(of: Edges(Boundary), eq: 6)",
        ),
        (
            "SymmetricUnder(group: AxisMirrors, eq: 8)",
            "SymmetricUnder(group: AxisMirrors, eq: 4)",
        ),
        (
            "(after: \"lift\", that: [Edges(eq: 1)])",
            "(after: \"lift\", that: [Edges(eq: 7)])",
        ),
    ] {
        assert_eq!(updated_expectations(was), is);
    }
}

#[test]
fn correct_coordinates_stay_as_written() {
    // The sheet reaches from -1 to 1 and from -0.5 to 0.5.
    let text = updated_expectations(
        "Bounds(min: (-1, -0.50, 3), max: (1.0, 0.5, 1.0)), \
         Position(of: Vertices([0]), is: (-1, -0.50, 0.25))",
    );
    assert_eq!(
        text,
        "Bounds(min: (-1, -0.50, 1), max: (1.0, 0.5, 1.0)), \
         Position(of: Vertices([0]), is: (-1, -0.50, 1.0))"
    );
}

#[test]
fn the_digest_is_updated() {
    let outcome = run(&read(&sheet("")));
    assert_eq!(
        updated_expectations("Digest(\"0\")"),
        format!("Digest(\"{}\")", outcome.digest)
    );
}

#[test]
fn requirements_are_not_updated() {
    for expect in [
        "Faces(min: 3)",
        "Faces(max: 1)",
        "Faces(eq: 3, min: 3)",
        "Not(Faces(eq: 2))",
        "Closed",
        "SymmetricUnder(group: AxisMirrors)",
        "(after: \"lift\", that: Closed)",
        "HasAttribute(domain: Vertex, name: \"uv\")",
    ] {
        let text = sheet(expect);
        let update = updated(&text);
        assert_eq!((&update.text, update.changes.len()), (&text, 0), "{expect}");
        let help = update.left[0].help.as_deref().unwrap_or_default();
        assert!(help.contains("only recorded values"), "{expect}: {help}");
    }
}

#[test]
fn all_repetitions_must_give_the_same_value() {
    let text = |expect: &str| {
        format!(
            "(recipe: 1, steps: [Sheet(columns: 2), Repeat(times: 3, steps: [(id: \"l\", run: Lift(by: 1))])],\n \
             expect: [(after: \"l\", that: {expect})])"
        )
    };
    let same = updated(&text("Faces(eq: 5)"));
    assert_eq!(same.text, text("Faces(eq: 2)"));
    assert_eq!((same.changes.len(), same.left.len()), (1, 0));
    let moving = text("Position(of: Vertices([0]), is: (-1, -0.5, 1))");
    let update = updated(&moving);
    assert_eq!(update.text, moving);
    let help = update.left[0].help.as_deref().unwrap_or_default();
    assert!(
        help.contains("the repetitions of the step give different values"),
        "{help}"
    );
}

#[test]
fn a_value_from_a_parameter_is_not_updated() {
    let text = sheet("Faces(eq: arg(\"n\"))").replace(
        "recipe: 1,",
        "recipe: 1, params: { \"n\": Int(default: 3) },",
    );
    let update = updated(&text);
    assert_eq!(update.text, text);
    assert_eq!(
        update.left[0].help.as_deref(),
        Some(
            "the expected value arg(\"n\") comes from a parameter, so the expectation is not updated"
        )
    );
}

#[test]
fn changes_have_their_lines_and_the_rest_of_the_text_stays() {
    let text = "\u{feff}(\r\n  recipe: 1, // Zeilen: äöü\r\n  steps: [Sheet(columns: 2)],\r\n  expect: [\r\n    Faces(eq: 5), // was 5\r\n    Edges(min: 99),\r\n  ],\r\n)\r\n";
    let text = text.trim_start_matches('\u{feff}');
    let update = updated(text);
    assert_eq!(update.text, text.replace("eq: 5", "eq: 2"));
    let change = &update.changes[0];
    assert_eq!(
        (change.line, change.was.as_str(), change.found.as_str()),
        (5, "Faces(eq: 5)", "2")
    );
    assert_eq!(update.left.len(), 1);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    /// The recorded numbers in a recipe are changed at random. The update of the recipe restores the original text.
    #[test]
    fn changed_numbers_are_restored(
        columns in 1_u32..40,
        by in -8_i32..8,
        chosen in prop::collection::vec((0_usize..7, any::<bool>(), 1_i64..50), 1..12),
    ) {
        let by = f64::from(by) / 4.0 + 0.125;
        let head = format!(
            "(recipe: 1, steps: [Sheet(columns: {columns}),\n (id: \"l\", run: Lift(by: {by:?}))], expect: ["
        );
        let outcome = run(&read(&format!("{head}])")));
        let mesh = outcome.scene.unwrap().objects()[0].as_mesh().unwrap().clone();
        let [min, max] = geometry::bounds(&mesh).unwrap();
        let vector = |p: mesh::DVec3, d: f64| format!("({:?}, {:?}, {:?})", p.x, p.y, p.z + d);
        let line = |which: usize, off: i64| {
            #[expect(clippy::cast_precision_loss, reason = "small numbers")]
            let (f, int) = (off as f64, |n: usize| i64::try_from(n).unwrap() + off);
            match which {
                0 => format!("Faces(eq: {})", int(mesh.n_faces())),
                1 => format!("Vertices( eq: {} ) /* here */", int(mesh.n_vertices())),
                2 => format!("(after: \"l\", that: Edges(eq: {}))", int(mesh.n_edges())),
                3 => format!("Area(eq: {:?}, tolerance: 0.0)", geometry::area(&mesh) + f),
                4 => format!("Bounds(min: {}, max: {})", vector(min, f), vector(max, 0.0)),
                5 => format!("Position(of: Vertices([0]), is: {})", vector(mesh.positions()[0], f)),
                _ if off == 0 => format!("Digest(\"{}\")", outcome.digest),
                _ => format!("Digest(\"{off}\")"),
            }
        };
        let text = |broken: bool| {
            let lines: Vec<String> = chosen
                .iter()
                .map(|&(which, breaks, off)| line(which, if broken && breaks { off } else { 0 }))
                .collect();
            format!("{head}\n  {},\n])", lines.join(",\n  "))
        };
        let (whole, broken) = (text(false), text(true));
        let first = updated(&broken);
        prop_assert_eq!(&first.text, &whole);
        prop_assert!(first.left.is_empty());
        let second = updated(&first.text);
        prop_assert_eq!(&second.text, &whole);
        prop_assert!(second.changes.is_empty() && second.left.is_empty());
    }
}
