#!/usr/bin/env bash
# Compares the simplification of a machine part with sharp edges. See README.md.
#
#   tests/peers/part.sh MESHWRIGHT [FINENESS]     FINENESS 1 makes 142,848 triangles, 2 (the default) 571,392.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
[ -x "${1:-}" ] || { echo "usage: $0 MESHWRIGHT [FINENESS]" >&2; exit 2; }
venv=$root/target/peers
[ -x "$venv/bin/python" ] || python3 -m venv "$venv"
"$venv/bin/pip" install --quiet meshlib==3.1.4.297 numpy
exec "$venv/bin/python" "$root/tests/peers/part.py" "$@"
