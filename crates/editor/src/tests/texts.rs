use crate::Outline;
use crate::text::{self, TextError};

const TEXT: &str = "(
    recipe: 1,
    steps: [
        // the first
        Cube(name: \"a\"), // one
        (id: \"poke\", run: PokeFaces()),

        // the last
        Smooth(
            by: Taubin(),
        )
    ],
)
";

fn edited(source: &str, edit: impl FnOnce(&Outline) -> Result<text::Edits, TextError>) -> String {
    let outline = Outline::of(source);
    let new = text::apply(source, edit(&outline).unwrap()).unwrap();
    let parsed = ron_tree::parse(&new);
    assert!(
        parsed.diagnostics.is_empty(),
        "{new}\n{:?}",
        parsed.diagnostics
    );
    new
}

fn names(text: &str) -> Vec<String> {
    Outline::of(text)
        .steps
        .into_iter()
        .map(|step| step.name)
        .collect()
}

fn inserted(source: &str, at: usize) -> String {
    edited(source, |outline| {
        text::insert_steps(source, outline, at, &["Weld()".to_owned()])
    })
}

#[test]
fn a_step_is_inserted_in_the_layout_around_it() {
    let new = inserted(TEXT, 1);
    assert!(
        new.contains("Cube(name: \"a\"), // one\n        Weld(),\n        (id: \"poke\""),
        "{new}"
    );
    let new = inserted(TEXT, 0);
    assert!(
        new.contains("steps: [\n        Weld(),\n        // the first\n        Cube("),
        "{new}"
    );
    let new = inserted(TEXT, 3);
    assert!(
        new.contains("            by: Taubin(),\n        ),\n        Weld()\n    ],"),
        "{new}"
    );
    for (source, expected) in [
        (
            "(recipe: 1, steps: [A(), B()])",
            "(recipe: 1, steps: [A(), Weld(), B()])",
        ),
        (
            "(recipe: 1, steps: [A()])",
            "(recipe: 1, steps: [A(), Weld()])",
        ),
        (
            "(recipe: 1, steps: [A(), /* b */ B()])",
            "(recipe: 1, steps: [A(), Weld(), /* b */ B()])",
        ),
        (
            "(recipe: 1, steps: [])",
            "(recipe: 1, steps: [\n    Weld(),\n])",
        ),
        (
            "(\n  recipe: 1,\n  steps: [\n  ],\n)",
            "(\n  recipe: 1,\n  steps: [\n      Weld(),\n  ],\n)",
        ),
    ] {
        assert_eq!(inserted(source, 1), expected);
    }
    let comment = "(\n    recipe: 1,\n    steps: [\n        // nothing yet\n    ],\n)";
    assert_eq!(
        inserted(comment, 0),
        comment.replace("yet\n", "yet\n        Weld(),\n")
    );
}

#[test]
fn a_step_is_removed_with_its_line() {
    let new = edited(TEXT, |outline| text::remove_step(TEXT, outline, 0));
    assert!(
        new.contains("        // the first\n        (id: \"poke\""),
        "{new}"
    );
    let new = edited(TEXT, |outline| text::remove_step(TEXT, outline, 2));
    assert!(new.contains("        // the last\n    ],"), "{new}");
    let line = "(recipe: 1, steps: [A(), B(), C()])";
    for (at, expected) in [(0, "[B(), C()]"), (1, "[A(), C()]"), (2, "[A(), B()]")] {
        let new = edited(line, |outline| text::remove_step(line, outline, at));
        assert!(new.contains(expected), "{new}");
    }
    let one = "(recipe: 1, steps: [A(),])";
    assert_eq!(
        edited(one, |outline| text::remove_step(one, outline, 0)),
        "(recipe: 1, steps: [])"
    );
}

#[test]
fn steps_move_with_their_comments() {
    let orders = [
        (0, 2, ["PokeFaces", "Smooth", "Cube"]),
        (0, 1, ["PokeFaces", "Cube", "Smooth"]),
        (2, 0, ["Smooth", "Cube", "PokeFaces"]),
        (2, 1, ["Cube", "Smooth", "PokeFaces"]),
        (1, 0, ["PokeFaces", "Cube", "Smooth"]),
        (1, 2, ["Cube", "Smooth", "PokeFaces"]),
    ];
    let line = "(recipe: 1, steps: [Cube(name: \"a\"), PokeFaces(), Smooth(by: Taubin())])";
    for (from, to, expected) in orders {
        let new = edited(TEXT, |outline| text::move_step(TEXT, outline, from, to));
        assert_eq!(names(&new), expected, "{new}");
        assert!(
            new.contains("        // the first\n        Cube(name: \"a\"), // one\n"),
            "{new}"
        );
        assert!(
            new.contains("        // the last\n        Smooth(\n"),
            "{new}"
        );
        let new = edited(line, |outline| text::move_step(line, outline, from, to));
        assert_eq!(names(&new), expected, "{new}");
    }
}

#[test]
fn a_copy_gets_a_new_id() {
    let new = edited(TEXT, |outline| text::duplicate_step(TEXT, outline, 1));
    assert!(
        new.contains(
            "(id: \"poke\", run: PokeFaces()),\n        (id: \"poke-2\", run: PokeFaces()),"
        ),
        "{new}"
    );
    let again = edited(&new, |outline| text::duplicate_step(&new, outline, 2));
    assert!(again.contains("\"poke-3\""), "{again}");
}

#[test]
fn fields_are_set_added_and_removed() {
    let source = "(recipe: 1, steps: [Picture(path: \"a.png\" /* here */), Reverse, A(n: Some(B(x: 1)), l: [C(1, 2)])])";
    let set = |step: usize, path: &[&str], new: Option<&str>| {
        let path: Vec<String> = path.iter().map(ToString::to_string).collect();
        let new = edited(source, |outline| {
            text::set_field(source, outline.run_of(step).unwrap(), &path, new)
        });
        Outline::of(&new).steps[step].span.of(&new).to_owned()
    };
    assert_eq!(
        set(0, &["path"], Some("\"b\"")),
        "Picture(path: \"b\" /* here */)"
    );
    assert_eq!(
        set(0, &["style", "wireframe"], Some("()")),
        "Picture(path: \"a.png\", style: (wireframe: ()) /* here */)"
    );
    assert_eq!(set(1, &["on"], Some("1")), "Reverse(on: 1)");
    assert_eq!(
        set(2, &["n", "B", "x"], Some("7")),
        "A(n: Some(B(x: 7)), l: [C(1, 2)])"
    );
    assert_eq!(set(2, &["n", "x"], None), "A(n: Some(B()), l: [C(1, 2)])");
    assert_eq!(set(2, &["n"], None), "A(l: [C(1, 2)])");
    assert_eq!(
        set(2, &["l", "0", "C", "1"], Some("9")),
        "A(n: Some(B(x: 1)), l: [C(1, 9)])"
    );
    let outline = Outline::of(source);
    let path = ["l".to_owned(), "5".to_owned()];
    let missing = text::set_field(source, outline.run_of(2).unwrap(), &path, Some("1"));
    assert_eq!(missing, Err(TextError::NoPlace("l.5".to_owned())));
}

#[test]
fn a_step_gains_and_loses_fields_around_it() {
    let set = |at: usize, field: &str, new: Option<&str>| {
        edited(TEXT, |outline| {
            text::set_envelope_field(TEXT, outline, at, field, new)
        })
    };
    assert!(set(0, "id", Some("\"c\"")).contains("(id: \"c\", run: Cube(name: \"a\")), // one"));
    assert!(
        set(1, "on", Some("[\"a\"]")).contains("(id: \"poke\", run: PokeFaces(), on: [\"a\"]),")
    );
    assert!(set(1, "id", None).contains("        (run: PokeFaces()),"));
}

#[test]
fn expectations_are_added() {
    let add = |source: &str| {
        edited(source, |outline| {
            text::add_expectations(source, outline, &["Manifold".into(), "Faces(eq: 6)".into()])
        })
    };
    let new = add(TEXT);
    assert!(
        new.ends_with(
            "    ],\n    expect: [\n        Manifold,\n        Faces(eq: 6),\n    ],\n)\n"
        ),
        "{new}"
    );
    assert_eq!(Outline::of(&new).expectations.len(), 2);
    let again = add(&new);
    assert_eq!(Outline::of(&again).expectations.len(), 4);
}

#[test]
fn a_text_with_errors_is_not_edited_blindly() {
    let outline = Outline::of("(recipe: 1");
    assert_eq!(
        text::insert_steps("(recipe: 1", &outline, 0, &["A()".into()]),
        Err(TextError::NoSteps)
    );
    let empty = Outline::of("");
    assert!(text::add_expectations("", &empty, &["A".into()]).is_err());
    assert_eq!(
        text::remove_step(TEXT, &Outline::of(TEXT), 9),
        Err(TextError::NoStep(9, 3))
    );
}
