#!/usr/bin/env bash
# The two programs as their users run them: programs_test.sh BUILD_DIR. What needs game data is skipped, saying so, where
# there is none (FULLBRIGHT_TEST_DATA, else ../shared/librequake beside the sources).
set -uo pipefail
source "$(dirname "$0")/test_checks.sh"
export HOME=$scratch/home  # the player's own folder has no say
mkdir -p "$HOME"
unset XDG_DATA_HOME
fails_with() {  # fails_with TEXT COMMAND...: exits non-zero with one line on stderr that holds TEXT
  local text=$1 out
  shift
  if out=$("$@" 2>&1 >/dev/null); then return 1; fi
  [[ $out == *"$text"* && $(wc -l <<<"$out") -le 2 ]]
}

check "an unknown option is named" fails_with "-nonsense" "$build/fullbright" -nonsense
check "a launcher's options are taken" grep -q '^fullbright ' <<<"$("$build/fullbright" -nosound -heapsize 524288 -zone 4096 \
  -condebug -nolan -protocol 999 -fsaa 4 -version)"
check "headless without a command says what to give" fails_with "+timedemo" "$build/fullbright" -headless
check "missing data says what to give" fails_with "-basedir" "$build/fullbright" -headless -basedir "$scratch" +timedemo demo1
mkdir -p "$HOME/.fullbright/id1" && echo >"$HOME/.fullbright/id1/config.cfg"
check "and where settings are kept already" fails_with "-basedir" "$build/fullbright" -headless -basedir "$scratch" +timedemo demo1
rm -r "$HOME/.fullbright"
check "help" grep -q -- -capture_every <<<"$("$build/fullbright" --help)"
check "the laboratory's help" grep -q reference <<<"$("$build/fullbright-lab" --help)"
for wrong in abc nan inf 0 -1 1e9 0x10; do
  check "--spp $wrong is refused" fails_with "--spp $wrong: a whole number from 1 to 16777216 is wanted" \
    "$build/fullbright-lab" render --scene cbox --spp "$wrong"
done
check "--fps nan is refused" fails_with "--fps nan: a number from 0.1 to 10000 is wanted" "$build/fullbright-lab" render --scene cbox --fps nan
check "a span of frames that ends before it begins is told" fails_with "--frames 3:1: the last comes before the first" \
  "$build/fullbright-lab" render --scene cbox --frames 3:1
check "a camera that is nowhere is told how far it may be" fails_with "each from -1000000 to 1000000" \
  "$build/fullbright-lab" render --scene cbox --camera 1e30,0,0,0,0,0
check "no runs are refused" fails_with "--repeats 0: a whole number from 1 to 1000 is wanted" \
  "$build/fullbright-lab" suite nothing.json --out "$scratch/nothing" --repeats 0
check "a cvar's wrong value is refused with its reason" fails_with '--set r_spp=abc: r_spp: "abc" is not a number' \
  "$build/fullbright-lab" render --scene cbox --set r_spp=abc
check "an unknown scene names those there are" fails_with cbox "$build/fullbright-lab" render --scene nowhere

