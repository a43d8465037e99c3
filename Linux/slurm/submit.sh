#!/usr/bin/env bash
# Splits a suite, a reference or a render over a Slurm cluster: an array of N jobs, and one that joins what they made.
#
#   Linux/slurm/submit.sh -n N -o OUT [-s "SBATCH OPTIONS"] suite SUITE.json [options of `fullbright-lab suite`]
#   Linux/slurm/submit.sh -n N -o OUT [-s "SBATCH OPTIONS"] reference --map start --spp 65536 [options of `reference`]
#   Linux/slurm/submit.sh -n N -o OUT [-s "SBATCH OPTIONS"] render --demo demo1 --frames 0:999 --warmup 30 [options of `render`]
#
# OUT, a folder that all nodes see, gets shards/1 to N, logs/, and what is joined: results/ (suite), reference.exr or frames/.
# -s: whatever the cluster asks for, such as "--partition=gpu --gres=gpu:1 --time=4:00:00". -w waits until all is joined.
# FULLBRIGHT_LAB names the program (default: build/fullbright-lab). Submitted again into the same OUT, a suite and a reference go
# on where they ended.
set -euo pipefail

usage() { sed -n '2,/^set /{/^set /!s/^# \{0,1\}//p}' "$0"; }
fail() { echo "submit.sh: $1" >&2 && exit 2; }

count='' out='' options=() wait=()
while getopts 'n:o:s:wh' option; do
  case $option in
    n) count=$OPTARG ;;
    o) out=$OPTARG ;;
    s) read -ra options <<<"$OPTARG" ;;
    w) wait=(--wait) ;;
    h) usage && exit ;;
    *) usage >&2 && exit 2 ;;
  esac
done
shift $((OPTIND - 1))
[[ $count =~ ^[1-9][0-9]*$ ]] || fail "-n N is wanted: the number of shards"
[[ -n $out ]] || fail "-o OUT is wanted: a folder that all nodes see"
[[ $# -ge 1 ]] || fail "suite, reference or render is wanted, and its options"
command -v sbatch >/dev/null || fail "there is no sbatch: this machine is not of a Slurm cluster (Debian: slurm-client)"
lab=$(realpath -e "${FULLBRIGHT_LAB:-$(dirname "$0")/../../build/fullbright-lab}") || fail "there is no program; make it (make), or name it in FULLBRIGHT_LAB"
what=$1
shift

# Of a suite's options, those that suite-merge asks for again.
merge_options() {
  while [[ $# -gt 0 ]]; do
    case $1 in
      --experiments | --size | --repeats | --reference-samples | --set) printf '%s\0%s\0' "$1" "${2:-}" && shift ;;
      --experiments=* | --size=* | --repeats=* | --reference-samples=* | --set=*) printf '%s\0' "$1" ;;
    esac
    shift
  done
}

mkdir -p "$out/logs" "$out/shards"
out=$(realpath "$out")
shard=$out/shards/%SHARD%
case $what in
  suite)
    [[ $# -ge 1 && -f $1 ]] || fail "suite: the suite's file comes first"
    suite=$(realpath "$1")
    shift
    one=("$lab" suite "$suite" --out "$shard" --shard "%SHARD%/$count" --quiet "$@")
    mapfile -d '' kept < <(merge_options "$@")
    all=("$lab" suite-merge "$suite" %FOLDERS% --out "$out/results" "${kept[@]}")
    ;;
  reference)
    one=("$lab" reference "$@" --quiet --blocks "$shard" --out "$shard/unused.exr" --shard "%SHARD%/$count")
    all=("$lab" reference-merge %FOLDERS% --out "$out/reference.exr")
    ;;
  render)
    one=("$lab" render "$@" --quiet --out "$shard" --shard "%SHARD%/$count")
    all=("$lab" render-merge %FOLDERS% --out "$out/frames")
    ;;
  *) fail "$what: suite, reference or render is wanted" ;;
esac

# Commands as scripts, so that they can be read and run by hand.
{
  echo '#!/usr/bin/env bash'
  echo "$(printf '%q ' "${one[@]}")" | sed 's/%SHARD%/${SLURM_ARRAY_TASK_ID}/g'
} >"$out/shard.sh"
folders=()
for ((i = 1; i <= count; ++i)); do folders+=("$out/shards/$i"); done
joined=()
for word in "${all[@]}"; do
  if [[ $word == %FOLDERS% ]]; then joined+=("${folders[@]}"); else joined+=("$word"); fi
done
printf '#!/usr/bin/env bash\n%s\n' "$(printf '%q ' "${joined[@]}")" >"$out/merge.sh"

array=$(sbatch --parsable --job-name="fullbright-$what" --array="1-$count" --requeue --chdir="$PWD" \
  --output="$out/logs/shard-%a.txt" "${options[@]}" "$out/shard.sh")
echo "job ${array%%;*}: $count shards of $what into $out/shards"
sbatch --parsable "${wait[@]}" --job-name="fullbright-merge" --dependency="afterok:${array%%;*}" --kill-on-invalid-dep=yes \
  --chdir="$PWD" --output="$out/logs/merge.txt" "${options[@]}" "$out/merge.sh" >/dev/null ||
  fail "joining failed: $out/logs has what the jobs said"
[[ ${#wait[@]} -eq 0 ]] || cat "$out/logs/merge.txt"
