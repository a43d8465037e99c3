// The block and the arrays of ReSTIR's techniques, and which pixels reuse.
#ifndef FB_RESTIR_ARRAYS_GLSL
#define FB_RESTIR_ARRAYS_GLSL
#include "estimators/restir/steps/light_sample.glsl"
#include "lib/pixel.glsl"

FB_TECHNIQUE_ARRAY(kRestirReservoirs, 16, , ReservoirArray, uvec4, reservoirs)
FB_TECHNIQUE_ARRAY(kRestirMerged, 16, , MergedArray, uvec4, merged)
FB_TECHNIQUE_ARRAY(kRestirFinal, 16, , FinalArray, uvec4, final_reservoirs)
FB_TECHNIQUE_ARRAY(kRestirIndirect, 16, , IndirectArray, uvec4, indirect_reservoirs)
FB_TECHNIQUE_ARRAY(kRestirFresh, 16, , FreshArray, uvec4, fresh)

uint light_candidates() { return uint(restir.nee_candidates); }
uint remembered_candidates() { return uint(restir.nee_remembered); }
uint light_seen_stride() { return restir.seen_stride; }
bool knows_ways() { return restir.nee_visibility != 0; }
uint known_ways() { return restir.seen_ways; }
#endif