if [[ -e $data/id1/pak0.pak ]] && command -v fteqcc >/dev/null; then
  mkdir -p "$scratch/user/id1" && cp -r testdemos/rules "$scratch/rules"
  (cd "$scratch/rules" && fteqcc -O0 -Tstandard -srcfile progs.src >/dev/null 2>&1 && cp progs.dat "$scratch/user/id1/")
  serve() {  # serve FILE: ten minutes of a server's game, and its state
    timeout 300 "$build/fullbright" -dedicated 1 -port $((20000 + RANDOM)) -seed 1 -basedir "$data" -userdir "$scratch/user" \
      +host_framerate 0.05 +map start +sv_run 600 +sv_dump "$1" +quit >"$scratch/log" 2>&1 </dev/null
  }
  dedicated_repeats() {
    serve one.txt && serve two.txt && [[ $(wc -c <"$scratch/user/id1/one.txt") -gt 1000 ]] &&
      cmp "$scratch/user/id1/one.txt" "$scratch/user/id1/two.txt"
  }
  check "a dedicated server's game repeats" dedicated_repeats
  terminal_is_obeyed() {
    printf 'echo typed\nquit\n' | timeout 300 "$build/fullbright" -dedicated -port $((20000 + RANDOM)) -basedir "$data" \
      -userdir "$scratch/user" >"$scratch/log" 2>&1 && grep -q '^typed' "$scratch/log"
  }
  check "a dedicated server obeys its terminal" terminal_is_obeyed
  check "a player's configuration is nothing to a server" bash -c "! grep -q 'Unknown command\|valid key' '$scratch/log'"
  no_such_map() {  # no_such_map OPTION...: says so, and fails
    ! timeout 300 "$build/fullbright" "$@" -basedir "$data" -userdir "$scratch/user" +map nowhere +quit +echo behind \
      >"$scratch/log" 2>&1 </dev/null && grep -q 'maps/nowhere.bsp' "$scratch/log" && ! grep -q '^behind' "$scratch/log"
  }
  refused() {  # refused SENTENCE COMMAND...: a server does not do this, says why, goes on, and fails in the end
    local sentence=$1
    shift
    ! timeout 300 "$build/fullbright" -dedicated 1 -port $((20000 + RANDOM)) -seed 1 -basedir "$data" -userdir "$scratch/user" \
      +map start "$@" +echo behind +quit >"$scratch/log" 2>&1 </dev/null && grep -q "$sentence" "$scratch/log" && grep -q '^behind' "$scratch/log"
  }
  for wrong in inf nan abc -5 1e300; do
    check "sv_run $wrong is refused" refused "^error: sv_run $wrong: a number from 0 to 1000000000 is wanted" "+sv_run $wrong"
  done
  check "so is maxplayers x" refused '^error: maxplayers x: a whole number from 1 to 16 is wanted' "+maxplayers x"
  tiny_frames() {
    timeout 300 "$build/fullbright" -dedicated 1 -port $((20000 + RANDOM)) -seed 1 -basedir "$data" -userdir "$scratch/user" \
      +host_framerate 0.00000001 +map start +sv_run 1 +quit >"$scratch/log" 2>&1 </dev/null &&
      grep -q '^host_framerate: 0.00000001 is not allowed' "$scratch/log"
  }
  check "a run of tiny frames ends, and says what a frame is at least" tiny_frames
  check "a map that is none is an error of a server" no_such_map -dedicated 1 -port $((20000 + RANDOM))

  # What could not be written: a sentence and status 1, and what was there before stays.
  before=()
  server() {  # server ARGUMENT...: a dedicated server that shall end; its status
    "${before[@]}" timeout 300 "$build/fullbright" -dedicated 1 -port $((20000 + RANDOM)) -basedir "$data" -userdir "$scratch/user" "$@" \
      2>&1 </dev/null | cat >"$scratch/log"  # what limits the program's files does not limit the log
    return "${PIPESTATUS[0]}"
  }
  own=$scratch/user/id1
  server +map start +save good +sv_dump good.txt +quit
  check "what is written is no error" test $? -eq 0 -a -s "$own/good.sav" -a -s "$own/good.txt"
  cp "$own/good.sav" "$own/good.txt" "$scratch"
  unwritten() {  # unwritten CAUSE COMMAND ARGUMENT...: fails for this, goes on, and leaves what there was
    local cause=$1
    shift
    server +map start "$@" +echo went on +quit
    [[ $? -eq 1 && $(grep -c '^error: ' "$scratch/log") -eq 1 ]] && grep -q "^error: .*$cause" "$scratch/log" &&
      grep -q '^went on' "$scratch/log" && cmp "$own/good.sav" "$scratch/good.sav" && cmp "$own/good.txt" "$scratch/good.txt"
  }
  before=(bash -c 'trap "" XFSZ; ulimit -f 1; exec "$@"' bash)
  check "save to a full disk" unwritten "good.sav: .*File too large" +save good
  check "sv_dump to a full disk" unwritten "good.txt: .*File too large" +sv_dump good.txt
  before=()
  mkdir "$scratch/outside" && mv "$own/good.sav" "$own/good.txt" "$scratch/outside" && ln -s "$scratch/outside/good.sav" "$own" && ln -s ../../outside/good.txt "$own"
  check "no save by a link that leads out" unwritten "good.sav: .*a link leads out of the game's folder" +save good
  check "nor a dump" unwritten "good.txt: .*a link leads out of the game's folder" +sv_dump good
  rm "$own/good.sav" "$own/good.txt" && cp "$scratch/good.sav" "$scratch/good.txt" "$own"
  check "a failure stays one whatever follows" unwritten "file.txt/x.sav: .*Not a directory" +sv_dump file +save file.txt/x +save other +map start
  check "exec of a script that is none" unwritten "couldn't exec none.cfg" +exec none.cfg

  # A configuration that executes itself costs only itself.
  for loop in "exec autoexec.cfg" "exec other.cfg" "go" "runs"; do
    printf 'alias go "exec autoexec.cfg"\nalias runs "runs;runs"\n%s\necho the rest\n' "$loop" >"$own/autoexec.cfg"
    echo "exec autoexec.cfg" >"$own/other.cfg"
    goes_on() {
      server +map start +echo the line +quit && grep -q '^the line' "$scratch/log" && grep -q '^the rest' "$scratch/log" &&
        grep -q 'Server spawned' "$scratch/log" && [[ $(grep -c 'runs itself' "$scratch/log") -eq 1 ]]
    }
    check "a configuration with \"$loop\" in it goes on" goes_on
  done
  rm "$own/autoexec.cfg" "$own/other.cfg"

  # Data that is there and cannot be read.
  mkdir -p "$scratch/odd/id1/maps" && chmod 755 "$scratch" "$scratch/odd"
  ln -s "$scratch/gone.pak" "$scratch/odd/id1/pak0.pak"
  unreadable() {  # unreadable TEXT COMMAND...: ends with status 1 and one sentence with this text
    local text=$1
    shift
    "$@" timeout 300 "$build/fullbright" -dedicated 1 -port $((20000 + RANDOM)) -basedir "$scratch/odd" -userdir "$scratch/none" \
      +map mine +quit >"$scratch/log" 2>&1 </dev/null
    [[ $? -eq 1 && $(grep -c "$text" "$scratch/log") -eq 1 ]] && ! grep -q 'no such map' "$scratch/log"
  }
  check "a pak that is a link to nothing is named" unreadable "odd/id1/pak0.pak: cannot be read: it is a link to .*gone.pak" env
  rm "$scratch/odd/id1/pak0.pak" && ln -s nowhere.bsp "$scratch/odd/id1/maps/mine.bsp"
  check "so is a map" unreadable "^error: .*maps/mine.bsp: cannot be read: it is a link to nowhere.bsp" env
  as=(env)  # somebody whom permissions bind
  if [[ $(id -u) -eq 0 ]]; then as=(setpriv --reuid 65534 --clear-groups); fi
  if "${as[@]}" test -x "$build/fullbright" 2>/dev/null; then
    chmod 000 "$scratch/odd/id1"
    check "an id1 that may not be read is named" unreadable "odd/id1: cannot be read: Permission denied" "${as[@]}"
    chmod 755 "$scratch/odd/id1" && chmod 000 "$scratch/odd/id1/maps"
    check "so is a folder in it, at the start" unreadable "^warning: .*odd/id1/maps: cannot be read: Permission denied" "${as[@]}"
    chmod 755 "$scratch/odd/id1/maps"
  else
    echo "skipped: what may not be read, for nobody else can run $build/fullbright"
  fi
