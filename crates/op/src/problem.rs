//! Problems with steps that are found before anything runs.

/// A problem with a step that is found before any step runs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// The description of the problem, in lower case and without a full stop.
    pub message: String,
    /// How to solve the problem.
    pub help: Option<String>,
    /// The path of the parameter: names of fields and variants, and indices of list items, from the outermost to the
    /// innermost. The path is empty if the problem concerns the whole step.
    pub path: Vec<String>,
    /// Whether the problem is only a warning. A recipe can run in spite of warnings.
    pub is_warning: bool,
}

impl Problem {
    /// Creates an error that concerns the whole step.
    pub fn error(message: impl Into<String>) -> Self {
        Self {
            message: message.into(),
            help: None,
            path: Vec::new(),
            is_warning: false,
        }
    }

    /// Creates a warning that concerns the whole step.
    pub fn warning(message: impl Into<String>) -> Self {
        Self {
            is_warning: true,
            ..Self::error(message)
        }
    }

    /// Sets the path of the parameter.
    #[must_use]
    pub fn at<const N: usize>(mut self, path: [&str; N]) -> Self {
        self.path = path.map(str::to_owned).to_vec();
        self
    }

    /// Sets the help text, which says how to solve the problem.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }
}
