#!/usr/bin/env bash
# Makes the packages of a build folder, in its folder package: make.sh BUILD [GENERATOR ...] (DEB TGZ). With the same
# SOURCE_DATE_EPOCH (seconds since 1970) the same build gives the same bytes.
set -euo pipefail

[[ $# -ge 1 && $1 != -* ]] || { sed -n '2,3s/^# //p' "$0" >&2; exit 2; }
build=$1
shift
[[ $# -gt 0 ]] || set -- DEB TGZ
export SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-0}
command -v dpkg-shlibdeps >/dev/null || { echo "make.sh: needs Debian's dpkg-dev (Linux/install-deps.sh package)" >&2; exit 1; }
cmake --build "$build" --target package_files
for generator; do (cd "$build" && cpack -G "$generator" >package/cpack.log 2>&1) || { cat "$build/package/cpack.log" >&2; exit 1; }; done
ls -l "$build"/package/fullbright[-_]*.deb "$build"/package/fullbright-*.tar.gz 2>/dev/null | awk '{print $5, $9}'
