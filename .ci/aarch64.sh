#!/usr/bin/env bash
# Checks that digests are the same on 64-bit ARM: builds the program for it, and runs every recipe under emulation.
#
# The compiler, standard library, linker and emulator are Debian packages. If they are not available, the script prints
# the reason and exits with code 0.
#
#   .ci/aarch64.sh [FOLDER]     FOLDER keeps downloads and builds. Defaults to target/ci/aarch64.
#
# If target/ci/scenes exists, the files that the scenes write are compared with the files in this folder. Some pictures
# of the reference of operations are drawn again and compared with those in the repository.
set -euo pipefail
cd "$(dirname "$0")/.."
work=$(mkdir -p "${1:-target/ci/aarch64}" && cd "${1:-target/ci/aarch64}" && pwd)
target=aarch64-unknown-linux-gnu

skip() { echo "the digests on 64-bit ARM are not compared: $*"; exit 0; }

[ "$(uname -sm)" = "Linux x86_64" ] || skip "this needs Linux on x86_64"
command -v apt-get > /dev/null || skip "apt-get is missing"
[ "$(id -u)" = 0 ] || skip "installing packages requires root"

# The script uses its own package lists, for both processors, and does not change the package lists of the machine.
mkdir -p "$work/lists/partial" "$work/cache/archives/partial" "$work/debs"
cat > "$work/apt.conf" << END
Dir::State::lists "$work/lists";
Dir::Cache "$work/cache";
APT::Architectures { "amd64"; "arm64"; };
APT::Sandbox::User "root";
END
apt() { APT_CONFIG=$work/apt.conf apt-get "$@"; }

if ! [ -x "$work/root/usr/bin/rustc" ]; then
    apt update > "$work/apt.txt" 2>&1 || skip "package lists cannot be downloaded"
    std=$(APT_CONFIG=$work/apt.conf apt-cache depends rustc-web 2> /dev/null | grep -c libstd-rust-web-dev || true)
    [ "$std" != 0 ] || skip "the package rustc-web does not exist"
    # Downloads the compiler, the libraries that it is linked with, and the standard libraries for both processors. All
    # packages must have the same version.
    version=$(APT_CONFIG=$work/apt.conf apt-cache policy rustc-web | awk '/Candidate/ { print $2 }')
    linked=$(APT_CONFIG=$work/apt.conf apt-cache depends "libstd-rust-web-dev=$version" |
        awk '/Depends: libstd-rust-web-/ { print $2 }')
    llvm=$(APT_CONFIG=$work/apt.conf apt-cache depends "$linked" | awk '/Depends: libllvm/ { print $2 }')
    (cd "$work/debs" && apt download "rustc-web=$version" "libstd-rust-web-dev=$version" "$linked" "$llvm" \
        "libstd-rust-web-dev:arm64=$version") >> "$work/apt.txt" 2>&1 ||
        skip "the standard library for $target cannot be downloaded"
    for package in "$work"/debs/*.deb; do dpkg -x "$package" "$work/root"; done
    rm -rf "$work/debs" "$work/cache" "$work/lists"
fi
if ! command -v aarch64-linux-gnu-gcc > /dev/null || ! command -v qemu-aarch64 > /dev/null; then
    { apt-get update && apt-get install -y --no-install-recommends \
        gcc-aarch64-linux-gnu libc6-dev-arm64-cross qemu-user; } >> "$work/apt.txt" 2>&1 ||
        skip "the linker or the emulator cannot be installed"
fi

cat > "$work/rustc" << END
#!/bin/sh
LD_LIBRARY_PATH=$work/root/usr/lib/x86_64-linux-gnu:$work/root/usr/lib exec $work/root/usr/bin/rustc "\$@"
END
chmod +x "$work/rustc"
needs=$(sed -n 's/^rust-version = "\(.*\)"/\1/p' Cargo.toml)
has=$("$work/rustc" -V 2> /dev/null | cut -d ' ' -f 2) || skip "the compiler does not run"
[ "$(printf '%s\n' "$needs" "$has" | sort -V | head -n 1)" = "$needs" ] ||
    skip "the packaged compiler has version $has, expected at least $needs"

# Low optimization halves the build time and does not affect the digests.
RUSTC=$work/rustc RUSTFLAGS="" CARGO_INCREMENTAL=0 CARGO_TARGET_DIR=$work/target \
    CARGO_PROFILE_RELEASE_OPT_LEVEL=1 CARGO_PROFILE_RELEASE_CODEGEN_UNITS=16 \
    CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_LINKER=aarch64-linux-gnu-gcc \
    cargo build --release --locked --target "$target" -p meshwright-cli

meshwright() { qemu-aarch64 -L /usr/aarch64-linux-gnu "$work/target/$target/release/meshwright" "$@"; }
rm -rf "$work/scenes" "$work/pictures"
meshwright test scenes --out "$work/scenes" | tee "$work/scenes.txt"
while read -r name digest; do
    grep -q "scenes/$name.ron .*digest $digest" "$work/scenes.txt" ||
        { echo "$name: the digest on 64-bit ARM differs from tests/digests.txt"; exit 1; }
done < tests/digests.txt
echo "$(wc -l < tests/digests.txt) digests are the same on 64-bit ARM"

if [ -d target/ci/scenes ]; then
    diff -r target/ci/scenes "$work/scenes" || { echo "64-bit ARM writes different files"; exit 1; }
    echo "$(find "$work/scenes" -type f | wc -l) files are the same on 64-bit ARM"
fi

meshwright test ops/all/pictures --filter _edges --out "$work/pictures"
find "$work/pictures" -name '*.png' -printf '%P\n' | while read -r picture; do
    cmp "ops/all/pictures/$picture" "$work/pictures/$picture" || { echo "64-bit ARM draws a different picture"; exit 1; }
done
echo "$(find "$work/pictures" -name '*.png' | wc -l) pictures are the same on 64-bit ARM"
