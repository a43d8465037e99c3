#!/usr/bin/env bash
# `make bench`: every benchmark program of the release build, one after the other (two at once would measure each
# other), each also as JSON in out/bench. BENCH_FILTER is a regular expression of names.
set -euo pipefail
cd "$(dirname "$0")/.."
out=out/bench
mkdir -p "$out"
found=no
for program in build/*_bench; do
  [[ -x $program ]] || continue
  found=yes
  name=$(basename "$program" _bench)
  echo "== $name"
  "$program" --benchmark_filter="${BENCH_FILTER:-.}" --benchmark_out="$out/$name.json" --benchmark_out_format=json
done
if [[ $found == no ]]; then
  echo "make bench: build/ holds no benchmark program; Google Benchmark was missing when it was configured" >&2
  exit 1
fi
echo "the same as JSON is in $out"
