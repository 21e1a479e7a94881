//! Results of tests as JUnit XML, which servers that build and test software read.
//!
//! One suite `recipes`; a test case for each recipe with its path as name and its folder as class.
//! What is wrong stands in the text of the failure as it is shown on a terminal.

use std::path::Path;

use anyhow::Context as _;
use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};

use super::{State, Test, TestResult};

/// The results as text.
pub(super) fn report(tests: &[Test], results: &[TestResult]) -> anyhow::Result<String> {
    let mut suite = TestSuite::new("recipes");
    suite.add_test_cases(tests.iter().zip(results).map(|(t, r)| case(t, r)));
    let mut report = Report::new("meshwright");
    report.set_time(results.iter().map(|r| r.time).sum());
    report.add_test_suite(suite);
    let text = report.to_string();
    text.context("cannot write the results as JUnit XML")
}

fn case(test: &Test, result: &TestResult) -> TestCase {
    let status = match result.state {
        State::Passed => TestCaseStatus::success(),
        State::Failed => failure(test, result),
        State::NoExpectations => skipped("no expectations"),
        State::Called => skipped("called by others"),
        State::NotRun => skipped("interrupted"),
    };
    let mut case = TestCase::new(test.found.path.display().to_string(), status);
    let folder = test.found.path.parent().unwrap_or(Path::new(""));
    case.set_classname(folder.display().to_string());
    case.set_time(result.time);
    case
}

fn skipped(message: &str) -> TestCaseStatus {
    let mut status = TestCaseStatus::skipped();
    status.set_message(message);
    status
}

fn failure(test: &Test, result: &TestResult) -> TestCaseStatus {
    let first = result.diagnostics.first().map(|d| d.message.as_str());
    let mut status = TestCaseStatus::non_success(NonSuccessKind::Failure);
    status.set_message(first.or(result.message.as_deref()).unwrap_or("failed"));
    let mut text = result.message.clone().unwrap_or_default();
    if let Ok(loaded) = &test.loaded {
        text += &loaded.render(&result.diagnostics, false);
    }
    status.set_description(text);
    status
}
