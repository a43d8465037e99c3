#!/usr/bin/env bash
# `make demo`: plays a recorded demo headless through the path tracer. Data: QUAKE_DIR, else LibreQuake beside the
# source tree. DEMO, SIZE and OUT choose the demo, the picture's size and the folder of the frames.
set -euo pipefail
cd "$(dirname "$0")/.."

data=${QUAKE_DIR:-}
if [[ -z $data && -d ../shared/librequake/id1 ]]; then data=../shared/librequake; fi
if [[ -z $data ]]; then
  echo "make demo: say where the game data is, with QUAKE_DIR=DIR, where DIR holds id1/pak0.pak (Quake's or LibreQuake's)" >&2
  exit 1
fi
if [[ ! -d $data/id1 ]]; then
  echo "make demo: $data has no folder id1; QUAKE_DIR must name the folder that holds id1/pak0.pak" >&2
  exit 1
fi

out=${OUT:-out/demo}
mkdir -p "$out"
rm -f "$out"/*.png
build/fullbright -headless -basedir "$data" -size "${SIZE:-320x180}" -capture "$out" \
  -capture_every "${CAPTURE_EVERY:-30}" +timedemo "${DEMO:-demo3}" +quit
echo "$(find "$out" -name '*.png' | wc -l) frames are in $(cd "$out" && pwd)"
