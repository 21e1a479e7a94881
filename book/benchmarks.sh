#!/usr/bin/env bash
# Runs all benchmarks in crates/benches with one and two threads, and writes book/src/benchmark_tables.md.
# Takes about half an hour on an idle machine.
set -euo pipefail
cd "$(dirname "$0")/.."
RAYON_NUM_THREADS=1 cargo bench -p meshwright-benches -- --save-baseline one
RAYON_NUM_THREADS=2 cargo bench -p meshwright-benches -- --save-baseline two
{
    cat << HEAD
# Measured tables

Written by \`book/benchmarks.sh\` on $(date -u +%F), commit $(git describe --always), $(rustc --version | cut -d' ' -f1,2).
Machine: $(lscpu | sed -n 's/^Model name: *//p') ($(uname -m)), $(nproc) processors, $(free -g | awk '/^Mem/ { print $2 }') GB of memory.

Times are medians. *Scaling* is the time with one thread divided by the time with two threads. *Time relative to copying
the bytes* is the time with one thread divided by a reference time. The reference time is the time that one thread needs
to copy, read or write the same bytes without other work. The rows "bytes alone" show these reference times. M/s means
million elements, such as triangles, edges or pixels, per second. Rows with the name of another crate, such as alum,
measure this other crate. Some of the other crates use only one thread.
HEAD
    cargo run --release -p meshwright-benches
} > target/benchmark_tables.md
mv target/benchmark_tables.md book/src/benchmark_tables.md
