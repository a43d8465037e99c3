#!/usr/bin/env bash
# `make demo`: plays a recorded demo headless through the path tracer: the base game's hub, or demo3 of the data in
# QUAKE_DIR, a folder with id1/pak0.pak. DEMO, SIZE, CAPTURE_EVERY, OUT and VIEWSIZE choose the demo, the picture's size, which
# frames are saved, the folder for them, and how much of the status bar they show (100: all of it).
set -euo pipefail
cd "$(dirname "$0")/.."

data=${QUAKE_DIR:-}
if [[ -n $data && ! -d $data/id1 ]]; then
  echo "make demo: $data has no folder id1; QUAKE_DIR must name the folder that holds id1/pak0.pak" >&2
  exit 1
fi
# Without QUAKE_DIR only the base game is used, whatever is in the current folder.
game=(-basedir "${data:-build/game}")
demo=${DEMO:-$([[ -n $data ]] && echo demo3 || echo hub)}

out=${OUT:-out/demo}
mkdir -p "$out"
rm -f "$out"/*.png
# At this size the status bar would hide a quarter of the picture.
build/fullbright -headless "${game[@]}" -size "${SIZE:-320x180}" -capture "$out" \
  -capture_every "${CAPTURE_EVERY:-30}" +viewsize "${VIEWSIZE:-120}" +timedemo "$demo" +quit
echo "$(find "$out" -name '*.png' | wc -l) frames are in $(cd "$out" && pwd)"
