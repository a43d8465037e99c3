# For the shell's tests of the programs, which are called with the build's folder: $build, $data (LibreQuake's), $scratch (a
# folder of the test's own); check NAME CONDITION... says how it went, and $failures counts what failed.
build=$1
data=${FULLBRIGHT_TEST_DATA:-../shared/librequake}
lacks_data="no LibreQuake in $data: FULLBRIGHT_TEST_DATA names the folder that holds its id1/pak0.pak"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export XDG_CACHE_HOME=${XDG_CACHE_HOME:-${HOME-/tmp}/.cache}  # shaders stay compiled
failures=0

check() {  # check NAME CONDITION...
  local name=$1
  shift
  if "$@"; then echo "ok: $name"; else
    echo "FAILED: $name"
    failures=$((failures + 1))
  fi
}
