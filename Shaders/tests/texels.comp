// For gpu/precompiler_test.cpp: copies words of two texel buffers.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/bindings.h"
layout(local_size_x = 8) in;
layout(set = kSetScene, binding = kBindTexelBuffers) uniform usamplerBuffer first;
layout(set = kSetScene, binding = kBindTexelBuffers + 1u) uniform usamplerBuffer second;
layout(set = kSetFrame, binding = 0, std430) writeonly buffer Result { uint result[]; };

void main() {
  int i = int(gl_GlobalInvocationID.x);
  result[i] = texelFetch(first, i).x + texelFetch(second, i).y;
}
