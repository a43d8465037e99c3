#!/usr/bin/env bash
# Compiles .map files into .bsp files beside them, with ericw-tools, which of Debian's releases only sid has: they are
# unpacked once into a folder of their own and run from there, so that nothing is installed.
set -euo pipefail

usage() {
  cat <<'TEXT'
usage: Misc/basegame/maps/compile.sh [--wad FILE] [--fast | --entities] [--keep] FILE.map ...
  --wad FILE  the textures; without it art/make.py makes them
  --fast      no visibility and no lightmaps: to look at a map while it is being made
  --entities  keeps FILE.bsp but for its entities, where nothing of brushes has changed: the rest stays bit for bit
  --keep      leaves the tools' files (FILE.log, .prt, .pts) in a folder that is named
PYTHON names a Python that has numpy (python3). ERICW_ROOT names where the tools are unpacked; by default ${XDG_CACHE_HOME:-~/.cache}/fullbright/ericw.
ERICW_MIRROR names the Debian mirror that sid is fetched from; by default the one that apt uses.
A map that leaks, lacks a texture or outgrows Quake's limits is an error. Beside FILE.bsp comes FILE.bsp.src, by which
check.py tells whether it is up to date.
TEXT
}

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
python=${PYTHON:-python3}
root=${ERICW_ROOT:-${XDG_CACHE_HOME:-$HOME/.cache}/fullbright/ericw}
wad="" fast=no entities=no keep=no maps=()
while [[ $# -gt 0 ]]; do
  case "$1" in
    --help | -h) usage; exit 0 ;;
    --wad) wad=${2:?compile.sh: --wad needs a file}; shift ;;
    --fast) fast=yes ;;
    --entities) entities=yes ;;
    --keep) keep=yes ;;
    -*) echo "compile.sh: unknown option '$1'; see --help" >&2; exit 2 ;;
    *) maps+=("$1") ;;
  esac
  shift
done
[[ ${#maps[@]} -gt 0 ]] || { usage >&2; exit 2; }

# Unpacks without installing: no package's scripts run. A mirror that stands still has an expired release file, whose
# signature is good all the same.
unpack_tools() {
  command -v mmdebstrap >/dev/null || { echo "compile.sh: needs Debian's mmdebstrap" >&2; exit 1; }
  # Sid lies on the mirror that serves this machine's own release.
  local mirror=${ERICW_MIRROR:-$(apt-get indextargets --format '$(REPO_URI) $(COMPONENT)' 'Created-By: Packages' |
    sed -n '/security/d; s/ main$//p' | head -1)}
  [[ -n $mirror ]] || { echo "compile.sh: apt's sources name no mirror; ERICW_MIRROR=URL does" >&2; exit 1; }
  echo "compile.sh: unpacking ericw-tools of Debian sid into $root"
  rm -rf "$root.part"
  mkdir -p "$(dirname "$root")"
  mmdebstrap --quiet --variant=extract --include=ericw-tools,libc6 --aptopt='Acquire::Check-Valid-Until "false"' \
    sid "$root.part" "$mirror"
  mv "$root.part" "$root"
}
[[ -d $root ]] || unpack_tools

libraries=$(dirname "$(find "$root/usr/lib" -maxdepth 2 -name 'libc.so.6' | head -1)")
loader=$(find "$libraries" -maxdepth 1 -name 'ld-linux*' | head -1)
[[ -n $loader ]] || { echo "compile.sh: no loader below $root/usr/lib; remove that folder and try again" >&2; exit 1; }
tool() { "$loader" --library-path "$libraries" "$root/usr/bin/ewtools-$1" "${@:2}"; }

work=$(mktemp -d)
[[ $keep == yes ]] && echo "compile.sh: the tools' files are in $work" || trap 'rm -rf "$work"' EXIT
if [[ -z $wad ]]; then
  "$python" "$here/../art/make.py" --out "$work/art" --only 'basegame.wad' >/dev/null
  wad=$(find "$work/art" -name basegame.wad | head -1)
fi
[[ -s $wad ]] || { echo "compile.sh: there is no wad '$wad'" >&2; exit 1; }
cp "$wad" "$work/basegame.wad"

# What each tool says goes to a file and is shown only where something is wrong.
step() {
  local log=$work/$1.log name=$1
  shift
  if ! "$@" >"$log" 2>&1; then
    tail -25 "$log" >&2
    echo "compile.sh: $name failed" >&2
    return 1
  fi
}

compile() {
  local map=$1 name bsp
  name=$(basename "$map" .map) bsp=${1%.map}.bsp
  [[ -r $map && $map == *.map ]] || { echo "compile.sh: '$map' is no readable .map" >&2; return 1; }
  cp "$map" "$work/$name.map"
  local qbsp_options=(-nolog -nopercent -noprogress -nocolor -leaktest -wadpath "$work" -noextendedsurfflags)
  local vis_options=(-nolog -nopercent -noprogress)
  # Lights fall off with the square of the distance; gamma keeps what lies between them from being black (glow.rad).
  local light_options=(-nolog -nopercent -noprogress -bounce 0 -gate 0.3 -gamma 2 -dirt 1 -emissivequality LOW
    -surflight_subdivide 512 -sunsamples 32)
  # Item boxes are models of their own and have no outside to be lit or seen from.
  local is_item=no
  [[ $name == b_* ]] && is_item=yes
  [[ $is_item == yes ]] && qbsp_options=("${qbsp_options[@]/-leaktest/-nofill}")
  if [[ $entities == yes ]]; then
    cp "$bsp" "$work/$name.bsp"
    qbsp_options+=(-onlyents)
  fi
  step qbsp tool qbsp "${qbsp_options[@]}" "$work/$name.map" "$work/$name.bsp" || {
    [[ -s $work/$name.pts ]] && "$python" "$here/leak.py" "$work/$name.pts" >&2
    return 1
  }
  if grep -E '^(WARNING|ERROR)' "$work/qbsp.log" | grep -v 'sides not found' >&2; then
    echo "compile.sh: $map: qbsp's warnings above" >&2
    return 1
  fi
  if [[ $fast == no && $entities == no ]]; then
    [[ $is_item == yes ]] || step vis tool vis "${vis_options[@]}" "$work/$name.bsp"
    # The laboratory's scenes are for the path tracer: no lightmaps.
    [[ $name == lab_* ]] || step light tool light "${light_options[@]}" -radlights "$here/glow.rad" "$work/$name.bsp"
  fi
  cp "$work/$name.bsp" "$bsp.part"
  mv "$bsp.part" "$bsp"
  # A quick one is not what belongs into the repository: without its sums check.py says so.
  [[ $fast == yes ]] && rm -f "$bsp.src" || "$python" "$here/check.py" --stamp "$map"
  echo "compile.sh: $(stat -c %s "$bsp") bytes $bsp"
}
for map in "${maps[@]}"; do compile "$map"; done