else
  echo "skipped: $([[ -e $data/id1/pak0.pak ]] && echo 'fteqcc is not installed (Linux/install-deps.sh test)' || echo "$lacks_data")"
fi

if ! "$build/fullbright" -listdevices >"$scratch/devices" 2>&1; then
  echo "skipped: no Vulkan device: $(cat "$scratch/devices")"
  exit $((failures > 0 ? 1 : 77))
fi
if [[ -e $data/id1/pak0.pak && -e $scratch/user/id1/progs.dat ]]; then
  check "a map that is none is an error without a window" no_such_map -headless -size 16x16
  : >"$scratch/user/id1/screenshots"
  unshown() {
    timeout 300 "$build/fullbright" -headless -size 16x16 -basedir "$data" -userdir "$scratch/user" +viewmap start +wait "$@" +quit \
      >"$scratch/log" 2>&1
    [[ $? -eq 1 && $(grep -c '^error: .*Not a directory' "$scratch/log") -eq 1 ]]
  }
  check "a screenshot that could not be written is an error" unshown +screenshot
  check "so is a demo" unshown +record screenshots/demo start
  check "and where nothing else is to be done" bash -c "! timeout 300 '$build/fullbright' -headless -size 16x16 -basedir '$data' \
    -userdir '$scratch/user' +map nowhere >'$scratch/log' 2>&1"
