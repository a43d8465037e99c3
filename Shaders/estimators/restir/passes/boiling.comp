// Empties reservoirs of light whose W stands out of their square's, as a boiling filter does.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
const bool kReusesIndirect = false;
#include "estimators/restir/steps/boiling.glsl"

uint word_of(uint element) { return merged.at[element].z; }
void empty(uint element) {
  merged.at[element].z = 0u;
  if (restir.restir_neighbors == 0) final_reservoirs.at[element].z = 0u;
  if (restir.restir_neighbors == 0 || restir.restir_keep == 0) reservoirs.at[restir.now + element].z = 0u;
}

void main() { empty_what_stands_out(); }
