#!/usr/bin/env bash
# With r_deterministic a picture does not depend on the driver's threads: repeats_test.sh BUILD_DIR. Demos of game data are
# skipped, saying so, where there is none (FULLBRIGHT_TEST_DATA, else ../shared/librequake beside the sources).
set -uo pipefail
source "$(dirname "$0")/test_checks.sh"

if ! "$build/fullbright" -listdevices >"$scratch/devices" 2>&1; then
  echo "skipped: no Vulkan device: $(cat "$scratch/devices")"
  exit 77
fi
hashes() {  # hashes THREADS ARGUMENTS...
  LP_NUM_THREADS=$1 "$build/fullbright-lab" render --quiet --hash "${@:2}" | grep '^frame'
}
same_with_any_threads() {
  hashes 1 "$@" >"$scratch/one" && hashes 2 "$@" >"$scratch/two" && hashes 2 "$@" >"$scratch/again" &&
    [[ -s $scratch/one ]] && cmp "$scratch/one" "$scratch/two" && cmp "$scratch/two" "$scratch/again"
}
check "pictures repeat with one thread and two" same_with_any_threads --scene moving --frames 0:5 --size 96x54
# Two runs of 60 frames with one worker thread and with two (of lavapipe; 0 would be the calling thread alone).
repeats() {  # [also=ESTIMATOR] repeats ARGUMENTS...
  local estimator threads
  for estimator in mcpg_nee nee ${also:-}; do
    for threads in 1 2; do
      hashes $threads --estimator $estimator --set r_deterministic=1 --frames 0:59 --size 64x36 "$@" >"$scratch/$estimator$threads"
    done
    [[ $(grep -c . "$scratch/${estimator}1") -eq 60 ]] && cmp "$scratch/${estimator}1" "$scratch/${estimator}2" || return 1
  done
  ! cmp -s "$scratch/mcpg_nee1" "$scratch/nee1"
}
also=restir_guided  # reservoirs of both kinds, and what is learnt of them
check "60 frames of what learns repeat with one thread and two" repeats --scene moving
also=
differs_when_racing() {  # what r_deterministic is for: without it the order of two threads shows, or this test sees nothing
  hashes 2 --estimator mcpg --frames 0:59 --size 64x36 --scene moving >"$scratch/racing" &&
    ! cmp -s "$scratch/racing" <(hashes 2 --estimator mcpg --frames 0:59 --size 64x36 --scene moving)
}
if (($(nproc) > 1)); then check "without r_deterministic they do not" differs_when_racing; fi
check "another cvar, another picture" bash -c "! cmp -s '$scratch/one' <(LP_NUM_THREADS=1 '$build/fullbright-lab' render --quiet \
  --hash --scene moving --frames 0:5 --size 96x54 --set r_bounces=1 | grep '^frame')"

if [[ ! -e $data/id1/pak0.pak ]]; then
  echo "skipped: $lacks_data"
  exit $((failures > 0 ? 1 : 77))
fi
check "a demo repeats with one thread and two" same_with_any_threads --basedir "$data" --demo testdemos/fight.dem --frames 60:63 --size 96x54
check "60 frames of a fight repeat with one thread and two" repeats --basedir "$data" --demo testdemos/fight.dem
check "60 frames of demo1 repeat with one thread and two" repeats --basedir "$data" --demo demo1
exit $((failures > 0 ? 1 : 0))
