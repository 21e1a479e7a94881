use std::collections::BTreeSet;

use op::ElementKind;
use ron_tree::parse;

use super::*;
use crate::{FieldKind, FieldValue, Panel};

/// Removes spaces and line ends outside of strings.
fn plain(text: &str) -> String {
    parse(text).value.to_string()
}

#[test]
fn each_paragraph_and_item_of_a_description_is_one_line() {
    let registry = ops_all::registry();
    let panel = Panel::new(registry.get("CollapseEdges").unwrap());
    let lines: Vec<&str> = panel.doc.lines().collect();
    let starts = |line: &&&str| line.starts_with("- `");
    assert!(lines.iter().filter(starts).count() >= 5, "{}", panel.doc);
    let ends_well = |line: &str| line.is_empty() || line.ends_with(['.', ':', ';', ',']);
    assert!(lines.iter().all(|line| ends_well(line)), "{}", panel.doc);
    assert!(lines.contains(&""));
}

#[test]
fn every_example_is_written_by_the_panel_of_its_operation() {
    let registry = ops_all::registry();
    for entry in registry.entries() {
        let parsed = parse(entry.example);
        assert!(parsed.diagnostics.is_empty(), "{}", entry.example);
        let mut panel = Panel::new(entry);
        assert!(
            !panel.doc.is_empty() && !panel.summary.is_empty(),
            "{}",
            entry.name
        );
        for field in parsed.value.fields() {
            panel.set(&field.name.text, Some(field.value.span.of(entry.example)));
        }
        assert_eq!(panel.problems(), [], "{}", entry.example);
        assert_eq!(plain(&panel.step_text()), plain(entry.example));
        let again = Panel::of_step(&registry, &parsed.value, entry.example).unwrap();
        assert_eq!(again.step_text(), panel.step_text());
        // A widget's value that is written as text and read again does not change.
        for field in &panel.fields {
            assert!(
                !field.doc.is_empty() && !field.type_name.is_empty(),
                "{} {}",
                entry.name,
                field.name
            );
            let Some(typed) = field.typed() else { continue };
            let written = typed.to_ron();
            assert_eq!(
                FieldValue::read(&field.kind, &written),
                Some(typed),
                "{} {}",
                entry.name,
                field.name
            );
        }
    }
}

#[test]
fn every_example_is_written_field_by_field_into_the_text() {
    let registry = ops_all::registry();
    for entry in registry.entries() {
        let example = parse(entry.example).value;
        let mut text = format!("(recipe: 1, steps: [\n    {}(),\n])", entry.name);
        for field in example.fields() {
            let outline = crate::Outline::of(&text);
            let path = [field.name.text.to_string()];
            let value = field.value.span.of(entry.example);
            let edits =
                crate::text::set_field(&text, outline.run_of(0).unwrap(), &path, Some(value))
                    .unwrap();
            text = crate::text::apply(&text, edits).unwrap();
        }
        let outline = crate::Outline::of(&text);
        assert_eq!(outline.run_of(0).unwrap().to_string(), plain(entry.example));
    }
}

#[test]
fn every_required_parameter_without_a_value_is_a_problem() {
    let registry = ops_all::registry();
    for entry in registry.entries() {
        let panel = Panel::new(entry);
        let missing = panel.fields.iter().any(crate::PanelField::is_missing);
        assert_eq!(missing, !panel.problems().is_empty(), "{}", entry.name);
    }
}

#[test]
fn the_kinds_of_fields_come_from_the_schema() {
    let registry = ops_all::registry();
    let kind = |operation: &str, field: &str| {
        let panel = Panel::new(registry.get(operation).unwrap());
        panel.field(field).unwrap().kind.clone()
    };
    assert_eq!(
        kind("FlipEdges", "edges"),
        FieldKind::Selection(Some(ElementKind::Edges))
    );
    let FieldKind::Choice(choices) = kind("FlipEdges", "on_refusal") else {
        panic!()
    };
    assert_eq!(
        choices.iter().map(|c| c.0.as_str()).collect::<Vec<_>>(),
        ["Error", "Skip"]
    );
    let FieldKind::Number(limits) = kind("SplitEdges", "at") else {
        panic!()
    };
    assert!(
        limits.allows(0.5)
            && !limits.allows(0.0)
            && !limits.allows(1.0)
            && !limits.allows(f64::NAN)
    );
    let FieldKind::Integer(limits) = kind("Tessellate", "segments") else {
        panic!()
    };
    assert_eq!((limits.min, limits.max), (Some(1.0), Some(4096.0)));
    assert_eq!(kind("Bisect", "normal"), FieldKind::Vector(3));
    assert_eq!(kind("Save", "path"), FieldKind::Text);
    assert_eq!(kind("Cube", "triangles"), FieldKind::Bool);
    assert_eq!(
        kind("Picture", "highlight"),
        FieldKind::Optional(Box::new(FieldKind::Selection(None)))
    );
    let all: BTreeSet<String> = registry
        .entries()
        .iter()
        .flat_map(|entry| Panel::new(entry).fields)
        .filter(|field| *field.kind.inner() == FieldKind::Other)
        .map(|field| field.type_name)
        .collect();
    assert!(all.len() < 20, "{all:?}");
}

