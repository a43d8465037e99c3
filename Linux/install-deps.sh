#!/usr/bin/env bash
# Names the missing Debian packages that Fullbright needs, and installs them. Does not ask, and does nothing if none is
# missing, so that every make may call it. Tested on Debian 12 and 13; Ubuntu's packages have the same names.
set -euo pipefail

usage() {
  cat <<'TEXT'
usage: Linux/install-deps.sh [--dry-run] [--quiet] [GROUP ...]
  build     what compiles the game, the laboratory and their tests, what makes the base game, and a Vulkan driver to run
            them (the default)
  test      build, and what the tests run with: validation layers, a virtual X server, QuakeSpasm to
            compare with
  bench     build, and what the benchmarks compare against
  fuzz      build, and clang with libFuzzer
  coverage  test, and gcovr
  report    what `fullbright-lab report` draws with, and the browser that its test looks at it with
  check     what checks the source text: clang-format, clang-tidy, python3
  maps      what compiles the base game's maps anew (they are kept compiled)
  platforms what makes fresh roots of other Debian releases
  package   what makes a .deb of a build
  slurm     what tests Linux/slurm: a Slurm cluster of this machine alone
  outside   Blender, whose Cycles judges references (testdemos/outside)
  all       every group
  --dry-run say what would be installed, install nothing
  --quiet   say nothing where nothing is missing
TEXT
}

packages_of() {
  case "$1" in
    build)
      echo g++ make cmake ninja-build pkg-config ccache glslang-tools libvulkan-dev mesa-vulkan-drivers libsdl2-dev \
        libglm-dev libfmt-dev libpng-dev libsndfile1-dev libopenmpt-dev libopenexr-dev libfftw3-dev libxxhash-dev libzip-dev libcli11-dev libimgui-dev nlohmann-json3-dev libgtest-dev libgmock-dev python3 python3-numpy fteqcc \
        vorbis-tools ;;
    test) packages_of build; echo vulkan-validationlayers xvfb xauth xdotool xclip imagemagick ffmpeg python3 fteqcc quakespasm ;;
    bench) packages_of build; echo libbenchmark-dev libembree-dev python3 fteqcc ;;
    fuzz) packages_of build; echo clang libclang-rt-dev lld llvm ;;
    coverage) packages_of test; echo gcovr ;;
    report) echo python3-numpy python3-matplotlib chromium ;;
    check) echo clang-format clang-tidy python3 ;;
    maps) echo mmdebstrap python3 python3-numpy ;;
    platforms) echo mmdebstrap git ;;
    package) packages_of build; echo dpkg-dev file git ;;
    slurm) echo slurm-wlm munge python3-numpy ;;
    outside) echo blender python3-numpy ;;
    all) for group in test bench fuzz coverage report check maps platforms package slurm outside; do packages_of "$group"; done ;;
    *) echo "install-deps.sh: unknown group '$1'; see --help" >&2; return 2 ;;
  esac
}

dry_run=no quiet=no groups=()
for argument in "$@"; do
  case "$argument" in
    --help | -h) usage; exit 0 ;;
    --dry-run) dry_run=yes ;;
    --quiet) quiet=yes ;;
    -*) echo "install-deps.sh: unknown option '$argument'; see --help" >&2; exit 2 ;;
    *) groups+=("$argument") ;;
  esac
done
[[ ${#groups[@]} -gt 0 ]] || groups=(build)

wanted=""
for group in "${groups[@]}"; do wanted+=" $(packages_of "$group")"; done
wanted=$(printf '%s\n' $wanted | sort -u)

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  echo "install-deps.sh: this system has no apt; install by its own means what Debian calls:" $wanted >&2
  exit 0
fi

installed=$(dpkg-query -W -f='${db:Status-Status} ${Package}\n' 2>/dev/null | sed -n 's/^installed //p' | sort -u)
missing=$(comm -23 <(printf '%s\n' "$wanted") <(printf '%s\n' "$installed"))
if [[ -z $missing ]]; then
  [[ $quiet == yes ]] || echo "install-deps.sh: nothing is missing for: ${groups[*]}"
  exit 0
fi

echo "install-deps.sh: will install" $missing "(and what they depend on)"
[[ $dry_run == no ]] || exit 0

as_root=()
if [[ $(id -u) -ne 0 ]]; then
  if ! command -v sudo >/dev/null; then
    echo "install-deps.sh: installing packages takes root; run this as root, or install sudo" >&2
    exit 1
  fi
  as_root=(sudo)
fi
apt() { "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -o Dpkg::Use-Pty=0 -o DPkg::Lock::Timeout=300 "$@" </dev/null; }

# Package lists are fetched only if they lack the packages, or list versions that the mirror no longer has.
install() { apt install --yes --no-install-recommends $missing; }
if apt install --simulate --no-install-recommends $missing >/dev/null 2>&1 && install; then exit 0; fi
apt update || echo "install-deps.sh: some package lists could not be fetched; trying with the others" >&2
install
