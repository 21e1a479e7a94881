//! Writes results as JUnit XML, a format that CI servers read. The report has one test suite, with a test case for each
//! recipe or input file.

use std::path::Path;

/// A recipe or an input file, with its result.
pub(crate) struct Case<'a> {
    /// The path of the recipe or of the input file. In the report, this path is the name of the test case. The folder
    /// of the path is the class of the test case.
    pub(crate) path: &'a Path,
    /// The time of the run, in seconds.
    pub(crate) time: f64,
    pub(crate) end: CaseEnd,
}

pub(crate) enum CaseEnd {
    Passed,
    /// The test case was not run. The text is the reason.
    Skipped(&'static str),
    Failed {
        /// A summary of the error in one line.
        message: String,
        /// The text of the error, as it is printed on a terminal.
        text: String,
    },
}

/// Returns the results as XML.
pub(crate) fn report(suite: &str, cases: &[Case]) -> String {
    let count = |is: fn(&CaseEnd) -> bool| cases.iter().filter(|case| is(&case.end)).count();
    let failures = count(|end| matches!(end, CaseEnd::Failed { .. }));
    let skipped = count(|end| matches!(end, CaseEnd::Skipped(_)));
    let time: f64 = cases.iter().map(|case| case.time).sum();
    let (n, suite) = (cases.len(), escaped(suite));
    let cases: String = cases.iter().map(case_xml).collect();
    format!(
        r#"<?xml version="1.0" encoding="UTF-8"?>
<testsuites name="meshwright" tests="{n}" failures="{failures}" errors="0" time="{time:.3}">
    <testsuite name="{suite}" tests="{n}" disabled="{skipped}" errors="0" failures="{failures}">
{cases}    </testsuite>
</testsuites>
"#
    )
}

fn case_xml(case: &Case) -> String {
    let end = match &case.end {
        CaseEnd::Passed => String::new(),
        CaseEnd::Skipped(reason) => format!(r#"<skipped message="{reason}"/>"#),
        CaseEnd::Failed { message, text } => {
            let (message, text) = (escaped(message), escaped(text));
            format!(r#"<failure message="{message}">{text}</failure>"#)
        }
    };
    let folder = case.path.parent().unwrap_or(Path::new(""));
    format!(
        "        <testcase name=\"{}\" classname=\"{}\" time=\"{:.3}\">{end}</testcase>\n",
        escaped(&case.path.display().to_string()),
        escaped(&folder.display().to_string()),
        case.time,
    )
}

/// Escapes a string for an XML attribute or for XML content. Removes characters that XML does not allow.
fn escaped(text: &str) -> String {
    let mut xml = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => xml += "&amp;",
            '<' => xml += "&lt;",
            '>' => xml += "&gt;",
            '"' => xml += "&quot;",
            // In attributes, XML parsers replace unescaped tabs and line breaks by spaces.
            '\t' | '\n' | '\r' => xml += &format!("&#{};", u32::from(c)),
            '\0'..='\x1f' | '\u{fffe}' | '\u{ffff}' => {}
            c => xml.push(c),
        }
    }
    xml
}
