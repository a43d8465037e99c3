#!/usr/bin/env bash
# Runs what Windows/build.sh --tests has built, under Wine: the modules' tests, then the programs beside Linux's own.
#
#   usage: Windows/test.sh [--tests | --programs] [MODULE]...
#     --tests     only the modules' tests; MODULE: only these (base fs net ...); default: all that are built
#     --programs  only the programs, of which build/ must have Linux's: a picture's hash, a demo's counts, a server's dump
#
# Needs: apt-get install wine wine64 xvfb, and a Vulkan driver for Linux (lavapipe will do). Wine's own folder is
# build-windows/wine. What each test printed is in build-windows/log. Exit status 1 if something failed or differed.
set -euo pipefail

say() { echo "test.sh: $*" >&2; }
fail() { say "$*"; exit 1; }
usage() { sed -n '2,9s/^# \{0,1\}//p' "$0"; }

tests=yes programs=yes modules=()
while [[ $# -gt 0 ]]; do
  case $1 in
  --help | -h) usage; exit 0 ;;
  --tests) programs=no ;;
  --programs) tests=no ;;
  -*) say "unknown option '$1'"; usage >&2; exit 2 ;;
  *) modules+=("$1") ;;
  esac
  shift
done
cd "$(dirname "$0")/.."
command -v wine >/dev/null || fail "there is no wine: apt-get install wine wine64"
if [[ -z ${DISPLAY:-} ]] && command -v xvfb-run >/dev/null; then
  exec Misc/with_display.sh "$0" $([[ $tests == yes ]] || echo --programs) $([[ $programs == yes ]] || echo --tests) "${modules[@]}"
fi
out=$PWD/build-windows
mkdir -p "$out/log"
# Neither .NET nor a browser is installed into Wine's folder, and no desktop entries.
export WINEPREFIX=$out/wine WINEDEBUG=${WINEDEBUG:--all} WINEDLLOVERRIDES="mscoree,mshtml,winemenubuilder.exe="
# Paths of Linux are Wine's drive Z.
export FULLBRIGHT_TEST_DATA=${FULLBRIGHT_TEST_DATA:-}
status=0

# Tests that cannot pass here: "module:filter", each with its reason in Windows/README.md.
declare -A without=()
while read -r module filter _; do
  [[ -z $module || $module == \#* ]] || without[$module]+="${without[$module]:+:}$filter"
done <Windows/untested.txt

run_tests() {
  [[ ${#modules[@]} -gt 0 ]] || for program in "$out"/build/*_test.exe; do
    [[ -e $program ]] || fail "no test is built: Windows/build.sh --tests"
    modules+=("$(basename "$program" _test.exe)")
  done
  printf '%-10s %8s %8s %8s %9s\n' module passed failed skipped seconds
  for module in "${modules[@]}"; do
    local log=$out/log/$module.log begin=$SECONDS ended=0
    timeout 1200 wine "$out/build/${module}_test.exe" ${without[$module]:+--gtest_filter=-${without[$module]}} >"$log" 2>&1 || ended=$?
    printf '%-10s %8s %8s %8s %9s\n' "$module" "$(grep -c '^\[       OK ' "$log" || true)" \
      "$(grep -c '^\[  FAILED  \].* ms)' "$log" || true)" "$(grep -c '^\[  SKIPPED \].* ms)' "$log" || true)" $((SECONDS - begin))
    if [[ $ended != 0 ]]; then
      say "$module: exit status $ended, see build-windows/log/$module.log"
      status=1
    fi
  done
}

# same WHAT LINUX WINDOWS: two texts.
same() {
  if [[ -n $2 && $2 == "$3" ]]; then
    echo "$1: equal: $2"
  else
    echo "$1: DIFFERS: Linux has '$2', Windows '$3'"
    status=1
  fi
}

run_programs() {
  local folder=$out/fullbright
  [[ -e $folder/fullbright.exe ]] || fail "there is no build-windows/fullbright: Windows/build.sh"
  local lab=(render --quiet --hash --scene cbox --size 64x36 --spp 1)
  for estimator in pt nee; do
    same "hash of cbox by $estimator" \
      "$(build/fullbright-lab "${lab[@]}" --estimator $estimator 2>/dev/null | tr -d '\r' || true)" \
      "$(wine "$folder/fullbright-lab.exe" "${lab[@]}" --estimator $estimator 2>/dev/null | tr -d '\r' || true)"
  done
}

[[ $tests == no ]] || run_tests
[[ $programs == no ]] || run_programs
exit $status