fi
ends_with_one_sentence() {  # ends_with_one_sentence TEXT COMMAND...: exit status 1, and one line on stderr, which holds TEXT
  local text=$1 status out
  shift
  out=$("$@" 2>&1 >/dev/null </dev/null)
  status=$?
  [[ $status -eq 1 && $out == *"$text"* && $(wc -l <<<"$out") -eq 1 ]] || { echo "exit status $status: $out" && false; }
}
game() { timeout 300 "$build/fullbright" -headless -userdir "$scratch/user" "$@"; }
if [[ -d $build/game/id1 || -d $data/id1 ]]; then
  basedir=$build/game
  [[ -d $basedir/id1 ]] || basedir=$data
  check "a size that the device does not allow is an error" ends_with_one_sentence "a picture of 16384x16384 needs a buffer of" \
    game -basedir "$basedir" -size 16384x16384 +map start +quit
  # However little address space there is, from too little for the driver (but enough for the program and its libraries)
  # to what a game takes: one sentence or a game.
  starved() {
    local kilobytes status
    for ((kilobytes = 150000; kilobytes < 6000000; kilobytes = kilobytes * 5 / 4)); do
      (ulimit -v $kilobytes && game -basedir "$basedir" -size 64x36 +map start +wait +quit) >"$scratch/log" 2>"$scratch/starved" </dev/null
      status=$?
      [[ $status -eq 0 || ($status -eq 1 && $(grep -vc '^warning' "$scratch/starved") -eq 1) ]] ||
        { echo "ulimit -v $kilobytes: exit status $status" && cat "$scratch/log" "$scratch/starved" && return 1; }
    done
    [[ $status -eq 0 ]]
  }
  # Not under sanitizers, which want terabytes of addresses.
  if (ulimit -v 6000000 && "$build/fullbright" -version) >/dev/null 2>&1; then check "a start with little memory ends with one sentence" starved; fi
