#!/usr/bin/env bash
# Computes the results of all cases with OpenSubdiv. Writes them to results/, or to the folder given as the argument.
# Needs a C++ compiler and OpenSubdiv 3.5 (Debian: g++ libosd-dev).
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
out=${1:-$here/results}
build=$here/../../target/oracle
mkdir -p "$out" "$build"

g++ -std=c++17 -O2 -ffp-contract=off -Wall -Wextra -Werror "$here/opensubdiv.cpp" -losdCPU -o "$build/opensubdiv"
for case in "$here"/cases/*.txt; do
    "$build/opensubdiv" "$case" > "$out/$(basename "$case")"
done
