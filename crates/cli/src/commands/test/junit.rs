//! Results of tests as JUnit XML, which servers that build and test software read.
//!
//! There is one suite, `recipes`. Each recipe is a test case with its path as name and its folder as class. The text of a
//! failure is what a terminal shows.

use std::path::Path;

use super::{State, Test, TestResult};

/// The results as text.
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
    let skipped = |why: &str| format!(r#"<skipped message="{why}"/>"#);
    let outcome = match result.state {
        State::Passed => String::new(),
        State::Failed => failure(test, result),
        State::NoExpectations => skipped("no expectations"),
        State::Called => skipped("called by others"),
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

/// The text as XML, in an attribute or between tags. Characters that XML does not allow are left out.
fn escaped(text: &str) -> String {
    let mut xml = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => xml += "&amp;",
            '<' => xml += "&lt;",
            '>' => xml += "&gt;",
            '"' => xml += "&quot;",
            // An attribute would read them as blanks.
            '\t' | '\n' | '\r' => xml += &format!("&#{};", u32::from(c)),
            '\0'..='\x1f' | '\u{fffe}' | '\u{ffff}' => {}
            c => xml.push(c),
        }
    }
    xml
}
