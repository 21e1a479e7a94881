//! `meshwright completions` and `meshwright man`: print completion scripts and the manual page.

use clap_complete::Shell;
use clap_mangen::Man;

use crate::args::help::command;
use crate::output::print;

/// Prints a completion script.
pub(crate) fn completions(shell: Shell) -> anyhow::Result<bool> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut command(), "meshwright", &mut script);
    print(&String::from_utf8(script)?)?;
    Ok(true)
}

/// Prints the manual page.
pub(crate) fn page() -> anyhow::Result<bool> {
    let mut page = Vec::new();
    Man::new(command()).render(&mut page)?;
    print(&String::from_utf8(page)?)?;
    Ok(true)
}
