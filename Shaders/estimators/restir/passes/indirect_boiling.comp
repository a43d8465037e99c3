// Empties reservoirs of light of two reflections whose W stands out of their square's.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
const bool kReusesIndirect = false;
#include "estimators/restir/steps/boiling.glsl"

uint word_of(uint element) { return fresh.at[2u * element + 1u].y; }
void empty(uint element) {
  fresh.at[2u * element + 1u].y = 0u;
  if (restir.restir_keep == 0) indirect_reservoirs.at[2u * (restir.now + element) + 1u].y = 0u;
}

void main() { empty_what_stands_out(); }
