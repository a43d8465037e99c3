// What a frame's later passes do only where some pixel needs it (shared/work.h).
#ifndef FB_LIB_WORK
#define FB_LIB_WORK
#include "lib/frame_bindings.glsl"
#include "shared/work.h"

// `blocks`: that are worked on in a row. Every pixel that asks writes the same.
void ask_for(uint kind, uint blocks) { counters.at[work_word(kind, frame.work_parity)] = (blocks + 7u) / 8u; }
bool asked_for(uint kind) { return counters.at[work_word(kind, frame.work_parity)] != 0u; }
bool was_asked_for(uint kind) { return counters.at[work_word(kind, 1u - frame.work_parity)] != 0u; }
#endif
