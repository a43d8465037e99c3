#!/usr/bin/env bash
# Runs a command where there is a display: the one there is, else a virtual X server, else (without Xvfb) as it stands,
# and tests of the window say that they skip. A server that resets when its last window closes would turn away the next.
set -euo pipefail
if [[ -z ${DISPLAY:-}${WAYLAND_DISPLAY:-} ]] && command -v xvfb-run >/dev/null; then
  exec xvfb-run --auto-servernum --server-args="-screen 0 1280x720x24 -noreset" "$@"
fi
exec "$@"
