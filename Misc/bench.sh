#!/usr/bin/env bash
# `make bench`: runs every benchmark program of the release build, one after the other (two at once would disturb each
# other), and measures speed and error of every estimator on scenes in code (`light_SCENE`). Results are also written as
# JSON to out/bench. BENCH_FILTER is a regular expression for names. References are kept in out/bench/references.
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
Misc/bench_game.py "$out"
lab=build/fullbright-lab
estimators=$("$lab" estimators | cut -d' ' -f1 | paste -sd,)
for scene in one_light cbox strips candles many lava; do
  [[ light_$scene =~ ${BENCH_FILTER:-.} ]] || continue
  echo "== light_$scene"
  "$lab" bench --scene "$scene" --estimators "$estimators" --size 160x90 --frames 0:63 --warmup 100 --repeats 2 \
    --reference-spp 8192 --reference-dir "$out/references" --json "$out/light_$scene.json"
done
echo "the same as JSON is in $out"
