#!/usr/bin/env bash
# Runs the benchmark of OpenSubdiv, then the benchmark of the crate `subdivision`. Run it on an otherwise idle machine.
# Arguments are passed to `cargo bench`. Needs a C++ compiler and OpenSubdiv 3.5 (Debian: g++ libosd-dev).
set -euo pipefail
cd "$(dirname "$0")/../.."
build=target/oracle
mkdir -p "$build"

g++ -std=c++17 -O2 -Wall -Wextra -Werror tests/oracle/bench.cpp -losdCPU -o "$build/bench"
"$build/bench"
cargo bench -p meshwright-benches --bench levels "$@"
