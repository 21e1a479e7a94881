#!/usr/bin/env bash
# Compares the texture coordinates of two programs. See README.md.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
[ -x "${1:-}" ] || { echo "usage: $0 MESHWRIGHT [MODEL.obj ..]" >&2; exit 2; }
venv=$root/target/peers
[ -x "$venv/bin/python" ] || python3 -m venv "$venv"
"$venv/bin/pip" install --quiet xatlas==0.0.11 numpy
exec "$venv/bin/python" "$root/tests/peers/unwrap.py" "$root" "$@"
