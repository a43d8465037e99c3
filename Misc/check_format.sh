#!/usr/bin/env bash
# Checks the C++ sources and the shaders against .clang-format; --fix rewrites them. Releases of
# clang-format differ in details, so the check is skipped unless it is release 14, which Debian 12 has.
set -euo pipefail
cd "$(dirname "$0")/.."
mapfile -t files < <(git ls-files 'Quake/*.cpp' 'Quake/*.h' 'Shaders/*.h' 'Shaders/*.cpp' 'Shaders/*.glsl' 'Shaders/*.comp' | xargs ls -d 2>/dev/null)
[[ ${#files[@]} -gt 0 ]] || exit 0
if [[ ${1:-} == --fix ]]; then
  clang-format -i "${files[@]}"
  exit 0
fi
version=$(clang-format --version | sed -n 's/.*version \([0-9]*\).*/\1/p')
if [[ $version != 14 ]]; then
  echo "check_format: skipped, clang-format is release $version and the sources follow release 14"
  exit 0
fi
# Each of the parallel runs says its files' names at once, so that no line holds pieces of two.
of_run='set -o pipefail; clang-format --dry-run "$@" 2>&1 | sed -n "s/^\([^:]*\):[0-9]*:[0-9]*: .*/\1/p" | sort -u'
wrong=$(printf '%s\0' "${files[@]}" | xargs -0 -n 32 -P "$(nproc)" bash -c "$of_run" of_run | sort -u)
if [[ -n $wrong ]]; then
  sed 's/^/check_format: /; s/$/ is not as .clang-format wants it (make format)/' <<<"$wrong"
  exit 1
fi
echo "check_format: ${#files[@]} files are in shape"
