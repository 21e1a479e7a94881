//! Writes test results as JUnit XML, which CI servers read.
//!
//! There is one suite, `recipes`. Each recipe is a test case, with its path as name and its folder as class. The text of
//! a failure is the same as on a terminal.

use std::path::Path;

use super::{State, Test, TestResult};

/// Returns the results as XML.
pub(super) fn report(tests: &[Test], results: &[TestResult]) -> String {
    let cases: String = tests.iter().zip(results).map(|(t, r)| case(t, r)).collect();
    let count = |is: fn(State) -> bool| results.iter().filter(|r| is(r.state)).count();
    let failures = count(|state| state == State::Failed);
    let skipped = count(|state| !matches!(state, State::Passed | State::Failed));
    let time: f64 = results.iter().map(|r| r.time.as_secs_f64()).sum();
    let tests = tests.len();
    format!(
        r#"<?xml version="1.0" encoding="UTF-8"?>
<testsuites name="meshwright" tests="{tests}" failures="{failures}" errors="0" time="{time:.3}">
    <testsuite name="recipes" tests="{tests}" disabled="{skipped}" errors="0" failures="{failures}">
{cases}    </testsuite>
</testsuites>
"#
    )
}

fn case(test: &Test, result: &TestResult) -> String {
    let skipped = |reason: &str| format!(r#"<skipped message="{reason}"/>"#);
    let outcome = match result.state {
        State::Passed => String::new(),
        State::Failed => failure(test, result),
        State::NoExpectations => skipped("no expectations"),
        State::Called => skipped("called by other recipes"),
        State::NotRun => skipped("interrupted"),
    };
    let path = &test.found.path;
    let folder = path.parent().unwrap_or(Path::new(""));
    format!(
        "        <testcase name=\"{}\" classname=\"{}\" time=\"{:.3}\">{outcome}</testcase>\n",
        escaped(&path.display().to_string()),
        escaped(&folder.display().to_string()),
        result.time.as_secs_f64(),
    )
}

fn failure(test: &Test, result: &TestResult) -> String {
    let first = result.diagnostics.first().map(|d| d.message.as_str());
    let message = first.or(result.message.as_deref()).unwrap_or("failed");
    let mut text = result.message.clone().unwrap_or_default();
    if let Ok(loaded) = &test.loaded {
        text += &loaded.render(&result.diagnostics, false);
    }
    let (message, text) = (escaped(message), escaped(&text));
    format!(r#"<failure message="{message}">{text}</failure>"#)
}

/// Escapes a text for an XML attribute or for XML content. Removes characters that XML does not allow.
fn escaped(text: &str) -> String {
    let mut xml = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => xml += "&amp;",
            '<' => xml += "&lt;",
            '>' => xml += "&gt;",
            '"' => xml += "&quot;",
            // In attributes, XML parsers replace these characters by spaces.
            '\t' | '\n' | '\r' => xml += &format!("&#{};", u32::from(c)),
            '\0'..='\x1f' | '\u{fffe}' | '\u{ffff}' => {}
            c => xml.push(c),
        }
    }
    xml
}
