#!/usr/bin/env bash
# Builds Fullbright for Windows (x86-64) on Debian 12, into build-windows/fullbright: fullbright.exe, fullbright-lab.exe and
# the base game, in a folder that can be copied anywhere. Libraries are linked into the programs; Vulkan's comes with
# Windows' drivers.
#
#   usage: Windows/build.sh [--jobs N] [--tests] [--up-to MODULE] [--only TARGET]...
#     --jobs N        compile N files at once; default: as many as there are processors
#     --tests         the test programs, too, for Windows/test.sh
#     --up-to MODULE  only the modules up to this one, in the order of Quake/CMakeLists.txt, and no programs; up to `server` few
#                     libraries are needed
#     --only TARGET   only these of CMake's targets, and no folder is put together
#
# Needs: apt-get install g++-mingw-w64-x86-64-posix cmake ninja-build make pkg-config dpkg-dev, and what `make` needs
# (Linux/install-deps.sh build). In order:
#   1. shaders and the base game are made by this machine's own build, in build/ (not with --up-to);
#   2. libraries from Debian's sources (Windows/dependencies.sh), once, in build-windows/deps;
#   3. the programs, in build-windows/build.
set -euo pipefail

say() { echo "build.sh: $*" >&2; }
fail() { say "$*"; exit 1; }
usage() { sed -n '2,19s/^# \{0,1\}//p' "$0"; }

jobs=$(nproc) tests=OFF up_to="" targets=()
while [[ $# -gt 0 ]]; do
  case $1 in
  --help | -h) usage; exit 0 ;;
  --jobs) jobs=${2:?--jobs needs a number}; shift ;;
  --tests) tests=ON ;;
  --up-to) up_to=${2:?--up-to needs a module}; shift ;;
  --only) targets+=("${2:?--only needs a target}"); shift ;;
  *) say "unknown option '$1'"; usage >&2; exit 2 ;;
  esac
  shift
done
cd "$(dirname "$0")/.."
for tool in cmake ninja x86_64-w64-mingw32-g++-posix x86_64-w64-mingw32-windres; do
  command -v "$tool" >/dev/null || fail "there is no $tool: see $0 --help"
done
out=$PWD/build-windows
mkdir -p "$out"

shaders=""
if [[ -z $up_to ]]; then
  say "1 of 3: shaders and the base game, in build/ (log: build-windows/host.log)"
  [[ -f build/build.ninja ]] || cmake --preset release >"$out/host.log" 2>&1 ||
    { cat "$out/host.log" >&2; fail "build/ cannot be configured"; }
  ninja -C build -j "$jobs" fb_shader_files gpu_test_shaders basegame >"$out/host.log" 2>&1 ||
    { tail -n 20 "$out/host.log" >&2; fail "shaders and the base game cannot be made, see build-windows/host.log"; }
  shaders=$PWD/build
fi

say "2 of 3: libraries"
libraries=()
case $up_to in
base | fs | console | formats | world | net | progs | server) libraries=(zlib libpng1.6 libzip fmtlib xxhash glm googletest) ;;
esac
Windows/dependencies.sh "$out/deps" "$jobs" "${libraries[@]}"

say "3 of 3: Fullbright"
cmake -S . -B "$out/build" -G Ninja -DCMAKE_TOOLCHAIN_FILE="$PWD/Windows/toolchain.cmake" \
  -DFULLBRIGHT_WINDOWS_DEPS="$out/deps" -DCMAKE_BUILD_TYPE=Release -DFULLBRIGHT_SHADERS_FROM="$shaders" \
  -DFULLBRIGHT_BASEGAME=OFF -DFULLBRIGHT_BENCHMARKS=OFF -DFULLBRIGHT_TESTS=$tests -DFULLBRIGHT_QUICK_BUILD=ON -DFULLBRIGHT_UP_TO="$up_to" \
  >"$out/configure.log" 2>&1 || { tail -n 30 "$out/configure.log" >&2; fail "CMake failed, see build-windows/configure.log"; }
if [[ ${#targets[@]} -gt 0 ]]; then
  ninja -C "$out/build" -j "$jobs" "${targets[@]}"
  exit
fi
if [[ -n $up_to ]]; then
  ninja -C "$out/build" -j "$jobs"
  exit
fi
ninja -C "$out/build" -j "$jobs" $([[ $tests == ON ]] && echo all || echo fullbright fullbright-lab)

rm -rf "$out/fullbright.new"
mkdir "$out/fullbright.new"
cp "$out"/build/{fullbright,fullbright-lab}.exe "$out/fullbright.new"
cp -r build/game "$out/fullbright.new/game"
cp LICENSE CHANGELOG.md "$out/fullbright.new"
for program in "$out"/fullbright.new/*.exe; do
  x86_64-w64-mingw32-strip "$program"
  # What Windows does not bring itself would be missed on a user's machine.
  lacking=$(x86_64-w64-mingw32-objdump -p "$program" | sed -n 's/.*DLL Name: //p' |
    grep -viE '^(kernel32|user32|gdi32|winmm|imm32|ole32|oleaut32|version|setupapi|shell32|advapi32|ws2_32|msvcrt|vulkan-1|rpcrt4|shlwapi|dbghelp|cfgmgr32|hid|iphlpapi)\.dll$' || true)
  [[ -z $lacking ]] || fail "$(basename "$program") wants" $lacking "which no Windows has"
done
rm -rf "$out/fullbright"
mv "$out/fullbright.new" "$out/fullbright"
say "build-windows/fullbright is complete: $(du -sh "$out/fullbright" | cut -f1)"
