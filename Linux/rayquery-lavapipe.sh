#!/usr/bin/env bash
# Unpacks a lavapipe with ray query into a folder of its own, without changing the system's Mesa, and prints the
# environment variables that make a program use it. Debian 12's Mesa (22.3) has no ray tracing; Debian's backports have
# 25.0, on the mirror that this machine's apt already uses. Debian 13's own Mesa has ray query, so nothing is done there.
#
#   usage: Linux/rayquery-lavapipe.sh DIR     then: env $(Linux/rayquery-lavapipe.sh DIR) build/fullbright ...
#
# Only the variables (or nothing) go to standard output. A DIR that already has a driver is not changed.
set -euo pipefail

say() { echo "rayquery-lavapipe.sh: $*" >&2; }
fail() { say "$*"; exit 1; }

[[ $# -eq 1 && $1 != -* ]] || { sed -n '2,8s/^# \{0,1\}//p' "$0" >&2; exit 2; }
mkdir -p "$1"
dir=$(cd "$1" && pwd)

print_environment() {
  echo "LD_LIBRARY_PATH=$1"
  echo "VK_ICD_FILENAMES=$dir/icd.json"
  echo "VK_DRIVER_FILES=$dir/icd.json"
}

system_mesa=$(dpkg-query -W -f='${Version}' mesa-vulkan-drivers 2>/dev/null || true)
if [[ -n $system_mesa ]] && dpkg --compare-versions "$system_mesa" ge 24.1; then
  say "the system's Mesa $system_mesa has ray query in lavapipe already; nothing to set"
  exit 0
fi
if [[ -f $dir/icd.json ]]; then
  print_environment "$(dirname "$(sed -n 's/.*"library_path": *"\([^"]*\)".*/\1/p' "$dir/icd.json")")"
  exit 0
fi

codename=$(. /etc/os-release && echo "${VERSION_CODENAME:-}")
[[ $codename == bookworm ]] || fail "knows Debian 12 (bookworm) and systems with Mesa 24.1 or later, not '$codename'"

# apt itself reports the mirror of the release, whatever the format of its sources.
mirror=$(apt-get indextargets --format '$(REPO_URI) $(RELEASE) $(COMPONENT)' 'Created-By: Packages' |
  sed -n "s/ $codename main\$//p" | head -n 1)
[[ -n $mirror ]] || fail "apt's sources name no mirror of $codename main"

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir -p "$scratch/lists/partial" "$scratch/cache/archives/partial" "$scratch/parts"
keyring=/usr/share/keyrings/debian-archive-keyring.gpg
options=""
[[ ! -f $keyring ]] || options="[signed-by=$keyring] "
echo "deb $options$mirror $codename-backports main" >"$scratch/sources.list"
# Separate lists and caches, so that the system's are neither read nor changed. APT::Sandbox: the scratch folder
# belongs to the user who runs this, not to apt's own user.
backports() {
  apt-get -q -o Dir::Etc::sourcelist="$scratch/sources.list" -o Dir::Etc::sourceparts="$scratch/parts" \
    -o Dir::Etc::preferencesparts="$scratch/parts" -o Dir::State::lists="$scratch/lists" \
    -o Dir::Cache="$scratch/cache" -o APT::Sandbox::User="$(id -un)" -o Acquire::Languages=none \
    -o Acquire::Retries=3 "$@" >&2 </dev/null
}
backports update || fail "could not fetch the list of $codename-backports from the machine's own mirror"
cd "$scratch"
backports download mesa-vulkan-drivers libdrm2 libdrm-amdgpu1 libdrm-common ||
  fail "could not download Mesa from $codename-backports"
for package in ./*.deb; do dpkg -x "$package" "$dir"; done
cd /

library=$(find "$dir/usr/lib" -name libvulkan_lvp.so | head -n 1)
[[ -n $library ]] || fail "the package has no lavapipe for this machine's architecture"
folder=$(dirname "$library")
lacking=$(LD_LIBRARY_PATH=$folder ldd "$library" | sed -n 's/^[[:space:]]*\(.*\) => not found.*/\1/p')
[[ -z $lacking ]] ||
  fail "the driver lacks" $lacking "(install the system's mesa-vulkan-drivers first: Linux/install-deps.sh build)"

cat >"$scratch/icd.json" <<JSON
{ "file_format_version": "1.0.0", "ICD": { "library_path": "$library", "api_version": "1.3.0" } }
JSON
mv "$scratch/icd.json" "$dir/icd.json"
say "Mesa $(basename "$(ls "$scratch"/mesa-vulkan-drivers_*.deb)" | cut -d_ -f2) stands in $dir"
print_environment "$folder"
