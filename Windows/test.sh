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
status=0

# Tests that cannot pass here: "module:filter", each with its reason in Windows/README.md.
declare -A without=()
while read -r module filter _; do
  [[ -z $module || $module == \#* ]] || without[$module]+="${without[$module]:+:}$filter"
done <Windows/untested.txt

# same WHAT LINUX WINDOWS: two texts.
same() {
  if [[ -n $2 && $2 == "$3" ]]; then
    echo "$1: equal: $2"
  else
    echo "$1: DIFFERS: Linux has '$2', Windows '$3'"
    status=1
  fi
}

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
  # A server with players, under packets of all kinds: what it did, but for seconds and bytes of memory.
  local flood=(300000) counts='/^strangers\|^players/p'
  [[ -x build/packet_flood && -e $out/build/packet_flood.exe ]] || return 0
  same "a server under ${flood[0]} packets" "$(build/packet_flood "${flood[@]}" 2>&1 | sed -n "$counts")" \
    "$(wine "$out/build/packet_flood.exe" "${flood[@]}" 2>&1 | tr -d '\r' | sed -n "$counts")"
}

# linux PROGRAM ARGUMENTS...; windows PROGRAM ARGUMENTS...: what the program prints.
linux() { timeout 600 "build/$1" "${@:2}" 2>>"$out/log/linux.log" </dev/null | tr -d '\r' || true; }
windows() { timeout 600 wine "$out/fullbright/$1.exe" "${@:2}" 2>>"$out/log/windows.log" </dev/null | tr -d '\r' || true; }

run_programs() {
  [[ -e $out/fullbright/fullbright.exe ]] || fail "there is no build-windows/fullbright: Windows/build.sh"
  local scratch
  scratch=$(mktemp -d)
  trap 'rm -rf "'"$scratch"'"' EXIT
  mkdir -p "$scratch"/{linux,windows}/id1
  : >"$out/log/linux.log"
  : >"$out/log/windows.log"
  local lab=(fullbright-lab render --quiet --hash --size 64x36 --basedir build/game)
  for view in "--scene cbox" "--map lab_cbox"; do
    for estimator in pt nee; do
      same "picture, $view, $estimator" "$(linux "${lab[@]}" $view --estimator $estimator)" \
        "$(windows "${lab[@]}" $view --estimator $estimator)"
    done
  done

  # A game played by script, and its demo: what the server said is in it to the byte.
  local game=(fullbright -headless -size 16x9 -seed 1 -basedir build/game +r_estimator pt +r_bounces 0 +host_framerate 0.1)
  for system in linux windows; do
    cat >"$scratch/$system/id1/script.cfg" <<'CFG'
alias w4 "wait;wait;wait;wait"
alias w20 "w4;w4;w4;w4;w4"
+forward
w20
+attack
w20
changelevel lab_plain
w20
stop
save script
quit
CFG
    $system "${game[@]}" -userdir "$scratch/$system" "+record" "script" "lab_cbox" +exec script.cfg >"$scratch/$system/record.txt"
  done
  same "a recorded game's bytes" "$(sha256sum <"$scratch/linux/id1/script.dem" | cut -c1-16)" \
    "$(sha256sum <"$scratch/windows/id1/script.dem" | cut -c1-16)"
  same "its save, but for the time" "$(tr -d '\r' <"$scratch/linux/id1/script.sav" | sha256sum | cut -c1-16)" \
    "$(tr -d '\r' <"$scratch/windows/id1/script.sav" | sha256sum | cut -c1-16)"
  for demo in script cbox; do
    local frames=()
    for system in linux windows; do
      frames+=("$($system "${game[@]}" -userdir "$scratch/$system" +timedemo $demo +quit | sed -n 's/^\([0-9]* frames\) .*/\1/p')")
    done
    same "timedemo $demo" "${frames[@]}"
  done
}

[[ $tests == no ]] || run_tests
[[ $programs == no ]] || run_programs
exit $status