fi
# `game` with and without a window's parts: the commands behind it go on in the other folder, behind its configuration.
mkdir -p "$scratch/two/id1/maps" "$scratch/two/other" && cp Misc/basegame/maps/b_bh25.bsp "$scratch/two/id1/maps/"
printf 'echo "others configuration"\ngame other\nsv_friction 3\n' >"$scratch/two/other/autoexec.cfg"
in_two() { timeout 300 "$build/fullbright" "$@" >"$scratch/log" 2>"$scratch/errors" </dev/null; }
two=(-size 16x16 -port $((20000 + RANDOM)) -userdir "$scratch/user_of_two" -basedir "$scratch/two")
goes_on() {  # goes_on OPTION...
  local status
  in_two "$@" "${two[@]}" +sv_gravity 555 +sv_friction 7 +alias greet "echo greetings; game; wait; sv_gravity; sv_friction" \
    +game other +greet +wait +game id1 +game +quit +echo beyond
  status=$?
  [[ $status -eq 0 && "$(grep -o '^others configuration\|^"game" is.*\|^greetings\|^"sv_gravity" is "555"\|^"sv_friction" is "3"\|^beyond' "$scratch/log")" == \
'others configuration
"game" is "other" already
greetings
"game" is "other"
"sv_gravity" is "555"
"sv_friction" is "3"
"game" is "id1"' ]] || { echo "exit status $status" && cat "$scratch/log" "$scratch/errors" && false; }
}
fails_before() {  # fails_before OPTION...: what failed in the first folder is the exit status of all
  in_two "$@" "${two[@]}" +map nowhere +game nofolder +game other +echo goes on +quit
  [[ $? -eq 1 ]] && grep -q 'game nofolder: there is no such game folder' "$scratch/errors" && grep -q '^goes on' "$scratch/log"
}
ends_there() { in_two -headless "${two[@]}" +echo here +game other && grep -q '^here' "$scratch/log"; }
typed_goes_on() {
  printf 'echo typed\ngame other\necho on\ngame\nquit\n' | timeout 300 "$build/fullbright" -dedicated "${two[@]}" >"$scratch/log" 2>&1 &&
    grep -q '^"game" is "other"' "$scratch/log"
}
for mode in -dedicated -headless; do
  check "$mode: commands behind \`game\` go on, with cvars and aliases" goes_on $mode
  check "$mode: a failure before \`game\` is not forgotten" fails_before $mode
done
check "a program without a window ends at a last \`game\`" ends_there
check "a terminal's commands behind \`game\` go on" typed_goes_on
check "and of the laboratory" ends_with_one_sentence "a picture of 16384x16384 needs a buffer of" \
  "$build/fullbright-lab" render --quiet --scene cbox --size 16384x16384
check "a device would be chosen" grep -q '^\* 0\|^\* [0-9]' "$scratch/devices"

lab=$build/fullbright-lab
"$lab" reference --quiet --scene cbox --size 48x27 --spp 32 --out "$scratch/r.exr" >"$scratch/log" 2>&1
for run in 1 2 3 4 5 6 7 8; do
  "$lab" render --quiet --scene cbox --size 48x27 --set r_seed=$run --format exr --out "$scratch/run$run" >>"$scratch/log" 2>&1
done
check "compare takes a reference's variance off and gives intervals" grep -q '^  mse_corrected .* \[.*\]$' <<<"$(
  "$lab" compare "$scratch/r.exr" "$scratch"/run?/frame_000000.exr)"
check "compare writes over nothing that it compares" fails_with "it is compared, so nothing is written over it" \
  "$lab" compare "$scratch/r.exr" "$scratch/run1/frame_000000.exr" --json "$scratch/r.exr"
check "compare's JSON" grep -q '"flip_hdr"' <<<"$("$lab" compare "$scratch/r.exr" "$scratch/run1/frame_000000.exr" --json -)"
latin=$scratch/$'caf\xe9.exr'
cp "$scratch/r.exr" "$latin"
"$lab" compare "$latin" "$scratch/run1/frame_000000.exr" --no-flip --json "$scratch/latin.json" >>"$scratch/log"
check "JSON that names a file in Latin-1 is UTF-8" python3 -c "import json, sys; \
  assert json.load(open(sys.argv[1], encoding='utf-8'))['reference'].endswith('caf\ufffd.exr')" "$scratch/latin.json"
"$lab" bench --quiet --scene cbox --size 48x27 --frames 0:5 --warmup 2 --repeats 2 --reference-spp 64 --estimators pt \
  --config four:r_spp=4 --json "$scratch/bench.json" --csv "$scratch/bench.csv" >"$scratch/bench" 2>>"$scratch/log"
check "bench's exit status" test $? -eq 0
check "bench tells the gain" grep -q '^    equal time of the estimator ' "$scratch/bench"
check "bench's JSON has times" grep -q '"gpu_ms_median"' "$scratch/bench.json"
check "bench's CSV has a line a frame" test "$(grep -c . "$scratch/bench.csv")" -eq 33
check "bench to standard output is JSON alone" grep -q '^{$' <<<"$("$lab" bench --quiet --scene cbox --size 8x8 --frames 0:1 \
  --reference-spp 32 --json - | head -1)"
check "bench tells that two runs have no interval" grep -q '^95% intervals want 8 runs; there are 2: --repeats 8' "$scratch/bench"
"$lab" iterate --quiet --scene cbox --size 24x16 --schedule 1,1,2 --repeats 2 --reference-spp 64 --estimators pt,mcpg \
  --json "$scratch/iterate.json" --out "$scratch/iterated_" >"$scratch/iterate" 2>>"$scratch/log"
check "iterate's exit status" test $? -eq 0
check "iterate tells the gain" grep -q '^    relMSE, equal time of the estimator ' "$scratch/iterate"
check "iterate's JSON has all runs and their samples" python3 -c "import json, sys; i = json.load(open(sys.argv[1])); \
  assert i['samples'] == 4 and [len(c['runs']['mse']) for c in i['configurations']] == [2, 2]" "$scratch/iterate.json"
check "iterate writes a picture of each" test -s "$scratch/iterated_pt.exr" -a -s "$scratch/iterated_mcpg.exr"
check "iterate says what a schedule is" fails_with "--schedule 1,0: samples a pixel of each iteration are wanted" \
  "$lab" iterate --scene cbox --schedule 1,0
check "a scene in code is seen from --camera" test "$(for camera in 32,32,32,0,0,0 32,32,32,-60,90,0; do "$lab" render --quiet --scene cbox \
  --size 16x9 --estimator nee --camera $camera --hash --out "$scratch/camera" | sort -u; done | sort -u | wc -l)" -eq 2
check "--camera is read for it, too" fails_with "--camera 0,0,0: six numbers" "$lab" render --scene cbox --camera 0,0,0
check "a reference is an .exr file" fails_with "no.png: a reference is an .exr file" "$lab" reference --scene cbox --out "$scratch/no.png"
check "what a setting would be is not told where it is refused" bash -c "! '$lab' render --scene cbox --set r_bounces=-1 2>&1 | grep 'so it is'"
check "an error of 0 is refused" fails_with "--error 0: a number from 1e-06 to 10 is wanted" \
  "$lab" reference --scene cbox --error 0 --out "$scratch/no.exr"
check "bench tells that a reference is of another view" grep -q 'is of `--scene cbox`, and this view is `--scene lava`' <<<"$(
  "$lab" bench --quiet --scene lava --size 48x27 --frames 0:1 --repeats 1 --reference "$scratch/r.exr" 2>&1)"
