#!/usr/bin/env bash
# Compares the nearest points of two programs. See README.md.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
[ -x "${1:-}" ] || { echo "usage: $0 MESHWRIGHT" >&2; exit 2; }
venv=$root/target/peers
[ -x "$venv/bin/python" ] || python3 -m venv "$venv"
"$venv/bin/pip" install --quiet open3d==0.20.0 numpy
exec "$venv/bin/python" "$root/tests/peers/nearest.py" "$1"
