#!/usr/bin/env bash
# Runs clang-tidy on the .cpp files that differ from BASE (default: origin's main branch if there is one, else the last
# commit), with the release build's compile commands. usage: Misc/tidy_changed.sh [FILE ...]
set -euo pipefail
cd "$(dirname "$0")/.."
cmake --preset release >/dev/null
cmake --build --preset release --target fb_shader_files >/dev/null
files=("$@")
if [[ ${#files[@]} -eq 0 ]]; then
  base=${BASE:-$(git merge-base HEAD origin/HEAD 2>/dev/null || git rev-parse 'HEAD~1')}
  mapfile -t files < <(git diff --name-only --diff-filter=d "$base" -- 'Quake/*.cpp' 'Shaders/*.cpp')
fi
if [[ ${#files[@]} -eq 0 ]]; then
  echo "tidy: no C++ source has changed"
  exit 0
fi
printf '%s\n' "${files[@]}" | xargs -P "${JOBS:-$(nproc)}" -n 1 clang-tidy --quiet -p build
