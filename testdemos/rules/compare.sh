#!/usr/bin/env bash
# Plays script.cfg on LibreQuake's lq_e0m1 by these rules, here and in Debian's quakespasm, and says how far apart the
# players were (fullbright-lab track); then each engine plays the demo that the other recorded. Exits with 77 where
# something that it needs is absent, having said what.
#
#   testdemos/rules/compare.sh BUILD BASEDIR      BASEDIR holds id1 with LibreQuake's paks
set -euo pipefail
if [[ $# -ne 2 || $1 == --help ]]; then
  sed -n '2,7s/^# \?//p' "$0"
  exit 2
fi
build=$(cd "$1" && pwd) data=$(cd "$2" 2>/dev/null && pwd || echo "$2") here=$(cd "$(dirname "$0")" && pwd)
export PATH=$PATH:/usr/games
skip() { echo "skipped: $*"; exit 77; }
[[ -d $data/id1 ]] || skip "there is no game data in $data"
command -v fteqcc >/dev/null || skip "fteqcc is not installed"

work=$(mktemp -d)
# quakespasm writes below the home that the system knows, whatever HOME says.
game=$(basename "$work") written=$(getent passwd "$(id -u)" | cut -d: -f6)/.quakespasm/$(basename "$work")
trap 'rm -rf "$work" "$written"' EXIT
mkdir -p "$work/base/$game"
ln -s "$data/id1" "$work/base/id1"
cp "$here"/*.qc "$here/progs.src" "$work/base/$game"
(cd "$work/base/$game" && fteqcc -Tstandard -O0 -srcfile progs.src >compile.log 2>&1) || { cat "$work/base/$game/compile.log"; exit 1; }
printf 'host_maxfps 72\nhost_framerate 0.05\n' >"$work/base/$game/autoexec.cfg"
{ cat "$here/script.cfg"; echo quit; } >"$work/base/$game/walk.cfg"

ours() { "$build/fullbright" -basedir "$work/base" -userdir "$work/user" -game "$game" -headless -size 64x36 "$@"; }
# Runs quakespasm until it prints the line, or what it records has not grown for 15 seconds (a script's end may leave it
# in a menu, where the game stands still), and ends it. theirs LINE LOG ARGUMENT...
theirs() {
  local line=$1 log=$2 size=0 before=0 still=0
  shift 2
  SDL_AUDIODRIVER=dummy timeout -s KILL 300 xvfb-run -a stdbuf -oL quakespasm -basedir "$work/base" -game "$game" -window \
    -width 320 -height 240 -nojoy "$@" >"$log" 2>&1 &
  for _ in $(seq 280); do
    if grep -q "$line" "$log" || ! kill -0 $! 2>/dev/null || ((still > 15)); then break; fi
    size=$({ cat "$written"/*.dem 2>/dev/null || true; } | wc -c)
    if [[ $line == *Completed* ]] && ((size > 0 && size == before)); then ((++still)); else still=0; fi
    before=$size
    sleep 1
  done
  pkill -KILL -f "quakespasm -basedir $work/base" || true
  wait 2>/dev/null || true
}

ours +record ours lq_e0m1 +exec walk.cfg >"$work/ours.log" 2>&1 || { tail -20 "$work/ours.log"; exit 1; }
our_demo=$(find "$work" -name ours.dem)
[[ -n $our_demo ]] || { tail -20 "$work/ours.log"; echo "no demo was recorded"; exit 1; }
"$build/fullbright-lab" track "$our_demo"
command -v quakespasm >/dev/null && command -v xvfb-run >/dev/null || skip "quakespasm and xvfb are not installed; nothing was compared"

theirs '^Completed demo' "$work/theirs.log" +record theirs lq_e0m1 +exec walk.cfg
their_demo=$(find "$written" -name theirs.dem)
[[ -n $their_demo ]] || { tail -20 "$work/theirs.log"; echo "quakespasm recorded no demo"; exit 1; }
"$build/fullbright-lab" track "$our_demo" "$their_demo" --shift 20

# Each plays what the other recorded, to its end and with as many frames as what it recorded itself.
cp "$our_demo" "$their_demo" "$work/base/$game"
our_frames() { ours +timedemo "$1" +quit 2>&1 | sed -n 's/^\([0-9]*\) frames .*fps.*/\1/p'; }
their_frames() {
  # r_norefresh: drawing 400 frames by software OpenGL takes minutes and is not needed.
  theirs ' frames .*fps' "$work/timedemo.log" +r_norefresh 1 +timedemo "$1"
  sed -n 's/^ *\([0-9]*\) frames .*fps.*/\1/p' "$work/timedemo.log"
}
for demo in ours theirs; do
  here_count=$(our_frames $demo) there_count=$(their_frames $demo)
  echo "$demo.dem: $here_count frames here, $there_count in quakespasm"
  [[ -n $here_count && $here_count == "$there_count" ]] || exit 1
done
