#!/usr/bin/env bash
# Bundles the viewer of notebooks with three.js into the sources of the package. Needs npm and a network.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$here/../../..
tools=$root/target/viewer
npm install --silent --no-audit --no-fund --prefix "$tools" three@0.180.0 esbuild@0.25
mkdir -p "$here/../python/meshwright/_static"
NODE_PATH=$tools/node_modules "$tools/node_modules/.bin/esbuild" "$here/viewer.js" --bundle --minify --format=iife \
    --global-name=meshwright --legal-comments=inline --outfile="$here/../python/meshwright/_static/viewer.js"
cp "$tools/node_modules/three/LICENSE" "$here/../python/meshwright/_static/LICENSE-three.txt"