#[test]
fn a_tuple_of_whole_numbers_is_read_and_written() {
    let registry = ops_all::registry();
    let field = |operation: &str| {
        let panel = Panel::new(registry.get(operation).unwrap());
        panel.field("size").unwrap().clone()
    };
    let size = field("Picture");
    let FieldKind::Integers(2, limits) = size.kind else {
        panic!("{:?}", size.kind)
    };
    assert_eq!((limits.min, limits.max), (Some(1.0), Some(16384.0)));
    assert_eq!(size.typed(), Some(FieldValue::Integers(vec![1280, 960])));
    let read = |text: &str| FieldValue::read(&size.kind, text);
    let value = read("(1600, 900)").unwrap();
    assert_eq!(value, FieldValue::Integers(vec![1600, 900]));
    assert_eq!(value.to_ron(), "(1600, 900)");
    for other in [
        "(1600, 900.5)",
        "(1600, arg(\"height\"))",
        "(1600, 900, 1)",
        "1600",
    ] {
        assert_eq!(read(other), None, "{other}");
    }
    let kind = field("Lattice").kind;
    assert!(matches!(kind, FieldKind::Integers(3, _)), "{kind:?}");
    assert_eq!(kind.first(), FieldValue::Integers(vec![9; 3]));
}

/// Returns the value `whole` after one of its parts was replaced by `new`. `path` contains the names that lead to this
/// part, from the outside to the inside.
fn with_part(kind: &FieldKind, whole: &str, path: &[&str], new: Option<&str>) -> String {
    let (name, rest) = path.split_first().unwrap();
    let (_, parts) = kind.parts(whole);
    let part = parts.iter().find(|part| part.field.name == *name);
    let part = part.unwrap_or_else(|| panic!("{whole} has no {name}"));
    let inner = part.field.current().unwrap_or_default();
    let new = match (rest, new) {
        ([], new) => new.map(str::to_owned),
        (rest, new) => Some(with_part(&part.field.kind, inner, rest, new)),
    };
    part.in_whole(whole, new.as_deref()).unwrap()
}

#[test]
#[expect(clippy::too_many_lines, reason = "a list")]
fn the_parts_of_variants_and_structs_are_fields_of_their_own() {
    let registry = ops_all::registry();
    for (operation, field, whole, path, new, expected) in [
        (
            "ExtrudeFaces",
            "by",
            "Distance(0.2)",
            &["Distance"][..],
            Some("0.3"),
            "Distance(0.3)",
        ),
        (
            "MoveVertices",
            "by",
            "Offset((0, 0, 1))",
            &["Offset"],
            Some("(1, 2, 3)"),
            "Offset((1, 2, 3))",
        ),
        (
            "Smooth",
            "by",
            "Taubin(factor: 0.3)",
            &["pass_band"],
            Some("0.1"),
            "Taubin(factor: 0.3, pass_band: 0.1)",
        ),
        (
            "Smooth",
            "by",
            "Taubin(factor: 0.3)",
            &["factor"],
            None,
            "Taubin()",
        ),
        (
            "Smooth",
            "by",
            "Laplacian",
            &["factor"],
            Some("0.1"),
            "Laplacian(factor: 0.1)",
        ),
        (
            "LoopSubdivide",
            "until",
            "EdgeLength(below: 1)",
            &["below"],
            Some("2"),
            "EdgeLength(below: 2)",
        ),
        (
            "LoopSubdivide",
            "until",
            "Some(EdgeLength(below: 1))",
            &["below"],
            Some("2"),
            "Some(EdgeLength(below: 2))",
        ),
        (
            "Transform",
            "about",
            "Point(0, 1, 0)",
            &["Point"],
            Some("(1, 2, 3)"),
            "Point(1, 2, 3)",
        ),
        (
            "Measure",
            "of",
            "PrincipalCurvature(Largest)",
            &["PrincipalCurvature"],
            Some("Smallest"),
            "PrincipalCurvature(Smallest)",
        ),
        (
            "Picture",
            "style",
            "(sharp: 30)",
            &["sharp"],
            Some("40"),
            "(sharp: 40)",
        ),
        (
            "Picture",
            "style",
            "(wireframe: (width: 1))",
            &["wireframe", "width"],
            Some("2"),
            "(wireframe: (width: 2))",
        ),
        (
            "Picture",
            "camera",
            "LookAt(from: (0, 0, 1), to: (0, 0, 0))",
            &["from"],
            Some("(1, 0, 0)"),
            "LookAt(from: (1, 0, 0), to: (0, 0, 0))",
        ),
    ] {
        let panel = Panel::new(registry.get(operation).unwrap());
        let kind = &panel.field(field).unwrap().kind;
        assert_eq!(with_part(kind, whole, path, new), expected, "{operation}");
    }
}

#[test]
fn every_variant_of_a_parameter_has_a_first_value_of_the_right_shape() {
    let registry = ops_all::registry();
    let mut n = 0;
    for entry in registry.entries() {
        let panel = Panel::new(entry);
        for field in &panel.fields {
            let FieldKind::Variants(variants) = field.kind.inner() else {
                continue;
            };
            for variant in variants {
                n += 1;
                let mut panel = panel.clone();
                let first = variant.first();
                panel.set(&field.name, Some(&first));
                let problems = panel.problems();
                let wrong = problems.iter().find(|(name, _)| *name == field.name);
                assert_eq!(wrong, None, "{} {first}", entry.name);
                let (name, parts) = field.kind.parts(&first);
                assert_eq!(name.as_ref(), Some(&variant.name));
                assert!(parts.iter().all(|part| !part.field.is_missing()), "{first}");
            }
        }
    }
    assert!(n > 30, "{n}");
}

#[test]
fn an_argument_of_the_recipe_is_shown_and_is_no_problem() {
    let text =
        "(recipe: 1, params: {\"n\": Int(default: 1)}, steps: [LoopSubdivide(levels: arg(\"n\"))])";
    let (editor, _) = opened(text);
    let panel = editor.panel(0).unwrap();
    assert_eq!(
        panel.field("levels").unwrap().argument.as_deref(),
        Some("n")
    );
    assert_eq!(panel.problems(), []);
    assert_eq!(editor.outline().parameters[0].name, "n");
}