check "and is silent where it is of this one" bash -c "! '$lab' bench --quiet --scene cbox --size 48x27 --frames 0:1 --repeats 1 \
  --reference '$scratch/r.exr' 2>&1 | grep 'this view is'"
check "ztest of what is black is no result" fails_with "nothing was tested" \
  "$lab" ztest --scene cbox --size 8x8 --estimator pt --set r_bounces=0 --runs 4 --frames 1
check "bench refuses a cvar that is not the renderer's" fails_with "no cvar" "$lab" bench --scene cbox --config a:b=1
# The judge with programs of its own, one of them in the role of an older one that writes one format at a time.
cat >"$scratch/suite.json" <<'END'
{"views": [{"name": "box", "scene": "cbox", "frames": [2, 3], "warmup": 2},
  {"name": "absent", "map": "start", "data": "librequake", "frames": [0, 1]}]}
END
printf '#!/bin/sh\n[ "$2" = --help ] && "%s" "$@" | sed s/,both// || exec "%s" "$@"\n' "$lab" "$lab" >"$scratch/older"
chmod +x "$scratch/older"
judge() {
  "$lab" picture "$scratch/suite.json" --quiet --librequake "$scratch/nowhere" --references "$scratch/references" --size 32x18 \
    --reference-spp 64 --seeds 2 "$@"
}
judge --binary "older=$scratch/older" --estimators pt --pictures "$scratch/pictures" --json "$scratch/picture.json" \
  >"$scratch/picture" 2>>"$scratch/log"
check "picture's exit status" test $? -eq 0
check "picture skips what is not there and says so" grep -q '^absent: skipped, there is no LibreQuake' "$scratch/picture"
check "picture judges programs beside each other" test "$(grep -c '^  pt  *0\|^  pt@older  *0' "$scratch/picture")" -eq 2
check "and both have the same tone curve" test "$(grep -c 'tone curve' "$scratch/picture")" -eq 0
check "pt's pictures are the same by both" python3 -c "import json, sys; a, b = json.load(open(sys.argv[1]))['views'][0]['configurations']; \
  assert a['relmse'] == b['relmse'] and a['flip'] == b['flip'] and a['relmse']['value'] > 0" "$scratch/picture.json"
check "picture's pictures" test -s "$scratch/pictures/box.png"
check "picture keeps its references" test "$(find "$scratch/references" -name '*.exr' | wc -l)" -eq 1
check "picture names a program that is none" fails_with "$scratch/none: cannot be started" judge --binary "none=$scratch/none"
check "picture says why a program failed" fails_with "no such estimator" judge --estimators nowhere
check "compare names the file that it cannot read" fails_with absent.exr "$lab" compare "$scratch/r.exr" "$scratch/absent.exr"

