//! The program `meshwright` with one more operation.

mod lift;

fn main() -> std::process::ExitCode {
    let registry = ops_all::registry().with::<lift::Lift>();
    cli::run(registry)
}
