#!/usr/bin/env bash
# Runs a command with a display: the existing one, else a virtual X server, else (without Xvfb) none, and tests of the
# window report that they skip. -noreset: a server that resets when its last window closes could refuse the next one.
set -euo pipefail
if [[ -z ${DISPLAY:-}${WAYLAND_DISPLAY:-} ]] && command -v xvfb-run >/dev/null; then
  exec xvfb-run --auto-servernum --server-args="-screen 0 1280x720x24 -noreset" "$@"
fi
exec "$@"
