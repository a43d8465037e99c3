#!/usr/bin/env bash
# Tries a package as on a new machine: fresh_root.sh DEB [RELEASE]. Makes a fresh installation of a release of Debian
# (default: this machine's), installs the package there by apt with what it recommends, and plays a demo through the
# path tracer. Needs mmdebstrap; as another user than root, user namespaces. PLATFORMS_MIRROR=URL takes Debian's
# packages from there.
set -euo pipefail

[[ $# -ge 1 && -f $1 ]] || { sed -n '2,5s/^# //p' "$0" >&2; exit 2; }
deb=$(realpath "$1")
release=${2:-$(. /etc/os-release && echo "$VERSION_CODENAME")}
command -v mmdebstrap >/dev/null || { echo "fresh_root.sh: needs Debian's mmdebstrap (Linux/install-deps.sh platforms)" >&2; exit 1; }
mirror=${PLATFORMS_MIRROR:-$(apt-get indextargets --format '$(REPO_URI) $(COMPONENT)' 'Created-By: Packages' |
  sed -n '/security/d; s/ main$//p' | head -1)}
log=$(mktemp)
trap 'rm -f "$log"' EXIT
said='env -i PATH=/usr/bin:/bin HOME=/root'
if mmdebstrap --variant=apt "$release" /dev/null --format=null "$mirror" --skip=cleanup/apt,cleanup/tmp \
  --customize-hook="upload '$deb' /fullbright.deb" \
  --customize-hook='chroot "$1" env DEBIAN_FRONTEND=noninteractive apt-get install --install-recommends --yes /fullbright.deb' \
  --customize-hook="chroot \"\$1\" $said fullbright -listdevices" \
  --customize-hook="chroot \"\$1\" $said fullbright -headless -size 64x36 +timedemo hub" \
  --customize-hook="chroot \"\$1\" $said fullbright-lab render --scene cbox --size 32x18 --out /drawn" \
  --customize-hook='test -s "$1/drawn/frame_000000.exr" -o -s "$1/drawn/frame_000000.png"' >"$log" 2>&1 &&
  frames=$(grep -aE '^[0-9]+ frames +[0-9.]+ seconds' "$log" | tail -1) && [[ -n $frames ]]; then
  echo "fresh_root.sh: $release: installed and played: $frames"
else
  tail -40 "$log" >&2
  echo "fresh_root.sh: $release: FAILED" >&2
  exit 1
fi
