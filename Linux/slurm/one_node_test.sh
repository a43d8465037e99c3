#!/usr/bin/env bash
# submit.sh on a Slurm cluster of this machine alone: split in three, a suite, a reference and a render give what they give
# whole. Starts munged, slurmctld and slurmd of its own in a scratch folder, and ends them. Exit status 77, skipped: no Slurm
# (Debian: slurm-wlm, munge), or not root, as whom the daemons run here.
#
#   Linux/slurm/one_node_test.sh BUILD
set -euo pipefail
here=$(realpath "$(dirname "$0")")
build=$(realpath "$1")
for program in munged slurmctld slurmd sbatch; do
  command -v $program >/dev/null || { echo "skipped: there is no $program (Debian: slurm-wlm, munge)" && exit 77; }
done
[[ $(id -u) -eq 0 ]] || { echo "skipped: Slurm's daemons of this test run as root" && exit 77; }

scratch=$(mktemp -d)
stop() {
  for pid in "$scratch"/*.pid; do [[ -e $pid ]] && kill "$(cat "$pid")" 2>/dev/null; done
  sleep 1
  rm -rf "$scratch"
}
trap stop EXIT
export FULLBRIGHT_LAB=$build/fullbright-lab SLURM_CONF=$scratch/slurm.conf
mkdir "$scratch/state" "$scratch/spool"
head -c 1024 /dev/urandom >"$scratch/munge.key" && chmod 400 "$scratch/munge.key"
munged --force --socket="$scratch/munge.socket" --key-file="$scratch/munge.key" --log-file="$scratch/munge.log" \
  --pid-file="$scratch/munge.pid" --seed-file="$scratch/munge.seed" 2>/dev/null
# Ports that are free tell two tests of one machine apart.
read -r port other < <(/usr/bin/python3 -c 'import socket
pair = [socket.socket() for _ in range(2)]
for s in pair: s.bind(("", 0))
print(*[s.getsockname()[1] for s in pair])')
cat >"$SLURM_CONF" <<END
ClusterName=one
SlurmctldHost=$(hostname)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$scratch/munge.socket
CryptoType=crypto/munge
StateSaveLocation=$scratch/state
SlurmdSpoolDir=$scratch/spool
SlurmctldPidFile=$scratch/ctld.pid
SlurmdPidFile=$scratch/d.pid
SlurmctldLogFile=$scratch/ctld.log
SlurmdLogFile=$scratch/d.log
SlurmctldPort=$port
SlurmdPort=$other
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
NodeName=$(hostname) CPUs=2 State=UNKNOWN
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP
END
slurmctld && slurmd
idle=false
for ((i = 0; i < 30; ++i)); do
  sinfo --noheader --states=idle 2>/dev/null | grep -q . && idle=true && break
  sleep 1
done
$idle || { echo "skipped: Slurm does not start here" && tail -n 5 "$scratch"/*.log && exit 77; }

failures=0
check() {
  if "${@:2}" >"$scratch/log" 2>&1; then echo "ok: $1"; else echo "FAILED: $1" && cat "$scratch/log" && failures=$((failures + 1)); fi
}
submit() { timeout 240 "$here/submit.sh" -w -n 3 "$@"; }
same_errors() {
  /usr/bin/python3 - "$@" <<'END'
import json
import sys
whole, joined = (json.load(open(path + "/results.json")) for path in sys.argv[1:])
errors = [[[p["errors"] for p in e["points"]] for e in r["experiments"]] for r in (whole, joined)]
assert errors[0] == errors[1] and joined["complete"] and errors[0][0], errors
END
}
same_pictures() {  # their lines of text differ
  PYTHONPATH=$here/../../Misc/python /usr/bin/python3 - "$@" <<'END'
import pathlib
import sys
from fullbright_lab import exr
a, b = (exr.read(pathlib.Path(path))[0] for path in sys.argv[1:])
assert set(a) == set(b) and "variance.G" in a, (set(a), set(b))
for name in a:
    assert (a[name] == b[name]).all(), name
END
}
cat >"$scratch/suite.json" <<'END'
{"title": "Two boxes", "size": [24, 16], "repeats": 2, "reference_samples": 32,
 "configurations": {"pt": {"r_estimator": "pt", "r_deterministic": 1}},
 "experiments": [{"name": "box", "view": {"name": "box", "scene": "cbox", "frames": [2, 3], "warmup": 0},
   "vary": {"what": "samples", "setting": "r_spp", "values": [1, 2]}}]}
END
lab=$FULLBRIGHT_LAB
"$lab" suite "$scratch/suite.json" --quiet --out "$scratch/whole" >/dev/null
check "a suite is submitted and joined" submit -o "$scratch/suite" suite "$scratch/suite.json"
check "and has the errors of the whole" same_errors "$scratch/whole" "$scratch/suite/results"
view=(--scene "many:20" --size 24x16 --set r_seed=3)
"$lab" reference "${view[@]}" --quiet --spp 1024 --out "$scratch/whole.exr" >/dev/null
check "a reference is submitted and joined" submit -o "$scratch/reference" reference "${view[@]}" --spp 1024
check "and is the whole to the bit" same_pictures "$scratch/whole.exr" "$scratch/reference/reference.exr"
"$lab" render "${view[@]}" --quiet --frames 0:6 --format exr --out "$scratch/frames" >/dev/null
check "a render is submitted and joined" submit -o "$scratch/render" render "${view[@]}" --frames 0:6 --format exr
check "and has the frames of the whole" diff -r "$scratch/frames" "$scratch/render/frames"
check "a shard that fails is told" bash -c '! "$@"' _ "$here/submit.sh" -w -n 2 -o "$scratch/bad" render --scene nowhere --frames 0:3
check "with its words in its log" grep -q nowhere "$scratch/bad/logs/shard-1.txt"
exit $((failures > 0))
