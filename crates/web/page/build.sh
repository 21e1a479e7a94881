#!/usr/bin/env bash
# Builds the page in target/web/page from the package in target/web, and tests it in Chromium. If a tool is not available,
# the script prints the reason and exits with code 0.
set -euo pipefail
cd "$(dirname "$0")/../../.."
package=$PWD/target/web
threads=$PWD/target/ci/web/threads
tools=$PWD/target/ci/page
out=$package/page

skip() { echo "$*"; exit 0; }

command -v npm > /dev/null || skip "the page is not built: npm is missing"
[ -e "$package/core_bg.wasm" ] || skip "the page is not built: target/web is missing, run crates/web/build.sh"
mkdir -p "$tools"
cp crates/web/page/package.json crates/web/page/package-lock.json "$tools"
npm ci --silent --no-audit --no-fund --ignore-scripts --prefix "$tools" ||
    skip "the page is not built: packages cannot be installed from npm"

# Checks the types of the package with a sample, which is not run.
mkdir -p "$tools/node_modules/meshwright"
cp "$package/package.json" "$package/meshwright.d.ts" "$package/meshwright.js" "$tools/node_modules/meshwright"
cp crates/web/tests/types.ts "$tools/types.mts"
"$tools/node_modules/.bin/tsc" --noEmit --strict --module nodenext --target es2022 --lib es2022,dom "$tools/types.mts"
node crates/web/page/bundle.mjs "$package" "$threads" "$tools" "$out"

chromium=$(command -v chromium || command -v chromium-browser || command -v google-chrome) ||
    skip "the page is not tested: chromium is missing"
node crates/web/page/test.mjs "$out" "$tools" "$chromium"
