#!/usr/bin/env bash
# `make fuzz`: builds every libFuzzer target and runs each for FUZZ_SECONDS, from three folders of inputs: the seeds that a
# module's *_make_seed_corpus program writes, what is kept in the repository (Misc/fuzz_corpus.py), and what reached new
# code in former runs, which stays in FUZZ_CORPUS (~/.cache/fullbright/corpus), whatever becomes of the build. Inputs that
# break a target are left in build-asan/crash/. The targets of whole programs read a game's files from FULLBRIGHT_FUZZ_GAME
# (build/game, which `make` makes), and are left out where there is none.
# usage: Misc/fuzz.sh [--keep] [TARGET ...]     --keep: then add to the repository what was found that it lacks
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${FUZZ_SECONDS:-60}
jobs=${JOBS:-$(nproc)}
dir=build-asan
corpus=${FUZZ_CORPUS:-${XDG_CACHE_HOME:-$HOME/.cache}/fullbright/corpus}
export FULLBRIGHT_FUZZ_GAME=${FULLBRIGHT_FUZZ_GAME:-$PWD/build/game}
keep=
if [[ ${1:-} == --keep ]]; then keep=yes; shift; fi

cmake --preset asan-ubsan >/dev/null
targets=$(ninja -C $dir -t targets all | sed -n 's/^\(fuzz_[a-z0-9_]*\):.*/\1/p' | sort -u)
makers=$(ninja -C $dir -t targets all | sed -n 's/^\([a-z0-9_]*make_seed_corpus\):.*/\1/p' | grep -v "^cmake_" | sort -u || true)
[[ $# -eq 0 ]] || targets="$*"
if [[ ! -f $FULLBRIGHT_FUZZ_GAME/id1/progs.dat ]]; then
  echo "fuzz: no game in $FULLBRIGHT_FUZZ_GAME: the targets of whole programs are left out"
  targets=$(printf '%s\n' $targets | grep -v '^fuzz_whole_' || true)
fi
if [[ -z $targets ]]; then
  echo "fuzz: no module has a fuzz target"
  exit 0
fi
ninja -C $dir $targets $makers

mkdir -p $dir/seeds $dir/crash
for maker in $makers; do "$dir/$maker" $dir/seeds; done
rm -rf $dir/kept
Misc/fuzz_corpus.py unpack $dir/kept
run_target() {  # run_target TARGET: its log, then one line of what it did
  local target=$1
  if ! timeout $((seconds + 120)) "$dir/$target" -max_total_time="$seconds" -rss_limit_mb=2048 -timeout=10 -print_final_stats=1 \
      -verbosity=0 -artifact_prefix="$dir/crash/$target-" "$corpus/$target" "$dir/seeds/$target" "$dir/kept/$target" >"$dir/$target.log" 2>&1; then
    tail -n 60 "$dir/$target.log"
    echo "$target: FAILED"
    return 1
  fi
  printf '%-28s %10s runs  %5s MB at most\n' "$target:" $(sed -n 's/^stat::number_of_executed_units: *//p; s/^stat::peak_rss_mb: *//p' "$dir/$target.log")
}
export -f run_target
export dir seconds corpus
echo "== $(wc -w <<<"$targets") targets, each for $seconds s, $jobs at a time"
for target in $targets; do mkdir -p "$corpus/$target" "$dir/seeds/$target" "$dir/kept/$target"; done
if ! printf '%s\n' $targets | xargs -P "$jobs" -I{} bash -c 'run_target {}'; then
  echo "fuzz: a target failed; the inputs are in $dir/crash" >&2
  exit 1
fi
echo "fuzz: every target ran $seconds s clean"
if [[ $keep ]]; then
  for target in $targets; do Misc/fuzz_corpus.py keep "$dir/$target" "$dir/seeds/$target" "$corpus/$target"; done
fi
