#!/usr/bin/env bash
# Edits a cube in a real window on a virtual display, with mouse and keys, and runs the saved recipe with the program.
#
#     crates/viewer/xvfb.sh target/debug/meshwright-viewer target/debug/meshwright FOLDER
#
# FOLDER gets the recipe, the messages of the programs and, if ImageMagick is installed, pictures of the screen. Needs Xvfb,
# xdotool, openbox and a Vulkan driver (on Debian: apt-get install xvfb xdotool openbox mesa-vulkan-drivers).
set -euo pipefail
viewer=$(realpath "$1")
meshwright=$(realpath "$2")
rm -rf "$3" && mkdir -p "$3/state" && cd "$3"
export XDG_STATE_HOME=$PWD/state LIBGL_ALWAYS_SOFTWARE=1
unset WAYLAND_DISPLAY WAYLAND_SOCKET

started=()
trap 'for id in "${started[@]}"; do kill "$id" 2> /dev/null || true; done' EXIT
fail() {
    echo "$1"
    picture failed
    cat messages.txt
    exit 1
}
# Tries a command until it succeeds, for at most 40 seconds.
wait_for() {
    for _ in {1..200}; do
        if "$@" > /dev/null 2>&1; then return 0; fi
        sleep 0.2
    done
    return 1
}
picture() { if command -v import > /dev/null; then sleep 1 && import -window root "$1.png" || true; fi; }
key() { xdotool key "$1" && sleep 0.5; }
click() { xdotool mousemove --window "$window" "$1" "$2" && sleep 0.5 && xdotool click 1 && sleep 0.5; }
# Saves the recipe, and waits until the saved file contains the given text.
saved() {
    key ctrl+s
    wait_for grep -q "$1" cube.ron || fail "the saved recipe has no $1"
}

cat > cube.ron <<'RON'
(
    recipe: 1,
    steps: [
        Cube(size: 2, triangles: true),
    ],
)
RON

exec 3> display
Xvfb -displayfd 3 -screen 0 1500x960x24 2> messages.txt &
started+=($!)
wait_for test -s display || fail "the virtual display does not start"
DISPLAY=:$(cat display)
export DISPLAY
openbox 2>> messages.txt &
started+=($!)
wait_for xdotool get_desktop || fail "the window manager does not start"

"$viewer" cube.ron 2>> messages.txt &
editor=$!
started+=("$editor")
wait_for xdotool search --onlyvisible --name '^Meshwright' || fail "the window does not open"
window=$(xdotool search --onlyvisible --name '^Meshwright' | head -n 1)
xdotool windowactivate --sync "$window"
sleep 1
picture 1-opened

# Picks the diagonal of the front face with a click on the middle of the face.
click 642 508
picture 2-picked
key f
saved 'FlipEdges(edges: Between('
# The flipped edge is still picked.
key s
saved 'SplitEdges(edges: Between('
picture 3-split
key l
saved 'LoopSubdivide(levels: 1)'
picture 4-subdivided
key ctrl+z
key ctrl+s
wait_for sh -c '! grep -q LoopSubdivide cube.ron' || fail "undo does not remove the step"
# Turns the view and zooms, which does not change the recipe.
xdotool mousemove --window "$window" 700 480 mousedown 1 mousemove_relative 60 40 mouseup 1 click 4
picture 5-turned

key ctrl+q
wait_for sh -c "! kill -0 $editor" || fail "the window does not close"
wait "$editor" || fail "the editor ends with an error"
test -z "$(find state -path '*journals*' -type f)" || fail "a journal is left although everything is saved"

"$meshwright" run cube.ron --out out | tee run.txt
grep -q 'SplitEdges .* 14 ' run.txt
echo "the recipe that was edited in the window runs"
