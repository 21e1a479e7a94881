#!/usr/bin/env bash
# Runs the fuzz targets. Needs `cargo install cargo-fuzz` and a C++ compiler; no nightly Rust.
#
#   tests/fuzz/run.sh [TARGET [SECONDS]]     TARGET defaults to all targets, SECONDS to 60 for each.
set -euo pipefail
cd "$(dirname "$0")"
export RAYON_NUM_THREADS=1
# For the target `recipe`, the examples in ops/README.md become seed inputs, and the names in this file become the
# dictionary.
mkdir -p target/corpus/recipe
awk '/^```ron/ { n++; next } /^```/ { next } n && /^[A-Z][A-Za-z]*\(/ {
    print "(recipe: 1, steps: [Cube(), " $0 "])" > "target/corpus/recipe/example_" n ".ron"
}' ../../ops/README.md
grep -oE '\b[A-Z][A-Za-z]+|\b[a-z_]+:' ../../ops/README.md | sort -u | sed 's/.*/"&"/' > target/recipe.dict
targets=${1:-$(sed -n 's/^name = "\([a-z]*\)"$/\1/p' Cargo.toml)}
for target in $targets; do
    dict=""
    for file in "dict/$target.dict" "target/$target.dict"; do
        [ -f "$file" ] && dict="-dict=$file"
    done
    mkdir -p "target/corpus/$target"
    cargo fuzz run --sanitizer none --fuzz-dir . "$target" "target/corpus/$target" $([ -d "corpus/$target" ] && echo "corpus/$target" || true) -- \
        -max_total_time="${2:-60}" -max_len=4096 -timeout=10 -malloc_limit_mb=256 -print_funcs=0 -verbosity=0 $dict
done
