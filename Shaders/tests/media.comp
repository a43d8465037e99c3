// For gpu/media_device_test.cpp: shared/phase.h, medium.h, dielectric.h and waves.h as the device computes them.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/test_media_probe.h"
layout(local_size_x = 64) in;
layout(push_constant) uniform Push { uint count; };
layout(set = 0, binding = 0, std430) readonly buffer Queries { MediaQuery queries[]; };
layout(set = 1, binding = 0, std430) writeonly buffer Answers { MediaAnswer answers[]; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i < count) answers[i] = media_probe(queries[i]);
}
