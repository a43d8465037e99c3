#!/usr/bin/env bash
# CI's sanitized part, after a release build: the build by clang, a few seconds of each fuzzer, and every test but what is statistical, slow,
# repeats, or scripts, which runs the same host code or none. It is a function of the sources: where it is known to have passed with the same
# ones (unless_passed.py), nothing runs.
#
#   usage: Misc/sanitized_part.sh [--keep]     --keep: write into passed.csv that it passed
set -euo pipefail
cd "$(dirname "$0")/.."
if [[ ${1:-} != --now ]]; then
  exec Misc/unless_passed.py sanitized --stamps build/passed --tools "$(clang++ --version | head -n 1)" --device build/fullbright --may-skip "$@" \
    --of CMakeLists.txt CMakePresets.json Quake Shaders Linux Misc/basegame Misc/cmake Misc/fuzz_corpus Misc/fuzz.sh Misc/python Misc/sanitized.sh \
    Misc/sanitized_part.sh testdemos -- Misc/sanitized_part.sh --now
fi
jobs=$(nproc)
cmake --preset asan-ubsan -DFULLBRIGHT_WERROR=ON -DFULLBRIGHT_QUICK_BUILD=ON -DFULLBRIGHT_SHADERS_FROM="$PWD/build" -DFULLBRIGHT_ALL_TESTS=OFF
cmake --build --preset asan-ubsan --parallel "$jobs"
FUZZ_SECONDS=${FUZZ_SECONDS:-3} FUZZ_CORPUS=${FUZZ_CORPUS:-$PWD/build-asan/corpus} Misc/fuzz.sh
Misc/with_display.sh Misc/sanitized.sh ctest --test-dir build-asan --parallel $((jobs + 1)) --label-exclude 'statistical|slow|repeats|scripts' \
  --output-on-failure --timeout 1500
