#!/usr/bin/env bash
# Compares the remeshing of several programs. See README.md.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
[ -x "${1:-}" ] || { echo "usage: $0 MESHWRIGHT [MODEL.obj ..]" >&2; exit 2; }
venv=$root/target/peers
[ -x "$venv/bin/python" ] || python3 -m venv "$venv"
"$venv/bin/pip" install --quiet pymeshlab==2025.7.post1 numpy
if [ -d /usr/include/CGAL ]; then
    g++ -O2 -DNDEBUG -o "$venv/remesh_cgal" "$root/tests/peers/remesh_cgal.cpp" -lgmp -lmpfr
fi
exec "$venv/bin/python" "$root/tests/peers/remesh.py" "$root" "$@"
