//! Writes test results as JUnit XML.

use super::{State, Test, TestResult};
use crate::junit::{Case, CaseEnd, report};

/// Returns the results as XML.
pub(super) fn tests_report(tests: &[Test], results: &[TestResult]) -> String {
    let pairs = tests.iter().zip(results);
    let cases: Vec<Case> = pairs.map(|(test, result)| case(test, result)).collect();
    report("recipes", &cases)
}

fn case<'a>(test: &'a Test, result: &TestResult) -> Case<'a> {
    let end = match result.state {
        State::Passed => CaseEnd::Passed,
        State::Failed => failure(test, result),
        State::NoExpectations => CaseEnd::Skipped("no expectations"),
        State::Called => CaseEnd::Skipped("called by other recipes"),
        State::NotRun => CaseEnd::Skipped("interrupted"),
    };
    let (path, time) = (test.found.path.as_path(), result.time.as_secs_f64());
    Case { path, time, end }
}

fn failure(test: &Test, result: &TestResult) -> CaseEnd {
    let first = result.diagnostics.first().map(|d| d.message.as_str());
    let message = first.or(result.message.as_deref()).unwrap_or("failed");
    let mut text = result.message.clone().unwrap_or_default();
    if let Ok(loaded) = &test.loaded {
        text += &loaded.render(&result.diagnostics, false);
    }
    let message = message.to_owned();
    CaseEnd::Failed { message, text }
}
