//! Reads arbitrary strings as sweeps, and computes the parameter values of each run of the sweep.

#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let reading = recipe::read_sweep(text);
    if reading.has_errors() {
        assert!(reading.diagnostics.iter().all(|d| !d.message.is_empty()));
    } else if let Some(sweep) = reading.sweep {
        let _ = sweep.grid(&[], "".as_ref());
    }
});
