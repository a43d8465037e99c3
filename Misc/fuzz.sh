#!/usr/bin/env bash
# `make fuzz`: builds every libFuzzer target and runs each for FUZZ_SECONDS. A module's *_make_seed_corpus program, built
# with them, writes seeds into build-asan/seeds/<target>/. Inputs that reach new code stay in build-asan/corpus/<target>,
# inputs that break a target in build-asan/crash/. usage: Misc/fuzz.sh [TARGET ...]
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${FUZZ_SECONDS:-60}
jobs=${JOBS:-$(nproc)}
dir=build-asan

cmake --preset asan-ubsan >/dev/null
targets=$(ninja -C $dir -t targets all | sed -n 's/^\(fuzz_[a-z0-9_]*\):.*/\1/p' | sort -u)
makers=$(ninja -C $dir -t targets all | sed -n 's/^\([a-z0-9_]*make_seed_corpus\):.*/\1/p' | grep -v "^cmake_" | sort -u || true)
[[ $# -eq 0 ]] || targets="$*"
if [[ -z $targets ]]; then
  echo "fuzz: no module has a fuzz target"
  exit 0
fi
ninja -C $dir $targets $makers

mkdir -p $dir/seeds $dir/crash
for maker in $makers; do "$dir/$maker" $dir/seeds; done
run_target() {  # run_target TARGET: its log, then one line of what it did
  local target=$1
  if ! timeout $((seconds + 120)) "$dir/$target" -max_total_time="$seconds" -rss_limit_mb=2048 -timeout=10 -print_final_stats=1 \
      -verbosity=0 -artifact_prefix="$dir/crash/$target-" "$dir/corpus/$target" "$dir/seeds/$target" >"$dir/$target.log" 2>&1; then
    tail -n 60 "$dir/$target.log"
    echo "$target: FAILED"
    return 1
  fi
  printf '%-28s %10s runs  %5s MB at most\n' "$target:" $(sed -n 's/^stat::number_of_executed_units: *//p; s/^stat::peak_rss_mb: *//p' "$dir/$target.log")
}
export -f run_target
export dir seconds
echo "== $(wc -w <<<"$targets") targets, each for $seconds s, $jobs at a time"
for target in $targets; do mkdir -p "$dir/corpus/$target" "$dir/seeds/$target"; done
if ! printf '%s\n' $targets | xargs -P "$jobs" -I{} bash -c 'run_target {}'; then
  echo "fuzz: a target failed; the inputs are in $dir/crash" >&2
  exit 1
fi
echo "fuzz: every target ran $seconds s clean"
