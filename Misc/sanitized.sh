#!/usr/bin/env bash
# Runs a command of the sanitized build: every error ends it, and leaks of the Vulkan driver are ignored.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)

# The Vulkan loader unloads drivers and layers before the search for leaks, and suppressions cannot match their names then.
# A preloaded dlclose that does nothing keeps them loaded (Debian 12's loader lacks
# VK_LOADER_DISABLE_DYNAMIC_LIBRARY_UNLOADING, which later ones have).
keep=$here/../build-asan/keep_loaded.so
if [[ ! -f $keep ]]; then
  mkdir -p "$(dirname "$keep")"
  echo 'extern "C" int dlclose(void*) { return 0; }' | c++ -x c++ -shared -fPIC -o "$keep.$$" -
  mv "$keep.$$" "$keep"
fi
export LD_PRELOAD="$keep${LD_PRELOAD:+:$LD_PRELOAD}"

# verify_asan_link_order=0: the preloaded library is loaded before the sanitizer's own, which does no harm.
export ASAN_OPTIONS="detect_leaks=1:strict_string_checks=1:detect_stack_use_after_return=1:check_initialization_order=1\
:verify_asan_link_order=0${ASAN_OPTIONS:+:$ASAN_OPTIONS}"
export LSAN_OPTIONS="suppressions=$here/lsan.supp:print_suppressions=0${LSAN_OPTIONS:+:$LSAN_OPTIONS}"
export UBSAN_OPTIONS="print_stacktrace=1:halt_on_error=1${UBSAN_OPTIONS:+:$UBSAN_OPTIONS}"
exec "$@"
