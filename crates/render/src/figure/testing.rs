//! Test data for this crate and for other crates.

/// Texts that often cause errors in programs. Each text must be written correctly, and drawing it must not fail.
pub const ODD_TEXTS: &[&str] = &[
    "",
    " ",
    "plain",
    "a < b & \"c\" > 'd'",
    "]]> <!-- --> &amp; &#0;",
    "tab\tline\nreturn\r",
    "\0\x01\x08\x1b[31m\x7f\u{85}\u{9f}",
    "\u{fffe}\u{ffff}\u{feff}",
    "\u{5e9}\u{5dc}\u{5d5}\u{5dd} abc \u{645}\u{631}\u{62d}\u{628}\u{627}",
    "\u{202e}override\u{202c} \u{2066}isolate",
    "\u{1f980}\u{1f469}\u{200d}\u{1f52c}\u{1f1e9}\u{1f1ea}",
    "e\u{301}\u{301}\u{301}\u{301}\u{301} \u{300}",
    "\u{10ffff}\u{e000}\u{200b}",
    "\u{4e16}\u{754c}",
];