# An item box as a map: nothing of it gives light.
mkdir -p "$scratch/unlit/id1/maps" && cp Misc/basegame/maps/b_bh25.bsp "$scratch/unlit/id1/maps/"
echo '{ "classname" "worldspawn" }' >"$scratch/unlit/id1/maps/b_bh25.ent"
unlit() {  # unlit FILE ARGUMENTS...: its hash, and what was said
  "$lab" render --quiet --hash --basedir "$scratch/unlit" --map b_bh25 --camera=-40,-40,60,25,45,0 --size 32x18 "${@:2}" \
    >"$scratch/$1" 2>&1 && grep '^frame' "$scratch/$1" >"$scratch/$1.hash"
}
unlit plain && unlit none --set r_ambient=0 && unlit as_asked --set r_ambient=-1 && unlit painted --set r_ambient=1
measures_what_paths_find() {
  cmp "$scratch/plain.hash" "$scratch/none.hash" && ! cmp -s "$scratch/plain.hash" "$scratch/as_asked.hash" &&
    cmp "$scratch/as_asked.hash" "$scratch/painted.hash" && ! grep -q 'even light' "$scratch/plain"
}
check "a map without any light is dark in the laboratory, unless asked" measures_what_paths_find
"$build/fullbright" -headless -userdir "$scratch/user" -basedir "$scratch/unlit" -size 16x16 +viewmap b_bh25 +quit >"$scratch/log" 2>&1
check "in the game it is shown in an even light, and one line says so" test "$(grep -c 'even light' "$scratch/log")" -eq 1

# The page of maps without a window: item boxes are none of them. Another room is, which shows that the page is seen.
maps_page() {  # maps_page FOLDER: its picture, of the first frame that has the page
  "$build/fullbright" -headless -userdir "$scratch/pages" -basedir "$scratch/$1" -size 320x200 +r_deterministic 1 +r_bounces 0 +viewmap start \
    +menu_maps +wait +screenshot "$1" +quit >"$scratch/log" 2>&1
}
for folder in rooms boxes more; do
  mkdir -p "$scratch/$folder/id1/maps" && echo >"$scratch/$folder/id1/progs.dat"  # so that the base game is not searched
  cp Misc/basegame/maps/start.bsp "$scratch/$folder/id1/maps/"
done
cp Misc/basegame/maps/b_*.bsp "$scratch/boxes/id1/maps/"
cp Misc/basegame/maps/start.bsp "$scratch/more/id1/maps/again.bsp"
shows_rooms_alone() {
  maps_page rooms && maps_page boxes && maps_page more && cmp "$scratch/pages/id1/screenshots/rooms.png" "$scratch/pages/id1/screenshots/boxes.png" &&
    ! cmp -s "$scratch/pages/id1/screenshots/rooms.png" "$scratch/pages/id1/screenshots/more.png"
}
check "the page of maps without a window leaves item boxes out" shows_rooms_alone

if [[ ! -e $data/id1/pak0.pak ]]; then
  echo "skipped: $lacks_data"
  exit $((failures > 0 ? 1 : 77))
fi

"$build/fullbright" -headless -userdir "$scratch/user" -basedir "$data" -size 32x18 -capture "$scratch/frames" -capture_every 400 \
  +r_bounces 0 +timedemo demo3 +quit >"$scratch/timedemo" 2>&1
check "timedemo's exit status" test $? -eq 0
check "timedemo prints QuakeSpasm's count" grep -Eq '^1232 frames +[0-9.]+ seconds +[0-9.]+ fps$' "$scratch/timedemo"
check "timedemo reports the passes' times" grep -q '^gpu ms a frame: .*gbuffer' "$scratch/timedemo"
check "and from input to picture" grep -Eq "^ms a frame: [0-9.]+, of these [0-9.]+ the host.s alone; input to picture [0-9.]+$" "$scratch/timedemo"
check "frames are written" test "$(find "$scratch/frames" -name 'frame_*.png' | wc -l)" -ge 4
check "a cvar without effect is none of the laboratory's" fails_with "no effect here" "$build/fullbright-lab" render --quiet \
  --basedir "$data" --map start --set gl_clear=1 --frames 0:0 --size 8x8
check "a frame beyond the demo's end is an error" fails_with "there is no frame" "$build/fullbright-lab" render --quiet --basedir "$data" \
  --demo testdemos/fight.dem --frames 9000:9000 --size 8x8 --set r_bounces=0
if ((failures)); then cat "$scratch/timedemo"; fi
exit $((failures > 0 ? 1 : 0))
