#!/usr/bin/env bash
# A config.cfg that Debian's quakespasm wrote runs here without a word: quakespasm_config_test.sh BUILD_DIR. Its own
# cvarlist must name nothing that is not here either, and LibreQuake's default.cfg, which is written for several
# engines, runs without unknown commands. Exits with 77 where something that it needs is absent, having said
# what.
set -uo pipefail
build=$1
data=${FULLBRIGHT_TEST_DATA:-../shared/librequake}
export PATH=$PATH:/usr/games
skip() { echo "skipped: $*"; exit 77; }
[[ -e $data/id1/pak0.pak ]] || skip "no LibreQuake in $data: FULLBRIGHT_TEST_DATA names the folder that holds its id1/pak0.pak"
command -v quakespasm >/dev/null && command -v xvfb-run >/dev/null || skip "quakespasm or xvfb is not installed (Linux/install-deps.sh test)"
"$build/fullbright" -listdevices >/dev/null 2>&1 || skip "there is no Vulkan device"

work=$(mktemp -d)
# quakespasm writes below the home that the system knows, whatever HOME says.
game=$(basename "$work") written=$(getent passwd "$(id -u)" | cut -d: -f6)/.quakespasm/$(basename "$work")
trap 'rm -rf "$work" "$written"' EXIT
mkdir -p "$work/base/$game" "$work/user/$game"
ln -s "$(cd "$data" && pwd)/id1" "$work/base/id1"
# The game's own default.cfg is for other engines, too, and would give warnings.
printf 'stuffcmds\n' >"$work/base/$game/quake.rc"
printf 'bind w +forward\nbind MOUSE1 +attack\nbind JOY1 +jump\nbind ABUTTON +jump\nbind LTRIGGER +jump\n' >"$work/base/$game/keys.cfg"

(cd "$work" && SDL_AUDIODRIVER=dummy timeout -s KILL 120 xvfb-run -a quakespasm -basedir "$work/base" -game "$game" -window -width 320 \
  -height 240 +exec keys.cfg +volume 0.25 +gamma 0.9 +cvarlist +quit >"$work/theirs.log" 2>&1)
[[ -s $written/config.cfg ]] || { tail "$work/theirs.log"; echo "quakespasm wrote no config.cfg"; exit 1; }
grep -q '^volume "0.25"' "$written/config.cfg" || { echo "quakespasm wrote another config.cfg"; exit 1; }
cp "$written/config.cfg" "$work/base/$game"

ours() { timeout 300 "$build/fullbright" -basedir "$work/base" -userdir "$work/user" -game "$game" -headless -size 16x16 "$@"; }
failures=0
ours +exec config.cfg +volume +gamma +bindlist +quit >"$work/ours.log" 2>&1 || failures=1
grep -q '^"volume" is "0.25"' "$work/ours.log" || { echo "FAILED: a cvar keeps what the configuration says"; failures=1; }
if grep -n 'Unknown command\|valid key\|not allowed\|is not a number\|no cvar\|read-only' "$work/ours.log"; then
  echo "FAILED: what quakespasm writes runs without a word"
  failures=1
fi
# "*  name "value"" of cvarlist, each asked for here.
sed -n 's/^[* ][ s] \([a-z_][a-z_0-9]*\) ".*"$/\1/p' "$work/theirs.log" >"$work/names"
count=$(grep -c . "$work/names")
((count > 200)) || { echo "FAILED: quakespasm listed $count cvars"; failures=1; }
cp "$work/names" "$work/base/$game/names.cfg"
ours +exec names.cfg +quit >"$work/ours.log" 2>&1 || failures=1
if grep -n 'Unknown command' "$work/ours.log"; then
  echo "FAILED: all of quakespasm's cvars are here"
  failures=1
fi
# The game's own quake.rc and default.cfg, which name things of several engines.
timeout 300 "$build/fullbright" -basedir "$data" -userdir "$work/user" -headless -size 16x16 +lq_toggle_style +quit >"$work/ours.log" 2>&1 || failures=1
grep -q '^execing default.cfg' "$work/ours.log" || { echo "FAILED: the game's default.cfg runs"; failures=1; }
if grep -n "Unknown command\|valid key" "$work/ours.log"; then
  echo "FAILED: the game's own configuration runs without unknown commands"
  failures=1
fi
((failures)) && { tail -50 "$work/ours.log"; exit 1; }
echo "ok: a config.cfg of quakespasm's, and its $count cvars"
