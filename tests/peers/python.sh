#!/usr/bin/env bash
# Compares the Python package with trimesh. See README.md.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
[ -e "${1:-}" ] || { echo "usage: $0 MESHWRIGHT.whl" >&2; exit 2; }
venv=$root/target/peers
[ -x "$venv/bin/python" ] || python3 -m venv "$venv"
"$venv/bin/pip" install --quiet --force-reinstall --no-deps "$1"
"$venv/bin/pip" install --quiet numpy trimesh==5.2.0 fast-simplification scipy networkx
exec "$venv/bin/python" "$root/tests/peers/python.py"
