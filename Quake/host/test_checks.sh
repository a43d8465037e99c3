# For the shell's tests of the programs: check NAME CONDITION... says how it went; $failures counts what failed.
failures=0

check() {  # check NAME CONDITION...
  local name=$1
  shift
  if "$@"; then echo "ok: $name"; else
    echo "FAILED: $name"
    failures=$((failures + 1))
  fi
}
