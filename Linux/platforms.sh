#!/usr/bin/env bash
# `make platforms`: tests each Debian release that the README names as on a new user's machine: it makes a fresh
# installation with nothing but apt and make, copies the sources into it, and runs the README's `make demo` there. Each
# release must build without this machine's packages, and write frames. Not part of .ci/run: two builds from nothing
# would double its time.
set -euo pipefail

usage() {
  cat <<'TEXT'
usage: Linux/platforms.sh [--keep] [RELEASE ...]
  RELEASE   Debian's codename: bookworm (12), trixie (13); default: both
  --keep    leave each root in out/platforms/RELEASE/root, to look around in
The log and the demo's frames of a release are in out/platforms/RELEASE. Needs mmdebstrap; as another user than root, user namespaces.
PLATFORMS_MIRROR=URL takes Debian's packages from there, instead of from the mirror of this machine's own apt.
TEXT
}

keep=no releases=()
for argument in "$@"; do
  case "$argument" in
    --help | -h) usage; exit 0 ;;
    --keep) keep=yes ;;
    -*) echo "platforms.sh: unknown option '$argument'; see --help" >&2; exit 2 ;;
    *) releases+=("$argument") ;;
  esac
done
[[ ${#releases[@]} -gt 0 ]] || releases=(bookworm trixie)
cd "$(dirname "$0")/.."
command -v mmdebstrap >/dev/null || { echo "platforms.sh: needs Debian's mmdebstrap (Linux/install-deps.sh platforms)" >&2; exit 1; }

mirror=${PLATFORMS_MIRROR:-$(apt-get indextargets --format '$(REPO_URI) $(COMPONENT)' 'Created-By: Packages' |
  sed -n '/security/d; s/ main$//p' | head -1)}
[[ -n $mirror ]] || { echo "platforms.sh: apt's sources name no mirror; PLATFORMS_MIRROR=URL does" >&2; exit 1; }

# Tracked files, and new ones that are not ignored: the tree as it would be committed now.
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
git ls-files --cached --others --exclude-standard -z |
  while IFS= read -r -d '' file; do [[ ! -e $file ]] || printf '%s\0' "$file"; done |
  tar --null --no-recursion --files-from=- --create --file "$scratch/sources.tar"

# Builds and plays in an installation of one release. mmdebstrap mounts /proc and /dev for its hooks, and unmounts them.
try_release() {
  local release=$1 out=$PWD/out/platforms/$1 target=(/dev/null --format=null)
  rm -rf "$out"
  mkdir -p "$out"
  [[ $keep == no ]] || target=("$out/root" --format=directory)
  mmdebstrap --variant=apt --include=make "$release" "${target[@]}" "$mirror" --skip=cleanup/apt,cleanup/tmp \
    --customize-hook="upload '$scratch/sources.tar' /sources.tar" \
    --customize-hook='chroot "$1" sh -c "mkdir /fullbright && tar -C /fullbright --no-same-owner -xf /sources.tar"' \
    --customize-hook='chroot "$1" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root make -C /fullbright demo' \
    --customize-hook="sync-out /fullbright/out/demo '$out'" >"$out/log" 2>&1 || return 1
  compgen -G "$out/*.png" >/dev/null || { echo "platforms.sh: the demo left no frames" >>"$out/log"; return 1; }
}

failed=()
for release in "${releases[@]}"; do
  start=$SECONDS
  echo "platforms.sh: $release: a fresh root, make demo (log: out/platforms/$release/log)"
  if try_release "$release"; then
    printf 'platforms.sh: %s: passed in %d s: %s\n' "$release" $((SECONDS - start)) \
      "$(grep -aE '^[0-9]+ frames +[0-9.]+ seconds' "out/platforms/$release/log" | tail -1)"
  else
    failed+=("$release")
    tail -40 "out/platforms/$release/log" >&2
    printf 'platforms.sh: %s: FAILED after %d s\n' "$release" $((SECONDS - start)) >&2
  fi
done
[[ ${#failed[@]} -eq 0 ]]
