#!/usr/bin/env bash
# Compares the simplification of several programs. See README.md.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
[ -x "${1:-}" ] || { echo "usage: $0 MESHWRIGHT [MODEL.obj ..]" >&2; exit 2; }
venv=$root/target/peers
[ -x "$venv/bin/python" ] || python3 -m venv "$venv"
"$venv/bin/pip" install --quiet meshlib==3.1.4.297 meshoptimizer==0.2.30a0 libigl==2.6.3 numpy
exec "$venv/bin/python" "$root/tests/peers/simplify.py" "$root" "$@"
