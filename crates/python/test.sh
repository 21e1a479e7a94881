#!/usr/bin/env bash
# Builds the wheel, installs it into a new virtual environment, and runs the tests there. The tests run the examples in
# the documentation of the package and in the book, too. Then mypy checks the types. The wheel is built in the same
# target folder and with the same profile as the program, so that most crates are compiled only once.
set -euo pipefail
cd "$(dirname "$0")/../.."
folder=$PWD/target/ci/python
rm -rf "$folder" && mkdir -p "$folder"
python=${PYTHON:-python3}

"$python" -c 'import sys; sys.exit(sys.version_info < (3, 11))' ||
    { echo "the Python package needs Python 3.11 or newer: set PYTHON"; exit 1; }
"$python" -m venv "$folder/tools"
"$folder/tools/bin/pip" install --quiet 'maturin>=1.9,<2' ||
    { echo "maturin cannot be installed from PyPI, so the wheel cannot be built: check the network and pip's index"; exit 1; }
"$folder/tools/bin/maturin" build --release --locked --manifest-path crates/python/Cargo.toml --target-dir target --out "$folder"

"$python" -m venv "$folder/new"
"$folder/new/bin/pip" install --quiet "$folder"/meshwright-*.whl
"$folder/new/bin/python" -c 'import meshwright as mw; print(mw.Scene().icosahedron(name="ball").mesh().loop_subdivide(levels=2))'
"$folder/new/bin/meshwright" ops > /dev/null
"$folder/new/bin/pip" install --quiet pytest mypy scipy tqdm trimesh meshio fsspec 'dask[distributed]' nbclient ipykernel ||
    { echo "the packages for the tests cannot be installed from PyPI: check the network and pip's index"; exit 1; }
for package in pyvista open3d; do
    "$folder/new/bin/pip" install --quiet "$package" && "$folder/new/bin/python" -c "import $package" ||
        echo "$package cannot be installed or imported on this machine: the tests of its conversions are skipped"
done
"$folder/new/bin/pip" install --quiet ray || echo "Ray has no wheel for this machine: its test is skipped"
cd crates/python
"$folder/new/bin/python" -m pytest --quiet -p no:cacheprovider tests
"$folder/new/bin/python" -m mypy --cache-dir "$folder/mypy" --strict tests/example.py tests/sample.py
"$folder/new/bin/python" -m mypy.stubtest meshwright._core --mypy-config-file pyproject.toml
