#!/usr/bin/env bash
# Runs a command of the sanitized build: every error ends it, and leaks that are the Vulkan driver's are not ours.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)

# The loader unloads drivers and layers before leaks are looked for, and then no suppression finds their names. A dlclose
# that closes nothing keeps them (later loaders have VK_LOADER_DISABLE_DYNAMIC_LIBRARY_UNLOADING for that, Debian 12's has
# not).
keep=$here/../build-asan/keep_loaded.so
if [[ ! -f $keep ]]; then
  mkdir -p "$(dirname "$keep")"
  echo 'extern "C" int dlclose(void*) { return 0; }' | c++ -x c++ -shared -fPIC -o "$keep.$$" -
  mv "$keep.$$" "$keep"
fi
export LD_PRELOAD="$keep${LD_PRELOAD:+:$LD_PRELOAD}"

# verify_asan_link_order: the preloaded library comes before the sanitizer's own and takes nothing from it.
export ASAN_OPTIONS="detect_leaks=1:strict_string_checks=1:detect_stack_use_after_return=1:check_initialization_order=1\
:verify_asan_link_order=0${ASAN_OPTIONS:+:$ASAN_OPTIONS}"
export LSAN_OPTIONS="suppressions=$here/lsan.supp:print_suppressions=0${LSAN_OPTIONS:+:$LSAN_OPTIONS}"
export UBSAN_OPTIONS="print_stacktrace=1:halt_on_error=1${UBSAN_OPTIONS:+:$UBSAN_OPTIONS}"
exec "$@"
