#!/usr/bin/env bash
# Builds the package for browsers and Node in target/web, and tests it in Node. Builds the engine with threads in
# target/ci/web/threads. Then builds the page in target/web/page, and tests it in Chromium.
#
# If the installed toolchain has the standard library for WebAssembly, the script uses this toolchain. If the toolchain
# does not have this library, the script unpacks Debian packages in target/ci/web: a compiler, and the sources of its
# standard library. If a tool is not available, the script prints the reason and exits with code 0.
set -euo pipefail
cd "$(dirname "$0")/../.."
work=$PWD/target/ci/web
out=$PWD/target/web
target=wasm32-unknown-unknown
mkdir -p "$work"

skip() { echo "the package for browsers is not built: $*"; exit 0; }

command -v npm > /dev/null || skip "npm is missing"
sysroot=$(rustc --print sysroot)
build=(cargo rustc --profile web --locked --target "$target" -p meshwright-web --lib --crate-type cdylib)
if ! [ -d "$sysroot/lib/rustlib/$target" ]; then
    [ "$(uname -sm)" = "Linux x86_64" ] || skip "the standard library is missing: rustup target add $target"
    command -v apt-get > /dev/null || skip "the standard library and apt-get are missing"
    linker=$sysroot/lib/rustlib/x86_64-unknown-linux-gnu/bin/rust-lld
    [ -x "$linker" ] || skip "the toolchain has no rust-lld"
    root=$work/root/usr
    if ! [ -d "$root/src" ] || ! [ -x "$root/bin/rustc" ]; then
        # The package lists are in a separate folder, so that apt-get does not need root.
        mkdir -p "$work/lists/partial" "$work/cache/archives/partial" "$work/debs"
        printf '%s\n' "Dir::State::lists \"$work/lists\";" "Dir::Cache \"$work/cache\";" > "$work/apt.conf"
        [ "$(id -u)" != 0 ] || echo 'APT::Sandbox::User "root";' >> "$work/apt.conf"
        export APT_CONFIG=$work/apt.conf
        apt-get update > "$work/apt.txt" 2>&1 || skip "package lists cannot be downloaded"
        version=$(apt-cache policy rustc-web | awk '/Candidate/ { print $2 }')
        [ -n "$version" ] || skip "the package rustc-web does not exist"
        linked=$(apt-cache depends "libstd-rust-web-dev=$version" | awk '/Depends: libstd-rust-web-/ { print $2 }')
        llvm=$(apt-cache depends "$linked" | awk '/Depends: libllvm/ { print $2 }')
        (cd "$work/debs" && apt-get download "rustc-web=$version" "rust-web-src=$version" "libstd-rust-web-dev=$version" \
            "$linked" "$llvm") >> "$work/apt.txt" 2>&1 || skip "the compiler cannot be downloaded"
        for package in "$work"/debs/*.deb; do dpkg -x "$package" "$work/root"; done
        rm -rf "$work/debs" "$work/cache" "$work/lists"
        unset APT_CONFIG
    fi
    printf '%s\n' '#!/bin/sh' \
        "LD_LIBRARY_PATH=$root/lib/x86_64-linux-gnu:$root/lib exec $root/bin/rustc \"\$@\"" > "$work/rustc"
    chmod +x "$work/rustc"
    needs=$(sed -n 's/^rust-version = "\(.*\)"/\1/p' Cargo.toml)
    has=$("$work/rustc" -V 2> /dev/null | cut -d ' ' -f 2) || skip "the compiler does not run"
    [ "$(printf '%s\n' "$needs" "$has" | sort -V | head -n 1)" = "$needs" ] ||
        skip "the packaged compiler has version $has, expected at least $needs"
    # A stable compiler builds its own standard library only if this variable is set.
    export RUSTC_BOOTSTRAP=1
    build+=(-Zbuild-std=std,panic_abort)
    compiler=(env "RUSTC=$work/rustc" "CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER=$linker")
fi
npm install --silent --no-audit --no-fund --prefix "$work/tools" binaryen@132.0.0 ||
    skip "binaryen cannot be installed from npm"

# Threads need atomic operations. The engine without threads is compiled with the same flag, so that both engines can
# use the same compiled dependencies.
[ -z "${compiler:-}" ] || export CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUSTFLAGS="-C target-feature=+atomics"
export CARGO_INCREMENTAL=0
CARGO_TARGET_DIR=$work/target "${compiler[@]:-env}" "${build[@]}"
(cd crates/web/bindgen && CARGO_TARGET_DIR=$work/bindgen cargo build --locked)

# Writes the package: package FOLDER-OF-CARGO FOLDER
package() {
    rm -rf "$2" && mkdir -p "$2"
    "$work/bindgen/debug/meshwright-bindgen" "$1/$target/web/meshwright_web.wasm" "$2"
    "$work/tools/node_modules/.bin/wasm-opt" -O1 -o "$2/core_bg.wasm" "$2/core_bg.wasm"
    cp crates/web/package/* LICENSE-APACHE LICENSE-MIT "$2"
}

package "$work/target" "$out"
# The compression uses one processor for about a minute.
node crates/web/tests/size.mjs "$out/core_bg.wasm" &
compression=$!
node crates/web/tests/scenes.mjs "$out"

# Threads also need shared memory, and a standard library that was compiled with atomic operations.
if [ -n "${compiler:-}" ]; then
    flags=(--cfg threads)
    for argument in --shared-memory --import-memory --max-memory=4294967296 --export=__heap_base \
        --export=__wasm_init_tls --export=__tls_size --export=__tls_align --export=__tls_base; do
        flags+=(-C "link-arg=$argument")
    done
    CARGO_TARGET_DIR=$work/target "${compiler[@]}" "${build[@]}" -- "${flags[@]}"
    package "$work/target" "$work/threads"
    node crates/web/tests/size.mjs "$work/threads/core_bg.wasm"
else
    rm -rf "$work/threads"
    echo "the engine with threads is not built: the sources of the standard library are missing"
fi
wait "$compression"
crates/web/page/build.sh
